// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Views of stability over parameters (stability/chart.hpp, stability/locus.hpp) and of Lyapunov exponents.

#include "present/report/json.hpp"
#include "stability/exponents.hpp"
#include "stability/locus.hpp"

namespace alembert {

Json as_json(const StabilityChart& chart);
std::string as_text(const StabilityChart& chart);
/// A row for each node, then for each point of the boundaries: part ("node", "boundary 1" …), both parameters,
/// kind, and how far the worst root lies beyond the axis or circle.
std::string as_csv(const StabilityChart& chart);
std::string as_svg(const StabilityChart& chart);

Json as_json(const RootLocus& locus);
std::string as_text(const RootLocus& locus);
/// A row for each value: the parameter, then re_1, im_1, re_2 …
std::string as_csv(const RootLocus& locus);
/// The complex plane, a line for each root; crossings of the axis or unit circle are marked.
std::string as_svg(const RootLocus& locus);

Json as_json(const LyapunovExponents& found);
std::string as_text(const LyapunovExponents& found);
/// A row for each time: t, then the estimates.
std::string as_csv(const LyapunovExponents& found);

}  // namespace alembert
