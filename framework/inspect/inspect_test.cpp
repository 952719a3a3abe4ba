// The record tells the truth about a pixel, and leaves the pixel as it is.
#include "core/mesh_triangle.hpp"
#include "inspect/inspect_json.hpp"
#include "inspect/inspect_text.hpp"
#include "inspect/test_scenes.hpp"
#include "render/mesh_detail.hpp"
#include "render/renderer.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

SearchCounts sum_of(const RayNode& node) {
    SearchCounts sum = node.counts;
    for (const LightRecord& light : node.lights) {
        for (const RayNode& ray : light.rays) {
            sum += sum_of(ray);
        }
    }
    for (const RayNode& bounce : node.bounces) {
        sum += sum_of(bounce);
    }
    return sum;
}

/// A structure that forgets one surface.
class Forgetful final : public Accelerator {
public:
    Forgetful(SurfaceList surfaces, std::size_t forgotten) : surfaces_(std::move(surfaces)) {
        surfaces_.erase(surfaces_.begin() + static_cast<std::ptrdiff_t>(forgotten));
    }

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return raysteps::closest_hit(surfaces_, ray);
    }

private:
    SurfaceList surfaces_;
};

}  // namespace

TEST_CASE("A pixel that is inspected has the bytes and the counts of one that is rendered", "[inspect]") {
    const Scene scene = small_scene();
    for (int step = 1; step <= 9; ++step) {
        for (const Acceleration kind :
             {Acceleration::none, Acceleration::boxes, Acceleration::octree, Acceleration::bvh}) {
            RenderOptions options{options_of(step), kind, 1, {}, false};
            const auto accelerator = make_accelerator(kind, scene.surfaces());
            const Image image = render(scene, options).image;
            for (int at = 0; at < 24 * 18; at += 5) {
                const int x = at % 24;
                const int y = at / 24;
                INFO("step " << step << ", structure " << static_cast<int>(kind) << ", pixel " << x << " " << y);
                const PixelRecord record = inspect_pixel(scene, scene.camera, *accelerator, kind, options.step, x, y);
                REQUIRE(record.bytes == image.at(x, y));
                REQUIRE(record.counts.surface_tests == record.stats.surface_tests);
                REQUIRE(record.counts.box_tests == record.stats.box_tests);
                const SearchCounts sum = sum_of(record.eye);
                REQUIRE(sum.surface_tests == record.stats.surface_tests);
                REQUIRE(sum.box_tests == record.stats.box_tests);
                REQUIRE_FALSE(record.eye.lost.has_value());
            }
        }
    }
}

TEST_CASE("A surface that the structure loses is found and named", "[inspect]") {
    const Scene scene = one_mirror();
    const Forgetful structure(scene.surfaces(), 0);
    const PixelRecord record = inspect_pixel(scene, scene.camera, structure, Acceleration::octree, options_of(5), 4, 4);
    REQUIRE(record.eye.lost.has_value());
    CHECK(record.eye.lost->surface == 0);
    CHECK(record.eye.lost->distance == about(4.0));
    CHECK(record.eye.lost->reason == LossReason::not_tested);
    CHECK(inspect_text(record).find("LOST") != std::string::npos);
    CHECK(record.counts.surface_tests == record.stats.surface_tests);
}

TEST_CASE("Boxes have their levels and their lists, and duplicates are told apart", "[inspect]") {
    const Scene scene = one_mirror();
    const PixelRecord record = inspected(scene, Acceleration::boxes, options_of(2), 4, 4);
    const RayNode& eye = record.eye;
    REQUIRE(eye.boxes.size() == eye.counts.box_tests);
    CHECK(eye.boxes[0].level == 0);
    CHECK(eye.boxes[1].level == 1);
    std::uint64_t listed = 0;
    for (const BoxEvent& event : eye.boxes) {
        listed += event.part ? event.listed.value_or(0) : 0;
    }
    CHECK(eye.counts.candidates == listed);
    CHECK(eye.counts.unique_surfaces == eye.counts.surface_tests);
    CHECK(eye.counts.candidates > eye.counts.unique_surfaces);  // the ball is in many boxes
}

