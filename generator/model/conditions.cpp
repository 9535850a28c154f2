// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "alembert/base/tolerances.hpp"
#include "base/language/say.hpp"
#include "model/building.hpp"
#include "model/constraint.hpp"
#include "model/energy.hpp"
#include "model/joints.hpp"
#include "scene/quaternions.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

// e·e − 1 = 0
void add_norm(Building& here, const FrameQuaternion& quaternion, int index) {
    SourceScope source(*here.m.z, "frame " + quaternion.of.text);
    ex value = -1, start = 0;
    bool moves = false;
    for (const Name& name : quaternion.e) {
        const std::size_t i = coordinate_index(name.text, here.m);
        value += here.m.q[i] * here.m.q[i];
        start += here.m.q_start[i] * here.m.q_start[i];
        moves = moves || here.m.q_is_guess[i];
    }
    const double square = here.values->number(here.m.z->expand(start));
    if (!moves && !(std::abs(square - 1) <= 1e-9))
        throw SceneMistake{
            {quaternion.e[0].place,
             say("the sum of squares of the quaternion of frame '{}' is {:.12g} at the start; expected 1: "
                 "divide each initial value by {:.12g}, or give them as guesses",
                 quaternion.of.text, square, std::sqrt(square))}};
    const std::string multiplier = multiplier_of(quaternion).text;
    here.m.constraints.push_back(
        constraint_of({.name = quaternion.of.text,
                       .holonomic = true,
                       .value = value,
                       .multiplier = here.m.symbols->declare(multiplier, SymbolInfo::Kind::other, index),
                       .place = quaternion.of.place,
                       .at = quaternion.e[0].place},
                      here.m));
    here.m.constraints.back().norm = true;
    here.translator.know(multiplier, here.m.constraints.back().multiplier);
}

/// The rows of a rolling condition along the axes of the frame in which its contact is given. There are none if
/// that frame is N, or if a row would be needed for which there is none along N.
std::vector<Mechanism::Constraint> rows_along_axes(Building& here, const RollingRule& rule,
                                                   const Vector3& sliding_velocity, bool drifts) {
    std::vector<Mechanism::Constraint> result;
    if (rule.axes.text == "N") return result;
    for (int k = 0; k < 3; ++k) {
        const std::string name = rule.name.text + "_" + "xyz"[k];
        const ex value = dot(sliding_velocity, here.places.orientation(rule.axes.text).axis(k), *here.m.z);
        const auto [row, offset] = linear_form(value, say("rolling '{}'", name), rule.contact.place, here.m);
        if (std::all_of(row.begin(), row.end(),
                        [&](const ex& entry) { return is_identically_zero(entry, here.m); })) {
            if (drifts && !offset.is_zero()) return {};
            continue;
        }
        const auto along_N = std::find_if(here.m.constraints.begin(), here.m.constraints.end(),
                                          [&](const Mechanism::Constraint& c) { return c.name == name; });
        if (along_N == here.m.constraints.end()) return {};
        result.push_back(constraint_of({.name = name,
                                        .holonomic = false,
                                        .value = value,
                                        .multiplier = along_N->multiplier,
                                        .place = rule.name.place,
                                        .at = rule.contact.place,
                                        .drifts = drifts},
                                       here.m));
        result.back().rolling = static_cast<int>(here.m.rollings.size());
    }
    return result;
}

