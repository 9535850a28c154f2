// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/marked.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "present/report/check.hpp"
#include "present/report/page.hpp"
#include "present/report/state_text.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr int narrowest_source = 24;

int width_of(const std::string& text) {
    int columns = 0;
    for (std::size_t i = 0; i < text.size();) {
        const char32_t c = decode(text, i);
        columns += c == invalid_character ? 1 : width(c);
    }
    return columns;
}

std::string padded(const std::string& text, int columns) {
    return text + std::string(static_cast<std::size_t>(std::max(0, columns - width_of(text))), ' ');
}

/// The beginning that fits, and "…".
std::string shortened(const std::string& text, int columns) {
    if (columns <= 0 || width_of(text) <= columns) return text;
    std::size_t end = 0;
    int used = 1;
    for (std::size_t i = 0; i < text.size();) {
        const char32_t c = decode(text, i);
        used += c == invalid_character ? 1 : width(c);
        if (used > columns) break;
        end = i;
    }
    return text.substr(0, end) + "…";
}

Json json_of_likely(const MarkedLine& line) {
    if (line.status != LineStatus::mistake && line.status != LineStatus::follows) return nullptr;
    const Slip slip = line.checked.likely.value_or(Slip{});
    Json json{{"kind", slip.kind}, {"term", slip.term}};
    for (const auto& [name, value] : {std::pair("repair", slip.repair), std::pair("should_be", slip.should_be),
                                      std::pair("written", slip.written), std::pair("meant", slip.meant)})
        if (!value.empty()) json[name] = value;
    return json;
}

Json json_of(const MarkedLine& line) {
    const CheckedClaim& c = line.checked;
    Json json;
    json["line"] = line.line;
    json["column"] = line.column;
    json["source"] = line.source;
    json["claim"] = line.claim;
    json["status"] = name_of(line.status);
    json["verdict"] = line.claim.empty() ? Json(nullptr) : Json(name_of(c.verdict));
    json["method"] = line.claim.empty() ? Json(nullptr) : Json(c.normal_form ? "proved" : "sampled");
    json["term"] = line.term;
    json["likely"] = json_of_likely(line);
    json["right"] = line.right;
    if (!line.right_latex.empty()) json["right_latex"] = line.right_latex;
    json["follows_from"] = or_null(line.follows_from);
    json["reason"] = line.reason;
    json["counterexample"] = Json::object();
    for (const auto& [name, value] : c.counterexample) json["counterexample"][name] = value;
    if (!c.residual.empty()) json["residual"] = c.residual_value;
    if (!c.difference.empty()) json["difference"] = c.difference;
    return json;
}

const std::string& ink_of(LineStatus status, const Ink& ink) {
    switch (status) {
        case LineStatus::mistake:
            return ink.bad;
        case LineStatus::follows:
        case LineStatus::unfounded:
        case LineStatus::undecided:
        case LineStatus::not_understood:
        case LineStatus::not_about_scene:
            return ink.unsure;
        default:
            return ink.good;
    }
}

/// What is wrong with a line, each fact in a line of its own.
std::string details_of(const MarkedLine& line, const std::string& indent) {
    const CheckedClaim& c = line.checked;
    std::string page;
    const auto add = [&](const std::string& label, const std::string& text) {
        if (!text.empty()) page += indent + label + text + "\n";
    };
    if (line.status != LineStatus::follows) add("", line.reason);
    if (line.status != LineStatus::mistake) return page;
    if (c.likely)
        add(say("probable slip: "), words_of(*c.likely));
    else
        add(say("wrong term: "), line.term);
    add(say("correct line: "), line.right);
    add(say("it fails at "), text_of_state(c.counterexample, line.claim));
    if (!c.counterexample.empty()) add("", say("where {}", as_written(say("left - right"), c.residual)));
    return page;
}

std::string letters_line(const Marked& marked) {
    std::string letters;
    for (const auto& [written, name] : marked.letters)
        if (written != name) letters += (letters.empty() ? "" : ", ") + written + " = " + name;
    return letters;
}

}  // namespace

std::string one_line(const std::string& source) {
    std::string result;
    for (std::size_t i = 0; i < source.size(); ++i) {
        const char c = source[i];
        if (c == '&' && (i == 0 || source[i - 1] != '\\')) continue;  // of LaTeX's columns
        const bool is_blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
        if (!is_blank) result += c;
        if (is_blank && !result.empty() && result.back() != ' ') result += ' ';
    }
    while (!result.empty() && result.back() == ' ') result.pop_back();
    return result;
}

std::string kind_of_slip(const MarkedLine& line) {
    return line.checked.likely ? line.checked.likely->kind : "unknown";
}

