// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/figure_view.hpp"

#include <algorithm>
#include <cmath>

namespace alembert {

namespace {

using Eigen::Vector3d;
using Element = FigureElement::Kind;

constexpr double margin = 58;  // space for labels and hatching, in units of the screen

class ViewFinder {
public:
    ViewFinder(const Drawing& drawing, const std::vector<Pose>& poses) : d_(drawing), poses_(poses) {}

    FigureView view() {
        choose_view();
        fit();
        return std::move(v_);
    }

private:
    void choose_view() {
        v_.is_plane = d_.is_plane;
        Vector3d up = -d_.down;
        if (d_.is_plane) {
            int axis = d_.normal == 2 ? 1 : 2;
            double sign = 1;
            for (int k = 0; k < 3; ++k)
                if (k != d_.normal && std::abs(up[k]) > 0.7) {
                    axis = k;
                    sign = up[k] > 0 ? 1 : -1;
                }
            const int other = 3 - axis - d_.normal;
            v_.up = sign * Vector3d::Unit(axis);
            v_.right = Vector3d::Unit(other);
            v_.toward = v_.right.cross(v_.up);
            return;
        }
        int axis = 2;
        for (int k = 0; k < 3; ++k)
            if (std::abs(up[k]) > 0.7) axis = k;
        const Vector3d vertical = up[axis] < 0 ? Vector3d(-Vector3d::Unit(axis)) : Vector3d(Vector3d::Unit(axis));
        const Vector3d first = Vector3d::Unit((axis + 1) % 3), second = vertical.cross(first);
        const double azimuth = -0.9, elevation = 0.35;
        const Vector3d out = std::cos(azimuth) * first + std::sin(azimuth) * second;
        v_.right = -std::sin(azimuth) * first + std::cos(azimuth) * second;
        v_.up = -std::sin(elevation) * out + std::cos(elevation) * vertical;
        v_.toward = std::cos(elevation) * out + std::sin(elevation) * vertical;
    }

    /// The points that must be inside the picture; without those that only show how far away something is.
    std::vector<int> shown(bool with_lengths) const {
        std::vector<int> points;
        for (const FigureElement& e : d_.elements) {
            if (e.kind == Element::length) {
                if (!with_lengths) continue;
                points.insert(points.end(), e.points.begin(), e.points.begin() + 2);
                continue;
            }
            const bool first_alone = e.kind == Element::block || e.kind == Element::force ||
                                     e.kind == Element::impulse || e.kind == Element::torque;
            if (e.kind == Element::gravity || e.kind == Element::axes || e.kind == Element::angle ||
                e.kind == Element::guide || e.kind == Element::wall || e.kind == Element::ground_plane)
                continue;
            if (e.kind == Element::floor) {
                if (with_lengths) points.push_back(e.points[3]);
                continue;
            }
            points.insert(points.end(), e.points.begin(), first_alone ? e.points.begin() + 1 : e.points.end());
        }
        return points;
    }

    Vector3d middle(const Pose& pose) const {
        Vector3d sum = Vector3d::Zero();
        for (const int k : v_.followed) sum += pose[k];
        return v_.followed.empty() ? sum : Vector3d(sum / static_cast<double>(v_.followed.size()));
    }

    struct Extent {
        Vector3d low = Vector3d::Constant(1e300), high = Vector3d::Constant(-1e300);
        void hold(const Vector3d& p) {
            if (!p.allFinite()) return;
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        Vector3d size() const { return (high - low).cwiseMax(0); }
    };

    Extent extent_of(const Pose& pose, const std::vector<int>& points, const Vector3d& origin) const {
        Extent extent;
        for (const int k : points) {
            const Vector3d p = pose[k] - origin;
            extent.hold({p.dot(v_.right), p.dot(v_.up), p.dot(v_.toward)});
        }
        for (const FigureElement& e : d_.elements)
            if (e.kind == Element::ring || e.kind == Element::ball || e.kind == Element::hoop ||
                e.kind == Element::pulley || e.kind == Element::ellipsoid) {
                const Vector3d p = pose[e.points[0]] - origin;
                const Vector3d c(p.dot(v_.right), p.dot(v_.up), p.dot(v_.toward));
                double size = e.size;
                for (std::size_t k = 1; k < e.points.size(); ++k)
                    size = std::max(size, (pose[e.points[k]] - pose[e.points[0]]).norm());
                extent.hold(c + Vector3d::Constant(size));
                extent.hold(c - Vector3d::Constant(size));
            }
        return extent;
    }

    void fit() {
        std::vector<int> points = shown(true);
        const std::vector<int> near = shown(false);
        Extent whole;
        double own = 0;
        for (const Pose& pose : poses_) {
            const Extent here = extent_of(pose, points, Vector3d::Zero());
            whole.hold(here.low);
            whole.hold(here.high);
            own = std::max(own, extent_of(pose, near, Vector3d::Zero()).size().norm());
        }
        const bool has_floor = std::any_of(d_.elements.begin(), d_.elements.end(), [](const FigureElement& e) {
            return e.kind == Element::floor && e.size == 0;
        });
        v_.followed = d_.traced;
        if (poses_.size() > 1 && own > 0 && !v_.followed.empty() && whole.size().norm() > 4 * own && !has_floor) {
            v_.follows = true;
            points = near;
            whole = {};
            for (const Pose& pose : poses_) {
                const Extent here = extent_of(pose, points, middle(pose));
                whole.hold(here.low);
                whole.hold(here.high);
            }
        }
        Vector3d size = whole.size();
        if (!(size.norm() > 0)) size = Vector3d::Constant(1);
        Vector3d centre = (whole.low + whole.high) / 2;
        if (!centre.allFinite()) centre.setZero();
        if (!v_.is_plane) {
            const double half = size.norm() / 2;
            v_.height = 360;
            v_.scale = (v_.height / 2 - margin / 2) / half;
        } else {
            v_.height = std::clamp(v_.width * (size[1] + 1e-9) / (size[0] + 1e-9), 230.0, 400.0);
            v_.scale = std::min((v_.width - 2 * margin) / std::max(size[0], 1e-9),
                                (v_.height - 2 * margin) / std::max(size[1], 1e-9));
            v_.scale = std::min(v_.scale, 0.6 * v_.width / size.norm());
        }
        v_.centre = centre[0] * v_.right + centre[1] * v_.up + centre[2] * v_.toward;
    }

    const Drawing& d_;
    const std::vector<Pose>& poses_;
    FigureView v_;
};

}  // namespace

FigureView figure_view(const Drawing& drawing, const std::vector<Pose>& poses) {
    return ViewFinder(drawing, poses).view();
}

}  // namespace alembert
