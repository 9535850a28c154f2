// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The contact modes of a scene with the numbers of one motion. A scene without unilateral constraints has only
/// the mode {}.
///
///     CompiledModes compiled(wishes, derived, Work::left_out, method);
///     LoadedModes modes(compiled, start, first, on_step);
///     const LoadedMode& lying = modes({0});
///     lying.contact.system.rhs(t, state, rate);

#include <map>
#include <memory>

#include "alembert/hybrid/hybrid_motion.hpp"
#include "alembert/ode/projection.hpp"
#include "simulate/compiled_modes.hpp"

namespace alembert {

struct LoadedMode {
    const CompiledMode& compiled;
    const Derived& derived;  ///< these are its own
    const Program& program;
    Module module;
    std::vector<double> par;  ///< the parameters after `prepare`
    Projection projection;
    ContactMode contact;
    std::optional<Rhs> when_stiff = {};  ///< set after the motion was found stiff
    /// The largest size during the motion of each function whose sign is held constant.
    std::vector<double> side_sizes = {};
    bool has_signs_in_rows = false;  ///< whether constraints hold signs that the run holds
    /// Whether `par` has the signs of the piece of motion that runs. If not, those at the state are taken when it
    /// is brought to the constraints.
    bool sides_are_known = false;
    std::optional<State<double>> last = {};   ///< at the end of the step before, where corners are looked for
    Method running = Method::dop853;          ///< what integrates at present
    double effort = 0, effort_of_series = 0;  ///< predicted time of all steps so far without and with series, ns
    /// Sets the signs in `par` to those at a state of the motion, or to given ones. To be called before anything
    /// is evaluated with `par`.
    void hold_sides(double t, const double* state);
    void hold(const std::vector<double>& sigma);
    /// The rates at a state, on whatever sides it is. Events that are evaluated then are those of this state too.
    void rates_on_sides(double t, const double* state, double* rate);
    /// Updates `side_sizes` from a motion.
    void measure_sides(const Trajectory& motion);
};

class LoadedModes {
public:
    /// The arguments must outlive this object; `start` is assembled, and `first` is the state there. `on_step`
    /// gets the mode of each step.
    using OnModeStep =
        std::function<void(LoadedMode&, double t, std::span<const double> state, std::span<const double> rate)>;
    LoadedModes(CompiledModes& compiled, const Start& start, const State<double>& first, OnModeStep on_step);

    /// The mode with the contacts `closed`, in ascending order. Throws IntegrationError if there are no finite
    /// accelerations at the start, and what the stages throw.
    LoadedMode& operator()(const std::vector<int>& closed);

    /// A change of a sign that a right-hand side holds constant.
    struct SideChange {
        const ModeChange& change;
        const std::string& name;
        bool is_knot;                                     ///< the function is a table at one of its knots
        const std::vector<Switched::Rubbing>& frictions;  ///< whose sliding velocities have this sign
    };
    std::function<void(const SideChange&)> on_side_change = {};  ///< may be empty
    /// Called with the sides, other than sliding ones, on which the functions are where a phase begins; may be
    /// empty.
    std::function<void(const ModeChange&, const std::vector<Switched::Rubbing>&)> on_side_begin = {};

    /// At these times the steps in all modes have to be shorter.
    void shorten_steps(const std::vector<InputTimeScale>& quick_times);

    /// To be called before another run from the first state or near it (Projection::begin).
    void begin();

    CompiledModes& compiled() { return compiled_; }

private:
    std::unique_ptr<LoadedMode> bound(const std::vector<int>& closed);
    void begin_in(LoadedMode& mode) const;
    void hold_signs(LoadedMode& mode, std::size_t events);
    Rhs with_jacobian(LoadedMode& mode);
    Rhs with_series(LoadedMode& mode);
    void count_step(LoadedMode& mode, double t, std::span<const double> state);
    State<double> state_of(const LoadedMode& mode, double t, const double* y, const double* rate) const;
    std::function<std::optional<std::string>(int, double, const double*, const double*)> obstacle_of(
        const LoadedMode& mode) const;
    void look_for_corner(LoadedMode& mode, double t, const double* y, const double* rate) const;

    CompiledModes& compiled_;
    const Start& start_;
    const State<double>& first_;
    OnModeStep on_step_;
    std::vector<InputTimeScale> quick_times_ = {};
    std::map<std::vector<int>, std::unique_ptr<LoadedMode>> loaded_;
};

}  // namespace alembert
