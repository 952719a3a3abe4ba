#pragma once
// The structures that --accel offers, in one table: what each is called, which step builds it, and how it is made.
#include <memory>
#include <span>
#include <string_view>

#include "render/accelerator.hpp"

namespace raysteps {

/// The surfaces must outlive what is made of them.
using AcceleratorMaker = std::unique_ptr<Accelerator> (*)(const SurfaceList& surfaces);

struct AcceleratorEntry {
    Acceleration kind = Acceleration::none;
    std::string_view name;                ///< as --accel takes it
    int step = 1;                         ///< the step that builds it; every surface needs none
    AcceleratorMaker make = nullptr;      ///< null: this program does not have it
    std::string_view unavailable_reason;  ///< what to say where it is missing, and what to take instead
};

/// One entry for each structure, in the order of the course.
[[nodiscard]] std::span<const AcceleratorEntry> accelerator_registry();

[[nodiscard]] const AcceleratorEntry& accelerator_entry(Acceleration kind);

/// Null for a name that no structure has.
[[nodiscard]] const AcceleratorEntry* find_accelerator(std::string_view name);

/// A program that is linked with the wide trees registers them before main begins. Always true.
bool register_accelerator(Acceleration kind, AcceleratorMaker make);

/// None before step 06, octree from there on, bvh for step 09; none for a tree whose step the course leaves out.
[[nodiscard]] Acceleration default_accelerator(int step);

/// Builds the structure. The surfaces must outlive it. Throws std::invalid_argument for one that the program lacks.
[[nodiscard]] std::unique_ptr<Accelerator> make_accelerator(Acceleration kind, const SurfaceList& surfaces);

}  // namespace raysteps
