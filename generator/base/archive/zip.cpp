// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/archive/zip.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace alembert {

namespace {

constexpr std::uint64_t most_32 = std::numeric_limits<std::uint32_t>::max(),
                        most_16 = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint64_t first_day = (1 << 5) + 1;      // 1 January 1980
constexpr std::uint64_t stored = 10, with_zip64 = 45;  // the versions that are needed to extract: 1.0 and 4.5

constexpr std::uint64_t utf_8 = 1U << 11U;  // the flag of names that are not ASCII

using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

/// Table k moves a byte over k more bytes, so that eight are taken at once.
constexpr CrcTables crc_tables() {
    CrcTables tables{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t crc = byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0xEDB88320U : crc >> 1U;
        tables[0][byte] = crc;
    }
    for (std::size_t k = 1; k < tables.size(); ++k)
        for (std::size_t byte = 0; byte < 256; ++byte) {
            const std::uint32_t before = tables[k - 1][byte];
            tables[k][byte] = (before >> 8U) ^ tables[0][before & 255U];
        }
    return tables;
}

/// The lowest byte first.
void put_number(std::string& out, std::uint64_t value, int bytes) {
    for (int k = 0; k < bytes; ++k) out.push_back(static_cast<char>((value >> (8 * k)) & 255U));
}

struct Entry {
    const ArchivedFile* file;
    std::uint32_t crc;
    std::uint64_t place;
    bool is_large() const { return file->bytes.size() >= most_32 || place >= most_32; }
};

/// What the headers before a file and in the directory share.
void put_description(std::string& out, const Entry& entry, std::uint64_t extra) {
    const std::uint64_t size = entry.is_large() ? most_32 : entry.file->bytes.size();
    put_number(out, entry.is_large() ? with_zip64 : stored, 2);
    const std::string& name = entry.file->name;
    const bool is_ascii =
        std::all_of(name.begin(), name.end(), [](char c) { return static_cast<signed char>(c) >= 0; });
    put_number(out, is_ascii ? 0 : utf_8, 2);
    put_number(out, 0, 2);  // stored
    put_number(out, 0, 2);  // midnight
    put_number(out, first_day, 2);
    put_number(out, entry.crc, 4);
    put_number(out, size, 4);  // stored, and
    put_number(out, size, 4);  // as it is
    put_number(out, entry.file->name.size(), 2);
    put_number(out, extra, 2);
}

void put_file(std::string& out, const Entry& entry) {
    out += "PK\3\4";
    put_description(out, entry, entry.is_large() ? 20 : 0);
    out += entry.file->name;
    if (entry.is_large()) {
        put_number(out, 1, 2);  // zip64
        put_number(out, 16, 2);
        put_number(out, entry.file->bytes.size(), 8);
        put_number(out, entry.file->bytes.size(), 8);
    }
    out += entry.file->bytes;
}

void put_directory_entry(std::string& out, const Entry& entry) {
    out += "PK\1\2";
    put_number(out, entry.is_large() ? with_zip64 : stored, 2);  // made by the same version, on MS-DOS
    put_description(out, entry, entry.is_large() ? 28 : 0);
    put_number(out, 0, 2);  // no comment
    put_number(out, 0, 2);  // the first disk
    put_number(out, 0, 2);
    put_number(out, 0, 4);  // no attributes
    put_number(out, entry.is_large() ? most_32 : entry.place, 4);
    out += entry.file->name;
    if (!entry.is_large()) return;
    put_number(out, 1, 2);
    put_number(out, 24, 2);
    put_number(out, entry.file->bytes.size(), 8);
    put_number(out, entry.file->bytes.size(), 8);
    put_number(out, entry.place, 8);
}

void put_end(std::string& out, std::uint64_t count, std::uint64_t directory) {
    const std::uint64_t length = out.size() - directory, here = out.size();
    const bool is_large = count >= most_16 || directory >= most_32 || length >= most_32;
    if (is_large) {
        out += "PK\6\6";
        put_number(out, 44, 8);
        put_number(out, with_zip64, 2);
        put_number(out, with_zip64, 2);
        put_number(out, 0, 8);  // disks
        put_number(out, count, 8);
        put_number(out, count, 8);
        put_number(out, length, 8);
        put_number(out, directory, 8);
        out += "PK\6\7";
        put_number(out, 0, 4);
        put_number(out, here, 8);
        put_number(out, 1, 4);
    }
    out += "PK\5\6";
    put_number(out, 0, 4);  // disks
    put_number(out, is_large ? most_16 : count, 2);
    put_number(out, is_large ? most_16 : count, 2);
    put_number(out, is_large ? most_32 : length, 4);
    put_number(out, is_large ? most_32 : directory, 4);
    put_number(out, 0, 2);  // no comment
}

}  // namespace

std::uint32_t crc32_of(std::string_view bytes) {
    static constexpr CrcTables tables = crc_tables();
    std::uint32_t crc = 0xFFFFFFFFU;
    std::size_t at = 0;
    for (; at + 8 <= bytes.size(); at += 8) {
        std::array<unsigned char, 8> next{};
        std::memcpy(next.data(), bytes.data() + at, 8);
        for (std::size_t k = 0; k < 4; ++k) next[k] ^= static_cast<unsigned char>(crc >> (8 * k));
        crc = 0;
        for (std::size_t k = 0; k < 8; ++k) crc ^= tables[7 - k][next[k]];
    }
    for (; at < bytes.size(); ++at)
        crc = (crc >> 8U) ^ tables[0][(crc ^ static_cast<unsigned char>(bytes[at])) & 255U];
    return ~crc;
}

std::string stored_zip(const std::vector<ArchivedFile>& files) {
    std::string out;
    std::size_t room = 100;
    for (const ArchivedFile& file : files) room += file.bytes.size() + 2 * file.name.size() + 150;
    out.reserve(room);
    std::vector<Entry> entries;
    for (const ArchivedFile& file : files) {
        entries.push_back({.file = &file, .crc = crc32_of(file.bytes), .place = out.size()});
        put_file(out, entries.back());
    }
    const std::uint64_t directory = out.size();
    for (const Entry& entry : entries) put_directory_entry(out, entry);
    put_end(out, entries.size(), directory);
    return out;
}

}  // namespace alembert
