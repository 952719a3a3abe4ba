#pragma once
// What keys and mouse do. Knows nothing of windows: places are in window pixels, keys are characters.
#include <optional>
#include <vector>

#include "render/pixel_cost.hpp"
#include "view/layout.hpp"
#include "view/progressive_renderer.hpp"

namespace raysteps {

/// Everything that a person can set.
struct Settings {
    Camera camera;
    StepOptions step;
    std::optional<Acceleration> acceleration;  ///< nothing: what the step comes with
    std::optional<CostKind> map;               ///< nothing: the picture
    float stops = 0.0F;                        ///< exposure, for step 07 and later
    int last_step = 9;                         ///< of the kit; keys beyond it do nothing
};

enum class Button { left, other };

struct Pixel {
    int x = 0;
    int y = 0;
};

class Controls {
public:
    explicit Controls(const Settings& start) : home_(start.camera), settings_(start) {}

    void set_layout(const Layout& layout) { layout_ = layout; }

    void key(char character);
    void press(const Point& place, Button button, bool shift);
    void move(const Point& place);
    void release(const Point& place);
    void wheel(float notches);

    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] RenderRequest request() const;
    [[nodiscard]] bool camera_moved() const;

    /// What happened since it was last asked for.
    struct Events {
        bool new_request = false;  ///< another picture must be traced
        bool new_look = false;     ///< the picture is the same, and shown in another way
        bool save = false;
        bool quit = false;
        std::optional<Pixel> click;
    };
    [[nodiscard]] Events take_events();

private:
    enum class Drag { none, undecided, orbit, pan, slider };

    void choose_step(int step);
    void next_acceleration();
    void next_map();
    void expose(float stops);
    void set_camera(const Camera& camera);
    void slide_to(const Point& place);
    [[nodiscard]] bool has_slider() const { return settings_.step.step >= 7 && !settings_.map; }

    Camera home_;
    Settings settings_;
    Layout layout_;
    Events events_;
    Drag drag_ = Drag::none;
    Point pressed_;
    Point last_;
};

}  // namespace raysteps
