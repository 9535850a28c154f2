// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/charts.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "alembert/base/dense.hpp"
#include "alembert/hybrid/automaton.hpp"
#include "alembert/ode/projection.hpp"
#include "base/language/say.hpp"
#include "simulate/angles_along.hpp"
#include "simulate/solver_code.hpp"

namespace alembert {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Quaternion = Eigen::Quaterniond;

std::optional<AnglesOfFrame> angles_of_frame(const Derived& d, const MethodChoice& method) {
    const Mechanism& m = d.mechanism;
    if (!m.redundant.empty() || !m.unilateral.empty() || !m.frictions.empty() || !m.events.empty() ||
        !m.speeds.empty() || !m.states.empty() || !d.equations.speeds_are_rates())
        return std::nullopt;
    if (!method.sundials.empty() || has_fixed_step(method.method) || uses_jacobian(method.method) ||
        needs_canonical(method.method) || needs_separable(method.method))
        return std::nullopt;
    const std::vector<AnglesOfFrame> found = angles_in(d.scene);
    return found.size() == 1 ? std::optional(found[0]) : std::nullopt;
}

class ChartRun::Parts {
public:
    Parts(const Derived& d, const AnglesOfFrame& angles, const std::vector<double>& parameters, Work work,
          const RunOptions& wishes)
        : angles_(angles), n_(d.mechanism.size()) {
        if (named_elsewhere(d.scene, angles)) throw ModelError(say("other parts of the scene name the angles"));
        const Derived other = derived(with_quaternion(d.scene, angles), {.use = Use::run});
        if (!other.equations.speeds_are_rates())
            throw ModelError(
                say("the equations are in generalized speeds (the formalism 'routh' has them in rates)"));
        const Program program = lowered(other).program;
        const Module module = solver_code(program, program.name + "_quaternion", wishes).module;
        projection_.emplace(module, parameters);
        rhs_ = make_rhs(module, parameters, work);
        if (work == Work::integrated) rhs_.extra = 0;
        rhs_ = projection_->guarded(std::move(rhs_), parameters);
        for (int i = 0; i < n_; ++i)
            if (std::find(angles.angles.begin(), angles.angles.end(), i) == angles.angles.end())
                others_.push_back(i);
    }

    Trajectory follow(const System& system, const std::vector<double>& initial, const Options& given,
                      const RunPiece& piece) {
        passes.clear();
        projection_->begin(given.start, to_other(initial).data());
        Following run(*this, system, initial, given);
        run_modes(run, given, piece);
        return std::move(run.whole);
    }

    std::vector<ChartPass> passes;

private:
    static constexpr double in_the_lock =
        1e-9;  // where a turn of both angles against each other has no rate, it gets 0

    /// The two descriptions as modes (automaton.hpp).
    class Following {
    public:
        Following(Parts& parts, const System& system, const std::vector<double>& initial, const Options& given)
            : parts_(parts), system_(system), given_(given), now_{.t = given.start, .state = initial} {
            system_.by = {};
            by_quaternion_ = parts.angles_.evenness(initial.data()) < to_quaternion;
        }

        MotionState& now() { return now_; }

        Mode enter(Options rest, RunPiece piece) {
            rest.when_stiff = {};
            grid_ = *piece.grid;
            Mode mode{.system = system_,
                      .guards = by_quaternion_ ? parts_.returning() : parts_.leaving(),
                      .own = 1,
                      .options = std::move(rest),
                      .piece = std::move(piece)};
            if (by_quaternion_)
                mode.integrate = [this](const System& system, const std::vector<double>& state,
                                        const Options& options, const Events& back, const RunPiece& part) {
                    return parts_.in_angles(system, state, options, back, part);
                };
            return mode;
        }

        void collect(Trajectory part) {
            if (whole.times.empty())
                whole = std::move(part);
            else
                append(whole, std::move(part), grid_, sample_interval(given_));
        }

        bool next_mode(const Hit& hit) {
            if (hit.guards.empty()) return false;
            whole.ending = Ending::completed;
            by_quaternion_ = !by_quaternion_;
            return true;
        }

        std::string changes() const { return {}; }

        Trajectory whole = {};

    private:
        Parts& parts_;
        System system_;
        const Options& given_;
        MotionState now_;
        bool by_quaternion_ = false;
        double grid_ = 0;
    };

    /// A motion that comes nearer to the lock than the error of its rotation cannot be told from one through it.
    static double through(double tolerance) { return std::clamp(10 * tolerance, 1e-6, to_quaternion / 2); }

    Events leaving() const {
        return make_events({{.name = "lock", .stop = true, .direction = -1}},
                           [this](double, const double* y, const double*, double* g) {
                               g[0] = angles_.evenness(y) - to_quaternion;
                           });
    }

    Events returning() const {
        return make_events(
            {{.name = "regular", .stop = true, .direction = 1}},
            [this](double, const double* z, const double*, double* g) { g[0] = evenness(z) - to_angles; });
    }

    /// The evenness of a state in the other description.
    double evenness(const double* z) const {
        const Matrix3d R = turn_of(z).normalized().toRotationMatrix();
        const auto [i, j, k] = angles_.axes;
        return std::sqrt(std::max(0.0, 1 - R(i, k) * R(i, k)));
    }

    Quaternion turn_of(const double* z) const {
        const double* const e = z + others_.size();
        return {e[0], e[1], e[2], e[3]};
    }

