// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/check_claim.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "scene/book_letters.hpp"
#include "scene/sticking.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

void complain(const CheckedParts& of, Place place, std::string message) {
    of.diagnostics.push_back({place, std::move(message)});
}

/// The claim may hold the forces of what sticks, whose names are added to `more`.
void check_sticking(const Claim& claim, const CheckedParts& of, std::unordered_set<std::string>& more) {
    std::vector<std::string> known;
    for (const FrictionRule& friction : of.scene.frictions) known.push_back(friction.name.text);
    if (known.empty())
        complain(of, claim.place,
                 say("a claim speaks of the motion while friction sticks, and the scene has no [[friction]]"));
    for (const std::string& name : claim.sticking)
        if (std::find(known.begin(), known.end(), name) == known.end())
            complain(of, claim.place,
                     say("a claim speaks of the motion while {} sticks, and no friction has this name{}",
                         in_quotes(name), of.quantities.suggestion(name, known)));
    const std::vector<std::string> sticking = sticking_in(claim, of.scene);
    for (const FrictionRule& friction : of.scene.frictions) {
        if (std::find(sticking.begin(), sticking.end(), friction.name.text) == sticking.end()) continue;
        for (const std::string& force : taken_forces(friction, of.names))
            complain(of, claim.place,
                     say("while friction '{}' sticks, {} is its force, and the scene has {} of this name",
                         friction.name.text, in_quotes(force), described(of.names.values.at(force).kind)));
        for (const std::string& force : sticking_forces(friction)) more.insert(force);
    }
}

void check_closed(const Claim& claim, const CheckedParts& of) {
    std::vector<std::string> known;
    for (const UnilateralRule& contact : of.scene.unilateral) known.push_back(contact.name.text);
    if (known.empty())
        complain(of, claim.place,
                 say("a claim speaks of the motion while contacts are closed, and the scene has no "
                     "[[unilateral]]"));
    for (const std::string& name : claim.closed)
        if (std::find(known.begin(), known.end(), name) == known.end())
            complain(of, claim.place,
                     say("a claim speaks of the motion while {} is closed, and no contact has this name{}",
                         in_quotes(name), of.quantities.suggestion(name, known)));
}

/// The values of coordinates and rates near which it holds.
void check_near(const Claim& claim, const CheckedParts& of) {
    for (const auto& [name, value] : claim.near) {
        const bool is_rate = name.text.ends_with('\'');
        const std::string coordinate = is_rate ? name.text.substr(0, name.text.size() - 1) : name.text;
        const Declared* const declared = NameSpaces::find(of.names.values, coordinate);
        if (declared == nullptr)
            complain(of, name.place, say("unknown name {}; expected a coordinate", in_quotes(coordinate)));
        else if (declared->kind != Declared::Kind::coordinate)
            complain(of, name.place,
                     say("'near' gives the values of coordinates, and of rates as \"x'\"; {} is {}",
                         in_quotes(coordinate), described(declared->kind)));
        of.quantities.check(value, {.subject = say("a state that a claim is held near")});
    }
}

/// Of a motion in closed form: x = x0*cos(w*t).
void check_solution_form(const Claim& claim, const CheckedParts& of, const std::unordered_set<std::string>& more) {
    const Tree& left = *claim.equation.lhs.tree;
    const Declared* const declared =
        left.kind == Tree::Kind::name ? NameSpaces::find(of.names.values, left.text) : nullptr;
    if (left.kind == Tree::Kind::name && declared == nullptr)
        complain(of, claim.equation.lhs.place(),
                 say("unknown name {}; expected a coordinate or a multiplier", in_quotes(left.text)));
    else if (declared == nullptr || left.primes > 0 ||
             (declared->kind != Declared::Kind::coordinate && declared->kind != Declared::Kind::multiplier))
        complain(
            of, claim.equation.lhs.place(),
            say("a claim at \"solution\" has the name of a coordinate or a multiplier on its left, and on its "
                "right what this is in the course of time: x = x0*cos(w*t)"));
    of.quantities.check(claim.equation.rhs,
                        {.subject = say("a solution"), .input_order = 2, .time = true, .more = &more});
}

}  // namespace

void check_claim(const Claim& claim, const CheckedParts& of) {
    std::unordered_set<std::string> more;
    for (const std::vector<Name>* list : {&claim.unknowns, &claim.constants})
        for (const Name& name : *list) {
            if (!need_name(name, of.diagnostics)) continue;
            if (const Declared* const declared = NameSpaces::find(of.names.values, name.text))
                complain(of, name.place,
                         say("{} cannot be left open: it is {} of the scene", in_quotes(name.text),
                             described(declared->kind)));
            more.insert(name.text);
        }
    for (std::string& reaction : reaction_letters(of.scene, of.names)) more.insert(std::move(reaction));
    if (claim.at == Claim::At::sticking) check_sticking(claim, of, more);
    if (claim.at == Claim::At::closed) check_closed(claim, of);
    check_near(claim, of);
    if (!claim.where.empty() && claim.at != Claim::At::motion && claim.at != Claim::At::rest &&
        claim.at != Claim::At::closed && claim.at != Claim::At::sticking)
        complain(of, claim.place,
                 say("a claim with 'where' is about motions or states of rest; leave it out here"));
    if (claim.at == Claim::At::solution && claim.equation.lhs.tree) {
        check_solution_form(claim, of, more);
        return;
    }
    const bool is_of_motion =
        claim.at == Claim::At::motion || claim.at == Claim::At::sticking || claim.at == Claim::At::closed;
    const Legal anything{.subject = say("a claim"),
                         .order = is_of_motion ? 3 : 2,
                         .input_order = 2,
                         .time = true,
                         .advice = {},
                         .more = &more,
                         .multipliers = true,
                         .claim = true};
    of.quantities.check(claim.equation.lhs, anything);
    of.quantities.check(claim.equation.rhs, anything);
    for (const Inequality& assumed : claim.where) {
        of.quantities.check(assumed.greater, anything);
        of.quantities.check(assumed.less, anything);
    }
}

}  // namespace alembert
