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
                static const std::set<std::string> forces{"N", "T", "S", "F", "R", "f", "Z", "P"};
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

/// A letter alone on one side may be introduced here. Returns whether it was; then the line is judged.
bool Marker::introduce(MarkedLine& line, const Math& lhs, const Math& rhs, bool turned) {
    const Lone lone = lone_letter(lhs);
    if (lone.letter == nullptr) return false;
    const bool is_gibbs = heard_.energy_of_accelerations && lone.letter->letter.base == "S" && is_accelerated(rhs);
    const auto name = letters_.name_of(lone.letter->letter);
    if (is_gibbs && name && letters_.is_of_scene(*name)) {  // an impulse S of the scene is another thing
        define(line, *lone.letter, rhs, lone.power);
        return true;
    }
    if (name) {  // introduced here, and used before
        if (!ahead_.contains(lone.letter->letter) || !known_.contains(*name)) return false;
        ahead_.erase(lone.letter->letter);
        judge_pair(line, lhs, rhs);
        if (line.status == LineStatus::right) line.status = LineStatus::definition;
        return true;
    }
    if (heard_.abbreviations || letters_.is_authors(lone.letter->letter)) {
        define(line, *lone.letter, rhs, lone.power);
        if (lone.power == 1 && speaks_of_angular_momentum(statement_->words)) hold_against_momenta(line, rhs);
        return true;
    }
    if (bind_to_part(lone.letter->letter, &rhs)) return false;
    const ClaimText text = claim_text(rhs, {.letters = letters_});
    if (lone.power == 1 && is_constant_of_motion(line, *lone.letter, text, turned)) return true;
    if (is_frequency(line, *lone.letter, rhs, lone.power)) return true;
    if (bind_to_scene(line, *lone.letter, rhs, lone.power)) return true;
    define(line, *lone.letter, rhs, lone.power);
    return true;
}

/// L = m l² θ' as an angular momentum: right if it is a generalized momentum; of another one it is not known about
/// which point it is.
void Marker::hold_against_momenta(MarkedLine& line, const Math& value) {
    const Mechanism& m = system_.mechanism();
    MotionRows& rows = system_.rows();
    const ex stated = truth_.value(claim_text(value, as_written()).text);
    const std::vector<ex> momenta = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
    if (rows.is_identity(rows.row(stated - m.lagrangian())) == true) {
        line.status = LineStatus::right;
        return;
    }
    const bool is_one = std::any_of(momenta.begin(), momenta.end(), [&](const ex& momentum) {
        return rows.is_identity(rows.row(stated - momentum)) == true;
    });
    const bool is_kept = does_not_change(stated);
    if (!is_one && !is_kept && speaks_of_conservation(heard_.around)) {
        line.status = LineStatus::mistake;
        line.reason = say("it does not keep its value");
        return;
    }
    if (!is_one && is_kept) {
        line.status = LineStatus::right;
        line.reason = say("a constant of the motion");
        return;
    }
    line.status = is_one ? LineStatus::right : LineStatus::undecided;
    line.reason = is_one ? say("a generalized momentum")
                         : say("an angular momentum that is none of the generalized momenta; it is not judged");
}

