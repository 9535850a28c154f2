// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `bench`: speed and error of every method over a range of tolerances, compared with a reference of
/// higher precision.
///
///     const Bench measured = bench(read_scene("scenes/benchmark/pleiades.toml"), {.wishes = {.duration = 3}});
///     measured.runs[0].error, measured.runs[0].seconds;

#include "analysis/derive/derived.hpp"
#include "simulate/measure.hpp"
#include "simulate/options.hpp"
#include "simulate/reference.hpp"

namespace alembert {

struct BenchOptions {
    RunOptions wishes = {};         ///< if these name a method, only that one is measured
    bool peers = false;             ///< whether to measure integrators of other libraries too
    double most_seconds = 2;        ///< of one run; after such a run a method is not run with stricter tolerances
    double reference_seconds = 30;  ///< processor time for each of the reference's methods
};

/// The reference with which runs are compared.
struct Judgement {
    std::vector<double> final;  ///< coordinates, then rates
    int digits = 0;
    std::string by;
};

struct Bench : Derived {
    std::optional<Reference> exact = {};  ///< in quadruple precision, if that was reached
    Judgement reference = {};
    std::vector<std::string> coordinates = {}, speeds = {};
    std::string formulation = {};
    int operations = 0;  ///< operations of one right-hand side
    double end = 0;      ///< time of the end, s
    std::vector<Measured> runs = {};
};

/// Throws what `derived` throws; ModelError for a method that is not measured; IntegrationError if no method
/// reaches the end.
Bench bench(Scene scene, const BenchOptions& options = {});

}  // namespace alembert
