// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/input_variants.hpp"

#include <algorithm>

#include "program/lower/quick_times.hpp"

namespace alembert {

InputVariants::InputVariants(const Program& program, const Starts& starts, const Grid& grid,
                             std::optional<double> duration)
    : program_(program), duration_(duration) {
    const Possible<Start> any = starts.possible(grid.point(0));
    if (any.exists()) used_ = parameters_of_inputs(program, any.value().parameters.size());
    // Of a grid only the axes on which variants depend are walked along.
    Grid walked = grid;
    bool one = true;
    for (std::size_t axis = 0; axis < grid.axes.size(); ++axis) {
        if (matters(starts, grid, axis))
            one = false;
        else if (!grid.is_listed())
            walked.axes[axis].count = 1;
    }
    if (!one) too_many_ = !collect(starts, walked);
}

InputVariants::Key InputVariants::key_of(const Start& start) const {
    Key key{start.t, duration_of(start)};
    for (std::size_t i = 0; i < start.parameters.size() && i < used_.size(); ++i)
        if (used_[i]) key.push_back(start.parameters[i]);
    return key;
}

/// Compared at three points: a variant that depends on an axis does so at almost all of them. Of samples these are
/// the first, because a later one may take as long as all before it.
bool InputVariants::matters(const Starts& starts, const Grid& grid, std::size_t axis) const {
    const std::size_t last = grid.size() - 1, apart = grid.is_listed() ? 1 : std::max<std::size_t>(1, last / 3);
    for (const std::size_t k : {std::size_t{0}, std::min(apart, last), std::min(2 * apart, last)}) {
        std::vector<double> values = grid.point(k);
        std::vector<Key> keys;
        for (const double value : {grid.axes[axis].from, grid.axes[axis].to}) {
            values[axis] = value;
            const Possible<Start> start = starts.possible(values);
            if (start.exists()) keys.push_back(key_of(start.value()));
        }
        if (keys.size() < 2 || keys[0] != keys[1]) return true;
    }
    return false;
}

bool InputVariants::collect(const Starts& starts, const Grid& grid) {
    for (std::size_t k = 0; k < grid.size(); ++k) {
        const Possible<Start> start = starts.possible(grid.point(k));
        if (!start.exists()) continue;
        const Key key = key_of(start.value());
        if (first_.contains(key)) continue;
        if (first_.size() == most) return false;
        first_.insert(key);
    }
    return true;
}

const std::vector<InputTimeScale>* InputVariants::quick_times(const Start& start) {
    const Key key = key_of(start);
    if (too_many_ && !first_.contains(key)) return nullptr;
    const auto [at, is_new] = known_.try_emplace(key);
    if (is_new)
        at->second = alembert::quick_times(program_, start.parameters, start.t, start.t + duration_of(start));
    return &at->second;
}

}  // namespace alembert
