#include "bench/structures.hpp"

#include <algorithm>
#include <array>

#include "bench/by_bounds.hpp"
#include "bench/other_libraries.hpp"
#include "core/triangle.hpp"
#include "io/command_line.hpp"
#include "io/json_writer.hpp"
#include "render/accelerator_registry.hpp"
#ifdef RAYSTEPS_EMBREE
#include "bench/embree_accelerator.hpp"
#endif

namespace raysteps::bench {
namespace {

// In the order of the tables. A new Acceleration needs its place here; its name is the registry's.
constexpr std::array k_own{Acceleration::none, Acceleration::boxes,       Acceleration::octree,
                           Acceleration::bvh,  Acceleration::wide_octree, Acceleration::wide};

#ifdef RAYSTEPS_TINYBVH
bool only_triangles(const SurfaceList& surfaces) {
    return std::all_of(surfaces.begin(), surfaces.end(),
                       [](const Surface* surface) { return dynamic_cast<const Triangle*>(surface) != nullptr; });
}
#endif

bool is_slow(Acceleration kind) { return kind == Acceleration::none || kind == Acceleration::boxes; }

std::vector<Structure> make_table() {
    std::vector<Structure> table;
    for (const Acceleration kind : k_own) {
        const AcceleratorEntry& entry = accelerator_entry(kind);
        if (entry.make != nullptr) {
            table.push_back(
                {.name = std::string(entry.name), .slow = is_slow(kind), .foreign = false, .make = entry.make});
        }
    }
    table.push_back({.name = "octree-by-bounds", .slow = false, .foreign = false, .make = make_octree_by_bounds});
#ifdef RAYSTEPS_EMBREE
    const auto add_embree = [&table](const char* name, EmbreeMode mode) {
        const auto make = [mode](const SurfaceList& surfaces) { return make_embree(surfaces, mode); };
        table.push_back({.name = name, .slow = false, .foreign = true, .make = make});
    };
    add_embree("embree", EmbreeMode::fast);
    add_embree("embree-high", EmbreeMode::high);
    add_embree("embree-robust", EmbreeMode::robust);
#endif
#ifdef RAYSTEPS_TINYBVH
    table.push_back({.name = "tinybvh", .foreign = true, .can_hold = only_triangles, .make = make_tinybvh});
#endif
#ifdef RAYSTEPS_BVH_V2
    table.push_back({.name = "bvh-v2", .foreign = true, .make = make_bvh_v2});
#endif
    return table;
}

}  // namespace

const std::vector<Structure>& all_structures() {
    static const std::vector<Structure> structures = make_table();
    return structures;
}

std::vector<Structure> chosen_structures(const std::vector<std::string>& names) {
    std::vector<Structure> chosen;
    std::string known;
    std::vector<std::string> unknown = names;
    for (const Structure& structure : all_structures()) {
        const auto count = std::count(names.begin(), names.end(), structure.name);
        std::erase(unknown, structure.name);
        if (names.empty() || count > 0) {
            chosen.push_back(structure);
        }
        known += (known.empty() ? "" : ", ") + structure.name;
    }
    if (!unknown.empty()) {
        throw UsageError("--structures: expected names among " + known + ", separated by commas, found '" +
                         unknown.front() + "'");
    }
    return chosen;
}

std::string list_structures(const std::vector<std::string>& words) {
    if (!words.empty()) {
        throw UsageError("list: expected nothing after it");
    }
    JsonWriter json;
    json.begin_object(JsonWriter::Layout::block).key("schema").text("raysteps/bench-structures/v1");
    json.key("embree_version").text(embree_version()).key("structures").begin_array(JsonWriter::Layout::block);
    for (const Structure& structure : all_structures()) {
        json.begin_object(JsonWriter::Layout::block).key("name").text(structure.name);
        json.key("slow").flag(structure.slow).key("foreign").flag(structure.foreign).end_object();
    }
    return json.end_array().end_object().result() + "\n";
}

std::string embree_version() {
#ifdef RAYSTEPS_EMBREE
    return k_embree_version;
#else
    return "";
#endif
}

}  // namespace raysteps::bench
