// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/origin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace alembert {

namespace {

const OriginWords& words_of(const Origin& origin) {
    return *std::find_if(std::begin(origin_words), std::end(origin_words),
                         [&](const OriginWords& one) { return one.kind == origin.kind; });
}

const char* pattern(const Origin& origin) {
    return origin.kind == Origin::Kind::gravity && origin.on_body ? to_say("gravity on body {1}")
                                                                  : words_of(origin).text;
}

}  // namespace

std::string label(const Origin& origin) {
    const int number = origin.index + 1;
    return fmt::vformat(pattern(origin), fmt::make_format_args(number, origin.name));
}

std::vector<std::string> labels(const Origin& origin) {
    const int number = origin.index + 1;
    return in_each_language(pattern(origin), fmt::make_format_args(number, origin.name));
}

std::string shown_label(const Origin& origin) {
    const int number = origin.index + 1;
    return translated_with(pattern(origin), fmt::make_format_args(number, origin.name));
}

std::vector<std::string> names_of(const Origin& origin) {
    const int number = origin.index + 1;
    std::vector<std::string> names;
    for (const char* const name : words_of(origin).names)
        if (name != nullptr) names.push_back(fmt::vformat(name, fmt::make_format_args(number, origin.name)));
    return names;
}

Origin gravity_on(const Origin& mass) {
    return {Origin::Kind::gravity, mass.index, mass.name, mass.kind == Origin::Kind::body};
}

}  // namespace alembert
