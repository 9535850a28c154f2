// SPDX-License-Identifier: GPL-2.0-or-later
// Parentheses, groups, vectors and matrices, numbers with units.

#include <algorithm>

#include "base/language/greek.hpp"
#include "base/language/say.hpp"
#include "check/written/windows.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

bool opens(WrittenToken::Kind kind) {
    using Kind = WrittenToken::Kind;
    return kind == Kind::open || kind == Kind::begin_group || kind == Kind::begin_environment ||
           kind == Kind::no_open;
}

bool closes(WrittenToken::Kind kind) {
    using Kind = WrittenToken::Kind;
    return kind == Kind::close || kind == Kind::end_group || kind == Kind::end_environment ||
           kind == Kind::no_close;
}

/// Whether two tokens can be the halves of one bracket. Brackets of different kinds may: [0, 1).
bool are_halves(WrittenToken::Kind open, WrittenToken::Kind close) {
    using Kind = WrittenToken::Kind;
    if (open == Kind::begin_group || close == Kind::end_group)
        return open == Kind::begin_group && close == Kind::end_group;
    return (open == Kind::begin_environment) == (close == Kind::end_environment);
}

}  // namespace

std::vector<std::size_t> partners(const std::vector<WrittenToken>& tokens) {
    using Kind = WrittenToken::Kind;
    std::vector<std::size_t> partner(tokens.size(), no_partner), open;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (opens(tokens[i].kind)) {
            open.push_back(i);
            if (open.size() > static_cast<std::size_t>(most_written_nesting))
                throw BeyondLimit{tokens[i].offset,
                                  say("the formula is nested more than {} levels deep", most_written_nesting)};
        } else if (closes(tokens[i].kind) && !open.empty()) {
            // What was not closed inside a group or an environment does not go on after it; at most
            // `most_written_nesting` are looked at.
            std::size_t k = open.size();
            while (k > 0 && !are_halves(tokens[open[k - 1]].kind, tokens[i].kind)) {
                const Kind wall = tokens[open[k - 1]].kind;
                if (tokens[i].kind == Kind::close &&
                    (wall == Kind::begin_group || wall == Kind::begin_environment)) {
                    k = 0;
                    break;
                }
                --k;
            }
            if (k == 0) continue;
            partner[i] = open[k - 1];
            partner[open[k - 1]] = i;
            open.resize(k - 1);
        }
    }
    return partner;
}

/// The expressions between commas.
std::vector<MathPtr> MathParser::listed(std::size_t begin, std::size_t end) {
    std::vector<MathPtr> list;
    for (const Range& range : argument_ranges(begin, end)) {
        const bool is_dots = range.end == range.begin + 1 && kind(range.begin) == Kind::dots;  // L(q_1, …, q_n)
        const bool is_value = range.end > range.begin + 2 && kind(range.begin) == Kind::letter &&
                              kind(range.begin + 1) == Kind::relation &&
                              token(range.begin + 1).text == "=";  // x(t=0)
        if (is_dots)
            list.push_back(node({.kind = Math::Kind::letter, .letter = {.base = "dots"}}, range.begin));
        else
            list.push_back(within(is_value ? range.begin + 2 : range.begin, range.end));
    }
    return list;
}

std::vector<MathParser::Range> MathParser::argument_ranges(std::size_t begin, std::size_t end) const {
    std::vector<Range> ranges{{begin, end}};
    for (std::size_t i = begin; i < end; ++i) {
        if (opens(tokens_[i].kind) && partner_[i] != no_partner && partner_[i] < end) {
            i = partner_[i];
        } else if (tokens_[i].kind == Kind::comma || tokens_[i].kind == Kind::semicolon) {
            ranges.back().end = i;
            ranges.push_back({i + 1, end});
        }
    }
    return ranges;
}

namespace {

MathPtr grouped(const MathPtr& inside) {
    if (inside->kind != Math::Kind::applied) return inside;
    auto result = std::make_shared<Math>(*inside);
    result->grouped = true;
    return result;
}

}  // namespace

