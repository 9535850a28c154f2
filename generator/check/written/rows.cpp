// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/rows.hpp"

#include <algorithm>
#include <utility>

#include "check/written/parser.hpp"

namespace alembert {

namespace {

using RowKind = WrittenToken::Kind;

bool is_system(const std::string& name) {
    static constexpr std::string_view names[] = {"cases",  "dcases",  "rcases",   "drcases",
                                                 "array",  "system",  "numcases", "subnumcases",
                                                 "matrix", "pmatrix", "bmatrix",  "Bmatrix"};
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

bool is_framing(const WrittenToken& token) {
    return token.kind == RowKind::begin_environment && is_system(token.text);
}

bool may_start_system(const std::vector<WrittenToken>& tokens, std::size_t i) {
    if (i == 0) return true;
    const RowKind before = tokens[i - 1].kind;
    if (before == RowKind::open) return i == 1 || may_start_system(tokens, i - 1);
    return before == RowKind::row || before == RowKind::ampersand || before == RowKind::space ||
           before == RowKind::arrow || before == RowKind::begin_group;
}

/// Whether nothing but words and separators stands around a bracket.
bool stands_alone(const std::vector<WrittenToken>& tokens, std::size_t open, std::size_t close) {
    const auto separates = [](RowKind kind) {
        return kind == RowKind::text || kind == RowKind::comma || kind == RowKind::semicolon ||
               kind == RowKind::row || kind == RowKind::space || kind == RowKind::arrow ||
               kind == RowKind::period || kind == RowKind::end;
    };
    return separates(open == 0 ? RowKind::end : tokens[open - 1].kind) &&
           separates(close + 1 < tokens.size() ? tokens[close + 1].kind : RowKind::end);
}

/// Marks for each bracket whether a relation or the end of a row stands directly in it.
std::vector<char> holds_relation(const std::vector<WrittenToken>& tokens,
                                 const std::vector<std::size_t>& partner) {
    std::vector<char> holds(tokens.size(), 0);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const RowKind kind = tokens[i].kind;
        if (partner[i] != no_partner && partner[i] > i) open.push_back(i);
        if (partner[i] != no_partner && partner[i] < i && !open.empty()) open.pop_back();
        const bool is_relation = kind == RowKind::relation || (kind == RowKind::row && !tokens[i].text.empty());
        if (is_relation && !open.empty()) holds[open.back()] = 1;
    }
    return holds;
}

}  // namespace

/// {+ b}, \textcolor{red}{+ b}, \underbrace{+ b}_{words}: TeX sets a term of the sum.
bool begins_term(const std::vector<WrittenToken>& tokens, const std::vector<std::size_t>& partner, std::size_t i) {
    if (tokens[i].kind != RowKind::begin_group || partner[i] == no_partner || partner[i] < i + 3 || i == 0)
        return false;
    const RowKind first = tokens[i + 1].kind, before = tokens[i - 1].kind;
    if (first != RowKind::plus && first != RowKind::minus) return false;
    if (before == RowKind::command) return tokens[i - 1].text == "underbrace" || tokens[i - 1].text == "overbrace";
    return before != RowKind::index && before != RowKind::power && before != RowKind::end_group;
}

/// \underbrace before the group, and the words below it.
void drop_label(const std::vector<WrittenToken>& tokens, const std::vector<std::size_t>& partner, std::size_t i,
                std::vector<char>& dropped) {
    dropped[i - 1] = 1;
    const std::size_t mark = partner[i] + 1;
    if (mark + 1 >= tokens.size() || (tokens[mark].kind != RowKind::index && tokens[mark].kind != RowKind::power))
        return;
    const std::size_t last = partner[mark + 1] == no_partner ? mark + 1 : partner[mark + 1];
    for (std::size_t k = mark; k <= last; ++k) dropped[k] = 1;
}

std::vector<WrittenToken> without_frames(std::vector<WrittenToken> tokens) {
    const auto keep_only = [&](const std::vector<char>& dropped) {
        std::vector<WrittenToken> kept;
        for (std::size_t i = 0; i < tokens.size(); ++i)
            if (!dropped[i]) kept.push_back(std::move(tokens[i]));
        tokens = std::move(kept);
    };
    std::vector<std::size_t> partner = partners(tokens);
    std::vector<char> dropped(tokens.size(), 0);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const bool is_open = tokens[i].kind == RowKind::no_open, is_close = tokens[i].kind == RowKind::no_close;
        const bool is_value = is_open && partner[i] != no_partner && tokens[partner[i]].text == "|";
        dropped[i] = (is_open && !is_value) || is_close;
    }
    keep_only(dropped);
    partner = partners(tokens);
    std::vector<char> holds = holds_relation(tokens, partner);
    dropped.assign(tokens.size(), 0);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const RowKind before = i == 0 ? RowKind::row : tokens[i - 1].kind;
        const bool has_partner = partner[i] != no_partner;
        if (begins_term(tokens, partner, i)) {
            dropped[i] = dropped[partner[i]] = 1;
            if (before == RowKind::command) drop_label(tokens, partner, i, dropped);
            continue;
        }
        const RowKind after_empty = i + 2 < tokens.size() ? tokens[i + 2].kind : RowKind::end;
        if (tokens[i].kind == RowKind::begin_group && partner[i] == i + 1 && before != RowKind::index &&
            before != RowKind::power && before != RowKind::command && before != RowKind::end_group &&
            after_empty != RowKind::power && after_empty != RowKind::index) {
            dropped[i] = dropped[i + 1] = 1;  // &{}- c
        } else if (tokens[i].kind == RowKind::begin_group && has_partner && holds[i] && before != RowKind::index &&
                   before != RowKind::power && before != RowKind::command && before != RowKind::end_group) {
            dropped[i] = dropped[partner[i]] = 1;
        } else if (is_framing(tokens[i]) && has_partner && holds[i] && may_start_system(tokens, i)) {
            tokens[i].kind = tokens[partner[i]].kind = RowKind::row;  // a system of equations
        } else if (tokens[i].kind == RowKind::open && has_partner && holds[i] &&
                   stands_alone(tokens, i, partner[i])) {
            dropped[i] = dropped[partner[i]] = 1;  // {x' = y, y' = -x}
        } else if (tokens[i].kind == RowKind::open && i + 1 < tokens.size()) {
            const WrittenToken& next = tokens[i + 1];
            const bool is_brace = (next.kind == RowKind::row && next.text == "begin") || is_framing(next);
            if (!has_partner && is_brace) dropped[i] = 1;
        } else if (tokens[i].kind == RowKind::close && !has_partner && before == RowKind::row) {
            dropped[i] = 1;  // \left. \begin{aligned} … \end{aligned} \right\}
        }
    }
    keep_only(dropped);
    return tokens;
}

