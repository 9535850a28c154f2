// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/equilibrium/equilibria.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/needs.hpp"
#include "program/lower/lower.hpp"
#include "stability/linear/dependence.hpp"
#include "stability/linear/events_here.hpp"

namespace alembert {

namespace {

constexpr double closed_gap = 1e-9;  // · max(1, |q|)

/// Checks that inputs are constant, because there is no equilibrium under a force that changes.
void check_inputs(const Mechanism& m, const Residuals& residuals, const Start& start) {
    for (std::size_t k = 0; k < residuals.inputs.size(); ++k) {
        const std::string name =
            m.inputs[static_cast<std::size_t>(residuals.inputs[k]) / 3].derivative[0].get_name();
        const int node = residuals.input_values[static_cast<std::size_t>(residuals.inputs[k])];
        for (const double later : {0.37, 1.0, 2.71}) {
            State<double> now = start.state(), then = now;
            then.t += later;
            now.unknown.resize(residuals.input_places());
            then.unknown = now.unknown;
            const double a = interpret(residuals.program, now)[node], b = interpret(residuals.program, then)[node];
            if (std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b))) continue;
            throw ModelError(say(
                "the input {} changes with time ({:.6g} at t = {:.6g}, {:.6g} at t = {:.6g}), so nothing stays at "
                "rest; expected inputs that are constant. Give its amplitude the value 0 by --at, or write a "
                "constant into [inputs]",
                name, a, now.t, b, then.t));
        }
        if (switches_in_time(residuals.program, node))
            throw ModelError(
                say("the input {} switches at some time, so nothing stays at rest; expected inputs that "
                    "are constant",
                    name));
    }
}

void check_contacts(const Derived& d, const Start& start) {
    if (d.mechanism.unilateral.empty()) return;
    const ContactView view(d.mechanism);
    const State<double> state = start.state();
    const LastingContacts lasting = contacts_at_rest(view, state, closed_gap);
    if (lasting.closed.empty()) return;
    std::vector<std::string> names;
    for (const int k : lasting.closed) names.push_back(d.mechanism.unilateral[k].gap.name);
    throw ModelError(
        say("contact {} is closed at this state; equilibria are searched with all contacts open. Give a "
            "state by --at in which it is open, or write it as a [[constraint]] in place of the "
            "[[unilateral]]",
            fmt::join(names, ", ")));
}

std::vector<double> multipliers_at(const SteadyProblem& problem, const Instant<long double>& at) {
    const SteadySystem here = problem.linearized_at(at, at.u);
    return {here.tangent.lambda.data(), here.tangent.lambda.data() + here.tangent.lambda.size()};
}

/// Whether it is proved that there is one within the accuracy of Newton's method, and no other.
StateKnown known_at(const Derived& d, const SteadyProblem& problem, const Start& start,
                    const Instant<long double>& at) {
    constexpr double most_work = 3e6;
    const Residuals& residuals = problem.residuals();
    const Split split = problem.linearized_at(at, at.u).split;
    const double unknowns = static_cast<double>(at.q.size() + 3 * static_cast<std::size_t>(residuals.kept));
    if (unknowns * unknowns * residuals.program.size() > most_work) return StateKnown::in_numbers;
    std::vector<int> essential;
    for (std::size_t k = 0; k < split.q.size(); ++k)
        if (problem.essential()[static_cast<std::size_t>(split.q[k])]) essential.push_back(static_cast<int>(k));
    RealBallPoint point{.parameters = exact_parameters(d.mechanism, start, {}),
                        .t = RealBall::about(static_cast<Quad>(start.t), 0)};
    const auto certain = [](const std::vector<long double>& list) {
        RealBallVector result;
        for (const long double x : list) result.push_back(x == 0 ? RealBall(0) : RealBall::about(x, 0));
        return result;
    };
    point.q = certain(at.q);
    point.u = certain(at.u);
    const RealBallVector inputs = certain(at.inputs);
    point.inputs.resize(residuals.input_places());
    for (std::size_t k = 0; k < inputs.size(); ++k)
        point.inputs[static_cast<std::size_t>(residuals.inputs[k])] = inputs[k];
    return disc_around(residuals, split, essential, {}, point, proved_radius);
}

