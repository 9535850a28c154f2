// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations that are shown for a scene with quaternions use e·e = 1.
///
/// Rotations are divided by e·e, so that T and V do not change along e (model/geometry.cpp). The derivatives are
/// therefore right for every e, and afterwards e·e is replaced by 1 in each term.

#include "model/formalism/equations.hpp"
#include "model/mechanism.hpp"

namespace alembert {

class UnitQuaternions {
public:
    explicit UnitQuaternions(const Mechanism& mechanism);

    bool any() const { return !one_.empty(); }
    /// The expression `e` with e·e of every quaternion replaced by 1.
    GiNaC::ex operator()(const GiNaC::ex& e) const;
    Equations operator()(Equations equations) const;

private:
    const Mechanism& m_;
    GiNaC::exmap one_;  ///< the intermediate symbols that stand for e·e
};

}  // namespace alembert
