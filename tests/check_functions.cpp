// SPDX-License-Identifier: MIT
// Functions that a scene leaves open, against the equations of books, against the same scenes with formulas in
// place of the functions, and against arithmetic with the values that a counterexample gives.
#include <doctest/doctest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"
#include "scenes.hpp"

namespace check_functions {

using alembert::test::contents;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

std::string scene(const std::string& name) {
    return source_path("scenes/functions/" + name + ".toml");
}

Json claims_of(const std::string& file, const std::string& claims = "") {
    std::vector<std::string> args{"check", file, "--json"};
    if (!claims.empty()) args.insert(args.begin() + 2, temporary("functions.claims", claims + "\n"));
    const auto result = run(args);
    INFO(file << ": " << result.err);
    REQUIRE(!result.out.empty());
    return Json::parse(result.out)["claims"];
}

double number(const Json& text) {
    const std::string value = text.get<std::string>();
    const std::size_t slash = value.find('/');
    return slash == std::string::npos ? std::stod(value) : std::stod(value) / std::stod(value.substr(slash + 1));
}

/// A particle on a moving surface in a field, with drag: functions of two arguments, of compound ones and of a
/// rate.
const std::string surface = R"toml(
gravity = [0, 0, "-g"]
[parameters]
m = 1.0
g = 9.81
c = 2.0
[coordinates]
x = { initial = 1.0, rate = 0.1 }
y = { initial = 1.0, rate = 0 }
[functions]
f = ["x", "y"]
w = ["s"]
D = ["v"]
[[particle]]
name = "P"
mass = "m"
position = ["x", "y", "f(x, y) + w(x - c*t)"]
[forces]
x = "-D(x')"
y = "-f(x, 2*x)"
)toml";

}  // namespace

TEST_CASE("functions: the books' equations of a central field, a wire and a cam are proved") {
    for (const char* name : {"central_field", "bead_on_any_curve", "cam_with_follower"}) {
        for (const Json& claim : claims_of(scene(name))) {
            INFO(name << ": " << claim.dump());
            CHECK(claim["verdict"] == "proved");
        }
        CHECK(run({"agree", scene(name)}).exit == 0);
    }
    CHECK(claims_of(scene("central_field"),
                    "m*r''' = 2*m*r*theta'*theta'' + m*r'*theta'^2 - diff(V(r), r, 2)*r'")[0]["kinematic"] ==
          false);
}

TEST_CASE("functions: a wrong equation is refuted with the name of the slip and values at which it fails") {
    const std::string wire = scene("bead_on_any_curve"), field = scene("central_field"),
                      cam = scene("cam_with_follower");
    const std::vector<std::array<std::string, 3>> wrong{
        {field, "m*r'' - m*r*theta'^2 = diff(V(r), r)", "sign"},
        {field, "m*r'' - m*r*theta'^2 = -diff(V(r), r)/2", "factor"},
        {field, "m*r'' - m*r*theta' = -diff(V(r), r)", "missing_power"},
        {wire, "m*x'' = lambda_wire*diff(f(x), x)", "sign"},
        {cam,
         "(J + m*diff(s(theta), theta)^2)*theta'' + m*diff(s(theta), theta)*diff(s(theta), theta, 2)*theta'^2 + "
         "k*s(theta)*diff(s(theta), theta) = M",
         "missing_term"}};
    for (const auto& [file, claim, kind] : wrong) {
        const Json told = claims_of(file, claim)[0];
        INFO(told.dump());
        CHECK(told["verdict"] == "refuted");
        if (kind != "missing_power") CHECK(told["likely"]["kind"] == kind);
    }
    // The same function at two places has independent values.
    CHECK(
        claims_of(
            wire,
            "(1 + diff(f(x), x)^2)*x'' + diff(f(x), x)*diff(f(x), x, 2)*x'^2 + g*diff(f(x), x) = 0")[0]
                                                                                                    ["verdict"] ==
        "refuted");  // the support's acceleration is missing
    CHECK(claims_of(field, "m*r'' - m*r*theta'^2 = -diff(V(2*r), 2*r)")[0]["verdict"] == "refuted");
    const Json at = claims_of(field, "m*r'' - m*r*theta'^2 = diff(V(r), r)")[0];
    const Json& value = at["counterexample"];
    const double m = number(value["m"]), r = number(value["r"]), rate = number(value["theta'"]),
                 slope = number(value["diff(V(r),r)"]);
    CHECK(number(value["r''"]) == doctest::Approx(r * rate * rate - slope / m));
    CHECK(at["residual"].get<double>() == doctest::Approx(-2 * slope));
}

