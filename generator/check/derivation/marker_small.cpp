// SPDX-License-Identifier: GPL-2.0-or-later
// Lines about states of rest and about small deviations from them.
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <utility>

#include "algebra/notation/readable.hpp"
#include "base/language/say.hpp"
#include "check/frequency.hpp"
#include "check/written/words.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;
using Found = RestStates::Found;

namespace {

/// T_2, V_1: energies of parts too.
bool is_energy_alone(const Math& side) {
    static constexpr const char* letters[] = {"T", "K", "V", "U", "L", "E", "H"};
    return side.kind == Kind::letter && side.dots == 0 &&
           std::find(std::begin(letters), std::end(letters), side.letter.base) != std::end(letters);
}

}  // namespace

/// The letter is that of a frequency of which nothing is judged.
void Marker::define_frequency(MarkedLine& line, const Math& letter, const Math& rhs, int power) {
    if (!letters_.name_of(letter.letter)) define(line, letter, rhs, power);
    line.status = LineStatus::undecided;
}

bool Marker::is_of_parameters(const ex& value) const {
    const Mechanism& m = system_.mechanism();
    const std::vector<GiNaC::symbol>* const changing[] = {&m.q, &m.qdot, &m.qddot, &system_.equations().lambda};
    return !m.z->depends(value, {m.t}) && !m.z->depends(value, symbols_of_places()) &&
           std::none_of(std::begin(changing), std::end(changing),
                        [&](const auto* symbols) { return m.z->depends(value, *symbols); });
}

std::vector<GiNaC::symbol> Marker::symbols_of_places() const {
    std::vector<GiNaC::symbol> result;
    for (const auto& [letter, coordinate] : places_) result.push_back(GiNaC::ex_to<GiNaC::symbol>(letter));
    return result;
}

/// A frequency about a state of rest that has no short form.
bool Marker::is_frequency_at_rest(MarkedLine& line, const Math& letter, const Math& rhs, int power,
                                  const std::string& square) {
    const ex value = truth_.value(square);
    std::string reason;
    const bool has_letter = system_.mechanism().z->depends(value, symbols_of_places());
    const RestStates::About about{.places = has_letter ? places_ : GiNaC::exmap(),
                                  .relations = has_letter ? rest_relations_ : std::vector<ex>()};
    const Found found = found_at_rest([&](RestStates& states) { return states.is_frequency(value, about); },
                                      has_letter || heard_.steady_lines > 0 || !places_.empty(), reason);
    const bool holds = found == Found::everywhere || found == Found::on_branch;
    if (!holds && has_letter && (is_state_wrong_ || rest_letters_.empty())) return false;
    if (!holds && (found != Found::nowhere || !(heard_.frequency || heard_.period))) return false;
    if (!letters_.name_of(letter.letter)) define(line, letter, rhs, power);
    const bool is_named = holds && !near_ && own_bases_.empty() && names_state_or_mode(heard_.around);
    line.follows_from = holds ? std::nullopt : own_.explains_frequency(value);
    line.status = is_named            ? LineStatus::undecided
                  : holds             ? LineStatus::right_near
                  : line.follows_from ? LineStatus::follows
                                      : LineStatus::mistake;
    line.reason =
        is_named
            ? say("it is a frequency about {}; whether of the state or mode that the words name is not judged",
                  say("a state of rest found in numbers"))
        : holds ? say("a frequency of small vibrations about {}", say("a state of rest found in numbers"))
        : line.follows_from ? say("it follows from line {}", lines[*line.follows_from].line)
                            : say("it is no frequency of small vibrations");
    notes_.back().is_sure = line.status == LineStatus::mistake && statement_->displayed;
    line.claim =
        identifier_of(letter.letter) + (power == 2 ? "^2" : "") + " = " + claim_text(rhs, as_written()).text;
    notes_.back().claim = {};
    if (holds) frequency_letters_.insert(letter.letter);
    return true;
}

