// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Measures integrators of other libraries on the same emitted function. A separate program (`alembert-peers`,
/// tools/peers), which is built with those of SUNDIALS, GSL and Boost.odeint that CMake found, loads the same
/// object file.
///
///     const Peers peers = measure_peers({.object = object, …});
///     peers.runs;                       // as Measured, `who` being "cvode", "gsl", …
///     peers.missing;                    // why there are none
///
/// It is a separate process, so that these libraries are not linked into alembert and a crash in them does not
/// affect it.

#include <filesystem>

#include "simulate/measure.hpp"

namespace alembert {

struct Peers {
    std::vector<Measured> runs;
    std::string missing;  ///< empty if the program ran
};

struct PeerRequest {
    std::filesystem::path object;
    std::vector<double> parameters, initial;
    double start = 0, duration = 0;
    std::vector<double> tolerances;
    double most_seconds = 2;  ///< for one run
};

/// `judge` computes the error of coordinates and rates at the end.
Peers measure_peers(const PeerRequest& request,
                    const std::function<double(const std::vector<double>& state)>& judge);

}  // namespace alembert
