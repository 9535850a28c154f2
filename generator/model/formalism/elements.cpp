// SPDX-License-Identifier: GPL-2.0-or-later
// The force of a spring on its end P₂ is −k (1 − d₀/|d|) d, d = r₂ − r₁, and the opposite on P₁; of V = ½ k (|d| −
// d₀)² the rest is −∂V/∂k along k and −∂V/∂d₀ along d₀, where these change with the coordinates. Steiner (Zhang &
// Qin, chapter 2): I_C = I_P − m (d·d E − d dᵀ), d from P to C along the body's axes.
#include "model/formalism/elements.hpp"

#include <fmt/format.h>

#include "alembert/base/interrupt.hpp"
#include "algebra/notation/readable.hpp"
#include "base/language/say.hpp"
#include "model/geometry.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Makes the forces of V.
class ForcesOfV {
public:
    explicit ForcesOfV(const Mechanism& m) : m_(m), z_(*m.z) {}

    std::vector<PlacedForce> run() {
        for (const MassElement& body : m_.masses)
            push(gravity_on(body.origin), body.position, scale(body.mass, m_.gravity, z_));
        for (const SpringElement& spring : m_.springs) add(spring);
        for (const Part& part : m_.potential)
            if (part.origin.kind != Origin::Kind::gravity && part.origin.kind != Origin::Kind::spring)
                add_gradient(part);
        return std::move(forces_);
    }

private:
    void push(const Origin& origin, const Vector3& place, const Vector3& force) {
        for (int k = 0; k < 3; ++k)
            if (!force[k].is_zero()) forces_.push_back({origin, place[k], force[k]});
    }

    void add(const SpringElement& spring) {
        if (!spring.between) {
            forces_.push_back(
                {spring.origin, spring.along, z_.name(spring.stiffness * (spring.free_length - spring.along))});
            add_along_constants(spring, spring.along);
            return;
        }
        const auto& [first, second] = *spring.between;
        const Vector3 d = alembert::add(second, scale(-1, first, z_), z_);
        const bool is_long = !spring.free_length.is_zero();
        const ex pull =
            is_long ? z_.name(spring.stiffness * (1 - spring.free_length / norm(d, z_))) : spring.stiffness;
        push(spring.origin, second, scale(-pull, d, z_));
        push(spring.origin, first, scale(pull, d, z_));
        if (is_long)
            add_along_constants(spring, norm(d, z_));
        else if (moves(spring.stiffness))
            add_along_stiffness(spring, dot(d, d, z_));
    }

    void add_along_constants(const SpringElement& spring, const ex& length) {
        if (moves(spring.free_length))
            forces_.push_back({spring.origin, z_.name(spring.free_length),
                               z_.name(spring.stiffness * (length - spring.free_length))});
        if (moves(spring.stiffness)) add_along_stiffness(spring, pow(length - spring.free_length, 2));
    }

    void add_along_stiffness(const SpringElement& spring, const ex& square) {
        forces_.push_back({spring.origin, z_.name(spring.stiffness), z_.name(-square / 2)});
    }

    bool moves(const ex& e) const { return z_.depends(e, m_.q); }

    void add_gradient(const Part& part) {
        const std::vector<ex> forces = z_.pull_back({{part.value, -1}}, m_.q);
        for (std::size_t i = 0; i < forces.size(); ++i)
            if (!forces[i].is_zero()) forces_.push_back({part.origin, m_.q[i], forces[i]});
    }

    const Mechanism& m_;
    Intermediates& z_;
    std::vector<PlacedForce> forces_;
};

}  // namespace

std::vector<PlacedForce> conservative_forces(const Mechanism& m) {
    return ForcesOfV(m).run();
}

std::vector<ex> work_of_loads(const Mechanism& m, bool dissipative) {
    std::vector<std::pair<ex, ex>> displaced, turned;
    for (const Load& load : m.loads)
        if (load.dissipative == dissipative)
            for (const Load::Pair& pair : load.pairs)
                (pair.position ? displaced : turned)
                    .emplace_back(pair.position.value_or(pair.velocity), pair.force);
    const std::vector<ex> a = m.z->pull_back(displaced, m.q), b = m.z->pull_back(turned, m.qdot);
    std::vector<ex> result;
    for (int i = 0; i < m.size(); ++i) result.push_back(m.z->name(a[i] + b[i]));
    return result;
}

std::array<ex, 6> central_inertia(const MassElement& body, Intermediates& z) {
    std::array<ex, 6> I = body.rotation->inertia;
    if (!body.rotation->about) return I;
    Vector3 d;
    for (int k = 0; k < 3; ++k) d[k] = dot(body.rotation->axes[k], *body.rotation->about, z);
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        I[k] = z.name(I[k] - body.mass * (d[next] * d[next] + d[last] * d[last]));
        I[3 + k] = z.name(I[3 + k] + body.mass * d[k] * d[next]);
    }
    return I;
}

