// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Values as bytes, for files and messages that the same program reads again on the same kind of processor.
///
///     std::string bytes;
///     put_bytes(bytes, 7L);
///     ByteReader(bytes).take<long>();      // 7

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace alembert {

template <typename T>
void put_bytes(std::string& out, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline void put_bytes(std::string& out, std::string_view text) {
    put_bytes(out, text.size());
    out += text;
}

template <typename T>
void put_list(std::string& out, const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(out, values.size());
    out.append(reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size());
}

/// Seven bits in a byte, so that small numbers are short.
inline void put_short(std::string& out, std::uint64_t value) {
    for (; value > 127; value >>= 7U) out.push_back(static_cast<char>(value | 128U));
    out.push_back(static_cast<char>(value));
}

/// Takes them back in the same order. Throws std::runtime_error where there are too few bytes.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <typename T>
    T take() {
        T value;
        std::memcpy(&value, next(sizeof value).data(), sizeof value);
        return value;
    }
    std::string text() { return std::string(next(take<std::size_t>())); }
    template <typename T>
    std::vector<T> list() {
        std::vector<T> values(take<std::size_t>());
        const std::string_view bytes = next(sizeof(T) * values.size());
        if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), bytes.data(), bytes.size());
        return values;
    }
    std::uint64_t short_number() {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 64; shift += 7) {
            const auto byte = take<unsigned char>();
            value |= std::uint64_t{byte & 127U} << shift;
            if (byte < 128) break;
        }
        return value;
    }
    bool is_at_end() const { return rest_.empty(); }
    std::string_view rest() const { return rest_; }

private:
    std::string_view next(std::size_t size) {
        if (size > rest_.size()) throw std::runtime_error("a record of a sweep is cut short");
        const std::string_view bytes = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return bytes;
    }
    std::string_view rest_;
};

}  // namespace alembert
