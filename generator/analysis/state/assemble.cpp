// SPDX-License-Identifier: GPL-2.0-or-later
// f(q) = 0 is solved by q ← q − J⁺ f, where J = ∂f/∂q has the columns of the guesses only; J⁺ gives the least
// change (Golub & Van Loan, §5.5).
#include "analysis/state/assemble.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "alembert/base/dense.hpp"
#include "alembert/base/random.hpp"
#include "alembert/base/tolerances.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"
#include "program/rounding.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

constexpr int most_rounds = 100;
constexpr double small_step = 1e-8;  // a larger one does not remove what is only rounding
/// An entry of a row of the constraints, compared with the largest of the row, that is the rounding of 0, like
/// sin π.
constexpr double rounded_off = 8 * std::numeric_limits<double>::epsilon();

class Assembly {
public:
    Assembly(Start& start, const Mechanism& m, const Program& p, const Overrides& held)
        : start_(start), m_(m), p_(p), rows_(p.nodes_of(Group::row)) {
        const std::size_t n = m.q.size();
        if (rows_.size() != n * m.constraints.size() || p.nodes_of(Group::form_row).size() != n * m.speeds.size())
            throw std::logic_error(
                "assemble: this program does not have all rows of the constraints and the speeds; take "
                "lower_constraints");
        const auto may_move = [&](const std::string& name, bool guess) {
            return guess && std::none_of(held.begin(), held.end(), [&](const auto& h) { return h.first == name; });
        };
        for (int i = 0; i < m.size(); ++i) {
            if (may_move(m.q[i].get_name(), m.q_is_guess[i])) q_free_.push_back(i);
            if (may_move(m.q[i].get_name() + "'", m.qdot_is_guess[i])) u_free_.push_back(i);
        }
    }

    std::vector<std::string> go(bool rates_must_obey) {
        settle_positions();
        if (!start_.speeds.empty()) {
            try {
                solve_for_rates(true);
                check(p_.nodes_of(Group::velocity), start_.qdot, false);
            } catch (const ModelError&) {
                if (rates_must_obey || m_.speeds.size() < m_.q.size()) throw;
                solve_for_rates(false);
            }
            return std::move(moved_);
        }
        const std::vector<double> given = start_.qdot;
        try {
            settle(Group::velocity, start_.qdot, u_free_, "'");
        } catch (const std::runtime_error&) {
            if (rates_must_obey) throw;
            start_.qdot = given;
        }
        return std::move(moved_);
    }

private:
    void settle_positions() {
        const std::vector<double> given = start_.q;
        const bool may_turn = !p_.nodes_of(Group::alignment).empty() && !q_free_.empty();
        std::optional<IntegrationError> failed;
        try {
            solve(Group::position, start_.q, q_free_);
        } catch (const IntegrationError& error) {
            if (!may_turn) throw;
            failed = error;
        }
        std::optional<std::string> turned;
        if (!failed) turned = turned_joint(m_, p_, start_.state());
        if (may_turn && (failed || turned) && !turn_back(given)) {
            if (failed) throw IntegrationError(*failed);
            throw IntegrationError(*turned, start_.t, start_.q);
        }
        if (!may_turn && turned) throw IntegrationError(*turned, start_.t, start_.q);
        report(given, start_.q, q_free_, "");
    }

