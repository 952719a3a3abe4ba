#pragma once
// The structures of one scene, each built when it is first asked for.
#include <map>
#include <memory>
#include <mutex>

#include "core/scene.hpp"
#include "render/accelerator_registry.hpp"

namespace raysteps {

class AcceleratorCache {
public:
    explicit AcceleratorCache(const Scene& scene) : scene_(scene) {}

    /// From any thread; others that ask meanwhile wait. Throws what make_accelerator throws.
    [[nodiscard]] const Accelerator& get(Acceleration kind) {
        const std::scoped_lock lock(mutex_);
        std::unique_ptr<Accelerator>& structure = built_[kind];
        if (!structure) {
            structure = make_accelerator(kind, scene_.surfaces());
        }
        return *structure;
    }

private:
    const Scene& scene_;
    std::mutex mutex_;
    std::map<Acceleration, std::unique_ptr<Accelerator>> built_;
};

}  // namespace raysteps