/// T + V = const: an expression that changes with the state and keeps its value.
bool Marker::is_constant_of_motion(MarkedLine& line, const Math& letter, const ClaimText& text, bool turned) {
    const Mechanism& m = system_.mechanism();
    const ex value = truth_.value(text.text);
    if (m.z->depends(value, m.qddot) ||
        (!m.z->depends(value, m.qdot) && !is_word_for_constant(letter.letter.base)))
        return false;
    const MotionRow rate = system_.rows().row(m.time_derivative({value})[0]);
    const bool holds = system_.rows().holds(rate) == true;
    const bool is_state = std::any_of(m.q.begin(), m.q.end(), [&](const auto& q) { return value.is_equal(q); });
    if (!holds && is_state && is_word_for_constant(letter.letter.base) && !statement_->displayed) {  // φ = const
        line.status = LineStatus::not_about_scene;
        line.reason = say("it describes a state; lines are judged for all motions");
        heard_.put_under_condition();
        return true;
    }
    if (!holds && is_word_for_constant(letter.letter.base) && follows_in_special_case(rate.residual)) {
        settle_in_special_case(line);
        return true;
    }
    if (!holds && !is_word_for_constant(letter.letter.base))
        return is_said_to_be_conserved(line, text, letter.letter, turned);
    std::string name =
        letters_.free_name(is_word_for_constant(letter.letter.base) ? "const" : identifier_of(letter.letter));
    while (constants_.contains(name)) name = letters_.free_name(name + "_");  // each "const" is one of its own
    if (is_word_for_constant(letter.letter.base)) constants_.insert(name);
    line.claim = text.text + " = " + name;
    notes_.back().claim = {.lhs = text.text, .rhs = name, .constants = {name}};
    notes_.back().left = text;
    line.status = holds ? LineStatus::right : LineStatus::mistake;
    if (!holds) follows_as_constant(line, text);
    notes_.back().is_sure = line.status == LineStatus::mistake;
    if (holds && !is_word_for_constant(letter.letter.base)) kept_.insert(bind(letter.letter, value));
    return true;
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
    for (const Binding& binding : bindings(letter.letter)) {
        const ex here = truth_.value(binding.text),
                 truth = heard_.no_accelerations ? system_.without_accelerations(here) : here;
        const ex power_of_truth = power == 1 ? truth : GiNaC::pow(truth, power);
        if (rows.is_identity(rows.row(power_of_truth - value)) == true) return tell(truth, binding.point, true);
        const bool is_size = power == 1 && (binding.text.starts_with("sqrt(") ||  // v = l θ' has a sign
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

/// A letter that stands among others: one of the scene's places and speeds with which the line is right, or a
/// force that the line determines.
bool Marker::find_meaning(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    if (bind_to_part(letter)) {
        judge(line, lhs, rhs, Relation::equal);
        return true;
    }
    if (bind_to_momentum(line, lhs, rhs, letter)) return true;
    const Letters before = letters_;
    for (const Binding& binding : bindings(letter)) {
        const std::string name = bind(letter, truth_.value(binding.text));
        try {
            const Sides sides = sides_of(lhs, rhs);
            const MotionRow row =
                system_.rows().row(truth_.value(sides.left.text) - truth_.value(sides.right.text));
            if (system_.rows().holds(row) == true || ((binding.named || binding.spoken) && !spoken_.empty())) {
                roaming_.insert(letter);
                judge_pair(line, lhs, rhs);
                return true;
            }
        } catch (const NoMeaning&) {  // another letter is not known either
        }
        known_.erase(name);
        letters_ = before;
    }
    return determine(line, lhs, rhs, letter);
}

/// H = p²/(2 m l²) + V of one coordinate: p is its momentum if that makes the line right.
bool Marker::bind_to_momentum(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    if (letter != Letter{.base = "p"} || letters_.coordinates().size() != 1) return false;
    const Letters before = letters_;
    letters_.bind(letter, "p_" + letters_.coordinates()[0]);
    try {
        const Sides sides = sides_of(lhs, rhs);
        MotionRows& rows = system_.rows();
        if (rows.holds(rows.row(truth_.value(sides.left.text) - truth_.value(sides.right.text))) == true) {
            judge_pair(line, lhs, rhs);
            return true;
        }
    } catch (const NoMeaning&) {  // another letter is not known either
    }
    letters_ = before;
    return false;
}

/// M x'' = F + S sin θ determines S. What follows must agree with it.
bool Marker::determine(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    std::map<Letter, int> all;
    collect_letters(lhs, all);
    collect_letters(rhs, all);
    if (all[letter] > 0) return determine_by_rate(line, lhs, rhs, letter);
    const Letters before = letters_;
    const std::string name = bind(letter, 0);
    const auto give_up = [&] {
        known_.erase(name);
        letters_ = before;
        return false;
    };
    Sides sides;
    try {
        sides = sides_of(lhs, rhs);
    } catch (const NoMeaning&) {
        return give_up();
    }
    const Mechanism& m = system_.mechanism();
    const auto solved = [&](const std::function<ex(const ex&)>& residual) -> std::optional<ex> {
        const ex none = residual(0), slope = residual(1) - none;
        if (!system_.rows().is_identity(system_.rows().row(residual(2) - none - 2 * slope)).value_or(false))
            return std::nullopt;
        if (m.z->name(slope).is_zero() || m.z->depends(slope, m.qddot)) return std::nullopt;
        const ex plain = m.z->expand(slope);  // pi - theta of theta = pi - alpha, without a quotient
        if (GiNaC::is_a<GiNaC::numeric>(plain)) return m.z->name((m.z->expand(none) / -plain).expand());
        return m.z->name(-none / slope);
    };
    const auto truth = solved([&](const ex& value) {
        truth_.know(name, value);
        return truth_.value(sides.left.text) - truth_.value(sides.right.text);
    });
    if (!truth) return give_up();
    const auto own = solved([&](const ex& value) {
        own_.state(name, value, {});
        return own_residual(sides);
    });
    known_[name] = *truth;
    truth_.know(name, *truth);
    if (is_constant_of_potential(line, sides, letter, *truth)) return true;
    own_.state(name, own.value_or(*truth), own_.wrong_in(sides.own_names()));
    note_base(lhs, rhs, letter);
    line.status = LineStatus::definition;  // it may absorb any slip
    line.claim = sides.left.text + " = " + sides.right.text;
    line.reason = say("it determines {}", name);
    return true;
}

/// φ' = x'/r, or x' = r φ' of rolling: φ is x/r, counted from where x is zero.
bool Marker::determine_by_rate(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter) {
    const Letters before = letters_;
    const std::string name = bind(letter, 0);
    const auto give_up = [&] {
        known_.erase(name);
        letters_ = before;
        return false;
    };
    const Mechanism& m = system_.mechanism();
    std::optional<ex> place;
    try {
        const Sides sides = sides_of(lhs, rhs);
        const auto residual = [&](int rate) {  // with φ = rate · t
            truth_.know(name, rate * m.t);
            return truth_.value(sides.left.text) - truth_.value(sides.right.text);
        };
        const ex none = residual(0), slope = residual(1) - none;
        if (!is_identically_zero(m.z->name(residual(2) - none - 2 * slope), m)) return give_up();
        if (is_identically_zero(m.z->name(slope), m)) return give_up();
        const ex rate = m.z->name(-none / slope);
        const std::vector<ex> shares = m.z->pull_back({{rate, 1}}, m.qdot);
        GiNaC::exvector terms, rates;
        for (std::size_t i = 0; i < shares.size(); ++i) {
            if (!is_of_parameters(shares[i])) return give_up();
            terms.push_back(shares[i] * m.q[i]);
            rates.push_back(shares[i] * m.qdot[i]);
        }
        if (!is_identically_zero(m.z->name(rate - GiNaC::add(rates)), m)) return give_up();
        place = m.z->expand(GiNaC::add(terms)).normal();
        line.claim = sides.left.text + " = " + sides.right.text;
    } catch (const NoMeaning&) {
        return give_up();
    }
    known_[name] = m.z->name(*place);
    truth_.know(name, known_[name]);
    own_.state(name, known_[name], {});
    of_rate_.insert(letter);
    line.status = LineStatus::definition;
    line.reason = say("it determines {}", name);
    return true;
}

void Marker::define(MarkedLine& line, const Math& letter, const Math& rhs, int power) {
    if (power == 1 && rhs.kind == Kind::letter && rhs.dots == 0) {  // q_1 = x
        const auto name = letters_.name_of(rhs.letter);
        const std::vector<std::string>& all = letters_.coordinates();
        if (name && std::find(all.begin(), all.end(), *name) != all.end()) {
            letters_.bind(letter.letter, *name);
            line.status = LineStatus::definition;
            line.claim = identifier_of(letter.letter) + " = " + *name;
            return;
        }
    }
    if (!statement_->displayed && is_number(rhs)) heard_.put_under_condition();  // "at the pole, λ = π/2"
    const ClaimText text = claim_text(rhs, {.letters = letters_}),
                    own = claim_text(rhs, {.letters = letters_, .steps = &own_.steps()});
    const GiNaC::numeric exponent(1, power);
    const ex truth = GiNaC::pow(truth_.value(text.text), exponent),
             stated = GiNaC::pow(own_.value(own.text), exponent);
    const std::optional<std::size_t> wrong = own_.wrong_in(own.names);
    const std::string name = bind(letter.letter, truth);
    own_.state(name, stated, wrong);
    if (holds_decimals(rhs)) rounded_.insert(name);
    line.status = LineStatus::definition;
    line.claim = (power == 1 ? name : name + "^2") + " = " + text.text;
    if (power == 1) hold_momenta(name, text, own, wrong);
    if (power == 1 && !wrong && is_foreign_inertia(letter.letter, truth)) inertias_[lines.size()] = truth;
}

/// U_eff(θ) = V + J²/(2 m l² sin²θ): ∂U/∂θ is taken with J held, ∂H/∂p with q held, of what the author has
/// written.
void Marker::hold_momenta(const std::string& name, const ClaimText& text, const ClaimText& own,
                          std::optional<std::size_t> wrong) {
    const Mechanism& m = system_.mechanism();
    std::map<std::string, ex> letters;
    GiNaC::exmap truths;
    std::vector<GiNaC::symbol> by = m.q;
    by.insert(by.end(), m.qdot.begin(), m.qdot.end());
    std::vector<std::string> names;
    for (const GiNaC::symbol& coordinate : by) names.push_back(coordinate.get_name());
    for (const std::string& held : text.names) {
        if (!known_.contains(held) || (!held.starts_with("p_") && !kept_.contains(held))) continue;
        const GiNaC::symbol letter = system_.held(held);
        letters[held] = letter;
        truths[letter] = known_.at(held);
        by.push_back(letter);
        names.push_back(held);
    }
    if (letters.empty()) return;
    for (const auto& [held, letter] : letters) truth_.know(held, letter);
    const ex value = truth_.value(text.text);
    for (const auto& [held, letter] : letters) truth_.know(held, known_.at(held));
    const auto hold = [&](const std::string& key, const ex& slope, const ex& own_slope) {
        own_.state_step(key, substitute(*m.z, {own_slope}, truths)[0], wrong);
        const auto quantity = quantity_of({.base = name});
        if (quantity && letters_.name_of(*quantity) == name) return;  // H itself is what it is
        const std::string step = letters_.free_name(fmt::format("held_{}", held_.size() + 1));
        held_[key] = step;
        known_[step] = m.z->name(substitute(*m.z, {slope}, truths)[0]);
        truth_.know(step, known_[step]);
        own_.state(step, known_[step], {});
    };
    const std::vector<ex> slopes = m.z->pull_back({{value, 1}}, by),
                          own_slopes = m.z->pull_back({{own_.value_with(own.text, letters), 1}}, by);
    for (std::size_t k = 0; k < by.size(); ++k)
        hold(fmt::format("diff({},{})", name, names[k]), slopes[k], own_slopes[k]);
    for (std::size_t k = 0; k < m.q.size(); ++k)  // ∂²U/∂r², of frequencies about a state
        hold(fmt::format("diff({0},{1},{1})", name, names[k]), m.z->pull_back({{slopes[k], 1}}, {m.q[k]})[0],
             m.z->pull_back({{own_slopes[k], 1}}, {m.q[k]})[0]);
}

}  // namespace alembert
