// SPDX-License-Identifier: MIT
// Claims about the quantities of a derivation: T, V, L, E, H, momenta, generalized forces, partial derivatives.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "analysis/derive/derive.hpp"
#include "check/frequency.hpp"
#include "checked.hpp"
#include "model/formalism/routh.hpp"
#include "model/formulas.hpp"
#include "oracle.hpp"
#include "program/interpret.hpp"
#include "program/lower/lower.hpp"
#include "scene/names.hpp"
#include "slips.hpp"

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

bool declares_a_letter(const Scene& scene) {
    std::vector<Diagnostic> none;
    const NameSpaces names = declare(scene, none);
    return std::any_of(names.values.begin(), names.values.end(), [](const auto& named) {
        return std::string("TVLEH").find(named.first) != std::string::npos;
    });
}

/// dT/d(q') or, with a prime, its rate, in the language of claims.
std::string slope_of(const Statement& s) {
    const std::string slope = "diff(" + s.letter + ", " + text(*s.by) + ")";
    return s.kind == Statement::Kind::partial_rate ? "(" + slope + ")'" : slope;
}

/// Every step of a derivation that gives a quantity, as a claim.
std::string steps_as_claims(const Derivation& shown) {
    std::string claims;
    const auto add = [&](const std::string& left, const Phrase& right) {
        claims += left + " = " + text(right) + "\n";
    };
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
    for (const Statement& s : shown.derivatives) add(slope_of(s), s.value);
    return claims;
}

TEST_CASE("claims: every energy, force and partial derivative that derive prints is proved") {
    int claims = 0;
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 0)) {
        CAPTURE(file);
        const Scene scene = read_scene(file);
        if (declares_a_letter(scene)) continue;  // it then means something else
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
V = V + m*g*l
theta*V = -m*g*l*theta*cos(theta) + m*g*l
2*E = m*l^2*theta'^2 - 2*m*g*l*cos(theta) + m*g*l
m*g*l*cos(theta) + m*g*l = -V
)"));
    check_verdicts(result,
                   {Verdict::proved, Verdict::proved, Verdict::proved, Verdict::refuted, Verdict::refuted,
                    Verdict::refuted, Verdict::refuted, Verdict::refuted, Verdict::proved, Verdict::proved});
    REQUIRE(result.claims[9].up_to);
    CHECK(result.claims[9].up_to->text == "-m*g*l");
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
    for (const std::size_t loads : {1, 4, 5})
        CHECK(result.claims[loads].reason.find("loads") != std::string::npos);
    REQUIRE(result.claims[2].likely);
    CHECK(result.claims[2].likely->kind == "swapped_trig");
    CHECK_FALSE(result.claims[6].counterexample.empty());
}

