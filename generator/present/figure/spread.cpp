// SPDX-License-Identifier: GPL-2.0-or-later
/// Treats masses that all move on one line: a chain of oscillators whose coordinates count from their positions at
/// rest, or the weights on a pulley.
#include <algorithm>
#include <cmath>

#include "present/figure/parts.hpp"

#include "base/language/say.hpp"

namespace alembert {

namespace {

using Eigen::Vector3d;
using Kind = FigureElement::Kind;

/// The direction of the line on which all masses are at all states.
std::optional<Vector3d> one_line(const Sketch& s) {
    std::optional<Vector3d> along;
    const Vector3d first = s.at(0, s.free_track[0]);
    for (int state = 0; state < Sketch::states; ++state)
        for (const int track : s.free_track) {
            const Vector3d way = s.at(state, track) - first;
            if (!(way.norm() > 1e-9 * s.scale)) continue;
            if (!along)
                along = way.normalized();
            else if (way.cross(*along).norm() > 1e-9 * s.scale)
                return {};
        }
    return along;
}

class Chain {
public:
    Chain(Sketch& sketch, const Vector3d& along) : s_(sketch), along_(along) {
        double reach = 0;
        for (const int track : s_.free_track)
            for (int state = 0; state < Sketch::states; ++state)
                reach = std::max(reach, std::abs(s_.at(state, track).dot(along_)));
        space_ = 5 * std::max(reach, 1e-9);
        if (s_.down.norm() > 0 && std::abs(along_.dot(s_.down)) > 0.99)
            along_ = s_.down;  // they hang
        else if (along_.sum() < 0)
            along_ = -along_;
        for (std::size_t k = 0; k < s_.free_track.size(); ++k)
            s_.displaced.emplace_back(s_.free_track[k], (static_cast<double>(k) + 1) * space_ * along_);
    }

    /// Adds an element from a wall to a mass, or between two masses. False if the expression is neither.
    bool add(Kind kind, int value, const std::string& label) {
        const auto ends = masses_of(value);
        if (!ends) return false;
        int from = 0, to = s_.spot(s_.free_track[ends->second]);
        if (ends->first < 0) {
            const bool right = ends->second > 0 && ends->second + 1 == static_cast<int>(s_.free_track.size());
            const double place = right ? static_cast<double>(s_.free_track.size()) + 1 : 0;
            from = s_.spot(s_.place("O"), -1, place * space_ * along_);
            s_.add({.kind = Kind::wall,
                    .points = {from, s_.spot(s_.place("O"), -1, (place + (right ? -1 : 1)) * space_ * along_)}});
        } else {
            from = s_.spot(s_.free_track[ends->first]);
        }
        s_.add({.kind = kind, .points = {from, to}, .label = label});
        return true;
    }

private:
    /// The two masses whose distance is this value up to a constant; −1 is the wall.
    std::optional<std::pair<int, int>> masses_of(int value) const {
        const auto place = [&](int mass, int state) {
            return mass < 0 ? 0.0 : s_.at(state, s_.free_track[mass]).dot(along_);
        };
        const int count = static_cast<int>(s_.free_track.size());
        for (int a = -1; a < count; ++a)
            for (int b = a + 1; b < count; ++b) {
                const auto line = s_.shifted([&](int state) { return s_.at(state, value)[0]; },
                                             [&](int state) { return place(b, state) - place(a, state); });
                if (line && std::abs(std::abs(line->first) - 1) < 1e-6) return std::pair(a, b);
            }
        return {};
    }

    Sketch& s_;
    Vector3d along_;
    double space_ = 1;
};

}  // namespace

void spread(Sketch& s, Asked& asked) {
    if (!s.is_plane || s.free_track.empty() || !s.bodies.empty() || !s.scene.joints.empty()) return;
    const std::optional<Vector3d> along = one_line(s);
    if (!along) return;
    const auto is_a_chain = [&](const std::vector<Link>& links) {
        return std::all_of(links.begin(), links.end(), [](const Link& link) { return !link.between; });
    };
    const bool is_chain = !s.scene.springs.empty() && is_a_chain(s.scene.springs) && is_a_chain(s.scene.dampers);
    if (std::abs(along->dot(s.down)) > 0.99 && !is_chain) {
        if (s.free_track.size() < 2) return;
        const Vector3d beside = along->cross(Vector3d::Unit(s.normal)).cwiseAbs();
        const double space = 0.5 * std::max(s.scale, 1e-9);
        for (std::size_t k = 0; k < s.free_track.size(); ++k)
            s.displaced.emplace_back(s.free_track[k], static_cast<double>(k) * space * beside);
        s.notes.emplace_back(say("All masses move on one line; they are drawn side by side."));
        return;
    }
    if (!is_chain) return;
    Chain chain(s, *along);
    const auto add = [&](const std::vector<Link>& links, std::vector<int>& values, Kind kind) {
        for (std::size_t k = 0; k < links.size(); ++k)
            if (chain.add(kind, values[k], links[k].constant.text.size() <= 8 ? links[k].constant.text : ""))
                values[k] = -2;
    };
    add(s.scene.springs, asked.spring_along, Kind::spring);
    add(s.scene.dampers, asked.damper_along, Kind::damper);
    s.notes.emplace_back(
        say("The coordinates count from the places at rest; these are drawn apart, not to scale."));
}

}  // namespace alembert
