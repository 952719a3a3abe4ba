#include "bench/embree_accelerator.hpp"

#if RAYSTEPS_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>
#include <atomic>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "bench/foreign_hit.hpp"
#include "core/smooth_triangle.hpp"
#include "core/sphere.hpp"

namespace raysteps::bench {

const char* const k_embree_version = RTC_VERSION_STRING;

namespace {

template <auto release>
struct Releaser {
    template <typename Handle>
    void operator()(Handle* handle) const {
        release(handle);
    }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Releaser<rtcReleaseDevice>>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Releaser<rtcReleaseScene>>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Releaser<rtcReleaseGeometry>>;

/// The kit's surfaces by what Embree makes of them. Each list is one geometry; place in the list is Embree's primID.
enum Kind : unsigned { k_flat, k_smooth, k_sphere, k_other, k_kinds };

// The two versions ask in different ways.
#if RAYSTEPS_EMBREE == 4
using QueryContext = RTCRayQueryContext;

void begin(QueryContext& context) { rtcInitRayQueryContext(&context); }

void intersect_one(RTCScene scene, QueryContext& context, RTCRayHit& asked) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &asked, &arguments);
}

void occluded_one(RTCScene scene, QueryContext& context, RTCRay& asked) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &asked, &arguments);
}
#else
using QueryContext = RTCIntersectContext;

void begin(QueryContext& context) { rtcInitIntersectContext(&context); }

void intersect_one(RTCScene scene, QueryContext& context, RTCRayHit& asked) { rtcIntersect1(scene, &context, &asked); }

void occluded_one(RTCScene scene, QueryContext& context, RTCRay& asked) { rtcOccluded1(scene, &context, &asked); }
#endif

/// What goes along with one question, and what a callback of Embree's finds in it.
struct Context {
    QueryContext embree;  // first: callbacks get its address
    Ray ray;
    HitRecord hit;  ///< of the nearest surface of kind other so far
};

Kind kind_of(const Surface& surface) {
    return std::visit(ByShape{[](const Triangle*) { return k_flat; }, [](const SmoothTriangle*) { return k_smooth; },
                              [](const Sphere*) { return k_sphere; }, [](const InwardSphere*) { return k_other; },
                              [](const MeshTriangle*) { return k_other; }, [](const Cone*) { return k_other; },
                              [](const Disk*) { return k_other; }, [](std::monostate) { return k_other; }},
                      surface.shape());
}

const Surface& surface_at(const void* list, unsigned place) { return *(*static_cast<const SurfaceList*>(list))[place]; }

void bounds_callback(const RTCBoundsFunctionArguments* args) {
    const Box box = surface_at(args->geometryUserPtr, args->primID).bounds();
    RTCBounds& bounds = *args->bounds_o;
    bounds.lower_x = box.min.x;
    bounds.lower_y = box.min.y;
    bounds.lower_z = box.min.z;
    bounds.upper_x = box.max.x;
    bounds.upper_y = box.max.y;
    bounds.upper_z = box.max.z;
}

void intersect_callback(const RTCIntersectFunctionNArguments* args) {
    auto& context = *reinterpret_cast<Context*>(args->context);
    auto& answer = *reinterpret_cast<RTCRayHit*>(args->rayhit);  // single rays only: N is 1
    const auto hit = surface_at(args->geometryUserPtr, args->primID).hit(context.ray);
    if (args->valid[0] == 0 || !hit || !(hit->distance < answer.ray.tfar)) {
        return;
    }
    answer.ray.tfar = hit->distance;
    answer.hit.geomID = args->geomID;
    answer.hit.primID = args->primID;
    context.hit = *hit;
}

void occluded_callback(const RTCOccludedFunctionNArguments* args) {
    const auto& context = *reinterpret_cast<const Context*>(args->context);
    auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
    const auto hit = surface_at(args->geometryUserPtr, args->primID).hit(context.ray);
    if (args->valid[0] != 0 && hit && hit->distance < ray.tfar) {
        ray.tfar = -std::numeric_limits<float>::infinity();
    }
}

RTCRay embree_ray(const Ray& ray, float far) {
    RTCRay made{};
    made.org_x = ray.origin.x;
    made.org_y = ray.origin.y;
    made.org_z = ray.origin.z;
    made.dir_x = ray.direction.x;
    made.dir_y = ray.direction.y;
    made.dir_z = ray.direction.z;
    made.tfar = far;
    made.mask = ~0U;
    return made;
}

