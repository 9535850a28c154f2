// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/lyapunov.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "model/formulas.hpp"
#include "scene/known_names.hpp"
#include "stability/lyapunov_samples.hpp"
#include "stability/periodic.hpp"
#include "stability/semidefinite.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t widest = 200;  // the most letters of dV/dt that the answer shows
const char* const unknown_sign = to_say("not known");

ex read_function(const std::string& text, const LinearizedScene& scene) {
    const Mechanism& m = scene.mechanism;
    const auto refuse = [&](const std::string& why) {
        throw ModelError(say("the Lyapunov function {}: {}", text, why));
    };
    std::vector<Diagnostic> mistakes;
    const KnownNames names(scene.scene);
    const Expression expression = parse_expression(text, {}, mistakes, &names);
    if (!expression) refuse(mistakes.empty() ? say("this is no expression") : mistakes[0].message);
    ex V;
    try {
        Formulas formulas(scene.scene, m);
        V = m.z->name(formulas.value(expression));
    } catch (const SceneMistake& mistake) {
        refuse(mistake.diagnostic.message);
    }
    std::vector<GiNaC::symbol> multipliers;
    for (const Mechanism::Constraint& c : m.constraints) multipliers.push_back(c.multiplier);
    for (const Mechanism::Constraint* c : m.undetermined()) multipliers.push_back(c->multiplier);
    if (m.z->depends(V, m.qddot) || m.z->depends(V, multipliers))
        refuse(say(
            "it holds accelerations or multipliers; expected coordinates, rates, speeds and parameters alone"));
    std::vector<GiNaC::symbol> changing{m.t};
    for (const Mechanism::Input& input : m.inputs)
        changing.insert(changing.end(), input.derivative.begin(), input.derivative.end());
    if (m.z->depends(V, changing))
        refuse(say("it changes with time; expected a function of coordinates, rates and parameters"));
    for (const std::string& name : scene.matrices.cyclic)
        for (const GiNaC::symbol& q : m.q)
            if (q.get_name() == name && m.z->depends(V, {q}))
                refuse(
                    say("it holds {}, which nothing in the equations depends on; stability is meant "
                        "with respect to the other coordinates and the rates",
                        name));
    return V;
}

const char* sign_text(const SignNear& s, const std::optional<Semidefinite>& half) {
    if (s.definite) return s.positive ? to_say("positive definite") : to_say("negative definite");
    if (half)
        return half->sign == 0  ? to_say("zero")
               : half->sign > 0 ? to_say("positive semidefinite")
                                : to_say("negative semidefinite");
    if (s.positive && s.negative) return to_say("of both signs");
    return unknown_sign;
}

std::string text_of_set(const Semidefinite& half, const Symbols& symbols) {
    std::vector<std::string> sets;
    for (const Semidefinite::ZeroSet& set : half.sets) {
        std::vector<std::string> equations;
        for (const ex& function : set.texts)
            if (const auto f = fourier(function, symbols, 100))
                equations.push_back(fmt::format("{} = 0", text(readable(*f))));
        if (equations.size() < set.functions.size() || equations.empty()) return "";
        sets.push_back(fmt::format("{}", fmt::join(equations, ", ")));
    }
    return fmt::format("{}", fmt::join(sets, " or "));
}

/// Rewrites an expression in q and q' in terms of q and u, without intermediate symbols.
ex in_states(const ex& in_rates, const Local& local) {
    return local.mechanism.z->expand(local.in_speeds({in_rates})[0]);
}

/// Is dV/dt = λ V + W with W definite and of V's sign? λ is found from the quadratic forms.
bool by_second_theorem(const Expansion& V, const Expansion& rate, int sign, const Neighbourhood& near) {
    const RealBallMatrix Q = RealBall(sign) * hessian(V, near.monomials),
                         Q_rate = RealBall(sign) * hessian(rate, near.monomials);
    const auto factor = definite_combination(Q_rate, {RealBall(-1) * Q});
    if (!factor || !((*factor)[0] > 0)) return false;
    const RealBall lambda{Rational(cln::rational(cln::cl_DF((*factor)[0])))};
    return sign_near(rate + Expansion(-lambda) * V, near.monomials).is(sign);
}

/// Is dV/dt = g V with a factor g that is positive at the point, or positive definite?
bool is_positive_multiple(const ex& V, const ex& rate, const Neighbourhood& near) {
    const auto in_numbers = near.with_numbers(in_states(V, near.local));
    if (!in_numbers || in_numbers->is_zero()) return false;
    const ex quotient = (rate / *in_numbers).normal();
    const auto value = near.value(quotient);
    if (!value || !value->sign()) return false;
    if (*value->sign() != 0) return *value->sign() > 0;
    if (!near.local.residuals.rates_are_speeds) return false;
    try {
        return sign_near(near.series(quotient), near.monomials).is(1);
    } catch (const NotAnalytic&) {
        return false;
    }
}

