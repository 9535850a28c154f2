// SPDX-License-Identifier: GPL-2.0-or-later
#include "derivation/written/rows.hpp"

#include <algorithm>
#include <utility>

#include "derivation/written/parser.hpp"

namespace alembert {

namespace {

using RowKind = WrittenToken::Kind;

bool is_system(const std::string& name) {
    static constexpr std::string_view names[] = {"cases", "dcases", "rcases", "drcases", "array", "system", "numcases", "subnumcases", "matrix"};
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

/// Marks for each bracket whether a relation or the end of a row stands directly in it.
std::vector<char> holds_relation(const std::vector<WrittenToken>& tokens, const std::vector<std::size_t>& partner) {
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
        if (tokens[i].kind == RowKind::begin_group && has_partner && holds[i] && before != RowKind::index &&
            before != RowKind::power && before != RowKind::command && before != RowKind::end_group) {
            dropped[i] = dropped[partner[i]] = 1;
        } else if (is_framing(tokens[i]) && has_partner && holds[i] && may_start_system(tokens, i)) {
            tokens[i].kind = tokens[partner[i]].kind = RowKind::row;  // a system of equations
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

class RowJoiner {
public:
    RowJoiner(const std::vector<WrittenToken>& tokens, bool joins_rows)
        : tokens_(tokens), partner_(partners(tokens)), joins_rows_(joins_rows) {}

    std::vector<std::vector<WrittenToken>> chains() {
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            const WrittenToken& token = tokens_[i];
            if (partner_[i] != no_partner && partner_[i] > i) {
                copy_bracket(i);
                i = partner_[i];
            } else if (token.kind == RowKind::row) {
                end_row();
            } else if (token.kind == RowKind::ampersand) {
                ++cells_;
                if (row_.empty()) begins_empty_ = true;
                // The second & of a row of `align` begins another equation, that of `eqnarray` (a &=& b) does not.
                if (cells_ % 2 == 0 && row_has_relation_ && !ends_with_sign(row_)) row_.push_back(space(token));
            } else {
                row_has_relation_ |= token.kind == RowKind::relation;
                row_.push_back(token);
            }
        }
        end_row();
        end_chain();
        return std::move(chains_);
    }

private:
    const std::vector<WrittenToken>& tokens_;
    const std::vector<std::size_t> partner_;
    const bool joins_rows_;
    std::vector<WrittenToken> row_, chain_;
    std::vector<std::vector<WrittenToken>> chains_;
    int cells_ = 0;
    bool begins_empty_ = false;
    bool chain_has_relation_ = false, row_has_relation_ = false;

    static WrittenToken space(const WrittenToken& at) {
        WrittenToken token = at;
        token.kind = RowKind::space;
        return token;
    }

    /// All of a bracket; the ends of rows in it, outside of matrices, only divide the line.
    void copy_bracket(std::size_t begin) {
        int matrices = 0;
        for (std::size_t i = begin; i <= partner_[begin]; ++i) {
            const RowKind kind = tokens_[i].kind;
            matrices += kind == RowKind::begin_environment ? 1 : kind == RowKind::end_environment ? -1 : 0;
            if (matrices > 0 || (kind != RowKind::row && kind != RowKind::ampersand)) row_.push_back(tokens_[i]);
        }
    }

    static bool is_sign(const WrittenToken& token) {
        const RowKind kind = token.kind;
        return kind == RowKind::plus || kind == RowKind::minus || kind == RowKind::times || kind == RowKind::divide ||
               kind == RowKind::relation;
    }

    static bool ends_with_sign(const std::vector<WrittenToken>& row) { return !row.empty() && is_sign(row.back()); }

    const WrittenToken* first_of_row() const {
        for (const WrittenToken& token : row_)
            if (token.kind != RowKind::space) return &token;
        return nullptr;
    }

    bool goes_on() const {
        const WrittenToken* const first = first_of_row();
        if (chain_.empty() || first == nullptr) return false;
        if (joins_rows_ || first->kind == RowKind::relation || ends_with_sign(chain_)) return true;
        const bool begins_with_sign = is_sign(*first);
        if (begins_empty_ && (begins_with_sign || !row_has_relation_)) return first->kind != RowKind::text;
        // a \\ + b = c
        return begins_with_sign && (!row_has_relation_ || !chain_has_relation_);
    }

    void end_row() {
        while (!row_.empty() && row_.back().kind == RowKind::space) row_.pop_back();
        if (!row_.empty()) {
            if (!goes_on()) end_chain();
            const auto from = std::find_if_not(row_.begin(), row_.end(), [](const WrittenToken& token) {
                return token.kind == RowKind::space;
            });
            chain_has_relation_ |= row_has_relation_;
            chain_.insert(chain_.end(), std::make_move_iterator(from), std::make_move_iterator(row_.end()));
        }
        row_.clear();
        cells_ = 0;
        begins_empty_ = row_has_relation_ = false;
    }

    void end_chain() {
        if (!chain_.empty()) chains_.push_back(std::move(chain_));
        chain_.clear();
        chain_has_relation_ = false;
    }
};

}  // namespace

std::vector<std::vector<WrittenToken>> chains_of(const std::vector<WrittenToken>& tokens, bool joins_rows) {
    return RowJoiner(tokens, joins_rows).chains();
}

}  // namespace alembert
