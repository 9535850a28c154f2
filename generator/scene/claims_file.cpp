// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/claims_file.hpp"

#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "base/language/say.hpp"
#include "scene/check.hpp"
#include "scene/claim_mode.hpp"
#include "scene/known_names.hpp"
#include "scene/source.hpp"
#include "scene/text_file.hpp"
#include "scene/typed.hpp"
#include "scene/typed_words.hpp"

namespace alembert {

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

struct Word {
    std::string text;
    std::size_t offset = 0;
};

std::vector<Word> words_of(const std::string& line) {
    std::vector<Word> words;
    for (std::size_t at = 0; at < line.size();) {
        while (at < line.size() && (is_blank(line[at]) || line[at] == ',')) ++at;
        const std::size_t begin = at;
        while (at < line.size() && !is_blank(line[at]) && line[at] != ',') ++at;
        if (at > begin) words.push_back({line.substr(begin, at - begin), begin});
    }
    return words;
}

std::string joined(const std::vector<Word>& words) {
    std::string text;
    for (const Word& word : words) text += (text.empty() ? "" : " ") + word.text;
    return text;
}

/// Of "near theta = 0, phi = pi/2", from the first name on.
std::vector<std::pair<Name, Expression>> values_after(const std::string& line, std::size_t offset,
                                                      const std::vector<Place>& places_of_line,
                                                      std::vector<Diagnostic>& mistakes, const KnownNames& names) {
    std::vector<std::pair<Name, Expression>> result;
    for (std::size_t from = offset; from < line.size();) {
        std::size_t end = from;  // of this value: a comma outside parentheses
        for (int depth = 0; end < line.size() && (line[end] != ',' || depth > 0); ++end)
            depth += line[end] == '(' ? 1 : line[end] == ')' ? -1 : 0;
        const std::vector<Place> places(places_of_line.begin() + static_cast<std::ptrdiff_t>(from),
                                        places_of_line.begin() + static_cast<std::ptrdiff_t>(end) + 1);
        const Equality value = parse_equality(line.substr(from, end - from), places, mistakes, false, &names);
        std::string name = value.lhs.text;
        while (!name.empty() && is_blank(name.back())) name.pop_back();
        result.emplace_back(Name{std::move(name), places.front()}, value.rhs);
        for (from = end + 1; from < line.size() && is_blank(line[from]);) ++from;
    }
    return result;
}

}  // namespace

Scene with_claims(Scene scene, const std::string& file) {
    return with_claims(std::move(scene), text_of_file(file), file);
}

Scene with_claims(Scene scene, std::string text, std::string file) {
    Scene result = std::move(scene);
    if (result.own_text.empty())
        result.own_file = std::move(result.file), result.own_text = std::move(result.text);
    result.file = std::move(file);
    result.text = std::move(text);
    result.claims.clear();
    std::vector<Diagnostic> mistakes = check_bytes(result.text);
    if (!mistakes.empty()) fail(result, std::move(mistakes));

    Claim common;  // what the lines before say of the claims that follow
    std::istringstream lines(result.text);
    const SourceText source(result.text);
    KnownNames names(result);
    std::size_t begin = 0, next = 0;
    for (std::string line; std::getline(lines, line);) {
        begin = std::exchange(next, next + line.size() + 1);
        line = line.substr(0, line.find('#'));
        std::vector<Place> places;
        for (std::size_t k = 0; k <= line.size(); ++k) places.push_back(source.place(begin + k));
        const std::vector<Word> typed = words_of(line);
        const bool is_list = !typed.empty() && (typed[0].text == "unknowns" || typed[0].text == "constants");
        if (!is_list || line.find('=') != std::string::npos) write_in_words(line, places, names);
        while (!line.empty() && is_blank(line.back())) line.pop_back();
        const std::vector<Word> words = words_of(line);
        if (words.empty()) continue;
        const std::string& first = words[0].text;
        const bool is_equation = line.find('=') != std::string::npos;
        if (!is_equation && (first == "unknowns" || first == "constants")) {
            std::vector<Name>& list = first == "unknowns" ? common.unknowns : common.constants;
            for (std::size_t k = 1; k < words.size(); ++k) {
                list.push_back({words[k].text, places[words[k].offset]});
                names.add(words[k].text);
            }
            if (words.size() == 1)
                mistakes.push_back({places.front(), say("'{}' names nothing; expected names after it", first)});
            continue;
        }
        if (first == "where") {
            const std::size_t from = words[0].offset + first.size();
            places.erase(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(from));
            if (words.size() == 1)
                common.where.clear();
            else
                common.where.push_back(parse_inequality(line.substr(from), places, mistakes, &names));
            continue;
        }
        if (!is_equation && set_mode(common, joined(words))) {
            common.near.clear();
            continue;
        }
        if (is_equation && first == "near" && words.size() > 1) {
            common.at = Claim::At::near;
            common.sticking = common.closed = {};
            common.near = values_after(line, words[1].offset, places, mistakes, names);
            continue;
        }
        Claim claim = common;
        claim.place = places[words[0].offset];
        claim.equation = parse_equality(line, places, mistakes, claim.at == Claim::At::impact, &names);
        result.claims.push_back(std::move(claim));
    }
    std::erase_if(mistakes, [](const Diagnostic& one) { return one.severity == Severity::warning; });
    if (!mistakes.empty()) fail(result, std::move(mistakes));
    mistakes = check_claims(result);
    if (!mistakes.empty()) fail(result, std::move(mistakes));
    if (result.claims.empty()) fail(result, {{{}, say("has no claims; expected one equation a line")}});
    return result;
}

}  // namespace alembert
