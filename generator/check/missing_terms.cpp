// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/missing_terms.hpp"

#include <algorithm>
#include <functional>

#include "algebra/symbolic/fourier.hpp"
#include "analysis/derive/derivation.hpp"
#include "check/edits.hpp"
#include "check/nearest.hpp"
#include "check/phrase_tree.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Tree::Kind;

namespace {

constexpr std::size_t most_terms = 3000, most_texts = 300;
constexpr double largest_tree = 5000;

/// The terms of a readable expression, without sign.
void add_terms(const Phrase& phrase, std::vector<TreePtr>& terms) {
    const TreePtr tree = tree_of(phrase);
    const auto add = [&](const TreePtr& term) {
        terms.push_back(term->kind == Kind::negate ? term->args[0] : term);
    };
    if (tree->kind != Kind::sum) return add(tree);
    for (const TreePtr& term : tree->args) add(term);
}

void add_terms(const ex& e, const Mechanism& m, std::vector<TreePtr>& terms) {
    if (m.z->tree_size(e) > largest_tree) return;
    if (const auto f = fourier(m.z->expand(e), *m.symbols, most_texts); f && f->size() > 0)
        for (const Fourier& part : parts_of(*f)) add_terms(readable(part), terms);
}

void collect_angles(const TreePtr& tree, TreesByText& angles) {
    if (tree->kind == Kind::call && (tree->text == "sin" || tree->text == "cos"))
        angles.emplace(plain_text_of(*tree->args[0]), detached(tree->args[0]));
    for (const TreePtr& arg : tree->args) collect_angles(arg, angles);
}

bool is_steady(const Tree& tree, const Mechanism& m) {
    if (tree.kind == Kind::name)
        return std::any_of(m.parameters.begin(), m.parameters.end(),
                           [&](const Mechanism::Parameter& p) { return p.symbol.get_name() == tree.text; });
    return tree.kind != Kind::derivative &&
           std::all_of(tree.args.begin(), tree.args.end(), [&](const TreePtr& arg) { return is_steady(*arg, m); });
}

void collect_steady_terms(const Tree& tree, const Mechanism& m, TreesByText& terms) {
    if (tree.kind == Kind::sum && is_steady(tree, m))
        for (const TreePtr& term : tree.args) {
            const TreePtr& inner = term->kind == Kind::negate ? term->args[0] : term;
            terms.emplace(plain_text_of(*inner), inner);
        }
    for (const TreePtr& arg : tree.args) collect_steady_terms(*arg, m, terms);
}

Factors joined(Factors a, const Factors& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Products of one or two of `atoms`, with no, one or two of `turns`.
void add_products(const std::vector<TreePtr>& atoms, const std::vector<TreePtr>& circular,
                  std::vector<Factors>& terms) {
    std::vector<Factors> factors{{}};
    for (std::size_t a = 0; a < circular.size(); ++a) {
        factors.push_back({circular[a]});
        for (std::size_t b = a; b < circular.size() && circular.size() <= 6; ++b)
            factors.push_back({circular[a], circular[b]});
    }
    std::vector<Factors> products{{number_tree(1)}};
    for (const TreePtr& atom : atoms) products.push_back({atom});
    for (std::size_t a = 0; a < atoms.size(); ++a)
        for (std::size_t b = a; b < atoms.size(); ++b) products.push_back({atoms[a], atoms[b]});
    for (const Factors& factor : factors)
        for (const Factors& product : products) {
            if (terms.size() >= most_terms) return;
            terms.push_back(joined(product, factor));
        }
}

TreePtr name_of(const GiNaC::symbol& symbol, const Mechanism& m) {
    const SymbolInfo& info = m.symbols->info(symbol);
    return name_tree(info.name, info.order);
}

/// Terms that are usual in equations in the scene's speeds, as Euler's of a gyrostat: w2*w3, e1*w1, w1*sigma'.
std::vector<Factors> products_of_speeds(const Mechanism& m) {
    if (m.speeds.empty()) return {};
    std::vector<TreePtr> atoms;
    for (const Mechanism::Speed& speed : m.speeds)
        for (const int primes : {0, 1}) atoms.push_back(name_tree(speed.u.get_name(), primes));
    for (const Mechanism::Input& input : m.inputs)
        for (const GiNaC::symbol& value : input.derivative) atoms.push_back(name_of(value, m));
    for (const GiNaC::symbol& q : m.q) atoms.push_back(name_tree(q.get_name()));
    std::vector<Factors> terms;
    add_products(atoms, {}, terms);
    return terms;
}

}  // namespace

EquationTerms equation_terms(const Mechanism& m, const Equations& e) {
    EquationTerms result;
    // With multipliers that the equations leave open there is no derivation to be shown.
    std::vector<GiNaC::symbol> open;
    for (const Mechanism::Constraint* c : m.undetermined()) open.push_back(c->multiplier);
    result.is_short =
        std::none_of(e.own.begin(), e.own.end(), [&](const ex& force) { return m.z->depends(force, open); });
    if (!result.is_short) return result;
    const Derivation shown = derivation_of(m, e);
    result.is_short = shown.definitions.empty();
    if (!result.is_short) return result;
    std::vector<TreePtr>& energies = result.of_energies;
    add_terms(m.kinetic_energy(), m, energies);
    add_terms(m.potential_energy(), m, energies);
    for (const ex& momentum : m.z->pull_back({{m.lagrangian(), 1}}, m.qdot)) add_terms(momentum, m, energies);
    for (const auto* parts : {&m.kinetic, &m.potential})  // the whole energy of a body or a spring
        for (const Part& part : *parts)
            if (m.z->tree_size(part.value) <= largest_tree)
                if (const auto f = fourier(m.z->expand(part.value), *m.symbols, most_texts); f && f->size() > 1)
                    energies.push_back(tree_of(readable(*f)));
    for (const ReadableEquation& equation : shown.equations) {
        add_terms(equation.lhs, result.of_equations);
        add_terms(equation.rhs, result.of_equations);
    }
    for (const auto& [name, zero] : shown.constraints) add_terms(zero, result.of_equations);
    for (const auto* terms : {&result.of_equations, &result.of_energies})
        for (const TreePtr& term : *terms) {
            collect_angles(term, result.angles);
            collect_steady_terms(*term, m, result.steady);
        }
    return result;
}

std::vector<Factors> terms_of_mechanics(const Claim& claim, const Mechanism& m, const Equations& e,
                                        const EquationTerms& known, bool integral) {
    constexpr std::size_t most_of_integrals = 400;
    std::vector<Factors> terms = products_of_speeds(m);
    if (!known.is_short) return terms;
    for (const auto* list : {&known.of_equations, &known.of_energies})
        for (const TreePtr& term : *list) terms.push_back({term});
    TreesByText angles = known.angles;
    for (const Expression* side : {&claim.equation.lhs, &claim.equation.rhs}) collect_angles(side->tree, angles);
    std::vector<TreePtr> circular, at_rest, in_motion;
    for (const auto& [text, angle] : angles)
        for (const char* function : {"sin", "cos"}) circular.push_back(made(Kind::call, {angle}, function));
    for (const GiNaC::symbol& q : m.q)
        for (const int primes : {0, 1}) at_rest.push_back(name_tree(q.get_name(), primes));
    if (integral) {
        add_products(at_rest, circular, terms);
        if (terms.size() > most_of_integrals) terms.resize(most_of_integrals);
        return terms;
    }
    in_motion = at_rest;
    for (const GiNaC::symbol& q : m.q) in_motion.push_back(name_tree(q.get_name(), 2));
    for (const GiNaC::symbol& lambda : e.lambda) in_motion.push_back(name_tree(lambda.get_name()));
    for (const Mechanism::Input& input : m.inputs) in_motion.push_back(name_of(input.derivative[0], m));
    for (const Mechanism::State& z : m.states) in_motion.push_back(name_of(z.derivative[0], m));
    if (has_derivative(*claim.equation.lhs.tree) || has_derivative(*claim.equation.rhs.tree)) {
        std::vector<Factors> inner;
        for (const TreePtr& energy : known.of_energies) inner.push_back({energy});
        add_products(at_rest, circular, inner);
        for (const TreePtr& energy : known.of_energies)
            for (const TreePtr& turn : circular) inner.push_back({energy, turn});
        if (inner.size() > most_terms / 2) inner.resize(most_terms / 2);
        for (Factors& factors : inner)
            terms.push_back({made(Kind::derivative, {product_of(std::move(factors))}, "", 1)});
    }
    add_products(in_motion, circular, terms);
    return terms;
}

std::vector<TreePtr> steady_sums(const Claim& claim, const Mechanism& m) {
    TreesByText parameters, sums;
    for (const Mechanism::Parameter& p : m.parameters)
        parameters.emplace(p.symbol.get_name(), name_tree(p.symbol.get_name()));
    const std::function<void(const TreePtr&)> collect = [&](const TreePtr& tree) {
        if (tree->kind == Kind::sum && is_steady(*tree, m)) sums.emplace(plain_text_of(*tree), detached(tree));
        for (const TreePtr& arg : tree->args) collect(arg);
    };
    for (const Expression* side : {&claim.equation.lhs, &claim.equation.rhs}) collect(side->tree);
    if (!m.speeds.empty())  // (A - C)*w2*w3 of Euler's equations
        for (std::size_t i = 0; i < m.parameters.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const Mechanism::Parameter &a = m.parameters[j], &b = m.parameters[i];
                if (a.unit.empty() || a.unit != b.unit) continue;
                const TreePtr difference = made(Kind::sum, {name_tree(a.symbol.get_name()),
                                                            made(Kind::negate, {name_tree(b.symbol.get_name())})});
                sums.emplace(plain_text_of(*difference), difference);
            }
    std::vector<TreePtr> result;
    for (const TreesByText* list : {&parameters, &sums})
        for (const auto& [text, tree] : *list) result.push_back(tree);
    return result;
}

std::vector<MissingFactor> missing_terms(const Program& program, int residual, const std::vector<int>& terms,
                                         const std::vector<int>& steady, const std::vector<ModularPoint>& points) {
    constexpr std::size_t needed = SteadyFactors::states;
    std::vector<int> roots{residual};
    roots.insert(roots.end(), terms.begin(), terms.end());
    roots.insert(roots.end(), steady.begin(), steady.end());
    std::vector<ModularValues> at;
    for (const ModularPoint& point : points) {
        auto values = evaluate_mod(program, point, roots);
        if (values && !values->value[residual].is_zero()) at.push_back(std::move(*values));
        if (at.size() == needed) break;
    }
    if (at.size() < needed) return {};
    std::vector<SteadyFactors::Values> values;
    for (const int node : steady) values.push_back({at[0].value[node], at[1].value[node], at[2].value[node]});
    const SteadyFactors known(std::move(values));
    std::vector<std::pair<int, MissingFactor>> found_terms;
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
        found_terms.emplace_back(effort, MissingFactor{k, *factor, effort});
    }
    std::stable_sort(found_terms.begin(), found_terms.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<MissingFactor> result;
    for (auto& [effort, term] : found_terms) result.push_back(std::move(term));
    return result;
}

}  // namespace alembert
