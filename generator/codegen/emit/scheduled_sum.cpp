// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/scheduled_sum.hpp"

#include <algorithm>
#include <numeric>

#include "program/processor.hpp"

namespace alembert {

namespace {

double time_of(const Times& times, const Moment& moment) {
    return times[static_cast<std::size_t>(moment.before)][static_cast<std::size_t>(moment.node)] + moment.delay;
}

}  // namespace

ScheduledSum::ScheduledSum(const SumParts& sum) : outer_(sum.outer), inner_(sum.inner) {
    for (const SumTerm& term : sum.terms) {
        const auto same = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
            return g.late.text == term.late.text && g.factor.text == term.factor.text &&
                   g.is_inner == term.is_inner;
        });
        Group& group = same != groups_.end()
                           ? *same
                           : groups_.emplace_back(Group{term.factor, term.late, term.ready, term.is_inner, {}});
        group.weights.push_back({term.negative, term.weight});
    }
}

std::vector<int> ScheduledSum::in_order_of(const Times& times) const {
    std::vector<int> order(groups_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return time_of(times, groups_[a].ready) < time_of(times, groups_[b].ready);
    });
    return order;
}

double ScheduledSum::ready(const Times& times) const {
    double inner = 0, plain = 0;
    for (const int k : in_order_of(times)) {
        double& sum = groups_[k].is_inner ? inner : plain;
        sum = std::max(sum, time_of(times, groups_[k].ready)) + processor::step;
    }
    if (inner > 0 && !inner_.is_one()) inner += processor::step;
    return std::max(inner, plain) + (outer_.is_one() ? 0 : processor::step);
}

/// The sign of a single weight is taken outside; a sum of several weights is multiplied as a whole.
Piece ScheduledSum::weight_of(const Group& group) {
    if (group.weights.size() == 1) return group.weights[0];
    std::vector<Piece> weights = group.weights;
    for (Piece& weight : weights)
        if (weight.value.is_one()) weight.value = "Real(1)";
    return {false, bracketed(joined(weights))};
}

/// Terms with the same weight are put into one bracket; the first piece is one that is not subtracted, if there is
/// one.
std::vector<Piece> ScheduledSum::together(const std::vector<const Group*>& groups) {
    std::vector<Piece> weights;
    std::vector<std::vector<Piece>> terms;
    for (const Group* group : groups) {
        const Piece weight = weight_of(*group);
        const auto same = std::find_if(weights.begin(), weights.end(), [&](const Piece& w) {
            return w.negative == weight.negative && w.value.text == weight.value.text;
        });
        const auto place = static_cast<std::size_t>(same - weights.begin());
        if (same == weights.end()) weights.push_back(weight), terms.emplace_back();
        terms[place].push_back({false, group->factor * group->late});
    }
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        if (weights[k].value.is_one() && !weights[k].negative)
            pieces.insert(pieces.end(), terms[k].begin(), terms[k].end());
        else
            pieces.push_back({weights[k].negative, weights[k].value * in_order(terms[k])});
    }
    const auto positive = std::find_if(pieces.begin(), pieces.end(), [](const Piece& x) { return !x.negative; });
    if (positive != pieces.end()) std::rotate(pieces.begin(), positive, positive + 1);
    return pieces;
}

CodeExpression ScheduledSum::value(const Times& times) const {
    std::vector<const Group*> inner, plain;
    for (const int k : in_order_of(times)) (groups_[k].is_inner ? inner : plain).push_back(&groups_[k]);
    if (plain.empty()) {
        const CodeExpression scale = outer_ * inner_, sum = in_order(together(inner));
        return scale.is_one() ? sum : bracketed(scale) * bracketed(sum);
    }
    std::vector<Piece> pieces = together(inner), rest = together(plain);
    if (!inner.empty() && !inner_.is_one()) pieces = {{false, inner_ * bracketed(in_order(pieces))}};
    pieces.insert(pieces.end(), rest.begin(), rest.end());
    const CodeExpression sum = in_order(pieces);
    return outer_.is_one() ? sum : outer_ * bracketed(sum);
}

}  // namespace alembert
