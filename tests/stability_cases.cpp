// SPDX-License-Identifier: MIT
// Verdicts of stability for cases with known answers, each with the theorem that has to decide it. "critical"
// means that the first approximation does not decide, or a boundary of stability.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "alembert/base/error.hpp"
#include "scenes.hpp"
#include "stability/stability.hpp"

namespace stability_cases {

using namespace alembert;

namespace {

using V = StabilityVerdict;
using T = StabilityTheorem;

Stability judged(const Scene& scene, const std::vector<std::string>& at) {
    StabilityOptions options;
    for (const std::string& item : at) {
        const std::string name = item.substr(0, item.find('=')), number = item.substr(item.find('=') + 1);
        options.at.emplace_back(name, std::stod(number));
        options.exact_at.emplace_back(name, number);
    }
    return stability(scene, options);
}

Stability judged(const std::string& text, const std::vector<std::string>& at = {}) {
    return judged(parse_scene(text, "case.toml"), at);
}

struct Case {
    std::string name, text;
    std::vector<std::string> at;
    V verdict;
    T theorem;
    bool critical = false;
};

void check(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        CAPTURE(c.name);
        std::string at;
        for (const std::string& item : c.at) at += item + " ";
        CAPTURE(at);
        Stability s;
        try {
            s = judged(c.text, c.at);
        } catch (const std::exception& e) {
            CHECK_MESSAGE(false, e.what());
            continue;
        }
        CAPTURE(s.reason);
        CHECK(std::string(name_of(s.verdict)) == name_of(c.verdict));
        CHECK(std::string(name_of(s.theorem)) == name_of(c.theorem));
    }
}

/// Of scenes/stability.
std::string text_of(const std::string& name) {
    std::ifstream file(test::source_path("scenes/stability/" + name + ".toml"));
    return {std::istreambuf_iterator<char>(file), {}};
}
void replace(std::string& text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
}

/// Coordinates at rest at 0 by their energy and forces.
std::string by_energy(const std::string& coordinates, const std::string& energy, const std::string& more = "") {
    std::string text = "[coordinates]\n";
    for (std::size_t k = 0; k < coordinates.size(); ++k) text += std::string(1, coordinates[k]) + " = 0\n";
    return text + "[energy]\n" + energy + "\n" + more;
}
std::string one(const std::string& potential, const std::string& more = "") {
    return by_energy("x", "kinetic = \"x'^2/2\"\npotential = \"" + potential + "\"", more);
}
std::string two(const std::string& potential, const std::string& more = "") {
    return by_energy("xy", "kinetic = \"(x'^2 + y'^2)/2\"\npotential = \"" + potential + "\"", more);
}
std::string gyroscopic(const std::string& potential, const std::string& more = "") {
    return "[parameters]\nG = 3\n" +
           by_energy("xy", "lagrangian = \"(x'^2 + y'^2)/2 + G*(x*y' - y*x')/2 - (" + potential + ")\"", more);
}
std::string forces(const std::string& x, const std::string& y = "") {
    return "[forces]\nx = \"" + x + "\"\n" + (y.empty() ? "" : "y = \"" + y + "\"\n");
}
std::string rayleigh(const std::string& R) {
    return "[dissipation]\nrayleigh = \"" + R + "\"\n";
}

}  // namespace

