// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What C++20 has and emscripten 3.1.6's standard library (libc++ 13) has not, where the program uses it. Included
/// before every file that is compiled for WebAssembly.

#include <charconv>
#include <compare>
#include <cstdlib>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace std {  // NOLINT: the names of the standard

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    static_assert(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>);
    return __builtin_bit_cast(To, from);
}

inline strong_ordering operator<=>(const string& a, const string& b) noexcept {
    return a.compare(b) <=> 0;
}

template <class T>
constexpr auto operator<=>(const vector<T>& a, const vector<T>& b) -> decltype(a[0] <=> b[0]) {
    for (size_t i = 0; i < a.size() && i < b.size(); ++i)
        if (const auto order = a[i] <=> b[i]; order != 0) return order;
    return a.size() <=> b.size();
}

/// As the standard has it: no sign "+", no blanks before, no "0x"; `first` and invalid_argument without a number.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const char* end = first;
    const auto digits = [&] {
        const char* const begin = end;
        while (end != last && *end >= '0' && *end <= '9') ++end;
        return end - begin;
    };
    const auto takes = [&](const char* word) {
        const char* at = end;
        for (; *word != 0 && at != last && (*at | 0x20) == *word; ++word) ++at;
        if (*word == 0) end = at;
        return *word == 0;
    };
    if (end != last && *end == '-') ++end;
    if (!takes("infinity") && !takes("inf") && !takes("nan")) {
        auto count = digits();
        if (end != last && *end == '.') {
            ++end;
            count += digits();
        }
        if (count == 0) return {first, errc::invalid_argument};
        if (end != last && (*end == 'e' || *end == 'E')) {
            const char* const before = end++;
            if (end != last && (*end == '-' || *end == '+')) ++end;
            if (digits() == 0) end = before;
        }
    }
    const string text(first, end);
    const double found = strtod(text.c_str(), nullptr);
    const bool is_finite = found - found == 0;
    const bool has_digit = text.find_first_of("123456789") < text.find_first_of("eE");
    if ((!is_finite && text.find_first_of("0123456789") != string::npos) || (found == 0 && has_digit))
        return {end, errc::result_out_of_range};
    value = found;
    return {end, errc()};
}

}  // namespace std
