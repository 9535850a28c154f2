// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/absent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>

#include "check/nearest.hpp"
#include "derive/derivation.hpp"
#include "notation/text.hpp"
#include "symbolic/fourier.hpp"

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
            if (const Expression known = parse_expression(term, {}, mistakes); known.tree)
                collect_angles(*known.tree, term, result.angles);
        }
    return result;
}

std::vector<std::string> terms_of_mechanics(const Claim& claim, const Mechanism& m, const Equations& e,
                                            const EquationTerms& known) {
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
    const std::function<bool(const Tree&)> is_steady = [&](const Tree& tree) {
        if (tree.kind == Tree::Kind::name) return parameters.contains(tree.text);
        return tree.kind != Tree::Kind::derivative &&
               std::all_of(tree.args.begin(), tree.args.end(),
                           [&](const TreePtr& arg) { return is_steady(*arg); });
    };
    const std::function<void(const Tree&, const std::string&)> collect = [&](const Tree& tree,
                                                                             const std::string& text) {
        if (tree.kind == Tree::Kind::sum && is_steady(tree))
            sums.insert("(" +
                        text.substr(static_cast<std::size_t>(tree.offset), static_cast<std::size_t>(tree.length)) +
                        ")");
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

namespace {

struct Powers {
    std::vector<std::pair<std::size_t, int>> of;  ///< the constant value, and its exponent
    int size() const {
        int sum = 0;
        for (const auto& [which, exponent] : of) sum += std::abs(exponent);
        return sum;
    }
};

Prime raised(Prime x, int exponent) {
    return exponent < 0 ? x.inverse().power(static_cast<std::uint64_t>(-exponent))
                        : x.power(static_cast<std::uint64_t>(exponent));
}

/// All products of at most three of `ratios` to small powers; of two with equal values, the simpler one.
std::map<Prime, Powers> table_of(const std::vector<Prime>& ratios) {
    constexpr int highest = 2;
    constexpr std::size_t most_factors = 3, most_entries = 60000;
    std::map<Prime, Powers> table{{Prime(1), {}}};
    std::vector<std::pair<Prime, Powers>> last{{Prime(1), {}}};
    for (std::size_t factors = 0; factors < most_factors; ++factors) {
        std::vector<std::pair<Prime, Powers>> next;
        for (const auto& [value, powers] : last)
            for (std::size_t j = powers.of.empty() ? 0 : powers.of.back().first + 1; j < ratios.size(); ++j)
                for (int e = -highest; e <= highest && table.size() < most_entries; ++e) {
                    if (e == 0) continue;
                    Powers more = powers;
                    more.of.emplace_back(j, e);
                    const Prime product = value * raised(ratios[j], e);
                    table.emplace(product, more);
                    next.emplace_back(product, more);
                }
        last = std::move(next);
    }
    return table;
}

/// As n/d with small n and d.
std::optional<std::pair<int, int>> small_fraction(Prime x) {
    constexpr std::uint64_t largest = 240;
    for (int d = 1; d <= 48; ++d) {
        const Prime n = x * Prime(d);
        if (n.bits() <= largest) return std::pair(static_cast<int>(n.bits()), d);
        if ((-n).bits() <= largest) return std::pair(-static_cast<int>((-n).bits()), d);
    }
    return std::nullopt;
}

std::string ratio_text(const std::pair<int, int>& number, const Powers& powers,
                       const std::vector<Steady>& steady) {
    std::string result;
    const auto multiply = [&](const std::string& by) {
        result += (result.empty() || result == "-" ? "" : "*") + by;
    };
    if (number.first < 0) result = "-";
    if (std::abs(number.first) != 1) multiply(std::to_string(std::abs(number.first)));
    for (const auto& [which, exponent] : powers.of)
        if (exponent > 0) multiply(steady[which].text + (exponent > 1 ? fmt::format("^{}", exponent) : ""));
    if (result.empty() || result == "-") result += "1";
    if (number.second != 1) result += fmt::format("/{}", number.second);
    for (const auto& [which, exponent] : powers.of)
        if (exponent < 0)
            result += "/" + steady[which].text + (exponent < -1 ? fmt::format("^{}", -exponent) : "");
    return result;
}

}  // namespace

std::vector<Absent> absent_terms(const Program& program, int residual, const std::vector<int>& terms,
                                 const std::vector<Steady>& steady, const std::vector<ModularPoint>& points) {
    constexpr std::size_t needed = 3;
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
    std::vector<Prime> ratios;
    for (const Steady& s : steady) ratios.push_back(at[1].value[s.node] * at[0].value[s.node].inverse());
    const std::map<Prime, Powers> table = table_of(ratios);

    std::vector<std::pair<int, Absent>> found_terms;
    for (std::size_t k = 0; k < terms.size(); ++k) {
        std::array<Prime, needed> c;
        bool nonzero = true;
        for (std::size_t s = 0; s < needed; ++s) {
            const Prime t = at[s].value[terms[k]];
            nonzero = nonzero && !t.is_zero();
            c[s] = -at[s].value[residual] * t.inverse();
        }
        if (!nonzero || c[0].is_zero()) continue;
        const auto found = table.find(c[1] * c[0].inverse());
        if (found == table.end()) continue;
        std::array<Prime, needed> number;
        for (std::size_t s = 0; s < needed; ++s) {
            number[s] = c[s];
            for (const auto& [which, exponent] : found->second.of)
                number[s] *= raised(at[s].value[steady[which].node], -exponent);
        }
        const auto fraction = small_fraction(number[0]);
        if (!fraction || number[2] != number[0]) continue;
        const int effort =
            2 * found->second.size() + (std::abs(fraction->first) != 1 ? 1 : 0) + (fraction->second != 1 ? 1 : 0);
        found_terms.emplace_back(effort, Absent{k, ratio_text(*fraction, found->second, steady)});
    }
    std::stable_sort(found_terms.begin(), found_terms.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Absent> result;
    for (auto& [effort, term] : found_terms) result.push_back(std::move(term));
    return result;
}

}  // namespace alembert
