// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The contact modes of a scene. Each is derived, emitted, compiled and loaded when the motion first needs it. A
/// scene without unilateral constraints has only the mode {}.
///
///     LoadedModes modes(request, derived, start, first, Work::left_out, method, on_step);
///     const LoadedMode& lying = modes({0});
///     lying.contact.rhs(t, state, rate);

#include <map>
#include <memory>

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
#include "run/solver_code.hpp"

namespace alembert {

struct LoadedMode {
    Derived derived;  ///< with a mechanism in which the closed contacts are constraints
    Program program;
    std::optional<Program> running = {};  ///< set if it is not `program` whose functions run
    const Program& run() const { return running ? *running : program; }
    Operations operations = {};  ///< of one right-hand side
    SolverCode code;
    CodeKind kind = CodeKind::memory;
    Module module;
    std::vector<double> par;  ///< the parameters after `prepare`
    Projection projection;
    ContactMode contact;
    std::optional<int> jacobian_operations = {};  ///< set if it is emitted
    std::optional<Rhs> when_stiff = {};           ///< set after the motion was found stiff
    /// The largest size during the motion of each function whose sign is held constant.
    std::vector<double> side_sizes = {};
    double effort = 0;  ///< predicted time of all steps so far, ns
    /// Sets the signs in `par` to those at a state of the motion, or to given ones. To be called before anything
    /// is evaluated with `par`.
    void hold_sides(double t, const double* state);
    void hold(const std::vector<double>& sigma);
    /// Updates `side_sizes` from a motion.
    void measure_sides(const Trajectory& motion);
};

/// The program with the Jacobian of its right-hand side, if `method` solves equations with it and it is not too
/// long to be written out; otherwise the unchanged program. With `with_power`, the gradient of the power is added
/// too.
Program with_jacobian(Program program, Method method, bool with_power);

/// Whether rates may jump: the mechanism has contacts, or events with impulses.
bool has_jumps(const Mechanism& mechanism);

/// Contacts and events in the form that the runtime needs: gaps, rows and impulses by interpretation. The views
/// must outlive the result. Throws ModelError if the state has speeds with which motions with jumps are not
/// supported.
Contacts contacts_of(const Derived& derived, const Start& start, const ContactView& view, const KickView& kicks);

class LoadedModes {
public:
    /// The arguments must outlive this object; `start` is assembled, and `first` is the state there. `on_step`
    /// gets the mode of each step. For implicit methods the solvers are emitted with their Jacobian, unless that
    /// would take long to compile; for methods that change to an implicit one when the motion is stiff, the
    /// Jacobian is emitted at that time. For taylor the series is emitted.
    using OnModeStep =
        std::function<void(LoadedMode&, double t, std::span<const double> state, std::span<const double> rate)>;
    LoadedModes(const RunOptions& wishes, const Derived& derived, const Start& start, const State<double>& first,
                Work work, const MethodChoice& method, OnModeStep on_step);

    /// The mode with the contacts `closed`, in ascending order. Throws IntegrationError if there are no finite
    /// accelerations at the start, and what the stages throw.
    LoadedMode& operator()(const std::vector<int>& closed);

    /// Called with changes of the signs that a right-hand side holds constant, their names, and the frictions
    /// whose sliding velocities have these signs; may be empty.
    std::function<void(const SideChange&, const std::string& name, const std::vector<Switched::Rubbing>&)>
        on_side_change = {};

    /// Uses a given program for the mode {}.
    void take_free(Program program);

    /// The operations of one right-hand side, the largest number of all modes used so far.
    int operations() const;

    /// To be called before another run (Projection::forget).
    void forget();

    struct Seconds {
        double derive = 0, emit = 0, compile = 0;  ///< processor time
    };
    const Seconds& seconds() const { return seconds_; }

private:
    std::unique_ptr<LoadedMode> made(const std::vector<int>& closed);
    void hold_signs(LoadedMode& mode, const Switched& jumps, std::size_t events, const SeriesModule& series);
    Rhs with_jacobian(LoadedMode& mode);
    void count_step(LoadedMode& mode);

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
