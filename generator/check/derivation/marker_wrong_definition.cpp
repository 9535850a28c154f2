// SPDX-License-Identifier: GPL-2.0-or-later
// A mistake in what the author says of a letter of his own, which only a later line shows.
#include <algorithm>

#include "base/language/say.hpp"
#include "check/derivation/marker.hpp"

namespace alembert {

namespace {

bool is_of_name(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Where the name stands in an expression as a whole word, and not as a rate.
std::vector<std::size_t> places_of(const std::string& name, const std::string& text) {
    std::vector<std::size_t> result;
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        const bool is_whole =
            (at == 0 || !is_of_name(text[at - 1])) && (end == text.size() || !is_of_name(text[end]));
        if (is_whole) result.push_back(at);
    }
    return result;
}

/// What stands in `repaired` in place of the part of `whole` from `begin` to `end`, whatever the blanks; empty
/// where more has changed.
std::string repaired_part(const std::string& whole, std::size_t begin, std::size_t end,
                          const std::string& repaired) {
    const std::string before = compact(whole.substr(0, begin)), behind = compact(whole.substr(end)),
                      text = compact(repaired);
    if (text.size() <= before.size() + behind.size() || !text.starts_with(before) || !text.ends_with(behind))
        return {};
    std::string part;
    std::size_t signs = 0;
    for (const char c : repaired) {
        if (signs >= before.size() && signs < text.size() - behind.size()) part += c;
        signs += c == ' ' ? 0 : 1;
    }
    return part;
}

}  // namespace

/// U = m g y + k δ²/2 after a wrong δ = δ_0 + l sin θ: no change of the line explains it, and one of what was said
/// of δ does. Then this is the mistake, and the line follows from it.
void Marker::blame_definition(std::size_t k, const std::map<std::string, GiNaC::ex>& known) {
    const LineClaim& claim = notes_[k].claim;
    const std::string written = claim.lhs + " = " + claim.rhs;
    constexpr int most_tried = 6;  // a search for a slip each
    int tried = 0;
    for (std::size_t d = k; d-- > 0 && tried < most_tried;) {
        const std::string& stated = lines[d].claim;
        const std::size_t equals = stated.find(" = ");
        if (lines[d].status != LineStatus::definition || equals == std::string::npos) continue;
        const std::string name = stated.substr(0, equals);
        if (!std::all_of(name.begin(), name.end(), is_of_name) || !known.contains(name)) continue;
        const std::vector<std::size_t> places = places_of(name, written);
        const bool is_borne_out = std::any_of(
            lines.begin() + static_cast<std::ptrdiff_t>(d) + 1, lines.begin() + static_cast<std::ptrdiff_t>(k),
            [&](const MarkedLine& line) { return is_right(line.status) && !places_of(name, line.claim).empty(); });
        if (places.size() != 1 || is_borne_out) continue;
        ++tried;
        const std::string value = "(" + stated.substr(equals + 3) + ")";
        std::string whole = written;
        whole.replace(places[0], name.size(), value);
        LineClaim expanded = claim;
        expanded.lhs = whole.substr(0, whole.find(" = "));
        expanded.rhs = whole.substr(whole.find(" = ") + 3);
        CheckedClaim found = verdicts_on({expanded}, known, system_)[0];
        if (found.verdict != Verdict::refuted || !is_plausible(found.likely, expanded)) continue;
        std::string right = repaired_part(whole, places[0], places[0] + value.size(), found.likely->repair);
        right.erase(0, std::min(right.find_first_not_of(' '), right.size()));
        right.erase(right.find_last_not_of(' ') + 1);
        if (right.size() < 3 || right.front() != '(' || right.back() != ')') continue;
        MarkedLine& definition = lines[d];
        definition.status = LineStatus::mistake;
        definition.reason = say("with it line {} is wrong", lines[k].line);
        definition.term = found.likely->term;
        definition.right = name + " = " + right.substr(1, right.size() - 2);
        found.likely->repair = definition.right;
        definition.checked.verdict = Verdict::refuted;
        definition.checked.likely = std::move(found.likely);
        locate_term(definition, notes_[d]);
        notes_[d].is_sure = true;
        lines[k].status = LineStatus::follows;
        lines[k].follows_from = d;
        lines[k].checked = {};
        lines[k].term.clear();
        lines[k].right.clear();
        return;
    }
}

}  // namespace alembert
