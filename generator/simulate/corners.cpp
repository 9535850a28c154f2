// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/corners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/language/say.hpp"
#include "program/jet.hpp"
#include "program/lower/lower.hpp"
#include "program/quotient_signs.hpp"
#include "simulate/sides.hpp"

namespace alembert {

namespace {

/// Velocities that jump together, and what makes that an impact: without mass there is none.
struct Thing {
    std::vector<GiNaC::ex> velocities;
    GiNaC::ex mass = 1;
};

std::vector<Thing> things_of(const Mechanism& m) {
    std::vector<Thing> result;
    const auto listed = [](const Vector3& v) { return std::vector<GiNaC::ex>(v.begin(), v.end()); };
    for (const MassElement& element : m.masses) {
        if (!element.mass.is_zero()) result.push_back({listed(element.velocity), element.mass});
        if (!element.rotation) continue;
        const std::array<GiNaC::ex, 6>& I = element.rotation->inertia;
        result.push_back({listed(element.rotation->w_NB_B), I[0] + I[1] + I[2]});
    }
    std::vector<std::pair<GiNaC::ex, GiNaC::ex>> energies;
    for (const Part& part : m.kinetic)
        if (part.origin.kind == Origin::Kind::given_kinetic) energies.emplace_back(part.value, 1);
    if (m.given_lagrangian) energies.emplace_back(*m.given_lagrangian, 1);
    if (!energies.empty()) result.push_back({m.z->pull_back(energies, m.qdot)});
    for (const Mechanism::Constraint& c : m.constraints) {
        GiNaC::ex rate = c.offset;
        for (std::size_t i = 0; i < c.row.size(); ++i) rate += c.row[i] * m.qdot[i];
        result.push_back({{rate}});
    }
    return result;
}

/// Whether a sign, or a derivative of a table that jumps at knots, stands in what the roots need.
bool may_jump(const Program& p) {
    std::vector<int> roots;
    for (const Root& root : p.roots) roots.push_back(root.node);
    const std::vector<int> needed = p.needed(roots);
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        const Node& node = p[id];
        if (node.is_constant()) return false;
        if (node.op == Op::sign) return true;
        return node.op == Op::unspecified && p.table_of(node) != nullptr &&
               p.table_of(node)->may_jump(p.table_call(node).orders);
    });
}

}  // namespace

namespace {

/// Whether an expression has a function of which a derivative may jump, or an open one, which may have a table.
bool bends(const GiNaC::ex& e) {
    static const std::set<std::string> smooth{"sin",  "cos",  "tan",  "asin", "acos", "atan",
                                              "sinh", "cosh", "tanh", "exp",  "log",  "atan2"};
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        if (GiNaC::is_a<GiNaC::power>(*part) && !part->op(1).info(GiNaC::info_flags::integer)) return true;
        if (GiNaC::is_a<GiNaC::function>(*part) &&
            !smooth.contains(GiNaC::ex_to<GiNaC::function>(*part).get_name()))
            return true;
    }
    return false;
}

bool may_have_corners(const Mechanism& m, const std::vector<GiNaC::ex>& velocities) {
    const std::vector<Intermediates::Entry>& entries = m.z->entries();
    return std::any_of(velocities.begin(), velocities.end(), bends) ||
           std::any_of(entries.begin(), entries.end(), [](const auto& one) { return bends(one.definition); });
}

}  // namespace

