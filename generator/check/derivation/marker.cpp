// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/marker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/language/say.hpp"
#include "check/derivation/general_law.hpp"
#include "check/derivation/parts.hpp"
#include "check/written/sentences.hpp"
#include "check/written/surroundings.hpp"
#include "check/written/words.hpp"
#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

bool is_number(const Math& side) {
    if (side.kind == Kind::number) return true;
    const bool is_form = side.kind == Kind::negate || side.kind == Kind::quotient || side.kind == Kind::product ||
                         side.kind == Kind::quantity || side.kind == Kind::sum;
    return (side.kind == Kind::letter && side.letter.base == "pi") ||
           (is_form &&
            std::all_of(side.args.begin(), side.args.end(), [](const MathPtr& arg) { return is_number(*arg); }));
}

namespace {

bool is_rate_alone(const Math& side) {
    return (side.kind == Kind::letter && side.dots == 1) ||
           (side.kind == Kind::rate && side.dots == 1 && side.args[0]->kind == Kind::letter);
}

}  // namespace

std::set<std::string> Marker::Sides::own_names() const {
    std::set<std::string> result = own_left.names;
    result.insert(own_right.names.begin(), own_right.names.end());
    return result;
}

Marker::Marker(DerivedSystem& system, const Written& written, Letters letters)
    : system_(system),
      written_(written),
      letters_(std::move(letters)),
      truth_(system.scene(), system.mechanism(), system.sheets()),
      own_(system, letters_) {
    count_letters();
    std::vector<ex> values = system.forces(true);
    values.push_back(system.mechanism().lagrangian());
    const std::vector<ex> changes = system.mechanism().explicit_time_derivative(values);
    is_autonomous_ = std::all_of(changes.begin(), changes.end(), [&](const ex& change) {
        return is_identically_zero(system.mechanism().z->name(change), system.mechanism());
    });
    for (const auto& [name, value] : own_.values()) {  // nothing is stated yet
        known_[name] = value;
        truth_.know(name, value);
    }
    for (const DerivedSystem::IndependentSpeed& speed : system_.independent_speeds())
        if (speed.is_of_scene || speed.is_rate) know_speed(speed.name + (speed.is_rate ? "'" : ""), speed.slopes);
}

void Marker::know_speed(const std::string& key, const std::vector<ex>& slopes) {
    if (speeds_.contains(key)) return;
    const Mechanism& m = system_.mechanism();
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        if (slopes[i].is_zero()) continue;
        const std::string q = m.q[i].get_name(),
                          name = letters_.free_name("d" + q + "_d" + key.substr(0, key.find('\'')));
        known_[name] = slopes[i];
        truth_.know(name, slopes[i]);
        own_.state(name, slopes[i], {});
        speeds_[key].emplace_back(q + "'", name);
    }
}

/// U = p_φ²/(2 m l² sin²θ) + … is the author's wherever it stands, and so with a letter of his own for the
/// momentum.
void Marker::find_effective_potentials() {
    std::set<Letter> momenta;
    for (const WrittenStatement& statement : written_.statements)
        for (std::size_t k = 0; k + 1 < statement.sides.size(); ++k)
            for (const bool turned : {false, true}) {
                const Lone own = lone_letter(*statement.sides[turned ? k + 1 : k]);
                const bool may_be = own.letter != nullptr && own.power == 1 && !quantity_of(own.letter->letter) &&
                                    holds_rates(*statement.sides[turned ? k : k + 1]);
                if (may_be && !letters_.is_of_scene(letters_.name_of(own.letter->letter).value_or("")))
                    momenta.insert(own.letter->letter);
            }
    for (const WrittenStatement& statement : written_.statements)
        for (std::size_t k = 0; k + 1 < statement.sides.size(); ++k) {
            const Lone own = lone_letter(*statement.sides[k]);
            const bool may_be = own.letter != nullptr && own.letter->letter.index.empty() &&
                                (own.letter->letter.base == "U" || own.letter->letter.base == "V");
            if (!may_be) continue;
            std::map<Letter, int> all;
            collect_letters(*statement.sides[k + 1], all);
            const bool has_momentum = std::any_of(all.begin(), all.end(), [&](const auto& item) {
                return (item.first.base == "p" && !item.first.index.empty()) || momenta.contains(item.first);
            });
            if (has_momentum) letters_.leave_to_author(own.letter->letter);
        }
}

