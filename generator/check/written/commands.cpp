// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/commands.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "base/language/greek.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

using CommandTable = std::map<std::string_view, WrittenCommand>;
using CommandEffect = WrittenCommand::Effect;
using TokenKind = WrittenToken::Kind;

/// Names separated by blanks.
void list_commands(CommandTable& table, std::string_view names, CommandEffect effect,
                   TokenKind kind = TokenKind::stray, std::string_view text = {}) {
    while (!names.empty()) {
        const std::size_t end = std::min(names.find(' '), names.size());
        const std::string_view name = names.substr(0, end);
        if (!name.empty()) table[name] = {name, effect, kind, text.empty() ? name : text};
        names.remove_prefix(std::min(end + 1, names.size()));
    }
}

void list_tokens(CommandTable& table, TokenKind kind, std::string_view names, std::string_view text = {}) {
    list_commands(table, names, CommandEffect::token, kind, text);
}

void list_letters(CommandTable& table) {
    list_tokens(
        table, TokenKind::letter,
        "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma tau "
        "upsilon phi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega varphi "
        "vartheta varepsilon varrho varsigma varkappa varpi digamma ell hbar imath jmath infty nabla aleph "
        "wp Re Im emptyset varnothing top bot dagger ddagger degree");
    list_tokens(table, TokenKind::letter, "intercal", "top");
    list_tokens(table, TokenKind::letter, "varOmega upOmega", "Omega");
    list_tokens(table, TokenKind::letter, "uptheta", "theta");
    list_tokens(table, TokenKind::letter, "upmu", "mu");
    list_tokens(table, TokenKind::letter, "circ", "degree");
}

void list_structure(CommandTable& table) {
    list_tokens(
        table, TokenKind::command,
        "sqrt dot ddot dddot ddddot vec hat bar tilde mathbf mathcal mathbb mathfrak mathscr underline "
        "underbrace overbrace overset underset stackrel sum prod int oint iint over atop "
        "dd dv pdv SI num qty norm abs lim det max min sup inf binom boxed textcolor colorbox mathcolor cancelto "
        "operatornamewithlimits mathop mathrel mathbin mathord bra ket");
    list_tokens(table, TokenKind::command, "frac dfrac tfrac cfrac sfrac nicefrac flatfrac", "frac");
    list_tokens(table, TokenKind::command, "odv derivative diff", "dv");
    list_tokens(table, TokenKind::command, "pderivative partialderivative pd", "pdv");
    list_tokens(table, TokenKind::command, "widehat vu", "hat");
    list_tokens(table, TokenKind::command, "odif odd", "dd");
    list_tokens(table, TokenKind::letter, "fdif variation var", "delta");
    list_tokens(table, TokenKind::command, "widetilde", "tilde");
    list_tokens(table, TokenKind::command, "overline", "bar");
    list_tokens(table, TokenKind::command, "overrightarrow overrightharpoon vectorarrow vv va vva", "vec");
    list_tokens(table, TokenKind::command, "boldsymbol bm pmb bf bold vb mathbfit symbf vectorbold", "mathbf");
    list_tokens(table, TokenKind::command, "cal", "mathcal");
    list_tokens(table, TokenKind::command, "SIrange si unit", "unit");
}

