// SPDX-License-Identifier: MIT
// What follows from a slip, what stands by itself beside one, and what a special case makes right.
#include <doctest/doctest.h>

#include <string>

#include "derivation_statuses.hpp"
#include "scenes.hpp"

namespace derivation_consequences {

using namespace alembert;
using test::statuses;

namespace {

const std::string pendulum = R"toml(
gravity = [0, "-g"]
[parameters]
m = 1
l = 1
g = 9.81
[coordinates]
theta = 0.3
[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)", "-l*cos(theta)"]
)toml";

/// A rod that hangs from its end, 2 b long.
const std::string rod = R"toml(
gravity = [0, "-g"]
[parameters]
m = 1
b = 0.4
g = 9.81
[coordinates]
theta = 0.3
[[frame]]
name = "B"
rotate = [["z", "theta"]]
[[body]]
name = "rod"
mass = "m"
inertia = "m*b^2/3"
frame = "B"
position = [0, "-b"]
axes = "B"
)toml";

/// Two bars of length l with a joint, of which the other end slides along x.
const std::string toggle = R"toml(
gravity = [0, "-g"]
[parameters]
m = 1
M = 2
l = 0.5
k = 100
a = 0.2
g = 9.81
[coordinates]
phi = 0.8
[[particle]]
name = "B"
mass = "m"
position = ["l*cos(phi)", "l*sin(phi)"]
[[particle]]
name = "C"
mass = "M"
position = ["2*l*cos(phi)", 0]
[[spring]]
along = "2*l*cos(phi)"
stiffness = "k"
length = "a"
)toml";

const std::string block = R"toml(
gravity = [0, "-g"]
[parameters]
M = 2
m = 1
l = 0.5
k = 50
g = 9.81
[coordinates]
u = 0.05
theta = 0.2
[[particle]]
name = "block"
mass = "M"
position = ["u", 0]
[[particle]]
name = "bob"
mass = "m"
position = ["u + l*sin(theta)", "-l*cos(theta)"]
[[spring]]
along = "u"
stiffness = "k"
)toml";

/// The weight is a load of the scene's, and no gravity.
const std::string load = R"toml(
[parameters]
m = 3
M = 2
k = 600
g = 9.81
[coordinates]
x = 0
[[particle]]
name = "cart"
mass = "m"
position = ["x", 0]
[[particle]]
name = "weight"
mass = "M"
position = [3, "-2*x"]
[[force]]
at = "weight"
vector = [0, "-M*g"]
[[spring]]
along = "x"
stiffness = "k"
)toml";

const std::string car = R"toml(
[parameters]
m = 1000
J = 1500
a = 1.2
b = 1.5
k1 = 30000
k2 = 24000
[coordinates]
y = 0.05
theta = 0.02
[[frame]]
name = "B"
rotate = [["z", "theta"]]
[[body]]
name = "car"
mass = "m"
inertia = "J"
frame = "B"
position = [0, "y"]
[[spring]]
along = "y + a*theta"
stiffness = "k1"
[[spring]]
along = "y - b*theta"
stiffness = "k2"
)toml";

const std::string wheel = R"toml(
[parameters]
m = 8
r = 0.2
k = 600
[coordinates]
x = 0.1
[[frame]]
name = "W"
rotate = [["z", "-x/r"]]
[[body]]
name = "wheel"
mass = "m"
inertia = "m*r^2/2"
frame = "W"
position = ["x", "r"]
[[spring]]
along = "x"
stiffness = "k"
)toml";

}  // namespace

