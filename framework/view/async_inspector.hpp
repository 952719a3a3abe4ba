#pragma once
// Inspects one pixel at a time in the background.
#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <utility>

#include "view/controls.hpp"

namespace raysteps {

class AsyncInspector {
public:
    /// Scene and accelerators must outlive it. name: what the text calls the scene.
    AsyncInspector(const Scene& scene, AcceleratorCache& accelerators, std::string name)
        : scene_(scene), accelerators_(accelerators), name_(std::move(name)) {}

    /// While a pixel is being inspected, the next one waits; of several that wait the last one counts.
    void ask(const RenderRequest& request, const Pixel& pixel, bool camera_moved);

    /// The text of a pixel that is done: what `inspect` prints, and for a camera that was moved first the lines that
    /// put it into a scene. To be called from time to time.
    [[nodiscard]] std::optional<std::string> answer();

    [[nodiscard]] bool is_idle() const { return !running_.valid(); }

    /// False: it goes on, as a step may hang.
    [[nodiscard]] bool idle_within(std::chrono::milliseconds timeout);

private:
    struct Question {
        RenderRequest request;
        Pixel pixel;
        bool camera_moved = false;
    };

    [[nodiscard]] std::string inspected(const Question& question);
    void begin(const Question& question);

    const Scene& scene_;
    AcceleratorCache& accelerators_;
    std::string name_;
    std::future<std::string> running_;
    std::optional<Question> waiting_;
};

}  // namespace raysteps
