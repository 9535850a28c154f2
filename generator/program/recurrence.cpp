// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/recurrence.hpp"

#include <fmt/format.h>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "program/motion_system.hpp"
#include "program/series_building.hpp"

namespace alembert {

using Kind = SeriesNode::Kind;

namespace {

double of(const std::vector<SeriesNode::Bilinear>& list) {
    double count = 0;
    for (const auto& [weight, a, b] : list) count += a == b ? 0.5 : 1;
    return count;
}

}  // namespace

Recurrences SeriesBuilding::direct() {
    begin(result_.program.right_hand_side());
    for (const int id : p().nodes_of(Group::acceleration)) result_.accelerations.push_back(node_of(form(id)));
    return finished();
}

Recurrences SeriesBuilding::implicit() {
    const MotionSystem system = motion_system(p());
    const std::vector<int>&lower = system.K, &right = system.b, kept = p().kept_constraints();
    const int s = system.speeds, m = system.size() - s;
    std::vector<int> needed = p().nodes_of(Group::rate);
    needed.insert(needed.end(), lower.begin(), lower.end());
    needed.insert(needed.end(), right.begin(), right.end());
    begin(std::move(needed));
    for (const int id : lower) result_.matrix.push_back(entry(form(id)));
    std::vector<SeriesForm> forms;
    for (const int id : right) forms.push_back(form(id));
    // The unknowns follow the residuals, which refer to them.
    const int first = static_cast<int>(nodes().size()) + s + m;
    for (int i = 0; i < s + m; ++i) result_.unknowns.push_back(first + i);
    for (int i = 0; i < s + m; ++i) result_.residuals.push_back(add(residual(forms[i], i)));
    result_.solved_at = first;
    result_.preferred = s;
    for (int i = 0; i < s + m; ++i) add({.kind = Kind::unknown, .index = i});
    result_.accelerations.assign(result_.unknowns.begin(), result_.unknowns.begin() + s);
    // Other nodes that need the solution find it under the nodes that the Program has for it.
    for (int i = 0; const int id : p().nodes_of(Group::acceleration)) remember(id, result_.unknowns[i++], 1);
    const std::vector<int> multipliers = p().nodes_of(Group::multiplier);
    for (int k = s; const int c : kept) remember(multipliers.at(c), result_.unknowns[k++], -1);
    return finished();
}

void SeriesBuilding::begin(std::vector<int> roots) {
    if (power_ >= 0) roots.push_back(power_);
    for (const int id : p().needed(roots))
        if (!p()[id].is_constant()) {
            const Node& node = p()[id];
            for (std::size_t k = 0; k < node.args.size(); ++k)
                uses_[node.args[k]] += node.exponents.empty() ? 1 : std::abs(node.exponents[k]);
        }
    for (const int id : roots) ++uses_[id];
    const int n = static_cast<int>(p().coordinates.size());
    const int s = p().speeds.empty() ? n : static_cast<int>(p().speeds.size());
    for (int i = 0; i < n; ++i)
        given_[{Variable::Kind::coordinate, i}] = add({.kind = Kind::coordinate, .index = i});
    for (int i = 0; i < s; ++i) given_[{Variable::Kind::rate, i}] = add({.kind = Kind::speed, .index = i});
    if (power_ >= 0) add({.kind = Kind::work});
}

Recurrences SeriesBuilding::finished() {
    for (const int id : p().nodes_of(Group::rate)) result_.coordinate_rates.push_back(node_of(form(id)));
    for (std::size_t i = 0; i < result_.accelerations.size(); ++i)
        given_[{Variable::Kind::acceleration, static_cast<int>(i)}] = result_.accelerations[i];
    if (power_ >= 0) result_.work = node_of(form(power_));
    if (result_.matrix.empty()) result_.solved_at = static_cast<int>(nodes().size());
    return std::move(result_);
}

SeriesEntry SeriesBuilding::entry(const SeriesForm& f) {
    if (!f.is_constant()) return {.node = node_of(f)};
    if (f.constants.empty()) return {};
    return {.node = -1, .constant = f.constants[0]};
}

SeriesNode SeriesBuilding::residual(const SeriesForm& f, int i) {
    SeriesNode node{
        .kind = Kind::residual, .index = i, .constants = f.constants, .linear = f.linear, .bilinear = f.bilinear};
    for (int j = 0; j < static_cast<int>(result_.unknowns.size()); ++j) {
        const int row = std::max(i, j), column = std::min(i, j);
        const SeriesEntry& e = result_.matrix[row * (row + 1) / 2 + column];
        if (e.node >= 0) node.implied.push_back({{-1, -1}, e.node, result_.unknowns[j]});
    }
    return node;
}

double Recurrences::products() const {
    double count = 0;
    for (const SeriesNode& node : nodes) {
        count += of(node.bilinear) + of(node.implied);
        switch (node.kind) {
            case Kind::root:
                count += 0.5;
                break;
            case Kind::power:
                count += 2;
                break;
            case Kind::turn:
                count += 3;
                break;
            case Kind::quotient:
            case Kind::sine:
            case Kind::cosine:
            case Kind::hyperbolic_sine:
            case Kind::hyperbolic_cosine:
            case Kind::exponential:
            case Kind::area:
            case Kind::ratio:
                count += 1;
                break;
            default:
                break;
        }
    }
    return count;
}

namespace {

/// What of these nodes has no power series.
std::optional<std::string> obstacle_in(const Program& program, const std::vector<int>& roots) {
    for (const int id : program.needed(roots)) {
        const Node& node = program[id];
        if (node.op == Op::unspecified && program.table_of(node) == nullptr) program.refuse_unspecified(node);
        if (node.is_constant()) continue;
        if (node.op == Op::unspecified)
            return say(
                "method 'taylor' needs functions that have a power series everywhere, and a table is made of "
                "pieces; take dop853");
        if (node.op == Op::abs || node.op == Op::sign || node.op == Op::min || node.op == Op::max)
            return say(
                "method 'taylor' needs functions that have a power series everywhere, and {}(...) has a kink; "
                "take dop853",
                name_of(node.op));
        if (node.op == Op::variable && node.variable.kind == Variable::Kind::unknown)
            return say("method 'taylor': the equations name something that no state gives; take dop853");
    }
    return std::nullopt;
}

/// The parts of M u' = f + A^T λ, A u' = γ, of which accelerations may hold fewer functions: f = 0 leaves none.
std::vector<int> implicit_roots(const Program& program) {
    std::vector<int> result;
    for (const Group group : {Group::mass, Group::forcing, Group::row, Group::speed_row, Group::gamma}) {
        const std::vector<int> nodes = program.nodes_of(group);
        result.insert(result.end(), nodes.begin(), nodes.end());
    }
    return result;
}

}  // namespace

std::optional<std::string> obstacle_to_recurrences(const Program& program, bool with_work) {
    if (program.singular)
        return say("the mass matrix is singular at every state: there are no accelerations to emit");
    std::vector<int> roots = program.right_hand_side();
    const std::vector<int> power = with_work ? program.nodes_of(Group::power) : std::vector<int>();
    roots.insert(roots.end(), power.begin(), power.end());
    return obstacle_in(program, roots);
}

Recurrences recurrences(const Program& program, bool with_work) {
    if (const auto obstacle = obstacle_to_recurrences(program, with_work)) throw ModelError(*obstacle);
    Recurrences direct = SeriesBuilding(program, with_work).direct();
    if (program.nodes_of(Group::mass).empty() || program.nodes_of(Group::forcing).empty()) return direct;
    if (program.friction_on_multipliers) return direct;  // M u' = f lacks it
    if (obstacle_in(program, implicit_roots(program))) return direct;
    Recurrences implicit = SeriesBuilding(program, with_work).implicit();
    return implicit.products() < direct.products() ? implicit : direct;
}

}  // namespace alembert
