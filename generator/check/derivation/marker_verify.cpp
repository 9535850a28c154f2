// SPDX-License-Identifier: GPL-2.0-or-later
// What the check says of each line, and where in the document the wrong term stands.
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "base/language/say.hpp"
#include "check/claims.hpp"
#include "check/derivation/explanation.hpp"
#include "check/written/words.hpp"

namespace alembert {

namespace {

bool is_up_to(LineStatus status) {
    return status == LineStatus::right_up_to_constant || status == LineStatus::right_up_to_derivative;
}

bool is_checked(LineStatus status) {
    return status == LineStatus::right || status == LineStatus::mistake || status == LineStatus::unfounded ||
           status == LineStatus::undecided || is_up_to(status);
}

}  // namespace

void Marker::verify() {
    std::vector<LineClaim> claims;
    std::vector<std::size_t> asked;
    for (std::size_t k = 0; k < lines.size(); ++k)
        if (is_checked(lines[k].status) && !notes_[k].claim.lhs.empty()) {
            claims.push_back(notes_[k].claim);
            asked.push_back(k);
        }
    const std::map<std::string, GiNaC::ex> known = known_to_check();
    std::vector<CheckedClaim> verdicts = verdicts_on(claims, known, system_);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        LineNotes& notes = notes_[asked[i]];
        if (verdicts[i].verdict == Verdict::undecided && !system_.scene().unilateral.empty()) {
            notes.claim.open = true;  // a quantity is what it is whether contacts are closed or not
            if (speaks_of_quantity(notes)) verdicts[i] = verdicts_on({notes.claim}, known, system_)[0];
        }
        adopt(lines[asked[i]], notes, std::move(verdicts[i]));
        MarkedLine& line = lines[asked[i]];
        if (line.status == LineStatus::mistake) find_slip(line, notes, known);
    }
    for (const std::size_t k : asked)
        if (lines[k].status == LineStatus::mistake && !notes_[k].is_sure &&
            !is_plausible(lines[k].checked.likely, notes_[k].claim))
            blame_definition(k, known);
    for (std::size_t k = 0; k < lines.size(); ++k)
        if (lines[k].status == LineStatus::mistake && notes_[k].expanded)
            find_slip_of_approximation(lines[k], notes_[k]);
    for (std::size_t k = 0; k < lines.size(); ++k) withhold_unexplained(k);
    for (MarkedLine& line : lines) name_held(line);
}

/// tan θ = 1/2 speaks of special values.
bool Marker::holds_parameter(const LineClaim& claim) {
    const Mechanism& m = system_.mechanism();
    std::vector<GiNaC::symbol> parameters;
    for (const Mechanism::Parameter& p : m.parameters) parameters.push_back(p.symbol);
    return m.z->depends(truth_.value(claim.lhs) - truth_.value(claim.rhs), parameters);
}

bool Marker::is_plausible(const std::optional<Slip>& slip, const LineClaim& claim) {
    return slip && alembert::is_plausible(*slip, claim, [this](const std::string& of) { return order_of(of); });
}

/// The slip of a line that no small change makes right as it was read: one in what it says near a state, against
/// what the derivation itself had before, of rest, or in what motions keep.
void Marker::find_slip(MarkedLine& line, LineNotes& notes, const std::map<std::string, GiNaC::ex>& known) {
    const LineClaim& claim = notes.claim;
    if (is_plausible(line.checked.likely, claim)) return;
    if (const std::optional<LineClaim> from_start = from_start_of_chain(line)) {
        CheckedClaim whole = std::move(verdicts_on({*from_start}, known, system_)[0]);
        if (whole.verdict == Verdict::refuted && is_plausible(whole.likely, *from_start))
            return adopt(line, notes, std::move(whole));
    }
    if (notes.near) {
        CheckedClaim near = line.checked;
        near.likely = slip_near(claim, *notes.near, system_, known);
        if (is_plausible(near.likely, claim)) return adopt(line, notes, std::move(near));
    }
    if (!notes.own.empty()) {
        CheckedClaim own = std::move(verdicts_on({claim}, notes.own, system_)[0]);
        if (is_plausible(own.likely, claim)) return adopt(line, notes, std::move(own));
    }
    const int order = order_of(claim);
    if (order == 0 && notes.is_of_rest && holds_parameter(claim)) {
        LineClaim at_rest = claim;
        at_rest.at_rest = true;
        CheckedClaim rest = std::move(verdicts_on({at_rest}, known, system_)[0]);
        const auto order_there = [this](const std::string& of) { return order_of(of); };
        if (rest.likely && is_plausible_at_rest(*rest.likely, claim, order_there, letters_.coordinates()))
            return adopt(line, notes, std::move(rest));
    }
    if (order == 1 && claim.constants.empty() && (has_free_constant(notes) || !has_quantity(notes)))
        seek_in_integral(line, notes, known);
}

