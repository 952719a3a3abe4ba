#pragma once
// The paper's own acceleration: a main box is split in eight, and each of these again, into 64 boxes. A ray
// tests the surfaces of all small boxes that it hits, each surface once, in the order of the scene.
#include <array>
#include <cstdint>
#include <vector>

#include "render/accelerator.hpp"

namespace raysteps {

class PaperBoxes final : public Accelerator {
public:
    explicit PaperBoxes(const SurfaceList& surfaces);

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
    [[nodiscard]] bool any_hit(const Ray& ray, float distance) const override;
    [[nodiscard]] StructureSize size() const override;
    void visit_boxes(const Surface* wanted, const BoxVisitor& visit) const override;

private:
    /// A small box and its intersect list: bit i of word w stands for surface 64 w + i.
    struct Small {
        Box box;
        std::vector<std::uint64_t> members;
    };
    struct Middle {
        Box box;
        std::array<Small, 8> small;
    };

    SurfaceList surfaces_;
    Box main_;
    std::array<Middle, 8> middle_;
};

}  // namespace raysteps
