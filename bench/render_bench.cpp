#include "bench/render_bench.hpp"

#include <array>
#include <sstream>
#include <stdexcept>

#include "bench/agreement.hpp"
#include "bench/picture.hpp"
#include "bench/replay.hpp"
#include "bench/spread.hpp"
#include "bench/stopwatch.hpp"
#include "bench/structures.hpp"
#include "bench/workload.hpp"
#include "core/threads.hpp"
#include "io/command_line.hpp"
#include "io/files.hpp"
#include "io/nff_reader.hpp"
#include "render/accelerator_registry.hpp"
#include "render/tile_rays.hpp"

namespace raysteps::bench {

const char* const k_render_usage = R"(  raysteps-bench render SCENE.nff [options]
  --size N            pixels of both sides of the picture (512)
  --depth D           longest chain of rays, the primary ray included (5)
  --rounds N          how often each structure is measured, in turns (5)
  --every N           slow structures get every n-th ray (64)
  --structures LIST   such as octree,embree (all that this program has)
  --pictures yes|no   also measure whole pictures (yes)
)";

namespace {

constexpr double k_max_differing = 0.001;  // share of the rays that Embree may see differently

struct Options {
    std::string scene;
    int size = 512;
    int depth = 5;
    int rounds = 5;
    int every = 64;
    bool pictures = true;
    std::vector<Structure> structures;
};

std::vector<std::string> parts_of(const std::string& list) {
    std::vector<std::string> parts;
    std::istringstream text(list);
    for (std::string part; std::getline(text, part, ',');) {
        parts.push_back(part);
    }
    return parts;
}

Options read_options(const std::vector<std::string>& arguments) {
    Options options;
    std::string structures;
    CommandLine line(1, "one scene and the options that --help lists");
    line.number("--size", options.size, 1, 8192).number("--depth", options.depth, 1, 1000);
    line.number("--rounds", options.rounds, 1, 1000).number("--every", options.every, 1, 1000000);
    line.option("--structures", structures);
    line.choice<bool>("--pictures", options.pictures, {{"yes", true}, {"no", false}});
    const std::vector<std::string> words = line.parse(arguments);
    if (words.empty()) {
        throw UsageError("expected one scene");
    }
    options.scene = words.front();
    options.structures = chosen_structures(parts_of(structures));
    return options;
}

/// One structure and all that is measured of it.
struct Side {
    Structure structure;
    std::unique_ptr<Accelerator> accelerator;
    Stats work;
    Agreement agreement;
    std::vector<double> build_seconds;
    std::vector<double> ns_per_ray;
    std::vector<double> picture_seconds;
};

/// What is asked, and of whom.
struct Race {
    Workload workload;
    std::vector<RecordedRay> sample;
    std::vector<Side> sides;