MathPtr MathParser::bracket() {
    const std::size_t begin = at_;
    const std::size_t close = closing(begin);
    if (close == begin + 1) {
        ++at_;
        unexpected(say("an expression in the brackets"));
    }
    const bool is_value = tokens_[begin].kind == Kind::no_open && tokens_[close].text == "|";
    if (is_value) fail(close, say("a value at a place, |_…, was found; expected the value written out"));
    std::vector<MathPtr> list = listed(begin + 1, close);
    at_ = close + 1;
    if (is(Kind::index)) fail(at_, say("brackets with an index were found; expected a letter before an index"));
    if (tokens_[begin].text == "|")
        return node({.kind = Math::Kind::call, .text = "abs", .args = {list[0]}}, begin);
    if (list.size() == 1) return grouped(list[0]);
    return node({.kind = Math::Kind::vector, .args = std::move(list)}, begin);
}

MathPtr MathParser::group() {
    const std::size_t begin = at_;
    const std::size_t close = closing(begin);
    if (close == begin + 1) {  // {}^{N}\omega
        at_ = close + 1;
        if (at_ >= end_) unexpected(say("a term"));
        Letter letter;
        int dots = 0;
        const bool is_marked = is(Kind::power) || is(Kind::index);
        while (is(Kind::power) || is(Kind::index))
            if (is(Kind::index))
                add_index(letter, dots);
            else if (!add_raised(letter, dots))
                unexpected(say("a term"));
        const MathPtr following = primary();
        if (!is_marked) return following;
        if (following->kind != Math::Kind::letter)
            fail(begin, say("marks before a term were found; expected a letter after them"));
        Letter marked = following->letter;
        const auto join = [](const std::string& a, const std::string& b) {
            return a.empty() || b.empty() ? a + b : a + "," + b;
        };
        marked.raised = join(letter.raised, marked.raised);
        marked.index = join(letter.index, marked.index);
        return node({.kind = Math::Kind::letter, .letter = marked, .dots = following->dots}, begin);
    }
    const MathPtr inside = within(begin + 1, close);
    at_ = close + 1;
    if (inside->kind == Math::Kind::letter) return letter(inside->letter, inside->dots, begin);
    return grouped(inside);
}

/// Column vectors and matrices.
MathPtr MathParser::environment() {
    const std::size_t begin = at_;
    const std::size_t close = closing(begin);
    const std::string& name = tokens_[begin].text;
    static constexpr std::string_view known[] = {"pmatrix", "bmatrix",     "matrix", "array",
                                                 "Bmatrix", "smallmatrix", "tabular"};
    if (std::find(std::begin(known), std::end(known), name) == std::end(known))
        fail(begin, say("an environment {} was found within a formula; expected a vector or a matrix", name));
    std::vector<std::vector<MathPtr>> rows{{}};
    std::size_t from = begin + 1;
    const auto add_cell = [&](std::size_t end) {
        const bool is_empty = from >= end;  // an empty cell is 0
        if (!is_empty || rows.back().size() > 0 || tokens_[end].kind == Kind::ampersand)
            rows.back().push_back(is_empty ? node({.kind = Math::Kind::number, .text = "0"}, begin)
                                           : within(from, end));
        from = end + 1;
    };
    for (std::size_t i = begin + 1; i < close; ++i) {
        if (opens(tokens_[i].kind) && partner_[i] != no_partner && partner_[i] < close) {
            i = partner_[i];
        } else if (tokens_[i].kind == Kind::ampersand) {
            add_cell(i);
        } else if (tokens_[i].kind == Kind::row) {
            add_cell(i);
            rows.emplace_back();
        }
    }
    if (from < close || rows.back().size() > 0) add_cell(close);
    if (rows.back().empty()) rows.pop_back();
    at_ = close + 1;
    if (rows.empty()) fail(begin, say("a matrix without entries was found"));
    bool is_column = true;
    for (const std::vector<MathPtr>& row : rows) {
        is_column &= row.size() == 1;
        if (row.size() != rows[0].size()) fail(begin, say("the rows of the matrix have different lengths"));
    }
    std::vector<MathPtr> parts;
    for (std::vector<MathPtr>& row : rows)
        parts.push_back(is_column ? row[0] : node({.kind = Math::Kind::vector, .args = std::move(row)}, begin));
    return node({.kind = is_column ? Math::Kind::vector : Math::Kind::matrix, .args = std::move(parts)}, begin);
}