void Marker::run() {
    find_effective_potentials();
    for (std::size_t s = 0; s < written_.statements.size(); ++s) {
        statement_ = &written_.statements[s];
        if (statement_->sides.size() == 1) continue;  // a letter among the words of the next one
        special_.hear(statement_->words);
        hear_special_values(statement_->words);
        if (ends_sentence(statement_->words) || statement_->displayed) stated_place_.clear();
        special_.hear_end(statement_->words);
        heard_.take_in(written_, *statement_);
        hear_bodies(statement_->words);
        if (statement_->sides.empty()) {
            MarkedLine line{.status = LineStatus::not_understood, .statement = s};
            line.offset = statement_->offset;
            line.length = statement_->length;
            line.line = written_.line(line.offset);
            line.column = written_.column(line.offset);
            line.source = written_.text.substr(line.offset, line.length);
            line.reason = statement_->reason;
            lines.push_back(std::move(line));
            notes_.emplace_back();
            continue;
        }
        for (std::size_t k = 0; k + 1 < statement_->sides.size(); ++k) line(s, k);
    }
}

void Marker::line(std::size_t s, std::size_t k) {
    const Math &lhs = *statement_->sides[k], &rhs = *statement_->sides[k + 1];
    MarkedLine line{.status = LineStatus::undecided, .statement = s};
    line.offset = k == 0 ? lhs.offset : rhs.offset;
    line.length = rhs.offset + rhs.length - line.offset;
    line.line = written_.line(line.offset);
    line.column = written_.column(line.offset);
    line.source = in_whole_brackets(written_.text, lhs.offset, rhs.offset + rhs.length);
    notes_.emplace_back();
    const Lone lone = lone_letter(lhs);
    is_new_law_ = lone.letter != nullptr && !quantity_of(lone.letter->letter) &&
                  is_unknown_force(lone.letter->letter) && !seen_.contains(lone.letter->letter);
    for (const Math* side : {&lhs, &rhs}) {
        std::map<Letter, int> all;
        collect_letters(*side, all);
        for (const auto& [letter, dots] : all) seen_.insert(letter);
    }
    relation_ = statement_->relations[k];
    heard_.small = heard_.small || relation_ == Relation::approximately;
    is_judging_ = true;
    try {
        judge(line, lhs, rhs, statement_->relations[k]);
        if (line.status == LineStatus::mistake) is_of_authors_function(line, lhs, rhs);
    } catch (const NoMeaning& not_understood) {
        const bool is_state =
            lhs.kind == Kind::letter && rhs.kind == Kind::letter && sets_value(statement_->words);
        if (not_understood.unknown && !statement_->displayed && (is_number(rhs) || is_state))
            heard_.put_under_condition();  // "with θ = θ_1 we get"
        const bool general = not_understood.unknown && !statement_->displayed && has_several_unknown(lhs, rhs);
        line.status = general ? LineStatus::not_about_scene : LineStatus::not_understood;
        line.reason = general ? say("a formula in letters that the scene does not have") : not_understood.reason;
    } catch (const std::domain_error&) {  // θ = 0 where something is divided by θ
        leave_undefined(line);
    } catch (const std::overflow_error&) {
        leave_undefined(line);
    }
    is_judging_ = false;
    try {
        weigh_condition(line, lhs, rhs);
    } catch (const NoMeaning&) {  // what has no value for itself is not excused
    } catch (const std::domain_error&) {
        leave_undefined(line);
    } catch (const std::overflow_error&) {
        leave_undefined(line);
    }
    if (line.status == LineStatus::follows && !is_judged_wrong(*line.follows_from)) {
        line.reason = say("it follows from line {}, which is not judged", lines[*line.follows_from].line);
        line.status = LineStatus::not_about_scene;
        line.follows_from.reset();
    }
    const bool is_of_rest = line.status == LineStatus::not_about_scene && heard_.assumed_rest;
    if (!is_of_rest && (holds_rates(lhs) || holds_rates(rhs))) heard_.assumed_rest = false;
    if (line.status == LineStatus::not_about_scene) notes_.back().claim = {};
    special_.pass_line();
    lines.push_back(std::move(line));
    if (lines.back().status != LineStatus::not_understood && lines.back().status != LineStatus::not_about_scene)
        take_in(s, k);
}

