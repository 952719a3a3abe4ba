#include "render/acceleration_choice.hpp"

#include <array>
#include <utility>

namespace raysteps {
namespace {

constexpr std::array<std::pair<std::string_view, Acceleration>, 6> k_names{{{"none", Acceleration::none},
                                                                            {"boxes", Acceleration::boxes},
                                                                            {"octree", Acceleration::octree},
                                                                            {"bvh", Acceleration::bvh},
                                                                            {"wide", Acceleration::wide},
                                                                            {"wide-octree", Acceleration::wide_octree}}};

}  // namespace

std::string_view acceleration_name(Acceleration kind) {
    for (const auto& [name, named] : k_names) {
        if (named == kind) {
            return name;
        }
    }
    return "";
}

std::optional<Acceleration> acceleration_named(std::string_view name) {
    for (const auto& [known, kind] : k_names) {
        if (known == name) {
            return kind;
        }
    }
    return std::nullopt;
}

std::vector<Acceleration> available_accelerations() {
    std::vector<Acceleration> available;
    for (const auto& [name, kind] : k_names) {
        if (has_accelerator(kind)) {
            available.push_back(kind);
        }
    }
    return available;
}

int step_of(Acceleration kind) {
    switch (kind) {
        case Acceleration::none:
            return 1;
        case Acceleration::bvh:
        case Acceleration::wide:
            return 9;
        default:
            return 6;
    }
}

Acceleration usual_acceleration(int step) {
    if (step < 6) {
        return Acceleration::none;
    }
    return step < 9 ? Acceleration::octree : Acceleration::bvh;
}

}  // namespace raysteps
