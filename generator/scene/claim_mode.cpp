// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/claim_mode.hpp"

#include <array>
#include <cctype>
#include <sstream>
#include <string_view>
#include <utility>

namespace alembert {

namespace {

constexpr std::array mode_words{std::pair{Claim::At::motion, std::string_view("motion")},
                                std::pair{Claim::At::rest, std::string_view("rest")},
                                std::pair{Claim::At::impact, std::string_view("impact")},
                                std::pair{Claim::At::solution, std::string_view("solution")},
                                std::pair{Claim::At::near, std::string_view("near")},
                                std::pair{Claim::At::sticking, std::string_view("sticking")},
                                std::pair{Claim::At::closed, std::string_view("closed")}};

/// The names after the word; nothing if the text does not begin with the word and a blank, and is not the word.
std::optional<std::vector<std::string>> names_after(std::string_view word, const std::string& text) {
    if (!text.starts_with(word)) return std::nullopt;
    if (text.size() > word.size() && std::isspace(static_cast<unsigned char>(text[word.size()])) == 0)
        return std::nullopt;
    std::istringstream rest(text.substr(word.size()));
    std::vector<std::string> names;
    for (std::string name; rest >> name;) names.push_back(name);
    return names;
}

}  // namespace

bool set_mode(Claim& claim, const std::string& text) {
    for (const auto& [at, word] : mode_words) {
        if (at == Claim::At::near) continue;
        std::vector<std::string> names;
        if (at == Claim::At::sticking || at == Claim::At::closed) {
            std::optional<std::vector<std::string>> found = names_after(word, text);
            if (!found) continue;
            names = std::move(*found);
        } else if (text != word) {
            continue;
        }
        claim.at = at;
        claim.sticking = claim.closed = {};
        (at == Claim::At::closed ? claim.closed : claim.sticking) = std::move(names);
        return true;
    }
    return false;
}

std::string mode_text(const Claim& claim) {
    std::string text;
    for (const auto& [at, word] : mode_words)
        if (at == claim.at) text = word;
    for (const auto* names : {&claim.sticking, &claim.closed})
        for (const std::string& name : *names) text += ' ' + name;
    return text;
}

}  // namespace alembert
