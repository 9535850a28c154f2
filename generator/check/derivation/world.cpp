// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/world.hpp"

#include "base/language/say.hpp"
#include "check/derivation/claim_text.hpp"

namespace alembert {

GiNaC::ex World::value(const std::string& text) {
    std::vector<Diagnostic> mistakes;
    const Expression expression = parse_expression(text, {}, mistakes);
    if (!expression) throw NoMeaning{.reason = mistakes.at(0).message};
    return value(expression);
}

GiNaC::ex World::value(const Expression& expression) {
    try {
        return m_.z->name(formulas_.value(expression));
    } catch (const SceneMistake& mistake) {
        throw NoMeaning{.reason = mistake.diagnostic.message};
    } catch (const std::exception&) {
        throw NoMeaning{.reason = say("it has no value: it names something else, or divides by zero")};
    }
}

}  // namespace alembert
