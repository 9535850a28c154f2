// SPDX-License-Identifier: GPL-2.0-or-later
// What the check says of each line, and where in the document the wrong term stands.
#include "check/derivation/marker.hpp"

#include <algorithm>
#include <cctype>

#include "base/language/say.hpp"
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

/// The verdicts together; where that fails, of each claim alone.
std::vector<CheckedClaim> verdicts_on(const std::vector<LineClaim>& claims,
                                      const std::map<std::string, GiNaC::ex>& known, const DerivedSystem& system) {
    if (claims.empty()) return {};
    try {
        return system.check(claims, known);
    } catch (const std::exception& error) {
        if (claims.size() == 1) {
            CheckedClaim open;
            open.reason = error.what();
            return {open};
        }
    }
    std::vector<CheckedClaim> result;
    for (const LineClaim& claim : claims) result.push_back(std::move(verdicts_on({claim}, known, system)[0]));
    return result;
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
        const bool unknown = !line.checked.likely || line.checked.likely->kind == "unknown";
        if (line.status != LineStatus::mistake || !unknown) continue;
        if (notes.near) {
            CheckedClaim near = line.checked;
            near.likely = slip_near(notes.claim, *notes.near, system_, known);
            if (near.likely) adopt(line, notes, std::move(near));
            continue;
        }
        if (notes.own.empty()) continue;
        // A second slip is one against what the derivation itself had before.
        std::vector<CheckedClaim> own = verdicts_on({notes.claim}, notes.own, system_);
        if (!own[0].likely || own[0].likely->kind == "unknown") continue;
        adopt(line, notes, std::move(own[0]));
    }
    for (std::size_t k = 0; k < lines.size(); ++k) withhold_unexplained(k);
    if (held_.empty()) return;
    for (MarkedLine& line : lines) name_held(line);
}

/// A formula among words that fails, and that no small change makes right, is more often meant otherwise than
/// wrong. Then nothing follows from it either.
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
    const bool is_unexplained = !line.checked.likely || line.checked.likely->kind == "unknown";
    const bool is_refuted = line.status == LineStatus::mistake && line.checked.verdict == Verdict::refuted;
    const WrittenStatement& statement = written_.statements[line.statement];
    if (!is_refuted || !is_unexplained || notes_[k].is_sure || statement.displayed) return;
    const bool was_evaluated = line.reason.empty();
    if (was_evaluated && (asserts(statement.words) || speaks_of_quantity(notes_[k]))) return;
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

/// The words of a verdict with ∂U/∂θ as it was written, where a name has stood for its value.
void Marker::name_held(MarkedLine& line) const {
    const auto rename = [&](std::string& text) {
        for (const auto& [written, name] : held_)
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
    const auto without_blanks = [](const std::string& text) {
        std::string result = text;
        std::erase(result, ' ');
        return result;
    };
    const std::string term = without_blanks(line.term);
    for (const ClaimText* side : {&notes.left, &notes.right})
        for (const ClaimText::Part& part : side->parts) {
            if (without_blanks(side->text.substr(part.begin, part.end - part.begin)) != term) continue;
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
