// SPDX-License-Identifier: MIT
// Derivations as people write them, with the status that each line deserves: letters of the author's own, guesses
// that nothing bears out, products without blanks, values at one moment, conditions, functions of momenta, words
// in three languages. Right lines must not be mistakes under one reading of several, and wrong ones must not pass.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/derivation/explanation.hpp"
#include "check/derivation/marked.hpp"
#include "check/written/sentences.hpp"
#include "check/written/words.hpp"
#include "derivation_statuses.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"

namespace derivation_readings {

using namespace alembert;
using test::statuses;

namespace {

const char* const plain = R"toml(
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

const char* const two_particles = R"toml(
[parameters]
m = 1
k = 2
[coordinates]
x = 1
y = 2
[energy]
kinetic = "m*(x'^2 + y'^2)/2"
potential = "k*(x^2 + y^2)/2"
)toml";

const std::string pendulum = plain, hoop = test::textbook_text("rotating_hoop"),
                  spherical = test::textbook_text("spherical_pendulum"),
                  spring = test::textbook_text("elastic_pendulum");

}  // namespace

TEST_CASE("readings: a letter that nothing bears out is not judged, and one that lines bear out is") {
    CHECK(statuses(pendulum, "$$m l^2\\ddot\\theta + G\\sin\\theta = 0$$") == "-");
    CHECK(statuses(pendulum, "$$\\ddot\\theta + \\omega_0^2\\sin\\theta = 0$$") == "-");
    CHECK(statuses(pendulum, "$$l\\ddot\\theta + M\\sin\\theta = 0$$") == "-");
    CHECK(statuses(pendulum,
                   "$$T = \\frac12 m L^2\\dot\\theta^2$$\n$$V = -m g L\\cos\\theta$$\n"
                   "$$L\\ddot\\theta + g\\cos\\theta = 0$$") == "RRM");
    CHECK(statuses(pendulum,
                   "$$T = \\frac12 m a^2\\dot\\varphi^2$$\n$$V = -m g a\\cos\\varphi$$\n"
                   "$$a\\ddot\\varphi - g\\sin\\varphi = 0$$") == "RRM");
}

TEST_CASE(
    "readings: what the author defines is his, and his wrong definitions are found by the lines that follow") {
    CHECK(statuses(pendulum, "With $v = \\dot\\theta$ we have $\\dot v = -\\frac{g}{l}\\sin\\theta$.") == "DR");
    CHECK(statuses(pendulum, "The angular momentum is $L = m l^2\\dot\\theta$.") == "R");
    CHECK(statuses(pendulum, "The angular momentum is $L = m l\\dot\\theta$.") == "-");
    CHECK(statuses(pendulum, "The angular momentum is $\\ell = m l^2\\dot\\theta$.") == "R");
    CHECK(statuses(spring, "Let $x = r - l_0$. Then $V = \\frac12 k x^2 - m g (l_0 + x)\\cos\\theta$.") == "DR");
    CHECK(statuses(spring, "Let $x = r - l_0$. Then $V = \\frac12 k x^2 + m g (l_0 + x)\\cos\\theta$.") == "DM");
    CHECK(
        statuses(pendulum,
                 "Let $u = \\dot\\theta$.\n$$l\\dot u + g\\sin\\theta = 0$$\n$$l\\dot u - g\\sin\\theta = 0$$") ==
        "DRM");
    CHECK(statuses(pendulum, "$$T = \\frac12 m l^2\\dot q^2$$\n$$m l^2\\ddot q + m g l\\cos q = 0$$") == "RM");
    CHECK(statuses(pendulum, "$v = l\\dot\\theta$, so $T = \\frac12 m v^2$.") == "RR");
    CHECK(statuses(pendulum,
                   "$\\theta = \\pi - \\alpha$\n\n$V = m g l\\cos\\alpha$\n\n$l\\ddot\\alpha = g\\sin\\alpha$") ==
          "DRR");
    CHECK(statuses(pendulum, "$$T = \\frac12 m l\\dot\\theta^2$$") == "M");  // an energy is what it is
}

TEST_CASE("readings: products without blanks, groups as TeX sets them, squares of whole groups") {
    CHECK(statuses(pendulum, "ml²θ̈ + mgl sin θ = 0", "test.txt") == "R");
    CHECK(statuses(pendulum, "ml²θ̈ − mglsinθ = 0", "test.txt") == "M");
    CHECK(statuses(spring, "V = ½k(r-l₀)² + mgr cos θ", "test.txt") == "M");
    CHECK(statuses(spring, "V = ½k(r-l₀)² − mgr cos θ", "test.txt") == "R");
    CHECK(statuses(pendulum, "$$l\\ddot\\theta \\textcolor{red}{+ g\\sin\\theta} = 0$$") == "R");
    CHECK(statuses(pendulum, "$$l\\ddot\\theta \\underbrace{+ g\\sin\\theta}_{\\text{gravity}} = 0$$") == "R");
    CHECK(statuses(pendulum, "$$T = \\frac12 m {+ l^2\\dot\\theta^2}$$") == "M");
    CHECK(statuses(spring, "$$V = \\frac12(k(r - l_0))^2 - m g r\\cos\\theta$$") == "M");
    CHECK(statuses(pendulum,
                   "$$\\begin{aligned} T &= \\frac12 m l^2\\dot\\theta^2 \\newline V &= -m g l\\cos\\theta "
                   "\\end{aligned}$$") == "RR");
}

TEST_CASE("readings: values at one moment, conditions and numbers of equations are no claims") {
    CHECK(statuses(pendulum, "$$\\theta(0) = 0.2$$\n$$\\dot\\theta(0) = 0$$") == "--");
    CHECK(statuses(pendulum, "At $\\theta=\\pi/2$ we have $$l\\ddot\\theta + g = 0$$") == "--");
    CHECK(
        statuses(pendulum,
                 "Take $V = 0$ at $\\theta = 0$, so $V = mgl(1-\\cos\\theta)$.\n\nAt rest $\\ddot\\theta = 0$.") ==
        "--R-");
    CHECK(statuses(pendulum,
                   "$(4) = (2)\\cos\\theta + (3)\\sin\\theta$ gives\n$$l\\ddot\\theta + g\\sin\\theta = 0$$") ==
          "-R");
    CHECK(statuses(hoop, "At equilibrium $\\sin\\theta=0$ or $\\cos\\theta=\\frac{g}{R\\Omega^2}$.") == "RR");
    CHECK(statuses(hoop, "At equilibrium $\\theta=\\theta_0$: $$\\cos\\theta_0=\\frac{g}{R\\Omega^2}$$") == "RR");
    CHECK(statuses(spherical, "For the conical pendulum $\\dot\\phi^2=\\frac{g}{l\\cos\\theta}$.") == "-");
    CHECK(statuses(pendulum, "$$l\\ddot\\theta - g\\sin\\theta = 0$$") == "M");
}

// The commonest words of a derivation state no condition, and what follows them is judged.
TEST_CASE("readings: descriptions are no conditions") {
    for (const char* words :
         {"The bob hangs on a massless rod. The potential energy becomes", "The length of the rod is constant:",
          "A bead on a circular hoop, whose centre is fixed, has", "The Lagrangian reduces to",
          "For the bob we have", "取 θ 为广义坐标，系统的势能为", "设杆为轻杆，势能"}) {
        CAPTURE(std::string(words));
        CHECK(statuses(pendulum, std::string(words) + "\n\n$$V = m g l\\cos\\theta$$") == "M");
        CHECK(statuses(pendulum, std::string(words) + "\n\n$$l\\ddot\\theta - g\\sin\\theta = 0$$") == "M");
    }
    CHECK(statuses(pendulum, "Take $V = 0$ at $\\theta = 0$, so $V = mgl(1+\\cos\\theta)$.") == "--M");
}

TEST_CASE("readings: virtual displacements, those of places and those that constraints allow") {
    const std::string places = "$$x = l\\sin\\theta,\\quad y=-l\\cos\\theta$$\n";
    CHECK(statuses(pendulum, places + "$$\\delta x = l\\cos\\theta\\,\\delta\\theta$$\n"
                                      "$$\\delta W = -mg\\,\\delta y = -mgl\\sin\\theta\\,\\delta\\theta$$\n"
                                      "$$-m\\ddot x\\,\\delta x - (m\\ddot y + mg)\\,\\delta y = 0$$") ==
          "RRRRRR");
    CHECK(statuses(pendulum, places + "$$\\delta x = -l\\cos\\theta\\,\\delta\\theta$$") == "RRM");
    CHECK(statuses(pendulum, places + "$$-m\\ddot x\\,\\delta x - (m\\ddot y - mg)\\,\\delta y = 0$$") == "RRM");
    CHECK(statuses(pendulum, places + "$$\\delta W = mg\\,\\delta y$$") == "RRM");
    CHECK(statuses(pendulum, "$$\\delta V = m g l\\sin\\theta\\,\\delta\\theta$$\n$$\\sum\\delta W = 0$$") ==
          "R-");
    CHECK(statuses(pendulum, "$$(m l^2\\ddot\\theta + m g l\\sin\\theta)\\,\\delta\\theta = 0$$") == "R");
    const std::string bound = test::textbook_text("cartesian_pendulum");
    CHECK(statuses(bound, "$$m\\ddot x\\,\\delta x + (m\\ddot y + mg)\\,\\delta y = 0$$") == "R");
    CHECK(statuses(bound, "$$m\\ddot x\\,\\delta x + (m\\ddot y - mg)\\,\\delta y = 0$$") == "M");
    CHECK(statuses(bound, "$$x\\,\\delta x + y\\,\\delta y = 0$$") == "R");
    CHECK(statuses(bound, "$$x\\,\\delta y + y\\,\\delta x = 0$$") == "M");
}

TEST_CASE("readings: what plain TeX writes, and rows whose ends were lost") {
    CHECK(statuses(pendulum, "$p_\\theta = {\\partial L \\over \\partial \\dot\\theta} = m l^2\\dot\\theta$") ==
          "RR");
    CHECK(statuses(pendulum,
                   "$${d \\over dt}{\\partial L \\over \\partial{\\dot\\theta}} = m l^2\\ddot\\theta$$") == "R");
    CHECK(statuses(pendulum, "$$\\dot\\theta = \\sqrt{p_\\theta^2 \\over m^2 l^4} \\over 1$$") == "-");
    CHECK(statuses(pendulum, "$$T = \\frac12 m l^2\\dot\\theta^2\nV = -m g l\\cos\\theta$$") == "RR");
    CHECK(statuses(pendulum, "$$T = \\frac12 m\nl^2\\dot\\theta^2$$") == "R");
    CHECK(statuses(pendulum,
                   "$$\\begin{pmatrix} T = \\frac12 m l^2\\dot\\theta^2 \\\\ V = m g l\\cos\\theta "
                   "\\end{pmatrix}$$") == "RM");
    CHECK(statuses(pendulum, "\\[ L = T - V = \\]\n\\[ = \\frac12 m l^2\\dot\\theta^2 + m g l\\cos\\theta \\]") ==
          "RR");
    CHECK(statuses(pendulum, "$H = \\frac{p^2}{2 m l^2} - m g l\\cos\\theta$") == "R");
    CHECK(statuses(pendulum, "$H = \\frac{p^2}{2 m l} - m g l\\cos\\theta$") != "R");
}

