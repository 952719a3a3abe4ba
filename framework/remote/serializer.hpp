#pragma once
// How each type is written to the wire and read from it: values as their fields.
#include <array>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "core/area_light.hpp"
#include "core/box.hpp"
#include "core/camera.hpp"
#include "core/hit_record.hpp"
#include "core/light.hpp"
#include "core/light_sample.hpp"
#include "core/mesh_face.hpp"
#include "core/mis_tracer.hpp"
#include "core/pixel_sample.hpp"
#include "core/random_stream.hpp"
#include "core/scatter.hpp"
#include "core/sphere.hpp"
#include "core/texture.hpp"
#include "core/triangle.hpp"
#include "remote/message.hpp"

namespace raysteps::remote {

/// write(out, value) and read(in) for a type that can be a result; what stands for a parameter is in functions.hpp.
template <typename T>
struct Serializer;

template <typename T>
void write(Writer& out, const T& value) {
    Serializer<T>::write(out, value);
}
template <typename T>
[[nodiscard]] T read(Reader& in) {
    return Serializer<T>::read(in);
}

template <Plain T>
struct Serializer<T> {
    static void write(Writer& out, T value) { out.put(value); }
    static T read(Reader& in) { return in.get<T>(); }
};

/// A few numbers without gaps between them.
template <typename T, std::size_t Size>
struct Packed {
    static_assert(sizeof(T) == Size && std::is_trivially_copyable_v<T>);
    static void write(Writer& out, const T& value) { out.put_bytes(&value, Size); }
    static T read(Reader& in) {
        T value;
        in.get_bytes(&value, Size);
        return value;
    }
};
template <>
struct Serializer<glm::vec2> : Packed<glm::vec2, 2 * sizeof(float)> {};
template <>
struct Serializer<glm::vec3> : Packed<glm::vec3, 3 * sizeof(float)> {};
template <>
struct Serializer<Ray> : Packed<Ray, 6 * sizeof(float)> {};
template <>
struct Serializer<Fill> : Packed<Fill, 14 * sizeof(float)> {};
template <>
struct Serializer<Box> : Packed<Box, 6 * sizeof(float)> {};
template <>
struct Serializer<RandomStream> : Packed<RandomStream, 8 * sizeof(std::uint32_t)> {};

/// The fields of a record, as references.
constexpr auto fields(auto& record) {
    using Record = std::remove_const_t<std::remove_reference_t<decltype(record)>>;
    if constexpr (std::is_same_v<Record, Camera>) {
        return std::tie(record.from, record.at, record.up, record.angle, record.hither, record.width, record.height,
                        record.lens_radius, record.focal_distance);
    } else if constexpr (std::is_same_v<Record, ViewFrame>) {
        return std::tie(record.right, record.up, record.forward, record.half_width, record.half_height);
    } else if constexpr (std::is_same_v<Record, Light>) {
        return std::tie(record.position, record.color);
    } else if constexpr (std::is_same_v<Record, TriangleLight>) {
        return std::tie(record.a, record.b, record.c);
    } else if constexpr (std::is_same_v<Record, SphereLight>) {
        return std::tie(record.center, record.radius);
    } else if constexpr (std::is_same_v<Record, DiskLight>) {
        return std::tie(record.center, record.normal, record.radius);
    } else if constexpr (std::is_same_v<Record, LightSample>) {
        return std::tie(record.position, record.normal, record.pdf);
    } else if constexpr (std::is_same_v<Record, PixelSample>) {
        return std::tie(record.offset, record.light);
    } else if constexpr (std::is_same_v<Record, ScatterSample>) {
        return std::tie(record.direction, record.weight, record.pdf, record.specular);
    } else if constexpr (std::is_same_v<Record, DirectSample>) {
        return std::tie(record.light, record.pdf, record.scatter_pdf);
    } else if constexpr (std::is_same_v<Record, MeshCorner>) {
        return std::tie(record.position, record.normal, record.uv);
    } else if constexpr (std::is_same_v<Record, Texture>) {
        return std::tie(record.width, record.height, record.texels);
    } else if constexpr (std::is_same_v<Record, Interval>) {
        return std::tie(record.enter, record.leave);
    } else {
        static_assert(std::is_same_v<Record, HitRecord>, "name the fields of this type here");
        return std::tie(record.position, record.fill, record.normal, record.ray_direction, record.distance,
                        record.front_face, record.mesh_triangle);
    }
}

template <typename T>
    requires std::is_aggregate_v<T>
struct Serializer<T> {
    static void write(Writer& out, const T& record) {
        std::apply([&](const auto&... field) { (remote::write(out, field), ...); }, fields(record));
    }
    static T read(Reader& in) {
        T record;
        std::apply([&](auto&... field) { ((field = remote::read<std::remove_reference_t<decltype(field)>>(in)), ...); },
                   fields(record));
        return record;
    }
};

template <typename T>
struct Serializer<std::optional<T>> {
    static void write(Writer& out, const std::optional<T>& value) {
        out.put(value.has_value());
        if (value) {
            remote::write(out, *value);
        }
    }
    static std::optional<T> read(Reader& in) {
        return in.get<bool>() ? std::optional<T>(remote::read<T>(in)) : std::nullopt;
    }
};

template <typename T, std::size_t N>
struct Serializer<std::array<T, N>> {
    static void write(Writer& out, const std::array<T, N>& values) {
        for (const T& value : values) {
            remote::write(out, value);
        }
    }
    static std::array<T, N> read(Reader& in) {
        std::array<T, N> values;
        for (T& value : values) {
            value = remote::read<T>(in);
        }
        return values;
    }
};

template <typename T>
struct Serializer<std::vector<T>> {
    static void write(Writer& out, std::span<const T> values) {
        out.put(static_cast<std::uint32_t>(values.size()));
        for (const T& value : values) {
            remote::write(out, value);
        }
    }
    static std::vector<T> read(Reader& in) {
        constexpr bool k_may_be_empty = requires(T value) { value.has_value(); };
        std::vector<T> values(in.count(k_may_be_empty ? 1 : sizeof(std::uint32_t)));
        for (T& value : values) {
            value = remote::read<T>(in);
        }
        return values;
    }
};

template <>
struct Serializer<Sphere> {
    static void write(Writer& out, const Sphere& sphere) {
        remote::write(out, sphere.center());
        out.put(sphere.radius());
        remote::write(out, sphere.fill());
    }
    static Sphere read(Reader& in) {
        const auto center = remote::read<glm::vec3>(in);
        const auto radius = in.get<float>();
        return {center, radius, remote::read<Fill>(in)};
    }
};

template <>
struct Serializer<Triangle> {
    static void write(Writer& out, const Triangle& triangle) {
        for (const glm::vec3& corner : {triangle.a(), triangle.b(), triangle.c()}) {
            remote::write(out, corner);
        }
        remote::write(out, triangle.fill());
    }
    static Triangle read(Reader& in) {
        const auto corners = remote::read<std::array<glm::vec3, 3>>(in);
        return {corners[0], corners[1], corners[2], remote::read<Fill>(in)};
    }
};

}  // namespace raysteps::remote
