#pragma once
// Everything that a picture is made from.
#include <memory>
#include <utility>
#include <vector>

#include "core/area_light.hpp"
#include "core/camera.hpp"
#include "core/light.hpp"
#include "core/surface.hpp"

namespace raysteps {

class Scene {
public:
    Camera camera;
    Color background = k_black;
    std::vector<Light> lights;
    std::vector<AreaLight> area_lights;  ///< of part two; their surfaces are among the others, and shine

    void add(std::unique_ptr<Surface> surface) { add(std::move(surface), surfaces_.size()); }

    /// With the order that it has in another scene, of which this one is a part.
    void add(std::unique_ptr<Surface> surface, std::size_t order) {
        surface->order_ = order;
        surfaces_.push_back(surface.get());
        owned_.push_back(std::move(surface));
    }

    [[nodiscard]] const SurfaceList& surfaces() const { return surfaces_; }

private:
    std::vector<std::unique_ptr<Surface>> owned_;
    SurfaceList surfaces_;
};

}  // namespace raysteps
