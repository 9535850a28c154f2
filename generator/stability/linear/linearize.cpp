// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/linearize.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "stability/linear/dense_long.hpp"
#include "stability/linear/dependence.hpp"
#include "stability/linear/kinks.hpp"
#include "stability/linear/outputs.hpp"
#include "stability/linear/paths.hpp"
#include "stability/linear/steady.hpp"
#include "stability/linear/tangent.hpp"

namespace alembert {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

namespace {

/// Sets to zero elements that are only rounding: those that differ between two precisions by as much as their
/// size.
Matrix clean(const MatrixOf<long double>& exact, const Matrix& rough) {
    Matrix result = exact.cast<double>();
    const double largest = result.size() == 0 ? 0 : result.cwiseAbs().maxCoeff();
    for (Index i = 0; i < result.rows(); ++i)
        for (Index j = 0; j < result.cols(); ++j) {
            const long double value = exact(i, j);
            if (std::abs(value) < 1e-9L * largest && std::abs(value - rough(i, j)) > 1e-4L * std::abs(value))
                result(i, j) = 0;
            if (std::abs(value) < 1e-16L * largest) result(i, j) = 0;
        }
    return result;
}

template <typename M>
M symmetric(const M& m) {
    return (m + m.transpose()) / 2;
}
template <typename M>
M skew(const M& m) {
    return (m - m.transpose()) / 2;
}

/// States on which nothing depends and states that do not change have the eigenvalue 0 and can be removed exactly.
std::vector<std::complex<double>> eigenvalues_of(const MatrixOf<long double>& A) {
    std::vector<Index> left;
    for (Index i = 0; i < A.rows(); ++i) left.push_back(i);
    std::vector<std::complex<double>> result;
    for (bool again = true; again;) {
        again = false;
        for (std::size_t k = 0; k < left.size() && !again; ++k) {
            const auto zero = [&](bool row) {
                return std::all_of(left.begin(), left.end(),
                                   [&](Index i) { return (row ? A(left[k], i) : A(i, left[k])) == 0; });
            };
            if (!zero(true) && !zero(false)) continue;
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
            result.emplace_back(0, 0);
            again = true;
        }
    }
    if (!left.empty()) {
        MatrixOf<long double> rest(left.size(), left.size());
        for (std::size_t i = 0; i < left.size(); ++i)
            for (std::size_t j = 0; j < left.size(); ++j)
                rest(static_cast<Index>(i), static_cast<Index>(j)) = A(left[i], left[j]);
        const auto values = eigenvalues(rest);
        if (!values) throw IntegrationError(say("the eigenvalues do not converge"), 0, {});
        const long double size = rest.cwiseAbs().maxCoeff();
        const auto rounded = [&](long double x) {
            return std::abs(x) < 1e-17L * size ? 0.0 : static_cast<double>(x);
        };
        for (const auto& value : *values) result.emplace_back(rounded(value.real()), rounded(value.imag()));
    }
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
        return std::pair(a.real(), a.imag()) < std::pair(b.real(), b.imag());
    });
    return result;
}

class Linearizing {
public:
    Linearizing(const Mechanism& m, const Equations& e, About about)
        : m_(m), e_(e), about_(about), residuals_(m, e) {}

    /// About another state; which coordinates and speeds are independent is decided at the first.
    void move_to(const Start& start) {
        start_ = &start;
        state_ = state_of(start, m_, e_);
        at_ = instant_of<long double>(residuals_, state_);
        result_ = {};
        kept_.clear();
        if (split_.u.empty() && split_.q.empty()) {
            std::vector<bool> guessed(residuals_.s, false);
            if (residuals_.rates_are_speeds) guessed = m_.qdot_is_guess;
            split_ = split_of(residuals_, at_, m_.q_is_guess, guessed);
        }
    }

