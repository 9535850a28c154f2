// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/language/say.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/language/catalogue.hpp"

namespace alembert {

namespace {

const MessageCatalogue* in_use = nullptr;
const MessageCatalogue* known = nullptr;

std::string formatted(const MessageCatalogue* catalogue, fmt::string_view english, fmt::format_args values) {
    const std::string_view other =
        catalogue == nullptr ? std::string_view() : catalogue->translation({english.data(), english.size()});
    if (!other.empty()) try {
            return fmt::vformat(other, values);
        } catch (const fmt::format_error&) {  // the translation asks for other values than there are
        }
    return fmt::vformat(english, values);
}

}  // namespace

void use_catalogue(const MessageCatalogue* catalogue) {
    in_use = catalogue;
}

void know_catalogue(const MessageCatalogue* catalogue) {
    known = catalogue;
}

std::vector<std::string> in_each_language(fmt::string_view english, fmt::format_args values) {
    return {formatted(nullptr, english, values), formatted(known, english, values)};
}

std::string translated(std::string_view english) {
    const std::string_view other = in_use == nullptr ? std::string_view() : in_use->translation(english);
    return std::string(other.empty() ? english : other);
}

std::string translated_parts(std::string_view english) {
    std::string result;
    for (std::size_t at = 0; at <= english.size();) {
        const std::size_t end = std::min(english.find(", ", at), english.size());
        result += (at == 0 ? "" : ", ") + translated(english.substr(at, end - at));
        at = end + 2;
    }
    return result;
}

std::string translated_with(fmt::string_view english, fmt::format_args values) {
    return formatted(in_use, english, values);
}

}  // namespace alembert