    /// Takes the pose nearest to the guesses in which no joint is turned, of those that are found from the guesses
    /// and from places around them and around the turned pose, the same in every run. False if none is found.
    bool turn_back(const std::vector<double>& given) {
        constexpr int places = 16;
        constexpr double reach = 0.1;
        const std::vector<double> found = start_.q;
        std::mt19937_64 random(5);
        const UniformReal<> part(-1, 1);
        const Eigen::Map<const Eigen::VectorXd> wanted(given.data(), m_.size());
        std::optional<std::vector<double>> nearest;
        double least = HUGE_VAL;
        for (int k = 0; k < places; ++k) {
            start_.q = k % 2 == 0 ? given : found;
            for (const int i : q_free_) start_.q[i] += k * reach * part(random);
            align();
            if (turned_joint(m_, p_, start_.state())) continue;
            try {
                solve(Group::position, start_.q, q_free_);
            } catch (const IntegrationError&) {
                continue;
            }
            const double away = (Eigen::Map<const Eigen::VectorXd>(start_.q.data(), m_.size()) - wanted).norm();
            if (!(away < least) || turned_joint(m_, p_, start_.state())) continue;
            least = away;
            nearest = start_.q;
        }
        if (nearest) start_.q = *nearest;
        return nearest.has_value();
    }

    /// Guesses may lie nearer to a pose in which a joint is turned. The products of its axes are rows here too,
    /// which no such pose obeys.
    void align() {
        constexpr double apart = 1e-5, longest = 0.5;  // of coordinates: for a difference, and in one step
        const std::vector<int> positions = p_.nodes_of(Group::position), axes = p_.nodes_of(Group::alignment);
        const auto m = static_cast<Eigen::Index>(positions.size()), a = static_cast<Eigen::Index>(axes.size()),
                   n = static_cast<Eigen::Index>(q_free_.size());
        const auto products = [&](const Start& at) {
            const std::vector<double> value = interpret(p_, at.state());
            Eigen::VectorXd result(a);
            for (Eigen::Index k = 0; k < a; ++k) result[k] = value[axes[k]];
            return result;
        };
        for (int round = 0; round < most_rounds; ++round) {
            const std::vector<double> value = interpret(p_, start_.state());
            Eigen::VectorXd f(m + a);
            Eigen::MatrixXd J(m + a, n);
            f.tail(a) = products(start_).array() - 1;
            for (Eigen::Index k = 0; k < m; ++k) f[k] = value[positions[k]];
            for (Eigen::Index j = 0; j < n; ++j) {
                for (Eigen::Index k = 0; k < m; ++k) J(k, j) = value[rows_[k * m_.size() + q_free_[j]]];
                Start more = start_, less = start_;
                more.q[q_free_[j]] += apart;
                less.q[q_free_[j]] -= apart;
                const auto flat = [](double slope) {
                    return std::abs(slope) < 1e-6 ? 0 : slope;
                };  // rounding of 1
                J.col(j).tail(a) = ((products(more) - products(less)) / (2 * apart)).unaryExpr(flat);
            }
            Eigen::VectorXd step = least_norm(J, f).x;
            if (const double length = step.lpNorm<Eigen::Infinity>(); length > longest) step *= longest / length;
            if (!step.allFinite() || step.lpNorm<Eigen::Infinity>() < small_step) return;
            for (Eigen::Index j = 0; j < n; ++j) start_.q[q_free_[j]] -= step[j];
        }
    }