// v_C + ω × c − v_on − ω_on × (r_C + c − r_on) = 0 along x, y, z
void add_rolling(Building& here, const RollingRule& rule, int index) {
    SourceScope source(*here.m.z, "rolling " + rule.name.text);
    Intermediates& z = *here.m.z;
    const Vector3 c = here.places.along(rule.contact, rule.axes);
    const std::string centre = here.places.centre_of(rule.body.text), ground = here.places.centre_of(rule.on.text);
    const auto turning = [&](const std::string& body, const Vector3& arm) {
        const Orientation& o = here.places.orientation(body);
        return cross(o.to_inertial(o.angular_velocity(), z), arm, z);
    };
    Vector3 sliding_velocity = add(here.places.velocity(centre), turning(rule.body.text, c), z);
    if (rule.on.text != "N") {
        const Vector3 contact_point = add(here.places.position(centre), c, z);
        const Vector3 arm = add(contact_point, scale(-1, here.places.position(ground), z), z);
        const Vector3 moving = add(here.places.velocity(ground), turning(rule.on.text, arm), z);
        sliding_velocity = add(sliding_velocity, scale(-1, moving, z), z);
    }
    const std::array<Name, 3> multipliers = multipliers_of(rule);
    const std::vector<GiNaC::symbol> clock = here.m.clock();
    // Velocities are homogeneous in the rates if no position and no orientation depends on time explicitly.
    const auto by_itself = [&](const Vector3& v) {
        return std::any_of(v.begin(), v.end(), [&](const ex& e) { return z.depends(e, clock); });
    };
    bool drifts = false;
    for (const std::string& body : {rule.body.text, rule.on.text})
        for (int k = 0; k < 3; ++k)
            if (body != "N")
                drifts = drifts || by_itself(here.places.position_of_body(body)) ||
                         by_itself(here.places.orientation(body).axis(k));
    bool any = false;
    for (int k = 0; k < 3; ++k) {
        const std::string name = rule.name.text + "_" + "xyz"[k];
        const auto [row, offset] =
            linear_form(sliding_velocity[k], say("rolling '{}'", name), rule.contact.place, here.m);
        if (std::all_of(row.begin(), row.end(),
                        [&](const ex& entry) { return is_identically_zero(entry, here.m); })) {
            if (drifts && !offset.is_zero())
                throw SceneMistake{
                    {rule.name.place,
                     say("rolling '{}' cannot hold: along {} the contact moves by itself, whatever the "
                         "coordinates' rates",
                         rule.name.text, "xyz"[k])}};
            here.translator.know(multipliers[k].text, 0);
            here.left_out.push_back(multipliers[k].text);
            continue;
        }
        any = true;
        here.m.constraints.push_back(constraint_of(
            {.name = name,
             .holonomic = false,
             .value = sliding_velocity[k],
             .multiplier = here.m.symbols->declare(multipliers[k].text, SymbolInfo::Kind::other, index + k),
             .place = rule.name.place,
             .at = rule.contact.place,
             .drifts = drifts},
            here.m));
        here.m.constraints.back().rolling = static_cast<int>(here.m.rollings.size());
        here.translator.know(multipliers[k].text, here.m.constraints.back().multiplier);
    }
    here.m.rollings.push_back({.name = rule.name.text,
                               .axes = rule.axes.text,
                               .along = rows_along_axes(here, rule, sliding_velocity, drifts)});
    if (!any)
        throw SceneMistake{
            {rule.name.place, say("rolling '{}' says nothing: the point of '{}' at the contact moves with '{}' "
                                  "in every motion",
                                  rule.name.text, rule.body.text, rule.on.text)}};
}

void add_constraint(Building& here, const ConstraintRule& rule, int index) {
    SourceScope source(*here.m.z, "constraint " + rule.name.text);
    const std::string multiplier = rule.multiplier ? rule.multiplier->text : "lambda_" + rule.name.text;
    here.m.constraints.push_back(constraint_of(
        {.name = rule.name.text,
         .holonomic = rule.holonomic,
         .value = here.translator.scalar(rule.equation.lhs) - here.translator.scalar(rule.equation.rhs),
         .multiplier = here.m.symbols->declare(multiplier, SymbolInfo::Kind::other, index),
         .place = rule.name.place,
         .at = rule.equation.lhs.place()},
        here.m));
    here.translator.know(multiplier, here.m.constraints.back().multiplier);
}

// Checks a direction in which no coordinate moves the bodies relative to each other: its value is that at the
// start.
void need_closed(Building& here, const Joint& joint, const ClosingRow& row, int k) {
    const bool moves = here.m.z->depends(row.value, {here.m.t}) &&
                       !is_identically_zero(here.m.explicit_time_derivative({row.value})[0], here.m);
    std::vector<ex> wanted{row.value};
    wanted.insert(wanted.end(), row.lengths.begin(), row.lengths.end());
    const std::vector<double> numbers = here.places.numbers_at_start(wanted);
    const double gap = moves ? std::nan("") : numbers[0];
    double size = 0;
    for (std::size_t i = 1; i < numbers.size(); ++i) size += std::abs(numbers[i]);
    if (std::abs(gap) <= tolerance::initial_values * std::max(1.0, size)) return;
    throw SceneMistake{
        {joint.name.place,
         say("joint '{}' cannot close: in its locked direction {} (translations x, y, z, then rotations, "
             "as far as locked) the bodies stand apart {}, and no coordinate can change that",
             joint.name.text, k, moves ? say("as time goes on") : say("by {:.6g}", gap))}};
}

