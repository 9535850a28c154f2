// SPDX-License-Identifier: GPL-2.0-or-later
// The statements of order 0: values computed by the functions themselves, and the factors of the linear system.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "alembert/base/error.hpp"
#include "codegen/emit/series_writer.hpp"
#include "codegen/emit/writer.hpp"
#include "program/solve.hpp"

namespace alembert {

using Kind = SeriesNode::Kind;

namespace {

bool is_pair(Kind kind) {
    return kind == Kind::sine || kind == Kind::cosine;
}

}  // namespace

/// Powers with small whole or half exponents are written without `pow`.
CodeExpression SeriesWriter::power_at_zero(const Weight& exponent, const CodeExpression& base) {
    const Rational size = cln::abs(exponent.number);
    if (exponent.constant >= 0 || !cln::equal(cln::denominator(size), 2) || size > 4)
        return fmt::format("pow({}, {})", base.text, number(exponent).text);
    CodeExpression power = fmt::format("sqrt({})", base.text);
    for (Rational rest = size; rest > 1; rest = rest - 1) power = base * power;
    return cln::minusp(exponent.number)
               ? CodeExpression{fmt::format("Real(1) / ({})", power.text), CodeExpression::Kind::product, 1}
               : power;
}

CodeExpression SeriesWriter::value_at_zero(int id, const View& v) {
    const SeriesNode& x = node(id);
    const auto first = [&](int arg) { return v.first(arg); };
    const auto call = [&](const char* function) -> CodeExpression {
        return fmt::format("{}({})", function, first(x.a).text);
    };
    std::vector<Piece> pieces;
    std::size_t term = 0;
    for (const auto& [weight, a] : x.linear) pieces.push_back(v.piece(term++, weight, first(a)));
    for (const auto& [weight, a, b] : x.bilinear) pieces.push_back(v.piece(term++, weight, first(a) * first(b)));
    for (const Weight& weight : x.constants) pieces.push_back(piece(weight, {}));
    switch (x.kind) {
        case Kind::quotient:
            return {fmt::format("{} / {}", bracketed(joined(pieces)).text, first(x.w).text),
                    CodeExpression::Kind::product, 1};
        case Kind::root:
            return call("sqrt");
        case Kind::power:
            return power_at_zero(x.exponent, first(x.a));
        case Kind::sine:
            return call("sin");
        case Kind::cosine:
            return call("cos");
        case Kind::hyperbolic_sine:
            return call("sinh");
        case Kind::hyperbolic_cosine:
            return call("cosh");
        case Kind::exponential:
            return call("exp");
        case Kind::area:
        case Kind::ratio:
            return call(name_of(x.op));
        case Kind::turn:
            return fmt::format("atan2({}, {})", first(x.a).text, first(x.b).text);
        default:
            return joined(pieces);
    }
}

bool SeriesWriter::is_vector_at_zero(const SeriesPack& pack) const {
    const SeriesNode& x = node(pack.nodes[0]);
    const auto plain = [&](int id) { return node(id).constants.empty(); };
    return !pack.by_lanes &&
           (x.kind == Kind::sum || x.kind == Kind::quotient || x.kind == Kind::root || x.kind == Kind::power) &&
           std::all_of(pack.nodes.begin(), pack.nodes.end(), plain);
}

void SeriesWriter::add_pack_at_zero(std::vector<CodeStatement>& lines, int number) {
    const SeriesPack& pack = lanes_.packs()[number];
    const SeriesNode& leader = node(pack.nodes[0]);
    const std::string& column = packs_[number].column;
    for (const int source : copies_needed_now(pack)) add_copy(lines, source, true);
    if (leader.kind != Kind::root && leader.kind != Kind::power) {
        lines.push_back(over_lanes(pack, column + " + l", value_at_zero(pack.nodes[0], view_of_pack(number))));
        return;
    }
    const CodeExpression base = packs_[lanes_.source_of(pack, leader.a)].column + "[l]";
    const CodeExpression value =
        leader.kind == Kind::root ? fmt::format("sqrt({})", base.text) : power_at_zero(leader.exponent, base);
    lines.push_back(
        {.text = fmt::format("for (int l = 0; l < {}; ++l) {}[l] = {};", pack.padded(), column, value.text)});
}

/// Adds everything that is ready, except sines; false if there was nothing.
bool SeriesWriter::add_ready_at_zero(std::vector<CodeStatement>& lines, std::vector<char>& done, bool solved) {
    bool moved = false;
    const auto ready = [&](int id) {
        const std::vector<int> list = arguments_of(node(id));
        return done[id] == 0 && std::all_of(list.begin(), list.end(), [&](int arg) { return done[arg] != 0; });
    };
    for (int id = 0; id < size(); ++id) {
        if (!ready(id) || is_pair(node(id).kind) || (node(id).kind == Kind::unknown && !solved)) continue;
        if (lanes_.is_packed(id) && is_vector_at_zero(pack_of(id))) {
            const std::vector<int>& nodes = pack_of(id).nodes;
            if (!std::all_of(nodes.begin(), nodes.end(), ready)) continue;
            add_pack_at_zero(lines, lanes_.pack(id));
            for (const int lane : nodes) done[lane] = 1;
        } else {
            if (node(id).kind != Kind::unknown) lines.push_back({.text = statement_at_zero(id)});
            done[id] = 1;
        }
        moved = true;
    }
    return moved;
}

/// Adds everything that is ready, then all sines that are ready together, until nothing is left.
std::vector<CodeStatement> SeriesWriter::order_zero() {
    std::vector<CodeStatement> lines;
    std::vector<char> done(r_.nodes.size(), 0);
    bool solved = r_.matrix.empty();
    for (bool moved = true; moved;) {
        moved = add_ready_at_zero(lines, done, solved);
        if (moved) continue;
        std::vector<int> pairs;
        for (int id = 0; id < size() && pairs.size() < processor::widest_sincos; ++id)
            if (node(id).kind == Kind::sine && done[id] == 0 && done[node(id).a] != 0) pairs.push_back(id);
        if (!pairs.empty()) {
            add_sines(lines, pairs);
            for (const int id : pairs) done[id] = done[node(id).w] = 1;
            moved = true;
        } else if (!solved) {
            const std::vector<CodeStatement> solution = solution_at_zero();
            lines.insert(lines.end(), solution.begin(), solution.end());
            solved = moved = true;
        }
    }
    for (std::size_t p = 0; p < packs_.size(); ++p)  // the packs that only the products need
        if (lanes_.packs()[p].is_copy) add_copy(lines, static_cast<int>(p), true);
    add_inverses(lines);
    return lines;
}

void SeriesWriter::add_sines(std::vector<CodeStatement>& lines, const std::vector<int>& pairs) {
    const std::string both = names_.numbered("both");
    std::string angles;
    for (const int id : pairs) angles += (angles.empty() ? "" : ", ") + first(node(id).a).text;
    lines.push_back({.text = fmt::format("const auto {} = sincos({});", both, angles)});
    const auto take = [&](int id, const std::string& part) {
        lines.push_back({.text = fmt::format("{}{} = {}.{};", lanes_.is_packed(id) ? "" : "const Real ",
                                             first(id).text, both, part)});
    };
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        take(pairs[i], pairs.size() == 1 ? "s" : fmt::format("sine[{}]", i));
        take(node(pairs[i]).w, pairs.size() == 1 ? "c" : fmt::format("cosine[{}]", i));
    }
}

