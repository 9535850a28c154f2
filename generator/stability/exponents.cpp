// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/exponents.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "alembert/ode/integrate.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/given_values.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/emit.hpp"
#include "program/differentiate.hpp"
#include "program/jump_watch.hpp"
#include "program/lower/lower.hpp"
#include "program/switches.hpp"
#include "stability/linear/events_here.hpp"
#include "stability/linear/tangent.hpp"
#include "stability/stretching.hpp"

namespace alembert {

using Index = Eigen::Index;

namespace {

Program differentiated(const Derived& d) {
    auto program = derivatives_of(d, lowered(d).program);
    if (!program)
        throw ModelError(say("the equations of this scene are too large to be differentiated, or singular"));
    return std::move(program->program);
}

Rhs emitted(const Program& program, const Start& start) {
    const Source source = emit(program);
    const Compilation compiled = compile(source.text, program.name + "_jacobian", {});
    return make_rhs(load(compiled.object), start.parameters);
}

/// The tangent space at a state: columns that span it, and the rows that tell which combination a vector of it is.
class TangentSpace {
public:
    TangentSpace(const Derived& d, const Start& start)
        : residuals_(in_terms_of(d.equations, d.mechanism), d.equations), guessed_q_(d.mechanism.q_is_guess) {
        constrained_ = residuals_.holonomic > 0 || residuals_.kept > 0;
        parameters_ = start.parameters;
    }

    /// The state put onto the constraints; the columns.
    Eigen::MatrixXd settle_at(double t, double* y) {
        const int n = residuals_.n, s = residuals_.s;
        if (!constrained_) {
            rows_.clear();
            for (int k = 0; k < n + s; ++k) rows_.push_back(k);
            return Eigen::MatrixXd::Identity(n + s, n + s);
        }
        State<double> state;
        state.parameters = parameters_;
        state.t = t;
        state.q.assign(y, y + n);
        state.qdot.assign(y + n, y + n + s);
        Instant<long double> at = instant_of<long double>(residuals_, state);
        const Split split =
            split_of(residuals_, at, guessed_q_, std::vector<bool>(static_cast<std::size_t>(s), false));
        if (!settle(residuals_, split, at))
            throw IntegrationError(say("the constraints cannot be kept along the motion"), t, state.q);
        for (int k = 0; k < n; ++k) y[k] = static_cast<double>(at.q[static_cast<std::size_t>(k)]);
        for (int k = 0; k < s; ++k) y[n + k] = static_cast<double>(at.u[static_cast<std::size_t>(k)]);
        rows_ = split.q;
        for (const int u : split.u) rows_.push_back(n + u);
        const Tangent<long double> here = tangent(residuals_, split, at);
        return here.along.topLeftCorner(n + s, static_cast<Index>(rows_.size())).cast<double>();
    }

    const std::vector<int>& rows() const { return rows_; }
    bool constrained() const { return constrained_; }

private:
    Residuals residuals_;
    std::vector<bool> guessed_q_;
    std::vector<double> parameters_;
    std::vector<int> rows_;
    bool constrained_;
};

/// x, the tangent vectors, and ∫ trace.
Rhs with_variations(const Rhs& rhs, Index N, Index columns) {
    return make_rhs(
        static_cast<int>(N + N * columns + 1),
        [rhs, N, columns, J = std::make_shared<Eigen::MatrixXd>(N, N)](double t, const double* y, double* rate) {
            rhs(t, y, rate);
            rhs.jacobian(rhs.context.get(), t, y, J->data());
            Eigen::Map<Eigen::MatrixXd>(rate + N, N, columns) =
                *J * Eigen::Map<const Eigen::MatrixXd>(y + N, N, columns);
            rate[N + N * columns] = J->trace();
        },
        1);
}

class Benettin {
public:
    Benettin(LyapunovExponents& result, const Derived& d, const Start& start, const ExponentOptions& options)
        : result_(result),
          options_(options),
          program_(differentiated(d)),
          rhs_(emitted(program_, start)),
          watch_(program_, start.parameters),
          space_(d, start),
          start_(start.t) {
        const State<double> state = state_of(start, d.mechanism, d.equations);
        y_ = state.q;
        y_.insert(y_.end(), state.qdot.begin(), state.qdot.end());
        N_ = static_cast<Index>(y_.size());
        const Eigen::MatrixXd along = space_.settle_at(start_, y_.data());
        result_.size = static_cast<int>(along.cols());
        if (options.count > result_.size)
            throw ModelError(
                say("--exponents {}: the tangent space has {} dimensions; expected at most "
                    "that many",
                    options.count, result_.size));
        columns_ = options.count > 0 ? options.count : result_.size;
        stretching_.emplace(along, static_cast<int>(columns_));
        Eigen::MatrixXd J(N_, N_);
        rhs_.jacobian(rhs_.context.get(), start_, y_.data(), J.data());
        intervals_ = intervals_of(options.duration, J.norm());
        result_.interval = options.duration / intervals_;
        result_.duration = options.duration;
    }

