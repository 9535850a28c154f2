// SPDX-License-Identifier: MIT
#pragma once

/// Power series of eight systems side by side, each at its own state and time and with its own parameters.
///
///     std::vector<Lanes> out((order + 1) * packs.places.width), work(packs.workspace());
///     packs.expand(t, state, par, order, out.data(), work.data());
///     out[k * packs.places.width + i][lane];      // of (time − t)^k in component i
///
/// The code is that of a series alone (series_code.hpp) with a pack in place of each number, but for two things:
/// the sums of products go through their lanes one product after the other, and each factor stands once in memory,
/// its coefficients behind each other. No number of a lane depends on the other lanes, not even in the last bit.

#include <memory>
#include <vector>

#include "alembert/batch/packs.hpp"
#include "alembert/native/series_code.hpp"

namespace alembert {

struct PackSeries {
    void (*prepare)(double* par) = nullptr;  ///< of one system: makes its constants behind its parameters
    void (*first)(const double* t, const double* state, const double* par, double* fixed, double* given) = nullptr;
    void (*fix)(double* fixed) = nullptr;
    /// `row` is that of order k; the other coefficients of a factor follow behind that.
    void (*next)(const double* k, const double* fixed, const double* given, double* next, double* row,
                 double* out) = nullptr;
    GivenPlaces places = {};  ///< without factors
    struct Product {
        int left, right;  ///< factors
    };
    std::vector<Product> products = {};
    int factors = 0, fixed = 0;
    int parameters = 0, constants = 0;
    double order_cost = 0, product_cost = 0;  ///< of one of the eight systems, as in alembert_series_table
    std::shared_ptr<const void> code = {};    ///< keeps the functions in memory

    void expand(const Lanes& t, const Lanes* state, const Lanes* par, int order, Lanes* out, Lanes* work) const;
    std::size_t workspace() const;  ///< of packs
    /// The place of the coefficient of order 0 of a factor in the rows; that of order k stands k places behind.
    static int place_of_factor(int factor) { return factor * (most_order + 1); }
};

}  // namespace alembert
