#include "view/async_inspector.hpp"

#include <exception>
#include <utility>

#include "inspect/inspect_pixel.hpp"
#include "inspect/inspect_text.hpp"
#include "io/nff_writer.hpp"

namespace raysteps {

void AsyncInspector::ask(const RenderRequest& request, const Pixel& pixel, bool camera_moved) {
    const Question question{request, pixel, camera_moved};
    if (running_.valid()) {
        waiting_ = question;
    } else {
        begin(question);
    }
}

void AsyncInspector::begin(const Question& question) {
    running_ = std::async(std::launch::async, [this, question] { return inspected(question); });
}

std::optional<std::string> AsyncInspector::answer() {
    if (!running_.valid() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return std::nullopt;
    }
    std::string text = running_.get();
    if (waiting_) {
        begin(*std::exchange(waiting_, std::nullopt));
    }
    return text;
}

bool AsyncInspector::idle_within(std::chrono::milliseconds timeout) {
    waiting_.reset();
    return !running_.valid() || running_.wait_for(timeout) == std::future_status::ready;
}

std::string AsyncInspector::inspected(const Question& question) {
    const auto refusal = [](const std::string& why) {
        return "raysteps view: this pixel cannot be inspected: " + why + "\n";
    };
    try {
        const RenderRequest& request = question.request;
        const Accelerator& accelerator = accelerators_.get(request.acceleration, request.step.step);
        PixelRecord record = inspect_pixel(scene_, request.camera, accelerator, request.acceleration, request.step,
                                           question.pixel.x, question.pixel.y);
        record.scene = name_;
        const std::string camera =
            question.camera_moved ? "# the camera as it was moved\n" + write_viewpoint(request.camera) : "";
        return camera + inspect_text(record);
    } catch (const std::exception& error) {
        return refusal(error.what());
    } catch (...) {  // a student's function may throw anything
        return refusal("something was thrown that is no std::exception");
    }
}

}  // namespace raysteps
