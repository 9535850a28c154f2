// SPDX-License-Identifier: MIT
// Right-hand sides of one coordinate as one writes them by hand, for rhs.cpp: a function for each scene of that
// name in systems/, with the scene's numbers, compiled as an emitted file is. What does not change is worked out
// beforehand, by the compiler.
#include <cmath>

/// θ″ = −(g/l) sin θ
extern "C" void pendulum(double, const double* state, double* rate) {
    constexpr double l = 0.8, g = 9.81;
    rate[0] = state[1];
    rate[1] = -(g / l) * std::sin(state[0]);
}

/// x″ = (F cos ωt − k x − c x′)/m
extern "C" void oscillator(double t, const double* state, double* rate) {
    constexpr double m = 2, c = 0.3, k = 50, F = 4, w = 3;
    rate[0] = state[1];
    rate[1] = (1 / m) * (F * std::cos(w * t) - k * state[0] - c * state[1]);
}

/// x″ = −(k x + h x³ + c x′)/m
extern "C" void spring(double, const double* state, double* rate) {
    constexpr double m = 2, c = 0.3, k = 50, h = 7;
    const double x = state[0], v = state[1];
    rate[0] = v;
    rate[1] = -(1 / m) * (x * (k + h * x * x) + c * v);
}
