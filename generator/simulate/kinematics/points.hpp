// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How points move.

#include <map>

#include "model/places.hpp"
#include "simulate/kinematics/vectors.hpp"

namespace alembert {

class PointWriter {
public:
    PointWriter(const Scene& scene, Places& places, VectorWriter& write);

    /// Without values. The name is one of these.
    PointKinematics operator()(const std::string& name, bool steps);

private:
    struct Moving {
        Vector3 r, v, a;
    };
    const Position* place_of(const std::string& name) const;
    const Joint* joint_of(const std::string& name) const;
    Moving along_N(const std::string& name);
    Moving along(const std::string& name, const std::string& frame);
    PlaceStep step_of(int point);

    const Scene& scene_;
    Places& places_;
    VectorWriter& write_;
    std::map<int, std::string> named_;  ///< frames of the skeleton
};

}  // namespace alembert
