// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the frames and points of a scene hang together, step by step: what their positions along N no longer show,
/// and what recursions from body to body need.
///
///     frames[f]: turned against frames[parent] by `angle` about `axis`, whose components are the same in both
///     points[p]: `offset`, along the axes of `frame`, away from points[from]
///
/// Frame 0 is N, point 0 is O. Joints are steps like those that frames and points are written with.

#include <array>
#include <vector>

#include "symbolic/intermediates.hpp"

namespace alembert {

using Vector3 = std::array<GiNaC::ex, 3>;

struct Skeleton {
    struct Turn {
        int parent = 0;
        Vector3 axis{0, 0, 1};  ///< a unit vector in parameters
        GiNaC::ex angle = 0;
        bool by_quaternion = false;  ///< then axis and angle say nothing
    };
    struct Step {
        int from = 0, frame = 0;
        Vector3 offset{0, 0, 0};
    };
    std::vector<Turn> frames{Turn{}};
    std::vector<Step> points{Step{}};
};

}  // namespace alembert
