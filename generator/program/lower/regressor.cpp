// SPDX-License-Identifier: GPL-2.0-or-later
// A unit of each parameter, with the acceleration a of the origin relative to free fall, needs at the origin
//     m:   f = a,                        n = 0
//     mx:  f = α × x + ω × (ω × x),      n = x × a
//     I:   f = 0,                        n = I α + ω × I ω,
// and along the coordinate k the load v_k·f + ω_k·n, where v_k and ω_k are the columns of the origin's Jacobian.
#include "program/lower/regressor.hpp"

#include <fmt/format.h>

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/scene_motion.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr const char* parameter_names[] = {"m", "mx", "my", "mz", "xx", "yy", "zz", "xy", "yz", "zx", "rotor"};

/// A wrench about the origin, along the body's axes.
struct UnitWrench {
    SymbolicVector force{0, 0, 0}, moment{0, 0, 0};
};

/// The wrenches of the ten parameters.
std::array<UnitWrench, 10> unit_wrenches(const SymbolicVector& a, const SymbolicVector& omega,
                                         const SymbolicVector& alpha) {
    std::array<UnitWrench, 10> result;
    result[0].force = a;
    for (std::size_t k = 0; k < 3; ++k) {
        SymbolicVector e{0, 0, 0};
        e[k] = 1;
        result[1 + k] = {cross(alpha, e) + cross(omega, cross(omega, e)), cross(e, a)};
    }
    for (std::size_t k = 0; k < 6; ++k) {
        Symmetric<Symbolic> I{0, 0, 0, 0, 0, 0};
        I[k] = 1;
        result[4 + k].moment = I * alpha + cross(omega, I * omega);
    }
    return result;
}

/// π of a body about a point from which the mass centre is at c.
std::array<ex, 10> parameters_about(const MassElement& mass, const std::array<ex, 3>& c, Intermediates& z) {
    std::array<ex, 10> pi;
    pi[0] = mass.mass;
    for (std::size_t k = 0; k < 3; ++k) pi[1 + k] = z.name(mass.mass * c[k]);
    const std::array<ex, 6> I = central_inertia(mass, z);
    for (std::size_t k = 0; k < 3; ++k) {
        const ex &x = c[(k + 1) % 3], &y = c[(k + 2) % 3];
        pi[4 + k] = z.name(I[k] + mass.mass * (x * x + y * y));
        pi[7 + k] = z.name(I[3 + k] - mass.mass * c[k] * c[(k + 1) % 3]);
    }
    return pi;
}

}  // namespace

std::string InertialParameter::name() const {
    return fmt::format("{}({})", parameter_names[which], body);
}

Regressor regressor(const Scene& scene, const Mechanism& mechanism, bool fold) {
    if (const auto unknown = masses_unknown(mechanism, say("Functions such as '{}'", "regressor")))
        throw ModelError(*unknown);
    const Mechanism m = with_own_intermediates(mechanism);
    Program program = begun(m, fold);
    SceneMotion motion(program, scene, m, fold);
    Regressor result{.function = {}, .columns = {}, .values = {}, .centres = {}, .z = m.z};
    std::vector<std::vector<Symbolic>> columns;  // of Y
    const SymbolicVector gravity = motion.gravity();
    for (const MassElement& mass : m.masses) {
        const SceneMotion::Origin origin = motion.origin_of(mass);
        const Matrix<Symbolic> to_body = transposed(motion.rotation(origin.spot.frame));
        const SymbolicVector a = to_body * (motion.acceleration(origin.spot, true).linear - gravity);
        const LinearAngular turning = motion.turning(origin.spot.frame);
        const std::array<UnitWrench, 10> wrenches = unit_wrenches(a, turning.linear, turning.angular);
        const std::size_t first = columns.size(), count = mass.rotation ? 10 : 1;
        columns.resize(first + count);
        for (int k = 0; k < m.size(); ++k) {
            const LinearAngular along_N = motion.column(origin.spot, k);
            const SymbolicVector v = to_body * along_N.linear, w = to_body * along_N.angular;
            for (std::size_t c = 0; c < count; ++c)
                columns[first + c].push_back(dot(v, wrenches[c].force) + dot(w, wrenches[c].moment));
        }
        const std::string& body = mass.origin.name;
        for (std::size_t c = 0; c < count; ++c) result.columns.push_back({body, static_cast<int>(c)});
        if (count == 1) {
            result.values.push_back(mass.mass);
            continue;
        }
        const std::array<ex, 10> pi = parameters_about(mass, origin.centre, *m.z);
        result.values.insert(result.values.end(), pi.begin(), pi.end());
        result.centres.emplace_back(body, origin.centre);
    }
    for (const Rotor& rotor : m.rotors) {
        columns.emplace_back(static_cast<std::size_t>(m.size()), Symbolic(0));
        columns.back()[static_cast<std::size_t>(rotor.coordinate)] =
            Symbolic(program, program.variable({Variable::Kind::acceleration, rotor.coordinate}));
        result.columns.push_back({rotor.origin.name, InertialParameter::rotor});
        result.values.push_back(rotor.inertia);
    }
    std::vector<int> nodes;
    for (std::size_t k = 0; k < static_cast<std::size_t>(m.size()); ++k)
        for (const auto& column : columns) nodes.push_back(column[k].node(program));
    result.function = {.name = "regressor",
                       .about = "Y of M q'' + C q' + g = Y pi with the inertial parameters pi of the bodies.",
                       .rows = m.size(),
                       .columns = static_cast<int>(columns.size()),
                       .program = with_values_only(std::move(program), nodes)};
    return result;
}

}  // namespace alembert
