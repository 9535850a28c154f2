// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/exponent_lattice.hpp"

#include <algorithm>
#include <cstdlib>

namespace alembert {

namespace {

/// Each column less its smallest number.
void make_least_zero(std::vector<ExponentLattice::Exponents>& terms) {
    if (terms.empty()) return;
    for (std::size_t j = 0; j < terms[0].size(); ++j) {
        long least = terms[0][j];
        for (const auto& term : terms) least = std::min(least, term[j]);
        for (auto& term : terms) term[j] -= least;
    }
}

}  // namespace

ExponentLattice::ExponentLattice(const std::vector<Exponents>& terms) {
    const std::size_t variables = terms.empty() ? 0 : terms[0].size();
    for (std::size_t j = 0; j < variables; ++j) {
        back_.emplace_back(variables, 0);
        back_[j][j] = 1;
    }
    std::vector<Exponents> differences = terms;
    for (Exponents& row : differences)
        for (std::size_t j = 0; j < variables; ++j) row[j] -= terms[0][j];
    for (Exponents& row : differences) clear_row(row, differences);
    for (Exponents& row : differences) row.resize(rank_);
    make_least_zero(differences);
    reduced_ = std::move(differences);
}

/// Euclid's algorithm on the columns from `rank_` on, until one of them at most has a number in this row.
void ExponentLattice::clear_row(Exponents& row, std::vector<Exponents>& differences) {
    for (;;) {
        std::size_t least = row.size(), count = 0;
        for (std::size_t j = rank_; j < row.size(); ++j) {
            if (row[j] == 0) continue;
            ++count;
            if (least == row.size() || std::abs(row[j]) < std::abs(row[least])) least = j;
        }
        if (count == 0) return;
        if (count == 1) {
            exchange(rank_, least, differences);
            ++rank_;
            return;
        }
        for (std::size_t j = rank_; j < row.size(); ++j)
            if (j != least && row[j] != 0) subtract(least, j, row[j] / row[least], differences);
    }
}

/// Column j less `times` column k: of the variables, x_k becomes x_k x_j^times.
void ExponentLattice::subtract(std::size_t k, std::size_t j, long times, std::vector<Exponents>& differences) {
    for (Exponents& row : differences) row[j] -= times * row[k];
    for (std::size_t i = 0; i < back_[k].size(); ++i) back_[k][i] += times * back_[j][i];
}

void ExponentLattice::exchange(std::size_t a, std::size_t b, std::vector<Exponents>& differences) {
    for (Exponents& row : differences) std::swap(row[a], row[b]);
    std::swap(back_[a], back_[b]);
}

std::vector<ExponentLattice::Exponents> ExponentLattice::restored(const std::vector<Exponents>& terms) const {
    std::vector<Exponents> result;
    for (const Exponents& term : terms) {
        Exponents& whole = result.emplace_back(back_.size(), 0);
        for (std::size_t k = 0; k < rank_; ++k)
            for (std::size_t i = 0; i < whole.size(); ++i) whole[i] += term[k] * back_[k][i];
    }
    make_least_zero(result);
    return result;
}

}  // namespace alembert
