// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The contact modes of a scene, each derived, emitted, compiled and loaded when the motion first asks for it. A
/// scene without unilateral constraints has the one mode {}.
///
///     LoadedModes modes(request, derived, start, first, Work::left_out, method, on_step);
///     const LoadedMode& lying = modes({0});
///     lying.contact.rhs(t, state, rate);

#include <map>
#include <memory>

#include "alembert/compile.hpp"
#include "alembert/module.hpp"
#include "alembert/phases.hpp"
#include "alembert/project.hpp"
#include "alembert/series.hpp"
#include "contact/contacts.hpp"
#include "contact/kicks.hpp"
#include "derive/derived.hpp"
#include "emit/emit.hpp"
#include "program/switches.hpp"
#include "run/method.hpp"

namespace alembert {

struct LoadedMode {
    Derived derived;  ///< its mechanism has the closed contacts as constraints
    Program program;
    Source source;
    Module module;
    std::vector<double> par;  ///< prepared
    Projection projection;
    ContactMode contact;
    bool from_cache = false;
    std::optional<int> jacobian_operations = {};  ///< where it is emitted
    std::optional<Rhs> when_stiff = {};           ///< once the motion was found stiff
    /// The largest size on the way of each function whose sign is held.
    std::vector<double> side_sizes = {};
    /// Before anything is evaluated with `par`: sets it to the signs at a state of the motion, or to those given.
    void hold_sides(double t, const double* state);
    void hold(const std::vector<double>& sigma);
    /// Lets `side_sizes` know a motion.
    void measure_sides(const Trajectory& motion);
};

/// The same program with the Jacobian of its right-hand side where `method` is one that solves equations with it,
/// and it is not too long to be written out; else as it is. `with_power`: of the power too.
Program with_jacobian(Program program, Method method, bool with_power);

/// What makes rates jump: contacts, and events with impulses.
bool has_jumps(const Mechanism& mechanism);

/// These as the runtime asks for them: gaps, rows and impulses by interpretation. The views must outlive them.
/// Throws ModelError where the state has speeds that the motion with jumps is not followed in.
Contacts contacts_of(const Derived& derived, const Start& start, const ContactView& view, const KickView& kicks);

class LoadedModes {
public:
    /// What it is given must outlive it; `start` is assembled, `first` the state there. `on_step` is told the mode
    /// of each step. Implicit methods have the solvers emitted with their Jacobian, unless it would take long to
    /// compile; those that turn to one where the motion is stiff have it emitted then. taylor has the series
    /// emitted.
    using OnModeStep =
        std::function<void(LoadedMode&, double t, std::span<const double> state, std::span<const double> rate)>;
    LoadedModes(const RunOptions& wishes, const Derived& derived, const Start& start, const State<double>& first,
                Work work, const MethodChoice& method, OnModeStep on_step);

    /// `closed` ascending. Throws IntegrationError where there are no finite accelerations at the start, and what
    /// the stages throw.
    LoadedMode& operator()(const std::vector<int>& closed);

    /// Told what happens to the signs that a right-hand side holds, their names, and the frictions whose sliding
    /// velocities have them; may be empty.
    std::function<void(const SideChange&, const std::string& name, const std::vector<Switched::Rubbing>&)>
        on_side_change = {};

    /// Takes the program of the mode {} from one who has it.
    void take_free(Program program);

    /// Of one right-hand side: the largest of the modes that have been asked for.
    int operations() const;

    /// Before another run (Projection::forget).
    void forget();

    struct Seconds {
        double derive = 0, emit = 0, compile = 0;  ///< processor time
    };
    const Seconds& seconds() const { return seconds_; }

private:
    std::unique_ptr<LoadedMode> made(const std::vector<int>& closed);
    void hold_signs(LoadedMode& mode, const Switched& jumps, std::size_t events, const SeriesModule& series);
    Rhs with_jacobian(LoadedMode& mode);
    CompileOptions options_of_compiler() const;

    const RunOptions& wishes_;
    const Derived& derived_;
    const Start& start_;
    const State<double>& first_;
    Work work_;
    const MethodChoice& method_;
    OnModeStep on_step_;
    std::optional<Program> free_;
    std::map<std::vector<int>, std::unique_ptr<LoadedMode>> loaded_;
    Seconds seconds_;
};

}  // namespace alembert
