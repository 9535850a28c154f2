// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/equilibrium/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "alembert/base/error.hpp"
#include "stability/equilibrium/judge.hpp"
#include "stability/linear/dense_long.hpp"

namespace alembert {

namespace {

constexpr long double pi = 3.14159265358979323846264338327950288L, turn = 2 * pi;
constexpr long double same = 1e-9L, same_if_singular = 1e-5L, same_if_multiple = 2e-4L;  // in units of the scales
constexpr int most_starts = 1500, least_starts = 60;
constexpr int most_of_families = 5,
              most_ways_to_members = 60;  // then continua of one dimension are not told apart
constexpr double most_work = 1.5e6;       // starts times nodes times unknowns: a second or two

/// The k-th number, for the i-th coordinate, of a sequence that fills (0, 1) evenly. (Halton, Numer. Math. 2
/// (1960) 84.)
long double halton(int k, std::size_t i) {
    constexpr std::array primes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};
    const int base = primes[i % primes.size()];
    long double result = 0, part = 1;
    for (int n = k + 1 + 409 * static_cast<int>(i / primes.size()); n > 0; n /= base) {
        part /= base;
        result += part * (n % base);
    }
    return result;
}

long double wrapped(long double x) {
    x = std::remainder(x, turn);
    return x <= -pi + 1e-13L ? x + turn : x;
}

/// The largest of a size and the parameters of this unit; 1 if there is none.
long double size_beside(const Mechanism& m, const Start& start, const std::string& unit, long double size) {
    std::size_t next = 0;
    for (const Mechanism::Parameter& p : m.parameters) {
        if (!p.independent) continue;
        const long double value = std::abs(start.parameters[next++]);
        if (!unit.empty() && p.unit == unit) size = std::max(size, value);
    }
    return size > 0 ? size : 1;
}

std::vector<long double> scales_of(const Mechanism& m, const Start& start, const std::vector<bool>& is_angle) {
    std::vector<long double> result;
    for (int i = 0; i < m.size(); ++i)
        result.push_back(is_angle[i] ? 1 : size_beside(m, start, m.units[i], std::abs(start.q[i])));
    return result;
}

/// At least such that an argument of a table goes through a piece of it by an ordinary change.
std::vector<long double> scaled_by_tables(std::vector<long double> scales, const SteadyProblem& problem,
                                          const Borders& borders, const std::vector<bool>& is_angle) {
    for (const Borders::Argument& argument : borders.arguments()) {
        const Borders::Slope slope = borders.slope(argument, problem.start());
        for (std::size_t i = 0; i < scales.size(); ++i)
            if (const long double by = std::abs(slope.by_q[i]); !is_angle[i] && by > 0 && std::isfinite(by))
                scales[i] = std::max(scales[i], argument.width / by);
    }
    return scales;
}

void sort_roots(std::vector<FoundRoot>& roots) {
    std::sort(roots.begin(), roots.end(), [](const FoundRoot& a, const FoundRoot& b) {
        for (const auto part : {&Instant<long double>::q, &Instant<long double>::u}) {
            const std::vector<long double>&one = a.at.*part, &other = b.at.*part;
            for (std::size_t i = 0; i < one.size(); ++i)
                if (std::abs(one[i] - other[i]) > 1e-9L) return one[i] < other[i];
        }
        return false;
    });
}

/// Keeps the smallest unbalanced forces.
void note_failure(SteadySearch& found, const SteadyProblem& problem, Instant<long double> at, bool first) {
    try {
        if (!problem.settle_at(at)) return;
        const SteadySystem here = problem.linearized_at(at, at.u);
        const auto p = static_cast<Eigen::Index>(here.split.u.size());
        if (!here.residual.head(p).allFinite()) return;
        const auto constant = [&](Eigen::Index i) {
            return here.residual[i] != 0 && here.by.row(i).cwiseAbs().maxCoeff() < 1e-12L;
        };
        if (first || found.left_over.empty()) found.constant.assign(static_cast<std::size_t>(p), true);
        long double sum = 0, least = 0;
        for (Eigen::Index i = 0; i < p && i < static_cast<Eigen::Index>(found.constant.size()); ++i) {
            found.constant[i] = found.constant[i] && (here.by.cols() == 0 ? here.residual[i] != 0 : constant(i));
            sum += std::abs(here.residual[i]);
        }
        for (const long double x : found.left_over) least += std::abs(x);
        if (!found.left_over.empty() && sum >= least) return;
        found.nearest = at;
        found.left_over.assign(here.residual.data(), here.residual.data() + p);
    } catch (const IntegrationError&) {  // the constraints lose rank there
    }
}

Borders borders_of(const SteadyProblem& problem) {
    const Residuals& r = problem.residuals();
    std::vector<int> roots;
    for (const auto* part : {&r.forcing, &r.mass, &r.gamma, &r.row, &r.rate, &r.position, &r.velocity})
        roots.insert(roots.end(), part->begin(), part->end());
    return Borders(r.program, roots, r.inputs);
}

}  // namespace

