#include "bench/picture.hpp"

#include "render/encode.hpp"
#include "render/tiles.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"

namespace raysteps::bench {

Image draw(const Scene& scene, RayCounter& rays, const StepOptions& options) {
    const Camera& camera = scene.camera;
    const ViewFrame frame = view_frame(camera);
    const std::unique_ptr<Integrator> integrator = make_integrator(scene, rays, options);
    Image image(camera.width, camera.height);
    for (const Rect& tile : tiles_of({0, 0, camera.width, camera.height})) {
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            for (int x = tile.x; x < tile.x + tile.width; ++x) {
                image.at(x, y) = encode(integrator->primary_color(primary_ray(camera, frame, x, y)), options.step);
            }
        }
    }
    return image;
}

}  // namespace raysteps::bench
