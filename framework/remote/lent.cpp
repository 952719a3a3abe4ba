#include "remote/lent.hpp"

#include <unordered_map>
#include <utility>

#include "remote/functions.hpp"

namespace raysteps::remote {
namespace {

struct Lent {
    const SceneQuery* query = nullptr;
    Tracer* tracer = nullptr;
    PathTracer* path_tracer = nullptr;
    MisTracer* mis_tracer = nullptr;
    UseCount uses;
};

std::unordered_map<LentId, Lent>& lent_queries() {
    static std::unordered_map<LentId, Lent> open;
    return open;
}

Lent& lent(LentId id) {
    const auto found = lent_queries().find(id);
    if (found == lent_queries().end()) {
        throw BadMessage("a scene was asked that no open question has lent");
    }
    return found->second;
}

Tracer& lent_tracer(LentId id) {
    Tracer* tracer = lent(id).tracer;
    if (tracer == nullptr) {
        throw BadMessage("a scene was asked what only a tracer knows");
    }
    return *tracer;
}

PathTracer& lent_path_tracer(LentId id) {
    PathTracer* tracer = lent(id).path_tracer;
    if (tracer == nullptr) {
        throw BadMessage("a scene was asked what only the tracer of paths knows");
    }
    return *tracer;
}

MisTracer& lent_mis_tracer(LentId id) {
    MisTracer* tracer = lent(id).mis_tracer;
    if (tracer == nullptr) {
        throw BadMessage("a scene was asked what only the tracer of step 15 knows");
    }
    return *tracer;
}

/// Stands for what the other end has lent.
class FarQuery final : public SceneQuery {
public:
    explicit FarQuery(LentId id) : id_(id) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return ask<std::optional<HitRecord>, LentId, Ray>(FunctionId::lent_closest_hit, id_, ray);
    }
    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return ask<bool, LentId, Ray, float>(FunctionId::lent_occluded, id_, ray, distance);
    }
    [[nodiscard]] LentId id() const { return id_; }

private:
    LentId id_;
};

class FarTracer final : public Tracer {
public:
    FarTracer(LentId id, int max_ray_depth, const Color& background)
        : scene_(id), max_ray_depth_(max_ray_depth), background_(background) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return scene_.closest_hit(ray);
    }
    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return scene_.occluded(ray, distance);
    }
    [[nodiscard]] Color direct_lighting(const HitRecord& hit, int depth) override {
        return ask<Color, LentId, HitRecord, int>(FunctionId::lent_direct_lighting, id(), hit, depth);
    }
    [[nodiscard]] Color trace(const Ray& ray, int depth) override {
        return ask<Color, LentId, Ray, int>(FunctionId::lent_trace, id(), ray, depth);
    }
    [[nodiscard]] int max_ray_depth() const override { return max_ray_depth_; }
    [[nodiscard]] Color background() const override { return background_; }
    [[nodiscard]] LentId id() const { return scene_.id(); }

private:
    FarQuery scene_;
    int max_ray_depth_;
    Color background_;
};

/// Of step 13, or of step 15: the other end knows which.
class FarPathTracer final : public MisTracer {
public:
    FarPathTracer(LentId id, const Color& background) : scene_(id), background_(background) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return scene_.closest_hit(ray);
    }
    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return scene_.occluded(ray, distance);
    }
    [[nodiscard]] Color light_sample(const HitRecord& hit) override {
        return ask<Color, LentId, HitRecord>(FunctionId::lent_light_sample, id(), hit);
    }
    [[nodiscard]] std::optional<ScatterSample> scatter(const HitRecord& hit) override {
        return ask<std::optional<ScatterSample>, LentId, HitRecord>(FunctionId::lent_scatter, id(), hit);
    }
    [[nodiscard]] std::vector<DirectSample> direct_samples(const HitRecord& hit) override {
        return ask<std::vector<DirectSample>, LentId, HitRecord>(FunctionId::lent_direct_samples, id(), hit);
    }
    [[nodiscard]] float light_pdf(const glm::vec3& from, const HitRecord& hit) const override {
        return ask<float, LentId, glm::vec3, HitRecord>(FunctionId::lent_light_pdf, id(), from, hit);
    }
    [[nodiscard]] Color background() const override { return background_; }
    [[nodiscard]] LentId id() const { return scene_.id(); }

private:
    FarQuery scene_;
    Color background_;
};

std::optional<LentId> id_of_other_end(const SceneQuery& query) {
    if (const auto* far = dynamic_cast<const FarQuery*>(&query)) {
        return far->id();
    }
    if (const auto* far = dynamic_cast<const FarPathTracer*>(&query)) {
        return far->id();
    }
    const auto* far = dynamic_cast<const FarTracer*>(&query);
    return far == nullptr ? std::nullopt : std::optional(far->id());
}

