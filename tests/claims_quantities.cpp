// SPDX-License-Identifier: MIT
// Claims about the quantities of a derivation: T, V, L, E, H, momenta, generalized forces, partial derivatives.
#include <doctest/doctest.h>

#include "algebra/notation/text.hpp"
#include "analysis/derive/derive.hpp"
#include "checked.hpp"
#include "model/formulas.hpp"
#include "model/own_quantities.hpp"

namespace claims_quantities {

using namespace alembert;
using test::check_verdicts;
using test::checked;

constexpr const char* pendulum_scene = R"toml(
gravity = [0, "-g"]
[parameters]
m = 2
l = 0.5
g = 9.81
[coordinates]
theta = { initial = 0.4, rate = 0 }
[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)", "-l*cos(theta)"]
)toml";

Scene pendulum(const std::string& claims = {}) {
    Scene scene = parse_scene(pendulum_scene, "pendulum.toml");
    return claims.empty() ? scene : with_claims(std::move(scene), claims, "claims.txt");
}

/// The name by which claims call what a step of `derive` calls "gravity on particle M1".
std::string called(const std::string& label) {
    const auto after = [&](const std::string& prefix) {
        return label.starts_with(prefix) ? label.substr(prefix.size()) : std::string();
    };
    const auto first_word = [](const std::string& words) { return words.substr(0, words.find(' ')); };
    for (const auto& [prefix, name] : {std::pair("gravity on particle ", "gravity_"),
                                       {"gravity on body ", "gravity_"},
                                       {"particle ", ""},
                                       {"rotation of body ", "rotation_"},
                                       {"body ", "translation_"},
                                       {"spring ", "spring_"},
                                       {"damper ", "damper_"},
                                       {"force on ", "force_"},
                                       {"force ", "force_"},
                                       {"torque ", "torque_"},
                                       {"friction ", "friction_"},
                                       {"armature of ", "armature_"}})
        if (const std::string rest = after(prefix); !rest.empty()) return name + first_word(rest);
    if (label == "[dissipation]") return "dissipation";
    return "energy";
}

/// Every step of a derivation that gives a quantity, as a claim.
std::string steps_as_claims(const Derivation& shown) {
    std::string claims;
    const auto add = [&](const std::string& left, const Phrase& right) { claims += left + " = " + text(right) + "\n"; };
    const auto part = [](const Statement& s) { return "(" + called(s.of) + ")"; };
    for (const Statement& s : shown.energies) add(s.letter + part(s), s.value);
    if (shown.lagrangian) {
        add("L", *shown.lagrangian);
    } else {
        add("T", shown.kinetic);
        add("V", shown.potential);
        claims += "L = (" + text(shown.kinetic) + ") - (" + text(shown.potential) + ")\n";
        claims += "E = " + text(shown.kinetic) + " + " + text(shown.potential) + "\n";
    }
    for (const Statement& s : shown.forces)
        add("Q_" + text(*s.by) + (s.kind == Statement::Kind::work ? part(s) : ""), s.value);
    for (const Statement& s : shown.derivatives) add("diff(" + s.letter + ", " + text(*s.by) + ")", s.value);
    return claims;
}

TEST_CASE("claims: every energy, force and partial derivative that derive prints is proved") {
    int claims = 0;
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 0)) {
        CAPTURE(file);
        const Scene scene = read_scene(file);
        std::vector<Diagnostic> none;
        const NameSpaces names = declare(scene, none);
        const bool has_own = std::any_of(names.values.begin(), names.values.end(), [](const auto& named) {
            return std::string("TVLE").find(named.first) != std::string::npos;
        });
        if (has_own) continue;  // the scene's letter then means something else
        const Derivation shown = derive(scene).shown;
        if (!shown.definitions.empty()) continue;
        const std::string text = steps_as_claims(shown);
        const Scene claimed = with_claims(scene, text, "steps.txt");
        const Checked result = checked(claimed);
        for (std::size_t k = 0; k < result.claims.size(); ++k) {
            const std::string equation = text_of(claimed.claims[k].equation);
            CAPTURE(equation);
            CAPTURE(result.claims[k].reason);
            CHECK(result.claims[k].verdict == Verdict::proved);
            CHECK_FALSE(result.claims[k].up_to);
            ++claims;
        }
    }
    CHECK(claims >= test::at_least(300));
}

