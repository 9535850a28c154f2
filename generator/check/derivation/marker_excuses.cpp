// SPDX-License-Identifier: GPL-2.0-or-later
// What would be a mistake of all motions, but is meant otherwise: under a condition, of one motion, for special
// values, of a part. A line is a mistake only under every reading.
#include "check/derivation/marker.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "check/written/surroundings.hpp"
#include "check/written/word_kinds.hpp"
#include "check/written/words.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

bool is_letter_t(const Math& math) {
    return math.kind == Kind::letter && math.letter == Letter{.base = "t"};
}

/// x(t)
bool is_at_time(const Math& math) {
    return math.kind == Kind::applied && math.args.size() == 1 && is_letter_t(*math.args[0]);
}

/// t itself, and not as in θ(t).
bool speaks_of_time(const Math& math) {
    if (is_letter_t(math)) return true;
    return !is_at_time(math) && std::any_of(math.args.begin(), math.args.end(),
                                            [](const MathPtr& arg) { return speaks_of_time(*arg); });
}

}  // namespace

/// A coordinate that the scene itself drives: φ = Ω t of a constraint.
bool Marker::keeps_to_time(const Math& lhs, const Math& rhs) {
    const Sides sides = sides_of(lhs, rhs);
    MotionRows& rows = system_.rows();
    return rows.holds(rows.row(truth_.value(sides.left.text) - truth_.value(sides.right.text))) == true;
}

/// x = ½ a t², θ = A cos ω t: one motion of a system that does not change with time. Letters such as A, which no
/// equation gives, speak of that motion from then on.
bool Marker::is_of_one_motion(const Math& lhs, const Math& rhs) {
    std::map<Letter, int> all;
    collect_letters(lhs, all);
    collect_letters(rhs, all);
    const Lone lone = lone_letter(lhs);
    if (lone.letter != nullptr && !speaks_of_time(rhs))
        motion_letters_.erase(lone.letter->letter);  // "with ω_1 = …"
    if (std::any_of(all.begin(), all.end(),
                    [&](const auto& item) { return motion_letters_.contains(item.first); }))
        return true;
    const bool is_value = lhs.kind == Kind::letter || is_at_time(lhs);
    const auto name = is_value ? letters_.name_of(lhs.letter) : std::nullopt;
    const std::vector<std::string>& coordinates = letters_.coordinates();
    const bool is_own = is_value && is_of_place(lhs);  // u of y = y_s + u
    const bool is_coordinate =
        name && std::find(coordinates.begin(), coordinates.end(), *name) != coordinates.end();
    const bool is_particular = is_value && !name && speaks_of_solution(statement_->words);  // r_p
    if (!is_own && !is_coordinate && !is_particular) return false;
    if (!speaks_of_time(rhs)) return false;
    std::set<Letter> unknown;
    for (const auto& [letter, dots] : all)
        if (!letters_.name_of(letter) && letter != Letter{.base = "t"}) unknown.insert(letter);
    if (!is_autonomous_ && unknown.empty() && (!is_coordinate || keeps_to_time(lhs, rhs))) return false;
    for (const auto& [letter, dots] : all)
        if (quantity_of(letter) && letter.base == "U" && letter.index.empty())
            unknown.insert(letter);  // u = U cos Ω t
    for (const Letter& letter : unknown) {
        motion_letters_.insert(letter);
        if (quantity_of(letter)) letters_.leave_to_author(letter);
    }
    return true;
}

/// The letter of an angle in it of which only the rate is known, if it stands there without a dot.
const Letter* Marker::place_of_rate(const Math& math) const {
    if (math.kind == Kind::letter && math.dots == 0 && of_rate_.contains(math.letter)) return &math.letter;
    for (const MathPtr& arg : math.args)
        if (const Letter* const found = place_of_rate(*arg)) return found;
    return nullptr;
}

