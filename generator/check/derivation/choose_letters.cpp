// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/choose_letters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "check/derivation/claim_text.hpp"
#include "check/derivation/general_law.hpp"
#include "check/derivation/marker.hpp"
#include "check/derivation/readings.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_trials = 240, fewest_trials = 8;
constexpr std::size_t most_lines_tried = 4000;  // about 20 s

std::string shown(const Letter& letter) {
    Math math{.kind = Math::Kind::letter};
    math.letter = letter;
    return latex(math);
}

/// The letter that the user means: "\\ell", "θ_1".
Letter letter_in(const std::string& text) {
    const Written written = read_derivation("$" + text + " = 0$", "--letters");
    if (written.statements.size() == 1 && written.statements[0].sides.size() == 2) {
        const Math& side = *written.statements[0].sides[0];
        if (side.kind == Math::Kind::letter) return side.letter;
    }
    throw SceneError(say("'{}' is not one letter; expected such as \\ell or \\theta_1", text), {});
}

/// Letters of the derivation that nothing gives a meaning: they stand in no scene, and no line introduces them
/// before they are used.
struct OpenLetters {
    std::vector<Letter> moving, constant;
};

OpenLetters open_letters(const Written& written, const Letters& letters) {
    std::map<Letter, int> all;
    std::set<Letter> introduced;
    for (const WrittenStatement& statement : written.statements) {
        const auto is_general = [&](const MathPtr& side) {
            return states_general_law(*side, letters, statement.displayed);
        };
        if (std::any_of(statement.sides.begin(), statement.sides.end(), is_general)) continue;
        for (const MathPtr& whole : statement.sides) {
            const Math* const side = whole->kind == Math::Kind::power ? whole->args[0].get() : whole.get();
            const bool alone = side->kind == Math::Kind::letter && side->dots == 0 && statement.sides.size() > 1;
            if (alone && !all.contains(side->letter)) introduced.insert(side->letter);
        }
        for (const MathPtr& side : statement.sides) collect_letters(*side, all);
    }
    OpenLetters result;
    for (const auto& [letter, dots] : all) {
        if (letters.name_of(letter) || introduced.contains(letter)) continue;
        (dots > 0 ? result.moving : result.constant).push_back(letter);
    }
    return result;
}

/// Names of the scene that no letter of the derivation is.
std::vector<std::string> unused(const std::vector<std::string>& names, const Written& written,
                                const Letters& letters) {
    std::map<Letter, int> all;
    for (const WrittenStatement& statement : written.statements)
        for (const MathPtr& side : statement.sides) collect_letters(*side, all);
    std::set<std::string> used;
    for (const auto& [letter, dots] : all)
        if (const auto name = letters.name_of(letter)) used.insert(*name);
    std::vector<std::string> result;
    for (const std::string& name : names)
        if (!used.contains(name)) result.push_back(name);
    return result;
}

using Assignment = std::vector<std::pair<Letter, std::string>>;

/// All ways to give each letter another name, as long as there are not too many.
std::vector<Assignment> assignments(const std::vector<Letter>& letters, const std::vector<std::string>& names,
                                    std::size_t most) {
    std::vector<Assignment> result{{}};
    for (const Letter& letter : letters) {
        std::vector<Assignment> longer;
        for (const Assignment& begun : result) {
            longer.push_back(begun);  // none of them
            for (const std::string& name : names) {
                const bool taken =
                    std::any_of(begun.begin(), begun.end(), [&](const auto& pair) { return pair.second == name; });
                if (taken) continue;
                longer.push_back(begun);
                longer.back().emplace_back(letter, name);
            }
        }
        if (longer.size() > most) return result;
        result = std::move(longer);
    }
    return result;
}

/// Letters of which partial derivatives are taken: T of ∂T/∂q'.
void collect_differentiated(const Math& math, std::set<Letter>& letters) {
    if (math.kind == Math::Kind::partial && math.args[0]->kind == Math::Kind::letter)
        letters.insert(math.args[0]->letter);
    for (const MathPtr& part : math.args) collect_differentiated(*part, letters);
}

/// Letters of mechanics that stand in an equation of motion as forces do: the tension T in m y'' = T − m g. One of
/// which partial derivatives are taken is none.
std::set<Letter> perhaps_forces(const Written& written, const Letters& letters) {
    std::set<Letter> result, differentiated;
    for (const WrittenStatement& statement : written.statements)
        for (const MathPtr& side : statement.sides) collect_differentiated(*side, differentiated);
    for (const WrittenStatement& statement : written.statements) {
        if (std::none_of(statement.sides.begin(), statement.sides.end(),
                         [](const MathPtr& side) { return is_accelerated(*side); }))
            continue;
        std::map<Letter, int> here;
        for (const MathPtr& side : statement.sides) collect_letters(*side, here);
        for (const auto& [letter, dots] : here)
            if (const auto name = letters.name_of(letter);
                name && quantity_of(letter) && !letters.is_of_scene(*name) && !differentiated.contains(letter))
                result.insert(letter);
    }
    return result;
}

