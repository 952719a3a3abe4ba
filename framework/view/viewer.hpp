#pragma once
// The window's life: shows what is known of the picture, and does what the person asks for.
#include <optional>
#include <string>

#include "view/controls.hpp"

namespace raysteps {

struct ViewerOptions {
    std::string scene;  ///< as it was typed
    StepOptions step;
    int last_step = 9;  ///< of the kit
    std::optional<Acceleration> acceleration;
    int threads = 1;
    std::string screenshot;      ///< empty: stays open; else the complete picture is read back, written, and that is it
    bool strip = false;          ///< whether the status bar is written with it
    std::optional<Pixel> click;  ///< as if it was clicked once the picture is complete
};

/// Until the window is closed. The scene's camera is where it starts. Throws WindowError.
void run_viewer(const Scene& scene, const ViewerOptions& options);

}  // namespace raysteps
