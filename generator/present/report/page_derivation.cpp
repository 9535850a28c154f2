// SPDX-License-Identifier: GPL-2.0-or-later
/// The derivation, the claims, the agreement of formalisms, the constraints.
#include "algebra/notation/latex.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "present/report/agree.hpp"
#include "present/report/audit.hpp"
#include "present/report/check.hpp"
#include "present/report/derivation.hpp"
#include "present/report/page_parts.hpp"

namespace alembert {

namespace {

// The most definitions shown for equations with intermediate symbols.
constexpr std::size_t definitions_shown = 150;

Notation html_notation() {
    Notation n = notation_of("mathml");
    n.inline_phrase = [](const Phrase& p) { return formula_begins + inline_math(p) + formula_ends; };
    return n;
}

/// Words with formulas among them. (The reader of scenes refuses control characters.)
std::string words_of_block(const std::string& words) {
    std::string result, plain;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] != formula_begins) {
            plain += words[i];
            continue;
        }
        const std::size_t end = words.find(formula_ends, i);
        result += html(plain) + words.substr(i + 1, end - i - 1);
        plain.clear();
        i = end;
    }
    return result + html(plain);
}

void add_blocks(PageParts& page, const std::vector<Block>& blocks) {
    for (const Block& block : blocks) {
        put(page.body, "<p>{}</p>\n", words_of_block(block.words));
        std::size_t shown = 0;
        for (const auto& [left, right] : block.equalities) {
            if (++shown > definitions_shown) {
                put(page.body, "<p>{}</p>\n", say("… and {} more.", block.equalities.size() - definitions_shown));
                break;
            }
            page.body += equation(left, right);
        }
    }
}

std::string equations_in(const Derivation& shown, std::string (*write)(const Phrase&), const char* separator) {
    std::string result;
    for (const ReadableEquation& e : shown.equations)
        result += (result.empty() ? "" : separator) + write(e.lhs) + " = " + write(e.rhs);
    return result;
}

}  // namespace

void add_derivation(PageParts& page, const Overview& all) {
    page.section("derivation", say("Derivation"));
    if (!all.derived.value) {
        page.problem(all.derived.problem);
        page.end();
        return;
    }
    const DerivedScene& d = *all.derived.value;
    const Notation n = html_notation();
    const std::vector<Block> plain = blocks_of(d, n, false), whole = blocks_of(d, n, true);
    const std::size_t steps = whole.size() - plain.size();
    const bool is_long = !d.shown.definitions.empty();
    if (!is_long && steps > 0)
        add_blocks(page, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(steps)});
    add_blocks(page, plain);
    put(page.body, "<p class=\"buttons\">");
    page.copy("LaTeX", equations_in(d.shown, latex, " \\\\\n"));
    page.copy(say("text"), equations_in(d.shown, text, "\n"));
    put(page.body, "</p>\n");
    page.end();
}

namespace {

/// The claim as its author wrote it, with the wrong term marked.
std::string marked(const std::string& equation, const std::optional<Slip>& likely) {
    const bool is_there = likely && likely->kind != "missing_term" && !likely->term.empty();
    std::string term = is_there ? likely->term : "";
    std::size_t at = is_there ? equation.find(term) : std::string::npos;
    if (is_there && at == std::string::npos && (term[0] == '-' || term[0] == '+')) {
        term.erase(0, 1);
        at = equation.find(term);
    }
    if (at == std::string::npos) return html(equation);
    return html(equation.substr(0, at)) + "<mark>" + html(term) + "</mark>" +
           html(equation.substr(at + term.size()));
}

void add_claim(std::string& body, const Claim& claim, const CheckedClaim& c) {
    const std::string equation = text_of(claim.equation);
    put(body, "<li class=\"claim {}\"><p><strong class=\"verdict\">{}</strong> <code>{}</code></p>\n",
        name_of(c.verdict), translated(name_of(c.verdict)), marked(equation, c.likely));
    if (!claim.source.empty()) put(body, "<p class=\"source\">{}</p>\n", html(claim.source));
    if (!c.reason.empty()) put(body, "<p>{}</p>\n", html(c.reason));
    if (c.verdict == Verdict::proved)
        put(body, "<p class=\"hint\">{}</p>\n",
            c.normal_form ? say("Proved by normal form.")
                          : say("Proved by exact evaluation at random states; the chance of an error is below {}.",
                                fmt::format("2<sup>{:.0f}</sup>", c.failure)));
    if (c.verdict == Verdict::refuted) {
        if (c.likely) put(body, "<p>{}</p>\n", html(say("Probable slip: {}.", words_of(*c.likely))));
        if (!c.nearest.empty())
            put(body, "<p>{}<code class=\"repair\">{}</code></p>\n", say("Correct equation: "), html(c.nearest));
        if (!c.difference.empty() && !is_missing_term(c))
            put(body, "<p>{}<code>{}</code></p>\n", say("Extra in your equation: "), html(c.difference));
        if (!c.counterexample.empty()) {
            put(body, "<details><summary>{}</summary><dl class=\"state\">", say("A state at which it fails"));
            for (const auto& [name, value] : c.counterexample)
                put(body, "<div><dt>{}</dt><dd>{}</dd></div>", html(name), html(value));
            put(body, "</dl><p>{}</p></details>\n", html(say("There left − right = {}", c.residual)));
        }
    }
    put(body, "</li>\n");
}

}  // namespace