/// The reason why a line that does not hold on all motions may yet be meant rightly; nothing if there is none.
std::optional<std::string> Marker::excuse(const MarkedLine& line, const Math& lhs, const Math& rhs) {
    if (statement_->in_words && system_.scene().particles.size() + system_.scene().bodies.size() > 1)
        return say("the words may mean the energy of a part");
    const ex kept = kept_of(lhs, rhs);
    const bool may_be_shifted =
        system_.mechanism().z->depends(kept, system_.mechanism().qddot) || does_not_change(kept);
    for (const Math* const side : {&lhs, &rhs})
        if (const Letter* const letter = place_of_rate(*side); letter != nullptr && may_be_shifted)
            return say("of {} only the rate has been stated", identifier_of(*letter));
    const Lone last = lone_letter(*statement_->sides.back());
    if (last.letter != nullptr && is_word_for_constant(last.letter->letter.base))
        for (const Math* const side : {&lhs, &rhs})
            if (side->kind == Math::Kind::letter && side->dots > 0 && quantity_of(side->letter))
                return say("the prime may be a part of the letter");  // T + V = E' = const
    if (speaks_of_other_system(statement_->words)) return say("the words speak of another system");
    const std::size_t masses = system_.scene().particles.size() + system_.scene().bodies.size();
    const bool is_numbered = lhs.kind == Kind::letter && lhs.dots == 0 && !lhs.letter.index.empty() &&
                             lhs.letter.index.find_first_not_of("0123456789") == std::string::npos;
    if (is_numbered && masses < 2 && std::string("TVKUEL").find(lhs.letter.base) != std::string::npos)
        return say("the number may mean a state");  // T_1 after the impact
    const Lone lone = lone_letter(lhs);
    const bool is_own = lone.letter != nullptr && !quantity_of(lone.letter->letter) &&
                        !letters_.is_of_scene(letters_.name_of(lone.letter->letter).value_or(""));
    if (is_own && !special_.empty() && line.reason.empty())  // no frequency, which is judged for all cases
        return say("it may hold for values of parameters that stand above");
    if (is_lone_force(lhs) && names_part_of_forces(heard_.around))
        return say("the words speak of a part of the forces");
    if (is_autonomous_ && (speaks_of_time(lhs) || speaks_of_time(rhs)))
        return say("it describes one motion; lines are judged for all motions");
    if (relation_ == Relation::approximately && has_quantities(sides_of(lhs, rhs)) &&
        !system_.equations().A.empty())
        return say("an approximation of energies on constraints is not judged");
    for (const Mechanism::Input& input : system_.mechanism().inputs)
        for (const GiNaC::symbol& derivative : input.derivative)
            if (special_.contains(derivative))
                return say("it may hold for the inputs that stand above; lines are judged for those of the scene");
    // T and V are what they are in every state, but not for every value of the parameters.
    const bool is_energy = lhs.kind == Kind::letter && lhs.dots == 0 && quantity_of(lhs.letter).has_value() &&
                           !letters_.is_of_scene(letters_.name_of(lhs.letter).value_or(""));
    const bool is_rest_alone = heard_.rest && !holds_rates(lhs) && !holds_rates(rhs) && !statement_->displayed &&
                               system_.mechanism().size() > 1;
    const bool is_steady = heard_.steady_lines > 0 && !is_accelerated(lhs) && !is_accelerated(rhs) &&
                           !has_quantities(sides_of(lhs, rhs));
    const bool is_approximate = heard_.approximate_lines > 0 && !has_quantities(sides_of(lhs, rhs));
    const bool is_of_place = !statement_->displayed && ends_at_place(statement_->words);  // "at the bottom"
    const bool is_conditional =
        is_of_place || heard_.condition_lines > 0 || is_rest_alone || is_steady || is_approximate;
    if (!is_energy && is_conditional)
        return say("the words state a condition for it; lines are judged for all motions");
    if (is_own && !statement_->displayed && is_number(rhs) &&
        is_of_parameters(truth_.value(claim_text(lhs, as_written()).text)))
        return say("a value in numbers; lines are judged for all values");  // W = 1 of W = m g l
    if (keeps_its_start(lhs, rhs)) {
        is_of_special_start_ = true;
        note_start(kept_of(lhs, rhs));
        return say("it keeps its value, and holds for motions that start so");
    }
    const bool may_use_start = is_of_special_start_ && !is_energy && !is_accelerated(lhs) &&
                               !is_accelerated(rhs) && !has_quantities(sides_of(lhs, rhs));
    if (may_use_start || (!is_energy && follows_from_start(lhs, rhs)))
        return say("it may hold for motions that start as the lines above say");
    if (!statement_->displayed && states_relation_of_constants(lhs, rhs)) {
        heard_.put_under_condition();
        return say("a condition on parameters; lines are judged for all their values");
    }
    return std::nullopt;
}

