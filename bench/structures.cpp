#include "bench/structures.hpp"

#include <algorithm>

#include "bench/arguments.hpp"
#include "bench/json.hpp"
#ifdef RAYSTEPS_EMBREE
#include "bench/embree_accelerator.hpp"
#endif

namespace raysteps::bench {
namespace {

template <Acceleration kind>
std::unique_ptr<Accelerator> kits_own(const SurfaceList& surfaces) {
    return make_accelerator(kind, surfaces);
}

#ifdef RAYSTEPS_EMBREE
template <EmbreeMode mode>
std::unique_ptr<Accelerator> embree(const SurfaceList& surfaces) {
    return make_embree(surfaces, mode);
}
#endif

}  // namespace

// A new Acceleration needs one line here; the commands find it by its name.
const std::vector<Structure>& all_structures() {
    static const std::vector<Structure> structures{
        {"none", true, false, kits_own<Acceleration::none>},
        {"boxes", true, false, kits_own<Acceleration::boxes>},
        {"octree", false, false, kits_own<Acceleration::octree>},
        {"bvh", false, false, kits_own<Acceleration::bvh>},
#ifdef RAYSTEPS_EMBREE
        {"embree", false, true, embree<EmbreeMode::fast>},
        {"embree-high", false, true, embree<EmbreeMode::high>},
        {"embree-robust", false, true, embree<EmbreeMode::robust>},
#endif
    };
    return structures;
}

std::vector<Structure> chosen_structures(const std::vector<std::string>& names) {
    std::vector<Structure> chosen;
    std::string known;
    std::size_t found = 0;
    for (const Structure& structure : all_structures()) {
        const auto count = std::count(names.begin(), names.end(), structure.name);
        found += static_cast<std::size_t>(count);
        if (names.empty() || count > 0) {
            chosen.push_back(structure);
        }
        known += (known.empty() ? "" : ", ") + structure.name;
    }
    if (found != names.size()) {
        throw UsageError("--structures: expected names among " + known + ", parted by commas");
    }
    return chosen;
}

std::string list_structures(const std::vector<std::string>& words) {
    if (!words.empty()) {
        throw UsageError("list: expected nothing after it");
    }
    Json json;
    json.begin_object().field("schema", std::string("raysteps/bench-structures/v1"));
    json.field("embree_version", embree_version()).key("structures").begin_array();
    for (const Structure& structure : all_structures()) {
        json.begin_object().field("name", structure.name);
        json.field("slow", structure.slow).field("foreign", structure.foreign).end_object();
    }
    return json.end_array().end_object().text();
}

std::string embree_version() {
#ifdef RAYSTEPS_EMBREE
    return k_embree_version;
#else
    return "";
#endif
}

}  // namespace raysteps::bench
