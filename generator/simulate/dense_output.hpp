// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The states of a motion between its rows: dense output after the run.
///
///     const Run run = simulate(scene, wishes);
///     DenseOutput motion(run, wishes);
///     motion.state_at(1.234, state);        // coordinates, then speeds
///
/// A row is a state of the motion itself. From the last one before t the equations of the contact mode are
/// integrated to t, with the tolerance of the run: no contact begins or ends between two rows of one phase. The
/// result at t does not depend on which other times are asked for.

#include <memory>
#include <span>

#include "simulate/simulate.hpp"

namespace alembert {

class DenseOutput {
public:
    /// `run` must outlive this object; `wishes` are those of the run. Compiled solvers come from the cache.
    DenseOutput(const Run& run, const RunOptions& wishes);
    ~DenseOutput();

    int dimension() const;  ///< number of coordinates and speeds
    double first_time() const;
    double last_time() const;

    /// Writes coordinates, then speeds (the rates where the scene has no others). If rates jump at t, the state is
    /// the one after. Throws std::invalid_argument for a time outside the motion, and IntegrationError if there
    /// is no step.
    void state_at(double t, std::span<double> state) const;

private:
    struct Parts;
    const Run& run_;
    std::unique_ptr<Parts> parts_;
};

}  // namespace alembert
