// SPDX-License-Identifier: MIT
#pragma once

/// A 128-bit fingerprint of bytes. It names the entries of the compile cache and shows whether an entry is intact.
///
///     Fingerprint print;
///     print.add("first part");
///     print.add("second part");        // other boundaries, other fingerprint: lengths are mixed in
///     std::string key = print.hex();   // 32 digits
///
/// Method: FNV-1a with 128 bits (Fowler, Noll, Vo; IETF draft-eastlake-fnv-17, §2 and §5). The method is not
/// cryptographic: it protects against accidents, not against somebody who may write into the user's cache. It
/// throws nothing.

#include <cstdint>
#include <string>
#include <string_view>

namespace alembert {

class Fingerprint {
public:
    /// Mixes in bytes as they are.
    void add_bytes(std::string_view bytes) {
        for (const char byte : bytes) {
            state_ ^= static_cast<unsigned char>(byte);
            state_ *= prime;
        }
    }

    /// Mixes in a part and its length, so that "ab", "c" differs from "a", "bc".
    void add(std::string_view part) {
        add_bytes(part);
        add_bytes(std::to_string(part.size()) + ';');
    }

    /// 32 hexadecimal digits, the most significant first.
    std::string hex() const {
        std::string text(32, '0');
        for (int i = 0; i < 32; ++i)
            text[static_cast<std::size_t>(i)] =
                "0123456789abcdef"[static_cast<unsigned>(state_ >> (4 * (31 - i))) & 15U];
        return text;
    }

private:
    __extension__ using Wide = unsigned __int128;
    static constexpr Wide prime = (Wide{1} << 88) + 0x13b;
    Wide state_ = (Wide{0x6c62272e07bb0142} << 64) + 0x62b821756295c58d;
};

}  // namespace alembert
