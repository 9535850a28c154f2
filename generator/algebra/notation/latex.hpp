// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A formula in LaTeX's math mode (amsmath): dots for time derivatives, Greek letters, indices.
///
///     (m_{1} + m_{2}) l_{1} \ddot{\theta}_{1} + m_{2} l_{2} \dot{\theta}_{2}^{2} \sin(\theta_{1} - \theta_{2})
///
/// Inputs are written as functions of time: F(t). The formula has no delimiters; put it into \[ … \] or an align
/// environment.

#include <string>

#include "algebra/notation/phrase.hpp"

namespace alembert {

std::string latex(const Phrase& phrase);

}  // namespace alembert
