#include "bench/structures.hpp"

#include <algorithm>
#include <array>

#include "bench/by_bounds.hpp"
#include "io/command_line.hpp"
#include "io/json_writer.hpp"
#ifdef RAYSTEPS_EMBREE
#include "bench/embree_accelerator.hpp"
#endif

namespace raysteps::bench {
namespace {

struct OwnStructure {
    const char* name;
    Acceleration kind;
    bool slow;
};

// A new Acceleration needs one line here; the commands find it by its name.
constexpr std::array k_own{
    OwnStructure{"none", Acceleration::none, true},
    OwnStructure{"boxes", Acceleration::boxes, true},
    OwnStructure{"octree", Acceleration::octree, false},
    OwnStructure{"bvh", Acceleration::bvh, false},
    OwnStructure{"wide-octree", Acceleration::wide_octree, false},
    OwnStructure{"wide", Acceleration::wide, false},
};

std::vector<Structure> make_table() {
    std::vector<Structure> table;
    for (const OwnStructure& own : k_own) {
        if (has_accelerator(own.kind)) {
            const auto make = [kind = own.kind](const SurfaceList& surfaces) {
                return make_accelerator(kind, surfaces);
            };
            table.push_back({own.name, own.slow, false, make});
        }
    }
    table.push_back({"octree-by-bounds", false, false, make_octree_by_bounds});
#ifdef RAYSTEPS_EMBREE
    const auto add_embree = [&table](const char* name, EmbreeMode mode) {
        const auto make = [mode](const SurfaceList& surfaces) { return make_embree(surfaces, mode); };
        table.push_back({name, false, true, make});
    };
    add_embree("embree", EmbreeMode::fast);
    add_embree("embree-high", EmbreeMode::high);
    add_embree("embree-robust", EmbreeMode::robust);
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