    /// What is not zero at this state and would be in a steady motion; empty where it is one.
    std::string unsteadiness() {
        if (!settle(residuals_, split_, at_))
            throw IntegrationError(
                say("the constraints cannot be solved for the dependent coordinates at this state"), state_.t,
                state_.q);
        at_kink_ = is_at_kink(residuals_, at_);
        here_ = tangent(residuals_, split_, at_, at_kink_);
        if (at_kink_) check_differentiable(residuals_, split_, at_, here_, m_, e_);
        p_ = static_cast<Index>(split_.u.size());
        nr_ = static_cast<Index>(split_.q.size());
        if (!here_.speed_rates.allFinite() || !here_.speed_rates_by.allFinite())
            throw IntegrationError(
                say("the mass matrix, constraints eliminated, is singular or not finite at this state"), state_.t,
                state_.q);
        if (about_ == About::any) {
            for (Index j = 0; j < nr_; ++j) kept_.push_back(j);
            return "";
        }
        depends_ = dependences(residuals_, split_, at_);
        const std::vector<bool> essential = essential_coordinates(depends_, residuals_, split_, at_);
        check_time();
        return find_motion(essential);
    }

    Linearization go() {
        if (const std::string residual = unsteadiness(); !residual.empty()) refuse(residual);
        fill();
        return std::move(result_);
    }

private:
    std::string coordinate(Index j) const { return m_.q[split_.q[j]].get_name(); }
    std::string speed(Index i) const { return e_.u[split_.u[i]].get_name(); }

    void check_time() const {
        for (Index i = 0; i < p_ + nr_; ++i)
            if (depends_(i, nr_ + p_))
                throw ModelError(
                    say("the equations change with time ({}' holds t, and not through inputs); there is no "
                        "equilibrium or steady motion to linearize about",
                        i < p_ ? speed(i) : coordinate(i - p_)));
    }

    /// The size of the unit in which `--at` takes a coordinate or a state.
    double shown_size(const std::string& name) const {
        const auto of = [](const Shown& shown) { return shown.unit.empty() ? 1 : shown.size; };
        for (int i = 0; i < m_.size(); ++i)
            if (m_.q[i].get_name() == name) return of(m_.shown_units[static_cast<std::size_t>(i)]);
        for (const Mechanism::State& z : m_.states)
            if (z.derivative[0].get_name() == name) return of(z.shown);
        return 1;
    }

    [[noreturn]] void refuse(const std::string& residual) const {
        std::string nearby;
        for (const auto& [name, value] : steady_nearby(m_, e_, *start_)) {
            const double size = shown_size(name);
            const std::string typed = size == 1 ? value : fmt::format("{}", std::stod(value) / size);
            nearby += fmt::format("{}--at {}={}", nearby.empty() ? "" : " ", name, typed);
        }
        throw ModelError(
            say("this state is no equilibrium and no steady motion: {}; expected zeros, or `stability --matrices` "
                "with "
                "--affine, about any state, or with --along, about a motion. {}",
                residual,
                nearby.empty()
                    ? say("Ask at a state where they are, or give it as initial values; `equilibrium` finds them")
                    : say("One that is, reached from here by Newton's method: {}; `equilibrium` finds "
                          "them all",
                          nearby)));
    }