// Lagrange's equations of the first kind on f(x, y, z) = 0: m a = λ grad f + m g.
TEST_CASE("functions: a particle on any surface f(x, y, z) = c has the equations of the first kind") {
    const std::string file = temporary("implicit.toml", R"toml(
gravity = [0, 0, "-g"]
[parameters]
m = 1.0
g = 9.81
c = 2.0
[coordinates]
x = 1.0
y = 1.0
z = 0
[functions]
f = ["x", "y", "z"]
[[particle]]
name = "P"
mass = "m"
position = ["x", "y", "z"]
[[constraint]]
name = "s"
holonomic = "f(x, y, z) = c"
)toml");
    const char* const claims[] = {"m*x'' = lambda_s*diff(f(x,y,z),x)",
                                  "m*z'' = lambda_s*diff(f(x,y,z),z) - m*g",
                                  "diff(f(x,y,z),x)*x' + diff(f(x,y,z),y)*y' + diff(f(x,y,z),z)*z' = 0",
                                  "f(x,y,z)*x'' = c*x''",
                                  "m*x'' = -lambda_s*diff(f(x,y,z),x)",
                                  "x'*diff(f(x,y,z),y) = y'*diff(f(x,y,z),x)",
                                  "f(x,y,z) = f(x,y,2*z)"};
    for (int k = 0; k < 7; ++k) {
        INFO(claims[k]);
        CHECK(claims_of(file, claims[k])[0]["verdict"] == (k < 4 ? "proved" : "refuted"));
    }
}

TEST_CASE("functions: what is proved of any function holds with a formula in its place") {
    std::string text = contents(scene("central_field"));
    text = std::regex_replace(text, std::regex("\\[functions\\]\nV = \\[\"r\"\\]"), "");
    text = std::regex_replace(text, std::regex("V\\(r\\)"), "(exp(-r)/r + r^3)");
    for (const Json& claim : claims_of(temporary("formula.toml", text))) {
        INFO(claim.dump());
        CHECK(claim["verdict"] == "proved");
    }
}

TEST_CASE(
    "functions: printed equations are claims that hold, and LaTeX and MathML have derivatives of functions") {
    const std::string file = temporary("surface.toml", surface);
    std::string all;
    for (const char* by : {"lagrange", "kane", "hamilton", "nielsen", "appell"}) {
        const auto derived = run({"derive", file, "--by", by, "--json"});
        INFO(by << derived.err);
        REQUIRE(derived.exit == 0);
        const Json page = Json::parse(derived.out);
        std::string claims;
        for (const Json& equation : page["equations"]) {
            claims += equation["text"].get<std::string>() + "\n";
            all += equation["latex"].get<std::string>() + "\n";
        }
        if (std::string(by) != "hamilton")
            for (const Json& claim : claims_of(file, claims)) {
                INFO(claim.dump());
                CHECK(claim["verdict"] == "proved");
            }
    }
    for (const char* part : {"\\frac{\\partial f}{\\partial x}", "w''(x - c t)", "D(\\dot{x})", "f(x, 2 x)"}) {
        INFO(part << " in " << all);
        CHECK(all.find(part) != std::string::npos);
    }
    const std::string field = run({"derive", scene("central_field"), "--format", "latex"}).out;
    CHECK(field.find("\\frac{\\mathrm{d}V}{\\mathrm{d}r}") != std::string::npos);
    CHECK(run({"derive", scene("central_field"), "--format", "mathml"})
              .out.find("<mfrac><mrow><mi mathvariant=\"normal\">d</mi><mi>V</mi></mrow>") != std::string::npos);
    CHECK(run({"derive", scene("central_field")}).out.find("m*r'' - m*r*theta'^2 + diff(V(r),r) = 0") !=
          std::string::npos);
}

TEST_CASE("functions: what needs numbers refuses with the name of the function") {
    for (const char* verb : {"simulate", "eval", "linearize", "equilibrium", "stability", "bench"}) {
        const auto result = run({verb, scene("central_field")});
        INFO(verb << ": " << result.out << result.err);
        CHECK(result.exit == 3);
        CHECK(result.err.find("[functions] leaves 'V' open") != std::string::npos);
    }
    const auto audited = run({"audit", scene("bead_on_any_curve"), "--json"});
    REQUIRE(audited.exit == 0);
    const Json audit = Json::parse(audited.out);
    CHECK(audit["degrees_of_freedom"] == 1);
    CHECK(audit["constraints"][0]["residual"].is_null());
}

}  // namespace check_functions
