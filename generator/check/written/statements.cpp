// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/statements.hpp"

#include <algorithm>
#include <optional>

#include "base/language/say.hpp"
#include "check/written/equation_number.hpp"
#include "check/written/parser.hpp"
#include "check/written/rows.hpp"
#include "check/written/tex_groups.hpp"
#include "check/written/word_kinds.hpp"
#include "check/written/words.hpp"

namespace alembert {

namespace {

using PartKind = WrittenToken::Kind;

/// What stands between two separators of a chain.
struct Part {
    std::size_t begin = 0, end = 0;
    PartKind before = PartKind::end;  // the separator
    std::vector<std::size_t> relations{};
    std::string words{};        // of \text{…} before it
    bool is_condition = false;  // "if", "for" before it
    bool is_consequence = false;
};

Relation relation_of(const std::string& sign) {
    if (sign == "=") return Relation::equal;
    if (sign == "~") return Relation::approximately;
    return sign == ":" ? Relation::identical : Relation::proportional;
}

/// Reads one chain.
class ChainReader {
public:
    explicit ChainReader(const std::vector<WrittenToken>& tokens) : tokens_(tokens), partner_(partners(tokens)) {}

    std::vector<WrittenStatement> statements() {
        split();
        join_parts();
        for (const Part& part : parts_) read(part);
        return std::move(list_);
    }

private:
    const std::vector<WrittenToken>& tokens_;
    const std::vector<std::size_t> partner_;
    std::vector<Part> parts_;
    std::vector<WrittenStatement> list_;

    PartKind kind(std::size_t i) const { return i < tokens_.size() ? tokens_[i].kind : PartKind::end; }

    /// Whether words stand where a letter can stand: \text{KE} = …
    bool is_operand(std::size_t i) const {
        const WrittenToken& token = tokens_[i];
        if (token.upright) return true;
        if (!is_word_for_letter(token.text)) return false;
        const auto is_operator = [](PartKind kind) {
            return kind == PartKind::plus || kind == PartKind::minus || kind == PartKind::times ||
                   kind == PartKind::divide || kind == PartKind::relation || kind == PartKind::index ||
                   kind == PartKind::power || kind == PartKind::number;
        };
        return is_operator(kind(i + 1)) || (i > 0 && is_operator(tokens_[i - 1].kind));
    }

    void split() {
        parts_.push_back({});
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            const PartKind what = tokens_[i].kind;
            if (partner_[i] != no_partner && partner_[i] > i) {
                i = partner_[i];
            } else if (what == PartKind::relation) {
                parts_.back().relations.push_back(i);
            } else if (what == PartKind::comma || what == PartKind::semicolon || what == PartKind::arrow ||
                       what == PartKind::space || (what == PartKind::text && !is_operand(i)) ||
                       (what == PartKind::period && i + 1 < tokens_.size())) {
                begin_part(i);
            }
        }
        parts_.back().end = tokens_.size();
    }

    void begin_part(std::size_t i) {
        parts_.back().end = i;
        Part part{.begin = i + 1, .before = tokens_[i].kind};
        if (part.before == PartKind::text) {
            part.words = tokens_[i].text;
            part.is_condition = begins_condition(part.words);
            part.is_consequence = speaks_of_consequence(part.words);
        }
        part.is_consequence |= part.before == PartKind::arrow;
        parts_.push_back(std::move(part));
    }

    bool is_number_of_equation(const Part& part) const {
        const std::size_t length = part.end - part.begin;
        if (length < 3 || length > 6 || kind(part.begin) != PartKind::open || partner_[part.begin] != part.end - 1)
            return false;
        for (std::size_t i = part.begin + 1; i + 1 < part.end; ++i)
            if (kind(i) != PartKind::number && kind(i) != PartKind::period && kind(i) != PartKind::letter &&
                kind(i) != PartKind::primes && kind(i) != PartKind::times && kind(i) != PartKind::minus)
                return false;
        return kind(part.begin + 1) == PartKind::number || kind(part.begin + 1) == PartKind::times || length == 3;
    }

    void end_before_punctuation(Part& part) const {
        while (part.end > part.begin && is_punctuation(kind(part.end - 1))) --part.end;
    }

