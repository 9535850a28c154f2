// SPDX-License-Identifier: GPL-2.0-or-later
// Formulas that state one moment, a condition or a number of an equation, and so nothing of all motions: theta(0)
// = 0.2, theta = theta_0, "at theta = pi/2 we have", (4) = (2) cos(theta) + (3) sin(theta).
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <cctype>

#include "base/language/say.hpp"
#include "check/written/surroundings.hpp"
#include "check/written/words.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

/// (4) = (2)cos θ + (3)sin θ: numbers of equations in parentheses.
bool speaks_of_numbered_equations(const std::string& source) {
    int numbered = 0;
    for (std::size_t at = source.find('('); at != std::string::npos; at = source.find('(', at + 1)) {
        std::size_t end = at + 1;
        while (end < source.size() && std::isdigit(static_cast<unsigned char>(source[end])) != 0) ++end;
        const bool follows_letter = at > 0 && std::isalpha(static_cast<unsigned char>(source[at - 1])) != 0;
        if (end > at + 1 && end < source.size() && source[end] == ')' && !follows_letter) ++numbered;
    }
    return numbered > 1 && source.find('(') == source.find_first_not_of(" {\\quad");
}

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

/// α' = 0, α' = α'': rates alone, and zero.
bool are_rates_at_rest(const Math& lhs, const Math& rhs) {
    const auto is_zero = [](const Math& side) { return side.kind == Kind::number && side.text == "0"; };
    const auto is_rate = [](const Math& side) { return side.kind == Kind::letter && side.dots > 0; };
    return (is_rate(lhs) || is_zero(lhs)) && (is_rate(rhs) || is_zero(rhs)) && (is_rate(lhs) || is_rate(rhs));
}

}  // namespace

/// "In steady motion", "if the wedge is held": what is said then holds under a condition, until the sentence ends.
void Marker::hear_conditions(const std::string& words) {
    if (under_condition_ > 0 && !goes_on_) --under_condition_;
    if (ends_sentence(words)) under_condition_ = 0;
    if (is_limit(written_, *statement_) || speaks_of_special_motion(words) || states_condition(words))
        under_condition_ = lines_of_condition;
    speaks_of_impact_ = speaks_of_impact_ || alembert::speaks_of_impact(said_);
    mentions_impact_ = mentions_impact_ || mentions_impact(said_);
    from_rest_ = from_rest_ || speaks_of_start_from_rest(words);
}

/// θ₀ where θ is a coordinate and the scene has no θ₀.
bool Marker::is_value_of_state(const Letter& letter) const {
    if (letters_.name_of(letter) || letter.index.empty()) return false;
    static const std::set<std::string> indices{"0", "eq", "e", "s", "st", "max", "min", "i", "f", "(0)", "star"};
    Letter plain = letter;
    plain.index.clear();
    const auto name = letters_.name_of(plain);
    return indices.contains(letter.index) && name && letters_.is_of_scene(*name) && letters_.moves(*name);
}

bool Marker::is_input(const std::string& name) const {
    const std::vector<Input>& all = system_.scene().inputs;
    return std::any_of(all.begin(), all.end(), [&](const Input& input) { return name == input.name.text; });
}

/// m_1 = m_2, I = 0, M → ∞: parameters of the scene alone, which would be numbers otherwise.
bool Marker::states_special_case(const Math& lhs, const Math& rhs, const std::map<Letter, int>& all) const {
    const auto is_parameter = [&](const Letter& letter) {
        const auto name = letters_.name_of(letter);
        return name && letters_.is_of_scene(*name) && (is_input(*name) || !letters_.moves(*name)) &&
               !letters_.is_function(*name);
    };
    const bool is_said = !statement_->displayed && speaks_of_special_case(statement_->words);  // "for ω² = 2 g c"
    if (all.empty() || (lhs.kind != Kind::letter && rhs.kind != Kind::letter && !is_said)) return false;
    return std::all_of(all.begin(), all.end(),
                       [&](const auto& item) { return item.second == 0 && is_parameter(item.first); });
}

