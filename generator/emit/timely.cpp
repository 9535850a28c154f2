// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/timely.hpp"

#include <algorithm>
#include <numeric>

namespace alembert {

namespace {

constexpr double latency = 4;  // cycles of a multiplication, an addition, or both

std::string product(const std::vector<std::string>& factors) {
    std::string text;
    for (const std::string& factor : factors)
        if (!factor.empty()) text += (text.empty() ? "" : " * ") + factor;
    return text;
}

double time_of(const Times& times, const Moment& moment) {
    return times[static_cast<std::size_t>(moment.before)][static_cast<std::size_t>(moment.node)] + moment.delay;
}

}  // namespace

Timely::Timely(const TimelySum& sum) : outer_(sum.outer), inner_(sum.inner) {
    for (const TimelyTerm& term : sum.terms) {
        const auto same = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.late == term.late && g.factor == term.factor && g.is_inner == term.is_inner; });
        Group& group = same != groups_.end() ? *same : groups_.emplace_back(Group{term.factor, term.late, term.ready, term.is_inner, {}});
        group.weights.push_back({term.negative, term.weight});
    }
}

std::vector<int> Timely::in_order(const Times& times) const {
    std::vector<int> order(groups_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return time_of(times, groups_[a].ready) < time_of(times, groups_[b].ready); });
    return order;
}

double Timely::ready(const Times& times) const {
    double inner = 0, plain = 0;
    for (const int k : in_order(times)) {
        double& sum = groups_[k].is_inner ? inner : plain;
        sum = std::max(sum, time_of(times, groups_[k].ready)) + latency;
    }
    if (inner > 0 && !inner_.empty()) inner += latency;
    return std::max(inner, plain) + (outer_.empty() ? 0 : latency);
}

/// Of one weight the sign goes outside; a sum of several is multiplied as a whole.
Piece Timely::weight_of(const Group& group) {
    if (group.weights.size() == 1) return group.weights[0];
    std::vector<Piece> weights = group.weights;
    for (Piece& weight : weights)
        if (weight.text.empty()) weight.text = "Real(1)";
    return {false, "(" + joined(weights) + ")"};
}

/// Terms with the same weight in one bracket.
std::string Timely::together(const std::vector<const Group*>& groups) {
    std::vector<Piece> weights;
    std::vector<std::vector<std::string>> terms;
    for (const Group* group : groups) {
        const Piece weight = weight_of(*group);
        const auto same = std::find_if(weights.begin(), weights.end(), [&](const Piece& w) { return w.negative == weight.negative && w.text == weight.text; });
        const auto place = static_cast<std::size_t>(same - weights.begin());
        if (same == weights.end()) weights.push_back(weight), terms.emplace_back();
        terms[place].push_back(product({group->factor, group->late}));
    }
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        std::string sum;
        for (const std::string& term : terms[k]) sum += (sum.empty() ? "" : " + ") + term;
        if (weights[k].text.empty() && !weights[k].negative)
            for (const std::string& term : terms[k]) pieces.push_back({false, term});
        else
            pieces.push_back({weights[k].negative, product({weights[k].text, terms[k].size() > 1 ? "(" + sum + ")" : sum})});
    }
    return joined(pieces);
}

std::string Timely::text(const Times& times) const {
    std::vector<const Group*> inner, plain;
    for (const int k : in_order(times)) (groups_[k].is_inner ? inner : plain).push_back(&groups_[k]);
    if (plain.empty()) {
        const std::string scale = product({outer_, inner_});
        return scale.empty() ? together(inner) : product({bracketed(scale), bracketed(together(inner))});
    }
    std::string text = inner.empty() ? "" : inner_.empty() ? together(inner) : product({inner_, bracketed(together(inner))});
    const std::string rest = together(plain);
    text += text.empty() ? rest : rest[0] == '-' ? " - " + rest.substr(1) : " + " + rest;
    return outer_.empty() ? text : product({outer_, bracketed(text)});
}

}  // namespace alembert
