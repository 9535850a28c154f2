// SPDX-License-Identifier: MIT
#include "alembert/ode/run_piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/tolerances.hpp"

namespace alembert {

Options rest_of(const Options& given, double t, long work) {
    Options rest = given;
    const double end = given.start + given.duration;
    rest.start = t;
    if (t != given.start) rest.duration = end - t > 16 * tolerance::epsilon * std::abs(end) ? end - t : 0;
    rest.sample = sample_interval(given);
    rest.budget = std::max(1L, given.budget - work);
    return rest;
}

std::string budget_is_used_up(long budget, double t, const std::string& changes) {
    return fmt::format(
        "{} right-hand sides were not enough to come further than t = {}{}; raise the budget, loosen the "
        "tolerance or shorten the duration",
        budget, t, changes);
}

}  // namespace alembert
