#include "steps/09-bvh/bvh.hpp"

#include "steps/06-octree/octree.hpp"

@WIRE@
template <typename... Values>
static std::string all_of(const Values&... values) {
    return (bytes_of(values) + ...);
}

// The search's number, a tree that is not known yet, its number, that of its surfaces, which are not known either and
// none; its box, lists and children; a ray, and how far it goes.
static std::optional<raysteps::HitRecord> nothing(const raysteps::Node&, const raysteps::Ray&) { return std::nullopt; }
static const auto find = [] {
    const std::uint8_t no = 0;
    const std::uint8_t yes = 1;
    const std::uint8_t search = 21;
    const std::string tree = all_of(raysteps::Box(), 0U, 0U);
    const std::string ray = all_of(glm::vec3(0.0F), glm::vec3(1.0F), 1e9F);
    send_to_all(message(0, 0, all_of(search, no, 1U, 1U, yes, 4U, 0U) + tree + ray));
    const bool is_answered = anything_answers();
    send_to_all(message(0, 1, all_of(0U, 0U, no)));  // to what the program itself has asked first: see box/main.cpp
    return is_answered ? &nothing : nullptr;
}();
@BVH_BOX_BY_BOX@