/// Another value of a letter that has been a frequency above: right if it is that of another state or of a special
/// case. Then it is what the letter stands for.
bool Marker::is_frequency_again(MarkedLine& line, const Math& letter, const Math& rhs, int power) {
    const std::string text = claim_text(rhs, as_written()).text;
    const ex value = truth_.value(power == 2 ? text : "(" + text + ")^2");
    const std::string name = letters_.name_of(letter.letter).value_or("");
    if (name.empty() || letters_.is_of_scene(name) || !is_of_parameters(value)) return false;
    MotionRows& rows = system_.rows();
    if (rows.is_identity(rows.row(GiNaC::pow(truth_.value(name), 2) - value)) == true) return false;  // the same
    std::string reason;
    const Found found =
        found_at_rest([&](RestStates& states) { return states.is_frequency(value, {}); }, true, reason);
    if (found == Found::elsewhere) {  // ω² < 0 of a state that is not stable
        define_frequency(line, letter, rhs, power);
        line.reason = say("it holds at some unstable states of rest; whether they are meant is not said");
        notes_.back().claim = {};
        return true;
    }
    if (found != Found::everywhere && found != Found::on_branch) return false;
    define(line, letter, rhs, power);
    line.status = LineStatus::right_near;
    line.reason = say("a frequency of small vibrations about {}", say("a state of rest found in numbers"));
    notes_.back().claim = {};
    return true;
}

/// ω² = g/l, T = 2π √(l/g): a letter for a frequency or a period, in parameters. Judged if the words say so, or
/// once the derivation has linearized; before that, ω₀² = g/l only gives a name.
bool Marker::is_frequency(MarkedLine& line, const Math& letter, const Math& rhs, int power) {
    const std::string& base = letter.letter.base;
    static const std::set<std::string> critical{"c", "cr", "crit", "krit", "k", "star"};
    if (critical.contains(letter.letter.index)) return false;  // Ω_c, beyond which there are other states
    const bool of_period = (base == "T" || base == "tau" || base == "P") && heard_.period;
    const bool of_turns = (base == "f" || base == "nu") && heard_.frequency;
    const bool of_angle = base == "omega" || base == "Omega" || base == "lambda" || base == "w";
    if (!of_period && !of_turns && !(of_angle && (heard_.frequency || heard_.small))) return false;
    const ClaimText text = claim_text(rhs, as_written());
    std::string omega = power == 2 ? text.text : "(" + text.text + ")^2";
    if (of_period) omega = "4*pi^2/(" + omega + ")";
    if (of_turns) omega = "4*pi^2*(" + omega + ")";
    if (!holds_letters_only(text.names, system_.scene()))  // k of k_1 = k_2 = k
        return is_of_parameters(truth_.value(omega)) && is_frequency_at_rest(line, letter, rhs, power, omega);
    const Expression square = parsed(omega);
    if (!square) return false;
    bool known = false;
    for (const BaseState& state : bases()) {
        const CheckedFrequency found =
            check_frequency({system_.scene(), system_.mechanism(), parsed(state), system_.sheets()}, square);
        if (found.verdict == Verdict::undecided) continue;
        known = true;
        line.checked = found;
        if (found.verdict != Verdict::proved) continue;
        const Expression other = parsed("2*(" + omega + ")"), third = parsed("3*(" + omega + ")");
        const AtPoint at{system_.scene(), system_.mechanism(), parsed(state), system_.sheets()};
        if (check_frequency(at, other).verdict == Verdict::proved &&
            check_frequency(at, third).verdict == Verdict::proved) {
            known = false;  // where the inertia matrix is singular any value is one
            continue;
        }
        if (!near_ && own_bases_.empty() && names_state_or_mode(heard_.around)) {
            define_frequency(line, letter, rhs, power);
            line.reason =
                say("it is a frequency about {}; whether of the state or mode that the words name is not judged",
                    state.text);
            return true;
        }
        line.status = LineStatus::right_near;
        line.reason = say("a frequency of small vibrations about {}", state.text);
        frequency_letters_.insert(letter.letter);
        break;
    }
    if (line.status != LineStatus::right_near && is_frequency_at_rest(line, letter, rhs, power, omega))
        return true;
    if (!known && (heard_.frequency || heard_.period)) {
        define_frequency(line, letter, rhs, power);
        line.reason = say("no state of rest is known about which it is a frequency");
        return true;
    }
    if (!known || (line.status != LineStatus::right_near && !heard_.frequency && !heard_.period)) return false;
    if (line.status != LineStatus::right_near) {
        line.follows_from = own_.explains_frequency(truth_.value(omega));
        line.status = line.follows_from ? LineStatus::follows : LineStatus::mistake;
        line.reason = line.follows_from ? say("it follows from line {}", lines[*line.follows_from].line)
                                        : say("it is no frequency of small vibrations");
        notes_.back().is_sure = !line.follows_from && statement_->displayed;
    }
    const LineStatus status = line.status;
    const std::string reason = line.reason;
    const bool is_open = !letters_.name_of(letter.letter);
    if (is_open) define(line, letter, rhs, power);
    line.status = status;
    line.reason = reason;
    if (line.claim.empty())
        line.claim = identifier_of(letter.letter) + (power == 2 ? "^2" : "") + " = " + text.text;
    return true;
}

