// SPDX-License-Identifier: GPL-2.0-or-later
// Functions at a place: U''(r_0), V''(0), and lines of one place that the sentence names.
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <functional>

#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

bool holds_letter(const Math& math, const char* base) {
    return (math.kind == Kind::letter && math.letter.base == base) ||
           std::any_of(math.args.begin(), math.args.end(),
                       [&](const MathPtr& arg) { return holds_letter(*arg, base); });
}

/// ∂²U/∂r² of U'' and r, at the place of U''.
MathPtr slope_of(const Math& function, const Letter& coordinate) {
    Math of = function, by = function, slope{.kind = Kind::partial};
    of.kind = by.kind = Kind::letter;
    of.dots = by.dots = 0;
    of.args.clear();
    by.args.clear();
    by.letter = coordinate;
    if (function.dots == 0) return std::make_shared<Math>(std::move(of));
    slope.text = "d";
    slope.offset = function.offset, slope.length = function.length;
    slope.args.push_back(std::make_shared<Math>(std::move(of)));
    slope.args.insert(slope.args.end(), static_cast<std::size_t>(function.dots), std::make_shared<Math>(by));
    return std::make_shared<Math>(std::move(slope));
}

bool is_two(const Math& math) {
    return math.kind == Kind::number && math.text == "2";
}

/// V''(0), at a number.
bool holds_value_at_number(const Math& math) {
    return (math.kind == Kind::applied && math.args.size() == 1 && math.args[0]->kind == Kind::number) ||
           std::any_of(math.args.begin(), math.args.end(),
                       [](const MathPtr& arg) { return holds_value_at_number(*arg); });
}

}  // namespace

bool holds_whole_turn(const Math& math) {
    const bool is_product = math.kind == Kind::product || math.kind == Kind::quotient;
    if (!is_product) return false;
    if (math.kind == Kind::quotient) return holds_whole_turn(*math.args[0]);
    const auto is_pi = [](const MathPtr& arg) { return arg->kind == Kind::letter && holds_letter(*arg, "pi"); };
    return std::any_of(math.args.begin(), math.args.end(), is_pi) &&
           std::any_of(math.args.begin(), math.args.end(), [](const MathPtr& arg) { return is_two(*arg); });
}

/// U''(r_0) as ∂²U/∂r², and U(r_0) as U: what they are at the state. Unchanged where the place is none of a
/// coordinate.
MathPtr Marker::with_slopes(const MathPtr& math) const {
    const auto changed = [&] {
        Math copy = *math;
        for (MathPtr& arg : copy.args) arg = with_slopes(arg);
        return std::make_shared<Math>(std::move(copy));
    };
    if (math->kind != Kind::applied || math->args.size() != 1) return changed();
    const Math& place = *math->args[0];
    const auto name = letters_.name_of(math->letter);
    if (!name || (letters_.is_of_scene(*name) && letters_.moves(*name))) return changed();
    std::string coordinate;
    if (place.kind == Kind::letter && state_letters_.contains(place.letter))
        coordinate = coordinate_of_value(place.letter).get_name();
    else if (place.kind == Kind::number && letters_.coordinates().size() == 1)
        coordinate = letters_.coordinates()[0];
    const auto letter = std::find_if(seen_.begin(), seen_.end(), [&](const Letter& one) {
        return letters_.name_of(one) == coordinate && !state_letters_.contains(one);
    });
    if (coordinate.empty() || letter == seen_.end()) return changed();
    return slope_of(*math, *letter);
}

namespace {

/// What is held with a function of one coordinate for each of its primes.
struct Slopes {
    const std::string& text;                                         ///< of the derivation
    std::function<std::optional<Letter>(const Letter&)> coordinate;  ///< of a function of one coordinate alone

    bool has_primes(const Math& math) const {
        const std::string source = text.substr(std::min(math.offset, text.size()), math.length + 3);
        return source.find("dot") == std::string::npos &&
               (source.find('\'') != std::string::npos || source.find("prime") != std::string::npos ||
                source.find("′") != std::string::npos || source.find("″") != std::string::npos);
    }

    MathPtr of(const MathPtr& math) const {
        const bool may_be = math->kind == Math::Kind::letter && math->dots > 0 && has_primes(*math);
        const auto by = may_be ? coordinate(math->letter) : std::nullopt;
        if (by) return slope_of(*math, *by);
        Math copy = *math;
        bool is_other = false;
        for (MathPtr& arg : copy.args) {
            const MathPtr changed = of(arg);
            is_other = is_other || changed != arg;
            arg = changed;
        }
        return is_other ? std::make_shared<Math>(std::move(copy)) : math;
    }
};

}  // namespace

