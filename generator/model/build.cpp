// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "model/constraint.hpp"
#include "model/energy.hpp"
#include "model/joints.hpp"
#include "model/parameter_values.hpp"
#include "model/places.hpp"
#include "model/translate.hpp"
#include "scene/quaternions.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

/// Builds one mechanism, table by table; mistakes are gathered and reported together.
class Builder {
public:
    explicit Builder(const Scene& scene)
        : scene_(scene),
          translator_(m_, {.position = [this](const std::string& p) { return places_.position(p); },
                           .velocity = [this](const std::string& p) { return places_.velocity(p); },
                           .orientation = [this](const std::string& f) -> const Orientation& {
                               return places_.orientation(f);
                           }}),
          places_(scene, m_, translator_) {}

    Mechanism build() {
        m_.name = std::filesystem::path(scene_.file).stem().string();
        m_.title = scene_.title;
        m_.symbols = std::make_shared<Symbols>();
        m_.z = std::make_shared<Intermediates>(*m_.symbols);
        m_.t = m_.symbols->declare("t", SymbolInfo::Kind::time);
        translator_.know("t", m_.t);
        declare_parameters();
        declare_inputs();
        declare_coordinates();
        define();
        if (!mistakes_.empty()) fail(scene_, mistakes_);
        values_.emplace(m_);
        check_values();
        add_masses();
        add_joints();
        add_links();
        add_forces();
        add_impulses();
        add_energy();
        add_speeds();
        add_constraints();
        add_outputs();
        add_run();
        if (!mistakes_.empty()) fail(scene_, mistakes_);
        m_.skeleton = places_.skeleton();
        return std::move(m_);
    }

private:
    using Kind = SymbolInfo::Kind;

    // Runs `step`; what it finds wrong is kept, and the building goes on.
    template <typename Step>
    void attempt(const Step& step) {
        try {
            step();
        } catch (const SceneMistake& mistake) {
            mistakes_.push_back(mistake.diagnostic);
        }
    }

    void declare_parameters() {
        for (std::size_t i = 0; i < scene_.parameters.size(); ++i) {
            const Parameter& p = scene_.parameters[i];
            const auto s = m_.symbols->declare(p.name.text, Kind::parameter, static_cast<int>(i));
            translator_.know(p.name.text, s);
            m_.parameters.push_back({.symbol = s, .value = 0, .unit = p.unit, .about = p.about});
        }
        for (std::size_t i = 0; i < scene_.parameters.size(); ++i)
            attempt([&] {
                m_.parameters[i].value = m_.z->expand(translator_.scalar(scene_.parameters[i].value));
                m_.parameters[i].independent = GiNaC::is_a<numeric>(m_.parameters[i].value);
            });
    }

    void declare_inputs() {
        for (std::size_t i = 0; i < scene_.inputs.size(); ++i) {
            const Input& input = scene_.inputs[i];
            Mechanism::Input made{.derivative = {}, .value = 0, .unit = input.unit};
            for (int order = 0; order < 3; ++order)
                made.derivative[order] =
                    m_.symbols->declare(input.name.text, Kind::input, static_cast<int>(i), order);
            translator_.know(input.name.text, made.derivative[0]);
            m_.inputs.push_back(made);
        }
        for (std::size_t i = 0; i < scene_.inputs.size(); ++i)
            attempt([&] { m_.inputs[i].value = m_.z->name(translator_.scalar(scene_.inputs[i].value)); });
    }

    void declare_coordinates() {
        for (std::size_t i = 0; i < scene_.coordinates.size(); ++i) {
            const Coordinate& c = scene_.coordinates[i];
            const int index = static_cast<int>(i);
            m_.q.push_back(m_.symbols->declare(c.name.text, Kind::coordinate, index, 0));
            m_.qdot.push_back(m_.symbols->declare(c.name.text, Kind::coordinate, index, 1));
            m_.qddot.push_back(m_.symbols->declare(c.name.text, Kind::coordinate, index, 2));
            m_.units.push_back(c.unit);
            m_.q_is_guess.push_back(c.initial_is_guess);
            m_.qdot_is_guess.push_back(c.rate_is_guess);
        }
        for (std::size_t i = 0; i < scene_.speeds.size(); ++i) {
            const Speed& s = scene_.speeds[i];
            const int index = static_cast<int>(i);
            m_.speeds.push_back({.u = m_.symbols->declare(s.name.text, Kind::speed, index, 0),
                                 .udot = m_.symbols->declare(s.name.text, Kind::speed, index, 1),
                                 .form = 0,
                                 .row = {},
                                 .drift = 0,
                                 .start = {},
                                 .unit = s.unit,
                                 .place = s.name.place});
        }
        for (const Coordinate& c : scene_.coordinates) {
            m_.q_start.emplace_back(0);
            m_.qdot_start.emplace_back(0);
            attempt([&] {
                m_.q_start.back() = m_.z->expand(translator_.scalar(c.initial));
                m_.qdot_start.back() = m_.z->expand(translator_.scalar(c.rate));
            });
        }
    }

