// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/derive/intermediate_form.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "program/lower/lower.hpp"

namespace alembert {

namespace {

using namespace phrases;

constexpr int widest = 8;  // the most operations in one definition

class Unfolding {
public:
    Unfolding(const Program& program, const Mechanism& mechanism, const Equations& equations)
        : p_(program), m_(mechanism), e_(equations) {
        for (const GiNaC::symbol& s : m_.symbols->all())
            if (!m_.symbols->info(s).intermediate) taken_.insert(m_.symbols->info(s).name);
    }

    void define(const std::vector<int>& roots) {
        const std::vector<int> order = p_.needed(roots);
        std::map<int, int> uses, length;
        for (const int root : roots) ++uses[root];
        for (const int id : order)
            for (const int arg : p_[id].args) ++uses[arg];
        for (const int id : order) {
            const Node& node = p_[id];
            if (node.args.empty()) continue;
            const bool negation = node.is_scaled() && cln::equal(node.coefficients[0], -1);
            for (const int arg : node.args) length[id] += 1 + (known_.contains(arg) ? 0 : length[arg]);
            if (!negation && (uses[id] > 1 || length[id] > widest)) {
                Phrase value = unfolded(node);
                known_.emplace(id, fresh());
                definitions.emplace_back(known_.at(id), std::move(value));
            }
        }
    }

    Phrase of(int id) const {
        const auto found = known_.find(id);
        return found != known_.end() ? found->second : unfolded(p_[id]);
    }

    std::vector<std::pair<Phrase, Phrase>> definitions;

private:
    Phrase fresh() {
        SymbolInfo info;
        do info.name = fmt::format("z{}", ++count_);
        while (taken_.contains(info.name));
        return symbol(GiNaC::symbol(info.name), info);
    }

    Phrase symbol_of(const GiNaC::symbol& s) const { return symbol(s, m_.symbols->info(s)); }

    Phrase variable(const Variable& v) const {
        switch (v.kind) {
            case Variable::Kind::time:
                return symbol_of(m_.t);
            case Variable::Kind::coordinate:
                return symbol_of(m_.q[v.index]);
            case Variable::Kind::rate:
                return symbol_of(v.index < m_.size() ? e_.u[v.index]
                                                     : m_.states[v.index - m_.size()].derivative[0]);
            case Variable::Kind::acceleration:
                return symbol_of(e_.udot[v.index]);
            case Variable::Kind::unknown:
                return symbol_of(m_.frictions[static_cast<std::size_t>(v.index)].multiplier.value());
            case Variable::Kind::parameter:
                break;
        }
        int position = v.index;
        for (const Mechanism::Parameter& p : m_.parameters)
            if (p.independent && position-- == 0) return symbol_of(p.symbol);
        throw std::out_of_range("parameter");
    }

    Phrase unfolded(const Node& node) const {
        switch (node.op) {
            case Op::number:
                return number(node.number);
            case Op::pi:
                return pi();
            case Op::variable:
                return variable(node.variable);
            case Op::sum: {
                std::vector<Phrase> terms;
                for (std::size_t k = 0; k < node.args.size(); ++k) {
                    const Rational size = cln::abs(node.coefficients[k]);
                    Phrase term = of(node.args[k]);
                    if (!cln::equal(size, 1)) term = product({number(size), std::move(term)});
                    terms.push_back(cln::minusp(node.coefficients[k]) ? negative(std::move(term))
                                                                      : std::move(term));
                }
                if (!cln::zerop(node.number)) terms.push_back(number(node.number));
                return sum(std::move(terms));
            }
            case Op::product: {
                std::vector<Phrase> factors;
                for (std::size_t k = 0; k < node.args.size(); ++k) {
                    Phrase factor = of(node.args[k]);
                    if (node.exponents[k] == -1)
                        factors.push_back(quotient(number(1), std::move(factor)));
                    else
                        factors.push_back(node.exponents[k] == 1
                                              ? std::move(factor)
                                              : power(std::move(factor), Rational(node.exponents[k])));
                }
                return product(std::move(factors));
            }
            case Op::pow:
                return power(of(node.args[0]), of(node.args[1]));
            default: {
                std::vector<Phrase> args;
                for (const int arg : node.args) args.push_back(of(arg));
                if (node.op == Op::sqrt) return power(std::move(args[0]), Rational(1) / 2);
                return call(name_of(node.op), std::move(args));
            }
        }
    }

