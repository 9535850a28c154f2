// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/likely_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

#include "alembert/base/random.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

/// Chosen so that no machine comes near: a mass of 1e5 times the next one beside gravity, and a radius of gyration
/// of 300 times the distance of the farthest mass. An inertia in kg mm² that is taken as kg m² makes that radius
/// 1000 times as long; a mass in g that is taken as kg is 1000 times as heavy, as heavy parts of machines are, and
/// stays unseen.
constexpr double suspicious_mass_ratio = 1e5, suspicious_gyration_ratio = 300;

/// Whether a load acts is asked at so many random states, and of scenes with at most so many coordinates.
constexpr int states_tried = 3, most_coordinates = 200;

/// Below this share of the sum of the sizes of its terms, a sum is rounding.
constexpr double rounding_share = 1e-12;

class LikelyMistakes {
public:
    LikelyMistakes(const Scene& scene, const Mechanism& mechanism, const Start& start)
        : scene_(scene), m_(mechanism), start_(start) {}

    std::vector<Diagnostic> found() {
        find_idle_loads();
        find_unlike_masses();
        find_stretched_springs();
        find_negative_constants();
        return std::move(found_);
    }

private:
    using Numbers = std::vector<double>;

    void tell(Place place, std::string message, std::string kind, std::string name) {
        found_.push_back({place, std::move(message), Severity::warning, std::move(kind), std::move(name)});
    }

    struct Given {
        Place place;
        const Name& on;
        const Vector& vector;
    };
    std::optional<Given> given(const Origin& origin) const {
        const auto given_in = [&](const auto& loads, auto on) {
            const auto& load = loads[static_cast<std::size_t>(origin.index)];
            return Given{load.place, load.*on, load.vector};
        };
        if (origin.kind == Origin::Kind::force) return given_in(scene_.forces, &Force::at);
        if (origin.kind == Origin::Kind::torque) return given_in(scene_.torques, &Torque::on);
        return {};
    }

    State<double> random_state(std::mt19937_64& random) const {
        const UniformReal<> near(-1, 1);
        State<double> state = start_.state();
        state.t += near(random);
        for (double& q : state.q) q += 0.3 * near(random);
        state.qdot.resize(m_.q.size() + m_.states.size());
        for (double& rate : state.qdot) rate = near(random);
        return state;
    }

    enum class Acts { no, yes, unknown };

    /// Whether the force has a part along any velocity, Q_i = Σ F ∂v/∂q'_i, at a state.
    Acts acts(const Program& program, State<double> state, const std::vector<int>& velocity,
              const std::vector<int>& force) const {
        const auto values_of = [&](const std::vector<int>& nodes) {
            const Numbers all = interpret(program, state);
            Numbers result;
            for (const int node : nodes) result.push_back(all[static_cast<std::size_t>(node)]);
            return result;
        };
        const Numbers F = values_of(force);
        double size = 0;
        for (const double f : F) size += std::abs(f);
        if (!std::isfinite(size) || size == 0) return Acts::unknown;
        const std::span<double> rates = std::span(state.qdot).first(m_.q.size());
        std::fill(rates.begin(), rates.end(), 0);
        const Numbers offset = values_of(velocity);
        for (double& rate : rates) {
            rate = 1;
            const Numbers v = values_of(velocity);
            rate = 0;
            double sum = 0, speed = 0;
            for (std::size_t k = 0; k < F.size(); ++k) {
                sum += F[k] * (v[k] - offset[k]);
                speed += std::abs(v[k]) + std::abs(offset[k]);
            }
            if (!std::isfinite(sum)) return Acts::unknown;
            if (std::abs(sum) > rounding_share * size * speed) return Acts::yes;
        }
        return Acts::no;
    }

    void find_idle_loads() {
        if (m_.q.empty() || m_.size() > most_coordinates) return;
        std::mt19937_64 random(1);
        for (const Load& load : m_.loads) {
            const std::optional<Given> load_given = given(load.origin);
            if (!load_given || !is_idle(load, load_given->vector, random)) continue;
            const std::string& name = load_given->on.text;
            tell(load_given->place,
                 load.origin.kind == Origin::Kind::force
                     ? say("the force at '{}' has no effect on the motion: nothing moves along it; look at its "
                           "direction and its place",
                           name)
                     : say("the torque on '{}' has no effect on the motion: nothing turns along it; look at its "
                           "direction and its frame",
                           name),
                 "no_effect", name);
        }
    }

