// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/locus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

constexpr double farthest = 0.03;  // a root's way between two values, of the largest root
constexpr int deepest_halving = 10;

/// The roots in the order of those before: the nearest pairs first.
Spectra::Roots in_order(const Spectra::Roots& before, const Spectra::Roots& now) {
    if (before.size() != now.size()) return now;
    struct Pair {
        double distance;
        std::size_t from, to;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < now.size(); ++i)
        for (std::size_t j = 0; j < now.size(); ++j) pairs.push_back({std::abs(before[i] - now[j]), i, j});
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    Spectra::Roots result(now.size());
    std::vector<bool> has(now.size(), false), taken(now.size(), false);
    for (const Pair& p : pairs)
        if (!has[p.from] && !taken[p.to]) {
            result[p.from] = now[p.to];
            has[p.from] = taken[p.to] = true;
        }
    return result;
}

double size_of(const Spectra::Roots& roots) {
    double size = 1e-300;
    for (const auto& root : roots) size = std::max(size, std::abs(root));
    return size;
}

double way(const Spectra::Roots& a, const Spectra::Roots& b) {
    double longest = 0;
    for (std::size_t k = 0; k < a.size() && k < b.size(); ++k) longest = std::max(longest, std::abs(a[k] - b[k]));
    return longest;
}

class Following {
public:
    Following(RootLocus& locus, const Spectra& spectra) : locus_(locus), spectra_(spectra) {}

    /// The roots at the state that is reached from the one of the value before.
    Spectra::Roots at(double value) const {
        Spectra::Place near = place_;
        return spectra_.following({value}, near).value_or(Spectra::Roots());
    }

    void add(double value, int depth = 0) {
        Spectra::Place place = place_;
        const Spectra::Roots roots = spectra_.following({value}, place).value_or(Spectra::Roots());
        if (!locus_.roots.empty() && !roots.empty() && !locus_.roots.back().empty()) {
            const Spectra::Roots ordered = in_order(locus_.roots.back(), roots);
            const double before = locus_.values.back();
            largest_ = std::max(largest_, size_of(roots));
            const double moved = way(locus_.roots.back(), ordered);
            if (depth < deepest_halving &&
                moved > farthest * std::max(size_of(locus_.roots.back()), size_of(ordered))) {
                add((before + value) / 2, depth + 1);
                add(value, depth + 1);
                return;
            }
            if (moved > farthest * largest_)
                locus_.jumps.push_back((before + value) / 2);
            else
                look_for_crossing(before, value, ordered);
            locus_.roots.push_back(ordered);
        } else {
            locus_.roots.push_back(roots);
        }
        locus_.values.push_back(value);
        place_ = std::move(place);
    }

private:
    int count(const Spectra::Roots& roots) const {
        const double margin = edge_margin(roots, locus_.of);
        return static_cast<int>(std::count_if(roots.begin(), roots.end(),
                                              [&](const auto& root) { return beyond(root, locus_.of) > margin; }));
    }

    void look_for_crossing(double a, double b, const Spectra::Roots& at_b) {
        const Spectra::Roots& at_a = locus_.roots.back();
        const int before = count(at_a), after = count(at_b);
        if (before == after) return;
        RootLocus::Crossing found{.value = 0, .root = 0, .before = before, .after = after};
        found.kind = kind_of(after > before ? at_b : at_a, locus_.of);
        const double margin = edge_margin(at_a, locus_.of);
        for (std::size_t k = 0; k < at_a.size(); ++k) {
            const double f = beyond(at_a[k], locus_.of), g = beyond(at_b[k], locus_.of);
            if ((f > 0) == (g > 0) || std::min(std::abs(f), std::abs(g)) <= margin || at_a[k].imag() < 0) continue;
            pass_through(found, a, b, at_a[k], std::min(count_still(at_a), count_still(at_b)));
            locus_.crossings.push_back(found);
            return;
        }
        leave_edge(found, a, b);
        locus_.crossings.push_back(found);
    }

