// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

constexpr int most_parts = 16;

class Surveyor {
public:
    explicit Surveyor(const SourceText& source) : source_(source), text_(source.text()) { layout_.text = text_; }

    Layout survey() {
        while (at_ < text_.size() && !layout_.is_too_deep) {
            if (is_in(" \t\r\n"))
                ++at_;
            else if (text_[at_] == '#')
                skip_line();
            else if (text_[at_] == '[')
                header();
            else
                statement();
        }
        return std::move(layout_);
    }

private:
    const SourceText& source_;
    const std::string_view text_;
    std::size_t at_ = 0;
    std::string table_;
    std::map<std::string, Place> keys_;  // the keys of the present table
    Layout layout_;

    bool is_in(std::string_view set) const { return set.find(text_[at_]) != std::string_view::npos; }
    bool at(char c) const { return at_ < text_.size() && text_[at_] == c; }
    void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
    void skip_blanks() {
        while (at_ < text_.size() && is_in(" \t")) ++at_;
    }

    void header() {
        const std::size_t begin = at_;
        while (at('[')) ++at_;
        const std::string name = key();
        layout_.headers.emplace(name, source_.place(begin));
        table_ = text_.compare(begin, 2, "[[") == 0 ? "[[" + name + "]]" : "[" + name + "]";
        keys_.clear();
        skip_line();
    }

    /// Reads a dotted key, its parts joined with dots; empty if there is none.
    std::string key() {
        std::string whole;
        const std::size_t begin = at_;
        for (int parts = 1;; ++parts) {
            if (parts > most_parts) too_deep(begin);
            if (layout_.is_too_deep) return whole;
            skip_blanks();
            if (at('"') || at('\'')) {
                whole += read_string(source_, at_).text;
                skip_string();
            } else {
                const std::size_t from = at_;
                while (at_ < text_.size() && !is_in(" \t\r\n.=[]{}#,\"'")) ++at_;
                whole += text_.substr(from, at_ - from);
            }
            skip_blanks();
            if (!at('.')) return whole;
            ++at_;
            whole += '.';
        }
    }

    /// Reads `key = value`, or a line that the parser will refuse.
    void statement() {
        const std::size_t begin = at_;
        const std::string name = key();
        if (layout_.is_too_deep) return;
        if (!at('=')) {
            skip_line();
            layout_.statements.push_back({begin, at_});
            return;
        }
        ++at_;
        value();
        layout_.statements.push_back({begin, at_});
        const auto [first, is_new] = keys_.emplace(name, source_.place(begin));
        if (is_new) return;
        layout_.mistakes.push_back(
            {source_.place(begin), say("{} is given twice in {}; first on line {}", in_quotes(name),
                                       table_.empty() ? say("the scene") : escaped(table_), first->second.line)});
        drop_statement(layout_, begin);
    }

    void value() {
        int open = 0;
        for (int dots = 0; at_ < text_.size() && !layout_.is_too_deep;) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                skip_string();
                continue;
            }
            if (c == '#' || (c == '\n' && open <= 0)) {
                if (open <= 0) return;
                skip_line();
                continue;
            }
            open += (c == '[' || c == '{') - (c == ']' || c == '}');
            dots = c == '.' ? dots + 1 : is_in(",={}[]\n") ? 0 : dots;
            if (dots > most_parts) too_deep(at_);
            ++at_;
        }
    }

    void skip_string() {
        const char quote = text_[at_];
        const std::string triple(3, quote);
        if (text_.compare(at_, 3, triple) == 0) {
            for (at_ += 3; at_ < text_.size() && text_.compare(at_, 3, triple) != 0; ++at_)
                if (quote == '"' && text_[at_] == '\\') ++at_;
            at_ = std::min(at_ + 3, text_.size());
            while (at(quote)) ++at_;
            return;
        }
        for (++at_; at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; ++at_)
            if (quote == '"' && text_[at_] == '\\') ++at_;
        at_ = std::min(at_ + 1, text_.size());
    }

    void too_deep(std::size_t offset) {
        layout_.is_too_deep = true;
        layout_.mistakes.push_back({source_.place(offset), say("a key of more than {} parts", most_parts)});
    }
};

}  // namespace

bool drop_statement(Layout& layout, std::size_t offset) {
    const auto after = std::upper_bound(layout.statements.begin(), layout.statements.end(), offset,
                                        [](std::size_t at, const Layout::Statement& s) { return at < s.begin; });
    if (after == layout.statements.begin()) return false;
    const auto [begin, end] = *std::prev(after);
    if (offset > end) return false;
    bool is_blank = true;
    for (std::size_t i = begin; i < end; ++i) {
        char& c = layout.text[i];
        is_blank = is_blank && (c == ' ' || c == '\n' || c == '\r');
        if (c != '\n' && c != '\r') c = ' ';
    }
    return !is_blank;
}

Layout survey(const SourceText& source) {
    return Surveyor(source).survey();
}

}  // namespace alembert