std::size_t count_of(const Marked& marked, LineStatus status) {
    return static_cast<std::size_t>(std::count_if(marked.lines.begin(), marked.lines.end(),
                                                  [&](const MarkedLine& line) { return line.status == status; }));
}

std::size_t count_right(const Marked& marked) {
    return static_cast<std::size_t>(std::count_if(marked.lines.begin(), marked.lines.end(),
                                                  [](const MarkedLine& line) { return is_right(line.status); }));
}

std::string words_of_status(const Marked& marked, const MarkedLine& line) {
    switch (line.status) {
        case LineStatus::right:
            return say("right{}", "");  // in the catalogue, the word alone is a direction
        case LineStatus::right_near:
            return say("right to first order");
        case LineStatus::right_up_to_constant:
            return say("right up to a constant");
        case LineStatus::right_up_to_derivative:
            return say("right up to d/dt");
        case LineStatus::definition:
            return say("definition");
        case LineStatus::mistake:
            return say("mistake");
        case LineStatus::follows:
            return line.follows_from ? say("follows from line {}", marked.lines[*line.follows_from].line)
                                     : say("follows");
        case LineStatus::unfounded:
            return say("true, but does not follow");
        case LineStatus::undecided:
            return say("undecided");
        case LineStatus::not_understood:
            return say("not understood");
        case LineStatus::not_about_scene:
            return say("not about the scene");
    }
    return {};
}

std::size_t count_judged(const Marked& marked) {
    return marked.lines.size() - count_of(marked, LineStatus::undecided) -
           count_of(marked, LineStatus::not_understood) - count_of(marked, LineStatus::not_about_scene);
}

std::string summary_of(const Marked& marked) {
    const std::size_t right = count_right(marked), wrong = count_of(marked, LineStatus::mistake),
                      follow = count_of(marked, LineStatus::follows);
    std::string text;
    if (marked.first_mistake) {
        const MarkedLine& first = marked.lines[*marked.first_mistake];
        text = first.checked.likely
                   ? say("First mistake: line {}, {}.", first.line, words_of(*first.checked.likely))
                   : say("First mistake: line {}.", first.line);
    } else {
        text = count_judged(marked) == 0 ? say("Nothing of this could be judged.") : say("No mistake was found.");
    }
    text += say(" Right: {}, mistakes: {}, following from them: {}.", right, wrong, follow);
    const std::size_t open =
        count_of(marked, LineStatus::undecided) + count_of(marked, LineStatus::not_understood);
    if (open > 0) text += say(" Not judged: {}.", open);
    return say("{} of {} lines were judged.", count_judged(marked), marked.lines.size()) + " " + text;
}

std::string words_of_missing(const Marked& marked) {
    if (marked.missing.empty()) return marked.complete ? say("No equation of motion is missing.") : std::string();
    std::string names;
    for (const std::string& name : marked.missing) names += (names.empty() ? "" : ", ") + name;
    return marked.missing.size() == 1 ? say("No right line gives the equation of motion of {}.", names)
                                      : say("No right lines give the equations of motion of {}.", names);
}

Json as_json(const Marked& marked) {
    Json json;
    json["file"] = marked.written.file;
    json["lines"] = Json::array();
    for (const MarkedLine& line : marked.lines) json["lines"].push_back(json_of(line));
    json["first_mistake"] = or_null(marked.first_mistake);
    json["judged"] = count_judged(marked);
    json["missing"] = marked.missing;
    json["complete"] = marked.complete;
    json["letters"] = Json::object();
    for (const auto& [written, name] : marked.letters) json["letters"][written] = name;
    json["remarks"] = marked.remarks;
    return json;
}

std::string as_text(const Marked& marked, const Ink& ink, int width) {
    int number = 1, word = 0;
    for (const MarkedLine& line : marked.lines) {
        number = std::max(number, static_cast<int>(std::to_string(line.line).size()));
        word = std::max(word, width_of(words_of_status(marked, line)));
    }
    const int before = number + 2 + word + 2;
    const int columns = width > 0 ? std::max(narrowest_source, width - before) : 0;
    const std::string indent(static_cast<std::size_t>(before), ' ');
    std::string page;
    for (const MarkedLine& line : marked.lines) {
        put(page, "{:>{}}  {}{}{}  {}\n", line.line, number, ink_of(line.status, ink),
            padded(words_of_status(marked, line), word), ink.end, shortened(one_line(line.source), columns));
        page += details_of(line, indent);
    }
    if (!page.empty()) page += "\n";
    page += summary_of(marked) + "\n";
    if (const std::string missing = words_of_missing(marked); !missing.empty()) page += missing + "\n";
    if (const std::string letters = letters_line(marked); !letters.empty())
        page += say("Letters: {}.", letters) + "\n";
    for (const std::string& remark : marked.remarks) page += remark + "\n";
    return page;
}

}  // namespace alembert
