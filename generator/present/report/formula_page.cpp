// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/formula_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include <cctype>

#include "algebra/notation/latex.hpp"
#include "algebra/notation/mathml.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

/// The contents of the <math> element of `mathml`.
std::string mathml_row(const Phrase& phrase) {
    const std::string whole = mathml(phrase);
    const std::size_t begin = whole.find('>') + 1, end = whole.rfind("</math>");
    return whole.substr(begin, end - begin);
}

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
        if (xml && c == '&')
            result += "&amp;";
        else if (xml && c == '<')
            result += "&lt;";
        else if (xml && c == '>')
            result += "&gt;";
        else if (!xml && std::string("_&%#${}").find(c) != std::string::npos)
            result += std::string("\\") + c;
        else if (!xml && c == '^')
            result += "\\^{}";
        else if (!xml && c == '~')
            result += "\\~{}";
        else if (!xml && c == '\\')
            result += "\\textbackslash{}";
        else
            result += c;
    }
    return result;
}

/// Formulas that occur in the words of steps; longer ones come before shorter ones with which they begin.
struct Spelled {
    std::string_view plain, latex;
};
constexpr std::array<Spelled, 32> spelled{{
    {"omega x (omega x r)", "\\omega \\times (\\omega \\times r)"},
    {"2 omega x v_relative", "2 \\omega \\times v_{\\text{relative}}"},
    {"omega x r + v_relative", "\\omega \\times r + v_{\\text{relative}}"},
    {"alpha x r", "\\alpha \\times r"},
    {"omega x omega", "\\omega \\times \\omega"},
    {"M q'' = F + A^T lambda", "M \\ddot{q} = F + A^{T} \\lambda"},
    {"m x'' = F + A^T lambda", "m \\ddot{x} = F + A^{T} \\lambda"},
    {"F + F* + A^T lambda = 0", "F + F^{*} + A^{T} \\lambda = 0"},
    {"F + F* = 0", "F + F^{*} = 0"},
    {"F*", "F^{*}"},
    {"Q + Q* + A^T lambda = 0", "Q + Q^{*} + A^{T} \\lambda = 0"},
    {"Q + Q* = 0", "Q + Q^{*} = 0"},
    {"Q = A^T lambda", "Q = A^{T} \\lambda"},
    {"A^T lambda", "A^{T} \\lambda"},
    {"dS/du' = Q + A^T lambda", "\\partial S/\\partial \\dot{u} = Q + A^{T} \\lambda"},
    {"dS/du' = Q", "\\partial S/\\partial \\dot{u} = Q"},
    {"p = dL/dq'", "p = \\partial L/\\partial \\dot{q}"},
    {"R = L - sum of p q'", "R = L - \\sum p \\dot{q}"},
    {"H = sum of p q' - L", "H = \\sum p \\dot{q} - L"},
    {"E = d/dt dL/dq' - dL/dq - Q",
     "E = \\frac{d}{dt} \\frac{\\partial L}{\\partial \\dot{q}} - \\frac{\\partial L}{\\partial q} - Q"},
    {"d/dt dL/dq' - dL/dq = Q",
     "\\frac{d}{dt} \\frac{\\partial L}{\\partial \\dot{q}} - \\frac{\\partial L}{\\partial q} = Q"},
    {"d/dt dT/dq' - dT/dq = Q",
     "\\frac{d}{dt} \\frac{\\partial T}{\\partial \\dot{q}} - \\frac{\\partial T}{\\partial q} = Q"},
    {"dL'/dq' - 2 dL/dq = Q",
     "\\frac{\\partial \\dot{L}}{\\partial \\dot{q}} - 2 \\frac{\\partial L}{\\partial q} = Q"},
    {"L' ", "\\dot{L} "},
    {"q' = B u + b", "\\dot{q} = B u + b"},
    {"B = dq'/du", "B = \\partial \\dot{q}/\\partial u"},
    {"E dq'/du", "E \\, \\partial \\dot{q}/\\partial u"},
    {"dW* = sum of Q* dq", "\\delta W^{*} = \\sum Q^{*} \\, \\delta q"},
    {"dW = sum of Q(q) dq", "\\delta W = \\sum Q_{q} \\, \\delta q"},
    {"dW = sum of Q dq", "\\delta W = \\sum Q \\, \\delta q"},
    {"S = sum of m a^2/2 + alpha.I alpha/2 + alpha.(w x I w)",
     "S = \\sum m a^{2}/2 + \\alpha \\cdot I \\alpha/2 + \\alpha \\cdot (\\omega \\times I \\omega)"},
    {"gap >= 0, lambda >= 0, lambda*gap = 0",
     "\\mathrm{gap} \\ge 0,\\ \\lambda \\ge 0,\\ \\lambda \\, \\mathrm{gap} = 0"},
}};

