// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A state at which a false claim fails, as a person types it.
///
///     if (const auto shown = counterexample(told, motions, program, root))
///         shown->values;              // {"m", "3/7"}, {"theta", "2*atan(1/3)"} …
///         shown->residual;            // left − right there
///
/// States are those of exact/real_state.hpp: fractions where there are some, floats of 50 digits after that.

#include <set>

#include "check/claims.hpp"
#include "check/open_rows.hpp"
#include "exact/real_state.hpp"

namespace alembert {

struct Counterexample {
    std::vector<std::pair<std::string, std::string>> values;  ///< name → value
    std::string residual;
    double residual_value = 0;
    bool of_derivative = false;  ///< the residual is that of the claim's time derivative
};

/// Of whom the claims speak.
struct Told {
    const Mechanism& mechanism;
    const Equations& equations;
    Claims& claims;
    const std::vector<std::size_t>&
        spoken;  ///< positions in Mechanism::undetermined(): multipliers that the claims name
    const std::vector<GiNaC::ex>& positive;  ///< on the sheet of roots on which they are held
    bool is_impact = false;
};

/// Of `program`'s node `root`, which is zero where the claim holds. Nothing after some seconds of search.
std::optional<Counterexample> counterexample(const Told& told, const Motions& motions, const Program& program,
                                             int root);

/// Of a claim with open names: a state, what the other claims make of the names there, and what is left of this
/// claim.
struct OpenClaim {
    std::size_t claim;
    const std::vector<int>& open;        ///< its names
    const std::set<std::size_t>& wrong;  ///< claims that are wrong: the others are satisfied before these
};
std::optional<Counterexample> counterexample(const Told& told, const Motions& motions, const OpenRows& rows,
                                             const OpenClaim& of);

/// What vanishes beside loose conditions (Motions::loose) vanishes on them too if it is continuous there. Which of
/// the roots are zero at states on them, where they have values and the equations have one solution?
std::vector<bool> hold_in_numbers(const Motions& motions, const Program& program, const std::vector<int>& roots);

}  // namespace alembert
