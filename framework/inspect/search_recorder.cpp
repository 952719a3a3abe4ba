#include "inspect/search_recorder.hpp"

#include <algorithm>

namespace raysteps {
namespace {

thread_local SearchRecorder* t_listening = nullptr;

/// Step 11 gives a hit of a mesh another normal, position and colour, and leaves its mark.
bool same(const HitRecord& a, const HitRecord& b) {
    if (a.mesh_triangle != 0 || b.mesh_triangle != 0) {
        return a.mesh_triangle == b.mesh_triangle;
    }
    return a.position == b.position && a.normal == b.normal && a.fill.color == b.fill.color && a.fill.ks == b.fill.ks &&
           a.front_face == b.front_face;
}

}  // namespace

SearchCounts& SearchCounts::operator+=(const SearchCounts& other) {
    box_tests += other.box_tests;
    boxes_entered += other.boxes_entered;
    candidates += other.candidates;
    surface_tests += other.surface_tests;
    unique_surfaces += other.unique_surfaces;
    return *this;
}

SearchRecorder* listening_recorder() { return t_listening; }

RecorderPause::RecorderPause() : before_(std::exchange(t_listening, nullptr)), stats_(thread_stats()) {}

RecorderPause::~RecorderPause() {
    t_listening = before_;
    thread_stats() = stats_;
}

SearchRecorder::SearchRecorder(const Accelerator& accelerator, std::size_t surfaces) : last_ray_(surfaces, 0) {
    accelerator.visit_nodes(
        nullptr, [this](const NodeInfo& place) { known_.push_back({&place.box, place.level, place.listed}); });
    std::sort(known_.begin(), known_.end(), [](const Known& a, const Known& b) { return std::less<>()(a.box, b.box); });
}

SearchRecorder::~SearchRecorder() {
    if (t_listening == this) {
        t_listening = nullptr;
    }
}

const SearchRecorder::Known* SearchRecorder::find_known(const Box& box) const {
    const auto found = std::lower_bound(known_.begin(), known_.end(), &box, [](const Known& known, const Box* wanted) {
        return std::less<>()(known.box, wanted);
    });
    return found != known_.end() && found->box == &box ? &*found : nullptr;
}

void SearchRecorder::begin(RayNode* node) {
    node_ = node;
    counts_ = {};
    hits_.clear();
    asked_boxes_.clear();
    hits_of_ray_ = 0;
    misses_of_ray_ = 0;
    ++ray_;
    t_listening = this;
}

SearchCounts SearchRecorder::end() {
    t_listening = nullptr;
    const std::uint64_t unique_before = total_.unique_surfaces;
    total_ += counts_;
    total_.unique_surfaces = unique_before;  // counted where a surface is asked for the first time
    return counts_;
}

void SearchRecorder::box(const Box& box, const std::optional<Interval>& part) {
    ++counts_.box_tests;
    asked_boxes_[&box] = part.has_value();
    const Known* const known = find_known(box);
    if (part) {
        ++counts_.boxes_entered;
        counts_.candidates += known != nullptr ? known->listed : 0;
    }
    if (node_ == nullptr || node_->boxes.size() >= k_max_events_per_ray || kept_boxes_ >= k_max_events) {
        ++left_out_.boxes;
        return;
    }
    ++kept_boxes_;
    BoxEvent& event = node_->boxes.emplace_back(BoxEvent{box, part, {}, {}});
    if (known != nullptr) {
        event.level = known->level;
        event.listed = known->listed;
    }
}

void SearchRecorder::surface(const Surface& surface, const std::optional<HitRecord>& hit) {
    ++counts_.surface_tests;
    if (surface.order() < last_ray_.size()) {
        std::uint32_t& last = last_ray_[surface.order()];
        total_.unique_surfaces += last == 0 ? 1U : 0U;
        counts_.unique_surfaces += last != ray_ ? 1U : 0U;
        last = ray_;
    }
    if (hit) {
        hits_.emplace_back(&surface, hit->distance);
    }
    std::uint64_t& of_ray = hit ? hits_of_ray_ : misses_of_ray_;
    std::uint64_t& of_pixel = hit ? kept_hits_ : kept_misses_;
    if (node_ == nullptr || of_ray >= k_max_events_per_ray || of_pixel >= k_max_events) {
        ++left_out_.tests;
        return;
    }
    ++of_ray;
    ++of_pixel;
    node_->tests.push_back({surface.order(), hit ? std::optional(hit->distance) : std::nullopt, counts_.box_tests});
}

const Surface* SearchRecorder::surface_of_hit(const Ray& ray, const HitRecord& hit) const {
    const Surface* found = nullptr;
    const RecorderPause unheard;
    for (const auto& [surface, distance] : hits_) {
        const bool earlier = found == nullptr || surface->order() < found->order();
        if (distance == hit.distance && earlier) {
            const std::optional<HitRecord> again = surface->hit(ray);
            if (again && same(*again, hit)) {
                found = surface;
            }
        }
    }
    return found;
}

const Surface* SearchRecorder::blocker(float distance) const {
    const auto near =
        std::find_if(hits_.rbegin(), hits_.rend(), [&](const auto& one) { return one.second < distance; });
    return near != hits_.rend() ? near->first : nullptr;
}

bool SearchRecorder::asked(const Surface& surface) const {
    return surface.order() < last_ray_.size() && last_ray_[surface.order()] == ray_;
}

}  // namespace raysteps