TEST_CASE("stability: one degree of freedom is judged by its potential, its damping, or terms of higher degree") {
    check({
        {"an oscillator", one("x^2/2"), {}, V::stable, T::jordan},
        {"a saddle", one("-x^2/2"), {}, V::unstable, T::hurwitz},
        {"a hardening spring", one("x^2/2 + x^4"), {}, V::stable, T::lagrange_dirichlet},
        {"a damped oscillator",
         one("x^2/2 + x^4", rayleigh("x'^2/2")),
         {},
         V::asymptotically_stable,
         T::kelvin_chetaev},
        {"a damped saddle", one("x^4 - x^2/2", rayleigh("x'^2/2")), {}, V::unstable, T::kelvin_odd},
        {"a particle that is free", one("0"), {}, V::stable, T::routh, true},
        {"V = x^4", one("x^4"), {}, V::stable, T::potential_form, true},
        {"V = -x^4", one("-x^4"), {}, V::unstable, T::potential_form, true},
        {"V = x^3", one("x^3"), {}, V::unstable, T::potential_form, true},
        {"V = x^6 - x^7", one("x^6 - x^7"), {}, V::stable, T::potential_form, true},
        {"the force -x^3",
         by_energy("x", "kinetic = \"x'^2/2\"", forces("-x^3")),
         {},
         V::stable,
         T::potential_form,
         true},
        {"the force x^3",
         by_energy("x", "kinetic = \"x'^2/2\"", forces("x^3")),
         {},
         V::unstable,
         T::potential_form,
         true},
        {"damped V = x^4", one("x^4", rayleigh("x'^2/2")), {}, V::asymptotically_stable, T::one_zero_root, true},
        {"damped V = -x^4", one("-x^4", rayleigh("x'^2/2")), {}, V::unstable, T::one_zero_root, true},
        {"damped V = x^3", one("x^3", rayleigh("x'^2/2")), {}, V::unstable, T::one_zero_root, true},
        {"damped V = x^6", one("x^6", rayleigh("x'^2/2")), {}, V::asymptotically_stable, T::one_zero_root, true},
        {"cubic damping", one("x^2/2", rayleigh("x'^4/4")), {}, V::asymptotically_stable, T::pair_on_axis, true},
        {"cubic excitation", one("x^2/2", forces("x'^3")), {}, V::unstable, T::pair_on_axis, true},
        {"damping that grows with x",
         one("x^2/2", forces("-x^2*x'")),
         {},
         V::asymptotically_stable,
         T::pair_on_axis,
         true},
        {"excitation that grows with x", one("x^2/2", forces("x^2*x'")), {}, V::unstable, T::pair_on_axis, true},
        {"van der Pol", one("x^2/2", forces("(1 - x^2)*x'")), {}, V::unstable, T::first_approximation},
        {"van der Pol backwards",
         one("x^2/2", forces("-(1 - x^2)*x'")),
         {},
         V::asymptotically_stable,
         T::kelvin_chetaev},
        {"damping of fifth order", one("x^2/2", rayleigh("x'^6/6")), {}, V::stable, T::lagrange_dirichlet, true},
        {"quintic damping of a quartic spring",
         one("x^4", rayleigh("x'^6/6")),
         {},
         V::stable,
         T::potential_form,
         true},
        {"a flat potential", one("exp(-1/(x^2 + 1e-9)) - exp(-1e9) + 0*x"), {}, V::undecided, T::none, true},
    });
}