/// x = ½ a t², θ = A cos ω t: one motion of a system that does not change with time.
bool Marker::is_of_one_motion(const Math& lhs, const Math& rhs) {
    const bool is_value = lhs.kind == Kind::letter || is_at_time(lhs);
    const auto name = is_value ? letters_.name_of(lhs.letter) : std::nullopt;
    const std::vector<std::string>& coordinates = letters_.coordinates();
    if (!name || std::find(coordinates.begin(), coordinates.end(), *name) == coordinates.end()) return false;
    if (!speaks_of_time(rhs)) return false;
    return is_autonomous_;
}

/// "Set α' = 0", "in steady rotation α' = α'' = 0", or the whole chain of rates that is set to zero.
bool Marker::assumes_rest() const {
    const bool is_chain = statement_->sides.size() > 2 && statement_->sides.back()->kind == Kind::number;
    return is_chain || is_rest_assumed_ || says_rest() || sets_value(statement_->words) ||
           speaks_of_special_motion(statement_->words) || begins_condition_of_state(statement_->words);
}

/// μ = m_1 m_2/(m_1 + m_2) where the scene has it so.
bool Marker::is_parameter_identity(const Math& lhs, const Math& rhs) {
    const ex left = truth_.value(claim_text(lhs, as_written()).text),
             right = truth_.value(claim_text(rhs, as_written()).text);
    MotionRows& rows = system_.rows();
    return rows.is_identity(rows.row(left - right)) == true;
}

/// Whether the line states one moment or a condition; then it is told so.
bool Marker::is_of_state(MarkedLine& line, const Math& lhs, const Math& rhs) {
    const MarkedLine before = line;
    const auto tell = [&](std::string reason) {
        line.status = LineStatus::not_about_scene;
        line.reason = std::move(reason);
        return true;
    };
    if (are_rates_at_rest(lhs, rhs) && assumes_rest()) {
        is_rest_assumed_ = true;
        return tell(say("a state of rest"));
    }
    if (conditioned_behind_)
        return tell(say("the words state a condition for it; lines are judged for all motions"));
    if (denies(statement_->words)) return tell(say("the words say that it does not hold"));
    if (speaks_of_numbered_equations(written_.text.substr(statement_->offset, statement_->length)))
        return tell(say("it speaks of equations by their numbers"));
    if (says_rest() && is_lone_force(lhs) && rhs.kind == Kind::number && rhs.text == "0")
        return tell(say("a state of rest"));
    if (is_of_one_motion(lhs, rhs)) return tell(say("it describes one motion; lines are judged for all motions"));
    for (const Math* side : {&lhs, &rhs})
        if (side->kind == Kind::applied && side->args.size() == 1 && side->args[0]->kind == Kind::number) {
            const auto name = letters_.name_of(side->letter);
            if (name && (!letters_.is_of_scene(*name) || letters_.moves(*name)))  // θ(0), V''(0)
                return tell(say("a value at one moment; lines are judged for all motions"));
        }
    std::map<Letter, int> all;
    collect_letters(lhs, all);
    collect_letters(rhs, all);
    const auto state =
        std::find_if(all.begin(), all.end(), [&](const auto& item) { return is_value_of_state(item.first); });
    if (state != all.end() && !letters_.is_authors(state->first))
        return tell(
            say("it speaks of the value of a coordinate at one state, {}; lines are judged for all motions",
                identifier_of(state->first)));
    if (says_rest() && states_special_case(lhs, rhs, all)) {  // P = (R − r) M g/(2 R) in equilibrium
        judge_pair(line, lhs, rhs);
        if (is_right(line.status)) return true;
        line = before;
        notes_.back() = {};
    }
    if (states_special_case(lhs, rhs, all) && !is_parameter_identity(lhs, rhs)) {
        take_in_special_case(lhs, rhs);
        return tell(say("a condition on parameters; lines are judged for all their values"));
    }
    const auto is_zero = [](const Math& side) { return side.kind == Kind::number && side.text == "0"; };
    const auto name = lhs.kind == Kind::letter ? letters_.name_of(lhs.letter) : std::nullopt;
    if (statement_->displayed || !is_zero(rhs) || !name) return false;
    if (*name == letters_.name_of(MechanicalQuantity::potential))
        return tell(say("the zero of the potential, which is free"));
    if (speaks_of_rest_ && lhs.dots > 0 && letters_.moves(*name)) return tell(say("a state of rest"));
    return false;
}

