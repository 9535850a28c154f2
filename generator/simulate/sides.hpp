// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The emitted functions of a program whose signs are held constant (program/switches.hpp), in the form that the
/// runtime needs.
///
///     const HeldSides sides(module, values, {.count = 1, .scene_events = 0});
///     sides.switching().rates(t, y, sigma, rate);

#include <functional>
#include <memory>

#include "alembert/hybrid/filippov_system.hpp"
#include "alembert/native/module.hpp"
#include "analysis/state/prepared.hpp"
#include "program/switches.hpp"

namespace alembert {

/// The array `par` of a solver whose last scene parameters are held: signs, and what friction in planes needs.
class HeldParameters {
public:
    /// `values` are without the `count` parameters that are held.
    HeldParameters(const Module& module, std::vector<double> values, int count);
    /// The array with these signs; cheap if they have not changed.
    const double* with(const double* sigma);
    std::vector<double> values(const std::vector<double>& sigma) const;

private:
    Module module_;
    std::vector<double> values_, sigma_, par_;
};

/// The names of the functions whose signs are held constant, for messages: "sign(x'-v)", "friction 'floor'",
/// "the reaction of friction 'slot'" where its side decides the normal force.
/// `program` is the one from which `s` was made.
std::vector<std::string> names_of_sides(const Program& program, const Switched& s);

/// Corrects the rates at a state for given σ, where the constraints need it; `par` is with these σ. May be empty.
using Correction =
    std::function<void(double t, const double* y, const double* sigma, const double* par, double* rate)>;

/// The motion while no side changes; `smooth` is as in FilippovSystem.
struct MotionOnSides {
    Work work;
    Correction correct;
    std::function<Rhs(const std::vector<double>& values)> smooth;
};

/// The caller adds the callbacks for steps and changes. `values` are the scene's parameters, without those that
/// are held.
FilippovSystem switching_of(const Module& module, const std::vector<double>& values, const Switched& jumps,
                            std::vector<std::string> names, MotionOnSides motion);

/// The program in which signs that the scene writes as x/|x| or x/√(x²) are such (program/quotient_signs.hpp),
/// with a warning for each.
Program with_signs_told(Prepared& prepared, const Program& program);

/// The scene's events, the first `count` of the module's, with the signs that `par` holds when they are called.
Events first_events(const Events& all, std::size_t count, const Module& module, const std::vector<double>* par);

/// σ at a state of a motion, for evaluations after the motion: the signs, and α where the state slides along a
/// zero. `sizes` are the largest |g_k| of the motion.
std::vector<double> sides_at(const FilippovSystem& system, double t, const double* y, int dimension,
                             const std::vector<double>& sizes);

}  // namespace alembert
