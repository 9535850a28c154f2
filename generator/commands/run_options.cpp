// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/run_options.hpp"

#include <fmt/format.h>

#include "alembert/error.hpp"

namespace alembert {

double longest_step(const Request& request, const Start& start) {
    return request.max_step >= 0 ? request.max_step : start.max_step;
}

Options options_of(const Request& request, const MethodChoice& choice, const Start& start) {
    const bool fixed = has_fixed_step(choice.method) && choice.foreign.empty();
    if (fixed && request.max_step >= 0)
        throw ModelError(
            fmt::format("--max-step {:g}: {} has a fixed step, which --step gives; methods that choose their "
                        "steps (dop853, radau …) take "
                        "--max-step",
                        request.max_step, name(choice.method)));
    const auto wish = [](double asked, double scene) { return asked >= 0 ? asked : scene; };
    return {.method = choice.method,
            .start = start.t,
            .duration = wish(request.duration, start.duration),
            .tolerance = wish(request.tolerance, start.tolerance),
            .step = wish(request.step, start.step),
            .longest_step = longest_step(request, start),
            .sample = wish(request.sample, start.sample),
            .budget = request.budget,
            .when_stiff = choice.when_stiff};
}

}  // namespace alembert