/// Is a gap negative at this state?
bool penetrates(const Derived& d, const Start& start) {
    if (d.mechanism.unilateral.empty()) return false;
    Program program;
    std::vector<GiNaC::ex> gaps;
    for (const Mechanism::Unilateral& contact : d.mechanism.unilateral) gaps.push_back(*contact.gap.position);
    const std::vector<int> nodes = lower_expressions(program, d.mechanism, gaps);
    const std::vector<double> value = interpret(program, start.state());
    return std::any_of(nodes.begin(), nodes.end(), [&](int node) { return value[node] < -closed_gap; });
}

std::string searched(const Equilibria& found) {
    std::vector<std::string> where;
    const Mechanism& m = found.mechanism;
    for (int i = 0; i < m.size(); ++i)
        if (std::find(found.cyclic.begin(), found.cyclic.end(), m.q[i].get_name()) == found.cyclic.end())
            where.push_back(m.q[i].get_name() +
                            (found.search.is_angle[i] ? say(" in one turn") : say(" near the scene's lengths")));
    std::string text = say("no equilibrium or steady motion was found from {} start{}", found.search.starts,
                           found.search.starts == 1 ? "" : "s");
    if (!where.empty()) text += fmt::format(" ({})", fmt::join(where, ", "));
    if (!found.search.left_over.empty()) {
        std::vector<std::string> forces;
        for (const long double x : found.search.left_over)
            forces.push_back(fmt::format("{:.6g}", static_cast<double>(x)));
        std::vector<std::string> state;
        for (int i = 0; i < m.size(); ++i)
            state.push_back(
                fmt::format("{} = {:.6g}", m.q[i].get_name(), static_cast<double>(found.search.nearest.q[i])));
        text += say("; the least forces left over were {} at {}", fmt::join(forces, ", "), fmt::join(state, ", "));
    } else {
        text += say("; at none of them did the constraints and forces have values");
    }
    return say("{}. This is no proof that there is none", text);
}

/// Nothing is said of the stability of what may not be there, or be there twice.
StabilityHint undecided_as_open(StabilityHint judgement) {
    if (judgement.stable == Stable::undecided) return judgement;
    judgement.stable = Stable::undecided;
    judgement.meets = true;
    judgement.because =
        say("that there is one equilibrium here, and not several or none, cannot be proved at these numbers");
    return judgement;
}

/// Throws if a force is the same at every state and nothing balances it. In a dead zone it is so, and on a flat
/// piece of a table, but not beyond.
void check_balance(const Equilibria& found, const SteadyProblem& problem) {
    const Residuals& residuals = problem.residuals();
    if (!Borders(residuals.program, residuals.forcing).empty()) return;
    for (std::size_t i = 0; i < found.search.constant.size(); ++i)
        if (found.search.constant[i]) {
            const SteadySystem here = problem.linearized_at(problem.start(), problem.start().u);
            throw ModelError(say(
                "there is no equilibrium or steady motion: the force along {} is {:.6g} at every state, and "
                "nothing balances it. Add what holds it (a spring, a damper, a constraint), or set the force to "
                "0 by --at",
                found.equations.u[here.split.u[i]].get_name(), static_cast<double>(here.tangent.balance[i])));
        }
}

/// If rates do not stay constant, Kane's speeds may, as for a sledge that runs on a circle.
bool may_try_minimal_speeds(const Derived& d) {
    const auto& all = d.mechanism.constraints;
    return d.by.empty() && d.mechanism.speeds.empty() && masses_are_known(d.mechanism) &&
           std::any_of(all.begin(), all.end(), [](const auto& c) { return !c.holonomic; });
}

