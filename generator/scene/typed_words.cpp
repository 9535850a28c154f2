// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/typed_words.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/language/greek.hpp"
#include "scene/advice.hpp"
#include "scene/functions.hpp"
#include "scene/text.hpp"
#include "scene/typed.hpp"
#include "scene/typed_pieces.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

constexpr std::size_t longest_in_words = 64 * 1024;  // more is refused as an expression

struct Rewording {
    std::size_t begin, end;
    std::string words;
};

/// Collects what is to be replaced; no two of these overlap.
class WordReader {
public:
    WordReader(std::string_view text, const KnownNames& names) : pieces_(text), names_(names) {}

    std::vector<Rewording> edits() {
        for (std::size_t k = 0; k + 1 < pieces_.size(); k = std::max(k, skipped_) + 1)
            if (pieces_[k].kind == TypedPiece::Kind::command)
                command(k);
            else if (pieces_.is(k, "^") && pieces_.opens(k + 1, "{"))
                round(k + 1, "(", ")");
            else if (pieces_.is_word(k) && !is_unit(k))
                word(k);
        std::stable_sort(edits_.begin(), edits_.end(), [](const Rewording& a, const Rewording& b) {
            return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
        });
        return std::move(edits_);
    }

private:
    const TypedPieces pieces_;
    const KnownNames& names_;
    std::vector<Rewording> edits_;
    std::size_t skipped_ = 0;  ///< the last piece that needs no look of its own

    void replace(std::size_t k, std::string words) {
        edits_.push_back({pieces_[k].begin, pieces_[k].end, std::move(words)});
    }
    void remove(std::size_t first, std::size_t last) {
        edits_.push_back({pieces_[first].begin, pieces_[last].end, ""});
    }
    /// Puts words right behind a piece.
    void append(std::size_t k, std::string words) {
        edits_.push_back({pieces_[k].end, pieces_[k].end, std::move(words)});
    }

    bool is_call(std::size_t k) const { return pieces_.opens(k + 1, "("); }

    /// A unit stands right behind a number.
    bool is_unit(std::size_t k) const {
        const std::string word(pieces_.word(k));
        return k > 0 && pieces_[k - 1].kind == TypedPiece::Kind::number && !is_call(k) && !names_.has(word) &&
               (is_known_unit(word) || names_.units().contains(word));
    }

    void word(std::size_t k) {
        if (index_in_braces(k, std::string(pieces_.word(k)))) return;
        const std::string text(pieces_.word(k));
        if (names_.has(text) || find_function(text) != nullptr) return known(k, text);
        if (is_call(k) && call(k, text)) return;
        if (is_of_library(k, text)) return remove(k, k + 1);
        if (text == "e" && pieces_.is(k + 1, "^")) return exponential(k);
        if (text == "π" || text == "Pi" || text == "PI") return replace(k, "pi");
        if (quotient_of_differentials(k, text)) return;
        std::string meant = names_.meant(text);
        const bool moves = !meant.empty() && names_.moves(meant);
        if (meant.empty()) meant = names_.rate_meant(text);
        if (meant.empty()) return;
        replace(k, meant);
        if (moves || meant.ends_with('\'')) drop_time(k);
    }

    /// x_{1} is x_1, or x1 where the scene has that; \theta_1 likewise. `letters` is what stands before the index.
    bool index_in_braces(std::size_t k, const std::string& letters) {
        const bool is_command = pieces_[k].kind == TypedPiece::Kind::command;
        const std::size_t next = k + 1, open = is_command ? k + 2 : k + 1;
        const bool is_apart = pieces_[next].begin != pieces_[k].end;
        if (is_apart || (is_command ? !pieces_.word(next).starts_with('_') : !letters.ends_with('_')))
            return false;
        const bool has_braces = (is_command ? pieces_.is(next, "_") : true) && pieces_.opens(open, "{") &&
                                pieces_[open].match == open + 2;
        if (!has_braces && !is_command) return false;
        const std::string index(has_braces ? pieces_.word(open + 1) : pieces_.word(next).substr(1));
        const std::string stem = is_command ? letters : letters.substr(0, letters.size() - 1);
        std::string name = names_.meant(stem + "_" + index);
        if (name.empty()) name = names_.meant(stem + index);
        replace(k, name.empty() ? stem + "_" + index : name);
        const std::size_t last = has_braces ? open + 2 : next;
        remove(next, last);
        skipped_ = last;
        return true;
    }

    /// np.sin and math.pi of Python.
    bool is_of_library(std::size_t k, const std::string& text) const {
        const bool is_library = text == "np" || text == "numpy" || text == "math" || text == "Math" ||
                                text == "sp" || text == "sympy" || text == "sm";
        const std::string next(pieces_.word(k + 2));
        return is_library && pieces_.is(k + 1, ".") &&
               (find_function(next) != nullptr || !function_meant(next).empty() || next == "pi");
    }

