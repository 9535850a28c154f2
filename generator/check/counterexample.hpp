// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A state at which a false claim fails, in the form in which a person would type it.
///
///     if (const auto shown = counterexample(told, motions, program, root))
///         shown->values;              // {"m", "3/7"}, {"theta", "2*atan(1/3)"} …
///         shown->residual;            // left − right there
///
/// States are those of analysis/exact/real_state.hpp: fractions if possible, otherwise floats with 50 digits.

#include <map>
#include <set>

#include "analysis/exact/real_state.hpp"
#include "check/claims.hpp"
#include "check/open_rows.hpp"

namespace alembert {

struct Counterexample {
    std::vector<std::pair<std::string, std::string>> values;  ///< name → value
    std::string residual;
    double residual_value = 0;
    bool of_derivative = false;  ///< whether the residual is that of the claim's time derivative
};

/// The quantities that the claims contain and the counterexample must show.
struct Told {
    const Mechanism& mechanism;
    const Equations& equations;
    Claims& claims;
    const std::vector<std::size_t>&
        spoken;  ///< positions in Mechanism::undetermined(): the multipliers in the claims
    const std::vector<GiNaC::ex>&
        positive;  ///< expressions that are positive on the sheet of roots on which the claims are checked
    const std::vector<GiNaC::ex>& own_factors;  ///< at rest: what vanishes on the scene's own branch
    bool is_impact = false;
    bool on_own_branch = false;  ///< only states on the scene's own branch count
};

/// A state, with what is left there of the claim; `open` are open names that have values in it.
Counterexample described(const Told& told, const RealState& state, const GiNaC::numeric& residual,
                         const std::vector<int>& open = {});

/// A counterexample for the node `root` of `program`, which is zero where the claim holds. Nothing after some
/// seconds of search.
std::optional<Counterexample> counterexample(const Told& told, const Motions& motions, const Program& program,
                                             int root);

/// A counterexample for a claim with open names: a state, the values of these names that follow from the other
/// claims, and the residual of this claim.
struct OpenClaim {
    std::size_t claim;
    const std::vector<int>& open;        ///< its names
    const std::set<std::size_t>& wrong;  ///< the wrong claims; the other claims are satisfied before these
    unsigned tries = 600;                ///< how many states are looked for
};
std::optional<Counterexample> counterexample(const Told& told, const Motions& motions, const OpenRows& rows,
                                             const OpenClaim& of);

/// What 2000 digits say of `root` at random states of the scene's own branch, of which three are enough. Where it
/// is an algebraic number that is not zero, its digits begin before: it is no smaller than its degree and height
/// allow. Only for what has no sides; one value that is not zero is enough to fail.
enum class InNumbers { holds, fails, unknown };
InNumbers in_many_digits(const Told& told, const Motions& motions, const Program& program, int root);

/// Whether there is a state in numbers at which all of told.positive are positive; false if none was found.
bool is_possible(const Told& told, const Motions& motions);

/// An expression that vanishes for all values of the loose conditions (Motions::loose) also vanishes on them if it
/// is continuous there. Which of the roots are zero at states on them, and on the sheet of the claims, at which
/// they have values and the equations have a unique solution?
std::vector<bool> hold_in_numbers(const Told& told, const Motions& motions, const Program& program,
                                  const std::vector<int>& roots);

/// Is the root zero at a few states on the sheet of the claims? It is unknown if fewer than three are found at
/// which it has a value.
InNumbers in_numbers(const Told& told, const Motions& motions, const Program& program, int root);

/// What states in numbers on the sheet of the claims say of a node in one cell of its program.
struct SeenInCell {
    int states = 0;                            ///< how many were found at which it has a value
    std::optional<Counterexample> fails = {};  ///< the first at which it is not zero
};
/// A node of a program that is cut into cells.
struct NodeInCells {
    const Program& program;
    int node;
    const Cells& cells;
};
/// What some states say, by the cells in which they lie.
std::map<Cell, SeenInCell> survey(const Told& told, const Motions& motions, const NodeInCells& of);
/// Looks for further states of one cell, until `wanted` are found, or one at which the node is not zero, or for a
/// while.
void look_in_cell(const Told& told, const Motions& motions, const NodeInCells& of, Cell cell, int wanted,
                  SeenInCell& seen);

/// The sign of the node at several states of the scene's own branch; nothing if it is not the same at all of them,
/// or if the motions do not know that branch.
std::optional<int> sign_on_own_branch(const Told& told, const Motions& motions, const Program& program, int root);

/// The first state, on any branch of the constraints, at which the node is zero, or is not zero; `where` are its
/// coordinates. Nothing if none of the first states is of that kind.
struct FoundState {
    std::vector<std::pair<std::string, std::string>> where;
    std::vector<std::pair<std::string, std::string>> values;
};
std::optional<FoundState> state_where(const Told& told, const Motions& motions, const Program& program, int root,
                                      bool is_zero);

}  // namespace alembert
