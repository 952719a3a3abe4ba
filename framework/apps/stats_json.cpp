#include "apps/stats_json.hpp"

#include <locale>
#include <sstream>

namespace raysteps {

std::string stats_json(const Rendering& rendering, std::size_t surfaces) {
    const Stats& stats = rendering.stats;
    const double per_ray =
        stats.rays() == 0 ? 0.0 : static_cast<double>(stats.surface_tests) / static_cast<double>(stats.rays());
    const double share = surfaces == 0 ? 0.0 : per_ray / static_cast<double>(surfaces);
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(9);
    out << "{\n"
        << "  \"schema\": \"raysteps/stats/v1\",\n"
        << "  \"rays\": {\"eye\": " << stats.eye << ", \"eye_hit\": " << stats.eye_hit
        << ", \"shadow\": " << stats.shadow << ", \"reflect\": " << stats.reflect << ", \"refract\": " << stats.refract
        << "},\n"
        << "  \"surfaces\": " << surfaces << ",\n"
        << "  \"surface_tests\": " << stats.surface_tests << ",\n"
        << "  \"box_tests\": " << stats.box_tests << ",\n"
        << "  \"tests_per_ray\": " << per_ray << ",\n"
        << "  \"share_tested\": " << share << ",\n"
        << "  \"structure\": {\"boxes\": " << rendering.structure.boxes
        << ", \"references\": " << rendering.structure.references << ", \"bytes\": " << rendering.structure.bytes
        << "},\n"
        << "  \"build_seconds\": " << rendering.build_seconds << ",\n"
        << "  \"render_seconds\": " << rendering.render_seconds << "\n"
        << "}\n";
    return out.str();
}

}  // namespace raysteps
