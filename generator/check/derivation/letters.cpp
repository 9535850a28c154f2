// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/letters.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/language/greek.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

bool is_digit_at(const std::string& text, std::size_t at) {
    return std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

/// With Latin spellings for Greek letters.
std::string in_latin(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t begin = i;
        decode(text, i);
        const GreekLetter* const greek = greek_of(std::string_view(text).substr(begin, i - begin));
        result += greek != nullptr ? std::string(greek->name) : text.substr(begin, i - begin);
    }
    return result;
}

/// The letters that a person may write for a name, the most likely first: theta1 → θ₁; l_C → l with the index C;
/// mB → the word mB, or m with the index B.
std::vector<Letter> letters_of(const std::string& name) {
    const std::string word = in_latin(name);
    std::vector<Letter> result;
    const auto add = [&](std::string base, std::string index) {
        if (!base.empty())
            result.push_back({.base = std::move(base), .index = std::move(index), .raised = {}, .accent = {}});
    };
    const std::size_t line = word.find('_');
    if (line != std::string::npos && line > 0 && line + 1 < word.size())
        add(word.substr(0, line), word.substr(line + 1));
    std::size_t digits = word.size();
    while (digits > 0 && is_digit_at(word, digits - 1)) --digits;
    if (digits > 0 && digits < word.size()) add(word.substr(0, digits), word.substr(digits));
    add(word, "");
    for (const std::size_t length : {5U, 4U, 3U, 2U, 1U})  // thetaC, mB
        if (word.size() > length && line == std::string::npos && digits == word.size() &&
            (length == 1 || greek_named(word.substr(0, length)) != nullptr))
            add(word.substr(0, length), word.substr(length));
    return result;
}

/// Other hands for the same letter.
std::vector<std::string> hands_of(const std::string& base) {
    static const std::map<std::string, std::string> plain{
        {"varphi", "phi"}, {"vartheta", "theta"}, {"varepsilon", "epsilon"},
        {"varrho", "rho"}, {"varkappa", "kappa"}, {"varsigma", "sigma"},
        {"ell", "l"},      {"hbar", "h"},         {"imath", "i"},
        {"varpi", "pi"},   {"th", "theta"},       {"ph", "phi"},
        {"om", "omega"},   {"Om", "Omega"},       {"al", "alpha"},
        {"be", "beta"},    {"ga", "gamma"},       {"lam", "lambda"},
        {"eps", "epsilon"}};
    std::vector<std::string> result{base};
    for (const auto& [variant, letter] : plain) {
        if (variant == base) result.push_back(letter);
        if (letter == base) result.push_back(variant);
    }
    return result;
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> list) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

/// An index as a word: "\\theta_1", "theta_1" and "θ₁" are "theta1"; "1,2" is "12".
std::string index_word(const std::string& index) {
    std::string result;
    for (const char c : in_latin(index))
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) result += c;
    for (const char* const variant : {"varphi", "vartheta", "varepsilon", "varrho"})  // u_\\varphi is u_phi
        if (const std::size_t at = result.find(variant); at != std::string::npos) result.erase(at, 3);
    return result;
}

}  // namespace

std::optional<MechanicalQuantity> quantity_of(const Letter& letter) {
    const std::string index = index_word(letter.index);
    const bool plain = is_one_of(letter.accent, {"", "mathcal", "mathrm", "mathscr", "mathit"});
    if (!plain || !letter.raised.empty()) return std::nullopt;
    const std::string& base = letter.base;
    if (is_one_of(base, {"E", "W"}) && is_one_of(index, {"k", "K", "kin", "kinetic", "c"}))
        return MechanicalQuantity::kinetic;
    if (is_one_of(base, {"E", "W"}) && is_one_of(index, {"p", "P", "pot", "potential"}))
        return MechanicalQuantity::potential;
    if (is_one_of(index, {"", "tot", "total", "sys", "system"})) {
        if (is_one_of(base, {"T", "K", "KE"})) return MechanicalQuantity::kinetic;
        if (is_one_of(base, {"V", "U", "PE", "Pi"})) return MechanicalQuantity::potential;
        if (is_one_of(base, {"L", "Lagrangian"})) return MechanicalQuantity::lagrangian;
        if (is_one_of(base, {"E"})) return MechanicalQuantity::energy;
        if (is_one_of(base, {"H", "Hamiltonian"})) return MechanicalQuantity::hamiltonian;
    }
    if (index.empty()) return std::nullopt;
    if (base == "p") return MechanicalQuantity::momentum;
    if (base == "Q") return MechanicalQuantity::force;
    return std::nullopt;
}

