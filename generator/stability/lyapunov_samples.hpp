// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// V and dV/dt at many states near the point, in floating point: a hint, never a proof.

#include "stability/linear/about.hpp"

namespace alembert {

/// "at 3000 states within 0.1, 0.01 and 0.001 of the point V > 0 at all, dV/dt <= 0 at all"
std::string lyapunov_samples(const GiNaC::ex& V, const LinearizedScene& scene);

/// Throws ModelError if V is not zero at the point.
void check_zero_there(const GiNaC::ex& V, const LinearizedScene& scene);

}  // namespace alembert