class EmbreeAccelerator final : public Accelerator {
public:
    EmbreeAccelerator(const SurfaceList& surfaces, EmbreeMode mode) : device_(rtcNewDevice("threads=1")) {
        if (!device_) {
            throw std::runtime_error("Embree cannot start");
        }
        rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, &bytes_);
        scene_.reset(rtcNewScene(device_.get()));
        rtcSetSceneFlags(scene_.get(), mode == EmbreeMode::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
        rtcSetSceneBuildQuality(scene_.get(),
                                mode == EmbreeMode::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
        for (const Surface* surface : surfaces) {
            lists_[kind_of(*surface)].push_back(surface);
        }
        attach_triangles(k_flat);
        attach_triangles(k_smooth);
        attach_spheres();
        attach_others();
        rtcCommitScene(scene_.get());
        if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
            throw std::runtime_error("Embree reports error " + std::to_string(error));
        }
    }

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        Context context = context_of(ray);
        RTCRayHit answer{embree_ray(ray, std::numeric_limits<float>::infinity()), {}};
        answer.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        intersect_one(scene_.get(), context.embree, answer);
        if (answer.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            return std::nullopt;
        }
        return answer.hit.geomID == k_other ? context.hit : record(ray, answer);
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        Context context = context_of(ray);
        RTCRay asked = embree_ray(ray, distance);
        occluded_one(scene_.get(), context.embree, asked);
        return asked.tfar < 0.0F;
    }

    [[nodiscard]] AcceleratorStats size() const override {
        AcceleratorStats size;
        for (const SurfaceList& list : lists_) {
            size.references += list.size();
        }
        size.bytes = static_cast<std::uint64_t>(bytes_.load());
        return size;
    }

private:
    static bool count_bytes(void* total, ssize_t change, bool /*after*/) {
        *static_cast<std::atomic<long long>*>(total) += change;
        return true;
    }

    static Context context_of(const Ray& ray) {
        Context context;
        begin(context.embree);
        context.ray = ray;
        return context;
    }

    /// Where Embree found one of its own shapes.
    [[nodiscard]] HitRecord record(const Ray& ray, const RTCRayHit& answer) const {
        const RTCHit& hit = answer.hit;
        const Surface& surface = *lists_[hit.geomID][hit.primID];
        return foreign_hit(surface, ray, answer.ray.tfar, {hit.Ng_x, hit.Ng_y, hit.Ng_z}, hit.u, hit.v);
    }

    void attach(const Geometry& geometry, Kind kind) {
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(scene_.get(), geometry.get(), kind);
    }

    void attach_triangles(Kind kind) {
        const SurfaceList& list = lists_[kind];
        if (list.empty()) {
            return;
        }
        const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
        const std::size_t corners = 3 * list.size();
        const std::span coordinates(
            static_cast<float*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                        3 * sizeof(float), corners)),
            3 * corners);
        const std::span indices(
            static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                           3 * sizeof(unsigned), list.size())),
            corners);
        std::iota(indices.begin(), indices.end(), 0U);
        std::size_t next = 0;
        for (const Surface* surface : list) {
            const auto& triangle = static_cast<const Triangle&>(*surface);
            for (const glm::vec3& point : {triangle.a(), triangle.b(), triangle.c()}) {
                for (int axis = 0; axis < 3; ++axis) {
                    coordinates[next++] = point[axis];
                }
            }
        }
        attach(geometry, kind);
    }

    void attach_spheres() {
        const SurfaceList& list = lists_[k_sphere];
        if (list.empty()) {
            return;
        }
        const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT));
        const std::span numbers(
            static_cast<float*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                        4 * sizeof(float), list.size())),
            4 * list.size());
        std::size_t next = 0;
        for (const Surface* surface : list) {
            const auto& sphere = static_cast<const Sphere&>(*surface);
            for (int axis = 0; axis < 3; ++axis) {
                numbers[next++] = sphere.center()[axis];
            }
            numbers[next++] = sphere.radius();
        }
        attach(geometry, k_sphere);
    }

    void attach_others() {
        SurfaceList& list = lists_[k_other];
        if (list.empty()) {
            return;
        }
        const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
        rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(list.size()));
        rtcSetGeometryUserData(geometry.get(), &list);
        rtcSetGeometryBoundsFunction(geometry.get(), bounds_callback, nullptr);
        rtcSetGeometryIntersectFunction(geometry.get(), intersect_callback);
        rtcSetGeometryOccludedFunction(geometry.get(), occluded_callback);
        attach(geometry, k_other);
    }

    std::atomic<long long> bytes_{0};  // before the device, which counts on it to its end
    Device device_;
    std::array<SurfaceList, k_kinds> lists_;
    EmbreeScene scene_;
};

}  // namespace

std::unique_ptr<Accelerator> make_embree(const SurfaceList& surfaces, EmbreeMode mode) {
    return std::make_unique<EmbreeAccelerator>(surfaces, mode);
}

}  // namespace raysteps::bench
