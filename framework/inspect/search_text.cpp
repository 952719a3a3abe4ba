#include "inspect/search_text.hpp"

#include <algorithm>

namespace raysteps {
namespace {

constexpr std::size_t k_max_box_lines = 80;  // the paper has 73 boxes
constexpr std::size_t k_max_hit_lines = 40;
constexpr std::size_t k_max_ranges = 60;

std::string box_words(const BoxEvent& event) {
    std::string text = event.level ? "level " + std::to_string(*event.level) + "  " : "";
    text += brief(event.box.min) + " to " + brief(event.box.max);
    text += "  enters at " + brief(event.part->enter) + ", leaves at " + brief(event.part->leave);
    return event.listed && *event.listed > 0 ? text + "  lists " + std::to_string(*event.listed) : text;
}

/// Such as 3-7, 12, 15-19.
std::string ranges(std::vector<std::size_t> numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    std::string text;
    std::size_t count = 0;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t last = i;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) {
            ++last;
        }
        if (++count > k_max_ranges) {
            return text + ", and " + std::to_string(numbers.size() - i) + " more";
        }
        text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
        text += last > i ? "-" + std::to_string(numbers[last]) : "";
        i = last + 1;
    }
    return text;
}

void say_more(TextLines& out, std::uint64_t all, std::uint64_t shown, int level) {
    if (all > shown) {
        out.line(level, "and " + std::to_string(all - shown) + " more");
    }
}

std::string reason_words(const LostHit& lost) {
    const std::string box = lost.box ? brief(lost.box->min) + " to " + brief(lost.box->max) : "";
    switch (lost.reason) {
        case LossReason::not_chosen:
            return "it was tested, but another answer was given";
        case LossReason::not_tested:
            return lost.box ? "the box that lists it was entered, but it was not tested: " + box : "it was not tested";
        case LossReason::box_missed:
            return "the ray was said to miss a box that holds the hit: " + box;
        case LossReason::not_visited:
            return "the box that lists it was never asked: " + box;
        case LossReason::not_listed:
            return "a box around the hit does not list it: " + box;
        case LossReason::no_overlap:
            return "overlaps says that it does not touch the box around the hit: " + box;
        case LossReason::no_box:
            return "no box lies around the hit";
        case LossReason::no_bounds:
            return "bounds_of all surfaces leaves the hit out: " + box;
        case LossReason::no_part:
            return "split makes parts that leave out the hit of this box: " + box;
    }
    return "";
}

}  // namespace

void write_boxes(TextLines& out, const RayNode& node, int level) {
    const SearchCounts& counts = node.counts;
    if (counts.box_tests == 0) {
        return;
    }
    const std::string entered = std::to_string(counts.boxes_entered) + " entered";
    out.line(level, "boxes",
             std::to_string(counts.box_tests) + " asked, " + entered +
                 (counts.boxes_entered > 0 ? ", in this order:" : ""));
    std::uint64_t shown = 0;
    for (const BoxEvent& event : node.boxes) {
        if (event.part && shown < k_max_box_lines) {
            out.line(level + 1, box_words(event));
            ++shown;
        }
    }
    say_more(out, counts.boxes_entered, shown, level + 1);
}

void write_tests(TextLines& out, const PixelRecord& record, const RayNode& node, int level) {
    const SearchCounts& counts = node.counts;
    const std::string all = " of " + std::to_string(record.surfaces);
    if (counts.candidates > 0) {
        out.line(level, "candidates",
                 std::to_string(counts.candidates) + " in the lists of these boxes, duplicates counted (" +
                     share(counts.candidates, record.surfaces) + all + ")");
    }
    out.line(level, "tests",
             amount(counts.surface_tests, "test") + " on " + amount(counts.unique_surfaces, "different surface") +
                 ", " + share(counts.unique_surfaces, record.surfaces) + all);
    std::vector<std::size_t> tested;
    std::vector<const SurfaceEvent*> hits;
    for (const SurfaceEvent& event : node.tests) {
        tested.push_back(event.surface);
        if (event.distance) {
            hits.push_back(&event);
        }
    }
    if (!tested.empty()) {
        const bool complete = tested.size() == counts.surface_tests;
        out.line(level + 1, (complete ? "surfaces " : "the first of them: ") + ranges(std::move(tested)));
    }
    const std::size_t shown = std::min(hits.size(), k_max_hit_lines);
    for (std::size_t i = 0; i < shown; ++i) {
        out.line(level + 1,
                 "surface " + std::to_string(hits[i]->surface) + " is hit at distance " + brief(*hits[i]->distance));
    }
    say_more(out, hits.size(), shown, level + 1);
}

void write_lost(TextLines& out, const LostHit& lost, int level) {
    out.line(level, "LOST",
             "a search through all surfaces finds surface " + std::to_string(lost.surface) + " (" + lost.kind +
                 ") at distance " + brief(lost.distance) + ";");
    out.line(level, "", reason_words(lost));
}

}  // namespace raysteps