TEST_CASE("Many rays and tests are counted, and only some kept", "[inspect]") {
    Scene scene;
    scene.camera.from = {0.0F, 0.0F, 0.0F};
    scene.camera.at = {0.0F, 0.0F, -1.0F};
    scene.camera.width = scene.camera.height = 1;
    scene.lights = {{{1.0F, 1.0F, 0.0F}, k_white}};
    const auto wall = [&](float z) {
        scene.add(std::make_unique<Triangle>(glm::vec3(-90.0F, -90.0F, z), glm::vec3(90.0F, -90.0F, z),
                                             glm::vec3(0.0F, 90.0F, z), k_mirror));
    };
    wall(-2.0F);
    wall(2.0F);
    for (int i = 0; i < 9000; ++i) {
        scene.add(std::make_unique<Sphere>(glm::vec3(50.0F, 0.0F, 50.0F), 0.1F, k_matte));
    }
    const PixelRecord record = inspected(scene, Acceleration::none, options_of(5, 200), 0, 0);
    CHECK(record.stats.reflect == 199);
    CHECK(record.counts.surface_tests == record.stats.surface_tests);
    CHECK(record.left_out.rays > 0);
    CHECK(record.left_out.tests > 1'000'000);
    CHECK(record.eye.color == record.color);
    CHECK(inspect_json(record).size() < 8'000'000);
    CHECK(inspect_text(record).find("left out") != std::string::npos);
}

TEST_CASE("The text tells the whole life", "[inspect]") {
    const Scene scene = small_scene();
    PixelRecord record = inspected(scene, Acceleration::octree, options_of(8), 7, 9);
    record.scene = "small.nff";
    const std::string text = inspect_text(record);
    for (const char* words : {"pixel (7, 9) of 24x18, small.nff, step 8", "eye ray", "surface 2 (sphere)", "light 2",
                              "reflected ray, depth 2", "tone mapping", "bytes"}) {
        INFO(words);
        CHECK(text.find(words) != std::string::npos);
    }
}

TEST_CASE("A hit of a mesh is that of its triangle, whatever step 11 makes of it", "[inspect]") {
    const glm::vec3 lean = glm::normalize(glm::vec3(0.3F, 0.2F, 1.0F));
    const MeshFace face{MeshCorner{{-2.0F, -2.0F, 0.0F}, lean}, MeshCorner{{2.0F, -2.0F, 0.0F}, lean},
                        MeshCorner{{0.0F, 3.0F, 0.0F}, lean}};
    Scene scene;
    scene.camera.width = scene.camera.height = 9;
    scene.lights = {{{0.0F, 0.0F, 9.0F}, k_white}};
    scene.add(std::make_unique<MeshTriangle>(face, k_matte, nullptr));
    const auto details = with_mesh_details(make_accelerator(Acceleration::none, scene.surfaces()), scene, 11);
    const PixelRecord record = inspect_pixel(scene, scene.camera, *details, Acceleration::none, options_of(11), 4, 4);
    REQUIRE(record.eye.hit.has_value());
    CHECK(record.eye.hit->surface == std::size_t{0});
    CHECK_THAT(record.eye.hit->hit.normal, IsNear(lean));
}