void list_signs(CommandTable& table) {
    list_tokens(table, TokenKind::times, "cdot cdotp bullet ast star", "cdot");
    list_tokens(table, TokenKind::times, "times wedge cross", "times");
    list_tokens(table, TokenKind::divide, "div slash", "/");
    list_tokens(table, TokenKind::partial, "partial");
    list_tokens(table, TokenKind::primes, "prime", "'");
    list_tokens(table, TokenKind::relation, "eq", "=");
    list_tokens(table, TokenKind::relation, "approx simeq sim doteq cong approxeq thickapprox", "~");
    list_tokens(table, TokenKind::relation,
                "equiv triangleq coloneqq coloneq vcentcolon eqdef defeq eqqcolon eqcolon Coloneqq", ":");
    list_tokens(table, TokenKind::relation,
                "propto le leq leqslant ge geq geqslant ll gg lt gt ne neq in notin subset lesssim gtrsim perp "
                "parallel mapsto not asymp succ succeq prec preceq subseteq supset",
                "<");
    list_tokens(table, TokenKind::arrow,
                "implies Rightarrow Longrightarrow iff Leftrightarrow Longleftrightarrow therefore because to "
                "rightarrow longrightarrow leadsto rightsquigarrow impliedby Leftarrow land hookrightarrow "
                "xrightarrow xRightarrow longmapsto curvearrowright");
    list_tokens(table, TokenKind::dots, "dots ldots cdots vdots ddots dotsc dotsb");
    list_tokens(table, TokenKind::space, "quad qquad enspace hfill enskip hfil eqno leqno");
    list_tokens(table, TokenKind::bar, "vert lvert rvert mid", "|");
    list_tokens(table, TokenKind::bar, "Vert lVert rVert", "||");
    list_tokens(table, TokenKind::open, "langle", "<");
    list_tokens(table, TokenKind::close, "rangle", ">");
    list_tokens(table, TokenKind::open, "lbrace", "{");
    list_tokens(table, TokenKind::close, "rbrace", "}");
    list_tokens(table, TokenKind::open, "lbrack", "[");
    list_tokens(table, TokenKind::close, "rbrack", "]");
    list_tokens(table, TokenKind::open, "lparen", "(");
    list_tokens(table, TokenKind::open, "llbracket lfloor lceil", "[");
    list_tokens(table, TokenKind::close, "rrbracket rfloor rceil", "]");
    list_tokens(table, TokenKind::close, "rparen", ")");
    list_tokens(table, TokenKind::stray, "pm mp");
    list_tokens(table, TokenKind::text, "forall", "for all");
    list_tokens(table, TokenKind::semicolon, "colon");
    list_tokens(table, TokenKind::row, "newline tabularnewline", "");
}

void list_dropped(CommandTable& table) {
    list_commands(
        table,
        "displaystyle textstyle scriptstyle scriptscriptstyle limits nolimits nonumber notag strut mathstrut "
        "allowbreak noindent hline centering big Big bigg Bigg bigl Bigl biggl Biggl bigr Bigr biggr Biggr "
        "bigm Bigm biggm Biggm rm it sf tt normalfont small large Large footnotesize cancel bcancel xcancel "
        "qed Box square blacksquare pqty bqty Bqty pab bab mathit mathnormal mathsf symit ensuremath smash "
        "mathinner thinspace medspace "
        "thickspace negthinspace negmedspace negthickspace space nobreakspace qedhere qed par "
        "nobreak protect mathsfit upright relax normalsize Aboxed",
        CommandEffect::nothing);
    list_commands(table,
                  "label tag hspace vspace phantom hphantom vphantom color ref eqref cite footnote mspace kern "
                  "mkern hskip vskip footnotemark pagebreak setlength nopagebreak displaybreak rule",
                  CommandEffect::dropped, TokenKind::stray, "1");
    list_commands(table,
                  "text mbox textrm textbf textit textsf texttt textnormal hbox intertext shortintertext "
                  "emph mathtext textup textsl",
                  CommandEffect::words);
    list_commands(table, "mathrm operatorname mathup symrm mathtt", CommandEffect::upright);
    list_commands(table, "left right middle", CommandEffect::delimiter);
    list_commands(table, "newcommand renewcommand providecommand DeclareMathOperator", CommandEffect::definition);
    list_commands(
        table,
        "def gdef edef xdef let futurelet input include write openin openout read immediate csname endcsname "
        "catcode special loop repeat expandafter directlua luaexec usepackage includegraphics "
        "newenvironment renewenvironment begingroup endgroup InputIfFileExists shellescape verbatiminput "
        "lstinputlisting import subimport noexpand aftergroup everymath global newread newwrite typein "
        "ifx if else fi ExplSyntaxOn NewDocumentCommand RenewDocumentCommand DeclareDocumentCommand "
        "newcount advance toks loop detokenize scantokens batchmode errmessage show message jobname",
        CommandEffect::refused);
}

