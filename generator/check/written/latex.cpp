// SPDX-License-Identifier: GPL-2.0-or-later
// A tree as LaTeX that is read as the same tree.

#include <algorithm>

#include "base/language/greek.hpp"
#include "check/written/commands.hpp"
#include "check/written/read.hpp"

namespace alembert {

namespace {

using MathKind = Math::Kind;

/// The sign of a letter: \theta, m, \mathrm{mp}.
std::string base_in_latex(const std::string& base) {
    if (base.size() == 1) return base;
    const WrittenCommand* const command = command_named(base);
    if (command != nullptr && command->kind == WrittenToken::Kind::letter && command->text == base)
        return "\\" + base;
    std::string word;
    for (const char c : base) word += c == '_' ? "\\_" : std::string(1, c);
    return "\\mathrm{" + word + "}";
}

bool is_plain_index(const std::string& text) {
    return text.find_first_not_of("0123456789,") == std::string::npos || text.size() == 1;
}

std::string index_in_latex(const std::string& text) {
    if (text.empty()) return {};
    if (is_plain_index(text)) return "_{" + text + "}";
    const std::size_t line = text.find('_');
    const std::string base = text.substr(0, line);
    if (greek_named(base) != nullptr) {
        const std::string rest = line == std::string::npos ? "" : text.substr(line + 1);
        if (rest == "dot" || rest == "ddot") return "_{\\" + rest + "{\\" + base + "}}";
        if (rest.find('_') == std::string::npos) return "_{\\" + base + index_in_latex(rest) + "}";
    }
    return "_{\\text{" + text + "}}";
}

std::string letter_in_latex(const Math& math) {
    static constexpr std::string_view dots[] = {"", "\\dot", "\\ddot", "\\dddot", "\\ddddot"};
    std::string text = base_in_latex(math.letter.base);
    std::string accents = math.letter.accent;
    while (!accents.empty()) {
        const std::size_t blank = accents.rfind(' ');
        const std::string one = accents.substr(blank == std::string::npos ? 0 : blank + 1);
        accents.resize(blank == std::string::npos ? 0 : blank);
        text = one == "Delta" ? "\\Delta " + text : "\\" + one + "{" + text + "}";
    }
    if (math.dots > 0 && math.dots <= 4) text = std::string(dots[math.dots]) + "{" + text + "}";
    text += index_in_latex(math.letter.index);
    if (!math.letter.raised.empty())
        text += math.letter.raised == "*" ? "^{*}" : "^{\\text{" + math.letter.raised + "}}";
    if (math.dots > 4) text += std::string(static_cast<std::size_t>(math.dots), '\'');
    return text;
}

/// How tightly a node holds together: 0 sum, 1 product, 2 factor, 3 what can have an exponent.
int tightness(const Math& math) {
    switch (math.kind) {
        case MathKind::sum:
        case MathKind::negate:
            return 0;
        case MathKind::product:
        case MathKind::quantity:
            return 1;
        case MathKind::rate:
        case MathKind::partial:
        case MathKind::power:
        case MathKind::quotient:
            return 2;
        case MathKind::call:
            return math.text == "sum" || math.text == "prod" || math.text == "integral" ? 1 : 2;
        case MathKind::variation:
            return 2;
        default:
            return 3;
    }
}

std::string bracketed(const Math& math, int least) {
    return tightness(math) < least ? "\\left(" + latex(math) + "\\right)" : latex(math);
}

std::string joined(const std::vector<MathPtr>& args, const std::string& between) {
    std::string text;
    for (const MathPtr& one : args) text += (text.empty() ? "" : between) + latex(*one);
    return text;
}

std::string sum_in_latex(const Math& math) {
    std::string text;
    for (const MathPtr& one : math.args) {
        if (one->kind == MathKind::negate)
            text += (text.empty() ? "-" : " - ") + bracketed(*one->args[0], 1);
        else
            text += (text.empty() ? "" : " + ") + bracketed(*one, 1);
    }
    return text;
}

std::string product_in_latex(const Math& math) {
    std::string text;
    const bool is_cross = math.text == "times", is_dotted = math.text == "cdot";
    for (std::size_t k = 0; k < math.args.size(); ++k) {
        const Math& one = *math.args[k];
        const bool is_product = one.kind == MathKind::product;
        const std::string factor = bracketed(one, is_product ? 3 : k + 1 < math.args.size() ? 2 : 1);
        const bool before_number = !text.empty() && one.kind == MathKind::number;
        // F(…) would be read for F times (…)
        const bool before_bracket =
            k > 0 && factor.starts_with("\\left(") && math.args[k - 1]->kind == MathKind::letter;
        if (k > 0) text += is_cross ? " \\times " : is_dotted || before_number ? " \\cdot " : " ";
        text += before_bracket && !is_cross && !is_dotted ? "{" + factor + "}" : factor;
    }
    return text;
}

std::string name_in_latex(const std::string& name) {
    if (name == "asin") return "\\arcsin";
    if (name == "acos") return "\\arccos";
    if (name == "atan") return "\\arctan";
    if (name == "abs" || name == "sign" || name == "atan2") return "\\operatorname{" + name + "}";
    return "\\" + name;
}

std::string call_in_latex(const Math& math) {
    if (math.text == "sqrt") return "\\sqrt{" + latex(*math.args[0]) + "}";
    if (math.text == "sum" || math.text == "prod" || math.text == "integral") {
        std::string text = math.text == "integral" ? "\\int" : "\\" + math.text;
        if (!math.letter.index.empty()) text += "_{\\text{" + math.letter.index + "}}";
        if (!math.letter.raised.empty()) text += "^{\\text{" + math.letter.raised + "}}";
        return text + " " + bracketed(*math.args[0], 1);
    }
    return name_in_latex(math.text) + "\\left(" + joined(math.args, ", ") + "\\right)";
}

std::string partial_in_latex(const Math& math) {
    const std::string sign = math.text == "d" ? "d " : "\\partial ";
    const std::size_t order = math.args.size() - 1;
    std::string below;
    for (std::size_t k = 1; k < math.args.size(); ++k)
        below += (below.empty() ? "" : " ") + sign + latex(*math.args[k]);
    const std::string raised = order > 1 ? "^{" + std::to_string(order) + "} " : "";
    const Math& of = *math.args[0];
    std::string above = sign.substr(0, sign.size() - 1) + (raised.empty() ? " " : raised);
    if (of.kind == MathKind::letter || of.kind == MathKind::applied)
        return "\\frac{" + above + latex(of) + "}{" + below + "}";
    return "\\frac{" + above + "}{" + below + "}\\left(" + latex(of) + "\\right)";
}

std::string rate_in_latex(const Math& math) {
    const std::string order = math.dots > 1 ? "^{" + std::to_string(math.dots) + "}" : "";
    return "\\frac{d" + order + "}{d t" + order + "}\\left(" + latex(*math.args[0]) + "\\right)";
}

std::string power_in_latex(const Math& math) {
    const Math& base = *math.args[0];
    std::string below = base.grouped ? "\\left(" + latex(base) + "\\right)" : bracketed(base, 3);
    // A letter's raised text or arguments stand where the exponent comes.
    if (base.kind == MathKind::letter && !base.letter.raised.empty()) below = "{" + below + "}";
    std::string above = latex(*math.args[1]);
    const bool is_capital =
        math.args[1]->kind == MathKind::letter && above.size() == 1 && above[0] >= 'A' && above[0] <= 'Z';
    if (is_capital) above = "{" + above + "}";
    return below + "^{" + above + "}";
}

std::string rows_in_latex(const Math& math) {
    std::string text;
    for (const MathPtr& row : math.args)
        text += (text.empty() ? "" : " \\\\ ") +
                (math.kind == MathKind::matrix ? joined(row->args, " & ") : latex(*row));
    return "\\begin{pmatrix}" + text + "\\end{pmatrix}";
}

}  // namespace

std::string latex(const Math& math) {
    switch (math.kind) {
        case MathKind::number:
            return math.text;
        case MathKind::letter:
            return letter_in_latex(math);
        case MathKind::call:
            return call_in_latex(math);
        case MathKind::applied:
            return letter_in_latex(math) + "\\left(" + joined(math.args, ", ") + "\\right)";
        case MathKind::sum:
            return sum_in_latex(math);
        case MathKind::product:
            return product_in_latex(math);
        case MathKind::negate:
            return "-" + bracketed(*math.args[0], 1);
        case MathKind::quotient:
            return "\\frac{" + latex(*math.args[0]) + "}{" + latex(*math.args[1]) + "}";
        case MathKind::power:
            return power_in_latex(math);
        case MathKind::rate:
            return rate_in_latex(math);
        case MathKind::partial:
            return partial_in_latex(math);
        case MathKind::variation: {
            const std::string of = latex(*math.args[0]);
            const bool is_letter = math.args[0]->kind == MathKind::letter;
            return (math.text == "d" ? "\\mathrm{d}" : "\\delta ") +
                   (is_letter ? of : "\\left(" + of + "\\right)");
        }
        case MathKind::vector:
        case MathKind::matrix:
            return rows_in_latex(math);
        case MathKind::quantity:
            return latex(*math.args[0]) + "\\,\\mathrm{" + math.text + "}";
    }
    return {};
}

}  // namespace alembert
