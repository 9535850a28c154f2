// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/marked_page.hpp"

#include <fmt/ranges.h>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "check/written/read.hpp"
#include "present/report/html.hpp"
#include "present/report/marked.hpp"
#include "present/report/page.hpp"
#include "present/report/page_parts.hpp"
#include "present/report/scene_page.hpp"
#include "present/report/written_mathml.hpp"

namespace alembert {

namespace {

std::string sign_between(Relation relation) {
    switch (relation) {
        case Relation::approximately:
            return "<mo>&#x2248;</mo>";
        case Relation::identical:
            return "<mo>&#x2261;</mo>";
        case Relation::proportional:
            return "<mo>&#x221D;</mo>";
        default:
            return "<mo>=</mo>";
    }
}

/// The sides of a chain from `first` to `last`; before the first, if it is not that of the chain, only its sign.
std::string formula(const WrittenStatement& statement, std::size_t first, std::size_t last,
                    const WrongPart& wrong) {
    std::vector<std::string> rows;
    if (first > 0) {
        rows.push_back(sign_between(statement.relations[first - 1]));
    }
    for (std::size_t k = first; k <= last; ++k) {
        if (k > first) rows.push_back(sign_between(statement.relations[k - 1]));
        rows.push_back(written_mathml(*statement.sides[k], wrong));
    }
    return breakable(rows);
}

/// The right line typeset; as text where that cannot be read.
std::string right_line(const MarkedLine& line) {
    const bool has_latex = !line.right_latex.empty();
    try {
        const Written written = has_latex ? read_derivation("\\[" + line.right_latex + "\\]", "right.tex")
                                          : read_derivation(line.right + "\n", "right.txt");
        if (written.statements.size() == 1 && !written.statements[0].sides.empty())
            return formula(written.statements[0], 0, written.statements[0].sides.size() - 1, {});
    } catch (const SceneError&) {  // NOLINT(bugprone-empty-catch): the text is shown instead
    }
    return "<code>" + html(has_latex ? line.right_latex : line.right) + "</code>";
}

/// Without what Markdown marks headings, lists and strong words with, and without the point of the formula before.
std::string plain_words(const std::string& words) {
    std::string result;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool begins = i == 0 || words[i - 1] == ' ';
        if (begins && words[i] == '#') {
            while (i < words.size() && words[i] == '#') ++i;
            continue;
        }
        if (words[i] == '*' || words[i] == '`') continue;
        result += words[i];
    }
    const std::size_t first = result.find_first_not_of(" .,;:");
    return first == std::string::npos ? std::string() : result.substr(first);
}

void add_facts(std::string& page, const MarkedLine& line) {
    if (!line.reason.empty() && line.status != LineStatus::follows) put(page, "<p>{}</p>\n", html(line.reason));
    if (line.status != LineStatus::mistake) return;
    const CheckedClaim& c = line.checked;
    if (c.likely)
        put(page, "<p>{}</p>\n", html(say("Probable slip: {}.", words_of(*c.likely))));
    else if (!line.term.empty())
        put(page, "<p>{}<code>{}</code></p>\n", html(say("wrong term: ")), html(line.term));
    if (!line.right.empty() || !line.right_latex.empty())
        put(page, "<div class=\"repair\">{}{}</div>\n", html(say("correct line: ")), right_line(line));
    add_failing_state(page, c);
}

void add_row(std::string& page, const Marked& marked, const MarkedLine& line, const std::string& content) {
    put(page, "<div class=\"marked {}\">\n<span class=\"where\">{}</span>\n<div class=\"as-written\">{}</div>\n",
        name_of(line.status), line.line, content);
    put(page, "<strong class=\"verdict\">{}</strong>\n", html(words_of_status(marked, line)));
    std::string facts;
    add_facts(facts, line);
    if (!facts.empty()) put(page, "<div class=\"beside\">{}</div>\n", facts);
    page += "</div>\n";
}

/// The sides of the statement that the line compares: those inside its part of the document.
std::pair<std::size_t, std::size_t> sides_of(const WrittenStatement& statement, const MarkedLine& line,
                                             std::size_t nth) {
    const auto& sides = statement.sides;
    for (std::size_t k = 0; k + 1 < sides.size(); ++k)
        if (sides[k]->length > 0 && line.length > 0 && sides[k]->offset >= line.offset &&
            sides[k + 1]->offset + sides[k + 1]->length <= line.offset + line.length)
            return {k, k + 1};
    const std::size_t last = sides.size() - 1;
    return {std::min(nth, last), std::min(nth + 1, last)};
}

void end_words(std::string& page, std::string& words) {
    if (!words.empty()) put(page, "<p class=\"words\">{}</p>\n", words);
    words.clear();
}

/// `words`: the paragraph that is still open, with formulas among its words that claim nothing.
void add_statement(std::string& page, std::string& words, const Marked& marked, std::size_t which,
                   const std::vector<std::size_t>& lines) {
    const WrittenStatement& statement = marked.written.statements[which];
    const std::string before = plain_words(statement.words);
    words += (words.empty() || before.empty() ? "" : " ") + html(before);
    const std::string source = marked.written.text.substr(statement.offset, statement.length);
    if (lines.empty() && statement.sides.size() == 1 && !statement.displayed) {
        words += " <math>" + written_mathml(*statement.sides[0]) + "</math>";
        return;
    }
    end_words(page, words);
    if (lines.empty() && !statement.sides.empty()) {
        put(page,
            "<div class=\"marked\"><span class=\"where\">{}</span>\n<div class=\"as-written\">{}</div></div>\n",
            marked.written.line(statement.offset), formula(statement, 0, statement.sides.size() - 1, {}));
        return;
    }
    std::size_t nth = 0;
    for (const std::size_t k : lines) {
        const MarkedLine& line = marked.lines[k];
        std::string content = "<pre>" + html(line.source.empty() ? source : line.source) + "</pre>";
        if (!statement.sides.empty()) {
            const auto [first, last] = sides_of(statement, line, nth);
            // In a chain, the side on the left stands in the row above.
            content = formula(statement, nth == 0 ? first : last, last, {line.term_offset, line.term_length});
        }
        add_row(page, marked, line, content);
        ++nth;
    }
}

std::string counts_of_slips(const Gradebook& book) {
    std::string page;
    begin_table(page, say("How often each slip occurs"), {say("slip"), say("derivations")});
    for (const auto& [kind, count] : book.slips())
        put(page, "<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html(kind), count);
    return page + "</tbody></table></div>\n";
}

std::string table_of(const Gradebook& book) {
    std::string page;
    begin_table(page, say("{} derivations", book.rows.size()),
                {say("file"), say("first mistake"), say("slip"), say("right{}", ""), say("mistakes"),
                 say("following"), say("not judged"), say("missing")});
    for (std::size_t k = 0; k < book.rows.size(); ++k) {
        const GradedRow& row = book.rows[k];
        put(page, "<tr><th scope=\"row\"><a href=\"#derivation-{}\">{}</a></th>", k, html(row.file));
        if (!row.problem.empty()) {
            put(page, "<td colspan=\"7\">{}</td></tr>\n", html(one_line(row.problem)));
            continue;
        }
        put(page, "<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            row.first_mistake ? html(say("line {}", *row.first_mistake)) : "", html(row.kind), row.right,
            row.mistakes, row.follows, row.open, html(fmt::format("{}", fmt::join(row.missing, ", "))));
    }
    return page + "</tbody></table></div>\n";
}

}  // namespace

std::string marked_fragment(const Marked& marked) {
    std::vector<std::vector<std::size_t>> lines(marked.written.statements.size());
    for (std::size_t k = 0; k < marked.lines.size(); ++k) lines.at(marked.lines[k].statement).push_back(k);
    std::string page;
    put(page, "<p><strong>{}</strong></p>\n", html(summary_of(marked)));
    if (const std::string missing = words_of_missing(marked); !missing.empty())
        put(page, "<p>{}</p>\n", html(missing));
    page += "<div class=\"sheet-of-lines\">\n";
    std::string words;
    for (std::size_t s = 0; s < lines.size(); ++s) add_statement(page, words, marked, s, lines[s]);
    end_words(page, words);
    page += "</div>\n";
    std::string letters;
    for (const auto& [written, name] : marked.letters)
        if (written != name)
            put(letters, "{}<code>{}</code> = <code>{}</code>", letters.empty() ? "" : ", ", html(written),
                html(name));
    if (!letters.empty()) put(page, "<p class=\"hint\">{} {}</p>\n", html(say("Letters as understood:")), letters);
    for (const std::string& remark : marked.remarks) put(page, "<p class=\"hint\">{}</p>\n", html(remark));
    return page;
}

std::string as_html(const Marked& marked, const MarkedPageOptions& options) {
    std::string page = page_head(marked.written.file, false);
    put(page, "<header>\n<h1>{}</h1>\n<p class=\"source\">{}</p>\n</header>\n<main id=\"main\">\n<section>\n{}",
        html(marked.written.file), html(options.title), marked_fragment(marked));
    put(page, "</section>\n</main>\n<footer>{}</footer>\n</body>\n</html>\n",
        html(say("Checked by alembert {}.", options.version)));
    return page;
}

std::string as_html(const Gradebook& book, const MarkedPageOptions& options) {
    std::string page = page_head(say("Derivations: {}", options.title), false);
    put(page, "<header>\n<h1>{}</h1>\n</header>\n<main id=\"main\">\n<section>\n{}{}</section>\n",
        html(say("Derivations: {}", options.title)), table_of(book),
        book.slips().empty() ? std::string() : counts_of_slips(book));
    for (std::size_t k = 0; k < book.rows.size(); ++k) {
        const GradedRow& row = book.rows[k];
        put(page, "<section id=\"derivation-{}\">\n<h2>{}</h2>\n", k, html(row.file));
        if (row.problem.empty())
            put(page, "<details><summary>{}</summary>\n{}</details>\n", html(say("Line by line")), row.page);
        else
            put(page, "<pre class=\"problem\" role=\"note\">{}</pre>\n", html(row.problem));
        page += "</section>\n";
    }
    put(page, "</main>\n<footer>{}</footer>\n</body>\n</html>\n",
        html(say("Checked by alembert {}.", options.version)));
    return page;
}

}  // namespace alembert