/// ω_1 = 2 ω_2 among words: constants of the author's, which may be so for some values of the parameters.
bool Marker::states_relation_of_constants(const Math& lhs, const Math& rhs) {
    const Sides sides = sides_of(lhs, rhs);
    const bool is_own =
        std::any_of(sides.left.names.begin(), sides.left.names.end(),
                    [&](const std::string& name) { return known_.contains(name) && !letters_.is_of_scene(name); });
    return is_own && !has_quantities(sides) && is_of_parameters(truth_.value(sides.left.text)) &&
           is_of_parameters(truth_.value(sides.right.text)) &&
           ((lhs.kind == Kind::letter && rhs.kind == Kind::letter) || speaks_of_special_case(statement_->words));
}

/// A mistake only under every reading.
void Marker::weigh_condition(MarkedLine& line, const Math& lhs, const Math& rhs) {
    if (line.status != LineStatus::mistake && line.status != LineStatus::follows) return;
    if (holds_with_slopes(line, lhs, rhs)) return;
    if (is_limit(written_, *statement_, within_sentence)) {
        line.status = LineStatus::not_about_scene;
        line.reason = say("the words state a condition for it; lines are judged for all motions");
        line.follows_from.reset();
        notes_.back().claim = {};
        return;
    }
    const Sides sides = sides_of(lhs, rhs);
    if (follows_in_special_case(truth_.value(sides.left.text) - truth_.value(sides.right.text))) {
        const LineStatus before = line.status;
        settle_in_special_case(line);
        if (line.status != before) return;
    }
    if (holds_from_start(kept_of(lhs, rhs))) {
        line.status = LineStatus::right;
        line.reason = say("of the motion that starts there from rest");
        line.follows_from.reset();
        notes_.back().claim = {};
        return;
    }
    if (!statement_->displayed && is_condition_of_parameters(sides)) {
        take_in_relation(lhs, rhs);
        line.status = LineStatus::not_about_scene;
        line.reason = say("a condition on parameters; lines are judged for all their values");
        line.follows_from.reset();
        notes_.back().claim = {};
        return;
    }
    if (!statement_->displayed && lhs.kind == Kind::letter && lhs.dots == 0 && rhs.kind == Kind::number &&
        rhs.text == "0" && sets_a_condition_behind(heard_.behind)) {
        line.status = LineStatus::not_about_scene;
        line.reason = say("it describes a state; lines are judged for all motions");
        line.follows_from.reset();
        notes_.back().claim = {};
        return;
    }
    if (holds_at_stated_place(sides)) {
        line.status = LineStatus::right;
        line.reason = is_place_held_ ? say("held where {}", told_values(stated_place_))
                                     : say("where {}", told_values(stated_place_));
        line.follows_from.reset();
        notes_.back().claim = {};
        return;
    }
    if (line.status != LineStatus::mistake) return;
    if (holds_to_digits(sides)) {
        line.status = LineStatus::right;
        line.reason = say("to the digits that are written");
        notes_.back().claim = {};
        return;
    }
    if (holds_at_pose(sides)) {
        line.status = LineStatus::right;
        line.reason = say("at the pose of the impact");
        notes_.back().claim = {};
        return;
    }
    if (notes_.back().is_sure || is_of_rest_unsaid(line, sides)) return;
    const std::optional<std::string> reason = excuse(line, lhs, rhs);
    if (!reason) return;
    line.status = LineStatus::not_about_scene;
    line.reason = *reason;
    line.claim.clear();
}