    bool is_idle(const Load& load, const Vector& vector, std::mt19937_64& random) const {
        // Where a component of the force or of the velocity is zero, there is no pair.
        if (load.pairs.empty())
            return std::any_of(vector.component.begin(), vector.component.end(), [](const Expression& e) {
                return e.text.find_first_not_of("0. ") != std::string::npos;
            });
        std::vector<GiNaC::ex> velocities, forces;
        for (const Load::Pair& pair : load.pairs) {
            velocities.push_back(pair.velocity);
            forces.push_back(pair.force);
        }
        Program program = begun(m_);
        const std::vector<int> of_velocity = lower_expressions(program, m_, velocities),
                               of_force = lower_expressions(program, m_, forces);
        for (int k = 0; k < states_tried; ++k)
            if (acts(program, random_state(random), of_velocity, of_force) != Acts::no) return false;
        return true;
    }

    void find_unlike_masses() {
        std::vector<GiNaC::ex> wanted;
        for (const MassElement& element : m_.masses) {
            wanted.push_back(element.mass);
            for (const GiNaC::ex& x : element.position) wanted.push_back(x);
            for (int k = 0; k < 3; ++k) wanted.push_back(element.rotation ? element.rotation->inertia[k] : 0);
        }
        Program program = begun(m_);
        const std::vector<int> nodes = lower_expressions(program, m_, wanted);
        const Numbers value = interpret(program, start_.state());
        constexpr std::size_t each = 7;
        const auto at = [&](std::size_t element, std::size_t k) {
            return value[static_cast<std::size_t>(nodes[element * each + k])];
        };
        if (scene_.gravity) find_unlike_mass(at);
        find_unlike_inertias(at);
    }

    Name name_of(const Origin& origin) const {
        const auto index = static_cast<std::size_t>(origin.index);
        return origin.kind == Origin::Kind::body ? scene_.bodies[index].name : scene_.particles[index].name;
    }

    template <typename At>
    void find_unlike_mass(const At& at) {
        std::size_t heaviest = 0;
        double next = 0;
        for (std::size_t k = 1; k < m_.masses.size(); ++k) {
            const bool is_heavier = at(k, 0) > at(heaviest, 0);
            next = std::max(next, is_heavier ? at(heaviest, 0) : at(k, 0));
            if (is_heavier) heaviest = k;
        }
        if (!(next > 0) || !(at(heaviest, 0) > suspicious_mass_ratio * next)) return;
        const Name name = name_of(m_.masses[heaviest].origin);
        tell(name.place,
             say("the mass of '{}' is {:.3g} kg, {:.0e} times that of the next heaviest; is its unit right?",
                 name.text, at(heaviest, 0), at(heaviest, 0) / next),
             "suspicious_number", name.text);
    }

    /// Held against the distances of all masses from the origin.
    template <typename At>
    void find_unlike_inertias(const At& at) {
        double size = 0;
        for (std::size_t k = 0; k < m_.masses.size(); ++k)
            size = std::max({size, std::hypot(at(k, 1), at(k, 2), at(k, 3))});
        if (!(size > 0)) return;
        for (std::size_t k = 0; k < m_.masses.size(); ++k) {
            const Origin& origin = m_.masses[k].origin;
            if (origin.kind != Origin::Kind::body || !m_.masses[k].rotation || !(at(k, 0) > 0)) continue;
            const Body& body = scene_.bodies[static_cast<std::size_t>(origin.index)];
            const double moment = std::max({at(k, 4), at(k, 5), at(k, 6)}), radius = std::sqrt(moment / at(k, 0));
            if (!body.inertia || !(radius > suspicious_gyration_ratio * size)) continue;
            tell(
                body.inertia->place,
                say("the moment of inertia of '{}', {:.3g} kg m^2, is that of its mass at a distance of {:.3g} m, "
                    "{:.0e} times the size of the scene; is its unit right?",
                    body.name.text, moment, radius, radius / size),
                "suspicious_number", body.name.text);
        }
    }

