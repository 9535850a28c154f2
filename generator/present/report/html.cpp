// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/html.hpp"

#include "algebra/notation/lettering.hpp"
#include "present/report/formula_page.hpp"
#include "present/report/letters.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

/// The children of a row of MathML, without an <mrow> around all of them.
std::vector<std::string> children(const std::string& mathml) {
    std::vector<std::string> parts;
    int depth = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < mathml.size(); ++i) {
        if (mathml[i] != '<') continue;
        const std::size_t end = mathml.find('>', i);
        if (mathml[i + 1] == '/')
            --depth;
        else if (mathml[end - 1] != '/')
            ++depth;
        i = end;
        if (depth != 0) continue;
        parts.push_back(mathml.substr(begin, end + 1 - begin));
        begin = end + 1;
    }
    constexpr std::string_view open = "<mrow>", close = "</mrow>";
    if (parts.size() == 1 && parts[0].starts_with(open) && parts[0].ends_with(close))
        return children(parts[0].substr(open.size(), parts[0].size() - open.size() - close.size()));
    return parts;
}

bool is_sign(const std::string& element) {
    return element == "<mo>+</mo>" || element == "<mo>&#x2212;</mo>";
}

bool is_relation(const std::string& element) {
    return element == "<mo>=</mo>" || element == "<mo>&#x2248;</mo>" || element == "<mo>&#x2261;</mo>" ||
           element == "<mo>&#x221D;</mo>";
}

}  // namespace

std::string html(const std::string& text) {
    std::string legal, result;
    for (std::size_t i = 0; i < text.size();) {
        const char32_t c = decode(text, i);
        legal += c == U'\n' || c == U'\t' || !is_disturbing(c) ? encode(c) : "\uFFFD";
    }
    for (const char c : xml_escaped(legal))
        if (c == '\'')
            result += "&#39;";
        else
            result += c;
    return result;
}

std::string html_letters(const std::string& expression) {
    return letters_of(expression, [](const std::string& index, bool) { return "<sub>" + index + "</sub>"; });
}

std::string script_json(const Json& json) {
    std::string result;
    for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace))
        if (c == '<')
            result += "\\u003c";
        else if (c == '>')
            result += "\\u003e";
        else if (c == '&')
            result += "\\u0026";
        else
            result += c;
    return result;
}

std::string inline_math(const Phrase& phrase) {
    return "<math>" + notation_of("mathml").phrase(phrase) + "</math>";
}

std::string breakable(const std::vector<std::string>& rows) {
    std::string result = "<div class=\"equation\"><math class=\"lines\" displaystyle=\"true\"><mrow>";
    bool after_sign = true;
    for (const std::string& row : rows)
        for (const std::string& part : is_relation(row) ? std::vector{row} : children(row)) {
            const bool relates = is_relation(part);
            if ((is_sign(part) || relates) && !after_sign)
                result += "</mrow> <mrow>" + part.substr(0, 3) + " form=\"infix\" lspace=\"0\"" + part.substr(3);
            else if (is_sign(part))  // of the first term behind a relation
                result += part.substr(0, 3) + " form=\"prefix\"" + part.substr(3);
            else
                result += part;
            after_sign = relates;
        }
    return result + "</mrow></math></div>\n";
}

std::string equation(const std::string& left, const std::string& right) {
    return breakable({left, "<mo>=</mo>", right});
}

}  // namespace alembert
