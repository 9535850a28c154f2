// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/named_function.hpp"

#include "program/constants.hpp"
#include "program/flatten.hpp"
#include "program/rewriting.hpp"
#include "program/share.hpp"

namespace alembert {

namespace {

int operations_of(const Program& program) {
    return program.count(program.right_hand_side()).total();
}

}  // namespace

NamedFunction absorbed(Program& program, const FunctionProgram& function) {
    NamedFunction result{
        .name = function.name, .about = function.about, .rows = function.rows, .columns = function.columns};
    Rewriting rewriting(function.program, std::move(program));
    program = rewriting.finish([&](int id) { return rewriting.plain(id); });
    const std::vector<int> all = program.nodes_of(Group::function);
    const auto own = static_cast<std::ptrdiff_t>(function.program.nodes_of(Group::function).size());
    result.nodes.assign(all.end() - own, all.end());
    result.operations = program.count(result.nodes);
    return result;
}

Program with_values_only(Program program, const std::vector<int>& values) {
    // The rewritings count the operations of accelerations, so the values take their place.
    program.roots.clear();
    for (const int node : values) program.roots.push_back({Group::acceleration, "", node});
    program = program.canonical();
    Program best = with_simple_constants(shared(program));
    if (Program flat = with_simple_constants(shared(flattened(program)));
        operations_of(flat) < operations_of(best))
        best = std::move(flat);
    best = without_swallowed_constants(best);
    for (Root& root : best.roots) root.group = Group::function;
    return best;
}

}  // namespace alembert
