// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/derive/derived.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "alembert/base/process_time.hpp"
#include "analysis/audit/audit.hpp"
#include "analysis/audit/tied_rows.hpp"
#include "analysis/derive/start_check.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/diagnose.hpp"
#include "analysis/state/force_balance.hpp"
#include "analysis/state/gimbal.hpp"
#include "analysis/state/irregular_constraints.hpp"
#include "analysis/state/redundancy.hpp"
#include "analysis/state/speeds.hpp"
#include "base/language/say.hpp"
#include "base/language/screens.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/joint_tree.hpp"
#include "model/formalism/needs.hpp"
#include "model/formalism/recursive.hpp"
#include "model/formalism/with_states.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/perturbed_tree.hpp"
#include "program/lower/start.hpp"

namespace alembert {

namespace {

/// The equations by the formalism of that name; without a name, by the one that a teacher would choose.
Equations equations_by(const std::string& name, const Mechanism& mechanism) {
    if (!name.empty()) return formalism(name).derive(mechanism);
    if (mechanism.q.empty())
        return equations_without_terms(formalism_for(Need::independent).name, with_own_intermediates(mechanism));
    if (!mechanism.speeds.empty() && mechanism.unilateral.empty() && masses_are_known(mechanism))
        return formalism_for(Need::minimal_speeds).derive(mechanism);
    return formalism_in_rates(mechanism).derive(mechanism);
}

constexpr int many_pairs = 128;       // pairs of a body and one it is carried by: a chain of 16 has as many
constexpr int pairs_too_long = 1600;  // with more nobody reads the equations, in which both of a pair appear
// Joints; with more, most of the derivation, emission and compilation would be for M.
constexpr int most_with_matrix = 80;

/// Nothing if other equations may be faster. M has an element for each joint and each joint that carries it, which
/// means as many operations for all methods except articulated bodies.
std::optional<Equations> recursive_for_large_trees(const Mechanism& m, Use use) {
    const bool has_others = std::any_of(m.constraints.begin(), m.constraints.end(),
                                        [](const Mechanism::Constraint& c) { return !c.norm; });
    if (!m.speeds.empty() || has_others || !m.unilateral.empty() || m.size() * (m.size() + 1) / 2 < many_pairs ||
        !masses_are_known(m))
        return {};
    const Possible<JointTree> tree = joint_tree(m);
    if (!tree.exists() || !norms_alone(tree.value(), m)) return {};
    std::vector<int> depth;
    int pairs = 0;
    for (const TreeJoint& joint : tree.value().joints) {
        depth.push_back(joint.link.parent < 0 ? 1 : depth[static_cast<std::size_t>(joint.link.parent)] + 1);
        pairs += depth.back();
    }
    if (pairs < many_pairs) return {};
    if (use == Use::shown_or_counted && m.size() <= lines_of_two_screens && pairs < pairs_too_long) return {};
    if (use != Use::asked && static_cast<int>(depth.size()) > most_with_matrix) return recursive_without_matrix(m);
    return recursive(m);
}

/// Throws with the names of constraints that no state obeys. Initial values that break a constraint are reported
/// later, by the computations that use them.
void refuse_contradiction(const Mechanism& m) {
    if (m.constraints.empty()) return;
    const Mechanism sampled = with_sample_functions(m);
    Start start = start_of(sampled);
    try {
        assemble(start, sampled, lower_constraints(sampled), {});
    } catch (const std::runtime_error&) {
        const Audit found = audit_of(m);
        if (found.contradictory.size() > 1) throw ModelError(found.problem);
    }
}

/// Adds the reaction of each constraint along each coordinate, λ ∂f/∂q, as outputs R_<constraint>_<coordinate>.
std::vector<ReactionOutput> add_reactions(Mechanism& m) {
    std::vector<ReactionOutput> result;
    for (const auto* list : {&m.constraints, &m.redundant})
        for (const Mechanism::Constraint& c : *list)
            for (int i = 0; i < m.size(); ++i) {
                if (c.row[i].is_zero()) continue;
                const std::string coordinate = m.q[i].get_name();
                result.push_back({m.outputs.size(), c.name, coordinate});
                m.outputs.push_back(
                    {fmt::format("R_{}_{}", c.name, coordinate), m.z->name(c.row[i] * c.multiplier)});
            }
    return result;
}

/// A rolling condition has three rows, one of which often follows from the position of the body; only `audit`
/// reports that. The same applies to a joint that closes a loop.
std::vector<Diagnostic> warning_of_redundancy(const Prepared& p, const Mechanism::Constraint& c) {
    if (c.joint) return {};
    if (std::any_of(p.scene.rolling.begin(), p.scene.rolling.end(),
                    [&](const RollingRule& r) { return r.name.place == c.place; }))
        return {};
    return {{c.place,
             say("constraint '{}' follows from the others; its equation is left "
                 "out, and of all reactions that satisfy the constraints the least are taken",
                 c.name),
             Severity::warning, "redundant", c.name}};
}

/// "k = 1, n = 0": what events set and nothing else changes, at the start; empty if there is nothing of the kind.
std::string held_by_modes(const Mechanism& m, const Overrides& at) {
    const Start start = start_of(m, at);
    std::string result;
    for (std::size_t i = 0; i < m.states.size(); ++i) {
        const auto sets = [&](const Mechanism::EventAction& event) {
            return std::any_of(event.set.begin(), event.set.end(),
                               [&](const auto& one) { return static_cast<std::size_t>(one.first) == i; });
        };
        if (!m.states[i].rate.is_zero() || std::none_of(m.event_actions.begin(), m.event_actions.end(), sets))
            continue;
        result += fmt::format("{}{} = {:.6g}", result.empty() ? "" : ", ", m.states[i].derivative[0].get_name(),
                              start.states[i]);
    }
    return result;
}

}  // namespace

Derived derived(Scene scene, const DeriveOptions& options) {
    const double start = process_seconds();
    Derived d{prepared(std::move(scene), options.at, options.on_sheets, options.coordinates)};
    d.by = options.by;
    refuse_irregular_constraints(d.mechanism);
    const std::vector<int> redundant = redundant_constraints(d.mechanism);
    check_implied(d.mechanism, redundant);
    for (const int k : redundant) d.warn(warning_of_redundancy(d, d.mechanism.constraints[k]));
    d.mechanism = with_tied_rows(without_constraints(std::move(d.mechanism), redundant));
    refuse_contradiction(d.mechanism);
    if (options.reactions) d.reaction_outputs = add_reactions(d.mechanism);
    if (const std::optional<Diagnostic> mistake = mistake_in_speeds(d.mechanism)) fail(d.scene, {*mistake});
    std::optional<Equations> at_once;
    if (options.use != Use::shown && d.by.empty()) at_once = recursive_for_large_trees(d.mechanism, options.use);
    d.equations = at_once ? *std::move(at_once) : equations_by(d.by, d.mechanism);
    d.mechanism.z = d.equations.z;
    if (options.with_states) d.equations = with_states(d.equations, d.mechanism);
    if (options.with_states && d.mechanism.has_kicks()) {
        const std::string held = held_by_modes(d.mechanism, options.at);
        d.warn("events",
               held.empty()
                   ? say("warning: the scene has events that change rates or states; what is said here is "
                         "of the equations between them\n")
                   : say("warning: the scene has events that change rates or states; what is said here is "
                         "of the equations between them, with {}\n",
                         held));
    }
    if (d.mechanism.speeds.empty() && !d.equations.poles.empty())
        d.warn(
            "poles",
            say("warning: the rates that remain when the nonholonomic constraints are solved do not determine the "
                "others at every pose, and numbers lose accuracy near such poses; give the scene generalized "
                "speeds, "
                "[speeds]\n"));
    if (options.use == Use::shown || (options.use == Use::shown_or_counted && !at_once)) {
        d.warn(warnings_of_unresisted(d.scene, d.mechanism, d.equations));
        d.warn(warnings_of_start(d.mechanism, options.at));
    }
    d.seconds = process_seconds() - start;
    return d;
}

Derived derived_again(const Derived& d, Mechanism mechanism, const std::string& by) {
    const double start = process_seconds();
    Derived again{{.scene = d.scene, .mechanism = std::move(mechanism), .warnings = d.warnings}};
    again.equations = equations_by(by, again.mechanism);
    if (has_states(d.equations, d.mechanism)) again.equations = with_states(again.equations, again.mechanism);
    again.mechanism.z = again.equations.z;
    again.by = d.by;
    again.sheets = d.sheets;
    again.reaction_outputs = d.reaction_outputs;
    again.seconds = process_seconds() - start;
    return again;
}

void need_rates(const Derived& d) {
    if (!d.equations.speeds_are_rates())
        throw ModelError(say(
            "contacts are followed in coordinates and their rates, and impulses of events in these or the scene's "
            "own speeds; derive by routh instead of "
            "kane"));
}

Choice lowered(const Derived& d, bool fold) {
    std::vector<Equations> all{d.equations};
    const Formalism& fastest = formalism_for(Need::fastest);
    if (d.by.empty() && d.equations.speeds_are_rates() && !d.equations.tree && !fastest.obstacle(d.mechanism))
        all.push_back(fastest.derive(d.mechanism));
    return choose(d.mechanism, all, {.fold = fold, .admissible = [&d] { return admissible_start(d.mechanism); }});
}

std::optional<Differentiated> derivatives_of(const Derived& d, const Program& program, DerivativeWishes wishes,
                                             bool fold) {
    wishes.perturbed = perturbed_tree(program, d.mechanism, d.equations, fold);
    return differentiated(program, wishes);
}

namespace {

struct Failure {
    enum class Kind { massless, division_by_zero, other };
    std::string reason;
    Kind kind = Kind::other;
    bool is_massless() const { return kind == Kind::massless; }
};

/// The line of a load or an energy in the scene; 0 for what has none of its own.
int line_of(const Scene& scene, const Origin& origin) {
    const auto k = static_cast<std::size_t>(origin.index);
    switch (origin.kind) {
        case Origin::Kind::spring:
            return scene.springs[k].place.line;
        case Origin::Kind::damper:
            return scene.dampers[k].place.line;
        case Origin::Kind::force:
            return scene.forces[k].place.line;
        case Origin::Kind::torque:
            return scene.torques[k].place.line;
        case Origin::Kind::generalized_force:
            return scene.generalized_forces[k].value.place().line;
        case Origin::Kind::given_kinetic:
            return scene.kinetic.place().line;
        case Origin::Kind::given_potential:
            return scene.potential.place().line;
        case Origin::Kind::given_lagrangian:
            return scene.lagrangian.place().line;
        case Origin::Kind::rayleigh:
            return scene.rayleigh.place().line;
        default:
            return 0;
    }
}

/// " (line 8)", for the parts of these labels.
std::string lines_of(const Derived& d, const std::vector<std::string>& labels) {
    std::set<int> lines;
    const auto add = [&](const Origin& origin) {
        if (std::find(labels.begin(), labels.end(), label(origin)) != labels.end())
            if (const int line = line_of(d.scene, origin); line > 0) lines.insert(line);
    };
    const auto look = [&](const auto& parts) {
        for (const auto& part : parts) add(part.origin);
    };
    add({.kind = Origin::Kind::given_lagrangian});
    look(d.mechanism.kinetic);
    look(d.mechanism.potential);
    look(d.mechanism.loads);
    if (lines.empty()) return "";
    return " " +
           (lines.size() == 1 ? say("(line {})", *lines.begin()) : say("(lines {})", fmt::join(lines, ", ")));
}

std::optional<Failure> found_failure(const Derived& d, const State<double>& state) {
    const auto other = [](std::optional<std::string> reason) -> std::optional<Failure> {
        if (!reason) return std::nullopt;
        return Failure{std::move(*reason)};
    };
    if (auto lock = gimbal_lock(d.scene, d.mechanism, state)) return other(lock);
    LowerOptions options{.admissible = [&d] { return admissible_start(d.mechanism); }};
    if (d.equations.M.rows() == 0) options.recursion = RecursionForm{.solve = RecursionForm::Solve::articulated};
    const Program program = lower(d.mechanism, d.equations, energy_of(d.mechanism), options);
    if (const auto combination = massless_combination(program, state))
        return Failure{say("nothing has inertia along {}; give it a mass, or remove a coordinate", *combination),
                       Failure::Kind::massless};
    if (auto lost = lost_rank(program, state, d.equations.kept(d.mechanism))) return other(lost);
    const Group group = program.singular ? Group::forcing : Group::acceleration;
    if (auto ended = ended_table(program, state, group)) return other(ended);
    auto found = not_finite(program, state, group);
    if (!found) return std::nullopt;
    return Failure{found->text + lines_of(d, found->parts),
                   found->is_division ? Failure::Kind::division_by_zero : Failure::Kind::other};
}

}  // namespace

std::optional<std::string> failure_at(const Derived& d, const State<double>& state) {
    auto failure = found_failure(d, state);
    if (!failure) return std::nullopt;
    if (failure->is_massless()) return say("the mass matrix is singular: {}", failure->reason);
    return std::move(failure->reason);
}

bool divides_by_zero_at(const Derived& d, const State<double>& state) {
    const auto failure = found_failure(d, state);
    return failure && failure->kind == Failure::Kind::division_by_zero;
}

std::string no_accelerations_at(const Derived& d, const State<double>& state) {
    const auto failure = found_failure(d, state);
    if (!failure) return say("there are no finite accelerations at t = {:.6g}: the numbers overflow", state.t);
    return failure->is_massless()
               ? say("the mass matrix is singular at t = {:.6g}: {}", state.t, failure->reason)
               : say("there are no finite accelerations at t = {:.6g}: {}", state.t, failure->reason);
}

}  // namespace alembert
