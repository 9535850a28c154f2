// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/contact/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "alembert/base/dense.hpp"
#include "alembert/base/tolerances.hpp"
#include "base/language/libraries.hpp"
#include "base/language/say.hpp"
#include "model/formalism/routh.hpp"
#include "model/friction.hpp"
#include "program/lower/lower.hpp"
#include "program/partials.hpp"

namespace alembert {

using GiNaC::ex;

Mechanism with_closed(Mechanism mechanism, const std::vector<int>& closed) {
    for (const int k : closed) mechanism.constraints.push_back(mechanism.unilateral[k].gap);
    return mechanism;
}

Mechanism with_all_closed(const Mechanism& mechanism) {
    std::vector<int> all(mechanism.unilateral.size());
    std::iota(all.begin(), all.end(), 0);
    return with_closed(mechanism, all);
}

Mechanism with_contacts_watched(Mechanism mechanism, const std::vector<int>& closed) {
    for (std::size_t k = 0; k < mechanism.unilateral.size(); ++k) {
        const Mechanism::Constraint& gap = mechanism.unilateral[k].gap;
        const bool is_closed = std::find(closed.begin(), closed.end(), static_cast<int>(k)) != closed.end();
        mechanism.events.push_back({gap.name, is_closed ? GiNaC::ex(gap.multiplier) : *gap.position});
        mechanism.event_actions.push_back({.stop = true});
    }
    return mechanism;
}

Mechanism with_contact_forces(Mechanism mechanism) {
    for (const Mechanism::Unilateral& contact : std::exchange(mechanism.unilateral, {})) {
        const Mechanism::Constraint& gap = contact.gap;
        ex velocity = 0;
        for (int i = 0; i < mechanism.size(); ++i) velocity += gap.row[i] * mechanism.qdot[i];
        const GiNaC::symbol force = mechanism.symbols->declare(
            gap.multiplier.get_name(), SymbolInfo::Kind::parameter, static_cast<int>(mechanism.parameters.size()));
        mechanism.parameters.push_back({.symbol = force, .value = 0, .unit = {}, .about = {}});
        mechanism.loads.push_back({.origin = {.kind = Origin::Kind::force, .name = gap.name},
                                   .pairs = {{.velocity = mechanism.z->name(velocity), .force = force}}});
        for (Mechanism::Definition& output : mechanism.outputs)
            if (mechanism.z->depends(output.value, {gap.multiplier}))
                output.value = mechanism.z->name(mechanism.z->expand(output.value).subs(gap.multiplier == force));
    }
    return mechanism;
}

namespace {

std::vector<ex> sliding_velocity(const Mechanism::Friction& f) {
    return f.across ? std::vector{f.sliding_velocity, *f.across} : std::vector{f.sliding_velocity};
}

/// Replaces the sliding velocity of each friction by its one or two components, and adds their rates of change at
/// q'' = 0, its restitution, and ∂v/∂q' of each component, n entries each.
void add_slip_rows(Program& program, const Mechanism& mechanism) {
    std::erase_if(program.roots, [](const Root& root) { return root.group == Group::sliding_velocity; });
    const auto add = [&](Group group, const std::vector<ex>& values) {
        for (const int node : lower_expressions(program, mechanism, values))
            program.roots.push_back({group, "", node});
    };
    std::vector<ex> velocities, restitutions;
    for (const Mechanism::Friction& f : mechanism.frictions) {
        for (const ex& v : sliding_velocity(f)) velocities.push_back(v);
        restitutions.push_back(f.restitution);
    }
    add(Group::sliding_velocity, velocities);
    add(Group::sliding_acceleration, mechanism.time_derivative_without_acceleration(velocities));
    add(Group::grip, restitutions);
    const std::vector<int> sliding_velocities = program.nodes_of(Group::sliding_velocity);
    const int n = static_cast<int>(program.coordinates.size());
    if (sliding_velocities.empty()) return;
    std::vector<int> rates;
    for (int i = 0; i < n; ++i) rates.push_back(program.variable({Variable::Kind::rate, i}));
    const auto found = partials(program, sliding_velocities, rates, EliminationOrder::forward);
    std::vector<int> rows(sliding_velocities.size() * rates.size(), program.number(0));
    for (const Partial& one : found.value()) rows[static_cast<std::size_t>(one.output * n + one.input)] = one.node;
    for (const int entry : rows) program.roots.push_back({Group::form_row, "", entry});
}

/// A program with the rows and other values of all constraints, contacts last. It has no accelerations, because
/// there may be none with all contacts closed.
Program view_of(const Mechanism& mechanism) {
    if (mechanism.q.empty()) return begun(mechanism);
    Mechanism closed = with_all_closed(without_plane_friction(mechanism));
    closed.outputs.clear();
    closed.events.clear();
    closed.event_actions.clear();
    Energy energy = energy_of(mechanism);
    energy.power = 0;  // it contains multipliers
    Program program = lower(closed, routh(closed), energy, {.states_are_given = true});
    const auto is_wanted = [](const Root& root) {
        for (const Group group : {Group::mass, Group::forcing, Group::row, Group::gamma, Group::position,
                                  Group::velocity, Group::sliding_velocity, Group::stick_bound, Group::friction})
            if (root.group == group) return true;
        return false;
    };
    std::erase_if(program.roots, [&](const Root& root) { return !is_wanted(root); });
    add_slip_rows(program, closed);
    return program.canonical();
}

}  // namespace

FunctionProgram contact_function(const Mechanism& mechanism) {
    Program program = view_of(mechanism);
    const std::vector<int> gap = program.nodes_of(Group::position), rate = program.nodes_of(Group::velocity),
                           delta = program.nodes_of(Group::gamma), row = program.nodes_of(Group::row);
    const std::size_t first = mechanism.constraints.size(), n = mechanism.q.size();
    std::vector<int> values;
    for (std::size_t k = 0; k < mechanism.unilateral.size(); ++k) {
        const std::size_t at = first + k;
        values.insert(values.end(), {gap[at], rate[at], delta[at],
                                     lower_expression(program, mechanism, mechanism.unilateral[k].restitution)});
        const auto begin = row.begin() + static_cast<std::ptrdiff_t>(at * n);
        values.insert(values.end(), begin, begin + static_cast<std::ptrdiff_t>(n));
    }
    return {.name = "contacts_at",
            .about = "Of each contact its gap, gap', delta of gap'' = G q'' - delta, restitution, and G.",
            .rows = static_cast<int>(mechanism.unilateral.size()),
            .columns = static_cast<int>(n) + 4,
            .program = with_values_only(std::move(program), values)};
}

namespace {

constexpr double rate_at_rest = 1e-13;     // of rounding, as in lib/alembert/hybrid/lasting_contacts.cpp
constexpr double negligible_slip = 1e-12;  // of a sliding velocity, relative to the sizes of its terms

}  // namespace

std::vector<ContactView::ContactOfFriction> ContactView::contacts_of_frictions(const Mechanism& m) {
    std::vector<ContactOfFriction> result;
    for (const Mechanism::Friction& f : m.frictions) {
        const auto found = std::find_if(m.unilateral.begin(), m.unilateral.end(), [&](const auto& contact) {
            return f.multiplier && contact.gap.multiplier.is_equal(*f.multiplier);
        });
        result.push_back(
            {.contact = found == m.unilateral.end() ? -1 : static_cast<int>(found - m.unilateral.begin()),
             .components = sliding_velocity(f).size()});
    }
    return result;
}

ContactView::ContactView(const Mechanism& mechanism)
    : program_(view_of(mechanism)),
      n_(mechanism.size()),
      bilateral_(static_cast<int>(mechanism.constraints.size())),
      rough_(contacts_of_frictions(mechanism)) {
    for (const Mechanism::Unilateral& contact : mechanism.unilateral) names_.push_back(contact.gap.name);
}

Situation ContactView::at(const State<double>& state) const {
    const std::vector<double> value = interpret(program_, state);
    const auto of = [&](Group group) {
        const std::vector<int> nodes = program_.nodes_of(group);
        Eigen::VectorXd result(static_cast<Eigen::Index>(nodes.size()));
        for (std::size_t i = 0; i < nodes.size(); ++i) result[static_cast<Eigen::Index>(i)] = value[nodes[i]];
        return result;
    };
    Situation here{.M = Eigen::MatrixXd(n_, n_), .f = of(Group::forcing), .bilateral = {}, .contacts = {}};
    const Eigen::VectorXd mass = of(Group::mass), row = of(Group::row),
                          u = Eigen::Map<const Eigen::VectorXd>(state.qdot.data(), n_);
    for (Eigen::Index i = 0, k = 0; i < n_; ++i)
        for (Eigen::Index j = 0; j <= i; ++j, ++k) here.M(i, j) = here.M(j, i) = mass[k];
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Index contacts = static_cast<Eigen::Index>(names_.size()), all = bilateral_ + contacts;
    Situation::Rows rows{.rows = Eigen::Map<const Rows>(row.data(), all, n_),
                         .value = of(Group::position),
                         .offset = {},
                         .acceleration = of(Group::gamma)};
    rows.offset = of(Group::velocity) - rows.rows * u;
    std::vector<int> which(static_cast<std::size_t>(all));
    std::iota(which.begin(), which.end(), 0);
    here.bilateral = selected(rows, {which.begin(), which.begin() + bilateral_});
    here.contacts = selected(rows, {which.begin() + bilateral_, which.end()});
    const Eigen::VectorXd sliding_velocity = of(Group::sliding_velocity), sliding_rows = of(Group::form_row),
                          sliding = of(Group::friction), bound = of(Group::stick_bound),
                          change = of(Group::sliding_acceleration), grip = of(Group::grip);
    for (std::size_t k = 0, first = 0; k < rough_.size(); first += rough_[k++].components) {
        if (rough_[k].contact < 0) continue;
        const auto i = static_cast<Eigen::Index>(k), at = static_cast<Eigen::Index>(first),
                   count = static_cast<Eigen::Index>(rough_[k].components);
        const Eigen::MatrixXd along = Eigen::Map<const Rows>(sliding_rows.data() + at * n_, count, n_);
        const Eigen::VectorXd velocity = sliding_velocity.segment(at, count);
        here.rough.push_back(
            {.contact = rough_[k].contact,
             .tangent = along,
             .offset = velocity - along * u,
             .velocity = velocity,
             .acceleration = -change.segment(at, count),
             .coefficient = sliding[i],
             .resting = sliding[i] * bound[i],
             .restitution = grip[i],
             .still = rate_at_rest + negligible_slip * (along.cwiseAbs() * u.cwiseAbs()).maxCoeff()});
    }
    return here;
}

std::vector<double> restitutions(const Mechanism& mechanism, const std::vector<double>& parameters) {
    Program program;
    std::vector<int> nodes;
    for (const Mechanism::Unilateral& contact : mechanism.unilateral)
        nodes.push_back(lower_expression(program, mechanism, contact.restitution));
    const std::vector<double> value =
        interpret<double>(program, {.parameters = parameters, .q = {}, .qdot = {}, .qddot = {}});
    std::vector<double> result;
    for (const int node : nodes) result.push_back(value[node]);
    return result;
}

std::vector<Diagnostic> negative_gaps(const Mechanism& mechanism, const ContactView& view,
                                      const State<double>& state, double tolerance) {
    const Situation here = view.at(state);
    const Eigen::VectorXd slack =
        negligible_gaps(here, Eigen::Map<const Eigen::VectorXd>(state.q.data(), mechanism.size()), tolerance);
    std::vector<Diagnostic> negative;
    for (std::size_t k = 0; k < mechanism.unilateral.size(); ++k) {
        const double gap = here.contacts.value[static_cast<Eigen::Index>(k)];
        if (!(gap < -slack[static_cast<Eigen::Index>(k)])) continue;
        const Mechanism::Constraint& contact = mechanism.unilateral[k].gap;
        negative.push_back(
            {contact.place, say("the gap of '{}' is {:.6g} at the start; a gap is never negative: give "
                                "initial values that leave it open or closed",
                                contact.name, gap)});
    }
    return negative;
}

void check_gaps(const Scene& scene, const Mechanism& mechanism, const ContactView& view,
                const State<double>& state, double tolerance) {
    const std::vector<Diagnostic> negative = negative_gaps(mechanism, view, state, tolerance);
    if (!negative.empty()) fail(scene, negative);
}

LastingContacts contacts_at_rest(const ContactView& view, const State<double>& state, double tolerance) {
    const Situation here = view.at(state);
    const auto n = static_cast<Eigen::Index>(state.q.size());
    const Eigen::Map<const Eigen::VectorXd> q(state.q.data(), n), u(state.qdot.data(), n);
    const Eigen::VectorXd slack = negligible_gaps(here, q, tolerance), speed = gap_rates(here, u),
                          still = negligible_rates(here, u);
    std::vector<int> closed;
    for (std::size_t k = 0; k < view.names().size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        if (std::abs(here.contacts.value[i]) > slack[i] || std::abs(speed[i]) > still[i]) continue;
        closed.push_back(static_cast<int>(k));
    }
    const LastingContacts lasting = lasting_contacts(here, closed);
    if (!lasting && !closed.empty())
        throw IntegrationError(translated_from_library(refusal_of(lasting, state.t, closed, view.names())),
                               state.t, state.q);
    return lasting;
}

// M q'' − f = Aᵀλ + Gᵀπ determines λ and π, except that bilateral rows may depend on each other.
std::vector<std::string> touching_without_force(const ContactView& view, const State<double>& state,
                                                const LastingContacts& lasting) {
    if (lasting.closed.empty()) return {};
    const Situation here = view.at(state);
    const auto closed = static_cast<Eigen::Index>(lasting.closed.size());
    Eigen::MatrixXd rows(here.bilateral.rows.rows() + closed, here.M.cols());
    rows.topRows(here.bilateral.rows.rows()) = here.bilateral.rows;
    for (Eigen::Index k = 0; k < closed; ++k)
        rows.row(here.bilateral.rows.rows() + k) =
            here.contacts.rows.row(lasting.closed[static_cast<std::size_t>(k)]);
    const Eigen::VectorXd reaction = here.M * lasting.acceleration - here.f;
    const Eigen::VectorXd force = least_norm(rows.transpose(), reaction).x.col(0).tail(closed);
    std::vector<std::string> names;
    for (Eigen::Index k = 0; k < closed; ++k) {
        const double size = rows.row(here.bilateral.rows.rows() + k).cwiseAbs().maxCoeff();
        if (force[k] * size <= tolerance::balanced_load * here.f.cwiseAbs().maxCoeff())
            names.push_back(view.names()[static_cast<std::size_t>(lasting.closed[static_cast<std::size_t>(k)])]);
    }
    return names;
}

}  // namespace alembert
