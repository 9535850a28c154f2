// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/absent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>

#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "analysis/derive/derivation.hpp"
#include "check/nearest.hpp"
#include "check/steady_factor.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_terms = 3000, most_texts = 300;
constexpr double largest_tree = 5000;

/// The terms of a readable expression, without sign.
void add_terms(const Phrase& phrase, std::vector<std::string>& terms) {
    std::vector<Diagnostic> mistakes;
    const std::string written = text(phrase);
    const Expression e = parse_expression(written, {}, mistakes);
    if (!e.tree) return;
    const auto add = [&](const Tree& tree) {
        const Tree& inner = tree.kind == Tree::Kind::negate ? *tree.args[0] : tree;
        terms.push_back(
            "(" + written.substr(static_cast<std::size_t>(inner.offset), static_cast<std::size_t>(inner.length)) +
            ")");
    };
    if (e.tree->kind != Tree::Kind::sum) return add(*e.tree);
    for (const TreePtr& term : e.tree->args) add(*term);
}

void add_terms(const ex& e, const Mechanism& m, std::vector<std::string>& terms) {
    if (m.z->tree_size(e) > largest_tree) return;
    if (const auto f = fourier(m.z->expand(e), *m.symbols, most_texts); f && f->size() > 0)
        for (const Fourier& part : parts_of(*f)) add_terms(readable(part), terms);
}

void collect_angles(const Tree& tree, const std::string& text, std::set<std::string>& angles) {
    if (tree.kind == Tree::Kind::call && (tree.text == "sin" || tree.text == "cos"))
        angles.insert(text.substr(static_cast<std::size_t>(tree.args[0]->offset),
                                  static_cast<std::size_t>(tree.args[0]->length)));
    for (const TreePtr& arg : tree.args) collect_angles(*arg, text, angles);
}

bool is_steady(const Tree& tree, const Mechanism& m) {
    if (tree.kind == Tree::Kind::name)
        return std::any_of(m.parameters.begin(), m.parameters.end(),
                           [&](const Mechanism::Parameter& p) { return p.symbol.get_name() == tree.text; });
    return tree.kind != Tree::Kind::derivative &&
           std::all_of(tree.args.begin(), tree.args.end(), [&](const TreePtr& arg) { return is_steady(*arg, m); });
}

std::string part_of(const Tree& tree, const std::string& text) {
    return text.substr(static_cast<std::size_t>(tree.offset), static_cast<std::size_t>(tree.length));
}

void collect_steady_terms(const Tree& tree, const std::string& text, const Mechanism& m,
                          std::set<std::string>& terms) {
    if (tree.kind == Tree::Kind::sum && is_steady(tree, m))
        for (const TreePtr& term : tree.args)
            terms.insert(part_of(term->kind == Tree::Kind::negate ? *term->args[0] : *term, text));
    for (const TreePtr& arg : tree.args) collect_steady_terms(*arg, text, m, terms);
}

bool differentiates(const Tree& tree) {
    return tree.kind == Tree::Kind::derivative ||
           std::any_of(tree.args.begin(), tree.args.end(),
                       [](const TreePtr& arg) { return differentiates(*arg); });
}

/// Products of one or two of `atoms`, with no, one or two of `turns`.
void add_products(const std::vector<std::string>& atoms, const std::vector<std::string>& turns,
                  std::vector<std::string>& terms) {
    std::vector<std::string> factors{""};
    for (std::size_t a = 0; a < turns.size(); ++a) {
        factors.push_back("*" + turns[a]);
        for (std::size_t b = a; b < turns.size() && turns.size() <= 6; ++b)
            factors.push_back("*" + turns[a] + "*" + turns[b]);
    }
    std::vector<std::string> products{"1"};
    products.insert(products.end(), atoms.begin(), atoms.end());
    for (std::size_t a = 0; a < atoms.size(); ++a)
        for (std::size_t b = a; b < atoms.size(); ++b) products.push_back(atoms[a] + "*" + atoms[b]);
    for (const std::string& factor : factors)
        for (const std::string& product : products) {
            if (terms.size() >= most_terms) return;
            terms.push_back(product + factor);
        }
}

