#pragma once
// Hears of every box and surface that this thread asks, while it listens.
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "inspect/pixel_record.hpp"

namespace raysteps {

/// How many events are kept. What goes beyond is counted all the same.
inline constexpr std::uint64_t k_max_events_per_ray = 5000;  ///< of boxes, of surfaces missed and of surfaces hit
inline constexpr std::uint64_t k_max_events = 20000;         ///< of the whole pixel, of each of the three

class SearchRecorder {
public:
    SearchRecorder(const Accelerator& accelerator, std::size_t surfaces);
    ~SearchRecorder();  // stops listening, where a search threw before its end
    SearchRecorder(const SearchRecorder&) = delete;
    SearchRecorder& operator=(const SearchRecorder&) = delete;

    /// What is asked from here on belongs to this ray; null: it is only counted.
    void begin(RayNode* node);

    /// Stops listening; gives the counts of the ray.
    SearchCounts end();

    void box(const Box& box, const std::optional<Interval>& part);
    void surface(const Surface& surface, const std::optional<HitRecord>& hit);

    /// The surface whose answer this hit is, among those that the last ray asked.
    [[nodiscard]] const Surface* surface_of_hit(const Ray& ray, const HitRecord& hit) const;

    /// The last surface that was hit nearer than `distance`: the one that ended the search for any hit.
    [[nodiscard]] const Surface* blocker(float distance) const;

    /// Whether the last ray asked this surface, or this box and with which answer.
    [[nodiscard]] bool asked(const Surface& surface) const;
    [[nodiscard]] const std::unordered_map<const Box*, bool>& asked_boxes() const { return asked_boxes_; }

    [[nodiscard]] const SearchCounts& total() const { return total_; }
    [[nodiscard]] const LeftOut& left_out() const { return left_out_; }

private:
    struct Known {
        const Box* box = nullptr;
        int level = 0;
        std::uint64_t listed = 0;
    };

    [[nodiscard]] const Known* find_known(const Box& box) const;

    std::vector<Known> known_;             // the structure's boxes, sorted by address
    std::vector<std::uint32_t> last_ray_;  // by surface: the last ray that asked it, from 1
    std::uint32_t ray_ = 0;
    RayNode* node_ = nullptr;
    SearchCounts counts_;
    SearchCounts total_;
    LeftOut left_out_;
    std::uint64_t kept_boxes_ = 0;
    std::uint64_t kept_hits_ = 0;
    std::uint64_t kept_misses_ = 0;
    std::uint64_t hits_of_ray_ = 0;
    std::uint64_t misses_of_ray_ = 0;
    std::vector<std::pair<const Surface*, float>> hits_;  // of the last ray
    std::unordered_map<const Box*, bool> asked_boxes_;    // of the last ray
};

/// Where Surface::hit and Box::hit tell what they were asked; null: nobody listens.
[[nodiscard]] SearchRecorder* listening_recorder();

/// Asks without being heard or counted.
class RecorderPause {
public:
    RecorderPause();
    ~RecorderPause();
    RecorderPause(const RecorderPause&) = delete;
    RecorderPause& operator=(const RecorderPause&) = delete;

private:
    SearchRecorder* before_;
    Stats stats_;
};

}  // namespace raysteps
