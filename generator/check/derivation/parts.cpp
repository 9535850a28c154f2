// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/parts.hpp"

#include <algorithm>
#include <cctype>

#include "check/total_derivative.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Letters of any alphabet and digits, without blanks.
std::string without_blanks(const std::string& text) {
    std::string result;
    for (const char c : text)
        if (static_cast<unsigned char>(c) >= 0x80 || std::isalnum(static_cast<unsigned char>(c)) != 0)
            result += static_cast<char>(static_cast<unsigned char>(c) < 0x80 ? std::tolower(c) : c);
    return result;
}

/// Does the word name the part: its label, its body, its place in the list, the kind of energy?
bool names(const std::string& word, const Origin& origin, std::size_t place, bool by_label) {
    const std::vector<std::string> all = labels(origin);
    if (by_label)
        return std::any_of(all.begin(), all.end(),
                           [&](const std::string& label) { return word == without_blanks(label); });
    if (word == plain_word(origin.name) || word == std::to_string(place + 1)) return true;
    if (origin.kind == Origin::Kind::gravity) return word == "g" || word == "grav" || word == "gravity";
    if (origin.kind == Origin::Kind::spring) return word == "s" || word == "k" || word == "spring" || word == "el";
    if (origin.kind == Origin::Kind::rotation) return word == "rot" || word == "r";
    const bool moves = origin.kind == Origin::Kind::body || origin.kind == Origin::Kind::particle;
    return moves && (word == "trans" || word == "tr" || word == "t");
}

std::optional<ex> sum_of(const std::vector<Part>& parts, const std::string& word, const Mechanism& m) {
    for (const bool by_label : {true, false}) {
        GiNaC::exvector terms;
        std::size_t place = 0;
        std::string last;
        for (const Part& part : parts) {
            if (!last.empty() && part.origin.name != last) ++place;  // a body and its rotation have one place
            last = part.origin.name;
            if (names(word, part.origin, place, by_label)) terms.push_back(part.value);
        }
        if (!terms.empty()) return m.z->name(GiNaC::add(std::move(terms)));
    }
    return std::nullopt;
}

std::optional<ex> force_of(const std::string& word, std::size_t coordinate, const Mechanism& m) {
    for (const bool by_label : {true, false}) {
        std::size_t place = 0;
        for (const Load& load : m.loads) {
            if (!names(word, load.origin, place++, by_label)) continue;
            std::vector<std::pair<ex, ex>> targets;
            for (const Load::Pair& pair : load.pairs) targets.emplace_back(pair.velocity, pair.force);
            return m.z->pull_back(targets, m.qdot)[coordinate];
        }
    }
    const auto potential = sum_of(m.potential, word, m);
    if (!potential) return std::nullopt;
    return m.z->name(-m.z->pull_back({{*potential, 1}}, m.q)[coordinate]);
}

}  // namespace

std::optional<ex> part_named(const Letter& letter, const Letters& letters, const DerivedSystem& system) {
    const Mechanism& m = system.mechanism();
    const std::string word = without_blanks(letter.raised.empty() ? letter.index : letter.raised);
    if (word.empty() || m.given_lagrangian) return std::nullopt;
    const std::string& base = letter.base;
    if (base == "gap")
        for (const Mechanism::Unilateral& contact : m.unilateral)
            if (plain_word(contact.gap.name) == word) return *contact.gap.position;
    if (base == "T" || base == "K") return sum_of(m.kinetic, word, m);
    if (base == "V" || base == "U") return sum_of(m.potential, word, m);
    const std::string name = letters.coordinate_of(letter.index);
    const auto q =
        std::find_if(m.q.begin(), m.q.end(), [&](const GiNaC::symbol& s) { return s.get_name() == name; });
    if (name.empty() || q == m.q.end()) return std::nullopt;
    const auto i = static_cast<std::size_t>(q - m.q.begin());
    const bool starred = letter.raised == "*" || letter.raised == "\\ast";
    if (starred && (base == "F" || base == "Q")) return m.z->name(-euler_operator(m.kinetic_energy(), m)[i]);
    if (base == "F" && letter.raised.empty()) return system.forces(true)[i];
    if (base == "E" && letter.raised.empty())
        return m.z->name(euler_operator(m.lagrangian(), m)[i] - system.forces(false)[i]);
    if (base == "Q" && !letter.raised.empty()) return force_of(word, i, m);
    return std::nullopt;
}

}  // namespace alembert
