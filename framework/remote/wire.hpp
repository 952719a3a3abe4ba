#pragma once
// Two pipes, and on them many conversations at once. A conversation is a stack of questions: who is asked may ask back
// before it answers. All that waits is sent together, one batch in each direction in turn: so thousands of questions
// take as long as a few.
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#if __has_include(<sys/single_threaded.h>)
#include <sys/single_threaded.h>
#define RAYSTEPS_TELLS_OF_THREADS 1
#endif

#include "core/stats.hpp"
#include "remote/fiber.hpp"

namespace raysteps::remote {

/// Whether no other thread was started yet, as far as the system tells.
[[nodiscard]] inline bool is_only_thread() {
#ifdef RAYSTEPS_TELLS_OF_THREADS
    return __libc_single_threaded != 0;
#else
    return false;
#endif
}

enum class MessageKind : std::uint8_t {
    question,
    answer,
    threw,          ///< the words of an exception follow
    threw_unknown,  ///< something that is no std::exception was thrown
    unwound,        ///< an exception of the other end's own, which it has kept, went through here
};

/// One that came. Its bytes lie in the batch that it came with.
struct Message {
    MessageKind kind = MessageKind::question;
    std::string_view bytes;
    std::shared_ptr<const char[]> batch;
};

class Wire {
public:
    enum class Side {
        home,  ///< of the program: knows the references, keeps its own exceptions, believes nothing
        box,   ///< of the student's code
    };

    /// The file descriptors that are read and written.
    struct Pipes {
        int in;
        int out;
    };

    /// Writes the answer to a question of the other end, in the conversation in which it was asked.
    using Service = void (*)(Wire& wire, std::string_view question);
    /// Whether the service answers it without a question of its own.
    using AnswersWithoutAsking = bool (*)(std::string_view question);

    /// Ends the program with its exit code, since there is nobody left to talk to: the other end is gone, sent what no
    /// stand-in sends, asks back without end, or has more to say at once than a batch holds.
    static constexpr int k_closed = 70;
    static constexpr int k_broken = 71;
    static constexpr int k_endless = 72;
    static constexpr int k_too_long = 73;
    static constexpr int k_fault = 74;  ///< of the kit, and not of the other end
    using ExitHandler = void (*)(int code, const char* why);

    static constexpr std::size_t k_max_conversations = 1024;

    Wire(Side side, Pipes pipes, Service service, ExitHandler exit_handler,
         AnswersWithoutAsking answers_without_asking = nullptr);

    /// A message of the current conversation: write(bytes) appends what it says. It is sent with all others when
    /// somebody waits.
    template <typename Write>
    void send(MessageKind kind, const Write& write) {
        const std::unique_lock lock = guard();
        const std::size_t start = begin_message(kind);
        try {
            write(outgoing_);
        } catch (...) {
            outgoing_.resize(start);
            throw;
        }
        end_message(start);
    }

    /// The next message of the current conversation that is no question. Questions are answered meanwhile.
    [[nodiscard]] Message wait_for_answer();

    /// Answers questions for ever.
    void serve();

    /// Runs `work` in `most` conversations at once, and waits for all: in fewer if one of them finds nothing left to
    /// do. What leaves one of them is thrown again.
    void run_together(int most, const std::function<void()>& work);

    /// What a thread has for itself: each conversation on a fiber gets one of its own, which begins as `fresh`.
    struct ThreadMemory {
        std::span<char> bytes;  ///< of the thread that fibers run on
        std::string fresh;
    };
    void keep_apart(std::vector<ThreadMemory> memory) { thread_memory_ = std::move(memory); }

    /// The number of the current conversation.
    [[nodiscard]] std::size_t current();

    /// A number of the call of run_together that goes on; 0 for none. What its work is made of does not change
    /// meanwhile.
    [[nodiscard]] std::uint64_t together() const { return together_; }

    [[noreturn]] void exit_process(int code, const char* why);

private:
    struct Conversation {
        std::optional<Message> received;  ///< one at most, for the ends take turns
        std::unique_ptr<Fiber> fiber;     ///< none in that of a thread itself
        Stats stats;                      ///< its own, while it does not run
        std::vector<std::string> memory;  ///< likewise
        int depth = 0;                    ///< questions that are being answered
        bool visitor = false;             ///< of a thread that a student has started
        bool waiting = false;             ///< for a message
        bool ready = false;               ///< in `ready_`: takes what it received when its turn comes, not before
        bool serves = false;              ///< the other end began it
    };

    /// A student may have threads of its own; before the first of them nobody else is here, and nothing of a student's
    /// starts one while a message is written. A program asks and answers from one thread.
    [[nodiscard]] std::unique_lock<std::recursive_mutex> guard() {
        const bool alone = side_ == Side::home || is_only_thread();
        return alone ? std::unique_lock<std::recursive_mutex>() : std::unique_lock(mutex_);
    }
    [[nodiscard]] std::size_t begin_message(MessageKind kind);
    void end_message(std::size_t start);
    [[nodiscard]] Message receive();
    void answer(const Message& question);
    void exchange();
    std::string_view read_batch();
    void deliver(std::string_view batch);
    [[nodiscard]] bool may_begin(std::size_t number) const;
    void answer_for(Conversation& talk, std::size_t number);
    [[nodiscard]] bool may_answer_for(const Conversation& talk) const;
    [[nodiscard]] bool must_return_to_thread() const;
    [[nodiscard]] std::size_t next_ready();
    void switch_conversation(std::size_t number);
    void exchange_thread_with(Conversation& talk);
    void resume_next();
    Conversation& conversation(std::size_t number);
    void write_all(std::string_view bytes);

    Side side_;
    Pipes pipes_;
    Service service_;
    ExitHandler exit_handler_;
    AnswersWithoutAsking answers_without_asking_;
    bool must_not_ask_ = false;
    std::recursive_mutex mutex_;
    std::array<std::unique_ptr<Conversation>, k_max_conversations> conversations_;
    std::deque<std::size_t> ready_;  ///< conversations on fibers that something came for, in that order
    bool starts_ = false;            ///< more fibers, in run_together
    std::uint64_t together_ = 0;
    std::uint64_t last_together_ = 0;
    std::vector<ThreadMemory> thread_memory_;
    Stats by_visitors_;                                ///< tests of conversations that a box began
    std::size_t running_ = 0;                          ///< the conversation of the thread that fibers run on
    std::map<std::thread::id, std::size_t> visitors_;  ///< conversations of other threads
    std::string outgoing_;
    std::vector<char> incoming_;
};

}  // namespace raysteps::remote
