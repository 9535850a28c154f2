// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The times at which the inputs of the motions of a sweep change fast (program/lower/quick_times.hpp). Motions
/// with the same parameters of inputs, start and duration are one variant and share one search, which takes about
/// a millisecond.
///
///     InputVariants variants(program, starts, grid, {});
///     options.quick_times = *variants.quick_times(starts.at(grid.point(7)), 10);
///
/// Only the first 2000 variants in the order of the points are searched: which these are depends on the points
/// alone, so that a motion is the same whatever else is computed with it.

#include <map>
#include <set>

#include "alembert/ode/input_time_scale.hpp"
#include "program/lower/start.hpp"
#include "scene/grid.hpp"

namespace alembert {

class InputVariants {
public:
    static constexpr std::size_t most = 2000;

    /// `duration` is in s; if missing, that of each start counts. `program` must outlive this.
    InputVariants(const Program& program, const Starts& starts, const Grid& grid, std::optional<double> duration);

    /// Null for a variant that is not searched; else valid as long as this is. One thread at a time.
    const std::vector<InputTimeScale>* quick_times(const Start& start);

    bool has_too_many() const { return too_many_; }

private:
    using Key = std::vector<double>;
    Key key_of(const Start& start) const;
    double duration_of(const Start& start) const { return duration_.value_or(start.duration); }
    bool matters(const Starts& starts, const Grid& grid, std::size_t axis) const;
    /// Collects the variants of the points; false if there are too many.
    bool collect(const Starts& starts, const Grid& grid);

    const Program& program_;
    std::optional<double> duration_;
    std::vector<bool> used_;
    std::set<Key> first_;  ///< if there are too many, those that are searched
    std::map<Key, std::vector<InputTimeScale>> known_;
    bool too_many_ = false;
};

}  // namespace alembert
