// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/proved_motion.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/language/say.hpp"
#include "proof/interval_matrix.hpp"
#include "proof/interval_of.hpp"
#include "proof/interval_series.hpp"

namespace alembert {

namespace {

using Box = std::vector<Interval>;

double width_of(const Interval& x) {
    return x.high - x.low;
}

bool is_within(const Interval& inner, const Interval& outer) {
    return outer.low < inner.low && inner.high < outer.high;
}

/// The decimals that round to it, or nearly so.
Interval around(double x) {
    return {std::nextafter(x, -HUGE_VAL), std::nextafter(x, HUGE_VAL)};
}

/// Σ c_k s^k for k from `last` down to 0.
template <typename Coefficient>
Interval horner(const Coefficient& c, int last, const Interval& s) {
    Interval sum = c(last);
    for (int k = last - 1; k >= 0; --k) sum = sum * s + c(k);
    return sum;
}

class Proving {
    static constexpr double local_error = 1e-16;  // that a step may add, as a part of max(1, |y|)

public:
    Proving(const Program& program, const IntervalStart& start, const ProofOptions& options)
        : options_(options), series_(recurrences(program), start.parameters), n_(series_.size()) {
        for (const Interval& y : start.state) {
            middle_.push_back(middle_of(y));
            rest_.push_back(y - Interval{middle_.back(), middle_.back()});
        }
        turn_.assign(n_ * n_, 0);
        size_.assign(n_, 0);
        for (std::size_t i = 0; i < n_; ++i) turn_[i * n_ + i] = 1;
        t_ = begin_ = middle_of(start.t);
        end_ = middle_of(start.end);
        exact_begin_ = start.t;
        exact_end_ = start.end;
        result_.rows.push_back({t_, box()});
    }

    ProvedMotion run() {
        next_row_ = options_.sample > 0 ? 1 : 0;
        while (t_ < end_) {
            if (options_.progress) options_.progress((t_ - begin_) / (end_ - begin_));
            if (++result_.steps > options_.most_steps)
                return given_up(say("{} steps were not enough", options_.most_steps));
            if (!step()) return given_up(say("no box around the next step could be proved"));
            const Box now = box();
            for (const Interval& x : now)
                if (!(width_of(x) <= options_.widest * std::max(1.0, x.size())))
                    return given_up(say("the box has become too wide to go on"));
        }
        result_.reached = t_;
        result_.complete = true;
        return std::move(result_);
    }

private:
    ProvedMotion given_up(std::string why) {
        result_.reached = t_;
        result_.why = std::move(why);
        const Box last = box();
        const bool is_bounded =
            std::all_of(last.begin(), last.end(), [](const Interval& x) { return std::isfinite(x.size()); });
        if (result_.rows.back().t < t_ && is_bounded) result_.rows.push_back({t_, last});
        return std::move(result_);
    }

    /// turn · rest
    Box deviation() const {
        Box result(n_);
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j)
                result[i] = result[i] + Interval{turn_[i * n_ + j], turn_[i * n_ + j]} * rest_[j];
        return result;
    }
    Box box() const {
        Box result = deviation();
        for (std::size_t i = 0; i < n_; ++i) result[i] = result[i] + Interval{middle_[i], middle_[i]};
        return result;
    }

    /// The length for which the last terms are lost in rounding.
    double length(const IntervalSeries& at_middle) const {
        const int p = options_.order;
        double h = end_ - begin_;
        for (const int k : {p - 1, p})
            for (std::size_t i = 0; i < n_; ++i) {
                const double c = at_middle.coefficient(i, k).size(), y = std::max(1.0, std::abs(middle_[i]));
                if (c > 0) h = std::min(h, std::pow(local_error * y / c, 1.0 / k));
            }
        return h;
    }

    /// The length for which the remainder, which holds in the whole of a longer step, is lost in rounding.
    double of_remainder(const Box& remainder) const {
        double h = end_ - begin_;
        for (std::size_t i = 0; i < n_; ++i)
            if (const double width = width_of(remainder[i]); width > 0)
                h = std::min(
                    h, std::pow(local_error * std::max(1.0, std::abs(middle_[i])) / width, 1.0 / options_.order));
        return h;
    }