/// Of cos θ ≈ 1 − θ²/3: the change after which the right side is the left one to the order that is written.
void Marker::find_slip_of_approximation(MarkedLine& line, const LineNotes& notes) {
    const std::string name = letters_.free_name("expanded");
    std::map<std::string, GiNaC::ex> known = known_to_check();
    known[name] = *notes.expanded;
    const LineClaim claim{.lhs = name, .rhs = notes.right.text};
    const CheckedClaim found = std::move(verdicts_on({claim}, known, system_)[0]);
    if (found.verdict != Verdict::refuted || !is_plausible(found.likely, claim)) return;
    const std::string begin = name + " = ";
    if (!found.likely->repair.starts_with(begin)) return;
    line.checked.verdict = Verdict::refuted;
    line.checked.likely = found.likely;
    line.checked.likely->repair = notes.left.text + " = " + found.likely->repair.substr(begin.size());
    line.term = found.likely->term;
    line.right = line.checked.likely->repair;
    locate_term(line, notes);
}

/// Of b = c in a = b = c, where a = b is right and shorter: a = c.
std::optional<LineClaim> Marker::from_start_of_chain(const MarkedLine& line) const {
    auto k = static_cast<std::size_t>(&line - lines.data());
    LineClaim claim = notes_[k].claim;
    const std::string written = claim.lhs;
    while (k > 0 && lines[k - 1].statement == line.statement && lines[k - 1].status == LineStatus::right &&
           notes_[k - 1].claim.rhs == claim.lhs) {
        --k;
        claim.lhs = notes_[k].claim.lhs;
    }
    return claim.lhs.size() < written.size() ? std::optional(claim) : std::nullopt;
}

/// The slip of θ'² = g (1 − cos θ)/R, which motions that start at rest keep, or of L − p φ': the change after
/// which both sides differ by a constant.
void Marker::seek_in_integral(MarkedLine& line, LineNotes& notes, const std::map<std::string, GiNaC::ex>& known) {
    const std::string constant = letters_.free_name("const"), added = " + " + constant;
    LineClaim kept = notes.claim;
    kept.rhs += added;
    kept.constants = {constant};
    const CheckedClaim found = std::move(verdicts_on({kept}, known, system_)[0]);
    const bool is_slip = found.verdict == Verdict::refuted && is_plausible(found.likely, notes.claim);
    if (!is_slip || !found.likely->repair.ends_with(added)) return;
    CheckedClaim as_written = line.checked;  // it fails at a state, whatever the constant
    as_written.likely = found.likely;
    as_written.nearest = found.likely->repair;
    as_written.difference.clear();
    adopt(line, notes, std::move(as_written));
}

int Marker::order_of(const LineClaim& claim) {
    return std::max(order_of(claim.lhs).value_or(2), order_of(claim.rhs).value_or(2));
}

/// Nothing of an expression that has no value here.
std::optional<int> Marker::order_of(const std::string& expression) {
    try {
        return alembert::order_of(truth_.value(expression), system_.mechanism());
    } catch (const NoMeaning&) {
    } catch (const std::domain_error&) {  // it divides by zero
    } catch (const std::overflow_error&) {
    }
    return std::nullopt;
}

