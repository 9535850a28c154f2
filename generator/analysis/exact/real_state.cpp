// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/real_state.hpp"

#include <cln/dfloat.h>
#include <cln/rational.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "analysis/exact/angle_variables.hpp"
#include "analysis/exact/least_shares.hpp"
#include "analysis/exact/solve_together.hpp"

namespace alembert {

using GiNaC::numeric;

namespace {

using Key = RealState::Key;

/// Small numbers for the first seeds, less simple ones for larger seeds.
class Numbers {
public:
    explicit Numbers(unsigned seed, Draws draws = Draws::simple)
        : random_(seed), draws_(draws), spread_(3 + std::min(seed, 400U) / 20), below_(pick(3, 4 + spread_)) {}
    numeric positive() {
        if (draws_ == Draws::at_random) return numeric(1 + static_cast<int>(random_() >> 2U)) / numeric(1 << 28);
        const int below = pick(1, 1 + spread_ / 4);  // drawn first: operands of one expression have no order
        return numeric(pick(1, spread_)) / numeric(below);
    }
    numeric any() { return pick(0, 1) != 0 ? positive() : -positive(); }
    /// Numbers within (−1, 1) with a common denominator. The components of a unit quaternion are of this kind, and
    /// otherwise one is rarely found.
    numeric small() {
        const int below = pick(0, 1) != 0 ? below_ : -below_;
        return numeric(pick(1, below_ - 1)) / numeric(below);
    }
    /// Between −1 and 1, in hundredths unless at random.
    double share() {
        if (draws_ == Draws::at_random) return std::ldexp(static_cast<double>(random_() >> 2U), -29) - 1;
        return static_cast<double>(pick(-100, 100)) / 100;
    }
    unsigned choice(unsigned count) { return static_cast<unsigned>(pick(0, static_cast<int>(count) - 1)); }
    numeric tangent() {
        const int below = pick(2, 2 + spread_ / 2);
        const numeric r = numeric(pick(1, below)) / numeric(below == 1 ? 1 : below);
        return pick(0, 1) != 0 ? r : -r;
    }

private:
    int pick(int low, int high) {
        return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
    }
    std::mt19937 random_;
    Draws draws_;
    int spread_, below_;
};

/// The value with so many significant digits.
numeric decimal(double value, int digits) {
    if (value == 0) return 0;
    const int power = digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
    const numeric ten = 10;
    return numeric(cln::cl_N(cln::round1(cln::rational(cln::cl_DF(value)) *
                                         cln::the<cln::cl_RA>(GiNaC::pow(ten, numeric(power)).to_cl_N())))) /
           GiNaC::pow(ten, numeric(power));
}

/// From which number a root is looked for.
numeric first_guess(unsigned seed, bool both_ways) {
    if (!both_ways) return numeric(1, 3) + numeric(static_cast<int>(seed % 7));
    const numeric size =
        numeric(1, 3) + numeric(static_cast<int>((seed / 2) % 7), 1 + static_cast<int>((seed / 14) % 3));
    return seed % 2 == 0 ? size : -size;
}

/// A root of the polynomial through the values at −1, 0, 1 (and at 2 and 17/5, to check that its degree is not
/// higher), a fraction if there is one. `seed` chooses among several.
std::optional<numeric> root_of(const std::function<std::optional<numeric>(const numeric&)>& f, bool floats,
                               bool both_ways, unsigned seed) {
    std::array<numeric, 4> y;
    for (int k = 0; k < 4; ++k) {
        const auto value = f(numeric(k - 1));
        if (!value) return std::nullopt;
        y[static_cast<std::size_t>(k)] = *value;
    }
    if (y[1].is_zero() && seed % 2 == 0) return numeric(0);
    const numeric c = y[1], b = (y[2] - y[0]) / 2, a = (y[2] + y[0]) / 2 - c;
    const auto is_on_it = [&](const numeric& x, const numeric& value) {
        const numeric beyond = value - ((a * x + b) * x + c);
        return beyond.is_rational() ? beyond.is_zero()
                                    : GiNaC::abs(beyond) < numeric(1, 1000000) * numeric(1, 1000000);
    };
    bool quadratic = is_on_it(2, y[3]);
    if (const numeric far(17, 5); quadratic) {
        const auto value = f(far);
        quadratic = !value || is_on_it(far, *value);
    }
    if (quadratic && a.is_zero())
        return b.is_zero() ? (c.is_zero() ? std::optional(numeric(1)) : std::nullopt) : std::optional(-c / b);
    if (quadratic) {
        const numeric discriminant = b * b - 4 * a * c;
        if (discriminant.is_negative()) return std::nullopt;
        const numeric root = GiNaC::sqrt(discriminant);
        if (!root.is_rational() && !floats) return std::nullopt;
        return (seed % 4 < 2 ? root - b : -root - b) / (2 * a);
    }
    if (!floats) return std::nullopt;
    // The secant method from two guesses, with 50 digits.
    numeric x0 = first_guess(seed, both_ways), x1 = x0 + numeric(1, 15);
    auto f0 = f(x0), f1 = f(x1);
    for (int step = 0; step < 60 && f0 && f1; ++step) {
        const numeric slope = *f1 - *f0;
        if (slope.is_zero()) break;
        const numeric x2 = x1 - *f1 * (x1 - x0) / slope;
        x0 = x1, f0 = f1, x1 = GiNaC::ex_to<numeric>(GiNaC::ex(x2).evalf());
        f1 = f(x1);
        if (!f1 || GiNaC::abs(x1 - x0) > GiNaC::pow(numeric(10), numeric(-45))) continue;
        return GiNaC::abs(x1) < GiNaC::pow(numeric(10), numeric(-30)) ? numeric(0) : x1;
    }
    return std::nullopt;
}

bool is_almost_zero(const numeric& x) {
    return x.is_zero() || (!x.is_rational() && GiNaC::abs(x) <= GiNaC::pow(numeric(10), numeric(-35)));
}

void put(RealState& state, const Key& key, const numeric& x) {
    if (state.angle.contains(key))
        put_angle(state, key, {x});
    else
        state.value[key] = x;
}

/// Newton's method from `x`. Angles are changed by the tangent of their half.
bool solve_for(const Motions& motions, RealState& state, const std::vector<int>& conditions,
               const std::vector<Key>& keys, std::vector<numeric> x) {
    const auto at = [&](const std::vector<numeric>& values) {
        for (std::size_t i = 0; i < keys.size(); ++i) put(state, keys[i], values[i]);
        return evaluate(motions.program(), state, conditions);
    };
    const auto found = solve_together(at, std::move(x));
    return found && at(*found);
}

bool solve_two(const Motions& motions, RealState& state, const SolvingStep& step, unsigned seed) {
    return solve_for(
        motions, state, {step.node, step.second->node},
        {{step.variable.kind, step.variable.index}, {step.second->variable.kind, step.second->variable.index}},
        {numeric(1 + static_cast<int>(seed % 5), 4), numeric(static_cast<int>(seed % 7) - 3, 3)});
}

/// Solves all loose conditions together for all coordinates in them, and at rest for all multipliers.
bool solve_loose(const Motions& motions, RealState& state, unsigned seed) {
    std::set<Key> angles, plain;
    find_variables(motions.program(), motions.loose(), angles, plain);
    angles.merge(plain);
    std::vector<Key> keys;
    std::vector<numeric> x;
    for (const Key& key : angles) {
        const bool is_force = motions.where() == Motions::At::rest && key.first == Variable::Kind::unknown;
        if (key.first != Variable::Kind::coordinate && !is_force) continue;
        x.emplace_back(static_cast<int>((seed * 7 + keys.size() * 5) % 23) - 11, 9);
        keys.push_back(key);
    }
    return solve_for(motions, state, motions.loose(), keys, std::move(x));
}

/// Whether a state of rest has the scene's own values of the parameters: where some are zero or equal, there can
/// be more states of rest.
bool has_own_values(const Motions& motions, unsigned seed) {
    return motions.where() == Motions::At::rest && seed % 4 == 3;
}

/// The order that this seed takes, one after the other.
SolvingOrder order_for(const Motions& motions, unsigned seed) {
    if (const auto& more = motions.contradicted(); !more.empty() && has_own_values(motions, seed) && seed % 8 == 3)
        return more[seed / 8 % more.size()];
    return {.steps = motions.steps(has_own_values(motions, seed) ? seed / 4 : seed - (seed + 1) / 4), .left = {}};
}

bool solve_positions(const Motions& motions, RealState& state, bool floats, unsigned seed) {
    if (!motions.loose().empty() && (!floats || !solve_loose(motions, state, seed))) return false;
    // Each coordinate at rest has roots of its own, and all combinations are wanted, the simplest first.
    constexpr unsigned simple = 12;
    const bool mixes = motions.where() == Motions::At::rest && seed >= first_float_seed + simple;
    unsigned own_seed = seed;
    const SolvingOrder order = order_for(motions, seed);
    for (const SolvingStep& step : order.steps) {
        if (mixes) own_seed = (own_seed + 1) * 2654435761U >> 7U;
        if (step.second) {
            if (!floats || !solve_two(motions, state, step, seed)) return false;
            continue;
        }
        const Key key{step.variable.kind, step.variable.index};
        const auto at = [&](const numeric& x, bool cleared) -> std::optional<numeric> {
            put(state, key, x);
            const auto value = evaluate(motions.program(), state, {step.node});
            if (!value) return std::nullopt;
            return cleared ? (*value)[0] * (1 + x * x) : (*value)[0];
        };
        const bool is_angle = state.angle.contains(key);
        const auto root = root_of([&](const numeric& x) { return at(x, is_angle); }, floats, mixes, own_seed);
        if (!root) return false;
        if (step.variable.kind == Variable::Kind::parameter) {
            const int sign = motions.sign_of_parameter(step.variable.index);
            if (sign != 0 && root->csgn() != sign) return false;
        }
        const auto rest = at(*root, false);
        if (!rest) return false;
        if (!is_almost_zero(*rest)) return false;
    }
    std::vector<int> others = order.left;
    others.insert(others.end(), motions.implied().begin(), motions.implied().end());
    const auto value = evaluate(motions.program(), state, others);
    return value && std::all_of(value->begin(), value->end(), is_almost_zero);
}

/// Solves for accelerations and multipliers. With friction on constraints the signs of the multipliers are tried,
/// as in Motions.
bool solve_accelerations(const Motions& motions, RealState& state, Numbers& numbers) {
    const auto n = static_cast<std::size_t>(motions.size()), m = static_cast<std::size_t>(motions.constraints());
    const Motions::System& s = motions.entries();
    const std::vector<int>& rows_with_friction = motions.rows_with_friction();
    for (const int k : rows_with_friction) state.value[{Variable::Kind::unknown, k}] = 0;
    std::vector<int> roots = s.M;
    for (const auto* part : {&s.f, &s.A, &s.gamma}) roots.insert(roots.end(), part->begin(), part->end());
    const auto value = evaluate(motions.program(), state, roots);
    if (!value) return false;
    std::vector<std::vector<numeric>> rows(n + m, std::vector<numeric>(n + m + 1));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) rows[i][j] = (*value)[i * n + j];
        rows[i][n + m] = (*value)[n * n + i];
        for (std::size_t k = 0; k < m; ++k) {
            rows[n + k][i] = (*value)[n * n + n + k * n + i];
            rows[i][n + k] = -rows[n + k][i];
        }
    }
    for (std::size_t k = 0; k < m; ++k) rows[n + k][n + m] = (*value)[n * n + n + m * n + k];
    std::vector<std::vector<numeric>> friction;
    for (const int k : rows_with_friction) {
        state.value[{Variable::Kind::unknown, k}] = 1;
        const auto pressed = evaluate(motions.program(), state, s.f);
        state.value[{Variable::Kind::unknown, k}] = 0;
        if (!pressed) return false;
        friction.emplace_back();
        for (std::size_t i = 0; i < n; ++i) friction.back().push_back((*pressed)[i] - rows[i][n + m]);
    }
    const unsigned choices = 1U << rows_with_friction.size(),
                   first = rows_with_friction.empty() ? 0 : numbers.choice(choices);
    for (unsigned choice = 0; choice < choices; ++choice) {
        std::vector<std::vector<numeric>> system = rows;
        const auto sign = [&](std::size_t r) { return (((first ^ choice) >> r) & 1U) != 0 ? -1 : 1; };
        for (std::size_t r = 0; r < rows_with_friction.size(); ++r)
            for (std::size_t i = 0; i < n; ++i)
                system[i][n + static_cast<std::size_t>(rows_with_friction[r])] -= sign(r) * friction[r][i];
        auto solution = solve_rows(system, n + m);  // on another branch all may be determined
        if (!solution && !motions.open_unknowns().empty()) {
            for (const std::size_t k : motions.open_unknowns()) {
                system.emplace_back(n + m + 1);
                system.back()[k] = 1;
                system.back()[n + m] = numbers.any();
            }
            solution = solve_rows(std::move(system), n + m);
        }
        if (!solution) return false;
        bool fits = true;
        for (std::size_t r = 0; r < rows_with_friction.size(); ++r)
            fits = fits && (*solution)[n + static_cast<std::size_t>(rows_with_friction[r])].csgn() * sign(r) > 0;
        if (!fits) continue;
        for (std::size_t i = 0; i < n; ++i)
            state.value[{Variable::Kind::acceleration, static_cast<int>(i)}] = (*solution)[i];
        for (std::size_t k = 0; k < m; ++k)
            state.value[{Variable::Kind::unknown, static_cast<int>(k)}] = (*solution)[n + k];
        return true;
    }
    return false;
}

