// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The contact modes of a scene, each derived and made into code (solver_code.hpp) when a motion first needs it.
/// They hold no numbers of a motion, so that any number of motions share them (simulate/loaded_modes.hpp), on
/// several threads.
///
///     CompiledModes compiled(wishes, derived, Work::left_out, method);
///     const CompiledMode& lying = compiled({0}, first);
///
/// Expressions and exact numbers serve one thread at a time: whoever touches them while motions run on other
/// threads holds the lock `symbols`. Making a mode or its Jacobian takes it; all else is for one thread, before
/// the motions or after them.

#include <map>
#include <memory>
#include <mutex>

#include "alembert/native/module.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/series.hpp"
#include "analysis/derive/derived.hpp"
#include "program/event_code.hpp"
#include "program/quotient_signs.hpp"
#include "program/switches.hpp"
#include "simulate/corners.hpp"
#include "simulate/faster_code.hpp"
#include "simulate/method.hpp"
#include "simulate/solver_code.hpp"

namespace alembert {

struct CompiledMode {
    Derived derived;  ///< with a mechanism in which the closed contacts are constraints
    Program program;
    std::optional<Switched> jumps;                ///< where signs are held constant
    std::vector<std::string> sides;               ///< the names of these signs
    std::shared_ptr<const Corners> corners = {};  ///< null if there are none
    std::optional<Program> running = {};          ///< set if it is not `program` whose functions run
    const Program& run() const { return running ? *running : program; }
    SolverCode code;
    CodeKind kind = CodeKind::memory;
    Operations operations = {};  ///< of one right-hand side
    CodeOfSeries series = {};    ///< for taylor, or for a run that may go over to it
    bool was_asked_for_series = false;
    std::optional<Module> canonical = {};              ///< for rattle
    std::optional<int> jacobian_operations = {};       ///< set if it is emitted
    double effort = 0;                                 ///< of a right-hand side (effort_of)
    std::shared_ptr<const EventCode> event_code = {};  ///< of the events of `run`
    std::shared_ptr<const EventCode> place_code = {};  ///< QuickPlaces::code
    bool was_asked_for_jacobian = false;
    std::optional<Module> with_jacobian = {};  ///< after the motion was found stiff; nothing where it is too long
};

/// The program with the Jacobian of its right-hand side, if `method` solves equations with it and it is not too
/// long to be written out; otherwise the unchanged program. With `with_power`, the gradient of the power is added
/// too.
Program with_jacobian(Program program, Method method, bool with_power);

class CompiledModes {
public:
    /// The arguments must outlive this object. For implicit methods the solvers are emitted with their Jacobian,
    /// unless that would take long to compile; for methods that change to an implicit one when the motion is
    /// stiff, the Jacobian is emitted at that time. For taylor the series is made too.
    CompiledModes(const RunOptions& wishes, const Derived& derived, Work work, const MethodChoice& method);

    /// The mode with the contacts `closed`, in ascending order. Throws IntegrationError if the mass matrix is
    /// singular at every state (`first` is where it is looked at), and what the stages throw. The reference stays
    /// valid.
    const CompiledMode& operator()(const std::vector<int>& closed, const State<double>& first);

    /// The mode's solver with its Jacobian; null if that is too long to be written out.
    const Module* jacobian_of(const CompiledMode& mode);

    /// The mode's power series, made when it is first asked for; null if it has none that is short.
    SeriesModule series_of(const CompiledMode& mode);

    /// What runs: the right-hand side, or its power series.
    enum class Part { solver, series };
    /// Whether code in memory may be replaced by compiled code: not where several threads share it.
    bool may_go_over(const CompiledMode& mode, Part part) const;
    /// Compiles that part of the mode's code, which takes the place of that in memory if it is the faster one at
    /// that place. Without a compiler, the code in memory stays.
    void go_over(const CompiledMode& mode, Part part, const TimedPlace& place);

    /// Uses a given program for the mode {}.
    void take_free(Program program);

    /// The operations of one right-hand side, the largest number of all modes used so far.
    int operations() const;

    struct Seconds {
        double derive = 0, emit = 0, compile = 0;  ///< processor time
    };
    const Seconds& seconds() const { return seconds_; }

    const MethodChoice& method() const { return method_; }
    Work work() const { return work_; }

    std::recursive_mutex symbols;
    bool is_shared = false;  ///< by several threads

private:
    std::unique_ptr<CompiledMode> made(const std::vector<int>& closed, const State<double>& first);
    CompiledMode& own(const CompiledMode& mode);

    const RunOptions& wishes_;
    const Derived& derived_;
    Work work_;
    const MethodChoice& method_;
    bool may_go_over_;  ///< not with momenta, where few call the right-hand side
    std::optional<Program> free_;
    std::map<std::vector<int>, std::unique_ptr<CompiledMode>> made_;
    Seconds seconds_;
};

}  // namespace alembert
