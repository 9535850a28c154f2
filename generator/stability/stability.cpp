// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/given_values.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "program/lower/lower.hpp"
#include "program/switches.hpp"
#include "stability/arnold.hpp"
#include "stability/conservative.hpp"
#include "stability/critical.hpp"
#include "stability/equilibrium/judge.hpp"
#include "stability/floquet.hpp"
#include "stability/linear/events_here.hpp"
#include "stability/lyapunov.hpp"
#include "stability/own_period.hpp"
#include "stability/polynomial.hpp"
#include "stability/potential.hpp"
#include "stability/reversible.hpp"
#include "stability/verdict.hpp"

namespace alembert {

using Side = RootOf::Side;

const char* name_of(StabilityVerdict verdict) {
    switch (verdict) {
        case StabilityVerdict::asymptotically_stable:
            return to_say("asymptotically stable");
        case StabilityVerdict::stable:
            return to_say("stable");
        case StabilityVerdict::unstable:
            return to_say("unstable");
        case StabilityVerdict::undecided:
            return to_say("undecided");
    }
    return "";
}

const char* name_of(StabilityTheorem theorem) {
    switch (theorem) {
        case StabilityTheorem::none:
            return "none";
        case StabilityTheorem::hurwitz:
            return to_say("Routh-Hurwitz");
        case StabilityTheorem::jordan:
            return to_say("roots on the axis and their Jordan blocks");
        case StabilityTheorem::first_approximation:
            return to_say("Lyapunov's first approximation");
        case StabilityTheorem::malkin:
            return to_say("Lyapunov-Malkin");
        case StabilityTheorem::lagrange_dirichlet:
            return to_say("Lagrange-Dirichlet");
        case StabilityTheorem::routh:
            return to_say("Routh (amended potential)");
        case StabilityTheorem::jacobi:
            return to_say("Lagrange-Dirichlet with Jacobi's integral");
        case StabilityTheorem::kelvin_chetaev:
            return to_say("Kelvin-Tait-Chetaev (damping)");
        case StabilityTheorem::kelvin_odd:
            return to_say("Kelvin-Tait-Chetaev (odd number of unstable degrees)");
        case StabilityTheorem::chetaev_integrals:
            return to_say("Chetaev (combination of integrals)");
        case StabilityTheorem::potential_form:
            return to_say("terms of higher degree of the potential");
        case StabilityTheorem::one_zero_root:
            return to_say("Lyapunov's critical case of one zero root");
        case StabilityTheorem::pair_on_axis:
            return to_say("Lyapunov's critical case of a pair on the axis");
        case StabilityTheorem::reversible:
            return to_say("reversibility (one frequency)");
        case StabilityTheorem::arnold:
            return to_say("Arnold (two frequencies)");
        case StabilityTheorem::lyapunov_stable:
            return to_say("Lyapunov's theorem on stability");
        case StabilityTheorem::lyapunov_asymptotic:
            return to_say("Lyapunov's theorem on asymptotic stability");
        case StabilityTheorem::lasalle:
            return to_say("Barbashin-Krasovskii-LaSalle");
        case StabilityTheorem::lyapunov_instability:
            return to_say("Lyapunov's theorem on instability");
        case StabilityTheorem::chetaev_instability:
            return to_say("Chetaev's theorem on instability");
        case StabilityTheorem::floquet:
            return to_say("Floquet multipliers");
    }
    return "";
}

namespace {

void take(Stability& result, const Decision& decision) {
    result.verdict = decision.verdict;
    result.theorem = decision.theorem;
    result.reason = decision.reason;
    result.assumed = decision.assumed;
}

/// The verdict was found in floating point.
void tell_numbers(Decision& decision) {
    if (decision.verdict == StabilityVerdict::undecided) return;
    decision.assumed.push_back(signs_in_numbers());
}

Decision by_integrals(const IntegralProof& proof, bool conserved) {
    const std::string energy = proof.relative ? say("Jacobi's integral T2 - T0 + V") : say("the energy");
    const std::string falls = conserved ? "" : say(", which never grows,");
    switch (proof.by) {
        case IntegralProof::By::energy:
            return {StabilityVerdict::stable,
                    proof.relative ? StabilityTheorem::jacobi : StabilityTheorem::lagrange_dirichlet,
                    say("{}{} has a strict minimum here: {} is positive definite to second degree", energy, falls,
                        proof.relative ? "V - T0" : "V")};
        case IntegralProof::By::momenta:
            return {StabilityVerdict::stable, StabilityTheorem::routh,
                    say("{}{} has a strict minimum among motions with the same momenta of the cyclic "
                        "coordinates: the amended potential is positive definite to second degree",
                        energy, falls)};
        case IntegralProof::By::angular_momenta:
            return {StabilityVerdict::stable, StabilityTheorem::chetaev_integrals,
                    say("a combination of {} with momenta and angular momenta is positive definite where these "
                        "keep their values",
                        energy)};
    }
    return {};
}

Decision by_potential(const Local& local, const PowerSign& power) {
    const auto degenerate = degenerate_minimum(local, power);
    if (!degenerate) return {};
    return {degenerate->minimum ? StabilityVerdict::stable : StabilityVerdict::unstable,
            StabilityTheorem::potential_form,
            say("the second derivatives of the {}potential do not decide; its first term beyond them, of degree "
                "{}, makes it {}",
                local.cyclic_momenta.empty() ? "" : say("amended "), degenerate->degree,
                degenerate->minimum ? say("a strict minimum") : say("no minimum, and the position is left"))};
}

/// For nonlinear equations whose first approximation does not decide, the first method that does.
Decision critical_case(const Local& local, const PowerSign& power, const std::vector<RootOf>& roots) {
    const std::function<Decision()> ways[] = {
        [&] { return family_of_motions(local, roots, FamilyProof::exact); },
        [&] { return one_zero_root(local, roots); },
        [&] { return pair_on_axis(local, roots); },
        [&] {
            const auto proof = proof_by_integrals(local, power);
            return proof ? by_integrals(*proof, power.is_zero) : Decision{};
        },
        [&] { return by_potential(local, power); },
        [&] { return family_of_motions(local, roots, FamilyProof::in_numbers); },
        [&] { return by_reversal(local, roots); },
        [&] { return by_arnold(local, power, roots); },
    };
    for (const auto& way : ways) try {
            if (Decision decision = way(); decision.verdict != StabilityVerdict::undecided) return decision;
        } catch (const NotAnalytic&) {  // no series there, or a pivot that is not certain
        }
    return {};
}

/// Names the role of damping and gyroscopic forces in a verdict from eigenvalues.
void name_forces(Decision& decision, const Local& local, const PowerSign& power) {
    if (!power.known || !local.mechanism.constraints.empty() || !local.cyclic_momenta.empty()) return;
    if (decision.verdict == StabilityVerdict::asymptotically_stable && !power.is_zero &&
        proof_by_integrals(local, power)) {
        decision.theorem = StabilityTheorem::kelvin_chetaev;
        decision.reason += say("; the potential has a strict minimum, and the damping is {}",
                               damping_is_complete(local, power) ? say("complete") : say("pervasive"));
    }
    if (decision.verdict != StabilityVerdict::unstable || !local.near.matrices.moving.empty()) return;
    std::vector<int> rows;
    for (std::size_t j = 0; j < local.split.u.size(); ++j)
        if (local.is_essential(local.split.u[j])) rows.push_back(static_cast<int>(j));
    if (rows.size() != local.essential.size() || !local.residuals.rates_are_speeds) return;
    const bool has_rates = std::any_of(local.tangent.damping.entries.begin(), local.tangent.damping.entries.end(),
                                       [](const RealBall& c) { return !c.is_zero(); });
    if (!has_rates) return;
    const RealBallMatrix P = local.tangent.stiffness.part(rows, local.essential);
    const RealBallMatrix K = RealBall(Rational(1) / 2) * (P + transposed(P));
    const auto signs = inertia(K);
    if (!signs || signs->negative == 0) return;
    if (signs->negative % 2 == 1 && signs->zero == 0) {
        decision.theorem = StabilityTheorem::kelvin_odd;
        decision.reason +=
            say("; {} of {} degrees of freedom {} unstable without gyroscopic forces, an odd "
                "number, which no gyroscopic forces stabilize",
                signs->negative, K.rows, signs->negative == 1 ? "is" : "are");
    } else if (damping_is_complete(local, power)) {
        decision.theorem = StabilityTheorem::kelvin_chetaev;
        decision.reason +=
            say("; the potential has no minimum, and complete damping destroys any gyroscopic stabilization");
    }
}

/// Are the roots of det(M s² + …) those of a polynomial in s²? They are for systems with a Hamiltonian, and if no
/// rate occurs.
bool has_even_spectrum(const Local& local) {
    const Mechanism& m = local.mechanism;
    if (!local.residuals.rates_are_speeds) return false;
    bool no_rates = m.constraints.empty() && local.near.matrices.moving.empty() && local.cyclic_momenta.empty();
    for (const RealBall& c : local.tangent.damping.entries) no_rates = no_rates && c.is_zero();
    if (no_rates) return true;
    for (const Mechanism::Constraint& c : m.constraints)
        if (!c.holonomic) return false;
    for (const bool dissipative : {true, false})
        for (const GiNaC::ex& load : m.generalized_forces(dissipative))
            if (!is_identically_zero(load, m)) return false;
    return energy_of(m).jacobi_conserved;
}

/// The matrix with radii for numbers that are known to the last digits of a double.
RealBallMatrix blurred(const Eigen::MatrixXd& A) {
    RealBallMatrix result(static_cast<int>(A.rows()), static_cast<int>(A.cols()));
    const double unit = 1e-13 * (A.size() == 0 ? 0.0 : A.cwiseAbs().maxCoeff());
    for (int i = 0; i < result.rows; ++i)
        for (int j = 0; j < result.columns; ++j)
            if (A(i, j) != 0) result(i, j) = RealBall::about(static_cast<Quad>(A(i, j)), unit);
    return result;
}

Decision undecided(const std::vector<RootOf>& roots) {
    const bool on_axis =
        std::any_of(roots.begin(), roots.end(), [](const RootOf& r) { return r.side == Side::axis; });
    return {StabilityVerdict::undecided, StabilityTheorem::none,
            say("the first approximation says nothing: no eigenvalue is surely to the right of the imaginary "
                "axis, and {}. Neither the energy, nor a combination of integrals, nor terms of higher degree "
                "decided",
                on_axis ? say("some are on it") : say("some are on it or too near to tell"))};
}

/// Refuses states that `linearize` accepts but for which stability cannot be decided.
void check_steady(const LinearizedScene& near) {
    if (const auto why = disturbed_by_event(near, near.start))
        throw ModelError(
            say("{}; 'alembert simulate' follows motions from states beside it. Give a state at which no event is "
                "zero",
                *why));
    for (const Mechanism::Unilateral& contact : near.mechanism.unilateral)
        for (const Mechanism::Constraint& c : near.mechanism.constraints)  // linearize closes contacts that press
            if (c.multiplier.is_equal(contact.gap.multiplier))
                throw ModelError(
                    say("contact {} is closed at this state: a disturbance may open it, and no first "
                        "approximation describes the motion after that. Give a state in which all "
                        "contacts are open, or a constraint in place of the contact",
                        c.name));
    for (const Mechanism::Input& input : near.mechanism.inputs)
        for (const std::string& name : near.matrices.inputs)
            if (name.substr(0, name.find('\'')) == input.derivative[0].get_name() &&
                near.mechanism.z->depends(input.value, {near.mechanism.t}))
                throw ModelError(
                    say("the input {} changes with time, so that there is no equilibrium; give the period "
                        "of the system, --period or `period` of [simulation], for its Floquet "
                        "multipliers, or make the input constant",
                        input.derivative[0].get_name()));
}

/// Whether the state is a double root or nearly so, and not known exactly: found by Newton's method, or typed with
/// so many digits that no eigenvalue is exactly zero.
bool is_inexact_fold(const LinearizedScene& near, const std::vector<RootOf>& roots) try {
    const bool is_exact =
        std::any_of(roots.begin(), roots.end(), [](const RootOf& root) { return root.value == 0.0; });
    if (near.reached.empty() && is_exact) return false;
    const SteadyProblem problem(near.mechanism, near.equations, near.start);
    return meeting_at(problem, problem.start()) == Meeting::open;
} catch (const ModelError&) {
    return false;
} catch (const IntegrationError&) {
    return false;
}

Decision undecided_at_fold() {
    return {StabilityVerdict::undecided, StabilityTheorem::none,
            say("equilibria meet here, or nearly so, and the state is known to so few digits that the first "
                "approximation "
                "and terms of higher degree are those of its roundings. Give it as a fraction or decimal by --at, "
                "or as "
                "the initial value in the scene")};
}

FloquetResult periodic_multipliers(const Derived& d, const StabilityOptions& options) {
    if (d.mechanism.has_modes() || jumps_along_motion(lowered(d).program))
        return floquet_through_jumps(with_numbers(d.scene, options.at), options.by, options.period);
    Start start = start_of(d.mechanism, options.at);
    assemble(start, d.mechanism, lower_constraints(d.mechanism), options.at);
    return floquet(d, start, options.exact_at, options.period);
}

Stability stability_of_periodic(Scene scene, const StabilityOptions& options) {
    const bool goes_through = is_changed_by_events(scene);  // else it is told that equations stand for all
    const Derived d =
        derived(std::move(scene), {.by = options.by, .at = options.at, .with_states = !goes_through});
    Stability result{.title = d.scene.title};
    result.warnings = d.warnings;
    const FloquetResult found = periodic_multipliers(d, options);
    result.period = found.period;
    result.multipliers = found.multipliers;
    result.radii = found.radii;
    result.certain = !found.is_in_numbers;
    result.states = found.states;
    result.periodic_start = found.start;
    take(result, found.decision);
    return result;
}

/// The verdict by the period that the equations have by how they are written; nothing if they have none, or no
/// motion of that period is found.
std::optional<Stability> by_own_period(Scene scene, StabilityOptions options) try {
    scene.on_warning = [](const Warning&) {};  // they have been told
    const Derived d = derived(std::move(scene), {.by = options.by, .at = options.at, .with_states = true});
    const Start start = start_of(d.mechanism, options.at);
    const std::optional<double> period = own_period(d, start);
    if (!period || disturbed_by_event(d, start)) return {};  // what it is after the event is another motion
    options.period = *period;
    Stability result = stability_of_periodic(d.scene, options);
    result.is_own_period = true;
    return result;
} catch (const ModelError&) {
    return {};
} catch (const IntegrationError&) {
    return {};
}

/// The verdict is what V proves; what is known without V is told beside.
void judge_function(Stability& result, const std::string& V, const Local* local) {
    const auto [answer, decision] = by_lyapunov_function(V, *result.near, local);
    const std::string without =
        result.verdict == StabilityVerdict::undecided
            ? say("undecided")
            : say("{}, by {}", translated(name_of(result.verdict)), translated(name_of(result.theorem)));
    take(result, decision);
    result.reason += say(" (without V: {})", without);
    result.lyapunov = answer;
}

/// By the energy, in numbers; undecided if it does not tell.
Decision decide_by_energy(const LinearizedScene& near) try {
    const SteadyProblem problem(near.mechanism, near.equations, near.start);
    const StabilityHint hint =
        judge(problem, energy_rate(near.mechanism, problem, near.start.parameters), problem.start());
    if (!hint.by_energy) return {};
    return hint.stable == Stable::yes
               ? Decision{StabilityVerdict::stable, StabilityTheorem::lagrange_dirichlet, hint.because}
               : Decision{StabilityVerdict::unstable, StabilityTheorem::lyapunov_instability, hint.because};
} catch (const ModelError&) {
    return {};
} catch (const IntegrationError&) {
    return {};
}

/// What nothing exact decides.
Decision decide_last(Stability& result) {
    Decision decision = decide_by_energy(*result.near);
    result.certain = decision.verdict == StabilityVerdict::undecided;
    tell_numbers(decision);
    return result.certain ? undecided(result.eigenvalues) : decision;
}

/// Where the equations have no Taylor series at the state.
void judge_in_numbers(Stability& result, const std::string& lyapunov) {
    result.eigenvalues = eigenvalues_of(blurred(result.A), false);
    result.state = StateKnown::in_numbers;
    Decision decision = decide_first(result.eigenvalues);
    if (decision.verdict == StabilityVerdict::undecided) decision = decide_by_energy(*result.near);
    if (decision.verdict == StabilityVerdict::undecided) decision = undecided(result.eigenvalues);
    if (is_inexact_fold(*result.near, result.eigenvalues)) decision = undecided_at_fold();
    tell_numbers(decision);
    take(result, decision);
    if (!lyapunov.empty()) judge_function(result, lyapunov, nullptr);
}

/// What the series at the state decide, and what the verdict rests on.
void judge_near(Stability& result, const Local& local, const StabilityOptions& options) {
    result.states = local.states;
    result.A.resize(local.A.rows, local.A.rows);
    for (int i = 0; i < local.A.rows; ++i)
        for (int j = 0; j < local.A.rows; ++j) result.A(i, j) = local.A(i, j).number();
    result.eigenvalues = eigenvalues_of(local.A, has_even_spectrum(local));
    result.certain = true;
    if (local.A.rows == 0) {
        take(result,
             {StabilityVerdict::stable, StabilityTheorem::routh,
              local.split.u.empty() ? say("the constraints give all rates, the same wherever the coordinates are")
                                    : say("all coordinates are cyclic, and their momenta are constant")});
        return;
    }
    const bool linear = is_linear(local.mechanism, local.equations);
    Decision decision = linear ? decide_linear(result.eigenvalues, &local.A) : decide_first(result.eigenvalues);
    PowerSign power;
    try {
        power = power_sign(local);
    } catch (const NotAnalytic&) {
    }
    if (decision.verdict == StabilityVerdict::undecided)
        decision = critical_case(local, power, result.eigenvalues);
    else
        name_forces(decision, local, power);
    if (decision.verdict == StabilityVerdict::undecided) decision = decide_last(result);
    if (decision.verdict == StabilityVerdict::asymptotically_stable && !local.cyclic_momenta.empty()) {
        decision.verdict = StabilityVerdict::stable;
        decision.reason +=
            say("; the momenta of the cyclic coordinates keep their disturbed values, and the motion tends to "
                "the steady motion that has these");
    }
    result.state = local.known;
    const bool is_of_family = decision.theorem == StabilityTheorem::malkin;
    if (is_inexact_fold(*result.near, result.eigenvalues) || (local.known == StateKnown::open && !is_of_family)) {
        decision = undecided_at_fold();
        result.certain = false;
    }
    if (decision.verdict != StabilityVerdict::undecided &&
        (local.known == StateKnown::in_numbers || local.known == StateKnown::open))
        decision.assumed.push_back(state_in_numbers());
    take(result, decision);
    if (result.certain) add_conditions(result, local, options.exact_at);
    if (!options.lyapunov.empty()) judge_function(result, options.lyapunov, &local);
}

}  // namespace

Stability stability(Scene scene, const StabilityOptions& wishes) {
    StabilityOptions options = wishes;
    argument::need_positive_if_given("period", options.period);
    const bool periodic = options.period > 0 || scene.simulation.period;
    if (!options.lyapunov.empty() && (scene.polynomial || periodic))
        throw ModelError(say(
            "a Lyapunov function is judged at an equilibrium or a steady motion of a mechanism; leave it out for "
            "a "
            "[polynomial] or a periodic motion"));
    if (scene.polynomial) return stability_of_polynomial(scene, options);
    if (periodic) return stability_of_periodic(std::move(scene), options);
    Stability result{.title = scene.title};
    LinearizeOptions linearize_options{.by = options.by, .at = options.at, .exact_at = options.exact_at};
    try {
        result.near = linearize(scene, linearize_options);
        check_steady(*result.near);
    } catch (const ModelError&) {
        if (options.lyapunov.empty())
            if (std::optional<Stability> other = by_own_period(scene, options)) return std::move(*other);
        throw;
    }
    if (!result.near->reached.empty()) options.exact_at = result.near->reached;
    result.near->mechanism = with_potential_of_loads(result.near->mechanism);
    const LinearizedScene& near = *result.near;
    result.warnings = near.warnings;
    result.states = near.matrices.states;
    result.A = near.matrices.A;
    std::optional<Local> local;
    try {
        local.emplace(near, options.exact_at);
    } catch (const NotAnalytic&) {
    }
    if (!local) {
        judge_in_numbers(result, options.lyapunov);
        return result;
    }
    judge_near(result, *local, options);
    return result;
}

}  // namespace alembert
