// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/language/catalogue.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace alembert {

namespace {

std::uint32_t number_at(std::string_view file, std::size_t offset) {
    std::uint32_t result = 0;
    if (offset + sizeof result > file.size()) throw std::invalid_argument("the catalogue of messages is cut off");
    std::memcpy(&result, file.data() + offset, sizeof result);
    return result;
}

/// The text whose length and place stand at `offset`.
std::string_view text_at(std::string_view file, std::size_t offset) {
    const std::size_t length = number_at(file, offset), begin = number_at(file, offset + 4);
    if (begin + length > file.size()) throw std::invalid_argument("the catalogue of messages is cut off");
    return file.substr(begin, length);
}

}  // namespace

MessageCatalogue::MessageCatalogue(std::string_view file) {
    if (number_at(file, 0) != 0x950412de) throw std::invalid_argument("not a catalogue of messages (a .mo file)");
    const std::size_t count = number_at(file, 8), english = number_at(file, 12), other = number_at(file, 16);
    entries_.reserve(count);
    for (std::size_t k = 0; k < count; ++k)
        entries_.emplace_back(text_at(file, english + 8 * k), text_at(file, other + 8 * k));
    std::sort(entries_.begin(), entries_.end());
}

std::string_view MessageCatalogue::translation(std::string_view english) const {
    if (english.empty()) return {};  // that entry holds the properties of the catalogue
    const auto found =
        std::lower_bound(entries_.begin(), entries_.end(), english,
                         [](const auto& entry, std::string_view text) { return entry.first < text; });
    return found != entries_.end() && found->first == english ? found->second : std::string_view();
}

}  // namespace alembert