TEST_CASE("readings: a law before its force, the author's own H, and velocities put into T") {
    CHECK(statuses(pendulum,
                   "$$\\frac{d}{dt}\\frac{\\partial T}{\\partial\\dot\\theta} - \\frac{\\partial "
                   "T}{\\partial\\theta} = Q_\\theta$$\n\n$$Q_\\theta = -mgl\\sin\\theta$$") == "RR");
    CHECK(statuses(pendulum,
                   "$$\\frac{d}{dt}\\frac{\\partial T}{\\partial\\dot\\theta} - \\frac{\\partial "
                   "T}{\\partial\\theta} = Q_\\theta$$\n\n$$Q_\\theta = mgl\\sin\\theta$$") == "RM");
    CHECK(statuses(pendulum,
                   "$$H = \\frac{p_\\theta^2}{2m} - mgl\\cos\\theta$$\n$$\\dot\\theta = \\frac{\\partial "
                   "H}{\\partial p_\\theta} = \\frac{p_\\theta}{m}$$") == "MRF");
    CHECK(statuses(pendulum,
                   "$x_b = l\\sin\\theta$, $y_b = -l\\cos\\theta$\n\n$\\dot x_b = l\\dot\\theta\\sin\\theta$, "
                   "$\\dot y_b = l\\dot\\theta\\sin\\theta$\n\n$T = m l^2\\dot\\theta^2\\sin^2\\theta$") ==
          "RRMRF");
    CHECK(statuses(pendulum, "$v^2 = l\\dot\\theta^2$, so $T = \\frac12 m l\\dot\\theta^2$") == "MF");
    CHECK(statuses(pendulum, "$v^2 = l\\dot\\theta^2$, so $T = \\frac13 m l\\dot\\theta^2$") == "-M");
    CHECK(statuses(pendulum,
                   "$$L' = \\frac12 m l^2\\dot\\theta^2 + m g l\\cos\\theta + \\frac{d}{dt}(\\theta^2)$$") == "R");
    CHECK(statuses(pendulum, "$$L' = \\frac12 m l^2\\dot\\theta^2 - m g l\\cos\\theta$$") == "M");
}

TEST_CASE("readings: rates just after an impact") {
    const std::string rods = test::textbook_text("struck_rods");
    CHECK(statuses(rods,
                   "碰撞结束时\n\n$$\\dot\\theta_1 = \\frac{3S}{7ml},\\quad \\dot\\theta_2 = \\frac{6S}{7ml}$$") ==
          "RR");
    CHECK(statuses(rods, "Just after the impact $$\\dot\\theta_1 = \\frac{3S}{8ml}$$") == "M");
    CHECK(statuses(rods, "$$\\dot\\theta_1 = \\frac{3S}{7ml}$$") == "M");
}

TEST_CASE("readings: a mass centre is no particle whose name has the same initial") {
    const std::string cart = test::textbook_text("cart_rod");
    CHECK(statuses(cart, "$x_C = x + l\\sin\\varphi$") == "R");
    CHECK(statuses(cart, "$x_G = x + l\\sin\\varphi$, $y_G = -l\\cos\\varphi$") == "RR");
}

TEST_CASE("readings: slopes along the motion, single motions, matrices that are written out") {
    CHECK(statuses(pendulum, "$$\\dot\\theta\\frac{d\\dot\\theta}{d\\theta} = -\\frac gl\\sin\\theta$$") == "R");
    CHECK(statuses(pendulum, "$$\\dot\\theta\\frac{d\\dot\\theta}{d\\theta} = \\frac gl\\sin\\theta$$") == "M");
    CHECK(statuses(pendulum, "$$\\ddot\\theta = \\frac12\\frac{d}{d\\theta}(\\dot\\theta^2)$$") == "R");
    CHECK(statuses(pendulum, "$$ml^2\\ddot\\theta = -\\frac{dV}{d\\theta} = -mgl\\sin\\theta$$") == "RR");
    CHECK(statuses(pendulum, "$$ml^2\\ddot\\theta = \\frac{dV}{d\\theta}$$") == "M");
    CHECK(statuses(test::textbook_text("central_force"), "$$\\dot r = \\dot\\phi\\frac{dr}{d\\phi}$$") == "R");
    CHECK(statuses(test::textbook_text("central_force"), "$$\\dot r = \\dot r\\frac{dr}{d\\phi}$$") == "M");
    CHECK(statuses(pendulum, "$$\\theta = A\\cosh(\\alpha t)$$") == "-");
    CHECK(statuses(pendulum, "Then $\\theta = \\frac12\\ddot\\theta t^2$.") == "-");
    CHECK(statuses(pendulum,
                   "$$V = -mgl\\cos\\theta,\\quad V'(\\theta) = mgl\\sin\\theta,\\quad V''(0) = mgl$$") == "RRR");
    const std::string M = "$$\\begin{pmatrix} m & 0 \\\\ 0 & m\\end{pmatrix}\\begin{pmatrix}\\ddot x\\\\ \\ddot "
                          "y\\end{pmatrix} + \\begin{pmatrix} k x \\\\ ",
                      end = " k y\\end{pmatrix} = 0$$";
    CHECK(statuses(two_particles, M + end) == "R");
    CHECK(statuses(two_particles, M + "2" + end) == "M");
}

TEST_CASE("readings: a law that is stated founds what follows; denials and what is struck out say nothing") {
    CHECK(statuses(pendulum,
                   "$\\frac{d}{dt}\\frac{\\partial L}{\\partial\\dot\\theta}=\\frac{\\partial "
                   "L}{\\partial\\theta}$ so $\\ddot\\theta=-\\frac gl\\sin\\theta$.") == "RR");
    CHECK(statuses(pendulum, "~~$T = m l \\dot\\theta$~~ $T=\\frac12 ml^2\\dot\\theta^2$") == "R");
    CHECK(statuses(pendulum, "It is not true that $V = mgl\\cos\\theta$.") == "-");
    CHECK(statuses(pendulum, "Instead of forces we use energies: $V = mgl\\cos\\theta$.") == "M");
    CHECK(statuses(pendulum, "$T + V = 常量$, $T + V = \\text{konst.}$") == "RR");
    CHECK(statuses(pendulum, "$T - V = 常量$") == "M");
    CHECK(statuses(pendulum, "$$K.E. = \\frac12 ml^2\\dot\\theta^2$$") == "R");
    CHECK(statuses(pendulum, "$$\\frac12 ml^2\\dot\\theta^2 - mgl\\cos\\theta =: K$$") == "D");
    CHECK(statuses(pendulum, "$$K = \\frac12 ml^2\\dot\\theta^2 - mgl\\cos\\theta$$") == "M");
}

TEST_CASE("readings: notebooks of Jupyter and reStructuredText, each mistake at its place") {
    const std::string cells =
        R"json({"cells": [{"cell_type": "markdown", "metadata": {}, "source": ["The energy is\n",
 "$T = \\frac12 m l^2\\dot\\theta^2$"]}, {"cell_type": "code", "source": ["T = 3*m"], "outputs": []},
 {"source": "\\begin{align}\nV &= -m g l\\cos\\theta\\\\\nL &= T + V\n\\end{align}", "cell_type": "markdown"}],
 "metadata": {}, "nbformat": 4})json";
    CHECK(statuses(pendulum, cells, "page.ipynb") == "RRM");
    const Marked marked = mark(parse_scene(pendulum, "scene.toml"), read_derivation(cells, "page.ipynb"));
    CHECK(marked.lines[2].line == 3);
    CHECK(marked.lines[2].source == "L &= T + V");
    CHECK_THROWS_AS(read_derivation("{}", "page.ipynb"), SceneError);
    CHECK(statuses(pendulum,
                   "Energies\n========\n\n.. math::\n\n   T = \\frac12 m l^2\\dot\\theta^2\n\n   V = m g "
                   "l\\cos\\theta\n\n"
                   "so :math:`l\\ddot\\theta + g\\sin\\theta = 0`.\n",
                   "page.rst") == "RMU");
}

TEST_CASE("readings: all coefficients of a virtual work count, and one text has one meaning of Q") {
    CHECK(
        statuses(spring,
                 "$\\delta W = (m g\\cos\\theta - k(r-l_0))\\,\\delta r + m g r\\sin\\theta\\,\\delta\\theta$") ==
        "M");
    CHECK(
        statuses(spring,
                 "$\\delta W = (m g\\cos\\theta - k(r-l_0))\\,\\delta r - m g r\\sin\\theta\\,\\delta\\theta$") ==
        "R");
    CHECK(statuses(spring, "$Q_r = m g\\cos\\theta - k(r-l_0)$ and $Q_\\theta = 0$") == "RM");
    CHECK(statuses(spring, "$Q_r = m g\\cos\\theta - k(r-l_0)$ and $Q_\\theta = -mgr\\sin\\theta$") == "RR");
    CHECK(statuses(spring, "$\\delta x = \\sin\\theta\\,\\delta r + r\\cos\\theta\\,\\delta\\theta$") == "R");
    CHECK(statuses(spring, "$\\delta x = \\sin\\theta\\,\\delta r - r\\cos\\theta\\,\\delta\\theta$") == "M");
}

TEST_CASE("readings: a derivative that is written out is one off the motion too") {
    const std::string orbit = test::textbook_text("central_force"),
                      trammel = test::textbook_text("elliptic_trammel");
    CHECK(statuses(orbit, "$\\frac{d}{dt}(m r^2\\dot\\varphi) = m r\\ddot\\varphi + 2m\\dot r\\dot\\varphi$") ==
          "M");
    CHECK(statuses(orbit,
                   "$\\frac{d}{dt}(m r^2\\dot\\varphi) = m r^2\\ddot\\varphi + 2mr\\dot r\\dot\\varphi = 0$") ==
          "RR");
    CHECK(statuses(
              orbit,
              "$\\frac{d}{dt}(m r^2\\dot\\varphi) = 0$, so $mr^2\\ddot\\varphi + 2mr\\dot r\\dot\\varphi = 0$") ==
          "RR");
    CHECK(statuses(trammel, "$\\frac{d}{dt}(x^2+y^2) = x\\dot x + y\\dot y$") == "M");
    CHECK(statuses(trammel, "$\\frac{d}{dt}(x^2+y^2) = 2x\\dot x + 2y\\dot y = 0$") == "RR");
    const std::string sleigh = test::textbook_text("chaplygin_sleigh_in_speeds");
    CHECK(statuses(sleigh, "$F^*_v = -m(\\dot v - a w^2)$") == "R");
    CHECK(statuses(sleigh, "$F^*_v = m(\\dot v - a w^2)$") == "M");
}

