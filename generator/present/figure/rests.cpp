// SPDX-License-Identifier: GPL-2.0-or-later
/// The floor and the wall of a ladder: a contact's gap, or a constraint, is how far an end of a bar is from them.
#include <algorithm>
#include <cmath>

#include "present/figure/parts.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;

struct BarEnd {
    int spot, track;
    int middle;  ///< the track of the bar's mass centre
};

std::vector<BarEnd> ends_of_bars(const Sketch& s) {
    std::vector<BarEnd> ends;
    for (const FigureElement& e : s.elements)
        if (e.kind == FigureElement::Kind::bar && e.owner >= 0)
            for (const int end : {e.points[0], e.points[1]})
                ends.push_back({end, s.track_of(end), s.free_track[static_cast<std::size_t>(e.owner)]});
    return ends;
}

/// Does something of the scene stand at this end, such as the slider of a crank?
bool is_taken(const Sketch& s, const BarEnd& end) {
    return std::any_of(s.sites.begin(), s.sites.end(), [&](const Sketch::Site& site) {
        return site.of != Sketch::Site::Of::origin &&
               (s.at(0, site.track) - s.at(0, end.track)).norm() <= 1e-6 * s.scale;
    });
}

/// Adds the line that the end touches, if the value is its height over it.
bool add_rest(Sketch& s, const BarEnd& end, int value, bool is_gap, const std::string& name) {
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == s.normal) continue;
        const auto line = s.shifted([&](int state) { return s.at(state, value)[0]; },
                                    [&](int state) { return s.at(state, end.track)[axis]; });
        if (!line || std::abs(std::abs(line->first) - 1) > 1e-6) continue;
        const Vector3d foot = Vector3d::Unit(axis) * (-line->second / line->first);
        const bool is_above = is_gap ? line->first > 0 : s.at(0, end.middle)[axis] > foot[axis];
        const Vector3d out = Vector3d::Unit(axis) * (is_above ? 1 : -1);
        const int origin = s.place("O"), other = 3 - axis - s.normal;
        s.add({.kind = FigureElement::Kind::floor,
               .points = {s.spot(origin, -1, foot), s.spot(origin, -1, foot + Vector3d::Unit(other)),
                          s.spot(origin, -1, foot + out), end.spot},
               .label = name});
        return true;
    }
    return false;
}

}  // namespace

void add_rests(Sketch& s, const Asked& asked) {
    if (!s.is_plane || asked.gaps.size() + asked.constraints.size() == 0) return;
    const std::vector<BarEnd> ends = ends_of_bars(s);
    if (ends.empty()) return;
    s.sample();  // the ends are newer than the sample
    const auto is_drawn = [&](const std::string& name) {
        return std::any_of(s.elements.begin(), s.elements.end(), [&](const FigureElement& e) {
            return e.kind == FigureElement::Kind::floor && e.label == name;
        });
    };
    const auto add = [&](int value, bool is_gap, const std::string& name) {
        if (value < 0 || is_drawn(name)) return;
        for (const BarEnd& end : ends)
            if (!is_taken(s, end) && add_rest(s, end, value, is_gap, name)) return;
    };
    for (std::size_t k = 0; k < asked.gaps.size(); ++k) add(asked.gaps[k], true, s.m.unilateral[k].gap.name);
    for (std::size_t k = 0; k < asked.constraints.size(); ++k)
        if (!s.m.constraints[k].joint && !s.m.constraints[k].norm)
            add(asked.constraints[k], false, s.m.constraints[k].name);
}

}  // namespace alembert
