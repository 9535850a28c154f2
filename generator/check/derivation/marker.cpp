// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/marker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/language/say.hpp"
#include "check/derivation/general_law.hpp"
#include "check/derivation/parts.hpp"
#include "check/derivation/sines_by_index.hpp"
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
    find_moving_letters();
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
    bind_sines_by_index();
}

void Marker::bind_sines_by_index() {
    for (const auto& [letter, value] : sines_by_index(written_, letters_, system_.scene())) {
        bind(letter, truth_.value(value));
        remarks_.push_back(say("{} is read as {}", identifier_of(letter), value));
    }
}

void Marker::find_moving_letters() {
    const auto moves = [this](const Math& value) {
        std::map<Letter, int> all;
        collect_letters(value, all);
        return value.kind != Math::Kind::letter && std::any_of(all.begin(), all.end(), [this](const auto& item) {
                   const auto name = letters_.name_of(item.first);
                   return name && item.second == 0 && letters_.is_of_scene(*name) && letters_.moves(*name);
               });
    };
    for (const WrittenStatement& statement : written_.statements) {
        if (statement.sides.size() < 2) continue;
        const Math& side = *statement.sides[0];
        if (side.kind == Math::Kind::letter && side.dots == 0 && !side.letter.index.empty() &&
            !letters_.name_of(side.letter) && moves(*statement.sides[1]))
            moving_letters_.insert(side.letter);
    }
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
        const bool is_behind_display =
            s > 0 && written_.statements[s - 1].displayed && holds_letters(statement_->words);
        if (is_behind_display || (ends_sentence(statement_->words) && !goes_on_with_case(statement_->words)))
            stated_place_.clear();
        special_.hear_end(statement_->words);
        said_before_ = heard_.around;
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
        note_rates();
    }
}

/// Rest, small motions, a start, values of parameters, a place, a single motion: after these a formula need not be
/// about all motions.
bool Marker::assumes() const {
    const bool is_of_state = says_rest() || heard_.roots || heard_.no_accelerations || heard_.steady_lines > 0;
    const bool is_of_case =
        heard_.condition_lines > 0 || heard_.condition_behind || !special_.empty() || !stated_place_.empty();
    const bool is_near = heard_.small || heard_.approximate_lines > 0 || heard_.frequency || heard_.period;
    const bool is_of_motion = heard_.start_from_rest || heard_.mentioned_impact || !motion_letters_.empty();
    const bool has_left_scene = std::any_of(lines.begin(), lines.end(), [](const MarkedLine& line) {
        return line.status == LineStatus::not_about_scene;
    });
    return is_of_state || is_of_case || is_near || is_of_motion || has_left_scene;
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
    has_assumed_ = has_assumed_ || assumes();
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
    if (!is_limit(written_, *statement_, beside_formula)) return false;
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
    if (lists_coordinates(lhs, rhs)) {
        line.status = LineStatus::definition;
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

}  // namespace alembert