TEST_CASE("readings: values of parameters, branches of roots, integrals that the words state") {
    const std::string data =
        "A bob of mass $m = 1\\,\\mathrm{kg}$ hangs on a spring with $k = 40\\,\\mathrm{N/m}$.\n";
    CHECK(statuses(spring, data + "$$T = m(\\dot r^2+r^2\\dot\\theta^2)$$\n$$m\\ddot r + k(r-l_0) = 0$$") ==
          "--M-");
    CHECK(statuses(pendulum, "With $l = 1$ we get $\\ddot\\theta + g\\sin\\theta = 0$") == "-R");
    CHECK(statuses(pendulum, "With $l = 1$ we get $\\ddot\\theta + 2g\\sin\\theta = 0$") == "-M");
    const std::string orbit = test::textbook_text("central_force"), wedge = test::textbook_text("block_on_wedge");
    CHECK(statuses(orbit, "We have $\\dot r = \\sqrt{\\frac{2}{m}(E + \\frac{k}{r}) - r^2\\dot\\phi^2}$.") == "R");
    CHECK(statuses(orbit, "We have $\\dot r = \\pm\\sqrt{\\frac{2}{m}(E + \\frac{k}{r}) - r^2\\dot\\phi^2}$.") ==
          "R");
    CHECK(statuses(orbit, "We have $\\dot r = \\sqrt{\\frac{2}{m}(E - \\frac{k}{r}) - r^2\\dot\\phi^2}$.") == "M");
    CHECK(statuses(wedge, "Momentum is conserved, so $(M+m)\\dot X - m\\dot s\\cos\\alpha = C$.") == "M");
    CHECK(statuses(wedge, "Momentum is conserved, so $(M+m)\\dot X + m\\dot s\\cos\\alpha = C$.") == "R");
    CHECK(statuses(orbit, "Since $\\phi$ is cyclic the angular momentum $L_z = mr\\dot\\phi$ is conserved.") ==
          "M");
    CHECK(statuses(orbit, "Angular momentum conservation: $r^2\\dot\\phi = h$.") == "R");
    CHECK(statuses(orbit, "It starts from rest. $$m r\\dot\\varphi = \\mathrm{const}$$") == "M");
}

TEST_CASE("readings: small motions about a state that the author names") {
    const std::string turning = test::textbook_text("bead_on_turning_circle");
    const std::string written = "Write $r = l_0 + mg/k + \\xi$. For small oscillations\n\n";
    CHECK(
        statuses(spring, written + "$$m\\ddot\\xi + k\\xi = 0$$\n$$(l_0 + mg/k)\\ddot\\theta + g\\theta = 0$$") ==
        "DRR");
    CHECK(
        statuses(spring, written + "$$m\\ddot\\xi - k\\xi = 0$$\n$$(l_0 + mg/k)\\ddot\\theta - g\\theta = 0$$") ==
        "DMM");
    CHECK(statuses(turning,
                   "Put $\\theta = \\pi + \\varepsilon$. For small $\\varepsilon$ we get "
                   "$\\ddot\\varepsilon - \\Omega^2\\varepsilon = 0$.") == "DR");
    CHECK(statuses(spring, "For small angles $$p_\\theta = m r\\dot\\theta$$") ==
          "M");  // the spring does not rest at r = 0
    CHECK(statuses(pendulum, "For small angles $\\cos\\theta \\approx 1 + \\frac12\\theta^2$") == "M");
    CHECK(statuses(pendulum, "For small angles $\\cos\\theta \\approx 1$, $\\sin\\theta \\approx \\theta$") ==
          "RR");
    CHECK(statuses(pendulum, "$$l\\ddot\\theta + g\\theta = 0$$ for small angles.") == "R");
    for (const char* words : {"Small angles will be considered in the next section.",
                              "Before we linearize:", "No small-angle approximation is made.",
                              "## Small oscillations\n\nFirst the exact equation."})
        CHECK_MESSAGE(
            statuses(hoop, std::string(words) + "\n\n$$R\\ddot\\theta - R\\Omega^2\\sin\\theta + g\\sin\\theta = "
                                                "0$$") == "M",
            words);
}

TEST_CASE("readings: bodies in the author's order, components and forces of his own, states that words set") {
    const std::string hanging = test::textbook_text("hoop_pendulum"), orbit = test::textbook_text("central_force");
    const std::string second =
        "$T_2 = \\frac12 m(\\dot x^2 + 2l\\dot x\\dot\\theta\\cos\\theta + l^2\\dot\\theta^2)$";
    CHECK(statuses(hanging, "$T_1 = \\frac12 M\\dot x^2 + \\frac12 M R^2\\dot\\psi^2$, " + second) == "RR");
    CHECK(statuses(hanging, "$T_1 = \\frac12 M\\dot x^2 + \\frac13 M R^2\\dot\\psi^2$, " + second) == "-R");
    CHECK(statuses(orbit, "$v_r = \\dot r$, $v_\\phi = r\\dot\\phi$") == "DD");
    const std::string governor = test::textbook_text("watt_governor");
    CHECK(statuses(governor, "稳定转动时 $\\dot\\alpha=\\ddot\\alpha=0$。") == "--");
    CHECK(statuses(governor, "稳态运动时\n\n$$\\cos\\alpha=\\frac{(m+M)g}{ml\\Omega^2}$$") == "R");
    CHECK(statuses(governor, "稳态运动时\n\n$$\\cos\\alpha=\\frac{(m-M)g}{ml\\Omega^2}$$") == "-");
    CHECK(statuses(pendulum, "Set $\\ddot\\theta = 0$, $\\dot\\theta = 0$.") == "--");
    CHECK(statuses(pendulum, "Hence $\\ddot\\theta = 0$.") == "M");
    const std::string bars = test::textbook_text("hinged_bars");
    CHECK(statuses(bars, "In equilibrium. We find $$\\tan\\frac\\theta2 = \\frac{2P}{mg}$$") == "R");
    CHECK(statuses(bars, "In equilibrium. We find $$\\tan\\frac\\theta2 = \\frac{P}{mg}$$") == "M");
}

TEST_CASE("readings: two equations in one line of text, limits, laws of time, forces that share a letter with T") {
    CHECK(statuses(pendulum, "T = 1/2 m l^2 θ'^2      V = -m g l cos θ\n\nand so it goes", "test.txt") == "RR");
    CHECK(statuses(pendulum, "T    = 1/2 m l^2 θ'^2\nV    =   m g l cos θ\n\nas it should be here", "test.txt") ==
          "RM");
    CHECK(statuses(pendulum, "Since $\\partial L/\\partial t = 0$ the energy $T + V$ is constant.") == "R");
    CHECK(statuses(pendulum, "For $l\\to 0$ the formula reduces to $\\ddot\\theta = 0$.") == "-");
    const std::string yo_yo = test::textbook_text("yo_yo");
    CHECK(statuses(yo_yo,
                   "$m\\ddot y = T - m g$, $J\\ddot\\theta = b T$, $T = m(g + \\ddot h + b\\ddot\\theta)$, "
                   "$(J - m b^2)\\ddot\\theta = m b(g + \\ddot h)$") == "RRMF");
}

// What a condition, a root, a pose or a special value excuses is what it governs, and nothing else.
TEST_CASE("readings: what is assumed ends where it is said to end") {
    const std::string rods = test::textbook_text("struck_rods"),
                      turning = test::textbook_text("bead_on_turning_circle");
    CHECK(statuses(rods, "$$V = 7 m g l\\sin\\theta_1$$") == "M");
    CHECK(statuses(rods, "The blow comes from the left. $$V = 7 m g l\\sin\\theta_1$$") == "-");
    CHECK(statuses(rods,
                   "Before the impact all rests. $$T = \\frac23 m l^2\\dot\\theta_1^2 + \\frac16 m "
                   "l^2\\dot\\theta_2^2 + \\frac12 m l^2\\dot\\theta_1\\dot\\theta_2$$") == "R");
    CHECK(statuses(test::textbook_text("cartesian_pendulum"), "$$y = \\sqrt{l^2 - x^2}$$") !=
          "R");  // it hangs below
    CHECK(statuses(pendulum, "$$l\\dot\\theta\\sqrt2 = -\\sqrt2\\, l\\dot\\theta$$") == "M");
    CHECK(statuses(turning, "In the special case $\\Omega = 0$ the bead is free: $\\ddot\\theta = 0$.") == "-R");
    CHECK(statuses(turning,
                   "In the special case $\\Omega = 0$ the bead is free. In general $$\\ddot\\theta = 0$$") ==
          "-M");
    CHECK(statuses(turning, "Let $\\Omega = 0$ first.\n\n## The general case\n\n$$\\ddot\\theta = 0$$") == "-M");
    CHECK(statuses(test::textbook_text("elastic_pendulum"),
                   "Let $g = 0$. In general, in equilibrium, $$k(r - l_0)\\cos\\theta = 0$$") == "--");
    CHECK(statuses(pendulum, "For $t\\to\\infty$ nothing is lost. The equation is $\\ddot\\theta = 0$") != "-");
    CHECK(statuses(test::textbook_text("central_force"), "In equilibrium $$r = 7$$") != "R");
}

TEST_CASE("readings: a scope ends with words of motion, of the general case, or with the sentence") {
    const std::string rods = test::textbook_text("struck_rods"), belt = test::textbook_text("belt_drive"),
                      coupled = test::textbook_text("coupled_pendulums"),
                      wedge = test::textbook_text("block_on_wedge");
    CHECK(statuses(rods,
                   "Just after the impulse $\\dot\\theta_1=\\frac{3S}{7ml}$. During the swing the rates keep the "
                   "ratio $\\dot\\theta_2=2\\dot\\theta_1$") == "R-");
    CHECK(
        statuses(belt,
                 "For $J_1=J_2$ the rotors are equal. For unequal rotors, $J_1\\ddot\\theta_2=2kr_2(r_1\\theta_1-"
                 "r_2\\theta_2)$") == "-M");
    CHECK(statuses(pendulum, "Let $g = 0$. Nothing pulls. Then $\\ddot\\theta = 0$") == "--");
    CHECK(statuses(hoop,
                   "In relative equilibrium $\\cos\\theta=g/(R\\Omega^2)$. During every motion we have "
                   "$R\\Omega^2\\sin\\theta\\cos\\theta=g\\sin\\theta$") == "R-");
    CHECK(statuses(hoop, "Small oscillations off the axis have the frequency $\\omega=\\sqrt{g/R-\\Omega^2}$") ==
          "-");
    CHECK(statuses(coupled,
                   "Small oscillations, both in phase, have the frequency $\\omega=\\sqrt{g/l+2kh^2/(ml^2)}$") ==
          "-");
    const std::string linear = "$ml^2\\ddot\\theta_1+(mgl+kh^2)\\theta_1-kh^2\\theta_2=0$";
    CHECK(statuses(coupled, "For small angles " + linear + ". Für beliebig große Ausschläge gilt " + linear) ==
          "R-");
    CHECK(statuses(
              wedge,
              "From rest the energy gives $\\dot s=\\sqrt{\\frac{2(M+m)gs\\sin\\alpha}{M+m\\sin^2\\alpha}}$. The "
              "acceleration is $\\ddot s=7g$") == "--");
    CHECK(statuses(
              test::textbook_text("bead_on_parabola"),
              "$$\\frac12m(1+4c^2r^2)\\dot r^2-\\frac12m\\omega^2r^2+mgcr^2=h$$\nso $\\dot r^2=\\frac{2h/m-(2gc-"
              "\\omega^2)r^2}{1+4c^2r^2}$") == "RR");  // 2h/m is no number of hours
}