/// k l_0 = 3 m g among words: of parameters of the scene alone.
bool Marker::is_condition_of_parameters(const Sides& sides) {
    const auto is_parameter = [&](const std::string& name) {
        return letters_.is_of_scene(name) && !letters_.moves(name) && !letters_.is_function(name) &&
               !is_multiplier(name);
    };
    const auto are = [&](const ClaimText& side) {
        return std::all_of(side.names.begin(), side.names.end(), is_parameter);
    };
    return are(sides.left) && are(sides.right) && !(sides.left.names.empty() && sides.right.names.empty());
}

/// m g l sin φ = 0 without a word of rest: what holds at rest, and fails in motion for want of accelerations
/// alone.
bool Marker::is_of_rest_unsaid(MarkedLine& line, const Sides& sides) {
    const Mechanism& m = system_.mechanism();
    const bool is_slope = sides.lhs->kind == Kind::partial && says_rest();  // d²V/dθ² = … at equilibrium
    if (displacements_ != nullptr || (has_quantities(sides) && !is_slope)) return false;
    if (holds_rates(*sides.lhs) || holds_rates(*sides.rhs) || speaks_of_motion(statement_->words)) return false;
    const ex residual = truth_.value(sides.left.text) - truth_.value(sides.right.text);
    if (!m.z->depends(residual, m.q) || m.z->depends(residual, m.qdot) || m.z->depends(residual, m.qddot))
        return false;
    std::string reason;
    const RestStates::About about{.names_place = names_coordinate(*sides.lhs) || names_coordinate(*sides.rhs),
                                  .of_number = is_number(*sides.lhs) || is_number(*sides.rhs)};
    const auto found =
        found_at_rest([&](RestStates& states) { return states.vanishes(residual, about); }, true, reason);
    if (found != RestStates::Found::everywhere && (is_slope || found != RestStates::Found::on_branch))
        return false;
    line.status = is_slope ? LineStatus::right : LineStatus::not_about_scene;
    line.reason = is_slope ? reason : say("it holds at states of rest; whether they are meant is not said");
    notes_.back().claim = {};
    line.claim.clear();
    return true;
}

/// left − right, of squares where a root stands: s' = √(2 a s).
ex Marker::kept_of(const Math& lhs, const Math& rhs) {
    const ex left = truth_.value(claim_text(lhs, as_written()).text),
             right = truth_.value(claim_text(rhs, as_written()).text);
    return holds_root(lhs) || holds_root(rhs) ? GiNaC::pow(left, 2) - GiNaC::pow(right, 2) : left - right;
}

/// Whether it keeps its value on all motions.
bool Marker::does_not_change(const ex& expression) {
    const ex rate = system_.mechanism().time_derivative({expression})[0];
    return system_.rows().holds(system_.rows().row(rate)) == true;
}

/// U''(r_0): what is the case at a place is so in all motions.
bool Marker::is_of_derivative_at_place(const Math& side) const {
    const bool is_there =
        side.kind == Kind::applied && side.dots > 0 && side.args.size() == 1 && side.args[0]->kind == Kind::letter;
    return is_there && is_value_of_state(side.args[0]->letter);
}

/// (M + m) x' + m l θ' cos θ = 0 of a motion that starts from rest: the rate of left − right vanishes on all
/// motions.
bool Marker::keeps_its_start(const Math& lhs, const Math& rhs) {
    if (displacements_ != nullptr) return false;
    const Mechanism& m = system_.mechanism();
    const ex residual = kept_of(lhs, rhs);
    const bool changes = m.z->depends(residual, m.q) || m.z->depends(residual, m.qdot);
    std::vector<GiNaC::symbol> state = m.q;
    state.insert(state.end(), m.qdot.begin(), m.qdot.end());
    const std::vector<ex> slopes = m.z->pull_back({{residual, 1}}, state);
    const bool is_constant = std::all_of(
        slopes.begin(), slopes.end(), [&](const ex& slope) { return is_identically_zero(m.z->name(slope), m); });
    const bool may_be_shifted = lhs.kind == Kind::letter && lhs.dots == 0;  // y = −l cos φ of another origin
    if (!changes || (is_constant && !may_be_shifted) || m.z->depends(residual, m.qddot) ||
        is_of_derivative_at_place(lhs))
        return false;
    MotionRows& rows = system_.rows();
    if (rows.holds(rows.row(residual)) == true) return false;  // it is wrong in another way
    return does_not_change(residual);
}