    /// Which coordinates are cyclic, which of them move, and which are states. Gives what is not steady.
    std::string find_motion(const std::vector<bool>& essential) {
        const auto tolerance = [&](const auto& row) {  // the effect of an error of 1e-9 in the state
            long double sum = 1e-12L;
            for (Index j = 0; j < nr_; ++j)
                sum += 1e-9L * std::abs(row[j]) * std::max(1.0L, std::abs(at_.q[split_.q[j]]));
            for (Index j = 0; j < p_; ++j)
                sum += 1e-9L * std::abs(row[nr_ + j]) * std::max(1.0L, std::abs(at_.u[split_.u[j]]));
            return sum;
        };
        std::vector<std::string> residual;
        for (Index i = 0; i < p_; ++i)
            if (std::abs(here_.speed_rates[i]) > tolerance(here_.speed_rates_by.row(i)))
                residual.push_back(
                    fmt::format("{}' = {:.6g}", speed(i), static_cast<double>(here_.speed_rates[i])));
        std::vector<bool> moves(nr_);
        for (Index j = 0; j < nr_; ++j) {
            moves[j] = std::abs(here_.rates[j]) > tolerance(here_.rates_by.row(j));
            if (moves[j] && essential[j])
                residual.push_back(say("{}' = {:.6g}, and {} is not cyclic", coordinate(j),
                                       static_cast<double>(here_.rates[j]), coordinate(j)));
            else if (moves[j])
                result_.moving.push_back(coordinate(j));
        }
        if (!residual.empty()) return fmt::format("{}", fmt::join(residual, "; "));
        for (Index j = 0; j < nr_; ++j)
            if (!essential[j]) result_.cyclic.push_back(coordinate(j));
        // A coordinate that moves may leave the matrix constant, or change the rates of others (heading); then
        // only coordinates on which others depend are states.
        bool constant = true;
        for (Index j = 0; j < nr_; ++j)
            for (Index i = 0; i < p_ + nr_; ++i) constant = constant && !(moves[j] && depends_(i, j));
        for (Index j = 0; j < nr_; ++j) {
            if (constant || essential[j])
                kept_.push_back(j);
            else
                result_.left_out.push_back(coordinate(j));
        }
        return "";
    }

    void fill() {
        Linearization& r = result_;
        for (Index i = 0; i < p_; ++i) r.speeds.push_back(speed(i));
        for (Index j = 0; j < nr_; ++j) r.coordinates.push_back(coordinate(j));
        for (const int i : split_.q_dependent) r.dependent.push_back(m_.q[i].get_name());
        for (const int i : split_.u_dependent) r.dependent.push_back(e_.u[i].get_name());
        for (const int k : residuals_.inputs)
            r.inputs.push_back(m_.inputs[k / 3].derivative[0].get_name() +
                               std::string(static_cast<std::size_t>(k % 3), '\''));

        const Instant<double> near{.parameters = {at_.parameters.begin(), at_.parameters.end()},
                                   .q = {at_.q.begin(), at_.q.end()},
                                   .u = {at_.u.begin(), at_.u.end()},
                                   .inputs = {at_.inputs.begin(), at_.inputs.end()},
                                   .t = static_cast<double>(at_.t)};
        const Tangent<double> rough = tangent(residuals_, split_, near, at_kink_);
        const auto both = [&](auto part) { return clean(part(here_), part(rough)); };
        r.M = both([](const auto& t) { return t.mass; });
        const auto damping = [&](const auto& t) { return t.force.middleCols(nr_, p_).eval(); };
        r.D = both(damping);
        r.C = both([&](const auto& t) { return symmetric(damping(t)); });
        r.G = both([&](const auto& t) { return skew(damping(t)); });
        r.P = both([&](const auto& t) { return t.force.leftCols(nr_).eval(); });

        // Coordinates that belong to the speeds.
        std::vector<Index> of_speed(p_, -1);
        std::vector<bool> belongs(nr_, false);
        for (Index i = 0; i < p_ && residuals_.rates_are_speeds; ++i)
            if (const auto found = std::find(split_.q.begin(), split_.q.end(), split_.u[i]);
                found != split_.q.end()) {
                of_speed[i] = found - split_.q.begin();
                belongs[of_speed[i]] = true;
            }
        r.paired = residuals_.rates_are_speeds;
        for (Index j = 0; j < nr_; ++j) r.paired = r.paired && (belongs[j] || r.P.col(j).isZero(0));
        const auto stiffness = [&](const auto& t) {
            auto result = t.mass;
            result.setZero();
            for (Index i = 0; i < p_; ++i)
                if (of_speed[i] >= 0) result.col(i) = t.force.col(of_speed[i]);
            return result;
        };
        if (r.paired) {
            r.K = both([&](const auto& t) { return symmetric(stiffness(t)); });
            r.N = both([&](const auto& t) { return skew(stiffness(t)); });
        }

        const Index size = static_cast<Index>(kept_.size()) + p_, inputs = static_cast<Index>(r.inputs.size());
        for (const Index j : kept_) r.states.push_back(coordinate(j));
        r.states.insert(r.states.end(), r.speeds.begin(), r.speeds.end());
        const auto rows = [&](const auto& t) {
            auto result = t.rates_by;
            result.resize(size, t.rates_by.cols());
            for (std::size_t i = 0; i < kept_.size(); ++i)
                result.row(static_cast<Index>(i)) = t.rates_by.row(kept_[i]);
            result.bottomRows(p_) = t.speed_rates_by;
            return result;
        };
        const auto A = [&](const auto& t) {
            const auto all = rows(t);
            auto result = all;
            result.resize(size, size);
            for (std::size_t j = 0; j < kept_.size(); ++j) result.col(static_cast<Index>(j)) = all.col(kept_[j]);
            result.rightCols(p_) = all.middleCols(nr_, p_);
            return result;
        };
        r.A = both(A);
        r.B = both([&](const auto& t) { return rows(t).rightCols(inputs).eval(); });
        if (about_ == About::any) fill_rest();
        fill_outputs(near, rough, inputs);
        MatrixOf<long double> exact = A(here_);
        for (Index i = 0; i < size; ++i)
            for (Index j = 0; j < size; ++j)
                if (r.A(i, j) == 0) exact(i, j) = 0;
        r.eigenvalues = eigenvalues_of(exact);
    }

