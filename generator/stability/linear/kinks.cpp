// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/kinks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "stability/linear/kink_message.hpp"

namespace alembert {

using Index = Eigen::Index;
using Column = VectorOf<long double>;

namespace {

// Up to this number all sums and differences of two directions are tried.
constexpr Index few_directions = 12;
constexpr long double rest_known_to = 1e-11L;  // relative to max(1, |u'|), max(1, |λ|)
constexpr long double linear_to = 1e-9L;

/// A function Σ factor · node that linearization differentiates or that must be continuous.
struct Wanted {
    std::string name;  ///< "the equation of x"
    std::vector<std::pair<int, PuiseuxSeries>> terms;
    bool derivative = true;

    PuiseuxSeries on(const std::vector<PuiseuxSeries>& value) const {
        PuiseuxSeries sum(0);
        for (const auto& [node, factor] : terms)
            if (factor.side() != 0) sum += factor * value[node];
        return sum;
    }
};

class Differentiability {
public:
    Differentiability(const Residuals& r, const Split& split, const Instant<long double>& at,
                      const Tangent<long double>& here, const Mechanism& m, const Equations& e)
        : r_(r),
          split_(split),
          at_(at),
          here_(here),
          m_(m),
          e_(e),
          size_(r.n + r.s + 1 + static_cast<Index>(r.inputs.size())) {}

    void check() {
        point_ = on_path(r_, at_, Column::Zero(size_));
        std::vector<int> roots;
        for (const Root& root : r_.program.roots)
            if (root.group != Group::input) roots.push_back(root.node);
        critical_ = critical_nodes(r_.program, roots, point_);
        if (critical_.empty()) return;
        collect();
        directions();
        along_axes();
        along_combinations();
    }

private:
    /// Collects the functions that are differentiated, in the notation of linearize.hpp; forces have the sign of
    /// f.
    void collect() {
        const auto about = [](long double x,
                              int sign) {  // at an equilibrium where the formula has no value u' is 0
            return PuiseuxSeries(std::isfinite(x) ? sign * x : 0,
                                 std::isfinite(x) ? rest_known_to * std::max(1.0L, std::abs(x)) : rest_known_to);
        };
        const auto single = [&](const std::string& name, int node, bool derivative) {
            wanted_.push_back({name, {{node, PuiseuxSeries(1)}}, derivative});
        };
        const auto mass = [&](int i, int j) {
            return r_.mass[std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j)];
        };
        for (int i = 0; i < r_.s; ++i) {
            const std::string name = say("the right-hand side of the equation for {}'", speed(i));
            Wanted force{name, {{r_.forcing[i], PuiseuxSeries(1)}}};
            for (int j = 0; j < r_.s; ++j) force.terms.emplace_back(mass(i, j), about(here_.udot[j], -1));
            for (int k = 0; k < r_.kept; ++k)
                force.terms.emplace_back(r_.row[k * r_.s + i], about(here_.lambda[k], 1));
            wanted_.push_back(std::move(force));
        }
        for (int k = 0; k < r_.kept; ++k) {
            Wanted acceleration{say("the acceleration of a constraint"), {{r_.gamma[k], PuiseuxSeries(-1)}}};
            for (int i = 0; i < r_.s; ++i)
                acceleration.terms.emplace_back(r_.row[k * r_.s + i], about(here_.udot[i], 1));
            wanted_.push_back(std::move(acceleration));
        }
        for (const int node : r_.mass) single(say("the mass matrix"), node, false);
        for (const int node : r_.row) single(say("a constraint's row"), node, false);
        for (std::size_t i = 0; i < r_.rate.size(); ++i) single(m_.q[i].get_name() + "'", r_.rate[i], true);
        for (const int node : r_.position) single(say("a constraint"), node, true);
        for (const int node : r_.velocity) single(say("a constraint's rate"), node, true);
    }