/// Terms that are usual in equations in the scene's speeds, as Euler's of a gyrostat: w2*w3, e1*w1, w1*sigma'.
std::vector<std::string> products_of_speeds(const Mechanism& m) {
    if (m.speeds.empty()) return {};
    std::vector<std::string> atoms, terms;
    for (const Mechanism::Speed& speed : m.speeds)
        for (const char* primes : {"", "'"}) atoms.push_back(speed.u.get_name() + primes);
    for (const Mechanism::Input& input : m.inputs)
        for (const GiNaC::symbol& value : input.derivative) atoms.push_back(value.get_name());
    for (const GiNaC::symbol& q : m.q) atoms.push_back(q.get_name());
    add_products(atoms, {}, terms);
    return terms;
}

}  // namespace

EquationTerms equation_terms(const Mechanism& m, const Equations& e) {
    EquationTerms result;
    const Derivation shown = derivation_of(m, e);
    result.is_short = shown.definitions.empty();
    if (!result.is_short) return result;
    std::vector<std::string>& energies = result.of_energies;
    add_terms(m.kinetic_energy(), m, energies);
    add_terms(m.potential_energy(), m, energies);
    for (const ex& momentum : m.z->pull_back({{m.lagrangian(), 1}}, m.qdot)) add_terms(momentum, m, energies);
    for (const auto* parts : {&m.kinetic, &m.potential})  // the whole energy of a body or a spring
        for (const Part& part : *parts)
            if (m.z->tree_size(part.value) <= largest_tree)
                if (const auto f = fourier(m.z->expand(part.value), *m.symbols, most_texts); f && f->size() > 1)
                    energies.push_back("(" + text(readable(*f)) + ")");
    for (const ReadableEquation& equation : shown.equations) {
        add_terms(equation.lhs, result.of_equations);
        add_terms(equation.rhs, result.of_equations);
    }
    for (const auto& [name, zero] : shown.constraints) add_terms(zero, result.of_equations);
    for (const auto* terms : {&result.of_equations, &result.of_energies})
        for (const std::string& term : *terms) {
            std::vector<Diagnostic> mistakes;
            if (const Expression known = parse_expression(term, {}, mistakes); known.tree) {
                collect_angles(*known.tree, term, result.angles);
                collect_steady_terms(*known.tree, term, m, result.steady);
            }
        }
    return result;
}

std::vector<std::string> terms_of_mechanics(const Claim& claim, const Mechanism& m, const Equations& e,
                                            const EquationTerms& known, bool integral) {
    constexpr std::size_t most_of_integrals = 400;
    std::vector<std::string> terms = products_of_speeds(m), at_rest, in_motion;
    if (!known.is_short) return terms;
    terms.insert(terms.end(), known.of_equations.begin(), known.of_equations.end());
    const std::vector<std::string>& energies = known.of_energies;
    terms.insert(terms.end(), energies.begin(), energies.end());
    std::set<std::string> angles = known.angles;
    for (const Expression* side : {&claim.equation.lhs, &claim.equation.rhs})
        collect_angles(*side->tree, side->text, angles);
    std::vector<std::string> turns;
    for (const std::string& angle : angles) {
        turns.push_back("sin(" + angle + ")");
        turns.push_back("cos(" + angle + ")");
    }
    for (const GiNaC::symbol& q : m.q)
        for (const char* primes : {"", "'"}) at_rest.push_back(q.get_name() + primes);
    if (integral) {
        add_products(at_rest, turns, terms);
        if (terms.size() > most_of_integrals) terms.resize(most_of_integrals);
        return terms;
    }
    in_motion = at_rest;
    for (const GiNaC::symbol& q : m.q) in_motion.push_back(q.get_name() + "''");
    for (const GiNaC::symbol& lambda : e.lambda) in_motion.push_back(lambda.get_name());
    for (const Mechanism::Input& input : m.inputs) in_motion.push_back(input.derivative[0].get_name());
    if (differentiates(*claim.equation.lhs.tree) || differentiates(*claim.equation.rhs.tree)) {
        std::vector<std::string> inner = energies;
        add_products(at_rest, turns, inner);
        for (const std::string& energy : energies)
            for (const std::string& turn : turns) inner.push_back(energy + "*" + turn);
        if (inner.size() > most_terms / 2) inner.resize(most_terms / 2);
        for (const std::string& term : inner) terms.push_back("(" + term + ")'");
    }
    add_products(in_motion, turns, terms);
    return terms;
}