    /// Where a step of this length ends: none is left over that is shorter than rounding errors of the times.
    double step_end(double h) const { return 1.001 * h < end_ - t_ ? t_ + h : end_; }

    bool step() {
        const int p = options_.order;
        const Interval t = t_ == begin_ ? exact_begin_ : Interval{t_, t_};
        Box here = box();  // and the middle, which the mean value theorem needs with it
        for (std::size_t i = 0; i < n_; ++i) here[i] = hull(here[i], {middle_[i], middle_[i]});
        Box point;
        for (const double y : middle_) point.push_back({y, y});
        series_.from(t, point, {.order = p, .with_slopes = false});
        const double h = length(series_);
        std::vector<Interval> at_point;
        for (std::size_t i = 0; i < n_; ++i)
            for (int k = 0; k < p; ++k) at_point.push_back(series_.coefficient(i, k));
        series_.from(t, here, {.order = p - 1, .with_slopes = true});
        std::vector<Interval> over_box, slopes;
        for (std::size_t i = 0; i < n_; ++i)
            for (int k = 0; k < p; ++k) {
                over_box.push_back(series_.coefficient(i, k));
                for (std::size_t j = 0; j < n_; ++j) slopes.push_back(series_.slope(i, k, j));
            }
        Box remainder;
        constexpr int most_halvings = 60;
        double until = step_end(h);
        for (int halvings = 1; !proves(t, over_box, until, remainder); ++halvings) {
            until = step_end(std::ldexp(h, -halvings));
            if (halvings > most_halvings || !(until > t_)) return false;
        }
        until = std::min(until, t_ + of_remainder(remainder));
        if (!(until > t_)) return false;
        const auto point_at = [&](std::size_t i, const Interval& s) {
            return horner([&](int k) { return k < p ? at_point[i * p + k] : remainder[i]; }, p, s);
        };
        const auto slope_at = [&](std::size_t i, std::size_t j, const Interval& s) {
            return horner([&](int k) { return slopes[(i * p + k) * n_ + j]; }, p - 1, s);
        };
        add_rows(until, t, point_at, slope_at);
        const Interval s = Interval{until, until} - t;
        Box change;  // from the middle, which is a number: little is lost in rounding
        std::vector<Interval> jacobian;
        for (std::size_t i = 0; i < n_; ++i) {
            change.push_back(
                s * horner([&](int k) { return k + 1 < p ? at_point[i * p + k + 1] : remainder[i]; }, p - 1, s));
            for (std::size_t j = 0; j < n_; ++j) jacobian.push_back(slope_at(i, j, s));
        }
        move_by(change, jacobian);
        t_ = until;
        return true;
    }

    /// Whether the motions that start in the box stay for the step in one over which `remainder` holds the last
    /// coefficient.
    bool proves(const Interval& t, const std::vector<Interval>& over_box, double until, Box& remainder) {
        const int p = options_.order;
        // The decimals of rows may lie behind their numbers, and that of the end before the start of a short
        // motion.
        const Interval last = until < end_ ? around(until) : hull(around(until), exact_end_);
        const Interval s = hull({0, 0}, last - t);
        const auto with = [&](std::size_t i, const Interval& last) {
            return horner([&](int k) { return k < p ? over_box[i * p + k] : last; }, p, s);
        };
        Box whole;
        for (std::size_t i = 0; i < n_; ++i) {
            const Interval known = with(i, {});
            const double more = 1e-15 * std::max(1.0, known.size()) + 0.01 * width_of(known);
            whole.push_back(known + Interval{-more, more});
        }
        constexpr int most_rounds = 4;
        for (int round = 0; round < most_rounds; ++round) {
            series_.from(t + s, whole, {.order = p, .with_slopes = false});
            remainder.clear();
            bool holds = true;
            for (std::size_t i = 0; i < n_; ++i) {
                remainder.push_back(series_.coefficient(i, p));
                const Interval found = with(i, remainder[i]);
                if (!std::isfinite(found.size())) return false;
                if (is_within(found, whole[i])) continue;
                holds = false;
                const double more = 0.1 * width_of(found) + 1e-15 * std::max(1.0, found.size());
                whole[i] = hull(whole[i], found + Interval{-more, more});
            }
            if (holds) return true;
        }
        return false;
    }