    /// Solves for all rates from the initial speeds and, if `obeyed`, the constraints; both are linear in the
    /// rates.
    void solve_for_rates(bool obeyed) {
        std::vector<int> nodes = obeyed ? p_.nodes_of(Group::velocity) : std::vector<int>(),
                         rows = obeyed ? rows_ : std::vector<int>();
        const std::vector<int> speeds = p_.nodes_of(Group::speed), forms = p_.nodes_of(Group::form_row);
        nodes.insert(nodes.end(), speeds.begin(), speeds.end());
        rows.insert(rows.end(), forms.begin(), forms.end());
        const auto m = static_cast<Eigen::Index>(nodes.size()), n = static_cast<Eigen::Index>(m_.size());
        const auto constraints = m - static_cast<Eigen::Index>(speeds.size());
        start_.qdot.assign(start_.qdot.size(), 0);
        for (int round = 0; round < 2; ++round) {  // the second round removes what rounding left in the first
            const std::vector<double> value = interpret(p_, start_.state());
            Eigen::VectorXd residual(m);
            Eigen::MatrixXd J(m, n);
            for (Eigen::Index k = 0; k < m; ++k) {
                residual[k] = value[nodes[k]] - (k < constraints ? 0 : start_.speeds[k - constraints]);
                for (Eigen::Index j = 0; j < n; ++j) J(k, j) = value[rows[k * n + j]];
            }
            const LeastNorm change = least_norm(J, residual);
            if (change.rank < n)
                throw IntegrationError(say("the speeds do not determine the rates at the start: their forms, with "
                                           "the constraints, lose "
                                           "rank at these coordinates; start elsewhere, or choose other "
                                           "coordinates (a quaternion, for "
                                           "angles in gimbal lock)"),
                                       start_.t, start_.q);
            const Eigen::VectorXd step = change.x;
            for (Eigen::Index j = 0; j < n; ++j) start_.qdot[j] -= step[j];
        }
        const std::vector<double> value = interpret(p_, start_.state()), size = sizes_of_terms(p_, start_.state());
        for (std::size_t k = 0; k < speeds.size(); ++k) {
            const double residual = std::abs(value[speeds[k]] - start_.speeds[k]);
            double row = 0,
                   largest = 0;  // the terms may all be zero, except for the rounding of the solution
            for (Eigen::Index j = 0; j < n; ++j) {
                row += std::abs(value[forms[k * static_cast<std::size_t>(n) + static_cast<std::size_t>(j)]]);
                largest = std::max(largest, std::abs(start_.qdot[j]));
            }
            const double rounding = 64 * std::numeric_limits<double>::epsilon() * row * largest;
            if (!(residual <=
                  tolerance::initial_values * (size[speeds[k]] + std::abs(start_.speeds[k])) + rounding))
                throw ModelError(
                    say("speed '{}' is {:.6g} at the start and cannot be had: the other speeds and the "
                        "constraints leave it off by {:.6g} at these coordinates",
                        m_.speeds[k].u.get_name(), start_.speeds[k], residual));
        }
    }

    void settle(Group group, std::vector<double>& x, const std::vector<int>& free, const char* prime) {
        const std::vector<double> before = x;
        solve(group, x, free);
        report(before, x, free, prime);
    }

    void report(const std::vector<double>& before, const std::vector<double>& x, const std::vector<int>& free,
                const char* prime) {
        for (const int i : free)
            if (std::abs(x[i] - before[i]) >
                1e-14 * std::max(1.0, std::abs(before[i])))  // a smaller change is rounding and is not reported
                moved_.push_back(moved_in_own_unit(m_, m_.q[i].get_name() + prime, before[i], x[i]));
    }

    void solve(Group group, std::vector<double>& x, const std::vector<int>& free) {
        const std::vector<int> nodes = p_.nodes_of(group);
        const auto m = static_cast<Eigen::Index>(nodes.size()), n = static_cast<Eigen::Index>(free.size());
        double former = HUGE_VAL;
        for (int round = 0; round < most_rounds && n > 0; ++round) {
            const std::vector<double> value = interpret(p_, start_.state());
            Eigen::VectorXd f(m);
            Eigen::MatrixXd J(m, n);
            for (Eigen::Index k = 0; k < m; ++k) {
                f[k] = value[nodes[k]];
                const bool counts = group == Group::velocity || m_.constraints[k].position;
                const double least = rounded_off * size_of_row(static_cast<std::size_t>(k), value);
                for (Eigen::Index j = 0; j < n; ++j) {
                    const double entry = value[rows_[k * m_.size() + free[j]]];
                    J(k, j) = counts && !(std::abs(entry) < least) ? entry : 0;
                }
            }
            const double residual = f.lpNorm<Eigen::Infinity>();
            if (!(residual > 0) || (residual < 1e-12 && residual > former / 2)) break;
            former = residual;
            Eigen::VectorXd step = least_norm(J, f).x;
            // Far from the solution a full step may turn an angle by whole revolutions.
            if (const double length = step.lpNorm<Eigen::Infinity>(); group == Group::position && length > 1)
                step /= length;
            if (!step.allFinite() || (step.lpNorm<Eigen::Infinity>() > small_step && is_rounding(f, nodes))) break;
            for (Eigen::Index j = 0; j < n; ++j) x[free[j]] -= step[j];
        }
        check(nodes, x, n > 0);
    }

