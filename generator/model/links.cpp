// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/links.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace alembert {

using GiNaC::ex;

namespace {

bool is_zero(const Vector3& v) {
    return v[0].is_zero() && v[1].is_zero() && v[2].is_zero();
}

bool same(const Vector3& a, const Vector3& b) {
    return a[0].is_equal(b[0]) && a[1].is_equal(b[1]) && a[2].is_equal(b[2]);
}

/// Steps along the axes of one frame, by what moves them.
struct Steps {
    std::map<std::vector<int>, Vector3> by;  ///< by the coordinates that move it
    Vector3 prescribed{0, 0, 0}, constant{0, 0, 0};

    bool empty() const { return by.empty() && is_zero(prescribed) && is_zero(constant); }
};

/// A position: steps by frame, away from a point that is not taken apart.
struct Sum {
    int root = 0;
    std::map<int, Steps> by_frame;
};

void add(Vector3& to, const Vector3& step) {
    for (int k = 0; k < 3; ++k) to[k] = (to[k] + step[k]).expand();
}

class Links {
public:
    Links(const Mechanism& m, TurningFrames turns) : m_(m), frames_(m, turns) {}

    std::optional<Skeleton> find() {
        for (const MassElement& body : m_.masses) points_.insert(body.point);
        for (const int point : points_) sums_.emplace(point, sum_of(point));
        if (!found_) return std::nullopt;
        count();
        skeleton_ = m_.skeleton;
        for (const int point : points_)
            if (point != sums_.at(point).root) place(point);
        skeleton_.frames = frames_.all();
        return skeleton_;
    }

private:
    /// The position of a point; the point itself as root if its last step cannot be taken apart.
    const Sum& sum_of(int point) {
        if (const auto known = known_.find(point); known != known_.end()) return known->second;
        const Skeleton::Step& step = m_.skeleton.points[point];
        const std::optional<std::map<int, Steps>> own = point == 0 ? std::nullopt : taken_apart(step);
        if (!own) return known_[point] = {point, {}};
        Sum sum = sum_of(step.from);
        for (const auto& [frame, steps] : *own) {
            Steps& whole = sum.by_frame[frame];
            for (const auto& [by, way] : steps.by) {
                add(whole.by[by], way);
                if (is_zero(whole.by[by])) whole.by.erase(by);
            }
            add(whole.prescribed, steps.prescribed);
            add(whole.constant, steps.constant);
            if (whole.empty()) sum.by_frame.erase(frame);
        }
        return known_[point] = std::move(sum);
    }

    std::optional<std::map<int, Steps>> taken_apart(const Skeleton::Step& step) {
        const std::optional<std::vector<StepFrames::Piece>> pieces = frames_.taken_apart(step);
        if (!pieces) return std::nullopt;
        std::map<int, Steps> result;
        for (const StepFrames::Piece& piece : *pieces) {
            found_ = found_ || !piece.by.empty() || piece.frame != step.frame;
            Steps& steps = result[piece.frame];
            add(!piece.by.empty()  ? steps.by[piece.by]
                : piece.prescribed ? steps.prescribed
                                   : steps.constant,
                piece.offset);
        }
        return result;
    }

    /// How many points have a step in each frame or in one that it carries, and how many one that the same
    /// coordinates move in a frame.
    void count() {
        for (const auto& [point, sum] : sums_) {
            std::set<int> carried;
            for (const auto& [frame, steps] : sum.by_frame) {
                for (int f = frame; f != 0; f = frames_.all()[f].parent) carried.insert(f);
                for (const auto& [by, way] : steps.by) ++slides_[{frame, by}];
            }
            for (const int f : carried) ++uses_[f];
        }
    }

    void place(int point) {
        const Sum& sum = sums_.at(point);
        std::vector<int> order;
        for (const auto& [frame, steps] : sum.by_frame) order.push_back(frame);
        const auto rank = [&](int frame) {
            int depth = 0;
            for (int f = frame; f != 0; f = frames_.all()[f].parent) ++depth;
            return std::make_tuple(frame == 0 ? 0 : 1, -uses_[frame], depth, frame);
        };
        std::sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
        int at = sum.root, in = 0;
        for (const int frame : order) {
            const Steps& steps = sum.by_frame.at(frame);
            in = frame;
            if (!is_zero(steps.prescribed)) at = stepped(at, frame, steps.prescribed);
            std::vector<std::pair<int, std::vector<int>>> slides;  // −uses, coordinates
            for (const auto& [by, way] : steps.by) slides.emplace_back(-slides_[{frame, by}], by);
            std::sort(slides.begin(), slides.end());
            for (const auto& [uses, by] : slides) at = stepped(at, frame, steps.by.at(by));
            if (!is_zero(steps.constant)) at = stepped(at, frame, steps.constant);
        }
        skeleton_.points[point] = {.from = at, .frame = in};
    }

    int stepped(int from, int frame, const Vector3& offset) {
        for (const int next : next_[from])
            if (skeleton_.points[next].frame == frame && same(skeleton_.points[next].offset, offset)) return next;
        skeleton_.points.push_back({from, frame, offset});
        next_[from].push_back(static_cast<int>(skeleton_.points.size()) - 1);
        return next_[from].back();
    }

    const Mechanism& m_;
    StepFrames frames_;
    Skeleton skeleton_;
    bool found_ = false;  // whether a position was more than a constant step
    std::set<int> points_;
    std::map<int, Sum> known_, sums_;
    std::map<int, int> uses_;  // by frame
    std::map<std::pair<int, std::vector<int>>, int> slides_;
    std::map<int, std::vector<int>> next_;
};

}  // namespace

std::optional<Skeleton> with_links(const Mechanism& m, TurningFrames turns) {
    return Links(m, turns).find();
}

}  // namespace alembert