/// What stands after the letter of a motion: "x'" is x and ', "v^2" is v and ^2.
std::pair<std::string, std::string> stem_and_mark(const std::string& letter) {
    const std::size_t mark = letter.find_first_of("'^");
    return {letter.substr(0, mark), mark == std::string::npos ? "" : letter.substr(mark)};
}

std::string text_left(const Statement& s) {
    switch (s.kind) {
        case Statement::Kind::motion: {
            const auto [stem, mark] = stem_and_mark(s.letter);
            return stem + "_" + s.of + mark;
        }
        case Statement::Kind::partial_rate:
            return fmt::format("d/dt d{}/d({})", s.letter, text(*s.by));
        case Statement::Kind::partial:
            return fmt::format("d{}/d({})", s.letter, text(*s.by));
        case Statement::Kind::force:
            return fmt::format("{}({})", s.letter, text(*s.by));
        case Statement::Kind::work:
            return say("Q({}) of {}", text(*s.by), s.of);
        default:
            return s.of.empty() ? s.letter : say("{} of {}", s.letter, s.of);
    }
}

/// A letter and the component that it is of: w_x, the component of an angular velocity, is ω_x in print.
struct Component {
    std::string latex, mathml;
    std::string index;  ///< empty where there is none
};

Component component_of(const std::string& letter) {
    const std::size_t mark = letter.find('_');
    const std::string stem = letter.substr(0, mark);
    const std::string index = mark == std::string::npos ? "" : letter.substr(mark + 1);
    if (stem == "omega" || stem == "w") return {"\\omega", "ω", index};
    if (stem == "alpha") return {"\\alpha", "α", index};
    if (stem == "omega x r") return {"\\omega \\times r", "ω × r", index};
    if (stem == "omega x omega") return {"\\omega \\times \\omega", "ω × ω", index};
    return {stem, stem, index};
}

std::string latex_letter(const std::string& letter) {
    if (letter == "L'") return "\\dot{L}";
    if (letter == "gap") return "\\mathrm{gap}";
    if (letter.ends_with('*')) return letter.substr(0, letter.size() - 1) + "^{*}";
    const Component c = component_of(letter);
    return c.index.empty() ? c.latex
                           : c.latex + "_" + (c.index.size() == 1 ? c.index : "{\\text{" + c.index + "}}");
}

std::string mathml_letter(const std::string& letter) {
    const Component c = component_of(letter);
    return c.index.empty() ? "<mi>" + c.mathml + "</mi>"
                           : "<msub><mi>" + c.mathml + "</mi><mi>" + c.index + "</mi></msub>";
}

/// A position, a velocity, a square of a speed or an angular velocity, with its body below.
std::string mathml_motion(const std::string& letter, const std::string& of) {
    const auto [stem, mark] = stem_and_mark(letter);
    const std::string base = mathml_letter(stem);
    if (mark == "^2") return "<msubsup>" + base + of + "<mn>2</mn></msubsup>";
    const std::string accented = "<mover accent=\"true\">" + base + "<mo>˙</mo></mover>";
    return "<msub>" + (mark == "'" ? accented : base) + of + "</msub>";
}

