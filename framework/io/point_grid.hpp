#pragma once
// Points in the plane, sorted into square cells: those near a place are found without a look at all.
#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace raysteps {

class PointGrid {
public:
    /// Takes the points whose numbers are in `chosen`; about as many cells as that. `points` must outlive the grid.
    PointGrid(std::span<const glm::dvec2> points, std::span<const std::size_t> chosen);

    /// Whether `accepts(number)` is true for any point in the rectangle. It is asked about near ones too.
    /// `work` grows by the number of cells and points looked at.
    template <typename Accepts>
    [[nodiscard]] bool any_in(const glm::dvec2& low, const glm::dvec2& high, std::size_t& work, Accepts accepts) const {
        for (std::size_t row = cell(low, 1); row <= cell(high, 1); ++row) {
            for (std::size_t column = cell(low, 0); column <= cell(high, 0); ++column) {
                const std::vector<std::size_t>& here = cells_[row * side_ + column];
                work += 1 + here.size();
                for (const std::size_t number : here) {
                    if (accepts(number)) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

private:
    [[nodiscard]] std::size_t cell(const glm::dvec2& point, int axis) const;

    glm::dvec2 low_{0.0};
    glm::dvec2 cells_per_unit_{0.0};
    std::size_t side_ = 1;  // cells along each axis
    std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace raysteps