    std::vector<double> to_other(const std::vector<double>& y) const {
        Vector3d angle, rate;
        for (int k = 0; k < 3; ++k) {
            angle[k] = y[static_cast<std::size_t>(angles_.angles[static_cast<std::size_t>(k)])];
            rate[k] = y[static_cast<std::size_t>(n_ + angles_.angles[static_cast<std::size_t>(k)])];
        }
        const TurnedFrame turned(angles_.axes, angle);
        const Vector3d w = turned.rates * rate / 2;
        const Quaternion change = Quaternion(0, w[0], w[1], w[2]) * turned.e;
        std::vector<double> z;
        for (const int i : others_) z.push_back(y[static_cast<std::size_t>(i)]);
        z.insert(z.end(), {turned.e.w(), turned.e.x(), turned.e.y(), turned.e.z()});
        for (const int i : others_) z.push_back(y[static_cast<std::size_t>(n_ + i)]);
        z.insert(z.end(), {change.w(), change.x(), change.y(), change.z()});
        z.insert(z.end(), y.begin() + 2 * n_, y.end());
        return z;
    }

    Turning turning(double t, const std::vector<double>& z) const {
        std::vector<double> rate(z.size());
        rhs_(t, z.data(), rate.data());
        const double* const e = z.data() + others_.size();
        const std::size_t half = others_.size() + 4;
        return {t, Eigen::Vector4d(e), Eigen::Vector4d(e + half),
                Eigen::Vector4d(rate.data() + others_.size() + half)};
    }

    /// The state in the scene's coordinates, with these angles.
    std::vector<double> to_scene(const std::vector<double>& z, const Vector3d& angle) const {
        const auto half = others_.size() + 4;
        std::vector<double> y(2 * static_cast<std::size_t>(n_));
        for (std::size_t k = 0; k < others_.size(); ++k) {
            y[static_cast<std::size_t>(others_[k])] = z[k];
            y[static_cast<std::size_t>(n_ + others_[k])] = z[half + k];
        }
        const Quaternion e = turn_of(z.data()), change = turn_of(z.data() + half);
        const Quaternion w = change * e.conjugate();
        const Vector3d rate = Orthogonal(TurnedFrame(angles_.axes, angle).rates, in_the_lock).solve(2 * w.vec());
        for (int k = 0; k < 3; ++k) {
            y[static_cast<std::size_t>(angles_.angles[static_cast<std::size_t>(k)])] = angle[k];
            y[static_cast<std::size_t>(n_ + angles_.angles[static_cast<std::size_t>(k)])] = rate[k];
        }
        y.insert(y.end(), z.begin() + static_cast<std::ptrdiff_t>(2 * half), z.end());
        return y;
    }

    /// A piece by quaternion, with its rows in the scene's coordinates.
    Trajectory in_angles(const System& given, const std::vector<double>& state, Options options,
                         const Events& back, const RunPiece& piece) {
        std::vector<std::pair<double, std::vector<double>>> steps;
        const System system{.rhs = rhs_,
                            .project = projection_->after_steps(),
                            .quick_times = given.quick_times,
                            .on_method = given.on_method};
        if (needs_series(options.method)) options.method = Method::verner98;
        options.on_step = [&](double t, std::span<const double> z, std::span<const double>) {
            steps.emplace_back(t, std::vector<double>(z.begin(), z.end()));
        };
        const std::vector<double> first = to_other(state);
        Trajectory motion = integrate(system, first, options, back, piece);
        passes.push_back({motion.times.front(), motion.times.back()});
        Vector3d start;
        for (int k = 0; k < 3; ++k)
            start[k] = state[static_cast<std::size_t>(angles_.angles[static_cast<std::size_t>(k)])];
        AnglesAlong along(angles_, start, turning(options.start, first), through(options.tolerance));
        std::vector<double> states, last = state;
        std::size_t step = 0;
        for (std::size_t row = 0; row < motion.rows(); ++row) {
            for (; step < steps.size() && steps[step].first < motion.times[row]; ++step)
                along.go_to(turning(steps[step].first, steps[step].second));
            const std::vector<double> z(motion.state(row).begin(), motion.state(row).end());
            along.go_to(turning(motion.times[row], z));
            last = to_scene(z, along.angles());
            states.insert(states.end(), last.begin(), last.end());
        }
        if (motion.failure) motion.failure->state = last;
        motion.dimension = given.rhs.dimension;
        motion.names = given.rhs.names;
        motion.states = std::move(states);
        return motion;
    }

    AnglesOfFrame angles_;
    int n_;
    std::vector<int> others_;  ///< the other coordinates
    std::optional<Projection> projection_;
    Rhs rhs_;
};

ChartRun::ChartRun(const Derived& derived, const AnglesOfFrame& angles, const std::vector<double>& parameters,
                   Work work, const RunOptions& wishes)
    : parts_(std::make_unique<Parts>(derived, angles, parameters, work, wishes)) {}

ChartRun::~ChartRun() = default;

Integrator ChartRun::integrator() {
    return
        [parts = parts_.get()](const System& system, const std::vector<double>& initial, const Options& options,
                               const Events&, const RunPiece& piece) {  // scenes with events stay in their angles
            return parts->follow(system, initial, options, piece);
        };
}

const std::vector<ChartPass>& ChartRun::passes() const {
    return parts_->passes;
}

}  // namespace alembert
