#pragma once
// What a question lends for as long as it is open: the scene, the tracer, surfaces. The other end holds stand-ins for
// them, which ask back.
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/mis_tracer.hpp"
#include "core/tracer.hpp"
#include "remote/groups.hpp"
#include "remote/message.hpp"

namespace raysteps::remote {

using LentId = std::uint32_t;

/// While it exists, the other end may ask this scene, which may be a Tracer, a PathTracer or a MisTracer, too.
class QueryLoan {
public:
    explicit QueryLoan(const SceneQuery& query, Tracer* tracer = nullptr, PathTracer* path_tracer = nullptr,
                       MisTracer* mis_tracer = nullptr);
    QueryLoan(const QueryLoan&) = delete;
    QueryLoan& operator=(const QueryLoan&) = delete;
    ~QueryLoan();

    [[nodiscard]] LentId id() const { return id_; }

private:
    LentId id_;
};

/// Writes which scene is meant: one that is lent with this question, or one that the other end has lent itself.
[[nodiscard]] std::unique_ptr<QueryLoan> write_query(Writer& out, const SceneQuery& query);
[[nodiscard]] std::unique_ptr<QueryLoan> write_tracer(Writer& out, Tracer& tracer);
[[nodiscard]] std::unique_ptr<QueryLoan> write_path_tracer(Writer& out, PathTracer& tracer);
[[nodiscard]] std::unique_ptr<QueryLoan> write_mis_tracer(Writer& out, MisTracer& tracer);

/// A scene as it came with a question: a stand-in, or an own one that came back.
struct ReceivedQuery {
    std::unique_ptr<SceneQuery> stand_in;
    const SceneQuery* query = nullptr;
    std::optional<UseGuard> use;  ///< of an own one
};
struct ReceivedTracer {
    std::unique_ptr<Tracer> stand_in;
    Tracer* tracer = nullptr;
    std::optional<UseGuard> use;
};
struct ReceivedPathTracer {
    std::unique_ptr<PathTracer> stand_in;
    PathTracer* tracer = nullptr;
    std::optional<UseGuard> use;
};
struct ReceivedMisTracer {
    std::unique_ptr<MisTracer> stand_in;
    MisTracer* tracer = nullptr;
    std::optional<UseGuard> use;
};
[[nodiscard]] ReceivedQuery read_query(Reader& in);
[[nodiscard]] ReceivedTracer read_tracer(Reader& in);
[[nodiscard]] ReceivedPathTracer read_path_tracer(Reader& in);
[[nodiscard]] ReceivedMisTracer read_mis_tracer(Reader& in);

/// Surfaces as they came with a question: copies, or own ones that the other end has copies of.
struct ReceivedSurfaces {
    std::shared_ptr<CopiedGroup> copies;
    SurfaceList own;
    std::vector<UseGuard> uses;
};
[[nodiscard]] Loan write_surfaces(Writer& out, const SurfaceList& surfaces);
[[nodiscard]] ReceivedSurfaces read_surfaces(Reader& in);

/// Of the surface that this copy stands for. Counted at the end that has it, as one surface test.
[[nodiscard]] std::optional<HitRecord> ask_hit(const Surface& copy, const Ray& ray);
[[nodiscard]] bool ask_overlaps(const Surface& copy, const Box& box);

}  // namespace raysteps::remote