/// T, V, L, E, H, momenta and forces: what they are leaves no constant open.
bool Marker::has_quantity(const LineNotes& notes) const {
    const auto is_one = [&](const std::string& name) {
        return known_.contains(name) && !letters_.is_of_scene(name);
    };
    return std::any_of(notes.left.names.begin(), notes.left.names.end(), is_one) ||
           std::any_of(notes.right.names.begin(), notes.right.names.end(), is_one);
}

/// V and L, in which a constant says nothing.
bool Marker::has_free_constant(const LineNotes& notes) const {
    return std::any_of(notes.left.names.begin(), notes.left.names.end(), [this](const std::string& name) {
        return name == letters_.name_of(MechanicalQuantity::potential) ||
               name == letters_.name_of(MechanicalQuantity::lagrangian);
    });
}

/// Whether it can be read in one way only: stated, and not mentioned, in the scene's letters and those of energies
/// and momenta, in a text that has spoken of no special state or case.
bool Marker::has_one_reading(std::size_t k) const {
    const LineNotes& notes = notes_[k];
    const WrittenStatement& statement = written_.statements[lines[k].statement];
    const bool is_stated = statement.displayed || asserts(statement.words) || speaks_of_quantity(notes);
    const std::map<std::string, GiNaC::ex> own = known_to_check();
    const auto is_own = [&](const std::string& name) { return own.contains(name) && !letters_.is_of_scene(name); };
    const auto holds_own = [&](const ClaimText& side) {
        return std::any_of(side.names.begin(), side.names.end(), is_own);
    };
    return is_stated && lines[k].reason.empty() && !notes.has_assumed && !holds_own(notes.left) &&
           !holds_own(notes.right);
}

/// A line that fails, and that no small change makes right, is more often meant otherwise than wrong if it can be
/// meant otherwise at all. Then nothing follows from it either.
void Marker::withhold_unexplained(std::size_t k) {
    MarkedLine& line = lines[k];
    const bool is_from_line = line.status == LineStatus::follows && line.follows_from;
    if (is_from_line && !is_judged_wrong(*line.follows_from)) {
        line.reason = say("it follows from line {}, which is not judged", lines[*line.follows_from].line);
        line.status = LineStatus::undecided;
        line.checked = {};
        line.follows_from.reset();
        return;
    }
    const bool is_refuted = line.status == LineStatus::mistake && line.checked.verdict == Verdict::refuted;
    if (!is_refuted || notes_[k].is_sure) return;
    if (is_plausible(line.checked.likely, notes_[k].claim)) return;
    const bool is_of_units = line.checked.likely && line.checked.likely->kind == "wrong_unit";
    if (has_one_reading(k) && !is_of_units) return;
    line.status = LineStatus::undecided;
    line.reason = say("as it was read it fails, and no small change makes it right: it may be meant otherwise");
    line.checked = {};
    line.term.clear();
    line.right.clear();
}

bool Marker::speaks_of_quantity(const LineNotes& notes) const {
    const auto is_own = [&](const std::string& name) { return known_.contains(name); };
    return is_own(notes.claim.lhs) || is_own(notes.claim.rhs);
}

/// Without the letters for values at one state, which no motion has.
std::map<std::string, GiNaC::ex> Marker::known_in_motion() const {
    std::map<std::string, GiNaC::ex> result = known_;
    const std::vector<GiNaC::symbol> letters = symbols_of_places();
    if (!letters.empty())
        std::erase_if(result,
                      [&](const auto& item) { return system_.mechanism().z->depends(item.second, letters); });
    return result;
}

/// Names beside those that claims know themselves: T, V, L, E, H, momenta and generalized forces, which the check
/// reads in either of their meanings.
std::map<std::string, GiNaC::ex> Marker::known_to_check() const {
    std::map<std::string, GiNaC::ex> result = known_in_motion();
    for (const char* const letter : {"T", "V", "L", "E", "H"}) result.erase(letter);
    for (const std::string& q : letters_.coordinates()) result.erase("p_" + q), result.erase("Q_" + q);
    return result;
}

