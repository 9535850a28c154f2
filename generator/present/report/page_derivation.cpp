// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of motion, the derivation, the agreement of formalisms, the constraints.
#include "algebra/notation/latex.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "present/report/agree.hpp"
#include "present/report/audit.hpp"
#include "present/report/derivation.hpp"
#include "present/report/page_parts.hpp"
#include "present/report/written_mathml.hpp"

namespace alembert {

namespace {

// The most definitions shown for equations with intermediate symbols.
constexpr std::size_t definitions_shown = 150;
constexpr std::size_t most_in_sight = 12;  // longer lists are folded

Notation html_notation() {
    Notation n = notation_of("mathml");
    n.inline_phrase = [](const Phrase& p) { return formula_begins + inline_math(p) + formula_ends; };
    return n;
}

/// Words with formulas among them, in MathML or in LaTeX. (The reader of scenes refuses control characters.)
std::string words_of_block(const std::string& words) {
    const std::string typeset_words = typeset(words);
    std::string result, plain;
    for (std::size_t i = 0; i < typeset_words.size(); ++i) {
        if (typeset_words[i] != formula_begins) {
            plain += typeset_words[i];
            continue;
        }
        const std::size_t end = typeset_words.find(formula_ends, i);
        const std::string formula = typeset_words.substr(i + 1, end - i - 1);
        result += html(plain) + (formula.starts_with("<math>") ? formula : latex_math(formula));
        plain.clear();
        i = end;
    }
    return result + html(plain);
}

void add_equalities(std::string& body, const Block& block) {
    std::size_t shown = 0;
    for (const auto& [left, right] : block.equalities) {
        if (++shown > definitions_shown) {
            put(body, "<p>{}</p>\n", say("… and {} more.", block.equalities.size() - definitions_shown));
            return;
        }
        body += equation(left, right);
    }
}

void add_block(std::string& body, const Block& block) {
    const bool folded = block.equalities.size() > (block.kind == Block::Kind::definition ? 0 : most_in_sight);
    if (folded)
        put(body, "<details><summary>{} ({})</summary>\n", words_of_block(block.words), block.equalities.size());
    else
        put(body, "<p>{}</p>\n", words_of_block(block.words));
    add_equalities(body, block);
    if (folded) body += "</details>\n";
}

std::string equations_in(const Derivation& shown, std::string (*write)(const Phrase&), const char* separator) {
    std::string result;
    for (const ReadableEquation& e : shown.equations)
        result += (result.empty() ? "" : separator) + write(e.lhs) + " = " + write(e.rhs);
    return result;
}

}  // namespace

void add_equations(PageParts& page, const Overview& all) {
    page.section("equations", say("Equations of motion"), Fold::never);
    add_badges(page, all);
    if (!all.derived.value) {
        page.problem(all.derived.problem);
        page.end();
        return;
    }
    const DerivedScene& d = *all.derived.value;
    for (const Block& block : blocks_of(d, html_notation(), false))
        if (block.kind == Block::Kind::equation || block.kind == Block::Kind::definition)
            add_block(page.body, block);
    put(page.body, "<p class=\"buttons\">");
    page.copy("LaTeX", equations_in(d.shown, latex, " \\\\\n"));
    page.copy(say("text"), equations_in(d.shown, text, "\n"));
    put(page.body, "</p>\n");
    page.end();
}

void add_derivation(PageParts& page, const Overview& all) {
    if (!all.derived.value) return;
    std::vector<Block> blocks;
    const bool is_long = !all.derived.value->shown.definitions.empty();
    for (Block& block : blocks_of(*all.derived.value, html_notation(), !is_long))
        if (block.kind == Block::Kind::step || block.kind == Block::Kind::remark)
            blocks.push_back(std::move(block));
    if (blocks.empty()) return;
    constexpr Readable in_folds{.lines = 1000, .operations = 20000, .of_one = 4000};  // half a megabyte
    leave_out_what_is_too_long(blocks, in_folds);
    page.section("derivation", say("Derivation"));
    for (const Block& block : blocks) add_block(page.body, block);
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