    /// Where the vector between the ends is linear in the coordinates, a spring without a length is the usual
    /// linear one, along a line or isotropic in a plane.
    static bool is_linear(const std::function<std::array<double, 3>(double)>& between) {
        const std::array<double, 3> here = between(0), there = between(1), beyond = between(2);
        double bend = 0, size = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bend = std::max(bend, std::abs(here[k] - 2 * there[k] + beyond[k]));
            size = std::max({size, std::abs(here[k]), std::abs(beyond[k])});
        }
        return bend <= rounding_share * size;
    }

    void find_stretched_springs() {
        std::mt19937_64 random(2);
        for (const SpringElement& spring : m_.springs) {
            if (!spring.between || spring.extension) continue;
            const Link& given = scene_.springs[static_cast<std::size_t>(spring.origin.index)];
            if (given.length.place() != given.place) continue;  // a missing one has the place of the table
            std::vector<GiNaC::ex> between;
            for (std::size_t k = 0; k < 3; ++k)
                between.push_back(spring.between->second[k] - spring.between->first[k]);
            Program program = begun(m_);
            const std::vector<int> nodes = lower_expressions(program, m_, between);
            const std::vector<double> way = random_state(random).qdot;
            const auto at = [&](double part) {
                State<double> state = start_.state();
                for (std::size_t i = 0; i < state.q.size(); ++i) state.q[i] += part * way[i];
                const Numbers value = interpret(program, state);
                std::array<double, 3> result;
                for (std::size_t k = 0; k < 3; ++k) result[k] = value[static_cast<std::size_t>(nodes[k])];
                return result;
            };
            const std::array<double, 3> start = at(0);
            const double distance = std::hypot(start[0], start[1], start[2]);
            if (!(distance > 0) || !std::isfinite(distance) || is_linear(at)) continue;
            tell(
                given.place,
                say("this spring has no length, so that it pulls wherever its ends are apart; they start {:.3g} m "
                    "apart; give it length = …, or length = 0 if that is meant",
                    distance),
                "no_length", given.between->first.text);
        }
    }

    /// The quotient, if it is the same number at random states.
    std::optional<double> constant(const GiNaC::ex& above, const GiNaC::ex& below) const {
        Program program = begun(m_);
        const std::vector<int> nodes = lower_expressions(program, m_, {above, below});
        std::mt19937_64 random(3);
        std::optional<double> first;
        for (int k = 0; k < states_tried; ++k) {
            const Numbers value = interpret(program, random_state(random));
            const double now =
                value[static_cast<std::size_t>(nodes[0])] / value[static_cast<std::size_t>(nodes[1])];
            if (!first) first = now;
            if (!(std::abs(now - *first) <= 1e-9 * std::abs(*first))) return std::nullopt;
        }
        return first;
    }

    /// Where stiffness or damping varies, as in van der Pol's equation, its sign is meant.
    void find_negative_constants() {
        const auto find = [&](const Link& link, const std::optional<double>& value, const auto& text) {
            if (value && *value < 0)
                tell(link.constant.place(), text(fmt::format("{:.6g}", *value)), "suspicious_number",
                     link.between ? link.between->first.text : "");
        };
        for (const SpringElement& spring : m_.springs)
            find(scene_.springs[static_cast<std::size_t>(spring.origin.index)], constant(spring.stiffness, 1),
                 [](const std::string& k) {
                     return say(
                         "the stiffness of this spring is {}: it pushes away from where it is unstretched; "
                         "expected "
                         "0 or more",
                         k);
                 });
        for (const Load& load : m_.loads) {
            if (load.origin.kind != Origin::Kind::damper || load.pairs.empty()) continue;
            find(scene_.dampers[static_cast<std::size_t>(load.origin.index)],
                 constant(-load.pairs[0].force, load.pairs[0].velocity), [](const std::string& c) {
                     return say("the damping of this damper is {}: it feeds energy; expected 0 or more", c);
                 });
        }
    }

    const Scene& scene_;
    const Mechanism& m_;
    const Start& start_;
    std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> likely_mistakes(const Scene& scene, const Mechanism& mechanism, const Overrides& at) {
    // What depends on open functions has no numbers.
    if (mechanism.masses.empty() || !mechanism.open_functions().empty()) return {};
    const Start start = start_of(mechanism, at);
    return LikelyMistakes(scene, mechanism, start).found();
}

}  // namespace alembert
