// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Derivatives of a motion through an event that sets states or rates.
///
///     const Saltation saltation(mechanism, by);
///     saltation.pass(event, t, f, y);           // y: the state, then columns of derivatives; both behind the event
///
/// At the zero of h(t, y) the state becomes G(t, y). A column Φ of derivatives, by a parameter p of h, G and f
/// too, becomes
///
///     G_y (Φ + f⁻ δτ) + G_t δτ + G_p − f⁺ δτ,        δτ = −(h_y Φ + h_p)/(h_t + h_y f⁻),
///
/// because the event happens later by δτ (the saltation matrix: Leine & Nijmeijer, Dynamics and Bifurcations of
/// Non-Smooth Mechanical Systems (2004), §7.3).

#include <functional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "program/jet.hpp"

namespace alembert {

class Saltation {
public:
    /// Of each column in `by` the position of its parameter, or −1. The mechanism's rates must be its speeds.
    Saltation(const Mechanism& mechanism, std::vector<int> by);

    /// Why derivatives are not carried through the events of this mechanism; empty if they are.
    static std::string obstacle(const Mechanism& mechanism);

    bool acts(int event) const { return !set_[static_cast<std::size_t>(event)].empty(); }

    struct Moment {
        int event;
        double t;
        const std::vector<double>& parameters;
    };
    /// `rate` gives f at a state. Throws IntegrationError where the event is grazed.
    void pass(const Moment& at, const std::function<std::vector<double>(const std::vector<double>&)>& rate,
              std::vector<double>& y) const;

private:
    struct Given {
        std::size_t component;  ///< of the state
        int node;
    };
    std::vector<Jet<double>> values(const Moment& at, const std::vector<double>& y) const;

    Program program_;
    std::vector<int> by_, when_;
    std::vector<std::vector<Given>> set_;
    std::vector<std::string> names_;
    std::size_t coordinates_, size_;
};

}  // namespace alembert
