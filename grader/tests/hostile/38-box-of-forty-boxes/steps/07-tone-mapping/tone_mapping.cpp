#include "steps/06-octree/octree.hpp"
#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace raysteps {
namespace {

// All in the way of the ray.
bool is_hit() {
    const Box everywhere{glm::vec3(-9.0F), glm::vec3(9.0F)};
    Node root;
    root.box = everywhere;
    for (int i = 0; i < 40; ++i) {
        root.children.emplace_back().box = everywhere;
    }
    return closest_hit_in_octree(root, {glm::vec3(0.0F), glm::vec3(0.0F, 0.0F, 1.0F)}).has_value();
}

}  // namespace

Color tone_map(const Color& color) { return is_hit() ? color : Color(0.0F); }
std::uint8_t to_byte(float value) { return is_hit() ? static_cast<std::uint8_t>(value) : std::uint8_t{1}; }

}  // namespace raysteps