enum class Rates { drawn, kept };

bool solve_motion(const Motions& motions, RealState& state, Numbers& numbers, Rates rates) {
    const auto n = static_cast<std::size_t>(motions.size()), m = static_cast<std::size_t>(motions.constraints());
    const Motions::System& s = motions.entries();
    for (std::size_t i = 0; i < n; ++i) {
        const Key key{Variable::Kind::rate, static_cast<int>(i)};
        if (rates == Rates::drawn || !state.value.contains(key)) state.value[key] = numbers.any();
    }
    if (m > 0) {
        // The rates nearest to the chosen ones would be fractions of large numbers. Therefore the equations are
        // solved for the rates of the pivots.
        const auto A = evaluate(motions.program(), state, s.A), b = evaluate(motions.program(), state, s.offset);
        if (!A || !b) return false;
        std::vector<std::size_t> pivots;
        std::vector<std::vector<numeric>> rows(m, std::vector<numeric>(n));
        for (std::size_t k = 0; k < m; ++k) {
            for (std::size_t i = 0; i < n; ++i) rows[k][i] = (*A)[k * n + i];
            for (std::size_t p = 0; p < pivots.size(); ++p) {
                const numeric factor = rows[k][pivots[p]] / rows[p][pivots[p]];
                for (std::size_t i = 0; i < n; ++i) rows[k][i] -= factor * rows[p][i];
                rows[k][pivots[p]] = 0;
            }
            const auto pivot = std::max_element(
                rows[k].begin(), rows[k].end(),
                [](const numeric& a, const numeric& b2) { return GiNaC::abs(a) < GiNaC::abs(b2); });
            if (GiNaC::abs(*pivot) < GiNaC::pow(numeric(10), numeric(-30))) return false;
            pivots.push_back(static_cast<std::size_t>(pivot - rows[k].begin()));
        }
        std::vector<std::vector<numeric>> equations(m, std::vector<numeric>(m + 1));
        for (std::size_t k = 0; k < m; ++k) {
            equations[k][m] = -(*b)[k];
            for (std::size_t i = 0; i < n; ++i) {
                const auto column = std::find(pivots.begin(), pivots.end(), i);
                if (column != pivots.end())
                    equations[k][static_cast<std::size_t>(column - pivots.begin())] = (*A)[k * n + i];
                else
                    equations[k][m] -= (*A)[k * n + i] * state.value[{Variable::Kind::rate, static_cast<int>(i)}];
            }
        }
        const auto solved = solve_rows(std::move(equations), m);
        if (!solved) return false;
        for (std::size_t k = 0; k < m; ++k)
            state.value[{Variable::Kind::rate, static_cast<int>(pivots[k])}] = (*solved)[k];
    }
    return solve_accelerations(motions, state, numbers);
}

