// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/series_times.hpp"

#include <algorithm>

namespace alembert {

using Kind = SeriesNode::Kind;

namespace {

int coordinates_of(const Recurrences& r) {
    return static_cast<int>(r.program.coordinates.size());
}

/// The component of the state that a node represents; −1 if it is none.
int component_of(const Recurrences& r, const SeriesNode& x) {
    return x.kind == Kind::coordinate ? x.index : x.kind == Kind::speed ? coordinates_of(r) + x.index : -1;
}

}  // namespace

int rate_node(const Recurrences& r, int i) {
    const int n = coordinates_of(r), s = static_cast<int>(r.accelerations.size());
    if (i < n) return r.coordinate_rates.empty() ? n + i : r.coordinate_rates[i];
    return i < n + s ? r.accelerations[i - n] : r.work;
}

Times series_times(const Recurrences& r, const SeriesLanes& lanes, const std::map<int, ScheduledSum>& sums) {
    Times all;
    for (std::vector<double>& times : all) times.assign(r.nodes.size() + 1, 0);
    for (int order = 0; order < processor::orders_to_settle; ++order) {
        std::rotate(all.begin(), all.end() - 1, all.end());
        std::vector<double>& here = all[0];
        double solved = 0, stored = 0;
        for (int id = 0; id < static_cast<int>(r.nodes.size()); ++id) {
            const SeriesNode& x = r.nodes[id];
            if (const int state = component_of(r, x); state >= 0) {
                here[id] = all[1][rate_node(r, state)] + processor::step;
            } else if (x.kind == Kind::unknown) {
                here[id] = solved + processor::solved * static_cast<double>(r.unknowns.size());
            } else if (const auto sum = sums.find(id); sum != sums.end()) {
                here[id] = sum->second.ready(all);
            } else {
                double latest = 0;
                for (const int arg : arguments_of(x)) latest = std::max(latest, here[arg]);
                here[id] = latest + (lanes.is_packed(id) ? processor::packed : processor::step);
            }
            if (x.kind == Kind::residual) solved = std::max(solved, here[id]);
        }
        for (const SeriesLane& lane : lanes.lanes()) stored = std::max({stored, here[lane.a], here[lane.b]});
        here.back() = stored;  // a row is read as a whole, after the last of its lanes has been stored
    }
    return all;
}

}  // namespace alembert
