// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds the formulas of a document and the words between them.

#include "check/written/read.hpp"
#include "check/written/tokens.hpp"

namespace alembert {

/// How formulas are marked in a document.
enum class Markup { tex, markdown };

/// Reads all of a document once, from its beginning to its end.
class DocumentReader {
public:
    DocumentReader(const std::string& text, Markup markup);

    /// Throws BeyondLimit.
    std::vector<WrittenStatement> statements();

private:
    const std::string& text_;
    const Markup markup_;
    const bool has_marks_;  // $ and the like: lines without them are words first
    TokenContext context_;
    std::vector<WrittenStatement> list_;
    std::size_t at_ = 0, end_ = 0;
    std::string words_;
    bool is_first_order_ = false;
    bool starts_paragraph_ = false;
    bool is_line_start_ = true;
    std::size_t known_paragraph_begin_ = 0, known_paragraph_end_ = 0;
    std::size_t no_dollar_before_ = 0;  // up to here a $ has no partner
    std::vector<std::string> unclosed_;
    std::vector<WrittenToken> waiting_;  // a display that may go on in the next one
    std::string waiting_words_;
    bool waiting_first_order_ = false, waiting_joins_rows_ = false;

    bool starts_with(std::string_view what) const { return text_.compare(at_, what.size(), what) == 0; }
    std::size_t line_end(std::size_t from) const;
    std::size_t paragraph_end(std::size_t from);
    std::size_t blank_line_after(std::size_t from) const;
    std::string_view slice(std::size_t begin, std::size_t end) const {
        return std::string_view(text_).substr(begin, end - begin);
    }

    void scan(std::size_t begin, std::size_t end, Markup markup);
    void next(Markup markup);
    void say_words(std::string_view text);
    bool struck_out();
    void end_paragraph();
    void dollar();
    bool enclosed(std::string_view open, std::string_view close, bool is_displayed);
    void backslash(Markup markup);
    void environment();
    void command_among_words();
    void formula(std::size_t begin, std::size_t end, WrittenNotation notation, bool is_displayed,
                 bool joins_rows = false);
    void add(std::vector<WrittenStatement> found, bool is_displayed);
    static void name_in_words(WrittenStatement& statement);
    void end_waiting();
    void refuse(std::size_t begin, std::size_t end, std::string reason);
    std::size_t end_of_environment(const std::string& name, std::size_t from) const;

    // lines.cpp
    bool line(Markup markup);
    bool fence();
    bool code();
    bool bare_display();
    bool restructured_math(std::size_t end);
    bool plain_line(std::size_t begin, std::size_t end);
    bool bare_parentheses();
    std::vector<WrittenToken> latex_tokens(std::size_t begin, std::size_t end);
    std::vector<WrittenToken> plain_tokens(std::size_t begin, std::size_t end);
    std::vector<WrittenToken> labelled_tokens(std::size_t begin, std::size_t end);
    static void add_word(std::vector<WrittenToken>& tokens, const std::string& word, std::size_t offset);
};

/// The length of a character of Mathematica that text begins with, \[Theta]; 0 if it begins with none.
std::size_t named_character_length(std::string_view text);

/// Whether text has \[ that opens a display.
bool has_display(std::string_view text);

/// Whether text has $…$, \[, \(, a mathematical environment or \frac.
bool has_marks_of_latex(std::string_view text);
/// Whether it has formulas between signs of LaTeX: $…$, \[…\], an environment.
bool has_enclosed_latex(std::string_view text);

}  // namespace alembert