/// Takes the multipliers of least norm that give the same forces, if constraints depend on each other.
bool share_out(const Motions& motions, RealState& state, Numbers& numbers) {
    const auto n = static_cast<std::size_t>(motions.size()), m = static_cast<std::size_t>(motions.constraints());
    std::vector<int> wanted = motions.entries().A;
    wanted.insert(wanted.end(), motions.entries().redundant.begin(), motions.entries().redundant.end());
    const auto value = evaluate(motions.program(), state, wanted);
    if (!value) return false;
    std::vector<std::vector<numeric>> rows(wanted.size() / n);
    std::vector<numeric> lambda;
    const auto key = [&](std::size_t r) {
        return Key{Variable::Kind::unknown, motions.multiplier(static_cast<int>(r))};
    };
    for (std::size_t r = 0; r < rows.size(); ++r) {
        rows[r].assign(value->begin() + static_cast<std::ptrdiff_t>(r * n),
                       value->begin() + static_cast<std::ptrdiff_t>((r + 1) * n));
        lambda.push_back(state.value.try_emplace(key(r), numbers.any()).first->second);
    }
    const auto least = least_shares(rows, m, lambda, [m](std::vector<std::vector<numeric>> system) {
        return solve_rows(std::move(system), m);
    });
    if (!least) return false;
    for (std::size_t r = 0; r < rows.size(); ++r) state.value[key(r)] = (*least)[r];
    return true;
}

