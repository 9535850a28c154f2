// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/angles_along.hpp"

#include <algorithm>
#include <vector>

namespace alembert {

namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

/// The rotation between two times, as a function of s from 0 to 1 (Hermite's polynomial of degree 5).
class TurnBetween {
public:
    TurnBetween(const Turning& a, const Turning& b) {
        const double h = b.t - a.t;
        c_[0] = a.e;
        c_[1] = h * a.rate;
        c_[2] = h * h / 2 * a.acceleration;
        const Vector4d value = b.e - c_[0] - c_[1] - c_[2], slope = h * b.rate - c_[1] - 2 * c_[2],
                       bend = h * h * b.acceleration - 2 * c_[2];
        c_[3] = 10 * value - 4 * slope + bend / 2;
        c_[4] = -15 * value + 7 * slope - bend;
        c_[5] = 6 * value - 3 * slope + bend / 2;
    }

    Vector4d at(double s) const {
        Vector4d e = c_[5];
        for (int k = 4; k >= 0; --k) e = s * e + c_[k];
        return e.normalized();
    }

private:
    Vector4d c_[6];
};

Eigen::Quaterniond quaternion_of(const Vector4d& e) {
    return {e[0], e[1], e[2], e[3]};
}

/// Finds points between which neither the rotation nor the direction of the lock changes by much.
class Points {
public:
    Points(const AnglesOfFrame& of, const TurnBetween& between, double through)
        : of_(of), between_(between), through_(through) {
        const Point first = at(0), last = at(1);
        beside_ = refine(first, last);
    }

    /// False where the motion goes through the lock.
    bool are_beside() const { return beside_; }
    const std::vector<Vector4d>& list() const { return list_; }

private:
    struct Point {
        double s;
        Vector4d e;
        Eigen::Vector2d from_lock;
    };

    Point at(double s) const {
        const Vector4d e = between_.at(s);
        return {s, e, of_.from_lock(quaternion_of(e))};
    }

    /// Appends points up to b; false where they come nearer than `through`.
    bool refine(const Point& a, const Point& b) {
        constexpr double cosine_of_half_turned = 0.9;  // turned by 0.9 rad
        constexpr double shortest = 1e-12;
        const double nearest = std::min(a.from_lock.norm(), b.from_lock.norm());
        if (nearest < through_) return false;
        // Turned by at most 29 degrees, and at least half as far from the lock as at its ends.
        if ((b.from_lock - a.from_lock).norm() <= nearest / 2 && std::abs(a.e.dot(b.e)) >= cosine_of_half_turned) {
            list_.push_back(b.e);
            return true;
        }
        if (b.s - a.s < shortest) return false;
        const Point middle = at((a.s + b.s) / 2);
        return refine(a, middle) && refine(middle, b);
    }

    const AnglesOfFrame& of_;
    const TurnBetween& between_;
    double through_;
    bool beside_ = false;
    std::vector<Vector4d> list_;
};

}  // namespace

void AnglesAlong::go_to(const Turning& next) {
    const TurnBetween between(last_, next);
    const Points points(of_, between, through_);
    if (of_.from_lock(quaternion_of(next.e)).norm() < through_)
        angles_ = angles_in_lock(of_, quaternion_of(next.e), angles_);
    else if (points.are_beside())
        for (const Vector4d& e : points.list()) angles_ = angles_on_side(of_, quaternion_of(e), angles_);
    else
        angles_ = angles_near(of_, quaternion_of(next.e), angles_);
    last_ = next;
}

}  // namespace alembert
