// SPDX-License-Identifier: MIT
#include "alembert/hybrid/automaton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/tolerances.hpp"

namespace alembert {

Hit take_hit(Trajectory& part, const Mode& mode) {
    Hit hit;
    const int of_run = static_cast<int>(mode.guards.list.size()) - mode.own;
    const auto is_own = [of_run](int event) { return event >= of_run; };
    if (part.ending == Ending::stopped_by_event)
        for (const LastZero& zero : part.last_zeros) {
            if (is_own(zero.event)) {
                hit.guards.push_back(zero.event - of_run);
                continue;
            }
            const auto known = std::find_if(hit.passed.begin(), hit.passed.end(),
                                            [&](const LastZero& z) { return z.event == zero.event; });
            if (known == hit.passed.end())
                hit.passed.push_back(zero);
            else if (zero.counts)
                *known = zero;
            if (zero.counts && mode.run != nullptr)
                hit.stops = hit.stops || mode.run->list[static_cast<std::size_t>(zero.event)].stop;
        }
    std::erase_if(part.events, [&](const EventRecord& e) { return is_own(e.index); });
    std::erase_if(part.last_zeros, [&](const LastZero& z) { return is_own(z.event); });
    return hit;
}

void settle_end(Trajectory& part, const Options& options, const std::string& changes) {
    const double end = options.start + options.duration;
    if (part.ending == Ending::completed &&
        std::abs(part.times.back() - end) <= 16 * tolerance::epsilon * std::abs(end))
        part.times.back() = end;
    if (part.failure && part.failure->kind == FailureKind::budget_used_up)
        part.failure->message = budget_is_used_up(options.budget, part.failure->time, changes);
    const auto last = part.final_state();
    const auto bad = std::find_if(last.begin(), last.end(), [](double y) { return !std::isfinite(y); });
    if (part.failure || bad == last.end()) return;
    // What a method adds up besides, such as the work, does not end its steps.
    part.ending = Ending::failed;
    part.failure =
        Failure{.kind = FailureKind::not_a_number,
                .message = fmt::format(
                    "{} is no longer finite after t = {}; take a shorter step, or an adaptive method such "
                    "as dop853",
                    "the state or the work", part.times.back()),
                .time = part.times.back(),
                .state = {last.begin(), last.end()},
                .component = static_cast<int>(bad - last.begin())};
}

}  // namespace alembert
