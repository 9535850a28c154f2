// SPDX-License-Identifier: GPL-2.0-or-later
// What `impact` does before it finds out that nothing is struck.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "allocations.hpp"
#include "analysis/contact/impact.hpp"
#include "model/formalism/lagrange.hpp"
#include "scenes.hpp"

namespace impact_work {

using namespace alembert;

namespace {

/// A free body with turned joints, on which another free body and one on a ball joint stand.
const char* const turned_tree = R"toml(gravity = [0, 0, "-g"]
[parameters]
m = 2.9
g = 9.81
[[body]]
name = "A"
mass = "m"
inertia = [1.01, 1.07, 0.95]
[[joint]]
name = "JA"
type = "free"
parent = "N"
child = "A"
parent_point = [0.44, 0.22, 0]
child_point = [-0.76, 0, 0.4]
parent_rotate = [["x", 0.4], ["z", "pi/3"]]
coordinates = { a0 = { initial = 0.35, rate = -0.92 }, a1 = { initial = 0.34, rate = -0.79 }, a2 = { initial = 0.43, rate = -0.3 }, a3 = { initial = 1, rate = 0 }, a4 = { initial = 0, rate = 0.37 }, a5 = { initial = 0, rate = -0.35 }, a6 = { initial = 0, rate = -0.28 } }
[[body]]
name = "B"
mass = 1.5
inertia = [0.97, 1.05, 0.96]
[[joint]]
name = "JB"
type = "free"
parent = "A"
child = "B"
parent_point = [0.54, 0.45, 0]
child_point = [-0.38, 0, 0.23]
coordinates = { b0 = { initial = 0.78, rate = -0.17 }, b1 = { initial = 0.56, rate = 0.08 }, b2 = { initial = 0.44, rate = -0.71 }, b3 = { initial = 1, rate = 0 }, b4 = { initial = 0, rate = -0.44 }, b5 = { initial = 0, rate = -0.1 }, b6 = { initial = 0, rate = -0.18 } }
[[body]]
name = "C"
mass = "m"
inertia = [1.01, 1.0, 0.91]
[[joint]]
name = "JC"
type = "spherical"
parent = "A"
child = "C"
parent_point = [0.29, 0.05, 0]
child_point = [-0.88, 0, 0.32]
coordinates = { c0 = { initial = 1, rate = 0 }, c1 = { initial = 0, rate = 0.01 }, c2 = { initial = 0, rate = -0.01 }, c3 = { initial = 0, rate = 0.44 } }
)toml";

}  // namespace

// The mass matrix in coordinates alone has so many nodes that looking at each of them took 12 s.
TEST_CASE("impact: where nothing is struck, the mass matrix is not written out") {
    const Mechanism m = build(parse_scene(turned_tree, "turned.toml"));
    const GiNaC::matrix M = lagrange_operator(m).M;
    double written_out = 0;
    for (std::size_t k = 0; k < M.nops(); ++k) written_out += m.z->tree_size(M.op(k));
    std::size_t made = 0;
    made = test::allocations_of([&] {
        const Impact hit = impact(m);
        CHECK(hit.nothing_happens);
    });
    CAPTURE(made);
    CAPTURE(written_out);
    CHECK(static_cast<double>(made) < written_out / 10);
}

}  // namespace impact_work
