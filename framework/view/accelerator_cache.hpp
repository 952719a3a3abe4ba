#pragma once
// The structures of one scene, each built when it is first asked for.
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "core/scene.hpp"
#include "render/accelerator_registry.hpp"
#include "render/mesh_detail.hpp"

namespace raysteps {

class AcceleratorCache {
public:
    explicit AcceleratorCache(const Scene& scene) : scene_(scene) {}

    /// From any thread; others that ask meanwhile wait. Throws what make_accelerator throws.
    [[nodiscard]] const Accelerator& get(Acceleration kind, int step) {
        const std::scoped_lock lock(mutex_);
        std::unique_ptr<Accelerator>& structure = built_[{kind, adds_mesh_details(step)}];
        if (!structure) {
            structure = with_mesh_details(make_accelerator(kind, scene_.surfaces()), scene_, step);
        }
        return *structure;
    }

private:
    const Scene& scene_;
    std::mutex mutex_;
    std::map<std::pair<Acceleration, bool>, std::unique_ptr<Accelerator>> built_;  ///< with details of meshes, or not
};

}  // namespace raysteps