namespace {

/// A row without its &.
struct WrittenRow {
    std::vector<WrittenToken> tokens;
    bool begins_empty = false;  // nothing stands before the first &
    bool is_indented = false;   // \quad
    bool has_relation = false;
    bool leads_to_relation =
        false;  // it, or a row that goes on with it, has a relation that is not its first sign
};

bool is_row_sign(RowKind kind) {
    return kind == RowKind::plus || kind == RowKind::minus || kind == RowKind::times || kind == RowKind::divide ||
           kind == RowKind::relation;
}

bool begins_with_sign(const WrittenRow& row) {
    return is_row_sign(row.tokens.front().kind);
}

class RowJoiner {
public:
    RowJoiner(const std::vector<WrittenToken>& tokens, bool joins_rows)
        : tokens_(tokens), partner_(partners(tokens)), joins_rows_(joins_rows) {}

    std::vector<std::vector<WrittenToken>> chains() {
        divide();
        for (std::size_t r = rows_.size(); r-- > 0;) {
            WrittenRow& row = rows_[r];
            const bool has_next = r + 1 < rows_.size() && rows_[r + 1].begins_empty &&
                                  begins_with_sign(rows_[r + 1]) &&
                                  rows_[r + 1].tokens.front().kind != RowKind::relation;
            row.leads_to_relation = (row.has_relation && row.tokens.front().kind != RowKind::relation) ||
                                    (has_next && rows_[r + 1].leads_to_relation);
        }
        std::vector<std::vector<WrittenToken>> chains;
        bool has_relation = false;  // the chain
        for (WrittenRow& row : rows_) {
            const bool joins = !chains.empty() && goes_on(row, chains.back(), has_relation);
            if (!joins) chains.emplace_back();
            has_relation = row.has_relation || (joins && has_relation);
            chains.back().insert(chains.back().end(), std::make_move_iterator(row.tokens.begin()),
                                 std::make_move_iterator(row.tokens.end()));
        }
        return chains;
    }

private:
    const std::vector<WrittenToken>& tokens_;
    const std::vector<std::size_t> partner_;
    const bool joins_rows_;
    WrittenRow row_;
    std::vector<WrittenRow> rows_;
    int cells_ = 0;

    void divide() {
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            const WrittenToken& token = tokens_[i];
            if (partner_[i] != no_partner && partner_[i] > i) {
                copy_bracket(i);
                i = partner_[i];
            } else if (token.kind == RowKind::row) {
                end_row();
            } else if (token.kind == RowKind::ampersand) {
                ++cells_;
                if (row_.tokens.empty()) row_.begins_empty = true;
                // The second & of a row of `align` begins another equation, that of `eqnarray` (a &=& b) does not.
                if (cells_ % 2 == 0 && row_.has_relation && !is_row_sign(row_.tokens.back().kind))
                    add_space(token);
            } else if (token.kind == RowKind::space && row_.tokens.empty()) {
                row_.is_indented = true;
            } else {
                row_.has_relation |= token.kind == RowKind::relation;
                row_.tokens.push_back(token);
            }
        }
        end_row();
    }

