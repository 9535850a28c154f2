// SPDX-License-Identifier: GPL-2.0-or-later
#include "symbolic_cases.hpp"

namespace alembert::test {

using GiNaC::cos;
using GiNaC::ex;
using GiNaC::exp;
using GiNaC::log;
using GiNaC::numeric;
using GiNaC::pow;
using GiNaC::sin;
using GiNaC::sqrt;
using GiNaC::symbol;

Mechanics::Mechanics() : time(symbols.declare("t", SymbolInfo::Kind::time)) {}

symbol Mechanics::parameter(const std::string& name) {
    return symbols.declare(name, SymbolInfo::Kind::parameter);
}

symbol Mechanics::input(const std::string& name) {
    return symbols.declare(name, SymbolInfo::Kind::input);
}

void Mechanics::coordinates(const std::vector<std::string>& names) {
    int order = 0;
    for (std::vector<symbol>* level : {&q, &qdot, &qddot}) {
        int index = 0;
        for (const std::string& name : names)
            level->push_back(symbols.declare(name, SymbolInfo::Kind::coordinate, index++, order));
        ++order;
    }
}

ex Mechanics::dot(const ex& f) const {
    ex result = f.diff(time);
    for (std::size_t i = 0; i < q.size(); ++i) result += f.diff(q[i]) * qdot[i] + f.diff(qdot[i]) * qddot[i];
    return result;
}

ex Mechanics::residual(int i) const {
    const auto k = static_cast<std::size_t>(i);
    const ex L = T - V;
    return dot(L.diff(qdot[k])) - L.diff(q[k]) + R.diff(qdot[k]);
}

namespace {

ex square(const ex& x) {
    return x * x;
}

void double_pendulum(Mechanics& m) {
    const auto m1 = m.parameter("m1"), m2 = m.parameter("m2"), l1 = m.parameter("l1"), l2 = m.parameter("l2"),
               g = m.parameter("g"), F = m.input("F");
    m.coordinates({"theta1", "theta2"});
    const ex x1 = l1 * sin(m.q[0]), y1 = l1 * cos(m.q[0]), x2 = x1 + l2 * sin(m.q[1]), y2 = y1 + l2 * cos(m.q[1]);
    m.T = m1 * (square(m.dot(x1)) + square(m.dot(y1))) / 2 + m2 * (square(m.dot(x2)) + square(m.dot(y2))) / 2;
    m.V = -m1 * g * y1 - m2 * g * y2;
    m.Q = {F * x2.diff(m.q[0]), F * x2.diff(m.q[1])};
}

void relative_double_pendulum(Mechanics& m) {
    const auto m1 = m.parameter("m1"), m2 = m.parameter("m2"), l1 = m.parameter("l1"), l2 = m.parameter("l2"),
               g = m.parameter("g");
    m.coordinates({"alpha", "beta"});
    const ex x1 = l1 * sin(m.q[0]), y1 = l1 * cos(m.q[0]);
    const ex x2 = x1 + l2 * sin(m.q[0] + m.q[1]), y2 = y1 + l2 * cos(m.q[0] + m.q[1]);
    m.T = m1 * (square(m.dot(x1)) + square(m.dot(y1))) / 2 + m2 * (square(m.dot(x2)) + square(m.dot(y2))) / 2;
    m.V = -m1 * g * y1 - m2 * g * y2;
}

void cart_with_rod(Mechanics& m) {
    const auto m1 = m.parameter("m1"), m2 = m.parameter("m2"), l = m.parameter("l"), g = m.parameter("g");
    m.coordinates({"x", "phi"});
    const ex &v = m.qdot[0], &w = m.qdot[1];
    m.T = (m1 + m2) * square(v) / 2 + m2 * l * v * w * cos(m.q[1]) + 2 * m2 * square(l) * square(w) / 3;
    m.V = -m2 * g * l * cos(m.q[1]);
}

void cart_pole(Mechanics& m) {
    const auto mc = m.parameter("mc"), mp = m.parameter("mp"), l = m.parameter("l"), g = m.parameter("g"),
               F = m.input("F");
    m.coordinates({"x", "theta"});
    const ex x = m.q[0] + l * sin(m.q[1]), y = l * cos(m.q[1]);
    m.T = mc * square(m.qdot[0]) / 2 + mp * (square(m.dot(x)) + square(m.dot(y))) / 2;
    m.V = mp * g * y;
    m.Q = {F, 0};
}

void spherical_pendulum(Mechanics& m) {
    const auto mass = m.parameter("m"), l = m.parameter("l"), g = m.parameter("g");
    m.coordinates({"theta", "phi"});
    const ex x = l * sin(m.q[0]) * cos(m.q[1]), y = l * sin(m.q[0]) * sin(m.q[1]), z = -l * cos(m.q[0]);
    m.T = mass * (square(m.dot(x)) + square(m.dot(y)) + square(m.dot(z))) / 2;
    m.V = mass * g * z;
}

void elastic_pendulum(Mechanics& m) {
    const auto mass = m.parameter("m"), k = m.parameter("k"), l0 = m.parameter("l0"), g = m.parameter("g");
    m.coordinates({"r", "theta"});
    const ex x = m.q[0] * sin(m.q[1]), y = m.q[0] * cos(m.q[1]);
    m.T = mass * (square(m.dot(x)) + square(m.dot(y))) / 2;
    m.V = -mass * g * y + k * square(m.q[0] - l0) / 2;
}

void stretched_pendulum(Mechanics& m) {
    const auto mass = m.parameter("m"), k = m.parameter("k"), l = m.parameter("l"), g = m.parameter("g");
    m.coordinates({"x", "theta"});
    const ex X = (l + m.q[0]) * sin(m.q[1]), Y = (l + m.q[0]) * cos(m.q[1]);
    m.T = mass * (square(m.dot(X)) + square(m.dot(Y))) / 2;
    m.V = -mass * g * Y + k * square(m.q[0]) / 2;
}

void bead_on_hoop(Mechanics& m) {
    const auto mass = m.parameter("m"), r = m.parameter("r"), Omega = m.parameter("Omega"), g = m.parameter("g");
    m.coordinates({"theta"});
    const ex x = r * sin(m.q[0]) * cos(Omega * m.time), y = r * sin(m.q[0]) * sin(Omega * m.time),
             z = -r * cos(m.q[0]);
    m.T = mass * (square(m.dot(x)) + square(m.dot(y)) + square(m.dot(z))) / 2;
    m.V = mass * g * z;
}

void moving_support(Mechanics& m) {
    const auto mass = m.parameter("m"), l = m.parameter("l"), a = m.parameter("a"), Omega = m.parameter("Omega"),
               g = m.parameter("g");
    m.coordinates({"theta"});
    const ex x = a * cos(Omega * m.time) + l * sin(m.q[0]), y = -l * cos(m.q[0]);
    m.T = mass * (square(m.dot(x)) + square(m.dot(y))) / 2;
    m.V = mass * g * y;
}

void swinging_atwood(Mechanics& m) {
    const auto mass = m.parameter("m"), M = m.parameter("M"), g = m.parameter("g");
    m.coordinates({"r", "theta"});
    const ex x = m.q[0] * sin(m.q[1]), y = -m.q[0] * cos(m.q[1]);
    m.T = M * square(m.qdot[0]) / 2 + mass * (square(m.dot(x)) + square(m.dot(y))) / 2;
    m.V = M * g * m.q[0] + mass * g * y;
}

void magnetic_field(Mechanics& mech) {
    const auto m = mech.parameter("m"), e = mech.parameter("e"), B = mech.parameter("B");
    mech.coordinates({"x", "y", "z"});
    mech.T = m * (square(mech.qdot[0]) + square(mech.qdot[1]) + square(mech.qdot[2])) / 2;
    mech.V = -e * B * (mech.q[0] * mech.qdot[1] - mech.q[1] * mech.qdot[0]) / 2;
}

void central_force_polar(Mechanics& mech) {
    const auto m = mech.parameter("m"), mu = mech.parameter("mu");
    mech.coordinates({"r", "phi"});
    mech.T = m * (square(mech.qdot[0]) + square(mech.q[0] * mech.qdot[1])) / 2;
    mech.V = -m * mu / mech.q[0];
}

void central_force_cartesian(Mechanics& mech) {
    const auto m = mech.parameter("m"), mu = mech.parameter("mu");
    mech.coordinates({"x", "y"});
    mech.T = m * (square(mech.qdot[0]) + square(mech.qdot[1])) / 2;
    mech.V = -m * mu / sqrt(square(mech.q[0]) + square(mech.q[1]));
}

void coupled_oscillators(Mechanics& m) {
    const auto m1 = m.parameter("m1"), m2 = m.parameter("m2"), k1 = m.parameter("k1"), k2 = m.parameter("k2"),
               c1 = m.parameter("c1"), c2 = m.parameter("c2"), F = m.input("F");
    m.coordinates({"x1", "x2"});
    m.T = m1 * square(m.qdot[0]) / 2 + m2 * square(m.qdot[1]) / 2;
    m.V = k1 * square(m.q[0]) / 2 + k2 * square(m.q[1] - m.q[0]) / 2;
    m.R = c1 * square(m.qdot[0]) / 2 + c2 * square(m.qdot[1] - m.qdot[0]) / 2;
    m.Q = {0, F};
}

/// Example 1-1 of Zhang & Qin: four rods of length l, balls m1, sleeve m2, turning with Omega.
void governor(Mechanics& m) {
    const auto m1 = m.parameter("m1"), m2 = m.parameter("m2"), l = m.parameter("l"), Omega = m.parameter("Omega"),
               g = m.parameter("g");
    m.coordinates({"theta"});
    for (const int side : {-1, 1}) {
        const ex r = side * l * sin(m.q[0]), x = r * cos(Omega * m.time), y = r * sin(Omega * m.time),
                 z = -l * cos(m.q[0]);
        m.T += m1 * (square(m.dot(x)) + square(m.dot(y)) + square(m.dot(z))) / 2;
        m.V += m1 * g * z;
    }
    const ex sleeve = -2 * l * cos(m.q[0]);
    m.T += m2 * square(m.dot(sleeve)) / 2;
    m.V += m2 * g * sleeve;
}

void heavy_top(Mechanics& mech) {
    const auto A = mech.parameter("A"), C = mech.parameter("C"), m = mech.parameter("m"), g = mech.parameter("g"),
               h = mech.parameter("h");
    mech.coordinates({"psi", "theta", "phi"});
    const ex psi_dot = mech.qdot[0], theta_dot = mech.qdot[1], phi_dot = mech.qdot[2], theta = mech.q[1],
             phi = mech.q[2];
    const ex p = psi_dot * sin(theta) * sin(phi) + theta_dot * cos(phi);
    const ex q = psi_dot * sin(theta) * cos(phi) - theta_dot * sin(phi);
    const ex r = phi_dot + psi_dot * cos(theta);
    mech.T = A * (square(p) + square(q)) / 2 + C * square(r) / 2;
    mech.V = m * g * h * cos(theta);
}

void spinning_body(Mechanics& mech) {
    const auto A = mech.parameter("A"), B = mech.parameter("B"), C = mech.parameter("C");
    mech.coordinates({"psi", "theta", "phi"});
    const ex psi_dot = mech.qdot[0], theta_dot = mech.qdot[1], phi_dot = mech.qdot[2], theta = mech.q[1],
             phi = mech.q[2];
    const ex p = psi_dot * sin(theta) * sin(phi) + theta_dot * cos(phi);
    const ex q = psi_dot * sin(theta) * cos(phi) - theta_dot * sin(phi);
    const ex r = phi_dot + psi_dot * cos(theta);
    mech.T = (A * square(p) + B * square(q) + C * square(r)) / 2;
}

void transcendental_potential(Mechanics& m) {
    const auto mass = m.parameter("m"), D = m.parameter("D"), a = m.parameter("a"), r0 = m.parameter("r0"),
               k = m.parameter("k"), l0 = m.parameter("l0"), b = m.parameter("b");
    m.coordinates({"r", "y"});
    m.T = mass * (square(m.qdot[0]) + square(m.qdot[1])) / 2;
    m.V = D * square(1 - exp(-a * (m.q[0] - r0))) + k * square(sqrt(square(m.q[1]) + square(b)) - l0) / 2 -
          D * log(m.q[1] / b);
}

void decimals(Mechanics& m) {
    m.coordinates({"x", "theta"});
    const numeric g(981, 100), l(8, 10);
    const ex x = m.q[0] + l * sin(m.q[1]), y = -l * cos(m.q[1]);
    m.T = numeric(3, 2) * square(m.qdot[0]) / 2 + numeric(1, 2) * (square(m.dot(x)) + square(m.dot(y))) / 2;
    m.V = numeric(1, 2) * g * y + 100 * square(m.q[0]) / 2;
}

void offset_spherical(Mechanics& m) {
    const auto mass = m.parameter("m"), a = m.parameter("a"), l = m.parameter("l"), g = m.parameter("g");
    m.coordinates({"theta", "phi"});
    const ex r = a + l * sin(m.q[0]);
    const ex x = r * cos(m.q[1]), y = r * sin(m.q[1]), z = -l * cos(m.q[0]);
    m.T = mass * (square(m.dot(x)) + square(m.dot(y)) + square(m.dot(z))) / 2;
    m.V = mass * g * z;
}

void rolling_wedge(Mechanics& m) {
    const auto M = m.parameter("M"), mass = m.parameter("m"), g = m.parameter("g"), alpha = m.parameter("alpha");
    m.coordinates({"x", "s"});
    const ex X = m.q[0] + m.q[1] * cos(alpha), Y = -m.q[1] * sin(alpha);
    m.T = M * square(m.qdot[0]) / 2 + mass * (square(m.dot(X)) + square(m.dot(Y))) / 2 +
          mass * square(m.qdot[1]) / 4;
    m.V = mass * g * Y;
}

}  // namespace

const std::vector<NamedCase>& mechanisms() {
    static const std::vector<NamedCase> cases{
        {"double pendulum", double_pendulum},
        {"double pendulum, relative angles", relative_double_pendulum},
        {"cart with a rod", cart_with_rod},
        {"cart-pole", cart_pole},
        {"spherical pendulum", spherical_pendulum},
        {"elastic pendulum", elastic_pendulum},
        {"elastic pendulum, elongation", stretched_pendulum},
        {"bead on a rotating hoop", bead_on_hoop},
        {"pendulum on a moving support", moving_support},
        {"swinging Atwood machine", swinging_atwood},
        {"charge in a magnetic field", magnetic_field},
        {"central force, polar", central_force_polar},
        {"central force, Cartesian", central_force_cartesian},
        {"coupled oscillators", coupled_oscillators},
        {"Watt's governor", governor},
        {"heavy top", heavy_top},
        {"free rigid body", spinning_body},
        {"exp, log and sqrt", transcendental_potential},
        {"decimals", decimals},
        {"spherical pendulum with an offset", offset_spherical},
        {"cylinder on a wedge", rolling_wedge},
    };
    return cases;
}

}  // namespace alembert::test
