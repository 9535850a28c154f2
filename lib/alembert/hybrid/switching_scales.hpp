// SPDX-License-Identifier: MIT
#pragma once

/// What counts as small at one moment of a motion with held signs (filippov_system.hpp), in the units of the
/// motion itself.
///
///     const SwitchingScales moment{system, sides, t, state, options, sizes};
///     moment.stopped(k);     // a sliding velocity below this is none
///
///     ChatterWatch swings(count);
///     swings.at_rest(moment, open, since);   // the functions that have come to rest at their zeros

#include <vector>

#include "alembert/hybrid/sliding_field.hpp"

namespace alembert {

struct SwitchingScales {
    const FilippovSystem& system;
    const FilippovMode& sides;
    double t;
    const std::vector<double>& state;
    const Options& options;
    const std::vector<double>& sizes;  ///< the largest |g_k| so far

    int dimension() const { return static_cast<int>(state.size()); }
    double value(int k) const;
    /// The sliding velocity that rounding may leave of none.
    double still(int k) const;
    /// The sliding velocity below which a friction counts as having stopped: what the tolerance leaves of none.
    /// Steps hold the error of a component y below it times max(1, |y|), and a body hands errors on from one of
    /// its feet to the others.
    double stopped(int k) const;
    /// Whether the value g of a function is zero, up to what rounding leaves of it, and the instant of an event at
    /// which an earlier run has ended.
    bool is_zero(int k, double g) const;
    /// Whether the rates at both signs of a function that is zero are the same. Friction with a normal force that
    /// is zero holds as soon as there is one, so nothing is said of friction.
    bool changes_nothing(int k) const;
    /// The size up to which such a function is idle (FilippovMode).
    double idle(int k) const;
    /// The size of sliding velocities: the largest so far. Before anything has slid, that to which the load would
    /// bring the pair without friction in a small part of the run.
    double speed(int pair) const;
    /// How far the k-th normal force is uncertain because the state and the time are. `now` has been evaluated
    /// here, with its bounds.
    double uncertain_normal(const SlidingField& now, int k) const;
    /// Whether the sign of a function changes its own rate, as that of a sliding velocity does.
    bool brakes(int k) const;
};

/// How far functions are from zero where others change their signs, from one change to the next.
class ChatterWatch {
public:
    explicit ChatterWatch(std::size_t functions) : of_(functions) {}

    /// Functions other than the `open` ones that the tolerance does not tell from zero, or that do not come nearer
    /// to it from one change to the next, and that do not move either. `since`: the time since the last change.
    std::vector<int> at_rest(const SwitchingScales& moment, const std::vector<int>& open, double since);

private:
    struct Swing {
        double most = 0, least = HUGE_VAL;
        int rounds = 0;  ///< changes since `least` became less
    };
    std::vector<Swing> of_;
};

/// Whether a function of positions that is zero stands still: its ġ is zero but for rounding, and g̈ decides where
/// it goes.
bool stands_still(const FilippovSystem& system, const FilippovMode& sides, int k, double t,
                  const std::vector<double>& state);

}  // namespace alembert
