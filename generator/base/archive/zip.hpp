// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Zip archives whose files are stored as they are, without compression.
///
///     const std::string bytes = stored_zip({{"t.npy", npy}, {"readme.txt", "…"}});
///
/// The same files give the same bytes: the order is that of the list, and all dates are 1 January 1980, the first
/// that the format knows. Archives and files of 4 GiB and more, and more than 65535 files, are written in the form
/// of zip64. (PKWARE, .ZIP File Format Specification 6.3.3, §4.3 and §4.5.3.)

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace alembert {

struct ArchivedFile {
    std::string name;  ///< with '/' between folders, in UTF-8
    std::string bytes;
};

std::string stored_zip(const std::vector<ArchivedFile>& files);

/// The checksum of the format, CRC-32 with the polynomial 0xEDB88320 (ISO 3309).
std::uint32_t crc32_of(std::string_view bytes);

}  // namespace alembert
