// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The emitted functions of a program with held signs (program/switches.hpp) as the runtime asks for them.
///
///     const HeldSides sides(module, values, {.count = 1, .scene_events = 0});
///     sides.switching().rates(t, y, sigma, rate);

#include <functional>
#include <memory>

#include "alembert/module.hpp"
#include "alembert/switching.hpp"
#include "program/switches.hpp"

namespace alembert {

/// Numbers in the `par` of a solver whose last scene parameters are the signs.
class HeldParameters {
public:
    /// `values` without the signs, of which there are `count`.
    HeldParameters(const Module& module, std::vector<double> values, int count);
    /// Cheap where they are as before.
    const double* with(const double* sigma);
    std::vector<double> values(const std::vector<double>& sigma) const;

private:
    Module module_;
    std::vector<double> values_, sigma_, par_;
};

/// Names of the functions whose signs are held, for messages: "sign(x'-v)", "friction 'floor'". `program` is the
/// one that `s` was made from.
std::vector<std::string> names_of_sides(const Program& program, const Switched& s);

/// `smooth` as Switching has it; what is told of steps and changes is for the caller to add. `has_bounds`: the
/// events end with those of dry friction.
Switching switching_of(const Module& module, const std::vector<double>& values, std::vector<std::string> names,
                       bool has_bounds, Work work, std::function<Rhs(const std::vector<double>& values)> smooth);

/// The scene's events, the first `count` of the module's.
Events first_events(Events all, std::size_t count);

/// σ where the motion is, for those who look at a state of it later: the signs, and α where the state is on a zero
/// that it slides along. `sizes`: the largest |g_k| of the motion.
std::vector<double> sides_at(const Switching& system, double t, const double* y, int dimension,
                             const std::vector<double>& sizes);

}  // namespace alembert