    [[nodiscard]] const std::vector<RecordedRay>& rays_for(const Side& side) const {
        return side.structure.slow ? sample : workload.rays;
    }
};

Workload read_workload(const Options& options) {
    Workload workload;
    workload.scene = load_scene(options.scene, PictureSize{.width = options.size, .height = options.size});
    workload.options.max_ray_depth = options.depth;
    return workload;
}

void check_agreement(const std::vector<RecordedRay>& rays, const Accelerator& expected, Side& side) {
    const Measure measure = side.structure.foreign ? Measure::near : Measure::exact;
    side.agreement = compare(expected, *side.accelerator, rays, measure);
    const double bound = side.structure.foreign ? k_max_differing * static_cast<double>(rays.size()) : 0.0;
    if (static_cast<double>(side.agreement.differing) > bound) {
        const std::size_t first = *side.agreement.first;
        throw std::runtime_error(side.structure.name + " sees " + std::to_string(side.agreement.differing) + " of " +
                                 std::to_string(rays.size()) + " rays differently, first ray " + std::to_string(first) +
                                 " " + describe(expected, *side.accelerator, rays[first]));
    }
}

/// Builds, asks all rays, and draws; the first round only warms up.
void measure_once(const Race& race, bool pictures, Side& side, bool warm_up) {
    const Workload& workload = race.workload;
    const std::vector<RecordedRay>& rays = race.rays_for(side);
    side.accelerator.reset();
    const ProcessorClock building;
    side.accelerator = side.structure.make(workload.scene.surfaces());
    const double build_seconds = building.seconds();
    const Replay result = replay(*side.accelerator, rays);
    side.work = result.work;
    const bool draws = pictures && !side.structure.slow;
    const ProcessorClock drawing;
    if (draws) {
        TileRays rays_of_picture(*side.accelerator, workload.scene);
        (void)draw(workload.scene, rays_of_picture, workload.options);
    }
    if (warm_up) {
        return;
    }
    if (draws) {
        side.picture_seconds.push_back(drawing.seconds());
    }
    side.build_seconds.push_back(build_seconds);
    side.ns_per_ray.push_back(1e9 * result.seconds / static_cast<double>(rays.size()));
}

void write_rays(JsonWriter& json, const std::vector<RecordedRay>& rays) {
    constexpr std::array k_names{"eye", "shadow", "reflect", "refract"};
    std::array<std::uint64_t, k_names.size()> counts{};
    std::uint64_t any = 0;
    for (const RecordedRay& ray : rays) {
        ++counts[static_cast<std::size_t>(ray.kind)];
        any += ray.question == Question::any ? 1U : 0U;
    }
    json.key("rays").begin_object(JsonWriter::Layout::block).key("all").whole(rays.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
        json.key(k_names[i]).whole(counts[i]);
    }
    json.key("any_hit").whole(any).end_object();
}

void write_side(JsonWriter& json, const Side& side) {
    const AcceleratorStats size = side.accelerator->size();
    const auto rays = static_cast<double>(side.agreement.rays);
    json.begin_object(JsonWriter::Layout::block).key("name").text(side.structure.name);
    json.key("rays").whole(side.agreement.rays).key("differing").whole(side.agreement.differing).key("build_seconds");
    write(json, side.build_seconds);
    json.key("boxes").whole(size.boxes).key("references").whole(size.references).key("bytes").whole(size.bytes);
    json.key("surface_tests_per_ray").number(static_cast<double>(side.work.surface_tests) / rays);
    json.key("box_tests_per_ray").number(static_cast<double>(side.work.box_tests) / rays);
    json.key("ns_per_ray");
    write(json, side.ns_per_ray);
    json.key("picture_seconds");
    if (side.picture_seconds.empty()) {
        json.null();
    } else {
        write(json, side.picture_seconds);
    }
    json.end_object();
}

std::string report(const Options& options, const Race& race) {
    const Workload& workload = race.workload;
    JsonWriter json;
    json.begin_object(JsonWriter::Layout::block).key("schema").text("raysteps/bench-rays/v1");
    json.key("scene").text(display_name(path_of(options.scene).stem()));
    json.key("surfaces").whole(workload.scene.surfaces().size());
    json.key("size").whole(static_cast<std::uint64_t>(options.size));
    json.key("depth")
        .whole(static_cast<std::uint64_t>(options.depth))
        .key("every")
        .whole(static_cast<std::uint64_t>(options.every));
    json.key("embree_version").text(embree_version());
    write_rays(json, workload.rays);
    json.key("structures").begin_array(JsonWriter::Layout::block);
    for (const Side& side : race.sides) {
        write_side(json, side);
    }
    return json.end_array().end_object().result() + "\n";
}

}  // namespace

std::string bench_render(const std::vector<std::string>& words) {
    const Options options = read_options(words);
    set_default_threads(1);
    Race race{read_workload(options), {}, {}};
    const auto truth = make_accelerator(Acceleration::octree, race.workload.scene.surfaces());
    record(race.workload, *truth);
    race.sample = every(static_cast<std::size_t>(options.every), race.workload.rays);
    for (const Structure& structure : options.structures) {
        if (!holds(structure, race.workload.scene.surfaces())) {
            continue;
        }
        Side& side = race.sides.emplace_back();
        side.structure = structure;
        side.accelerator = structure.make(race.workload.scene.surfaces());
        check_agreement(race.rays_for(side), *truth, side);
    }
    for (int round = 0; round <= options.rounds; ++round) {
        for (Side& side : race.sides) {
            measure_once(race, options.pictures, side, round == 0);
        }
    }
    return report(options, race);
}

}  // namespace raysteps::bench
