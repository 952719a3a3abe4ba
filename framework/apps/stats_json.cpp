#include "apps/stats_json.hpp"

#include "io/json_writer.hpp"

namespace raysteps {

std::string stats_json(const Rendering& rendering, std::size_t surfaces) {
    const Stats& stats = rendering.stats;
    const double per_ray =
        stats.rays() == 0 ? 0.0 : static_cast<double>(stats.surface_tests) / static_cast<double>(stats.rays());
    const double share = surfaces == 0 ? 0.0 : per_ray / static_cast<double>(surfaces);
    JsonWriter json;
    json.begin_object(JsonWriter::Layout::block).key("schema").text("raysteps/stats/v1");
    json.key("rays").begin_object().key("eye").whole(stats.eye).key("eye_hit").whole(stats.eye_hit);
    json.key("shadow").whole(stats.shadow).key("reflect").whole(stats.reflect).key("refract").whole(stats.refract);
    json.end_object();
    json.key("surfaces").whole(surfaces).key("surface_tests").whole(stats.surface_tests);
    json.key("box_tests").whole(stats.box_tests);
    json.key("tests_per_ray").number(per_ray).key("share_tested").number(share);
    json.key("structure").begin_object().key("boxes").whole(rendering.structure.boxes);
    json.key("references").whole(rendering.structure.references).key("bytes").whole(rendering.structure.bytes);
    json.end_object();
    json.key("build_seconds").number(rendering.build_seconds).key("render_seconds").number(rendering.render_seconds);
    return json.end_object().result() + "\n";
}

}  // namespace raysteps
