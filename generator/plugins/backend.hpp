// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// SUNDIALS as a back end of `simulate`: a separate shared object, `alembert-sundials.so`, which CMake builds if
/// it finds libsundials-dev. The program loads it when it is needed (simulate/sundials_methods.hpp), so that
/// nothing of SUNDIALS is linked into either the program or the runtime.
///
/// cvode: y' = f(t, y) by BDF with variable order, Newton's method with the Jacobian of the Rhs if it has one, and
/// System::project as CVODE's projection. ida: without constraints the same equations in implicit form; with
/// constraints the stabilized index-2 form of Gear, Gupta and Leimkuhler (Hairer & Wanner, Solving ODEs II,
/// §VII.2) in q, u, λ and μ,
///
///     q' = u + Aᵀμ,   M u' = f + Aᵀλ,   0 = f(q, t),   0 = A u + b
///
/// Where signs are held, among them those of friction that changes λ, the second equation is u' = a + Aᵀλ instead,
/// with the accelerations a of the Rhs; λ is then 0 but for errors.
///
/// Events are looked for in the polynomial of each step, and located on it, as in the runtime's own methods.
///
/// Local errors are compared with tolerance · max(1, |y|) in SUNDIALS' norm, the root of the mean square.

#include <vector>

#include "alembert/native/module.hpp"
#include "alembert/ode/integrate.hpp"

namespace alembert {

struct Backend {
    int version;
    Integrator (*cvode)();
    /// `parameters` as for make_rhs. The state is (q, q'), followed by the work if the Rhs has it. With
    /// `has_signs` the last parameters are signs, which the Rhs knows and these do not.
    Integrator (*ida)(const Module& module, const std::vector<double>& parameters, bool has_signs);
};

inline constexpr int backend_version =
    4;  ///< raised whenever this struct, System, Options, RunPiece or Trajectory changes
inline constexpr const char* backend_function = "alembert_backend";

}  // namespace alembert