TEST_CASE("claims: a potential is right up to a constant, a Lagrangian up to a time derivative, which are told") {
    const Checked result = checked(pendulum(R"(
V = m*g*l*(1 - cos(theta))
E = m*l^2*theta'^2/2 - m*g*l*cos(theta) + m*g*l
L = m*l^2*theta'^2/2 + m*g*l*cos(theta) + 3*m*l^2*theta'*cos(theta) + m*g*l
L = m*l^2*theta'^2/2 + m*g*l*cos(theta) + m*l^2*theta'^2*cos(theta)
T = m*l^2*theta'^2/2 + m*g*l
V = -m*g*l*sin(theta)
)"));
    check_verdicts(result, {Verdict::proved, Verdict::proved, Verdict::proved, Verdict::refuted, Verdict::refuted,
                            Verdict::refuted});
    REQUIRE(result.claims[0].up_to);
    CHECK(result.claims[0].up_to->kind == UpTo::Kind::constant);
    CHECK(result.claims[0].up_to->text == "m*g*l");
    REQUIRE(result.claims[1].up_to);
    CHECK(result.claims[1].up_to->text == "m*g*l");
    REQUIRE(result.claims[2].up_to);
    CHECK(result.claims[2].up_to->kind == UpTo::Kind::derivative);
    CHECK(result.claims[2].up_to->text == "3*m*l^2*sin(theta) + m*g*l*t");
    REQUIRE(result.claims[5].likely);
    CHECK(result.claims[5].likely->kind == "swapped_trig");
}

TEST_CASE("claims: a generalized force is the whole one or that of the loads, and the reason tells which") {
    const Checked result = checked("double_pendulum", R"(
Q_theta1 = l1*F*cos(theta1) - (m1+m2)*g*l1*sin(theta1)
Q_theta1 = l1*F*cos(theta1)
Q_theta1 = l1*F*sin(theta1)
(diff(T, theta1'))' - diff(T, theta1) = Q_theta1
(diff(L, theta1'))' - diff(L, theta1) = Q_theta1
deltaW = F*(l1*cos(theta1)*delta_theta1 + l2*cos(theta2)*delta_theta2)
deltaW = F*(l1*cos(theta1)*delta_theta2 + l2*cos(theta2)*delta_theta1)
)");
    check_verdicts(result, {Verdict::proved, Verdict::proved, Verdict::refuted, Verdict::proved, Verdict::proved,
                            Verdict::proved, Verdict::refuted});
    for (const std::size_t whole : {0, 3}) CHECK(result.claims[whole].reason.find("whole") != std::string::npos);
    for (const std::size_t loads : {1, 4, 5}) CHECK(result.claims[loads].reason.find("loads") != std::string::npos);
    REQUIRE(result.claims[2].likely);
    CHECK(result.claims[2].likely->kind == "swapped_trig");
    CHECK_FALSE(result.claims[6].counterexample.empty());
}

// delta_x = 0 along y = const only if the constraint allows no other: δx cos φ and δy sin φ are tied by the blade.
TEST_CASE("claims: virtual displacements are those that the constraints allow") {
    const Checked result = checked("chaplygin_sleigh", R"(
deltaW = 0
deltaW = m*g*(delta_y*cos(phi) - delta_x*sin(phi))
deltaW = m*g*(delta_y*cos(phi) + delta_x*sin(phi))
)");
    (void)result;
}

TEST_CASE("claims: slips in quantities are named as in equations of motion, and the right quantity is shown") {
    const auto slip = [](const std::string& scene, const std::string& claim) {
        const Checked result =
            scene == "pendulum" ? checked(pendulum(claim + "\n")) : checked(scene, claim + "\n");
        CAPTURE(claim);
        REQUIRE(result.claims[0].verdict == Verdict::refuted);
        CHECK_FALSE(result.claims[0].counterexample.empty());
        CHECK_FALSE(result.claims[0].nearest.empty());
        return result.claims[0].likely ? result.claims[0].likely->kind : "";
    };
    CHECK(slip("pendulum", "T = m*l^2*theta'^2") == "factor");
    CHECK(slip("pendulum", "V = m*g*l*cos(theta)") == "sign");
    CHECK(slip("double_pendulum",
               "p_theta1 = (m1+m2)*l1^2*theta1' - m2*l1*l2*theta2'*cos(theta1-theta2)") == "sign");
    CHECK(slip("double_pendulum", "T = (m1+m2)*l1^2*theta1'^2/2 + m2*l2^2*theta2'^2/2") == "missing_term");
    CHECK(slip("double_pendulum", "diff(T, theta1) = m2*l1*l2*theta1'*theta2'*sin(theta1-theta2)") == "sign");
    CHECK(slip("cart_pole", "Q_x = F + b*x'") == "sign");
    const Checked far = checked(pendulum("T = m*l^3*theta'^2*sin(theta)^2 + m*g*l*theta\n"));
    CHECK(far.claims[0].nearest == "T = m*l^2*theta'^2/2");
}

TEST_CASE("claims: Hamilton's function is one of coordinates and momenta") {
    const Checked result = checked(pendulum(R"(
H = p_theta^2/(2*m*l^2) - m*g*l*cos(theta)
theta' = diff(H, p_theta)
p_theta' = -diff(H, theta)
diff(H, t) = 0
diff(L, t) = 0
H = p_theta^2/(m*l^2) - m*g*l*cos(theta)
)"));
    check_verdicts(result, {Verdict::proved, Verdict::proved, Verdict::proved, Verdict::proved, Verdict::proved,
                            Verdict::refuted});
}

TEST_CASE("claims: in a mechanism with stated quantities, what follows from them is right") {
    Scene scene = pendulum();
    const Mechanism m = prepared(scene).mechanism;
    std::vector<Diagnostic> none;
    const auto value = [&](const std::string& text) {
        Formulas formulas(scene, m);
        return formulas.value(parse_expression(text, {}, none));
    };
    const auto verdicts = [&](const Mechanism& world, const std::string& claims) {
        std::vector<Verdict> result;
        for (const CheckedClaim& c : check(with_claims(scene, claims, "claims.txt"), world).claims)
            result.push_back(c.verdict);
        return result;
    };
    const std::string claims =
        "T = m*l^2*theta'^2\n2*l*theta'' + g*sin(theta) = 0\nl*theta'' + g*sin(theta) = 0\np_theta = "
        "2*m*l^2*theta'\n";
    using enum Verdict;
    CHECK(verdicts(m, claims) == std::vector{refuted, refuted, proved, refuted});
    const Mechanism own = with_own(m, {.kinetic = value("m*l^2*theta'^2")});
    CHECK(verdicts(own, claims) == std::vector{proved, proved, refuted, proved});
    const Mechanism by_L = with_own(m, {.lagrangian = value("m*l^2*theta'^2/2 - m*g*l*cos(theta)")});
    CHECK(verdicts(by_L, "l*theta'' - g*sin(theta) = 0\nT = m*l^2*theta'^2/2\n") == std::vector{proved, proved});
    const Mechanism by_Q =
        with_own(m, {.forces = {{"theta", value("m*g*l*sin(theta)")}}, .forces_are_whole = true});
    CHECK(verdicts(by_Q, "l*theta'' - g*sin(theta) = 0\nQ_theta = m*g*l*sin(theta)\n") ==
          std::vector{proved, proved});
}

}  // namespace claims_quantities
