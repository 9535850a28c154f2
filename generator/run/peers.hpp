// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Other people's integrators on the same emitted function, by a program of its own (`alembert-peers`,
/// generator/peers), which is built with what CMake found of SUNDIALS, GSL and Boost.odeint and loads the same
/// object file.
///
///     const Peers peers = measure_peers({.object = object, …});
///     peers.runs;                       // as Measured, `who` being "cvode", "gsl", …
///     peers.missing;                    // why there are none
///
/// A process of its own: nothing of theirs is linked into alembert, and a crash of theirs stays theirs.

#include <filesystem>

#include "run/measure.hpp"

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
    double most_seconds = 2;  ///< of one run
};

/// `judge` gives the error of coordinates and rates at the end.
Peers measure_peers(const PeerRequest& request,
                    const std::function<double(const std::vector<double>& state)>& judge);

}  // namespace alembert
