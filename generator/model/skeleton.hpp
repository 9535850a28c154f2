// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the frames and points of a scene are connected, step by step. Their positions along N no longer show this,
/// and recursions from body to body need it.
///
///     frames[f]: turned against frames[parent] by `angle` about `axis`, whose components are the same in both
///     points[p]: `offset`, along the axes of `frame`, away from points[from]
///
/// Frame 0 is N, point 0 is O. Joints become steps of the same kind as frames and points.

#include <array>
#include <vector>

#include "algebra/symbolic/intermediates.hpp"

namespace alembert {

using Vector3 = std::array<GiNaC::ex, 3>;

struct Skeleton {
    struct Turn {
        int parent = 0;
        Vector3 axis{0, 0, 1};  ///< a unit vector in parameters
        GiNaC::ex angle = 0;
        bool by_quaternion = false;                ///< if true, axis and angle have no meaning
        std::array<GiNaC::ex, 4> quaternion = {};  ///< in coordinates or prescribed, scalar first
    };
    struct Step {
        int from = 0, frame = 0;
        Vector3 offset{0, 0, 0};
    };
    std::vector<Turn> frames{Turn{}};
    std::vector<Step> points{Step{}};
};

}  // namespace alembert
