#include "remote/wire.hpp"

#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <system_error>
#include <utility>

#include "remote/message.hpp"

namespace raysteps::remote {
namespace {

using BatchSize = std::uint32_t;  // stands before a batch, in bytes

constexpr std::size_t k_usual_batch = std::size_t{128} << 10U;
constexpr std::size_t k_max_batch = std::size_t{128} << 20U;
constexpr std::size_t k_message_head = sizeof(std::uint16_t) + sizeof(MessageKind) + sizeof(std::uint32_t);
constexpr std::size_t k_first_visitor = 512;
constexpr int k_deepest = 200;  // questions within questions; the stack of a fiber holds some more

thread_local bool t_has_fibers = false;  // whether this is the thread that all fibers run on

}  // namespace

void Wire::exit_process(int code, const char* why) {
    exit_handler_(code, why);
    std::_Exit(code);
}

Wire::Wire(Side side, Pipes pipes, Service service, ExitHandler exit_handler,
           AnswersWithoutAsking answers_without_asking)
    : side_(side),
      pipes_(pipes),
      service_(service),
      exit_handler_(exit_handler),
      answers_without_asking_(answers_without_asking),
      outgoing_(sizeof(BatchSize), '\0'),
      incoming_(k_usual_batch) {
    t_has_fibers = true;
    std::signal(SIGPIPE, SIG_IGN);  // who is gone is heard of by what write returns
}

std::size_t Wire::current() {
    if (t_has_fibers) {
        return running_;
    }
    const std::unique_lock lock = guard();  // several threads of a student's may come for the first time at once
    const auto [place, is_new] = visitors_.try_emplace(std::this_thread::get_id(), k_first_visitor + visitors_.size());
    if (is_new) {
        conversation(place->second).visitor = true;
    }
    return place->second;
}

Wire::Conversation& Wire::conversation(std::size_t number) {
    if (number >= conversations_.size()) {
        exit_process(k_broken, "a conversation has a number that nobody gave it");
    }
    std::unique_ptr<Conversation>& talk = conversations_[number];
    if (talk == nullptr) {
        talk = std::make_unique<Conversation>();
    }
    return *talk;
}

std::size_t Wire::begin_message(MessageKind kind) {
    const std::size_t start = outgoing_.size();
    Writer out(outgoing_);
    out.put(static_cast<std::uint16_t>(current()));
    out.put(kind);
    out.put(std::uint32_t{0});
    return start;
}

void Wire::end_message(std::size_t start) {
    const auto size = static_cast<std::uint32_t>(outgoing_.size() - start - k_message_head);
    std::memcpy(&outgoing_[start + k_message_head - sizeof size], &size, sizeof size);
}

Message Wire::receive() {
    if (must_not_ask_) {
        exit_process(k_fault, "a function that answers without asking has asked");
    }
    while (true) {
        {
            const std::unique_lock lock = guard();
            Conversation& talk = conversation(current());
            if (talk.received && !talk.ready) {
                Message message = std::move(*talk.received);
                talk.received.reset();
                talk.waiting = false;
                if (!talk.serves) {
                    thread_stats() += std::exchange(by_visitors_, {});
                }
                return message;
            }
            talk.waiting = true;
            if (talk.visitor || (ready_.empty() && !must_return_to_thread())) {
                exchange();
                continue;
            }
        }
        resume_next();
    }
}

Message Wire::wait_for_answer() {
    while (true) {
        Message message = receive();
        if (message.kind != MessageKind::question) {
            return message;
        }
        answer(message);
    }
}

void Wire::serve() {
    while (true) {
        answer(receive());
    }
}

void Wire::answer(const Message& question) {
    if (question.kind != MessageKind::question) {
        exit_process(k_broken, "an answer came that nobody asked for");
    }
    Conversation& talk = conversation(current());
    if (++talk.depth > k_deepest) {
        exit_process(k_endless, "the functions call each other without end");
    }
    service_(*this, question.bytes);
    --talk.depth;
}

void Wire::run_together(int most, const std::function<void()>& work) {
    if (running_ != 0) {
        work();
        return;
    }
    together_ = ++last_together_;
    std::exception_ptr failed;
    std::size_t started = 0;
    std::size_t ended = 0;
    const auto guarded = [&] {
        try {
            work();
        } catch (...) {
            failed = failed ? failed : std::current_exception();
        }
        ++ended;
    };
    while (std::cmp_less(started, most) && ended == 0) {
        try {
            conversation(started + 1).fiber = std::make_unique<Fiber>(guarded);
        } catch (const std::system_error&) {
            if (started == 0) {
                throw;
            }
            break;  // there is room for fewer
        }
        starts_ = true;
        ready_.push_back(++started);
        resume_next();
    }
    starts_ = false;
    while (ended < started) {
        if (ready_.empty()) {
            exchange();
        } else {
            resume_next();
        }
    }
    for (std::size_t number = 1; number <= started; ++number) {
        conversations_[number].reset();
    }
    together_ = 0;
    if (failed) {
        std::rethrow_exception(failed);
    }
}

/// Lets the next of those that something came for go on: in place of the fiber that calls this, until something comes
/// for that, or until nothing is left to do without the thread that fibers run on.
void Wire::resume_next() {
    Fiber* const self = conversation(running_).fiber.get();
    const std::size_t number = next_ready();
    if (number == 0) {
        switch_conversation(0);
        self->yield();
        return;
    }
    Conversation& next = conversation(number);
    if (may_answer_for(next)) {
        answer_for(next, number);
        return;
    }
    if (next.fiber->ended()) {
        exit_process(k_broken, "an answer came that nobody asked for");
    }
    if (next.fiber.get() == self) {
        return;
    }
    switch_conversation(number);
    if (self != nullptr) {
        self->switch_to(*next.fiber);
    } else {
        next.fiber->resume();
        switch_conversation(0);  // from whichever ran last
    }
}

/// A fiber that waits for an answer, and is asked meanwhile what needs none of its own, sleeps on: to wake it and to
/// let it sleep again would take longer than most answers.
bool Wire::may_answer_for(const Conversation& talk) const {
    return answers_without_asking_ != nullptr && !talk.serves && talk.received &&
           talk.received->kind == MessageKind::question && answers_without_asking_(talk.received->bytes);
}

void Wire::answer_for(Conversation& talk, std::size_t number) {
    const Message question = *std::exchange(talk.received, std::nullopt);
    const std::size_t before = running_;
    switch_conversation(number);
    must_not_ask_ = true;
    service_(*this, question.bytes);
    must_not_ask_ = false;
    switch_conversation(before);
}

/// In the order of sending: what comes first may explain the next. 0 for the thread itself.
std::size_t Wire::next_ready() {
    const std::unique_lock lock = guard();
    if (ready_.empty()) {
        return 0;
    }
    const std::size_t number = ready_.front();
    ready_.pop_front();
    conversation(number).ready = false;
    return number;
}

/// Whether the thread that fibers run on waits for this one to stop: it has more of them to start, or was asked itself.
bool Wire::must_return_to_thread() const {
    return running_ != 0 && (starts_ || (conversations_[0] != nullptr && conversations_[0]->received));
}

/// What the thread has for itself is of this conversation from now on.
void Wire::switch_conversation(std::size_t number) {
    Conversation& before = conversation(running_);
    exchange_thread_with(before);
    if (side_ == Side::home && before.serves) {  // whoever goes on next is charged with it
        by_visitors_ += std::exchange(before.stats, {});
    }
    running_ = number;
    exchange_thread_with(conversation(number));
}

void Wire::exchange_thread_with(Conversation& talk) {
    std::swap(thread_stats(), talk.stats);
    for (std::size_t i = 0; i < thread_memory_.size(); ++i) {
        if (talk.memory.size() == i) {
            talk.memory.push_back(thread_memory_[i].fresh);
        }
        std::swap_ranges(talk.memory[i].begin(), talk.memory[i].end(), thread_memory_[i].bytes.begin());
    }
}

// Both ends send a batch only when they have read the other's: so neither ever waits for a full pipe while the other
// does the same.
void Wire::exchange() {
    if (outgoing_.size() > sizeof(BatchSize)) {
        if (outgoing_.size() - sizeof(BatchSize) > k_max_batch) {
            exit_process(k_too_long, "what was to be said at once is too long");
        }
        const auto size = static_cast<BatchSize>(outgoing_.size() - sizeof(BatchSize));
        std::memcpy(outgoing_.data(), &size, sizeof size);
        write_all(outgoing_);
        outgoing_.resize(sizeof size);
    }
    try {
        deliver(read_batch());
    } catch (const BadMessage& error) {
        exit_process(k_broken, error.what());
    }
}

std::string_view Wire::read_batch() {
    std::size_t have = 0;
    BatchSize size = 0;
    while (have < sizeof size || have < sizeof size + size) {
        const ssize_t got = read(pipes_.in, incoming_.data() + have, incoming_.size() - have);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            exit_process(k_closed, "the other end is gone");
        }
        have += static_cast<std::size_t>(got);
        if (have >= sizeof size) {
            std::memcpy(&size, incoming_.data(), sizeof size);
            if (size > k_max_batch) {  // no end of ours sends that: mostly it is text
                exit_process(k_broken, "a message is too long");
            }
            incoming_.resize(std::max(incoming_.size(), sizeof size + size));
        }
    }
    if (have > sizeof size + size) {
        exit_process(k_broken, "a batch came out of turn");
    }
    return {incoming_.data() + sizeof size, size};
}

