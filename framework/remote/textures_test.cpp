// Textures that are sent once and then named.
#include "remote/textures.hpp"

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::remote;

namespace {

struct Ends {
    ValueCache<Texture> here;
    ValueCache<Texture> there;
    std::size_t sent = 0;  ///< bytes of the last message

    Texture pass(const Texture& texture, std::uint64_t together = 0) {
        std::string bytes;
        Writer out(bytes);
        here.write(out, texture, together);
        sent = bytes.size();
        Reader in(bytes);
        return *there.read(in);
    }
};

constexpr std::size_t k_name = sizeof(std::uint32_t) + 1;

}  // namespace

TEST_CASE("a texture is sent once", "[remote][texture]") {
    Ends ends;
    const Texture texture{2, 1, {Color(0.5F), Color(1.0F)}};
    CHECK(ends.pass(texture) == texture);
    CHECK(ends.sent > k_name);
    CHECK(ends.pass(texture) == texture);
    CHECK(ends.sent == k_name);
}

TEST_CASE("a texture that changed at its place is sent again", "[remote][texture]") {
    Ends ends;
    Texture texture{2, 1, {Color(0.5F), Color(1.0F)}};
    CHECK(ends.pass(texture) == texture);
    texture.texels[0] = Color(0.25F);
    CHECK(ends.pass(texture) == texture);
    CHECK(ends.pass(texture, 7) == texture);
    CHECK(ends.sent == k_name);
}

TEST_CASE("both ends forget the same old textures", "[remote][texture]") {
    Ends ends;
    std::vector<Texture> many;
    for (int i = 0; i < 100; ++i) {
        many.push_back({1, 1, {Color(static_cast<float>(i))}});
    }
    for (int round = 0; round < 3; ++round) {
        for (const Texture& texture : many) {
            REQUIRE(ends.pass(texture) == texture);
        }
    }
    CHECK(ends.pass(many.back()) == many.back());
    CHECK(ends.sent == k_name);
}

TEST_CASE("a texture that nobody has sent is refused", "[remote][texture]") {
    std::string bytes;
    Writer out(bytes);
    out.put(std::uint32_t{3});
    out.put(false);
    Reader in(bytes);
    ValueCache<Texture> known;
    CHECK_THROWS_AS(known.read(in), BadMessage);
}