/// A division by zero is that line's alone.
void Marker::leave_undefined(MarkedLine& line) {
    line.status = LineStatus::undecided;
    line.reason = say("it could not be evaluated");
    line.follows_from.reset();
    notes_.back().claim = {};
}

/// Whether something can follow from the line as from a mistake: definitions may be wrong too.
bool Marker::is_judged_wrong(std::size_t k) const {
    const LineStatus status = lines[k].status;
    return status != LineStatus::not_about_scene && status != LineStatus::not_understood &&
           status != LineStatus::undecided;
}

bool Marker::has_several_unknown(const Math& lhs, const Math& rhs) const {
    std::map<Letter, int> all;
    collect_letters(lhs, all);
    collect_letters(rhs, all);
    return std::count_if(all.begin(), all.end(), [&](const auto& item) { return !letters_.name_of(item.first); }) >
           1;
}

/// "For M → 0 we have ω² = k/m": another value of a letter that has one, of the limit alone.
bool Marker::is_of_limit(MarkedLine& line, const Math& lhs) const {
    const Lone lone = lone_letter(lhs);
    const auto name = lone.letter != nullptr ? letters_.name_of(lone.letter->letter) : std::nullopt;
    if (!name || !known_.contains(*name) || letters_.is_of_scene(*name) || quantity_of(lone.letter->letter))
        return false;
    if (!is_limit(written_, *statement_)) return false;
    line.status = LineStatus::not_about_scene;
    line.reason = say("the words state a condition for it; lines are judged for all motions");
    return true;
}

/// A letter of the author's for a place.
bool Marker::is_of_place(const Math& side) const {
    const auto name = letters_.name_of(side.letter);
    const auto known = name ? known_.find(*name) : known_.end();
    const Mechanism& m = system_.mechanism();
    return known != known_.end() && m.z->depends(known->second, m.q) && !m.z->depends(known->second, m.qdot);
}

/// A letter of the author's, or a multiplier: each law may say anew what it is.
bool Marker::is_unknown_force(const Letter& letter) const {
    const std::string name = letters_.name_of(letter).value_or("");
    return !letters_.is_of_scene(name) || is_multiplier(name);
}

/// U(θ) of which the words say so, or in which a momentum stands: no potential of the forces.
bool Marker::is_effective_potential(const Math& lhs, const Math& rhs) const {
    const Lone own = lone_letter(lhs);
    if (own.letter == nullptr || !own.letter->letter.index.empty()) return false;
    if (own.letter->letter.base != "U" && own.letter->letter.base != "V") return false;
    if (speaks_of_effective_potential(statement_->words)) return true;
    std::map<Letter, int> all;
    collect_letters(rhs, all);
    return std::any_of(all.begin(), all.end(), [&](const auto& item) {
        const std::string name = letters_.name_of(item.first).value_or("");
        const auto known = known_.find(name);  // a momentum that the author has named
        const bool is_momentum =
            known != known_.end() && system_.mechanism().z->depends(known->second, system_.mechanism().qdot);
        const bool is_quantity =
            quantity_of(item.first) && quantity_of(item.first) != MechanicalQuantity::momentum;
        return item.second == 0 && !is_quantity && !letters_.is_of_scene(name) &&
               (kept_.contains(name) || is_momentum);
    });
}