/// The values of expressions in parameters and given rates.
std::vector<double> numbers(const Mechanism& m, const std::vector<GiNaC::ex>& list, const Start& start) {
    Program program;
    const std::vector<int> nodes = lower_expressions(program, m, list);
    const std::vector<double> value = interpret(program, start.state());
    std::vector<double> result;
    for (const int node : nodes) result.push_back(value[node]);
    return result;
}

/// Whether a sine is taken of a coordinate that is no angle, as of x in (y - x/3)^2 + cos(x): each of its whole
/// turns is another state.
bool turns_otherwise(const Equilibria& found, const SteadyProblem& problem) {
    const Program& program = problem.residuals().program;
    const std::vector<int> needed = program.needed(problem.residuals().forcing);
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        const Op op = program[id].op;
        if (op != Op::sin && op != Op::cos && op != Op::tan) return false;
        const std::vector<int> inside = program.needed(std::vector{program[id].args[0]});
        return std::any_of(inside.begin(), inside.end(), [&](int leaf) {
            const Variable& v = program[leaf].variable;
            return program[leaf].op == Op::variable && v.kind == Variable::Kind::coordinate &&
                   !found.search.is_angle[static_cast<std::size_t>(v.index)];
        });
    });
}

/// Compares the solutions in the parameters with those that Newton's method has found: each of the latter must be
/// one of the former, and each solution that is real at these parameters must be a root.
void solve_in_symbols(Equilibria& result, const SteadyProblem& problem, const Start& start,
                      const std::function<void(const FoundRoot&)>& add) {
    // Newton's method comes no nearer to a root of high multiplicity, and takes it for one of a continuum.
    constexpr long double same = 1e-9L, same_if_multiple = 1e-4L, same_if_meeting = 3e-2L;
    const Mechanism& m = result.mechanism;
    const auto vanishes = [&](const GiNaC::ex& e) { return !(std::abs(numbers(m, {e}, start)[0]) > 1e-13); };
    auto roots = closed_form(m, result.equations, problem.essential(), vanishes);
    if (!roots) return;
    const auto place = [&](const Equilibrium& one) {
        Instant<long double> at = problem.start();
        at.q.assign(one.start.q.begin(), one.start.q.end());
        return at;
    };
    bool agrees = true;
    for (ClosedRoot& root : *roots) {
        const std::vector<double> q = numbers(m, root.value, start);
        if (!std::all_of(q.begin(), q.end(), [](double x) { return std::isfinite(x); })) {
            result.not_real.push_back(std::move(root));
            continue;
        }
        Instant<long double> at = problem.start();
        for (std::size_t i = 0; i < q.size(); ++i)
            if (problem.essential()[i]) at.q[i] = q[i];
        wrap_angles(at, result.search.is_angle);
        const auto find = [&](long double tolerance) {
            return std::find_if(result.list.begin(), result.list.end(), [&](const Equilibrium& one) {
                const long double apart = distance(problem, result.search.is_angle, at, place(one));
                return apart < (one.judgement.meets && tolerance > same ? same_if_meeting : tolerance);
            });
        };
        auto found = find(same);
        if (found == result.list.end()) found = find(same_if_multiple);
        if (found == result.list.end()) {
            if (const auto more = problem.solve(at)) add({*more});
            found = find(same_if_multiple);
        }
        agrees = agrees && found != result.list.end();
        if (found == result.list.end() || found->exact) continue;
        for (std::size_t i = 0; i < q.size(); ++i)
            if (problem.essential()[i]) found->start.q[i] = static_cast<double>(at.q[i]);
        if (found->judgement.meets) found->family.reset();
        found->exact = std::move(root);
        found->known = StateKnown::exactly;
    }
    std::erase_if(result.list, [&](const Equilibrium& one) {
        return !one.exact && one.judgement.meets &&
               std::any_of(result.list.begin(), result.list.end(), [&](const Equilibrium& other) {
                   return other.exact &&
                          distance(problem, result.search.is_angle, place(other), place(one)) < same_if_meeting;
               });
    });
    for (const Equilibrium& one : result.list) agrees = agrees && one.exact;
    result.closed = agrees && result.mechanism.frictions.empty() && !turns_otherwise(result, problem);
    std::sort(result.not_real.begin(), result.not_real.end(),
              [](const ClosedRoot& a, const ClosedRoot& b) { return a.text < b.text; });
}

