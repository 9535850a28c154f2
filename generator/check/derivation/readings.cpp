// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/readings.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "check/derivation/claim_text.hpp"
#include "check/derivation/marker.hpp"
#include "check/derivation/sines_by_index.hpp"
#include "check/written/word_kinds.hpp"
#include "check/written/words.hpp"

namespace alembert {

namespace {

using Kind = Math::Kind;

constexpr int most_tried = 6;

/// The letter that stands alone on a side; null if none does.
const Letter* alone_in(const Math& side) {
    const Lone lone = lone_letter(side);
    return lone.letter == nullptr ? nullptr : &lone.letter->letter;
}

bool speaks_of(const Math& math, const Letter& letter) {
    std::map<Letter, int> all;
    collect_letters(math, all);
    return all.contains(letter);
}

/// The sides of a line: the k-th pair of its statement.
std::pair<const Math*, const Math*> pair_of(const Written& written, const std::vector<MarkedLine>& lines,
                                            std::size_t k) {
    const std::vector<MathPtr>& sides = written.statements[lines[k].statement].sides;
    std::size_t first = k;
    while (first > 0 && lines[first - 1].statement == lines[k].statement) --first;
    const std::size_t pair = k - first;
    if (pair + 1 >= sides.size()) return {nullptr, nullptr};
    return {sides[pair].get(), sides[pair + 1].get()};
}

bool is_any_energy(const Letter& letter) {
    const auto quantity = quantity_of(letter);
    return quantity && quantity != MechanicalQuantity::momentum && quantity != MechanicalQuantity::force;
}

bool has_motion(const Math& math, const Letters& letters) {
    std::map<Letter, int> all;
    collect_letters(math, all);
    return std::any_of(all.begin(), all.end(), [&](const auto& item) {
        const auto name = letters.name_of(item.first);
        return !name || item.second > 0 || letters.moves(*name) || !letters.is_of_scene(*name);
    });
}

/// θ'²: an energy, and no momentum.
bool holds_square_of_rate(const Math& math) {
    const bool is_square =
        math.kind == Kind::power && math.args[0]->kind == Kind::letter && math.args[0]->dots > 0;
    return is_square || std::any_of(math.args.begin(), math.args.end(),
                                    [](const MathPtr& arg) { return holds_square_of_rate(*arg); });
}

/// How many rates are multiplied in it, at most.
int degree_in_rates(const Math& math) {
    if (math.kind == Kind::letter) return math.dots > 0 ? 1 : 0;
    if (math.kind == Kind::power) return 2 * degree_in_rates(*math.args[0]);
    int sum = 0, most = 0;
    for (const MathPtr& arg : math.args)
        sum += degree_in_rates(*arg), most = std::max(most, degree_in_rates(*arg));
    return math.kind == Kind::product ? sum : most;
}

bool is_linear_in_rates(const Math& math) {
    return degree_in_rates(math) == 1;
}

std::ptrdiff_t mistakes(const std::vector<MarkedLine>& lines) {
    return std::count_if(lines.begin(), lines.end(),
                         [](const MarkedLine& line) { return line.status == LineStatus::mistake; });
}

std::ptrdiff_t rights(const std::vector<MarkedLine>& lines) {
    return std::count_if(lines.begin(), lines.end(), [](const MarkedLine& line) { return is_right(line.status); });
}

/// p_φ = (J + m R² sin² θ) φ' = K, K = m (u v' − v u') = const: a chain in which the letter is a momentum or keeps
/// its value, linear in rates.
bool is_integral(const Written& written, const Letter& letter) {
    return std::any_of(
        written.statements.begin(), written.statements.end(), [&](const WrittenStatement& statement) {
            bool is_there = false, is_kept = false, is_linear = false;
            for (const MathPtr& side : statement.sides) {
                const Letter* const own = alone_in(*side);
                is_there = is_there || (own != nullptr && *own == letter);
                is_kept = is_kept || (own != nullptr && (is_word_for_constant(own->base) || own->base == "cost" ||
                                                         (own->base == "p" && !own->index.empty())));
                is_linear = is_linear || is_linear_in_rates(*side);
            }
            return is_there && is_kept && is_linear;
        });
}

/// The letter q of a derivation about one coordinate, which he calls nothing else: l q'' + g cos q = 0.
bool calls_coordinate_q(const Letters& letters, const Written& written) {
    const Letter q{.base = "q"};
    if (letters.coordinates().size() != 1 || letters.name_of(q)) return false;
    bool is_used = false;
    for (const WrittenStatement& statement : written.statements) {
        std::map<Letter, int> all;
        for (const MathPtr& side : statement.sides) collect_letters(*side, all);
        const bool speaks_of_q = all.contains(q);
        for (const auto& [letter, dots] : all) {
            const auto name = letters.name_of(letter);
            if (name && letters.moves(*name)) return false;
            is_used = is_used || (speaks_of_q && name && letters.is_of_scene(*name));
        }
    }
    return is_used;
}

/// A parameter with a bar or a tilde, where the plain one stands too: B̄ = B + m d².
std::vector<Letter> barred_letters(const Letters& letters, const Written& written) {
    std::map<Letter, int> all;
    for (const WrittenStatement& statement : written.statements)
        for (const MathPtr& side : statement.sides) collect_letters(*side, all);
    std::vector<Letter> result;
    for (const auto& item : all) {
        if (item.first.accent != "bar" && item.first.accent != "tilde") continue;
        Letter plain = item.first;
        plain.accent.clear();
        const auto name = letters.name_of(plain);
        if (all.contains(plain) && name && !letters.moves(*name)) result.push_back(item.first);
    }
    return result;
}

}  // namespace

/// "The force function U is", or V = −U.
bool states_force_function(const Written& written) {
    return std::any_of(
        written.statements.begin(), written.statements.end(), [](const WrittenStatement& statement) {
            if (asserts_force_function(statement.words)) return true;
            for (std::size_t k = 0; k + 1 < statement.sides.size(); ++k) {
                const Letter* const V = alone_in(*statement.sides[k]);
                const Math& other = *statement.sides[k + 1];
                const Letter* const U = other.kind == Math::Kind::negate ? alone_in(*other.args[0]) : nullptr;
                if (V != nullptr && U != nullptr && U->base == "U" && U->index.empty() && is_any_energy(*V))
                    return true;
            }
            return false;
        });
}

Letters with_authors_letters(Letters letters, const Written& written) {
    if (states_force_function(written)) letters.leave_to_author({.base = "U"});
    if (calls_coordinate_q(letters, written)) letters.bind({.base = "q"}, letters.coordinates()[0]);
    for (const WrittenStatement& statement : written.statements)
        for (std::size_t k = 0; k + 1 < statement.sides.size(); ++k)
            for (const bool turned : {false, true}) {
                const Math &side = *statement.sides[turned ? k + 1 : k],
                           &value = *statement.sides[turned ? k : k + 1];
                const Letter* const letter = alone_in(side);
                if (letter == nullptr || speaks_of(value, *letter)) continue;
                const bool is_general =
                    letter->index.empty() && (letter->base == "u" || letter->base == "q" || letter->base == "Q");
                std::map<Letter, int> all;
                collect_letters(value, all);
                const bool is_known = !all.empty() && std::all_of(all.begin(), all.end(), [&](const auto& item) {
                    return letters.name_of(item.first).has_value();
                });
                const auto name = letters.name_of(*letter);
                const bool is_named_here = turned && statement.relations[k] == Relation::identical &&
                                           alone_in(value) == nullptr;  // T + V =: K
                const bool is_own_q = letter->base == "q" && !letter->index.empty();
                if (is_known && (is_named_here || ((is_general || is_own_q) && !name)))
                    letters.leave_to_author(*letter);
                const bool is_assigned = statement.relations[k] == Relation::identical && !turned;
                if (is_assigned && is_any_energy(*letter) && name && !letters.is_of_scene(*name) && is_known &&
                    std::any_of(all.begin(), all.end(), [](const auto& item) { return item.second > 0; }) &&
                    !holds_square_of_rate(value))
                    letters.leave_to_author(*letter);  // K := m r² φ'
                if (is_any_energy(*letter) && name && !letters.is_of_scene(*name) && is_known &&
                    !has_motion(value, letters))
                    letters.leave_to_author(*letter);  // no energy is a constant in parameters
                const bool is_scenes = name && letters.is_of_scene(*name) && identifier_of(*letter) == *name;
                if (!is_scenes && has_motion(value, letters) && is_known && !holds_square_of_rate(value) &&
                    speaks_of_angular_momentum(statement.words))
                    letters.leave_to_author(*letter);
            }
    for (const Letter& letter : barred_letters(letters, written)) letters.leave_to_author(letter);
    if (is_integral(written, {.base = "K"})) letters.leave_to_author({.base = "K"});
    return letters;
}

std::vector<MarkedLine> Readings::marked_with(const Letters& letters) const {
    Marker marker(system_, written_, letters);
    marker.run();
    return std::move(marker.lines);
}

bool Readings::has_sines_of_two_angles(const Letters& letters) const {
    const auto sines = sines_by_index(written_, letters, system_.scene());
    return std::any_of(sines.begin(), sines.end(),
                       [](const auto& item) { return item.second.find('+') != std::string::npos; });
}

Readings::Uses Readings::uses(const std::vector<MarkedLine>& lines, std::size_t k, const Letter& letter) const {
    Uses result;
    for (std::size_t i = k + 1; i < lines.size(); ++i) {
        const auto [left, right] = pair_of(written_, lines, i);
        if (left == nullptr || (!speaks_of(*left, letter) && !speaks_of(*right, letter))) continue;
        if (lines[i].statement == lines[k].statement && i == k + 1 && alone_in(*left) != nullptr &&
            *alone_in(*left) == letter)
            continue;  // x = a = b
        ++result.all;
        result.right += is_right(lines[i].status) ? 1 : 0;
    }
    return result;
}

std::optional<Letter> Readings::perhaps_defined(const std::vector<MarkedLine>& lines, std::size_t k,
                                                const Letters& letters, const std::set<Letter>& given) const {
    if (lines[k].status != LineStatus::mistake) return std::nullopt;
    const auto [left, right] = pair_of(written_, lines, k);
    for (const auto& [side, value] : {std::pair(left, right), std::pair(right, left)}) {
        const Letter* const letter = side == nullptr ? nullptr : alone_in(*side);
        if (letter == nullptr || is_word_for_constant(letter->base) || is_any_energy(*letter) ||
            letters.is_authors(*letter) || given.contains(*letter) || speaks_of(*value, *letter))
            continue;
        const auto name = letters.name_of(*letter);
        if (name && letters.is_of_scene(*name) && identifier_of(*letter) == *name) continue;
        bool is_new = true;  // the first line that speaks of it
        for (std::size_t i = 0; i < k; ++i) {
            const auto [a, b] = pair_of(written_, lines, i);
            if (a != nullptr && (speaks_of(*a, *letter) || speaks_of(*b, *letter))) is_new = false;
        }
        if (is_new) return *letter;
    }
    return std::nullopt;
}

Letters Readings::settle(Letters letters, const std::set<Letter>& given) const {
    std::vector<MarkedLine> lines = marked_with(letters);
    if (mistakes(lines) > 0 && has_sines_of_two_angles(letters)) {
        Letters other = letters;
        other.read_sines_of_differences();
        std::vector<MarkedLine> otherwise = marked_with(other);
        const auto falseness = [](const auto& all) { return std::pair(mistakes(all), -rights(all)); };
        if (falseness(otherwise) < falseness(lines)) {
            letters = std::move(other);
            lines = std::move(otherwise);
        }
    }
    int tried = 0;
    for (std::size_t k = 0; k < lines.size() && tried < most_tried; ++k) {
        const std::optional<Letter> letter = perhaps_defined(lines, k, letters, given);
        if (!letter) continue;
        ++tried;
        Letters other = letters;
        other.leave_to_author(*letter);
        std::vector<MarkedLine> otherwise = marked_with(other);
        if (otherwise.size() != lines.size() || otherwise[k].status == LineStatus::mistake) continue;
        const Uses guessed = uses(lines, k, *letter), own = uses(otherwise, k, *letter);
        const bool is_authors = own.right >= guessed.right && own.all > 0 && mistakes(otherwise) < mistakes(lines);
        if (!is_authors) continue;
        letters = std::move(other);
        lines = std::move(otherwise);
    }
    return letters;
}

void Readings::withhold(std::vector<MarkedLine>& lines, const Letters& letters,
                        const std::set<Letter>& given) const {
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const std::optional<Letter> letter = perhaps_defined(lines, k, letters, given);
        const bool bears_out = std::any_of(lines.begin(), lines.end(), [&](const MarkedLine& line) {
            return line.status == LineStatus::follows && line.follows_from == k;  // T = ½ m v² with this v
        });
        const std::string& words = written_.statements[lines[k].statement].words;
        const auto [left, right] = pair_of(written_, lines, k);
        const bool is_integral =
            letter && is_letter_of_constant(*letter) && right != nullptr && alone_in(*right) != nullptr;  // … = C
        const bool is_told = speaks_of_conservation(words) || speaks_of_frequency(words) || is_integral;
        if (!letter || !letter->index.empty() || bears_out || is_told || uses(lines, k, *letter).all > 0) continue;
        lines[k].status = LineStatus::undecided;
        lines[k].checked = {};
        const std::string name = identifier_of(*letter);
        lines[k].reason =
            say("it is wrong of what {} usually is here; if {} is a letter of your own, the line defines it, "
                "and no later line tells",
                name, name);
    }
    bool has_mistake = false;
    for (MarkedLine& line : lines) {
        has_mistake = has_mistake || line.status == LineStatus::mistake || line.status == LineStatus::follows;
        if (line.status != LineStatus::unfounded || has_mistake) continue;
        line.status = LineStatus::right;  // what it did not follow from is no mistake
        line.reason.clear();
        line.follows_from.reset();
    }
}

}  // namespace alembert