    /// A space divides only what are two statements; the number of an equation and what is empty go.
    void join_parts() {
        std::vector<Part> joined;
        PartKind divider = PartKind::end;  // before parts that are empty
        for (Part& part : parts_) {
            if (part.before == PartKind::space && divider != PartKind::end) part.before = divider;
            divider = PartKind::end;
            end_before_punctuation(part);
            part.end = before_equation_number(tokens_, part.begin, part.end);
            end_before_punctuation(part);
            const bool is_space = part.before == PartKind::space;
            if (is_space && is_number_of_equation(part)) continue;
            const bool goes_on = is_space && !joined.empty() && !joined.back().is_condition &&
                                 (part.relations.empty() || joined.back().relations.empty() ||
                                  kind(part.begin) == PartKind::relation || ends_with_relation(joined.back())) &&
                                 joined.back().begin < joined.back().end;
            if (goes_on && part.begin < part.end) {
                joined.back().end = part.end;
                joined.back().relations.insert(joined.back().relations.end(), part.relations.begin(),
                                               part.relations.end());
                continue;
            }
            if (part.begin >= part.end && part.words.empty() && !part.is_consequence) {
                if (part.before != PartKind::space) divider = part.before;
                continue;
            }
            joined.push_back(std::move(part));
        }
        parts_ = std::move(joined);
    }

    bool ends_with_relation(const Part& part) const {
        std::size_t end = part.end;
        while (end > part.begin && kind(end - 1) == PartKind::space) --end;
        return end > part.begin && kind(end - 1) == PartKind::relation;
    }

    static bool is_punctuation(PartKind kind) {
        return kind == PartKind::period || kind == PartKind::comma || kind == PartKind::semicolon ||
               kind == PartKind::space;
    }

    void read(const Part& part) {
        if (part.begin >= part.end) {  // words alone, or an arrow before what comes next
            carry(part);
            return;
        }
        WrittenStatement statement;
        statement.words = std::move(carried_words_);
        if (!part.words.empty()) statement.words += (statement.words.empty() ? "" : " ") + part.words;
        statement.consequence = part.is_consequence || carried_consequence_;
        const bool is_condition = part.is_condition || carried_condition_;
        carry({});
        statement.offset = tokens_[part.begin].offset;
        statement.length = tokens_[part.end - 1].offset + tokens_[part.end - 1].length - statement.offset;
        try {
            if (is_condition && !list_.empty()) {
                for (const auto& [begin, end] : sides(part))
                    if (begin < end) list_.back().conditions.push_back(side(begin, end, false));
                was_condition_ = true;
                return;
            }
            if (is_index_range(part)) return;
            was_condition_ = false;
            if (fill_from_call(part, statement) || fill_piecewise(part, statement)) return;
            fill(part, statement);
        } catch (const NotUnderstood& why) {
            if (is_condition) return;
            statement.sides.clear();
            statement.relations.clear();
            statement.reason = why.message;
            statement.offset = why.length > 0 || why.offset > 0 ? why.offset : statement.offset;
            statement.length = why.length;
        }
        list_.push_back(std::move(statement));
    }

    std::string carried_words_;
    bool carried_consequence_ = false, carried_condition_ = false;

    void carry(const Part& part) {
        if (part.end == 0 && part.begin == 0) {
            carried_words_.clear();
            carried_consequence_ = carried_condition_ = false;
            return;
        }
        if (!part.words.empty()) carried_words_ += (carried_words_.empty() ? "" : " ") + part.words;
        carried_consequence_ |= part.is_consequence;
        carried_condition_ |= part.is_condition;
    }

    std::vector<std::pair<std::size_t, std::size_t>> sides(const Part& part) const {
        std::vector<std::pair<std::size_t, std::size_t>> ranges;
        std::size_t begin = part.begin;
        for (const std::size_t relation : part.relations) {
            ranges.emplace_back(begin, relation);
            begin = relation + 1;
        }
        ranges.emplace_back(begin, part.end);
        return ranges;
    }