/// The states about which lines may be linearized: the one that a line has shown, or those that the author
/// deviates from, or the scene's own.
std::vector<BaseState> Marker::bases() const {
    if (near_) return {*near_};
    return own_bases_.empty() ? base_states(system_.scene()) : own_bases_;
}

/// r = l_0 + m g/k + ξ: a deviation ξ from a state of rest.
void Marker::note_base(const Math& lhs, const Math& rhs, const Letter& deviation) {
    const Math& coordinate = lhs.kind == Kind::letter ? lhs : rhs;
    const Math& sum = &coordinate == &lhs ? rhs : lhs;
    if (coordinate.kind != Kind::letter || coordinate.dots > 0 || sum.kind != Kind::sum) return;
    const auto name = letters_.name_of(coordinate.letter);
    const std::vector<std::string>& all = letters_.coordinates();
    if (!name || std::find(all.begin(), all.end(), *name) == all.end()) return;
    Math rest = sum;
    std::erase_if(rest.args, [&](const MathPtr& term) {
        const Math& inner = term->kind == Kind::negate ? *term->args[0] : *term;
        return inner.kind == Kind::letter && inner.letter == deviation;
    });
    if (rest.args.size() + 1 != sum.args.size()) return;
    const ClaimText value = claim_text(rest.args.size() == 1 ? *rest.args[0] : rest, as_written());
    if (!holds_letters_only(value.names, system_.scene())) return;
    std::vector<BaseState> bases = own_bases_.empty() ? base_states(system_.scene()) : own_bases_;
    for (BaseState& base : bases) {
        base.text.clear();
        for (auto& [q, place] : base.values) {
            if (q == *name) place = value.text;
            base.text += (base.text.empty() ? "" : ", ") + q + " = " + place;
        }
    }
    own_bases_ = std::move(bases);
    near_.reset();
}

/// cos θ ≈ 1 + θ²/2: terms of second order that are written are to be right.
bool Marker::states_second_order(const Sides& sides, const ex& residual, const BaseState& base) {
    if (is_accelerated(*sides.lhs) || is_accelerated(*sides.rhs)) return false;
    if (is_small(residual, base, 2, false, system_)) return false;
    const ex value = truth_.value(sides.right.text);
    const std::optional<ex> first = linear_part(value, base, system_);
    return first && !is_small(value - *first, base, 2, true, system_);
}

/// Whether the author deviates from a state at which the system does not rest, such as a steady motion.
bool Marker::deviates_from_motion() const {
    return heard_.small && !own_bases_.empty() &&
           std::none_of(own_bases_.begin(), own_bases_.end(),
                        [&](const BaseState& base) { return may_rest(base, system_); });
}

