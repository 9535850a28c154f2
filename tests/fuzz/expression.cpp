// SPDX-License-Identifier: MIT
// The parsers of expressions, equations and units. An equation that was accepted is accepted again as it is
// printed.
#include "scene/expression.hpp"
#include "scene/unit_text.hpp"
#include "target.hpp"

using namespace alembert;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string given = fuzz::text(data, size);
    std::vector<Diagnostic> mistakes, second;
    parse_expression(given, {}, mistakes);
    mistakes.clear();
    const Equality equation = parse_equality(given, {}, mistakes);
    if (mistakes.empty()) {
        const std::string printed = text_of(equation);
        if (text_of(parse_equality(printed, {}, second)) != printed || !second.empty()) __builtin_trap();
    }
    meaning_of_unit(given);
    return 0;
}
