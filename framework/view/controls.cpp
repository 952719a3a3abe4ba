#include "view/controls.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/accelerator_registry.hpp"
#include "view/camera_moves.hpp"
#include "view/status_bar.hpp"

namespace raysteps {
namespace {

constexpr float k_click_reach = 3.0F;   // window pixels that a hand may slip while it clicks
constexpr float k_wheel_factor = 0.9F;  // of the distance, per notch
constexpr float k_stops_per_key = 0.5F;
constexpr std::array<std::optional<CostKind>, 5> k_maps{std::nullopt, CostKind::tests, CostKind::boxes, CostKind::depth,
                                                        CostKind::time};

bool same_view(const Camera& a, const Camera& b) { return a.from == b.from && a.at == b.at && a.up == b.up; }

}  // namespace

RenderRequest Controls::request() const {
    return {settings_.camera, settings_.step,
            settings_.acceleration.value_or(default_accelerator(settings_.step.step))};
}

bool Controls::camera_moved() const { return !same_view(settings_.camera, home_); }

Controls::Events Controls::take_events() { return std::exchange(events_, {}); }

void Controls::key(char character) {
    if (character >= '1' && character <= '9') {
        choose_step(character - '0');
        return;
    }
    switch (character) {
        case 'a':
        case 'A':
            next_acceleration();
            break;
        case 'm':
        case 'M':
            next_map();
            break;
        case 'r':
        case 'R':
            set_camera(home_);
            break;
        case '+':
        case '=':  // the same key, without shift
            expose(settings_.stops + k_stops_per_key);
            break;
        case '-':
            expose(settings_.stops - k_stops_per_key);
            break;
        case 's':
        case 'S':
            events_.save = true;
            break;
        case 'q':
        case 'Q':
            events_.quit = true;
            break;
        default:
            break;
    }
}

void Controls::press(const Point& place, Button button, bool shift) {
    pressed_ = last_ = place;
    const bool in_bar = layout_.in_picture(place).y >= static_cast<float>(settings_.camera.height);
    if (in_bar) {
        drag_ = has_slider() ? Drag::slider : Drag::none;
        slide_to(place);
    } else if (button == Button::other || shift) {
        drag_ = Drag::pan;
    } else {
        drag_ = Drag::undecided;
    }
}

void Controls::move(const Point& place) {
    const float height = layout_.scale() * static_cast<float>(settings_.camera.height);
    const float right = (place.x - last_.x) / height;
    const float down = (place.y - last_.y) / height;
    if (drag_ == Drag::undecided && std::hypot(place.x - pressed_.x, place.y - pressed_.y) > k_click_reach) {
        drag_ = Drag::orbit;
    }
    if (drag_ == Drag::undecided) {
        return;
    }
    last_ = place;
    if (drag_ == Drag::orbit) {  // the scene follows the hand, so the eye goes the other way
        constexpr float k_half_turn = std::numbers::pi_v<float>;
        set_camera(orbit(settings_.camera, -k_half_turn * right, k_half_turn * down));
    } else if (drag_ == Drag::pan) {
        set_camera(pan(settings_.camera, right, -down));
    } else if (drag_ == Drag::slider) {
        slide_to(place);
    }
}

void Controls::release(const Point& /*place*/) {
    if (std::exchange(drag_, Drag::none) != Drag::undecided) {
        return;
    }
    const Point at = layout_.in_picture(pressed_);
    const Pixel pixel{static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y))};
    if (pixel.x >= 0 && pixel.x < settings_.camera.width && pixel.y >= 0 && pixel.y < settings_.camera.height) {
        events_.click = pixel;
    }
}

void Controls::wheel(float notches) { set_camera(dolly(settings_.camera, std::pow(k_wheel_factor, notches))); }

void Controls::choose_step(int step) {
    if (step <= settings_.last_step) {
        settings_.step.step = step;
        events_.new_request = true;
    }
}

void Controls::next_acceleration() {
    std::vector<Acceleration> all;
    for (const AcceleratorEntry& entry : accelerator_registry()) {
        if (entry.make != nullptr && entry.step <= settings_.last_step) {
            all.push_back(entry.kind);
        }
    }
    const Acceleration now = request().acceleration;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i] == now) {
            settings_.acceleration = all[(i + 1) % all.size()];
            break;
        }
    }
    events_.new_request = true;
}

void Controls::next_map() {
    for (std::size_t i = 0; i < k_maps.size(); ++i) {
        if (k_maps[i] == settings_.map) {
            settings_.map = k_maps[(i + 1) % k_maps.size()];
            break;
        }
    }
    events_.new_look = true;
}

void Controls::expose(float stops) {
    if (settings_.step.step >= 7) {
        settings_.stops = round_stops(stops);
        events_.new_look = true;
    }
}

void Controls::set_camera(const Camera& camera) {
    if (!same_view(camera, settings_.camera)) {
        settings_.camera = camera;
        events_.new_request = true;
    }
}

void Controls::slide_to(const Point& place) {
    if (drag_ == Drag::slider) {
        expose(stops_at(slider_in(settings_.camera.width).place(layout_.in_picture(place).x)));
    }
}

}  // namespace raysteps