    template <typename Point, typename Slope>
    void add_rows(double until, const Interval& t, const Point& point_at, const Slope& slope_at) {
        const Box rest = deviation();
        const auto add = [&](double at, const Interval& exact) {
            const Interval s = exact - t;
            ProvedRow row{.t = at, .box = {}};
            for (std::size_t i = 0; i < n_; ++i) {
                Interval value = point_at(i, s);
                for (std::size_t j = 0; j < n_; ++j) value = value + slope_at(i, j, s) * rest[j];
                row.box.push_back(value);
            }
            result_.rows.push_back(std::move(row));
        };
        while (options_.sample > 0) {
            const double at = begin_ + static_cast<double>(next_row_) * options_.sample;
            if (!(at <= until) || at >= end_) break;
            add(at, around(at));
            ++next_row_;
        }
        if (until >= end_) add(end_, hull(exact_end_, {end_, end_}));
    }

    /// y = middle + change + J (turn rest): the new middle, and what is left in the coordinates of a new
    /// orthogonal matrix.
    void move_by(const Box& change, const std::vector<Interval>& jacobian) {
        const auto size = static_cast<Eigen::Index>(n_);
        std::vector<Interval> product(n_ * n_);
        Eigen::MatrixXd middle(size, size);
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j) {
                for (std::size_t k = 0; k < n_; ++k)
                    product[i * n_ + j] = product[i * n_ + j] +
                                          jacobian[i * n_ + k] * Interval{turn_[k * n_ + j], turn_[k * n_ + j]};
                middle(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                    middle_of(product[i * n_ + j]);
            }
        std::vector<double> scale(n_, 1);  // of each component, so that large ones do not wrap the others
        for (std::size_t i = 0; i < n_; ++i) {
            size_[i] = std::max({size_[i], std::abs(middle_[i]), change[i].size()});
            if (std::isfinite(size_[i])) scale[i] = std::max(1.0, size_[i]);
            middle.row(static_cast<Eigen::Index>(i)) /= scale[i];
        }
        std::vector<Eigen::Index> order(n_);  // the longest edges of the box first
        std::iota(order.begin(), order.end(), 0);
        const auto edge = [&](Eigen::Index j) {
            return middle.col(j).norm() * width_of(rest_[static_cast<std::size_t>(j)]);
        };
        std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return edge(a) > edge(b); });
        Eigen::MatrixXd sorted(size, size);
        for (Eigen::Index j = 0; j < size; ++j) sorted.col(j) = middle.col(order[static_cast<std::size_t>(j)]);
        const Eigen::MatrixXd Q = sorted.householderQr().householderQ();
        std::vector<Interval> turned(n_ * n_);
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j) {
                const double q = scale[i] * Q(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                turn_[i * n_ + j] = q;
                turned[i * n_ + j] = {q, q};
            }
        const std::vector<Interval> back = inverse_of(turned, n_);
        Box off(n_), rest(n_);
        for (std::size_t i = 0; i < n_; ++i) {
            const double before = middle_[i];
            middle_[i] = before + middle_of(change[i]);
            off[i] = change[i] + (Interval{before, before} - Interval{middle_[i], middle_[i]});
        }
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j) {
                rest[i] = rest[i] + back[i * n_ + j] * off[j];
                Interval carried;
                for (std::size_t k = 0; k < n_; ++k) carried = carried + back[i * n_ + k] * product[k * n_ + j];
                rest[i] = rest[i] + carried * rest_[j];
            }
        rest_ = std::move(rest);
    }

    const ProofOptions& options_;
    IntervalSeries series_;
    std::size_t n_;
    double t_ = 0, begin_ = 0, end_ = 0;
    Interval exact_begin_, exact_end_;
    long next_row_ = 0;
    std::vector<double> middle_, turn_, size_;  ///< the size: the largest of each component so far
    Box rest_;
    ProvedMotion result_;
};

}  // namespace

ProvedMotion proved_motion(const Program& program, const IntervalStart& start, const ProofOptions& options) {
    return Proving(program, start, options).run();
}

}  // namespace alembert