// The blade allows δx sin φ = δy cos φ only.
TEST_CASE("claims: virtual displacements are those that the constraints allow") {
    const Checked result = checked("chaplygin_sleigh", R"(
deltaW = 0
deltaW = m*a^2*phi'^2*(delta_y*cos(phi) - delta_x*sin(phi))
deltaW = m*a^2*phi'^2*(delta_y*cos(phi) + delta_x*sin(phi))
)");
    check_verdicts(result, {Verdict::proved, Verdict::proved, Verdict::refuted});
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
    CHECK(slip("pendulum", "V = m*g*l*(1 + cos(theta))") == "sign");
    CHECK(slip("pendulum", "E = m*l*theta'^2/2 - m*g*l*cos(theta)") == "wrong_arm");
    CHECK(slip("double_pendulum", "p_theta1 = (m1+m2)*l1^2*theta1' - m2*l1*l2*theta2'*cos(theta1-theta2)") ==
          "sign");
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

// The plumb position of the pendulum; energies are held to second order there.
TEST_CASE("claims: energies near a state are held to second order") {
    const Checked result = checked(pendulum(R"(
near theta = 0
V = m*g*l*theta^2/2
V = m*g*l*theta^2
L = m*l^2*theta'^2/2 - m*g*l*theta^2/2
L = m*l^2*theta'^2/2 - m*g*l*theta^2/2 + m*l^2*theta*theta'
L = m*l^2*theta'^2/2 + m*g*l*theta^2/2
T = m*l^2*theta'^2/2
p_theta = m*l^2*theta'
Q_theta = -m*g*l*theta
Q_theta = m*g*l*theta
)"));
    check_verdicts(result, {Verdict::proved, Verdict::refuted, Verdict::proved, Verdict::proved, Verdict::refuted,
                            Verdict::proved, Verdict::proved, Verdict::proved, Verdict::refuted});
}

// I of a rod of length 2a about its end is m (2a)²/3; the scene has m (2a)²/12 about its middle.
TEST_CASE("claims: moments of inertia about any point, and components of vectors") {
    const Scene scene = with_claims(parse_scene(R"toml(
gravity = [0, "-g"]
[parameters]
m = 2
a = 0.5
g = 9.81
[coordinates]
phi = { initial = 0.4, rate = 0 }
[[frame]]
name = "R"
rotate = [["z", "phi"]]
[[point]]
name = "end"
offset = ["2*a*cos(phi)", "2*a*sin(phi)"]
[[body]]
name = "rod"
mass = "m"
frame = "R"
position = ["a*cos(phi)", "a*sin(phi)"]
inertia = [0, "m*a^2/3", "m*a^2/3"]
)toml",
                                                "rod.toml"),
                                    R"(
inertia(rod, O) = 4*m*a^2/3
inertia(rod, end) = 4*m*a^2/3
inertia(rod, rod) = m*a^2/3
inertia(rod, O, ex(R)) = 0
inertia(rod, O, 3*ey(R)) = 4*m*a^2/3
inertia(rod, O, ex(N), ey(N)) = -4*m*a^2/3*sin(phi)*cos(phi)
T = inertia(rod, O)*phi'^2/2
T(rod) = T(translation_rod) + T(rotation_rod)
T(rotation_rod) = m*a^2*phi'^2/6
dot(vel(end), ex(N)) = -2*a*phi'*sin(phi)
dot(acc(end), ey(R)) = 2*a*phi''
dot(omega(rod), ez(N)) = phi'
inertia(rod, O) = m*a^2/3
)",
                                    "claims.txt");
    std::vector<Verdict> expected(12, Verdict::proved);
    expected.push_back(Verdict::refuted);
    check_verdicts(checked(scene), expected);
}

TEST_CASE("claims: what no letter can hold is told") {
    const auto message = [](const std::string& claim) -> std::string {
        try {
            checked(pendulum(claim + "\n"));
        } catch (const SceneError& e) {
            return e.what();
        }
        return "";
    };
    CHECK(message("T(spring_1) = 0").find("T has no part of the name 'spring_1'; there are bob") !=
          std::string::npos);
    CHECK(message("T(bob, bob) = 0").find("one name of a part") != std::string::npos);
    CHECK(message("T(2*theta) = 0").find("for a product write T*") != std::string::npos);
    CHECK(message("inertia(bob, P) = 0").find("unknown point") != std::string::npos);
    CHECK(message("Q_phi = 0").find("unknown name 'Q_phi'") != std::string::npos);
    CHECK(message("delta_theta' = 0").find("virtual displacement") != std::string::npos);
    CHECK(message("diff(theta*g, t) = 0").find("does not depend on t") != std::string::npos);
}

// ∂X/∂y by central differences of X at states in double precision: with steps of 1e-4 their error is 1e-8 of the
// third derivative.
TEST_CASE("claims: partial derivatives of the letters agree with differences") {
    constexpr unsigned seed = 20261126;
    std::mt19937_64 random(seed);
    int compared = 0;
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 2)) {
        CAPTURE(file);
        CAPTURE(seed);
        const Scene scene = read_scene(file);
        if (declares_a_letter(scene)) continue;
        const Mechanism m = prepared(scene).mechanism;
        if (!m.symbols->functions().empty()) continue;
        Formulas formulas(scene, m);
        State<double> state = test::random_state(start_of(m), random);
        state.qddot.assign(static_cast<std::size_t>(m.size()), 0);
        const auto value = [&](const std::string& text, const State<double>& at) {
            std::vector<Diagnostic> none;
            Program p;
            const int id = lower_expression(p, m, m.z->name(formulas.value(parse_expression(text, {}, none))));
            return interpret<double>(p, at)[static_cast<std::size_t>(id)];
        };
        for (const std::string letter : {"T", "V", "E", "H"})
            for (int i = 0; i < m.size(); ++i)
                for (const bool rate : {false, true}) {
                    if (letter == "H" && !rate) continue;  // the momenta are held there
                    constexpr double step = 1e-4;
                    State<double> above = state, below = state;
                    (rate ? above.qdot : above.q)[static_cast<std::size_t>(i)] += step;
                    (rate ? below.qdot : below.q)[static_cast<std::size_t>(i)] -= step;
                    const double slope = (value(letter, above) - value(letter, below)) / (2 * step);
                    const std::string name = m.q[i].get_name() + (rate ? "'" : "");
                    const double exact = value(fmt::format("diff({}, {})", letter, name), state);
                    if (std::isnan(exact)) continue;
                    CAPTURE(letter);
                    CAPTURE(name);
                    const double size = std::abs(value(letter, state)) + std::abs(exact) + 1;
                    CHECK(std::abs(slope - exact) < 1e-5 * size);
                    ++compared;
                }
    }
    CHECK(compared >= test::at_least(150));
}

