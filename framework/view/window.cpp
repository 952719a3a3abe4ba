#include "view/window.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace raysteps {
namespace {

constexpr int k_wanted_width = 640;  // small pictures are enlarged up to about this size
constexpr int k_wanted_height = 600;

std::string& last_error() {
    static std::string text;
    return text;
}

[[noreturn]] void fail(const std::string& what) {
    const std::string why = last_error().empty() ? "" : " (" + last_error() + ")";
    throw WindowError(what + why + "; expected a screen with OpenGL. `./raysteps render` needs none");
}

/// GLFW as long as it lives.
class Library {
public:
    Library() {
        glfwSetErrorCallback([](int, const char* text) { last_error() = text; });
        if (glfwInit() != GLFW_TRUE) {
            fail("no window can be opened");
        }
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

// The image as a texture on one rectangle.
class WindowTexture {
public:
    /// Throws WindowError for an image that the graphics card has no room for.
    void load(const Image& image);

    /// In window pixels, from the top left corner.
    void draw(const Layout& layout) const;

private:
    void grow(const Image& image);
    void corner(bool right, bool bottom, const Layout& layout) const;

    int width_ = 0;
    int height_ = 0;
    float right_ = 0.0F;  ///< the part of the texture that the image fills
    float bottom_ = 0.0F;
};

void WindowTexture::load(const Image& image) {
    static_assert(sizeof(Rgb8) == 3);
    glEnable(GL_TEXTURE_2D);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (image.width() > width_ || image.height() > height_) {
        grow(image);
    }
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width(), image.height(), GL_RGB, GL_UNSIGNED_BYTE,
                    image.pixels().data());
    right_ = static_cast<float>(image.width()) / static_cast<float>(width_);
    bottom_ = static_cast<float>(image.height()) / static_cast<float>(height_);
}

/// OpenGL 1.1, which is all that Windows offers without further help, wants powers of two.
void WindowTexture::grow(const Image& image) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    width_ = static_cast<int>(std::bit_ceil(static_cast<unsigned int>(image.width())));
    height_ = static_cast<int>(std::bit_ceil(static_cast<unsigned int>(image.height())));
    if (std::max(width_, height_) > most) {
        throw WindowError("the picture is too large for a window: at most " + std::to_string(most) +
                          " pixels a side, strip included; --size WxH makes it smaller");
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, width_, height_, 0, GL_RGB, GL_UNSIGNED_BYTE, nullptr);
}

void WindowTexture::draw(const Layout& layout) const {
    glBegin(GL_QUADS);
    corner(false, false, layout);
    corner(true, false, layout);
    corner(true, true, layout);
    corner(false, true, layout);
    glEnd();
}

void WindowTexture::corner(bool right, bool bottom, const Layout& layout) const {
    glTexCoord2f(right ? right_ : 0.0F, bottom ? bottom_ : 0.0F);
    glVertex2i(layout.left() + (right ? layout.shown_width() : 0), layout.top() + (bottom ? layout.shown_height() : 0));
}

struct Extent {
    int width = 0;
    int height = 0;
};

/// How large the window is to be: whole multiples of the image, or what the screen has room for.
Extent size_for(int width, int height, bool pixel_for_pixel) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (pixel_for_pixel || monitor == nullptr) {
        return {width, height};
    }
    int left = 0;
    int top = 0;
    Extent room;
    glfwGetMonitorWorkarea(monitor, &left, &top, &room.width, &room.height);
    const int enlarged = std::max(
        1, std::min({k_wanted_width / width, k_wanted_height / height, room.width / width, room.height / height}));
    return {std::clamp(enlarged * width, 1, std::max(1, room.width)),
            std::clamp(enlarged * height, 1, std::max(1, room.height))};
}

}  // namespace

struct Window::Inside {
    Library library;
    GLFWwindow* handle = nullptr;
    WindowEvents events;
    WindowTexture texture;
    int width = 1;  ///< of the image
    int height = 1;
    bool pixel_for_pixel = false;
    bool damaged = true;
    Point pointer;

    ~Inside() {
        if (handle != nullptr) {
            glfwDestroyWindow(handle);
        }
    }

    static Inside& of(GLFWwindow* window) { return *static_cast<Inside*>(glfwGetWindowUserPointer(window)); }

    [[nodiscard]] Extent pixels() const {
        Extent size;
        glfwGetFramebufferSize(handle, &size.width, &size.height);
        return {std::max(1, size.width), std::max(1, size.height)};
    }

