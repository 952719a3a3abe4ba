#pragma once
// What travels between a program and the box that a student's code is in: values in the order in which they are
// written. Both ends are built from the same sources, so a value is its bytes.
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace raysteps::remote {

/// A message that no stand-in writes. Only a box sends one, when the code in it writes to the wire itself.
class BadMessage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

template <typename T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class Writer {
public:
    explicit Writer(std::string& bytes) : bytes_(bytes) {}

    template <Plain T>
    void put(T value) {
        put_bytes(&value, sizeof value);
    }
    void put_bytes(const void* bytes, std::size_t size) { bytes_.append(static_cast<const char*>(bytes), size); }
    void put(bool value) { put<std::uint8_t>(value ? 1 : 0); }
    void put(std::string_view text) {
        put(static_cast<std::uint32_t>(text.size()));
        bytes_.append(text);
    }

private:
    std::string& bytes_;
};

/// Every reader throws BadMessage where the message ends too early.
class Reader {
public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}

    template <Plain T>
    [[nodiscard]] T get() {
        if constexpr (std::is_same_v<T, bool>) {
            return get<std::uint8_t>() != 0;
        } else {
            T value;
            get_bytes(&value, sizeof value);
            return value;
        }
    }
    void get_bytes(void* bytes, std::size_t size) { std::memcpy(bytes, take(size).data(), size); }
    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    [[nodiscard]] std::string_view text() { return take(get<std::uint32_t>()); }

    /// A number of things that follow, each of which takes `least` bytes at least.
    [[nodiscard]] std::size_t count(std::size_t least) {
        const std::size_t count = get<std::uint32_t>();
        if (count > rest_.size() / least) {
            throw BadMessage("a message announces more than it holds");
        }
        return count;
    }

private:
    std::string_view take(std::size_t size) {
        if (size > rest_.size()) {
            throw BadMessage("a message ends too early");
        }
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }

    std::string_view rest_;
};

}  // namespace raysteps::remote
