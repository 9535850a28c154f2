// SPDX-License-Identifier: MIT
#pragma once

/// Runge-Kutta-Nyström methods as formulas, for a state (q, v) with q' = v and accelerations a(t, q) that do not
/// depend on rates.
///
///     FormulaStepper<Nystrom<rkn1210_tableau>> step(rhs, t, state, tolerance);
///
/// The caller must know that a system is of this kind, because a right-hand side does not show it;
/// std::invalid_argument is thrown for a state that is not (q, v). For the same error these methods take several
/// times fewer evaluations than those for first-order systems.
///
/// Within a step the motion is the polynomial that has the position, rate and acceleration of its two ends and of
/// one place between them, or two for order 12. These are found by steps of rkn86, a half or a third as long as
/// the whole one, when the step is looked into.
///
/// The rate of a quadrature may depend on rates of the motion, which stages do not know. It is integrated by
/// Gauss's rule of order 12, at states that are found by shorter steps, as are all states within a step then.
/// `auto` does not take these methods for such systems.

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "alembert/ode/formula_stepper.hpp"
#include "alembert/ode/nystrom_stages.hpp"
#include "alembert/ode/nystrom_tableau.hpp"

namespace alembert {

/// Places and weights on [0, 1] (Abramowitz & Stegun, table 25.4).
inline constexpr std::array<std::pair<double, double>, 6> gauss_rule = {
    {{0.03376524289842399, 0.0856622461895852},
     {0.16939530676686776, 0.1803807865240693},
     {0.38069040695840156, 0.2339569672863455},
     {0.61930959304159844, 0.2339569672863455},
     {0.83060469323313224, 0.1803807865240693},
     {0.96623475710157601, 0.0856622461895852}}};

template <const auto& tableau>
class Nystrom {
public:
    static constexpr bool has_fixed_step = false;
    static constexpr bool predicts_length = true;
    static constexpr int estimate_order = tableau.estimate_order;
    static constexpr Between between = Between::own;

    /// The tolerance is for methods that solve equations in a step.
    explicit Nystrom(const Ends& ends, double /*tolerance*/ = 0)
        : n_(ends.controlled / 2), size_(ends.size), whole_(n_, size_), part_(n_, size_) {
        need_coordinates_and_rates(ends, "rkn86 and rkn1210", "verner98 or dop853");
    }

    int most_evaluations() const {
        return tableau.stages - 1 + (has_quadratures() ? static_cast<int>(gauss_rule.size()) * tableau.stages : 0);
    }

    bool increment(Ends& ends, double h, double* change, double* end_rate) {
        looked_into_ = false;
        change_in(ends, h, change);
        std::copy_n(whole_.error(), n_, ends.error.begin());
        std::copy_n(whole_.rate_error(), n_, ends.error.begin() + n_);
        if (has_quadratures()) {
            integrate_quadratures(ends, h, change);
        } else if constexpr (tableau.ends_with_rate) {
            for (int i = 0; i < n_; ++i)
                end_rate[i] = ends.y[at(n_ + i)] + (change[n_ + i] + ends.rest[at(n_ + i)]);
            std::copy_n(whole_.last_accelerations(), n_, end_rate + n_);
            ends.knows_end_rate = true;
        }
        return true;
    }

    void interpolate(Ends& ends, double theta, double* out) {
        if (has_quadratures()) {
            change_in(ends, theta * ends.h, out);
            integrate_quadratures(ends, theta * ends.h, out);
        } else {
            if (!looked_into_) look_into(ends);
            for (int i = 0; i < n_; ++i) {
                const Conditions& newton = differences_[at(i)];
                double value = 0, slope = 0;
                for (int k = conditions - 1; k >= 0; --k) {
                    const double apart = theta - place(k);
                    slope = slope * apart + value;
                    value = value * apart + newton[at(k)];
                }
                out[i] = value;
                out[n_ + i] = slope / ends.h - ends.y[at(n_ + i)] - ends.rest[at(n_ + i)];
            }
        }
        for (int i = 0; i < size_; ++i) out[i] = ends.y[at(i)] + (out[i] + ends.rest[at(i)]);
    }

private:
    static constexpr int parts = tableau.order > 8 ? 3 : 2;  ///< of a step that is looked into
    static constexpr int conditions = 3 * (parts + 1);
    using Conditions = std::array<double, conditions>;