    /// i = 1, 2, …, n: no claim. What follows the comma has no relation.
    bool is_index_range(const Part& part) {
        if (was_condition_ && part.before == PartKind::comma && part.relations.empty() &&
            part.end == part.begin + 1)
            return true;
        const bool is_list_item = part.before == PartKind::comma && part.relations.empty() && !list_.empty() &&
                                  !list_.back().sides.empty() && list_.back().relations.size() == 1 &&
                                  part.end == part.begin + 1 &&
                                  (kind(part.begin) == PartKind::number || kind(part.begin) == PartKind::dots ||
                                   (was_index_range_ && kind(part.begin) == PartKind::letter));
        if (!is_list_item) {
            was_index_range_ = false;
            return false;
        }
        if (!was_index_range_ && list_.back().sides[0] && list_.back().sides[0]->kind == Math::Kind::letter &&
            list_.back().relations.size() == 1) {
            std::vector<MathPtr> condition = std::move(list_.back().sides);
            const WrittenStatement range = list_.back();
            if (list_.size() > 1) {
                list_.pop_back();
                list_.back().conditions.insert(list_.back().conditions.end(), condition.begin(), condition.end());
            } else {
                list_.back().relations = {Relation::proportional};
                list_.back().sides = std::move(condition);
            }
        }
        was_index_range_ = true;
        return true;
    }

    bool was_index_range_ = false, was_condition_ = false;

    /// Reads the tokens of one side, without the spaces in it.
    MathPtr side(std::size_t begin, std::size_t end, bool has_differentials) {
        std::vector<WrittenToken> own;
        for (std::size_t i = begin; i < end; ++i) {
            if (tokens_[i].kind == PartKind::space) continue;
            own.push_back(tokens_[i]);
        }
        while (!own.empty() && is_punctuation(own.back().kind)) own.pop_back();
        const bool has_root = std::any_of(own.begin(), own.end(), [](const WrittenToken& token) {
            return token.text == "sqrt" && (token.kind == PartKind::command || token.kind == PartKind::function);
        });
        if (has_root && (own.front().text == "pm" || own.front().text == "mp"))
            own.erase(own.begin());  // of both branches one is read
        if (own.empty()) {
            const WrittenToken& near = tokens_[std::min(begin, tokens_.size() - 1)];
            throw NotUnderstood{near.offset, near.length,
                                say("nothing stands on one side of a sign such as =; expected an expression")};
        }
        const std::vector<std::size_t> partner = partners(own);
        return MathParser(own, partner, has_differentials).read(0, own.size());
    }

    /// Whether the first side is dW, so that each d before a letter is a differential.
    bool has_differentials(const Part& part) const {
        const std::size_t end = part.relations.empty() ? part.end : part.relations[0];
        std::size_t i = part.begin;
        const bool is_d =
            kind(i) == PartKind::letter && tokens_[i].letter == Letter{.base = "d"} && tokens_[i].dots == 0;
        for (std::size_t k = part.begin; k < part.end; ++k)
            if (kind(k) == PartKind::command && tokens_[k].text == "int") return true;
        if (is_between_differentials(part)) return true;
        if (!is_d || kind(i + 1) != PartKind::letter || part.relations.empty()) return false;
        for (i += 2; i < end; ++i)
            if (kind(i) != PartKind::index && kind(i) != PartKind::begin_group && kind(i) != PartKind::end_group &&
                kind(i) != PartKind::number && kind(i) != PartKind::power && kind(i) != PartKind::times &&
                kind(i) != PartKind::text)
                return false;
        return true;
    }

    /// r dθ = dx: each term has one d that is written together with its letter.
    bool is_between_differentials(const Part& part) const {
        if (part.relations.size() != 1) return false;
        bool has_one = false;
        std::size_t differentials = 0, tokens = 0;
        const auto ends_term = [&](std::size_t i) {
            const bool is_zero = tokens == 1 && kind(i - 1) == PartKind::number && tokens_[i - 1].text == "0";
            const bool is_fine = differentials == 1 || is_zero || tokens == 0;
            has_one = has_one || differentials == 1;
            differentials = tokens = 0;
            return is_fine;
        };
        for (std::size_t i = part.begin; i < part.end; ++i) {
            const PartKind what = kind(i);
            if (what == PartKind::plus || what == PartKind::minus || what == PartKind::relation) {
                if (!ends_term(i)) return false;
                continue;
            }
            ++tokens;
            if (partner_[i] != no_partner && partner_[i] > i) {
                i = partner_[i];
            } else if (what == PartKind::divide || (what == PartKind::command && tokens_[i].text == "frac")) {
                return false;
            } else {
                const bool is_d = what == PartKind::letter && tokens_[i].letter == Letter{.base = "d"};
                const bool has_operand = kind(i + 1) == PartKind::letter || kind(i + 1) == PartKind::command;
                differentials += is_d && has_operand && tokens_[i + 1].tight ? 1 : 0;
            }
        }
        return ends_term(part.end) && has_one;
    }

