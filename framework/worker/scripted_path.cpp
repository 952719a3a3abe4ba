#include "worker/scripted_path.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/frame.hpp"

namespace raysteps {
namespace {

constexpr float k_pi = std::numbers::pi_v<float>;
constexpr std::size_t k_endless = 300;  // rays, then there is nothing more to meet
constexpr float k_beside = 0.02F;       // of a place that is meant

/// Distance, normal, emission, front face.
ScriptedPathHit read_surface(TokenReader& words) {
    ScriptedPathHit hit;
    hit.distance = words.number();
    hit.normal = words.vector();
    hit.emission = words.vector();
    hit.front_face = words.flag();
    return hit;
}

ScriptedPathHit read_path_hit(TokenReader& words) {
    ScriptedPathHit hit = read_surface(words);
    hit.light = words.vector();
    if (words.flag()) {
        hit.sample = read_scatter(words);
        // Behind the first hit as high as that of rough metal: only the flag tells what is specular.
        hit.sample->pdf = hit.sample->specular ? 1.0F : hit.distance > 2.0F ? hit.distance : 0.0F;
    }
    return hit;
}

ScriptedPathHit read_mis_hit(TokenReader& words) {
    ScriptedPathHit hit = read_surface(words);
    hit.light_pdf = words.number();
    hit.samples = read_samples(words);
    if (words.flag()) {
        hit.sample = read_scatter(words);
        hit.sample->pdf = words.number();
    }
    hit.exponent = words.number();
    for (int left = words.count(); left > 0; --left) {
        ScriptedLamp lamp;
        lamp.low = words.number();
        lamp.high = words.number();
        lamp.radiance = words.vector();
        hit.lamps.push_back(lamp);
    }
    return hit;
}

template <typename ReadHit>
PathScript read_hits(TokenReader& words, const ReadHit& read_hit) {
    PathScript script;
    script.background = words.vector();
    script.goes_on = words.flag();
    for (int left = words.count(); left > 0; --left) {
        script.hits.push_back(read_hit(words));
    }
    return script;
}

/// Around the normal, with that cosine.
glm::vec3 direction_at(const glm::vec3& normal, float cosine, float turn) {
    const float sine = std::sqrt(std::max(0.0F, 1.0F - cosine * cosine));
    const float angle = 2.0F * k_pi * turn;
    return Frame::around(normal).to_world({sine * std::cos(angle), sine * std::sin(angle), cosine});
}

/// The density of a plate's directions.
float plate_pdf(float exponent, float cosine) {
    return (exponent + 1.0F) / (2.0F * k_pi) * std::pow(std::max(0.0F, cosine), exponent);
}

}  // namespace

float ScriptedLamp::pdf() const { return 1.0F / (2.0F * k_pi * (high - low)); }

ScatterSample read_scatter(TokenReader& words) {
    ScatterSample sample;
    sample.direction = words.vector();
    sample.weight = words.vector();
    sample.specular = words.flag();
    return sample;
}

std::vector<DirectSample> read_samples(TokenReader& words) {
    std::vector<DirectSample> samples;
    for (int left = words.count(); left > 0; --left) {
        DirectSample sample;
        sample.light = words.vector();
        sample.pdf = words.number();
        sample.scatter_pdf = words.number();
        samples.push_back(sample);
    }
    return samples;
}

PathScript read_path_script(TokenReader& words) { return read_hits(words, read_path_hit); }

PathScript read_mis_script(TokenReader& words) { return read_hits(words, read_mis_hit); }

std::optional<HitRecord> ScriptedPath::closest_hit(const Ray& ray) const {
    const std::size_t number = cast_.size();
    cast_.push_back(ray);
    HitRecord hit;
    hit.ray_direction = ray.direction;
    if (number > 0 && !met_.empty()) {  // a lamp of the plate that the ray comes from
        const std::vector<ScriptedLamp>& lamps = at(met_.back()).lamps;
        const float cosine = glm::dot(met_.back().normal, ray.direction);
        for (const ScriptedLamp& lamp : lamps) {
            if (cosine > lamp.low && cosine <= lamp.high) {
                hit.normal = -ray.direction;
                hit.position = ray.origin + ray.direction;
                hit.distance = 1.0F;  // all others are farther
                hit.fill.emission = lamp.radiance;
                hit.fill.light = static_cast<std::uint32_t>(&lamp - lamps.data() + 1);
                return hit;
            }
        }
    }
    if (script_.hits.empty() || number >= k_endless || (number >= script_.hits.size() && !script_.goes_on)) {
        return std::nullopt;
    }
    const ScriptedPathHit& scripted = script_.hits[std::min(number, script_.hits.size() - 1)];
    hit.position = ray.origin + scripted.distance * ray.direction;
    hit.normal = glm::dot(scripted.normal, ray.direction) <= 0.0F ? scripted.normal : -scripted.normal;
    hit.distance = scripted.distance;
    hit.fill.emission = scripted.emission;
    hit.front_face = scripted.front_face;
    met_.push_back(hit);
    return hit;
}

/// Draws those of a plate's lamps.
std::vector<DirectSample> ScriptedPath::samples_at(const HitRecord& hit) {
    const ScriptedPathHit& scripted = at(hit);
    std::vector<DirectSample> samples = scripted.samples;
    for (const ScriptedLamp& lamp : scripted.lamps) {
        const float cosine = lamp.low + (lamp.high - lamp.low) * random_.next();
        const float scatter_pdf = plate_pdf(scripted.exponent, cosine);
        const Color light = lamp.radiance * scripted.sample->weight * (scatter_pdf / lamp.pdf());
        samples.push_back({.light = light, .pdf = lamp.pdf(), .scatter_pdf = scatter_pdf});
    }
    asked_ += std::max(1, static_cast<int>(samples.size()));
    return samples;
}

Color ScriptedPath::light_sample(const HitRecord& hit) {
    Color light = at(hit).light;
    for (const DirectSample& sample : samples_at(hit)) {
        light += sample.light;
    }
    return light;
}

std::vector<DirectSample> ScriptedPath::direct_samples(const HitRecord& hit) { return samples_at(hit); }

/// Who asks for another place than that of the hit before gets another density.
float ScriptedPath::light_pdf(const glm::vec3& from, const HitRecord& hit) const {
    const bool is_lamp = hit.fill.light > 0;  // of a plate, the last hit of the script
    const std::size_t before = is_lamp ? 1 : 2;
    if (met_.size() < before) {
        return at(hit).light_pdf;
    }
    const HitRecord& last = met_[met_.size() - before];
    const float pdf = is_lamp ? at(last).lamps.at(hit.fill.light - 1).pdf() : at(hit).light_pdf;
    return glm::distance(from, last.position) < k_beside ? pdf : 3.0F * pdf + 1.0F;
}

/// The direction is turned to the side of the normal. Who asks twice gets another one.
std::optional<ScatterSample> ScriptedPath::scatter(const HitRecord& hit) {
    const ScriptedPathHit& scripted = at(hit);
    std::optional<ScatterSample> sample = scripted.sample;
    if (!sample) {
        return sample;
    }
    ++scattered_;
    if (scripted.exponent > 0.0F) {
        const float cosine = std::pow(1.0F - random_.next(), 1.0F / (scripted.exponent + 1.0F));
        sample->direction = direction_at(hit.normal, cosine, random_.next());
        sample->pdf = plate_pdf(scripted.exponent, cosine);
        return sample;
    }
    const float along = glm::dot(sample->direction, hit.normal);
    sample->direction *= along < 0.0F ? -1.0F : 1.0F;
    if (scattered_ > cast_.size()) {
        sample->direction = 2.0F * std::abs(along) * hit.normal - sample->direction;
    }
    if (!(sample->pdf > 0.0F)) {
        sample->pdf = glm::dot(hit.normal, sample->direction) / k_pi;
    }
    return sample;
}

const ScriptedPathHit& ScriptedPath::at(const HitRecord& hit) const {
    static const ScriptedPathHit nothing;
    const auto found = std::ranges::find(script_.hits, hit.distance, &ScriptedPathHit::distance);
    return found == script_.hits.end() ? nothing : *found;
}

}  // namespace raysteps
