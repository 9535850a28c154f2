// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <utility>

#include "scene/tables.hpp"

#include "base/language/say.hpp"

namespace alembert {
namespace {

/// Reads a link between two points or along an expression.
Link read_link(const Table& table, std::string_view constant) {
    Link link{.place = table.place(), .between = {}, .along = {}, .constant = {}, .length = {}};
    const Entry* const between = table.find("between");
    if (between && table.has("along"))
        table.complain("along", say("{} has both 'between' and 'along'; give one", table.title()));
    else if (!between && !table.has("along"))
        table.complain_of_missing(
            {"between", "along"},
            say("{} needs 'between' (two points) or 'along' (an expression)", table.title()));
    if (between) {
        std::vector<Name> ends = table.names("between");
        if (const auto* array = between->node->as_array(); array && array->size() != 2)
            table.complain("between",
                           say("{} names {} points; expected two", table.what("between"), array->size()));
        else if (ends.size() == 2)
            link.between.emplace(std::move(ends[0]), std::move(ends[1]));
    } else {
        link.along = table.expression("along");
    }
    link.constant = table.needed_expression(constant);
    link.length = table.has("length") ? table.expression("length") : zero(table.place());
    return link;
}

void read_force(Table table, Scene& scene) {
    table.allow("force");
    Force force;
    force.place = table.place();
    force.at = table.needed_name("at");
    force.vector = table.needed_vector("vector");
    if (auto axes = table.name("axes")) force.axes = std::move(*axes);
    force.reaction = table.name("reaction");
    force.on = table.name("on");
    scene.forces.push_back(std::move(force));
}

void read_impulse(Table table, Scene& scene) {
    table.allow("impulse");
    Impulse impulse;
    impulse.place = table.place();
    impulse.at = table.needed_name("at");
    impulse.vector = table.needed_vector("vector");
    if (auto axes = table.name("axes")) impulse.axes = std::move(*axes);
    scene.impulses.push_back(std::move(impulse));
}

void read_torque(Table table, Scene& scene) {
    table.allow("torque");
    Torque torque;
    torque.place = table.place();
    torque.on = table.needed_name("on");
    const Entry* const vector = table.find("vector");
    if (vector && !vector->node->is_array()) {
        torque.vector.place = place_of(*vector->node);
        torque.vector.component = {zero(torque.vector.place), zero(torque.vector.place),
                                   table.expression("vector")};
    } else {
        torque.vector = table.needed_vector("vector");
    }
    if (auto axes = table.name("axes")) torque.axes = std::move(*axes);
    torque.reaction = table.name("reaction");
    scene.torques.push_back(std::move(torque));
}

void read_spring(Table table, Scene& scene) {
    table.allow("spring");
    scene.springs.push_back(read_link(table, "stiffness"));
}

void read_damper(Table table, Scene& scene) {
    table.allow("damper");
    scene.dampers.push_back(read_link(table, "damping"));
}

void read_constraint(Table table, Scene& scene) {
    table.allow("constraint");
    ConstraintRule rule;
    rule.name = table.needed_name("name");
    table.entitle(rule.name);
    rule.multiplier = table.name("multiplier");
    if (table.has("holonomic") == table.has("nonholonomic"))
        return table.complain_of_missing({"holonomic", "nonholonomic"},
                                         say("{} needs one of 'holonomic' and 'nonholonomic'", table.title()));
    rule.holonomic = table.has("holonomic");
    const std::string_view key = rule.holonomic ? "holonomic" : "nonholonomic";
    const toml::node& node = *table.find(key)->node;
    const auto* const text = node.as_string();
    if (text != nullptr && text->get().find('=') != std::string::npos) {
        rule.equation = read_equality(table.reading(), node, false);
    } else {
        rule.equation.lhs = table.expression(key);
        rule.equation.rhs = zero(table.place());
    }
    scene.constraints.push_back(std::move(rule));
}

void read_rolling(Table table, Scene& scene) {
    table.allow("rolling");
    RollingRule rule;
    rule.name = table.needed_name("name");
    table.entitle(rule.name);
    rule.body = table.needed_name("body");
    rule.contact = table.needed_vector("contact");
    if (auto axes = table.name("axes")) rule.axes = std::move(*axes);
    if (auto on = table.name("on")) rule.on = std::move(*on);
    scene.rolling.push_back(std::move(rule));
}

void read_unilateral(Table table, Scene& scene) {
    table.allow("unilateral");
    UnilateralRule rule;
    rule.name = table.needed_name("name");
    table.entitle(rule.name);
    rule.gap = table.needed_expression("gap");
    rule.restitution = table.has("restitution") ? table.expression("restitution") : zero(table.place());
    scene.unilateral.push_back(std::move(rule));
}

/// One expression, or two in an array: components along perpendicular directions.
void read_slip(const Table& table, FrictionRule& rule) {
    const Entry* const entry = table.find("slip");
    const toml::array* const list = entry ? entry->node->as_array() : nullptr;
    if (!list) {
        rule.sliding_velocity = table.needed_expression("slip");
        return;
    }
    if (list->size() != 2)
        return table.complain("slip", say("{} has {} components; expected one expression, or two in an array for "
                                          "a sliding velocity in a plane",
                                          table.what("slip"), list->size()));
    rule.sliding_velocity = read_expression(table.reading(), *list->get(0), table.what("slip"));
    rule.across = read_expression(table.reading(), *list->get(1), table.what("slip"));
}

void read_friction(Table table, Scene& scene) {
    table.allow("friction");
    FrictionRule rule;
    rule.name = table.needed_name("name");
    table.entitle(rule.name);
    rule.coefficient = table.needed_expression("coefficient");
    rule.resting = table.expression("static");
    read_slip(table, rule);
    if (table.has("on") == table.has("normal"))
        return table.complain_of_missing(
            {"on", "normal"}, say("{} needs one of 'on' (the constraint or contact whose reaction is the "
                                  "normal force) and 'normal' (the normal force)",
                                  table.title()));
    rule.on = table.name("on");
    rule.normal = table.expression("normal");
    rule.restitution = table.expression("restitution");
    if (rule.restitution && !rule.on)
        table.complain("restitution",
                       say("{} gives a 'restitution' without 'on'; only a [[unilateral]] contact has "
                           "impacts",
                           table.title()));
    scene.frictions.push_back(std::move(rule));
}

}  // namespace

std::span<const TableReader> load_sections() {
    static constexpr TableReader all[] = {
        {"force", read_force},     {"impulse", read_impulse},       {"torque", read_torque},
        {"spring", read_spring},   {"damper", read_damper},         {"constraint", read_constraint},
        {"rolling", read_rolling}, {"unilateral", read_unilateral}, {"friction", read_friction},
    };
    return all;
}

}  // namespace alembert
