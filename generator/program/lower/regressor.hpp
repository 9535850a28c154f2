// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Inverse dynamics as a linear function of the inertial parameters of the bodies,
///     M q'' + C q' + g = Y(q, q', q'', t) π.
///
///     const Regressor r = regressor(scene, mechanism, false);
///     r.columns[3].name();          // "mz(upper)"
///
/// Ten parameters of each body, along its own axes about its origin: m, the first moments mx my mz = m c, and the
/// elements xx yy zz xy yz zx of the tensor of inertia (of the matrix: xy is −∫ x y dm). A particle has m alone.
/// The origin of a body is the farthest point towards the ground that is fixed to it, the joint that places it, or
/// else its mass centre. The rotor of a joint has its inertia, rotor(q1) (Khalil & Dombre, Modeling,
/// Identification and Control of Robots (2002), chapter 12).

#include <array>

#include "model/mechanism.hpp"
#include "program/named_function.hpp"
#include "scene/scene.hpp"

namespace alembert {

struct InertialParameter {
    std::string body;
    static constexpr int rotor = 10;
    int which =
        0;  ///< 0: m; 1 to 3: first moments; 4 to 9: xx yy zz xy yz zx; 10: the rotor of the coordinate `body`
    std::string name() const;
};

struct Regressor {
    FunctionProgram function;  ///< Y, n × number of columns
    std::vector<InertialParameter> columns;
    /// The values of π that the scene gives, in parameters.
    std::vector<GiNaC::ex> values;
    /// The mass centre of each body of `columns` from its origin, along its own axes.
    std::vector<std::pair<std::string, std::array<GiNaC::ex, 3>>> centres;
    std::shared_ptr<Intermediates> z;  ///< that of `values` and `centres`
};

/// Throws ModelError for a scene that gives energies in place of masses.
Regressor regressor(const Scene& scene, const Mechanism& mechanism, bool fold);

}  // namespace alembert