    /// The directions that the constraints allow: the columns of `along` without that of t.
    void directions() {
        const Index independent = static_cast<Index>(split_.q.size() + split_.u.size());
        for (Index j = 0; j < here_.along.cols(); ++j) {
            if (j == independent) continue;
            columns_.push_back(j);
            names_.push_back(j < static_cast<Index>(split_.q.size()) ? m_.q[split_.q[j]].get_name()
                             : j < independent ? speed(split_.u[j - static_cast<Index>(split_.q.size())])
                                               : input(r_.inputs[j - independent - 1]));
        }
    }

    struct Sides {
        std::vector<PuiseuxSeries> above, below;
    };

    /// Paths in both directions along Σ weight · direction, with some curvature normal to the constraints.
    Sides sides(const Column& weight) {
        Column d = Column::Zero(size_), c = Column::Zero(size_);
        for (std::size_t j = 0; j < columns_.size(); ++j)
            d += weight[static_cast<Index>(j)] * here_.along.col(columns_[j]);
        for (const int i : split_.q_dependent) c[i] = unit();
        for (const int i : split_.u_dependent) c[r_.n + i] = unit();
        return {on_path(r_, at_, d, c), on_path(r_, at_, -d, -c)};
    }

    long double unit() { return static_cast<long double>(random_() >> 11) / 4503599627370496.0L - 1; }

    void along_axes() {
        slope_.assign(wanted_.size(), {});
        for (std::size_t j = 0; j < columns_.size(); ++j) {
            const Sides both = sides(Column::Unit(static_cast<Index>(columns_.size()), static_cast<Index>(j)));
            for (std::size_t k = 0; k < wanted_.size(); ++k) {
                const PuiseuxSeries above = wanted_[k].on(both.above), below = wanted_[k].on(both.below);
                const std::string what = fault(wanted_[k], above, below, names_[j]);
                if (!what.empty()) refuse(blamed(wanted_[k], both), wanted_[k].name, what);
                slope_[k].push_back(above.at(1));
            }
        }
    }

    void along_combinations() {
        const Index n = static_cast<Index>(columns_.size());
        std::vector<Column> weights;
        for (Index i = 0; i < n && n <= few_directions; ++i)
            for (Index j = 0; j < i; ++j)
                for (const int sign : {1, -1}) weights.push_back(Column::Unit(n, i) + sign * Column::Unit(n, j));
        for (Index k = 0; k < 2 * n + 4 && n > 1; ++k) {
            weights.push_back(Column::Zero(n));
            for (Index j = 0; j < n; ++j) weights.back()[j] = unit();
        }
        for (const Column& weight : weights) {
            const Sides both = sides(weight);
            for (std::size_t k = 0; k < wanted_.size(); ++k) {
                const PuiseuxSeries above = wanted_[k].on(both.above), below = wanted_[k].on(both.below);
                std::string what = fault(wanted_[k], above, below, "");
                if (what.empty() && wanted_[k].derivative && !is_linear(slope_[k], weight, above.at(1)))
                    what = say("has derivatives that depend on the direction in a way that is not linear");
                if (!what.empty()) refuse(blamed(wanted_[k], both), wanted_[k].name, what);
            }
        }
    }

    static bool is_linear(const std::vector<PuiseuxSeries::Term>& slopes, const Column& weight,
                          const PuiseuxSeries::Term& found) {
        long double sum = 0, allowed = found.error;
        for (std::size_t j = 0; j < slopes.size(); ++j) {
            const long double w = weight[static_cast<Index>(j)], part = w * slopes[j].value;
            sum += part;
            allowed += std::abs(w) * slopes[j].error + linear_to * std::abs(part);
        }
        return std::abs(found.value - sum) <= allowed;
    }

