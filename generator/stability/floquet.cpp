// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/floquet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/parameter_values.hpp"
#include "program/lower/lower.hpp"
#include "stability/equilibrium/loads.hpp"
#include "stability/periodic.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double fine = 1e-26, coarse = 1e-20;
constexpr double basis_rounding = 1e-17;  // of the tangent space's columns, which are long doubles

void check_period(const Variation<Quad>& f, const std::vector<Quad>& start, Quad t0, Quad period) {
    std::mt19937_64 random(5);
    for (int k = 0; k < 6; ++k) {
        std::vector<Quad> x = start;
        for (Quad& one : x)
            one += static_cast<Quad>(0.2 * (static_cast<double>(random() >> 11) / 9007199254740992.0 - 0.5));
        const Quad t = t0 + period * static_cast<Quad>((k + 0.37) / 6.0);
        const std::vector<Quad> now = f.rate_at(t, x), later = f.rate_at(t + period, x);
        for (std::size_t i = 0; i < now.size(); ++i)
            if (abs(now[i] - later[i]) > static_cast<Quad>(1e-12) * (1 + abs(now[i])))
                throw ModelError(say(
                    "the equations do not have the period {:.10g}: a rate is {:.10g} at t = {:.6g} and {:.10g} "
                    "one period later; give the period of the inputs, or a multiple of it",
                    static_cast<double>(period), static_cast<double>(now[i]), static_cast<double>(t),
                    static_cast<double>(later[i])));
    }
}

enum class OnCircle { inside, circle, outside, unclear };

/// The place of each multiplier; with `mirrored`, the set of multipliers is its own mirror image in the circle.
std::vector<OnCircle> places(const std::vector<RootOf>& roots, bool mirrored) {
    std::vector<OnCircle> result;
    for (const RootOf& root : roots) {
        const double size = std::abs(root.value);
        OnCircle place = size + root.radius < 1   ? OnCircle::inside
                         : size - root.radius > 1 ? OnCircle::outside
                                                  : OnCircle::unclear;
        if (place == OnCircle::unclear && mirrored && root.multiplicity == 1) {
            const std::complex<double> image = 1.0 / std::conj(root.value);
            const double reach = 4 * (root.radius + std::abs(image - root.value)) + 1e-12;
            const auto near = std::count_if(roots.begin(), roots.end(), [&](const RootOf& other) {
                return std::abs(other.value - root.value) <= reach + other.radius;
            });
            if (near == 1) place = OnCircle::circle;
        }
        result.push_back(place);
    }
    return result;
}

Decision judged(const FloquetResult& found, const std::vector<RootOf>& roots, bool autonomous, bool linear,
                bool mirrored) {
    std::vector<OnCircle> at = places(roots, mirrored);
    if (autonomous) {  // the one along the motion
        std::size_t own = 0;
        for (std::size_t k = 0; k < roots.size(); ++k)
            if (std::abs(roots[k].value - 1.0) < std::abs(roots[own].value - 1.0)) own = k;
        at[own] = OnCircle::inside;
    }
    const auto has = [&](OnCircle place) { return std::find(at.begin(), at.end(), place) != at.end(); };
    const std::string of = say("the largest multiplier over the period {:.10g} has the size {:.12g}", found.period,
                               std::abs(found.multipliers.front()));
    const std::string orbit =
        autonomous ? say("; the one along the motion is 1 and not counted: the orbit is stable") : "";
    if (has(OnCircle::outside))
        return {StabilityVerdict::unstable, StabilityTheorem::floquet, say("{}, beyond 1", of)};
    if (!has(OnCircle::circle) && !has(OnCircle::unclear))
        return {StabilityVerdict::asymptotically_stable, StabilityTheorem::floquet,
                autonomous ? say("all multipliers but one are smaller than 1") + orbit : say("{}, below 1", of)};
    if (linear && !has(OnCircle::unclear))
        return {StabilityVerdict::stable, StabilityTheorem::floquet,
                say("all multipliers are simple and on the unit circle: the equations are linear and have a "
                    "Hamiltonian, so "
                    "that none can leave it")};
    return {
        StabilityVerdict::undecided, StabilityTheorem::none,
        say("critical: no multiplier is surely beyond the unit circle, and some are on it{}; the first "
            "approximation over a period says nothing about {} equations",
            has(OnCircle::unclear) ? say(" or too near to tell") : "", linear ? say("these") : say("nonlinear"))};
}

/// Numbers as exactly as the scene and the options have them.
void take_exact(PeriodicMotion<Quad>& motion, const Derived& d, const Start& start, const ExactOverrides& exact_at,
                double period) {
    const Mechanism& m = d.mechanism;
    const ExactStart exact = exact_start(m, start, exact_at);
    for (std::size_t k = 0; k < exact.parameters.size(); ++k) motion.parameters[k] = exact.parameters[k].middle();
    for (std::size_t k = 0; k < exact.q.size(); ++k) motion.x[k] = exact.q[k].middle();
    for (std::size_t k = 0; k < exact.qdot.size() && d.equations.speeds_are_rates(); ++k)
        motion.x[exact.q.size() + k] = exact.qdot[k].middle();
    motion.t = exact.t.middle();
    if (period > 0) return;
    Program one = begun(m);
    const int node = lower_expression(one, m, *m.run.period);
    Tape<Quad>(one, {node}, motion.parameters)(0, nullptr, nullptr, &motion.period);
}

