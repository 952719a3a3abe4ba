#pragma once
// The answer of step 02's closest_hit, with the tests that it took: where that step is the student's, its box tests
// spheres and triangles itself.
#include "remote/functions.hpp"

namespace raysteps::remote {

struct CountedHit {
    std::optional<HitRecord> hit;
    std::uint64_t surface_tests = 0;
};

template <>
struct Travel<CountedHit> {
    static void write(Writer& out, const CountedHit& counted) {
        remote::write(out, counted.hit);
        out.put(counted.surface_tests);
    }
    static CountedHit read(Reader& in) {
        auto hit = remote::read<std::optional<HitRecord>>(in);
        return {hit, in.get<std::uint64_t>()};
    }
};

}  // namespace raysteps::remote