/// The quantities that derive prints, each with its value.
std::vector<std::pair<std::string, std::string>> quantities_of(const Derivation& shown) {
    std::vector<std::pair<std::string, std::string>> result;
    if (!shown.lagrangian) result = {{"T", text(shown.kinetic)}, {"V", text(shown.potential)}};
    for (const Statement& s : shown.derivatives) result.emplace_back(slope_of(s), text(s.value));
    return result;
}

TEST_CASE("claims: slips made on the energies and derivatives of textbook scenes are refuted and named") {
    constexpr unsigned seed = 20261127;
    std::mt19937 random(seed);
    int all = 0, rightly = 0;
    std::string misnamed;
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 1)) {
        CAPTURE(file);
        const Scene scene = read_scene(file);
        if (declares_a_letter(scene) || !scene.unilateral.empty()) continue;  // what fails may hold at a contact
        const Derivation shown = derive(scene).shown;
        if (!shown.definitions.empty()) continue;
        const Mechanism m = prepared(scene).mechanism;
        const Equations e = routh(m);
        const test::Oracle oracle(scene, m, e, seed);
        std::string claims;
        std::vector<std::string> kinds;
        for (const auto& [letter, value] : quantities_of(shown)) {
            if (value == "0") continue;
            for (const test::StudentSlip& slip : test::slips_of(scene, {value + " = 0"}, 0, 0, random, 1)) {
                std::vector<Diagnostic> mistakes;
                const std::string wrong = slip.equation.substr(0, slip.equation.find(" = "));
                const Equality difference = parse_equality(wrong + " = " + value, {}, mistakes);
                if (!slip.equation.ends_with(" = 0") || random() % 4 != 0 || oracle.holds(difference) != false)
                    continue;
                claims += letter + " = " + wrong + "\n";
                kinds.push_back(slip.kind);
            }
        }
        if (kinds.empty()) continue;
        const Scene wrong = with_claims(scene, claims, "slips");
        const Checked result = check(wrong, m);
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            const CheckedClaim& c = result.claims[k];
            const std::string equation = text_of(wrong.claims[k].equation);
            CAPTURE(equation);
            if (c.up_to) continue;  // a constant of V
            CHECK(c.verdict == Verdict::refuted);
            CHECK_FALSE(c.counterexample.empty());
            const std::string kind = c.likely ? c.likely->kind : "unknown";
            ++all;
            if (kind == kinds[k])
                ++rightly;
            else
                misnamed += fmt::format("{} named {}: {} | {} | {}\n", kinds[k], kind, file, equation,
                                        c.likely ? c.likely->repair : "");
        }
    }
    INFO("seed " << seed << "\n" << misnamed << rightly << " of " << all);
    CHECK(10 * rightly >= 9 * all);
    CHECK(all >= test::at_least(60));
}

// By Newton's law of both bodies together, and of the one below.
TEST_CASE("claims: reactions of joints and of what rolls go by the names that derive shows") {
    const Checked result = checked("double_pendulum_joints", R"(
F_x_hook = m1*dot(acc(upper), ex(N)) + m2*dot(acc(lower), ex(N))
F_y_hook = m1*dot(acc(upper), ey(N)) + m2*dot(acc(lower), ey(N)) - (m1 + m2)*g
F_x_elbow = m2*dot(acc(lower), ex(upper)) - m2*g*sin(q1)
M_z_elbow = 0
F_x_hook = m1*dot(acc(upper), ex(N))
)");
    check_verdicts(result, {Verdict::proved, Verdict::proved, Verdict::proved, Verdict::proved, Verdict::refuted});
    check_verdicts(checked("rolling_disc_in_space",
                           "N_rim = m*g - m*r*theta''*sin(theta) - m*r*theta'^2*cos(theta)\n"
                           "N_rim = m*g - m*r*theta''*sin(theta)\n"),
                   {Verdict::proved, Verdict::refuted});
}