    /// The fault of this function on the two sides; empty if there is none. `by` is the variable that changes, if
    /// there is only one.
    std::string fault(const Wanted& f, const PuiseuxSeries& above, const PuiseuxSeries& below,
                      const std::string& by) const {
        const PuiseuxSeries here = f.on(point_);
        if (!here.defined() && !above.defined() && !below.defined())
            return say(
                "has no value at this state: it divides by 0, or an argument is outside its function's domain");
        const auto side = [&](bool up) {
            return by.empty() ? say("in some directions")
                   : up       ? say("where {} grows", by)
                              : say("where {} falls", by);
        };
        for (const bool up : {true, false}) {
            const PuiseuxSeries& x = up ? above : below;
            if (!x.defined()) return say("has no value {}: the state is on the border of its domain", side(up));
            const PuiseuxSeries::Term *first = x.leading(), start = x.at(0), rest = here.at(0);
            if (first != nullptr && first->exponent < -1e-9) return say("grows without bound {}", side(up));
            if (here.defined() &&
                std::abs(start.value - rest.value) >
                    start.error + rest.error + linear_to * (std::abs(start.value) + std::abs(rest.value)))
                return say("jumps {}: from {} to {}", side(up), shown(rest.value), shown(start.value));
            if (!f.derivative) continue;
            for (const PuiseuxSeries::Term& term : x.terms())
                if (term.value != 0 && term.exponent < 1 - 1e-9 && term.exponent > 1e-9)
                    return say("has an infinite slope {}", side(up));
            if (x.order() <= 1) return say("has a slope that the series do not decide {}", side(up));
        }
        const PuiseuxSeries::Term up = above.at(0), down = below.at(0);
        if (!here.defined() && std::abs(up.value - down.value) >
                                   up.error + down.error + linear_to * (std::abs(up.value) + std::abs(down.value)))
            return say("has no value at this state, and two limits: {} {}, and {} {}", shown(up.value), side(true),
                       shown(down.value), side(false));
        if (!here.defined()) return say("has no value at this state itself, as the formula divides by 0 there");
        if (!f.derivative || slope(above, below)) return "";
        const std::string one = shown(above.at(1).value), other = shown(-below.at(1).value);
        return by.empty()
                   ? say("has slopes in two opposite directions that are not those of a linear function")
                   : say("has the slope {} in {} where {} grows, and {} where it falls", one, by, by, other);
    }

    static std::string shown(long double x) { return fmt::format("{:.6g}", static_cast<double>(x) + 0.0); }

    /// The critical functions in this sum that are not smooth on these sides; all critical ones if only their
    /// combination is not smooth.
    std::vector<int> blamed(const Wanted& f, const Sides& both) const {
        std::vector<int> roots, found, all;
        for (const auto& [node, factor] : f.terms)
            if (factor.side() != 0) roots.push_back(node);
        const std::vector<int> needed = r_.program.needed(roots);
        for (const int id : critical_) {
            if (std::find(needed.begin(), needed.end(), id) == needed.end()) continue;
            all.push_back(id);
            if (!slope(both.above[id], both.below[id])) found.push_back(id);
        }
        return found.empty() ? all : found;
    }

    [[noreturn]] void refuse(const std::vector<int>& nodes, const std::string& where,
                             const std::string& what) const {
        throw ModelError(no_derivative({r_, at_, point_, m_, e_}, nodes, fmt::format("{} {}", where, what)));
    }

    std::string speed(int i) const { return e_.u[i].get_name(); }
    std::string input(int k) const {
        return m_.inputs[k / 3].derivative[0].get_name() + std::string(static_cast<std::size_t>(k % 3), '\'');
    }

    const Residuals& r_;
    const Split& split_;
    const Instant<long double>& at_;
    const Tangent<long double>& here_;
    const Mechanism& m_;
    const Equations& e_;
    Index size_;
    std::vector<PuiseuxSeries> point_;
    std::vector<int> critical_;
    std::vector<Wanted> wanted_;
    std::vector<Index> columns_;
    std::vector<std::string> names_;
    std::vector<std::vector<PuiseuxSeries::Term>> slope_;
    std::mt19937_64 random_{20261};
};

}  // namespace

void check_differentiable(const Residuals& residuals, const Split& split, const Instant<long double>& at,
                          const Tangent<long double>& here, const Mechanism& mechanism,
                          const Equations& equations) {
    Differentiability(residuals, split, at, here, mechanism, equations).check();
}

}  // namespace alembert
