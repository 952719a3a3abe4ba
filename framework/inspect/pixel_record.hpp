#pragma once
// The life of one pixel: every ray that was sent for it, what each was tested against, and what light it brought.
#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "core/area_light.hpp"
#include "core/box.hpp"
#include "core/camera.hpp"
#include "core/image.hpp"
#include "core/light.hpp"
#include "core/light_sample.hpp"
#include "core/stats.hpp"
#include "inspect/hit_trace.hpp"
#include "render/integrator.hpp"

namespace raysteps {

/// Why a ray was sent. `internal`: glass that mirrors from within, total internal reflection.
enum class RayRole { eye, shadow, reflect, refract, internal };

/// One box that was asked, in the order of asking.
struct BoxEvent {
    Box box;
    std::optional<Interval> part;         ///< nothing: the ray misses the box
    std::optional<int> level;             ///< 0: the root; nothing where the structure does not know the box
    std::optional<std::uint64_t> listed;  ///< surfaces in the box's own list
};

/// One surface that was asked.
struct SurfaceEvent {
    std::size_t surface = 0;         ///< Surface::order()
    std::optional<float> distance;   ///< nothing: the ray misses it
    std::uint64_t boxes_before = 0;  ///< box tests of the same ray that came earlier
};

/// What one ray cost. Exact, however many events are kept.
struct SearchCounts {
    std::uint64_t box_tests = 0;
    std::uint64_t boxes_entered = 0;
    std::uint64_t candidates = 0;  ///< entries in the lists of the boxes entered, duplicates counted
    std::uint64_t surface_tests = 0;
    std::uint64_t unique_surfaces = 0;  ///< different ones among those tested

    SearchCounts& operator+=(const SearchCounts& other);
};

struct LightRecord;
struct LampRecord;

/// What happened at a hit of a path, from step 13 on.
struct PathStep {
    std::optional<Color> lamps;            ///< what one sample of each lamp brought; nothing: nobody asked
    std::optional<ScatterSample> scatter;  ///< nothing: the path ends there
};

/// One ray and everything that followed from it.
struct RayNode {
    RayRole role = RayRole::eye;
    int depth = 1;
    Ray ray;
    std::optional<float> limit;  ///< only hits nearer than this were asked for
    SearchCounts counts;
    std::optional<bool> any;  ///< the answer, where the ray asked no more than whether anything is hit
    std::vector<BoxEvent> boxes;
    std::vector<SurfaceEvent> tests;
    std::optional<HitTrace> hit;  ///< of any hit: the surface that ended the search
    std::optional<LostHit> lost;  ///< where a search through all surfaces finds something else
    std::vector<LightRecord> lights;
    std::vector<LampRecord> lamps;     ///< in the order in which they were sampled
    std::uint64_t lamps_beyond = 0;    ///< further samples, which were not kept
    std::optional<Color> direct;       ///< step 03's sum over the lights that reach the hit
    std::optional<Color> transmitted;  ///< what shines through, weighed with the transmittance
    std::optional<PathStep> path;      ///< nothing where no path has a hit
    std::optional<Color> local;        ///< all that the surface itself sends along the ray
    std::list<RayNode> bounces;
    std::optional<Color> color;    ///< nothing for a shadow ray, and where nobody saw it
    bool followed_within = false;  ///< by step 05 itself and not through trace, so that nobody saw what it brought
};

/// What step 04 answered of a place that shines, at a hit.
struct ShadowRecord {
    bool lit = true;
    std::list<RayNode> rays;  ///< shadow rays; none before step 04
};

/// One light, seen from a hit.
struct LightRecord : ShadowRecord {
    std::size_t light = 0;
    std::optional<Ray> shadow_ray;  ///< step 04's own answer, which is_lit need not have used
    glm::vec3 to_light{0.0F};
    glm::vec3 mirrored{0.0F};  ///< the light's direction of travel, mirrored
    float l_n = 0.0F;
    float r_v = 0.0F;
    Color diffuse = k_black;
    Color specular = k_black;
};

/// One sample of an area light, seen from a hit. Step 04 is not asked of one that is black unshadowed.
struct LampRecord : ShadowRecord {
    std::size_t lamp = 0;  ///< of the scene's area lights
    AreaLight light;
    LightSample sample;
    Color unshadowed = k_black;        ///< what it brings to the hit where nothing stands between
    std::optional<float> scatter_pdf;  ///< as step 15 was told it; nothing where it was not
    std::optional<float> weight;       ///< step 15's power heuristic of both densities

    [[nodiscard]] bool is_dark() const { return !(unshadowed.r > 0.0F || unshadowed.g > 0.0F || unshadowed.b > 0.0F); }
    [[nodiscard]] Color brought() const { return lit ? weight.value_or(1.0F) * unshadowed : k_black; }
};

/// What was counted but not kept.
struct LeftOut {
    std::uint64_t rays = 0;
    std::uint64_t boxes = 0;
    std::uint64_t tests = 0;

    [[nodiscard]] bool any() const { return rays + boxes + tests > 0; }
};

struct PixelRecord {
    std::string scene;  ///< as it was named
    StepOptions options;
    Acceleration acceleration = Acceleration::none;
    Camera camera;
    ViewFrame frame;
    Color background = k_black;
    std::vector<Light> lights;
    std::size_t area_lights = 0;  ///< that are sampled
    AcceleratorStats structure;
    std::uint64_t surfaces = 0;  ///< in the scene
    int x = 0;
    int y = 0;
    std::optional<int> sample;  ///< of those of the pixel, from 1 on; nothing: the ray through its middle
    RayNode eye;
    bool endless = false;         ///< the rays went on far beyond the greatest depth, and were stopped
    std::optional<Color> color;   ///< of the pixel, before tone mapping
    std::optional<Color> mapped;  ///< as it is shown, from step 07 on
    Rgb8 bytes;
    Stats stats;
    SearchCounts counts;  ///< of all rays; unique_surfaces: different ones in the whole pixel
    LeftOut left_out;
    std::vector<SurfaceInfo> near;  ///< those that were hit, those that were tested, then others, up to a limit
};

}  // namespace raysteps