// What is heard in one language is heard in the others.
// Words that a person writes beside his lines excuse none that is wrong.
TEST_CASE("readings: functions of one coordinate, their primes, and their values at a place") {
    const std::string V = "$V = -mgl\\cos\\theta$. ";
    CHECK(statuses(pendulum, V + "Hence $V' = mgl\\sin\\theta$, $V'' = mgl\\cos\\theta$.") == "RRR");
    CHECK(statuses(pendulum, V + "Hence $V' = mgl\\cos\\theta$.") == "RM");
    CHECK(statuses(pendulum, V + "Then $\\frac{V''(0)}{ml^2} = \\frac gl$.") == "RR");
    CHECK(statuses(pendulum, V + "Then $\\frac{V''(0)}{ml^2} = \\frac{2g}l$.") == "R-");
    const std::string cone = test::textbook_text("spherical_pendulum");
    const std::string U =
        "Let $J = ml^2\\dot\\phi\\sin^2\\theta$, which is constant, and $$U(\\theta) = "
        "\\frac{J^2}{2ml^2\\sin^2\\theta} - mgl\\cos\\theta.$$ ";
    CHECK(statuses(cone, U + "Then $ml^2\\ddot\\theta = -U'(\\theta)$.").ends_with("R"));
    CHECK(!statuses(cone, U + "Then $ml^2\\ddot\\theta = U'(\\theta)$.").ends_with("R"));
}

TEST_CASE("readings: secular equations are held against the frequencies") {
    const std::string scene = test::textbook_text("coupled_pendulums");
    const std::string before = "Small oscillations, frequencies. ";
    CHECK(statuses(scene, before + "$$(mgl + kh^2 - ml^2\\omega^2)^2 - k^2h^4 = 0$$") == "R");
    CHECK(statuses(scene, before + "$$(mgl + kh^2 - ml^2p^2)^2 = k^2h^4$$") == "R");
    CHECK(statuses(scene, before + "$$(mgl + kh^2 - ml^2\\lambda)^2 = k^2h^4$$") == "R");
    CHECK(statuses(scene, before + "$$(mgl + 2kh^2 - ml^2\\omega^2)^2 - k^2h^4 = 0$$") == "M");
    CHECK(statuses(scene, before + "$$(mgl + kh^2 - ml^2\\omega^2)^2 + k^2h^4 = 0$$") == "M");
}

TEST_CASE("readings: approximations agree to the order to which they are written") {
    CHECK(statuses(pendulum, "$1 - \\cos\\theta \\approx \\frac12\\theta^2$") == "R");
    CHECK(statuses(pendulum, "$1 - \\cos\\theta \\approx \\theta^2$") == "M");
    CHECK(statuses(pendulum, "$\\sin\\theta \\approx \\theta - \\theta^3/6$") == "R");
    CHECK(statuses(pendulum, "$\\sin\\theta \\approx \\theta - \\theta^3/3$") == "M");
    CHECK(statuses(pendulum,
                   "For small angles, to fourth order, $$V = -mgl + \\frac12mgl\\theta^2 - "
                   "\\frac1{24}mgl\\theta^4$$") == "R");
    CHECK(statuses(pendulum,
                   "For small angles, to fourth order, $$V = -mgl + \\frac12mgl\\theta^2 + "
                   "\\frac1{24}mgl\\theta^4$$") != "R");
}

TEST_CASE("readings: what holds at a place, at rest or in one mode is no mistake of motion") {
    CHECK(statuses(hoop,
                   "There is no force along the hoop: $$R\\Omega^2\\sin\\theta\\cos\\theta = "
                   "g\\sin\\theta$$") == "-");
    CHECK(statuses(hoop,
                   "There is no force along the hoop: $$R\\Omega^2\\sin\\theta\\cos\\theta = "
                   "2g\\sin\\theta$$") == "M");
    CHECK(statuses(spring,
                   "In the lowest position $\\theta = 0$ one has $m\\ddot r = mr\\dot\\theta^2 + mg - "
                   "k(r-l_0)$.")
              .ends_with("R"));
    CHECK(!statuses(spring,
                    "In the lowest position $\\theta = 0$ one has $m\\ddot r = mr\\dot\\theta^2 - mg - "
                    "k(r-l_0)$.")
               .ends_with("R"));
    CHECK(statuses(test::textbook_text("coupled_pendulums"),
                   "In the first mode the pendulums swing together, $\\theta_1 = \\theta_2$.") == "-");
}

TEST_CASE("readings: the work of a part of the forces, the start of a motion, one mode of several") {
    const std::string spring_work = "$$\\delta W = -k(r - l_0)\\,\\delta r$$";
    CHECK(statuses(spring, spring_work) == "-");  // if all forces are meant, the weight is missing
    CHECK(statuses(spring, "The virtual work of the weight is " + spring_work) != "R");
    CHECK(statuses(spring, "$$\\delta W = k(r - l_0)\\,\\delta r$$") == "M");
    CHECK(statuses(pendulum,
                   "Released from rest at $\\theta = \\pi/2$. All the time $$\\dot\\theta^2 = "
                   "\\frac{2g}{l}\\cos\\theta$$") == "-R");
    CHECK(statuses(pendulum,
                   "Released from rest at $\\theta = \\pi/2$. All the time $$\\dot\\theta^2 = "
                   "\\frac{g}{l}\\cos\\theta$$") != "-R");
    CHECK(statuses(test::textbook_text("coupled_pendulums"), "Frequencies. $$ml^2\\omega^2 - mgl - 2kh^2 = 0$$") ==
          "R");
    CHECK(statuses(test::textbook_text("coupled_pendulums"),
                   "Frequencies. $$m^2l^4\\omega^4 - mgl - 3kh^2 = 0$$") == "M");
}

TEST_CASE("readings: a force that its own equation determines is a definition, whatever a later line says of it") {
    CHECK(statuses(pendulum,
                   "Let $a_t = l\\ddot\\theta$.\n\n$$F_t + mg\\sin\\theta = m a_t$$\n\n"
                   "$$F_t = -2mg\\sin\\theta$$") == "DDR");
}

TEST_CASE("readings: labels in the text, decimals with a comma, letters that are rounded") {
    CHECK(statuses(pendulum, "and from (2) l theta'' + g sin(theta) = 0", "test.txt") == "R");
    CHECK(statuses(pendulum, "whence with (17)      theta'' = -g/l sin(theta)", "test.txt") == "R");
    CHECK(statuses(pendulum, "g = 9,81 m/s^2\nl = 2 m\nomega_0 = sqrt(g/l) = 2,21 1/s", "test.txt").find('M') ==
          std::string::npos);
    CHECK(statuses(test::textbook_text("coupled_pendulums"),
                   "Let $\\omega_0 = \\sqrt{g/l}$ and $\\omega_1 = 1.414\\,\\omega_0$. Then $\\omega_1^2 = "
                   "2\\omega_0^2$.") == "DDR");
}

TEST_CASE("readings: ordinary prose hides no wrong line") {
    for (const char* words :
         {"If we insert this into Lagrange's equation, we get", "When the bob moves, it obeys",
          "Assuming no friction at the pivot,", "The pivot is at rest. The equation of motion is",
          "The bob starts from rest; it obeys", "We do not linearize yet:", "wenn man einsetzt, folgt",
          "当摆运动时，", "当然，运动方程为", "支座静止。运动方程为",
          "We choose the angle measured from the equilibrium. Then"}) {
        CAPTURE(std::string(words));
        CHECK(statuses(pendulum, std::string(words) + "\n\n$$l\\ddot\\theta - g\\sin\\theta = 0$$") == "M");
        CHECK(statuses(pendulum, std::string(words) + "\n\n$$m l\\dot\\theta = 0$$") != "R");
    }
}

const char* const rod_on_springs = R"toml(
gravity = [0, "-g"]
[parameters]
m = 2
a = 0.5
k1 = 300
k2 = 500
g = 9.81
[coordinates]
y = 0
phi = 0.1
[[frame]]
name = "rod"
rotate = [["z", "phi"]]
[[body]]
name = "beam"
mass = "m"
inertia = "m*a^2/3"
frame = "rod"
position = [0, "y"]
[[spring]]
along = "y - a*sin(phi)"
stiffness = "k1"
[[spring]]
along = "y + a*sin(phi)"
stiffness = "k2"
)toml";

TEST_CASE("readings: equilibria of several coordinates, and what holds on one branch of them") {
    CHECK(statuses(rod_on_springs, "In equilibrium\n\n$$y=-\\frac{mg(k_1+k_2)}{4k_1k_2}$$") == "R");
    CHECK(statuses(rod_on_springs, "In equilibrium\n\n$$y=-\\frac{mg(k_1+k_2)}{2k_1k_2}$$") == "-");
    CHECK(statuses(rod_on_springs, "In equilibrium\n\n$$a\\sin\\phi=\\frac{mg(k_2-k_1)}{4k_1k_2}$$") == "R");
    CHECK(statuses(rod_on_springs, "In equilibrium\n\n$$a\\sin\\phi=\\frac{mg(k_1-k_2)}{4k_1k_2}$$") == "-");
    CHECK(statuses(rod_on_springs,
                   "For $k_1=k_2$ the frequency of small turns is\n\n$$\\omega^2=\\frac{6k_1}{m}$$") == "-R");
    CHECK(statuses(rod_on_springs,
                   "For $k_1=k_2$ the frequency of small turns is\n\n$$\\omega^2=\\frac{3k_1}{m}$$") == "-M");
    // Both sides vanish where θ = 0, which says nothing.
    CHECK(statuses(hoop, "In equilibrium\n\n$$g\\sin\\theta=2R\\Omega^2\\sin\\theta\\cos\\theta$$") == "M");
    CHECK(statuses(hoop, "In equilibrium\n\n$$g\\sin\\theta=R\\Omega^2\\sin\\theta\\cos\\theta$$") == "R");
    CHECK(statuses(pendulum, "The equilibrium follows from $dV/d\\theta = 0$.") == "R");
}

