// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/fmu/dependence.hpp"

#include <algorithm>

namespace alembert {

Dependence::Dependence(const UnitModel& model) : model_(model) {
    for (const int node : model.program.nodes_of(Group::acceleration)) accelerations_.push_back(of(node));
}

std::set<Dependence::Known> Dependence::of(int node) const {
    std::set<Known> result;
    const Program& p = model_.program;
    for (const int id : p.needed(std::vector<int>{node})) {
        if (p[id].op != Op::variable) continue;
        const auto index = static_cast<std::size_t>(p[id].variable.index);
        if (p[id].variable.kind != Variable::Kind::acceleration)
            result.emplace(p[id].variable.kind, p[id].variable.index);
        else if (index < accelerations_.size())
            result.insert(accelerations_[index].begin(), accelerations_[index].end());
    }
    return result;
}

bool Dependence::uses_rate(std::size_t input, std::size_t order) const {
    const Program& p = model_.program;
    State<double> at = model_.start;
    const FreeInput& f = model_.inputs[input];
    // Generic numbers, so that nothing vanishes by chance; the input is set, at the present time.
    for (std::vector<double>* const list : {&at.q, &at.qdot})
        for (std::size_t i = 0; i < list->size(); ++i) (*list)[i] += 0.0137 * static_cast<double>(i + 1);
    at.parameters[p.parameters.empty() ? 0 : model_.parameter(model_.input_time)] = at.t;
    at.parameters[model_.parameter(f.is_set)] = 1;
    at.parameters[model_.parameter(f.given[0])] = 0.731;
    const std::vector<double> before = interpret(p, at);
    at.parameters[model_.parameter(f.given[order])] = 0.417;
    const std::vector<double> after = interpret(p, at);
    const auto is_shown = [&](const Root& root) {
        return root.group == Group::output &&
               std::any_of(model_.inputs.begin(), model_.inputs.end(), [&](const auto& i) {
                   return std::find(i.shown.begin(), i.shown.end(), root.name) != i.shown.end();
               });
    };
    for (const Group group : {Group::acceleration, Group::rate, Group::kinetic, Group::potential, Group::power,
                              Group::output, Group::speed, Group::event, Group::position, Group::velocity})
        for (const Root& root : p.roots)
            if (root.group == group && !is_shown(root) && !(before[root.node] == after[root.node])) return true;
    return false;
}

}  // namespace alembert
