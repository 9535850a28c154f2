// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The power series in time of a motion, from every state of a box: intervals that contain the coefficients, and
/// their derivatives by the state at the start.
///
///     IntervalSeries series(recurrences(program), parameters);
///     series.from(t, box, {.order = 20, .with_slopes = true});
///     series.coefficient(0, 3);       // contains q_0'''/3! of each motion that starts in the box
///     series.slope(0, 3, 1);          // contains its derivative by component 1 of the start
///
/// The recurrences are those of program/recurrence.hpp; the derivatives follow from them term by term (Moore,
/// Interval Analysis (1966), §11; Lohner, Einschließung der Lösung gewöhnlicher Anfangs- und Randwertaufgaben,
/// Karlsruhe (1988)). Where a function has no value somewhere in the box, the coefficients are the whole line.
/// Components are the coordinates, then the speeds.

#include <span>
#include <vector>

#include "alembert/base/interval.hpp"
#include "program/recurrence.hpp"

namespace alembert {

class IntervalSeries {
public:
    struct Extent {
        int order = 20;
        bool with_slopes = false;
    };

    /// `parameters` contain the values of the independent parameters.
    IntervalSeries(Recurrences recurrences, const std::vector<Interval>& parameters);

    std::size_t size() const { return state_.size(); }
    void from(const Interval& t, std::span<const Interval> box, const Extent& extent);
    const Interval& coefficient(std::size_t component, int order) const { return at(state_[component], order)[0]; }
    const Interval& slope(std::size_t component, int order, std::size_t by) const {
        return at(state_[component], order)[1 + by];
    }

private:
    /// Factors of a node that do not change during a run.
    struct Weights {
        Interval constant{}, exponent{};
        std::vector<Interval> linear{}, bilinear{}, implied{};
    };

    Interval weight(const Weight& w, const std::vector<Interval>& values) const;
    Interval* at(int node, int order) { return coefficients_.data() + place(node, order); }
    const Interval* at(int node, int order) const { return coefficients_.data() + place(node, order); }
    std::size_t place(int node, int order) const {
        return (static_cast<std::size_t>(node) * static_cast<std::size_t>(orders_) +
                static_cast<std::size_t>(order)) *
               width_;
    }

    void at_order_zero(const Interval& t, std::span<const Interval> box);
    void value_at_zero(int id);
    void function_at_zero(int id);
    void at_order(int k);
    void next(int id, int k);
    void next_of_function(int id, int k);
    /// Terms of a sum, from its constants at order 0 on.
    void sum(int id, int k, Interval* to) const;
    void add(Interval* to, const Interval& factor, const Interval* a) const;
    void add_product(Interval* to, const Interval& factor, const Interval* a, const Interval* b) const;
    /// to = (to)/(factor·d)
    void divide(Interval* to, const Interval* d, double factor = 1) const;
    void invert_matrix();
    void solve(int k);

    Recurrences r_;
    std::vector<Weights> weights_;
    std::vector<Interval> constant_entries_;  ///< of the matrix
    std::vector<int> state_, rates_;          ///< the node of each component, and of its rate
    int orders_ = 1;
    std::size_t width_ = 1;
    std::vector<Interval> coefficients_, inverse_;
};

}  // namespace alembert
