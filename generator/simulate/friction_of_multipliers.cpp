// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/friction_of_multipliers.hpp"

#include "program/interpret.hpp"

namespace alembert {

namespace {

struct Columns {
    const Program& program;
    std::recursive_mutex& symbols;
    std::vector<Root> entries = {};
    Eigen::Index speeds = 0, constraints = 0;

    Eigen::MatrixXd at(const State<double>& state) const {
        const std::lock_guard lock(symbols);
        const std::vector<double> value = interpret(program, state);
        Eigen::MatrixXd C = Eigen::MatrixXd::Zero(speeds, constraints);
        for (std::size_t k = 0; k < entries.size(); ++k)
            C(static_cast<Eigen::Index>(k) % speeds, entries[k].constraint) =
                value[static_cast<std::size_t>(entries[k].node)];
        return C;
    }
};

}  // namespace

FrictionAt friction_of_multipliers(const Program& program, std::recursive_mutex& symbols) {
    auto columns = std::make_shared<Columns>(Columns{program, symbols});
    for (const Root& root : program.roots)
        if (root.group == Group::friction_column) columns->entries.push_back(root);
    if (columns->entries.empty()) return [](const std::vector<double>&) { return ForcesOfMultipliers(); };
    columns->speeds = static_cast<Eigen::Index>(program.nodes_of(Group::acceleration).size());
    columns->constraints = static_cast<Eigen::Index>(program.nodes_of(Group::velocity).size());
    return [columns = std::shared_ptr<const Columns>(columns)](const std::vector<double>& values) {
        return [columns, values](double t, const double* y) {
            const auto n = columns->program.coordinates.size();
            return columns->at({.parameters = values,
                                .t = t,
                                .q = {y, y + n},
                                .qdot = {y + n, y + n + columns->speeds},
                                .qddot = {}});
        };
    };
}

}  // namespace alembert