TEST_CASE("consequences: a wrong moment of inertia is the mistake, and the energy follows from it") {
    const std::string wrong = "The moment of inertia about the centre is $J_C = \\frac1{12} m b^2$.\n\n";
    CHECK(statuses(rod, wrong + "$$T = \\frac12\\left(m b^2 + \\frac1{12} m b^2\\right)\\dot\\theta^2$$") == "MF");
    CHECK(statuses(rod, wrong + "$$\\frac{13}{12} b\\ddot\\theta + g\\sin\\theta = 0$$") == "MF");
    CHECK(statuses(rod, wrong + "$$\\frac{13}{24} m b^2\\dot\\theta^2 - m g b\\cos\\theta = \\text{const}$$") ==
          "MF");
    CHECK(statuses(rod, wrong + "$$T = \\frac12\\left(m b^2 + \\frac1{24} m b^2\\right)\\dot\\theta^2$$") == "DM");
    // about the centre, about the end: both are right, and a wrong use of them is another mistake
    CHECK(statuses(rod,
                   "$J_C = \\frac13 m b^2$, $J_O = \\frac43 m b^2$\n\n"
                   "$$T = \\frac12\\left(m b^2 + \\frac43 m b^2\\right)\\dot\\theta^2$$") == "DDM");
}

TEST_CASE("consequences: a wrong virtual displacement goes on in the work and in the condition of rest") {
    const std::string slip =
                          "$$x_C = 2 l\\cos\\varphi$$\n$$y_B = l\\sin\\varphi$$\n"
                          "$$\\delta x_C = -l\\sin\\varphi\\,\\delta\\varphi$$\n"
                          "$$\\delta W = -m g\\,\\delta y_B - k(x_C - a)\\,\\delta x_C$$\n",
                      work =
                          "$$\\delta W = [-m g l\\cos\\varphi + k(2 l\\cos\\varphi - a) l\\sin\\varphi]\\,"
                          "\\delta\\varphi$$\n";
    CHECK(statuses(toggle, slip + work) == "RRMRF");
    CHECK(statuses(toggle, slip + work +
                               "In equilibrium\n"
                               "$$\\tan\\varphi = \\frac{m g}{k(2 l\\cos\\varphi - a)}$$") == "RRMRFF");
    CHECK(statuses(pendulum,
                   "$x = l\\sin\\theta$, $y = -l\\cos\\theta$\n\n$$m g\\,\\delta y = 0$$\n"
                   "$$m g l\\sin\\theta = 0$$") == "RRRR");
    // not what these displacements give
    CHECK(statuses(toggle, slip + "$$\\delta W = [-m g l\\cos\\varphi + 3 k(2 l\\cos\\varphi - a) "
                                  "l\\sin\\varphi]\\,\\delta\\varphi$$") == "RRMRM");
}

TEST_CASE("consequences: a generalized force that the virtual work introduces is one of the scene's") {
    const std::string work = "$\\delta W = Q\\,\\delta\\varphi$, where\n\n";
    CHECK(statuses(toggle, work + "$$Q = -m g l\\cos\\varphi + 2 k l\\sin\\varphi\\,(2 l\\cos\\varphi - a)$$") ==
          "DR");
    CHECK(statuses(toggle, work + "$$Q = -m g l\\cos\\varphi + k l\\sin\\varphi\\,(2 l\\cos\\varphi - a)$$") ==
          "DM");
}

TEST_CASE("consequences: laws of a part and energies stand by themselves beside a slip") {
    const std::string slip = "$$T = \\frac12 (M + m)\\dot u^2 + \\frac12 m l^2\\dot\\theta^2$$\n";
    const std::string force = statuses(block, slip +
                                                  "$$M\\ddot u = -k u + S\\sin\\theta$$\n"
                                                  "$$m\\frac{d^2}{dt^2}(u + l\\sin\\theta) = -S\\sin\\theta$$");
    CHECK(force == "MDR");
    CHECK(statuses(block, slip + "$$V = \\frac12 k u^2 - m g l\\cos\\theta$$") == "MR");
    // the derivative of a wrong T does not stand by itself: two slips have cancelled
    CHECK(statuses(pendulum,
                   "$$T = m l^2\\dot\\theta^2$$\n$$\\frac{\\partial T}{\\partial\\dot\\theta} = "
                   "m l^2\\dot\\theta$$\n$$l\\ddot\\theta + g\\sin\\theta = 0$$") == "MUR");
}

