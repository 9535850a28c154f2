// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/lyapunov_samples.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "alembert/base/dense.hpp"
#include "alembert/base/error.hpp"
#include "alembert/base/random.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// V, dV/dt and the size of the terms whose sum is dV/dt, at any state.
class SampledFunction {
public:
    SampledFunction(const ex& in_rates, const LinearizedScene& scene)
        : scene_(scene), start_(state_of(scene.start, scene.mechanism, scene.equations)) {
        const Mechanism& m = scene.mechanism;
        const Equations& e = scene.equations;
        GiNaC::exmap rates;
        for (int i = 0; i < m.size(); ++i) rates[m.qdot[i]] = e.h[i];
        const ex V = e.speeds_are_rates() ? in_rates : substitute(*m.z, {in_rates}, rates)[0];
        std::vector<ex> wanted{V};
        for (const std::vector<GiNaC::symbol>* by : {&e.q, &e.u})
            for (const ex& slope : m.z->pull_back({{m.z->name(V), 1}}, *by)) wanted.push_back(slope);
        for (const ex& h : e.h) wanted.push_back(h);
        for (int i = 0; i < e.size(); ++i) wanted.push_back(m.z->name(e.forcing(i)));
        for (int i = 0; i < e.size(); ++i)
            for (int j = 0; j <= i; ++j) wanted.push_back(e.M(i, j));
        program_ = begun(m);
        std::vector<std::pair<GiNaC::symbol, int>> given;
        for (int i = 0; i < e.size(); ++i)
            given.emplace_back(e.u[i], program_.variable({Variable::Kind::rate, i}));
        nodes_ = lower_expressions(program_, m, wanted, given);
    }

    struct Values {
        double V, rate, size;
    };
    Values at(const std::vector<double>& shift) const {
        const std::size_t n = start_.q.size(), s = start_.qdot.size();
        State<double> state = start_;
        for (std::size_t i = 0; i < n; ++i) state.q[i] += shift[i];
        for (std::size_t i = 0; i < s; ++i) state.qdot[i] += shift[n + i];
        const std::vector<double> all = interpret(program_, state);
        std::size_t next = 0;
        const auto take = [&] { return all[static_cast<std::size_t>(nodes_[next++])]; };
        const double V = take();
        std::vector<double> slopes(n + s), h(n);
        for (double& one : slopes) one = take();
        for (double& one : h) one = take();
        const auto size = static_cast<Eigen::Index>(s);
        Eigen::VectorXd f(size);
        for (Eigen::Index i = 0; i < size; ++i) f[i] = take();
        Eigen::MatrixXd M(size, size);
        for (Eigen::Index i = 0; i < size; ++i)
            for (Eigen::Index j = 0; j <= i; ++j) M(i, j) = M(j, i) = take();
        const Eigen::VectorXd udot = solve_symmetric(M, f);
        Values result{V, 0, 0};
        const auto add = [&](double term) {
            result.rate += term;
            result.size += std::abs(term);
        };
        for (std::size_t i = 0; i < n; ++i) add(slopes[i] * h[i]);
        for (std::size_t i = 0; i < s; ++i) add(slopes[n + i] * udot[static_cast<Eigen::Index>(i)]);
        return result;
    }
    /// Marks the states that are varied: speeds, and coordinates on which something depends.
    std::vector<bool> moving() const {
        std::vector<bool> result;
        const std::vector<std::string>& cyclic = scene_.matrices.cyclic;
        for (const GiNaC::symbol& q : scene_.equations.q)
            result.push_back(std::find(cyclic.begin(), cyclic.end(), q.get_name()) == cyclic.end());
        result.resize(result.size() + start_.qdot.size(), true);
        return result;
    }

private:
    const LinearizedScene& scene_;
    State<double> start_;
    Program program_;
    std::vector<int> nodes_;
};

std::string counted(const char* what, int positive, int negative, int all) {
    if (positive == all) return say("{} > 0 at all", what);
    if (negative == all) return say("{} < 0 at all", what);
    if (negative == 0) return say("{} >= 0 at all", what);
    if (positive == 0) return say("{} <= 0 at all", what);
    return say("{} > 0 at {}, < 0 at {}", what, positive, negative);
}

}  // namespace

std::string lyapunov_samples(const ex& V, const LinearizedScene& scene) {
    const SampledFunction function(V, scene);
    const std::vector<bool> moving = function.moving();
    std::mt19937_64 random(15);
    NormalReal normal;
    int V_signs[2] = {}, rate_signs[2] = {}, all = 0;
    for (const double radius : {0.1, 0.01, 0.001})
        for (int k = 0; k < 1000; ++k) {
            std::vector<double> shift(moving.size(), 0.0);
            double length = 0;
            for (std::size_t i = 0; i < shift.size(); ++i) {
                if (moving[i]) shift[i] = normal(random);
                length += shift[i] * shift[i];
            }
            for (double& one : shift) one *= radius / std::sqrt(length);
            const auto [value, rate, size] = function.at(shift);
            if (!std::isfinite(value) || !std::isfinite(rate)) continue;
            ++all;
            if (value != 0) ++V_signs[value < 0];
            if (std::abs(rate) > 1e-12 * size) ++rate_signs[rate < 0];
        }
    return say("In floating point, at {} states within 0.1, 0.01 and 0.001 of the point, {}, {}", all,
               counted("V", V_signs[0], V_signs[1], all), counted("dV/dt", rate_signs[0], rate_signs[1], all));
}

void check_zero_there(const ex& V, const LinearizedScene& scene) {
    const SampledFunction function(V, scene);
    const double value = function.at(std::vector<double>(function.moving().size(), 0.0)).V;
    if (std::abs(value) < 1e-9) return;
    throw ModelError(
        say("the Lyapunov function is {0:.10g} at this state; expected 0 there: subtract {0:.10g}", value));
}

}  // namespace alembert
