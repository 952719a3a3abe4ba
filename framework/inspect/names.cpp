#include "inspect/names.hpp"

#include "render/accelerator_registry.hpp"

namespace raysteps {

std::string name_of(RayRole role) {
    switch (role) {
        case RayRole::eye:
            return "eye";
        case RayRole::shadow:
            return "shadow";
        case RayRole::reflect:
            return "reflect";
        case RayRole::refract:
            return "refract";
        case RayRole::internal:
            return "internal";
    }
    return "";
}

std::string name_of(MissReason reason) {
    switch (reason) {
        case MissReason::not_chosen:
            return "not-chosen";
        case MissReason::not_tested:
            return "not-tested";
        case MissReason::box_missed:
            return "box-missed";
        case MissReason::not_visited:
            return "not-visited";
        case MissReason::not_listed:
            return "not-listed";
        case MissReason::no_overlap:
            return "no-overlap";
        case MissReason::no_box:
            return "no-box";
        case MissReason::no_bounds:
            return "no-bounds";
        case MissReason::no_part:
            return "no-part";
    }
    return "";
}

std::string name_of(Acceleration acceleration) { return std::string(accelerator_entry(acceleration).name); }

}  // namespace raysteps
