// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/formalism/steps.hpp"

#include "algebra/notation/fractions.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double largest_shown = 30000;  // the most nodes with all intermediate symbols substituted
constexpr std::size_t most_terms = 150;

}  // namespace

Phrase StepWriter::symbol_of(const GiNaC::symbol& symbol) const {
    return phrases::symbol(symbol, m_.symbols->info(symbol));
}

Phrase StepWriter::letter(const std::string& name) {
    const GiNaC::symbol s(name);
    return phrases::symbol(s, {.name = name});
}

Phrase StepWriter::rate(const GiNaC::symbol& momentum) const {
    SymbolInfo info = m_.symbols->info(momentum);
    info.order = 1;
    return phrases::symbol(momentum, info);
}

std::optional<Fourier> StepWriter::normal(const ex& e, std::size_t most) const {
    if (m_.z->tree_size(e) > largest_shown) return std::nullopt;
    std::optional<Fourier> f = fourier(m_.z->expand(e), *m_.symbols, most * most_terms);
    if (f && f->size() > most_terms) return std::nullopt;
    return f;
}

void StepWriter::equality(Section& section, const Phrase& left, const ex& value) const {
    if (const auto f = normal(value)) section.equalities.emplace_back(left, in_fractions(*f, *m_.symbols));
}

void StepWriter::force(Section& section, const std::string& letter, const GiNaC::symbol& of,
                       const ex& value) const {
    if (const auto f = normal(value))
        section.statements.push_back({Statement::Kind::force, letter, "", symbol_of(of), readable(*f)});
}

void StepWriter::partial(Section& section, const std::string& of, const GiNaC::symbol& by, const ex& value) const {
    if (value.is_zero()) return;
    if (const auto f = normal(value))
        section.statements.push_back({Statement::Kind::partial, of, "", symbol_of(by), readable(*f)});
}

}  // namespace alembert
