#pragma once
// The image as a texture on one rectangle. Part of the window: nobody else includes it.
#include "core/image.hpp"
#include "view/layout.hpp"

namespace raysteps {

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

}  // namespace raysteps
