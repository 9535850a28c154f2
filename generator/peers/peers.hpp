// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What each of the peers is given and gives back. One function for each library, absent where CMake did not find
/// it.

#include <functional>
#include <string>
#include <vector>

#include "alembert/rhs.hpp"

namespace alembert::peers {

struct Task {
    const Rhs& rhs;
    const std::vector<double>& initial;
    double start = 0, end = 0, tolerance = 1e-9;
    long budget = 10'000'000;  ///< evaluations
};

struct Answer {
    bool failed = false;
    std::vector<double> state;
    long evaluations = 0, steps = 0;
};

struct Peer {
    std::string who, method;
    std::function<Answer(const Task&)> solve;
};

std::vector<Peer> sundials();
std::vector<Peer> gsl();
std::vector<Peer> odeint();

}  // namespace alembert::peers
