// SPDX-License-Identifier: GPL-2.0-or-later
/// The claims with their verdicts.
#include "base/language/say.hpp"
#include "present/report/check.hpp"
#include "present/report/claim_mathml.hpp"
#include "present/report/page_parts.hpp"

namespace alembert {

namespace {

/// The claim as its author wrote it, with the wrong term marked.
std::string marked(const Equality& equation, const std::optional<Slip>& likely) {
    const bool is_there = likely && likely->kind != "missing_term";
    return typeset_equality(equation, is_there ? likely->term : "");
}

/// An equation that the program found.
std::string typeset_text(const std::string& text) {
    std::vector<Diagnostic> mistakes;
    const Equality equation = parse_equality(text, {}, mistakes, true);
    return equation.lhs && equation.rhs ? typeset_equality(equation, "") : "<code>" + html(text) + "</code>";
}

void add_claim(std::string& body, const Claim& claim, const CheckedClaim& c) {
    put(body, "<li class=\"claim {}\"><strong class=\"verdict\">{}</strong> {}\n", name_of(c.verdict),
        translated(name_of(c.verdict)), marked(claim.equation, c.likely));
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
            put(body, "<div class=\"repair\">{}{}</div>\n", say("Correct equation: "), typeset_text(c.nearest));
        if (!c.difference.empty() && !is_missing_term(c))
            put(body, "<p>{}<code>{}</code></p>\n", say("Extra in your equation: "), html(c.difference));
        add_failing_state(body, c);
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

}  // namespace alembert