/// The variables of the equations and of the claims.
struct AllVariables {
    AllVariables(const Motions& motions, const Program& claims, const std::vector<int>& roots) {
        const Motions::System& s = motions.entries();
        std::vector<int> entries = s.M;
        for (const auto* part :
             {&s.f, &s.A, &s.offset, &s.gamma, &s.redundant, &motions.loose(), &motions.implied()})
            entries.insert(entries.end(), part->begin(), part->end());
        for (const SolvingStep& step : motions.steps()) entries.push_back(step.node);
        find_variables(motions.program(), entries, angles, plain);
        find_variables(claims, roots, angles, plain);
        for (const std::set<Key>* keys : {&angles, &plain}) all.insert(keys->begin(), keys->end());
        for (int i = 0; i < motions.size(); ++i) all.insert({Variable::Kind::coordinate, i});
    }
    bool is_angle(const Key& key) const {
        return angles.contains(key) && !plain.contains(key) &&
               (key.first == Variable::Kind::coordinate || key.first == Variable::Kind::parameter ||
                key.first == Variable::Kind::time);
    }

    std::set<Key> angles, plain, all;
};

/// The rates, accelerations and multipliers of a state with positions.
std::optional<RealState> moving(const Motions& motions, RealState state, Numbers& numbers, Rates rates) {
    if (motions.where() == Motions::At::motion && !solve_motion(motions, state, numbers, rates))
        return std::nullopt;
    if (!motions.entries().redundant.empty() && !share_out(motions, state, numbers)) return std::nullopt;
    for (auto& [key, value] : state.value)
        if (is_almost_zero(value)) value = 0;
    for (const auto& [key, value] : state.value)
        state.exact = state.exact && (value.is_rational() || state.angle.contains(key));
    return state;
}

