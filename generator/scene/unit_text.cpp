// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/unit_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "base/language/say.hpp"
#include "scene/hints.hpp"
#include "scene/text.hpp"
#include "scene/tokens.hpp"
#include "scene/typed.hpp"
#include "scene/unit_pounds.hpp"

namespace alembert {

namespace {

constexpr int most_unit_exponent = 64;      // as in expressions
constexpr double most_unit_factor = 1e250;  // the factor times a number stays a number of double precision

bool digit_stands_at(const std::string& text, std::size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

/// "mm2" without its digits; the word itself where it ends with none.
std::string without_digits(const std::string& word) {
    const std::size_t last = word.find_last_not_of("0123456789");
    return last == std::string::npos ? word : word.substr(0, last + 1);
}

class UnitText {
public:
    /// The words that begin at `forces` are forces: the pounds of torques.
    UnitText(const std::string& text, const OwnUnits& own, UnitReading& reading, std::set<std::size_t> forces = {})
        : text_(text), own_(own), reading_(reading), forces_(std::move(forces)) {}

    UnitMeaning meaning() {
        UnitMeaning result = product();
        if (at_ < text_.size())
            stop(static_cast<int>(at_), say("this parenthesis closes nothing: none is open here"));
        return result;
    }

    const std::vector<WrittenWord>& words() const { return words_; }

private:
    bool take(char c) {
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    [[noreturn]] void refuse(std::size_t at, std::string message) const {
        stop(static_cast<int>(std::min(at, text_.size())), std::move(message));
    }

    /// What joins two words.
    struct Link {
        std::string text;  ///< "*", " per " as "/"
        bool divides = false;
    };
    Link link(bool is_first) {
        const std::size_t begin = at_;
        std::size_t sign = std::string::npos;
        Link result;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            const bool is_word = text_.compare(at_, 4, "per ") == 0 && at_ > begin;
            const bool is_sign = is_word || c == '*' || c == '/' || c == '.' || (c == '-' && !is_first);
            if (!is_sign && c != ' ' && c != '\t') break;
            if (is_sign && (is_first || sign != std::string::npos))
                refuse(at_, say("a word of a unit is missing before '{}'", is_word ? "per" : std::string(1, c)));
            if (is_sign) sign = at_;
            result.divides |= is_word || c == '/';
            result.text += is_word || c == '/' ? '/' : c == '-' ? '*' : c;
            at_ += is_word ? 4 : 1;
            if (is_word) result.text = "/";
        }
        const bool is_end = at_ >= text_.size() || text_[at_] == ')';
        if (is_end && sign != std::string::npos)
            refuse(sign, say("nothing follows '{}'",
                             text_.compare(sign, 3, "per") == 0 ? "per" : text_.substr(sign, 1)));
        if (!is_end && !is_first && result.text.empty() && text_[at_ - 1] != ')' && text_[at_] != '(')
            result.text = "*";  // kg²m
        return result;
    }

    UnitMeaning product() {
        UnitMeaning result;
        bool is_first = true;
        while (true) {
            const Link before = link(is_first);
            if (at_ >= text_.size() || text_[at_] == ')') {
                if (is_first) refuse(at_, say("a unit is missing here"));
                return result;
            }
            multiply(result, before, is_first);
            is_first = false;
        }
    }

    /// A word or a parenthesis with its exponent.
    void multiply(UnitMeaning& result, const Link& before, bool is_first) {
        const std::size_t first = words_.size();
        const bool has_brackets = take('(');
        const std::vector<UnitMeaning> factors = has_brackets ? std::vector{in_brackets()} : word();
        const std::size_t begin = at_;
        const int power = exponent();
        for (std::size_t k = first; k < words_.size(); ++k)
            words_[k].power *= (before.divides ? -1 : 1) * (has_brackets || k + 1 == words_.size() ? power : 1);
        const bool is_alone = is_first && begin == text_.size() && factors.size() == 1;
        std::string si;
        for (const UnitMeaning& factor : factors)
            si += (si.empty() ? "" : "*") + (is_compound(factor) && !is_alone ? "(" + factor.si + ")" : factor.si);
        si += text_.substr(begin, at_ - begin);
        result.si += before.text + (factors.size() > 1 && before.divides ? "(" + si + ")" : si);
        for (std::size_t k = 0; k < factors.size(); ++k)
            multiply(result, factors[k], (before.divides ? -1 : 1) * (k + 1 == factors.size() ? power : 1));
        const double size = std::abs(result.factor);
        if (!(size <= most_unit_factor) || !(size >= 1 / most_unit_factor))
            refuse(begin, say("this unit is beyond the range of double precision"));
    }

    UnitMeaning in_brackets() {
        const std::size_t opening = at_ - 1;
        if (++depth_ > 100) refuse(opening, say("nested more than {} levels deep", 100));
        UnitMeaning inside = product();
        if (!take(')')) refuse(opening, say("this parenthesis is never closed"));
        --depth_;
        inside.si = "(" + inside.si + ")";
        return inside;
    }

    /// Whether its unit of the SI, unlike itself, is made of several: "rpm".
    static bool is_compound(const UnitMeaning& word) {
        return !word.si.starts_with('(') && word.si.find_first_of("/*^ ") != std::string::npos;
    }

    static void multiply(UnitMeaning& result, const UnitMeaning& factor, int power) {
        result.exponents = multiplied(std::move(result.exponents), factor.exponents, power);
        result.factor *= std::pow(factor.factor, power);
        if (factor.exact.empty()) return;
        const int size = std::abs(power);
        if (result.exact.empty() && power == 1) {
            result.exact = factor.exact;
            return;
        }
        if (result.exact.empty()) result.exact = "1";
        result.exact += fmt::format("{}({}){}", power < 0 ? "/" : "*", factor.exact,
                                    size == 1 ? "" : fmt::format("^{}", size));
    }

    /// ^2, ^-1, ², -1 or 2 right after a word.
    int exponent() {
        const std::size_t begin = at_;
        const bool has_sign = take('^');
        const bool has_bracket = has_sign && take('(');
        const bool minus = (has_sign || digit_stands_at(text_, at_ + 1)) && take('-');
        if (has_sign && !minus) take('+');
        if (!has_sign && !digit_stands_at(text_, at_)) return at_ = begin, 1;
        int value = 0;
        const std::size_t digits = at_;
        while (digit_stands_at(text_, at_)) value = std::min(1000, 10 * value + (text_[at_++] - '0'));
        const bool is_fraction = at_ < text_.size() && ((text_[at_] == '.' && digit_stands_at(text_, at_ + 1)) ||
                                                        (has_bracket && text_[at_] == '/'));
        if (at_ == digits || is_fraction || (has_bracket && !take(')')))
            refuse(begin, say("the power of a unit is a whole number"));
        if (value == 0 || value > most_unit_exponent)
            refuse(begin, say("the exponent {} of a unit is not between 1 and {} in size",
                              text_.substr(digits, at_ - digits), most_unit_exponent));
        return minus ? -value : value;
    }

    /// The end of the word that begins here; a hyphen between letters belongs to it.
    std::size_t word_end() const {
        std::size_t end = at_;
        while (end < text_.size()) {
            std::size_t next = end;
            const char32_t c = decode(text_, next);
            if (c == U'-') {
                const bool is_between = end > at_ && next < text_.size();
                if (!is_between || !is_letter_at(next)) break;
            } else if (!is_unit_letter(c) && !is_digit(c)) {
                break;
            }
            end = next;
        }
        return end;
    }

    static bool is_unit_letter(char32_t c) {
        return is_letter(c) || c == U'°' || c == U'º' || c == U'%' || c == U'℃' || c == U'℉';
    }
    bool is_letter_at(std::size_t at) const { return is_unit_letter(decode(text_, at)); }

    /// The one or the two units that a word is; `at_` is then behind it, and before the digits of its exponent.
    std::vector<UnitMeaning> word() {
        const std::size_t begin = at_;
        std::size_t end = word_end();
        if (end == begin) {
            std::size_t after = begin;
            decode(text_, after);
            refuse(begin, say("{} has no place in a unit", in_quotes(text_.substr(begin, after - begin))));
        }
        std::string name = text_.substr(begin, end - begin);
        if (auto units = joined(name, end)) return *std::move(units);
        for (std::size_t hyphen; (hyphen = name.rfind('-')) != std::string::npos;) {
            name.resize(hyphen);
            end = begin + hyphen;
            if (auto units = joined(name, end)) return *std::move(units);
        }
        if (const UnitMeaning* const known = own_unit(own_, name)) {
            at_ = end;
            reading_.has_own = true;
            return {written(name, begin, *known)};
        }
        if (is_digit(static_cast<unsigned char>(name[0])) && name != "1")
            refuse(begin, say("a unit has no number but its exponents; the number is the value"));
        return {written(name, begin, of_word(name, end))};
    }

    UnitMeaning written(const std::string& name, std::size_t begin, UnitMeaning meaning) {
        if (forces_.contains(begin)) meaning = *unit_word(force_of_mass(meaning)).meaning;
        words_.push_back({name, begin, 1, meaning});
        return meaning;
    }

    /// Two words as one: "kNm", "kgm2", "ftlb".
    std::optional<std::vector<UnitMeaning>> joined(const std::string& name, std::size_t end) {
        if (own_unit(own_, name) != nullptr || unit_word(name).meaning) return {};
        const std::string stem = without_digits(name);
        if (unit_word(stem).meaning) return {};
        auto words = joined_units(stem);
        const bool is_damping = !words && stem.ends_with("ms");  // Nms, kNmms
        if (is_damping) words = joined_units(stem.substr(0, stem.size() - 1));
        if (!words || (is_damping && !words->first.ends_with('N'))) return {};
        at_ = end - (name.size() - stem.size());
        const std::size_t begin = end - name.size();
        std::vector<UnitMeaning> units;
        units.push_back(written(words->first, begin, *unit_word(words->first).meaning));
        const std::size_t second = begin + words->first.size();
        units.push_back(written(words->second, second, *unit_word(words->second).meaning));
        if (is_damping) units.push_back(written("s", at_ - 1, *unit_word("s").meaning));
        return units;
    }

    UnitMeaning of_word(const std::string& name, std::size_t end) {
        at_ = end;
        if (is_no_multiple(name))
            refuse(end - name.size(),
                   say("'{}' has a zero of its own or is a logarithm, and a quantity is a multiple of "
                       "its unit; write it in K, or as a ratio",
                       name));
        UnitWord known = unit_word(name);
        if (const std::string stem = without_digits(name); !known.meaning && stem.size() < name.size()) {
            const UnitMeaning* const own = own_unit(own_, stem);
            UnitWord of_stem = own == nullptr ? unit_word(stem) : UnitWord{*own};
            if (of_stem.meaning) {
                at_ = end - (name.size() - stem.size());
                reading_.has_own |= own != nullptr;
                known = std::move(of_stem);
            }
        }
        if (!known.meaning || !known.meant.empty())
            reading_.doubts.push_back({text_.substr(end - name.size(), at_ - (end - name.size())),
                                       std::move(known.meant), known.meaning.has_value()});
        return known.meaning ? *std::move(known.meaning) : UnitMeaning{{{name, 1}}, 1, "", name};
    }

    const std::string& text_;
    const OwnUnits& own_;
    UnitReading& reading_;
    const std::set<std::size_t> forces_;
    std::vector<WrittenWord> words_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

/// Tells of a mass that may be meant as a force, with the text that has the force.
void tell_mass(const std::string& text, const UnitText& read, const std::set<std::size_t>& forces,
               UnitReading& reading) {
    const WrittenWord* const mass = doubtful_mass(read.words(), forces);
    if (mass == nullptr || !reading.doubts.empty()) return;
    std::string meant = text;
    meant.replace(mass->begin, mass->word.size(), force_of_mass(mass->meaning));
    reading.doubts.push_back({text, std::move(meant), true, mass->word});
}

}  // namespace

UnitExponents multiplied(UnitExponents a, const UnitExponents& b, double exponent) {
    for (const auto& [base, power] : b)
        if ((a[base] += exponent * power) == 0) a.erase(base);
    return a;
}

const UnitMeaning* own_unit(const OwnUnits& own, const std::string& word) {
    auto found = own.find(word);
    if (found == own.end() && word.ends_with('s') && !unit_word(word).meaning)
        found = own.find(word.substr(0, word.size() - 1));
    return found == own.end() ? nullptr : &found->second;
}

UnitReading read_unit(const std::string& text, const OwnUnits& own) {
    UnitReading reading;
    try {
        UnitText read(text, own, reading);
        reading.meaning = read.meaning();
        const std::set<std::size_t> forces = pounds_of_force(read.words());
        tell_mass(text, read, forces, reading);
        UnitReading none;
        if (!forces.empty()) reading.meaning = UnitText(text, own, none, forces).meaning();
    } catch (const Mistake& mistake) {
        reading.mistake = mistake.message;
        reading.offset = mistake.offset;
    }
    return reading;
}

namespace {

/// Whether its words are known.
bool is_certain(const UnitReading& reading) {
    return reading.meaning && (reading.doubts.empty() || !reading.doubts[0].mass.empty());
}

}  // namespace

std::string advice_on_mass(const UnitDoubt& doubt) {
    return say("'{}' is read with the mass '{}'; if a force is meant, write {}", escaped(doubt.word),
               escaped(doubt.mass), escaped(doubt.meant));
}

std::optional<UnitMeaning> meaning_of_unit(const std::string& text) {
    std::string plain = text;
    std::vector<Place> none;
    write_plainly(plain, none);
    return read_unit(plain).meaning;
}

std::string per_second(const std::string& unit, int times) {
    if (unit.empty()) return {};
    const std::string below = times == 1 ? "/s" : fmt::format("/s^{}", times);
    if (unit == "1" || unit == "-") return "1" + below;
    return (unit.find_first_of("/ ") == std::string::npos ? unit : "(" + unit + ")") + below;
}

bool is_known_unit(const std::string& word) {
    if (word.empty() || is_digit(static_cast<unsigned char>(word[0]))) return word == "1";
    return is_certain(read_unit(word));
}

bool is_product_of_units(const std::string& first, const std::string& second) {
    const UnitReading one = read_unit(first + second), two = read_unit(first + "*" + second);
    return is_certain(one) && is_certain(two) && one.meaning->exponents == two.meaning->exponents &&
           std::abs(one.meaning->factor / two.meaning->factor - 1) < 1e-12;
}

bool is_unit_symbol(const std::string& word) {
    const UnitWord known = unit_word(word);
    return known.meaning && known.is_symbol;
}

}  // namespace alembert
