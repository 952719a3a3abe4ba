#pragma once
// Surfaces that both ends know. The end that has them describes them once; the other makes copies, and asks back
// whenever one is tested.
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/scene.hpp"
#include "remote/message.hpp"
#include "remote/use.hpp"

namespace raysteps::remote {

using GroupId = std::uint32_t;

/// Its surfaces, at the end that has them.
struct OwnGroup {
    GroupId id = 0;
    SurfaceList surfaces;
    std::string description;
    std::uint64_t described_in = 0;  ///< `together` when it was last described
    int lent = 0;                    ///< open questions that may lead to one of these surfaces
    UseCount uses;
};

/// Its copies at the other end, in the same order.
struct CopiedGroup {
    GroupId id = 0;
    Scene scene;
};

struct SurfaceRef {
    GroupId group = 0;
    std::uint32_t index = 0;
};

/// All groups of this end. What nothing else holds is forgotten when enough others have come.
class Groups {
public:
    [[nodiscard]] static Groups& all();

    /// Writes which group these surfaces are, and what they look like if the other end does not know it yet. Between
    /// two calls with the same `together`, which is not 0, no surface has changed.
    std::shared_ptr<OwnGroup> write(Writer& out, const SurfaceList& surfaces, std::uint64_t together = 0);

    /// Whether the surfaces of an own group, which still exist, look as they did.
    [[nodiscard]] static bool is_unchanged(const OwnGroup& group);

    /// The copies of what `write` wrote at the other end.
    [[nodiscard]] std::shared_ptr<CopiedGroup> read(Reader& in);

    /// A surface of an own group that an open question has lent. Throws BadMessage for any other.
    [[nodiscard]] const Surface& lent(SurfaceRef place) const;

    /// While one of its surfaces is asked. Throws as `lent` does.
    [[nodiscard]] UseGuard use(GroupId group) const;

    /// Null for a surface that is no copy.
    [[nodiscard]] const SurfaceRef* place_of(const Surface* surface) const;

private:
    [[nodiscard]] OwnGroup& lent_group(GroupId id) const;
    std::shared_ptr<CopiedGroup> make_copies(GroupId id, std::string_view description);

    std::map<GroupId, std::shared_ptr<OwnGroup>> own_;
    std::map<GroupId, std::shared_ptr<CopiedGroup>> copied_;
    std::unordered_map<const Surface*, SurfaceRef> places_;
    GroupId last_ = 0;
};

/// As long as it exists, the other end may ask the surfaces of the group.
class Loan {
public:
    Loan() = default;
    explicit Loan(std::shared_ptr<OwnGroup> group) : group_(std::move(group)) { ++group_->lent; }
    Loan(Loan&& other) noexcept : group_(std::move(other.group_)) {}
    Loan& operator=(Loan&&) = delete;
    ~Loan() {
        if (group_ != nullptr && --group_->lent == 0) {
            group_->uses.require_none();
        }
    }

    [[nodiscard]] const std::shared_ptr<OwnGroup>& group() const { return group_; }

private:
    std::shared_ptr<OwnGroup> group_;
};

/// Whether whoever tests the surface asks the other end, which counts the test.
[[nodiscard]] bool is_asked(const Surface& surface);

/// What an entry of a student's tree becomes that leads to no surface of the scene: no ray hits it.
[[nodiscard]] const Surface& no_surface();

}  // namespace raysteps::remote
