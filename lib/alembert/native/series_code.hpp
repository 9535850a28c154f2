// SPDX-License-Identifier: MIT
#pragma once

/// Power series by machine code in memory (executable.hpp): what is the same for all of them, the orders one after
/// the other and the sums of products over lower orders.
///
///     SeriesCode code{.first = …, .fix = …, .next = …, .places = …, .fixed = 3};
///     code.expand(t, state, par, order, out, work);      // work: workspace_of(code) numbers
///
/// `first` computes what stays fixed for all orders, `fix` adds what follows from that, and `next` computes the
/// coefficients of order k from what it is given: sums of products, and numbers that it wrote at the order before.
/// A row has the left factors of all products at its order, then the right ones. `next` is given rows and
/// coefficients from those of order k − 1 on, and writes those of order k behind them.

#include <vector>

#include "alembert/ode/series.hpp"

namespace alembert {

/// Where the numbers stand that an order is given.
struct GivenPlaces {
    int lanes = 0;      ///< sums of products, filled up to a multiple of eight
    int width = 0;      ///< components of the state
    int positions = 0;  ///< so many first components have the rates that stand `positions` behind them; the order
                        ///< before writes the rates of all others
    int factors = 0;    ///< different factors of products, if `next` adds the first and the last term of each sum
                        ///< itself, so that no order waits until the row before has left for memory; else 0
    int inverse() const { return lanes; }     ///< 1/k
    int is_one() const { return lanes + 1; }  ///< whether k is 1
    int rates() const { return lanes + 2; }
    /// Factors of order 1: 0 at k = 1, half of them at k = 2, so that the only term there is counted once.
    int ones() const { return rates() + width; }
    int size() const { return ones() + factors; }
};

struct SeriesCode {
    void (*first)(double t, const double* state, const double* par, double* fixed, double* given) = nullptr;
    void (*fix)(double* fixed) = nullptr;
    void (*next)(double k, const double* fixed, const double* given, double* next, double* rows,
                 double* out) = nullptr;
    GivenPlaces places;
    std::vector<int> place_of_factor = {};  ///< of each, in a row
    int fixed = 0;                          ///< numbers that stay fixed

    /// As alembert_series_table::series; `work` begins at a multiple of 64 bytes.
    void expand(double t, const double* state, const double* par, int order, double* out, double* work) const;
};

int workspace_of(const SeriesCode& code);

}  // namespace alembert