void wrap_angles(Instant<long double>& at, const std::vector<bool>& is_angle) {
    for (std::size_t i = 0; i < at.q.size(); ++i)
        if (is_angle[i]) at.q[i] = wrapped(at.q[i]);
}

long double distance(const SteadyProblem& problem, const std::vector<bool>& is_angle,
                     const Instant<long double>& a, const Instant<long double>& b) {
    long double result = 0;
    for (std::size_t i = 0; i < a.q.size(); ++i) {
        if (!problem.essential()[i]) continue;
        const long double d = a.q[i] - b.q[i];
        result = std::max(result, std::abs(is_angle[i] ? std::remainder(d, turn) : d) / problem.scales()[i]);
    }
    for (const MovingState& z : problem.states())
        result = std::max(result, std::abs(a.u[z.place] - b.u[z.place]) / z.scale);
    return result;
}

std::vector<bool> find_angles(const SteadyProblem& problem) {
    const Residuals& r = problem.residuals();
    const Borders borders = borders_of(problem);
    std::vector<bool> result(static_cast<std::size_t>(r.n), true);
    std::mt19937_64 random(4711);
    const auto unit = [&] { return static_cast<long double>(random() >> 11) / 4503599627370496.0L - 1; };
    for (int trial = 0; trial < 3; ++trial) {
        State<long double> state{.parameters = problem.start().parameters,
                                 .t = problem.start().t,
                                 .q = problem.start().q,
                                 .qdot = problem.start().u,
                                 .qddot = {}};
        state.unknown.resize(r.input_places(), 0.7L);
        for (long double& q : state.q) q += unit();
        for (long double& u : state.qdot) u += unit();
        const std::vector<long double> here = interpret(r.program, state);
        const Instant<long double> at{.parameters = state.parameters,
                                      .q = state.q,
                                      .u = state.qdot,
                                      .inputs = problem.start().inputs,
                                      .t = state.t};
        for (std::size_t i = 0; i < state.q.size(); ++i) {
            if (!borders.has_period(i, turn, at)) result[i] = false;
            State<long double> turned = state;
            turned.q[i] += turn;
            const std::vector<long double> there = interpret(r.program, turned);
            for (const Root& root : r.program.roots) {
                const long double a = here[root.node], b = there[root.node];
                if (std::isfinite(a) && !(std::abs(a - b) <= 1e-13L * (1 + std::abs(a)))) result[i] = false;
            }
        }
    }
    return result;
}

namespace {

std::vector<MovingState> moving_states(const SteadyProblem& problem, const Mechanism& m, const Start& start) {
    std::vector<MovingState> result;
    const Residuals& r = problem.residuals();
    for (std::size_t k = 0, first = static_cast<std::size_t>(r.s - r.states); r.states > 0 && k < m.states.size();
         ++k)
        if (!problem.is_held(first + k))
            result.push_back({.number = k,
                              .place = first + k,
                              .scale = size_beside(m, start, m.states[k].unit,
                                                   static_cast<long double>(std::abs(start.states[k])))});
    return result;
}

/// Most within twice the scale, every fourth within ten times.
long double spread_out(int k, long double part) {
    return k % 4 == 3 ? std::sinh(3 * part) : 2 * part;
}

/// Fewer for long equations, so that the search takes seconds for many coordinates too.
int usual_starts(const SteadyProblem& problem, int dimension) {
    const Residuals& r = problem.residuals();
    const int wanted = std::min(most_starts, 40 + 80 * dimension);
    const double each = static_cast<double>(problem.nodes()) * (1 + r.n + r.s);
    return std::clamp(static_cast<int>(std::min<double>(wanted, most_work / each)), std::min(least_starts, wanted),
                      wanted);
}

}  // namespace

namespace {

/// States at which the argument of a table lies in the middle of each of its pieces, or of some of many.
void add_starts_in(const Borders::Argument& argument, const SteadyProblem& problem, const Borders& borders,
                   const std::function<Instant<long double>(int)>& spread,
                   std::vector<Instant<long double>>& starts) {
    constexpr std::size_t most_pieces = 500;
    constexpr int most_steps = 40;
    constexpr long double near_middle = 0.1L;  // of a piece
    const std::size_t count = argument.middles.size(), each = (count + most_pieces - 1) / most_pieces;
    for (std::size_t k = 0; k < count; k += each) {
        Instant<long double> at = spread(static_cast<int>(k / each));
        const long double aim = argument.middles[k];
        for (int step = 0; step < most_steps; ++step) {
            const Borders::Slope here = borders.slope(argument, at);
            if (!std::isfinite(here.value)) break;
            if (std::abs(here.value - aim) < near_middle * argument.widths[k]) {
                starts.push_back(at);
                break;
            }
            // By what changes it most.
            long double most = 0;
            long double* moves = nullptr;
            long double slope = 0;
            const auto look = [&](long double by, long double scale, long double& x) {
                if (std::abs(by) * scale > most) most = std::abs(by) * scale, moves = &x, slope = by;
            };
            for (std::size_t i = 0; i < at.q.size(); ++i)
                if (problem.essential()[i]) look(here.by_q[i], problem.scales()[i], at.q[i]);
            for (const MovingState& z : problem.states()) look(here.by_u[z.place], z.scale, at.u[z.place]);
            if (moves == nullptr) break;
            *moves += (aim - here.value) / slope;
        }
    }
}

/// The end of a flat piece is no state of its own, and the edge of a flat area no continuum of its own.
void drop_ends(const FamilyWays& ways, SteadySearch& found) {
    const auto is_end = [&](const FoundRoot& root) {
        const int dimension = root.family ? root.family->dimension : 0;
        return !ways.problem.has_first_approximation(root.at) &&
               std::any_of(found.roots.begin(), found.roots.end(), [&](const FoundRoot& other) {
                   return other.family && other.family->dimension > dimension &&
                          (leads_to(ways, other, root) || leads_round(ways, *other.family, other, root));
               });
    };
    std::vector<FoundRoot> kept;
    for (const FoundRoot& root : found.roots)
        if (!is_end(root)) kept.push_back(root);
    found.in_families += static_cast<int>(found.roots.size() - kept.size());
    found.roots = std::move(kept);
}

}  // namespace