    /// Whether the constraints are off by no more than the rounding of their own values. Where a linkage lies
    /// flat, a step that removes it would be large.
    bool is_rounding(const Eigen::VectorXd& f, const std::vector<int>& nodes) const {
        const std::vector<double> rounded = rounding_errors(p_, start_.state());
        for (Eigen::Index k = 0; k < f.size(); ++k)
            if (!(std::abs(f[k]) <= rounded[nodes[k]])) return false;
        return true;
    }

    double size_of_row(std::size_t k, const std::vector<double>& value) const {
        double largest = 0;
        for (std::size_t i = 0; i < m_.q.size(); ++i)
            largest = std::max(largest, std::abs(value[rows_[k * m_.q.size() + i]]));
        return largest;
    }

    /// The rounding error of a step, here or in the computation that gave the values; the terms themselves may all
    /// be zero.
    double rounding(std::size_t k, const std::vector<double>& x, const std::vector<double>& value) const {
        double row = 0, largest = 0;
        for (int i = 0; i < m_.size(); ++i) {
            row += std::abs(value[rows_[k * m_.q.size() + i]]);
            largest = std::max(largest, std::abs(x[i]));
        }
        return 64 * std::numeric_limits<double>::epsilon() * row * largest;
    }

    void check(const std::vector<int>& nodes, const std::vector<double>& x, bool guessed) const {
        const State<double> state = start_.state();
        const std::vector<double> value = interpret(p_, state);
        std::vector<double> size, rounded;  // computed when the terms that are left do not suffice
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const double residual = std::abs(value[nodes[k]]);
            if (residual <= tolerance::initial_values * size_of_terms(p_, nodes[k], value)) continue;
            if (size.empty()) {
                size = sizes_of_terms(p_, state);
                rounded = rounding_errors(p_, state);
            }
            if (residual <= tolerance::initial_values * size[nodes[k]] + rounding(k, x, value) + rounded[nodes[k]])
                continue;
            if (!std::isfinite(residual))
                throw BrokenConstraint(
                    say("constraint '{}' is not finite at the start: it divides by zero there, or takes "
                        "a root or a logarithm of what has none; give other initial values",
                        m_.constraints[k].name),
                    m_.constraints[k].place);
            const std::string what =
                say("constraint '{}' is off by {:.6g} at the start", m_.constraints[k].name, residual);
            if (guessed)
                throw IntegrationError(say("{}: the guesses do not converge to a state that obeys it; try others, "
                                           "or let more values move",
                                           what),
                                       start_.t, start_.q);
            throw BrokenConstraint(
                say("{}; give initial values that obey it, or let some move: guess, rate_guess", what),
                m_.constraints[k].place);
        }
    }

    Start& start_;
    const Mechanism& m_;
    const Program& p_;
    std::vector<int> rows_, q_free_, u_free_;
    std::vector<std::string> moved_;
};

}  // namespace

std::string moved_in_own_unit(const Mechanism& m, const std::string& name, double from, double to) {
    const std::string coordinate = name.substr(0, name.find('\''));
    for (int i = 0; i < m.size(); ++i) {
        const Shown& shown = m.shown_units[static_cast<std::size_t>(i)];
        if (m.q[i].get_name() != coordinate || shown.unit.empty()) continue;
        return say("{} from {:.6g} to {:.17g} {}", name, from / shown.size, to / shown.size,
                   name == coordinate ? shown.unit : per_second(shown.unit));
    }
    return say("{} from {:.6g} to {:.17g}", name, from, to);
}

