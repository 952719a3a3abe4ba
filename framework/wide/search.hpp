#pragma once
// Looks for hits in a wide tree, with the widest instructions that the machine has.
//
// Eight surfaces at a time are asked in single precision, with a bound on every rounding error, theirs and that of
// Surface::hit. A surface that is surely missed is out; one that is surely hit bounds the search; the few in doubt, and
// the winner, are asked themselves. So the answer is Surface::hit's own, to the last bit, as long as no ray comes from
// farther away than some hundred sizes of the scene: there no box is sure any more, whatever the tree.
#include <optional>

#include "core/hit_record.hpp"
#include "wide/tree.hpp"

namespace raysteps::wide {

/// The searches for the machine that the program runs on.
struct Search {
    /// The nearest hit with distance > 0; of two at the same distance that of the surface which comes first in the
    /// scene.
    std::optional<HitRecord> (*closest_hit)(const Tree& tree, const Ray& ray);

    /// Whether any surface is hit nearer than `distance`. A surface that is surely hit is not asked itself any more.
    /// `hint` is 0, or what a search of the same tree left there: that is asked first.
    bool (*occluded)(const Tree& tree, const Ray& ray, float distance, std::uint32_t& hint);
};

[[nodiscard]] Search best_search();

}  // namespace raysteps::wide