/// Whether a product ends here: what stands before can have a unit.
bool MathParser::ends_product(std::size_t i) const {
    if (i >= end_) return true;
    const Kind what = kind(i);
    return what == Kind::plus || what == Kind::minus || what == Kind::relation || what == Kind::comma ||
           what == Kind::semicolon || what == Kind::close || what == Kind::arrow || what == Kind::period;
}

/// The end of a unit that begins at `i`, whose text becomes `unit`; `i` itself if there is none.
std::size_t MathParser::unit_end(std::size_t i, std::string& unit) const {
    const std::size_t begin = i;
    bool is_certain = false, has_sign = false;
    const bool is_upright = token(i).upright;
    while (i < end_) {
        const WrittenToken& what = token(i);
        std::string word;
        if (what.kind == Kind::text)
            word = what.text;
        else if (what.kind == Kind::letter && what.dots == 0 && (what.upright || !is_upright))
            word = what.text.empty() || what.text == "word" ? what.letter.base : what.text;
        const bool is_angle = !what.upright && greek_named(word) != nullptr;  // 2ψ is no pressure in psi
        const bool is_word = word.size() > 3 && word.find_first_of("0123456789") == std::string::npos;
        const bool is_known = is_unit_symbol(word) || ((what.upright || is_word) && is_known_unit(word));
        if (word.empty() || is_angle || (what.kind == Kind::letter && !is_known)) return begin;
        if (what.kind == Kind::text && (!meaning_of_unit(word) || word.find_first_of("0123456789") == 0))
            return begin;
        is_certain |= what.upright || what.kind == Kind::text || word.size() > 1;
        unit += word;
        ++i;
        if (kind(i) == Kind::power) {
            std::size_t k = i + 1;
            const bool is_group = kind(k) == Kind::begin_group;
            if (is_group) ++k;
            std::string sign;
            if (kind(k) == Kind::minus) sign = "-", ++k;
            if (kind(k) != Kind::number) return begin;
            unit += "^" + sign + token(k).text;
            i = k + (is_group ? 2 : 1);
        }
        if (kind(i) == Kind::divide || kind(i) == Kind::times) {
            has_sign |= kind(i) == Kind::divide;
            unit += kind(i) == Kind::divide ? "/" : "*";
            ++i;
        } else if (kind(i) == Kind::letter && token(i).upright && is_upright) {
            unit += " ";
        } else {
            break;
        }
    }
    static constexpr std::string_view of_letters[] = {"m/s", "m/s^2", "N/m", "N*m", "J/s"};  // and not 2h/m
    const bool is_usual = std::find(std::begin(of_letters), std::end(of_letters), unit) != std::end(of_letters);
    return is_certain || (has_sign && is_usual) ? i : begin;
}

/// A number and the unit after it, if one stands there: \mathrm{m/s^2}, kg, 30^\circ.
MathPtr MathParser::quantity(const MathPtr& value, std::size_t begin) {
    if (is(Kind::power)) {
        const std::size_t sign = at_++;
        const Range range = script_range();
        if (range.end == range.begin + 1 && kind(range.begin) == Kind::letter &&
            token(range.begin).letter.base == "degree") {
            at_ = range.begin == at_ ? range.end : range.end + 1;
            return node({.kind = Math::Kind::quantity, .text = "deg", .args = {value}}, begin);
        }
        at_ = sign;
        return value;
    }
    std::string unit;
    const std::size_t end = unit_end(at_, unit);
    if (end == at_ || !ends_product(end)) return value;
    at_ = end;
    return node({.kind = Math::Kind::quantity, .text = unit, .args = {value}}, begin);
}

}  // namespace alembert
