#include "remote/session.hpp"

#ifdef __linux__
#include <sched.h>
#endif
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raysteps::remote {
namespace {

Session* g_session = nullptr;

constexpr std::size_t k_longest_words = 200;  // of an exception

/// Of each function: before main begins, whatever comes first makes it.
template <typename T>
using OfEach = std::array<T, static_cast<std::size_t>(FunctionId::count)>;

OfEach<Session::Service>& services() {
    static OfEach<Session::Service> offered{};
    return offered;
}
OfEach<bool>& stand_ins() {
    static OfEach<bool> asked{};
    return asked;
}
/// Nothing is known of the calls of most.
OfEach<std::optional<std::vector<FunctionId>>>& calls() {
    static OfEach<std::optional<std::vector<FunctionId>>> of_each{};
    return of_each;
}

}  // namespace

bool register_service(FunctionId id, Session::Service service) {
    services().at(static_cast<std::size_t>(id)) = service;
    return true;
}

bool stand_in(FunctionId id) { return stand_ins().at(static_cast<std::size_t>(id)) = true; }

bool calls_only(FunctionId id, std::initializer_list<FunctionId> steps) {
    calls().at(static_cast<std::size_t>(id)) = steps;
    return true;
}

Session::Session(Side side, Wire::Pipes pipes, Wire::ExitHandler exit_handler)
    : side_(side), wire_(side, pipes, answer, exit_handler, side == Side::home ? answers_without_asking : nullptr) {
    g_session = this;
}

bool run_on_processor(int processor) {
#ifdef __linux__
    cpu_set_t one;
    CPU_ZERO(&one);
    if (processor < 0 || processor >= CPU_SETSIZE) {
        return false;
    }
    CPU_SET(static_cast<unsigned>(processor), &one);
    return sched_setaffinity(0, sizeof one, &one) == 0;
#else
    static_cast<void>(processor);
    return false;
#endif
}

bool Session::asks(FunctionId id) { return stand_ins().at(static_cast<std::size_t>(id)); }

bool Session::offers(FunctionId id) { return services().at(static_cast<std::size_t>(id)) != nullptr; }

Session& Session::current() {
    if (g_session == nullptr) {
        throw std::logic_error("this program has stand-ins for a step, and nobody to ask");
    }
    return *g_session;
}

Message Session::wait_for_answer() {
    Message message = wire_.wait_for_answer();
    switch (message.kind) {
        case MessageKind::threw:
            throw RemoteException(std::string(message.bytes));
        case MessageKind::threw_unknown:
            throw RemoteSurprise();  // NOLINT(bugprone-std-exception-baseclass): so was what it stands for
        case MessageKind::unwound:
            if (side_ == Side::box) {
                throw Unwinding();  // NOLINT(bugprone-std-exception-baseclass): nobody is to catch it
            }
            if (kept_[wire_.current()] == nullptr) {
                broken("an exception came back that never went out");
            }
            std::rethrow_exception(std::exchange(kept_[wire_.current()], nullptr));
        default:
            return message;
    }
}

void Session::keep_exception() {
    if (side_ == Side::home) {
        kept_[wire_.current()] = std::current_exception();
    }
}

/// No stand-in is here for what it may call. All of them have said so when the first question comes.
bool Session::answers_without_asking(std::string_view question) {
    static const OfEach<bool> alone = [] {
        OfEach<bool> of_each{};
        std::transform(calls().begin(), calls().end(), of_each.begin(),
                       [](const auto& called) { return called && std::none_of(called->begin(), called->end(), asks); });
        return of_each;
    }();
    const auto id = question.empty() ? alone.size() : static_cast<unsigned char>(question.front());
    return id < alone.size() && alone[id];
}

void Session::answer(Wire& wire, std::string_view question) {
    Session& session = current();
    const bool keeps = session.side_ == Side::home;
    std::string words;
    MessageKind kind = MessageKind::unwound;
    try {
        Reader reader(question);
        const auto id = static_cast<std::size_t>(reader.get<FunctionId>());
        const Service service = id < services().size() ? services()[id] : nullptr;
        if (service == nullptr) {
            throw BadMessage("there is no such function at this end");
        }
        service(reader, wire);
        return;
    } catch (const BadMessage& error) {
        session.broken(error.what());
    } catch (const Unwinding&) {
        kind = MessageKind::unwound;
    } catch (const std::exception& error) {
        kind = MessageKind::threw;
        words = std::string(error.what()).substr(0, k_longest_words);
        session.keep_exception();
    } catch (...) {
        kind = MessageKind::threw_unknown;
        session.keep_exception();
    }
    wire.send(keeps ? MessageKind::unwound : kind,
              [&](std::string& out) { out += keeps ? std::string_view() : words; });
}

}  // namespace raysteps::remote