/// Whether a letter stands in anything but alone on a side, as a term of a sum, or in ∂L/∂q'.
bool stands_otherwise(const Math& math, const Letter& letter, bool is_term) {
    using Kind = Math::Kind;
    if (math.kind == Kind::letter) return math.letter == letter && (!is_term || math.dots > 0);
    const bool is_sum = math.kind == Kind::sum || math.kind == Kind::negate;
    for (std::size_t k = 0; k < math.args.size(); ++k)
        if (stands_otherwise(*math.args[k], letter, (is_sum && is_term) || (math.kind == Kind::partial && k == 0)))
            return true;
    return false;
}

/// Parameters and inputs of the scene whose letters the author writes for energies alone: L for the Lagrangian
/// where the scene's L is a length that he does not use. What stands beside accelerations may be a force.
std::map<Letter, std::string> energies_in_place_of_names(const Scene& scene, const Written& written,
                                                         const Letters& letters) {
    std::set<std::string> steady;
    for (const Parameter& p : scene.parameters) steady.insert(p.name.text);
    for (const Input& i : scene.inputs) steady.insert(i.name.text);
    std::map<Letter, std::string> result;
    std::set<Letter> others;
    for (const WrittenStatement& statement : written.statements) {
        std::map<Letter, int> all;
        for (const MathPtr& side : statement.sides) collect_letters(*side, all);
        const bool is_accelerated_here = std::any_of(statement.sides.begin(), statement.sides.end(),
                                                     [](const MathPtr& side) { return is_accelerated(*side); });
        for (const auto& item : all) {
            const Letter& letter = item.first;
            const auto quantity = quantity_of(letter);
            const auto name = letters.name_of(letter);
            if (!quantity || !name || !steady.contains(*name) || *quantity == MechanicalQuantity::momentum ||
                *quantity == MechanicalQuantity::force)
                continue;
            const bool is_other =
                is_accelerated_here ||
                std::any_of(statement.sides.begin(), statement.sides.end(),
                            [&](const MathPtr& side) { return stands_otherwise(*side, letter, true); });
            if (is_other)
                others.insert(letter);
            else
                result.emplace(letter, letters.name_of(*quantity));
        }
    }
    std::erase_if(result, [&](const auto& item) { return others.contains(item.first); });
    return result;
}

double score_of(DerivedSystem& system, const Written& written, const Letters& letters) {
    Marker marker(system, written, letters);
    marker.run();
    return marker.score();
}

/// Whether a user may give a letter this name: one of the scene, its rate, or an energy.
bool is_name(const std::string& name, const Letters& letters) {
    const std::string stem = name.substr(0, name.find('\''));
    const bool is_energy = name.size() == 1 && std::string_view("TVLEH").find(name) != std::string_view::npos;
    return is_energy || letters.is_of_scene(stem);
}

std::string without_lines(std::string name) {
    std::erase(name, '_');
    return name;
}

/// Tells of letters that are written in another hand than the scene's: \ell for l.
void tell_hands(ChosenLetters& chosen, const Written& written) {
    std::map<Letter, int> all;
    for (const WrittenStatement& statement : written.statements)
        for (const MathPtr& side : statement.sides) collect_letters(*side, all);
    for (const auto& [letter, dots] : all) {
        const auto name = chosen.letters.name_of(letter);
        if (name && chosen.letters.is_of_scene(*name) &&
            without_lines(identifier_of(letter)) != without_lines(*name))
            chosen.told.emplace(shown(letter), *name);
    }
}

/// Whether letters of this hand and names of that are written for the same kind of thing.
bool are_of_one_kind(const std::string& letter, const std::string& name) {
    static const std::vector<std::set<std::string>> kinds{
        {"l", "L", "ell", "R", "r", "a", "b", "d", "h", "s", "D", "H", "rho", "e", "c"},
        {"m", "M", "mu"},
        {"g", "G"},
        {"k", "K", "c", "C", "kappa"},
        {"J", "I", "Theta", "A", "B", "C"},
        {"c", "b", "d", "beta", "gamma", "delta", "mu", "eta", "k"},
        {"F", "P", "Q", "S", "N", "T", "f", "lambda", "mu", "R"},
        {"omega", "Omega", "w", "nu", "n"},
        {"theta", "phi", "varphi", "vartheta", "alpha", "beta", "psi", "gamma", "delta", "q", "chi"},
        {"x", "y", "z", "r", "s", "q", "u", "xi", "eta", "zeta", "rho", "X", "Y", "Z"}};
    std::string base = name.substr(0, name.find('_'));
    while (base.size() > 1 && std::isdigit(static_cast<unsigned char>(base.back())) != 0) base.pop_back();
    return letter == base || std::any_of(kinds.begin(), kinds.end(), [&](const std::set<std::string>& kind) {
               return kind.contains(letter) && kind.contains(base);
           });
}

