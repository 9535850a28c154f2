// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/language.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "alembert/base/error.hpp"
#include "base/language/catalogue.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

bool is_language(std::string_view word) {
    return word == "en" || word == "zh";
}

/// Takes `--language en` and the like out of the words and gives the last of them. `emit --language c` stays.
std::optional<std::string> taken_from(std::vector<std::string>& words) {
    constexpr std::string_view option = "--language", with_value = "--language=";
    std::optional<std::string> result;
    for (std::size_t k = 0; k < words.size() && words[k] != "--";) {
        const std::size_t count = words[k] == option ? 2 : words[k].starts_with(with_value) ? 1 : 0;
        const std::string value = count == 1                           ? words[k].substr(with_value.size())
                                  : count == 2 && k + 1 < words.size() ? words[k + 1]
                                                                       : std::string();
        if (!is_language(value)) {
            ++k;
            continue;
        }
        result = value;
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(k),
                    words.begin() + static_cast<std::ptrdiff_t>(k + count));
    }
    return result;
}

std::string_view variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string_view() : std::string_view(value);
}

/// As gettext chooses: LANGUAGE is a list and comes first, but not where LC_ALL is the locale of programs.
std::string of_the_environment() {
    const std::string_view all = variable("LC_ALL");
    const bool is_plain = all == "POSIX" || all == "C" || all.starts_with("C.");
    for (std::string_view list = is_plain ? std::string_view() : variable("LANGUAGE"); !list.empty();) {
        const std::string_view first = list.substr(0, list.find(':'));
        if (is_language(first.substr(0, 2))) return std::string(first.substr(0, 2));
        list.remove_prefix(std::min(list.size(), first.size() + 1));
    }
    for (const char* const name : {"LC_ALL", "LC_MESSAGES", "LANG"})
        if (const std::string_view locale = variable(name); !locale.empty())
            return std::string(locale.substr(0, 2));
    return "en";
}

}  // namespace

void choose_language(std::vector<std::string>& words) {
    const std::optional<std::string> asked = taken_from(words);
    if (asked == "zh" && chinese_catalogue.empty())
        throw CompileError(
            say("Chinese is missing: this program was built without msgfmt; install gettext, configure and build "
                "again"));
    const bool is_for_programs = std::find(words.begin(), words.end(), "--json") != words.end();
    if (chinese_catalogue.empty()) return;
    static const MessageCatalogue chinese(chinese_catalogue);
    know_catalogue(&chinese);
    if (!is_for_programs && asked.value_or(of_the_environment()) == "zh") use_catalogue(&chinese);
}

}  // namespace alembert
