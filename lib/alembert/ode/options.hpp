// SPDX-License-Identifier: MIT
#pragma once

/// What somebody wishes of an integration: its method, its length, how exact it is to be, where rows stand.
///
///     const Options options{.method = Method::dop853, .duration = 10, .tolerance = 1e-12};
///
/// What a system can do (derivatives, power series, a projection onto its constraints) stands in `System`
/// (system.hpp), and what the pieces of a run know of each other in `RunPiece` (run_piece.hpp). `check_options`
/// (integrate.hpp) says which values make no sense.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "alembert/ode/method.hpp"

namespace alembert {

/// Called with the start, then with the end of each accepted step (or with the event that ends the run in it).
using OnStep = std::function<void(double t, std::span<const double> state, std::span<const double> rate)>;

/// The time in which steps are counted: t, or one of its own that makes steps short where the potential is deep,
/// in the form for any system or in that for constant masses and forces of positions (time_transformation.hpp).
enum class Regularization { none, rescaled, canonical };

/// Changes of a run, by which a second run shows how large the errors of the first are.
struct Disturbed {
    std::uint64_t seed = 0;  ///< changes that are a few times as large as rounding (disturbance.hpp); 0: none
    double first_step = 1;   ///< a first step that is found automatically is multiplied by this
};

struct Options {
    Method method = Method::dop853;
    double start = 0;
    double duration = 0;      ///< counted from the start; 0 gives one row
    double tolerance = 1e-9;  ///< adaptive methods
    double step = 0;  ///< the step of methods with a fixed step, and of taylor if given; for the others the first
                      ///< step, found automatically if 0
    double longest_step = 0;  ///< for adaptive methods; 0 means no bound
    double sample = 0;        ///< time between rows; 0: duration/200
    /// The most evaluations of the right-hand side; no step is begun that could exceed it.
    long budget = 10'000'000;
    /// If stiffness is found to limit the steps of an explicit method (stiffness_watch.hpp), the run goes on with
    /// this method. It comes back where the explicit one would be stable with the same steps, or where the steps
    /// of the other turn out to cost more (cost_model.hpp).
    std::optional<Method> when_stiff = {};
    /// Where no step is short enough, as for a power series whose coefficients overflow or that is none at the
    /// start (sqrt(t) at t = 0), the run goes on with this method to its end. So it does where the series of a
    /// system with constraints needs steps of a twentieth of its longest though the motion is no faster. Where a
    /// linkage lies flat, pivots of its equations pass through zero: values beside that pose are still good, but
    /// the coefficients of a series lose all digits as it comes close.
    std::optional<Method> when_stuck = {};
    /// If the steps of an explicit method turn out to cost clearly more than those of a power series would
    /// (taylor_switch.hpp), the run goes on with this method, which must be taylor. It comes back where the steps
    /// of the series become very short, as above.
    std::optional<Method> when_cheaper = {};
    OnStep on_step = {};  ///< may be empty
    Regularization regularization = Regularization::none;
    Disturbed disturbed = {};
};

/// Seconds between rows.
inline double sample_interval(const Options& options) {
    return options.sample > 0 ? options.sample : options.duration / 200;
}

}  // namespace alembert
