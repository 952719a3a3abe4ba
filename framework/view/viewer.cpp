#include "view/viewer.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "io/files.hpp"
#include "io/picture_file.hpp"
#include "render/accelerator_registry.hpp"
#include "view/async_inspector.hpp"
#include "view/content.hpp"
#include "view/window.hpp"

namespace raysteps {
namespace {

constexpr double k_frame_seconds = 1.0 / 30.0;  // while something is going on
constexpr double k_idle_seconds = 0.2;
constexpr std::chrono::milliseconds k_stop_timeout{1000};  // with a step that does not end, when the window closes

void say(const std::string& text) {
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
}

/// A name in the current folder that is free: three-spheres-1.ppm
std::filesystem::path free_name(const std::string& scene) {
    const std::string stem = display_name(path_of(scene).stem());
    for (int number = 1;; ++number) {
        std::filesystem::path name = path_of(stem + "-" + std::to_string(number) + ".ppm");
        if (!std::filesystem::exists(name)) {
            return name;
        }
    }
}

class Viewer {
public:
    Viewer(const Scene& scene, const ViewerOptions& options)
        : options_(options),
          accelerators_(scene),
          renderer_(scene, accelerators_, options.threads),
          inspector_(scene, accelerators_, options.scene),
          controls_({.camera = scene.camera,
                     .step = options.step,
                     .acceleration = options.acceleration,
                     .map = std::nullopt,
                     .stops = 0.0F,
                     .last_step = options.last_step}),
          window_(name(), scene.camera.width, content_height(scene.camera), !options.screenshot.empty(), events()) {}

    void run() {
        renderer_.start(controls_.request());
        while (!window_.is_closing() && !done_) {
            controls_.set_layout(window_.layout());
            window_.wait(is_idle() ? k_idle_seconds : k_frame_seconds);
            handle(controls_.take_events());
            refresh();
            print_answer();
        }
        leave();
    }

private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] std::string name() const { return display_name(path_of(options_.scene).filename()); }

    WindowEvents events() {
        return {
            .key = [this](char character) { controls_.key(character); },
            .press = [this](const Point& place, Button button, bool shift) { controls_.press(place, button, shift); },
            .move = [this](const Point& place) { controls_.move(place); },
            .release = [this](const Point& place) { controls_.release(place); },
            .wheel = [this](float notches) { controls_.wheel(notches); }};
    }

    [[nodiscard]] bool is_idle() const {
        const RenderStatus status = renderer_.status();
        const bool at_rest = status.finished || !status.problem.empty();
        return at_rest && status.version == shown_ && !redraw_ && inspector_.is_idle();
    }

    void handle(const Controls::Events& events) {
        if (events.new_request) {
            renderer_.start(controls_.request());
        }
        redraw_ = redraw_ || events.new_look;
        if (events.click) {
            inspector_.ask(controls_.request(), *events.click, controls_.camera_moved());
        }
        if (events.save) {
            save();
        }
        done_ = done_ || events.quit;
    }

    /// Shows what is new.
    void refresh() {
        const RenderStatus status = renderer_.status();
        redraw_ = window_.take_damage() || redraw_;
        const Clock::time_point begun = Clock::now();
        if ((status.version == shown_ && !redraw_) || begun < earliest_) {
            return;
        }
        shown_ = status.version;
        redraw_ = false;
        const std::string text = status_of(status);
        copy_what_is_shown();
        const Image image = content(frame_, controls_.settings(), text);
        window_.set_title(name() + ", " + text);
        if (status.finished && !completed_) {
            completed_ = true;
            complete(image);
        } else {
            window_.show(image);
        }
        report(status.problem);
        const Clock::time_point ended = Clock::now();
        earliest_ = ended + (ended - begun);
    }

    void report(const std::string& problem) {
        if (!problem.empty() && !options_.screenshot.empty()) {
            throw std::runtime_error("this picture cannot be made: " + problem);
        }
        if (!problem.empty() && problem != problem_) {
            std::fprintf(stderr, "raysteps view: this picture cannot be made: %s\n", problem.c_str());
        }
        problem_ = problem;
    }

    void copy_what_is_shown() {
        if (controls_.settings().map) {
            renderer_.copy_costs(frame_);
        } else {
            renderer_.copy_colors(frame_);
        }
    }

    [[nodiscard]] std::string status_of(const RenderStatus& status) const {
        const RenderRequest request = controls_.request();
        const std::string made = status.problem.empty()
                                     ? std::to_string(std::lround(std::floor(100.0 * status.share))) + "%"
                                     : "failed, see the terminal";
        return "step " + std::to_string(request.step.step) + "  " +
               std::string(accelerator_entry(request.acceleration).name) + "  " + made;
    }

    /// Once, when the first picture is complete.
    void complete(const Image& image) {
        if (options_.click) {
            inspector_.ask(controls_.request(), *options_.click, controls_.camera_moved());
        }
        if (options_.screenshot.empty()) {
            window_.show(image);
            return;
        }
        const Image read = window_.show_and_read(image);
        write_picture(options_.strip ? read : without_status_bar(read, controls_.settings().camera),
                      path_of(options_.screenshot));
        while (!inspector_.idle_within(k_stop_timeout)) {
        }
        print_answer();
        done_ = true;
    }

    void save() {
        try {
            const std::filesystem::path path = free_name(options_.scene);
            copy_what_is_shown();
            const Image image = content(frame_, controls_.settings(), "");
            const bool map = controls_.settings().map.has_value();
            write_picture(map ? image : without_status_bar(image, controls_.settings().camera), path);
            say("saved " + display_name(path) + "\n");
        } catch (const std::exception& error) {
            std::fprintf(stderr, "raysteps view: %s\n", error.what());
        }
    }

    void print_answer() {
        if (const std::optional<std::string> text = inspector_.answer()) {
            say(*text);
        }
    }

    void leave() {
        if (!renderer_.stop(k_stop_timeout) || !inspector_.idle_within(k_stop_timeout)) {
            std::fputs("raysteps view: a step did not come to an end, and was left\n", stderr);
            std::_Exit(0);  // a thread that hangs cannot be joined
        }
    }

    ViewerOptions options_;
    AcceleratorCache accelerators_;
    ProgressiveRenderer renderer_;
    AsyncInspector inspector_;
    Controls controls_;
    Window window_;
    RenderedFrame frame_;
    std::uint64_t shown_ = 0;     ///< version of the picture
    Clock::time_point earliest_;  ///< of the next look at a large picture, so that hands find time between two
    std::string problem_;
    bool redraw_ = true;
    bool completed_ = false;
    bool done_ = false;
};

}  // namespace

void run_viewer(const Scene& scene, const ViewerOptions& options) { Viewer(scene, options).run(); }

}  // namespace raysteps
