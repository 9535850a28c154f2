// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What is shown of a scene with quaternions uses e·e = 1.
///
/// Rotations are divided by e·e, so that T and V do not change along e (model/geometry.cpp): the derivatives are
/// right for every e, and after them e·e is 1 in each term.

#include "formalism/equations.hpp"
#include "model/mechanism.hpp"

namespace alembert {

class UnitQuaternions {
public:
    explicit UnitQuaternions(const Mechanism& mechanism);

    bool any() const { return !one_.empty(); }
    /// `e` with 1 in place of the e·e of every quaternion.
    GiNaC::ex operator()(const GiNaC::ex& e) const;
    Equations operator()(Equations equations) const;

private:
    const Mechanism& m_;
    GiNaC::exmap one_;  ///< the intermediate symbols that are e·e
};

}  // namespace alembert