CommandTable all_commands() {
    CommandTable table;
    list_letters(table);
    list_structure(table);
    list_signs(table);
    list_dropped(table);
    return table;
}

struct NamedFunction {
    std::string_view name, meaning;
};

constexpr std::array<NamedFunction, 49> named_functions{{
    {"sen", "sin"},     {"cotg", "cot"},    {"arcsen", "asin"}, {"arctg", "atan"},    {"senh", "sinh"},
    {"sin", "sin"},     {"cos", "cos"},     {"tan", "tan"},     {"cot", "cot"},       {"sec", "sec"},
    {"csc", "csc"},     {"asin", "asin"},   {"acos", "acos"},   {"atan", "atan"},     {"atan2", "atan2"},
    {"sinh", "sinh"},   {"cosh", "cosh"},   {"tanh", "tanh"},   {"sqrt", "sqrt"},     {"exp", "exp"},
    {"ln", "ln"},       {"log", "ln"},      {"abs", "abs"},     {"sign", "sign"},     {"sgn", "sign"},
    {"arcsin", "asin"}, {"arccos", "acos"}, {"arctan", "atan"}, {"arctan2", "atan2"}, {"tg", "tan"},
    {"ctg", "cot"},     {"cosec", "csc"},   {"sh", "sinh"},     {"ch", "cosh"},       {"Sin", "sin"},
    {"Cos", "cos"},     {"Tan", "tan"},     {"Cot", "cot"},     {"Sqrt", "sqrt"},     {"Exp", "exp"},
    {"Log", "ln"},      {"Abs", "abs"},     {"Sign", "sign"},   {"ArcSin", "asin"},   {"ArcCos", "acos"},
    {"ArcTan", "atan"}, {"Sinh", "sinh"},   {"Cosh", "cosh"},   {"Tanh", "tanh"},
}};

struct SpelledSign {
    char32_t sign;
    std::string_view latex;
};