TEST_CASE("readings: a letter for the value of a coordinate at rest, and deviations from it") {
    const std::string rest =
        "In equilibrium $\\cos\\theta_0=\\frac{g}{R\\Omega^2}$. Put $\\theta=\\theta_0+\\xi$; to first "
        "order\n\n";
    CHECK(statuses(hoop, rest + "$$\\ddot\\xi+\\Omega^2\\sin^2\\theta_0\\,\\xi=0$$") == "RDR");
    CHECK(statuses(hoop, rest + "$$\\ddot\\xi+2\\Omega^2\\sin^2\\theta_0\\,\\xi=0$$") == "RDM");
    CHECK(statuses(hoop, "In equilibrium $\\cos\\theta_0=\\frac{2g}{R\\Omega^2}$.") == "M");
    CHECK(statuses(pendulum,
                   "Released from rest at $\\theta=\\theta_0$\n\n"
                   "$$\\dot\\theta^2=\\frac{2g}{l}(\\cos\\theta-\\cos\\theta_0)$$") == "-R");
    CHECK(statuses(pendulum,
                   "Released from rest at $\\theta=\\theta_0$\n\n"
                   "$$\\dot\\theta^2=\\frac{g}{l}(\\cos\\theta-\\cos\\theta_0)$$") == "-M");
    CHECK(statuses(spherical,
                   "Steady motion. Let $\\theta=\\alpha$ and $\\dot\\phi=\\omega$ be constant. Then\n\n"
                   "$$\\omega^2=\\frac{g}{l\\cos\\alpha}$$") == "--R");
    CHECK(statuses(spherical,
                   "Steady motion. Let $\\theta=\\alpha$ and $\\dot\\phi=\\omega$ be constant. Then\n\n"
                   "$$\\omega^2=\\frac{2g}{l\\cos\\alpha}$$") != "--R");
}

TEST_CASE("readings: numbers hold to their digits, and items and approximations are no factors and no claims") {
    CHECK(statuses(pendulum,
                   "With $g=9.81$ m/s² and $l=2$ m the frequency $\\omega=\\sqrt{g/l}$ is\n\n$$\\omega=2.21$$") ==
          "--RR");
    CHECK(statuses(pendulum,
                   "With $g=9.81$ m/s² and $l=2$ m the frequency $\\omega=\\sqrt{g/l}$ is\n\n$$\\omega=2.36$$") ==
          "--R-");
    CHECK(statuses(pendulum,
                   "With $g=9.81$ m/s² and $l=2$ m the frequency $\\omega=\\sqrt{g/l}$ is\n\n$$\\omega=4.43$$") ==
          "--RM");
    CHECK(statuses(pendulum, "An exam about a pendulum\n\n(b) l theta'' + g sin(theta) = 0", "exam.txt") == "R");
    CHECK(statuses(pendulum, "An exam about a pendulum\n\n(b) l theta'' + g cos(theta) = 0", "exam.txt") == "M");
    CHECK(statuses(pendulum, "平衡时 θ'' = 0\nsin(theta) = 0\n这是结果", "page.txt") == "-R");
    CHECK(statuses(pendulum,
                   "The energy that it starts with gives\n\n$$\\dot\\theta^2=\\frac{2g}{l}\\cos\\theta$$") == "-");
    CHECK(statuses(pendulum,
                   "The energy that it starts with gives\n\n$$\\dot\\theta^2=\\frac{g}{l}\\cos\\theta$$") == "M");
}

TEST_CASE("readings: words have their twins in three languages") {
    const auto heard = [](bool (*hears)(std::string_view), const std::vector<const char*>& yes,
                          const std::vector<const char*>& no) {
        for (const char* words : yes) CHECK_MESSAGE(hears(words), std::string(words));
        for (const char* words : no) CHECK_MESSAGE(!hears(words), std::string(words));
    };
    heard(states_condition,
          {"If the hand is held fixed, ", "When the wedge does not move,", "Wenn der Wagen ruht:", "若手不动，",
           "如果杆固定，"},
          {"If we insert this into", "when the bead moves,", "assuming no friction,", "The pivot is at rest.",
           "当然", "相当于", "wenn man einsetzt:"});
    heard(begins_condition_of_state,
          {"If the hand is at rest (", "Suppose that", "the value at", "Falls", "für", "若手不动（", "当"},
          {"The potential energy becomes", "It is known if so. Then", "the equation for this is",
           "取 r 为广义坐标，"});
    heard(speaks_of_rest, {"At equilibrium", "At rest we have", "静止时", "平衡位置为", "In der Ruhelage gilt"},
          {"The bob starts from rest.", "measured from the equilibrium", "displacements from equilibrium are",
           "released at rest"});
    heard(speaks_of_first_order,
          {"For small angles", "Linearizing,", "微振动时", "für kleine Winkel",
           "We do not need more. For small angles"},
          {"We do not linearize yet", "small oscillations are treated later", "without linearizing"});
    heard(speaks_of_special_motion,
          {"For the conical pendulum", "In steady motion", "das Kegelpendel", "圆锥摆：", "规则进动时"},
          {"a circular hoop", "a massless rod", "the length is constant", "圆环"});
    heard(speaks_of_start_from_rest, {"Since the system starts from rest,", "aus der Ruhe", "由于初始静止，"},
          {"the rest of the terms", "at the equilibrium"});
    heard(speaks_of_angular_momentum, {"The angular momentum is", "Drehimpuls", "对 O 点的动量矩为"},
          {"the momentum is", "动量"});
    heard(explains, {"where", "wobei", "其中"}, {"so", "we get"});
    heard(ends_sentence, {"done. Then", "完。", "This is so."}, {"i.e.", "or", "d.h. "});
    heard(joins_formulas, {"or", "i.e.", "或", "und"}, {"done. ", "and with the forces of the springs"});
}

TEST_CASE("readings: momenta are held in what the author writes in them") {
    const std::string J = "$J = m l^2\\sin^2\\theta\\,\\dot\\phi$ is constant.\n";
    CHECK(
        statuses(spherical, J + "$$U_{eff}(\\theta) = -m g l\\cos\\theta + \\frac{J^2}{2 m l^2\\sin^2\\theta}$$\n"
                                "$$m l^2\\ddot\\theta = -\\frac{dU_{eff}}{d\\theta}$$\n$$m l^2\\ddot\\theta = "
                                "\\frac{dU_{eff}}{d\\theta}$$") == "RDRM");
    CHECK(statuses(spherical,
                   "$$R = \\frac12 m l^2\\dot\\theta^2 - \\frac{p_\\phi^2}{2 m l^2\\sin^2\\theta} + m g "
                   "l\\cos\\theta$$\n$$\\frac{d}{dt}\\frac{\\partial R}{\\partial\\dot\\theta} - "
                   "\\frac{\\partial R}{\\partial\\theta} = 0$$") == "DR");
    CHECK(statuses(hoop,
                   "$$V_{eff}(\\theta)=-mgR\\cos\\theta-\\frac12mR^2\\Omega^2\\sin^2\\theta$$\n"
                   "$$V_{eff}'(\\theta)=mgR\\sin\\theta-mR^2\\Omega^2\\sin\\theta\\cos\\theta$$\n"
                   "$$mR^2\\ddot\\theta = -V_{eff}'(\\theta)$$") == "DRR");
}

TEST_CASE("readings: from a contradiction nothing follows") {
    CHECK(statuses(two_particles, "T = m*x'^2/2\n\nV = 7*k*x^4") == "MM");
    CHECK(statuses(two_particles, "T = m*x'^2/2\n\nm*x'' = 5*k*x") == "MM");
    const std::string slip =
        statuses(pendulum, "$$T = \\frac12 m l^2\\theta^2$$\n$$V = -m g l\\sin\\theta$$\n$$E = 44$$");
    CHECK(slip.substr(0, 2) == "MM");
    CHECK(slip[2] != 'F');
    CHECK(statuses(pendulum,
                   "$$T = \\frac12 m l^2\\dot\\theta^2$$\n$$V = m g l\\cos\\theta$$\n"
                   "$$l\\ddot\\theta - g\\sin\\theta = 0$$") == "RMF");
}

TEST_CASE("readings: words in Chinese are heard, and two integrals may both be constant") {
    CHECK(statuses(pendulum, "固有频率为\n\n$$\\omega_n = \\sqrt{2g/l}$$") == "M");
    CHECK(statuses(pendulum, "固有频率为\n\n$$\\omega_n = \\sqrt{g/l}$$") == "R");
    CHECK(statuses(pendulum, "微振动时\n\n$$l\\ddot\\theta + g\\theta = 0$$") == "R");
    CHECK(statuses(pendulum, "周期\n\n$$T = 2\\pi\\sqrt{\\frac{l}{g}}$$") == "R");
    CHECK(statuses(hoop, "平衡位置：\n\n$$\\sin\\theta(R\\Omega^2\\cos\\theta-g)=0$$") == "R");
    CHECK(statuses(spherical,
                   "$$m l^2\\sin^2\\theta\\,\\dot\\phi = \\text{const}$$\n\n$$T+V = \\mathrm{const}$$") == "RR");
    CHECK(statuses(pendulum, "Energy: $$\\frac12 m l^2\\dot\\theta^2 + mgl\\cos\\theta = \\text{const.}$$") ==
          "M");
}

TEST_CASE(
    "readings: a line that fails is a mistake where a small change explains it, or where it has one reading") {
    const LineClaim motion{.lhs = "m*l*theta''", .rhs = "-m*g*sin(theta) - k*theta + F"};
    const auto order = [](const std::string& of) {
        return of.find("''") != std::string::npos ? 2 : of.find('\'') != std::string::npos ? 1 : 0;
    };
    CHECK(is_plausible({.kind = "sign", .term = "k*theta", .repair = "…"}, motion, order));
    CHECK(is_plausible({.kind = "extra_term", .term = "F", .repair = "…"}, motion, order));
    CHECK(!is_plausible({.kind = "extra_term", .term = "F", .repair = "…"}, {.lhs = "F", .rhs = "a + b"}, order));
    CHECK(is_plausible({.kind = "missing_term", .term = "-m*x''", .repair = "…"}, motion, order));
    const LineClaim rest{.lhs = "k*x", .rhs = "m*g"};
    CHECK(!is_plausible({.kind = "missing_term", .term = "-m*x''", .repair = "…"}, rest, order));
    CHECK(!is_plausible({.kind = "missing_term", .term = "-m*x'' - k*x", .repair = "…"}, motion, order));
    CHECK(is_plausible({.kind = "missing_term", .term = "x'^2 + y'^2", .repair = "…"}, motion, order));
    CHECK(!is_plausible({.kind = "unknown"}, motion, order));
    const std::string wrong = "$$V = 7 m g l\\sin\\theta$$";
    CHECK(statuses(pendulum, wrong) == "M");
    CHECK(statuses(pendulum, "The bob is released from rest. " + wrong) == "-");
    CHECK(statuses(pendulum, "In equilibrium " + wrong) == "-");
    CHECK(statuses(pendulum, "The bob is released from rest. $$V = m g l\\cos\\theta$$") == "M");  // a sign
    CHECK(statuses(pendulum, "In equilibrium\n\n$$7 g\\sin\\theta = 0$$") == "R");
}