/// What speaks for a guess: the lines with the letter that are right, and those that are mistakes.
bool is_borne_out(const std::pair<Letter, std::string>& guess, const Written& written, const Marker& marker) {
    int right = 0, wrong = 0;
    for (const MarkedLine& line : marker.lines) {
        std::map<Letter, int> all;
        for (const MathPtr& side : written.statements[line.statement].sides) collect_letters(*side, all);
        if (!all.contains(guess.first)) continue;
        right += is_right(line.status) || line.status == LineStatus::unfounded ? 1 : 0;
        wrong += line.status == LineStatus::mistake ? 1 : 0;
    }
    const int needed = are_of_one_kind(guess.first.base, guess.second) ? 1 : 2;
    return right >= needed && right >= wrong;
}

Letters with(Letters letters, const Assignment& assignment) {
    for (const auto& [letter, name] : assignment) letters.bind(letter, name);
    return letters;
}

}  // namespace

ChosenLetters choose_letters(DerivedSystem& system, const Written& written,
                             const std::map<std::string, std::string>& given) {
    ChosenLetters result{.letters = Letters(system.scene()), .told = {}, .given = {}, .remarks = {}};
    const Scene& scene = system.scene();
    for (const auto& [text, name] : given) {
        if (!is_name(name, result.letters))
            throw SceneError(say("the letter {} is said to be '{}', and the scene has no such name; it has {}",
                                 text, name, fmt::join(result.letters.scene_names(), ", ")),
                             {});
        result.letters.bind(letter_in(text), name);
        result.given.insert(letter_in(text));
        result.told[text] = name;
    }
    result.letters = with_authors_letters(std::move(result.letters), written);
    for (const auto& [letter, name] : energies_in_place_of_names(scene, written, result.letters)) {
        if (result.given.contains(letter)) continue;
        Letters otherwise = result.letters;
        otherwise.bind(letter, name);
        if (score_of(system, written, otherwise) <= score_of(system, written, result.letters)) continue;
        result.remarks.push_back(
            say("{} is read as the energy or Lagrangian that usually has this letter, not as the scene's {}",
                shown(letter), result.letters.name_of(letter).value_or("")));
        result.letters = std::move(otherwise);
    }
    for (const Letter& letter : perhaps_forces(written, result.letters)) {
        Letters otherwise = result.letters;
        otherwise.leave_open(letter);
        if (score_of(system, written, otherwise) <= score_of(system, written, result.letters)) continue;
        result.letters = std::move(otherwise);
        result.remarks.push_back(say("{} is a force here, no energy or momentum", shown(letter)));
    }
    const OpenLetters open = open_letters(written, result.letters);
    std::vector<std::string> parameters;
    for (const Parameter& p : scene.parameters) parameters.push_back(p.name.text);
    for (const Input& i : scene.inputs) parameters.push_back(i.name.text);
    for (const GiNaC::symbol& multiplier : system.equations().lambda) parameters.push_back(multiplier.get_name());
    Assignment best;
    const std::size_t most = std::clamp(most_lines_tried / std::max<std::size_t>(1, written.statements.size()),
                                        fewest_trials, most_trials);
    for (const auto& [letters, names] :
         {std::pair(open.moving, unused(result.letters.coordinates(), written, result.letters)),
          std::pair(open.constant, unused(parameters, written, result.letters))}) {
        if (letters.empty() || names.empty()) continue;
        double highest = -1e9;
        Assignment chosen;
        for (const Assignment& trial : assignments(letters, names, most)) {
            Assignment whole = best;
            whole.insert(whole.end(), trial.begin(), trial.end());
            const double score = score_of(system, written, with(result.letters, whole));
            if (score > highest) highest = score, chosen = whole;
        }
        best = chosen;
    }
    if (!best.empty()) {
        Marker marker(system, written, with(result.letters, best));
        marker.run();
        std::erase_if(best, [&](const auto& guess) { return !is_borne_out(guess, written, marker); });
    }
    result.letters = with(std::move(result.letters), best);
    for (const auto& [letter, name] : best) result.told[shown(letter)] = name;
    tell_hands(result, written);
    return result;
}

}  // namespace alembert
