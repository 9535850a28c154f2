// SPDX-License-Identifier: MIT
#pragma once

/// A first-order system y' = f(t, y) as the integrators see it: a function pointer, what it works on, and names.
///
///     const Rhs decay = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = -y[0]; });
///     const Rhs pendulum = make_rhs(module, {1.0, 9.81});               // parameters in the scene's order
///     const Rhs driven = make_rhs(module, {}, Work::integrated);        // own values, and one more component
///
/// The last `extra` components are quadratures. They are integrated with the same stages but left out of error
/// control, and nothing may depend on them. `Work::integrated` adds one, W(t) = ∫ power dt, named "work", for the
/// work balance. A copy is cheap and shares the context, which keeps the module loaded. Calls are thread-safe if
/// the function is. If the file has derivatives, `jacobian` writes the dense matrix ∂rate/∂state, column by
/// column, quadratures included; otherwise it is null, and methods that need it use differences
/// (newton_iteration.hpp). `make_rhs` throws std::invalid_argument if the number of parameters is wrong or a count
/// makes no sense.

#include <concepts>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "alembert/native/module.hpp"
#include "alembert/ode/series.hpp"

namespace alembert {

struct HamiltonianSystem;

/// How many times as long as on the processor of cost_model.hpp evaluations and power series take on this one.
struct Slowness {
    double evaluation = 1, series = 1;
};

struct Rhs {
    using Call = void (*)(const void* context, double t, const double* state, double* rate);

    int dimension = 0;                    ///< of the state, quadratures included
    int extra = 0;                        ///< how many of the last components are quadratures
    std::vector<std::string> names = {};  ///< of the components; may be empty
    std::shared_ptr<const void> context = {};
    Call call = nullptr;
    Call jacobian = nullptr;  ///< writes dimension² numbers
    double effort = 0;  ///< about how many ns a call takes, predicted from counts (cost_model.hpp); 0: not known
    Slowness slowness = {};  ///< by which predicted times are multiplied
    Series series = {};      ///< of the motion, for the method taylor; may be missing
    std::shared_ptr<const HamiltonianSystem> canonical =
        {};  ///< momenta and constraints, for the method rattle (hamiltonian_system.hpp); may be missing
    Call energies =
        nullptr;  ///< writes T and V at a state, for regularized runs (time_transformation.hpp); may be missing
    /// Writes the rates of the components that depend on velocities alone, q and the time of a regularized system,
    /// and leaves the others; null for systems in t, where these are q' = v.
    Call drift = nullptr;
    /// The components on which the rates depend besides q' = v, −1 among them for time; null if that is not known.
    std::shared_ptr<const std::vector<int>> needed_state = {};

    void operator()(double t, const double* state, double* rate) const { call(context.get(), t, state, rate); }

    /// "theta1' (component 2)": the name of a component for messages; the first component is 0.
    std::string describe(int component) const;
};

enum class Work { left_out, integrated };

/// The emitted right-hand side with `values` for parameters (empty: the scene's own).
Rhs make_rhs(const Module& module, const std::vector<double>& values = {}, Work work = Work::left_out);

/// A right-hand side from any function f(t, const double* state, double* rate) and a Jacobian of the same form.
template <std::invocable<double, const double*, double*> Function,
          std::invocable<double, const double*, double*> Jacobian>
Rhs make_rhs(int dimension, Function function, Jacobian jacobian) {
    using Both = std::pair<Function, Jacobian>;
    if (dimension < 1) throw std::invalid_argument("a right-hand side needs at least one component");
    return {.dimension = dimension,
            .extra = 0,
            .names = {},
            .context = std::make_shared<const Both>(std::move(function), std::move(jacobian)),
            .call = [](const void* context, double t, const double* state,
                       double* rate) { static_cast<const Both*>(context)->first(t, state, rate); },
            .jacobian = [](const void* context, double t, const double* state,
                           double* values) { static_cast<const Both*>(context)->second(t, state, values); },
            .series = {},
            .canonical = {}};
}

/// Any function f(t, const double* state, double* rate).
template <std::invocable<double, const double*, double*> Function>
Rhs make_rhs(int dimension, Function function, int extra = 0) {
    if (dimension < 1 || extra < 0 || extra > dimension)
        throw std::invalid_argument(
            "a right-hand side needs at least one component, and no more quadratures than those");
    const Rhs::Call call = [](const void* context, double t, const double* state, double* rate) {
        (*static_cast<const Function*>(context))(t, state, rate);
    };
    return {.dimension = dimension,
            .extra = extra,
            .names = {},
            .context = std::make_shared<const Function>(std::move(function)),
            .call = call,
            .jacobian = nullptr,
            .series = {},
            .canonical = {}};
}

}  // namespace alembert
