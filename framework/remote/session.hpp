#pragma once
// One end of the wire as the stand-ins see it: asks functions of the other end, and offers its own.
#include <array>
#include <exception>
#include <initializer_list>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "remote/function_ids.hpp"
#include "remote/message.hpp"
#include "remote/wire.hpp"

namespace raysteps::remote {

/// What a student's function threw, in its own words.
class RemoteException : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};
/// A student's function threw what is no std::exception. Neither is this.
struct RemoteSurprise {};
/// An exception of the other end's goes through this one, which must let it pass.
struct Unwinding {};

class Session {
public:
    /// Reads the arguments, calls the function, and sends the result.
    using Service = void (*)(Reader& arguments, Wire& wire);

    using Side = Wire::Side;

    /// A process has one session at most.
    Session(Side side, Wire::Pipes pipes, Wire::ExitHandler exit_handler);
    [[nodiscard]] static Session& current();
    [[nodiscard]] Side side() const { return side_; }
    [[nodiscard]] Wire& wire() { return wire_; }

    /// What the other end says to the question that write(bytes) writes. Throws what the function threw.
    template <typename Write>
    [[nodiscard]] Message ask(const Write& write) {
        wire_.send(MessageKind::question, write);
        return wait_for_answer();
    }

    /// Whether stand-ins for the step that this function is named for are here, or the function for the other end to
    /// ask.
    [[nodiscard]] static bool asks(FunctionId id);
    [[nodiscard]] static bool offers(FunctionId id);

    [[noreturn]] void broken(const char* why) { wire_.exit_process(Wire::k_broken, why); }

private:
    [[nodiscard]] Message wait_for_answer();
    static void answer(Wire& wire, std::string_view question);
    static bool answers_without_asking(std::string_view question);
    void keep_exception();

    Side side_;
    Wire wire_;
    /// At home, by conversation: what went out of a question that the box asked, until it comes back.
    std::unordered_map<std::size_t, std::exception_ptr> kept_;
};

/// Whether this process keeps to that processor from now on.
bool run_on_processor(int processor);

/// Called before main begins, by whoever has the function, or a stand-in for it. Always true. Stand-ins come by steps:
/// one function is named for all of the step's.
bool register_service(FunctionId id, Session::Service service);
bool stand_in(FunctionId id);

/// Of each step with a function that tests of surfaces, or searches of a scene, may call: the one that stands for it.
inline constexpr std::initializer_list<FunctionId> k_called_by_surfaces = {
    FunctionId::point_at,          // 01
    FunctionId::sphere_intersect,  // 02
};
inline constexpr std::initializer_list<FunctionId> k_called_by_searches = {
    FunctionId::point_at,          // 01
    FunctionId::sphere_intersect,  // 02
    FunctionId::box_clip,          // 06
    FunctionId::surface_area,      // 09
    FunctionId::barycentric,       // 11: what is met is a mesh's
};

/// That the offered function calls none of the steps' functions but those of these steps. Always true.
bool calls_only(FunctionId id, std::initializer_list<FunctionId> steps);

}  // namespace raysteps::remote