SteadySearch search_steady(SteadyProblem& problem, const Mechanism& m, const Start& start,
                           const SearchOptions& options) {
    SteadySearch found;
    found.is_angle = find_angles(problem);
    const Borders borders = borders_of(problem);
    problem.set_scales(scaled_by_tables(scales_of(m, start, found.is_angle), problem, borders, found.is_angle));
    problem.set_states(moving_states(problem, m, start));
    const std::vector<MovingState>& states = problem.states();
    const auto dimension = std::count(problem.essential().begin(), problem.essential().end(), true) +
                           static_cast<std::ptrdiff_t>(states.size());
    found.starts = options.starts > 0 ? options.starts : usual_starts(problem, static_cast<int>(dimension));
    const auto spread = [&](int k) {
        Instant<long double> at = problem.start();
        std::size_t place = 0;
        for (std::size_t i = 0; i < at.q.size(); ++i) {
            if (k == 0 || !problem.essential()[i]) continue;
            const long double part = 2 * halton(k, place++) - 1;
            at.q[i] = found.is_angle[i] ? pi * part : problem.scales()[i] * spread_out(k, part);
        }
        for (const MovingState& z : states)
            if (k > 0) at.u[z.place] = z.scale * spread_out(k, 2 * halton(k, place++) - 1);
        return at;
    };
    std::vector<Instant<long double>> pieces;
    for (const Borders::Argument& argument : borders.arguments())
        add_starts_in(argument, problem, borders, spread, pieces);
    const int spread_starts = found.starts;
    found.starts += static_cast<int>(pieces.size());
    const auto from = [&](int k) {
        return k < spread_starts ? spread(k) : pieces[static_cast<std::size_t>(k - spread_starts)];
    };
    const auto is_known = [&](const SteadyRoot& root) {
        return std::any_of(found.roots.begin(), found.roots.end(), [&](const FoundRoot& other) {
            const bool sharp = root.isolated && other.isolated;
            const long double apart = distance(problem, found.is_angle, root.at, other.at);
            if (apart < (sharp ? same : same_if_singular)) return true;
            return apart < same_if_multiple && (meeting_at(problem, root.at) != Meeting::none ||
                                                meeting_at(problem, other.at) != Meeting::none);
        });
    };
    int ways = 0;
    const auto is_in_known_family = [&](const FoundRoot& root, Rates rates) {
        int shown = 0;
        for (const FoundRoot& other : found.roots) {
            if (!other.family || other.family->dimension != root.family->dimension) continue;
            if (++shown == most_of_families || ++ways > most_ways_to_members) return true;
            const FamilyWays in{problem, borders, found.is_angle, rates};
            if (leads_to(in, root, other) || leads_to(in, other, root)) return true;
            if (leads_round(in, *other.family, other, root)) return true;
        }
        return false;
    };
    for (const Rates rates : {Rates::given, Rates::free}) {
        found.rates = rates;
        for (int k = 0; k < found.starts; ++k) {
            if (options.progress) options.progress(static_cast<double>(k) / found.starts);
            const auto solved = problem.solve(from(k), rates);
            if (!solved) continue;
            ++found.converged;
            FoundRoot root{*solved};
            wrap_angles(root.at, found.is_angle);
            if (is_known(root)) continue;
            if (!root.isolated) root.family = family_of(problem, found.is_angle, root, rates);
            root.isolated = !root.family;
            found.in_families += root.family ? 1 : 0;
            if (!root.isolated && is_in_known_family(root, rates)) continue;
            if (root.family) find_ends({problem, borders, found.is_angle, rates}, *root.family, root);
            found.roots.push_back(root);
        }
        if (!found.roots.empty() || problem.kept_speeds().rows() == 0) break;
    }
    drop_ends({problem, borders, found.is_angle, found.rates}, found);
    if (found.roots.empty()) {
        found.rates = Rates::given;
        for (int k = 0; k < std::min(found.starts, 100); ++k) note_failure(found, problem, from(k), k == 0);
    }
    sort_roots(found.roots);
    return found;
}

}  // namespace alembert