void search_in(Equilibria& result, const Start& start, const EquilibriumOptions& options) {
    SteadyProblem problem(result.mechanism, result.equations, start);
    check_inputs(result.mechanism, problem.residuals(), start);
    SearchOptions wishes{.starts = options.starts};
    if (options.progress) wishes.progress = [&](double part) { options.progress(say("searching"), part); };
    result.search = search_steady(problem, result.mechanism, start, wishes);
    result.cyclic.clear();
    for (int i = 0; i < result.mechanism.size(); ++i)
        if (!problem.essential()[i]) result.cyclic.push_back(result.mechanism.q[i].get_name());
    const EnergyRate energy = energy_rate(result.mechanism, problem, start.parameters);
    const Program constraints = lower_constraints(result.mechanism);
    const auto add = [&](const FoundRoot& root) {
        Equilibrium one{.start = problem.start_at(start, root.at),
                        .moving = {},
                        .residual = static_cast<double>(root.residual),
                        .family = root.family,
                        .multipliers = multipliers_at(problem, root.at),
                        .known = root.family ? StateKnown::in_numbers : known_at(result, problem, start, root.at),
                        .judgement = judge(problem, energy, root.at)};
        if (one.known == StateKnown::open) one.judgement = undecided_as_open(std::move(one.judgement));
        if (const auto why = disturbed_by_event(result, one.start)) {
            one.judgement.stable = Stable::undecided;
            one.judgement.because = *why;
        }
        if (penetrates(result, one.start) || turned_joint(result.mechanism, constraints, one.start.state()))
            return;
        // Coordinates that are cyclic, or moved by a constraint, from rest too.
        const VectorOf<long double> udot = problem.linearized_at(root.at, root.at.u).tangent.udot;
        for (int i = 0; i < result.mechanism.size(); ++i)
            if (std::abs(one.start.qdot[i]) > 1e-12 ||
                (problem.residuals().rates_are_speeds && std::abs(udot[i]) > 1e-9L))
                one.moving.push_back(result.mechanism.q[i].get_name());
            else
                one.start.qdot[i] = 0;
        result.list.push_back(std::move(one));
    };
    for (const FoundRoot& root : result.search.roots) add(root);
    if (result.search.rates == Rates::given && result.mechanism.unilateral.empty())
        solve_in_symbols(result, problem, start, add);
    for (Equilibrium& one : result.list) {
        std::vector<Assumption>& assumed = one.judgement.assumed;
        if (one.judgement.stable == Stable::undecided)
            assumed.clear();
        else if (one.known == StateKnown::in_numbers)
            assumed.push_back(state_in_numbers());
    }
    if (!result.list.empty()) return;
    check_balance(result, problem);
    result.nothing = result.search.roots.empty()
                         ? searched(result)
                         : say("at each equilibrium that was found a contact would be open by less "
                               "than nothing; those that rest on a contact are not searched");
}

}  // namespace

Equilibria equilibria(Scene scene, const EquilibriumOptions& options) {
    argument::need_whole_nonnegative("starts", options.starts);
    Equilibria result{derived(std::move(scene), {.by = options.by, .at = options.at, .with_states = true})};
    Start start = start_of(result.mechanism, options.at);
    assemble(start, result.mechanism, lower_constraints(result.mechanism), options.at, false);
    check_contacts(result, start);
    search_in(result, start, options);
    if (result.list.empty() && may_try_minimal_speeds(result)) {
        Equilibria other{derived_again(result, result.mechanism, formalism_for(Need::minimal_speeds).name)};
        search_in(other, start, options);
        if (!other.list.empty()) return other;
    }
    return result;
}

}  // namespace alembert