/// What is a mistake of all motions may hold under the condition that the words state, or be a constant of the
/// motion that starts from rest. T and V are what they are in every state, but not for every value of the
/// parameters.
void Marker::weigh_condition(MarkedLine& line, const Math& lhs, const Math& rhs) {
    if (line.status != LineStatus::mistake) return;
    if (statement_->in_words && system_.scene().particles.size() + system_.scene().bodies.size() > 1) {
        line.status = LineStatus::not_about_scene;
        line.reason = say("the words may mean the energy of a part");
        line.claim.clear();
        return;
    }
    const bool is_energy = lhs.kind == Kind::letter && lhs.dots == 0 && quantity_of(lhs.letter).has_value();
    const bool is_rest_alone = speaks_of_rest_ && !holds_rates(lhs) && !holds_rates(rhs) &&
                               !statement_->displayed && system_.mechanism().size() > 1;
    const ex residual =
        truth_.value(claim_text(lhs, as_written()).text) - truth_.value(claim_text(rhs, as_written()).text);
    if (follows_in_special_case(residual)) return settle_in_special_case(line);
    const bool is_excused = keeps_its_start(lhs, rhs) || (!is_energy && (under_condition_ > 0 || is_rest_alone));
    if (!is_excused) return;
    line.status = LineStatus::not_about_scene;
    line.reason = say("the words state a condition for it; lines are judged for all motions");
    line.claim.clear();
}

/// (M + m) x' + m l θ' cos θ = 0 of a motion that starts from rest: the rate of left − right vanishes on all
/// motions.
bool Marker::keeps_its_start(const Math& lhs, const Math& rhs) {
    if (!from_rest_ || displacements_ != nullptr) return false;
    const Mechanism& m = system_.mechanism();
    const ex left = truth_.value(claim_text(lhs, as_written()).text),
             right = truth_.value(claim_text(rhs, as_written()).text);
    const bool has_root = holds_root(lhs) || holds_root(rhs);  // s' = √(2 a s)
    const ex residual = has_root ? GiNaC::pow(left, 2) - GiNaC::pow(right, 2) : left - right;
    if (m.z->depends(residual, m.qddot)) return false;
    return system_.rows().holds(system_.rows().row(m.time_derivative({residual})[0])) == true;
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
    const ex residual = truth_.value(sides.left.text) - truth_.value(sides.right.text);
    if (m.z->depends(residual, m.qddot)) return false;
    return is_identically_zero(m.z->name(substitute(*m.z, {residual}, pose)[0]), m);
}

/// θ' = 3 S / (7 m l) of the rates just after the scene's impulses.
bool Marker::holds_after_impact(MarkedLine& line, const Sides& sides) {
    if (mentions_impact_ && holds_at_pose(sides)) {
        line.status = LineStatus::right;
        line.reason = say("at the pose of the impact");
        notes_.back().claim = {};
        return true;
    }
    if (!speaks_of_impact_ || system_.scene().impulses.empty() || has_quantities(sides) ||
        is_accelerated(*sides.lhs) || is_accelerated(*sides.rhs))
        return false;
    LineClaim claim = notes_.back().claim;
    claim.at_impact = true;
    Verdict verdict;
    try {
        verdict = system_.check({claim}, known_)[0].verdict;
    } catch (const std::exception&) {
        return false;
    }
    notes_.back().claim = claim;
    line.status = verdict == Verdict::proved    ? LineStatus::right
                  : verdict == Verdict::refuted ? LineStatus::mistake
                                                : LineStatus::undecided;
    line.reason = say("just after the impact");
    return true;
}

}  // namespace alembert
