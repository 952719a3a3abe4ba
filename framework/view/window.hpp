#pragma once
// A window that shows one image. The only place that knows GLFW and OpenGL.
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "core/image.hpp"
#include "view/controls.hpp"
#include "view/layout.hpp"

namespace raysteps {

class WindowError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Places are in pixels of the window, keys are characters.
struct WindowEvents {
    std::function<void(char)> key;
    std::function<void(const Point&, Button, bool shift)> press;
    std::function<void(const Point&)> move;
    std::function<void(const Point&)> release;
    std::function<void(float)> wheel;
};

class Window {
public:
    /// Pixel for pixel, or enlarged in whole numbers and fitted to the screen. Throws WindowError.
    Window(const std::string& title, int width, int height, bool pixel_for_pixel, WindowEvents events);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    void set_title(const std::string& title);
    [[nodiscard]] Layout layout() const;

    void show(const Image& image);
    /// Shows the image, and reads back from OpenGL what the window then holds of it. Throws WindowError where the
    /// window is smaller than the image.
    [[nodiscard]] Image show_and_read(const Image& image);

    /// Takes what the person does; returns after that time even if nothing happens.
    void wait(double seconds);
    [[nodiscard]] bool is_closing() const;
    /// Whether the window needs its image again, since it was last asked.
    [[nodiscard]] bool take_damage();

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace raysteps
