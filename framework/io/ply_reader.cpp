#include "io/ply_reader.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "io/files.hpp"
#include "io/numbers.hpp"
#include "io/token_scanner.hpp"

namespace raysteps {
namespace {

enum class Kind : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Kind> kind_of(std::string_view name) {
    struct Name {
        std::string_view text;
        Kind kind;
    };
    constexpr std::array k_names{
        Name{"char", Kind::int8},      Name{"int8", Kind::int8},       Name{"uchar", Kind::uint8},
        Name{"uint8", Kind::uint8},    Name{"short", Kind::int16},     Name{"int16", Kind::int16},
        Name{"ushort", Kind::uint16},  Name{"uint16", Kind::uint16},   Name{"int", Kind::int32},
        Name{"int32", Kind::int32},    Name{"uint", Kind::uint32},     Name{"uint32", Kind::uint32},
        Name{"float", Kind::float32},  Name{"float32", Kind::float32}, Name{"double", Kind::float64},
        Name{"float64", Kind::float64}};
    const auto found = std::find_if(k_names.begin(), k_names.end(), [&](const Name& one) { return one.text == name; });
    return found == k_names.end() ? std::nullopt : std::optional(found->kind);
}

struct Property {
    std::string name;
    Kind kind = Kind::float32;
    std::optional<Kind> count;  ///< of a list: of its length
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

enum class Format : std::uint8_t { text, little, big };

/// The values of the body, one after the other.
class Body {
public:
    Body(std::string_view bytes, const std::string& name, Format format, std::size_t start)
        : bytes_(bytes), name_(name), format_(format), place_(start), scanner_(bytes.substr(start), name) {}

    double value(Kind kind, std::string_view what) {
        if (format_ == Format::text) {
            const Token token = scanner_.next();
            const std::optional<double> number = parse_number(token.text);
            if (!number || !std::isfinite(*number)) {
                fail(what, token.is_end() ? "the end of the file" : quoted(token.text));
            }
            return *number;
        }
        switch (kind) {
            case Kind::int8:
                return binary<std::int8_t>(what);
            case Kind::uint8:
                return binary<std::uint8_t>(what);
            case Kind::int16:
                return binary<std::int16_t>(what);
            case Kind::uint16:
                return binary<std::uint16_t>(what);
            case Kind::int32:
                return binary<std::int32_t>(what);
            case Kind::uint32:
                return binary<std::uint32_t>(what);
            case Kind::float32:
                return static_cast<double>(binary<float>(what));
            case Kind::float64:
                return binary<double>(what);
        }
        return 0.0;
    }

    std::size_t whole(Kind kind, std::string_view what, std::size_t below) {
        const double number = value(kind, what);
        if (!(number >= 0.0 && number < static_cast<double>(below)) || number != std::floor(number)) {
            fail(std::string(what) + " from 0 to " + std::to_string(below - 1), number_text(number, 12));
        }
        return static_cast<std::size_t>(number);
    }

    float coordinate(Kind kind, std::string_view what) {
        const double number = value(kind, what);
        if (!(std::abs(number) <= static_cast<double>(k_farthest))) {
            fail(std::string(what) + " within a thousand million of 0", number_text(number, 12));
        }
        return static_cast<float>(number);
    }

    [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
        throw ReadError(name_ + ": " + element_, expected, found);
    }

    void begin(const std::string& element, std::size_t number) { element_ = element + ' ' + std::to_string(number); }

private:
    template <typename T>
    T binary(std::string_view what) {
        std::array<char, sizeof(T)> raw{};
        if (bytes_.size() - place_ < sizeof(T)) {
            fail(what, "the end of the file");
        }
        std::copy_n(bytes_.data() + place_, sizeof(T), raw.begin());
        place_ += sizeof(T);
        const bool is_little = std::endian::native == std::endian::little;
        if (is_little != (format_ == Format::little)) {
            std::reverse(raw.begin(), raw.end());
        }
        return std::bit_cast<T>(raw);
    }

