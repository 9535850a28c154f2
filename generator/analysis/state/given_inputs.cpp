// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/given_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/argument.hpp"
#include "base/language/libraries.hpp"
#include "scene/expression.hpp"

namespace alembert {

Overrides with_inputs_given(Scene& scene, Overrides at) {
    std::erase_if(at, [&](const std::pair<std::string, double>& given) {
        const auto input = std::find_if(scene.inputs.begin(), scene.inputs.end(),
                                        [&](const Input& one) { return one.name.text == given.first; });
        if (input == scene.inputs.end()) return false;
        if (!std::isfinite(given.second))
            throw ModelError(
                translated_from_library(argument::mistake(given.first, given.second, argument::finite)));
        std::vector<Diagnostic> none;
        input->value = parse_expression(fmt::format("{:.17g}", given.second), {}, none);
        return true;
    });
    return at;
}

}  // namespace alembert
