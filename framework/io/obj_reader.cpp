#include "io/obj_reader.hpp"

#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "io/files.hpp"
#include "io/numbers.hpp"
#include "io/token_scanner.hpp"

namespace raysteps {
namespace {

// A face names positions, places in the texture and normals each by a number of its own; here each such triple that
// occurs is one corner of the mesh.
class ObjReader {
public:
    ObjReader(std::string_view text, const std::string& name) : scanner_(text, name), fields_(scanner_) {}

    MeshData read() {
        for (Token token = scanner_.next(); !token.is_end(); token = scanner_.next()) {
            if (token.text == "v") {
                positions_.push_back(fields_.point("the position"));
            } else if (token.text == "vn") {
                normals_.push_back(fields_.point("the normal"));
            } else if (token.text == "vt") {
                const float u = fields_.coordinate("u of the place in the texture");
                uvs_.emplace_back(u, is_on(token.line) ? fields_.coordinate("v of the place in the texture") : 0.0F);
            } else if (token.text == "f") {
                read_face(token);
            }
            while (is_on(token.line)) {  // colours of vertices, and lines of no interest
                static_cast<void>(scanner_.next());
            }
        }
        if (!all_have_normals_) {
            mesh_.normals.clear();
        }
        if (!all_have_uvs_) {
            mesh_.uvs.clear();
        }
        return std::move(mesh_);
    }

private:
    struct Corner {
        std::size_t position = 0;
        std::optional<std::size_t> uv;
        std::optional<std::size_t> normal;

        // Not <=>, which the optional of Xcode 15 lacks.
        bool operator<(const Corner& other) const {
            return std::tie(position, uv, normal) < std::tie(other.position, other.uv, other.normal);
        }
    };

    [[nodiscard]] bool is_on(std::size_t line) {
        const Token token = scanner_.peek();
        return !token.is_end() && token.line == line;
    }

    void read_face(const Token& entity) {
        std::vector<std::uint32_t> corners;
        while (is_on(entity.line)) {
            corners.push_back(number_of(read_corner(scanner_.next())));
        }
        if (corners.size() < 3) {
            scanner_.fail(scanner_.here(), "three corners of a face or more", std::to_string(corners.size()));
        }
        for (std::size_t i = 2; i < corners.size(); ++i) {
            mesh_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
        }
    }

    // `7`, `7/2`, `7//3` or `7/2/3`.
    Corner read_corner(const Token& token) {
        std::array<std::string_view, 3> parts;
        std::string_view rest = token.text;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const std::size_t end = i < 2 ? rest.find('/') : std::string_view::npos;
            parts.at(i) = rest.substr(0, end);
            rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
        }
        Corner corner;
        corner.position = index(token, parts[0], positions_.size(), "positions");
        if (!parts[1].empty()) {
            corner.uv = index(token, parts[1], uvs_.size(), "places in the texture");
        }
        if (!parts[2].empty()) {
            corner.normal = index(token, parts[2], normals_.size(), "normals");
        }
        return corner;
    }

    // From 1, or backwards from -1 on, the last one.
    [[nodiscard]] std::size_t index(const Token& token, std::string_view text, std::size_t size,
                                    std::string_view what) const {
        const bool backwards = text.starts_with('-');
        const std::optional<int> number = parse_whole(backwards ? text.substr(1) : text);
        if (!number || *number < 1 || std::cmp_greater(*number, size)) {
            scanner_.fail(token,
                          "a number of one of the " + std::to_string(size) + ' ' + std::string(what) + " so far");
        }
        const auto found = static_cast<std::size_t>(*number);
        return backwards ? size - found : found - 1;
    }

    std::uint32_t number_of(const Corner& corner) {
        const auto [found, is_new] = numbers_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (is_new) {
            mesh_.positions.push_back(positions_[corner.position]);
            mesh_.normals.push_back(corner.normal ? normals_[*corner.normal] : glm::vec3(0.0F));
            mesh_.uvs.push_back(corner.uv ? uvs_[*corner.uv] : glm::vec2(0.0F));
            all_have_normals_ = all_have_normals_ && corner.normal;
            all_have_uvs_ = all_have_uvs_ && corner.uv;
        }
        return found->second;
    }

    TokenScanner scanner_;
    FieldReader fields_;
    std::vector<glm::vec3> positions_;
    std::vector<glm::vec3> normals_;
    std::vector<glm::vec2> uvs_;
    std::map<Corner, std::uint32_t> numbers_;
    bool all_have_normals_ = true;
    bool all_have_uvs_ = true;
    MeshData mesh_;
};

}  // namespace

MeshData read_obj(const std::filesystem::path& path) { return read_obj(read_text(path), display_name(path)); }

MeshData read_obj(std::string_view text, const std::string& name) { return ObjReader(text, name).read(); }

}  // namespace raysteps