    void go() {
        const Rhs both = with_variations(rhs_, N_, columns_);
        const auto look = [this](double t, std::span<const double> y, std::span<const double>) {
            watch_(t, y.data());
        };
        Eigen::MatrixXd& Q = stretching_->vectors;
        const int begin = static_cast<int>(forgotten_part * intervals_);
        for (int k = 0; k < intervals_; ++k) {
            if (options_.progress) options_.progress(say("the motion"), static_cast<double>(k) / intervals_);
            const double t = start_ + result_.interval * k;
            std::vector<double> whole = y_;
            whole.insert(whole.end(), Q.data(), Q.data() + Q.size());
            whole.push_back(0);
            const Trajectory motion = integrate(both, whole,
                                                {.start = t,
                                                 .duration = result_.interval,
                                                 .tolerance = options_.tolerance,
                                                 .sample = result_.interval,
                                                 .on_step = look});
            if (motion.failure)
                throw IntegrationError(motion.failure->message, motion.failure->time, motion.failure->state);
            const auto end = motion.final_state();
            std::copy(end.begin(), end.begin() + N_, y_.begin());
            Q = Eigen::Map<const Eigen::MatrixXd>(end.data() + N_, N_, columns_);
            const Eigen::MatrixXd along = space_.settle_at(t + result_.interval, y_.data());
            if (space_.constrained()) {
                Eigen::MatrixXd own(along.cols(), columns_);
                for (Index i = 0; i < own.rows(); ++i)
                    own.row(i) = Q.row(space_.rows()[static_cast<std::size_t>(i)]);
                Q = along * own;
            }
            stretching_->renew(t + result_.interval - start_, result_.interval, k >= begin, end.back());
        }
        stretching_->finish(result_, !space_.constrained());
    }

private:
    LyapunovExponents& result_;
    const ExponentOptions& options_;
    Program program_;
    Rhs rhs_;
    JumpWatch watch_;
    TangentSpace space_;
    double start_;
    std::vector<double> y_;
    std::optional<Stretching> stretching_;
    Index N_ = 0, columns_ = 0;
    int intervals_ = 0;
};

}  // namespace

LyapunovExponents lyapunov_exponents(Scene scene, const ExponentOptions& options) {
    argument::need_whole_nonnegative("count", options.count);
    argument::need_positive("duration", options.duration);
    argument::need_positive("tolerance", options.tolerance);
    const bool goes_through = is_changed_by_events(scene);
    const Derived d = derived(scene, {.by = options.by, .at = options.at, .with_states = !goes_through});
    if (d.mechanism.has_modes() || jumps_along_motion(lowered(d).program))
        return exponents_through_jumps(with_numbers(std::move(scene), options.at), options);
    LyapunovExponents result{.title = scene.title};
    result.warnings = d.warnings;
    Start start = start_of(d.mechanism, options.at);
    assemble(start, d.mechanism, lower_constraints(d.mechanism), options.at);
    Benettin(result, d, start, options).go();
    return result;
}

}  // namespace alembert
