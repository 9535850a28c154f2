// SPDX-License-Identifier: GPL-2.0-or-later
// x(T) = x(0) by Newton's method, where x(T) is the end of a motion of `simulate` and its derivative goes by
// saltation matrices through all that the motion passes.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "alembert/base/dense.hpp"
#include "alembert/base/error.hpp"
#include "analysis/state/given_values.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"
#include "simulate/hybrid_variation.hpp"
#include "simulate/simulate.hpp"
#include "stability/floquet.hpp"

namespace alembert {

using Index = Eigen::Index;

namespace {

constexpr double fine_run = 1e-12, coarse_run = 1e-10;  // tolerances
constexpr double returns = 1e-9;                        // of x(T) − x(0)
constexpr int most_periods = 30;

struct ThroughPeriod {
    std::vector<double> end, rate;  ///< f at the end
    Eigen::MatrixXd Phi;
};

class JumpingPeriod {
public:
    JumpingPeriod(const Scene& scene, const std::string& by, double period)
        : scene_(scene),
          by_(by),
          derived_(derived(scene, {.by = by, .use = Use::run})),
          start_(start_of(derived_.mechanism)),
          program_(lowered(derived_).program),
          variation_(derived_, program_, {}, start_, {}),
          period_(period > 0 ? period : own_period()) {
        const Mechanism& m = derived_.mechanism;
        if (!m.constraints.empty())
            throw ModelError(
                say("multipliers through impacts, events and jumps of forces are computed for scenes "
                    "without constraints"));
        for (const GiNaC::symbol& q : m.q) names_.push_back(q.get_name());
        for (const GiNaC::symbol& q : m.q) names_.push_back(q.get_name() + "'");
        for (const Mechanism::State& z : m.states) names_.push_back(z.derivative[0].get_name());
        const State<double> state = start_.state();
        x_ = state.q;
        x_.insert(x_.end(), state.qdot.begin(), state.qdot.end());
        autonomous_ = !changes_with_time();
        if (!autonomous_) check_period();
    }

    /// False where Newton's method does not converge.
    bool shoot() {
        const auto N = static_cast<Index>(x_.size());
        for (int round = 0; round < most_periods; ++round) {
            const ThroughPeriod end = through(fine_run);
            Eigen::VectorXd g(N);
            for (Index i = 0; i < N; ++i)
                g[i] = end.end[static_cast<std::size_t>(i)] - x_[static_cast<std::size_t>(i)];
            miss_ = g.cwiseAbs().maxCoeff();
            if (miss_ <
                returns * std::max(1.0, Eigen::Map<const Eigen::VectorXd>(x_.data(), N).cwiseAbs().maxCoeff()))
                return true;
            Eigen::MatrixXd J(N, N + (autonomous_ ? 1 : 0));
            J.leftCols(N) = end.Phi - Eigen::MatrixXd::Identity(N, N);
            if (autonomous_) J.col(N) = Eigen::Map<const Eigen::VectorXd>(end.rate.data(), N);
            const Eigen::VectorXd step = least_norm(J, -g).x;
            if (!step.allFinite() || step.norm() > 1e3) return false;
            for (Index i = 0; i < N; ++i) x_[static_cast<std::size_t>(i)] += step[i];
            if (autonomous_) period_ += step[N];
            if (!(period_ > 0)) return false;
        }
        return false;
    }

    FloquetResult result() {
        FloquetResult result;
        result.period = period_;
        result.is_in_numbers = true;
        const ThroughPeriod good = through(fine_run), rough = through(coarse_run);
        const auto N = static_cast<int>(x_.size());
        RealBallMatrix Phi(N, N);
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j)
                Phi(i, j) = RealBall::about(static_cast<Quad>(good.Phi(i, j)),
                                            std::abs(good.Phi(i, j) - rough.Phi(i, j)) +
                                                returns * std::max(1.0, good.Phi.cwiseAbs().maxCoeff()));
        const std::vector<RootOf> roots = multipliers_in_order(Phi);
        for (const RootOf& root : roots) {
            result.multipliers.push_back(root.value);
            result.radii.push_back(root.radius);
        }
        result.states = names_;
        for (std::size_t k = 0; k < names_.size(); ++k) result.start.emplace_back(names_[k], x_[k]);
        if (autonomous_ &&
            std::all_of(good.rate.begin(), good.rate.end(), [](double x) { return std::abs(x) < 1e-9; }))
            throw ModelError(
                say("the equations do not hold t and this state is an equilibrium; leave the period out, "
                    "or give a state on a periodic motion"));
        result.decision = decision_by_multipliers(result, roots, autonomous_);
        return result;
    }

