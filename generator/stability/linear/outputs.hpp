// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The scene's outputs near an undisturbed motion: δy = (by) (δr, δw, δt, δinputs).
///
///     const OutputProgram outputs(mechanism, equations, residuals);
///     outputs.by(residuals, instant, here)
///
/// An output may contain accelerations and multipliers. These follow from the state and the inputs, and their
/// derivatives enter those of the output. If the speeds are not the rates of coordinates, outputs that contain
/// accelerations are left out.

#include "stability/linear/tangent.hpp"

namespace alembert {

/// A program of the outputs in q, u, t, inputs, accelerations and multipliers.
class OutputProgram {
public:
    OutputProgram(const Mechanism& mechanism, const Equations& equations, const Residuals& residuals);

    const std::vector<std::string>& names() const { return names_; }
    const std::vector<std::string>& left_out() const { return left_out_; }

    /// Rows: outputs; columns: those of the tangent.
    template <typename Real>
    MatrixOf<Real> by(const Residuals& residuals, const Instant<Real>& at, const Tangent<Real>& here) const;

private:
    Program program_;
    std::vector<int> nodes_;
    int first_multiplier_ = 0;
    std::vector<std::string> names_, left_out_;
};

}  // namespace alembert