    static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }
    /// Of condition k: three stand at each place.
    static constexpr double place(int k) { return static_cast<double>(k / 3) / parts; }

    bool has_quadratures() const { return size_ > 2 * n_; }

    /// Of positions and rates, those of quadratures being 0.
    void change_in(Ends& ends, double h, double* change) {
        whole_.reach(ends,
                     {.t = ends.t,
                      .q = ends.y.data(),
                      .v = ends.y.data() + n_,
                      .a = ends.rate.data() + n_,
                      .rest = ends.rest.data()},
                     h);
        std::copy_n(whole_.change(), n_, change);
        std::copy_n(whole_.rate_change(), n_, change + n_);
        std::fill(change + 2 * n_, change + size_, 0.0);
    }

    void integrate_quadratures(Ends& ends, double h, double* change) {
        std::vector<double> state(at(size_)), rate(at(size_));
        for (const auto& [theta, weight] : gauss_rule) {
            change_in(ends, theta * h, state.data());
            for (int i = 0; i < size_; ++i) state[at(i)] = ends.y[at(i)] + (state[at(i)] + ends.rest[at(i)]);
            ends.evaluate(ends.t + theta * h, state.data(), rate.data());
            for (int i = 2 * n_; i < size_; ++i) change[i] += weight * h * rate[at(i)];
        }
    }

    /// The polynomial in θ of what each position changes, by Newton's divided differences.
    void look_into(Ends& ends) {
        differences_.resize(at(n_));
        const double h = ends.h;
        const auto put = [&](int place, int i, double change, double v, double a) {
            double* const three = differences_[at(i)].data() + 3 * place;
            three[0] = change, three[1] = h * v, three[2] = h * h / 2 * a;
        };
        std::vector<double> q(at(n_)), v(at(n_)), change(at(n_));
        for (int i = 0; i < n_; ++i) {
            const std::size_t k = at(i), r = at(n_ + i);
            q[k] = ends.y[k], v[k] = ends.y[r];
            put(0, i, 0, v[k], ends.rate[r]);
            put(parts, i, (ends.next[k] - ends.y[k]) + (ends.next_rest[k] - ends.rest[k]), ends.next[r],
                ends.end_rate[r]);
        }
        const double length = h / parts;
        for (int part = 1; part < parts; ++part) {
            const bool first = part == 1;
            part_.reach(ends,
                        {.t = ends.t + (part - 1) * length,
                         .q = q.data(),
                         .v = v.data(),
                         .a = first ? ends.rate.data() + n_ : std::as_const(part_).last_accelerations(),
                         .rest = first ? ends.rest.data() : nullptr},
                        length);
            for (int i = 0; i < n_; ++i) {
                const std::size_t k = at(i);
                change[k] += part_.change()[i];
                q[k] = ends.y[k] + (change[k] + ends.rest[k]);
                v[k] += part_.rate_change()[i];
                put(part, i, change[k], v[k], part_.last_accelerations()[i]);
            }
        }
        for (Conditions& of_one : differences_) divide(of_one);
        looked_into_ = true;
    }

    /// From the value, the slope and half the second slope at each place.
    static void divide(Conditions& row) {
        const Conditions given = row;
        for (int k = 0; k < conditions; ++k) row[at(k)] = given[at(k / 3 * 3)];
        for (int order = 1; order < conditions; ++order)
            for (int k = conditions - 1; k >= order; --k)
                row[at(k)] = k / 3 == (k - order) / 3
                                 ? given[at(k / 3 * 3 + order)]
                                 : (row[at(k)] - row[at(k - 1)]) / (place(k) - place(k - order));
    }

    int n_, size_;  ///< positions; components, with quadratures
    NystromStages<tableau> whole_;
    NystromStages<rkn86_tableau> part_;
    std::vector<Conditions> differences_;
    bool looked_into_ = false;
};

}  // namespace alembert