/// By the size, the largest first.
std::vector<RootOf> multipliers_of(const PeriodicSystem& periodic, const PeriodicMotion<Quad>& motion) {
    const PeriodEnd<Quad> good = periodic.monodromy(motion, fine), rough = periodic.monodromy(motion, coarse);
    if (!good.finished || !rough.finished)
        throw IntegrationError(say("the variational equations cannot be integrated over one period"),
                               static_cast<double>(motion.t), {});
    const int size = static_cast<int>(periodic.independent(motion).size());
    const double rounding = periodic.constrained() ? basis_rounding : 0;
    RealBallMatrix Phi(size, size);
    for (int c = 0; c < size; ++c)
        for (int i = 0; i < size; ++i) {
            const auto k = static_cast<std::size_t>(c * size + i);
            const double unsure = static_cast<double>(abs(good.Phi[k] - rough.Phi[k])) + 1e-24 +
                                  rounding * std::max(1.0, std::abs(static_cast<double>(good.Phi[k])));
            Phi(i, c) = RealBall::about(good.Phi[k], unsure);
        }
    return multipliers_in_order(Phi);
}

/// Do the loads outside V have a potential too, at these values of the parameters, and are all constraints
/// holonomic? The multipliers are then those of a symplectic matrix.
bool has_hamiltonian(const Mechanism& m, const std::vector<double>& parameters) {
    for (const Mechanism::Constraint& c : m.constraints)
        if (!c.position) return false;
    auto Q = written_out_loads(m);
    if (!Q) return false;
    const ParameterValues values(m, parameters);
    GiNaC::exmap zeros;
    for (const Mechanism::Parameter& p : m.parameters)
        if (values.number(p.symbol) == 0) zeros[p.symbol] = 0;
    for (ex& load : *Q) {
        load = load.subs(zeros, GiNaC::subs_options::no_pattern);
        for (const GiNaC::symbol& rate : m.qdot)
            if (!is_identically_zero(load.diff(rate), m)) return false;
    }
    return have_potential(*Q, m);
}

}  // namespace

std::vector<RootOf> multipliers_in_order(const RealBallMatrix& Phi) {
    std::vector<RootOf> roots = roots_of(characteristic(Phi));
    std::sort(roots.begin(), roots.end(),
              [](const RootOf& a, const RootOf& b) { return std::abs(a.value) > std::abs(b.value); });
    return roots;
}

Decision decision_by_multipliers(const FloquetResult& found, const std::vector<RootOf>& roots, bool autonomous) {
    Decision decision = judged(found, roots, autonomous, false, false);
    if (decision.verdict != StabilityVerdict::undecided)
        decision.assumed.push_back({Assumption::Kind::numbers,
                                    say("the motion and its multipliers through impacts, events and jumps of "
                                        "forces are in floating point"),
                                    false});
    return decision;
}

FloquetResult floquet(const Derived& d, const Start& start, const ExactOverrides& exact_at, double period) {
    const Mechanism& m = d.mechanism;
    const PeriodicSystem periodic(d);
    PeriodicMotion<Quad> motion = periodic.motion<Quad>(start, period);
    take_exact(motion, d, start, exact_at, period);
    const Variation<Quad> f(periodic.program(), motion.parameters);
    if (!periodic.autonomous()) check_period(f, motion.x, motion.t, motion.period);
    if (!periodic.shoot(motion))
        throw ModelError(
            say("no motion of period {:.10g} is found from this state: after Newton's method the state "
                "misses itself by {:.3g}; give a state and a period nearer to one",
                static_cast<double>(motion.period), motion.closure_error));
    FloquetResult result;
    const std::vector<RootOf> roots = multipliers_of(periodic, motion);
    for (const RootOf& root : roots) {
        result.multipliers.push_back(root.value);
        result.radii.push_back(root.radius);
    }
    result.period = static_cast<double>(motion.period);
    const std::vector<std::string> names = periodic.names();
    for (const int k : periodic.independent(motion)) result.states.push_back(names[static_cast<std::size_t>(k)]);
    for (std::size_t k = 0; k < names.size(); ++k)
        result.start.emplace_back(names[k], static_cast<double>(motion.x[k]));
    bool still = periodic.autonomous();
    for (const Quad& rate : f.rate_at(motion.t, motion.x)) still = still && abs(rate) < static_cast<Quad>(1e-12);
    if (still)
        throw ModelError(
            say("the equations do not hold t and this state is an equilibrium; leave the period out, or give a "
                "state on a periodic motion"));
    result.decision = judged(result, roots, periodic.autonomous(), is_linear(m, d.equations),
                             has_hamiltonian(m, start.parameters));
    return result;
}

}  // namespace alembert
