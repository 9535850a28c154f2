// SPDX-License-Identifier: MIT
#include "alembert/ode/rhs.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace alembert {
namespace {

struct Emitted {
    Module module;
    std::vector<double> par;
};

void rate_of(const void* context, double t, const double* state, double* rate) {
    const auto& solver = *static_cast<const Emitted*>(context);
    solver.module.table().rhs(t, state, solver.par.data(), rate);
}

void rate_and_power(const void* context, double t, const double* state, double* rate) {
    const auto& solver = *static_cast<const Emitted*>(context);
    const alembert_solver_table& table = solver.module.table();
    double energy[4];
    double jacobi = 0;
    table.rhs(t, state, solver.par.data(), rate);
    table.energy(t, state, rate, solver.par.data(), energy, &jacobi);
    rate[table.coordinates + table.speeds] = energy[3];
}

void energies_of(const void* context, double t, const double* state, double* kinetic_potential) {
    const auto& solver = *static_cast<const Emitted*>(context);
    const alembert_solver_table& table = solver.module.table();
    thread_local std::vector<double> no_rate;  // only the power depends on it
    no_rate.resize(static_cast<std::size_t>(table.coordinates + table.speeds));
    double energy[4], jacobi = 0;
    table.energy(t, state, no_rate.data(), solver.par.data(), energy, &jacobi);
    std::copy_n(energy, 2, kinetic_potential);
}

/// With a quadrature the dimension is larger by one, and the row of the power belongs to it; without, that row is
/// left out.
template <int quadratures>
void derivative_of(const void* context, double t, const double* state, double* values) {
    const auto& solver = *static_cast<const Emitted*>(context);
    const alembert_solver_table& table = solver.module.table();
    const alembert_derivative_table& derivatives = *solver.module.derivatives();
    const int dimension = table.coordinates + table.speeds + quadratures;
    thread_local std::vector<double> entries;
    entries.resize(static_cast<std::size_t>(derivatives.entries));
    derivatives.jacobian(t, state, solver.par.data(), entries.data());
    std::fill_n(values, dimension * dimension, 0.0);
    for (int k = 0; k < derivatives.entries; ++k)
        if (derivatives.rows[k] < dimension)
            values[derivatives.columns[k] * dimension + derivatives.rows[k]] =
                entries[static_cast<std::size_t>(k)];
}

}  // namespace

std::string Rhs::describe(int component) const {
    const auto index = static_cast<std::size_t>(component);
    return index < names.size() ? fmt::format("{} (component {})", names[index], component)
                                : fmt::format("component {}", component);
}

Rhs make_rhs(const Module& module, const std::vector<double>& values, Work work) {
    const alembert_solver_table& table = module.table();
    const bool with_work = work == Work::integrated;
    Rhs rhs{.dimension = table.coordinates + table.speeds + (with_work ? 1 : 0),
            .extra = with_work ? 1 : 0,
            .names = {},
            .context = std::make_shared<const Emitted>(Emitted{module, prepared(module, values)}),
            .call = with_work ? rate_and_power : rate_of,
            .jacobian = nullptr};
    rhs.energies = energies_of;
    rhs.needed_state = module.needed_state();
    if (module.derivatives() != nullptr) rhs.jacobian = with_work ? derivative_of<1> : derivative_of<0>;
    for (int i = 0; i < table.coordinates; ++i) rhs.names.emplace_back(table.coordinate_names[i]);
    for (int i = 0; i < table.speeds; ++i)
        rhs.names.push_back(table.speed_names != nullptr ? table.speed_names[i]
                                                         : std::string(table.coordinate_names[i]) + "'");
    if (with_work) rhs.names.emplace_back("work");
    return rhs;
}

}  // namespace alembert
