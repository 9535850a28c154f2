// SPDX-License-Identifier: GPL-2.0-or-later
// J_C = m b²/12 of a rod that is 2 b long: a definition, until an energy shows that it is meant of a body of the
// scene, whose moment of inertia is another one.
#include <algorithm>

#include "base/language/say.hpp"
#include "check/derivation/marker.hpp"
#include "check/written/words.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// A body that turns in a plane, and its share of the kinetic energy.
struct Turning {
    std::string written;         ///< its moment of inertia, as the scene has it
    ex inertia;                  ///< about its mass centre
    ex moving = 0, turning = 0;  ///< the two parts of its kinetic energy
};

std::vector<Turning> turning_bodies(const Scene& scene, const Mechanism& m,
                                    const std::function<ex(const Expression&)>& value) {
    std::vector<Turning> result;
    for (const Body& body : scene.bodies) {
        if (!body.inertia || !body.inertia->planar) continue;
        Turning one{.written = body.inertia->planar->text, .inertia = value(*body.inertia->planar)};
        for (const Part& part : m.kinetic) {
            if (part.origin.name != body.name.text) continue;
            (part.origin.kind == Origin::Kind::rotation ? one.turning : one.moving) += part.value;
        }
        if (!one.turning.is_zero() && !one.inertia.is_zero()) result.push_back(std::move(one));
    }
    return result;
}

/// J φ'²
bool multiplies_square_of_rate(const Math& math, const Letter& letter) {
    if (math.kind == Math::Kind::product) {
        bool has_letter = false, has_square = false;
        for (const MathPtr& factor : math.args) {
            has_letter = has_letter || (factor->kind == Math::Kind::letter && factor->letter == letter);
            has_square = has_square || (factor->kind == Math::Kind::power &&
                                        factor->args[0]->kind == Math::Kind::letter && factor->args[0]->dots == 1);
        }
        if (has_letter && has_square) return true;
    }
    return std::any_of(math.args.begin(), math.args.end(),
                       [&](const MathPtr& arg) { return multiplies_square_of_rate(*arg, letter); });
}

}  // namespace

/// Whether it is the moment of inertia of a body about its mass centre or about a fixed point, or of all of them.
bool Marker::is_an_inertia(const ex& value) {
    const Mechanism& m = system_.mechanism();
    const auto is_it = [&](const ex& energy, const ex& square_of_rate) {
        return is_identically_zero(m.z->name(2 * energy - value * square_of_rate), m);
    };
    for (const Turning& body :
         turning_bodies(system_.scene(), m, [&](const Expression& e) { return truth_.value(e); })) {
        const ex square = 2 * body.turning / body.inertia;
        if (is_it(body.turning, square) || is_it(body.moving + body.turning, square)) return true;
    }
    return std::any_of(m.qdot.begin(), m.qdot.end(), [&](const GiNaC::symbol& rate) {
        const ex slope = m.z->pull_back({{m.kinetic_energy(), 1}}, {rate})[0];
        return is_identically_zero(m.z->name(m.z->pull_back({{slope, 1}}, {rate})[0] - value), m);
    });
}

/// "The moment of inertia is J = …", J of a J φ'' = M that stands above, or of J φ'²/2.
bool Marker::is_meant_as_inertia(const Letter& letter) const {
    if (speaks_of_inertia(heard_.around) || speaks_of_inertia(said_before_)) return true;
    for (const WrittenStatement& statement : written_.statements)
        for (const MathPtr& side : statement.sides)
            if (multiplies_square_of_rate(*side, letter)) return true;
    return std::any_of(&written_.statements.front(), statement_, [&](const WrittenStatement& above) {
        std::map<Letter, int> all;
        for (const MathPtr& side : above.sides) collect_letters(*side, all);
        return all.contains(letter) && std::any_of(above.sides.begin(), above.sides.end(),
                                                   [](const MathPtr& side) { return is_accelerated(*side); });
    });
}

/// A letter for a moment of inertia with a value that no body of the scene has.
bool Marker::is_foreign_inertia(const Letter& letter, const ex& value) {
    const bool is_letter = letter.base == "I" || letter.base == "J" || letter.base == "Theta";
    return is_letter && !system_.scene().bodies.empty() && is_of_parameters(value) && !is_an_inertia(value);
}

/// The kinetic energies that a wrong moment of inertia would give, and what it is taken for in the scene.
std::vector<Marker::WrongInertia> Marker::energies_with_inertia(const ex& value) {
    const Mechanism& m = system_.mechanism();
    const ex T = m.kinetic_energy();
    std::vector<WrongInertia> result;
    for (const Turning& body :
         turning_bodies(system_.scene(), m, [&](const Expression& e) { return truth_.value(e); })) {
        const ex turning = body.turning * value / body.inertia;
        result.push_back({m.z->name(T - body.turning + turning), body.written});
        result.push_back({m.z->name(T - body.turning - body.moving + turning), ""});  // about a fixed point
    }
    if (m.size() == 1) result.push_back({m.z->name(value * GiNaC::pow(m.qdot[0], 2) / 2), ""});
    return result;
}

/// A line that is right with the author's moment of inertia follows from its definition, which is the mistake.
bool Marker::follows_from_inertia(MarkedLine& line, const Sides& sides) {
    const auto from = [&] {
        const MotionRow own = system_.rows().row(own_residual(sides));
        return system_.rows().is_identity(own) == true ? own_.wrong_in(sides.own_names())
                                                       : own_.explained_by(own, heard_.small);
    };
    if (is_from_inertia(line, from)) return true;
    const Mechanism& m = system_.mechanism();
    const std::set<std::string> names = sides.own_names();
    for (const Turning& body :
         turning_bodies(system_.scene(), m, [&](const Expression& e) { return truth_.value(e); }))
        for (const std::string& name : names) {  // T_rot = I θ'²/2
            const auto known = known_.find(name);
            if (known == known_.end() || !is_identically_zero(m.z->name(known->second - body.turning), m))
                continue;
            for (const auto& [d, inertia] : inertias_) {
                if (lines[d].status != LineStatus::definition ||
                    !own_.state_if(name, m.z->name(body.turning * inertia / body.inertia), d,
                                   [&] { return (line.follows_from = from()).has_value(); }))
                    continue;
                blame_inertia(line, d, body.written);
                return true;
            }
        }
    return false;
}

/// No body has this moment of inertia, and the line follows from it.
void Marker::blame_inertia(MarkedLine& line, std::size_t definition, const std::string& meant) {
    MarkedLine& wrong = lines[definition];
    wrong.status = LineStatus::mistake;
    wrong.reason = say("no body of the scene has this moment of inertia");
    if (!meant.empty()) wrong.right = wrong.claim.substr(0, wrong.claim.find(" = ")) + " = " + meant;
    notes_[definition].is_sure = true;
    notes_[definition].claim = {};
    line.status = LineStatus::follows;
    line.reason = say("it follows from line {}", wrong.line);
}

/// `from` says from which line it follows, in a world with such a moment.
bool Marker::is_from_inertia(MarkedLine& line, const std::function<std::optional<std::size_t>()>& from) {
    const std::string T = letters_.name_of(MechanicalQuantity::kinetic);
    for (const auto& [d, inertia] : inertias_) {
        if (lines[d].status != LineStatus::definition) continue;
        for (const WrongInertia& wrong : energies_with_inertia(inertia)) {
            if (!own_.state_if(T, wrong.energy, d, [&] { return (line.follows_from = from()).has_value(); }))
                continue;
            blame_inertia(line, d, wrong.meant);
            return true;
        }
    }
    return false;
}

}  // namespace alembert
