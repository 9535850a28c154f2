// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/timely.hpp"

#include <algorithm>

namespace alembert {

namespace {

constexpr double latency = 4;  // cycles of a multiplication with addition
constexpr int most_apart = 8;     // values that enter by themselves

std::string product(const std::vector<std::string>& factors) {
    std::string text;
    for (const std::string& factor : factors)
        if (!factor.empty()) text += (text.empty() ? "" : " * ") + factor;
    return text;
}

std::string grouped(const std::string& text) { return text.find(' ') == std::string::npos ? text : "(" + text + ")"; }

struct Signed {
    bool negative;
    std::string text;
};

/// Begins with something that is not subtracted, where there is one.
std::string joined(std::vector<Signed> pieces) {
    const auto positive = std::find_if(pieces.begin(), pieces.end(), [](const Signed& x) { return !x.negative; });
    if (positive != pieces.end()) std::rotate(pieces.begin(), positive, positive + 1);
    std::string text;
    for (const Signed& x : pieces) text += (text.empty() ? x.negative ? "-" : "" : x.negative ? " - " : " + ") + x.text;
    return text;
}

/// All terms with the same factor of the same late value.
struct Group {
    std::string factor, late;
    double ready;
    bool is_inner;
    std::vector<Signed> weights;
};

/// Of one term the sign goes outside; a sum of several is multiplied as a whole.
Signed times(const std::string& scale, const Group& group, bool apart) {
    const bool is_sum = group.weights.size() > 1;
    const std::string factor = product({scale, is_sum ? "(" + joined(group.weights) + ")" : group.weights[0].text == "Real(1)" ? "" : group.weights[0].text, group.factor});
    const std::string text = product({apart && !group.late.empty() ? grouped(factor) : factor, group.late});
    return {!is_sum && group.weights[0].negative, text.empty() ? "Real(1)" : text};
}

/// The last `apart` of the groups, which are in the order in which they are ready, enter by themselves.
Timely written(const TimelySum& sum, const std::vector<Group>& groups, std::size_t apart) {
    const std::size_t together = groups.size() - apart;
    std::vector<Signed> inner, plain;
    double ready = 0;
    for (std::size_t k = 0; k < together; ++k) {
        const Group& group = groups[k];
        (group.is_inner ? inner : plain).push_back(times("", group, false));
        ready = std::max(ready, group.ready) + latency;
    }
    // What is multiplied may be one product: then the factors can be multiplied before.
    std::vector<Signed> pieces;
    if (!inner.empty()) {
        const std::string scale = plain.empty() ? product({sum.outer, sum.inner}) : sum.inner;
        pieces.push_back({false, scale.empty() ? joined(inner) : product({grouped(scale), grouped(joined(inner))})});
        if (!scale.empty()) ready += latency;
    }
    if (!plain.empty()) {
        pieces.insert(pieces.end(), plain.begin(), plain.end());
        if (!sum.outer.empty()) {
            pieces = {{false, product({sum.outer, grouped(joined(pieces))})}};
            ready += latency;
        }
    }
    for (std::size_t k = together; k < groups.size(); ++k) {
        const Group& group = groups[k];
        ready = std::max(ready, group.ready) + latency;
        pieces.push_back(times(product({sum.outer, group.is_inner ? sum.inner : ""}), group, true));
    }
    // In this order: what comes first is added first.
    std::string text;
    for (const Signed& x : pieces) text += (text.empty() ? x.negative ? "-" : "" : x.negative ? " - " : " + ") + x.text;
    return {text.empty() ? "Real(0)" : text, ready};
}

}  // namespace

Timely in_time(TimelySum sum) {
    std::vector<Group> groups;
    for (const TimelyTerm& term : sum.terms) {
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.late == term.late && g.factor == term.factor && g.is_inner == term.is_inner; });
        Group& group = same != groups.end() ? *same : groups.emplace_back(Group{term.factor, term.late, term.ready, term.is_inner, {}});
        group.weights.push_back({term.negative, term.weight.empty() ? "Real(1)" : term.weight});
    }
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.ready < b.ready; });
    Timely best = written(sum, groups, 0);
    for (std::size_t apart = 1; apart <= std::min<std::size_t>(groups.size(), most_apart); ++apart) {
        if (groups[groups.size() - apart].late.empty()) break;
        if (Timely other = written(sum, groups, apart); other.ready < best.ready) best = std::move(other);
    }
    return best;
}

}  // namespace alembert
