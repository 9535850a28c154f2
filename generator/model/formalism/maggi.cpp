// SPDX-License-Identifier: GPL-2.0-or-later
// Bᵀ E = Bᵀ Aᵀ λ, E = d/dt ∂L/∂q̇ − ∂L/∂q − Q, B = ∂q̇/∂u (Neimark & Fufaev, Dynamics of Nonholonomic Systems
// (1972)). A B = 0 for the constraints that the speeds eliminate. With E = M_L q̈ − f_L and q̈ = B u̇ + c:
//   M = Bᵀ M_L B,   f = Bᵀ (f_L − M_L c),   q̇ = h in both.
#include "model/formalism/maggi.hpp"

#include "base/language/say.hpp"
#include "model/formalism/in_speeds.hpp"
#include "model/formalism/lagrange.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

Possible<Kinematics> kinematics_for_maggi(const Mechanism& m) {
    if (const auto none = no_coordinates(m, say("Maggi's equations"))) return Obstacle{*none};
    return kinematics(m);
}

/// B: a row for each coordinate, a column for each speed.
GiNaC::matrix kernel(const Mechanism& m, const Kinematics& k) {
    GiNaC::matrix B(static_cast<unsigned>(m.size()), static_cast<unsigned>(k.u.size()));
    for (unsigned c = 0; c < B.cols(); ++c) {
        const std::vector<ex> column = m.z->push_forward(k.h, {{k.u[c], 1}});
        for (unsigned i = 0; i < B.rows(); ++i) B(i, c) = column[i];
    }
    return B;
}

/// Bᵀ x
std::vector<ex> along(const GiNaC::matrix& B, const std::vector<ex>& x, Intermediates& z) {
    std::vector<ex> result;
    for (unsigned c = 0; c < B.cols(); ++c) {
        GiNaC::exvector terms;
        for (unsigned i = 0; i < B.rows(); ++i)
            if (!B(i, c).is_zero()) terms.push_back(B(i, c) * x[i]);
        result.push_back(z.name(GiNaC::add(std::move(terms))));
    }
    return result;
}

/// M_L x
std::vector<ex> times(const GiNaC::matrix& M, const std::vector<ex>& x, Intermediates& z) {
    std::vector<ex> result;
    for (unsigned i = 0; i < M.rows(); ++i) {
        GiNaC::exvector terms;
        for (unsigned j = 0; j < M.cols(); ++j)
            if (!x[j].is_zero()) terms.push_back(M(i, j) * x[j]);
        result.push_back(z.name(GiNaC::add(std::move(terms))));
    }
    return result;
}

/// Lagrange's expression E of each coordinate, in q, q', q'', t.
std::vector<ex> expressions_of(const Equations& lagrange, const Mechanism& m) {
    std::vector<ex> E = times(lagrange.M, {m.qddot.begin(), m.qddot.end()}, *m.z);
    for (int i = 0; i < m.size(); ++i) E[i] = m.z->name(E[i] - lagrange.forcing(i));
    return E;
}

}  // namespace

std::optional<std::string> obstacle_to_maggi(const Mechanism& m) {
    return kinematics_for_maggi(with_own_intermediates(m)).obstacle();
}

Equations maggi(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    Intermediates& z = *m.z;
    const InSpeeds motion(m, kinematics_for_maggi(m).value());
    const GiNaC::matrix B = kernel(m, motion.kinematics());
    const Equations lagrange = lagrange_operator(m);
    Equations equations = motion.begin("maggi");
    const auto projected = [&](const std::vector<ex>& forces) {
        return along(B, motion.short_in_speeds(forces), z);
    };
    GiNaC::matrix M = lagrange.M;
    for (int i = 0; i < m.size(); ++i)
        for (int j = 0; j <= i; ++j) M(i, j) = M(j, i) = motion.short_in_speeds(std::vector<ex>{M(i, j)})[0];
    for (int s = 0; s < equations.size(); ++s) {
        std::vector<ex> direction;
        for (int i = 0; i < m.size(); ++i) direction.push_back(B(i, s));
        const std::vector<ex> column = along(B, times(M, direction, z), z);
        for (int r = 0; r < equations.size(); ++r) equations.M(r, s) = motion.without_false_poles(column[r]);
    }
    equations.dissipative = projected(lagrange.dissipative);
    equations.applied = projected(lagrange.applied);
    const std::vector<ex> own = projected(lagrange.own);
    const std::vector<ex> convected = along(B, times(M, motion.without_acceleration(motion.kinematics().h), z), z);
    for (int r = 0; r < equations.size(); ++r)
        equations.own.push_back(motion.without_false_poles(z.name(own[r] - convected[r])));
    motion.attach_kept(equations);
    if (!equations.eliminated.empty()) recover_multipliers(m, equations, expressions_of(lagrange, m));
    return equations;
}

OwnSteps steps_of_maggi(const Mechanism& m, const Equations& e) {
    const StepWriter write(m);
    const GiNaC::matrix B = kernel(m, kinematics_for_maggi(m).value());
    Section rates{.words =
                      say("The rates that the constraints leave, q' = B u + b, by the columns of B = dq'/du:")};
    for (unsigned c = 0; c < B.cols(); ++c) {
        std::vector<Phrase> column;
        for (unsigned i = 0; i < B.rows(); ++i)
            if (const auto entry = write.normal(B(i, c))) column.push_back(readable(*entry));
        if (column.size() == B.rows())
            rates.statements.push_back(
                {Statement::Kind::force, "B", "", write.symbol_of(e.u[c]), phrases::tuple(std::move(column))});
    }
    Section lagrange{.words = say("Lagrange's expressions, E = d/dt dL/dq' - dL/dq - Q:")};
    const std::vector<ex> E = expressions_of(lagrange_operator(m), m);
    for (int i = 0; i < m.size(); ++i) write.force(lagrange, "E", m.q[i], E[i]);
    Section sum{
        .words =
            e.A.empty()
                ? say("Maggi's equations are the sums of E dq'/du over the coordinates; the multipliers are gone.")
                : say("Maggi's equations are the sums of E dq'/du over the coordinates, A^T lambda of the "
                      "constraints "
                      "that the speeds do not leave out.")};
    return {.sections = {std::move(rates), std::move(lagrange), std::move(sum)}};
}

}  // namespace alembert
