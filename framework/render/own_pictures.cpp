#include "render/own_pictures.hpp"

#include <map>

namespace raysteps {
namespace {

std::map<int, PictureOf>& offered() {
    static std::map<int, PictureOf> pictures;
    return pictures;
}

}  // namespace

bool offer_picture(int step, PictureOf picture) {
    offered()[step] = picture;
    return true;
}

Color with_own_pictures(Tracer& tracer, const Ray& ray, const Color& color, int step) {
    Color seen = color;
    for (const auto& [own_step, picture] : offered()) {
        if (own_step <= step) {
            seen = picture(tracer, ray, seen);
        }
    }
    return seen;
}

}  // namespace raysteps
