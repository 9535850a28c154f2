// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/written_mathml.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "alembert/base/error.hpp"
#include "algebra/notation/mathml.hpp"
#include "base/language/greek.hpp"
#include "check/written/read.hpp"
#include "present/report/html.hpp"

namespace alembert {

namespace {

using Kind = Math::Kind;

std::string element_of(const std::string& name, const std::string& content) {
    return "<" + name + ">" + content + "</" + name + ">";
}
std::string row_of(const std::string& content) {
    return element_of("mrow", content);
}
std::string sign_of(const std::string& sign) {
    return element_of("mo", sign);
}
const std::string thin_space = "<mspace width=\"0.17em\"></mspace>";
const std::string minus_sign = "<mo>&#x2212;</mo>", no_sign = "<mo>&#x2062;</mo>", of_sign = "<mo>&#x2061;</mo>",
                  partial_sign = "<mi>&#x2202;</mi>";

/// "theta" as θ, "ell" as ℓ; other words as they are.
std::string printed(const std::string& base) {
    static const std::map<std::string, std::string> signs{
        {"ell", "ℓ"}, {"varphi", "φ"},   {"varepsilon", "ε"}, {"vartheta", "ϑ"}, {"varrho", "ϱ"}, {"hbar", "ħ"},
        {"phi", "ϕ"}, {"varOmega", "Ω"}, {"infty", "∞"},      {"nabla", "∇"},    {"imath", "ı"},  {"jmath", "ȷ"}};
    if (const auto found = signs.find(base); found != signs.end()) return found->second;
    if (const GreekLetter* greek = greek_named(base)) return std::string(greek->letter);
    return base;
}

std::string accented(const std::string& letter, const std::string& accent) {
    static const std::map<std::string, const char*> above{
        {"vec", "&#x2192;"}, {"hat", "^"}, {"bar", "&#xAF;"}, {"tilde", "~"}, {"overline", "&#xAF;"}};
    if (const auto found = above.find(accent); found != above.end())
        return "<mover accent=\"true\">" + letter + sign_of(found->second) + "</mover>";
    if (accent == "prime") return element_of("msup", letter + sign_of("&#x2032;"));
    return letter;
}

bool is_bold(const std::string& accent) {
    return accent == "mathbf" || accent == "boldsymbol" || accent == "bm";
}

std::string dotted(const std::string& letter, int dots) {
    constexpr std::array<const char*, 5> signs{"", "˙", "¨", "⃛", "⃜"};
    if (dots <= 0) return letter;
    if (dots < 5)
        return "<mover accent=\"true\">" + letter + sign_of(signs[static_cast<std::size_t>(dots)]) + "</mover>";
    return element_of("msup", letter + in_brackets(element_of("mn", std::to_string(dots))));
}

/// "1,2", "cm", "theta_1" below or above a letter.
std::string small_print(const std::string& text) {
    const bool is_number = text.find_first_not_of("0123456789") == std::string::npos;
    if (is_number) return element_of("mn", text);
    const std::size_t split = text.find('_');
    if (split == std::string::npos || split == 0) return element_of("mi", html(printed(text)));
    return element_of(
        "msub", element_of("mi", html(printed(text.substr(0, split)))) + small_print(text.substr(split + 1)));
}

std::string letter_mathml(const Letter& letter, int dots) {
    const std::string name = html(printed(letter.base));
    std::string stem = is_bold(letter.accent) ? "<mi class=\"bold\">" + name + "</mi>" : element_of("mi", name);
    stem = accented(dotted(stem, dots), letter.accent);
    if (!letter.index.empty() && !letter.raised.empty())
        return element_of("msubsup", stem + small_print(letter.index) + small_print(letter.raised));
    if (!letter.index.empty()) return element_of("msub", stem + small_print(letter.index));
    if (!letter.raised.empty()) return element_of("msup", stem + small_print(letter.raised));
    return stem;
}

/// Writes a tree; what lies in the wrong part is put into a row of the class "wrong".
class Writer {
public:
    explicit Writer(const WrongPart& wrong) : wrong_(wrong) {}

