// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A first judgement of stability: what the eigenvalues or the energy say at once. The verb `stability` goes
/// further.
///
///     const StabilityHint is = judge(problem, mechanism, root.at);
///     is.stable == Stable::yes, is.because, is.eigenvalues
///
/// Of the essential coordinates and all speeds. A cyclic rate that is given may be another one, to which the
/// motion belongs as steadily: that many zero eigenvalues are not counted. On the imaginary axis energy decides
/// where nothing but a potential acts: the motion is stable if V − T₀ + ½ Σ momenta²/inertia has a minimum
/// (Lagrange and Dirichlet; Routh for steady motions).

#include <complex>

#include "linear/steady.hpp"

namespace alembert {

enum class Stable { yes, no, undecided };
const char* name_of(Stable stable);

struct StabilityHint {
    Stable stable = Stable::undecided;
    std::string because;
    std::vector<std::complex<double>> eigenvalues =
        {};  ///< by real part, then imaginary part; no rounding as real part
    std::vector<std::complex<long double>> exact = {};  ///< as they were computed
};

/// Whether nothing acts but a potential and ideal holonomic constraints, so that the energy decides.
bool is_conservative(const Mechanism& mechanism, const Residuals& residuals);

/// x' = A x for small deviations of the essential coordinates and all speeds; no rows where inertia is singular or
/// the equations have a kink.
MatrixOf<long double> essential_motion(const SteadyProblem& problem, const Instant<long double>& at);

/// Undecided, with the reason, where inertia is singular.
StabilityHint judge(const SteadyProblem& problem, bool conservative, const Instant<long double>& at);

}  // namespace alembert
