// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/formalism/ball_joint.hpp"

#include <algorithm>

namespace alembert {

using GiNaC::ex;

namespace {

ex product(const std::array<ex, 4>& a, const std::array<ex, 4>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// R(e) as model/geometry.cpp has it.
std::array<Vector3, 3> rotation(const std::array<ex, 4>& e, const ex& inverse, Intermediates& z) {
    const auto entry = [&](const ex& value) { return z.name(z.name(value) * inverse); };
    const auto sq = [&](std::size_t k) { return e[k] * e[k]; };
    std::array<Vector3, 3> R;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        R[i][i] = entry(sq(0) + sq(i + 1) - sq(j + 1) - sq(k + 1));
        R[i][j] = entry(2 * (e[i + 1] * e[j + 1] - e[0] * e[k + 1]));
        R[j][i] = entry(2 * (e[i + 1] * e[j + 1] + e[0] * e[k + 1]));
    }
    return R;
}

}  // namespace

std::optional<BallJoint> ball_joint(const Mechanism& m, const std::array<ex, 4>& e) {
    BallJoint ball{.e = e};
    std::array<ex, 4> rate;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto found = std::find_if(m.q.begin(), m.q.end(),
                                        [&](const ex& q) { return q.is_equal(e[k]) || q.is_equal(-e[k]); });
        if (found == m.q.end()) return std::nullopt;
        ball.coordinate[k] = static_cast<int>(found - m.q.begin());
        ball.sign[k] = e[k].is_equal(*found) ? 1 : -1;
        rate[k] = ball.sign[k] * m.qdot[static_cast<std::size_t>(ball.coordinate[k])];
    }
    Intermediates& z = *m.z;
    const ex inverse = ball.inverse = z.name(1 / z.name(product(e, e)));
    ball.spin = z.name(z.name(product(rate, rate)) * inverse);
    ball.R = rotation(e, inverse, z);
    const auto G = rows_of_turn(e);
    Vector3& w = ball.rate;
    for (std::size_t k = 0; k < 3; ++k) w[k] = z.name(2 * z.name(product(G[k], rate)) * inverse);
    const ex growth = z.name(-2 * z.name(product(e, rate)) * inverse);
    ball.bias = {z.name(growth * w[0] - w[1] * w[2]), z.name(growth * w[1] + w[0] * w[2]),
                 z.name(growth * w[2] - w[0] * w[1])};
    return ball;
}

}  // namespace alembert