std::vector<std::string> steady_sums(const Claim& claim, const Mechanism& m) {
    std::set<std::string> parameters, sums;
    for (const Mechanism::Parameter& p : m.parameters) parameters.insert(p.symbol.get_name());
    const std::function<void(const Tree&, const std::string&)> collect = [&](const Tree& tree,
                                                                             const std::string& text) {
        if (tree.kind == Tree::Kind::sum && is_steady(tree, m)) sums.insert("(" + part_of(tree, text) + ")");
        for (const TreePtr& arg : tree.args) collect(*arg, text);
    };
    for (const Expression* side : {&claim.equation.lhs, &claim.equation.rhs}) collect(*side->tree, side->text);
    std::vector<std::string> result(parameters.begin(), parameters.end());
    if (!m.speeds.empty())  // (A - C)*w2*w3 of Euler's equations
        for (std::size_t i = 0; i < m.parameters.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const Mechanism::Parameter &a = m.parameters[j], &b = m.parameters[i];
                if (!a.unit.empty() && a.unit == b.unit)
                    sums.insert(fmt::format("({} - {})", a.symbol.get_name(), b.symbol.get_name()));
            }
    result.insert(result.end(), sums.begin(), sums.end());
    return result;
}

std::vector<Absent> absent_terms(const Program& program, int residual, const std::vector<int>& terms,
                                 const std::vector<Steady>& steady, const std::vector<ModularPoint>& points) {
    constexpr std::size_t needed = SteadyFactors::states;
    std::vector<int> roots{residual};
    roots.insert(roots.end(), terms.begin(), terms.end());
    for (const Steady& s : steady) roots.push_back(s.node);
    std::vector<ModularValues> at;
    for (const ModularPoint& point : points) {
        auto values = evaluate_mod(program, point, roots);
        if (values && !values->value[residual].is_zero()) at.push_back(std::move(*values));
        if (at.size() == needed) break;
    }
    if (at.size() < needed) return {};
    std::vector<SteadyFactors::Values> values;
    std::vector<std::string> names;
    for (const Steady& s : steady) {
        values.push_back({at[0].value[s.node], at[1].value[s.node], at[2].value[s.node]});
        names.push_back(s.text);
    }
    const SteadyFactors known(std::move(values));
    std::vector<std::pair<int, Absent>> found_terms;
    for (std::size_t k = 0; k < terms.size(); ++k) {
        SteadyFactors::Values c;
        bool nonzero = true;
        for (std::size_t s = 0; s < needed; ++s) {
            const Prime t = at[s].value[terms[k]];
            nonzero = nonzero && !t.is_zero();
            c[s] = -at[s].value[residual] * t.inverse();
        }
        if (!nonzero) continue;
        const std::optional<SteadyFactor> factor = known.of(c);
        if (!factor) continue;
        const int effort = 2 * factor->degree() + (std::abs(factor->n) != 1 ? 1 : 0) + (factor->d != 1 ? 1 : 0);
        found_terms.emplace_back(effort, Absent{k, text_of(*factor, names), effort});
    }
    std::stable_sort(found_terms.begin(), found_terms.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Absent> result;
    for (auto& [effort, term] : found_terms) result.push_back(std::move(term));
    return result;
}

}  // namespace alembert
