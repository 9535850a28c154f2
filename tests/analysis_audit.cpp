// SPDX-License-Identifier: MIT
// Constraints: integrability against dw ∧ w written out and against forms made from known functions, integrals
// against the functions they were made from, poses and contradictions against hand calculation.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <random>
#include <set>

#include "algebra/notation/text.hpp"
#include "analysis/audit/audit.hpp"
#include "analysis/audit/integral.hpp"
#include "analysis/exact/variety.hpp"
#include "analysis/state/prepared.hpp"
#include "analysis/state/redundancy.hpp"
#include "model/energy.hpp"
#include "program/lower/lower.hpp"
#include "scenes.hpp"

namespace analysis_audit {

using namespace alembert;
using GiNaC::ex;

namespace {

/// Constraints as text: velocity ones contain a prime. Coordinates as in a scene's table.
Mechanism with(const std::vector<std::string>& coordinates, const std::vector<std::string>& constraints,
               const std::string& parameters = "", const std::string& inputs = "") {
    std::string text = "[parameters]\n" + parameters + "\n[inputs]\n" + inputs + "\n[coordinates]\n",
                kinetic = "0";
    for (const std::string& q : coordinates) {
        text += q + (q.find('=') == std::string::npos ? " = 0.3\n" : "\n");
        kinetic += "+" + q.substr(0, q.find(' ')) + "'^2";
    }
    text += "[energy]\nkinetic = \"" + kinetic + "\"\n";
    for (std::size_t k = 0; k < constraints.size(); ++k)
        text += fmt::format("[[constraint]]\nname = \"c{}\"\n{} = \"{}\"\n", k,
                            constraints[k].find('\'') == std::string::npos ? "holonomic" : "nonholonomic",
                            constraints[k]);
    return build(parse_scene(text, "test.toml"));
}

OneForm expanded(const Mechanism& m, const OneForm& form) {
    OneForm result;
    for (const ex& e : form) result.push_back(m.z->expand(e));
    return result;
}

std::vector<GiNaC::symbol> variables(const Mechanism& m) {
    std::vector<GiNaC::symbol> result = m.q;
    result.push_back(m.t);
    return result;
}

/// dw ∧ w = 0, all components by normal form. No inputs.
bool is_integrable(const Mechanism& m, const OneForm& form) {
    const OneForm a = expanded(m, form);
    const auto z = variables(m);
    const auto curl = [&](std::size_t j, std::size_t k) { return a[k].diff(z[j]) - a[j].diff(z[k]); };
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (std::size_t k = 0; k < j; ++k)
                if (vanishes(a[i] * curl(j, k) + a[j] * curl(k, i) + a[k] * curl(i, j), m) != true) return false;
    return true;
}

std::vector<std::optional<bool>> joint(const Mechanism& m) {
    return integrability(forms_of(m), m, {}, {}).integrable;
}
std::optional<int> integrals(const Mechanism& m) {
    return integrability(forms_of(m), m, {}, {}).integrals;
}

using Answers = std::vector<std::optional<bool>>;

}  // namespace

TEST_CASE("integrability: that of one constraint is decided as by dw ^ w") {
    int yes = 0, no = 0;
    for (const char* constraint :
         {"x' - r*y'", "y*x' - x*y'", "z' - y*x'", "x'*sin(z) - y'*cos(z)", "x' - t*y'", "x' - sin(t)",
          "sin(x*y)*x' + exp(y)*y'", "y*z*x' + x*z*y' + x*y*z'", "y*z*x' + x*z*y' - x*y*z'",
          "y*z*x' + 2*x*z*y' + x*y*t*z'", "cos(x - y)*(x' - y') + z*z'", "x*x' + y*y' + sqrt(1 + z^2)*z'",
          "x*x' + y*z' + z*y' + r*t", "x' + y*z*y' + y^2*z'/2", "exp(z)*(x' - r*z')", "y*x' + z*y' + x*z'",
          "x' - y*t*z'"}) {
        CAPTURE(constraint);
        const Mechanism m = with({"x", "y", "z"}, {constraint}, "r = 0.5");
        const bool expected = is_integrable(m, forms_of(m)[0]);
        CHECK(joint(m) == Answers{expected});
        CHECK(integrals(m) == int{expected});
        ++(expected ? yes : no);
    }
    CHECK(yes >= 6);
    CHECK(no >= 6);
}

// Any combinations of dF and dG, with functions for coefficients.
TEST_CASE("integrability: combinations of two differentials are integrable together, but not each alone") {
    const char *F = "(y*x' + x*y' + 2*w*w')", *G = "(cos(z)*z' + y*v' + v*y')";
    const Mechanism m =
        with({"x", "y", "z", "w", "v"}, {fmt::format("{} + x*z*{}", F, G), fmt::format("sin(w)*{} + v*{}", F, G)});
    const auto forms = forms_of(m);
    CHECK(!is_integrable(m, forms[0]));
    CHECK(!is_integrable(m, forms[1]));
    CHECK(joint(m) == Answers{true, true});
    CHECK(integrals(m) == 2);
    // With one coefficient of dF changed, neither is integrable.
    const Mechanism other = with({"x", "y", "z", "w", "v"}, {fmt::format("{} + x*z*{}", F, G),
                                                             fmt::format("sin(w)*{} + v*{} + x*y*v'", F, G)});
    CHECK(joint(other) == Answers{false, false});
}

TEST_CASE(
    "integrability: two scleronomic forms in three coordinates are integrable, the coin and the sleigh are not") {
    const Mechanism two = with({"x", "y", "z"}, {"z' - y*x'", "x' - z*y'"});
    CHECK(joint(two) == Answers{true, true});
    CHECK(integrability({forms_of(two)[0]}, two, {}, {}).integrable == Answers{false});
    CHECK(integrals(with({"x", "y", "z"}, {"z' - y*x'", "x' - t*z*y'"})) == 0);  // here t is a fourth variable
    CHECK(joint(with({"x", "y", "phi", "theta"}, {"x' - r*phi'*cos(theta)", "y' - r*phi'*sin(theta)"},
                     "r = 1.0")) == Answers{false, false});
    CHECK(joint(with({"x", "y", "phi"}, {"x'*sin(phi) - y'*cos(phi)"})) == Answers{false});
    CHECK(joint(with({"x", "y", "z"}, {"z' - y*x'", "y'"})) == Answers{true, true});
}

// The rank of the derived flags of Engel's and Goursat's forms falls by one in each step, to zero (Bryant et al.,
// II.4-5), so that only the last bracket shows that there is no integral. If u' − (xw)' is added, one integral
// remains, that one.
TEST_CASE("integrability: the derived flag is followed to its end") {
    CHECK(integrals(with({"x", "y", "z", "w"}, {"y' - z*x'", "z' - w*x'"})) == 0);
    CHECK(integrals(with({"x", "y", "z", "w", "v"}, {"y' - z*x'", "z' - w*x'", "w' - v*x'"})) == 0);
    const Mechanism m = with({"x", "y", "z", "w", "u"}, {"y' - z*x'", "z' - w*x'", "u' - x*w' - w*x'"});
    CHECK(joint(m) == Answers{false, false, true});
    CHECK(integrals(m) == 1);
    // z' = 0 follows, and y − z·x with it.
    CHECK(integrals(with({"x", "y", "z", "w"}, {"y' - z*x'", "z' - 3*w'", "w'"})) == 3);
}

// x' cos + y' sin ± b th' = r p': the difference is 2b th' = r (p1' − p2'), though no constraint is integrable.
TEST_CASE(
    "audit: for two wheels on an axle 2 b th - r (p1 - p2) is constant, although no constraint is integrable") {
    const Mechanism m = with({"x", "y", "th", "p1", "p2"},
                             {"x'*cos(th) + y'*sin(th) + b*th' - r*p1'", "x'*cos(th) + y'*sin(th) - b*th' - r*p2'",
                              "y'*cos(th) - x'*sin(th)"},
                             "b = 0.4\nr = 0.1");
    const Audit audit = audit_of(m);
    CHECK(audit.integrals == 1);
    for (const AuditedConstraint& c : audit.constraints) CHECK(c.integrable == false);
    REQUIRE(audit.combinations.size() == 1);
    CHECK(audit.combinations[0].first == "'c0' - 'c1'");
    REQUIRE(audit.combinations[0].second);
    CHECK(text(*audit.combinations[0].second) == "2*b*th + r*(p2-p1)");
    CHECK(audit.degrees_of_freedom == 2);
}

// Outside z = 0 the form is not integrable; on it x' = 0 remains. In the second case, on x = y, the form is z' −
// y·x' with dx = dy.
TEST_CASE("integrability: it is decided at states that obey the holonomic constraints") {
    const Mechanism flat = with({"x", "y", "z = 0"}, {"z", "x' + z*x*y' + z*y'"});
    const Audit audit = audit_of(flat);
    CHECK(audit.constraints[1].alone == false);
    CHECK(audit.constraints[1].integrable == true);
    const Mechanism still = with({"x", "y", "z", "w"}, {"x - y", "z' - y*w'"});
    CHECK(audit_of(still).constraints[1].integrable == false);
    CHECK(audit_of(with({"x", "y", "z", "w"}, {"x - y", "z' - y*x'"})).constraints[1].integrable == true);
    // With the gear c = a + b the second is (x − a + y − b)′ cos c, which makes the blade's two coordinates of
    // three.
    const std::vector<std::string> gear{"c - a - b", "x'*sin(c) - y'*cos(c)",
                                        "cos(c)*(x' - a') + (cos(a)*cos(b) - sin(a)*sin(b))*(y' - b')"};
    const Audit turned = audit_of(with({"a", "b", "c = 0.6", "x", "y"}, gear));
    CHECK(turned.constraints[1].integrable == true);
    CHECK(turned.constraints[1].alone == false);
    CHECK(turned.constraints[2].integrable == true);
}

TEST_CASE("integrability: if the loop has no exact point, its \"no\" is confirmed numerically") {
    const std::vector<std::string> q{"al = 0.5", "be = { guess = 0.3, rate_guess = 0 }",
                                     "ga = { guess = 0.7, rate_guess = 0 }", "x", "y"};
    const std::string loop_x = "al*cos(al) + 2*be*cos(be) - 1.5*ga*cos(ga) - 1.7",
                      loop_y = "al*sin(al) + 2*be*sin(be) - 1.5*ga*sin(ga)";
    const Audit no = audit_of(with(q, {loop_x, loop_y, "x' - y*al'"}));
    CHECK(no.constraints[2].integrable == false);
    CHECK(!no.exact_rank);
    const Audit yes = audit_of(with(q, {loop_x, loop_y, "x' - y*al' - al*y'"}));
    CHECK(yes.constraints[2].integrable == true);
}

// An integral G of w = μ dF is a function of F: dG ∧ dF = 0.
TEST_CASE("integral: that of dF times a factor is a function of F") {
    struct Case {
        const char *function, *factor;
    };
    const std::vector<Case> cases{{"x*y^2 + z", "1"},
                                  {"x/y", "y^2"},
                                  {"x*y*z", "1/(x*y*z)"},
                                  {"sin(x + 2*y)*z", "1"},
                                  {"x^2 + y^2", "1/(x^2 + y^2)"},
                                  {"x*sin(y) + z*cos(y)", "1"},
                                  {"x - r*y + t^2*z", "1"},
                                  {"exp(x)*y", "exp(-x)"},
                                  {"x - 2*sin(3*t)", "r"},
                                  {"x^3*sin(x)*r + y", "1"},
                                  {"sqrt(x^2 + y^2 + z^2)", "1"},
                                  {"x/cos(y)", "cos(y)^2"},
                                  {"log(1 + x^2) + y*z", "1"},
                                  {"r*cos(x) - cos(x - y)", "1"},
                                  {"y*cosh(x) + log(cos(z))", "1"}};
    for (const Case& c : cases) {
        CAPTURE(c.function);
        const Mechanism m = with({"x", "y", "z"}, {c.function}, "r = 0.5");
        const Mechanism::Constraint& F = m.constraints[0];
        const Mechanism scaled =
            with({"x", "y", "z"}, {fmt::format("({})*({})'", c.factor, c.function)}, "r = 0.5");
        const auto G = integral_of(forms_of(scaled)[0], scaled);
        REQUIRE(G);
        const auto z = variables(m), own = variables(scaled);
        GiNaC::exmap to;
        for (std::size_t i = 0; i < z.size(); ++i) to[own[i]] = z[i];
        to[scaled.parameters[0].symbol] = m.parameters[0].symbol;
        const ex f = m.z->expand(*F.position), g = G->subs(to, GiNaC::subs_options::no_pattern);
        bool moves = false;
        for (std::size_t i = 0; i < z.size(); ++i) {
            moves = moves || vanishes(g.diff(z[i]), m) == false;
            for (std::size_t j = 0; j < i; ++j)
                CHECK(vanishes(g.diff(z[i]) * f.diff(z[j]) - g.diff(z[j]) * f.diff(z[i]), m) == true);
        }
        CHECK(moves);
    }
    const Mechanism sleigh = with({"x", "y", "phi"}, {"x'*sin(phi) - y'*cos(phi)"});
    CHECK(!integral_of(forms_of(sleigh)[0], sleigh));
    const Mechanism three = with({"x", "y", "z"}, {"z' - y*x'"});
    CHECK(!integral_of(forms_of(three)[0], three));
    CHECK(integral_of(forms_of(three)[0], three, {1}));  // y is constant
}

TEST_CASE("variety: its points obey the constraints exactly, with parameters and angles solved for") {
    const auto look = [](const Mechanism& m) {
        Program program;
        std::vector<ex> f;
        for (const Mechanism::Constraint& c : m.constraints) f.push_back(*c.position);
        const std::vector<int> nodes = lower_expressions(program, m, f);
        const Variety variety = variety_points(program, nodes, {}, 3);
        REQUIRE(variety.points.size() == 3);
        int zeros = 0;
        for (const ModularPoint& point : variety.points)
            for (const int id : nodes) zeros += evaluate_mod(program, point, nodes)->value[id].is_zero();
        CHECK((zeros == static_cast<int>(3 * nodes.size())) == variety.on_variety);
        return variety.on_variety;
    };
    CHECK(look(prepared(read_scene(test::source_path("scenes/textbook/four_bar.toml"))).mechanism));
    CHECK(look(prepared(read_scene(test::source_path("scenes/textbook/falling_ladder.toml"))).mechanism));
    CHECK(look(with({"x", "y", "z", "w"}, {"x^2 + y^2 - 1", "(x - z)^2 + (y - w)^2 - 4"})));
    CHECK(look(with({"a", "b"}, {"sin(a) + 2*cos(a)*sin(b) - 1"})));
    // The turn of c = 2a − 3b + 1 is the product of theirs.
    const Mechanism gear =
        with({"a", "b", "c"}, {"c - 2*a + 3*b - 1", "sin(c) - sin(2*a)*cos(3*b - 1) + cos(2*a)*sin(3*b - 1)",
                               "sin(c) - sin(2*a - 3*b)"});
    CHECK(look(with({"a", "b", "c"}, {"c - 2*a + 3*b - 1"})));
    Program program;
    const std::vector<int> f = lower_expressions(
        program, gear,
        {*gear.constraints[0].position, *gear.constraints[1].position, *gear.constraints[2].position});
    const Variety variety = variety_points(program, {f[0]}, {f[1], f[2]}, 2);
    CHECK(variety.on_variety);
    for (const ModularPoint& point : variety.points) {
        const auto at = evaluate_mod(program, point, f);
        CHECK(at->value[f[1]].is_zero());
        CHECK(!at->value[f[2]].is_zero());
    }
    CHECK(look(with({"a", "b", "c"}, {"cos(a) + 2*cos(b) - 3*cos(c) - 1", "sin(a) + 2*sin(b) - 3*sin(c)"})));
    CHECK(!look(with({"a", "b"}, {"a*cos(a) + b*cos(b) - 1"})));
}

TEST_CASE(
    "audit: copies, multiples and derivatives are redundant, a velocity rather than the position it follows "
    "from") {
    const std::vector<std::string> q{"x = 0.6", "y = 0.8", "z"};
    const auto redundant = [&](const std::vector<std::string>& constraints) {
        std::vector<int> result;
        const Audit audit = audit_of(with(q, constraints));
        for (const AuditedConstraint& c : audit.constraints) result.push_back(c.redundant);
        CHECK(audit.exact_rank);
        CHECK(audit.rank == std::count(result.begin(), result.end(), 0));
        CHECK(audit.degrees_of_freedom == 3 - audit.rank);
        return result;
    };
    CHECK(redundant({"x^2 + y^2 - 1", "z*x*x' + z*y*y'", "exp(x)*(z' - y*x')", "z' - y*x'"}) ==
          std::vector{0, 1, 0, 1});
    CHECK(redundant({"x*x' + y*y'", "x^2 + y^2 - 1"}) == std::vector{1, 0});
    // The rows are dependent on the circle, and nowhere else.
    CHECK(redundant({"x^2 + y^2 - 1", "z*(x^2 + y^2 - 1) + x^2 + y^2 - 1"}) == std::vector{0, 1});
    CHECK(redundant({"x' + y' - z'", "x' - y'", "2*x' - z'"}) == std::vector{0, 0, 1});
    CHECK(redundant({"(sin(x)^2 + cos(x)^2 - 1)*x'", "z'"}) == std::vector{1, 0});
    const Audit audit = audit_of(with(q, {"z' + x*y'", "x^2 + y^2 - 1", "x' - y'", "2*x*x' + 2*y*y' + x' - y'"}));
    REQUIRE(!audit.constraints[3].notes.empty());
    CHECK(audit.constraints[3].notes[0] == "follows from 'c1' and 'c2'; the equations of motion leave it out");
}

// The rank is known by construction: a factor that depends on parameters alone, and is not zero, changes no row.
TEST_CASE("audit: a factor of parameters that a constraint's terms share does not make it hold everywhere") {
    const std::vector<std::string> factors{"k",   "k*r", "k^2",     "(k + r)",  "(1 + k^2)",
                                           "2*k", "k/r", "sqrt(k)", "(k^3 - r)"};
    const std::vector<std::vector<std::string>> loops{
        {"sin(a) + sin(b)"},
        {"sin(a) + sin(b)", "cos(a) + cos(b) - x"},
        {"r*cos(a) + r*cos(b) - x", "r*sin(a) + r*sin(b)"},
        {"a^2 - b^2 + x - 0.3"},
        {"a*b - x - 0.09 + 0.3", "sin(a - b)"},
        {"a' - r*x'"},
        {"a + b", "b' - r*x'"},
    };
    std::mt19937 random(4);
    for (const std::vector<std::string>& loop : loops)
        for (int trial = 0; trial < 6; ++trial) {
            std::vector<std::string> constraints;
            for (const std::string& f : loop)
                constraints.push_back(fmt::format("{}*({})", factors[random() % factors.size()], f));
            const std::size_t independent = constraints.size();
            if (trial % 2 == 0)
                constraints.push_back(
                    fmt::format("{}*({})", factors[random() % factors.size()], loop[random() % loop.size()]));
            CAPTURE(constraints.back());
            CAPTURE(constraints.front());
            const Audit audit = audit_of(
                with({"a = 0.3", "b = { guess = -0.3 }", "x = { guess = 0.3 }"}, constraints, "r = 0.3\nk = 1.5"));
            CHECK(audit.problem.empty());
            CHECK(audit.exact_rank);
            CHECK(audit.rank == static_cast<int>(independent));
            CHECK(audit.degrees_of_freedom == 3 - static_cast<int>(independent));
        }
}

TEST_CASE("audit: constraints that contradict each other are named, and no others") {
    const Audit audit =
        audit_of(with({"x = 1", "y = 0", "z"}, {"z - x", "x^2 + y^2 - 1", "z' + y'", "2*x^2 + 2*y^2 - 4"}));
    CHECK(audit.wrong);
    CHECK(audit.problem.find("'c1' and 'c3' contradict each other") != std::string::npos);
    CHECK(audit.problem.find("'c0'") == std::string::npos);
    CHECK(audit.problem.find("'c2'") == std::string::npos);
    const Audit rates = audit_of(with({"x", "y", "z"}, {"z' - x'", "x' - y'", "y' - z' - 1"}));
    CHECK(rates.problem.find("'c0', 'c1' and 'c2' contradict each other") != std::string::npos);
    const Audit impossible = audit_of(with({"x = { guess = 1 }", "y = 0"}, {"y' - x'", "x^2 + y^2 + 1"}));
    CHECK(impossible.problem.find("'c1' cannot be obeyed") != std::string::npos);
    CHECK(impossible.problem.find("'c0'") == std::string::npos);
    // 0 = z is no contradiction where z is 0, but no constraint says so.
    const Audit hidden = audit_of(with({"x", "y", "z = 0"}, {"x' - y*z'", "x' - y*z' - z"}));
    CHECK(hidden.problem.empty());
    REQUIRE(!hidden.constraints[1].notes.empty());
    CHECK(hidden.constraints[1].notes[0].find("force a relation") != std::string::npos);
}

// The minors of the loop's A are a b sin(al − be) and so on: all links are on one line. A parallelogram closes in
// this way at al = ga = 0 or π with be = 0, a linkage with a + d = b + c (not a parallelogram) at al = ga = π, be
// = 0, Grashof's alone never.
TEST_CASE("audit: a linkage that can lie flat has lost a row there, and Grashof's cannot") {
    const auto poses = [](const std::string& lengths, const std::string& be, const std::string& ga) {
        const Audit audit = audit_of(
            with({"al = 0.5", "be = { guess = " + be + ", rate_guess = 0 }",
                  "ga = { guess = " + ga + ", rate_guess = 0 }"},
                 {"a*cos(al) + b*cos(be) - c*cos(ga) - d", "a*sin(al) + b*sin(be) - c*sin(ga)"}, lengths));
        CHECK(audit.problem.empty());
        CHECK(audit.rank == 2);
        std::set<std::array<long, 3>> result;  // in units of 1e-7
        for (const SingularPose& pose : audit.singular_poses) {
            CHECK(pose.rank == 1);
            result.insert(
                {std::lround(1e7 * pose.q[0]), std::lround(1e7 * pose.q[1]), std::lround(1e7 * pose.q[2])});
        }
        return result;
    };
    const long pi = std::lround(1e7 * M_PI);
    CHECK(poses("a = 1\nb = 2\nc = 1\nd = 2", "0.1", "0.6") ==
          std::set<std::array<long, 3>>{{0, 0, 0}, {pi, 0, pi}});
    CHECK(poses("a = 1\nb = 2\nc = 2\nd = 3", "0.6", "1.4") == std::set<std::array<long, 3>>{{pi, 0, pi}});
    CHECK(poses("a = 1\nb = 4\nc = 3.5\nd = 3", "0.6", "1.4").empty());
}

TEST_CASE("audit: a velocity constraint without a row, and a pose that is the initial one") {
    const Audit origin = audit_of(with({"x = 1", "y = 0.5", "z = 0"}, {"y*x' - x*y' + z*z'"}));
    REQUIRE(origin.singular_poses.size() == 1);
    CHECK(origin.singular_poses[0].q == std::vector<double>{0, 0, 0});
    CHECK(origin.singular_poses[0].rank == 0);
    const Audit here = audit_of(with({"x = 0", "y = 0.5"}, {"x*y' + x*x'"}));
    REQUIRE(!here.singular_poses.empty());
    CHECK(here.singular_poses[0].given);
    CHECK(audit_of(with({"x = 0", "y = 0.5"}, {"exp(y)*x' + y'"})).singular_poses.empty());
}

TEST_CASE("audit: a constraint that is declared wrongly is reported with its integral") {
    const Audit disc =
        audit_of(prepared(read_scene(test::source_path("scenes/textbook/rolling_disc.toml"))).mechanism);
    REQUIRE(disc.constraints.size() == 1);
    CHECK(disc.constraints[0].integrable == true);
    CHECK(text(*disc.constraints[0].integral) == "x - r*phi");
    REQUIRE(disc.constraints[0].notes.size() == 1);
    CHECK(disc.constraints[0].notes[0] == "declared nonholonomic, but it is integrable: x - r*phi is constant");
    CHECK(disc.failure <= -60);
    // A four-bar's loop, differentiated by hand.
    const Audit bar = audit_of(
        with({"al", "be", "ga"},
             {"a*sin(al)*al' + b*sin(be)*be' - c*sin(ga)*ga'", "a*cos(al)*al' + b*cos(be)*be' - c*cos(ga)*ga'"},
             "a = 1\nb = 4\nc = 3.5"));
    CHECK(text(*bar.constraints[0].integral) == "a*cos(al) + b*cos(be) - c*cos(ga)");
    CHECK(text(*bar.constraints[1].integral) == "a*sin(al) + b*sin(be) - c*sin(ga)");
    // Integrable together with another constraint.
    const Audit coin = audit_of(with({"x", "y", "phi", "theta"},
                                     {"x' - r*phi'*cos(theta)", "y' - r*phi'*sin(theta)", "theta'"}, "r = 1.0"));
    CHECK(coin.constraints[0].alone == false);
    CHECK(text(*coin.constraints[0].integral) == "x - r*phi*cos(theta)");
    const Audit square = audit_of(with({"x = 1", "y"}, {"(x - 1)^2"}));
    REQUIRE(square.constraints[0].notes.size() == 1);
    CHECK(square.constraints[0].notes[0].find("without the square") != std::string::npos);
    const Audit special = audit_of(with({"x", "y", "z"}, {"z' - k*y*x'"}, "k = 0"));
    CHECK(special.constraints[0].integrable == false);
    CHECK(special.constraints[0].notes ==
          std::vector<std::string>{"it is integrable for the scene's parameters, but not for general ones"});
}

TEST_CASE(
    "audit: a constraint is rheonomic if it changes with t, not if it is merely written with t or an input") {
    const auto kinds = [](const Mechanism& m) {
        std::vector<int> result;
        for (const AuditedConstraint& c : audit_of(m).constraints) result.push_back(c.rheonomic);
        return result;
    };
    CHECK(kinds(with({"x = { guess = 1, rate_guess = 0 }", "y = { guess = 1, rate_guess = 0 }",
                      "z = { guess = 1, rate_guess = 0 }"},
                     {"x - (sin(t)^2 + cos(t)^2)", "y - cos(2*t)", "z' - F'"}, "", "F = \"sin(t)\"")) ==
          std::vector{0, 1, 1});
    const std::vector<std::string> q{"x = { guess = 1, rate_guess = 0 }", "y = { guess = 1, rate_guess = 0 }"};
    const Audit given = audit_of(with(q, {"x' - F*y' - y*F'"}, "", "F = \"G^2\"\nG = \"1 + t\""));
    CHECK(given.constraints[0].integrable == true);
    CHECK(given.constraints[0].integral);
    CHECK(audit_of(with(q, {"x' - F*y'"}, "", "F = \"G^2\"\nG = \"1 + t\"")).constraints[0].integrable == false);
    CHECK(audit_of(with(q, {"x' - F*y' - 2*y*F'"}, "", "F = \"G^2\"\nG = \"1 + t\"")).constraints[0].integrable ==
          false);
    CHECK(audit_of(with(q, {"x' - F'*y' - 2*y"}, "", "F = \"G^2\"\nG = \"1 + t\"")).constraints[0].integrable ==
          true);  // F'' = 2
    CHECK(audit_of(with(q, {"x' - F'*y' - 3*y"}, "", "F = \"G^2\"\nG = \"1 + t\"")).constraints[0].integrable ==
          false);
}

TEST_CASE("audit: guesses are adjusted to the constraints, and the adjustments are reported") {
    const Audit audit = audit_of(with({"x = 0.6", "y = { guess = 0.7, rate_guess = 0 }"}, {"x^2 + y^2 - 1"}));
    REQUIRE(audit.adjusted.size() == 1);
    CHECK(audit.adjusted[0].name == "y");
    CHECK(audit.adjusted[0].from == 0.7);
    CHECK(audit.adjusted[0].to == doctest::Approx(0.8).epsilon(1e-14));
    CHECK(std::abs(audit.constraints[0].residual[0]) < 1e-14);
    const Audit broken = audit_of(with({"x = 0.6", "y = 0.7"}, {"x^2 + y^2 - 1"}));
    CHECK(broken.wrong);
    CHECK(broken.constraints[0].residual[0] == doctest::Approx(-0.15).epsilon(1e-12));
}

TEST_CASE("audit: every constraint of every scene is decided, and exact arithmetic finds the same rank") {
    for (const std::string& file : test::scenes_in("scenes/textbook")) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(file)).mechanism;
        const Audit audit = audit_of(m);
        CHECK(audit.problem.empty());
        CHECK(audit.constraints.size() == m.constraints.size());
        CHECK(audit.degrees_of_freedom == m.size() - audit.rank);
        CHECK((audit.exact_rank || m.constraints.empty()));
        for (const AuditedConstraint& c : audit.constraints) CHECK(c.integrable.has_value());
    }
}

}  // namespace analysis_audit