Vector3 with_mass_rate(const MassElement& body, const Vector3& inertia, const Vector3& velocity,
                       Intermediates& z) {
    return body.mass_rate.is_zero() ? inertia : add(inertia, scale(body.mass_rate, velocity, z), z);
}

std::vector<ex> carried_momentum(const Mechanism& m) {
    std::vector<std::pair<ex, ex>> pairs;
    for (const MassElement& body : m.masses)
        if (!body.mass_rate.is_zero())
            for (const ex& v : body.velocity) pairs.emplace_back(v, m.z->name(body.mass_rate * v));
    return pairs.empty() ? std::vector<ex>() : m.z->pull_back(pairs, m.qdot);
}

bool masses_are_known(const Mechanism& m) {
    return !m.given_lagrangian &&
           (m.kinetic.empty() || m.kinetic.back().origin.kind != Origin::Kind::given_kinetic);
}

std::optional<std::string> no_coordinates(const Mechanism& m, const std::string& who) {
    if (m.size() > 0) return std::nullopt;
    return say("{} need at least one coordinate; the scene has none", who);
}

std::optional<std::string> masses_unknown(const Mechanism& m, const std::string& who) {
    if (m.size() == 0 || masses_are_known(m)) return no_coordinates(m, who);
    return say(
        "{} start from the velocities of particles and bodies, and [energy] {} belongs to none; "
        "use the formalism 'lagrange', or give the scene its particles and bodies",
        who, m.given_lagrangian ? "lagrangian" : "kinetic");
}

std::vector<ex> substitute(Intermediates& z, const std::vector<ex>& values, const GiNaC::exmap& by) {
    GiNaC::exmap full = by;
    const auto options = GiNaC::subs_options::no_pattern;
    // Only the entries that the values need are replaced; definitions refer to earlier ones only.
    std::vector<char> needed(z.entries().size(), 0);
    const auto mark = [&](const ex& e) {
        std::vector<ex> stack{e};
        while (!stack.empty()) {
            const ex top = stack.back();
            stack.pop_back();
            for (const ex& part : top) stack.push_back(part);
            if (!GiNaC::is_a<GiNaC::symbol>(top)) continue;
            if (const auto* entry = z.find(GiNaC::ex_to<GiNaC::symbol>(top)))
                needed[entry - z.entries().data()] = 1;
        }
    };
    for (const ex& value : values) mark(value);
    for (std::size_t k = needed.size(); k-- > 0;)
        if (needed[k] != 0) mark(z.entries()[k].definition);
    // GiNaC goes through the whole map at every sum and product, so it is given only the symbols in the
    // expression.
    const auto substituted = [&](const ex& e) {
        GiNaC::exmap here;
        std::vector<ex> stack{e};
        while (!stack.empty()) {
            const ex top = stack.back();
            stack.pop_back();
            if (const auto found = full.find(top); found != full.end())
                here.insert(*found);
            else
                for (const ex& part : top) stack.push_back(part);
        }
        return here.empty() ? e : ex(e.subs(here, options));
    };
    for (std::size_t k = 0; k < needed.size(); ++k) {
        if (needed[k] == 0) continue;
        const ex symbol = z.entries()[k].symbol, definition = z.entries()[k].definition;
        const ex replaced = substituted(definition);
        if (!replaced.is_equal(definition)) full[symbol] = z.name(replaced);
    }
    std::vector<ex> result;
    for (const ex& value : values) result.push_back(z.name(substituted(value)));
    return result;
}

ex short_form(const ex& e, const Mechanism& m) {
    ask_whether_wanted();
    if (m.z->tree_size(e) > 3000) return e;
    const ex plain = m.z->expand(e);
    if (const auto known = m.symbols->short_forms.find(plain); known != m.symbols->short_forms.end())
        return m.z->name(known->second);
    const auto f = fourier(plain, *m.symbols, 200);
    if (!f || f->size() > 20) return e;
    // A chain of trailers has a hundred such expressions, so that the search for a short form of each is limited.
    constexpr std::size_t effort = 1500;
    const ex result = expression(readable(*f, effort));
    m.symbols->short_forms.emplace(plain, result);
    return m.z->name(result);
}

Equations equations_without_terms(const std::string& formalism, const Mechanism& m) {
    Equations equations;
    equations.formalism = formalism;
    equations.q = m.q;
    equations.u = m.qdot;
    equations.udot = m.qddot;
    equations.M = GiNaC::matrix(m.size(), m.size());
    equations.z = m.z;
    equations.h = equations.form = {m.qdot.begin(), m.qdot.end()};
    return equations;
}

void attach_constraints(const Mechanism& m, Equations& equations) {
    for (const Mechanism::Constraint& constraint : m.constraints) {
        equations.A.push_back(constraint.row);
        equations.gamma.push_back(constraint.acceleration);
        equations.lambda.push_back(constraint.multiplier);
    }
}

}  // namespace alembert
