// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/operations.hpp"

namespace alembert {

namespace {

std::size_t letters_of(const Polynomial& polynomial) {
    std::size_t result = 0;
    for (const Term& term : polynomial.terms())
        for (const Factor& factor : term.monomial) {
            ++result;
            for (const Polynomial& arg : factor.atom->args) result += letters_of(arg);
        }
    return result;
}

}  // namespace

std::size_t operations_in(const Phrase& phrase) {
    std::size_t result = phrase.args.empty() ? 0 : 1;
    if (phrase.kind == Phrase::Kind::sum || phrase.kind == Phrase::Kind::product) result = phrase.args.size() - 1;
    if (phrase.kind == Phrase::Kind::negative) result = 0;
    for (const Phrase& arg : phrase.args) result += operations_in(arg);
    return result;
}

std::size_t letters_in(const Fourier& f) {
    return letters_of(f.polynomial());
}

}  // namespace alembert