    void fill_rest() {
        Linearization& r = result_;
        r.rest.resize(nr_ + p_), r.at.resize(nr_ + p_);
        r.rest << here_.rates.template cast<double>(), here_.speed_rates.template cast<double>();
        for (Index j = 0; j < nr_; ++j) r.at[j] = static_cast<double>(at_.q[split_.q[j]]);
        for (Index i = 0; i < p_; ++i) r.at[nr_ + i] = static_cast<double>(at_.u[split_.u[i]]);
    }

    void fill_outputs(const Instant<double>& near, const Tangent<double>& rough, Index inputs) {
        const OutputProgram program(m_, e_, residuals_);
        const MatrixOf<long double> exact = program.by(residuals_, at_, here_);
        const Matrix all = clean(exact, program.by(residuals_, near, rough));
        result_.outputs = program.names();
        result_.output_state.resize(all.rows(), static_cast<Index>(kept_.size()) + p_);
        for (std::size_t j = 0; j < kept_.size(); ++j)
            result_.output_state.col(static_cast<Index>(j)) = all.col(kept_[j]);
        result_.output_state.rightCols(p_) = all.middleCols(nr_, p_);
        result_.output_input = all.rightCols(inputs);
    }

    const Mechanism& m_;
    const Equations& e_;
    const Start* start_ = nullptr;
    About about_;
    Residuals residuals_;
    State<double> state_;
    Instant<long double> at_;
    Split split_;
    Tangent<long double> here_;
    Index p_ = 0, nr_ = 0;
    bool at_kink_ = false;
    Dependences depends_;
    std::vector<Index> kept_;
    Linearization result_;
};

}  // namespace

Linearization linearize(const Mechanism& mechanism, const Equations& equations, const Start& start, About about) {
    const Mechanism m = in_terms_of(equations, mechanism);
    Linearizing here(m, equations, about);
    here.move_to(start);
    return here.go();
}

std::vector<Linearization> linearize_along(const Mechanism& mechanism, const Equations& equations,
                                           const std::vector<Start>& starts,
                                           const std::function<void(double part)>& told) {
    const Mechanism m = in_terms_of(equations, mechanism);
    Linearizing here(m, equations, About::any);
    std::vector<Linearization> result;
    for (const Start& start : starts) {
        if (told) told(static_cast<double>(result.size()) / static_cast<double>(starts.size()));
        here.move_to(start);
        result.push_back(here.go());
    }
    return result;
}

bool is_steady(const Mechanism& mechanism, const Equations& equations, const Start& start) {
    const Mechanism m = in_terms_of(equations, mechanism);
    Linearizing here(m, equations, About::steady);
    here.move_to(start);
    return here.unsteadiness().empty();
}

}  // namespace alembert
