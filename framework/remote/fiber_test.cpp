#include "remote/fiber.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "testing/testing.hpp"

// Compiled once more as fibers change on processors for which asm_context.hpp has no instructions.
#ifdef RAYSTEPS_PORTABLE_FIBERS
#define WAY " (as on other processors)"
#else
#define WAY ""
#endif

using namespace raysteps::remote;

namespace {

constexpr int k_fibers = 70;  // more than begin at different places

using Fibers = std::vector<std::unique_ptr<Fiber>>;

/// Makes as many as that, each of body(number, itself), and resumes them in turns until all have ended.
template <typename Body>
void run_in_turns(const Body& body) {
    Fibers fibers;
    for (int number = 0; number < k_fibers; ++number) {
        fibers.push_back(std::make_unique<Fiber>(
            [&fibers, &body, number] { body(number, *fibers[static_cast<std::size_t>(number)]); }));
    }
    for (bool all_ended = false; !all_ended;) {
        all_ended = true;
        for (const std::unique_ptr<Fiber>& fiber : fibers) {
            if (!fiber->ended()) {
                fiber->resume();
                all_ended = all_ended && fiber->ended();
            }
        }
    }
}

/// Stops `levels` deep, and adds up what it knew on each level before.
double sum_across_yields(Fiber& self, int levels, double value) {
    if (levels == 0) {
        self.yield();
        return value;
    }
    const double mine = value * 1.5 + levels;
    self.yield();
    const double rest = sum_across_yields(self, levels - 1, mine);
    return mine + rest;
}

double sum_without_yields(int levels, double value) {
    if (levels == 0) {
        return value;
    }
    const double mine = value * 1.5 + levels;
    return mine + sum_without_yields(levels - 1, mine);
}

}  // namespace

TEST_CASE("fibers that take turns keep what they know" WAY, "[remote]") {
    std::array<double, k_fibers> sums{};
    run_in_turns([&sums](int number, Fiber& self) {
        sums[static_cast<std::size_t>(number)] = sum_across_yields(self, 1 + number % 7, number);
    });
    for (int number = 0; number < k_fibers; ++number) {
        REQUIRE(sums[static_cast<std::size_t>(number)] == sum_without_yields(1 + number % 7, number));
    }
}

TEST_CASE("the stacks of fibers are aligned as the system's are" WAY, "[remote]") {
    std::set<std::uintptr_t> odd;
    std::set<std::string> words;
    run_in_turns([&](int number, Fiber& self) {
        alignas(16) std::array<float, 4> numbers{};
        numbers[0] = static_cast<float>(number);
        self.yield();
        odd.insert(reinterpret_cast<std::uintptr_t>(numbers.data()) % 16);
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.1f", static_cast<double>(numbers[0]));  // libraries count on it
        words.insert(text.data());
    });
    REQUIRE(odd == std::set<std::uintptr_t>{0});
    REQUIRE(words.size() == k_fibers);
    REQUIRE(words.contains("69.0"));
}

TEST_CASE("a fiber that yields in a handler has its own exception afterwards" WAY, "[remote]") {
    std::array<std::string, k_fibers> caught;
    run_in_turns([&caught](int number, Fiber& self) {
        try {
            try {
                throw std::runtime_error(std::to_string(number));
            } catch (const std::runtime_error&) {
                self.yield();
                throw;
            }
        } catch (const std::runtime_error& error) {
            self.yield();
            caught[static_cast<std::size_t>(number)] = error.what();
        }
    });
    for (int number = 0; number < k_fibers; ++number) {
        REQUIRE(caught[static_cast<std::size_t>(number)] == std::to_string(number));
    }
}

TEST_CASE("fibers that yield to each other go on where they were, each in its own handler" WAY, "[remote]") {
    Fibers fibers;
    std::array<std::string, k_fibers> caught;
    for (std::size_t number = 0; number < k_fibers; ++number) {
        fibers.push_back(std::make_unique<Fiber>([&fibers, &caught, number] {
            Fiber& next = *fibers[(number + 1) % k_fibers];
            for (int round = 0; round < 3; ++round) {
                try {
                    throw std::runtime_error(std::to_string(number));
                } catch (const std::runtime_error& error) {
                    fibers[number]->switch_to(next);
                    caught[number] += error.what();
                }
            }
            fibers[number]->yield();
        }));
    }
    fibers[0]->resume();  // the others only ever go on in its place
    REQUIRE_FALSE(fibers[0]->ended());
    REQUIRE(std::current_exception() == nullptr);
    for (std::size_t number = 0; number < k_fibers; ++number) {
        const std::string word = std::to_string(number);
        REQUIRE(caught[number] == (number == 0 ? word + word + word : word + word));
    }
}

TEST_CASE("who resumes a fiber gets what nobody has handled in it, or in one that it yielded to" WAY, "[remote]") {
    Fiber failing([] { throw std::length_error("unhandled"); });
    Fiber first([&] { first.switch_to(failing); });
    REQUIRE_THROWS_AS(first.resume(), std::length_error);
    REQUIRE(failing.ended());
    REQUIRE_FALSE(first.ended());
    first.resume();
    REQUIRE(first.ended());
}

TEST_CASE("a fiber that never ends is given back as it is" WAY, "[remote]") {
    int begun = 0;
    {
        Fiber fiber([&begun, &fiber] {
            ++begun;
            fiber.yield();
            ++begun;
        });
        fiber.resume();
        REQUIRE_FALSE(fiber.ended());
    }
    REQUIRE(begun == 1);
}