TEST_CASE("stability: two degrees of freedom, gyroscopic, circulatory and degenerate") {
    check({
        {"a Jordan block on the axis",
         by_energy("xy", "kinetic = \"(x'^2 + y'^2)/2\"", forces("y - x", "-y")),
         {},
         V::unstable,
         T::jordan,
         true},
        {"equal frequencies without coupling", two("(x^2 + y^2)/2"), {}, V::stable, T::jordan, true},
        {"gyroscopic stabilization", gyroscopic("-(x^2 + y^2)/2"), {}, V::stable, T::jordan},
        {"too little of it", gyroscopic("-(x^2 + y^2)/2"), {"G=1"}, V::unstable, T::hurwitz},
        {"just not enough", gyroscopic("-(x^2 + y^2)/2"), {"G=2"}, V::unstable, T::jordan, true},
        {"destroyed by damping",
         gyroscopic("-(x^2 + y^2)/2", rayleigh("(x'^2 + y'^2)/100")),
         {},
         V::unstable,
         T::kelvin_chetaev},
        {"an odd number of unstable degrees", gyroscopic("(x^2 - y^2)/2"), {"G=50"}, V::unstable, T::kelvin_odd},
        {"gyroscopic stabilization, nonlinear",
         gyroscopic("-(x^2 + y^2)/2 + x^4"),
         {},
         V::stable,
         T::arnold,
         true},
        {"at the boundary, nonlinear", gyroscopic("-(x^2 + y^2)/2 + x^4"), {"G=2"}, V::undecided, T::none, true},
        {"circulatory forces below flutter",
         by_energy("xy", "kinetic = \"(x'^2 + y'^2)/2\"", forces("-x + y/2", "-3*y - x/2")),
         {},
         V::stable,
         T::jordan},
        {"circulatory forces at flutter",
         by_energy("xy", "kinetic = \"(x'^2 + y'^2)/2\"", forces("-x + y", "-3*y - x")),
         {},
         V::unstable,
         T::jordan,
         true},
        {"circulatory forces beyond flutter",
         by_energy("xy", "kinetic = \"(x'^2 + y'^2)/2\"", forces("-x + 2*y", "-3*y - 2*x")),
         {},
         V::unstable,
         T::hurwitz},
        {"circulatory forces on equal springs",
         by_energy("xy", "kinetic = \"(x'^2 + y'^2)/2\"", forces("-x + y/100", "-y - x/100")),
         {},
         V::unstable,
         T::hurwitz},
        {"pervasive damping of one of two",
         two("(x^2 + (x - y)^2)/2 + x^4", rayleigh("y'^2/2")),
         {},
         V::asymptotically_stable,
         T::kelvin_chetaev},
        {"damping that is not pervasive",
         two("(x^2 + y^2)/2 + x^4", rayleigh("y'^2/2")),
         {},
         V::stable,
         T::lagrange_dirichlet,
         true},
        {"damping of a difference",
         two("(x^2 + y^2)/2", rayleigh("(x' - y')^2/2")),
         {},
         V::stable,
         T::jordan,
         true},
        {"a degenerate valley that rises", two("(x - y)^2/2 + x^4"), {}, V::stable, T::potential_form, true},
        {"a curved valley that falls", two("(y - x^2)^2/2 - x^6"), {}, V::unstable, T::potential_form, true},
        {"a curved valley that rises", two("(y - x^2)^2/2 + x^6"), {}, V::stable, T::potential_form, true},
        {"a valley that coupling bends down", two("y^2/2 + y*x^2"), {}, V::unstable, T::potential_form, true},
        {"the same, damped",
         two("y^2/2 + y*x^2", rayleigh("(x'^2 + y'^2)/2")),
         {},
         V::unstable,
         T::one_zero_root,
         true},
        {"x^4 + y^4", two("x^4 + y^4"), {}, V::stable, T::potential_form, true},
        {"a quartic form that is negative somewhere",
         two("x^4 - 3*x^2*y^2 + y^4"),
         {},
         V::unstable,
         T::potential_form,
         true},
        {"a cubic form", two("x^3 + x*y^2"), {}, V::unstable, T::potential_form, true},
        {"x^2*y^2, of which nothing here decides", two("x^2*y^2"), {}, V::undecided, T::none, true},
    });
}

TEST_CASE("stability: pendulums at all their equilibria") {
    const auto pendulum = [](int links, const std::string& more) {
        std::string text = "gravity = [0, \"-g\"]\n[parameters]\ng = 9.81\nl = 1\nm = 1\n[coordinates]\n";
        for (int k = 1; k <= links; ++k) text += "q" + std::to_string(k) + " = 0\n";
        for (int k = 1; k <= links; ++k) {
            const std::string n = std::to_string(k);
            text += "[[particle]]\nname = \"P" + n + "\"\nmass = \"m\"\n" +
                    (k > 1 ? "from = \"P" + std::to_string(k - 1) + "\"\n" : "") + "position = [\"l*sin(q" + n +
                    ")\", \"-l*cos(q" + n + ")\"]\n";
        }
        return text + more;
    };
    const std::string pi = "3.14159265358979323846264338327950288";
    const std::string damper = rayleigh("q1'^2/10");
    check({
        {"one hangs", pendulum(1, ""), {}, V::stable, T::lagrange_dirichlet},
        {"one stands", pendulum(1, ""), {"q1=" + pi}, V::unstable, T::first_approximation},
        {"one hangs, damped", pendulum(1, damper), {}, V::asymptotically_stable, T::kelvin_chetaev},
        {"two hang", pendulum(2, ""), {}, V::stable, T::lagrange_dirichlet},
        {"the lower of two stands", pendulum(2, ""), {"q2=" + pi}, V::unstable, T::first_approximation},
        {"the upper of two stands", pendulum(2, ""), {"q1=" + pi}, V::unstable, T::first_approximation},
        {"both stand", pendulum(2, ""), {"q1=" + pi, "q2=" + pi}, V::unstable, T::first_approximation},
        {"two hang, one damped", pendulum(2, damper), {}, V::asymptotically_stable, T::kelvin_chetaev},
        {"three hang", pendulum(3, ""), {}, V::stable, T::lagrange_dirichlet},
        {"three stand",
         pendulum(3, ""),
         {"q1=" + pi, "q2=" + pi, "q3=" + pi},
         V::unstable,
         T::first_approximation},
    });
}

