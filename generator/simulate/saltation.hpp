// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Derivatives of a motion through an instant at which it, or its equations, jump.
///
///     const Saltation saltation(mechanism, switched, by);
///     const Saltation::Jump jump = saltation.jump(instant, parameters, before);
///     saltation.carry(jump, f_before, f_after, y);     // y: the state, then columns; both behind the instant
///
/// At the zero of h(t, y) the state becomes G(t, y). A column Φ of derivatives, by a parameter p of h, G and f
/// too, becomes
///
///     G_y (Φ + f⁻ δτ) + G_t δτ + G_p − f⁺ δτ,        δτ = −(h_y Φ + h_p)/(h_t + h_y f⁻),
///
/// because the zero comes later by δτ (the saltation matrix: Leine & Nijmeijer, Dynamics and Bifurcations of
/// Non-Smooth Mechanical Systems (2004), §7.3). G is
///
///  - of an event what it sets, and u + M⁻¹ Q̂ for an impulse Q̂,
///  - of an impact u − (1 + e) g' W gᵀ/(g W gᵀ), where g is the row of the gap, g' its rate and W = M⁻¹, or what
///    constraints leave of it,
///  - the state itself where f alone jumps, at the zero of a function whose sign f holds.

#include <memory>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "program/jet.hpp"
#include "program/switches.hpp"
#include "simulate/jump_instants.hpp"

namespace alembert {

class Saltation {
public:
    /// Of each column in `by` the position of its parameter, or −1; further columns are by values at the start.
    /// The mechanism's rates must be its speeds. `switched` may be null.
    Saltation(const Mechanism& mechanism, std::shared_ptr<const Switched> switched, std::vector<int> by);

    /// Why derivatives are not carried through what happens in this mechanism; empty if they are.
    static std::string obstacle(const Mechanism& mechanism);

    /// Whether an event changes the state.
    bool acts(int event) const {
        const Event& one = events_[static_cast<std::size_t>(event)];
        return !one.set.empty() || !one.impulse.empty();
    }

    struct At {
        double t;
        const std::vector<double>& parameters;  ///< with the sides, where there are some
    };
    /// h and the state after, with their derivatives by the state, then the time, then what the columns vary.
    struct Jump {
        Jet<double> value;
        std::vector<Jet<double>> after;
    };
    Jump jump(const JumpInstant& instant, const At& at, const std::vector<double>& before) const;
    /// h alone.
    Jet<double> value(const JumpInstant& instant, const At& at, const std::vector<double>& state) const;

    /// The rate of h along the motion.
    double speed(const Jet<double>& value, const std::vector<double>& f) const;
    /// The derivative of h by what a column varies, at a fixed time.
    double change(const Jet<double>& value, const double* column, std::size_t number) const;

    /// `y`: the state before, then the columns.
    void carry(const Jump& jump, const std::vector<double>& f_before, const std::vector<double>& f_after,
               std::vector<double>& y) const;

    /// What is passed where it comes to its zero: events that act, then contacts.
    std::vector<JumpInstant> watched() const;

private:
    struct Given {
        std::size_t component;  ///< of the state
        int node;
    };
    struct Event {
        std::string name;
        int when = 0;
        std::vector<Given> set = {}, impulse = {};  ///< components of impulses are those of coordinates
    };
    struct Contact {
        std::string name;
        int gap = 0, offset = 0, restitution = 0;
        std::vector<int> row = {};
    };
    std::vector<Jet<double>> values(const Program& program, const std::vector<int>& nodes, const At& at,
                                    const std::vector<double>& state) const;
    std::vector<Jet<double>> solved(const std::vector<Jet<double>>& values,
                                    std::vector<Jet<double>> impulse) const;
    void kick(const Event& event, const At& at, const std::vector<double>& before,
              std::vector<Jet<double>>& after) const;
    void strike(const Contact& contact, const At& at, const std::vector<double>& before,
                std::vector<Jet<double>>& after) const;
    std::vector<Jet<double>> varied(const std::vector<double>& state) const;
    int side_function(int index) const;

    Program program_;
    std::shared_ptr<const Switched> switched_;
    std::vector<int> by_;
    std::vector<Event> events_;
    std::vector<Contact> contacts_;
    std::vector<int> mass_, rows_;  ///< nodes: M row by row, and the rows of the constraints
    std::size_t coordinates_, constraints_, size_;
    std::size_t scene_events_;
};

}  // namespace alembert
