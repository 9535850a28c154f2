// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/sha256.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace alembert {

namespace {

/// The first 32 bits of the fractional parts of the square or cube roots of the first primes.
template <std::size_t N>
std::array<std::uint32_t, N> root_bits(long double (*root)(long double)) {
    std::array<std::uint32_t, N> bits{};
    std::size_t found = 0;
    for (int n = 2; found < N; ++n) {
        bool prime = true;
        for (int d = 2; d * d <= n; ++d) prime = prime && n % d != 0;
        if (!prime) continue;
        const long double r = root(n);
        bits[found++] = static_cast<std::uint32_t>((r - std::floor(r)) * 4294967296.0L);
    }
    return bits;
}

}  // namespace

std::string sha256_base64(std::string_view text) {
    static const auto k = root_bits<64>([](long double x) { return std::cbrt(x); });
    auto h = root_bits<8>([](long double x) { return std::sqrt(x); });
    std::vector<std::uint8_t> bytes(text.begin(), text.end());
    const std::uint64_t length = 8 * bytes.size();
    bytes.push_back(0x80);
    while (bytes.size() % 64 != 56) bytes.push_back(0);
    for (int shift = 56; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(length >> shift));

    for (std::size_t block = 0; block < bytes.size(); block += 64) {
        std::array<std::uint32_t, 64> w{};
        for (std::size_t i = 0; i < 16; ++i)
            for (std::size_t j = 0; j < 4; ++j) w[i] = w[i] << 8 | bytes[block + 4 * i + j];
        for (std::size_t i = 16; i < 64; ++i) {
            const std::uint32_t a = w[i - 15], b = w[i - 2];
            w[i] = w[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + w[i - 7] +
                   (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
        }
        auto v = h;
        for (std::size_t i = 0; i < 64; ++i) {
            const std::uint32_t e = v[4], a = v[0];
            const std::uint32_t first = v[7] + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                        ((e & v[5]) ^ (~e & v[6])) + k[i] + w[i];
            const std::uint32_t second = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) +
                                         ((a & v[1]) ^ (a & v[2]) ^ (v[1] & v[2]));
            v = {first + second, v[0], v[1], v[2], v[3] + first, v[4], v[5], v[6]};
        }
        for (std::size_t i = 0; i < 8; ++i) h[i] += v[i];
    }

    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> digest;
    for (const std::uint32_t word : h)
        for (int shift = 24; shift >= 0; shift -= 8) digest.push_back(static_cast<std::uint8_t>(word >> shift));
    digest.push_back(0);  // 32 bytes are ten triples and a pair
    std::string result;
    for (std::size_t i = 0; i < digest.size(); i += 3) {
        const unsigned three =
            static_cast<unsigned>(digest[i]) << 16 | static_cast<unsigned>(digest[i + 1]) << 8 | digest[i + 2];
        for (int shift = 18; shift >= 0; shift -= 6) result += letters[three >> shift & 63U];
    }
    result.back() = '=';
    return result;
}

}  // namespace alembert