TEST_CASE("stability: steady motions by Jacobi's integral, momenta and angular momenta") {
    const std::string hoop = text_of("hoop");
    std::string tilted = hoop;
    replace(tilted, "initial = 0", "initial = \"acos(1/c^2)\"");
    const std::string top = text_of("sleeping_top");
    const std::string conical = R"toml(
gravity = [0, 0, "-g"]
[parameters]
g = 9.81
l = 1
alpha = 1
[coordinates]
theta = "alpha"
phi = { initial = 0, rate = "sqrt(g/(l*cos(alpha)))" }
[[particle]]
name = "bob"
mass = 1
position = ["l*sin(theta)*cos(phi)", "l*sin(theta)*sin(phi)", "-l*cos(theta)"]
)toml";
    const auto body = [](const char* w1, const char* w2, const char* w3) {
        return std::string(
                   "[parameters]\nI1 = 1\nI2 = 2\nI3 = 2.5\n[coordinates]\npsi = 0.1\ntheta = 0.9\nphi = "
                   "0.2\n[speeds]\n") +
               "w1 = { form = \"dot(omega(B), ex(B))\", initial = " + w1 + " }\n" +
               "w2 = { form = \"dot(omega(B), ey(B))\", initial = " + w2 + " }\n" +
               "w3 = { form = \"dot(omega(B), ez(B))\", initial = " + w3 + " }\n" +
               "[[frame]]\nname = \"F\"\nrotate = [[\"z\", \"psi\"], [\"x\", \"theta\"], [\"z\", \"phi\"]]\n" +
               "[[body]]\nname = \"B\"\nmass = 1\nframe = \"F\"\ninertia = [\"I1\", \"I2\", \"I3\"]\nposition = "
               "[0, 0]\n";
    };
    const std::string moon = text_of("triangular_point");
    std::string routh = moon;
    replace(routh, "value = 0.01", "value = \"(1 - sqrt(23/27))/2\"");
    check({
        {"bead at the bottom of a slow hoop", hoop, {"c=0.9"}, V::stable, T::jacobi},
        {"bead at the bottom at the pitchfork", hoop, {"c=1"}, V::stable, T::potential_form, true},
        {"bead at the bottom of a fast hoop", hoop, {"c=1.1"}, V::unstable, T::first_approximation},
        {"bead at the top",
         hoop,
         {"c=1.1", "theta=3.14159265358979323846264338327950288"},
         V::unstable,
         T::first_approximation},
        {"bead aside on a fast hoop", tilted, {"c=1.1"}, V::stable, T::jacobi},
        {"sleeping top, fast", top, {}, V::stable, T::chetaev_integrals, true},
        {"sleeping top, just fast enough", top, {"psi'=4.001"}, V::stable, T::chetaev_integrals, true},
        {"sleeping top, just too slow", top, {"psi'=3.999"}, V::unstable, T::first_approximation},
        {"conical pendulum", conical, {}, V::stable, T::routh, true},
        {"free body about its shortest axis", body("0", "0", "2"), {}, V::stable, T::chetaev_integrals, true},
        {"free body about its longest axis", body("2", "0", "0"), {}, V::stable, T::chetaev_integrals, true},
        {"free body about its middle axis", body("0", "2", "0"), {}, V::unstable, T::first_approximation},
        {"triangular point, mass ratio 0.01", moon, {}, V::stable, T::arnold, true},
        {"triangular point, mass ratio 0.03", moon, {"mu=0.03"}, V::stable, T::arnold, true},
        {"triangular point, mass ratio 0.039", moon, {"mu=0.039"}, V::unstable, T::first_approximation},
        {"triangular point at Routh's ratio", routh, {}, V::undecided, T::none, true},
    });
}

