// SPDX-License-Identifier: MIT
// Derivations as people write them, with the status that each line deserves: letters of the author's own, guesses
// that nothing bears out, products without blanks, values at one moment, conditions, functions of momenta, words
// in three languages. Right lines must not be mistakes under one reading of several, and wrong ones must not pass.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/derivation/marked.hpp"
#include "scene/scene.hpp"

namespace derivation_readings {

using namespace alembert;

namespace {

const char* const pendulum = R"toml(
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

const char* const hoop = R"toml(
gravity = [0, 0, "-g"]
[parameters]
m = 0.2
R = 0.5
Omega = 6
g = 9.81
[coordinates]
theta = 0.3
[[particle]]
name = "bead"
mass = "m"
position = ["R*sin(theta)*cos(Omega*t)", "R*sin(theta)*sin(Omega*t)", "-R*cos(theta)"]
)toml";

const char* const spherical = R"toml(
gravity = [0, 0, "-g"]
[parameters]
m = 1
l = 1
g = 9.81
[coordinates]
theta = 0.4
phi = { initial = 0, rate = 1 }
[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)*cos(phi)", "l*sin(theta)*sin(phi)", "-l*cos(theta)"]
)toml";

const char* const spring = R"toml(
gravity = [0, "-g"]
[parameters]
m = 1
k = 30
l0 = 1
g = 9.81
[coordinates]
r = 1.2
theta = 0.3
[[particle]]
name = "bob"
mass = "m"
position = ["r*sin(theta)", "-r*cos(theta)"]
[[spring]]
between = ["O", "bob"]
stiffness = "k"
length = "l0"
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

/// One letter a line: R right, D definition, M mistake, F follows, U unfounded, and - for what is not judged.
std::string statuses(const char* scene, const std::string& text, const std::string& file = "test.md") {
    const Marked marked = mark(parse_scene(scene, "scene.toml"), read_derivation(text, file));
    std::string result;
    for (const MarkedLine& line : marked.lines) switch (line.status) {
            case LineStatus::right:
            case LineStatus::right_near:
            case LineStatus::right_up_to_constant:
            case LineStatus::right_up_to_derivative:
                result += 'R';
                break;
            case LineStatus::definition:
                result += 'D';
                break;
            case LineStatus::mistake:
                result += 'M';
                break;
            case LineStatus::follows:
                result += 'F';
                break;
            case LineStatus::unfounded:
                result += 'U';
                break;
            default:
                result += '-';
        }
    return result;
}

}  // namespace

TEST_CASE("readings: a letter that nothing bears out is not judged, and one that lines bear out is") {
    CHECK(statuses(pendulum, "$$m l^2\\ddot\\theta + G\\sin\\theta = 0$$") == "-");
    CHECK(statuses(pendulum, "$$\\ddot\\theta + \\omega_0^2\\sin\\theta = 0$$") == "-");
    CHECK(statuses(pendulum, "$$l\\ddot\\theta + M\\sin\\theta = 0$$") == "-");
    CHECK(statuses(pendulum,
                   "$$T = \\frac12 m L^2\\dot\\theta^2$$\n$$V = -m g L\\cos\\theta$$\n"
                   "$$L\\ddot\\theta + g\\cos\\theta = 0$$") != "RRR");
    CHECK(statuses(pendulum,
                   "$$T = \\frac12 m a^2\\dot\\varphi^2$$\n$$V = -m g a\\cos\\varphi$$\n"
                   "$$a\\ddot\\varphi - g\\sin\\varphi = 0$$") == "RRM");
}

TEST_CASE(
    "readings: what the author defines is his, and his wrong definitions are found by the lines that follow") {
    CHECK(statuses(pendulum, "With $v = \\dot\\theta$ we have $\\dot v = -\\frac{g}{l}\\sin\\theta$.") == "DR");
    CHECK(statuses(pendulum, "The angular momentum is $L = m l^2\\dot\\theta$.") == "D");
    CHECK(statuses(pendulum, "The angular momentum is $\\ell = m l^2\\dot\\theta$.") == "D");
    CHECK(statuses(spring, "Let $x = r - l_0$. Then $V = \\frac12 k x^2 - m g (l_0 + x)\\cos\\theta$.") == "DR");
    CHECK(statuses(spring, "Let $x = r - l_0$. Then $V = \\frac12 k x^2 + m g (l_0 + x)\\cos\\theta$.").back() !=
          'R');
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
    CHECK(statuses(hoop, "At equilibrium $\\theta=\\theta_0$: $$\\cos\\theta_0=\\frac{g}{R\\Omega^2}$$") == "--");
    CHECK(statuses(spherical, "For the conical pendulum $\\dot\\phi^2=\\frac{g}{l\\cos\\theta}$.") == "-");
    CHECK(statuses(pendulum, "$$l\\ddot\\theta - g\\sin\\theta = 0$$") == "M");
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

}  // namespace derivation_readings
