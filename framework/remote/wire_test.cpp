// Two ends of a wire in one process, each on a thread of its own.
#include "remote/wire.hpp"

#include <unistd.h>
#include <array>
#include <atomic>
#include <set>
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

void send_number(Wire& wire, MessageKind kind, int number) {
    wire.send(kind, [number](std::string& bytes) { Writer(bytes).put(number); });
}

int ask(Wire& wire, int number) {
    send_number(wire, MessageKind::question, number);
    return number_in(wire.wait_for_answer().bytes);
}

/// The sum of all numbers up to the one that was asked for, by asking back for the sum without it.
void sum_up(Wire& wire, std::string_view question) {
    const int number = number_in(question);
    send_number(wire, MessageKind::answer, number == 0 ? 0 : number + ask(wire, number - 1));
}

struct Hung {
    int code;
};

/// Ends a thread, and not the whole program.
[[noreturn]] void hang_up(int code, const char* /*why*/) { throw Hung{code}; }

/// How the program ends that works on this wire.
template <typename Work>
int ending_of(const Work& work) {
    try {
        work();
    } catch (const Hung& hung) {
        return hung.code;
    }
    return 0;
}

/// Another thread serves questions until the wire of the test is gone.
class Pair {
public:
    Pair() {
        REQUIRE(pipe(there_.data()) == 0);
        REQUIRE(pipe(back_.data()) == 0);
        other_ = std::thread([in = there_[0], out = back_[1]] {
            Wire wire(Wire::Side::box, {in, out}, sum_up, hang_up);
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
    Wire wire(Wire::Side::home, pair.pipes(), sum_up, hang_up);
    CHECK(ask(wire, 0) == 0);
    CHECK(ask(wire, 10) == 55);
    CHECK(ask(wire, 50) == 1275);
}

TEST_CASE("many conversations at once do not mix their answers", "[remote]") {
    const Pair pair;
    Wire wire(Wire::Side::home, pair.pipes(), sum_up, hang_up);
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

TEST_CASE("threads of a student's have conversations of their own", "[remote]") {
    Wire wire(Wire::Side::box, {-1, -1}, sum_up, hang_up);
    std::array<std::size_t, 16> numbers{};
    std::atomic<int> waiting{16};
    std::vector<std::thread> threads;
    for (std::size_t& number : numbers) {
        threads.emplace_back([&] {
            for (--waiting; waiting > 0;) {  // all come for the first time at once
            }
            number = wire.current();
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    CHECK(std::set<std::size_t>(numbers.begin(), numbers.end()).size() == numbers.size());
    CHECK(wire.current() == 0);
}

TEST_CASE("an exception leaves the conversations, and each has counters of its own", "[remote]") {
    const Pair pair;
    Wire wire(Wire::Side::home, pair.pipes(), sum_up, hang_up);
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

namespace {

bool is_even(std::string_view question) { return number_in(question) % 2 == 0; }

/// Says 100 to even numbers at once, and to others what sum_up would.
void sum_up_odd(Wire& wire, std::string_view question) {
    ++thread_stats().box_tests;
    if (is_even(question)) {
        send_number(wire, MessageKind::answer, 100);
    } else {
        sum_up(wire, question);
    }
}

}  // namespace

TEST_CASE("an answer that needs no question is of the conversation that was asked", "[remote]") {
    const Pair pair;
    Wire wire(Wire::Side::home, pair.pipes(), sum_up_odd, hang_up, is_even);
    std::array<int, 200> answers{};
    std::array<std::uint64_t, 200> counted{};
    std::size_t next = 0;
    wire.run_together(16, [&] {
        while (next < answers.size()) {
            const std::size_t mine = next++;
            thread_stats().box_tests = 0;
            answers.at(mine) = ask(wire, static_cast<int>(mine % 20));
            counted.at(mine) = thread_stats().box_tests;
        }
    });
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const std::size_t number = i % 20;
        const bool is_odd = number % 2 == 1;
        CHECK(answers.at(i) == static_cast<int>(is_odd ? number + 100 : number * (number + 1) / 2));
        CHECK(counted.at(i) == (is_odd ? 1 : number / 2));
    }
}

TEST_CASE("questions without an end, and an end that is gone, end the program", "[remote]") {
    const Pair pair;
    Wire wire(Wire::Side::home, pair.pipes(), sum_up, hang_up);
    CHECK(ending_of([&] { ask(wire, 100000); }) == Wire::k_closed);  // the other end has had enough first
}

namespace {

struct Sent {
    std::uint16_t conversation;
    MessageKind kind;
};

/// A batch as a box could write it, with a number in each message.
std::string batch_of(const std::vector<Sent>& messages) {
    std::string inside;
    Writer out(inside);
    for (const Sent& sent : messages) {
        out.put(sent.conversation);
        out.put(sent.kind);
        out.put(static_cast<std::uint32_t>(sizeof(int)));
        out.put(0);
    }
    std::string batch;
    Writer(batch).put(std::string_view(inside));
    return batch;
}

/// How a program ends that asks one question and gets these messages.
int ending_with(const std::vector<Sent>& messages) {
    std::array<int, 2> in{};
    std::array<int, 2> out{};
    REQUIRE(pipe(in.data()) == 0);
    REQUIRE(pipe(out.data()) == 0);
    const std::string batch = batch_of(messages);
    REQUIRE(write(in[1], batch.data(), batch.size()) == static_cast<ssize_t>(batch.size()));
    close(in[1]);
    Wire wire(Wire::Side::home, {in[0], out[1]}, sum_up, hang_up);
    const int code = ending_of([&] { static_cast<void>(ask(wire, 1)); });
    for (const int file : {in[0], out[0], out[1]}) {
        close(file);
    }
    return code;
}

}  // namespace

TEST_CASE("a program takes from a box only what it can be waiting for", "[remote]") {
    CHECK(ending_with({{0, MessageKind::answer}}) == 0);
    CHECK(ending_with({}) == Wire::k_closed);
    CHECK(ending_with({{0, MessageKind::answer}, {0, MessageKind::answer}}) == Wire::k_broken);
    for (const std::uint16_t conversation :
         std::vector<std::uint16_t>{1, 7, 128, 511, 1024, 65535}) {  // nobody has begun these
        CAPTURE(conversation);
        CHECK(ending_with({{conversation, MessageKind::question}}) == Wire::k_broken);
        CHECK(ending_with({{conversation, MessageKind::answer}}) == Wire::k_broken);
    }
    CHECK(ending_with({{600, MessageKind::answer}}) == Wire::k_broken);
    CHECK(ending_with({{600, MessageKind::question}, {600, MessageKind::question}}) == Wire::k_broken);
    CHECK(ending_with({{600, MessageKind::question}, {0, MessageKind::answer}}) == 0);  // as a thread of the student's
    CHECK(ending_with({{0, static_cast<MessageKind>(9)}}) == Wire::k_broken);
}

TEST_CASE("what is too long for a batch is not sent, and text is no batch", "[remote]") {
    constexpr std::size_t k_too_much = (std::size_t{128} << 20U) + 1;
    Wire box(Wire::Side::box, {-1, -1}, sum_up, hang_up);
    box.send(MessageKind::answer, [](std::string& bytes) { bytes.append(k_too_much, 'x'); });
    CHECK(ending_of([&] { static_cast<void>(box.wait_for_answer()); }) == Wire::k_too_long);

    std::array<int, 2> in{};
    REQUIRE(pipe(in.data()) == 0);
    constexpr std::string_view k_text = "hello\n";
    REQUIRE(write(in[1], k_text.data(), k_text.size()) == static_cast<ssize_t>(k_text.size()));
    Wire home(Wire::Side::home, {in[0], -1}, sum_up, hang_up);
    CHECK(ending_of([&] { static_cast<void>(home.wait_for_answer()); }) == Wire::k_broken);
    for (const int file : in) {
        close(file);
    }
}

TEST_CASE("what a box's own conversations count is somebody's", "[remote]") {
    static std::array<int, 2> in{};
    const auto tested = [](Wire& wire, std::string_view /*question*/) {
        ++thread_stats().surface_tests;
        send_number(wire, MessageKind::answer, 0);
        if (wire.current() == 601) {  // the last that was asked
            const std::string batch = batch_of({{0, MessageKind::answer}});
            REQUIRE(write(in[1], batch.data(), batch.size()) == static_cast<ssize_t>(batch.size()));
            close(in[1]);
        }
    };
    std::array<int, 2> out{};
    REQUIRE(pipe(in.data()) == 0);
    REQUIRE(pipe(out.data()) == 0);
    const std::string batch =
        batch_of({{600, MessageKind::question}, {601, MessageKind::question}, {0, MessageKind::answer}});
    REQUIRE(write(in[1], batch.data(), batch.size()) == static_cast<ssize_t>(batch.size()));
    Wire wire(Wire::Side::home, {in[0], out[1]}, tested, hang_up);
    const std::uint64_t before = thread_stats().surface_tests;
    static_cast<void>(ask(wire, 1));
    static_cast<void>(ask(wire, 1));
    CHECK(thread_stats().surface_tests == before + 2);
    for (const int file : {in[0], out[0], out[1]}) {
        close(file);
    }
}

TEST_CASE("who says that it answers without a question must not ask", "[remote]") {
    std::array<int, 2> in{};
    std::array<int, 2> out{};
    REQUIRE(pipe(in.data()) == 0);
    REQUIRE(pipe(out.data()) == 0);
    const std::string batch = batch_of({{1, MessageKind::question}});
    REQUIRE(write(in[1], batch.data(), batch.size()) == static_cast<ssize_t>(batch.size()));
    const auto asks = [](Wire& wire, std::string_view /*question*/) { static_cast<void>(ask(wire, 1)); };
    const auto always = [](std::string_view /*question*/) { return true; };
    Wire wire(Wire::Side::home, {in[0], out[1]}, asks, hang_up, always);
    CHECK(ending_of([&] { wire.run_together(1, [&] { static_cast<void>(ask(wire, 5)); }); }) == Wire::k_fault);
    for (const int file : {in[0], in[1], out[0], out[1]}) {
        close(file);
    }
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
