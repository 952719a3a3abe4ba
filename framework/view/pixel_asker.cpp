#include "view/pixel_asker.hpp"

#include <exception>
#include <utility>

#include "inspect/inspect_pixel.hpp"
#include "inspect/inspect_text.hpp"
#include "io/nff_writer.hpp"

namespace raysteps {

void PixelAsker::ask(const Shot& shot, const Pixel& pixel, bool camera_moved) {
    const Question question{shot, pixel, camera_moved};
    if (running_.valid()) {
        waiting_ = question;
    } else {
        begin(question);
    }
}

void PixelAsker::begin(const Question& question) {
    running_ = std::async(std::launch::async, [this, question] { return inspected(question); });
}

std::optional<std::string> PixelAsker::answer() {
    if (!running_.valid() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return std::nullopt;
    }
    std::string text = running_.get();
    if (waiting_) {
        begin(*std::exchange(waiting_, std::nullopt));
    }
    return text;
}

bool PixelAsker::idle_within(std::chrono::milliseconds patience) {
    waiting_.reset();
    return !running_.valid() || running_.wait_for(patience) == std::future_status::ready;
}

std::string PixelAsker::inspected(const Question& question) {
    try {
        const Shot& shot = question.shot;
        const Accelerator& accelerator = structures_.get(shot.acceleration);
        PixelRecord record = inspect_pixel(scene_, shot.camera, accelerator, shot.acceleration, shot.step,
                                           question.pixel.x, question.pixel.y);
        record.scene = name_;
        const std::string camera =
            question.camera_moved ? "# the camera as it was moved\n" + write_viewpoint(shot.camera) : "";
        return camera + inspect_text(record);
    } catch (const std::exception& error) {
        return "raysteps view: this pixel cannot be inspected: " + std::string(error.what()) + "\n";
    }
}

}  // namespace raysteps
