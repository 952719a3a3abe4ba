#include "view/window_texture.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <bit>
#include <string>

#include "view/window.hpp"

namespace raysteps {

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

}  // namespace raysteps