TEST_CASE("stability: terms of high degree and coefficients that cancel are not taken for nothing") {
    const auto bead = [](const std::string& wire, const std::string& more = "") {
        return "gravity = [0, -9.81]\n[coordinates]\nx = 0\ny = 0\n[[particle]]\nname = \"P\"\nmass = 1\nposition "
               "= "
               "[\"x\", \"y\"]\n[[constraint]]\nname = \"wire\"\nholonomic = \"y - (" +
               wire + ")\"\n" + more;
    };
    const std::string damper = rayleigh("x'^2/2");
    check({
        {"a zero root, degree 19", one("0*x", forces("x^19 - x'")), {}, V::unstable, T::one_zero_root, true},
        {"a zero root, tiny", one("0*x", forces("1e-20*x^3 - x'")), {}, V::unstable, T::one_zero_root, true},
        // 3 x² x' − x'³ does no work over a turn: the first Lyapunov coefficient is zero.
        {"work that cancels", one("x^2/2", forces("3*x^2*x' - x'^3 + x'^5")), {}, V::undecided, T::none, true},
        // The states at rest are the two axes, and no plane of them.
        {"two zero roots", two("0*x", forces("x*y - x'", "x*y - y'")), {}, V::undecided, T::none, true},
        {"a circle of states at rest",
         two("(x^2 + y^2 - 1)^2", rayleigh("(x'^2 + y'^2)/2")),
         {"x=1"},
         V::stable,
         T::malkin,
         true},
        {"a flat hill", bead("-x^20", damper), {}, V::unstable, T::one_zero_root, true},
        {"a hill that is nearly flat", bead("-1e-12*x^10", damper), {}, V::unstable, T::one_zero_root, true},
        {"a flat valley", bead("x^20", damper), {}, V::asymptotically_stable, T::one_zero_root, true},
        {"damping up and down alone",
         bead("x^2", rayleigh("y'^2/2")),
         {},
         V::asymptotically_stable,
         T::pair_on_axis,
         true},
    });
}

TEST_CASE("stability: rolling bodies of revolution, as long as their motion can be reversed") {
    const auto disc = [](const std::string& more) { return text_of("rolling_disc") + more; };
    check({
        {"a disc", disc(""), {}, V::stable, T::reversible, true},
        {"a ring", disc(""), {"A=0.125", "C=0.25", "w=2.3"}, V::stable, T::reversible, true},
        {"a ring, too slow", disc(""), {"A=0.125", "C=0.25", "w=2.2"}, V::unstable, T::first_approximation},
        // What drives it while it leans: the first approximation is the same, and the motion grows.
        {"a disc that is driven", disc("[forces]\ntheta = \"theta'^3/50\"\n"), {}, V::undecided, T::none, true},
        {"a disc that is braked", disc("[forces]\ntheta = \"-theta'^3/50\"\n"), {}, V::undecided, T::none, true},
        {"a force of position", disc("[forces]\ntheta = \"-theta^3/50\"\n"), {}, V::stable, T::reversible, true},
        {"a damped lean", disc("[forces]\ntheta = \"-theta'/50\"\n"), {}, V::stable, T::malkin, true},
        {"a driven lean", disc("[forces]\ntheta = \"theta'/50\"\n"), {}, V::unstable, T::first_approximation},
    });
}

