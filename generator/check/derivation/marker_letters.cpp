// SPDX-License-Identifier: GPL-2.0-or-later
// Letters that a derivation introduces: points and velocities of the scene, constants of the motion,
// abbreviations.
#include "check/derivation/marker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>

#include "base/language/say.hpp"
#include "check/derivation/bindings.hpp"
#include "check/derivation/parts.hpp"
#include "check/total_derivative.hpp"
#include "check/written/sentences.hpp"
#include "check/written/word_kinds.hpp"
#include "check/written/words.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

/// "psi" of the index "psi_dot"; empty for one without a dot.
std::string without_dot(const std::string& index) {
    constexpr std::string_view dot = "_dot";
    return index.ends_with(dot) ? index.substr(0, index.size() - dot.size()) : "";
}

}  // namespace

std::string Marker::bind(const Letter& letter, const ex& truth) {
    const std::string name = letters_.free_name(identifier_of(letter));
    letters_.bind(letter, name);
    known_[name] = system_.mechanism().z->name(truth);
    truth_.know(name, known_[name]);
    own_.state(name, known_[name], {});
    if (!system_.mechanism().z->depends(truth, system_.mechanism().qdot)) return name;
    MotionRows& rows = system_.rows();
    for (const DerivedSystem::IndependentSpeed& speed : system_.independent_speeds())
        if (!speed.is_of_scene && !speed.is_rate && rows.is_identity(rows.row(speed.form - truth)) == true)
            know_speed(name, speed.slopes);
    return name;
}

/// y_1 and y_2 where the scene has one body: the author counts springs, or corners.
bool Marker::counts_other_things(const Letter& letter) const {
    if (!is_count(letter.index)) return false;
    const Scene& scene = system_.scene();
    const std::size_t things = scene.particles.size() + scene.bodies.size() + scene.points.size();
    const auto largest = counts_.find(letter.base);
    return largest != counts_.end() && largest->second > things;
}

/// The largest number with which the text counts each letter.
void Marker::count_letters() {
    std::map<Letter, int> all;
    for (const WrittenStatement& statement : written_.statements)
        for (const MathPtr& side : statement.sides) collect_letters(*side, all);
    constexpr std::size_t longest = 2;  // a year is no count
    for (const auto& [letter, dots] : all)
        if (is_count(letter.index) && letter.index.size() <= longest)
            counts_[letter.base] = std::max(counts_[letter.base], std::stoul(letter.index));
}

/// Those of the body of which the words before the line speak, if they speak of one.
std::vector<Binding> Marker::bindings(const Letter& letter) const {
    std::vector<Binding> all = bindings_of(letter, system_.scene());
    if (counts_other_things(letter))
        for (Binding& binding : all) binding.named = false;
    if (letter.base == "v" && letter.index.empty())
        for (const char* const axis : {"x", "y", "z"})  // v² beside v_x and v_y is of the same point
            if (const auto component = motions_.find({.base = "v", .index = axis}); component != motions_.end())
                for (Binding& binding : all)
                    binding.named = binding.named || binding.point == component->second.point;
    if (spoken_.empty()) return all;
    std::vector<Binding> own;
    for (Binding& binding : all)
        if (binding.text.find("(" + spoken_ + ")") != std::string::npos) {
            binding.spoken = true;
            own.push_back(binding);
        }
    return own.empty() ? all : own;
}

/// The body or particle that stands in the words before a statement. Letters such as v_x that had been found for
/// another one are open again then.
void Marker::hear_bodies(const std::string& words) {
    if (!holds_letters(words)) return;
    std::string spoken;
    std::set<std::string> all_spoken;
    const auto look_for = [&](const std::string& name) {
        const auto is_part_of_word = [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
        };
        for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name, at + 1)) {
            const std::size_t end = at + name.size();
            const bool alone =
                name.size() > 1 || (at > 4 && (words.compare(at - 5, 5, "body ") == 0 ||
                                               (at > 8 && words.compare(at - 9, 9, "particle ") == 0)));
            if (alone && (at == 0 || !is_part_of_word(words[at - 1])) &&
                (end == words.size() || !is_part_of_word(words[end])))
                spoken = name, all_spoken.insert(name);
        }
    };
    for (const Particle& p : system_.scene().particles) look_for(p.name.text);
    for (const Body& b : system_.scene().bodies) look_for(b.name.text);
    if (all_spoken.size() > 1) spoken = spoken_;                     // of both
    if (spoken.empty() && !statement_->displayed) spoken = spoken_;  // the sentence goes on
    if (spoken != spoken_) {
        for (const Letter& letter : roaming_) letters_.release(letter);
        roaming_.clear();
    }
    spoken_ = spoken;
}

