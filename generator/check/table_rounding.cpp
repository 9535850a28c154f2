// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/table_rounding.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/symbolic/intermediates.hpp"
#include "algebra/symbolic/unspecified.hpp"
#include "program/rounding.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

bool calls_table(const Mechanism& m, const ex& e) {
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (const auto call = unspecified_call(*part); call && m.table_of(call->function) != nullptr) return true;
    return false;
}

bool equations_call_tables(const Mechanism& m, const Equations& equations) {
    if (std::all_of(m.tables.begin(), m.tables.end(), [](const auto& table) { return table == nullptr; }))
        return false;
    if (equations.M.rows() == 0 || !equations.z) return true;  // the equations are not written out
    const Intermediates& z = *equations.z;
    std::vector<GiNaC::symbol> by_table;
    for (const Intermediates::Entry& entry : z.entries())
        if (calls_table(m, entry.definition) || z.depends(entry.definition, by_table))
            by_table.push_back(entry.symbol);
    const auto has = [&](const ex& e) { return calls_table(m, e) || z.depends(e, by_table); };
    const auto any = [&](const std::vector<ex>& list) { return std::any_of(list.begin(), list.end(), has); };
    for (unsigned k = 0; k < equations.M.nops(); ++k)
        if (has(equations.M.op(k))) return true;
    return any(equations.own) || any(equations.dissipative) || any(equations.applied) || any(equations.gamma) ||
           any(equations.h) || std::any_of(equations.A.begin(), equations.A.end(), any);
}

/// The state in doubles; what it has no value for is 0.
State<double> in_doubles(const Program& p, const RealState& state) {
    State<double> result{};
    const auto list_of = [&](Variable::Kind kind) -> std::vector<double>& {
        return kind == Variable::Kind::parameter      ? result.parameters
               : kind == Variable::Kind::coordinate   ? result.q
               : kind == Variable::Kind::rate         ? result.qdot
               : kind == Variable::Kind::acceleration ? result.qddot
                                                      : result.unknown;
    };
    for (int id = 0; id < p.size(); ++id) {
        if (p[id].op != Op::variable) continue;
        const Variable& v = p[id].variable;
        const auto known = state.value.find({v.kind, v.index});
        const double value = known == state.value.end() ? 0 : known->second.to_double();
        if (v.kind == Variable::Kind::time) {
            result.t = value;
            continue;
        }
        std::vector<double>& list = list_of(v.kind);
        list.resize(std::max(list.size(), static_cast<std::size_t>(v.index) + 1), 0);
        list[static_cast<std::size_t>(v.index)] = value;
    }
    return result;
}

/// How much larger the terms from which a derivative of a table is made are than its value.
double cancelled_in(const TabulatedFunction& table, const Program::TableCall& call, double value) {
    constexpr double most = 1e9;
    double scale = 0;
    for (const double c : table.coefficients()) scale = std::max(scale, std::abs(c));
    for (std::size_t k = 0; k < call.arguments; ++k) {
        const std::vector<double>& at = table.axes()[k].at;
        double gap = at.back() - at.front();
        for (std::size_t i = 1; i < at.size(); ++i) gap = std::min(gap, at[i] - at[i - 1]);
        scale /= std::pow(gap, call.orders[k]);
    }
    return std::abs(value) * most > scale ? scale / std::abs(value) : most;
}

}  // namespace

TableRounding::TableRounding(const Told& told)
    : in_equations_(equations_call_tables(told.mechanism, told.equations)) {}

bool TableRounding::explains(const Program& p, int root, const RealState& state,
                             const GiNaC::numeric& residual) const {
    constexpr double of_terms = 1e-12, unit = 1e-15;
    const int roots[] = {root};
    std::vector<int> calls;
    for (const int id : p.needed(roots))
        if (p[id].op == Op::unspecified && p.table_of(p[id]) != nullptr) calls.push_back(id);
    if (calls.empty() && !in_equations_) return false;
    const State<double> here = in_doubles(p, state);
    const std::vector<double> sizes = sizes_of_terms(p, here), value = interpret(p, here);
    double allowed = of_terms;
    for (const int id : calls) {
        const Program::TableCall call = p.table_call(p[id]);
        if (call.orders[0] + call.orders[1] > 0)
            allowed = std::max(allowed,
                               unit * cancelled_in(*p.table_of(p[id]), call, value[static_cast<std::size_t>(id)]));
    }
    return std::abs(residual.to_double()) <= allowed * sizes[static_cast<std::size_t>(root)];
}

}  // namespace alembert
