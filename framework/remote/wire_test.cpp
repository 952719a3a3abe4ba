// Two ends of a wire in one process, each on a thread of its own.
#include "remote/wire.hpp"

#include <unistd.h>
#include <array>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "remote/message.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::remote;
using namespace raysteps::testing;

namespace {

int number_in(std::string_view bytes) { return Reader(bytes).get<int>(); }

void send_number(Wire& wire, Kind kind, int number) {
    wire.send(kind, [number](std::string& bytes) { Writer(bytes).put(number); });
}

int ask(Wire& wire, int number) {
    send_number(wire, Kind::question, number);
    return number_in(wire.wait_for_answer().bytes);
}

/// The sum of all numbers up to the one that was asked for, by asking back for the sum without it.
void sum_up(Wire& wire, std::string_view question) {
    const int number = number_in(question);
    send_number(wire, Kind::answer, number == 0 ? 0 : number + ask(wire, number - 1));
}

struct Hung {};

/// Ends a thread, and not the whole program.
[[noreturn]] void hang_up(int /*code*/, const char* /*why*/) { throw Hung(); }

/// Another thread serves questions until the wire of the test is gone.
class Pair {
public:
    Pair() {
        REQUIRE(pipe(there_.data()) == 0);
        REQUIRE(pipe(back_.data()) == 0);
        other_ = std::thread([in = there_[0], out = back_[1]] {
            Wire wire({in, out}, sum_up, hang_up);
            try {
                wire.serve();
            } catch (const Hung&) {
            }
            close(in);
            close(out);
        });
    }
    ~Pair() {
        close(there_[1]);
        other_.join();
        close(back_[0]);
    }
    Pair(const Pair&) = delete;
    Pair& operator=(const Pair&) = delete;

    [[nodiscard]] Wire::Pipes pipes() const { return {back_[0], there_[1]}; }

private:
    std::array<int, 2> there_{};
    std::array<int, 2> back_{};
    std::thread other_;
};

}  // namespace

TEST_CASE("a question leads to questions back and to one answer", "[remote]") {
    const Pair pair;
    Wire wire(pair.pipes(), sum_up, hang_up);
    CHECK(ask(wire, 0) == 0);
    CHECK(ask(wire, 10) == 55);
    CHECK(ask(wire, 50) == 1275);
}

TEST_CASE("many conversations at once do not mix their answers", "[remote]") {
    const Pair pair;
    Wire wire(pair.pipes(), sum_up, hang_up);
    std::array<int, 200> answers{};
    int next = 0;
    wire.run_together(16, [&] {
        while (next < 200) {
            const int mine = next++;
            answers.at(static_cast<std::size_t>(mine)) = ask(wire, mine % 20);
        }
    });
    for (int i = 0; i < 200; ++i) {
        CHECK(answers.at(static_cast<std::size_t>(i)) == i % 20 * (i % 20 + 1) / 2);
    }
}

TEST_CASE("an exception leaves the conversations, and each has counters of its own", "[remote]") {
    const Pair pair;
    Wire wire(pair.pipes(), sum_up, hang_up);
    std::vector<std::uint64_t> counted;
    const auto count = [&] {
        thread_stats().surface_tests = 0;
        for (int i = 0; i < 5; ++i) {
            ++thread_stats().surface_tests;
            static_cast<void>(ask(wire, i));
        }
        counted.push_back(thread_stats().surface_tests);
    };
    wire.run_together(8, count);
    CHECK(counted == std::vector<std::uint64_t>(8, 5));
    CHECK_THROWS_AS(wire.run_together(8, [&] { throw std::length_error(std::to_string(ask(wire, 3))); }),
                    std::length_error);
}

TEST_CASE("questions without an end, and an end that is gone, end the program", "[remote]") {
    const Pair pair;
    Wire wire(pair.pipes(), sum_up, hang_up);
    CHECK_THROWS_AS(ask(wire, 100000), Hung);
}

TEST_CASE("a message that ends too early or announces too much is refused", "[remote]") {
    std::string bytes;
    Writer writer(bytes);
    writer.put(7);
    writer.put(std::string_view("words"));
    Reader whole(bytes);
    CHECK(whole.get<int>() == 7);
    CHECK(whole.text() == "words");
    CHECK(whole.at_end());
    CHECK_THROWS_AS(whole.get<bool>(), BadMessage);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        Reader cut(std::string_view(bytes).substr(0, size));
        CHECK_THROWS_AS((static_cast<void>(cut.get<int>()), cut.text()), BadMessage);
    }
    std::string many;
    Writer(many).put(std::uint32_t{1000000});
    Reader announced(many);
    CHECK_THROWS_AS(announced.count(1), BadMessage);
}