    std::string write(const Math& math) {
        if (is_marked_ || !is_wrong(math)) return plain(math);
        is_marked_ = true;
        const std::string content = plain(math);
        is_marked_ = false;
        return "<mrow class=\"wrong\">" + content + "</mrow>";
    }

private:
    bool is_inside(const Math& math) const {
        return math.length > 0 && math.offset >= wrong_.offset &&
               math.offset + math.length <= wrong_.offset + wrong_.length;
    }
    bool is_around(const Math& math) const {
        return math.offset <= wrong_.offset && math.offset + math.length >= wrong_.offset + wrong_.length;
    }

    /// Whether it lies in the wrong part, or is the smallest that has this in it.
    bool is_wrong(const Math& math) const {
        if (wrong_.length == 0) return false;
        if (is_inside(math)) return true;
        return is_around(math) && std::none_of(math.args.begin(), math.args.end(), [this](const MathPtr& arg) {
                   return is_inside(*arg) || is_around(*arg);
               });
    }

    std::string in_product(const Math& math) {
        const bool needs = math.kind == Kind::sum || math.kind == Kind::negate;
        return needs ? in_brackets(write(math)) : write(math);
    }

    std::string after_minus(const Math& math) { return in_product(math); }

    std::string list(const std::vector<MathPtr>& args, std::size_t from = 0) {
        std::string result;
        for (std::size_t k = from; k < args.size(); ++k)
            result += (k > from ? sign_of(",") : "") + write(*args[k]);
        return result;
    }

    std::string sum(const Math& math) {
        std::string result;
        for (const MathPtr& term : math.args) {
            const bool is_negative = term->kind == Kind::negate;
            if (!result.empty() && !is_negative) result += sign_of("+");
            // Its sign stands in the row of the sum, before which the line may be broken.
            result += is_negative && !is_wrong(*term) ? minus_sign + after_minus(*term->args[0]) : write(*term);
        }
        return row_of(result);
    }

    /// sin θ, or sin² θ.
    static bool has_function_first(const Math& math) {
        const Math& first = math.kind == Kind::power ? *math.args[0] : math;
        return first.kind == Kind::call && first.text != "sqrt" && first.text != "abs" && first.text != "exp";
    }

    std::string product(const Math& math) {
        std::string result;
        for (const MathPtr& factor : math.args) {
            const bool is_number = factor->kind == Kind::number, is_function = has_function_first(*factor);
            if (!result.empty()) result += is_number ? sign_of("&#x22C5;") : is_function ? thin_space : no_sign;
            result += in_product(*factor);
        }
        return row_of(result);
    }

    std::string power(const Math& math) {
        const Math &base = *math.args[0], &exponent = *math.args[1];
        const bool is_function = base.kind == Kind::call && base.args.size() == 1 && base.text != "sqrt" &&
                                 base.text != "abs" && base.text != "exp";
        if (is_function)
            return row_of(element_of("msup", element_of("mi", html(base.text)) + write(exponent)) + of_sign +
                          argument(*base.args[0]));
        const bool is_atom = base.kind == Kind::letter || base.kind == Kind::number || base.kind == Kind::vector ||
                             base.kind == Kind::matrix;
        return element_of("msup", (is_atom ? write(base) : in_brackets(write(base))) + write(exponent));
    }

    std::string argument(const Math& math) {
        const bool is_atom = math.kind == Kind::letter || math.kind == Kind::number;
        return is_atom ? thin_space + write(math) : in_brackets(write(math));
    }

    std::string call(const Math& math) {
        if (math.args.empty()) return element_of("mi", html(math.text));
        if (math.text == "sqrt") return element_of("msqrt", write(*math.args[0]));
        if (math.text == "abs") return in_brackets(write(*math.args[0]), "|", "|");
        if (math.text == "sum" && math.args.size() == 1) return row_of(sign_of("&#x2211;") + write(*math.args[0]));
        if (math.text == "exp") return element_of("msup", element_of("mi", "e") + row_of(write(*math.args[0])));
        static const std::map<std::string, std::string> names{
            {"asin", "arcsin"}, {"acos", "arccos"}, {"atan", "arctan"}, {"sign", "sgn"}};
        const auto found = names.find(math.text);
        const std::string name = element_of("mi", html(found == names.end() ? math.text : found->second));
        if (math.args.size() == 1) return row_of(name + of_sign + argument(*math.args[0]));
        return row_of(name + of_sign + in_brackets(list(math.args)));
    }

