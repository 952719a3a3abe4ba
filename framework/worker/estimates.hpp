#pragma once
// Many independent estimates of one number by chance, until their mean is known well enough to be judged. Which mean is
// right the worker does not know.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/color.hpp"
#include "core/random_stream.hpp"
#include "core/threads.hpp"
#include "worker/protocol.hpp"

namespace raysteps {

/// One estimate, and what it cost: rays, or whatever else the judge counts.
struct Estimate {
    Color value{0.0F};
    int cost = 1;
};

/// How an estimate is repeated: seed, precision, most.
struct EstimatePlan {
    std::uint32_t seed = 0;  ///< number i has the stream (seed, i)
    float precision = 0.0F;  ///< standard error of the mean, as a share of it, that is good enough
    int most = 0;            ///< estimates, whatever the precision is then
};

[[nodiscard]] inline EstimatePlan read_estimate_plan(TokenReader& words) {
    EstimatePlan plan;
    plan.seed = static_cast<std::uint32_t>(words.whole());
    plan.precision = words.number();
    plan.most = words.count();
    return plan;
}

/// Sums of estimates, each in one of so many batches: the means of batches are nearly normal, and tell how far off the
/// mean of all may be.
class EstimateSums {
public:
    static constexpr int k_batches = 256;

    void add(int number, const Estimate& estimate) {
        sums_[static_cast<std::size_t>(number % k_batches)] += glm::dvec3(estimate.value);
        cost_ += estimate.cost;
        ++count_;
    }

    [[nodiscard]] int count() const { return count_; }

    /// Of the channel that is known worst: standard error of the mean as a share of the largest mean. NaN for what is
    /// no number, and for no light at all.
    [[nodiscard]] double relative_error() const {
        glm::dvec3 sum(0.0);
        glm::dvec3 squares(0.0);
        for (const glm::dvec3& one : sums_) {
            sum += one;
            squares += one * one;
        }
        const glm::dvec3 variance = squares - sum * sum / double{k_batches};  // of the sum
        const double largest = std::max({std::abs(sum.x), std::abs(sum.y), std::abs(sum.z)});
        return std::sqrt(std::max({variance.x, variance.y, variance.z, 0.0})) / largest;
    }

    /// Number of estimates in each batch, cost of all, the mean of each batch.
    void write(TokenWriter& answer) const {
        const int size = count_ / k_batches;
        answer.whole(size).whole(cost_).whole(k_batches);
        for (const glm::dvec3& sum : sums_) {
            answer.vector(sum / static_cast<double>(size));
        }
    }

private:
    std::array<glm::dvec3, k_batches> sums_{};
    long long cost_ = 0;
    int count_ = 0;
};

/// Calls estimate(random) with one stream after the other, many at once where it waits for a box. Stops when the mean
/// is known to the plan's precision. The first few streams are asked before it and once more behind it: the answer ends
/// with what they gave together, first and last.
template <typename MakeEstimate>
void write_estimates(const EstimatePlan& plan, TokenWriter& answer, const MakeEstimate& estimate) {
    const auto at = [&](int number) {
        RandomStream random(plan.seed, static_cast<std::uint32_t>(number));
        return estimate(random);
    };
    const auto first_few = [&at] {
        constexpr int k_few = 16;
        Color sum = k_black;
        for (int number = 0; number < k_few; ++number) {
            sum += at(number).value;
        }
        return sum;
    };
    EstimateSums sums;
    const Color first = first_few();
    constexpr double k_batches = EstimateSums::k_batches;
    double wanted = 8 * k_batches;
    while (sums.count() < plan.most) {
        const double rest = std::min(wanted, static_cast<double>(plan.most)) - sums.count();
        const auto count = static_cast<std::size_t>(std::ceil(rest / k_batches) * k_batches);
        const int begin = sums.count();
        for (const Estimate& one :
             made_in_turn(count, [&](std::size_t i) { return at(begin + static_cast<int>(i)); })) {
            sums.add(sums.count(), one);
        }
        const double above = sums.relative_error() / plan.precision;
        if (!(above > 1.0)) {
            break;
        }
        wanted = sums.count() * std::clamp(1.05 * above * above, 1.25, 4.0);  // an error falls with the root of it
    }
    sums.write(answer);
    answer.vector(first).vector(first_few());
}

}  // namespace raysteps
