// SPDX-License-Identifier: MIT
#include "alembert/ode/hamiltonian_system.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace alembert {

std::shared_ptr<const HamiltonianSystem> make_canonical(const Module& module, const Module& form,
                                                        const std::vector<double>& values) {
    const alembert_solver_table& table = module.table();
    HamiltonianSystem result{.coordinates = table.coordinates, .constraints = module.independent_constraints()};
    if (table.speed_names != nullptr || form.table().coordinates != table.coordinates ||
        form.table().outputs != result.form_size())
        throw std::invalid_argument(
            fmt::format("{}: momenta need a system in its rates and a file with {} outputs, this one has {}",
                        table.scene, result.form_size(), form.table().outputs));
    result.form = [form, par = prepared(form, values)](double t, const double* state, double* out) {
        form.table().outputs_at(t, state, nullptr, par.data(), out);
    };
    result.held = [module, par = prepared(module, values)](double t, const double* state, double* position,
                                                           double* velocity, double* rows) {
        const auto all = static_cast<std::size_t>(module.table().constraints),
                   independent = static_cast<std::size_t>(module.independent_constraints()),
                   n = static_cast<std::size_t>(module.table().coordinates);
        if (all == independent)
            return module.table().constraints_at(t, state, par.data(), position, velocity, rows);
        std::vector<double> off(2 * all), each(all * n);
        module.table().constraints_at(t, state, par.data(), off.data(), off.data() + all, each.data());
        std::copy_n(off.begin(), independent, position);
        std::copy_n(off.data() + all, independent, velocity);
        std::copy_n(each.begin(), independent * n, rows);
    };
    return std::make_shared<const HamiltonianSystem>(std::move(result));
}

}  // namespace alembert
