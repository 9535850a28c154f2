// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "scene/functions.hpp"
#include "scene/joint_moves.hpp"
#include "scene/quaternions.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

using DeclaredAs = Declared::Kind;

struct Declaration {
    const Name* name;
    DeclaredAs kind;
    std::size_t index;
};

/// A name without a place was missing in the file, which the reader has reported.
template <typename Item>
void add(std::vector<Declaration>& list, const std::vector<Item>& items, DeclaredAs kind) {
    for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i].name.place.line > 0) list.push_back({&items[i].name, kind, i});
}

bool is_reserved(const std::string& name, DeclaredAs kind) {
    switch (kind) {
        case DeclaredAs::frame:
            return name == "N";
        case DeclaredAs::point:
        case DeclaredAs::particle:
            return name == "O";
        case DeclaredAs::body:
            return name == "N" || name == "O";
        case DeclaredAs::function:
            return name == "t" || name == "pi" || find_function(name) != nullptr;
        default:
            return name == "t" || name == "pi" || is_reserved_function(name);
    }
}

std::string reason(const std::string& name) {
    if (name == "N") return say("the fixed frame");
    if (name == "O") return say("the origin");
    if (name == "t") return say("the time");
    if (name == "pi") return say("the number π");
    return say("a function");
}

/// Reports an illegal or reserved name; true if the name may be used.
bool check(const Name& name, DeclaredAs kind, std::vector<Diagnostic>& diagnostics) {
    if (!need_name(name, diagnostics)) return false;
    if (!is_reserved(name.text, kind)) return true;
    diagnostics.push_back(
        {name.place, say("the name '{0}' is reserved: {0} is {1}", name.text, reason(name.text))});
    return false;
}

/// Enters the declarations in the order of the file; if two have the same name, the second is the mistake.
NameSpaces::Space enter(std::vector<Declaration> list, std::vector<Diagnostic>& diagnostics) {
    NameSpaces::Space space;
    std::stable_sort(list.begin(), list.end(),
                     [](const Declaration& a, const Declaration& b) { return a.name->place < b.name->place; });
    for (const auto& [name, kind, index] : list) {
        const auto [first, is_new] = space.emplace(name->text, Declared{kind, index, name->place});
        if (!is_new)
            diagnostics.push_back(
                {name->place, say("the name {} is taken: {} has it on line {}", in_quotes(name->text),
                                  described(first->second.kind), first->second.place.line)});
    }
    return space;
}

}  // namespace

std::array<Name, 3> multipliers_of(const RollingRule& rule) {
    const std::string stem = "lambda_" + rule.name.text;
    return {Name{stem + "_x", rule.name.place}, Name{stem + "_y", rule.name.place},
            Name{stem + "_z", rule.name.place}};
}

std::string UnspecifiedFunction::usage() const {
    std::string list;
    for (const Name& argument : arguments) list += (list.empty() ? "" : ", ") + argument.text;
    return fmt::format("{}({})", name.text, list);
}

std::string described(DeclaredAs kind) {
    switch (kind) {
        case DeclaredAs::coordinate:
            return say("a coordinate");
        case DeclaredAs::speed:
            return say("a generalized speed");
        case DeclaredAs::state:
            return say("a state");
        case DeclaredAs::parameter:
            return say("a parameter");
        case DeclaredAs::input:
            return say("an input");
        case DeclaredAs::definition:
            return say("a definition");
        case DeclaredAs::function:
            return say("a function");
        case DeclaredAs::frame:
            return say("a frame");
        case DeclaredAs::point:
            return say("a point");
        case DeclaredAs::particle:
            return say("a particle");
        case DeclaredAs::body:
            return say("a body");
        default:
            return say("a multiplier");
    }
}

bool need_name(const Name& name, std::vector<Diagnostic>& diagnostics) {
    if (is_name(name.text)) return true;
    diagnostics.push_back({name.place, say("{} is not a name: a name is a letter or _, then letters, digits, _",
                                           in_quotes(name.text))});
    return false;
}

NameSpaces declare(const Scene& scene, std::vector<Diagnostic>& diagnostics) {
    std::vector<Declaration> values, frames, points;
    add(values, scene.coordinates, DeclaredAs::coordinate);
    add(values, scene.speeds, DeclaredAs::speed);
    add(values, scene.states, DeclaredAs::state);
    add(values, scene.parameters, DeclaredAs::parameter);
    add(values, scene.inputs, DeclaredAs::input);
    add(values, scene.definitions, DeclaredAs::definition);
    add(values, scene.functions, DeclaredAs::function);
    std::vector<Name> multipliers;
    for (const ConstraintRule& rule : scene.constraints)
        multipliers.push_back(rule.multiplier ? *rule.multiplier
                                              : Name{"lambda_" + rule.name.text, rule.name.place});
    for (const FrameQuaternion& quaternion : quaternions_of(scene))
        multipliers.push_back(multiplier_of(quaternion));
    for (const RollingRule& rule : scene.rolling)
        for (Name& multiplier : multipliers_of(rule)) multipliers.push_back(std::move(multiplier));
    for (const UnilateralRule& rule : scene.unilateral)
        multipliers.push_back({"lambda_" + rule.name.text, rule.name.place});
    for (const Joint& joint : scene.joints)
        if (joint.closes_loop)
            for (int k = 1; k <= locked_directions(joint.type); ++k)
                multipliers.push_back({fmt::format("lambda_{}_{}", joint.name.text, k), joint.name.place});
    for (std::size_t i = 0; i < multipliers.size(); ++i)
        if (multipliers[i].place.line > 0) values.push_back({&multipliers[i], DeclaredAs::multiplier, i});
    add(frames, scene.frames, DeclaredAs::frame);
    add(points, scene.points, DeclaredAs::point);
    add(points, scene.particles, DeclaredAs::particle);
    const auto refuse = [&](std::vector<Declaration>& list) {
        std::erase_if(list, [&](const Declaration& d) { return !check(*d.name, d.kind, diagnostics); });
    };
    refuse(values);
    refuse(frames);
    refuse(points);
    std::vector<Declaration> bodies;
    add(bodies, scene.bodies, DeclaredAs::body);
    refuse(bodies);
    frames.insert(frames.end(), bodies.begin(), bodies.end());
    for (Declaration& body : bodies) {
        const Name& centre = scene.bodies[body.index].point();
        if (&centre == body.name || check(centre, DeclaredAs::point, diagnostics))
            points.push_back({&centre, body.kind, body.index});
    }
    return {enter(values, diagnostics), enter(frames, diagnostics), enter(points, diagnostics), scene.functions};
}

std::vector<std::string> spellings(const NameSpaces::Space& space) {
    std::vector<std::pair<Place, std::string>> list;
    for (const auto& [name, declared] : space) list.emplace_back(declared.place, name);
    std::sort(list.begin(), list.end());
    std::vector<std::string> result;
    for (auto& [place, name] : list) result.push_back(std::move(name));
    return result;
}

}  // namespace alembert