void Wire::deliver(std::string_view batch) {
    const std::shared_ptr<char[]> kept(new char[batch.size()]);  // not set to 0 first
    std::memcpy(kept.get(), batch.data(), batch.size());
    Reader reader(std::string_view(kept.get(), batch.size()));
    while (!reader.at_end()) {
        const std::size_t number = reader.get<std::uint16_t>();
        const auto kind = reader.get<MessageKind>();
        Conversation& talk = conversation(number);
        const bool begins = kind == MessageKind::question && talk.fiber == nullptr && may_begin(number);
        if (kind > MessageKind::unwound || talk.received || (side_ == Side::home && !talk.waiting && !begins)) {
            throw BadMessage("a message came that nobody can have sent");
        }
        talk.received = Message{kind, reader.text(), kept};
        if (number == 0 || talk.visitor) {
            continue;
        }
        if (talk.fiber == nullptr) {
            if (kind != MessageKind::question) {
                throw BadMessage("an answer came that nobody asked for");
            }
            talk.fiber = std::make_unique<Fiber>([this] { serve(); });
            talk.serves = true;
        }
        ready_.push_back(number);
        talk.ready = true;
    }
}

/// A box begins conversations for threads of the student's only; those of the program's own it could take for others.
bool Wire::may_begin(std::size_t number) const { return side_ == Side::box || number >= k_first_visitor; }

void Wire::write_all(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(pipes_.out, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            exit_process(k_closed, "the other end is gone");
        }
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

}  // namespace raysteps::remote