TEST_CASE("consequences: a coordinate that is held in a special case") {
    CHECK(statuses(block, "If the block is clamped, $u = 0$, then $l\\ddot\\theta + g\\sin\\theta = 0$.") == "-R");
    CHECK(statuses(block, "If the block is clamped, $u = 0$, then $l\\ddot\\theta + g\\cos\\theta = 0$.") == "--");
}

TEST_CASE("consequences: a place that is passed holds no coordinate") {
    for (const std::string words :
         {"The following holds at $u = 0$: ", "If the block is not clamped, at $u = 0$, ",
          "The block is no longer clamped at $u = 0$, so ", "The block isn't clamped at $u = 0$, so ",
          "The block, which was clamped before, is let go at $u = 0$. Then ",
          "At the moment when the block passes $u = 0$, the pendulum obeys ", "Initially $u = 0$, so ",
          "Die Feder ist bei $u = 0$ entspannt, dort gilt "}) {
        CAPTURE(words);
        CHECK(statuses(block, words + "$l\\ddot\\theta + g\\sin\\theta = 0$.").back() != 'R');
    }
}

TEST_CASE("consequences: a kinetic energy K and a potential energy U stay energies beside T and V") {
    CHECK(statuses(pendulum, "The kinetic energy is $K = m l\\dot\\theta$.") == "M");
    CHECK(statuses(pendulum,
                   "$$T = \\frac12 m l^2\\dot\\theta^2$$\n$$V = -m g l\\cos\\theta$$\n"
                   "$$T + U = \\frac12 m l^2\\dot\\theta^2 + m g l\\cos\\theta$$") == "RRM");
    CHECK(statuses(test::textbook_text("spherical_pendulum"),
                   "$$T = \\frac12 m l^2(\\dot\\theta^2 + \\sin^2\\theta\\,\\dot\\phi^2)$$\n"
                   "$$p_\\phi = m l^2\\sin^2\\theta\\,\\dot\\phi = K$$") == "RRD");
}

TEST_CASE("consequences: a potential that holds the scene's loads goes on in L") {
    const std::string all = "$$T = \\frac12 (m + 4M)\\dot x^2$$\n$$V = \\frac12 k x^2 - 2 M g x$$\n";
    CHECK(statuses(load, all + "$$\\frac{d}{dt}\\frac{\\partial L}{\\partial\\dot x} - "
                               "\\frac{\\partial L}{\\partial x} = 0$$") == "RRR");
    CHECK(statuses(load, all + "$$\\frac{\\partial L}{\\partial x} = 2 M g - k x$$") == "RRR");
    CHECK(statuses(load, all + "$$\\frac{\\partial L}{\\partial x} = 2 M g + k x$$") == "RRM");
    CHECK(statuses(load, all + "$$T + V = \\text{const.}$$") == "RRR");
}

TEST_CASE("consequences: letters that the author counts otherwise, and angles of which the rate is stated") {
    CHECK(statuses(car,
                   "$y_1 = y + a\\theta$, $y_2 = y - b\\theta$\n\n"
                   "$$V = \\frac12 k_1 y_1^2 + \\frac12 k_2 y_2^2$$") == "DDR");
    CHECK(statuses(wheel,
                   "$\\dot x = r\\dot\\psi$ (rolling)\n\n"
                   "$$T = \\frac12 m\\dot x^2 + \\frac14 m r^2\\dot\\psi^2$$\n"
                   "$$\\frac32 m r\\ddot\\psi = -k x$$") == "DRR");
    CHECK(statuses(wheel,
                   "$\\dot x = r\\dot\\psi$ (rolling)\n\n"
                   "$$T = \\frac12 m\\dot x^2 + \\frac12 m r^2\\dot\\psi^2$$") == "DM");
}

