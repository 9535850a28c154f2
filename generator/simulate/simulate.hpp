// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `simulate`: a scene's motion, with measurements of its accuracy.
///
///     const Scene scene = read_scene("scenes/textbook/double_pendulum.toml");
///     const Run run = simulate(scene, {.duration = 10, .tolerance = 1e-12});
///     run.final_coordinates[0];          // in the scene's unit, at run.motion.final_time()
///     *run.estimate->value;              // the estimated error
///     run.distrust_reasons.empty();      // nothing speaks against trusting it
///
/// The scene is derived, turned into code (solver_code.hpp) and integrated; contact modes
/// are treated in this way when the motion first reaches them.

#include <optional>

#include "alembert/hybrid/hybrid_motion.hpp"
#include "simulate/charts.hpp"
#include "simulate/estimate.hpp"
#include "simulate/jump_instants.hpp"
#include "simulate/options.hpp"
#include "simulate/rows.hpp"
#include "simulate/sensitivity.hpp"
#include "simulate/solver_code.hpp"

namespace alembert {

/// The balance of the energy.
struct EnergyAccount {
    bool conserved = true;  ///< whether E = T + V is conserved; otherwise E − E₀ is compared with the work
    bool jacobi_conserved = false;  ///< whether T₂ − T₀ + V is conserved while E is not
    double drift = 0;    ///< max |E − E₀| / max(|E₀|, the largest kinetic energy), if E is conserved
    double balance = 0;  ///< the same for E − E₀ − W, if E is not conserved
    double jacobi_drift = 0;
    double impact_loss = 0, impulse_work = 0;
    std::optional<double> set_change = {};  ///< of E by states that events have set; nothing if none has moved it
};

/// Processor time of each stage, in seconds.
struct Timings {
    double derive = 0, emit = 0, compile = 0, integrate = 0, estimate = 0;
};

/// The solver that was made for the run.
struct Solver {
    std::string formulation;  ///< formalism and form, for people
    int operations = 0;       ///< operations of one right-hand side, the largest number of all contact modes
    std::optional<int> jacobian_operations;  ///< set if the Jacobian is emitted
    CodeKind code = CodeKind::memory;        ///< that of the mode in which the run began
    bool from_cache = false;
};

struct Run : Derived {
    HybridMotion motion = {};
    std::string why_method = {};  ///< the reason in words; empty if the method was given
    Solver solver = {};
    std::vector<std::string> coordinates = {}, speeds = {};  ///< names; speeds only if the scene has its own
    std::vector<double> final_coordinates = {}, final_rates = {}, final_speeds = {};
    MotionTable event_rows =
        {};  ///< a row for each event of `motion`, if any event of the scene records something
    std::vector<double> final_states = {};   ///< of the scene's first-order states, in the order of the scene
    std::vector<std::string> contacts = {};  ///< names of all unilateral constraints
    /// A change of a sign in the right-hand side: of |x|, min, max, sign, or of the piece of a table at a knot.
    struct Side {
        double time;
        std::string name;
        ModeChange::Kind kind;
        bool is_knot;
    };
    std::vector<Side> side_changes = {};
    JumpInstants instants = {};  ///< what derivatives have to know of all this
    /// A contact with dry friction begins to stick or to slip, or slips the other way.
    struct FrictionChange {
        double time;
        int friction;  ///< position in Mechanism::frictions
        int side;      ///< the sign of the slip, 0 if it sticks; 1 if it begins to slide in a plane
        std::array<double, 2> direction = {0, 0};  ///< in this case, a unit vector
    };
    std::vector<FrictionChange> friction_changes = {};
    /// The frame whose angles came near gimbal lock, and when a quaternion took their place (charts.hpp).
    std::string chart_frame = {};
    std::vector<ChartPass> chart_passes = {};
    bool is_regularized = false;  ///< steps were those of a time of its own
    EnergyAccount energy = {};
    double constraint_drift = 0;  ///< the largest residual
    std::optional<ErrorEstimate> estimate = {};
    std::vector<std::string> distrust_reasons = {};  ///< reasons why the result should not be trusted
    /// The values that were moved at the start so that the constraints hold.
    std::vector<std::string> adjusted = {};
    std::optional<Sensitivity> sensitivity = {};  ///< if it was requested, and the motion did not fail
    MotionTable rows = {};
    Timings timings = {};
    /// The reason why the motion ended early, in terms of the scene. The results until then are kept.
    std::optional<std::string> failure = {};

    bool is_constrained() const { return !mechanism.constraints.empty() || !contacts.empty(); }
};

/// Throws what `derived` throws; std::invalid_argument for numbers that no option can be; ModelError for a method
/// that the scene does not allow; IntegrationError if there are no finite accelerations at the start; CompileError
/// if a compiler is needed and there is none. A motion that ends early later on is a Run with a `failure`.
Run simulate(Scene scene, const RunOptions& wishes = {});

}  // namespace alembert
