// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/document.hpp"
#include "check/written/rows.hpp"

#include <algorithm>
#include <cctype>

#include "base/language/say.hpp"
#include "check/written/commands.hpp"
#include "check/written/lexer.hpp"
#include "check/written/parser.hpp"
#include "check/written/statements.hpp"
#include "check/written/words.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_statements = 10000;

bool is_formula_environment(std::string_view name) {
    if (name.ends_with('*')) name.remove_suffix(1);
    static constexpr std::string_view names[] = {"equation", "align",   "gather",       "multline",    "eqnarray",
                                                 "alignat",  "flalign", "math",         "displaymath", "aligned",
                                                 "split",    "dmath",   "cases",        "array",       "gathered",
                                                 "empheq",   "dgroup",  "IEEEeqnarray", "pmatrix",     "bmatrix"};
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

bool is_skipped_environment(std::string_view name) {
    static constexpr std::string_view names[] = {"verbatim", "lstlisting",      "comment",    "tikzpicture",
                                                 "minted",   "thebibliography", "circuitikz", "pspicture"};
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// A sign with which a display ends or begins that goes on in, or from, another.
bool is_joining_sign(const WrittenToken& token) {
    using Kind = WrittenToken::Kind;
    return token.kind == Kind::plus || token.kind == Kind::minus || token.kind == Kind::times ||
           token.kind == Kind::relation;
}

/// $=$ or $\\Rightarrow$ among words.
bool is_sign_alone(const std::vector<WrittenToken>& tokens) {
    using Kind = WrittenToken::Kind;
    if (tokens[0].kind == Kind::index) return true;  // CO$_2$
    return tokens.size() == 1 &&
           (is_joining_sign(tokens[0]) || tokens[0].kind == Kind::arrow || tokens[0].kind == Kind::divide ||
            tokens[0].kind == Kind::partial || tokens[0].kind == Kind::dots || tokens[0].kind == Kind::comma ||
            tokens[0].kind == Kind::period);
}

bool is_letter_of_command(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '@';
}

}  // namespace

bool has_marks_of_latex(std::string_view text) {
    return has_enclosed_latex(text) || text.find("\\frac") != std::string_view::npos;
}

bool has_enclosed_latex(std::string_view text) {
    if (has_display(text) || text.find("\\(") != std::string_view::npos ||
        text.find("$$") != std::string_view::npos)
        return true;
    for (std::size_t at = text.find("\\begin{"); at != std::string_view::npos;
         at = text.find("\\begin{", at + 1)) {
        const std::size_t close = text.find('}', at);
        if (close != std::string_view::npos && is_formula_environment(text.substr(at + 7, close - at - 7)))
            return true;
    }
    // $…$ within a line, and no price
    for (std::size_t at = text.find('$'); at != std::string_view::npos; at = text.find('$', at + 1)) {
        const std::size_t close = text.find_first_of("$\n", at + 1);
        if (close != std::string_view::npos && text[close] == '$' && close > at + 1 && text[at + 1] != ' ' &&
            text[close - 1] != ' ')
            return true;
    }
    return false;
}

DocumentReader::DocumentReader(const std::string& text, Markup markup)
    : text_(text), markup_(markup), has_marks_(has_marks_of_latex(text)) {
    for (const char* const work : {"deltaW", "delta_W", "delta W"})
        context_.has_virtual_work = context_.has_virtual_work || text.find(work) != std::string::npos;
}

std::vector<WrittenStatement> DocumentReader::statements() {
    std::size_t begin = 0, end = text_.size();
    if (markup_ == Markup::tex) {
        const std::size_t body = text_.find("\\begin{document}");
        if (body != std::string::npos) {
            for (at_ = 0, end_ = body; at_ < body;) {  // the preamble: its macros alone
                if (text_[at_] == '%')
                    at_ = std::min(text_.find('\n', at_), body);
                else if (text_[at_] == '\\')
                    command_among_words();
                else
                    ++at_;
            }
            words_.clear();
            begin = body + std::string_view("\\begin{document}").size();
            end = std::min(text_.find("\\end{document}", begin), end);
        }
    }
    scan(begin, end, markup_);
    end_waiting();
    return std::move(list_);
}

void DocumentReader::scan(std::size_t begin, std::size_t end, Markup markup) {
    const std::size_t at = at_, last = end_;
    known_paragraph_end_ = 0;
    at_ = begin;
    end_ = end;
    is_line_start_ = true;
    while (at_ < end_) next(markup);
    at_ = at;
    end_ = last;
}

std::size_t DocumentReader::line_end(std::size_t from) const {
    return std::min(text_.find('\n', from), end_);
}

/// The next blank line.
std::size_t DocumentReader::paragraph_end(std::size_t from) {
    if (from < known_paragraph_begin_ || from >= known_paragraph_end_) {
        known_paragraph_begin_ = from;
        known_paragraph_end_ = blank_line_after(from);
    }
    return known_paragraph_end_;
}

std::size_t DocumentReader::blank_line_after(std::size_t from) const {
    for (std::size_t k = text_.find('\n', from); k != std::string::npos && k < end_; k = text_.find('\n', k + 1)) {
        std::size_t after = k + 1;
        while (after < end_ && (text_[after] == ' ' || text_[after] == '\t' || text_[after] == '\r')) ++after;
        if (after >= end_ || text_[after] == '\n') return k;
    }
    return end_;
}

void DocumentReader::next(Markup markup) {
    if (is_line_start_) {
        is_line_start_ = false;
        if (line(markup)) return;
    }
    const char c = text_[at_];
    if (c == '\n') {
        std::size_t after = at_ + 1;
        while (after < end_ && (text_[after] == ' ' || text_[after] == '\t' || text_[after] == '\r')) ++after;
        if (after < end_ && text_[after] == '\n') end_paragraph();
        say_words(" ");
        ++at_;
        is_line_start_ = true;
    } else if (c == '%' && markup == Markup::tex) {
        at_ = line_end(at_);
    } else if (c == '\\') {
        backslash(markup);
    } else if (c == '$') {
        dollar();
    } else if (c == '`' && markup == Markup::markdown && code()) {
        return;
    } else if (c == '(' && markup == Markup::markdown && bare_parentheses()) {
        return;
    } else if (c == '<' && starts_with("<!--")) {
        const std::size_t close = text_.find("-->", at_);
        at_ = close == std::string::npos ? end_ : std::min(close + 3, end_);
    } else if (markup == Markup::markdown && struck_out()) {
        return;
    } else {
        const std::size_t stop = std::min(text_.find_first_of("\n%\\$`(<~", at_ + 1), end_);
        say_words(slice(at_, stop));
        at_ = stop;
    }
}

/// ~~…~~ and <del>…</del>: what the author has struck out says nothing.
bool DocumentReader::struck_out() {
    static constexpr std::pair<std::string_view, std::string_view> signs[] = {
        {"~~", "~~"}, {"<del>", "</del>"}, {"<s>", "</s>"}, {"<strike>", "</strike>"}};
    for (const auto& [open, close] : signs) {
        if (!starts_with(open) || starts_with("~~~")) continue;
        const std::size_t end = text_.find(close, at_ + open.size());
        if (end == std::string::npos || end >= paragraph_end(at_)) return false;
        at_ = end + close.size();
        return true;
    }
    return false;
}

void DocumentReader::say_words(std::string_view text) {
    std::string added;
    for (const char c : text) {
        if (c == '{' || c == '}') continue;
        const bool is_blank = c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '~';
        if (!is_blank) {
            added += c;
        } else if (!(added.empty() ? words_.empty() || words_.back() == ' ' : added.back() == ' ')) {
            added += ' ';
        }
    }
    const bool has_letters = added.find_first_not_of(" *#>-_.") != std::string::npos;
    if (has_letters && starts_paragraph_) {
        is_first_order_ = starts_paragraph_ = false;
    }
    const std::size_t from = words_.size() > 60 ? words_.size() - 60 : 0;
    words_ += added;
    const bool is_exact = speaks_of_exact_motion(added);
    if (is_exact) is_first_order_ = false;
    if (has_letters && !is_exact && !is_first_order_)
        is_first_order_ = speaks_of_first_order(std::string_view(words_).substr(from));
}

void DocumentReader::end_paragraph() {
    starts_paragraph_ = true;
}

void DocumentReader::refuse(std::size_t begin, std::size_t end, std::string reason) {
    WrittenStatement statement;
    statement.reason = std::move(reason);
    statement.offset = begin;
    statement.length = end - begin;
    add({statement}, false);
}

/// The statements of the display that was kept for the next one to go on with it.
void DocumentReader::end_waiting() {
    if (waiting_.empty()) return;
    std::vector<WrittenToken> tokens = std::move(waiting_);
    waiting_.clear();
    std::string words = std::move(words_);
    const bool is_first_order = is_first_order_;
    words_ = std::move(waiting_words_);
    waiting_words_.clear();
    is_first_order_ = waiting_first_order_;
    add(statements_of(std::move(tokens), waiting_joins_rows_), true);
    words_ = std::move(words);
    is_first_order_ = is_first_order;
}

/// "The kinetic energy is ½ m l² θ'²" is T = ….
void DocumentReader::name_in_words(WrittenStatement& statement) {
    const char* const name = spoken_energy(statement.words);
    if (name == nullptr || statement.sides[0] == nullptr || statement.sides[0]->kind == Math::Kind::letter) return;
    auto letter = std::make_shared<Math>();
    letter->kind = Math::Kind::letter;
    letter->letter.base = name;
    letter->offset = statement.sides[0]->offset;
    statement.sides.insert(statement.sides.begin(), std::move(letter));
    statement.relations.push_back(Relation::equal);
    statement.in_words = true;
}

void DocumentReader::add(std::vector<WrittenStatement> found, bool is_displayed) {
    end_waiting();
    for (WrittenStatement& one : found) {
        if (list_.size() >= most_statements)
            throw BeyondLimit{one.offset, say("the derivation has more than {} statements", most_statements)};
        while (!words_.empty() && words_.back() == ' ') words_.pop_back();
        if (!one.words.empty()) say_words(words_.empty() ? one.words : " " + one.words);
        if (one.sides.size() == 1 && one.relations.empty() && !is_displayed && one.reason.empty()) {
            say_words(" " + std::string(slice(one.offset, one.offset + one.length)) +
                      " ");  // a letter among words
            one.words = words_;
            list_.push_back(std::move(one));
            continue;
        }
        const std::size_t recent = words_.size() > 120 ? words_.size() - 120 : 0;
        const std::size_t sentence = words_.rfind(". ");
        const std::size_t from = sentence == std::string::npos ? recent : std::max(recent, sentence);
        one.consequence |= speaks_of_consequence(std::string_view(words_).substr(from));
        one.words = std::move(words_);
        words_.clear();
        one.first_order = is_first_order_;
        one.displayed = is_displayed;
        if (one.sides.size() == 1 && one.relations.empty()) name_in_words(one);
        if (!one.sides.empty() && one.sides[0] == nullptr) {  // goes on with the statement before
            const bool has_last = !list_.empty() && !list_.back().sides.empty();
            if (has_last) {
                one.sides[0] = list_.back().sides.back();
            } else {
                one.sides.clear();
                one.relations.clear();
                one.reason = say("nothing stands on one side of a sign such as =; expected an expression");
            }
        }
        list_.push_back(std::move(one));
    }
}

void DocumentReader::formula(std::size_t begin, std::size_t end, WrittenNotation notation, bool is_displayed,
                             bool joins_rows) {
    if (notation == WrittenNotation::latex && end > begin + 1 && text_[begin] == '`' && text_[end - 1] == '`')
        ++begin, --end;  // $`…`$
    std::vector<WrittenToken> tokens = tokens_of(slice(begin, end), begin, notation, context_);
    if (tokens.empty()) return;
    if (is_sign_alone(tokens)) return say_words(slice(begin, end));
    if (!is_displayed) return add(statements_of(std::move(tokens), joins_rows), false);
    tokens = with_lost_rows(std::move(tokens), text_);
    const bool goes_on = !waiting_.empty() && words_.find_first_not_of(" .,") == std::string::npos &&
                         (is_joining_sign(waiting_.back()) || is_joining_sign(tokens.front()));
    if (goes_on) {
        const bool ends_open = waiting_.back().kind == WrittenToken::Kind::relation;
        if (ends_open && tokens.front().kind == WrittenToken::Kind::relation)
            waiting_.pop_back();  // L = | = T - V
        WrittenToken row = tokens.front();
        row.kind = WrittenToken::Kind::row;
        row.text.clear();
        waiting_.push_back(std::move(row));
        waiting_.insert(waiting_.end(), std::make_move_iterator(tokens.begin()),
                        std::make_move_iterator(tokens.end()));
        words_.clear();
        return;
    }
    end_waiting();
    waiting_ = std::move(tokens);
    waiting_joins_rows_ = joins_rows;
    waiting_words_ = std::move(words_);
    waiting_first_order_ = is_first_order_;
    words_.clear();
}

void DocumentReader::dollar() {
    const std::size_t begin = at_;
    const bool is_displayed = starts_with("$$");
    const std::size_t width = is_displayed ? 2 : 1;
    const std::size_t limit = is_displayed ? end_ : paragraph_end(at_);
    std::size_t close = std::string::npos;
    // In Markdown a $ within a word is none, and one that blanks part from the formula opens the next before a
    // word.
    const bool is_strict = markup_ == Markup::markdown && !is_displayed;
    const auto is_blank = [&](std::size_t k) {
        return k >= end_ || text_[k] == ' ' || text_[k] == '\n' || text_[k] == '\t';
    };
    const bool is_within_word =
        is_strict && begin > 0 && std::isalnum(static_cast<unsigned char>(text_[begin - 1]));
    if (is_within_word) {
        at_ = begin + 1;
        return say_words("$");
    }
    if (begin >= no_dollar_before_)
        for (std::size_t k = begin + width; k < limit; ++k) {
            if (text_[k] == '\\') {
                ++k;
            } else if (text_[k] == '$') {
                if (is_displayed && text_.compare(k, 2, "$$") != 0) continue;
                const bool before_word =
                    k + 1 < end_ && std::isalnum(static_cast<unsigned char>(text_[k + 1])) != 0;
                if (is_strict && is_blank(begin + 1) != is_blank(k - 1) && (before_word || text_[k + 1] == '\\'))
                    continue;
                close = k;
                break;
            }
        }
    if (close == std::string::npos) {
        no_dollar_before_ = std::max(no_dollar_before_, limit);
        const std::string_view rest = slice(begin, std::min(line_end(begin), begin + 200));
        if (is_displayed || markup_ == Markup::tex || rest.find_first_of("=\\^") != std::string_view::npos) {
            refuse(begin, begin + width,
                   say("a formula is opened here by {} and not closed", is_displayed ? "$$" : "$"));
        } else {
            say_words("$");
        }
        at_ = begin + width;
        return;
    }
    at_ = close + width;
    formula(begin + width, close, WrittenNotation::latex, is_displayed);
}

/// \[ … \] and \( … \)
bool DocumentReader::enclosed(std::string_view open, std::string_view close, bool is_displayed) {
    const std::size_t begin = at_ + open.size();
    const std::string key(close);
    const bool is_known_unclosed = std::find(unclosed_.begin(), unclosed_.end(), key) != unclosed_.end();
    std::size_t end = is_known_unclosed ? std::string::npos : text_.find(close, begin);
    while (close.size() == 2 && end != std::string::npos && end < end_ && end > begin && text_[end - 1] == '\\')
        end = text_.find(close, end + 1);  // \\[
    if (end == std::string::npos || end >= end_) {
        if (!is_known_unclosed) unclosed_.push_back(key);
        refuse(at_, begin, say("a formula is opened here by {} and not closed", open));
        at_ = begin;
        return true;
    }
    at_ = end + close.size();
    formula(begin, end, WrittenNotation::latex, is_displayed);
    return true;
}

void DocumentReader::backslash(Markup markup) {
    if (named_character_length(std::string_view(text_).substr(at_, 60)) > 0) {  // \[Theta] of Mathematica
        const std::size_t length = named_character_length(std::string_view(text_).substr(at_, 60));
        say_words(slice(at_, std::min(at_ + length, end_)));
        at_ = std::min(at_ + length, end_);
    } else if (markup == Markup::markdown && starts_with("\\\\[")) {  // where Markdown takes a backslash away
        enclosed("\\\\[", "\\\\]", true);
    } else if (markup == Markup::markdown && starts_with("\\\\(")) {
        enclosed("\\\\(", "\\\\)", false);
    } else if (starts_with("\\[")) {
        enclosed("\\[", "\\]", true);
    } else if (starts_with("\\(")) {
        enclosed("\\(", "\\)", false);
    } else if (starts_with("\\begin{")) {
        environment();
    } else if (at_ + 1 < end_ && !is_letter_of_command(text_[at_ + 1])) {
        if (markup == Markup::markdown || std::string_view("%&#_$").find(text_[at_ + 1]) != std::string_view::npos)
            say_words(slice(at_ + 1, at_ + 2));
        else
            say_words(" ");
        at_ = std::min(at_ + 2, end_);
    } else {
        command_among_words();
    }
}

std::size_t DocumentReader::end_of_environment(const std::string& name, std::size_t from) const {
    const std::string close = "\\end{" + name + "}";
    const std::size_t end = text_.find(close, from);
    return end == std::string::npos || end >= end_ ? std::string::npos : end;
}

void DocumentReader::environment() {
    const std::size_t begin = at_, name_begin = at_ + 7;
    const std::size_t brace = std::min(text_.find('}', name_begin), end_);
    const std::string name(slice(name_begin, std::min(brace, name_begin + 40)));
    at_ = std::min(brace + 1, end_);
    const bool is_formula = is_formula_environment(name);
    if (!is_formula && !is_skipped_environment(name)) {
        say_words(" ");
        return;
    }
    const bool is_known_unclosed = std::find(unclosed_.begin(), unclosed_.end(), name) != unclosed_.end();
    const std::size_t end = is_known_unclosed ? std::string::npos : end_of_environment(name, at_);
    if (end == std::string::npos) {
        if (!is_known_unclosed) unclosed_.push_back(name);
        refuse(begin, at_, say("the environment {} is opened here and not closed", in_quotes(name)));
        return;
    }
    const std::size_t after = end + 6 + name.size();
    if (is_formula) {
        const bool is_matter_of_rows = name.starts_with("multline");
        const bool keeps_frame = name == "cases" || name == "array" || name.ends_with("matrix");
        if (name.starts_with("alignat") && at_ < end && text_[at_] == '{')
            at_ = std::min(text_.find('}', at_) + 1, end);
        formula(keeps_frame ? begin : at_, keeps_frame ? after : end, WrittenNotation::latex, true,
                is_matter_of_rows);
    }
    at_ = after;
}

/// \section{…}, \item, \newcommand … in the text.
void DocumentReader::command_among_words() {
    const std::size_t begin = at_++;
    while (at_ < end_ && is_letter_of_command(text_[at_])) ++at_;
    if (at_ == begin + 1) {
        at_ = std::min(at_ + 1, end_);
        return;
    }
    const std::string_view name = slice(begin + 1, at_);
    const WrittenCommand* const known = command_named(name);
    if (known != nullptr && known->effect == WrittenCommand::Effect::definition) {
        at_ = begin;
        if (take_in_macro(std::string_view(text_).substr(0, end_), at_, context_)) return;
        at_ = begin + 1 + name.size();
        refuse(begin, at_,
               say("a macro of this form is not taken in; expected \\newcommand{{\\name}}[n]{{…}} or the formulas "
                   "written out"));
        return;
    }
    if (known != nullptr && known->effect == WrittenCommand::Effect::refused && name != "usepackage" &&
        name != "includegraphics" && name != "setlength" && name != "else" && name != "fi" && name != "show" &&
        name != "message") {
        refuse(begin, at_,
               say("{} is refused: nothing is executed, and no other file is read; expected formulas written out",
                   in_quotes("\\" + std::string(name))));
        if (name.ends_with("def")) {  // its body is no formula of the document
            const std::size_t brace = std::min(text_.find_first_of("{\n", at_), end_);
            const std::size_t close =
                brace < end_ && text_[brace] == '{'
                    ? end_of_group(std::string_view(text_).substr(0, std::min(end_, brace + 1000)), brace)
                    : std::string_view::npos;
            at_ = close == std::string_view::npos ? brace : close;
        }
        return;
    }
    static constexpr std::string_view silent[] = {"label",
                                                  "ref",
                                                  "eqref",
                                                  "cite",
                                                  "usepackage",
                                                  "documentclass",
                                                  "includegraphics",
                                                  "vspace",
                                                  "hspace",
                                                  "bibliographystyle",
                                                  "bibliography",
                                                  "setlength",
                                                  "end",
                                                  "color",
                                                  "pagestyle",
                                                  "geometry",
                                                  "setcounter",
                                                  "addtocounter",
                                                  "numberwithin",
                                                  "hypersetup",
                                                  "theoremstyle"};
    if (std::find(std::begin(silent), std::end(silent), name) == std::end(silent)) {
        say_words(" ");
        return;
    }
    while (at_ < end_ && (text_[at_] == '[' || text_[at_] == '{' || text_[at_] == '*')) {
        if (text_[at_] == '*') {
            ++at_;
            continue;
        }
        const std::size_t close = std::min(text_.find(text_[at_] == '[' ? ']' : '}', at_), end_);
        at_ = std::min(close + 1, end_);
    }
}

}  // namespace alembert