/// Whether the statement holds accelerations, or letters that stand for some: m g − T = m a.
bool Marker::speaks_of_acceleration() const {
    std::map<Letter, int> all;
    for (const MathPtr& side : statement_->sides) {
        if (is_accelerated(*side)) return true;
        collect_letters(*side, all);
    }
    const Mechanism& m = system_.mechanism();
    return std::any_of(all.begin(), all.end(), [&](const auto& item) {
        const auto name = letters_.name_of(item.first);
        const auto known = name ? known_.find(*name) : known_.end();
        return known != known_.end() && m.z->depends(known->second, m.qddot);
    });
}

/// A letter of the author's for what changes in motion, as a force that an equation has determined.
bool Marker::changes_in_motion(const std::string& name) const {
    const Mechanism& m = system_.mechanism();
    const auto known = known_.find(name);
    return known != known_.end() && !letters_.is_of_scene(name) &&
           (m.z->depends(known->second, m.q) || m.z->depends(known->second, m.qdot) ||
            m.z->depends(known->second, m.qddot));
}

/// "…, where M = m_1 + m_2": a letter that a later line introduces.
bool Marker::introduce_ahead(const Letter& letter) {
    if (ahead_.contains(letter)) return false;
    const bool of_motion = speaks_of_acceleration();
    const auto is_constant = [&](const Math& value) {
        std::map<Letter, int> all;
        collect_letters(value, all);
        return std::none_of(all.begin(), all.end(), [&](const auto& item) {
            const auto name = letters_.name_of(item.first);
            return !name || letters_.moves(*name) || changes_in_motion(*name);
        });
    };
    for (const WrittenStatement& statement : written_.statements) {
        if (&statement < statement_) continue;  // in this one: y_1 = y_2 = l cos α
        for (std::size_t k = 0; k + 1 < statement.sides.size(); ++k)
            for (const bool turned : {false, true}) {
                if (statement.relations[k] == Relation::proportional) continue;  // n ≫ Ω
                const Math &side = *statement.sides[turned ? k + 1 : k],
                           &value = *statement.sides[turned ? k : k + 1];
                const Lone lone = lone_letter(side);
                if (lone.letter == nullptr || lone.letter->letter != letter) continue;
                const bool is_special = speaks_of_special_motion(statement.words) ||
                                        speaks_of_rest(statement.words) || is_conditional(statement.words) ||
                                        speaks_of_special_case(statement.words);
                if (of_motion && is_special) continue;                   // "on the circle S = M g"
                if (!statement.displayed && is_number(value)) continue;  // "at θ = 0", "at the pole, λ = π/2"
                if (of_motion && statement.consequence)
                    continue;  // "we get N = …" of the force that it determines
                const bool is_explained =
                    !statement.displayed && !is_accelerated(value) && explains(statement.words);
                static const std::set<std::string> forces{"N", "T", "S", "F", "R", "f", "Z", "P", "H"};
                if (of_motion && !is_explained && (!is_constant(value) || forces.contains(letter.base)))
                    continue;  // a force, which the equation itself determines
                try {
                    MarkedLine there;
                    if (&statement == statement_ && turned) continue;
                    if (&statement == statement_ && k > 0 && introduce(there, side, value)) return true;
                    if (&statement == statement_) continue;
                    if (is_foreign_inertia(letter, truth_.value(claim_text(value, as_written()).text)))
                        continue;  // the line may determine it, and the definition be the mistake
                    define(there, *lone.letter, value, lone.power);
                    ahead_.insert(letter);
                    return true;
                } catch (const NoMeaning&) {
                    continue;
                }
            }
    }
    return false;
}

/// T of one body, V of gravity: what the scene has a part for. In an equation of motion T_1 is a force.
bool Marker::bind_to_part(const Letter& letter, const Math* value) {
    const bool of_motion = speaks_of_acceleration();
    const bool starred = letter.raised == "*" || letter.base == "F" || letter.base == "E";
    if (of_motion && !starred) return false;
    std::optional<ex> part = part_named(letter, letters_, system_);
    if (!part) part = force_along_speed(letter);
    if (part && value != nullptr) part = numbered_otherwise(letter, *value, *part);
    if (value != nullptr && letter.base == "F" && letter.raised.empty()) part = other_force(letter, *value, part);
    const bool is_numbered_force = letter.base == "F" && letter.raised.empty() && is_count(letter.index);
    if (part && is_numbered_force && !(value != nullptr && is_value_of(*value, *part))) return false;  // of body 1
    if (!part) return false;
    const std::string name = bind(letter, *part);
    const bool of_force = letter.base == "Q" && !letter.raised.empty() && letter.raised != "*";
    const std::string whole =
        letter.base == "T" || letter.base == "K"   ? letters_.name_of(MechanicalQuantity::kinetic)
        : letter.base == "V" || letter.base == "U" ? letters_.name_of(MechanicalQuantity::potential)
        : of_force                                 ? "Q_" + letters_.coordinate_of(letter.index)
                                                   : "";
    if (!whole.empty()) own_.count_as_part(name, whole, *part);
    return true;
}