std::string SeriesWriter::statement_at_zero(int id) {
    const SeriesNode& x = node(id);
    const std::string to = first(id).text;
    switch (x.kind) {
        case Kind::time:
            return fmt::format("const Real {} = t;", to);
        case Kind::coordinate:
            return fmt::format("const Real {} = state[{}];", to, x.index);
        case Kind::speed:
            return fmt::format("const Real {} = state[{}];", to, n_ + x.index);
        case Kind::work:
            return fmt::format("const Real {} = state[{}];", to, n_ + s_);
        default:
            return fmt::format("{}{} = {};", lanes_.is_packed(id) ? "" : "const Real ", to,
                               value_at_zero(id, view(id)).text);
    }
}

/// Adds the inverses of the divisors that every order uses, and the weights of lanes.
void SeriesWriter::add_inverses(std::vector<CodeStatement>& lines) {
    const std::vector<SeriesPack>& packs = lanes_.packs();
    for (const SeriesPack& pack : packs) {
        if (pack.is_copy || pack.by_lanes) continue;
        const int of = divisor_of(r_, pack.nodes[0]);
        if (of < 0) continue;
        const int source = lanes_.source_of(pack, of);
        PackNames& names = packs_[source];
        if (!names.inverse.empty()) continue;
        names.inverse = names_.fresh("per_" + names.column);
        lines.push_back({.text = fmt::format(
                             "for (int l = 0; l < {}; l += lanes<Real>) put({} + l, Real(1) / loaded({} + l));",
                             packs[source].padded(), names.inverse, names.column)});
    }
    for (int id = 0; id < size(); ++id) {
        if (lanes_.is_packed(id) && !pack_of(id).by_lanes) continue;
        const int of = divisor_of(r_, id);
        if (of < 0 || !names_of_[of].inverse.empty()) continue;
        names_of_[of].inverse = names_.fresh("per_" + names_of_[of].now);
        lines.push_back(
            {.text = fmt::format("const Real {} = Real(1) / {};", names_of_[of].inverse, first(of).text)});
    }
    std::vector<CodeStatement> weights;
    for (std::size_t p = 0; p < packs.size(); ++p)
        for (std::size_t k = 0; k < packs_[p].weights.size(); ++k)
            for (std::size_t lane = 0; lane < packs[p].nodes.size() && !packs_[p].weights[k].empty(); ++lane)
                weights.push_back({.text = fmt::format("{}[{}] = {};", packs_[p].weights[k], lane,
                                                       number(packs[p].weights[k][lane]).text)});
    lines.insert(lines.begin(), weights.begin(), weights.end());
}