constexpr std::array spelled_signs = std::to_array<SpelledSign>({
    {U'·', "\\cdot "},
    {U'⋅', "\\cdot "},
    {U'∙', "\\cdot "},
    {U'•', "\\cdot "},
    {U'∗', "\\cdot "},
    {U'×', "\\times "},
    {U'⨯', "\\times "},
    {U'÷', "/"},
    {U'∕', "/"},
    {U'⁄', "/"},
    {U'−', "-"},
    {U'–', "-"},
    {U'﹣', "-"},
    {U'－', "-"},
    {U'＋', "+"},
    {U'＝', "="},
    {U'（', "("},
    {U'）', ")"},
    {U'，', ","},
    {U'；', ";"},
    {U'。', "."},
    {U'［', "["},
    {U'］', "]"},
    {U'′', "'"},
    {U'″', "''"},
    {U'‴', "'''"},
    {U'’', "'"},
    {U'ʹ', "'"},
    {U'∂', "\\partial "},
    {U'√', "\\sqrt "},
    {U'∑', "\\sum "},
    {U'Σ', "\\sum "},
    {U'∫', "\\int "},
    {U'≈', "\\approx "},
    {U'≃', "\\approx "},
    {U'≅', "\\approx "},
    {U'∼', "\\sim "},
    {U'≡', "\\equiv "},
    {U'≔', "\\equiv "},
    {U'≜', "\\equiv "},
    {U'≐', "\\approx "},
    {U'∝', "\\propto "},
    {U'≤', "\\le "},
    {U'≥', "\\ge "},
    {U'≪', "\\ll "},
    {U'≫', "\\gg "},
    {U'≠', "\\ne "},
    {U'⇒', "\\implies "},
    {U'⟹', "\\implies "},
    {U'→', "\\to "},
    {U'⟶', "\\to "},
    {U'∴', "\\therefore "},
    {U'⇔', "\\iff "},
    {U'⟺', "\\iff "},
    {U'∞', "\\infty "},
    {U'°', "^\\degree "},
    {U'º', "^\\degree "},
    {U'ℓ', "\\ell "},
    {U'ℒ', "\\mathcal{L}"},
    {U'ℋ', "\\mathcal{H}"},
    {U'∆', "\\Delta "},
    {U'⟨', "\\langle "},
    {U'⟩', "\\rangle "},
    {U'〈', "\\langle "},
    {U'〉', "\\rangle "},
    {U'‖', "\\Vert "},
    {U'∣', "|"},
    {U'½', "\\frac{1}{2}"},
    {U'¼', "\\frac{1}{4}"},
    {U'¾', "\\frac{3}{4}"},
    {U'⅓', "\\frac{1}{3}"},
    {U'⅔', "\\frac{2}{3}"},
    {U'⅕', "\\frac{1}{5}"},
    {U'⅖', "\\frac{2}{5}"},
    {U'⅗', "\\frac{3}{5}"},
    {U'⅘', "\\frac{4}{5}"},
    {U'⅙', "\\frac{1}{6}"},
    {U'⅚', "\\frac{5}{6}"},
    {U'⅛', "\\frac{1}{8}"},
    {U'⅜', "\\frac{3}{8}"},
    {U'⅝', "\\frac{5}{8}"},
    {U'⅞', "\\frac{7}{8}"},
    {U'⅐', "\\frac{1}{7}"},
    {U'⅑', "\\frac{1}{9}"},
    {U'⅒', "\\frac{1}{10}"},
    {U'±', "\\pm "},
    {U'∓', "\\mp "},
    {U'…', "\\dots "},
    {U'⋯', "\\dots "},
    {U'∈', "\\in "},
    {U'∇', "\\nabla "},
    {U'ℏ', "\\hbar "},
    {U'ẋ', "\\dot{x}"},
    {U'ẍ', "\\ddot{x}"},
    {U'ẏ', "\\dot{y}"},
    {U'ÿ', "\\ddot{y}"},
    {U'ż', "\\dot{z}"},
    {U'ṙ', "\\dot{r}"},
    {U'ṡ', "\\dot{s}"},
    {U'ṗ', "\\dot{p}"},
    {U'ṁ', "\\dot{m}"},
    {U'ẇ', "\\dot{w}"},
    {U'ẅ', "\\ddot{w}"},
    {U'ü', "\\ddot{u}"},
    {U'ä', "\\ddot{a}"},
    {U'ö', "\\ddot{o}"},
    {U'ë', "\\ddot{e}"},
    {U'ẗ', "\\ddot{t}"},
    {U'ṫ', "\\dot{t}"},
    {U'ȧ', "\\dot{a}"},
    {U'ḃ', "\\dot{b}"},
    {U'ċ', "\\dot{c}"},
    {U'ḋ', "\\dot{d}"},
    {U'ė', "\\dot{e}"},
    {U'ḟ', "\\dot{f}"},
    {U'ġ', "\\dot{g}"},
    {U'ḣ', "\\dot{h}"},
    {U'ḧ', "\\ddot{h}"},
    {U'ṅ', "\\dot{n}"},
    {U'ȯ', "\\dot{o}"},
    {U'ṽ', "\\tilde{v}"},
    {U'Ẋ', "\\dot{X}"},
    {U'Ẍ', "\\ddot{X}"},
    {U'Ẏ', "\\dot{Y}"},
    {U'Ÿ', "\\ddot{Y}"},
    {U'Ż', "\\dot{Z}"},
    {U'Ṙ', "\\dot{R}"},
    {U'Ḣ', "\\dot{H}"},
    {U'Ė', "\\dot{E}"},
    {U'Ṫ', "\\dot{T}"},
    {U'Ṗ', "\\dot{P}"},
    {U'Ẇ', "\\dot{W}"},
    {U'ⅆ', "\\mathrm{d}"},
    {U'ⅇ', "\\mathrm{e}"},
    {U'⊤', "\\top "},
    {U'ᵀ', "^{T}"},
    {U'↦', "\\mapsto "},
    {U'ϕ', "\\phi "},
    {U'ϑ', "\\vartheta "},
    {U'ϵ', "\\epsilon "},
    {U'ϱ', "\\varrho "},
    {U'µ', "\\mu "},
});