/// A letter of the author's for what changes in motion.
bool Marker::is_of_motion(const Math& side) const {
    const auto name = side.kind == Kind::letter ? letters_.name_of(side.letter) : std::nullopt;
    const auto known = name ? known_.find(*name) : known_.end();
    const Mechanism& m = system_.mechanism();
    return known != known_.end() && m.z->depends(known->second, m.qdot);
}

void Marker::judge(MarkedLine& line, const Math& lhs, const Math& rhs, Relation relation) {
    if (relation == Relation::proportional) {  // among words it states a condition
        if (!statement_->displayed && (holds_rates(lhs) || holds_letters_that_move(lhs)))
            heard_.put_under_condition();  // "while x' < 0"
        line.status = statement_->displayed ? LineStatus::not_understood : LineStatus::not_about_scene;
        line.reason = say("only equations are judged");
        return;
    }
    const bool displayed = statement_->displayed;
    if (states_general_law(lhs, letters_, displayed) || states_general_law(rhs, letters_, displayed)) {
        line.status = LineStatus::not_about_scene;
        line.reason = say("a law in general coordinates");
        heard_.no_accelerations = lhs.kind == Kind::letter && lhs.dots == 2 && rhs.kind == Kind::number;
        return;
    }
    if (judge_virtual(line, lhs, rhs) || is_frequency_equation(line, lhs, rhs)) return;
    if (is_condition_on_potential(line, lhs, rhs)) return;
    const Math& first = *statement_->sides.front();
    const bool ends_chain = &lhs != &first && rhs.kind == Kind::number && rhs.text == "0";
    if (ends_chain && is_condition_on_potential(line, first, rhs)) return;  // dV/dθ = … = 0
    if (is_effective_potential(lhs, rhs)) letters_.leave_to_author(lone_letter(lhs).letter->letter);
    if (is_of_limit(line, lhs)) return;
    if (is_of_state(line, lhs, rhs) || judge_value(line, lhs, rhs, relation)) return;
    if (judge_vector(line, lhs, rhs)) return;
    const bool is_period = heard_.period || (lhs.letter.base == "T" && holds_whole_turn(rhs));
    if (std::exchange(heard_.period, is_period); is_period && lhs.kind == Kind::letter) {
        if (is_frequency(line, lhs, rhs, 1)) return;
        if (lhs.letter == Letter{.base = "T"} && holds_whole_turn(rhs)) return define(line, lhs, rhs, 1);
    }
    const Lone lone = lone_letter(lhs);
    const bool is_again = lone.letter != nullptr && frequency_letters_.contains(lone.letter->letter) &&
                          is_frequency_again(line, *lone.letter, rhs, lone.power);  // of another state or case
    if (is_again) return;
    const bool is_reused =
        lone.letter != nullptr && heard_.frequency && is_of_motion(*lone.letter);  // ω has been a speed above
    if (is_reused && is_frequency(line, *lone.letter, rhs, lone.power)) return;
    try {
        if (introduce(line, lhs, rhs) || introduce(line, rhs, lhs, true)) return;
        judge_pair(line, lhs, rhs);
    } catch (const NoMeaning& reason) {
        if (reason.unknown && introduce_ahead(*reason.unknown)) return judge(line, lhs, rhs, relation);
        if (!reason.unknown || !find_meaning(line, lhs, rhs, *reason.unknown)) throw;
    }
}

Marker::Sides Marker::sides_of(const Math& lhs, const Math& rhs) const {
    const ClaimWriting as_is = as_written(), own = as_derived();
    return {
        &lhs, &rhs, claim_text(lhs, as_is), claim_text(rhs, as_is), claim_text(lhs, own), claim_text(rhs, own)};
}

ClaimWriting Marker::as_written() const {
    return {.letters = letters_,
            .steps = &held_,
            .displacements = displacements_,
            .speeds = &speeds_,
            .alone_is_quantity = notes_.back().alone_is_quantity,
            .rates_are_speeds = notes_.back().rates_are_speeds,
            .is_autonomous = is_autonomous_,
            .differentials_are_rates = notes_.back().differentials_are_rates,
            .slopes_are_of_motion = notes_.back().slopes_are_of_motion};
}