/// Whether it holds near the states of rest in numbers, or near those from which the author deviates.
bool Marker::holds_near_some_rest(MarkedLine& line, const ex& residual) {
    if (!heard_.small || displacements_ != nullptr) return false;
    MotionRows& rows = system_.rows();
    const Mechanism& m = system_.mechanism();
    for (const GiNaC::symbol& q : m.q) {  // l φ' + x' φ = 0 of a small φ, whatever x' is
        if (!m.z->depends(residual, {q})) continue;
        const ex exact = substitute(*m.z, {residual}, {{q, GiNaC::sin(q)}})[0];
        if (rows.holds(rows.row(exact)) != true) continue;
        line.status = LineStatus::right_near;
        line.reason = say("to first order near {}", q.get_name() + " = 0");
        return true;
    }
    RestStates::About about;
    if (!own_bases_.empty())
        for (const auto& [q, text] : own_bases_.front().values)
            for (const GiNaC::symbol& coordinate : system_.mechanism().q)
                if (q == coordinate.get_name()) about.base[coordinate] = truth_.value(text);
    return is_near_state(line, residual, about);
}

bool Marker::holds_near(MarkedLine& line, const Sides& sides, const ex& residual) {
    if (!heard_.small) return false;
    const auto speaks_of = [&](MechanicalQuantity quantity) {
        const std::string name = letters_.name_of(quantity);
        return sides.left.names.contains(name) || sides.right.names.contains(name);
    };
    const bool of_potential = speaks_of(MechanicalQuantity::potential) ||
                              speaks_of(MechanicalQuantity::lagrangian) || speaks_of(MechanicalQuantity::energy);
    const int order =
        of_potential || speaks_of(MechanicalQuantity::kinetic) || is_energy_alone(*sides.lhs) ? 2 : 1;
    for (const BaseState& base : bases()) {
        if (!may_rest(base, system_)) continue;
        bool holds = is_small(residual, base, order, of_potential, system_);
        if (holds && order == 1 && states_second_order(sides, residual, base)) continue;
        if (holds && order == 2) {  // V = … + m g l θ⁴/24, written further
            const auto value = [&](const ClaimText& side) {
                return system_.mechanism().z->expand(truth_.value(side.text));
            };
            const auto written = agree_to_written_order(value(sides.left), value(sides.right), base,
                                                        system_.mechanism().q, system_, of_potential);
            if (written && !written->agrees) continue;
        }
        if (!holds && order == 1) {
            const auto checked = checked_near(notes_.back().claim, base, system_, known_in_motion());
            holds = checked && checked->verdict == Verdict::proved;
            if (checked) near_ = base;
        }
        if (!holds) continue;
        line.status = LineStatus::right_near;
        line.reason = say("to first order near {}", base.text);
        return true;
    }
    return false;
}

/// ω of a secular equation, which nothing has defined or which is a frequency: all else in it is constant.
const Letter* Marker::letter_of_frequency(const Math& lhs, const Math& rhs, std::map<Letter, int>& all) const {
    static const std::set<std::string> bases{"omega", "Omega", "w", "p", "lambda", "s", "nu", "mu", "r", "z", "x"};
    collect_letters(lhs, all);
    collect_letters(rhs, all);
    const Letter* result = nullptr;
    for (const auto& [letter, dots] : all) {
        const auto name = letters_.name_of(letter);
        if (dots > 0) return nullptr;
        const auto known = name ? known_.find(*name) : known_.end();
        const bool is_constant =
            name && !letters_.moves(*name) && !is_multiplier(*name) &&
            (letters_.is_of_scene(*name) || (known != known_.end() && is_of_parameters(known->second)));
        if (is_constant && !frequency_letters_.contains(letter)) continue;
        if (result != nullptr || !bases.contains(letter.base) || (name && letters_.is_of_scene(*name)))
            return nullptr;
        result = &letter;
    }
    return result;
}

