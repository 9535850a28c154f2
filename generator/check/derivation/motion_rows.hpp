// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equations as rows at exact states: does one follow from others?
///
///     MotionRows rows(mechanism, equations, lower);
///     const MotionRow claim = rows.row(residual);
///     rows.holds(claim)                 // on every motion of the system
///     rows.is_identity(claim)           // whatever the forces are
///     rows.follows(claim, {&a, &b})     // wherever a and b hold, whether they are right or not
///
/// An equation linear in accelerations and multipliers is r* + s·(x − x*) at a state with the accelerations and
/// multipliers x*; it follows from others where its row (s, r*) is a combination of theirs and of those of the
/// constraints, (A, 0). States are exact (analysis/exact/motions.hpp), so that a wrong answer has a probability of
/// about 2⁻⁵⁰ a state. This is enough to mark a line; the verdict on the system itself is that of the check.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/exact/exact_states.hpp"
#include "model/formalism/equations.hpp"

namespace alembert {

struct MotionRow {
    GiNaC::ex residual;
    bool linear = true;  ///< in accelerations and multipliers
    /// At each state its slopes and its value; nothing where it cannot be evaluated.
    std::vector<std::optional<std::vector<Prime>>> at;
    bool is_known() const;
};

class MotionRows {
public:
    using Lower = std::function<std::vector<int>(Program&, const std::vector<GiNaC::ex>&)>;
    MotionRows(const Mechanism& mechanism, const Equations& equations, Lower lower);

    MotionRow row(const GiNaC::ex& residual);
    /// Whether Σ factor δq vanishes in motion for all displacements that the constraints allow; nothing if it
    /// could not be evaluated.
    std::optional<bool> is_bound(const std::vector<GiNaC::ex>& factors);
    /// Nothing if it could not be evaluated anywhere.
    std::optional<bool> holds(const MotionRow& row) const;
    std::optional<bool> is_identity(const MotionRow& row) const;
    /// False too where one of them is not linear, and where they contradict each other. `bound`: whether the
    /// constraints of the system count, too.
    bool follows(const MotionRow& row, const std::vector<const MotionRow*>& of, bool bound = true) const;
    /// Whether it is a number times the other one.
    bool is_multiple(const MotionRow& row, const MotionRow& of) const;
    /// Whether these and the constraints determine all accelerations.
    bool determine(const std::vector<const MotionRow*>& rows) const;
    /// Whether there are accelerations and multipliers that obey all of them.
    bool agree(const std::vector<const MotionRow*>& rows, bool bound = true) const;

private:
    std::vector<std::vector<Prime>> matrix(std::size_t state, const std::vector<const MotionRow*>& rows,
                                           bool bound) const;

    const Mechanism& m_;
    Lower lower_;
    std::vector<GiNaC::symbol> unknowns_;
    std::vector<ModularPoint> points_;
    std::vector<std::vector<std::vector<Prime>>> bound_;  ///< the rows of the constraints at each state
};

}  // namespace alembert