void Marker::adopt(MarkedLine& line, LineNotes& notes, CheckedClaim verdict) {
    line.checked = std::move(verdict);
    if (is_up_to(line.status)) {
        if (line.checked.verdict != Verdict::proved) line.checked = {};
        line.reason = line.checked.reason;
        return;
    }
    switch (line.checked.verdict) {
        case Verdict::refuted:
            if (line.status != LineStatus::unfounded) line.status = LineStatus::mistake;
            break;
        case Verdict::undecided:
            line.status = LineStatus::undecided;
            if (line.reason.empty()) line.reason = line.checked.reason;
            return;
        case Verdict::proved:
        case Verdict::vacuous:
            if (line.status == LineStatus::mistake || line.status == LineStatus::undecided)
                line.status = LineStatus::right;
            return;
    }
    if (line.checked.likely) {
        line.term = line.checked.likely->term;
        line.right = line.checked.likely->repair;
    }
    if (line.right.empty()) line.right = line.checked.nearest;
    locate_term(line, notes);
}

/// The words of a verdict with ∂U/∂θ as it was written, where a name has stood for its value; and with L for the
/// Lagrangian where the scene has an L of its own.
void Marker::name_held(MarkedLine& line) const {
    std::map<std::string, std::string> names = held_;
    for (const MechanicalQuantity quantity :
         {MechanicalQuantity::kinetic, MechanicalQuantity::potential, MechanicalQuantity::lagrangian,
          MechanicalQuantity::energy, MechanicalQuantity::hamiltonian})
        if (const std::string name = letters_.name_of(quantity); name.size() > 1) names[name.substr(0, 1)] = name;
    const auto rename = [&](std::string& text) {
        for (const auto& [written, name] : names)
            for (std::size_t at = text.find(name); at != std::string::npos;
                 at = text.find(name, at + written.size())) {
                const std::size_t end = at + name.size();
                if (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) {
                    ++at;
                    continue;
                }
                text.replace(at, name.size(), written);
            }
    };
    for (std::string* text : {&line.claim, &line.term, &line.right, &line.reason, &line.checked.difference,
                              &line.checked.nearest, &line.checked.reason})
        rename(*text);
    if (!line.checked.likely) return;
    Slip& slip = *line.checked.likely;
    for (std::string* text : {&slip.term, &slip.repair, &slip.should_be, &slip.written, &slip.meant})
        rename(*text);
}

void Marker::locate_term(MarkedLine& line, const LineNotes& notes) const {
    if (line.term.empty() || line.checked.likely->kind == "missing_term") return;
    const std::string term = compact(line.term);
    for (const ClaimText* side : {&notes.left, &notes.right})
        for (const ClaimText::Part& part : side->parts) {
            if (compact(side->text.substr(part.begin, part.end - part.begin)) != term) continue;
            line.term_offset = part.offset;
            line.term_length = part.length;
            return;
        }
}

std::vector<std::string> Marker::missing() {
    MotionRows& rows = system_.rows();
    std::vector<const MotionRow*> right;
    for (std::size_t k = 0; k < lines.size(); ++k)
        if (notes_[k].equation &&
            (lines[k].status == LineStatus::right || lines[k].status == LineStatus::unfounded))
            right.push_back(&*notes_[k].equation);
    std::vector<std::string> result;
    if (rows.determine(right)) return result;
    const Mechanism& m = system_.mechanism();
    const Equations& e = system_.equations();
    for (int i = 0; i < e.size(); ++i) {
        if (!rows.follows(rows.row(system_.motion_residual(i)), right)) result.push_back(m.q[i].get_name());
    }
    return result;
}

double Marker::score() const {
    double result = 0;
    for (const MarkedLine& line : lines) switch (line.status) {
            case LineStatus::right:
            case LineStatus::right_near:
            case LineStatus::right_up_to_constant:
            case LineStatus::right_up_to_derivative:
                result += 1;
                break;
            case LineStatus::follows:
            case LineStatus::unfounded:
                result += 0.5;
                break;
            case LineStatus::definition:
                result += 0.1;
                break;
            case LineStatus::not_understood:
            case LineStatus::undecided:
                result -= 0.5;
                break;
            case LineStatus::mistake:
                result -= 0.25;
                break;
            case LineStatus::not_about_scene:
                break;
        }
    return result;
}

}  // namespace alembert
