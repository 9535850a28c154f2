// SPDX-License-Identifier: MIT
// What textbooks say of their examples is proved (check_claims.cpp); here a typical slip in each of them is
// refuted and called by its name. And what the program itself prints of a scene, by whatever formalism, is proved.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <set>

#include "algebra/notation/text.hpp"
#include "analysis/derive/derive.hpp"
#include "check/check.hpp"
#include "scene/claims_file.hpp"
#include "scenes.hpp"

namespace check_textbook {

using namespace alembert;

namespace {

struct WrongClaim {
    std::string scene, claims;  ///< a file of claims: one equation, after "rest" or "impact" on a line of its own
    std::string slip;
};

// In the order of the alphabet.
const WrongClaim wrong_claims[] = {
    {"bar_in_guides", "m*b^2/12*theta'' + k*b^2*sin(theta)*cos(theta) - m*g*b/2*sin(theta) = 0", "factor"},
    {"bead_on_parabola", "r''*(1 + 4*c^2*r^2) + r'*4*c^2*r + r*(2*g*c - omega^2) = 0", "lost_dot"},
    {"bead_on_turning_circle", "theta'' - Omega^2*sin(theta) = 0", "sign"},
    {"beam_two_modes", "(rho*L/5 + M)*q1'' + (rho*L/6 + M)*q2'' + EI/L^3*(4*q1 + 12*q2) = P", "factor"},
    {"beam_with_moving_load", "(mu*L/2 + M*s^2)*q'' + M*s*s'*q' + (pi^4*EI/(2*L^3) + M*s*s'')*q = M*g*s",
     "factor"},
    {"belt_drive", "J2*theta2'' + 2*k*r2*(r1*theta1 - r2*theta2) = 0", "sign"},
    {"bifilar_suspension", "z*theta'' = 3*(z'' + g)*cos(theta)", "swapped_trig"},
    {"block_on_wedge", "s'' + X''*sin(alpha) = g*sin(alpha)", "swapped_trig"},
    {"chain_hoist", "rest\nP = M*g*(R - r)/R", "factor"},
    {"charged_pendulum", "((m*phi' + q*B)*sin(theta)^2)' = 0", "factor"},
    {"condenser_microphone", "L*q'' + R*q' + q*(d + x)/a = E", "sign"},
    {"coupled_pendulums", "m*l^2*theta1'' + m*g*l*sin(theta1) + k*h^2*(sin(theta2) - sin(theta1))*cos(theta1) = 0",
     "sign"},
    {"cycloidal_pendulum", "2*a*(1 + cos(phi))*phi'' - a*phi'^2*cos(phi) + g*sin(phi) = 0", "swapped_trig"},
    {"cylinder_in_cylinder", "(R-a)*phi'' + 2*g*sin(phi) = 0", "factor"},
    {"cylinder_in_rolling_cylinder", "m*r*chi'' = F", "factor"},
    {"cylinder_on_wedge", "m*r*phi'' = -F", "factor"},
    {"double_rods_with_springs",
     "m*l^2*(alpha''/2*cos(beta - alpha) + beta''/12 + alpha'^2/2*sin(beta - alpha)) + m*g*l/2*sin(beta) + "
     "k2*(beta - alpha) = 0",
     "factor"},
    {"dumbbell_satellite", "phi'' + (theta' + n)^2*sin(phi)*cos(phi) = 0", "missing_term"},
    {"eccentric_cylinder", "(m*(a^2 + R^2 - 2*a*R*cos(phi)) + J)*phi'' + m*a*R*phi'*sin(phi) + m*g*a*sin(phi) = 0",
     "lost_dot"},
    {"elliptic_trammel", "m1*x''*y + m2*(y'' + g)*x = 0", "sign"},
    {"epicyclic_train", "a*sun' = (a+b)*phi'", "factor"},
    {"falling_stick", "m*y'' = lambda_floor", "missing_term"},
    {"folded_chain", "(b - x)*x'' + x'^2/2 = g*(b - x)", "sign"},
    {"foucault_pendulum", "x'' + g/l*x = Omega*sin(lat)*y'", "factor"},
    {"gyroscopic_monorail",
     "(J + A*cos(beta)^2)*alpha'' - A*alpha'*beta'*sin(beta)*cos(beta) + C*(phi' + "
     "alpha'*sin(beta))*beta'*cos(beta) "
     "= (Wh + u*cos(beta))*sin(alpha)",
     "factor"},
    {"gyrostat", "(B+D)*w2' + (A + D - C)*w3*w1 + I*(w3 + sigma')*w1 = 0", "sign"},
    {"hinged_bars", "rest\nP*l*cos(theta/2) + m*g*l/2*sin(theta/2) = 0", "sign"},
    {"kepler_parabolic", "m*s*xi'' + m*xi*(xi'^2 - eta'^2) + m*eta*xi'*eta' + 4*k*xi/s^2 = 0", "factor"},
    {"ladder_with_string", "rest\nlambda_wall = k*(l*sin(phi) - d)", "swapped_trig"},
    {"motor_on_springs", "(M + m)*x'' + c*x' + k*x = m*e*(phi'^2*sin(phi) - phi''*sin(phi))", "swapped_trig"},
    {"pendulum_absorber", "l*theta'' + (l + R*cos(theta))*phi'' + R*phi'*sin(theta) = 0", "lost_dot"},
    {"rate_gyroscope",
     "A*theta'' + A*psi'^2*sin(theta)*cos(theta) - C*(phi' + psi'*sin(theta))*psi'*sin(theta) + c*theta' + "
     "k*theta = 0",
     "swapped_trig"},
    {"relativistic_kepler", "(m*r'/root)' = m*r*phi'/root - alpha/r^2", "lost_dot"},
    {"relativistic_oscillator", "(m*c^2/sqrt(1 - x'^2/c^2) - k*x^2/2)' = 0", "sign"},
    {"restricted_three_bodies", "x'' + 2*y' - x + (1 - mu)*(x + mu)/r1^3 + mu*(x - 1 + mu)/r2^3 = 0", "sign"},
    {"rising_plane", "r'' - omega^2*r = -g*cos(omega*t)", "swapped_trig"},
    {"rod_in_bowl", "rest\n2*r*cos(theta) = a*cos(theta)", "wrong_argument"},
    {"rotating_beam", "rho*L/5*q'' - 4*rho*L/15*phi'^2*q + 4*EI/L^3*q = 0", "sign"},
    {"seismograph", "m*z'' + c*z' + k*z = -m*y'", "lost_dot"},
    {"shortened_pendulum", "x*y'' - y*x'' - g*x = 0", "sign"},
    {"skate_on_slope", "(x'*cos(phi) + y'*sin(phi))' = g*sin(alpha)*sin(phi)", "swapped_trig"},
    {"sliding_chain", "2*l*x'' = g*x", "factor"},
    {"sphere_on_sphere", "2*lambda_contact*(R + r)^2 = m*g*y + m*(x'^2 + y'^2)", "sign"},
    {"spool", "m*x'' = P*sin(beta) + F", "swapped_trig"},
    {"stepped_drum", "J*theta'' = R*T1 + r*T2", "sign"},
    {"struck_rhombus", "impact\n4*m*(x' - x'(-)) = 2*P", "factor"},
    {"struck_rods_on_table", "impact\nalpha' = -9*P/(2*m*a)", "factor"},
    {"struck_slider_crank", "impact\nx' = a*alpha'", "sign"},
    {"swing_ride", "rest\ng*tan(theta) = Omega^2*l*sin(theta)", "missing_term"},
    {"towed_trailer", "(M+m)*x'' + m*l*phi''*sin(phi) = F + lambda_wheels*sin(phi)", "missing_term"},
    {"tractor_with_trailer", "l*psi' = v*cos(phi - psi)", "swapped_trig"},
    {"triatomic_molecule", "M*x2'' = k*(x3 - x2 + x1)", "factor"},
    {"two_centres", "(m*c^2*D*(u'^2 + v'^2)/2 - k1/(c*(cosh(u) - cos(v))) + k2/(c*(cosh(u) + cos(v))))' = 0",
     "sign"},
    {"vibration_absorber", "M*x1'' + K*x1 + k*x1 = P*sin(omega*t)", "missing_term"},
    {"wedge_with_two_blocks", "rest\nm2*cos(beta) = m1*sin(alpha)", "swapped_trig"},
    {"yo_yo", "(J + m*b^2)*theta'' = m*b*(g - h'')", "sign"},
};

Scene textbook(const std::string& name) {
    return read_scene(test::source_path("scenes/textbook/" + name + ".toml"));
}

/// What `derive` prints of a scene by a formalism, each equation once; nothing where it does not apply.
std::set<std::string> printed(const Scene& scene, const std::string& by) {
    std::set<std::string> result;
    try {
        const Derivation shown = derive(scene, {.by = by}).shown;
        for (const auto* equations : {&shown.equations, &shown.shares})
            for (const ReadableEquation& e : *equations) result.insert(text(e.lhs) + " = " + text(e.rhs));
        for (const auto& [rate, value] : shown.kinematics) result.insert(text(rate) + " = " + text(value));
    } catch (const ModelError&) {
    }
    return result;
}

/// z1 or u1, which `derive` gives to intermediate symbols and to speeds that it chooses.
bool holds_given_name(const std::string& equation) {
    static const std::regex name("(^|[^A-Za-z0-9_])[zu][0-9]");
    return std::regex_search(equation, name);
}

}  // namespace

TEST_CASE("check: a typical slip in each textbook example is refuted and named") {
    std::string last;
    for (const WrongClaim& wrong : wrong_claims) {
        CAPTURE(wrong.scene);
        CAPTURE(wrong.claims);
        CHECK(last < wrong.scene);
        last = wrong.scene;
        const CheckedScene result = check(with_claims(textbook(wrong.scene), wrong.claims, "wrong.txt"));
        REQUIRE(result.checked.claims.size() == 1);
        const CheckedClaim& c = result.checked.claims[0];
        CHECK(c.verdict == Verdict::refuted);
        CHECK((c.likely ? std::string(c.likely->kind) : "unknown") == wrong.slip);
    }
}

// With ALEMBERT_CLAIMS every formalism on every scene, otherwise each on every fourth. A name as z1 or u1 is
// another by each formalism; what holds none of them is asked at once.
TEST_CASE("check: the equations that each formalism prints of a textbook scene are proved") {
    const std::size_t stride = std::getenv("ALEMBERT_CLAIMS") != nullptr ? 1 : 4;
    std::size_t claims = 0, scenes = 0;
    const auto ask = [&](const Scene& scene, const std::set<std::string>& equations, const std::string& by) {
        CAPTURE(by);
        if (equations.empty()) return;
        std::string lines;
        for (const std::string& equation : equations) lines += equation + "\n";
        const Scene asked = with_claims(scene, lines, "printed.txt");
        const CheckedScene result = check(asked, by);
        for (std::size_t k = 0; k < asked.claims.size(); ++k) {
            const std::string equation = text_of(asked.claims[k].equation);
            CAPTURE(equation);
            CAPTURE(result.checked.claims[k].reason);
            CHECK(result.checked.claims[k].verdict == Verdict::proved);
        }
        claims += asked.claims.size();
    };
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 2)) {
        CAPTURE(file);
        const Scene scene = read_scene(file);
        std::set<std::string> plain;
        for (std::size_t k = scenes++ % stride; k < formalisms().size(); k += stride) {
            std::set<std::string> own;
            for (const std::string& equation : printed(scene, formalisms()[k].name))
                (holds_given_name(equation) ? own : plain).insert(equation);
            ask(scene, own, formalisms()[k].name);
        }
        ask(scene, plain, {});
    }
    CHECK(claims >= test::at_least(100));
}

}  // namespace check_textbook