std::string latex_left(const Statement& s) {
    const std::string of = s.of.empty() ? "" : fmt::format("^{{\\text{{{}}}}}", escaped(s.of, false));
    const auto partial = [&] {
        return fmt::format("\\frac{{\\partial {}}}{{\\partial {}}}", latex_letter(s.letter), latex(*s.by));
    };
    switch (s.kind) {
        case Statement::Kind::motion: {
            const auto [stem, mark] = stem_and_mark(s.letter);
            const std::string letter = mark == "'" ? "\\dot{" + stem + "}" : latex_letter(stem);
            const std::string index = "_{\\text{" + escaped(s.of, false) + "}}";
            return letter + index + (mark == "^2" ? "^{2}" : "");
        }
        case Statement::Kind::partial:
            return partial();
        case Statement::Kind::partial_rate:
            return "\\frac{d}{dt} " + partial();
        case Statement::Kind::force:
        case Statement::Kind::work:
            return fmt::format("{}_{{{}}}{}", latex_letter(s.letter), latex(*s.by), of);
        default:
            return latex_letter(s.letter) + of;
    }
}

std::string mathml_left(const Statement& s) {
    const std::string letter = mathml_letter(s.letter);
    const std::string of = "<mtext>" + escaped(s.of, true) + "</mtext>";
    const auto partial = [&] {
        return "<mfrac><mrow><mo>∂</mo>" + letter + "</mrow><mrow><mo>∂</mo>" + mathml_row(*s.by) +
               "</mrow></mfrac>";
    };
    switch (s.kind) {
        case Statement::Kind::motion:
            return mathml_motion(s.letter, of);
        case Statement::Kind::partial:
            return partial();
        case Statement::Kind::partial_rate:
            return "<mfrac><mi>d</mi><mrow><mi>d</mi><mi>t</mi></mrow></mfrac>" + partial();
        case Statement::Kind::force:
            return "<msub>" + letter + "<mrow>" + mathml_row(*s.by) + "</mrow></msub>";
        case Statement::Kind::work:
            return "<msubsup>" + letter + "<mrow>" + mathml_row(*s.by) + "</mrow>" + of + "</msubsup>";
        default:
            return s.of.empty() ? letter : "<msup>" + letter + of + "</msup>";
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

/// The approximate number of visible letters: a command counts as one, braces do not count.
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
        std::size_t next = i + 2;  // the end of the term that begins here
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
        page += (page.empty() ? "" : "\n") + escaped(typeset(block.words), false) + "\n";
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

}  // namespace

std::string typeset(const std::string& given) {
    std::string words = given, result;
    const std::string sum = "Σ ";  // in Chinese
    for (std::size_t at = words.find(sum); at != std::string::npos; at = words.find(sum))
        words.replace(at, sum.size(), "sum of ");
    for (std::size_t i = 0; i < words.size();) {
        const bool begins = i == 0 || (std::isalnum(static_cast<unsigned char>(words[i - 1])) == 0 &&
                                       std::string_view("/'^*").find(words[i - 1]) == std::string_view::npos);
        const auto found = std::find_if(spelled.begin(), spelled.end(), [&](const Spelled& s) {
            return begins && std::string_view(words).substr(i).starts_with(s.plain);
        });
        if (found == spelled.end()) {
            result += words[i++];
            continue;
        }
        const bool has_space = found->plain.back() == ' ';
        result += formula_begins;
        result += found->latex.substr(0, found->latex.size() - (has_space ? 1 : 0));
        result += formula_ends;
        if (has_space) result += ' ';
        i += found->plain.size();
    }
    return result;
}

Notation notation_of(const std::string& format) {
    const auto plain = [](const Phrase& p) { return text(p); };
    if (format == "latex")
        return {[](const Phrase& p) { return latex(p); },
                [](const Phrase& p) { return formula_begins + latex(p) + formula_ends; }, latex_left, latex_page};
    if (format == "mathml") return {mathml_row, plain, mathml_left, mathml_page};
    return {plain, plain, text_left, text_page};
}

}  // namespace alembert