TEST_CASE("consequences: data with units in plain text") {
    const std::string data = "m = 1 kg, b = 0.4 m, g = 9.81 m/s^2\n\n";
    CHECK(statuses(rod, data + "m g b = 3.92 N m", "page.txt").back() == 'R');
    CHECK(statuses(rod, data + "m g b = 7.85 N m", "page.txt").back() == 'M');
    CHECK(statuses(rod, "T = 2/3 m b^2 theta'^2   (3 points)", "page.txt") == "R");
    CHECK(statuses(rod, "T = 2/3 m b^2 theta'^2 （3分）", "page.txt") == "R");
}

const char* const rod_in_guides = R"toml(
gravity = [0, "-g"]
[parameters]
m = 2
l = 0.8
g = 9.81
[coordinates]
theta = 0.6
[[frame]]
name = "F"
rotate = [["z", "theta"]]
[[body]]
name = "asta"
mass = "m"
inertia = "m*l^2/12"
frame = "F"
position = ["l/2*sin(theta)", "l/2*cos(theta)"]
)toml";

TEST_CASE("consequences: a force function, a primed constant, the place of a start, another system") {
    for (const std::string words : {"The force function is ", "la fonction de forces est ", "力函数为 "})
        CHECK(statuses(pendulum, words + "$$U = m g l\\cos\\theta$$") == "D");
    CHECK(statuses(pendulum, "$U = m g l\\cos\\theta$, so $V = -U$.") == "DR");
    CHECK(statuses(pendulum, "The potential energy is $$U = m g l\\cos\\theta$$") == "M");
    CHECK(statuses(pendulum, "$$\\tfrac12 m l^2\\dot\\theta^2 - m g l\\cos\\theta = E' = \\text{const}$$")[0] !=
          'M');
    const std::string start = "It starts from rest at $\\theta = \\alpha$, so that ";
    CHECK(statuses(pendulum, start + "$l\\dot\\theta^2 = 2g(\\cos\\theta - \\cos\\alpha)$.") == "-R");
    CHECK(statuses(pendulum, start + "$l\\dot\\theta^2 = g(\\cos\\theta - \\cos\\alpha)$.") == "-M");
    CHECK(statuses(pendulum, start + "at the bottom $l\\dot\\theta^2 = 2g(1 - \\cos\\alpha)$.") != "-M");
    // A is the upper end of the rod, and not the thing whose name begins so
    CHECK(statuses(rod_in_guides, "$y_G = \\frac l2\\cos\\theta$, $y_A = l\\cos\\theta$") == "RD");
    CHECK(statuses(rod_in_guides, "$x_B = l\\sin\\theta$, $v_B = l\\dot\\theta$") == "DD");
    for (const std::string said : {"It is released at ", "It starts at ", "Initially "}) {
        CHECK(statuses(pendulum, said + "$\\theta = \\alpha$. $$l\\ddot\\theta = -g\\sin\\alpha$$") == "--");
        CHECK(statuses(pendulum, "From rest. " + said +
                                     "$\\theta = \\alpha$. $$l\\dot\\theta^2 = 2g(\\cos\\theta - "
                                     "\\cos\\alpha)$$") == "-R");
    }
    CHECK(statuses(test::textbook_text("central_force"), "The angular momentum is $$l = -7 m r^2\\dot\\phi$$") !=
          "R");
    CHECK(statuses(rod_in_guides, "$y_G = l\\cos\\theta$") == "M");
    CHECK(statuses(pendulum,
                   "The angular momentum $l = \\frac12 m l^2\\dot\\theta^2 - m g l\\cos\\theta$ is conserved.") !=
          "R");
    CHECK(statuses(pendulum,
                   "Ersetzt man die Masse durch einen Stab, folgt $$l\\ddot\\theta + \\frac32 "
                   "g\\sin\\theta = 0$$") != "M");
    for (const std::string said : {"The angular momentum is conserved: ", "The angular momentum is "})
        CHECK(statuses(pendulum, said + "$$m l^2\\dot\\theta = \\text{const}$$").back() != 'R');
    CHECK(statuses(pendulum, "If the bob is replaced by a rod, $$l\\ddot\\theta + \\frac32 g\\sin\\theta = 0$$") !=
          "M");
}

}  // namespace derivation_consequences
