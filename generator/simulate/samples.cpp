// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/samples.hpp"

#include <array>
#include <bit>
#include <numeric>
#include <random>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr int bits = 32;  // of a coordinate of Sobol's points

/// A primitive polynomial x^s + a₁ x^(s−1) + … + 1, the digits of a in one number, and the first direction
/// numbers.
struct Direction {
    unsigned degree, a;
    std::array<unsigned, 7> m;
};

/// Of the dimensions from the second on.
constexpr std::array<Direction, 20> directions{{{1, 0, {1}},
                                                {2, 1, {1, 3}},
                                                {3, 1, {1, 3, 1}},
                                                {3, 2, {1, 1, 1}},
                                                {4, 1, {1, 1, 3, 3}},
                                                {4, 4, {1, 3, 5, 13}},
                                                {5, 2, {1, 1, 5, 5, 17}},
                                                {5, 4, {1, 1, 5, 5, 5}},
                                                {5, 7, {1, 1, 7, 11, 19}},
                                                {5, 11, {1, 1, 5, 1, 1}},
                                                {5, 13, {1, 1, 1, 3, 11}},
                                                {5, 14, {1, 3, 5, 5, 31}},
                                                {6, 1, {1, 3, 3, 9, 7, 49}},
                                                {6, 13, {1, 1, 1, 15, 21, 21}},
                                                {6, 16, {1, 3, 1, 13, 27, 49}},
                                                {6, 19, {1, 1, 1, 15, 7, 5}},
                                                {6, 22, {1, 3, 1, 15, 13, 25}},
                                                {6, 25, {1, 1, 5, 5, 19, 61}},
                                                {7, 1, {1, 3, 7, 11, 23, 15, 103}},
                                                {7, 4, {1, 3, 7, 13, 13, 15, 69}}}};

double fraction(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11U) * 0x1p-53;
}

using DirectionNumbers = std::array<std::uint32_t, bits>;

DirectionNumbers numbers_of(std::size_t dimension) {
    DirectionNumbers v{};
    if (dimension == 0) {
        for (unsigned k = 0; k < bits; ++k) v[k] = 1U << (bits - 1 - k);
        return v;
    }
    const Direction& d = directions[dimension - 1];
    for (unsigned k = 0; k < bits; ++k) {
        if (k < d.degree) {
            v[k] = d.m[k] << (bits - 1 - k);
            continue;
        }
        v[k] = v[k - d.degree] ^ (v[k - d.degree] >> d.degree);
        for (unsigned i = 1; i < d.degree; ++i)
            if (((d.a >> (d.degree - 1 - i)) & 1U) != 0) v[k] ^= v[k - i];
    }
    return v;
}

using Fractions = std::function<void(std::size_t k, std::span<double> fractions)>;

Fractions sobol(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
    if (dimensions > directions.size() + 1)
        throw ModelError(
            say("--sampling sobol spreads points over at most {} ranges, and there are {}; take latin",
                directions.size() + 1, dimensions));
    if (count > std::size_t{1} << bits)
        throw ModelError(
            say("--sampling sobol has at most 2^{} points, and {} are asked for; take latin", bits, count));
    std::mt19937_64 random(seed);
    std::vector<DirectionNumbers> numbers;
    std::vector<std::uint32_t> shift;
    for (std::size_t d = 0; d < dimensions; ++d) {
        numbers.push_back(numbers_of(d));
        shift.push_back(seed == 0 ? 0 : static_cast<std::uint32_t>(random() >> 32U));
    }
    return [numbers = std::move(numbers), shift = std::move(shift)](std::size_t k, std::span<double> fractions) {
        for (std::size_t d = 0; d < fractions.size(); ++d) {
            std::uint32_t x = shift[d];
            for (std::size_t gray = k ^ k >> 1U; gray != 0; gray &= gray - 1)  // in the order of Gray's code
                x ^= numbers[d][static_cast<std::size_t>(__builtin_ctzll(gray))];
            fractions[d] = x * 0x1p-32;
        }
    };
}

