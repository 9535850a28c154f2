// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Constraints that were left out because they follow from the others at the scene's values of the parameters. At
/// other values they may not follow, and nothing would hold them.
///
///     const LeftOut left_out(mechanism);
///     left_out.check(start_of(mechanism, {{"L1", 1.2}}));   // throws if |AC| = L3 no longer follows
///
/// `assemble` checks this for one state. Who gives other values without it (a sweep, a chart, a branch) does so
/// here.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "program/lower/start.hpp"
#include "program/program.hpp"

namespace alembert {

class LeftOut {
public:
    explicit LeftOut(const Mechanism& mechanism);

    /// Throws ModelError if a position that was left out is off at `start`, after all its coordinates have been
    /// moved onto the constraints that are kept. Where parameters of constraints have other values than in the
    /// scene, it also must not be off at states around that one, and its row and offset must follow from the kept
    /// ones there. Nothing is checked if no state obeys the kept ones.
    void check(const Start& start) const;

    /// A mechanism and lower_constraints of it.
    struct Whole {
        Mechanism mechanism;
        Program program;
    };
    /// With the constraints that are tied to those that are kept (Mechanism::Constraint::tie), each of which is
    /// needed at some pose; nothing if there are none.
    const std::optional<Whole>& whole() const { return whole_; }

private:
    struct Both {
        Mechanism kept;         ///< with the constraints that are not left out; all coordinates are guesses
        Program kept_program;   ///< its rows
        Program program;        ///< the rows of those that are kept, then of those that were left out
        int count_kept, count;  ///< of constraints
        std::vector<Mechanism::Constraint> constraints;
        std::set<int> parameters;  ///< on which they depend
    };
    bool has_other_parameters(const Start& start) const;
    bool move_onto_kept(Start& start) const;
    void check_position(const State<double>& state) const;
    void check_row(const State<double>& state) const;
    [[noreturn]] void refuse(int constraint, double residual) const;

    std::optional<Both> both_;  ///< nothing if nothing was left out
    std::optional<Whole> whole_;
};

/// For each independent parameter, whether what was left out ceases to follow when this parameter alone changes
/// from its value at `start` by a hundredth of it (by 0.01 from zero).
std::vector<bool> tied_parameters(const Mechanism& mechanism, const Start& start);

}  // namespace alembert
