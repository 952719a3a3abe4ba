// Step 07: the tone curve.
#include "figure_list.hpp"
#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace raysteps {
namespace {

constexpr int k_samples = 81;  // of the curve

void bytes(const Color& color, JsonWriter& json) {
    json.begin_array();
    for (const float channel : {color.r, color.g, color.b}) {
        json.whole(to_byte(channel));
    }
    json.end_array();
}

}  // namespace

/// The greatest light of the curve, the exposure, and the light of red, green and blue before it.
void tone_figure(Numbers numbers, JsonWriter& json) {
    const float brightest = numbers.next();
    const float exposure = numbers.next();
    Color light;
    light.r = exposure * numbers.next();
    light.g = exposure * numbers.next();
    light.b = exposure * numbers.next();
    const Color shown = tone_map(light);
    json.key("light").vector(light).key("shown").vector(shown);
    json.key("bytes");
    bytes(shown, json);
    json.key("cutOff");
    bytes(light, json);
    json.key("curve").begin_array();
    for (int sample = 0; sample < k_samples; ++sample) {
        const float at = brightest * static_cast<float>(sample) / static_cast<float>(k_samples - 1);
        json.number(tone_map(Color(exposure * at)).r);
    }
    json.end_array();
}

}  // namespace raysteps