constexpr std::size_t most_shuffled = 1'000'000;

/// The order of the parts in memory; `values` has the fractions of all points, one dimension after the other.
Fractions shuffled_latin(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> values(count * dimensions);
    for (std::size_t d = 0; d < dimensions; ++d) {
        std::vector<std::size_t> part(count);
        std::iota(part.begin(), part.end(), 0);
        for (std::size_t k = count; k > 1; --k)
            std::swap(part[k - 1], part[static_cast<std::size_t>(fraction(random) * static_cast<double>(k))]);
        for (std::size_t k = 0; k < count; ++k)
            values[d * count + k] = (static_cast<double>(part[k]) + fraction(random)) / static_cast<double>(count);
    }
    return [count, values = std::move(values)](std::size_t k, std::span<double> fractions) {
        for (std::size_t d = 0; d < fractions.size(); ++d) fractions[d] = values[d * count + k];
    };
}

/// The finalizer of SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15U;
    x = (x ^ x >> 30U) * 0xBF58476D1CE4E5B9U;
    x = (x ^ x >> 27U) * 0x94D049BB133111EBU;
    return x ^ x >> 31U;
}

/// A permutation of 0 … count − 1 that depends on the key.
std::uint64_t permuted(std::uint64_t k, std::uint64_t count, std::uint64_t key) {
    const auto digits = static_cast<unsigned>(std::bit_width(count - 1));
    const unsigned half = (digits + 1) / 2;
    const std::uint64_t low = (std::uint64_t{1} << half) - 1;
    do {
        std::uint64_t left = k >> half, right = k & low;
        for (std::uint64_t round = 0; round < 4; ++round) {
            const std::uint64_t next = left ^ (mixed(right ^ mixed(key + round)) & low);
            left = right;
            right = next;
        }
        k = left << half | right;
    } while (k >= count);
    return k;
}

Fractions keyed_latin(std::size_t count, std::uint64_t seed) {
    return [count, seed](std::size_t k, std::span<double> fractions) {
        for (std::size_t d = 0; d < fractions.size(); ++d) {
            const std::uint64_t key = mixed(mixed(seed) + d);
            const double inside = static_cast<double>(mixed(key ^ mixed(k)) >> 11U) * 0x1p-53;
            fractions[d] = (static_cast<double>(permuted(k, count, key)) + inside) / static_cast<double>(count);
        }
    };
}

Fractions uniform(std::uint64_t seed) {
    /// The stream of numbers, as far as it was read.
    struct Stream {
        std::mt19937_64 random;
        std::size_t next = 0;
    };
    return [seed, stream = Stream{std::mt19937_64(seed)}](std::size_t k, std::span<double> fractions) mutable {
        if (k < stream.next) stream = {std::mt19937_64(seed)};
        stream.random.discard((k - stream.next) * fractions.size());
        for (double& x : fractions) x = fraction(stream.random);
        stream.next = k + 1;
    };
}

}  // namespace

Sampling sampling_of(const std::string& word) {
    if (word == "uniform") return Sampling::uniform;
    if (word == "latin") return Sampling::latin;
    if (word == "sobol") return Sampling::sobol;
    throw ModelError(say("{} is no way to sample; expected sobol, latin or uniform", in_quotes(word)));
}

Grid sampled(std::vector<Axis> axes, std::size_t count, Sampling sampling, std::uint64_t seed) {
    Grid grid{.axes = std::move(axes)};
    grid.samples = sampling == Sampling::sobol     ? sobol(count, grid.axes.size(), seed)
                   : sampling == Sampling::uniform ? uniform(seed)
                   : count <= most_shuffled        ? shuffled_latin(count, grid.axes.size(), seed)
                                                   : keyed_latin(count, seed);
    for (Axis& axis : grid.axes) axis.count = count;
    return grid;
}

}  // namespace alembert