// Axes that coincide, or never do: where no coordinate turns them against each other.
void align(Building& here, const Joint& joint, int index, std::size_t rows) {
    Mechanism::Alignment alignment{.joint = index, .rows = rows, .between = {}};
    for (const ex& product : coinciding_axes(joint, here.places)) {
        if (here.m.z->depends(product, here.m.moving())) {
            alignment.between.push_back(product);
        } else if (!(here.places.numbers_at_start({product})[0] > 0)) {
            throw SceneMistake{
                {joint.name.place,
                 say("joint '{}' cannot close: its axes in the child are turned against those in the parent, by "
                     "half a turn or a third of one, and no coordinate can change that",
                     joint.name.text)}};
        }
    }
    if (!alignment.between.empty()) here.m.alignments.push_back(std::move(alignment));
}

void close(Building& here, const Joint& joint, int index) {
    SourceScope source(*here.m.z, "joint " + joint.name.text);
    const std::size_t before = here.m.constraints.size();
    int k = 0;
    for (const ClosingRow& row : closing_rows(joint, here.places)) {
        const std::string name = fmt::format("{}_{}", joint.name.text, ++k), multiplier = "lambda_" + name;
        const std::vector<ex> slopes =
            here.m.z->pull_back({{row.value, 1}}, row.holonomic ? here.m.q : here.m.qdot);
        if (std::all_of(slopes.begin(), slopes.end(),
                        [&](const ex& e) { return is_identically_zero(e, here.m); })) {
            if (row.holonomic) need_closed(here, joint, row, k);
            here.m.identities.push_back(name);
            here.translator.know(multiplier, 0);
            here.left_out.push_back(multiplier);
            continue;
        }
        here.m.constraints.push_back(
            constraint_of({.name = name,
                           .holonomic = row.holonomic,
                           .value = row.value,
                           .multiplier = here.m.symbols->declare(multiplier, SymbolInfo::Kind::other,
                                                                 static_cast<int>(here.m.constraints.size())),
                           .place = joint.name.place,
                           .at = joint.name.place},
                          here.m));
        here.m.constraints.back().joint = index;
        here.m.constraints.back().between_axes = row.holonomic && row.lengths.empty();
        here.translator.know(multiplier, here.m.constraints.back().multiplier);
    }
    align(here, joint, index, here.m.constraints.size() - before);
}

// gap(q,t) ≥ 0
void add_unilateral(Building& here, const UnilateralRule& rule, int index) {
    SourceScope source(*here.m.z, "unilateral " + rule.name.text);
    const std::string multiplier = "lambda_" + rule.name.text;
    const double restitution = here.number_at(rule.restitution);
    if (!(restitution >= 0 && restitution <= 1))
        throw SceneMistake{{rule.restitution.place(),
                            say("the restitution of '{}' is {}; expected a number from 0 (the bodies stay "
                                "together) to 1 (no energy is lost)",
                                rule.name.text, restitution)}};
    here.m.unilateral.push_back(
        {.gap = constraint_of({.name = rule.name.text,
                               .holonomic = true,
                               .value = here.translator.scalar(rule.gap),
                               .multiplier = here.m.symbols->declare(multiplier, SymbolInfo::Kind::other, index),
                               .place = rule.name.place,
                               .at = rule.gap.place()},
                              here.m),
         .restitution = here.m.z->name(here.translator.scalar(rule.restitution))});
    here.translator.know(multiplier, here.m.unilateral.back().gap.multiplier);
}

}  // namespace

// f(q,t) = 0 or a·q' + b = 0, as rows (mechanism.hpp).
void add_conditions(Building& here) {
    for (std::size_t k = 0; k < here.scene.constraints.size(); ++k)
        here.attempt([&] { add_constraint(here, here.scene.constraints[k], static_cast<int>(k)); });
    int index = static_cast<int>(here.scene.constraints.size());
    for (const FrameQuaternion& quaternion : quaternions_of(here.scene))
        here.attempt([&] { add_norm(here, quaternion, index++); });
    for (const RollingRule& rule : here.scene.rolling) {
        here.attempt([&] { add_rolling(here, rule, index); });
        index += 3;
    }
    for (std::size_t j = 0; j < here.scene.joints.size(); ++j)
        if (here.scene.joints[j].closes_loop)
            here.attempt([&] { close(here, here.scene.joints[j], static_cast<int>(j)); });
    for (const UnilateralRule& rule : here.scene.unilateral)
        here.attempt([&] { add_unilateral(here, rule, index++); });
}

}  // namespace alembert
