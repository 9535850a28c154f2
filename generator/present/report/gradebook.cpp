// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/gradebook.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/language/say.hpp"
#include "present/report/marked.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

/// A field of a CSV file (RFC 4180). A file's name that begins like a formula of a spreadsheet is no formula.
std::string csv_field(std::string text) {
    if (!text.empty() && std::string_view("=+-@").find(text[0]) != std::string_view::npos) text.insert(0, "'");
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

std::vector<std::pair<std::string, std::size_t>> Gradebook::slips() const {
    std::map<std::string, std::size_t> counts;
    for (const GradedRow& row : rows)
        for (const std::string& kind : std::set<std::string>(row.kinds.begin(), row.kinds.end())) ++counts[kind];
    std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    return sorted;
}

GradedRow graded(const Marked& marked) {
    GradedRow row;
    row.file = marked.written.file;
    if (marked.first_mistake) {
        row.first_mistake = marked.lines[*marked.first_mistake].line;
        row.kind = kind_of_slip(marked.lines[*marked.first_mistake]);
    }
    row.right = count_right(marked);
    row.mistakes = count_of(marked, LineStatus::mistake);
    row.follows = count_of(marked, LineStatus::follows);
    row.open = count_of(marked, LineStatus::undecided) + count_of(marked, LineStatus::not_understood);
    row.missing = marked.missing;
    for (const MarkedLine& line : marked.lines)
        if (line.status == LineStatus::mistake) row.kinds.push_back(kind_of_slip(line));
    return row;
}

Json to_json(const GradedRow& row) {
    return {{"file", row.file},         {"first_mistake", or_null(row.first_mistake)},
            {"kind", row.kind},         {"right", row.right},
            {"mistakes", row.mistakes}, {"follows", row.follows},
            {"open", row.open},         {"missing", row.missing},
            {"kinds", row.kinds},       {"problem", row.problem},
            {"page", row.page}};
}

GradedRow row_from(const Json& json) {
    GradedRow row;
    row.file = json.at("file").get<std::string>();
    if (!json.at("first_mistake").is_null()) row.first_mistake = json.at("first_mistake").get<int>();
    row.kind = json.at("kind").get<std::string>();
    row.right = json.at("right").get<std::size_t>();
    row.mistakes = json.at("mistakes").get<std::size_t>();
    row.follows = json.at("follows").get<std::size_t>();
    row.open = json.at("open").get<std::size_t>();
    row.missing = json.at("missing").get<std::vector<std::string>>();
    row.kinds = json.at("kinds").get<std::vector<std::string>>();
    row.problem = json.at("problem").get<std::string>();
    row.page = json.at("page").get<std::string>();
    return row;
}

std::string as_csv(const Gradebook& book) {
    std::string text = "file,first_mistake,kind,right,mistakes,follows,missing,not_judged,problem\n";
    for (const GradedRow& row : book.rows)
        put(text, "{},{},{},{},{},{},{},{},{}\n", csv_field(row.file),
            row.first_mistake ? std::to_string(*row.first_mistake) : "", row.kind, row.right, row.mistakes,
            row.follows, csv_field(fmt::format("{}", fmt::join(row.missing, " "))), row.open,
            csv_field(one_line(row.problem)));
    return text;
}

Json as_json(const Gradebook& book) {
    Json json;
    json["derivations"] = Json::array();
    for (const GradedRow& row : book.rows) {
        Json one = to_json(row);
        one.erase("page");
        if (row.problem.empty()) one.erase("problem");
        json["derivations"].push_back(std::move(one));
    }
    json["slips"] = Json::object();
    for (const auto& [kind, count] : book.slips()) json["slips"][kind] = count;
    return json;
}

std::string as_text(const Gradebook& book, const Ink& ink) {
    std::vector<std::string> names;
    for (const GradedRow& row : book.rows) names.push_back(row.file);
    const std::size_t column = column_for(names, 6);
    std::string page;
    for (const GradedRow& row : book.rows) {
        put(page, "{:<{}} ", row.file, column);
        if (!row.problem.empty())
            put(page, "{}{}{}\n", ink.unsure, say("cannot be read: {}", one_line(row.problem)), ink.end);
        else if (row.first_mistake)
            put(page, "{}{}{}\n", ink.bad,
                say("first mistake in line {} ({}); right {}, mistakes {}, following {}", *row.first_mistake,
                    row.kind, row.right, row.mistakes, row.follows),
                ink.end);
        else
            put(page, "{}{}{}\n", row.open > 0 ? ink.unsure : ink.good,
                row.open > 0 ? say("no mistake found; right {}, not judged {}", row.right, row.open)
                             : say("no mistake; right {}", row.right),
                ink.end);
    }
    if (!book.slips().empty()) page += "\n" + say("Slips, and in how many derivations:") + "\n";
    for (const auto& [kind, count] : book.slips()) put(page, "{:<16} {}\n", kind, count);
    return page;
}

}  // namespace alembert