std::shared_ptr<const Corners> Corners::of(const Mechanism& mechanism) {
    const Mechanism own = with_own_intermediates(mechanism);
    Program lowered = begun(own);
    std::vector<GiNaC::ex> velocities, all;
    std::vector<std::size_t> ends;
    const std::vector<Thing> things = things_of(own);
    for (const Thing& one : things) {
        velocities.insert(velocities.end(), one.velocities.begin(), one.velocities.end());
        ends.push_back(velocities.size());
    }
    if (!may_have_corners(own, velocities)) return nullptr;
    all = velocities;
    for (const Thing& one : things) all.push_back(one.mass);
    const std::vector<int> nodes = lower_expressions(lowered, own, all);
    for (int i = 0; i < own.size() && !own.states.empty(); ++i)
        lowered.speeds.push_back({.name = own.q[i].get_name() + "'", .unit = "", .rate_of = i});
    for (const Mechanism::State& z : own.states)
        lowered.speeds.push_back({.name = z.derivative[0].get_name(), .unit = z.unit});
    for (std::size_t k = 0; k < nodes.size(); ++k)
        lowered.roots.push_back({Group::output, fmt::format("velocity {}", k + 1), nodes[k]});
    std::vector<QuotientSign> signs;
    Program program = with_quotient_signs(lowered, signs);
    if (!may_jump(program)) return nullptr;
    std::optional<Switched> held = switched(program);
    if (!held) return nullptr;
    std::shared_ptr<const Corners> result(new Corners(std::move(program), *std::move(held), std::move(ends)));
    return result->names().empty() ? nullptr : result;
}

void warn_of_corners(Prepared& prepared) {
    const std::shared_ptr<const Corners> corners = Corners::of(prepared.mechanism);
    if (!corners) return;
    prepared.warn("left_out", say("warning: velocities jump where the motion passes a corner of {} with speed, an "
                                  "impact whose law the scene does not give; what is written passes it without a "
                                  "word, and 'alembert simulate' ends there\n",
                                  fmt::join(corners->names(), ", ")));
}

Corners::Corners(Program program, Switched held, std::vector<std::size_t> ends)
    : program_(std::move(program)),
      held_(std::move(held)),
      ends_(std::move(ends)),
      names_(names_of_sides(program_, held_)) {
    const std::size_t count = held_.functions.size();
    velocities_ = held_.program.nodes_of(Group::output);
    masses_.assign(velocities_.begin() + static_cast<std::ptrdiff_t>(ends_.back()), velocities_.end());
    velocities_.resize(ends_.back());
    const std::vector<int> events = held_.program.nodes_of(Group::event);
    functions_.assign(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(count));
    matters_.assign(count, false);
    const int first = static_cast<int>(held_.program.parameters.size() - count);
    for (const int id : held_.program.needed(velocities_)) {
        const Node& node = held_.program[id];
        if (node.op == Op::variable && node.variable.kind == Variable::Kind::parameter &&
            node.variable.index >= first)
            matters_[static_cast<std::size_t>(node.variable.index - first)] = true;
    }
}

std::vector<std::string> Corners::names() const {
    std::vector<std::string> result;
    for (std::size_t k = 0; k < names_.size(); ++k)
        if (matters_[k] && std::find(result.begin(), result.end(), names_[k]) == result.end())
            result.push_back(names_[k]);
    return result;
}

/// The state with each side as its function is; a function may contain the sides of those before it.
State<double> Corners::on_sides(const State<double>& at, std::vector<double>* values) const {
    State<double> here = at;
    const std::size_t given = held_.program.parameters.size() - functions_.size();
    here.parameters.resize(held_.program.parameters.size(), 1);
    std::vector<double> value;
    for (int round = 0; round < 3; ++round) {
        value = interpret(held_.program, here);
        bool changed = false;
        for (std::size_t k = 0; k < functions_.size(); ++k) {
            const double side = value[static_cast<std::size_t>(functions_[k])] < 0 ? -1 : 1;
            changed = changed || here.parameters[given + k] != side;
            here.parameters[given + k] = side;
        }
        if (!changed) break;
    }
    if (values != nullptr) *values = std::move(value);
    return here;
}