/// Does V vanish wherever all functions of the set do? Each of them must be solved for one state by a linear
/// equation.
bool vanishes_on_set(ex V, const Semidefinite::ZeroSet& set, const Neighbourhood& near) {
    if (set.texts.size() < set.functions.size()) return false;
    for (ex function : set.texts) {
        function = function.expand();
        const auto solves = [&](const GiNaC::symbol& s) {
            const ex slope = function.diff(s);
            return !slope.is_zero() && GiNaC::is_a<GiNaC::numeric>(slope);
        };
        const auto state = std::find_if(near.states.begin(), near.states.end(), solves);
        if (state == near.states.end()) return false;
        V = V.subs(GiNaC::exmap{{*state, (*state - function / function.diff(*state)).expand()}});
    }
    return is_identically_zero(V, near.local.mechanism);
}

/// With constraints, from the energy H: dV/dt is zero, or V - c H is constant and dH/dt is known to be nowhere
/// positive.
std::optional<Semidefinite> half_by_energy(const ex& V, const Expansion& rate, const Neighbourhood& near) {
    if (is_integral(V, near.local)) return Semidefinite{.sign = 0, .sets = {{}}};
    try {
        const PowerSign power = power_sign(near.local);
        if (!power.known) return {};
        const Expansion of_H = near.rate(near.series(power.H));
        int first = 0;
        while (first < near.monomials.size() && of_H.coefficient(first).is_zero()) ++first;
        if (first == near.monomials.size()) return {};
        const auto c = (rate.coefficient(first) / of_H.coefficient(first)).rational();
        if (!c || *c == 0 || !is_integral(V - ex(GiNaC::numeric(cln::cl_N(*c))) * power.H, near.local)) return {};
        return Semidefinite{*c > 0 ? -1 : 1, {{{rate}, {}}}};
    } catch (const NotAnalytic&) {
        return {};
    }
}

struct Signs {
    SignNear V, rate;
    std::optional<Semidefinite> half;  ///< of the rate
};

Decision stable_by(const Signs& s, const Neighbourhood& near, const std::string& set) {
    const int against = s.V.positive ? -1 : 1;
    const std::string V = s.V.positive ? say("V is positive definite") : say("-V is positive definite");
    const char* const down = s.V.positive ? "dV/dt" : "-dV/dt";
    if (s.rate.is(against))
        return {StabilityVerdict::asymptotically_stable, StabilityTheorem::lyapunov_asymptotic,
                say("{} and {} negative definite", V, down)};
    if (!s.half || (s.half->sign != 0 && s.half->sign != against)) return {};
    if (s.half->sign == 0)
        return {StabilityVerdict::stable, StabilityTheorem::lyapunov_stable,
                say("{} and constant along every motion", V)};
    const std::string where = set.empty() ? say("where dV/dt = 0") : say("where dV/dt = 0 ({})", set);
    if (std::all_of(s.half->sets.begin(), s.half->sets.end(),
                    [&](const Semidefinite::ZeroSet& one) { return holds_no_other_motion(one, near); }))
        return {StabilityVerdict::asymptotically_stable, StabilityTheorem::lasalle,
                say("{} and {} nowhere positive, and no motion but the equilibrium stays {}", V, down, where)};
    return {StabilityVerdict::stable, StabilityTheorem::lyapunov_stable,
            say("{} and {} nowhere positive; that no other motion stays {} is not shown", V, down, where)};
}

Decision unstable_by(const ex& V, const std::optional<ex>& rate, const Signs& s, const Expansion& V_series,
                     const Expansion& rate_series, const Neighbourhood& near) {
    for (const int sign : {1, -1}) {
        if (!(sign > 0 ? s.V.positive : s.V.negative)) continue;
        const std::string minus = sign > 0 ? "" : "-";
        if (s.rate.is(sign))
            return {
                StabilityVerdict::unstable, StabilityTheorem::lyapunov_instability,
                say("{}V takes positive values arbitrarily near, and {}dV/dt is positive definite", minus, minus)};
        if (by_second_theorem(V_series, rate_series, sign, near))
            return {StabilityVerdict::unstable, StabilityTheorem::lyapunov_instability,
                    say("{}V takes positive values arbitrarily near, and {}dV/dt is a positive multiple "
                        "of it and a positive definite rest",
                        minus, minus)};
        const auto V_numbers = near.with_numbers(in_states(V, near.local));
        if (V_numbers && s.half && s.half->sign == sign &&
            std::all_of(s.half->sets.begin(), s.half->sets.end(),
                        [&](const Semidefinite::ZeroSet& set) { return vanishes_on_set(*V_numbers, set, near); }))
            return {StabilityVerdict::unstable, StabilityTheorem::chetaev_instability,
                    say("{}V takes positive values arbitrarily near, and {}dV/dt is positive wherever it "
                        "is: {}dV/dt is nowhere negative, and zero only where V is",
                        minus, minus, minus)};
        if (rate && is_positive_multiple(V, *rate, near))
            return {StabilityVerdict::unstable, StabilityTheorem::chetaev_instability,
                    say("{}V takes positive values arbitrarily near, and {}dV/dt is positive wherever it "
                        "is: dV/dt is V times a positive function",
                        minus, minus)};
    }
    return {};
}

