// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/spectra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "analysis/state/left_out.hpp"
#include "base/language/say.hpp"
#include "model/friction.hpp"
#include "program/lower/lower.hpp"
#include "stability/equilibrium/judge.hpp"
#include "stability/linear/dense_long.hpp"
#include "stability/periodic.hpp"

namespace alembert {

namespace {

Spectra::Roots sorted(Spectra::Roots roots) {
    std::sort(roots.begin(), roots.end(), [](const auto& a, const auto& b) {
        return std::pair(a.real(), a.imag()) < std::pair(b.real(), b.imag());
    });
    return roots;
}

std::optional<Spectra::Roots> roots_of(const LongMatrix& A) {
    if (A.rows() == 0 || !A.allFinite()) return {};
    const auto values = eigenvalues(A);
    if (!values) return {};
    return sorted(Spectra::Roots(values->begin(), values->end()));
}

void check_names(const std::vector<std::string>& names, const StabilityOptions& options, const Scene& scene) {
    for (const std::string& name : names) {
        for (const auto& [other, value] : options.at)
            if (other == name) throw ModelError(say("{} cannot be held by --at and varied", name));
        const bool is_coordinate =
            std::any_of(scene.coordinates.begin(), scene.coordinates.end(),
                        [&](const auto& coordinate) { return coordinate.name.text == name; });
        if (is_coordinate || name == "t")
            throw ModelError(
                say("{} cannot be varied: expected a parameter, or the rate of a cyclic "
                    "coordinate",
                    name));
    }
}

}  // namespace

const char* name_of(SpectrumKind kind) {
    switch (kind) {
        case SpectrumKind::none:
            return "none";
        case SpectrumKind::inside:
            return to_say("asymptotically stable");
        case SpectrumKind::edge:
            return to_say("critical");
        case SpectrumKind::divergence:
            return to_say("divergence");
        case SpectrumKind::flip:
            return to_say("flip");
        case SpectrumKind::flutter:
            return to_say("flutter");
    }
    return "";
}

double beyond(const std::complex<double>& root, SpectrumOf of) {
    return of == SpectrumOf::multipliers ? std::abs(root) - 1 : root.real();
}

double beyond(const Spectra::Roots& roots, SpectrumOf of) {
    double most = -HUGE_VAL;
    for (const auto& root : roots) most = std::max(most, beyond(root, of));
    return most;
}

double edge_margin(const Spectra::Roots& roots, SpectrumOf of) {
    double size = 0, sum = 0, product = 1;
    for (const auto& root : roots) {
        size = std::max(size, std::abs(root));
        sum += root.real();
        product *= std::abs(root);
    }
    if (of == SpectrumOf::multipliers) return std::abs(product - 1) < 1e-7 ? 1e-4 : 1e-8;
    return size * (std::abs(sum) < 1e-9 * size ? 1e-6 : 1e-9);
}

SpectrumKind kind_of(const Spectra::Roots& roots, SpectrumOf of) {
    const double margin = edge_margin(roots, of);
    const auto worst = std::max_element(
        roots.begin(), roots.end(), [&](const auto& a, const auto& b) { return beyond(a, of) < beyond(b, of); });
    if (worst == roots.end()) return SpectrumKind::none;
    if (beyond(*worst, of) < -margin) return SpectrumKind::inside;
    if (beyond(*worst, of) <= margin) return SpectrumKind::edge;
    if (std::abs(worst->imag()) > margin) return SpectrumKind::flutter;
    return of == SpectrumOf::multipliers && worst->real() < 0 ? SpectrumKind::flip : SpectrumKind::divergence;
}

Spectra::Spectra(Scene scene, const StabilityOptions& options, const std::vector<std::string>& names,
                 const std::vector<double>& middle)
    : title_(scene.title) {
    check_names(names, options, scene);
    for (const auto& [name, value] : options.at) {
        names_.push_back(name);
        held_.push_back(value);
    }
    names_.insert(names_.end(), names.begin(), names.end());
    if (scene.polynomial) {
        take_polynomial(scene, options);
        return;
    }
    const bool periodic = options.period > 0 || scene.simulation.period;
    const auto d =
        std::make_shared<const Derived>(derived(std::move(scene), {.by = options.by, .with_states = true}));
    need_given_normal_forces(d->mechanism, "stability");
    if (periodic)
        take_motion(d, options, all(middle));
    else
        take_equilibrium(d, all(middle));
}

std::optional<Spectra::Roots> Spectra::following(const std::vector<double>& values, Place& near) const {
    if (!near.empty())
        if (auto roots = at_(values, near)) return roots;
    near.clear();
    return at_(values, near);
}

std::vector<double> Spectra::all(const std::vector<double>& values) const {
    std::vector<double> result = held_;
    result.insert(result.end(), values.begin(), values.end());
    return result;
}

void Spectra::take_polynomial(const Scene& scene, const StabilityOptions&) {
    of_ = SpectrumOf::roots;
    const auto polynomial = std::make_shared<const PolynomialScene>(polynomial_of(scene));
    const Mechanism& m = polynomial->mechanism;
    const auto starts = std::make_shared<const Starts>(m, names_);
    auto program = std::make_shared<Program>(begun(m));
    const std::vector<int> nodes = lower_expressions(*program, m, polynomial->coefficients);
    at_ = [this_all = held_, polynomial, starts, program, nodes](const std::vector<double>& values,
                                                                 Place&) -> std::optional<Roots> {
        std::vector<double> given = this_all;
        given.insert(given.end(), values.begin(), values.end());
        State<double> state;
        state.parameters = starts->at(given).parameters;
        const std::vector<double> value = interpret(*program, state);
        const auto degree = static_cast<Eigen::Index>(nodes.size()) - 1;
        const auto c = [&](Eigen::Index k) {
            return value[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])];
        };
        if (c(0) == 0) return {};
        MatrixOf<long double> companion = MatrixOf<long double>::Zero(degree, degree);
        for (Eigen::Index k = 0; k < degree; ++k) {
            companion(0, k) = -static_cast<long double>(c(k + 1)) / c(0);
            if (k > 0) companion(k, k - 1) = 1;
        }
        return roots_of(companion);
    };
}