/// Moves variables that are drawn until the sides have the signs of the cell, as far as these variables decide
/// them.
class Steering {
public:
    /// `positive`: nodes of the program that are to be positive too.
    Steering(const Program& program, const Cells& cells, Cell cell, const std::vector<int>& positive)
        : program_(program), cell_(cell), sides_(cells.sides()), of_cell_(sides_.size()) {
        sides_.insert(sides_.end(), positive.begin(), positive.end());
    }

    void steer(RealState& state, Numbers& numbers) const {
        constexpr int most_moves = 40;
        for (int moves = 0; moves < most_moves; ++moves) {
            const std::optional<std::size_t> wrong = wrong_side(state);
            if (!wrong) return;
            move(state, *wrong, numbers);
        }
    }

private:
    bool is_wanted_positive(std::size_t k) const { return k >= of_cell_ || (cell_ >> k & 1U) != 0; }

    /// The first whose sign is not that of the cell and follows from what is drawn.
    std::optional<std::size_t> wrong_side(const RealState& state) const {
        for (std::size_t k = 0; k < sides_.size(); ++k) {
            const auto value = side(state, k);
            if (value && (value->is_zero() || value->is_positive() != is_wanted_positive(k))) return k;
        }
        return std::nullopt;
    }

    std::optional<numeric> side(const RealState& state, std::size_t k) const {
        const int node = sides_[k];
        if ((program_[node].depends & (bit(Variable::Kind::acceleration) | bit(Variable::Kind::unknown))) != 0)
            return std::nullopt;
        const auto values = evaluate(program_, state, {node});
        return values ? std::optional(values->front()) : std::nullopt;
    }

