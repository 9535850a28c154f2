// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A first judgement of stability, from the eigenvalues or the energy. The verb `stability` goes further.
///
///     const StabilityHint is = judge(problem, energy_rate(mechanism, problem, start.parameters), root.at);
///     is.stable == Stable::yes, is.because, is.eigenvalues
///
/// It concerns the essential coordinates and all speeds. There is also a steady motion for every other value of a
/// given cyclic rate; the zero eigenvalues that belong to these rates are not counted. If eigenvalues lie on the
/// imaginary axis, energy decides if it never grows: the motion is stable if V − T₀ + ½ Σ momenta²/inertia has a
/// minimum (Lagrange and Dirichlet; Routh for steady motions).

#include <complex>

#include "model/assumption.hpp"
#include "stability/equilibrium/energy_rate.hpp"

namespace alembert {

enum class Stable { yes, no, undecided };
const char* name_of(Stable stable);

struct StabilityHint {
    Stable stable = Stable::undecided;
    std::string because;
    std::vector<Assumption> assumed = {};  ///< nothing of what is proved, and of what is undecided
    bool by_energy = false;
    bool meets = false;     ///< whether others meet it there, or nearly so, and nothing was decided therefore
    bool singular = false;  ///< whether some inertia vanishes here, as at a pole of spherical coordinates
    std::vector<std::complex<double>> eigenvalues =
        {};  ///< by real part, then imaginary part; a real part that is only rounding is 0
    std::vector<std::complex<long double>> exact = {};  ///< as they were computed
};

/// x' = A x for small deviations of the essential coordinates and all speeds; no rows if inertia is singular or
/// the equations have a kink.
MatrixOf<long double> essential_motion(const SteadyProblem& problem, const Instant<long double>& at);

/// Where equilibria meet, or nearly so, the stiffness changes by as much as it is within the digits to which a
/// multiple root is known: the first approximation at numbers decides nothing, unless disturbances grow on both
/// sides.
enum class Meeting { none, grows, open };
Meeting meeting_at(const SteadyProblem& problem, const Instant<long double>& at);

/// Undecided, with the reason, if inertia is singular.
StabilityHint judge(const SteadyProblem& problem, EnergyRate energy, const Instant<long double>& at);

}  // namespace alembert
