// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/archive/stored_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "base/archive/zip.hpp"

namespace alembert {

namespace {

const char order = std::endian::native == std::endian::little ? '<' : '>';

/// The bytes before the values; `shape` as in Python: "(3,)".
std::string npy_header(const std::string& type, const std::string& shape) {
    std::string text =
        fmt::format("{{'descr': '{}{}', 'fortran_order': False, 'shape': {}, }}", order, type, shape);
    constexpr std::size_t before = 10, alignment = 64;
    text.append((alignment - (before + text.size() + 1) % alignment) % alignment, ' ');
    text += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header.push_back(static_cast<char>(text.size() & 255U));
    header.push_back(static_cast<char>(text.size() >> 8U));
    return header + text;
}

template <typename Number>
std::string npy_numbers(const char* type, const std::vector<Number>& values) {
    static_assert(sizeof(Number) == 8);
    std::string bytes = npy_header(type, fmt::format("({},)", values.size()));
    const std::size_t begin = bytes.size();
    bytes.resize(begin + 8 * values.size());
    if (!values.empty()) std::memcpy(bytes.data() + begin, values.data(), 8 * values.size());
    return bytes;
}

/// Code points; a byte that begins no sequence of UTF-8 counts for itself.
std::vector<std::uint32_t> code_points(std::string_view text) {
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < text.size();) {
        const auto first = static_cast<unsigned char>(text[i]);
        const std::size_t more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
        std::uint32_t point = more == 3 ? first & 7U : more == 2 ? first & 15U : more == 1 ? first & 31U : first;
        for (std::size_t k = 1; k <= more && i + k < text.size(); ++k)
            point = point << 6U | (static_cast<unsigned char>(text[i + k]) & 63U);
        result.push_back(point);
        i += more + 1;
    }
    return result;
}

/// Texts of one length, filled with zeros.
std::string npy_texts(const std::vector<std::string>& texts, const std::string& shape) {
    std::size_t longest = 1;
    std::vector<std::vector<std::uint32_t>> all;
    for (const std::string& text : texts) {
        all.push_back(code_points(text));
        longest = std::max(longest, all.back().size());
    }
    std::string bytes = npy_header(fmt::format("U{}", longest), shape);
    for (std::vector<std::uint32_t>& text : all) {
        text.resize(longest);
        const std::size_t begin = bytes.size();
        bytes.resize(begin + 4 * longest);
        std::memcpy(bytes.data() + begin, text.data(), 4 * longest);
    }
    return bytes;
}

std::string npy_texts(const std::vector<std::string>& texts) {
    return npy_texts(texts, fmt::format("({},)", texts.size()));
}

}  // namespace

std::vector<std::string> names_beside_columns(const StoredTable& table) {
    std::vector<std::string> names{"columns", "units"};
    for (const auto& [name, text] : table.texts) names.push_back(name);
    for (std::string& name : names)
        while (std::any_of(table.columns.begin(), table.columns.end(),
                           [&](const StoredColumn& column) { return column.name == name; }))
            name += "_";
    return names;
}

std::string as_npz(const StoredTable& table) {
    std::vector<ArchivedFile> files;
    const auto add = [&](const std::string& name, std::string bytes) {
        files.push_back({name + ".npy", std::move(bytes)});
    };
    std::vector<std::string> columns, units;
    for (const StoredColumn& column : table.columns) {
        columns.push_back(column.name);
        units.push_back(column.unit);
        if (const auto* numbers = std::get_if<std::vector<double>>(&column.values))
            add(column.name, npy_numbers("f8", *numbers));
        else if (const auto* counts = std::get_if<std::vector<std::int64_t>>(&column.values))
            add(column.name, npy_numbers("i8", *counts));
        else
            add(column.name, npy_texts(std::get<std::vector<std::string>>(column.values)));
    }
    const std::vector<std::string> names = names_beside_columns(table);
    add(names[0], npy_texts(columns));
    add(names[1], npy_texts(units));
    for (std::size_t k = 0; k < table.texts.size(); ++k)
        add(names[2 + k], npy_texts({table.texts[k].second}, "()"));
    return stored_zip(files);
}

}  // namespace alembert