std::optional<std::string> Corners::jump(const State<double>& at, std::size_t side) const {
    constexpr double least = 1e-9;        // of the velocities of a thing,
    constexpr double of_rounding = 1e-4;  // which count as this part of the largest one at least
    State<double> here = on_sides(at);
    double& sigma = here.parameters[here.parameters.size() - functions_.size() + side];
    sigma = 1;
    const std::vector<double> above = interpret(held_.program, here);
    sigma = -1;
    const std::vector<double> below = interpret(held_.program, here);
    const auto at_node = [](const std::vector<double>& value, int node) {
        return value[static_cast<std::size_t>(node)];
    };
    double largest = 0;
    for (const int node : velocities_) largest = std::max(largest, std::abs(at_node(above, node)));
    bool jumps = false;
    for (std::size_t thing = 0, next = 0; thing < ends_.size(); ++thing) {
        double size = of_rounding * largest, most = 0;
        for (; next < ends_[thing]; ++next) {
            const double a = at_node(above, velocities_[next]), b = at_node(below, velocities_[next]);
            size = std::max({size, std::abs(a), std::abs(b)});
            most = std::max(most, std::abs(a - b));
        }
        jumps = jumps || (most > least * size && at_node(above, masses_[thing]) != 0);
    }
    if (!jumps) return std::nullopt;
    std::string where;
    for (std::size_t k = 0; k < program_.coordinates.size(); ++k)
        where += fmt::format("{}{} = {:.6g}", k == 0 ? "" : ", ", program_.coordinates[k].name, at.q[k]);
    const bool is_table = program_[held_.functions[side]].op == Op::unspecified;
    return is_table
               ? say("at t = {:.15g} the motion passes a corner of {} ({}), where its slope jumps and velocities "
                     "would jump with it: an impact, whose law the scene does not give. Write interpolation = "
                     "\"cubic\" into the table, or round the corner",
                     at.t, names_[side], where)
               : say("at t = {:.15g} the motion passes a corner where {} changes ({}) and velocities would jump: "
                     "an "
                     "impact, whose law the scene does not give. Write a function that is smooth there, such as "
                     "sqrt(x^2 + d^2) in place of abs(x)",
                     at.t, names_[side], where);
}

std::optional<std::string> Corners::obstacle(const State<double>& at) const {
    constexpr double rounding = 1e-9, of_time = 1e-12;
    State<Jet<double>> state;
    const State<double> here = on_sides(at);
    const std::size_t n = at.q.size(), count = n + at.qdot.size();
    const auto jets = [](const std::vector<double>& list) {
        return std::vector<Jet<double>>(list.begin(), list.end());
    };
    state.parameters = jets(here.parameters);
    state.t = Jet<double>(at.t);
    state.q = jets(at.q);
    state.qdot = jets(at.qdot);
    for (std::size_t k = 0; k < count; ++k) {
        Jet<double>& x = k < n ? state.q[k] : state.qdot[k - n];
        x.d.assign(count, 0);
        x.d[k] = 1;
    }
    std::vector<Jet<double>> value(static_cast<std::size_t>(held_.program.size()));
    interpret_into(value, held_.program, state, held_.program.needed(functions_));
    for (std::size_t k = 0; k < functions_.size(); ++k) {
        if (!matters_[k]) continue;
        const Jet<double>& g = value[static_cast<std::size_t>(functions_[k])];
        double uncertain = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const double x = i < n ? at.q[i] : at.qdot[i - n], rate = i < n ? std::abs(at.qdot[i]) : 0;
            uncertain += std::abs(g.derivative(i)) *
                         (rounding * (std::abs(x) + 1e-3 * rate) + of_time * rate * std::abs(at.t));
        }
        if (std::abs(g.value) > uncertain) continue;
        if (auto why = jump(at, k)) return why;
    }
    return std::nullopt;
}

std::optional<std::string> Corners::obstacle_between(const State<double>& before,
                                                     const State<double>& after) const {
    std::vector<double> a, b;
    on_sides(before, &a);
    on_sides(after, &b);
    for (std::size_t k = 0; k < functions_.size(); ++k) {
        const double from = a[static_cast<std::size_t>(functions_[k])],
                     to = b[static_cast<std::size_t>(functions_[k])];
        if (!matters_[k] || !(from * to < 0)) continue;
        const double part = from / (from - to);
        const auto between = [&](double x, double y) { return x + part * (y - x); };
        State<double> at = after;
        at.t = between(before.t, after.t);
        for (std::size_t i = 0; i < at.q.size(); ++i) at.q[i] = between(before.q[i], after.q[i]);
        for (std::size_t i = 0; i < at.qdot.size(); ++i) at.qdot[i] = between(before.qdot[i], after.qdot[i]);
        if (auto why = jump(at, k)) return why;
    }
    return std::nullopt;
}

}  // namespace alembert