Decision says_nothing(const LyapunovAnswer& answer) {
    return {StabilityVerdict::undecided, StabilityTheorem::none,
            say("this V proves nothing here: the sign of V is {}, that of dV/dt is {}{}",
                translated(answer.sampled ? to_say("not proved") : answer.sign),
                translated(answer.sampled ? to_say("not proved") : answer.rate_sign),
                answer.sampled ? say(". {}, which is no proof", answer.samples) : "")};
}

void check_applies(const LinearizedScene& scene) {
    const Mechanism& m = scene.mechanism;
    if (!m.unilateral.empty())
        throw ModelError(say(
            "a Lyapunov function is judged where the equations of motion stay the same; this scene has contacts, "
            "which may close. Leave them out"));
    if (changes_with_time(m, scene.equations))
        throw ModelError(
            say("a Lyapunov function without t is judged where the equations do not change with time; these do"));
}

}  // namespace

std::pair<LyapunovAnswer, Decision> by_lyapunov_function(const std::string& text_of_V,
                                                         const LinearizedScene& scene, const Local* local) {
    check_applies(scene);
    const ex V = read_function(text_of_V, scene);
    LyapunovAnswer answer{.function = text_of_V, .sign = unknown_sign, .rate_sign = unknown_sign};
    const bool constrained = !scene.mechanism.constraints.empty();
    const auto sample = [&] {
        if (constrained) return std::pair(answer, says_nothing(answer));  // no numbers on the constraints
        answer.sampled = true;
        answer.samples = lyapunov_samples(V, scene);
        return std::pair(answer, says_nothing(answer));
    };
    check_zero_there(V, scene);
    if (!local) return sample();
    std::optional<Neighbourhood> near;
    Expansion V_series;
    try {
        near.emplace(*local);
        V_series = near->series(V);
    } catch (const NotAnalytic&) {
        return sample();
    }
    const Expansion rate_series = near->rate(V_series);
    const std::optional<ex> rate = near->rate(V);
    const std::optional<ex> in_numbers = rate ? near->with_numbers(*rate) : std::nullopt;
    if (rate)
        if (const auto f = fourier(*rate, *scene.mechanism.symbols, 400)) {
            answer.rate = text(readable(*f));
            if (answer.rate.size() > widest) answer.rate.clear();
        }
    Signs signs{sign_near(V_series, near->monomials), sign_near(rate_series, near->monomials), {}};
    if (!signs.rate.definite && !(signs.rate.positive && signs.rate.negative) && in_numbers)
        signs.half = semidefinite(*in_numbers, *near);
    if (!signs.rate.definite && !(signs.rate.positive && signs.rate.negative) && constrained)
        signs.half = half_by_energy(V, rate_series, *near);
    std::optional<Semidefinite> V_half;
    if (!signs.V.definite && !(signs.V.positive && signs.V.negative))
        if (const auto V_numbers = near->with_numbers(in_states(V, *local)))
            V_half = semidefinite(*V_numbers, *near);
    answer.sign = sign_text(signs.V, V_half);
    answer.rate_sign = sign_text(signs.rate, signs.half);
    if (signs.half && signs.half->sign != 0) answer.set = text_of_set(*signs.half, *scene.mechanism.symbols);
    Decision decision;
    if (signs.V.definite) decision = stable_by(signs, *near, answer.set);
    if (decision.verdict == StabilityVerdict::undecided)
        decision = unstable_by(V, in_numbers, signs, V_series, rate_series, *near);
    if (decision.verdict != StabilityVerdict::undecided) return {answer, decision};
    if (answer.sign == unknown_sign || answer.rate_sign == unknown_sign) return sample();
    return {answer, says_nothing(answer)};
}

}  // namespace alembert
