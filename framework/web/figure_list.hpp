#pragma once
// What each live figure asks of the steps: a function that reads the reader's numbers and writes what the steps say.
#include <cstdlib>
#include <span>

#include "io/json_writer.hpp"

namespace raysteps {

/// What the page sends, one after the other.
class Numbers {
public:
    explicit Numbers(std::span<char*> words) : words_(words) {}

    [[nodiscard]] float next() {
        const float value = words_.empty() ? 0.0F : std::strtof(words_.front(), nullptr);
        words_ = words_.subspan(words_.empty() ? 0 : 1);
        return value;
    }

    [[nodiscard]] int whole() { return static_cast<int>(next()); }

private:
    std::span<char*> words_;
};

// Steps 01 and 02.
void camera_figure(Numbers numbers, JsonWriter& json);
void sphere_figure(Numbers numbers, JsonWriter& json);
void triangle_figure(Numbers numbers, JsonWriter& json);

// Steps 03 to 06.
void phong_figure(Numbers numbers, JsonWriter& json);
void shadow_figure(Numbers numbers, JsonWriter& json);
void mirrors_figure(Numbers numbers, JsonWriter& json);
void octree_figure(Numbers numbers, JsonWriter& json);

// Steps 07 to 09.
void tone_figure(Numbers numbers, JsonWriter& json);
void glass_figure(Numbers numbers, JsonWriter& json);
void cuts_figure(Numbers numbers, JsonWriter& json);

// Steps 10 to 12.
void samples_figure(Numbers numbers, JsonWriter& json);
void filter_figure(Numbers numbers, JsonWriter& json);
void mesh_figure(Numbers numbers, JsonWriter& json);
void level_figure(Numbers numbers, JsonWriter& json);
void lamp_figure(Numbers numbers, JsonWriter& json);
void lens_figure(Numbers numbers, JsonWriter& json);

// Steps 13 to 15.
void cosine_figure(Numbers numbers, JsonWriter& json);
void roulette_figure(Numbers numbers, JsonWriter& json);
void fresnel_figure(Numbers numbers, JsonWriter& json);
void metal_figure(Numbers numbers, JsonWriter& json);
void weights_figure(Numbers numbers, JsonWriter& json);
void ways_figure(Numbers numbers, JsonWriter& json);

}  // namespace raysteps
