// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The fewest variables in which a polynomial can be written: products of powers of its own.
///
///     k²S² − 2 k S w²J + w⁴J² − k²c²w²  =  k²S² (1 − 2 A + A² − B²),   A = w²J/(kS), B = wc/S
///
///     ExponentLattice lattice({{2, 2, 0, 0, 0}, {1, 1, 2, 1, 0}, …});
///     lattice.rank()                // 2: of A and B
///     lattice.reduced()             // {{0, 0}, {1, 0}, …}, one row for each term, none negative
///     lattice.restored({{0, 0}, {0, 1}})
///
/// Polynomials of mechanics have a dimension, often several, so that few variables are left. The factors of a
/// polynomial are those of the reduced one, because the powers in a factor differ by what the powers in the whole
/// span: the new variables are a basis of all whole vectors in that span, made by a change of variables of
/// determinant ±1 (Cohen, A Course in Computational Algebraic Number Theory, 1993, §2.4).

#include <vector>

namespace alembert {

class ExponentLattice {
public:
    using Exponents = std::vector<long>;

    /// One row for each term, one number for each variable.
    explicit ExponentLattice(const std::vector<Exponents>& terms);

    std::size_t rank() const { return rank_; }
    std::vector<Exponents> reduced() const { return reduced_; }
    /// The terms of a factor in the first variables, without a common factor that is a monomial.
    std::vector<Exponents> restored(const std::vector<Exponents>& terms) const;

private:
    void clear_row(Exponents& row, std::vector<Exponents>& differences);
    void subtract(std::size_t from, std::size_t column, long times, std::vector<Exponents>& differences);
    void exchange(std::size_t a, std::size_t b, std::vector<Exponents>& differences);

    std::size_t rank_ = 0;
    std::vector<Exponents> back_;  ///< the new variables in the old ones, one row for each
    std::vector<Exponents> reduced_;
};

}  // namespace alembert