bool is_letter_of_constant(const Letter& letter) {
    const bool is_number = letter.index.find_first_not_of("0123456789") == std::string::npos;
    return is_one_of(letter.base, {"C", "c", "h"}) && is_number && letter.accent.empty();
}

std::string plain_word(const std::string& text) {
    std::string result;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

std::string identifier_of(const Letter& letter) {
    std::string result = letter.base;
    if (!letter.accent.empty() &&
        !is_one_of(letter.accent, {"mathrm", "mathit", "mathbf", "boldsymbol", "mathcal"}))
        result += "_" + letter.accent;
    if (letter.raised == "*") result += "_star";
    for (const std::string* part : {&letter.index, &letter.raised}) {
        std::string word;
        for (const char c : *part)
            if (std::isalnum(static_cast<unsigned char>(c)) != 0)
                word += c;
            else if (!word.empty() && word.back() != '_')
                word += '_';
        while (!word.empty() && word.back() == '_') word.pop_back();
        if (!word.empty()) result += "_" + word;
    }
    return result;
}

Letters::Letters(const Scene& scene) {
    const auto know = [&](const std::string& name, bool moves) {
        scene_names_.insert(name);
        if (moves) moving_.insert(name);
    };
    for (const Coordinate& c : scene.coordinates) know(c.name.text, true), coordinates_.push_back(c.name.text);
    for (const Speed& s : scene.speeds) know(s.name.text, true);
    for (const FirstOrderState& z : scene.states) know(z.name.text, true);
    for (const Input& i : scene.inputs) know(i.name.text, true);
    for (const Definition& d : scene.definitions) know(d.name.text, true);
    for (const Parameter& p : scene.parameters) know(p.name.text, false);
    for (const UnspecifiedFunction& f : scene.functions) know(f.name.text, false), functions_.insert(f.name.text);
    for (const ConstraintRule& c : scene.constraints)
        know(c.multiplier ? c.multiplier->text : "lambda_" + c.name.text, false);
    for (const RollingRule& r : scene.rolling)
        for (const Name& name : multipliers_of(r)) know(name.text, false);
    for (const UnilateralRule& u : scene.unilateral) know("lambda_" + u.name.text, false);
    taken_ = scene_names_;
    for (const MechanicalQuantity quantity :
         {MechanicalQuantity::kinetic, MechanicalQuantity::potential, MechanicalQuantity::lagrangian,
          MechanicalQuantity::energy, MechanicalQuantity::hamiltonian})
        taken_.insert(name_of(quantity));
    for (const std::string& q : coordinates_) taken_.insert({"p_" + q, "Q_" + q});
    // A name that is written exactly so comes before one that another hand would write so.
    std::vector<std::vector<Letter>> all;
    std::size_t most = 0;
    for (const std::string& name : scene_names_)
        all.push_back(letters_of(name)), most = std::max(most, all.back().size());
    for (std::size_t rank = 0; rank < most; ++rank) {
        std::size_t k = 0;
        for (const std::string& name : scene_names_) {
            const std::vector<Letter>& letters = all[k++];
            if (rank < letters.size()) written_so_.emplace(letters[rank], name);
        }
    }
    // A rate that is typed as w is written ω.
    const auto know_rate = [&](const std::string& name, const std::string& unit) {
        const bool is_bare = name.find_first_not_of("w0123456789") == std::string::npos;  // w, w0: no width
        const bool is_rate = unit == "rad/s" || unit == "1/s" || unit == "deg/s" || unit == "rpm" ||
                             unit == "s^-1" || (unit.empty() && is_bare);
        if (!name.starts_with("w") || (!is_rate && !moving_.contains(name))) return;
        for (Letter letter : letters_of(name))
            if (letter.base == "w") letter.base = "omega", written_so_.emplace(letter, name);
    };
    for (const Parameter& p : scene.parameters) know_rate(p.name.text, p.unit);
    for (const Speed& s : scene.speeds) know_rate(s.name.text, s.unit);
    for (const Coordinate& c : scene.coordinates) know_rate(c.name.text, "");
}

void Letters::bind(const Letter& letter, const std::string& name) {
    bound_[letter] = name;
    taken_.insert(name);
}

std::optional<std::string> Letters::in_scene(const Letter& letter) const {
    for (const bool with_accent : {true, false}) {
        if (!with_accent &&
            !is_one_of(letter.accent, {"mathrm", "mathit", "mathbf", "boldsymbol", "bar", "tilde"}))
            break;
        for (const std::string& base : hands_of(letter.base)) {
            const Letter plain{.base = base,
                               .index = index_word(letter.index),
                               .raised = letter.raised,
                               .accent = with_accent ? letter.accent : ""};
            if (const auto found = written_so_.find(plain); found != written_so_.end()) return found->second;
            for (const auto& [written, name] : written_so_)
                if (written.base == base && index_word(written.index) == plain.index && plain.raised.empty() &&
                    plain.accent.empty())
                    return name;
        }
        if (letter.accent.empty()) break;
    }
    return std::nullopt;
}

std::optional<std::string> Letters::of_mechanics(const Letter& letter) const {
    const std::optional<MechanicalQuantity> quantity = quantity_of(letter);
    if (!quantity || open_.contains(letter)) return std::nullopt;
    if (*quantity != MechanicalQuantity::momentum && *quantity != MechanicalQuantity::force)
        return name_of(*quantity);
    const std::string coordinate = coordinate_of(letter.index);
    if (coordinate.empty()) return std::nullopt;
    const std::string name = (*quantity == MechanicalQuantity::momentum ? "p_" : "Q_") + coordinate;
    if (scene_names_.contains(name)) return std::nullopt;
    return name;
}

std::optional<std::string> Letters::name_of(const Letter& letter, bool as_quantity) const {
    if (const auto found = bound_.find(letter); found != bound_.end()) return found->second;
    if (own_.contains(letter)) return std::nullopt;
    if (as_quantity)
        if (const auto quantity = of_mechanics(letter)) return quantity;
    const auto exact = written_so_.find(letter);
    if (exact != written_so_.end()) return exact->second;
    if (const auto quantity = of_mechanics(letter)) return quantity;
    if (const auto found = in_scene(letter)) return found;
    if (letter == Letter{.base = "t", .index = {}, .raised = {}, .accent = {}}) return "t";
    if (letter == Letter{.base = "pi", .index = {}, .raised = {}, .accent = {}}) return "pi";
    return std::nullopt;
}

std::string Letters::name_of(MechanicalQuantity quantity) const {
    static const std::map<MechanicalQuantity, std::array<const char*, 2>> names{
        {MechanicalQuantity::kinetic, {"T", "T_kinetic"}},
        {MechanicalQuantity::potential, {"V", "V_potential"}},
        {MechanicalQuantity::lagrangian, {"L", "L_lagrangian"}},
        {MechanicalQuantity::energy, {"E", "E_energy"}},
        {MechanicalQuantity::hamiltonian, {"H", "H_hamiltonian"}}};
    const auto& [plain, longer] = names.at(quantity);
    return scene_names_.contains(plain) ? longer : plain;
}

std::string Letters::coordinate_of(const std::string& index) const {
    const std::string word = index_word(index);
    for (const std::string& q : coordinates_)
        if (index_word(q) == word) return q;
    for (const std::string& q : coordinates_)
        for (const std::string& hand : hands_of(word))
            if (index_word(q) == hand) return q;
    for (const auto& [letter, name] : bound_) {  // φ for theta: p_φ is p_theta; q_1 for x: Q_1 is Q_x
        const bool is_it = letter.index.empty() ? index_word(letter.base) == word
                                                : letter.base == "q" && index_word(letter.index) == word;
        if (is_it && std::find(coordinates_.begin(), coordinates_.end(), name) != coordinates_.end()) return name;
    }
    for (std::size_t k = 0; k < coordinates_.size(); ++k)
        if (word == std::to_string(k + 1)) return coordinates_[k];
    return {};
}

std::string Letters::free_name(std::string wanted) const {
    while (taken_.contains(wanted)) wanted += "_";
    return wanted;
}

}  // namespace alembert