ClaimWriting Marker::as_derived() const {
    return {.letters = letters_,
            .steps = &own_.steps(),
            .displacements = displacements_,
            .speeds = &speeds_,
            .alone_is_quantity = notes_.back().alone_is_quantity,
            .rates_are_speeds = notes_.back().rates_are_speeds,
            .is_autonomous = is_autonomous_,
            .differentials_are_rates = notes_.back().differentials_are_rates,
            .slopes_are_of_motion = notes_.back().slopes_are_of_motion};
}

ex Marker::own_residual(const Sides& sides) {
    return own_.value(sides.own_left.text) - own_.value(sides.own_right.text);
}

void Marker::judge_pair(MarkedLine& line, const Math& lhs, const Math& rhs) {
    const Sides sides = sides_of(lhs, rhs);
    line.claim = sides.left.text + " = " + sides.right.text;
    notes_.back().claim = {.lhs = sides.left.text, .rhs = sides.right.text};
    if (has_potential_of_all_ && has_quantities(sides)) notes_.back().claim = {};  // the check has the scene's V
    notes_.back().left = sides.left;
    notes_.back().right = sides.right;
    const MotionRow row = system_.rows().row(truth_.value(sides.left.text) - truth_.value(sides.right.text));
    const std::optional<bool> holds = system_.rows().holds(row);
    if (!holds && says_rest() && (is_equilibrium(line, sides) || holds_at_rest(line, sides))) return;
    if (!holds) {
        line.reason = say("it could not be evaluated");
        return;
    }
    if (*holds)
        judge_true(line, sides, row);
    else
        judge_false(line, sides, row);
}

/// q' = ∂H/∂p, p' = −∂H/∂q: true of the scene's H whatever the author has found it to be.
bool Marker::is_law_of_hamilton(const Sides& sides) const {
    const auto is_slope = [&](const Math& side) {
        const Math& inner = side.kind == Kind::negate ? *side.args[0] : side;
        return inner.kind == Kind::partial && inner.args[0]->kind == Kind::letter &&
               letters_.name_of(inner.args[0]->letter) == letters_.name_of(MechanicalQuantity::hamiltonian);
    };
    return (is_slope(*sides.lhs) && is_rate_alone(*sides.rhs)) ||
           (is_rate_alone(*sides.lhs) && is_slope(*sides.rhs));
}

/// d/dt ∂L/∂q' = ∂L/∂q is right, and gives no equation of motion that is written out.
bool Marker::repeats_law(const Sides& sides) const {
    const auto is_law = [&](const std::string& name) {
        const auto is = [&](MechanicalQuantity quantity) { return name == letters_.name_of(quantity); };
        return name.starts_with("Q_") || is(MechanicalQuantity::kinetic) || is(MechanicalQuantity::potential) ||
               is(MechanicalQuantity::lagrangian) || is(MechanicalQuantity::energy) ||
               is(MechanicalQuantity::hamiltonian);
    };
    return std::any_of(sides.left.names.begin(), sides.left.names.end(), is_law) ||
           std::any_of(sides.right.names.begin(), sides.right.names.end(), is_law);
}

bool Marker::has_quantities(const Sides& sides) const {
    std::set<std::string> energies;
    for (const MechanicalQuantity quantity :
         {MechanicalQuantity::kinetic, MechanicalQuantity::potential, MechanicalQuantity::lagrangian,
          MechanicalQuantity::energy, MechanicalQuantity::hamiltonian})
        energies.insert(letters_.name_of(quantity));
    const auto is_one = [&](const std::string& name) {
        const bool is_along = name.starts_with("p_") || name.starts_with("Q_");
        return known_.contains(name) && (is_along || energies.contains(name));
    };
    return std::any_of(sides.left.names.begin(), sides.left.names.end(), is_one) ||
           std::any_of(sides.right.names.begin(), sides.right.names.end(), is_one);
}