/// x' = ω y of such a motion: one of the rates by the others, for the lines that put it into an equation.
void Marker::note_start(const ex& kept) {
    const Mechanism& m = system_.mechanism();
    const std::vector<ex> slopes = m.z->pull_back({{kept, 1}}, m.qdot);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        if (slopes[i].is_zero() || !is_of_parameters(slopes[i])) continue;
        start_rates_[m.qdot[i]] = m.z->expand(m.qdot[i] - kept / slopes[i]);
        return;
    }
}

bool Marker::follows_from_start(const Math& lhs, const Math& rhs) {
    return !start_rates_.empty() && displacements_ == nullptr && follows_with(kept_of(lhs, rhs), start_rates_);
}

/// The same of a start at rest at θ_0, where it holds too: θ'² = 2 g (cos θ − cos θ_0)/l.
bool Marker::keeps_its_start_at(const ex& residual, const Math& lhs, const Math& rhs) {
    const Mechanism& m = system_.mechanism();
    if (displacements_ != nullptr || m.z->depends(residual, m.qddot)) return false;
    const ex kept = kept_of(lhs, rhs);
    GiNaC::exmap start;
    for (const GiNaC::symbol& rate : m.qdot) start[rate] = 0;
    for (const auto& [letter, coordinate] : places_) start[coordinate] = letter;
    if (!vanishes_at(kept, start)) return false;
    if (is_identically_zero(m.z->name(kept), m)) return false;
    return does_not_change(kept);
}

/// θ'² = g (cos θ − cos θ_0)/l of a motion that the words start from rest: with one degree of freedom and a
/// constant energy the rate is known where the start is.
bool Marker::is_wrong_energy_of_start(const ex& residual, const Math& lhs, const Math& rhs) {
    const Mechanism& m = system_.mechanism();
    const bool has_one = m.size() == static_cast<int>(system_.equations().A.size()) + 1 && places_.size() == 1;
    if (!heard_.start_from_rest || !has_one || !m.z->depends(residual, m.qdot) || m.z->depends(residual, m.qddot))
        return false;
    const bool is_of_instant = !m.z->depends(residual, m.q);  // the rate where it leaves the wall
    if (is_of_instant || (!holds_rates(lhs) && !holds_rates(rhs))) return false;
    return does_not_change(truth_.value(letters_.name_of(MechanicalQuantity::energy)));
}

/// The rates that are zero just after the scene's impulses.
const std::vector<GiNaC::symbol>& Marker::still_after_impact() {
    if (still_after_impact_) return *still_after_impact_;
    still_after_impact_.emplace();
    for (const GiNaC::symbol& rate : system_.mechanism().qdot) {
        const std::vector<CheckedClaim> verdicts =
            checked_alone({.lhs = rate.get_name(), .rhs = "0", .at_impact = true});
        if (!verdicts.empty() && verdicts[0].verdict == Verdict::proved) still_after_impact_->push_back(rate);
    }
    return *still_after_impact_;
}

/// Velocities, displacements and energies of an impact may be written for the pose in which it happens.
bool Marker::holds_at_pose(const Sides& sides) {
    const bool is_of_motion = displacements_ != nullptr || holds_rates(*sides.lhs) || holds_rates(*sides.rhs);
    if (system_.scene().impulses.empty() || !is_of_motion) return false;
    const Mechanism& m = system_.mechanism();
    GiNaC::exmap pose;
    for (const Coordinate& c : system_.scene().coordinates)
        for (const GiNaC::symbol& q : m.q)
            if (q.get_name() == c.name.text && c.initial) pose[q] = truth_.value(c.initial);
    for (const GiNaC::symbol& rate : still_after_impact()) pose[rate] = 0;
    const ex left = truth_.value(sides.left.text), right = truth_.value(sides.right.text);
    if (m.z->depends(left - right, m.qddot)) return false;
    return vanishes_at(left - right, pose) ||
           vanishes_at(GiNaC::pow(left, 2) - GiNaC::pow(right, 2), pose);  // a speed has no sign
}

}  // namespace alembert