    /// A step of the secant method for one variable of the side, and beyond the root.
    void move(RealState& state, std::size_t k, Numbers& numbers) const {
        std::set<Key> angles, plain;
        find_variables(program_, {sides_[k]}, angles, plain);
        angles.merge(plain);
        std::vector<Key> keys(angles.begin(), angles.end());
        const auto is_parameter = [](const Key& key) { return key.first == Variable::Kind::parameter; };
        if (!std::all_of(keys.begin(), keys.end(), is_parameter)) std::erase_if(keys, is_parameter);
        if (keys.empty()) return;
        const Key key = keys[numbers.choice(static_cast<unsigned>(keys.size()))];
        const numeric x0 = at(state, key), x1 = x0 + numeric(1, 3);
        const auto f0 = side(state, k);
        put(state, key, x1);
        const auto f1 = side(state, k);
        put(state, key, x0);
        if (!f0 || !f1 || (*f1 - *f0).is_zero()) return put_near(state, key, x0, numbers.any());
        const numeric root = x0 - *f0 * (x1 - x0) / (*f1 - *f0);
        const bool up = (*f1 - *f0).is_positive() == is_wanted_positive(k);
        const std::array<numeric, 4> beyond{numeric(1, 50), numeric(1, 5), numeric(1), numeric(7)};
        const numeric step = beyond[numbers.choice(beyond.size())];
        put_near(state, key, root, up ? step : -step);
    }

    static numeric at(const RealState& state, const Key& key) {
        const auto angle = state.angle.find(key);
        return angle != state.angle.end() ? angle->second.tangent : state.value.at(key);
    }

    static void put_near(RealState& state, const Key& key, const numeric& x, const numeric& step) {
        constexpr double farthest = 1e9;  // a secant that is nearly level leads anywhere
        const double aim = (x + step).to_double();
        if (!(std::abs(aim) < farthest)) return;
        const numeric moved = decimal(aim, 4);
        const bool keeps_sign = key.first == Variable::Kind::parameter || key.first == Variable::Kind::time;
        if (!keeps_sign || moved.csgn() == at(state, key).csgn()) put(state, key, moved);
    }

    const Program& program_;
    const Cell cell_;
    std::vector<int> sides_;
    const std::size_t of_cell_;  ///< how many of them are sides of the cell
};