// Where a constraint gives a rate that depends on the coordinate itself, x' = x, nothing else need depend on it.
TEST_CASE("stability: coordinates that constraints drive by themselves are no cyclic ones") {
    const auto servo = [](const std::string& constraints, const std::string& more = "") {
        std::string text =
            "coordinates = { x = 0, y = 0, z = 0 }\n[energy]\nkinetic = \"(x'^2 + y'^2 + z'^2)/2\"\n"
            "potential = \"z^2/2\"\n" +
            more;
        std::size_t from = 0;
        for (int k = 0; from < constraints.size(); ++k) {
            const std::size_t to = std::min(constraints.find(';', from), constraints.size());
            text += "[[constraint]]\nname = \"c" + std::to_string(k) + "\"\nnonholonomic = \"" +
                    constraints.substr(from, to - from) + "\"\n";
            from = to + 1;
        }
        return text;
    };
    const std::string damped = "[forces]\nz = \"-z'\"\n";
    check({{"x' = x", servo("x' = x;y' = 0"), {}, V::unstable, T::first_approximation},
           {"x' = -x", servo("x' = -x;y' = -2*y", damped), {}, V::asymptotically_stable, T::first_approximation},
           {"x' = x²", servo("x' = x^2;y' = -y", damped), {}, V::unstable, T::one_zero_root, true},
           {"a saddle of two", servo("x' = -y;y' = -x"), {}, V::unstable, T::first_approximation},
           {"a node of two",
            servo("x' = -x - y;y' = x - y", damped),
            {},
            V::asymptotically_stable,
            T::first_approximation},
           {"a rate of both", servo("x' + y' = x - y;x' - y' = x + y"), {}, V::unstable, T::first_approximation}});
    const std::string alone =
        "coordinates = { x = 0 }\n[energy]\nkinetic = \"x'^2/2\"\n"
        "[[constraint]]\nname = \"c\"\nnonholonomic = \"x' = x\"\n";
    const Stability judged_by_V = stability(parse_scene(alone, "s.toml"), {.lyapunov = "x^2"});
    CHECK(judged_by_V.verdict == V::unstable);
    CHECK(judged_by_V.theorem == T::lyapunov_instability);
    CHECK(judged_by_V.lyapunov);
}

TEST_CASE("stability: polynomials without a mechanism") {
    const auto polynomial = [](const std::string& list) {
        return "[polynomial]\ncoefficients = [" + list + "]\n";
    };
    check({
        {"s^3 + 6 s^2 + 11 s + 6", polynomial("1, 6, 11, 6"), {}, V::asymptotically_stable, T::hurwitz},
        {"s^3 + s^2 + s + 1", polynomial("1, 1, 1, 1"), {}, V::stable, T::jordan, true},
        {"s^3 + s^2 + s + 1.000001", polynomial("1, 1, 1, 1.000001"), {}, V::unstable, T::hurwitz},
        {"(s^2 + 1)^2", polynomial("1, 0, 2, 0, 1"), {}, V::unstable, T::jordan, true},
        {"(s^2 + 2)(s + 1)^2", polynomial("1, 2, 3, 4, 2"), {}, V::stable, T::jordan, true},
        {"(s^2 + 1)(s^2 + 1 + 1e-12)",
         polynomial("1, 0, 2.000000000001, 0, 1.000000000001"),
         {},
         V::stable,
         T::jordan,
         true},
        {"s (s + 1)", polynomial("1, 1, 0"), {}, V::stable, T::jordan, true},
        {"s^2", polynomial("1, 0, 0"), {}, V::unstable, T::jordan, true},
        {"s^2 - 2", polynomial("1, 0, -2"), {}, V::unstable, T::hurwitz},
        {"-s - 1", polynomial("-1, -1"), {}, V::asymptotically_stable, T::hurwitz},
    });
}

TEST_CASE("stability: Whipple's bicycle between its weave and capsize speeds") {
    const Scene scene = read_scene(test::source_path("scenes/gallery/bicycle.toml"));
    for (const auto& [speed, verdict] :
         {std::pair("4", V::unstable), std::pair("5", V::stable), std::pair("7", V::unstable)}) {
        const Stability s = judged(scene, {std::string("v=") + speed, "kick=0"});
        CAPTURE(speed);
        CAPTURE(s.reason);
        CHECK(std::string(name_of(s.verdict)) == name_of(verdict));
        CHECK(s.theorem == (verdict == V::stable ? T::malkin : T::first_approximation));
    }
}

}  // namespace stability_cases
