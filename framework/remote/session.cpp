#include "remote/session.hpp"

#include <string>
#include <utility>

namespace raysteps::remote {
namespace {

Session* g_session = nullptr;
bool g_box_counts_surfaces = false;

constexpr std::size_t k_longest_words = 200;  // of an exception

using Services = std::array<Session::Service, static_cast<std::size_t>(FunctionId::count)>;

Services& services() {
    static Services offered{};
    return offered;
}

}  // namespace

bool offer(FunctionId id, Session::Service service) {
    services().at(static_cast<std::size_t>(id)) = service;
    return true;
}

Session::Session(End end, Wire::Pipes pipes, Wire::Farewell farewell) : end_(end), wire_(pipes, answer, farewell) {
    g_session = this;
}

bool Session::box_counts_surfaces() { return g_box_counts_surfaces; }

bool Session::let_box_count_surfaces() { return g_box_counts_surfaces = true; }

Session& Session::current() {
    if (g_session == nullptr) {
        throw std::logic_error("this program has stand-ins for a step, and nobody to ask");
    }
    return *g_session;
}

Message Session::wait_for_answer() {
    Message message = wire_.wait_for_answer();
    switch (message.kind) {
        case Kind::threw:
            throw RemoteException(std::string(message.bytes));
        case Kind::threw_unknown:
            throw RemoteSurprise();
        case Kind::unwound:
            if (end_ == End::box) {
                throw Unwinding();
            }
            if (kept_ == nullptr) {
                broken("an exception came back that never went out");
            }
            std::rethrow_exception(std::exchange(kept_, nullptr));
        default:
            return message;
    }
}

void Session::answer(Wire& wire, std::string_view question) {
    Session& session = current();
    const bool keeps = session.end_ == End::home;
    std::string words;
    Kind kind = Kind::unwound;
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
        kind = Kind::unwound;
    } catch (const std::exception& error) {
        kind = Kind::threw;
        words = std::string(error.what()).substr(0, k_longest_words);
        session.kept_ = std::current_exception();
    } catch (...) {
        kind = Kind::threw_unknown;
        session.kept_ = std::current_exception();
    }
    wire.send(keeps ? Kind::unwound : kind, [&](std::string& out) { out += keeps ? std::string_view() : words; });
}

}  // namespace raysteps::remote
