// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/irreducible.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <vector>

#include <cln/integer.h>

namespace alembert {

namespace {

constexpr std::uint64_t p = 2147483647;  // 2³¹ − 1 is prime
constexpr int most_images = 24;          // if the polynomial is irreducible, about one image in `degree` is
constexpr int highest_tried = 12;        // the highest degree that is tried

std::uint64_t power_mod(std::uint64_t base, std::uint64_t exponent) {
    std::uint64_t result = 1;
    for (; exponent > 0; exponent >>= 1, base = base * base % p)
        if (exponent & 1) result = result * base % p;
    return result;
}

std::uint64_t residue(const cln::cl_I& n) {
    return cln::cl_I_to_UL(cln::mod(n, cln::cl_I(p)));
}

/// Nothing if p divides the denominator.
std::optional<std::uint64_t> residue(const Rational& r) {
    const std::uint64_t below = residue(cln::denominator(r));
    if (below == 0) return std::nullopt;
    return residue(cln::numerator(r)) * power_mod(below, p - 2) % p;
}

/// Coefficients from the constant upwards; in a divisor the last one is 1.
using Image = std::vector<std::uint64_t>;

void drop_zeros(Image& f) {
    while (!f.empty() && f.back() == 0) f.pop_back();
}

/// Reduces f modulo g, whose leading coefficient is 1.
void reduce(Image& f, const Image& g) {
    while (f.size() >= g.size()) {
        const std::uint64_t lead = f.back();
        const std::size_t shift = f.size() - g.size();
        for (std::size_t i = 0; i < g.size(); ++i) f[shift + i] = (f[shift + i] + (p - lead) * g[i]) % p;
        drop_zeros(f);
    }
}

Image product(const Image& a, const Image& b, const Image& modulus) {
    if (a.empty() || b.empty()) return {};
    Image result(a.size() + b.size() - 1, 0);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) result[i + j] = (result[i + j] + a[i] * b[j]) % p;
    drop_zeros(result);
    reduce(result, modulus);
    return result;
}

void make_monic(Image& f) {
    const std::uint64_t inverse = power_mod(f.back(), p - 2);
    for (std::uint64_t& c : f) c = c * inverse % p;
}

bool are_coprime(Image a, Image b) {
    while (!b.empty()) {
        make_monic(b);
        reduce(a, b);
        std::swap(a, b);
    }
    return a.size() == 1;
}

/// f^p modulo g.
Image to_the_p(const Image& f, const Image& g) {
    Image result{1}, base = f;
    for (std::uint64_t e = p; e > 0; e >>= 1) {
        if (e & 1) result = product(result, base, g);
        base = product(base, base, g);
    }
    return result;
}

/// Whether g, of degree at least 2 and with leading coefficient 1, has no factor of at most half its degree:
/// x^(p^k) − x is the product of all that are irreducible of a degree that divides k.
bool is_irreducible(const Image& g) {
    const Image x{0, 1};
    Image frobenius = x;
    for (std::size_t k = 1; 2 * k < g.size(); ++k) {
        frobenius = to_the_p(frobenius, g);
        Image difference = frobenius;
        difference.resize(std::max<std::size_t>(difference.size(), 2), 0);
        difference[1] = (difference[1] + p - 1) % p;
        drop_zeros(difference);
        if (!are_coprime(g, difference)) return false;
    }
    return true;
}

}  // namespace

bool is_surely_irreducible(const Polynomial& primitive, const Atom& variable, const Rational& unit) {
    struct Part {
        std::size_t degree;
        const Term* term;
    };
    std::vector<Part> parts;
    std::map<std::size_t, int> terms_of_degree;
    std::size_t highest = 0;
    for (const Term& term : primitive.terms()) {
        std::size_t degree = 0;
        for (const Factor& factor : term.monomial)
            if (compare(factor.atom, variable) == 0)
                degree = cln::cl_I_to_ulong(cln::numerator(Rational(factor.exponent / unit)));
        parts.push_back({degree, &term});
        ++terms_of_degree[degree];
        highest = std::max(highest, degree);
    }
    if (highest < 2 || highest > highest_tried) return false;
    if (std::none_of(terms_of_degree.begin(), terms_of_degree.end(),
                     [](const auto& entry) { return entry.second == 1; }))
        return false;

    const auto less = [](const Atom& a, const Atom& b) { return compare(a, b) < 0; };
    std::mt19937_64 random(highest);
    for (int image = 0; image < most_images; ++image) {
        std::map<Atom, std::uint64_t, decltype(less)> value(less);
        Image g(highest + 1, 0);
        for (const Part& part : parts) {
            const std::optional<std::uint64_t> coefficient = residue(part.term->coefficient);
            if (!coefficient) return false;
            std::uint64_t c = *coefficient;
            for (const Factor& factor : part.term->monomial) {
                if (compare(factor.atom, variable) == 0) continue;
                // A residue need not have a root, so that fractional powers cannot be evaluated.
                if (cln::denominator(factor.exponent) != 1) return false;
                const auto [place, is_new] = value.try_emplace(factor.atom, 0);
                if (is_new) place->second = random() % (p - 1) + 1;
                c = c * power_mod(place->second, cln::cl_I_to_ulong(cln::numerator(factor.exponent))) % p;
            }
            g[part.degree] = (g[part.degree] + c) % p;
        }
        if (g.back() == 0) continue;
        make_monic(g);
        if (is_irreducible(g)) return true;
    }
    return false;
}

}  // namespace alembert