    std::string_view bytes_;
    std::string name_;
    Format format_;
    std::size_t place_;
    TokenScanner scanner_;
    std::string element_ = "body";
};

constexpr std::size_t k_max_items = std::size_t{1} << 26U;  // elements of a kind, or values of a list
constexpr std::size_t k_max_elements = 100;

bool is_known(std::string_view element) { return element == "vertex" || element == "face"; }

class PlyReader {
public:
    PlyReader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

    MeshData read() {
        read_header();
        Body body(bytes_, name_, format_, place_);
        for (const Element& element : elements_) {
            const std::size_t count = element.properties.empty() ? 0 : element.count;  // what is nothing takes no time
            for (std::size_t i = 0; i < count; ++i) {
                body.begin(is_known(element.name) ? element.name : raysteps::quoted(element.name), i);
                read_one(element, body);
            }
        }
        return std::move(mesh_);
    }

private:
    // The header is lines of words, whatever the body is.
    std::string_view next_line() {
        const std::size_t end = std::min(bytes_.find('\n', place_), bytes_.size());
        std::string_view line = bytes_.substr(place_, end - place_);
        place_ = std::min(end + 1, bytes_.size());
        ++line_;
        if (line.ends_with('\r')) {
            line.remove_suffix(1);
        }
        return line;
    }

    [[noreturn]] void fail(std::string_view expected, std::string_view line) const {
        throw ReadError(name_, line_, 1, expected, line.empty() ? "nothing" : quoted(line));
    }

    void read_header() {
        const std::string_view first = next_line();
        if (words_of(first) != std::vector<std::string_view>{"ply"}) {
            fail("`ply`, the first line of a PLY file", first);
        }
        read_format();
        while (true) {
            const std::string_view line = next_line();
            const std::vector<std::string_view> words = words_of(line);
            if (words.size() == 1 && words[0] == "end_header") {
                check_vertices();
                return;
            }
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
                if (place_ == bytes_.size()) {
                    fail("`end_header`", line);
                }
            } else if (words[0] == "element" && words.size() == 3) {
                read_element(words, line);
            } else if (words[0] == "property" && !elements_.empty()) {
                read_property(words, line);
            } else {
                fail("`element`, `property`, `comment` or `end_header`", line);
            }
        }
    }

    /// Without its place a vertex would be at the origin.
    void check_vertices() const {
        for (const Element& element : elements_) {
            const auto has = [&](std::string_view axis) {
                return std::any_of(element.properties.begin(), element.properties.end(),
                                   [&](const Property& one) { return one.name == axis && !one.count; });
            };
            const bool has_place = element.properties.empty() || (has("x") && has("y") && has("z"));
            if (element.name == "vertex" && element.count > 0 && !has_place) {
                fail("the properties x, y and z of the vertices before it", "end_header");
            }
        }
    }

    void read_format() {
        const std::string_view line = next_line();
        const std::vector<std::string_view> words = words_of(line);
        const bool is_known = words.size() == 3 && words[0] == "format" && words[2] == "1.0";
        if (is_known && words[1] == "ascii") {
            format_ = Format::text;
        } else if (is_known && words[1] == "binary_little_endian") {
            format_ = Format::little;
        } else if (is_known && words[1] == "binary_big_endian") {
            format_ = Format::big;
        } else {
            fail("`format` and ascii, binary_little_endian or binary_big_endian, and 1.0", line);
        }
    }

    void read_element(const std::vector<std::string_view>& words, std::string_view line) {
        const std::optional<int> count = parse_whole(words[2]);
        if (!count || *count < 0 || std::cmp_greater(*count, k_max_items)) {
            fail("a number of elements up to 67108864", line);
        }
        if (std::any_of(elements_.begin(), elements_.end(), [&](const Element& one) { return one.name == words[1]; })) {
            fail("an element of another name than those before", line);
        }
        if (elements_.size() == k_max_elements) {
            fail("100 kinds of elements at most", line);
        }
        elements_.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
    }