/// V' = m g a sin φ, where V is of one coordinate: V' is dV/dφ if that is what makes the line right.
bool Marker::holds_with_slopes(MarkedLine& line, const Math& lhs, const Math& rhs) {
    const Mechanism& m = system_.mechanism();
    const auto coordinate = [&](const Letter& letter) -> std::optional<Letter> {
        const auto name = letters_.name_of(letter);
        if (!name || letters_.is_of_scene(*name) || quantity_of(letter) == MechanicalQuantity::kinetic) return {};
        const ex value = truth_.value(*name);
        std::optional<Letter> by;
        for (const GiNaC::symbol& q : m.q) {
            if (!m.z->depends(value, {q})) continue;
            const auto found = std::find_if(seen_.begin(), seen_.end(), [&](const Letter& one) {
                return letters_.name_of(one) == q.get_name() && !state_letters_.contains(one);
            });
            if (by || found == seen_.end()) return {};
            by = *found;
        }
        return by;
    };
    const Slopes slopes{written_.text, coordinate};
    const MathPtr whole = std::make_shared<Math>(lhs), other = std::make_shared<Math>(rhs);
    const MathPtr left = slopes.of(whole), right = slopes.of(other);
    if (left == whole && right == other) return false;
    const Sides sides = sides_of(*left, *right);
    const ex residual = truth_.value(sides.left.text) - truth_.value(sides.right.text);
    const bool holds = system_.rows().holds(system_.rows().row(residual)) == true || holds_at_stated_place(sides);
    const bool is_of_rest = heard_.assumed_rest || says_rest() || rhs.kind == Kind::number;
    if (!holds && !(is_of_rest && is_of_rest_unsaid(line, sides))) return false;
    line.status = line.status == LineStatus::not_about_scene ? line.status : LineStatus::right;
    if (line.status == LineStatus::right) line.reason = say("a prime is read as the derivative by the coordinate");
    line.claim = sides.left.text + " = " + sides.right.text;
    line.follows_from.reset();
    notes_.back().claim = {};
    return true;
}

/// V''(0)/I = 3 k/(m l²) − …: held at that place, at rest. Otherwise it is told that it is a value at one moment.
bool Marker::is_at_number(MarkedLine& line, const Math& lhs, const Math& rhs) {
    if (!holds_value_at_number(lhs) && !holds_value_at_number(rhs)) return false;
    const MathPtr left = with_slopes(std::make_shared<Math>(lhs)),
                  right = with_slopes(std::make_shared<Math>(rhs));
    if (holds_value_at_number(*left) || holds_value_at_number(*right)) return false;
    const Math* number = nullptr;
    const std::function<void(const Math&)> find = [&](const Math& math) {
        if (math.kind == Kind::applied && math.args.size() == 1 && math.args[0]->kind == Kind::number)
            number = math.args[0].get();
        for (const MathPtr& arg : math.args) find(*arg);
    };
    find(lhs);
    find(rhs);
    const Mechanism& m = system_.mechanism();
    const Sides sides = sides_of(*left, *right);
    GiNaC::exmap place{{m.q[0], truth_.value(number->text)}, {m.qdot[0], 0}};
    const ex residual = truth_.value(sides.left.text) - truth_.value(sides.right.text);
    if (m.z->depends(residual, m.qddot)) return false;
    if (!vanishes_at(residual, place)) return false;
    line.status = LineStatus::right;
    line.reason = say("where {} = {}", m.q[0].get_name(), number->text);
    line.claim = sides.left.text + " = " + sides.right.text;
    return true;
}

/// "In the stretched position φ = 0 …": the place of which the sentence goes on to speak.
void Marker::note_place(const Math& lhs, const Math& rhs) {
    if (statement_->displayed || lhs.kind != Kind::letter || lhs.dots > 0) return;
    const auto name = letters_.name_of(lhs.letter);
    const Mechanism& m = system_.mechanism();
    for (const GiNaC::symbol& q : m.q) {
        if (!name || q.get_name() != *name) continue;
        const ClaimText value = claim_text(rhs, as_written());
        const ex place = m.z->expand(truth_.value(value.text));
        if (!is_of_parameters(place)) continue;
        stated_place_[q] = place;
        is_place_held_ = says_held(statement_->words);
        if (heard_.start_from_rest) start_place_[q] = place;
    }
}

