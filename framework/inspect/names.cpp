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

std::string name_of(LossReason reason) {
    switch (reason) {
        case LossReason::not_chosen:
            return "not-chosen";
        case LossReason::not_tested:
            return "not-tested";
        case LossReason::box_missed:
            return "box-missed";
        case LossReason::not_visited:
            return "not-visited";
        case LossReason::not_listed:
            return "not-listed";
        case LossReason::no_overlap:
            return "no-overlap";
        case LossReason::no_box:
            return "no-box";
        case LossReason::no_bounds:
            return "no-bounds";
        case LossReason::no_part:
            return "no-part";
    }
    return "";
}

std::string name_of(Acceleration acceleration) { return std::string(accelerator_entry(acceleration).name); }

std::string name_of(const LightShape& shape) {
    if (std::holds_alternative<TriangleLight>(shape)) {
        return "triangle";
    }
    return std::holds_alternative<SphereLight>(shape) ? "sphere" : "disk";
}

}  // namespace raysteps
