#pragma once
// The text that the worker reads and writes: words and numbers between blanks, and the kit's values as such numbers.
// The judge's protocol.py writes and reads the same order.
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/box.hpp"
#include "core/camera.hpp"
#include "core/hit_record.hpp"
#include "core/light.hpp"

namespace raysteps {

/// What a tree may have at most to be told; judge/octrees.py and judge/bvhs.py know the same numbers.
inline constexpr std::size_t k_max_nodes = 5000;
inline constexpr std::size_t k_max_entries = 50000;  ///< of the lists in all leaves together

/// A case that nobody can run: the judge's mistake, not the student's.
class ProtocolError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The words of one line, from left to right. Every reader throws ProtocolError where there is no such word.
class TokenReader {
public:
    explicit TokenReader(std::string_view line) : rest_(line) {}

    [[nodiscard]] std::string word();
    [[nodiscard]] float number();  ///< also inf, -inf and nan
    [[nodiscard]] int whole();
    [[nodiscard]] std::uint32_t index();  ///< any that 32 bits hold, which is more than an int does
    [[nodiscard]] bool flag() { return whole() != 0; }
    [[nodiscard]] int count();  ///< from 0 to a million
    /// One of the values of an enum, of which `last` is the last; `what` they are called in an error.
    template <typename Enum>
    [[nodiscard]] Enum one_of(const std::string& what, Enum last) {
        const int number = whole();
        if (number < 0 || number > static_cast<int>(last)) {
            throw ProtocolError("there is no " + what + " " + std::to_string(number));
        }
        return static_cast<Enum>(number);
    }
    [[nodiscard]] glm::vec3 vector();
    void expect_end();

private:
    std::string_view rest_;
};

/// The words of an answer.
class TokenWriter {
public:
    TokenWriter& word(std::string_view word);
    TokenWriter& number(float value);  ///< the shortest text that reads back as the same float
    TokenWriter& whole(long long value);
    TokenWriter& flag(bool value) { return whole(value ? 1 : 0); }
    TokenWriter& vector(const glm::vec3& value);

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_;
};

[[nodiscard]] Ray read_ray(TokenReader& words);          ///< origin, direction
[[nodiscard]] Camera read_camera(TokenReader& words);    ///< from, at, up, angle, size, hither, lens
[[nodiscard]] ViewFrame read_frame(TokenReader& words);  ///< right, up, forward, half width, half height
[[nodiscard]] Fill read_fill(TokenReader& words);        ///< colour, kd, ks, shine, transmittance, index
[[nodiscard]] Light read_light(TokenReader& words);      ///< position, colour
[[nodiscard]] Box read_box(TokenReader& words);          ///< min, max
/// Position, fill, normal, ray direction, distance, front face.
[[nodiscard]] HitRecord read_hit(TokenReader& words);
/// How many, then each.
[[nodiscard]] std::vector<Light> read_lights(TokenReader& words);

void write_ray(TokenWriter& answer, const Ray& ray);
void write_frame(TokenWriter& answer, const ViewFrame& frame);
void write_hit(TokenWriter& answer, const std::optional<HitRecord>& hit);  ///< `miss`, or `hit` and the record
void write_box(TokenWriter& answer, const Box& box);

}  // namespace raysteps
