#pragma once
// Textures that both ends know: each is sent once, and then named by its number. A picture asks thousands of times
// about the same ones.
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>

#include "core/texture.hpp"
#include "remote/serializer.hpp"

namespace raysteps::remote {

[[nodiscard]] inline const void* place_of(const Texture& texture) { return texture.texels.data(); }
[[nodiscard]] inline const void* place_of(const Pyramid& pyramid) { return pyramid.data(); }

/// What this end has sent of one kind, and what came. Both ends forget the same old ones.
template <typename T>
class ValueCache {
public:
    [[nodiscard]] static ValueCache& all() {
        static ValueCache known;
        return known;
    }

    /// Writes which one it is, and what it looks like if the other end does not know it yet. Between two calls with the
    /// same `together`, which is not 0, none has changed.
    void write(Writer& out, const T& value, std::uint64_t together) {
        const void* place = place_of(value);
        if (knows(value, together)) {
            out.put(ids_.at(place));
            out.put(false);
            return;
        }
        const std::uint32_t id = ++last_;
        out.put(id);
        out.put(true);
        remote::write(out, value);
        sent_[id] = {place, value, together};
        ids_[place] = id;
        for (auto old = sent_.begin(); old->first <= oldest_kept(id); old = sent_.erase(old)) {
            if (const auto named = ids_.find(old->second.place); named->second == old->first) {
                ids_.erase(named);
            }
        }
    }

    /// What `write` wrote at the other end.
    [[nodiscard]] std::shared_ptr<const T> read(Reader& in) {
        const auto id = in.get<std::uint32_t>();
        if (in.get<bool>()) {
            const auto value = std::make_shared<const T>(remote::read<T>(in));
            received_[id] = value;
            received_.erase(received_.begin(), received_.upper_bound(oldest_kept(id)));
            return value;
        }
        const auto found = received_.find(id);
        if (found == received_.end()) {
            throw BadMessage("this texture is not known here");
        }
        return found->second;
    }

private:
    struct Sent {
        const void* place = nullptr;  ///< by which it is found again
        T copy;
        std::uint64_t compared_in = 0;  ///< `together` when it was last compared
    };

    static std::uint32_t oldest_kept(std::uint32_t newest) {
        constexpr std::uint32_t k_kept = 32;
        return newest > k_kept ? newest - k_kept : 0;
    }

    [[nodiscard]] bool knows(const T& value, std::uint64_t together) {
        const auto found = ids_.find(place_of(value));
        if (found == ids_.end()) {
            return false;
        }
        Sent& sent = sent_.at(found->second);
        const bool compared = together != 0 && sent.compared_in == together;
        if (!compared && sent.copy != value) {
            return false;
        }
        sent.compared_in = together;
        return true;
    }

    std::map<std::uint32_t, Sent> sent_;
    std::unordered_map<const void*, std::uint32_t> ids_;
    std::map<std::uint32_t, std::shared_ptr<const T>> received_;
    std::uint32_t last_ = 0;
};

}  // namespace raysteps::remote
