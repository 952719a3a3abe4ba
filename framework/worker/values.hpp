#pragma once
// The kit's values as numbers on a line. The judge's values.py writes and reads the same order.
#include <optional>
#include <vector>

#include "core/box.hpp"
#include "core/camera.hpp"
#include "core/hit_record.hpp"
#include "core/light.hpp"
#include "worker/tokens.hpp"

namespace raysteps {

[[nodiscard]] Ray read_ray(Words& words);           ///< origin, direction
[[nodiscard]] Camera read_camera(Words& words);     ///< from, at, up, angle, width, height
[[nodiscard]] ViewFrame read_frame(Words& words);   ///< right, up, forward, half width, half height
[[nodiscard]] Fill read_fill(Words& words);         ///< colour, kd, ks, shine, transmittance, index
[[nodiscard]] Light read_light(Words& words);       ///< position, colour
[[nodiscard]] HitRecord read_hit(Words& words);     ///< position, fill, normal, ray direction, distance, from outside
[[nodiscard]] Box read_box(Words& words);           ///< min, max
[[nodiscard]] std::vector<Light> read_lights(Words& words);  ///< how many, then each

void write_ray(Answer& answer, const Ray& ray);
void write_frame(Answer& answer, const ViewFrame& frame);
void write_hit(Answer& answer, const std::optional<HitRecord>& hit);  ///< `miss`, or `hit` and the record
void write_box(Answer& answer, const Box& box);

}  // namespace raysteps