/// Q = 0, of rest
bool Marker::is_balance(const Sides& sides) const {
    return is_lone_force(*sides.lhs) && is_number(*sides.rhs);
}

/// Newton's law of a part, p' = …, what an energy is in letters: a law that no other line has to give, so that no
/// mistake above says anything about it.
bool Marker::stands_by_itself(const Sides& sides, bool is_identity) const {
    if (is_new_law_ || (!is_identity && repeats_law(sides))) return true;
    const Mechanism& m = system_.mechanism();
    const std::set<std::string> names = sides.own_names();
    const bool has_force = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        const auto known = known_.find(name);
        const bool is_force = known != known_.end() && (m.z->depends(known->second, m.qddot) ||
                                                        m.z->depends(known->second, system_.equations().lambda));
        return is_multiplier(name) || is_force;
    });
    const auto is_rate_of_momentum = [&](const Math& side) {
        if (!is_rate_alone(side)) return false;
        const Letter& letter = side.kind == Kind::rate ? side.args[0]->letter : side.letter;
        const std::string name = letters_.name_of(letter).value_or("");
        return name.starts_with("p_") && !letters_.is_of_scene(name);
    };
    const bool is_momentum_law = is_rate_of_momentum(*sides.lhs) || is_rate_of_momentum(*sides.rhs);
    const Lone lone = lone_letter(*statement_->sides.front());
    const bool is_energy = lone.letter != nullptr && quantity_of(lone.letter->letter) && is_identity;
    return has_force || is_balance(sides) || is_momentum_law || is_energy;
}

void Marker::judge_true(MarkedLine& line, const Sides& sides, const MotionRow& row) {
    if (is_wrong_derivative(line, sides)) return;
    line.status = LineStatus::right;
    MotionRows& rows = system_.rows();
    const bool is_identity = rows.is_identity(row) == true;
    const MotionRow own = rows.row(own_residual(sides));
    if (is_law_of_hamilton(sides)) return;
    note_forces(sides);
    if (!is_identity && !repeats_law(sides)) notes_.back().equation = row;
    const std::optional<std::size_t> wrong = own_.wrong_in(sides.own_names());
    const bool has_mistake = std::any_of(lines.begin(), lines.end(), [](const MarkedLine& one) {
        return one.status == LineStatus::mistake || one.status == LineStatus::follows;
    });
    if (!has_mistake) return note_reduced(sides, row);  // nothing stands above from which it could not follow
    if (stands_by_itself(sides, is_identity)) return note_reduced(sides, row);
    const bool founded =
        is_identity ? !wrong || rows.is_identity(own) == true : own_.founds(own) || own_.founds(row);
    if (founded) return note_reduced(sides, row);
    line.status = LineStatus::unfounded;
    line.follows_from = wrong;
    line.reason = say("it is right, but it does not follow from what stands above");
}

void Marker::judge_false(MarkedLine& line, const Sides& sides, const MotionRow& row) {
    if (is_balance(sides)) heard_.assumed_rest = true;
    if (is_approximation(line, sides) || is_of_own_gauge(line, sides) || is_energy_of_part(line, sides) ||
        (is_aside() && is_assumption(line, sides)) || holds_after_impact(line, sides) ||
        is_assumption(line, sides) || is_reduced_momentum(line, sides))
        return;
    if (is_of_quantity(line, sides) || is_in_independent_rates(line, sides) || is_along_motion(line, sides) ||
        is_equilibrium(line, sides) || is_given_value(line, sides) || is_on_branch(line, sides) ||

        holds_with_all_forces(line, sides) || holds_up_to(line, sides, row.residual) ||
        holds_at_rest(line, sides) || holds_at_some_rest(line, sides) || holds_near(line, sides, row.residual) ||
        holds_near_some_rest(line, row.residual) || follows(line, sides) || follows_with_all_forces(line, sides) ||
        follows_from_inertia(line, sides))
        return;
    if (deviates_from_motion()) {
        line.status = LineStatus::undecided;
        line.reason = say("the state from which it deviates is no state of rest");
        notes_.back().claim = {};
        return;
    }
    line.status = LineStatus::mistake;
    if (heard_.small) notes_.back().near = near_;
    if (own_.wrong_in(sides.own_names())) notes_.back().own = own_.values();
}

