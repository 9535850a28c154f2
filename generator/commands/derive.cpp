// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <cctype>
#include <iostream>

#include "analysis/contacts.hpp"
#include "analysis/expression_of.hpp"
#include "analysis/joint_reactions.hpp"
#include "commands/pipeline.hpp"
#include "formalism/formalisms.hpp"
#include "report/derivation.hpp"
#include "report/latex.hpp"
#include "report/mathml.hpp"
#include "report/text.hpp"

namespace alembert {

namespace {

/// Words, then what they announce.
struct Block {
    std::string words;
    std::vector<std::pair<std::string, std::string>> equalities;
};

/// How one format writes formulas, left sides of statements, and blocks.
struct Notation {
    std::string (*phrase)(const Phrase&);
    std::string (*inline_phrase)(const Phrase&);  ///< for use among words
    std::string (*left)(const Statement&);
    std::string (*page)(const std::vector<Block>&);
};

/// What `mathml` puts into its <math> element.
std::string mathml_row(const Phrase& phrase) {
    const std::string whole = mathml(phrase);
    const std::size_t begin = whole.find('>') + 1, end = whole.rfind("</math>");
    return whole.substr(begin, end - begin);
}

constexpr char formula_begins = '\x01', formula_ends = '\x02';  // around LaTeX among words

std::string escaped(const std::string& words, bool xml) {
    std::string result;
    bool in_formula = false;
    for (const char c : words) {
        if (c == formula_begins || c == formula_ends) {
            in_formula = c == formula_begins;
            result += '$';
            continue;
        }
        if (in_formula) {
            result += c;
            continue;
        }
        if (xml && c == '&') result += "&amp;";
        else if (xml && c == '<') result += "&lt;";
        else if (xml && c == '>') result += "&gt;";
        else if (!xml && std::string("_&%#${}").find(c) != std::string::npos) result += std::string("\\") + c;
        else if (!xml && c == '^') result += "\\^{}";
        else if (!xml && c == '~') result += "\\~{}";
        else if (!xml && c == '\\') result += "\\textbackslash{}";
        else result += c;
    }
    return result;
}

std::string text_left(const Statement& s) {
    switch (s.kind) {
        case Statement::Kind::partial: return fmt::format("d{}/d({})", s.letter, text(*s.by));
        case Statement::Kind::force: return fmt::format("{}({})", s.letter, text(*s.by));
        case Statement::Kind::work: return fmt::format("Q({}) of {}", text(*s.by), s.of);
        default: return s.of.empty() ? s.letter : fmt::format("{} of {}", s.letter, s.of);
    }
}

/// w_x, the component of an angular velocity, is ω_x in print.
bool is_angular(const std::string& letter) { return letter.size() == 3 && letter[0] == 'w' && letter[1] == '_'; }

std::string latex_letter(const std::string& letter) { return is_angular(letter) ? "\\omega_" + letter.substr(2) : letter; }

std::string mathml_letter(const std::string& letter) {
    return is_angular(letter) ? "<msub><mi>ω</mi><mi>" + letter.substr(2) + "</mi></msub>" : "<mi>" + letter + "</mi>";
}

std::string latex_left(const Statement& s) {
    const std::string of = s.of.empty() ? "" : fmt::format("^{{\\text{{{}}}}}", escaped(s.of, false));
    switch (s.kind) {
        case Statement::Kind::partial:
            return fmt::format("\\frac{{\\partial {}}}{{\\partial {}}}", latex_letter(s.letter), latex(*s.by));
        case Statement::Kind::force:
        case Statement::Kind::work: return fmt::format("{}_{{{}}}{}", s.letter, latex(*s.by), of);
        default: return latex_letter(s.letter) + of;
    }
}

std::string mathml_left(const Statement& s) {
    const std::string letter = mathml_letter(s.letter);
    const std::string of = "<mtext>" + escaped(s.of, true) + "</mtext>";
    switch (s.kind) {
        case Statement::Kind::partial:
            return "<mfrac><mrow><mo>∂</mo>" + letter + "</mrow><mrow><mo>∂</mo>" + mathml_row(*s.by) + "</mrow></mfrac>";
        case Statement::Kind::force: return "<msub>" + letter + "<mrow>" + mathml_row(*s.by) + "</mrow></msub>";
        case Statement::Kind::work:
            return "<msubsup>" + letter + "<mrow>" + mathml_row(*s.by) + "</mrow>" + of + "</msubsup>";
        default: return s.of.empty() ? letter : "<msup>" + letter + of + "</msup>";
    }
}

std::string text_page(const std::vector<Block>& blocks) {
    std::string page;
    for (const Block& block : blocks) {
        page += (page.empty() ? "" : "\n") + block.words + "\n";
        for (const auto& [left, right] : block.equalities) page += "  " + left + " = " + right + "\n";
    }
    return page;
}

constexpr int line_width = 75;  // letters of a formula that fit on a page

/// Letters that a reader sees, roughly: a command is one, braces are none.
int visible(const std::string& formula) {
    int count = 0;
    for (std::size_t i = 0; i < formula.size(); ++i) {
        if (formula[i] == '\\')
            while (i + 1 < formula.size() && std::isalpha(static_cast<unsigned char>(formula[i + 1])) != 0) ++i;
        if (std::string("{}_ ").find(formula[i]) == std::string::npos) ++count;
    }
    return count;
}

/// A long sum over several lines, broken before its outermost signs.
std::string broken(const std::string& formula) {
    std::string lines, line;
    int depth = 0;
    for (std::size_t i = 0; i < formula.size(); ++i) {
        const char c = formula[i];
        if (c == '{' || c == '(') ++depth;
        if (c == '}' || c == ')') --depth;
        const bool is_sign = depth == 0 && c == ' ' && i + 2 < formula.size() &&
                             (formula[i + 1] == '+' || formula[i + 1] == '-') && formula[i + 2] == ' ';
        std::size_t next = i + 2;  // where the term that begins here ends
        for (int inside = 0; is_sign && next < formula.size(); ++next) {
            if (formula[next] == '{' || formula[next] == '(') ++inside;
            if (formula[next] == '}' || formula[next] == ')') --inside;
            if (inside == 0 && next > i + 3 && formula[next] == ' ' && next + 2 < formula.size() &&
                (formula[next + 1] == '+' || formula[next + 1] == '-') && formula[next + 2] == ' ')
                break;
        }
        if (is_sign && visible(line) + visible(formula.substr(i, next - i)) > line_width) {
            lines += line + " \\\\\n  &\\quad ";
            line.clear();
            continue;
        }
        line += c;
    }
    return lines + line;
}

std::string latex_equality(const std::string& left, const std::string& right) {
    if (visible(left) + visible(right) <= line_width) return "  " + left + " &= " + right;
    if (visible(left) > line_width / 2) return "  &" + broken(left + " = " + right);
    return "  " + left + " &= " + broken(right);
}

std::string latex_page(const std::vector<Block>& blocks) {
    std::string page;
    for (const Block& block : blocks) {
        page += (page.empty() ? "" : "\n") + escaped(block.words, false) + "\n";
        if (block.equalities.empty()) continue;
        page += "\\begin{align*}\n";
        for (std::size_t i = 0; i < block.equalities.size(); ++i)
            page += latex_equality(block.equalities[i].first, block.equalities[i].second) +
                    (i + 1 < block.equalities.size() ? " \\\\\n" : "\n");
        page += "\\end{align*}\n";
    }
    return page;
}

std::string mathml_page(const std::vector<Block>& blocks) {
    std::string page =
        "<math display=\"block\" xmlns=\"http://www.w3.org/1998/Math/MathML\">\n<mtable displaystyle=\"true\">\n";
    for (const Block& block : blocks) {
        page += "<mtr><mtd columnspan=\"3\"><mtext>" + escaped(block.words, true) + "</mtext></mtd></mtr>\n";
        for (const auto& [left, right] : block.equalities)
            page += "<mtr><mtd><mrow>" + left + "</mrow></mtd><mtd><mo>=</mo></mtd><mtd><mrow>" + right +
                    "</mrow></mtd></mtr>\n";
    }
    return page + "</mtable>\n</math>\n";
}

Notation notation_of(const std::string& format) {
    const auto plain = [](const Phrase& p) { return text(p); };
    if (format == "latex")
        return {[](const Phrase& p) { return latex(p); },
                [](const Phrase& p) { return formula_begins + latex(p) + formula_ends; }, latex_left, latex_page};
    if (format == "mathml") return {mathml_row, plain, mathml_left, mathml_page};
    return {plain, plain, text_left, text_page};
}

/// The four steps of the book but for the equations themselves.
std::vector<Block> steps(const Derivation& shown, const Notation& n) {
    const auto statements = [&](const std::vector<Statement>& list) {
        std::vector<std::pair<std::string, std::string>> result;
        for (const Statement& s : list) result.emplace_back(n.left(s), n.phrase(s.value));
        return result;
    };
    std::string names;
    for (const Phrase& q : shown.coordinates) names += (names.empty() ? "" : ", ") + n.inline_phrase(q);
    const int freedom = shown.degrees_of_freedom;
    std::vector<Block> blocks{{fmt::format("1. The system has {} degree{} of freedom; generalized coordinate{}: {}.", freedom,
                                           freedom == 1 ? "" : "s", shown.coordinates.size() == 1 ? "" : "s", names),
                               {}}};

    if (!shown.angular.empty()) blocks.push_back({"Angular velocities along the axes of the bodies:", statements(shown.angular)});
    std::vector<Statement> energies = shown.energies;
    const auto total = [&](const char* letter, const Phrase& value) {
        energies.push_back({Statement::Kind::energy, letter, "", {}, value});
    };
    if (shown.lagrangian) {
        total("L", *shown.lagrangian);
    } else {
        total("T", shown.kinetic);
        total("V", shown.potential);
    }
    blocks.push_back({shown.lagrangian ? "2. The Lagrangian, as the scene gives it:" : "2. Kinetic and potential energy:",
                      statements(energies)});
    blocks.push_back({shown.forces.empty() ? "3. No force does virtual work beside what is in the energies."
                                           : "3. Generalized forces, from the virtual work dW = sum of Q(q) dq:",
                      statements(shown.forces)});
    for (std::size_t k = 0; k < shown.sections.size(); ++k) {
        const Section& section = shown.sections[k];
        blocks.push_back({(k == 0 ? "4. " : "") + section.words, statements(section.statements)});
        for (const auto& [left, right] : section.equalities)
            blocks.back().equalities.emplace_back(n.phrase(left), n.phrase(right));
    }
    if (!shown.sections.empty()) return blocks;
    blocks.push_back({shown.lagrangian ? "4. For Lagrange's equations d/dt dL/dq' - dL/dq = Q:"
                                       : "4. For Lagrange's equations d/dt dT/dq' - dT/dq = Q:",
                      statements(shown.derivatives)});
    return blocks;
}

/// What joints bear, as far as it is short: F_x … M_z of each.
std::vector<Statement> borne(const Derived& d) {
    constexpr std::size_t most_terms = 20;
    constexpr const char* letters[] = {"F_x", "F_y", "F_z", "M_x", "M_y", "M_z"};
    if (d.mechanism.joints.empty()) return {};
    const JointReactions reactions = joint_reactions(d.scene, d.mechanism);
    std::vector<GiNaC::symbol> multipliers;
    const auto find = [&](const std::string& name, const Mechanism::Constraint& c) {
        if (c.multiplier.get_name() == name) multipliers.push_back(c.multiplier);
    };
    for (const std::string& name : reactions.multipliers) {
        for (const auto* list : {&d.mechanism.constraints, &d.mechanism.redundant})
            for (const Mechanism::Constraint& c : *list) find(name, c);
        for (const Mechanism::Unilateral& contact : d.mechanism.unilateral) find(name, contact.gap);
    }
    const std::vector<int> force = reactions.program.nodes_of("force"), moment = reactions.program.nodes_of("moment");
    std::vector<Statement> result;
    for (std::size_t k = 0; k < reactions.joints.size(); ++k)
        for (std::size_t i = 0; i < 6; ++i) {
            const auto e = expression_of(reactions.program, i < 3 ? force[3 * k + i] : moment[3 * k + i - 3], d.mechanism, multipliers);
            if (!e) continue;
            const auto f = fourier(*e, *d.mechanism.symbols, 20 * most_terms);
            if (!f || f->size() > most_terms) continue;
            result.push_back({.kind = Statement::Kind::energy, .letter = letters[i], .of = reactions.joints[k], .by = {}, .value = readable(*f)});
        }
    return result;
}

Json as_json(const Derivation& shown, const Mechanism& m) {
    Json result;
    result["formalism"] = shown.formalism;
    result["degrees_of_freedom"] = shown.degrees_of_freedom;
    result["coordinates"] = Json::array();
    result["speeds"] = Json::array();
    for (const GiNaC::symbol& q : m.q) {
        result["coordinates"].push_back(q.get_name());
        if (m.speeds.empty()) result["speeds"].push_back(q.get_name() + "'");
    }
    for (const Mechanism::Speed& speed : m.speeds) result["speeds"].push_back(speed.u.get_name());
    result["multipliers"] = Json::array();
    for (const Mechanism::Constraint& c : m.constraints) result["multipliers"].push_back(c.multiplier.get_name());
    if (!shown.gaps.empty()) {
        result["gaps"] = Json::object();
        for (const auto& [name, phrase] : shown.gaps) result["gaps"][name] = text(phrase);
    }
    if (!shown.reactions.empty()) {
        result["reactions"] = Json::object();
        for (const Statement& r : shown.reactions) result["reactions"][r.of][text(*r.by)] = text(r.value);
    }
    result["kinetic"] = text(shown.kinetic);
    result["potential"] = text(shown.potential);
    if (shown.lagrangian) result["lagrangian"] = text(*shown.lagrangian);
    result["equations"] = Json::array();
    for (const ReadableEquation& e : shown.equations) {
        Json one = {{"text", text(e.lhs) + " = " + text(e.rhs)}, {"latex", latex(e.lhs) + " = " + latex(e.rhs)}};
        if (e.divided_by) one["divided_by"] = text(*e.divided_by);
        result["equations"].push_back(std::move(one));
    }
    if (!shown.kinematics.empty()) {
        result["kinematics"] = Json::array();
        for (const auto& [rate, value] : shown.kinematics)
            result["kinematics"].push_back({{"text", text(rate) + " = " + text(value)}, {"latex", latex(rate) + " = " + latex(value)}});
    }
    for (const auto* list : {&shown.speeds, &shown.definitions})
        for (const auto& [name, value] : *list)
            result["definitions"].push_back({{"name", text(name)}, {"text", text(value)}});
    return result;
}

}  // namespace

int derive(const Request& request) {
    Derived d = derived(request);
    // Reactions of unilateral constraints stand in the equations, zero while the gap is open; not in those for
    // independent coordinates, where all gaps are.
    const bool independent = !request.by.empty() && formalism(request.by).independent;
    const bool reactions = !d.mechanism.unilateral.empty() && !independent;
    if (reactions) d = derived_again(d, with_all_closed(d.mechanism), request.by);
    Derivation shown = derivation_of(d.mechanism, d.equations, formalism(d.equations.formalism));
    if (request.reactions) show_reactions(shown, d.mechanism);
    const std::vector<Statement> joints = request.reactions ? borne(d) : std::vector<Statement>();
    if (request.json) {
        Json result = as_json(shown, d.mechanism);
        for (const Statement& s : joints) result["joint_reactions"][s.of][s.letter] = text(s.value);
        std::cout << result.dump(2) << "\n";
        return 0;
    }
    const Notation n = notation_of(request.format);
    std::vector<Block> blocks;
    if (request.format == "text" && !d.scene.title.empty()) blocks.push_back({d.scene.title, {}});
    if (!shown.definitions.empty()) {
        blocks.push_back({"The equations are beyond the readable size; intermediate symbols:", {}});
        for (const auto& [name, value] : shown.definitions)
            blocks.back().equalities.emplace_back(n.phrase(name), n.phrase(value));
        for (const Section& section : shown.sections) {
            if (!request.steps) break;
            blocks.push_back({section.words, {}});
            for (const Statement& s : section.statements) blocks.back().equalities.emplace_back(n.left(s), n.phrase(s.value));
        }
    } else if (request.steps) {
        for (Block& block : steps(shown, n)) blocks.push_back(std::move(block));
    }
    const bool free = d.mechanism.constraints.size() == (reactions ? d.mechanism.unilateral.size() : 0);
    if (!shown.choice.empty()) blocks.push_back({shown.choice, {}});
    for (const auto& [speed, form] : shown.speeds) blocks.back().equalities.emplace_back(n.phrase(speed), n.phrase(form));
    blocks.push_back({fmt::format("Equations of motion ({}{}):",
                                  shown.title,
                                  !request.by.empty()        ? ""
                                  : !d.equations.speeds_are_rates() ? "; the scene has generalized speeds"
                                  : free && reactions ? "; the coordinates are independent while all gaps are open"
                                  : free              ? "; the coordinates are independent"
                                                      : "; the coordinates are not independent"),
                      {}});
    for (const ReadableEquation& e : shown.equations) blocks.back().equalities.emplace_back(n.phrase(e.lhs), n.phrase(e.rhs));
    if (!shown.kinematics.empty()) {
        blocks.push_back({"with the rates of the coordinates:", {}});
        for (const auto& [rate, value] : shown.kinematics) blocks.back().equalities.emplace_back(n.phrase(rate), n.phrase(value));
    }
    for (const Phrase& pole : shown.poles)
        blocks.push_back({fmt::format("They do not follow from the speeds where {} = 0.", n.inline_phrase(pole)), {}});
    if (!shown.constraints.empty()) {
        const bool all = d.equations.A.empty();
        blocks.push_back({all ? "The constraints, which the speeds obey:"
                              : "with the constraints (multipliers stand on the right with a plus: M q'' = F + A^T lambda):", {}});
        for (const auto& [name, phrase] : shown.constraints) blocks.back().equalities.emplace_back(n.phrase(phrase), "0");
    }
    if (!shown.reactions.empty()) {
        blocks.push_back({"Reactions as generalized forces, Q = A^T lambda:", {}});
        for (const Statement& r : shown.reactions) blocks.back().equalities.emplace_back(n.left(r), n.phrase(r.value));
    }
    if (!joints.empty()) {
        blocks.push_back({"Joints bear, as force and moment on the child at its point, along the joint's axes in the parent:", {}});
        for (const Statement& s : joints) blocks.back().equalities.emplace_back(n.left(s), n.phrase(s.value));
    }
    if (!shown.gaps.empty()) {
        blocks.push_back({"with the unilateral constraints gap >= 0, lambda >= 0, lambda*gap = 0 for the gaps:", {}});
        for (const auto& [name, phrase] : shown.gaps)
            blocks.back().equalities.emplace_back(n.left({Statement::Kind::energy, "gap", name, {}, {}}), n.phrase(phrase));
    }
    for (std::size_t i = 0; i < shown.equations.size(); ++i)
        if (shown.equations[i].divided_by)
            blocks.push_back({fmt::format("The equation of {} has been divided by {}.",
                                          n.inline_phrase(shown.rows[i]),
                                          n.inline_phrase(*shown.equations[i].divided_by)),
                              {}});
    std::cout << n.page(blocks);
    return 0;
}

}  // namespace alembert