TEST_CASE("readings: a long dash between terms is a minus, and one before words is none") {
    const std::string rest = " \u2014 m g l cos(theta)";
    CHECK(statuses(pendulum, "On integration\n\n    1/2 m l^2 theta'^2" + rest + " = E\n") == "R");
    CHECK(statuses(pendulum, "    L = 1/2 m l^2 theta'^2 \u2014 m g l + m g l cos(theta)\n") == "R");
    CHECK(statuses(pendulum, "    l theta'' = \u2014 g sin(theta)\n") == "R");
    CHECK(statuses(pendulum, "    T = 1/2 m l^2 theta'^2 \u2014 as the bob moves on a circle\n") == "R");
    CHECK(statuses(pendulum, "    T = 1/2 m l^2 theta'^2 \u2014 l theta'' = -g sin(theta)\n") == "RR");
}

TEST_CASE("readings: L is the Lagrangian where the scene's length of that name is not used") {
    std::string table = test::textbook_text("central_force");
    table = table.substr(0, table.find("k = {")) + "L = 2\n" + table.substr(table.find("k = {"));
    const std::string begun =
        "$$L = \\frac{m}{2}(\\dot r^2 + r^2\\dot\\phi^2) + \\frac{k}{r}$$ $$p = \\frac{\\partial "
        "L}{\\partial\\dot\\phi}$$ $$R = L - p\\dot\\phi$$";
    CHECK(statuses(table, begun + "$$\\frac{\\partial R}{\\partial\\dot r} = m\\dot r$$").back() == 'R');
    CHECK(statuses(table, begun + "$$R = \\frac{m}{2}\\dot r^2 - \\frac{p^2}{2mr^2} + \\frac{k}{r}$$").back() ==
          'R');
    CHECK(statuses(table,
                   "$$L - p_\\phi\\dot\\phi = \\frac{m}{2}\\dot r^2 + \\frac{p_\\phi^2}{2mr^2} + "
                   "\\frac{k}{r}$$ $$L = \\frac{m}{2}(\\dot r^2 + r^2\\dot\\phi^2) + \\frac{k}{r}$$") == "MR");
    // A length where it is used as one.
    CHECK(statuses(table, "$$\\frac{L m \\dot r^2}{L} = m\\dot r^2$$") == "R");
}

TEST_CASE("readings: a function of a coordinate with a momentum in it is differentiated with the momentum held") {
    const std::string orbit = test::textbook_text("central_force"),
                      momentum = "The momentum $$G = mr^2\\dot\\phi = \\mathrm{const}$$";
    for (const std::string letter : {"W", "U", "F", "V"}) {
        CAPTURE(letter);
        const std::string function = momentum + "$$" + letter + "(r) = \\frac{G^2}{2mr^2} - \\frac{k}{r}$$";
        CHECK(statuses(orbit, function + "$$" + letter + "'(r) = -\\frac{G^2}{mr^3} + \\frac{k}{r^2}$$").back() ==
              'R');
        CHECK(statuses(orbit, function + "$$" + letter + "'(r) = \\frac{G^2}{mr^3} + \\frac{k}{r^2}$$").back() ==
              'M');
    }
}

TEST_CASE("readings: a remark, a number or a name behind a long dash is no term") {
    for (const std::string behind :
         {"(1)", "[1]", "m l cancels", "sin(theta) dropped", "theta", "QED", "\u2014 (1)", "Eq. 3"})
        for (const std::string before : {"", "l theta'' = -g sin(theta)\n\n"}) {
            CAPTURE(behind);
            const std::string found =
                statuses(pendulum, before + "    l theta'' + g sin(theta) = 0 \u2014 " + behind + "\n");
            CHECK(found.find('M') == std::string::npos);
            CHECK(found.back() == 'R');
        }
    CHECK(statuses(pendulum, "    V = m g l (1 \u2014 cos(theta))\n") == "R");
}

TEST_CASE("readings: a letter of the scene that stands beside accelerations is no energy") {
    const std::string string =
        "[parameters]\nm = 2\nl = 1\nT = 3\n[coordinates]\nx = 0.1\n[energy]\nkinetic = "
        "\"m*x'^2/2\"\n[forces]\nx = \"T\"\n";
    CHECK(statuses(string, "$$m\\ddot x = T$$ $$T = m\\ddot x$$") == "RR");
    CHECK(statuses(string, "$$T = \\frac12 m\\dot x^2$$ $$\\frac{\\partial T}{\\partial\\dot x} = m\\dot x$$") ==
          "RR");
}

TEST_CASE("readings: words of a beginning make no value at a start of what the author defines") {
    CHECK(statuses(spring,
                   "Starting from the Lagrangian, we write $\\dot r = v$. $$r\\ddot\\theta + 5v\\dot\\theta + "
                   "g\\sin\\theta = 0$$")
              .back() == 'M');
    CHECK(statuses(spring,
                   "Starting from the Lagrangian, we write $\\dot r = v$. $$r\\ddot\\theta + 2v\\dot\\theta + "
                   "g\\sin\\theta = 0$$")
              .back() == 'R');
}

TEST_CASE("readings: a function of a coordinate may have the letter of a parameter") {
    const std::string crank =
        "[parameters]\nJ0 = 0.3\nm = 2\nr = 0.4\n[inputs]\nM = 1.2\n[coordinates]\nphi = 0.3\n[energy]\nkinetic = "
        "\"(J0 + m*r^2*sin(phi)^2)*phi'^2/2\"\n[forces]\nphi = \"M\"\n";
    const std::string function = "$$m(\\phi) = J_0 + m r^2\\sin^2\\phi$$";
    CHECK(statuses(crank, function + "$$T = \\frac12 m(\\phi)\\dot\\phi^2$$"
                                     "$$m(\\phi)\\ddot\\phi + \\frac12 m'(\\phi)\\dot\\phi^2 = M$$") == "DRR");
    CHECK(statuses(crank, function + "$$\\frac{dm}{d\\phi} = m r^2\\sin 2\\phi$$"
                                     "$$m(\\phi)\\ddot\\phi + \\frac12\\frac{dm}{d\\phi}\\dot\\phi^2 = M$$") ==
          "DRR");
    CHECK(statuses(crank, function + "$$m(\\phi)\\ddot\\phi = M + \\frac12 m'(\\phi)\\dot\\phi^2$$") == "DM");
    CHECK(statuses(crank, function + "$$m'(\\phi) = m r^2\\cos 2\\phi$$") == "DM");
}

TEST_CASE("readings: a parameter with a bar beside the plain one is the author's own") {
    const std::string camera =
        "[parameters]\nB = 2\nm = 1\nd = 0.3\n[coordinates]\neps = 0.2\n[energy]\nkinetic = "
        "\"(B + m*d^2)*eps'^2/2\"\npotential = \"m*d*sin(eps)\"\n";
    const std::string shifted = "$$\\bar B = B + m d^2$$";
    CHECK(statuses(camera, shifted + "$$T = \\tfrac12\\bar B\\dot\\varepsilon^2$$ $$\\bar B\\ddot\\varepsilon + m "
                                     "d\\cos\\varepsilon = 0$$") == "DRR");
    CHECK(statuses(camera, shifted + "$$T = \\tfrac12 B\\dot\\varepsilon^2$$") != "DR");
}

const char* const half_car = R"toml(
[parameters]
m = 1200
J = 1800
a = 1.2
b = 1.5
kf = 30000
kr = 28000
[coordinates]
z = 0.02
theta = 0.01
[energy]
kinetic = "m*z'^2/2 + J*theta'^2/2"
potential = "kf*(z + a*theta)^2/2 + kr*(z - b*theta)^2/2"
)toml";

TEST_CASE("readings: z_f of z_f = z + a θ moves, and is no value at one state") {
    const std::string places =
        "$$z_f = z + a\\theta, \\qquad z_r = z - b\\theta$$ $$F_f = -k_f z_f, \\qquad F_r = "
        "-k_r z_r$$ ";
    CHECK(statuses(half_car, places + "$$m\\ddot z = F_f + F_r$$ $$J\\ddot\\theta = a F_f - b F_r$$") == "DDDDRR");
    CHECK(statuses(half_car, places + "$$J\\ddot\\theta = a F_f + b F_r$$").back() == 'M');
    // the slip of a chain is looked for from its beginning
    const std::string chain =
        "$$J\\ddot\\theta = -a k_f(z + a\\theta) + b k_r(z - b\\theta) = -(a k_f - b k_r)z - (a^2 "
        "k_f ";
    CHECK(statuses(half_car, chain + "+ b^2 k_r)\\theta$$") == "RR");
    CHECK(statuses(half_car, places + chain + "- b^2 k_r)\\theta$$") == "DDDDRM");
}

const char* const two_links = R"toml(
[parameters]
m1 = 2
m2 = 1
l1 = 0.5
r2 = 0.2
[inputs]
tau1 = "sin(t)"
tau2 = "cos(t)"
[coordinates]
q1 = 0.3
q2 = 0.4
[[particle]]
name = "P"
mass = "m1"
position = ["l1*cos(q1)", "l1*sin(q1)"]
[[particle]]
name = "Q"
mass = "m2"
position = ["l1*cos(q1) + r2*cos(q1 + q2)", "l1*sin(q1) + r2*sin(q1 + q2)"]
[forces]
q1 = "tau1"
q2 = "tau2"
)toml";