void add_claims(PageParts& page, const Overview& all) {
    if (!all.checked.was_asked) return;
    page.section("claims", say("Claims"));
    if (!all.checked.value) {
        page.problem(all.checked.problem);
        page.end();
        return;
    }
    const Checked& checked = all.checked.value->checked;
    put(page.body, "<ol class=\"claims\">\n");
    for (std::size_t k = 0; k < checked.claims.size(); ++k)
        add_claim(page.body, all.checked.value->scene.claims[k], checked.claims[k]);
    put(page.body, "</ol>\n<p>{}</p>\n", html(words_of_completeness(checked)));
    page.end();
}

void add_agreement(PageParts& page, const Overview& all) {
    page.section("agreement", say("Agreement of the formalisms"));
    if (!all.agreed.value) {
        page.problem(all.agreed.problem);
        page.end();
        return;
    }
    const Agreed& agreed = *all.agreed.value;
    const Agreement& a = agreed.agreement;
    std::string names;
    for (const Equations& e : agreed.derivations.equations) names += (names.empty() ? "" : ", ") + e.formalism;
    const bool alone = agreed.derivations.equations.size() < 2;
    put(page.body, "<p><strong class=\"verdict {}\">{}</strong> {}</p>\n<p>{}</p>\n", name_of(a.verdict),
        translated(name_of(a.verdict)),
        html(alone ? say("for the only formalism that applies: {}.", names)
                   : say("These formalisms give the same equations: {}.", names)),
        html(a.verdict == Agreement::Verdict::proved ? how_it_was_proved(a) : a.reason));
    if (!agreed.derivations.refused.empty()) {
        put(page.body, "<details><summary>{}</summary><ul>\n", say("Formalisms that do not apply here"));
        for (const auto& [name, reason] : agreed.derivations.refused)
            put(page.body, "<li><strong>{}</strong>: {}</li>\n", html(name), html(reason));
        put(page.body, "</ul></details>\n");
    }
    page.end();
}

void add_constraints(PageParts& page, const Overview& all) {
    const Mechanism& m = all.mechanism;
    if (m.constraints.empty() && m.unilateral.empty() && m.redundant.empty() && m.identities.empty()) return;
    page.section("constraints", say("Constraints"));
    if (!all.audited.value) {
        page.problem(all.audited.problem);
    } else {
        const Audit& audit = all.audited.value->audit;
        begin_table(
            page.body,
            say("{} coordinates, rank {}: {} degree{} of freedom", m.size(), audit.rank, audit.degrees_of_freedom,
                audit.degrees_of_freedom == 1 ? "" : "s"),
            {say("constraint"), say("kind"), say("integrable"), say("redundant"), say("residual at the start")});
        for (const AuditedConstraint& c : audit.constraints)
            put(page.body,
                "<tr><th scope=\"row\">{}</th><td>{}{}</td><td>{}</td><td>{}</td><td>{:.2g}</td></tr>\n",
                html(c.name), c.holonomic ? say("holonomic") : say("nonholonomic"),
                c.rheonomic ? say(", depends on time") : "",
                c.integrable ? (*c.integrable ? say("yes") : say("no")) : say("undecided"),
                c.redundant ? say("yes") : say("no"), c.holonomic ? c.residual[0] : c.residual[1]);
        put(page.body, "</tbody></table></div>\n<details><summary>{}</summary><pre>{}</pre></details>\n",
            say("The whole audit"), html(as_text(*all.audited.value)));
        if (!audit.problem.empty()) page.problem(audit.problem);
    }
    page.end();
}

}  // namespace alembert
