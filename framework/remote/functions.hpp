#pragma once
// A function of the other end, called as if it were here; and a function of this end, called from there.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "remote/lent.hpp"
#include "remote/serializer.hpp"
#include "remote/session.hpp"
#include "remote/textures.hpp"
#include "remote/trees.hpp"

namespace raysteps::remote {

/// How a parameter travels. send: writes it, and gives what has to exist while the question is open. Received is what
/// it becomes at the other end, where `give` makes the parameter of it.
template <typename P>
struct Parameter {
    using Received = std::remove_cvref_t<P>;
    static int send(Writer& out, const Received& value) {
        write(out, value);
        return 0;
    }
    static Received receive(Reader& in) { return read<Received>(in); }
    // NOLINTNEXTLINE(bugprone-return-const-ref-from-parameter): what was received outlives the call
    static const Received& give(const Received& value) { return value; }
};

template <>
struct Parameter<const SceneQuery&> {
    using Received = ReceivedQuery;
    static auto send(Writer& out, const SceneQuery& query) { return write_query(out, query); }
    static Received receive(Reader& in) { return read_query(in); }
    static const SceneQuery& give(const Received& received) { return *received.query; }
};

template <>
struct Parameter<Tracer&> {
    using Received = ReceivedTracer;
    static auto send(Writer& out, Tracer& tracer) { return write_tracer(out, tracer); }
    static Received receive(Reader& in) { return read_tracer(in); }
    static Tracer& give(const Received& received) { return *received.tracer; }
};

template <>
struct Parameter<PathTracer&> {
    using Received = ReceivedPathTracer;
    static auto send(Writer& out, PathTracer& tracer) { return write_path_tracer(out, tracer); }
    static Received receive(Reader& in) { return read_path_tracer(in); }
    static PathTracer& give(const Received& received) { return *received.tracer; }
};

template <>
struct Parameter<MisTracer&> {
    using Received = ReceivedMisTracer;
    static auto send(Writer& out, MisTracer& tracer) { return write_mis_tracer(out, tracer); }
    static Received receive(Reader& in) { return read_mis_tracer(in); }
    static MisTracer& give(const Received& received) { return *received.tracer; }
};

template <typename T>
struct Parameter<std::span<const T>> {
    using Received = std::vector<T>;
    static int send(Writer& out, std::span<const T> values) {
        Serializer<Received>::write(out, values);
        return 0;
    }
    static Received receive(Reader& in) { return read<Received>(in); }
    static std::span<const T> give(const Received& values) { return values; }
};

/// A copy travels, and none comes back: whoever asks gives each question a stream of its own.
template <>
struct Parameter<RandomStream&> {
    using Received = std::unique_ptr<RandomStream>;
    static int send(Writer& out, const RandomStream& random) {
        write(out, random);
        return 0;
    }
    static Received receive(Reader& in) { return std::make_unique<RandomStream>(read<RandomStream>(in)); }
    static RandomStream& give(const Received& random) { return *random; }
};

template <typename T>
struct KnownParameter {
    using Received = std::shared_ptr<const T>;
    static int send(Writer& out, const T& value) {
        ValueCache<T>::all().write(out, value, Session::current().wire().together());
        return 0;
    }
    static Received receive(Reader& in) { return ValueCache<T>::all().read(in); }
    static const T& give(const Received& value) { return *value; }
};
template <>
struct Parameter<const Texture&> : KnownParameter<Texture> {};
template <>
struct Parameter<const Pyramid&> : KnownParameter<Pyramid> {};

template <>
struct Parameter<const SurfaceList&> {
    using Received = ReceivedSurfaces;
    static Loan send(Writer& out, const SurfaceList& surfaces) { return write_surfaces(out, surfaces); }
    static Received receive(Reader& in) { return read_surfaces(in); }
    static const SurfaceList& give(const Received& received) {
        return received.copies == nullptr ? received.own : received.copies->scene.surfaces();
    }
};

/// Surfaces that the other end makes copies of, whoever has them.
struct ToCopy {
    const SurfaceList& surfaces;
};
template <>
struct Parameter<const ToCopy&> {
    using Received = std::shared_ptr<CopiedGroup>;
    static Loan send(Writer& out, const ToCopy& list) { return Loan(Groups::all().write(out, list.surfaces)); }
};

template <typename Tree>
struct Parameter<const Search<Tree>&> {
    using Received = ReceivedSearch<Tree>;
    static LentTree send(Writer& out, const Search<Tree>& search) { return write_search(out, search); }
    static Received receive(Reader& in) { return read_search<Tree>(in); }
    static const Search<Tree>& give(const Received& received) { return received.search; }
};

/// A box that has step 02 tests spheres and triangles itself, and is believed: there a wrong count wins nothing. All
/// other tests of surfaces are counted where they are made. The boxes of step 06 are shown, but not graded.
inline void add_counts(Reader& in) {
    const auto surface_tests = in.get<std::uint32_t>();
    thread_stats().box_tests += in.get<std::uint32_t>();
    thread_stats().surface_tests += Session::asks(FunctionId::sphere_intersect) ? surface_tests : 0;
}

/// What this end has counted since it was last asked. A program keeps its own counts.
inline void write_counts(Writer& out) {
    Stats& stats = thread_stats();
    const bool tells = Session::current().side() == Session::Side::box;
    out.put(static_cast<std::uint32_t>(tells ? std::exchange(stats.surface_tests, 0) : 0));
    out.put(static_cast<std::uint32_t>(tells ? std::exchange(stats.box_tests, 0) : 0));
}

/// Sends what write(out) writes.
template <typename Write>
void send_answer(Wire& wire, const Write& write_result) {
    wire.send(MessageKind::answer, [&](std::string& bytes) {
        Writer out(bytes);
        write_counts(out);
        write_result(out);
    });
}

/// Asks the other end and hands its words to `read_result`.
template <typename... Parameters, typename ReadResult>
auto ask_and_read(FunctionId id, const ReadResult& read_result, std::type_identity_t<Parameters>... values) {
    Session& session = Session::current();
    using Open = std::tuple<decltype(Parameter<Parameters>::send(std::declval<Writer&>(), values))...>;
    std::optional<Open> open;
    const Message answer = session.ask([&](std::string& bytes) {
        Writer out(bytes);
        out.put(id);
        open.emplace(Open{Parameter<Parameters>::send(out, values)...});
    });
    try {
        Reader in(answer.bytes);
        add_counts(in);
        return read_result(in, *open);
    } catch (const BadMessage& error) {
        session.broken(error.what());
    }
}

/// ask<Result, Parameter...>(id, value...)
template <typename Result, typename... Parameters>
Result ask(FunctionId id, std::type_identity_t<Parameters>... values) {
    const auto read_result = [](Reader& in, const auto& /*open*/) { return read<Result>(in); };
    return ask_and_read<Parameters...>(id, read_result, values...);
}

template <typename Result, typename... Parameters>
Result ask_as(Result (* /*type*/)(Parameters...), FunctionId id, std::type_identity_t<Parameters>... values) {
    return ask<Result, Parameters...>(id, values...);
}
template <typename Class, typename Result, typename... Parameters>
Result ask_as(Result (Class::* /*type*/)(Parameters...) const, FunctionId id, const Class& self,
              std::type_identity_t<Parameters>... values) {
    return ask<Result, const Class&, Parameters...>(id, self, values...);
}

/// ask<&point_at>(FunctionId::point_at, ray, distance): a stand-in asks for the function that it stands for. Members
/// are asked with their object first.
template <auto Function, typename... Values>
auto ask(FunctionId id, Values&... values) {
    return ask_as(Function, id, values...);
}

template <typename Call, typename... Parameters>
void call_with(Reader& in, const Call& call, std::tuple<Parameters...>* /*types*/) {
    const std::tuple<typename Parameter<Parameters>::Received...> received{Parameter<Parameters>::receive(in)...};
    std::apply([&](const auto&... one) { call(Parameter<Parameters>::give(one)...); }, received);
}

template <typename Result>
void send_result(Wire& wire, const Result& result) {
    send_answer(wire, [&](Writer& out) { write<Result>(out, result); });
}

template <auto Function>
struct ServiceOf;

template <typename Result, typename... Parameters, Result (*Function)(Parameters...)>
struct ServiceOf<Function> {
    static void serve(Reader& in, Wire& wire) {
        call_with(
            in, [&](Parameters... values) { send_result<Result>(wire, Function(std::forward<Parameters>(values)...)); },
            static_cast<std::tuple<Parameters...>*>(nullptr));
    }
};

template <typename Class, typename Result, typename... Parameters, Result (Class::*Function)(Parameters...) const>
struct ServiceOf<Function> {
    static void serve(Reader& in, Wire& wire) {
        call_with(
            in,
            [&](const Class& self, Parameters... values) { send_result<Result>(wire, (self.*Function)(values...)); },
            static_cast<std::tuple<const Class&, Parameters...>*>(nullptr));
    }
};

/// offer_function<&point_at>(FunctionId::point_at): the other end may call it. Always true.
template <auto Function>
bool offer_function(FunctionId id) {
    return register_service(id, &ServiceOf<Function>::serve);
}

}  // namespace raysteps::remote