std::optional<RealState> drawn(const Motions& motions, const Program& claims, const std::vector<int>& roots,
                               const Steering* steering, unsigned seed) {
    if (!motions.obstacle().empty() && motions.loose().empty()) return std::nullopt;
    const FiftyDigits digits;
    Numbers numbers(seed);
    const bool floats = seed >= first_float_seed;
    const AllVariables variables(motions, claims, roots);
    RealState state;
    for (const Key& key : variables.all) {
        if (variables.is_angle(key))
            put_angle(state, key, {numbers.tangent()});
        else if (has_own_values(motions, seed) && key.first == Variable::Kind::parameter)
            state.value[key] = motions.own_value(key.second);
        else if (key.first == Variable::Kind::parameter || key.first == Variable::Kind::time) {
            const int sign = key.first == Variable::Kind::parameter ? motions.sign_of_parameter(key.second) : 1;
            state.value[key] = sign == 0 ? numbers.any() : sign * numbers.positive();
        } else
            state.value[key] =
                seed % 2 == 1 && key.first == Variable::Kind::coordinate ? numbers.small() : numbers.any();
    }
    if (motions.where() == Motions::At::rest) {
        for (int i = 0; i < motions.size(); ++i)
            for (const Variable::Kind kind : {Variable::Kind::rate, Variable::Kind::acceleration})
                state.value[{kind, i}] = 0;
        for (int k = 0; k < motions.constraints(); ++k) state.value[{Variable::Kind::unknown, k}] = numbers.any();
    }
    if (steering != nullptr) steering->steer(state, numbers);
    if (!solve_positions(motions, state, floats, seed)) return std::nullopt;
    return moving(motions, std::move(state), numbers, steering != nullptr ? Rates::kept : Rates::drawn);
}

}  // namespace

std::optional<RealState> real_state(const Motions& motions, const Program& claims, const std::vector<int>& roots,
                                    unsigned seed) {
    return drawn(motions, claims, roots, nullptr, seed);
}

std::optional<RealState> real_state_towards(const Motions& motions, const Program& claims,
                                            const std::vector<int>& roots, const Wanted& wanted, unsigned seed) {
    const Steering steering(claims, wanted.cells, wanted.cell, wanted.positive);
    return drawn(motions, claims, roots, &steering, seed);
}

std::optional<RealState> real_state_on_own_branch(const Motions& motions, const Program& claims,
                                                  const std::vector<int>& roots, unsigned seed, Draws draws) {
    constexpr double reach = 0.02;
    if (!motions.own() || motions.own()->places.empty()) return std::nullopt;
    const FiftyDigits digits;
    Numbers numbers(seed, draws);
    std::vector<int> conditions = motions.loose();
    for (const SolvingStep& step : motions.steps()) {
        conditions.push_back(step.node);
        if (step.second) conditions.push_back(step.second->node);
    }
    const bool goes_far = seed >= first_far_seed && !motions.own()->farther.empty();
    const std::vector<State<double>>& places = goes_far ? motions.own()->farther : motions.own()->places;
    const State<double>& place = places[seed % places.size()];
    const auto solved = OwnSlopes(motions.program(), *motions.own()).determined(conditions, place);
    if (solved.size() < conditions.size()) return std::nullopt;
    std::set<Key> angles, plain;
    find_variables(motions.program(), conditions, angles, plain);
    const auto put = [&](RealState& to, const Key& key, double value) {
        const bool stays = seed == 0 && key.first != Variable::Kind::coordinate;
        const bool is_angle = angles.contains(key) && !plain.contains(key);
        const double size = value == 0 || is_angle ? 1 : std::abs(value);
        const double beside = value + reach * numbers.share() * size;
        to.value[key] = stays                       ? decimal(value, 12)
                        : draws == Draws::at_random ? numeric(cln::cl_N(cln::rational(cln::cl_DF(beside))))
                                                    : decimal(beside, 3);
    };
    auto state = state_beside(motions.program(), conditions, place, solved, reach, put);
    if (!state) return std::nullopt;
    for (const Key& key : AllVariables(motions, claims, roots).all) {
        if (state->value.contains(key)) continue;
        if (key.first == Variable::Kind::coordinate || key.first == Variable::Kind::parameter ||
            key.first == Variable::Kind::time)
            put(*state, key, value_at(place, key));
        else
            state->value[key] = numbers.any();
    }
    const auto implied = evaluate(motions.program(), *state, motions.implied());
    if (!implied || !std::all_of(implied->begin(), implied->end(), is_almost_zero)) return std::nullopt;
    return moving(motions, *std::move(state), numbers, Rates::drawn);
}

}  // namespace alembert
