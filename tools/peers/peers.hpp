// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The input and the result of each peer. There is one function for each library that CMake found.

#include <functional>
#include <string>
#include <vector>

#include "alembert/ode/rhs.hpp"

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
std::vector<Peer> hairer();

}  // namespace alembert::peers