/// The linear system: its factors at order 0, and a function that solves it for given residuals.
std::vector<CodeStatement> SeriesWriter::solution_at_zero() {
    Program solver;
    std::map<int, std::string> leaves;
    std::vector<CodeStatement> lines;
    std::vector<int> lower, right;
    for (const SeriesEntry& e : r_.matrix) {
        if (e.node < 0 && e.constant.constant < 0) {
            lower.push_back(solver.number(e.constant.number));
            continue;
        }
        const int variable = solver.variable({Variable::Kind::parameter, static_cast<int>(lower.size())});
        lower.push_back(variable);
        leaves[variable] = e.node >= 0 ? first(e.node).text : names_.numbered("m");
        if (e.node < 0)
            lines.push_back(
                {.text = fmt::format("const Real {} = {};", leaves[variable], number(e.constant).text)});
    }
    std::string residuals, results, firsts;
    for (std::size_t i = 0; i < r_.residuals.size(); ++i) {
        right.push_back(solver.variable({Variable::Kind::unknown, static_cast<int>(i)}));
        const std::string row = names_.numbered("r");
        leaves[right.back()] = row;
        residuals += fmt::format("{}const Real& {}", i > 0 ? ", " : "", row);
        results += fmt::format(", Real& {}", now(r_.unknowns[i]).text);
        firsts += fmt::format("{}{}", i > 0 ? ", " : "", first(r_.unknowns[i]).text);
    }
    const auto solution = solve_symmetric(solver, lower, right, r_.preferred);
    if (!solution)
        throw ModelError("the mass matrix is singular at every state: there are no accelerations to emit");
    // Statements that do not depend on the residuals are executed once.
    std::set<int> fixed;
    for (const int id : solver.needed(*solution))
        if (!solver[id].is_constant())
            for (const int arg : solver[id].args)
                if (solver[arg].is_constant() && !solver[arg].args.empty()) fixed.insert(arg);
    std::vector<Goal> goals;
    for (const int id : fixed) goals.push_back({"Factors", names_.numbered("factor"), id, true});
    Writer factors(solver, names_, leaves);
    for (const Passage& section : factors.write(goals))
        lines.insert(lines.end(), section.statements.begin(), section.statements.end());
    for (const Goal& goal : goals) {
        if (const std::string value = factors.value(goal.node); value != goal.name)
            lines.push_back({.text = fmt::format("const Real {} = {};", goal.name, value)});
        leaves[goal.node] = goal.name;
    }
    lines.push_back({.text = fmt::format("const auto solve = [&]({}{}) __attribute__((always_inline)) {{",
                                         residuals, results)});
    Writer writer(solver, names_, leaves);
    goals.clear();
    for (const int id : *solution) goals.push_back({"Solution", "", id});
    for (const Passage& section : writer.write(goals))
        for (const CodeStatement& statement : section.statements)
            lines.push_back({.text = "    " + statement.text});
    for (std::size_t i = 0; i < solution->size(); ++i)
        lines.push_back(
            {.text = fmt::format("    {} = {};", now(r_.unknowns[i]).text, writer.value((*solution)[i]))});
    lines.push_back({.text = "};"});
    lines.push_back({.text = fmt::format("Real {};", firsts)});
    lines.push_back({.text = solve_call([&](int id) { return first(id).text; })});
    return lines;
}

std::string SeriesWriter::solve_call(const std::function<std::string(int)>& name) const {
    std::string args;
    for (const auto* list : {&r_.residuals, &r_.unknowns})
        for (const int id : *list) args += (args.empty() ? "" : ", ") + name(id);
    return fmt::format("solve({});", args);
}

std::string SeriesWriter::rates_at_zero() const {
    std::string rates;
    for (int i = 0; i < width(); ++i) rates += first(rate_node(r_, i)).text + ", ";
    return rates;
}

}  // namespace alembert