/// What the other end may ask of what it was lent.
std::optional<HitRecord> closest_hit_of(LentId id, const Ray& ray) {
    const UseGuard use(lent(id).uses);
    return lent(id).query->closest_hit(ray);
}
bool occluded_of(LentId id, const Ray& ray, float distance) {
    const UseGuard use(lent(id).uses);
    return lent(id).query->occluded(ray, distance);
}
Color direct_lighting_of(LentId id, const HitRecord& hit, int depth) {
    const UseGuard use(lent(id).uses);
    return lent_tracer(id).direct_lighting(hit, depth);
}
Color trace_of(LentId id, const Ray& ray, int depth) {
    const UseGuard use(lent(id).uses);
    return lent_tracer(id).trace(ray, depth);
}
Color light_sample_of(LentId id, const HitRecord& hit) {
    const UseGuard use(lent(id).uses);
    return lent_path_tracer(id).light_sample(hit);
}
std::optional<ScatterSample> scatter_of(LentId id, const HitRecord& hit) {
    const UseGuard use(lent(id).uses);
    return lent_path_tracer(id).scatter(hit);
}
std::vector<DirectSample> direct_samples_of(LentId id, const HitRecord& hit) {
    const UseGuard use(lent(id).uses);
    return lent_mis_tracer(id).direct_samples(hit);
}
float light_pdf_of(LentId id, const glm::vec3& from, const HitRecord& hit) {
    const UseGuard use(lent(id).uses);
    return lent_mis_tracer(id).light_pdf(from, hit);
}
std::optional<HitRecord> hit_of(GroupId group, std::uint32_t index, const Ray& ray) {
    const UseGuard use = Groups::all().use(group);
    return Groups::all().lent({group, index}).hit(ray);
}
bool overlaps_of(GroupId group, std::uint32_t index, const Box& box) {
    const UseGuard use = Groups::all().use(group);
    return Groups::all().lent({group, index}).overlaps(box);
}

[[maybe_unused]] const bool offered_one_by_one =
    offer_function<&closest_hit_of>(FunctionId::lent_closest_hit) &&
    offer_function<&occluded_of>(FunctionId::lent_occluded) &&
    offer_function<&direct_lighting_of>(FunctionId::lent_direct_lighting) &&
    offer_function<&trace_of>(FunctionId::lent_trace) &&
    offer_function<&light_sample_of>(FunctionId::lent_light_sample) &&
    offer_function<&scatter_of>(FunctionId::lent_scatter) &&
    offer_function<&direct_samples_of>(FunctionId::lent_direct_samples) &&
    offer_function<&light_pdf_of>(FunctionId::lent_light_pdf) &&
    offer_function<&hit_of>(FunctionId::lent_surface_hit) &&
    offer_function<&overlaps_of>(FunctionId::lent_surface_overlaps);

[[maybe_unused]] const bool answered_alone = calls_only(FunctionId::lent_closest_hit, k_called_by_searches) &&
                                             calls_only(FunctionId::lent_occluded, k_called_by_searches) &&
                                             calls_only(FunctionId::lent_surface_hit, k_called_by_surfaces);

SurfaceRef place_of(const Surface& copy) {
    const SurfaceRef* place = Groups::all().place_of(&copy);
    if (place == nullptr) {
        throw std::logic_error("this surface is no copy of one of the other end's");
    }
    return *place;
}

/// Where the other end has what these surfaces are copies of; nothing if some are not.
std::vector<SurfaceRef> places_of(const SurfaceList& surfaces) {
    std::vector<SurfaceRef> places;
    for (const Surface* surface : surfaces) {
        if (const auto* entry = dynamic_cast<const LeafEntry*>(surface)) {
            places.push_back(entry->place());
        } else if (const SurfaceRef* place = Groups::all().place_of(surface)) {
            places.push_back(*place);
        } else {
            return {};
        }
    }
    return places;
}

std::unique_ptr<QueryLoan> write_paths(Writer& out, PathTracer& tracer, MisTracer* mis_tracer) {
    const std::optional<LentId> known = id_of_other_end(tracer);
    auto loan = known ? nullptr : std::make_unique<QueryLoan>(tracer, nullptr, &tracer, mis_tracer);
    out.put(known.has_value());
    out.put(known ? *known : loan->id());
    write(out, tracer.background());
    return loan;
}

template <typename Received>
Received read_paths(Reader& in, auto& (*lent_one)(LentId)) {
    const bool own = in.get<bool>();
    const auto id = in.get<LentId>();
    const auto background = read<Color>(in);
    if (own) {
        return {nullptr, &lent_one(id), UseGuard(lent(id).uses)};
    }
    auto stand_in = std::make_unique<FarPathTracer>(id, background);
    FarPathTracer* tracer = stand_in.get();
    return {std::move(stand_in), tracer, std::nullopt};
}

}  // namespace

