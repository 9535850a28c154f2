// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/lower.hpp"

#include <algorithm>

#include "program/lower/lowering.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::ex_to;

Program begun(const Mechanism& m, bool fold) {
    Program program;
    program.source_labels = m.z->source_labels();
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.independent && (!fold || p.from_outside))
            program.parameters.push_back({.name = p.symbol.get_name(),
                                          .unit = p.unit,
                                          .value = p.number().to_double(),
                                          .from_outside = p.from_outside});
    for (int i = 0; i < m.size(); ++i) program.coordinates.push_back({m.q[i].get_name(), m.units[i]});
    program.name = m.name;
    return program;
}

namespace {

/// The positions of alignments whose joints have all their rows, kept or left out.
std::vector<int> closed_joints(const Mechanism& m) {
    std::vector<int> result;
    for (std::size_t k = 0; k < m.alignments.size(); ++k) {
        std::size_t rows = 0;
        for (const auto* list : {&m.constraints, &m.redundant})
            rows += static_cast<std::size_t>(
                std::count_if(list->begin(), list->end(),
                              [&](const Mechanism::Constraint& c) { return c.joint == m.alignments[k].joint; }));
        if (rows >= m.alignments[k].rows) result.push_back(static_cast<int>(k));
    }
    return result;
}

}  // namespace

Program lower_constraints(const Mechanism& m) {
    Program program = begun(m, false);
    Lowering lowering(program, m, false);
    std::vector<ex> wanted;
    const auto want = [&](const std::vector<ex>& row, const ex& value, const ex& offset) {
        wanted.insert(wanted.end(), row.begin(), row.end());
        wanted.insert(wanted.end(), {value, offset});
    };
    for (const Mechanism::Constraint& c : m.constraints) want(c.row, c.position.value_or(0), c.offset);
    for (const Mechanism::Speed& s : m.speeds) want(s.row, s.form, s.offset);
    const std::vector<int> closed = closed_joints(m);
    for (const int k : closed) {
        const std::vector<ex>& between = m.alignments[static_cast<std::size_t>(k)].between;
        wanted.insert(wanted.end(), between.begin(), between.end());
    }
    lowering.lower_definitions(wanted);
    const auto linear = [&](const std::vector<ex>& row, const ex& offset, Group group) {
        std::vector<Program::Term> value{{1, lowering(offset)}};
        for (int i = 0; i < m.size(); ++i) {
            const int entry = lowering(row[i]);
            program.roots.push_back({group, "", entry});
            value.emplace_back(1, program.product(1, {{entry, 1}, {lowering(m.qdot[i]), 1}}));
        }
        return program.sum(0, value);
    };
    for (const Mechanism::Constraint& c : m.constraints) {
        program.roots.push_back({Group::velocity, c.name, linear(c.row, c.offset, Group::row)});
        program.roots.push_back({Group::position, c.name, c.position ? lowering(*c.position) : program.number(0)});
    }
    for (const Mechanism::Speed& s : m.speeds)
        program.roots.push_back({Group::speed, s.u.get_name(), linear(s.row, s.offset, Group::form_row)});
    for (const int k : closed)
        for (const ex& product : m.alignments[static_cast<std::size_t>(k)].between)
            program.roots.push_back({Group::alignment, "", lowering(product), k});
    return program.canonical();
}

int lower_expression(Program& program, const Mechanism& mechanism, const ex& e) {
    return lower_expressions(program, mechanism, {e})[0];
}

std::vector<int> lower_expressions(Program& program, const Mechanism& mechanism, const std::vector<ex>& list,
                                   const std::vector<std::pair<GiNaC::symbol, int>>& given) {
    Lowering lowering(program, mechanism, false);
    for (const auto& [symbol, node] : given) lowering.define(symbol, node);
    lowering.lower_definitions(list);
    std::vector<int> nodes;
    for (const ex& e : list) nodes.push_back(lowering(e));
    return nodes;
}

std::function<int(const ex&)> lowering_into(Program& program, const Mechanism& mechanism,
                                            const std::vector<std::pair<GiNaC::symbol, int>>& given, bool fold) {
    const auto lowering = std::make_shared<Lowering>(program, mechanism, fold);
    for (const auto& [symbol, node] : given) lowering->define(symbol, node);
    return [lowering](const ex& e) {
        lowering->lower_definitions({e});
        return (*lowering)(e);
    };
}

}  // namespace alembert