    void fill(const Part& part, WrittenStatement& statement) {
        const bool differentials = has_differentials(part);
        for (const std::size_t relation : part.relations)
            statement.relations.push_back(relation_of(tokens_[relation].text));
        bool is_first = true;
        for (const auto& [begin, end] : sides(part)) {
            const bool is_missing = is_first && begin == end && !part.relations.empty();
            statement.sides.push_back(is_missing ? nullptr : side(begin, end, differentials));
            is_first = false;
        }
    }

    /// Eq(a, b) of SymPy
    bool fill_from_call(const Part& part, WrittenStatement& statement) {
        if (kind(part.begin) != PartKind::command || tokens_[part.begin].text != "Eq" || !part.relations.empty())
            return false;
        const std::size_t open = part.begin + 1;
        if (kind(open) != PartKind::open || partner_[open] != part.end - 1) return false;
        for (std::size_t i = open + 1; i + 1 < part.end; ++i) {
            if (partner_[i] != no_partner && partner_[i] > i) {
                i = partner_[i];
            } else if (tokens_[i].kind == PartKind::comma) {
                statement.sides = {side(open + 1, i, false), side(i + 1, part.end - 1, false)};
                statement.relations = {Relation::equal};
                list_.push_back(std::move(statement));
                return true;
            }
        }
        return false;
    }

    /// f = \begin{cases} a & x > 0 \\ b & x < 0 \end{cases} is one statement for each row.
    bool fill_piecewise(const Part& part, const WrittenStatement& statement) {
        const std::size_t begin = part.relations.empty() ? part.begin : part.relations.back() + 1;
        if (kind(begin) != PartKind::begin_environment || !tokens_[begin].text.ends_with("cases") ||
            partner_[begin] != part.end - 1)
            return false;
        Part before = part;
        std::size_t from = begin + 1;
        for (std::size_t i = from; i < part.end; ++i) {
            if (partner_[i] != no_partner && partner_[i] > i) {
                i = partner_[i];
                continue;
            }
            if (kind(i) != PartKind::row && i + 1 != part.end) continue;
            if (from < i) add_case(before, statement, from, i);
            from = i + 1;
        }
        return true;
    }

    void add_case(const Part& part, WrittenStatement statement, std::size_t begin, std::size_t end) {
        std::size_t cell = begin;
        while (cell < end && kind(cell) != PartKind::ampersand) ++cell;
        for (const std::size_t relation : part.relations)
            statement.relations.push_back(relation_of(tokens_[relation].text));
        auto ranges = sides(part);
        ranges.back() = {begin, cell};
        for (const auto& [first, last] : ranges) statement.sides.push_back(side(first, last, false));
        statement.offset = tokens_[begin].offset;
        statement.length = tokens_[end - 1].offset + tokens_[end - 1].length - statement.offset;
        std::size_t from = cell + 1;
        for (std::size_t i = cell + 1; i <= end; ++i) {
            const bool divides = i == end || kind(i) == PartKind::relation || kind(i) == PartKind::text ||
                                 kind(i) == PartKind::comma;
            if (!divides) continue;
            if (from < i) statement.conditions.push_back(side(from, i, false));
            from = i + 1;
        }
        list_.push_back(std::move(statement));
    }
};

}  // namespace

std::vector<WrittenStatement> statements_of(std::vector<WrittenToken> tokens, bool joins_rows) {
    std::vector<WrittenStatement> list;
    const std::vector<WrittenToken> plain = without_frames(with_fractions(std::move(tokens)));
    for (const std::vector<WrittenToken>& chain : chains_of(plain, joins_rows)) {
        ChainReader reader(chain);
        for (WrittenStatement& one : reader.statements()) list.push_back(std::move(one));
    }
    return list;
}

}  // namespace alembert
