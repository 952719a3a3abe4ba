// The live figures of the handouts: the reader's numbers go to the functions of the steps, what these say comes back as
// JSON. Nothing is computed here that a step computes.
#include "figures.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "figure_list.hpp"
#include "io/command_line.hpp"

namespace raysteps {
namespace {

struct Figure {
    std::string_view name;
    void (*answer)(Numbers numbers, JsonWriter& json);
};

constexpr std::array k_figures{
    Figure{"camera", camera_figure},   Figure{"sphere", sphere_figure},   Figure{"triangle", triangle_figure},
    Figure{"phong", phong_figure},     Figure{"shadow", shadow_figure},   Figure{"mirrors", mirrors_figure},
    Figure{"octree", octree_figure},   Figure{"tone", tone_figure},       Figure{"glass", glass_figure},
    Figure{"cuts", cuts_figure},       Figure{"samples", samples_figure}, Figure{"filter", filter_figure},
    Figure{"mesh", mesh_figure},       Figure{"level", level_figure},     Figure{"lamp", lamp_figure},
    Figure{"lens", lens_figure},       Figure{"cosine", cosine_figure},   Figure{"roulette", roulette_figure},
    Figure{"fresnel", fresnel_figure}, Figure{"metal", metal_figure},     Figure{"weights", weights_figure},
    Figure{"ways", ways_figure},
};

void answer(std::span<char*> words, JsonWriter& json) {
    const std::string_view name = words.size() < 2 ? "" : words[1];
    const auto found =
        std::find_if(k_figures.begin(), k_figures.end(), [name](const Figure& figure) { return figure.name == name; });
    if (found == k_figures.end()) {
        throw UsageError("expected the name of a figure");
    }
    found->answer(Numbers(words.subspan(2)), json);
}

}  // namespace

int figure_main(int argc, char** argv) {
    const std::span<char*> words(argv, static_cast<std::size_t>(argc));
    return run_program("play", [&words] {
        JsonWriter json;
        json.begin_object();
        answer(words, json);
        json.end_object();
        std::printf("\n%s\n", json.result().c_str());  // in a line of its own, whatever the student prints
    });
}

}  // namespace raysteps