    void define() {
        for (const Speed& s : scene_.speeds)
            translator_.know_later(s.name.text, [this, &s] {
                SourceScope source(*m_.z, "speed " + s.name.text);
                return m_.z->name(translator_.scalar(s.form));
            });
        for (const Definition& d : scene_.definitions)
            translator_.know_later(d.name.text, [this, &d] {
                SourceScope source(*m_.z, "definition " + d.name.text);
                return m_.z->name(translator_.scalar(d.value));
            });
        for (const Definition& d : scene_.definitions)
            attempt([&] {
                const Tree self{.kind = Tree::Kind::name, .text = d.name.text};
                const Expression whole{d.name.text, {d.name.place}, std::make_shared<Tree>(self)};
                m_.definitions.push_back({d.name.text, translator_.scalar(whole)});
            });
    }

    // Values at the scene's own parameters

    double number_at(const Expression& e) {
        try {
            return values_->number(m_.z->expand(translator_.scalar(e)));
        } catch (const SceneMistake&) {
            throw;
        } catch (const std::exception&) {  // a pole, or beyond CLN's range
            return std::nan("");
        }
    }

    void require(const Expression& e, const std::string& what, bool not_negative) {
        attempt([&] {
            const double value = number_at(e);
            if (!std::isfinite(value))
                throw SceneMistake{{e.place(), what + " is not a finite real number at the scene's values"}};
            if (not_negative && value < 0)
                throw SceneMistake{{e.place(), fmt::format("{} is {}; expected zero or more", what, value)}};
        });
    }

    void check_values() {
        for (const Parameter& p : scene_.parameters) require(p.value, "parameter '" + p.name.text + "'", false);
        for (const Coordinate& c : scene_.coordinates) {
            require(c.initial, "the initial value of '" + c.name.text + "'", false);
            require(c.rate, "the initial rate of '" + c.name.text + "'", false);
        }
        for (const Speed& s : scene_.speeds)
            if (s.initial) require(s.initial, "the initial value of '" + s.name.text + "'", false);
        for (const Particle& p : scene_.particles) require(p.mass, "the mass of particle '" + p.name.text + "'", true);
        for (const Body& b : scene_.bodies) {
            require(b.mass, "the mass of body '" + b.name.text + "'", true);
            if (!b.inertia) continue;
            if (b.inertia->planar) require(*b.inertia->planar, "the moment of inertia of body '" + b.name.text + "'", true);
            for (std::size_t k = 0; !b.inertia->planar && k < 6; ++k)
                require(b.inertia->tensor[k], "the moment of inertia of body '" + b.name.text + "'", k < 3);
        }
        if (!mistakes_.empty()) fail(scene_, mistakes_);
    }

    // T, V and the loads

    void add_masses() {
        for (const Particle& p : scene_.particles)
            attempt([&] {
                SourceScope source(*m_.z, "particle " + p.name.text);
                add_translation("particle " + p.name.text, p.name.text, translator_.scalar(p.mass));
            });
        for (const Body& b : scene_.bodies)
            attempt([&] {
                SourceScope source(*m_.z, "body " + b.name.text);
                const ex mass = translator_.scalar(b.mass);
                add_translation("body " + b.name.text, b.name.text, mass);
                add_rotation(b, mass);
            });
    }

    /// The system graph.
    void add_joints() {
        const auto index = [&](const std::string& body) {
            const auto found = std::find_if(m_.masses.begin(), m_.masses.end(),
                                            [&](const MassElement& e) { return e.label == "body " + body; });
            return found == m_.masses.end() ? -1 : static_cast<int>(found - m_.masses.begin());
        };
        for (const Joint& joint : scene_.joints)
            attempt([&] {
                SourceScope source(*m_.z, "joint " + joint.name.text);
                m_.joints.push_back(arc_of(joint, places_));
                m_.joints.back().parent = index(joint.parent.body.text);
                m_.joints.back().child = index(joint.child.body.text);
            });
    }