bool Marker::is_value_of(const Math& value, const ex& truth) {
    MotionRows& rows = system_.rows();
    const ex stated = truth_.value(claim_text(value, {.letters = letters_}).text);
    return rows.is_identity(rows.row(stated - truth)) == true;
}

/// T_1 is that of the first body in the author's order, which is another one where that makes the line right.
ex Marker::numbered_otherwise(const Letter& letter, const Math& value, const ex& part) {
    const std::string& index = letter.index;
    const bool is_number = index.size() == 1 && index[0] >= '1' && index[0] <= '9' && letter.raised.empty();
    const bool is_energy = letter.base == "T" || letter.base == "V" || letter.base == "K" || letter.base == "U";
    if (!is_number || !is_energy || is_counted(system_.scene())) return part;
    if (is_value_of(value, part)) return part;
    for (char k = '1'; k <= '9'; ++k) {
        Letter other = letter;
        other.index = k;
        const std::optional<ex> candidate = part_named(other, letters_, system_);
        if (!candidate) break;
        if (is_value_of(value, *candidate)) return *candidate;
    }
    return part;
}

/// F_θ = 0 is of the forces that are not in V if that is what makes it right.
std::optional<ex> Marker::other_force(const Letter& letter, const Math& value, const std::optional<ex>& force) {
    const std::string along = letters_.coordinate_of(letter.index);
    const Mechanism& m = system_.mechanism();
    const std::vector<ex> others = system_.forces(false);
    const ex stated = truth_.value(claim_text(value, {.letters = letters_}).text);
    for (std::size_t i = 0; i < others.size(); ++i)
        if (along == m.q[i].get_name() && is_identically_zero(m.z->name(stated - others[i]), m)) return others[i];
    return force;
}

/// F_u = Σ F_q ∂q'/∂u, F*_u likewise: forces along a generalized speed, or along a rate when the constraints have
/// been solved for others.
std::optional<ex> Marker::force_along_speed(const Letter& letter) const {
    const bool inertia = letter.raised == "*" || letter.raised == "\\ast";
    const bool is_force = letter.base == "F" || letter.base == "Q";
    if (!is_force || letter.index.empty() || (!inertia && !letter.raised.empty())) return std::nullopt;
    const Mechanism& m = system_.mechanism();
    const std::vector<ex> forces = inertia ? euler_operator(m.kinetic_energy(), m) : system_.forces(true);
    const std::string rate = letters_.coordinate_of(without_dot(letter.index)), word = plain_word(letter.index);
    std::optional<ex> result;
    for (int i = 0; !result && i < m.size(); ++i)  // without constraints in the way
        if (rate == m.q[i].get_name()) result = inertia ? -forces[i] : forces[i];
    for (const auto& [key, slopes] : speeds_) {
        if (key.back() == '\'' ? key != rate + "'" : plain_word(key) != word) continue;
        GiNaC::exvector terms;
        for (const auto& [changed, slope] : slopes)
            for (int i = 0; i < m.size(); ++i)
                if (changed == m.q[i].get_name() + "'")
                    terms.push_back((inertia ? -forces[i] : forces[i]) * known_.at(slope));
        result = GiNaC::add(std::move(terms));
    }
    return result ? std::optional(m.z->name(*result)) : std::nullopt;
}