    /// Without those nearest to the edge, so many.
    Spectra::Roots without_still(Spectra::Roots roots, std::size_t still) const {
        std::sort(roots.begin(), roots.end(), [&](const auto& x, const auto& y) {
            return std::abs(beyond(x, locus_.of)) < std::abs(beyond(y, locus_.of));
        });
        roots.erase(roots.begin(), roots.begin() + static_cast<std::ptrdiff_t>(std::min(still, roots.size())));
        return roots;
    }

    /// Roots that stay on the edge, such as the zeros of a family of steady motions.
    std::size_t count_still(const Spectra::Roots& roots) const {
        const double margin = edge_margin(roots, locus_.of);
        return static_cast<std::size_t>(std::count_if(roots.begin(), roots.end(), [&](const auto& root) {
            return std::abs(beyond(root, locus_.of)) <= margin;
        }));
    }

    /// A root that is on one side before and on the other after, followed by its nearest one.
    void pass_through(RootLocus::Crossing& found, double a, double b, std::complex<double> root,
                      std::size_t still) const {
        const bool side = beyond(root, locus_.of) > 0;
        for (int k = 0; k < 200 && std::abs(b - a) > 4e-16 * std::max(std::abs(a), std::abs(b)); ++k) {
            const double middle = a + (b - a) / 2;
            const Spectra::Roots roots = without_still(at(middle), still);
            if (roots.empty()) break;
            root = *std::min_element(roots.begin(), roots.end(), [&](const auto& x, const auto& y) {
                return std::abs(x - root) < std::abs(y - root);
            });
            ((beyond(root, locus_.of) > 0) == side ? a : b) = middle;
        }
        found.value = a + (b - a) / 2;
        found.root = root;
    }

    /// Roots on the edge that meet there and leave it.
    void leave_edge(RootLocus::Crossing& found, double a, double b) const {
        for (int k = 0; k < 200 && std::abs(b - a) > 4e-16 * std::max(std::abs(a), std::abs(b)); ++k) {
            const double middle = a + (b - a) / 2;
            const Spectra::Roots roots = at(middle);
            if (roots.empty()) break;
            const int beyond_now = count(roots);
            (beyond_now == found.before ? a : b) = middle;
            if (beyond_now == std::min(found.before, found.after)) continue;
            found.kind = kind_of(roots, locus_.of);
            found.root = *std::max_element(roots.begin(), roots.end(), [&](const auto& x, const auto& y) {
                return std::pair(beyond(x, locus_.of), x.imag()) < std::pair(beyond(y, locus_.of), y.imag());
            });
        }
        found.value = a + (b - a) / 2;
    }

    RootLocus& locus_;
    const Spectra& spectra_;
    Spectra::Place place_;  ///< of the last value
    double largest_ = 0;    ///< root so far
};

}  // namespace

std::vector<std::pair<double, double>> RootLocus::gaps() const {
    std::vector<std::pair<double, double>> result;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!roots[k].empty()) continue;
        if (k > 0 && roots[k - 1].empty())
            result.back().second = values[k];
        else
            result.emplace_back(values[k], values[k]);
    }
    return result;
}

RootLocus root_locus(Scene scene, const Axis& axis, const ChartOptions& options) {
    argument::need_positive_if_given("period", options.stability.period);
    if (!(std::isfinite(axis.from) && std::isfinite(axis.to)) || axis.from == axis.to || axis.count < 2)
        throw ModelError(say("{}: expected a range of two different numbers, and at least two values", axis.name));
    const UnitOfName unit = unit_of_name(scene, axis.name);
    const Spectra spectra(std::move(scene), options.stability, {axis.name},
                          {axis.from + 0.47 * (axis.to - axis.from)});
    RootLocus locus{.title = spectra.title(),
                    .name = axis.name,
                    .of = spectra.of(),
                    .from = axis.from,
                    .to = axis.to,
                    .unit = unit};
    Following following(locus, spectra);
    for (std::size_t k = 0; k < axis.count; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(axis.count - 1);
        if (options.progress) options.progress(say("the roots"), part);
        const double value = axis.from + (axis.to - axis.from) * part;
        following.add(value);
    }
    return locus;
}

}  // namespace alembert