    void known(std::size_t k, const std::string& text) {
        if (find_function(text) == nullptr) {
            if (names_.moves(text)) drop_time(k);
        } else if (const std::string meant = names_.meant(text);
                   !meant.empty() && (!is_call(k) || is_of_time(k + 1))) {
            replace(k, meant);  // alpha and omega are functions, too: those of a body
            if (names_.moves(meant)) drop_time(k);
        } else if (text == "dot" && is_call(k) && pieces_[k + 1].commas.empty()) {
            rate_of_name(k, "'");
        }
    }

    /// x(t) is x, and x'(t) is x'.
    void drop_time(std::size_t k) {
        const std::size_t open = k + (pieces_[k + 1].kind == TypedPiece::Kind::primes ? 2 : 1);
        if (is_of_time(open)) remove(open, open + 2);
    }

    /// "(t)"
    bool is_of_time(std::size_t open) const {
        return pieces_.opens(open, "(") && pieces_.is(open + 1, "t") && pieces_[open].match == open + 2 &&
               !names_.has("t");
    }

    bool call(std::size_t k, const std::string& text) {
        if (const std::string_view function = function_meant(text); !function.empty()) {
            replace(k, std::string(function));
            return true;
        }
        if (text == "ddot") return rate_of_name(k, "''");
        if (text == "der" || text == "Derivative") return derivative(k);
        return false;
    }

    /// The name of what moves in the parentheses behind the word, in the scene's spelling; empty if there is more.
    std::string moving_name_in(std::size_t open, std::size_t last) const {
        const bool has_time = last == open + 5 && pieces_.is(open + 2, "(") && pieces_.is(open + 3, "t");
        if (!pieces_.is_word(open + 1) || (last != open + 2 && !has_time)) return {};
        const std::string name = names_.meant(std::string(pieces_.word(open + 1)));
        return names_.moves(name) ? name : std::string();
    }

    /// dot(theta) is theta'.
    bool rate_of_name(std::size_t k, const std::string& primes) {
        const std::size_t open = k + 1, close = pieces_[open].match;
        if (!pieces_[open].commas.empty() || moving_name_in(open, close).empty()) return false;
        remove(k, open);
        edits_.push_back({pieces_[close].begin, pieces_[close].end, primes});
        return true;
    }

    /// Derivative(x, t), Derivative(x, t, 2), Derivative(x, t, t), Derivative(x, (t, 2)), der(x).
    bool derivative(std::size_t k) {
        const std::size_t open = k + 1, close = pieces_[open].match;
        const std::vector<std::size_t>& commas = pieces_[open].commas;
        const std::size_t last = commas.empty() ? close : commas[0];
        std::string by;
        for (std::size_t i = last; i < close; ++i) by += pieces_.word(i);
        std::string primes;
        if (by.empty() ? pieces_.is(k, "der") : by == ",t" || by == ",t,1" || by == ",(t,1)")
            primes = "'";
        else if (by == ",t,2" || by == ",t,t" || by == ",(t,2)")
            primes = "''";
        else
            return false;
        const bool is_name = !moving_name_in(open, last).empty();
        remove(k, is_name ? open : k);
        edits_.push_back({pieces_[last].begin, pieces_[close].end, (is_name ? "" : ")") + primes});
        return true;
    }

    /// dx/dt, d2x/dt2 and d2x/dt^2, where the scene has x, and none of the other words.
    bool quotient_of_differentials(std::size_t k, const std::string& text) {
        const bool is_second = text.starts_with("d2");
        const std::string name = text.starts_with('d') ? names_.meant(text.substr(is_second ? 2 : 1)) : "";
        if (name.empty() || !names_.moves(name) || !pieces_.is(k + 1, "/")) return false;
        const std::string by(pieces_.word(k + 2));
        const bool has_power = is_second && by == "dt" && pieces_.is(k + 3, "^") && pieces_.is(k + 4, "2");
        if (names_.has(by) || !(is_second ? has_power || by == "dt2" : by == "dt")) return false;
        replace(k, name + (is_second ? "''" : "'"));
        remove(k + 1, has_power ? k + 4 : k + 2);
        return true;
    }

    /// e^x is exp(x): the parenthesis closes where the exponent ends.
    void exponential(std::size_t k) {
        constexpr int most_levels = 200;  // more is refused
        std::size_t last = k + 1;
        for (int level = 0; level < most_levels; ++level) {
            ++last;
            while (pieces_.is(last, "-") || pieces_.is(last, "+")) ++last;
            const bool is_named = pieces_.is_word(last) || pieces_[last].kind == TypedPiece::Kind::command;
            if (is_named && (pieces_.opens(last + 1, "(") || pieces_.opens(last + 1, "{"))) ++last;
            if (pieces_.opens(last, "(") || pieces_.opens(last, "{"))
                last = pieces_[last].match;
            else if (!is_named && pieces_[last].kind != TypedPiece::Kind::number)
                return;
            if (pieces_[last + 1].kind == TypedPiece::Kind::primes) ++last;
            if (!pieces_.is(last + 1, "^")) break;
            ++last;
        }
        remove(k, k + 1);
        edits_.back().words = "exp(";
        append(last, ")");
    }

