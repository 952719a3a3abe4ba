#pragma once
// What a question has lent, such as a scene, is in use while a question of the other end about it is answered. Nothing
// may end before whatever uses it.
#include <utility>

#include "remote/session.hpp"

namespace raysteps::remote {

class Uses {
public:
    /// Called before what was lent ends. An honest box has had its answers by then: it needs them for its own.
    void require_none() const {
        if (count_ != 0) {
            Session::current().broken("an answer came before those that it was to be made of");
        }
    }

private:
    friend class Use;
    int count_ = 0;
};

class Use {
public:
    explicit Use(Uses& uses) : uses_(&uses) { ++uses_->count_; }
    Use(Use&& other) noexcept : uses_(std::exchange(other.uses_, nullptr)) {}
    Use& operator=(Use&&) = delete;
    ~Use() {
        if (uses_ != nullptr) {
            --uses_->count_;
        }
    }

private:
    Uses* uses_;
};

}  // namespace raysteps::remote
