// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `identify`: which combinations of the bodies' inertial parameters motion and loads can show, the base
/// parameters (Gautier & Khalil, IEEE Trans. Robotics and Automation 6 (1990) 368; Mayeda, Yoshida & Osuka, ibid.
/// 312).
///
///     const Identification found = identify(read_scene("scenes/gallery/six_joint_arm.toml"));
///     found.base.size();      // 36
///
/// Columns of the regressor Y (program/lower/regressor.hpp) at many states that depend on each other in the same
/// way at all of them show only together. The rank, and which columns depend on which, are exact: Y is evaluated
/// modulo 2⁶¹ − 1 at random states. A column that depends on others is expressed by those before it in the order
/// second moments, first moments, masses, each from the ground outwards; these keep their parameters, which become
/// sums. Coefficients are polynomials of degree two in the scene's parameters where these are few, otherwise
/// numbers: decimals of at most ten digits, or a fraction where decimals would not end and its denominator has at
/// most three digits.

#include <string>
#include <vector>

#include "analysis/state/prepared.hpp"

namespace alembert {

struct BaseTerm {
    std::string parameter;    ///< "m(lower)"
    std::string coefficient;  ///< "l1^2", "0.25", or "1/3"
    double value = 1;         ///< of the coefficient, with the scene's parameters
};

/// The first term has the coefficient 1 and names the combination.
struct BaseParameter {
    std::vector<BaseTerm> terms;
    double value = 0;  ///< with the scene's masses
};

struct Identification : Prepared {
    struct Body {
        std::string name;
        std::array<double, 3>
            centre{};  ///< the mass centre from the origin of the body's parameters, along its axes
    };
    std::vector<Body> bodies = {};
    std::vector<std::string> parameters = {};  ///< all, in the order of the regressor's columns
    std::vector<BaseParameter> base = {};
    std::vector<std::string> without_influence = {};  ///< parameters that no motion shows
};

/// Throws ModelError for a scene without coordinates or that gives energies in place of masses, and for
/// constraints without exact states (column_dependence.hpp).
Identification identify(Scene scene);

}  // namespace alembert