QueryLoan::QueryLoan(const SceneQuery& query, Tracer* tracer, PathTracer* path_tracer, MisTracer* mis_tracer) {
    static LentId last = 0;
    id_ = ++last;
    lent_queries()[id_] = {
        .query = &query, .tracer = tracer, .path_tracer = path_tracer, .mis_tracer = mis_tracer, .uses = {}};
}

QueryLoan::~QueryLoan() {
    const auto own = lent_queries().find(id_);
    own->second.uses.require_none();
    lent_queries().erase(own);
}

std::unique_ptr<QueryLoan> write_query(Writer& out, const SceneQuery& query) {
    const std::optional<LentId> known = id_of_other_end(query);
    auto loan = known ? nullptr : std::make_unique<QueryLoan>(query);
    out.put(known.has_value());
    out.put(known ? *known : loan->id());
    return loan;
}

std::unique_ptr<QueryLoan> write_tracer(Writer& out, Tracer& tracer) {
    const std::optional<LentId> known = id_of_other_end(tracer);
    auto loan = known ? nullptr : std::make_unique<QueryLoan>(tracer, &tracer);
    out.put(known.has_value());
    out.put(known ? *known : loan->id());
    out.put(tracer.max_ray_depth());
    write(out, tracer.background());
    return loan;
}

std::unique_ptr<QueryLoan> write_path_tracer(Writer& out, PathTracer& tracer) {
    return write_paths(out, tracer, nullptr);
}

std::unique_ptr<QueryLoan> write_mis_tracer(Writer& out, MisTracer& tracer) {
    return write_paths(out, tracer, &tracer);
}

ReceivedQuery read_query(Reader& in) {
    const bool own = in.get<bool>();
    const auto id = in.get<LentId>();
    if (own) {
        return {nullptr, lent(id).query, UseGuard(lent(id).uses)};
    }
    auto stand_in = std::make_unique<FarQuery>(id);
    const SceneQuery* query = stand_in.get();
    return {std::move(stand_in), query, std::nullopt};
}

ReceivedTracer read_tracer(Reader& in) {
    const bool own = in.get<bool>();
    const auto id = in.get<LentId>();
    const auto max_ray_depth = in.get<int>();
    const auto background = read<Color>(in);
    if (own) {
        return {nullptr, &lent_tracer(id), UseGuard(lent(id).uses)};
    }
    auto stand_in = std::make_unique<FarTracer>(id, max_ray_depth, background);
    Tracer* tracer = stand_in.get();
    return {std::move(stand_in), tracer, std::nullopt};
}

ReceivedPathTracer read_path_tracer(Reader& in) { return read_paths<ReceivedPathTracer>(in, lent_path_tracer); }

ReceivedMisTracer read_mis_tracer(Reader& in) { return read_paths<ReceivedMisTracer>(in, lent_mis_tracer); }

Loan write_surfaces(Writer& out, const SurfaceList& surfaces) {
    const std::vector<SurfaceRef> places = places_of(surfaces);
    out.put(!places.empty());
    if (places.empty()) {
        return Loan(Groups::all().write(out, surfaces, Session::current().wire().together()));
    }
    out.put(static_cast<std::uint32_t>(places.size()));
    for (const SurfaceRef place : places) {
        out.put(place.group);
        out.put(place.index);
    }
    return {};
}

ReceivedSurfaces read_surfaces(Reader& in) {
    if (!in.get<bool>()) {
        return {Groups::all().read(in), {}, {}};
    }
    ReceivedSurfaces received;
    GroupId last = 0;
    received.own.resize(in.count(sizeof(SurfaceRef)));
    for (const Surface*& surface : received.own) {
        const auto group = in.get<GroupId>();
        if (std::exchange(last, group) != group) {
            received.uses.push_back(Groups::all().use(group));
        }
        surface = &Groups::all().lent({group, in.get<std::uint32_t>()});
    }
    return received;
}

std::optional<HitRecord> ask_hit(const Surface& copy, const Ray& ray) {
    const SurfaceRef place = place_of(copy);
    return ask<std::optional<HitRecord>, GroupId, std::uint32_t, Ray>(FunctionId::lent_surface_hit, place.group,
                                                                      place.index, ray);
}

bool ask_overlaps(const Surface& copy, const Box& box) {
    const SurfaceRef place = place_of(copy);
    return ask<bool, GroupId, std::uint32_t, Box>(FunctionId::lent_surface_overlaps, place.group, place.index, box);
}

}  // namespace raysteps::remote