/// (2 k − 2 J ω²)(k − J ω²) − k² = 0: right if its roots are the frequencies about a state of rest.
bool Marker::is_frequency_equation(MarkedLine& line, const Math& lhs, const Math& rhs) {
    std::map<Letter, int> all, beside;
    const Letter* letter = letter_of_frequency(lhs, rhs, all);
    if (letter == nullptr || all.size() < 2) return false;
    for (const auto& [side, other] : {std::pair{&lhs, &rhs}, {&rhs, &lhs}}) {
        beside.clear();
        collect_letters(*other, beside);
        if (lone_letter(*side).letter != nullptr && !beside.contains(*letter)) return false;  // ω² = k/m
    }
    const Letters before = letters_;
    const std::string name = letters_.free_name("frequency");
    const GiNaC::symbol x = system_.held(name);
    letters_.bind(*letter, name);
    truth_.know(name, x);
    const Sides sides = sides_of(lhs, rhs);
    const ex residual = system_.mechanism()
                            .z->expand(truth_.value(sides.left.text) - truth_.value(sides.right.text))
                            .normal()
                            .numer()
                            .expand();
    letters_ = before;
    if (!residual.is_polynomial(x) || residual.degree(x) < 2) return false;
    std::vector<ex> coefficients;
    for (int k = 0; k <= residual.degree(x); ++k) coefficients.push_back(residual.coeff(x, k));
    std::string reason;
    const Found found = found_at_rest(
        [&](RestStates& states) { return states.is_characteristic(coefficients, {}); }, true, reason);
    const bool holds = found == Found::everywhere || found == Found::on_branch;
    const bool is_said = heard_.frequency || heard_.small || frequency_letters_.contains(*letter);
    if (!holds && (found != Found::nowhere || !is_said)) return false;
    if (holds) frequency_letters_.insert(*letter);
    line.status = holds ? LineStatus::right : LineStatus::mistake;
    line.reason = holds ? say("its roots are the frequencies of small vibrations about {}",
                              say("a state of rest found in numbers"))
                        : say("its roots are no frequencies of small vibrations");
    line.claim = sides.left.text + " = " + sides.right.text;
    return true;
}

namespace {

/// Coordinates of which a sine, a cosine or the like is taken.
void collect_angles(const ex& e, const std::vector<GiNaC::symbol>& coordinates, std::vector<GiNaC::symbol>& to) {
    if (GiNaC::is_a<GiNaC::function>(e))
        for (const GiNaC::symbol& q : coordinates)
            if (e.has(q) && std::find(to.begin(), to.end(), q) == to.end()) to.push_back(q);
    for (const ex& part : e) collect_angles(part, coordinates, to);
}

}  // namespace

/// r θ'² − g (1 − cos θ) ≈ r θ'² − g θ²/2: the same to the order that is written, of the angles or of all
/// coordinates; momenta stay what they are.
bool Marker::is_approximation(MarkedLine& line, const Sides& sides) {
    if (relation_ != Relation::approximately) return false;
    const Mechanism& m = system_.mechanism();
    std::vector<std::string> held;
    for (const ClaimText* side : {&sides.left, &sides.right})
        for (const std::string& name : side->names)
            if (known_.contains(name) && (name.starts_with("p_") || kept_.contains(name))) held.push_back(name);
    for (const std::string& name : held) truth_.know(name, system_.held(name));
    const ex left = m.z->expand(truth_.value(sides.left.text)),
             right = m.z->expand(truth_.value(sides.right.text));
    for (const std::string& name : held) truth_.know(name, known_.at(name));
    std::vector<GiNaC::symbol> angles;
    collect_angles(left, m.q, angles);
    bool fails = false, may_lack_constant = false;
    ex expanded;
    for (const BaseState& base : bases())
        for (const std::vector<GiNaC::symbol>& small : {std::as_const(angles), m.q}) {
            const auto written = agree_to_written_order(left, right, base, small, system_);
            if (written && !written->agrees && written->order > 1) {
                if (!fails) expanded = written->left;
                fails = true;
                const auto shifted = agree_to_written_order(left, right, base, small, system_, true);
                may_lack_constant = may_lack_constant || !shifted || shifted->agrees;
            }
            if (!written || !written->agrees) continue;
            line.status = LineStatus::right_near;
            line.reason = say("to the order that is written, near {}", base.text);
            notes_.back().claim = {};
            return true;
        }
    if (!fails || angles.empty() || (has_quantities(sides) && may_lack_constant)) return false;
    line.status = LineStatus::mistake;  // a polynomial in the angles that is another
    line.reason = say("the two sides differ at an order that is written");
    line.claim = sides.left.text + " = " + sides.right.text;
    notes_.back().is_sure = true;
    notes_.back().claim = {};
    notes_.back().left = sides.left;
    notes_.back().right = sides.right;
    notes_.back().expanded = expanded;
    return true;
}

}  // namespace alembert