double size_of_terms(const Program& program, int id, const std::vector<double>& value) {
    const Node* node = &program[id];
    double factor = 1;
    while (node->is_scaled()) {
        factor *= std::abs(real_of<double>(node->coefficients[0]));
        node = &program[node->args[0]];
    }
    double sum = std::abs(real_of<double>(node->number));
    for (std::size_t k = 0; k < node->args.size(); ++k)
        sum += (node->op == Op::sum ? std::abs(real_of<double>(node->coefficients[k])) : 1) *
               std::abs(value[node->args[k]]);
    return factor * sum;
}

std::optional<std::string> turned_joint(const Mechanism& mechanism, const Program& program,
                                        const State<double>& state) {
    constexpr double aligned = 0.5;  // a product of axes is 1, or where they are turned 0 or less
    if (program.nodes_of(Group::alignment).empty()) return std::nullopt;
    const std::vector<double> value = interpret(program, state);
    for (const Root& root : program.roots) {
        const double product = value[static_cast<std::size_t>(root.node)];
        if (root.group != Group::alignment || !(product < aligned)) continue;
        const Mechanism::Alignment& one = mechanism.alignments[static_cast<std::size_t>(root.constraint)];
        return say(
            "joint '{}' is turned at the start: of its axes in the parent and in the child, which coincide where "
            "it "
            "closes, two are {:.6g} deg apart; give initial values or guesses nearer to the pose that is meant",
            mechanism.joints[static_cast<std::size_t>(one.joint)].name,
            std::acos(std::clamp(product, -1.0, 1.0)) * 180 / std::acos(-1.0));
    }
    return std::nullopt;
}

std::vector<std::string> assemble(Start& start, const Mechanism& mechanism, const Program& program,
                                  const Overrides& held, bool rates_must_obey) {
    return assemble(start, mechanism, program, held, LeftOut(mechanism), rates_must_obey);
}

std::vector<std::string> assemble(Start& start, const Mechanism& mechanism, const Program& program,
                                  const Overrides& held, const LeftOut& left_out, bool rates_must_obey) {
    std::vector<std::string> moved;
    const std::optional<LeftOut::Whole>& whole = left_out.whole();
    if (!mechanism.constraints.empty() || !start.speeds.empty())
        moved = (whole ? Assembly(start, whole->mechanism, whole->program, held)
                       : Assembly(start, mechanism, program, held))
                    .go(rates_must_obey);
    left_out.check(start);
    return moved;
}

namespace {

/// The state a little further on along its rates; nothing if it does not move or the constraints cannot be met.
std::optional<Start> moved_on(Start start, const Mechanism& movable, const Program& constraints) {
    constexpr double distance = 0.01;  // of the coordinate that moves fastest
    double fastest = 0;
    for (const double rate : start.qdot) fastest = std::max(fastest, std::abs(rate));
    if (!(fastest > 0)) return std::nullopt;
    for (std::size_t i = 0; i < start.q.size(); ++i) start.q[i] += distance * start.qdot[i] / fastest;
    start.t += distance / fastest;
    try {
        assemble(start, movable, constraints, {});
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
    return start;
}

}  // namespace

Start admissible_start(const Mechanism& m) {
    const Program constraints = lower_constraints(m);
    Mechanism movable = m;
    movable.q_is_guess.assign(m.q.size(), true);
    movable.qdot_is_guess.assign(m.q.size(), true);
    for (const Mechanism* one : {&m, static_cast<const Mechanism*>(&movable)}) {
        Start start = start_of(m);
        try {
            assemble(start, *one, constraints, {});
        } catch (const std::runtime_error&) {
            continue;
        }
        return moved_on(start, movable, constraints).value_or(start);
    }
    return start_of(m);
}

}  // namespace alembert