/// "Of constant length (l' = l'' = 0)": the rates of which the sentence goes on to speak.
void Marker::note_rates() {
    const std::vector<MathPtr>& sides = statement_->sides;
    const Mechanism& m = system_.mechanism();
    const bool is_equal = std::all_of(statement_->relations.begin(), statement_->relations.end(),
                                      [](Relation one) { return one == Relation::equal; });
    if (statement_->displayed || sides.size() < 2 || sides.back()->kind != Kind::number ||
        sides.back()->text != "0" || !is_equal || statement_->consequence ||
        limits_a_condition(statement_->words, heard_.behind))
        return;
    GiNaC::exmap rates;
    for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
        const auto name = sides[k]->kind == Kind::letter ? letters_.name_of(sides[k]->letter) : std::nullopt;
        const auto q = std::find_if(m.q.begin(), m.q.end(),
                                    [&](const GiNaC::symbol& one) { return name && one.get_name() == *name; });
        if (q == m.q.end() || sides[k]->dots < 1 || sides[k]->dots > 2) return;
        const auto i = static_cast<std::size_t>(q - m.q.begin());
        rates[sides[k]->dots == 1 ? m.qdot[i] : m.qddot[i]] = 0;
    }
    stated_place_.insert(rates.begin(), rates.end());
}

/// False too where something is divided by zero there.
bool Marker::vanishes_at(const ex& residual, const GiNaC::exmap& place) const try {
    const Mechanism& m = system_.mechanism();
    return is_identically_zero(m.z->name(substitute(*m.z, {residual}, place)[0]), m);
} catch (const std::domain_error&) {
    return false;
} catch (const std::overflow_error&) {
    return false;
}

/// Whether it keeps its value, and vanishes where the motion starts from rest.
bool Marker::holds_from_start(const ex& residual) {
    const Mechanism& m = system_.mechanism();
    if (start_place_.empty() || displacements_ != nullptr || m.z->depends(residual, m.qddot)) return false;
    GiNaC::exmap start = start_place_;
    for (const GiNaC::symbol& rate : m.qdot) start[rate] = 0;
    return vanishes_at(residual, start) && does_not_change(residual);
}

/// Whether the line follows from the equations at the place of the sentence. A display behind it is of the rates
/// that are zero, not of a place, near which it may be meant; what says there only that nothing is nothing,
/// T = m x'² at x' = 0, is not of that state.
bool Marker::holds_at_stated_place(const Sides& sides) {
    const Mechanism& m = system_.mechanism();
    GiNaC::exmap place = stated_place_;
    if (statement_->displayed)
        for (const GiNaC::symbol& q : m.q) place.erase(q);
    if (place.empty()) return false;
    const ex left = truth_.value(sides.left.text), right = truth_.value(sides.right.text), residual = left - right;
    if (statement_->displayed && vanishes_at(left, place) && vanishes_at(right, place)) return false;
    GiNaC::exmap state = place;  // l' = l'' = 0 is a condition on the forces too, of which the line need not speak
    for (const GiNaC::symbol& acceleration : m.qddot) state.erase(acceleration);
    return vanishes_at(residual, place) || follows_with(residual, place) || follows_with(residual, state) ||
           (is_place_held_ && holds_where_held(residual));
}

/// "If the block is clamped, u = 0": the equations of the other coordinates, with u at rest there, give the line.
bool Marker::holds_where_held(const ex& residual) {
    const Mechanism& m = system_.mechanism();
    GiNaC::exmap held = stated_place_;
    std::vector<ex> all{residual};
    for (int i = 0; i < m.size(); ++i) {
        if (stated_place_.contains(m.q[i]))
            held[m.qdot[i]] = held[m.qddot[i]] = 0;
        else
            all.push_back(system_.motion_residual(i));
    }
    if (all.size() == 1 || !m.z->depends(residual, m.qddot)) return false;
    MotionRows& rows = system_.rows();
    std::vector<MotionRow> special;
    for (const ex& one : substitute(*m.z, all, held)) special.push_back(rows.row(one));
    std::vector<const MotionRow*> given;
    for (std::size_t k = 1; k < special.size(); ++k) given.push_back(&special[k]);
    return rows.is_identity(special[0]) != true && rows.follows(special[0], given, false);
}

}  // namespace alembert