    // --- commands of LaTeX

    void command(std::size_t k) {
        const std::string name(pieces_.word(k).substr(1));
        if (name == "dot" || name == "ddot" || name == "dddot") {
            dots(k, std::string(name.size() - 2, '\''));
        } else if (name == "cdot" || name == "times") {
            replace(k, "*");
        } else if (name == "left" || name == "right" || name == "," || name == ";" || name == "!" || name == " ") {
            replace(k, " ");
        } else if (name == "frac" || name == "dfrac" || name == "tfrac") {
            fraction(k);
        } else if (name == "sqrt" && pieces_.opens(k + 1, "{")) {
            replace(k, "sqrt");
            round(k + 1, "(", ")");
        } else if (const std::string written = letter_or_function(name); !written.empty()) {
            if (!index_in_braces(k, written)) replace(k, apart(k, written));
        }
    }

    /// With blanks where the word would run into its neighbours: \cos\theta.
    std::string apart(std::size_t k, const std::string& word) const {
        using Kind = TypedPiece::Kind;
        const TypedPiece &before = pieces_[k == 0 ? 0 : k - 1], &after = pieces_[k + 1];
        const bool joins_before =
            k > 0 && before.end == pieces_[k].begin && (before.kind == Kind::word || before.kind == Kind::number);
        const bool joins_after =
            after.begin == pieces_[k].end && (after.kind == Kind::word || after.kind == Kind::command);
        return (joins_before ? " " : "") + word + (joins_after ? " " : "");
    }

    /// "theta", as the scene spells it, for \theta; "sin" for \sin.
    std::string letter_or_function(const std::string& command) const {
        if (const std::string own = names_.meant(command); !own.empty()) return own;
        if (is_reserved_function(command)) return command;
        if (!function_meant(command).empty()) return std::string(function_meant(command));
        const GreekLetter* const greek = greek_named(command);
        if (greek == nullptr) return {};
        const std::string name(greek->name.substr(greek->name.starts_with("var") ? 3 : 0));
        const std::string meant = names_.meant(name);
        return meant.empty() ? name : meant;
    }

    void round(std::size_t open, const std::string& begin, const std::string& end) {
        replace(open, begin);
        replace(pieces_[open].match, end);
    }

    /// \dot{x}, \dot x, \dot\theta.
    void dots(std::size_t k, const std::string& primes) {
        const std::size_t next = k + 1;
        if (pieces_.opens(next, "{")) {
            const bool is_name = pieces_[next].match == next + 2;
            remove(k, k);
            round(next, is_name ? "" : "(", (is_name ? "" : ")") + primes);
        } else if (pieces_.is_word(next) || pieces_[next].kind == TypedPiece::Kind::command) {
            remove(k, k);
            append(next, primes);
        }
    }

    void fraction(std::size_t k) {
        const std::size_t above = k + 1;
        if (!pieces_.opens(above, "{")) return;
        const std::size_t below = pieces_[above].match + 1;
        if (!pieces_.opens(below, "{")) return;
        remove(k, k);
        round(above, "((", ")");
        round(below, "/(", "))");
    }
};

void reword(const std::vector<Rewording>& edits, std::string& text, std::vector<Place>& places) {
    std::string written;
    std::vector<Place> new_places;
    const auto keep = [&](std::size_t begin, std::size_t end) {
        written.append(text, begin, end - begin);
        if (places.empty()) return;
        for (std::size_t i = begin; i < end; ++i) new_places.push_back(places[std::min(i, places.size() - 1)]);
    };
    std::size_t done = 0;
    for (const Rewording& edit : edits) {
        if (edit.begin < done) continue;
        keep(done, edit.begin);
        written += edit.words;
        if (!places.empty())
            new_places.insert(new_places.end(), edit.words.size(),
                              places[std::min(edit.begin, places.size() - 1)]);
        done = edit.end;
    }
    keep(done, text.size());
    if (!places.empty()) new_places.push_back(places.back());
    text = std::move(written);
    places = std::move(new_places);
}

}  // namespace

void write_in_words(std::string& text, std::vector<Place>& places, const KnownNames& names) {
    write_plainly(text, places);
    if (text.size() > longest_in_words) return;
    const std::vector<Rewording> edits = WordReader(text, names).edits();
    if (!edits.empty()) reword(edits, text, places);
}

std::string written_name(std::string name, const KnownNames& names) {
    std::vector<Place> none;
    write_in_words(name, none, names);
    return name;
}

}  // namespace alembert