    // ½ m v², and −m g·r
    void add_translation(const std::string& label, const std::string& point, const ex& mass) {
        const Vector3 v = places_.velocity(point);
        m_.kinetic.push_back({label, m_.z->name(mass / 2 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]))});
        m_.masses.push_back({.label = label, .mass = mass, .position = places_.position(point), .velocity = v, .point = places_.point(point)});
        if (!scene_.gravity) return;
        const Vector3 g = places_.vector(*scene_.gravity), r = places_.position(point);
        m_.gravity = g;
        const ex weight = m_.z->name(-mass * (g[0] * r[0] + g[1] * r[1] + g[2] * r[2]));
        if (!weight.is_zero()) m_.potential.push_back({"gravity on " + label, weight});
    }

    // ½ ω·I ω with I about the mass centre; if I is about P, less ½ m (v − v_P)², what the transport adds.
    void add_rotation(const Body& b, const ex& mass) {
        if (!b.inertia) return;
        const Orientation& orientation = places_.orientation(b.frame.text);
        const Vector3 w = orientation.angular_velocity();
        MassElement::Rotation rotation{
            .axes = {orientation.axis(0), orientation.axis(1), orientation.axis(2)}, .w_NB_B = w, .inertia = {}};
        ex energy;
        if (b.inertia->planar) {
            if (!w[0].is_zero() || !w[1].is_zero())
                throw SceneMistake{{b.inertia->place,
                                    fmt::format("body '{}' turns in space and has one moment of inertia; expected "
                                                "three, [Ixx, Iyy, Izz], or a tensor",
                                                b.name.text)}};
            rotation.inertia[2] = translator_.scalar(*b.inertia->planar);
            energy = rotation.inertia[2] * w[2] * w[2] / 2;
        } else {
            std::array<ex, 6>& I = rotation.inertia;
            for (int k = 0; k < 6; ++k) I[k] = translator_.scalar(b.inertia->tensor[k]);
            energy = (I[0] * w[0] * w[0] + I[1] * w[1] * w[1] + I[2] * w[2] * w[2]) / 2 + I[3] * w[0] * w[1] +
                     I[4] * w[1] * w[2] + I[5] * w[2] * w[0];
        }
        if (b.about) {
            const auto from_about = [&](const Vector3& centre, const Vector3& about) {
                return add(centre, scale(-1, about, *m_.z), *m_.z);
            };
            const Vector3 r = from_about(places_.position(b.name.text), places_.position(b.about->text));
            const Vector3 d = from_about(places_.velocity(b.name.text), places_.velocity(b.about->text));
            const Vector3 turning = cross(orientation.to_inertial(w, *m_.z), r, *m_.z);
            for (int k = 0; k < 3; ++k)
                if (vanishes(d[k] - turning[k], m_) == false)
                    throw SceneMistake{{b.about->place,
                                        fmt::format("point '{}' is not fixed in body '{}'; its moments of inertia can "
                                                    "only be given about a point that moves with it",
                                                    b.about->text, b.name.text)}};
            energy -= mass / 2 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            rotation.about = r;
        }
        m_.masses.back().rotation = rotation;
        m_.masses.back().frame = orientation.frame;
        if (b.about) m_.masses.back().about = places_.point(b.about->text);
        m_.kinetic.push_back({"rotation of body " + b.name.text, m_.z->name(energy)});
    }

    /// The length of a spring or damper, or the expression along which it acts.
    ex length_of(const Link& link) {
        if (!link.between) return m_.z->name(translator_.scalar(link.along));
        return norm(add(places_.position(link.between->second.text), scale(-1, places_.position(link.between->first.text), *m_.z),
                        *m_.z),
                    *m_.z);
    }

    // Spring: V = ½ k (d − d₀)². Damper: −c d' along d.
    void add_links() {
        for (std::size_t i = 0; i < scene_.springs.size(); ++i)
            attempt([&] {
                const Link& s = scene_.springs[i];
                const std::string label = fmt::format("spring {}", i + 1);
                SourceScope source(*m_.z, label);
                const ex k = translator_.scalar(s.constant), free_length = translator_.scalar(s.length);
                ex square;
                if (s.between && free_length.is_zero()) {
                    const Vector3 d = add(places_.position(s.between->second.text),
                                          scale(-1, places_.position(s.between->first.text), *m_.z), *m_.z);
                    square = dot(d, d, *m_.z);
                } else {
                    square = pow(length_of(s) - free_length, 2);
                }
                m_.potential.push_back({label, m_.z->name(k / 2 * square)});
                SpringElement spring{.label = label, .stiffness = k, .free_length = free_length};
                if (s.between)
                    spring.between = {places_.position(s.between->first.text), places_.position(s.between->second.text)};
                else
                    spring.along = length_of(s);
                m_.springs.push_back(std::move(spring));
            });
        for (std::size_t i = 0; i < scene_.dampers.size(); ++i)
            attempt([&] {
                const std::string label = fmt::format("damper {}", i + 1);
                SourceScope source(*m_.z, label);
                const ex length = length_of(scene_.dampers[i]);
                const ex rate = m_.time_derivative({length})[0];
                const ex force = m_.z->name(-translator_.scalar(scene_.dampers[i].constant) * rate);
                m_.loads.push_back({label, true, {{rate, force, length}}});
            });
    }

    void add_forces() {
        const auto add_pairs = [](Load& load, const Vector3& velocity, const Vector3& force, int sign,
                                  const std::optional<Vector3>& position = {}) {
            for (int k = 0; k < 3; ++k)
                if (!force[k].is_zero() && !velocity[k].is_zero())
                    load.pairs.push_back({velocity[k], sign * force[k], position ? std::optional((*position)[k]) : std::nullopt});
        };
        for (std::size_t i = 0; i < scene_.forces.size(); ++i)
            attempt([&] {
                const Force& f = scene_.forces[i];
                Load load{.label = fmt::format("force {} at {}", i + 1, f.at.text), .pairs = {}};
                SourceScope source(*m_.z, load.label);
                const Vector3 F = places_.along(f.vector, f.axes);
                add_pairs(load, places_.velocity(f.at.text), F, 1, places_.position(f.at.text));
                if (f.reaction)
                    add_pairs(load, places_.velocity(f.reaction->text), F, -1, places_.position(f.reaction->text));
                m_.loads.push_back(std::move(load));
            });
        for (std::size_t i = 0; i < scene_.torques.size(); ++i)
            attempt([&] {
                const Torque& tau = scene_.torques[i];
                Load load{.label = fmt::format("torque {} on {}", i + 1, tau.on.text), .pairs = {}};
                SourceScope source(*m_.z, load.label);
                const Vector3 M = places_.along(tau.vector, tau.axes);
                const auto spin = [&](const std::string& frame) {
                    const Orientation& o = places_.orientation(frame);
                    return o.to_inertial(o.angular_velocity(), *m_.z);
                };
                add_pairs(load, spin(tau.on.text), M, 1);
                if (tau.reaction) add_pairs(load, spin(tau.reaction->text), M, -1);
                m_.loads.push_back(std::move(load));
            });
    }

    void add_impulses() {
        for (std::size_t i = 0; i < scene_.impulses.size(); ++i)
            attempt([&] {
                const Impulse& impulse = scene_.impulses[i];
                Load load{.label = fmt::format("impulse {} at {}", i + 1, impulse.at.text), .pairs = {}};
                SourceScope source(*m_.z, load.label);
                const Vector3 S = places_.along(impulse.vector, impulse.axes), velocity = places_.velocity(impulse.at.text);
                for (int k = 0; k < 3; ++k)
                    if (!S[k].is_zero() && !velocity[k].is_zero()) load.pairs.push_back({velocity[k], S[k]});
                m_.impulses.push_back(std::move(load));
            });
        for (const GeneralizedForce& f : scene_.generalized_impulses)
            attempt([&] {
                const std::string label = "impulse on " + f.coordinate.text;
                SourceScope source(*m_.z, label);
                for (int i = 0; i < m_.size(); ++i)
                    if (m_.q[i].get_name() == f.coordinate.text)
                        m_.impulses.push_back({label, false, {{m_.qdot[i], m_.z->name(translator_.scalar(f.value)), m_.q[i]}}});
            });
    }

    void add_energy() {
        attempt([&] {
            SourceScope source(*m_.z, "[energy] kinetic");
            if (scene_.kinetic) m_.kinetic.push_back({"[energy] kinetic", m_.z->name(translator_.scalar(scene_.kinetic))});
        });
        attempt([&] {
            SourceScope source(*m_.z, "[energy] potential");
            if (scene_.potential)
                m_.potential.push_back({"[energy] potential", m_.z->name(translator_.scalar(scene_.potential))});
        });
        attempt([&] {
            SourceScope source(*m_.z, "[energy] lagrangian");
            if (scene_.lagrangian) m_.given_lagrangian = m_.z->name(translator_.scalar(scene_.lagrangian));
        });
        attempt([&] {
            if (!scene_.rayleigh) return;
            SourceScope source(*m_.z, "[dissipation]");
            const ex R = m_.z->name(translator_.scalar(scene_.rayleigh));
            const std::vector<ex> gradient = m_.z->pull_back({{R, 1}}, m_.qdot);
            Load load{.label = "[dissipation]", .dissipative = true, .pairs = {}};
            for (int i = 0; i < m_.size(); ++i)
                if (!gradient[i].is_zero()) load.pairs.push_back({m_.qdot[i], -gradient[i], m_.q[i]});
            m_.loads.push_back(std::move(load));
        });
        for (const GeneralizedForce& f : scene_.generalized_forces)
            attempt([&] {
                const std::string label = "force on " + f.coordinate.text;
                SourceScope source(*m_.z, label);
                for (int i = 0; i < m_.size(); ++i)
                    if (m_.q[i].get_name() == f.coordinate.text)
                        m_.loads.push_back({label, false, {{m_.qdot[i], m_.z->name(translator_.scalar(f.value)), m_.q[i]}}});
            });
    }

    // u = W q' + w
    void add_speeds() {
        const bool has_start = std::any_of(scene_.speeds.begin(), scene_.speeds.end(), [](const Speed& s) { return !!s.initial; });
        for (std::size_t i = 0; i < scene_.speeds.size(); ++i)
            attempt([&] {
                const Speed& s = scene_.speeds[i];
                const std::string what = "speed '" + s.name.text + "'";
                SourceScope source(*m_.z, "speed " + s.name.text);
                Mechanism::Speed& made = m_.speeds[i];
                made.form = m_.z->name(translator_.scalar(s.form));
                std::tie(made.row, made.drift) = linear_form(made.form, what, s.form.place(), m_);
                if (all_zero(made.row)) throw SceneMistake{{s.form.place(), what + " contains no rate"}};
                if (has_start) made.start = s.initial ? m_.z->expand(translator_.scalar(s.initial)) : ex(0);
            });
    }

    // f(q,t) = 0 or a·q' + b = 0, as rows (mechanism.hpp).
    void add_constraints() {
        for (std::size_t k = 0; k < scene_.constraints.size(); ++k)
            attempt([&] { add_constraint(scene_.constraints[k], static_cast<int>(k)); });
        int index = static_cast<int>(scene_.constraints.size());
        for (const FrameQuaternion& quaternion : quaternions_of(scene_)) attempt([&] { add_norm(quaternion, index++); });
        for (const RollingRule& rule : scene_.rolling) {
            attempt([&] { add_rolling(rule, index); });
            index += 3;
        }
        for (const Joint& joint : scene_.joints)
            if (joint.closes_loop) attempt([&] { close(joint); });
        for (const UnilateralRule& rule : scene_.unilateral) attempt([&] { add_unilateral(rule, index++); });
    }

    // e·e − 1 = 0
    void add_norm(const FrameQuaternion& quaternion, int index) {
        SourceScope source(*m_.z, "frame " + quaternion.of.text);
        ex value = -1, start = 0;
        bool moves = false;
        for (const Name& name : quaternion.e) {
            const std::size_t i = coordinate_index(name.text, m_);
            value += m_.q[i] * m_.q[i];
            start += m_.q_start[i] * m_.q_start[i];
            moves = moves || m_.q_is_guess[i];
        }
        const double square = values_->number(m_.z->expand(start));
        if (!moves && !(std::abs(square - 1) <= 1e-9))
            throw SceneMistake{{quaternion.e[0].place,
                                fmt::format("the sum of squares of the quaternion of frame '{}' is {:.12g} at the start; expected 1: "
                                            "divide each initial value by {:.12g}, or give them as guesses",
                                            quaternion.of.text, square, std::sqrt(square))}};
        const std::string multiplier = multiplier_of(quaternion).text;
        m_.constraints.push_back(constraint_of({.name = quaternion.of.text,
                                                .holonomic = true,
                                                .value = value,
                                                .multiplier = m_.symbols->declare(multiplier, Kind::other, index),
                                                .place = quaternion.of.place,
                                                .at = quaternion.e[0].place},
                                               m_));
        m_.constraints.back().norm = true;
        translator_.know(multiplier, m_.constraints.back().multiplier);
    }

    // v_C + ω × c − v_on − ω_on × (r_C + c − r_on) = 0 along x, y, z
    void add_rolling(const RollingRule& rule, int index) {
        SourceScope source(*m_.z, "rolling " + rule.name.text);
        Intermediates& z = *m_.z;
        const Vector3 c = places_.along(rule.contact, rule.axes);
        const auto turning = [&](const std::string& body, const Vector3& arm) {
            const Orientation& o = places_.orientation(body);
            return cross(o.to_inertial(o.angular_velocity(), z), arm, z);
        };
        Vector3 slip = add(places_.velocity(rule.body.text), turning(rule.body.text, c), z);
        if (rule.on.text != "N") {
            const Vector3 touching = add(places_.position(rule.body.text), c, z);
            const Vector3 arm = add(touching, scale(-1, places_.position(rule.on.text), z), z);
            const Vector3 ground = add(places_.velocity(rule.on.text), turning(rule.on.text, arm), z);
            slip = add(slip, scale(-1, ground, z), z);
        }
        const std::array<Name, 3> multipliers = multipliers_of(rule);
        std::vector<GiNaC::symbol> clock{m_.t};
        for (const Mechanism::Input& input : m_.inputs) clock.insert(clock.end(), input.derivative.begin(), input.derivative.end());
        // Velocities are forms in the rates alone where no place and no attitude depends on time by itself.
        const auto by_itself = [&](const Vector3& v) { return std::any_of(v.begin(), v.end(), [&](const ex& e) { return z.depends(e, clock); }); };
        bool drifts = false;
        for (const std::string& body : {rule.body.text, rule.on.text})
            for (int k = 0; k < 3; ++k)
                if (body != "N") drifts = drifts || by_itself(places_.position(body)) || by_itself(places_.orientation(body).axis(k));
        bool any = false;
        for (int k = 0; k < 3; ++k) {
            const std::string name = rule.name.text + "_" + "xyz"[k];
            const auto [row, drift] = linear_form(slip[k], "rolling '" + name + "'", rule.contact.place, m_);
            if (std::all_of(row.begin(), row.end(), [&](const ex& entry) { return is_identically_zero(entry, m_); })) {
                if (drifts && !drift.is_zero())
                    throw SceneMistake{{rule.name.place,
                                        fmt::format("rolling '{}' cannot hold: along {} the contact moves by itself, whatever the "
                                                    "coordinates' rates",
                                                    rule.name.text, "xyz"[k])}};
                translator_.know(multipliers[k].text, 0);
                continue;
            }
            any = true;
            m_.constraints.push_back(constraint_of({.name = name,
                                                    .holonomic = false,
                                                    .value = slip[k],
                                                    .multiplier = m_.symbols->declare(multipliers[k].text, Kind::other, index + k),
                                                    .place = rule.name.place,
                                                    .at = rule.contact.place,
                                                    .drifts = drifts},
                                                   m_));
            translator_.know(multipliers[k].text, m_.constraints.back().multiplier);
        }
        if (!any)
            throw SceneMistake{{rule.name.place, fmt::format("rolling '{}' says nothing: the point of '{}' at the contact moves with '{}' "
                                                             "in every motion",
                                                             rule.name.text, rule.body.text, rule.on.text)}};
    }

    void add_constraint(const ConstraintRule& rule, int index) {
        SourceScope source(*m_.z, "constraint " + rule.name.text);
        const std::string multiplier = rule.multiplier ? rule.multiplier->text : "lambda_" + rule.name.text;
        m_.constraints.push_back(
            constraint_of({.name = rule.name.text,
                           .holonomic = rule.holonomic,
                           .value = translator_.scalar(rule.equation.lhs) - translator_.scalar(rule.equation.rhs),
                           .multiplier = m_.symbols->declare(multiplier, Kind::other, index),
                           .place = rule.name.place,
                           .at = rule.equation.lhs.place()},
                          m_));
        translator_.know(multiplier, m_.constraints.back().multiplier);
    }

    void close(const Joint& joint) {
        SourceScope source(*m_.z, "joint " + joint.name.text);
        int k = 0;
        for (const ClosingRow& row : closing_rows(joint, places_)) {
            const std::string name = fmt::format("{}_{}", joint.name.text, ++k), multiplier = "lambda_" + name;
            const std::vector<ex> slopes = m_.z->pull_back({{row.value, 1}}, row.holonomic ? m_.q : m_.qdot);
            if (std::all_of(slopes.begin(), slopes.end(), [&](const ex& e) { return is_identically_zero(e, m_); })) {
                if (row.holonomic) need_closed(joint, row.value, k);
                m_.identities.push_back(name);
                translator_.know(multiplier, 0);
                continue;
            }
            m_.constraints.push_back(
                constraint_of({.name = name,
                               .holonomic = row.holonomic,
                               .value = row.value,
                               .multiplier = m_.symbols->declare(multiplier, Kind::other, static_cast<int>(m_.constraints.size())),
                               .place = joint.name.place,
                               .at = joint.name.place},
                              m_));
            m_.constraints.back().closes_loop = true;
            translator_.know(multiplier, m_.constraints.back().multiplier);
        }
    }

    // A direction in which no coordinate moves the bodies against each other.
    void need_closed(const Joint& joint, const ex& value, int k) {
        constexpr double closed = 1e-9;  // of lengths of order one; what initial values may break a constraint by
        const bool moves = m_.z->depends(value, {m_.t}) && !is_identically_zero(m_.explicit_time_derivative({value})[0], m_);
        const double gap = moves ? std::nan("") : places_.number(value);
        if (std::abs(gap) <= closed) return;
        throw SceneMistake{{joint.name.place,
                            fmt::format("joint '{}' cannot close: in its locked direction {} (translations x, y, z, then rotations, "
                                        "as far as locked) the bodies stand apart {}, and no coordinate can change that",
                                        joint.name.text, k, moves ? "as time goes on" : fmt::format("by {:.6g}", gap))}};
    }

    // gap(q,t) ≥ 0
    void add_unilateral(const UnilateralRule& rule, int index) {
        SourceScope source(*m_.z, "unilateral " + rule.name.text);
        const std::string multiplier = "lambda_" + rule.name.text;
        const double restitution = number_at(rule.restitution);
        if (!(restitution >= 0 && restitution <= 1))
            throw SceneMistake{{rule.restitution.place(),
                                fmt::format("the restitution of '{}' is {}; expected a number from 0 (the bodies stay "
                                            "together) to 1 (no energy is lost)",
                                            rule.name.text, restitution)}};
        m_.unilateral.push_back({.gap = constraint_of({.name = rule.name.text,
                                                       .holonomic = true,
                                                       .value = translator_.scalar(rule.gap),
                                                       .multiplier = m_.symbols->declare(multiplier, Kind::other, index),
                                                       .place = rule.name.place,
                                                       .at = rule.gap.place()},
                                                      m_),
                                 .restitution = m_.z->name(translator_.scalar(rule.restitution))});
        translator_.know(multiplier, m_.unilateral.back().gap.multiplier);
    }

    void add_outputs() {
        for (const Output& o : scene_.outputs)
            attempt([&] {
                SourceScope source(*m_.z, "output " + o.name.text);
                m_.outputs.push_back({o.name.text, m_.z->name(translator_.scalar(o.value))});
            });
        for (const EventRule& e : scene_.events)
            attempt([&] {
                SourceScope source(*m_.z, "event " + e.name.text);
                m_.events.push_back({e.name.text, m_.z->name(translator_.scalar(e.when))});
                m_.event_stops.push_back(e.stop);
            });
    }

    void add_run() {
        const Simulation& s = scene_.simulation;
        const auto value = [&](const Expression& e, std::optional<ex>& to) {
            attempt([&] {
                if (e) to = m_.z->expand(translator_.scalar(e));
            });
        };
        value(s.start, m_.run.start);
        value(s.duration, m_.run.duration);
        value(s.tolerance, m_.run.tolerance);
        value(s.step, m_.run.step);
        value(s.sample, m_.run.sample);
        if (s.method) m_.run.method = s.method->text;
    }

    const Scene& scene_;
    Mechanism m_;
    Translator translator_;
    Places places_;
    std::optional<ParameterValues> values_;  // once the parameters are known
    std::vector<Diagnostic> mistakes_;
};

}  // namespace

Mechanism build(const Scene& scene) { return Builder(scene).build(); }

}  // namespace alembert