/// p' = −∂H/∂q and q' = ∂H/∂p with the author's own H.
bool Marker::is_from_own_hamiltonian(MarkedLine& line, const Sides& sides) {
    const Math& rate = is_rate_alone(*sides.lhs) ? *sides.lhs : *sides.rhs;
    const std::string& value = &rate == sides.lhs ? sides.own_right.text : sides.own_left.text;
    if (!is_rate_alone(rate)) return false;
    const Letter& letter = rate.kind == Kind::rate ? rate.args[0]->letter : rate.letter;
    const std::string name = letters_.name_of(letter).value_or(""),
                      H = letters_.name_of(MechanicalQuantity::hamiltonian);
    const bool is_momentum = name.starts_with("p_") && !letters_.is_of_scene(name);
    const std::string key =
        is_momentum ? "diff(" + H + "," + name.substr(2) + ")" : "diff(" + H + ",p_" + name + ")";
    const auto step = own_.steps().find(key);
    if (step == own_.steps().end() || !own_.is_wrong_step(key)) return false;
    MotionRows& rows = system_.rows();
    const ex slope = own_.value(step->second);
    if (rows.is_identity(rows.row((is_momentum ? -slope : slope) - own_.value(value))) != true) return false;
    line.follows_from = own_.wrong_in({step->second});
    line.status = LineStatus::follows;
    line.reason = say("it follows from line {}", lines[*line.follows_from].line);
    return true;
}

/// Whether both, at rest, are the same condition but for a factor without coordinates.
bool Marker::is_same_at_rest(const ex& residual, const ex& other) const {
    const Mechanism& m = system_.mechanism();
    const auto numerator = [&](const ex& of) {
        const ex argument = GiNaC::wild(0);
        const ex whole = m.z->expand(system_.at_rest({of})[0]);
        return whole.subs(GiNaC::tan(argument) == GiNaC::sin(argument) / GiNaC::cos(argument)).normal().numer();
    };
    constexpr double most_at_rest = 1000;  // nodes
    if (m.z->tree_size(residual) + m.z->tree_size(other) > most_at_rest) return false;
    const ex a = numerator(residual), b = numerator(other);
    if (a.is_zero() || b.is_zero()) return false;
    return std::all_of(m.q.begin(), m.q.end(), [&](const GiNaC::symbol& q) {
        return is_identically_zero(m.z->name(a * b.diff(q) - b * a.diff(q)), m);
    });
}

bool Marker::follows(MarkedLine& line, const Sides& sides) {
    MotionRows& rows = system_.rows();
    const MotionRow own = rows.row(own_residual(sides));
    line.follows_from =
        rows.is_identity(own) == true ? own_.wrong_in(sides.own_names()) : own_.explained_by(own, heard_.small);
    if (!line.follows_from) line.follows_from = own_.explained_by_relations(own.residual);
    if (!line.follows_from && is_from_own_hamiltonian(line, sides)) return true;
    if (!line.follows_from && heard_.small) {
        const BaseState base = near_ ? *near_ : base_states(system_.scene()).front();
        line.follows_from = own_.explained_by_linearizing(
            own.residual, [&](const ex& e) { return linear_part(e, base, system_); });
    }
    const bool is_of_rest = says_rest() && !holds_rates(*sides.lhs) && !holds_rates(*sides.rhs);
    if (!line.follows_from && is_of_rest)
        line.follows_from = own_.explained_at_rest([&](const ex& e) { return is_same_at_rest(own.residual, e); });
    if (!line.follows_from) return false;
    line.status = LineStatus::follows;
    line.reason = say("it follows from line {}", lines[*line.follows_from].line);
    return true;
}

}  // namespace alembert
