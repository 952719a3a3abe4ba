#include "apps/spd_report.hpp"

#include <algorithm>
#include <iomanip>
#include <optional>
#include <sstream>

#include "render/spd.hpp"

namespace raysteps {
namespace {

void add_line(std::ostringstream& out, const char* kind, std::uint64_t counted,
              std::optional<std::uint64_t> published) {
    out << std::left << std::setw(12) << kind << std::right << std::setw(10) << counted;
    if (published) {
        out << std::setw(12) << *published;
        if (*published > 0) {
            const double off = 100.0 * (static_cast<double>(counted) / static_cast<double>(*published) - 1.0);
            out << std::setw(11) << std::fixed << std::setprecision(2) << std::showpos << off << " %" << std::noshowpos;
        }
    }
    out << '\n';
}

}  // namespace

std::string spd_report(const std::string& scene, const Stats& stats) {
    const auto found = std::find_if(k_spd_published.begin(), k_spd_published.end(),
                                    [&scene](const SpdCounts& counts) { return counts.scene == scene; });
    std::optional<SpdCounts> published;
    if (found != k_spd_published.end()) {
        published = *found;
    }
    const auto of = [&published](std::uint64_t SpdCounts::* member) {
        return published ? std::optional((*published).*member) : std::nullopt;
    };
    std::ostringstream out;
    out << scene << ", 513x513 corner rays, depth 5\n"
        << std::left << std::setw(12) << "rays" << std::right << std::setw(10) << "counted" << std::setw(12)
        << "published" << std::setw(13) << "off" << '\n';
    add_line(out, "eye hits", stats.eye_hit, of(&SpdCounts::eye_hits));
    add_line(out, "reflected", stats.reflect, of(&SpdCounts::reflected));
    add_line(out, "refracted", stats.refract, of(&SpdCounts::refracted));
    add_line(out, "shadow", stats.shadow, of(&SpdCounts::shadow));
    return out.str();
}

}  // namespace raysteps