    double miss() const { return miss_; }
    double period() const { return period_; }

private:
    double own_period() const {
        const Mechanism& m = derived_.mechanism;
        Program one = begun(m);
        const int node = lower_expression(one, m, *m.run.period);
        double period = 0;
        Tape<double>(one, {node}, start_.parameters)(0, nullptr, nullptr, &period);
        return period;
    }

    bool changes_with_time() const {
        const Mechanism& m = derived_.mechanism;
        const std::vector<int> roots = program_.right_hand_side();
        std::vector<GiNaC::symbol> clock{m.t};
        for (const Mechanism::Input& input : m.inputs)
            clock.insert(clock.end(), input.derivative.begin(), input.derivative.end());
        const auto moves = [&](const GiNaC::ex& value) { return m.z->depends(value, clock); };
        bool result = std::any_of(roots.begin(), roots.end(), [&](int node) {
            return (program_[node].depends & bit(Variable::Kind::time)) != 0;
        });
        for (const Mechanism::Definition& event : m.events) result = result || moves(event.value);
        for (const Mechanism::Unilateral& contact : m.unilateral) result = result || moves(*contact.gap.position);
        for (const Mechanism::EventAction& action : m.event_actions) {
            for (const auto* list : {&action.set, &action.rates})
                for (const auto& [index, value] : *list) result = result || moves(value);
            for (const GiNaC::ex& value : action.impulse) result = result || moves(value);
        }
        return result;
    }

    void check_period() const {
        constexpr double same = 1e-9;
        std::mt19937_64 random(5);
        for (int k = 0; k < 6; ++k) {
            std::vector<double> x = x_;
            for (double& one : x) one += 0.2 * (static_cast<double>(random() >> 11) / 9007199254740992.0 - 0.5);
            const double t = start_.t + period_ * (k + 0.37) / 6;
            const std::vector<double> now = variation_.all_at(t, x), later = variation_.all_at(t + period_, x);
            for (std::size_t i = 0; i < now.size(); ++i)
                // A value with the other sign has its zeros at the same times.
                if (!(std::abs(now[i] - later[i]) <= same * (1 + std::abs(now[i]))) &&
                    !(i >= x_.size() && std::abs(now[i] + later[i]) <= same * (1 + std::abs(now[i]))))
                    throw ModelError(
                        say("the equations do not have the period {:.10g}: a value in them is {:.10g} at t "
                            "= {:.6g} and {:.10g} one period later; give the period of the inputs, or a "
                            "multiple of it",
                            period_, now[i], t, later[i]));
        }
    }

    ThroughPeriod through(double tolerance) {
        Overrides at;
        for (std::size_t k = 0; k < names_.size(); ++k) at.emplace_back(names_[k], x_[k]);
        Scene scene = with_numbers(scene_, at);
        scene.on_warning = [](const Warning&) {};  // they have been told
        const Run run = simulate(
            std::move(scene),
            {.by = by_, .duration = period_, .tolerance = tolerance, .sample = period_, .estimate = false});
        if (run.failure) throw IntegrationError(*run.failure, run.motion.failure->time, run.motion.failure->state);
        const std::size_t N = x_.size();
        std::vector<double> y = x_;
        for (std::size_t c = 0; c < N; ++c)
            for (std::size_t i = 0; i < N; ++i) y.push_back(i == c ? 1 : 0);
        const HybridVariation::Wishes wishes{.tolerance = tolerance};
        variation_.begin(run.instants, start_.t, y, wishes);
        variation_.go(start_.t, start_.t + period_, y, wishes);
        ThroughPeriod result;
        result.end.assign(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(N));
        result.rate = variation_.rate_at(start_.t + period_, result.end);
        result.Phi = Eigen::Map<const Eigen::MatrixXd>(y.data() + N, static_cast<Index>(N), static_cast<Index>(N));
        return result;
    }

    const Scene& scene_;
    std::string by_;
    Derived derived_;
    Start start_;
    Program program_;
    HybridVariation variation_;
    double period_, miss_ = 0;
    bool autonomous_ = false;
    std::vector<std::string> names_;
    std::vector<double> x_;
};

}  // namespace

FloquetResult floquet_through_jumps(const Scene& scene, const std::string& by, double period) {
    JumpingPeriod periodic(scene, by, period);
    if (!periodic.shoot())
        throw ModelError(
            say("no motion of period {:.10g} is found from this state: after Newton's method the state "
                "misses itself by {:.3g}; give a state and a period nearer to one",
                periodic.period(), periodic.miss()));
    return periodic.result();
}

}  // namespace alembert