/// x_1 = l sin θ: a letter for a point's place, a speed, an angular velocity. Right if one of those of the scene
/// is this; wrong if the index says which one it is and it is not.
bool Marker::bind_to_scene(MarkedLine& line, const Math& letter, const Math& rhs, int power) {
    const ClaimText text = claim_text(rhs, {.letters = letters_}),
                    own = claim_text(rhs, {.letters = letters_, .steps = &own_.steps()});
    const ex value = truth_.value(text.text);
    MotionRows& rows = system_.rows();
    std::optional<ex> named;
    std::string point;
    const auto tell = [&](const ex& truth, const std::string& point, bool right) {
        const ex stated = own_.value(own.text);
        roaming_.insert(letter.letter);
        const std::string name = bind(letter.letter, truth);
        own_.state(name, GiNaC::pow(stated, GiNaC::numeric(1, power)),
                   right ? std::nullopt : std::optional(lines.size()));
        motions_[letter.letter] = {point, letter.letter.base == "v"};
        if (!right) count_velocity(letter.letter, letter.dots, name);
        line.status = right ? LineStatus::right : LineStatus::mistake;
        const std::string left = power == 1 ? name : name + "^2";
        line.claim = left + " = " + text.text;
        notes_.back().claim = {.lhs = left, .rhs = text.text};
        notes_.back().right = text;
        return true;
    };
    // a = x'' may be the acceleration of any of the things that move so
    const bool is_acceleration = system_.mechanism().z->depends(value, system_.mechanism().qddot);
    for (const Binding& binding : bindings(letter.letter)) {
        const ex here = truth_.value(binding.text),
                 truth = heard_.no_accelerations ? system_.without_accelerations(here) : here;
        const ex power_of_truth = power == 1 ? truth : GiNaC::pow(truth, power);
        if (rows.is_identity(rows.row(power_of_truth - value)) == true) return tell(truth, binding.point, true);
        const bool is_size = power == 1 && !is_acceleration &&
                             (binding.text.starts_with("sqrt(") ||  // v = l θ' has a sign
                              (letter.letter.base == "omega" && letter.letter.index.empty()));
        if (is_size && rows.is_identity(rows.row(GiNaC::pow(truth, 2) - GiNaC::pow(value, 2))) == true)
            return tell(value, binding.point, true);
        if (!binding.size.empty()) {
            const ex square = GiNaC::pow(truth_.value(binding.size), 2);
            if (rows.is_identity(rows.row(square - GiNaC::pow(value, power == 1 ? 2 : 1))) == true)
                return tell(power == 1 ? value : GiNaC::sqrt(value), binding.point, true);
            if (rows.is_identity(rows.row(square - GiNaC::pow(truth, 2))) != true) continue;  // not in a plane
        }
        const bool is_said = binding.spoken && speaks_of_motion_of(statement_->words, spoken_);
        const bool is_of_own_axes = letter.letter.base == "omega" && letter.letter.index.size() == 1 &&
                                    letter.letter.index.find_first_of("123") == 0;
        if ((binding.named || is_said) && !named && !is_of_own_axes) named = truth, point = binding.point;
    }
    const bool is_component = letter.letter.base != "v" || component_of_axis(letter.letter);
    if (named && ((heard_.turning_axes && is_component) || is_on_other_axis(letter.letter, value))) {
        define(line, letter, rhs, power);
        return true;
    }
    const bool is_constant = std::all_of(text.names.begin(), text.names.end(), [&](const std::string& name) {
        return letters_.is_of_scene(name) && !letters_.moves(name);
    });
    return named && !is_constant && tell(*named, point, false);  // ω = √(g/l) is no rate of a body
}

/// v_x, ω_z
bool Marker::component_of_axis(const Letter& letter) {
    return letter.index.find_first_of("xyzXYZ123") != std::string::npos;
}

/// y = l cos α with y downwards along the shaft: another axis of the scene, or one of its frames.
bool Marker::is_on_other_axis(const Letter& letter, const ex& value) {
    MotionRows& rows = system_.rows();
    const auto is_in_plane = [&](const auto& masses) {
        return std::all_of(masses.begin(), masses.end(), [&](const auto& mass) {
            return truth_.value("dot(pos(" + mass.name.text + "),ez(N))").is_zero();
        });
    };
    const Scene& scene = system_.scene();
    if (!heard_.axes && is_in_plane(scene.particles) && is_in_plane(scene.bodies)) return false;
    for (const Binding& binding : other_axes_of(letter, system_.scene())) {
        const ex truth = truth_.value(binding.text);
        if (rows.is_identity(rows.row(truth - value)) == true || rows.is_identity(rows.row(truth + value)) == true)
            return true;
    }
    return false;
}

/// What the derivation says of a velocity counts in the kinetic energy of its mass.
void Marker::count_velocity(const Letter& letter, int dots, const std::string& text) {
    const auto found = motions_.find(letter);
    if (found == motions_.end() || dots != (found->second.is_velocity ? 0 : 1)) return;
    const auto count = [&](const auto& masses) {
        for (const auto& mass : masses)
            if (mass.name.text == found->second.point)
                own_.count_as_velocity(
                    text,
                    truth_.value(*letters_.name_of(letter) + std::string(static_cast<std::size_t>(dots), '\'')),
                    truth_.value(mass.mass));
    };
    count(system_.scene().particles);
    count(system_.scene().bodies);
}

}  // namespace alembert