TEST_CASE("readings: sines and cosines by index, factors on a part of a sum, rates of relative turns") {
    CHECK(statuses(two_links,
                   "$$D_{12} = m_2(r_2^2 + l_1 r_2 c_2)$$ $$\\dot D_{12} = -m_2 l_1 r_2 s_2\\dot q_2$$ "
                   "$$\\dot y_Q = l_1 c_1\\dot q_1 + r_2 c_{12}(\\dot q_1 + \\dot q_2)$$") == "DRR");
    CHECK(statuses(two_links,
                   "$$D_{12} = m_2(r_2^2 + l_1 r_2 c_2)$$ $$\\dot D_{12} = -m_2 l_1 r_2 s_2\\dot q_1$$") == "DM");
    const std::string wheel =
        "[parameters]\nI0 = 2\nJw = 1\nmu = 3\n[coordinates]\ntheta = 0.1\nphi = 0\n[energy]\nkinetic = "
        "\"I0*theta'^2/2 + Jw*(theta' + phi')^2/2\"\npotential = \"mu*cos(theta)\"\n";
    CHECK(statuses(wheel,
                   "The wheel turns with $\\dot\\varphi$, so $$T = \\tfrac12 I_0\\dot\\theta^2 + \\tfrac12 "
                   "J_w\\dot\\varphi^2$$") == "M");
    const std::string geared =
        "[parameters]\nJm = 2\nbm = 1\nn = 50\nJ_L = 3\ntm = 1\n[coordinates]\nq = 0\n[energy]\nkinetic = \"(J_L "
        "+ "
        "n^2*Jm)*q'^2/2\"\n[dissipation]\nrayleigh = \"n^2*bm*q'^2/2\"\n[forces]\nq = \"n*tm\"\n";
    const std::string torque = "The gear gives $$J_L\\ddot q = n t_m - n";
    CHECK(statuses(geared, torque + "^2 b_m\\dot q - n^2 J_m\\ddot q$$").back() == 'R');
    CHECK(statuses(geared, torque + " b_m\\dot q - n J_m\\ddot q$$").back() == 'M');
}

TEST_CASE("readings: what stays where it was in a motion from rest is constant") {
    const std::string cars =
        "[parameters]\nM = 3\nm = 1\nk = 2\n[coordinates]\nX = 0\ns = 0.1\n[energy]\nkinetic = "
        "\"M*X'^2/2 + m*(X' + s')^2/2\"\npotential = \"k*s^2/2\"\n";
    const std::string start =
        "All starts from rest at $s = 0$. Then $(M + m)\\dot X + m\\dot s = 0$, hence $(M + m)X + ";
    CHECK(statuses(cars, start + "m s = \\mathrm{const}$.").substr(1) == "RR");
    CHECK(statuses(cars, start + "2 m s = \\mathrm{const}$.").back() == 'M');
    CHECK(statuses(cars, "Then $(M + m)X + m s = \\mathrm{const}$.") == "M");
}

TEST_CASE("readings: a vector of the coordinates, times matrices") {
    const std::string car =
        "$z$ and $\\theta$ are small. With $\\mathbf x = (z, \\theta)^T$ $$\\begin{pmatrix} m & 0\\\\ 0 & "
        "J\\end{pmatrix}\\ddot{\\mathbf x} + \\begin{pmatrix} k_f + k_r & a k_f - b k_r\\\\ a k_f - b "
        "k_r & ";
    const std::string end = "\\end{pmatrix}\\mathbf x = \\begin{pmatrix}0\\\\0\\end{pmatrix}$$";
    CHECK(statuses(half_car, car + "a^2 k_f + b^2 k_r" + end) == "DR");
    CHECK(statuses(half_car, car + "a^2 k_f - b^2 k_r" + end).back() == 'M');
}

TEST_CASE("readings: limits before a display, numbers of equations behind dots, uniform motion") {
    CHECK(statuses(half_car,
                   "For $b\\to\\infty$, $k_r\\to 0$ and the car becomes the rigid "
                   "link\n\n$$(J + m)\\ddot\\theta + k_f z = 0$$")
              .back() != 'M');
    for (const std::string dots : {"…(8)", "……(8)", ". . . (8)", "...(8)", "⋯ (8a)"})
        CHECK(statuses(half_car, "由(6)：   m z'' = -kf*(z + a*theta) - kr*(z - b*theta)      " + dots + "\n",
                       "page.txt") == "R");
    CHECK(statuses(half_car, "匀速运动 θ'' = 0： J θ' = 3\n", "page.txt").find('M') == std::string::npos);
}

TEST_CASE("readings: a force H of a reaction, K := m r² φ', values of states in numbers, a limit behind a slip") {
    const std::string roller =
        "gravity = [\"g*sin(alpha)\", \"-g*cos(alpha)\"]\n[parameters]\nm = 5\nr = 0.15\ng = 9.81\nalpha = "
        "0.4\n[coordinates]\nx = 0\nphi = 0\n[[frame]]\nname = \"W\"\nrotate = [[\"z\", "
        "\"-phi\"]]\n[[body]]\nname = \"walze\"\nmass = \"m\"\ninertia = \"m*r^2/2\"\nframe = \"W\"\nposition = "
        "[\"x\", \"r\"]\n[[constraint]]\nname = \"rollen\"\nholonomic = \"x = r*phi\"\n";
    const std::string laws =
        "$$m\\ddot x = m g\\sin\\alpha - H, \\qquad \\tfrac12 m r^2\\ddot\\varphi = H r$$ "
        "Die Reaktionskraft ist $$H = \\tfrac13 m g";
    CHECK(statuses(roller, laws + "\\sin\\alpha$$") == "DRR");
    CHECK(statuses(roller, laws + "\\cos\\alpha$$") == "DRM");
    const std::string orbit =
        "[parameters]\nm = 1\nk = 3\n[coordinates]\nr = 1\nphi = 0\n[energy]\nkinetic = "
        "\"m*(r'^2 + r^2*phi'^2)/2\"\npotential = \"k*r\"\n";
    CHECK(statuses(orbit, "> K := m*r^2*phi';\n> m*r'' - K^2/(m*r^3) + k = 0;\n", "work.txt") == "DR");
    CHECK(statuses(orbit, "> T := m*r^2*phi'^2;\n", "work.txt") == "M");
    CHECK(statuses(orbit,
                   "On the circle of radius $r_0$ the rate is $\\omega_0 = \\sqrt{k/(m r_0)}$. With $m = 2$ kg, "
                   "$k = 5$ N, $r_0 = 1$ m?")
              .find('M') == std::string::npos);
    CHECK(statuses(orbit,
                   "$$T = m(\\dot r^2 + r^2\\dot\\phi^2)$$ For $m\\to\\infty$ the body stands still, $\\ddot r = "
                   "0$, as it must be.") == "M-");
}

const std::string two_masses =
    "[parameters]\nm = 2\nk = 3\n[coordinates]\nx1 = 0\nx2 = 1\n[energy]\nkinetic = \"m*(x1'^2 + "
    "x2'^2)/2\"\npotential = \"k*x1^2/2 + k*(x2 - x1)^2/2\"\n";

TEST_CASE("readings: the number of an equation behind one blank or a dash is no factor") {
    for (const std::string number :
         {" (7)", " — (7)", " (2.13)", " (5a)", " (ii)", " — (i)", ", (7)", " (*)", ".  (7)"}) {
        CAPTURE(number);
        CHECK(statuses(two_masses, "m x1'' + 2 k x1 = k x2" + number + "\n", "page.txt") == "R");
        CHECK(statuses(two_masses, "$$m\\ddot x_1 + 2 k x_1 = k x_2" + number + "$$") == "R");
        CHECK(statuses(two_masses, "$m\\ddot x_1 + 2 k x_1 = 3 k x_2" + number + "$") == "M");
        CHECK(statuses(two_masses, "$m\\ddot x_1 + 2 k x_1 - k x_2 = 0$" + number) == "R");
    }
    CHECK(statuses(two_masses, "m x1'' + 2 k x1 = k x2(7)\n", "page.txt").back() != 'R');
    CHECK(statuses(two_masses, "m x1'' + 2 k x1 = k (x2)\n", "page.txt") == "R");
    CHECK(statuses(two_masses, "With numbers $m = 1 (2)$.") == "-");
}

TEST_CASE("readings: c_12 of angles that count from one line is the cosine of their difference") {
    const std::string pendulums =
        "[parameters]\nm1 = 1\nm2 = 2\nl1 = 1\nl2 = 0.8\ng = 9.81\n[coordinates]\ntheta1 = 0.5\ntheta2 = "
        "-0.2\n[energy]\nkinetic = \"(m1 + m2)*l1^2*theta1'^2/2 + m2*l2^2*theta2'^2/2 + "
        "m2*l1*l2*theta1'*theta2'*cos(theta1 - theta2)\"\npotential = \"-(m1 + m2)*g*l1*cos(theta1) - "
        "m2*g*l2*cos(theta2)\"\n";
    const std::string line =
        "With the short forms $s_1$ and $c_1$, $$T = \\frac12(m_1 + m_2)l_1^2\\dot\\theta_1^2 + \\frac12 m_2 "
        "l_2^2\\dot\\theta_2^2 + m_2 l_1 l_2 c_{12}\\dot\\theta_1\\dot\\theta_2$$ $$(m_1 + m_2)l_1\\ddot\\theta_1 "
        "+ m_2 l_2 c_{12}\\ddot\\theta_2 + "
        "m_2 l_2 s_{12}\\dot\\theta_2^2 + (m_1 + m_2) g ";
    CHECK(statuses(pendulums, line + "s_1 = 0$$") == "RR");
    CHECK(statuses(pendulums, line + "2 s_1 = 0$$") == "RM");
    CHECK(statuses(two_masses, "The springs stretch by s. $$m\\ddot x_1 = -c_1 s_1 + c_2 s_2$$").back() != 'M');
}

TEST_CASE("readings: what holds nothing and what is not assumed excuses nothing") {
    const std::string wrong = "\n\n$$m\\ddot x_1 = 2 k x_1 + k x_2$$";
    for (const std::string words :
         {"Keeping all terms, the equation of motion is", "The springs holding the block give",
          "No approximation like $k \\ll m$ is made, and the equation is", "Even as $x_2 \\to 0$ the law is"})
        CHECK(statuses(two_masses, words + wrong).back() == 'M');
    CHECK(statuses(two_masses, "Holding the second mass fixed, we get" + wrong).back() != 'M');
}

TEST_CASE("readings: an angular momentum is made of two lengths") {
    const std::string orbit =
        "[parameters]\nm = 1\nk = { value = 3, unit = \"N\" }\n[coordinates]\nr = 1\nphi = 0\n[energy]\nkinetic "
        "= \"m*(r'^2 + r^2*phi'^2)/2\"\npotential = \"k*r\"\n[[particle]]\nname = \"P\"\nmass = 0\nposition = "
        "[\"r*cos(phi)\", \"r*sin(phi)\"]\n";
    CHECK(statuses(orbit, "The angular momentum is $$D = m r^3\\dot\\varphi - m\\varphi\\dot r$$") == "-");
    CHECK(statuses(orbit, "The angular momentum is $$D = m r^2\\dot\\varphi$$") == "R");
}

const std::string hoisting =
    "gravity = [0, \"-g\"]\n[parameters]\nm = 5\nA = 0.4\ng = 9.81\n[inputs]\ns = \"A*t^2/2\"\nW = \"50000 + "
    "0*t\"\n[coordinates]\ntheta = 0\nl = 12\n[[particle]]\nname = \"load\"\nmass = \"m\"\nposition = [\"s + "
    "l*sin(theta)\", \"-l*cos(theta)\"]\n[forces]\nl = \"-W\"\n";