/// Letters of U+1D400 and after: alphabets of 26 capital and 26 small Latin letters, then of Greek ones.
std::string mathematical_letter(char32_t c) {
    static constexpr std::string_view greek_order =
        "Alpha Beta Gamma Delta Epsilon Zeta Eta Theta Iota Kappa Lambda Mu Nu Xi Omicron Pi Rho Theta Sigma Tau "
        "Upsilon Phi Chi Psi Omega nabla alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi "
        "omicron pi rho varsigma sigma tau upsilon phi chi psi omega partial epsilon vartheta kappa phi varrho "
        "varpi ";
    if (c == U'ℎ') return "h";
    if (c < 0x1D400 || c > 0x1D7FF) return {};
    if (c >= 0x1D7CE) return std::string(1, static_cast<char>('0' + (c - 0x1D7CE) % 10));
    if (c < 0x1D6A8) {
        const char32_t at = (c - 0x1D400) % 52, alphabet = (c - 0x1D400) / 52;
        const std::string letter(1, static_cast<char>(at < 26 ? 'A' + at : 'a' + at - 26));
        if (alphabet == 0 || alphabet == 2) return "\\mathbf{" + letter + "}";
        return alphabet == 3 || alphabet == 4 ? "\\mathcal{" + letter + "}" : letter;
    }
    char32_t at = (c - 0x1D6A8) % 58;
    std::string_view rest = greek_order;
    for (; at > 0; --at) rest.remove_prefix(rest.find(' ') + 1);
    return "\\" + std::string(rest.substr(0, rest.find(' '))) + " ";
}

}  // namespace

const WrittenCommand* command_named(std::string_view name) {
    static const CommandTable table = all_commands();
    const auto found = table.find(name);
    return found == table.end() ? nullptr : &found->second;
}

std::string_view function_named(std::string_view name) {
    for (const NamedFunction& function : named_functions)
        if (function.name == name) return function.meaning;
    return {};
}

std::string spelled(char32_t c) {
    if (c < 0x80) return {};
    static const std::map<char32_t, std::string_view> table = [] {
        std::map<char32_t, std::string_view> map;
        for (const SpelledSign& entry : spelled_signs) map[entry.sign] = entry.latex;
        return map;
    }();
    if (const auto found = table.find(c); found != table.end()) return std::string(found->second);
    if (std::string letter = mathematical_letter(c); !letter.empty()) return letter;
    if (const GreekLetter* const greek = greek_of(encode(c)))
        return greek->latex.starts_with("\\mathrm") ? std::string(greek->latex)
                                                    : "\\" + std::string(greek->name) + " ";
    return {};
}

char raised_sign(char32_t c) {
    static constexpr std::u32string_view raised = U"⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ⁿ";
    const std::size_t at = raised.find(c);
    return at == std::u32string_view::npos ? '\0' : "0123456789+-n"[at];
}

char lowered_sign(char32_t c) {
    static constexpr std::u32string_view lowered = U"₀₁₂₃₄₅₆₇₈₉ₐₑₒₓₕₖₗₘₙₚₛₜᵢⱼᵣᵤᵥ";
    const std::size_t at = lowered.find(c);
    return at == std::u32string_view::npos ? '\0' : "0123456789aeoxhklmnpstijruv"[at];
}

std::string_view combining_mark(char32_t c) {
    switch (c) {
        case 0x0307:
            return "dot";
        case 0x0308:
            return "ddot";
        case 0x20DB:
            return "dddot";
        case 0x20DC:
            return "ddddot";
        case 0x0302:
            return "hat";
        case 0x0303:
            return "tilde";
        case 0x0304:
        case 0x0305:
            return "bar";
        case 0x20D7:
        case 0x20D1:
            return "vec";
        default:
            return {};
    }
}

}  // namespace alembert
