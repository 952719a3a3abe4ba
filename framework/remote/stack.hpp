#pragma once
// The stack of a fiber.
#include <cstddef>

namespace raysteps::remote {

/// As a thread's: below it lies what nobody may touch, so who overflows it crashes.
class Stack {
public:
    Stack();
    ~Stack();
    Stack(const Stack&) = delete;
    Stack& operator=(const Stack&) = delete;

    [[nodiscard]] void* lowest() const;
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    void* base_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace raysteps::remote