TEST_CASE("readings: rates that are zero are meant in the line behind them") {
    const std::string line = "$$l\\ddot\\theta = -g\\sin\\theta - A\\cos\\theta$$";
    for (const std::string words :
         {"Rope of constant length ($\\dot l = 0$): ", "Fune di lunghezza costante ($\\dot l = \\ddot l = 0$): ",
          "Rope of constant length, $\\dot l = 0$. Then ", "At the start of the motion, $\\dot l = 0$: "}) {
        CAPTURE(words);
        CHECK(statuses(hoisting, words + line).back() == 'R');
    }
    CHECK(statuses(hoisting, line) == "M");
    CHECK(statuses(hoisting, "At the start $\\dot l = 0$. The load then swings by " + line).back() == 'M');
    CHECK(statuses(two_masses, "Now $\\dot x_1 = 0$: $$p_1 = 2 m\\dot x_1$$").back() == 'M');
    CHECK(statuses(hoisting, "Near $\\theta = 0$: $$l\\ddot\\theta + 2\\dot l\\dot\\theta = 2 g\\theta - A$$")
              .back() != 'R');
}

TEST_CASE("readings: an index that runs stands for all numbers of the scene") {
    const std::string masses =
        "[parameters]\nm1 = 2\nm2 = 5\nk = 3\n[coordinates]\nx1 = 0\nx2 = 1\n[energy]\nkinetic = \"m1*x1'^2/2 + "
        "m2*x2'^2/2\"\npotential = \"k*x1^2/2 + k*(x2 - x1)^2/2\"\n";
    const std::string words = "With $v_i = \\dot x_i$ and $a_i = \\ddot x_i$ ";
    CHECK(statuses(masses, words + "$$m_1\\dot v_1 = k(x_2 - 2 x_1)$$").back() == 'R');
    CHECK(statuses(masses, words + "$$m_1\\dot v_1 = k(x_2 - x_1)$$").back() == 'M');
    CHECK(statuses(masses, "$$p_i = m_i\\dot x_i$$") == "R");
    CHECK(statuses(masses, "$$p_i = 2 m_i\\dot x_i$$") == "M");
    CHECK(statuses(masses, "$$\\frac{\\partial T}{\\partial\\dot x_i} = m_1\\dot x_i$$") == "M");  // not of m_2
}

TEST_CASE("readings: a question and a condition claim nothing") {
    CHECK(statuses(two_masses, "Does $m\\ddot x_1 = k x_2$ hold for small amplitudes only?") == "-");
    CHECK(statuses(two_masses, "I get $m\\ddot x_1 = k x_2$. Is that right?") == "M");
    CHECK(statuses(two_masses, "Newton: $$m\\ddot x_1 = F$$ $F = 0$ gives the place of rest.").back() == '-');
}

TEST_CASE("readings: {\\rm sen}, \\eqno and numbers behind the lines of a formula that goes on") {
    const std::string pendulum =
        "[parameters]\nm = 2\nl = 1\ng = 9.81\n[coordinates]\ntheta = 0.3\n[energy]\nkinetic = "
        "\"m*l^2*theta'^2/2\"\npotential = \"-m*g*l*cos(theta)\"\n";
    CHECK(statuses(pendulum, "$$l\\ddot\\theta + g\\,{\\rm sen}\\,\\theta = 0 \\eqno(7)$$") == "R");
    CHECK(statuses(pendulum, "$$l\\ddot\\theta - g\\,{\\rm sen}\\,\\theta = 0 \\eqno(7)$$") == "M");
    const std::string chain =
        "   L = T - V      (4)\n     = 1/2 m l^2 theta'^2 + m g l cos(theta)   (5)\n     = m l ( l theta'^2/2 ";
    CHECK(statuses(pendulum, chain + "+ g cos(theta) )   (6)\n", "page.txt") == "RRR");
    CHECK(statuses(pendulum, chain + "- g cos(theta) )   (6)\n", "page.txt") == "RRM");
}

TEST_CASE("readings: a wrong definition is the mistake where one change of it explains a later line") {
    const std::string bar =
        "[parameters]\nm = 2\nl = 0.8\na = 0.3\nk = 400\ng = 9.81\nd0 = 0.1\n[coordinates]\ntheta = "
        "0.1\n[energy]\nkinetic = \"m*l^2*theta'^2/6\"\npotential = \"-m*g*l/2*sin(theta) + k*(d0 + "
        "a*sin(theta))^2/2\"\n";
    const auto with = [&](const std::string& arm) {
        return statuses(bar,
                        "The spring is stretched by $$\\delta = d_0 + " + arm +
                            "\\sin\\theta.$$ Hence $$V = -\\frac12 m g l\\sin\\theta + \\frac12 k\\delta^2.$$");
    };
    CHECK(with("a") == "DR");
    CHECK(with("l") == "MF");
}

TEST_CASE("readings: an approximation of an energy that is wrong at an order that is written") {
    const std::string two =
        "[parameters]\nm = 2\nl = 0.8\ng = 9.81\n[coordinates]\na = 0.1\nb = 0.2\n[energy]\nkinetic = "
        "\"m*l^2*(a'^2 + b'^2)/2\"\npotential = \"-m*g*l*(2*cos(a) + cos(b))\"\n";
    const std::string line = "For small angles $$V \\approx -3 m g l + \\tfrac12 m g l";
    CHECK(statuses(two, line + "(2 a^2 + b^2)$$") == "R");
    CHECK(statuses(two, line + "(a^2 + b^2)$$") == "M");
    CHECK(statuses(two, "For small angles $$V \\approx \\tfrac12 m g l(2 a^2 + b^2)$$") == "R");
}

TEST_CASE("readings: second derivatives of effective potentials, at a place too") {
    const std::string puck =
        "[parameters]\nm = 1\nM = 2\ng = 9.81\n[coordinates]\nr = 1\ntheta = { initial = 0, rate = 3 "
        "}\n[energy]\nkinetic = \"(m + M)*r'^2/2 + m*r^2*theta'^2/2\"\npotential = \"M*g*r\"\n";
    const std::string words =
        "With $\\dot\\theta = p/(m r^2)$ the effective potential is $$U(r) = \\frac{p^2}{2 m r^2} + M g r.$$ Then "
        "$$";
    for (const std::string side : {"\\frac{d^2U}{dr^2} = ", "U''(r) = "}) {
        CHECK(statuses(puck, words + side + "\\frac{3p^2}{m r^4}$$") == "DDR");
        CHECK(statuses(puck, words + side + "\\frac{2p^2}{m r^4}$$") == "DDM");
    }
    CHECK(statuses(puck, words + "U''(r_0) = \\frac{3p^2}{m r_0^4}$$") == "DDR");
    CHECK(statuses(puck, words + "U''(r_0) = \\frac{2p^2}{m r_0^4}$$").back() != 'R');
}

TEST_CASE("readings: the centre that moves on a circle is no special motion") {
    CHECK(statuses(two_masses, "The centre moves on a circle of radius $a$. $$m\\ddot x_1 = k x_2$$").back() ==
          'M');
}

TEST_CASE("readings: what is wrong by a constant, and conditions on parameters") {
    const std::string puck =
        "[parameters]\nm = 1\nM = 2\ng = 9.81\n[coordinates]\nr = 1\ntheta = { initial = 0, rate = 3 "
        "}\n[energy]\nkinetic = \"(m + M)*r'^2/2 + m*r^2*theta'^2/2\"\npotential = \"M*g*r\"\n";
    CHECK(statuses(puck, "$$\\frac{\\partial L}{\\partial r} = m r\\dot\\theta^2 + M g$$") == "M");
    CHECK(statuses(puck, "$$\\frac{\\partial L}{\\partial r} = m r\\dot\\theta^2 - M g$$") == "R");
    const std::string frequencies =
        "Small vibrations. The uncoupled case is $k_f a = k_r b$: $$\\omega_z = \\sqrt{\\frac{k_f + k_r}";
    CHECK(statuses(half_car, frequencies + "m}$$").back() == 'R');
    CHECK(statuses(half_car, frequencies + "{2m}}$$").back() != 'R');
}

TEST_CASE("readings: a wrong moment of inertia that the energy of a turning part shows") {
    const std::string rolling =
        "gravity = [0, \"-g\"]\n[parameters]\nm = 5\nr = 0.15\ng = 9.81\n[coordinates]\nx = 0\nphi = "
        "0\n[[frame]]\nname = \"W\"\nrotate = [[\"z\", \"-phi\"]]\n[[body]]\nname = \"wheel\"\nmass = "
        "\"m\"\ninertia = \"m*r^2/2\"\nframe = \"W\"\nposition = [\"x\", \"r\"]\n";
    const auto with = [&](const std::string& inertia) {
        return statuses(rolling, "With $I = " + inertia + " m r^2$ $$T_{rot} = \\tfrac12 I\\dot\\varphi^2$$");
    };
    CHECK(with("\\tfrac12") == "DR");
    CHECK(with("\\tfrac25") == "MF");
}

TEST_CASE("readings: what only looks like a condition, a question, a number of an equation or a running index") {
    const std::string ep =
        "[parameters]\nm = 1\nk = 20\nl0 = 1\ng = 9.81\n[coordinates]\nr = 1\ntheta = 0.2\n[energy]\nkinetic = "
        "\"m*(r'^2 + r^2*theta'^2)/2\"\npotential = \"k*(r - l0)^2/2 - m*g*r*cos(theta)\"\n";
    const std::string still = "m\\ddot r + k(r-l_0) - m g\\cos\\theta = 0$";
    CHECK(statuses(ep, "Since $\\dot\\theta \\ne 0$, $" + still + ".").back() != 'R');
    CHECK(statuses(ep, "We do not assume $\\dot\\theta = 0$. Then $" + still + ".").back() != 'R');
    CHECK(statuses(ep, "Setting $\\dot\\theta = 0$: $$r\\ddot\\theta + g\\sin\\theta = 0$$ $$" + still + "$")
              .back() != 'M');
    CHECK(statuses(
              ep,
              "The equation $m\\ddot r - m r\\dot\\theta^2 - k(r-l_0) - m g\\cos\\theta = 0$ gives the length.") ==
          "M");
    CHECK(statuses(ep, "$$p_\\theta = \\tfrac12 m r\\dot\\theta (2 r)$$") == "R");
    CHECK(statuses(ep, "We do get $p_\\theta = m r\\dot\\theta$, don't we?") == "M");
    CHECK(statuses(two_masses, "$$T = \\frac12 m_i\\dot x_i^2$$").find('M') == std::string::npos);
}

}  // namespace derivation_readings
