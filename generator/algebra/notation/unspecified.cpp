// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/unspecified.hpp"

#include <algorithm>

#include "algebra/notation/text.hpp"
#include "algebra/symbolic/unspecified.hpp"

namespace alembert {

namespace {

bool holds(const Phrase& phrase, const std::string& name) {
    return (phrase.kind == Phrase::Kind::symbol && phrase.info.text() == name) ||
           std::any_of(phrase.args.begin(), phrase.args.end(),
                       [&](const Phrase& arg) { return holds(arg, name); });
}

}  // namespace

std::optional<UnspecifiedPhrase> unspecified_phrase(const Phrase& phrase) {
    if (phrase.kind != Phrase::Kind::call || phrase.name != unspecified_name) return {};
    UnspecifiedPhrase result{.function = &phrase.args[0], .arguments = {}, .orders = {}};
    for (std::size_t k = 1; k < phrase.args.size(); k += 2) {
        result.orders.push_back(to_int(phrase.args[k].value));
        result.order += result.orders.back();
        result.arguments.push_back(&phrase.args[k + 1]);
    }
    for (std::size_t k = 0; k < result.orders.size(); ++k) {
        if (result.orders[k] == 0) continue;
        const Phrase& by = *result.arguments[k];
        const std::string written = text(by);
        result.by_symbols = result.by_symbols && by.kind == Phrase::Kind::symbol;
        for (std::size_t other = 0; other < result.orders.size(); ++other) {
            if (other == k) continue;
            result.by_symbols = result.by_symbols && !holds(*result.arguments[other], written);
            result.by_different = result.by_different && text(*result.arguments[other]) != written;
        }
    }
    return result;
}

}  // namespace alembert