    /// Kept from the events, as by the time of a click the pointer itself may be elsewhere. In pixels of the
    /// framebuffer: on some screens a window counts in larger units.
    void move_pointer(double x, double y) {
        Extent units;
        glfwGetWindowSize(handle, &units.width, &units.height);
        const Extent size = pixels();
        pointer = {static_cast<float>(x * size.width / std::max(1, units.width)),
                   static_cast<float>(y * size.height / std::max(1, units.height))};
    }

    void listen() {
        glfwSetWindowUserPointer(handle, this);
        glfwSetWindowRefreshCallback(handle, [](GLFWwindow* window) { of(window).damaged = true; });
        glfwSetFramebufferSizeCallback(handle, [](GLFWwindow* window, int, int) { of(window).damaged = true; });
        glfwSetCharCallback(handle, [](GLFWwindow* window, unsigned int character) {
            if (character < 128) {
                of(window).events.key(static_cast<char>(character));
            }
        });
        glfwSetKeyCallback(handle, [](GLFWwindow* window, int key, int, int action, int) {
            if (key == GLFW_KEY_ESCAPE && action == GLFW_PRESS) {
                of(window).events.key('q');
            } else if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9 && action == GLFW_PRESS) {
                of(window).events.key(static_cast<char>('1' + key - GLFW_KEY_1));  // where digits need shift
            }
        });
        glfwSetMouseButtonCallback(handle, [](GLFWwindow* window, int button, int action, int modifiers) {
            const Inside& inside = of(window);
            if (action == GLFW_PRESS) {
                inside.events.press(inside.pointer, button == GLFW_MOUSE_BUTTON_LEFT ? Button::left : Button::other,
                                    (modifiers & GLFW_MOD_SHIFT) != 0);
            } else {
                inside.events.release(inside.pointer);
            }
        });
        glfwSetCursorPosCallback(handle, [](GLFWwindow* window, double x, double y) {
            of(window).move_pointer(x, y);
            of(window).events.move(of(window).pointer);
        });
        glfwSetScrollCallback(handle, [](GLFWwindow* window, double, double notches) {
            of(window).events.wheel(static_cast<float>(notches));
        });
    }

    void draw(const Image& image, const Layout& layout) {
        const Extent size = pixels();
        glViewport(0, 0, size.width, size.height);
        glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        glDisable(GL_DITHER);
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glOrtho(0.0, size.width, size.height, 0.0, -1.0, 1.0);  // from the top left, as the picture
        texture.load(image);
        texture.draw(layout);
    }
};

Window::Window(const std::string& title, int width, int height, bool pixel_for_pixel, WindowEvents events)
    : inside_(std::make_unique<Inside>()) {
    inside_->events = std::move(events);
    inside_->width = width;
    inside_->height = height;
    inside_->pixel_for_pixel = pixel_for_pixel;
    glfwWindowHint(GLFW_COCOA_RETINA_FRAMEBUFFER, GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    const Extent size = size_for(width, height, pixel_for_pixel);
    inside_->handle = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
    if (inside_->handle == nullptr) {
        fail("no window can be opened");
    }
    glfwMakeContextCurrent(inside_->handle);
    glfwSwapInterval(1);
    inside_->listen();
}

Window::~Window() = default;

void Window::set_title(const std::string& title) { glfwSetWindowTitle(inside_->handle, title.c_str()); }

Layout Window::layout() const {
    const Extent size = inside_->pixels();
    constexpr float k_any = 1e6F;
    return {inside_->width, inside_->height, size.width, size.height, inside_->pixel_for_pixel ? 1.0F : k_any};
}

void Window::show(const Image& image) {
    inside_->draw(image, layout());
    glfwSwapBuffers(inside_->handle);
}

Image Window::show_and_read(const Image& image) {
    const Layout place = layout();
    if (place.scale() < 1.0F) {
        throw WindowError("the window was made smaller than the picture: expected room for " +
                          std::to_string(image.width()) + "x" + std::to_string(image.height()) + " pixels");
    }
    inside_->draw(image, place);
    Image read(image.width(), image.height());
    const int bottom = place.window_height() - place.top() - 1;  // OpenGL counts rows from below
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (int y = 0; y < image.height(); ++y) {
        glReadPixels(place.left(), bottom - y, image.width(), 1, GL_RGB, GL_UNSIGNED_BYTE, &read.at(0, y));
    }
    glfwSwapBuffers(inside_->handle);
    return read;
}

void Window::wait(double seconds) { glfwWaitEventsTimeout(seconds); }

bool Window::is_closing() const { return glfwWindowShouldClose(inside_->handle) == GLFW_TRUE; }

bool Window::take_damage() { return std::exchange(inside_->damaged, false); }

}  // namespace raysteps
