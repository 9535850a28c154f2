// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/reaction/rolling_release.hpp"

#include <algorithm>

#include "model/energy.hpp"
#include "model/geometry.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

Expression expression(const std::string& text) {
    std::vector<Diagnostic> none;
    return parse_expression(text, {}, none);
}

const Body* body_named(const Scene& scene, const std::string& name) {
    const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                    [&](const Body& body) { return body.name.text == name; });
    return found == scene.bodies.end() ? nullptr : &*found;
}

/// A name that begins with `wish` and that nothing in the scene has.
std::string free_name(const Scene& scene, std::string wish) {
    const auto is_taken = [&](const auto& list) {
        return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.name.text == wish; });
    };
    while (is_taken(scene.coordinates) || is_taken(scene.parameters) || is_taken(scene.inputs) ||
           is_taken(scene.definitions) || is_taken(scene.functions) || is_taken(scene.points) ||
           is_taken(scene.particles) || is_taken(scene.bodies))
        wish += "_";
    return wish;
}

/// Questions about the mechanism with the shifts.
class Released {
public:
    Released(const Mechanism& given, const Mechanism& m, const ReleasedRolling& at)
        : given_(given),
          m_(m),
          rule_(at.scene->rolling[static_cast<std::size_t>(at.rolling)]),
          at_(at),
          body_(mass(Origin::Kind::body,
                     static_cast<int>(body_named(*at.scene, rule_.body.text) - at.scene->bodies.data()))),
          contact_(mass(Origin::Kind::particle, at.contact)) {}

    std::optional<Vector3> normal() {
        if (body_ == nullptr || contact_ == nullptr) return std::nullopt;
        find_own();
        if (!is_held_by_contact_alone()) return std::nullopt;
        const Vector3 arm = minus(contact_->position, body_->position);
        std::optional<std::size_t> axis;
        int free_axes = 0;
        for (std::size_t k = 0; k < 3; ++k)
            if (!has_row(k) && !is_zero(arm[k])) {
                axis = k;
                ++free_axes;
            }
        if (free_axes > 1) return std::nullopt;
        if (axis) {
            Vector3 n{0, 0, 0};
            n[*axis] = is_positive(arm[*axis]) ? -1 : 1;
            return n;
        }
        if (!is_across_rows(arm)) return std::nullopt;
        return scale(-1 / m_.z->name(norm(arm, *m_.z)), arm, *m_.z);
    }

private:
    const MassElement* mass(Origin::Kind kind, int index) const {
        for (const MassElement& one : m_.masses)
            if (one.origin.kind == kind && one.origin.index == index) return &one;
        return nullptr;
    }
    Vector3 minus(const Vector3& a, const Vector3& b) const { return add(a, scale(-1, b, *m_.z), *m_.z); }
    bool is_zero(const ex& e) const { return is_identically_zero(e, m_); }

    /// The coordinates on which the body's place and attitude depend.
    void find_own() {
        for (int i = 0; i < at_.coordinates; ++i)
            if (depends(*body_, {m_.q[static_cast<std::size_t>(i)]}))
                own_.push_back(m_.q[static_cast<std::size_t>(i)]);
    }

    bool depends(const Vector3& v, const std::vector<GiNaC::symbol>& on) const {
        return std::any_of(v.begin(), v.end(), [&](const ex& e) { return m_.z->depends(e, on); });
    }
    bool depends(const MassElement& one, const std::vector<GiNaC::symbol>& on) const {
        if (depends(one.position, on)) return true;
        return one.rotation && std::any_of(one.rotation->axes.begin(), one.rotation->axes.end(),
                                           [&](const Vector3& axis) { return depends(axis, on); });
    }
    std::vector<GiNaC::symbol> shifts() const { return {m_.q.begin() + at_.first, m_.q.begin() + at_.first + 3}; }
    bool is_shifted(const Vector3& place) const { return depends(place, shifts()); }

    /// Whether what depends on the body's coordinates is placed relative to it, and no constraint or other contact
    /// without a multiplier holds it.
    bool is_held_by_contact_alone() const {
        for (const MassElement& one : m_.masses)
            if (one.origin.name != rule_.on.text && depends(one, own_) && !is_shifted(one.position)) return false;
        for (const SpringElement& spring : m_.springs)
            if (spring.between)
                for (const Vector3* end : {&spring.between->first, &spring.between->second})
                    if (depends(*end, own_) && !is_shifted(*end)) return false;
        if (!std::all_of(m_.loads.begin(), m_.loads.end(), [&](const Load& load) { return is_seen(load); }))
            return false;
        return std::all_of(m_.constraints.begin(), m_.constraints.end(), [&](const Mechanism::Constraint& c) {
            return c.rolling == at_.rolling || !holds(c) || is_known(c.multiplier.get_name());
        });
    }

