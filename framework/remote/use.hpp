#pragma once
// What a question has lent, such as a scene, is in use while a question of the other end about it is answered. Nothing
// may end before whatever uses it.
#include <utility>

#include "remote/session.hpp"

namespace raysteps::remote {

class UseCount {
public:
    /// Called before what was lent ends. An honest box has had its answers by then: it needs them for its own.
    void require_none() const {
        if (count_ != 0) {
            Session::current().broken("an answer came before those that it was to be made of");
        }
    }

private:
    friend class UseGuard;
    int count_ = 0;
};

class UseGuard {
public:
    explicit UseGuard(UseCount& uses) : uses_(&uses) { ++uses_->count_; }
    UseGuard(UseGuard&& other) noexcept : uses_(std::exchange(other.uses_, nullptr)) {}
    UseGuard& operator=(UseGuard&&) = delete;
    ~UseGuard() {
        if (uses_ != nullptr) {
            --uses_->count_;
        }
    }

private:
    UseCount* uses_;
};

}  // namespace raysteps::remote