    const Program& p_;
    const Mechanism& m_;
    const Equations& e_;
    std::set<std::string> taken_;
    std::map<int, Phrase> known_;
    int count_ = 0;
};

}  // namespace

namespace {

/// Nodes of expressions in q, q' and t; what stands for q' in equations in speeds are the nodes of `h`.
std::vector<int> nodes_of(const std::vector<GiNaC::ex>& list, Program& program, const Mechanism& m,
                          const Equations& e, const std::vector<int>& h) {
    std::vector<std::pair<GiNaC::symbol, int>> given;
    for (std::size_t i = 0; i < h.size(); ++i) given.emplace_back(m.qdot[i], h[i]);
    for (int k = 0; k < e.size() && !h.empty(); ++k)
        given.emplace_back(e.u[k], program.variable({Variable::Kind::rate, k}));
    for (auto k = static_cast<int>(m.frictions.size()); k-- > 0;)
        if (const auto& reaction = m.frictions[static_cast<std::size_t>(k)].multiplier)
            given.emplace_back(*reaction, program.variable({Variable::Kind::unknown, k}));
    return lower_expressions(program, m, list, given);
}

}  // namespace

IntermediateForm intermediate_form(Program program, const Mechanism& m, const Equations& e,
                                   const std::vector<GiNaC::ex>& others) {
    std::vector<Mechanism::Constraint> held = m.constraints;
    // Constraints that follow from others have their share of the forces.
    if (e.speeds_are_rates() && !e.A.empty()) {
        const auto lowering = lowering_into(program, m, {});
        for (const Mechanism::Constraint& c : m.redundant)
            for (const GiNaC::ex& entry : c.row)
                program.roots.push_back({.group = Group::row, .name = c.name, .node = lowering(entry)});
        held.insert(held.end(), m.redundant.begin(), m.redundant.end());
    }
    const std::vector<int> mass = program.nodes_of(Group::mass), forcing = program.nodes_of(Group::forcing);
    const int kinetic = program.nodes_of(Group::kinetic)[0], potential = program.nodes_of(Group::potential)[0];
    std::vector<int> roots = mass;
    roots.insert(roots.end(), forcing.begin(), forcing.end());
    const bool own_speeds = !program.speeds.empty();
    const std::vector<int> rows = program.nodes_of(own_speeds ? Group::speed_row : Group::row),
                           h = program.nodes_of(Group::rate);
    roots.insert(roots.end(), rows.begin(), rows.end());
    roots.insert(roots.end(), h.begin(), h.end());
    roots.push_back(kinetic);
    roots.push_back(potential);
    const std::vector<int> other_nodes = nodes_of(others, program, m, e, h);
    roots.insert(roots.end(), other_nodes.begin(), other_nodes.end());
    Unfolding unfolding(program, m, e);
    unfolding.define(roots);

    IntermediateForm form;
    const int n = e.size();
    for (int i = 0; i < n; ++i) {
        std::vector<Phrase> terms;
        for (int j = 0; j < n; ++j) {
            const int row = std::max(i, j), column = std::min(i, j);
            const int entry = mass[row * (row + 1) / 2 + column];
            if (program.is_zero(entry)) continue;
            const Phrase acceleration = phrases::symbol(e.udot[j], m.symbols->info(e.udot[j]));
            const Node& node = program[entry];
            const bool is_one = node.is_number() && cln::equal(node.number, 1);
            terms.push_back(is_one ? acceleration : phrases::product({unfolding.of(entry), acceleration}));
        }
        if (!program.is_zero(forcing[i])) terms.push_back(phrases::negative(unfolding.of(forcing[i])));
        for (std::size_t k = 0; k < held.size(); ++k) {
            const int entry = rows[k * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)];
            const GiNaC::symbol& lambda = held[k].multiplier;
            if (!program.is_zero(entry))
                terms.push_back(phrases::negative(
                    phrases::product({unfolding.of(entry), phrases::symbol(lambda, m.symbols->info(lambda))})));
        }
        form.equations.push_back(
            {.lhs = phrases::sum(std::move(terms)), .rhs = phrases::number(0), .divided_by = {}});
    }
    for (std::size_t i = 0; i < h.size(); ++i)
        form.kinematics.emplace_back(phrases::symbol(m.qdot[i], m.symbols->info(m.qdot[i])), unfolding.of(h[i]));
    form.kinetic = unfolding.of(kinetic);
    form.potential = unfolding.of(potential);
    for (const int node : other_nodes) form.others.push_back(unfolding.of(node));
    form.definitions = std::move(unfolding.definitions);
    return form;
}

}  // namespace alembert