// The oracle differentiates the printed ∂T/∂q' on Taylor series of motions in 60 digits.
TEST_CASE(
    "claims: time derivatives of momenta, as they are written out, are proved and agree with series in time") {
    int compared = 0;
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 0)) {
        CAPTURE(file);
        const Scene scene = read_scene(file);
        if (declares_a_letter(scene)) continue;
        const Mechanism m = prepared(scene).mechanism;
        if (m.given_lagrangian) continue;
        const Equations e = routh(m);
        const test::Oracle oracle(scene, m, e, 5);
        const std::vector<GiNaC::ex> p = m.z->pull_back({{m.kinetic_energy(), 1}}, m.qdot);
        std::string claims;
        for (int i = 0; i < m.size() && i < 3; ++i) {
            const GiNaC::ex rate = m.time_derivative({p[i]})[0];
            if (rate.is_zero() || m.z->tree_size(rate) > 1000) continue;
            const auto momentum = fourier(m.z->expand(p[i]), *m.symbols, 100),
                       written = fourier(m.z->expand(rate), *m.symbols, 100);
            if (!momentum || !written) continue;
            const std::string right = text(readable(*written));
            std::vector<Diagnostic> mistakes;
            const Equality by_series =
                parse_equality("(" + text(readable(*momentum)) + ")' = " + right, {}, mistakes);
            CAPTURE(right);
            CHECK(oracle.holds(by_series).value_or(true));
            claims += fmt::format("(diff(T, {}'))' = {}\n", m.q[i].get_name(), right);
        }
        if (claims.empty()) continue;
        for (const CheckedClaim& c : checked(with_claims(scene, claims, "rates.txt")).claims) {
            CHECK(c.verdict == Verdict::proved);
            ++compared;
        }
    }
    CHECK(compared >= test::at_least(25));
}

TEST_CASE("claims: equilibria, frequencies and modes") {
    const Scene scene = pendulum();
    const Mechanism m = prepared(scene).mechanism;
    std::vector<Diagnostic> none;
    const auto e = [&](const std::string& text) { return parse_expression(text, {}, none); };
    const AtPoint hanging{scene, m, {{"theta", e("0")}}}, standing{scene, m, {{"theta", e("pi")}}},
        oblique{scene, m, {{"theta", e("pi/3")}}};
    CHECK(check_equilibrium(hanging).verdict == Verdict::proved);
    CHECK(check_equilibrium(standing).verdict == Verdict::proved);
    CHECK(check_equilibrium(oblique).verdict == Verdict::refuted);
    const CheckedFrequency right = check_frequency(hanging, e("g/l"));
    CHECK(right.verdict == Verdict::proved);
    CHECK(right.multiplicity == 1);
    const CheckedFrequency wrong = check_frequency(hanging, e("2*g/l"));
    CHECK(wrong.verdict == Verdict::refuted);
    CHECK(wrong.nearest == "omega^2 = g/l");
    CHECK(check_frequency(standing, e("-g/l")).verdict == Verdict::proved);

    Scene two = read_scene(test::source_path("scenes/textbook/coupled_oscillators.toml"));
    two.dampers.clear();
    two.rayleigh = {};
    const Mechanism undamped = prepared(two).mechanism;
    const AtPoint rest{two, undamped, {{"x1", e("0")}, {"x2", e("0")}}};
    const std::string half = "((k1 + k2)/m1 + (k2 + k3)/m2)/2",
                      root = "sqrt(((k1 + k2)/m1 - (k2 + k3)/m2)^2/4 + k2^2/(m1*m2))";
    CHECK(check_frequency(rest, e(half + " + " + root)).verdict == Verdict::proved);
    CHECK(check_frequency(rest, e(half + " - " + root)).verdict == Verdict::proved);
    CHECK(check_frequency(rest, e(half)).verdict == Verdict::refuted);
    CHECK(check_mode(rest, {{"x1", e("1")}, {"x2", e("1")}}).verdict == Verdict::refuted);
}

TEST_CASE("claims: letters may be written with Greek names, and the scene's own names come first") {
    check_verdicts(checked(pendulum("p_θ = m*l^2*θ'\nQ_θ = -m*g*l*sin(θ)\n")), {Verdict::proved, Verdict::proved});
    // The energy is left open, so that it is a constant of the motion and no letter.
    const Checked open = checked(pendulum("constants E\nm*l^2*theta'^2/2 - m*g*l*cos(theta) = E\n"));
    CHECK(open.claims[0].verdict == Verdict::proved);
    CHECK_FALSE(open.claims[0].up_to);
}

}  // namespace claims_quantities
