// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A power series as two straight-line programs: what its order 0 takes, and what any further order takes.
///
///     const SeriesSteps steps = series_steps(recurrences(program));
///     steps.first;            // from t, state and par: the values that stay fixed, and the rates at order 0
///     steps.next;             // from the fixed values and what is given: coefficients of order k, t being k
///
/// The values that stay fixed are the parameters of `next`: what depends on them alone, such as the factors of
/// the linear system, is computed once for all orders.

#include "alembert/batch/pack_series.hpp"
#include "codegen/emit/function.hpp"
#include "codegen/emit/taylor.hpp"
#include "program/recurrence.hpp"

namespace alembert::machine {

struct SeriesSteps {
    Program at_zero, at_order;
    FunctionTask first;  ///< (t, state, par, fixed, given): given gets the rates
    FunctionTask next;   ///< (k, par, given, next, row, out): par are the fixed values
    GivenPlaces places;
    std::vector<int> place_of_factor = {};     ///< SeriesCode; none in packs
    int factors = 0;                           ///< different ones, of products
    std::vector<PackSeries::Product> pairs{};  ///< in packs: the products, by the numbers of their factors
    double products = 0;  ///< multiplications of eight lanes, divided by the square of the order
};

/// `in_packs`: for eight systems side by side (alembert/batch/pack_series.hpp). Throws ModelError if the mass
/// matrix is singular at every state.
SeriesSteps series_steps(const Recurrences& recurrences, bool in_packs = false);

/// What a function gives.
std::vector<int> nodes_of(const FunctionTask& task);

/// What a series takes by code in memory.
SeriesCost cost_in_memory(const SeriesSteps& steps);

}  // namespace alembert::machine