    /// d/dt or ∂/∂x of an argument: a letter stands above, anything longer beside.
    std::string derivative(const std::string& sign, const std::string& below, int order, const Math& of) {
        const std::string d =
            order < 2 ? sign : element_of("msup", sign + element_of("mn", std::to_string(order)));
        const bool is_atom = of.kind == Kind::letter;
        const std::string top = is_atom ? row_of(d + write(of)) : d;
        const std::string front = element_of("mfrac", top + row_of(below));
        return is_atom ? front : row_of(front + no_sign + bracketed_once(of));
    }

    std::string bracketed_once(const Math& of) {
        return of.kind == Kind::partial || of.kind == Kind::rate ? in_brackets(write(of)) : argument(of);
    }

    std::string partial(const Math& math) {
        std::string below;
        for (std::size_t k = 1; k < math.args.size(); ++k) below += partial_sign + write(*math.args[k]);
        return derivative(partial_sign, below, static_cast<int>(math.args.size()) - 1, *math.args[0]);
    }

    std::string rate(const Math& math) {
        const std::string d = element_of("mi", "d"), t = element_of("mi", "t");
        const std::string below =
            d + (math.dots < 2 ? t : element_of("msup", t + element_of("mn", std::to_string(math.dots))));
        return derivative(d, below, math.dots, *math.args[0]);
    }

    std::string table(const Math& math) {
        std::string rows;
        for (const MathPtr& one : math.args) {
            std::string cells;
            if (math.kind == Kind::matrix && one->kind == Kind::vector)
                for (const MathPtr& cell : one->args) cells += element_of("mtd", write(*cell));
            else
                cells = element_of("mtd", write(*one));
            rows += element_of("mtr", cells);
        }
        return in_brackets(element_of("mtable", rows));
    }

    std::string plain(const Math& math) {
        switch (math.kind) {
            case Kind::number:
                return element_of("mn", html(math.text));
            case Kind::letter:
                return letter_mathml(math.letter, math.dots);
            case Kind::call:
                return call(math);
            case Kind::applied:
                return row_of(letter_mathml(math.letter, math.dots) + of_sign + in_brackets(list(math.args)));
            case Kind::sum:
                return sum(math);
            case Kind::product:
                return product(math);
            case Kind::negate:
                return row_of(minus_sign + after_minus(*math.args[0]));
            case Kind::quotient:
                return element_of("mfrac", row_of(write(*math.args[0])) + row_of(write(*math.args[1])));
            case Kind::power:
                return power(math);
            case Kind::rate:
                return rate(math);
            case Kind::partial:
                return partial(math);
            case Kind::variation: {
                const bool is_letter = math.args[0]->kind == Kind::letter;
                return row_of(element_of("mi", "δ") +
                              (is_letter ? write(*math.args[0]) : in_brackets(write(*math.args[0]))));
            }
            case Kind::vector:
            case Kind::matrix:
                return table(math);
            case Kind::quantity:
                return row_of(write(*math.args[0]) + "<mspace width=\"0.2em\"></mspace>" +
                              element_of("mtext", html(math.text)));
        }
        return {};
    }

    WrongPart wrong_;
    bool is_marked_ = false;
};

}  // namespace

std::string written_mathml(const Math& math, const WrongPart& wrong) {
    return Writer(wrong).write(math);
}

std::string latex_math(const std::string& latex) {
    try {
        const Written written = read_derivation("\\[" + latex + "\\]", "formula.tex");
        if (written.statements.size() == 1 && !written.statements[0].sides.empty()) {
            std::string result;
            for (const MathPtr& side : written.statements[0].sides)
                result += (result.empty() ? "" : sign_of("=")) + written_mathml(*side);
            return "<math>" + row_of(result) + "</math>";
        }
    } catch (const SceneError&) {  // NOLINT(bugprone-empty-catch): the text is shown instead
    }
    return "<code>" + html(latex) + "</code>";
}

}  // namespace alembert
