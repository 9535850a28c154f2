// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A value, or the reason why a scene has none, for computations that apply to some scenes only.
///
///     const Possible<JointTree> tree = joint_tree(mechanism);
///     if (tree.obstacle()) …          // "the recursive formalism goes from body to body along joints: …"
///     use(tree.value());

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "model/mechanism.hpp"

namespace alembert {

struct Obstacle {
    std::string reason;
};

/// Throws ModelError with the reason, if there is one.
inline void need_none(const std::optional<std::string>& obstacle) {
    if (obstacle) throw ModelError(*obstacle);
}

template <typename T>
class Possible {
public:
    Possible(T value) : content_(std::move(value)) {}
    Possible(Obstacle obstacle) : content_(std::move(obstacle)) {}

    /// The reason why there is no value; nothing if there is one.
    std::optional<std::string> obstacle() const {
        const Obstacle* const found = std::get_if<Obstacle>(&content_);
        return found != nullptr ? std::optional(found->reason) : std::nullopt;
    }
    bool exists() const { return std::holds_alternative<T>(content_); }

    /// Throws ModelError with the reason if there is no value.
    const T& value() const& {
        need_none(obstacle());
        return std::get<T>(content_);
    }
    T value() && {
        need_none(obstacle());
        return std::get<T>(std::move(content_));
    }

private:
    std::variant<T, Obstacle> content_;
};

}  // namespace alembert