    void read_property(const std::vector<std::string_view>& words, std::string_view line) {
        const bool is_list = words.size() == 5 && words[1] == "list";
        const std::optional<Kind> kind = words.size() >= 3 ? kind_of(words[words.size() - 2]) : std::nullopt;
        const std::optional<Kind> count = is_list ? kind_of(words[2]) : std::nullopt;
        if (!kind || (is_list ? !count : words.size() != 3)) {
            fail("`property`, a type and a name, or `property list` with two types and a name", line);
        }
        elements_.back().properties.push_back({std::string(words.back()), *kind, count});
    }

    void read_one(const Element& element, Body& body) {
        if (element.name == "vertex") {
            read_vertex(element, body);
            return;
        }
        for (const Property& property : element.properties) {
            const bool is_corners =
                element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index");
            if (is_corners && property.count) {
                read_face(property, body);
            } else {
                skip(property, body);
            }
        }
    }

    static void skip(const Property& property, Body& body) {
        const std::size_t values = property.count ? body.whole(*property.count, "a number of values", k_max_items) : 1;
        for (std::size_t i = 0; i < values; ++i) {
            static_cast<void>(body.value(property.kind, "a value of " + raysteps::quoted(property.name)));
        }
    }

    void read_vertex(const Element& element, Body& body) {
        glm::vec3 position(0.0F);
        glm::vec3 normal(0.0F);
        glm::vec2 uv(0.0F);
        int normals = 0;
        int uvs = 0;
        for (const Property& property : element.properties) {
            constexpr std::array<std::string_view, 3> k_axes{"x", "y", "z"};
            constexpr std::array<std::string_view, 3> k_normals{"nx", "ny", "nz"};
            const auto axis = std::find(k_axes.begin(), k_axes.end(), property.name) - k_axes.begin();
            const auto normal_axis = std::find(k_normals.begin(), k_normals.end(), property.name) - k_normals.begin();
            const bool is_u = property.name == "u" || property.name == "s" || property.name == "texture_u";
            const bool is_v = property.name == "v" || property.name == "t" || property.name == "texture_v";
            if (property.count) {
                skip(property, body);
            } else if (axis < 3) {
                position[static_cast<int>(axis)] = body.coordinate(property.kind, "a coordinate");
            } else if (normal_axis < 3) {
                normal[static_cast<int>(normal_axis)] = body.coordinate(property.kind, "a part of the normal");
                ++normals;
            } else if (is_u || is_v) {
                (is_u ? uv.x : uv.y) = body.coordinate(property.kind, "a place in the texture");
                ++uvs;
            } else {
                static_cast<void>(body.value(property.kind, "a value of " + raysteps::quoted(property.name)));
            }
        }
        mesh_.positions.push_back(position);
        if (normals == 3) {
            mesh_.normals.push_back(normal);
        }
        if (uvs == 2) {
            mesh_.uvs.push_back(uv);
        }
    }

    void read_face(const Property& property, Body& body) {
        const std::size_t corners = body.whole(*property.count, "a number of corners", k_max_items);
        if (mesh_.positions.empty() || corners < 3) {
            body.fail("three corners or more, after the vertices", std::to_string(corners));
        }
        std::uint32_t first = 0;
        std::uint32_t last = 0;
        for (std::size_t i = 0; i < corners; ++i) {
            const auto corner =
                static_cast<std::uint32_t>(body.whole(property.kind, "the number of a vertex", mesh_.positions.size()));
            if (i == 0) {
                first = corner;
            } else if (i > 1) {
                mesh_.triangles.push_back({first, last, corner});
            }
            last = corner;
        }
    }

    std::string_view bytes_;
    std::string name_;
    std::size_t place_ = 0;
    std::size_t line_ = 0;
    Format format_ = Format::text;
    std::vector<Element> elements_;
    MeshData mesh_;
};

}  // namespace

MeshData read_ply(const std::filesystem::path& path) { return read_ply(read_file(path), display_name(path)); }

MeshData read_ply(std::string_view bytes, const std::string& name) { return PlyReader(bytes, name).read(); }

}  // namespace raysteps
