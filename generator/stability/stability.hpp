// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `stability`: is an equilibrium, a steady motion or a polynomial stable, and which theorem says so?
///
///     const Stability s = stability(read_scene("scenes/textbook/rotating_hoop.toml"), {.at = {{"theta", 0}}});
///     s.verdict, s.theorem, s.reason;
///
/// In this order: eigenvalues with discs that contain them decide by Lyapunov's first approximation; a scene whose
/// equations are linear is decided by its eigenvalues and Jordan blocks; then energy and other integrals
/// (integrals.hpp), terms of higher degree of the potential (potential.hpp) and of the equations (critical.hpp).
/// If none of these decides, the verdict is undecided. Stability is understood with respect to all rates and the
/// coordinates on which anything depends; cyclic coordinates, and the zero eigenvalues that belong to them and to
/// conserved momenta, are not counted.

#include <complex>
#include <string>
#include <vector>

#include "stability/local.hpp"
#include "stability/spectrum.hpp"

namespace alembert {

enum class StabilityVerdict { asymptotically_stable, stable, unstable, undecided };

/// What decided.
enum class StabilityTheorem {
    none,
    hurwitz,               ///< of a polynomial or of linear equations: the roots themselves
    jordan,                ///< roots on the axis: simple ones, or as many eigenvectors as the root counts, or not
    first_approximation,   ///< Lyapunov: all real parts negative, or one positive
    malkin,                ///< Lyapunov and Malkin: as many zero roots as the steady motion has parameters
    lagrange_dirichlet,    ///< the potential has a minimum
    routh,                 ///< the amended potential has a minimum, with constant momenta of cyclic coordinates
    jacobi,                ///< the potential minus T₀ has a minimum, in a moving frame
    kelvin_chetaev,        ///< complete or pervasive damping of a conservative system
    kelvin_odd,            ///< an odd number of unstable degrees cannot be stabilized by gyroscopic forces
    chetaev_integrals,     ///< a combination of integrals is definite
    potential_form,        ///< terms of higher degree of the potential
    one_zero_root,         ///< Lyapunov's critical case of one zero root
    pair_on_axis,          ///< Lyapunov's critical case of a pair on the axis
    reversible,            ///< a reversible system with one frequency and zeros
    arnold,                ///< fourth-order normal form of a Hamiltonian with two degrees of freedom
    lyapunov_stable,       ///< of a function given: positive definite, and never growing
    lyapunov_asymptotic,   ///< and falling
    lasalle,               ///< and no other motion keeps its value
    lyapunov_instability,  ///< it takes positive values, and grows everywhere near
    chetaev_instability,   ///< or where it is positive
    floquet,               ///< multipliers of a periodic system
};

/// "asymptotically stable" …
const char* name_of(StabilityVerdict verdict);

/// "Lagrange-Dirichlet" …
const char* name_of(StabilityTheorem theorem);

/// What a function V proves (lyapunov.hpp).
struct LyapunovAnswer {
    std::string function = {}, rate = {};   ///< V as typed; dV/dt, empty where it is long
    std::string sign = {}, rate_sign = {};  ///< "positive definite", "negative semidefinite" … or "not known"
    bool sampled = false;                   ///< signs were looked at in numbers only
    std::string samples = {};               ///< what was seen there
    std::string set = {};                   ///< where dV/dt is zero, if it is semidefinite
};

struct StabilityOptions {
    std::string by = {};  ///< a formalism; empty: the program chooses
    Overrides at = {};
    ExactOverrides exact_at = {};  ///< the same as typed: decimals are exact
    double period = 0;             ///< s; 0: the scene's, where it gives one
    std::string lyapunov = {};     ///< a function V to be judged; then the verdict is what V proves
};

struct Stability {
    std::string title = {};
    std::vector<std::string> warnings = {};
    std::optional<LinearizedScene> near = {};  ///< nothing of a polynomial
    std::vector<std::string> states = {};      ///< what the eigenvalues belong to
    Eigen::MatrixXd A = {};
    double period = 0;           ///< s, of a periodic system; then these instead of eigenvalues
    bool is_own_period = false;  ///< it was not given, but found in the equations
    std::vector<std::complex<double>> multipliers = {};               ///< Floquet's, the largest first
    std::vector<double> radii = {};                                   ///< of the discs that hold them
    std::vector<std::pair<std::string, double>> periodic_start = {};  ///< coordinates and speeds, by name
    std::vector<RootOf> eigenvalues = {};
    bool certain = false;  ///< discs contain the eigenvalues; else they are those of floating-point numbers
    std::optional<StateKnown> state = {};      ///< of an equilibrium or a steady motion
    std::vector<Assumption> assumed = {};      ///< nothing of a verdict that is proved
    std::vector<std::string> conditions = {};  ///< "expr > 0", together necessary and sufficient
    std::string conditions_for = {};           ///< what for
    /// Where the conditions are too long in the parameters: the coefficients of the characteristic polynomial that
    /// stand in them, "a1 = D/m".
    std::vector<std::string> coefficients = {};
    std::vector<std::string> routh = {};  ///< of a polynomial: rows of Routh's array
    StabilityVerdict verdict = StabilityVerdict::undecided;
    StabilityTheorem theorem = StabilityTheorem::none;
    std::string reason = {};
    std::optional<LyapunovAnswer> lyapunov = {};  ///< of the function that was given
};

/// Throws like `linearize` if the state is neither an equilibrium nor a steady motion.
Stability stability(Scene scene, const StabilityOptions& options = {});

}  // namespace alembert