    void add_space(const WrittenToken& at) {
        row_.tokens.push_back(at);
        row_.tokens.back().kind = RowKind::space;
    }

    /// All of a bracket; the ends of rows in it, outside of matrices, only divide the line.
    void copy_bracket(std::size_t begin) {
        int matrices = 0;
        for (std::size_t i = begin; i <= partner_[begin]; ++i) {
            const RowKind kind = tokens_[i].kind;
            matrices += kind == RowKind::begin_environment ? 1 : kind == RowKind::end_environment ? -1 : 0;
            if (matrices > 0 || (kind != RowKind::row && kind != RowKind::ampersand))
                row_.tokens.push_back(tokens_[i]);
        }
    }

    void end_row() {
        while (!row_.tokens.empty() && row_.tokens.back().kind == RowKind::space) row_.tokens.pop_back();
        if (!row_.tokens.empty()) rows_.push_back(std::move(row_));
        row_ = {};
        cells_ = 0;
    }

    bool goes_on(const WrittenRow& row, const std::vector<WrittenToken>& chain, bool chain_has_relation) const {
        if (joins_rows_ || row.tokens.front().kind == RowKind::relation || is_row_sign(chain.back().kind))
            return true;
        if (!begins_with_sign(row)) return false;
        if (!chain_has_relation) return true;  // a \\ + b = c
        if (row.begins_empty) return row.is_indented || !row.leads_to_relation;
        return !row.has_relation;
    }
};

}  // namespace

namespace {

/// Whether a line begins with what stands alone on one side: V =, \\dot x_1 =, \\frac{d}{dt} … =
bool begins_equation(const std::vector<WrittenToken>& tokens, const std::vector<std::size_t>& partner,
                     std::size_t begin, std::size_t end) {
    const auto is_derivative_sign = [&](std::size_t i) {
        return i < end && (tokens[i].kind == RowKind::partial ||
                           (tokens[i].kind == RowKind::letter && tokens[i].letter == Letter{.base = "d"}));
    };
    const bool is_fraction = tokens[begin].kind == RowKind::command && tokens[begin].text == "frac";
    const bool is_derivative = is_fraction && is_derivative_sign(begin + 2);
    std::size_t letters = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const RowKind kind = tokens[i].kind;
        if (kind == RowKind::relation) return i > begin && (is_derivative || letters == 1);
        const bool is_bracket = partner[i] != no_partner && partner[i] > i && partner[i] < end;
        const bool is_accent = kind == RowKind::command && !is_fraction;
        const bool is_script =
            kind == RowKind::index || kind == RowKind::primes || (kind == RowKind::open && is_bracket);
        const bool is_letter = kind == RowKind::letter || kind == RowKind::begin_group;
        if (!is_derivative && !is_accent && !is_script && !is_letter) return false;
        letters += is_letter ? 1 : 0;
        if (kind == RowKind::index) ++i;  // what stands below
        if (i < end && partner[i] != no_partner && partner[i] > i && partner[i] < end) i = partner[i];
    }
    return false;
}

}  // namespace

std::vector<WrittenToken> with_lost_rows(std::vector<WrittenToken> tokens, std::string_view text) {
    const std::vector<std::size_t> partner = partners(tokens);
    std::vector<WrittenToken> result;
    bool has_relation = false;  // the row
    int depth = 0;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const std::size_t last = i == 0 ? 0 : tokens[i - 1].offset + tokens[i - 1].length;
        const bool is_new_line = i > 0 && last < tokens[i].offset &&
                                 text.substr(last, tokens[i].offset - last).find('\n') != std::string_view::npos;
        if (is_new_line && depth == 0 && has_relation && !is_row_sign(tokens[i - 1].kind)) {
            std::size_t end = i + 1;
            for (std::size_t from = i; end < tokens.size(); from = end++) {
                const std::size_t done = tokens[from].offset + tokens[from].length;
                if (done < tokens[end].offset &&
                    text.substr(done, tokens[end].offset - done).find('\n') != std::string_view::npos)
                    break;
            }
            if (begins_equation(tokens, partner, i, end)) {
                result.push_back(tokens[i]);
                result.back().kind = RowKind::row;
                result.back().text.clear();
                has_relation = false;
            }
        }
        if (partner[i] != no_partner && tokens[i].kind != RowKind::begin_environment &&
            tokens[i].kind != RowKind::end_environment)
            depth += partner[i] > i ? 1 : -1;
        if (tokens[i].kind == RowKind::row) has_relation = false;
        has_relation = has_relation || (depth == 0 && tokens[i].kind == RowKind::relation);
        result.push_back(tokens[i]);
    }
    return result;
}

std::vector<std::vector<WrittenToken>> chains_of(const std::vector<WrittenToken>& tokens, bool joins_rows) {
    return RowJoiner(tokens, joins_rows).chains();
}

}  // namespace alembert