void Spectra::take_equilibrium(const std::shared_ptr<const Derived>& d, const std::vector<double>& middle) {
    if (!d->mechanism.unilateral.empty())
        throw ModelError(
            say("a chart is drawn for scenes without contacts; put a constraint in place of a contact that "
                "stays closed"));
    const auto starts = std::make_shared<const Starts>(d->mechanism, names_);
    const auto problem = std::make_shared<const SteadyProblem>(d->mechanism, d->equations, starts->at(middle));
    Instant<long double> between = problem->start();
    if (problem->settle_at(between)) LeftOut(d->mechanism).check(problem->start_at(starts->at(middle), between));
    at_ = [held = held_, d, starts, problem](const std::vector<double>& values,
                                             Place& near) -> std::optional<Roots> {
        std::vector<double> given = held;
        given.insert(given.end(), values.begin(), values.end());
        const Possible<Start> start = starts->possible(given);
        if (!start.exists()) return {};
        Instant<long double> from =
            instant_of<long double>(problem->residuals(), state_of(start.value(), d->mechanism, d->equations));
        const auto states = static_cast<std::ptrdiff_t>(d->mechanism.states.size());
        if (!near.empty()) {
            from.q.assign(near.begin(), near.end() - states);
            std::copy(near.end() - states, near.end(), from.u.end() - states);
        }
        const auto root = problem->solve(from);
        if (!root) return {};
        near = root->at.q;
        near.insert(near.end(), root->at.u.end() - states, root->at.u.end());
        return roots_of(essential_motion(*problem, root->at));
    };
}

void Spectra::take_motion(const std::shared_ptr<const Derived>& d, const StabilityOptions& options,
                          const std::vector<double>& middle) {
    of_ = SpectrumOf::multipliers;
    const auto starts = std::make_shared<const Starts>(d->mechanism, names_);
    if (const Possible<Start> between = starts->possible(middle); between.exists())
        LeftOut(d->mechanism).check(between.value());
    const auto system = std::make_shared<const PeriodicSystem>(*d);
    at_ = [held = held_, d, starts, system, period = options.period](const std::vector<double>& values,
                                                                     Place& near) -> std::optional<Roots> {
        std::vector<double> given = held;
        given.insert(given.end(), values.begin(), values.end());
        const Possible<Start> start = starts->possible(given);
        if (!start.exists()) return {};
        PeriodicMotion<double> motion = system->motion<double>(start.value(), period);
        if (!near.empty()) motion.x.assign(near.begin(), near.end());
        if (!(motion.period > 0) || !system->shoot(motion)) return {};
        near.assign(motion.x.begin(), motion.x.end());
        const PeriodEnd<double> end = system->monodromy(motion, 1e-11);
        if (!end.finished) return {};
        const auto size = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(end.Phi.size()))));
        return roots_of(Eigen::Map<const Eigen::MatrixXd>(end.Phi.data(), size, size).cast<long double>());
    };
}

}  // namespace alembert
