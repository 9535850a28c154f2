// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// When each Taylor coefficient is ready, order after order, so that sums can take what is late last.

#include <map>

#include "emit/scheduled_sum.hpp"
#include "emit/series_lanes.hpp"

namespace alembert {

/// The node of the rate of component i of the state: of q, then of u, then of the power's integral.
int rate_node(const Recurrences& recurrences, int i);

/// Cycles, of each node and then of a row of lanes; `sums` are those of nodes that stand alone, where sums have
/// edges.
Times series_times(const Recurrences& recurrences, const SeriesLanes& lanes,
                   const std::map<int, ScheduledSum>& sums);

}  // namespace alembert