TEST_CASE("metal and glass are named", "[inspect]") {
    const auto text_of = [](const Fill& fill) {
        Scene scene;
        scene.camera = {.from = {0, 0, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .width = 3, .height = 3};
        scene.add(std::make_unique<Sphere>(glm::vec3(0), 1.0F, fill));
        const auto accelerator = make_accelerator(Acceleration::none, scene.surfaces());
        return inspect_text(inspect_pixel(scene, scene.camera, *accelerator, Acceleration::none, options_of(14), 1, 1));
    };
    Fill fill{.index_of_refraction = 1.5F, .scattering = Scattering::glass};
    CHECK(text_of(fill).find("shine 1  glass of index 1.5\n") != std::string::npos);
    fill.roughness = 0.25F;
    CHECK(text_of(fill).find("glass of index 1.5  roughness 0.25\n") != std::string::npos);
    fill.scattering = Scattering::metal;
    CHECK(text_of(fill).find("  metal  roughness 0.25\n") != std::string::npos);
    CHECK(text_of({.scattering = Scattering::mirror}).find("  polished metal\n") != std::string::npos);
}

TEST_CASE("a lamp with a size is told by the sum of what it brings", "[inspect]") {
    Scene scene;
    scene.camera = {.from = {0, 0, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .width = 3, .height = 3};
    Fill shining{.color = k_black};
    shining.emission = {2.0F, 3.0F, 4.0F};
    scene.add(std::make_unique<Sphere>(glm::vec3(0), 1.0F, shining));
    scene.area_lights.push_back({SphereLight{{0, 0, 0}, 1.0F}, shining.emission});
    const auto accelerator = make_accelerator(Acceleration::none, scene.surfaces());
    const PixelRecord record =
        inspect_pixel(scene, scene.camera, *accelerator, Acceleration::none, options_of(12), 1, 1);
    const std::string text = inspect_text(record);
    CHECK(text.find("(2, 3, 4)  one sample of each") != std::string::npos);
}

TEST_CASE("what is told of a path adds up to its light", "[inspect]") {
    Scene scene = small_scene();
    scene.background = {0.3F, 0.4F, 0.5F};
    Fill shining{.color = k_black};
    shining.emission = {9.0F, 8.0F, 7.0F};
    scene.add(std::make_unique<Sphere>(glm::vec3(0.0F, 1.5F, 1.0F), 0.5F, shining));
    scene.area_lights.push_back({SphereLight{{0.0F, 1.5F, 1.0F}, 0.5F}, shining.emission});
    const auto accelerator = make_accelerator(Acceleration::none, scene.surfaces());
    int short_paths = 0;
    int lamps = 0;
    for (int at = 0; at < 24 * 18; ++at) {
        const PixelRecord record =
            inspect_pixel(scene, scene.camera, *accelerator, Acceleration::none, options_of(13), at % 24, at / 24);
        Color light = k_black;
        Color weight = k_white;
        int bounces = 0;
        for (const RayNode* node = &record.eye; node != nullptr; ++bounces) {
            if (!node->hit) {
                light += weight * scene.background;
                break;
            }
            REQUIRE(node->path.has_value());
            if (bounces == 0 && node->hit->hit.front_face) {
                light += weight * node->hit->hit.fill.emission;
                lamps += node->hit->hit.fill.emission == k_black ? 0 : 1;
            }
            light += weight * node->path->lamps.value_or(k_black);
            weight *= node->path->scatter ? node->path->scatter->weight : k_black;
            node = node->bounces.empty() ? nullptr : &node->bounces.back();
        }
        if (bounces <= 3) {  // roulette was not played
            CAPTURE(at);
            CHECK_THAT(*record.color, IsNear(light, 1e-4F));
            ++short_paths;
        }
    }
    CHECK(short_paths > 100);
    CHECK(lamps > 0);
}

TEST_CASE("the paths of a pixel that are inspected one by one are those of its picture", "[inspect]") {
    Scene scene = small_scene();
    scene.background = {0.3F, 0.4F, 0.5F};
    scene.camera.lens_radius = 0.2F;
    scene.camera.focal_distance = 5.0F;
    const auto accelerator = make_accelerator(Acceleration::none, scene.surfaces());
    for (const int step : {10, 13}) {
        RenderOptions options{options_of(step), Acceleration::none, 1, {}, false};
        options.sample_side = 2;
        const Rendering rendering = render(scene, options);
        for (int at = 0; at < 24 * 18; at += 7) {
            const int x = at % 24;
            const int y = at / 24;
            INFO("step " << step << ", pixel " << x << " " << y);
            Color sum = k_black;
            for (int sample = 1; sample <= 4; ++sample) {
                const PixelRecord record =
                    inspect_pixel(scene, scene.camera, *accelerator, Acceleration::none, options.step, x, y, sample);
                REQUIRE(record.color.has_value());
                sum += *record.color / 4.0F;
            }
            CHECK_THAT(rendering.estimates.at(x, y).mean, IsNear(sum, 1e-5F));
        }
    }
    const PixelRecord record =
        inspect_pixel(scene, scene.camera, *accelerator, Acceleration::none, options_of(13), 12, 16, 3);
    CHECK(inspect_text(record).starts_with("pixel (12, 16) of 24x18, step 13, sample 3\n"));
    CHECK(inspect_json(record).find("\"sample\": 3") != std::string::npos);
}

TEST_CASE("a path is told hit by hit", "[inspect]") {
    const PixelRecord record = inspected(small_scene(), Acceleration::none, options_of(13), 12, 16);
    const std::string text = inspect_text(record);
    INFO(text);
    CHECK(text.find("  lamps       (") != std::string::npos);
    CHECK(text.find("by one sample of each, times the weight (1, 1, 1)") != std::string::npos);
    CHECK(text.find("weight of the path behind it (0.72, 0.63, 0.18), before roulette") != std::string::npos);
    CHECK(text.find("x ks") == std::string::npos);
    CHECK(text.find("not kept") == std::string::npos);
}

TEST_CASE("a path that goes through glass is told as refracted", "[inspect]") {
    Scene scene;
    scene.camera = {.from = {0, 0, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .width = 3, .height = 3};
    Fill glass{.index_of_refraction = 1.5F, .scattering = Scattering::glass};
    scene.add(std::make_unique<Sphere>(glm::vec3(0), 1.0F, glass));
    const PixelRecord record = inspected(scene, Acceleration::none, options_of(14), 1, 1);
    REQUIRE(record.eye.path.has_value());
    REQUIRE(record.eye.path->scatter.has_value());
    const bool goes_through = record.eye.path->scatter->direction.z < 0.0F;
    REQUIRE(record.eye.bounces.size() == 1);
    CHECK(record.eye.bounces.front().role == (goes_through ? RayRole::refract : RayRole::reflect));
    CHECK(record.stats.refract + record.stats.reflect > 0);
}