    /// A force at a point that moves with the body's coordinates has to move with its shifts.
    bool is_seen(const Load& load) const {
        if (load.origin.kind != Origin::Kind::force) return true;
        std::vector<GiNaC::symbol> rates, shifted;
        for (int i = 0; i < at_.coordinates; ++i)
            if (std::any_of(own_.begin(), own_.end(),
                            [&](const ex& q) { return q.is_equal(m_.q[static_cast<std::size_t>(i)]); }))
                rates.push_back(m_.qdot[static_cast<std::size_t>(i)]);
        for (int k = 0; k < 3; ++k) shifted.push_back(m_.qdot[static_cast<std::size_t>(at_.first + k)]);
        const auto any = [&](const std::vector<GiNaC::symbol>& of) {
            return std::any_of(load.pairs.begin(), load.pairs.end(),
                               [&](const Load::Pair& pair) { return m_.z->depends(pair.velocity, of); });
        };
        return !any(rates) || any(shifted);
    }

    bool holds(const Mechanism::Constraint& c) const {
        return std::any_of(c.row.begin() + at_.first, c.row.begin() + at_.first + 3,
                           [&](const ex& e) { return !is_zero(e); });
    }
    bool is_known(const std::string& multiplier) const {
        const auto has = [&](const std::vector<Mechanism::Constraint>& list) {
            return std::any_of(list.begin(), list.end(), [&](const Mechanism::Constraint& c) {
                return c.multiplier.get_name() == multiplier;
            });
        };
        return has(given_.constraints) || has(given_.redundant) ||
               std::any_of(
                   given_.unilateral.begin(), given_.unilateral.end(),
                   [&](const Mechanism::Unilateral& u) { return u.gap.multiplier.get_name() == multiplier; });
    }

    /// Whether the scene has a row of this rolling along an axis of N, or rows along other axes.
    bool has_row(std::size_t axis) const {
        return given_.rollings[static_cast<std::size_t>(at_.rolling)].is_along ||
               is_known(multipliers_of(rule_)[axis].text);
    }

    bool is_positive(const ex& e) const {
        ex value = m_.z->expand(e);
        GiNaC::exmap start;
        for (std::size_t i = 0; i < m_.q.size(); ++i) start[m_.q[i]] = m_.q_start[i];
        value = value.subs(start, GiNaC::subs_options::no_pattern);
        for (std::size_t round = 0; round <= m_.parameters.size(); ++round) {
            GiNaC::exmap numbers;
            for (const Mechanism::Parameter& p : m_.parameters) numbers[p.symbol] = p.value;
            value = value.subs(numbers, GiNaC::subs_options::no_pattern);
        }
        value = value.subs(m_.t == 0).evalf();
        return GiNaC::is_a<GiNaC::numeric>(value) && value > 0;
    }

    /// Whether the slip that the rows forbid is perpendicular to the arm in every motion of the scene's
    /// coordinates.
    bool is_across_rows(const Vector3& arm) const {
        for (std::size_t i = 0; i < static_cast<std::size_t>(at_.coordinates); ++i) {
            std::vector<ex> terms;
            for (const Mechanism::Constraint& c : m_.constraints) {
                if (c.rolling != at_.rolling) continue;
                const auto axis = static_cast<std::size_t>(c.name.back() - 'x');
                terms.push_back(arm[axis] * c.row[i]);
            }
            if (!is_zero(m_.z->name(GiNaC::add(GiNaC::exvector(terms.begin(), terms.end()))))) return false;
        }
        return true;
    }

    const Mechanism &given_, &m_;
    const RollingRule& rule_;
    ReleasedRolling at_;
    const MassElement *body_, *contact_;
    std::vector<GiNaC::symbol> own_;
};

}  // namespace

bool is_releasable(const Scene& scene, const RollingRule& rule) {
    const Body* const body = body_named(scene, rule.body.text);
    return body != nullptr && body->has_position && !body->joint && !scene.kinetic && !scene.potential &&
           !scene.lagrangian;
}

Scene with_rolling_released(Scene scene, const RollingRule& rule) {
    const std::string place = free_name(scene, "place_of_" + rule.name.text);
    Body& body = *std::find_if(scene.bodies.begin(), scene.bodies.end(),
                               [&](const Body& one) { return one.name.text == rule.body.text; });
    scene.points.push_back({.name = {place, body.name.place}, .position = body.position});
    Position shifted{.from = scene.points.back().name, .offset = {}, .axes = {"N", {}}};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string name = free_name(scene, "shift_of_" + rule.name.text + "_" + "xyz"[k]);
        scene.coordinates.push_back({.name = {name, rule.name.place},
                                     .initial = expression("0"),
                                     .rate = expression("0"),
                                     .unit = {},
                                     .about = {}});
        shifted.offset.component[k] = expression(name);
    }
    body.position = shifted;
    scene.particles.push_back({.name = {free_name(scene, "contact_of_" + rule.name.text), rule.name.place},
                               .mass = expression("0"),
                               .position = {.from = body.point(), .offset = rule.contact, .axes = rule.axes}});
    return scene;
}

std::optional<Vector3> normal_of(const Mechanism& given, const Mechanism& released, const ReleasedRolling& at) {
    return Released(given, released, at).normal();
}

std::string normal_reaction_of(const RollingRule& rule) {
    return "lambda_" + rule.name.text + "_normal";
}

}  // namespace alembert
