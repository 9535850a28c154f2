// SPDX-License-Identifier: MIT
// Impacts against other routes: the limit of short forces, the printed equations and solutions read back; and what
// is refused.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "impact_scenes.hpp"
#include "json.hpp"
#include "scenes.hpp"

namespace commands_impact_routes {

using namespace alembert::test;

// Printed results are typed as outputs of a scene with other values of the parameters and compared with the
// numbers there.
TEST_CASE("impact: the symbolic rates are right for other values than those for which they were found") {
    const Json first =
        impact_of(filled(slanting_rod, {{"m", 2}, {"l", 0.8}, {"v", 1.5}, {"e", 0.4}, {"alpha", 0.6}}));
    std::string other =
        filled(slanting_rod, {{"m", 0.7}, {"l", 3.1}, {"v", 0.2}, {"e", 0.9}, {"alpha", 1.3}}) + "[outputs]\n";
    for (const auto& [name, text] : first["solution"].items())
        other += fmt::format("after_{} = \"{}\"\n", name, text.get<std::string>());
    const auto evaluated = run({"eval", temporary("other.toml", other), "--json"});
    REQUIRE(evaluated.exit == 0);
    const Json outputs = Json::parse(evaluated.out)["outputs"], there = impact_of(other)["after"];
    for (const char* name : {"y", "theta"})
        CHECK(number(outputs[std::string("after_") + name]) ==
              doctest::Approx(number(there[name])).epsilon(1e-13));
}

// A smooth pulse of the same ∫F dt, integrated by the equations of motion; gravity acts meanwhile, so the rates
// differ by a term of first order in the length of the pulse; halving the length halves the difference.
TEST_CASE("impact: it is the limit of a large short force") {
    std::string text = pinned_rod;
    text.replace(text.find("{h}"), 3, "0.9*l");
    const Json limit = impact_of(filled(text, {{"tau", 1}}) + "[[impulse]]\nat = \"P\"\nvector = [\"S\", 0]\n");
    const auto after = [&](double tau) {
        const std::string scene = filled(text, {{"tau", tau}}) + "[[force]]\nat = \"P\"\nvector = [\"F\", 0]\n";
        return json_of({"simulate", temporary("pulse.toml", scene), "--tolerance", "1e-12", "--duration",
                        fmt::format("{}", tau)})["final"]["rates"];
    };
    const Json coarse = after(4e-3), fine = after(2e-3);
    for (const char* name : {"x", "y", "theta"}) {
        CAPTURE(name);
        const double aim = limit["after"][name], one = number(coarse[name]) - aim, half = number(fine[name]) - aim;
        CHECK(std::abs(one) < 0.05);
        CHECK(std::abs(one) > 1e-5);
        CHECK(one / half == doctest::Approx(2).epsilon(0.02));
    }
}

// x' = 2 y' holds before and after the impact; the guess obeys it, so the constraint is not imposed suddenly.
TEST_CASE("impact: guessed rates obey the constraints before the impact") {
    const Json json = impact_of(R"toml(
[parameters]
S = 5
[coordinates]
x = { rate_guess = 0 }
y = { rate = 1.5 }
[energy]
kinetic = "x'^2/2 + y'^2/2"
[[constraint]]
name = "gear"
nonholonomic = "x' - 2*y'"
[impulses]
x = "S"
)toml");
    CHECK(number(json["before"]["x"]) == doctest::Approx(3));
    CHECK(json["imposed"].empty());
    CHECK(number(json["after"]["y"]) == doctest::Approx(1.5 + 2 * 5. / 5));  // (1 + 4) Δy' = 2 S
    CHECK(number(json["loss_in_constraints"]) < 1e-14);
}

// Rates before as numbers, rates after by `eval --at`, multipliers by the impulses of the reactions.
TEST_CASE("impact: its equations hold as claims, and so do those in textbook scenes") {
    int held = 0;
    const auto check = [&](const std::string& text, std::vector<std::string> claims) {
        const Json json = impact_of(text);
        for (const auto& equation : json["equations"]) claims.push_back(equation["text"]);
        for (const auto& condition : json["conditions"]) claims.push_back(condition);
        std::string read = text;
        for (const std::string& claim : claims)
            read += fmt::format("[[claim]]\nequation = \"{}\"\nat = \"impact\"\n", claim);
        CHECK(run({"impact", temporary("claims.toml", read)}).exit == 0);
        std::string outputs = "\n[outputs]\n";
        const auto replace = [](std::string& in, const std::string& mark, const Json& by) {
            for (std::size_t at = in.find(mark); at != std::string::npos; at = in.find(mark))
                in.replace(at, mark.size(), fmt::format("({:.17g})", by.get<double>()));
        };
        for (std::size_t k = 0; k < claims.size(); ++k) {
            std::string claim = claims[k];
            for (const auto& item : json["before"].items()) replace(claim, item.key() + "'(-)", item.value());
            for (const auto& item : json["reactions"].items())
                replace(claim, "lambda_" + item.key(), item.value());
            const std::size_t equals = claim.find('=');
            outputs += fmt::format("c{} = \"{} - ({})\"\n", k, claim.substr(0, equals), claim.substr(equals + 1));
        }
        std::vector<std::string> args{"eval", temporary("held.toml", text + outputs), "--json", "--at"};
        for (const auto& item : json["after"].items())
            args.push_back(fmt::format("{}'={:.17g}", item.key(), item.value().get<double>()));
        const auto result = run(args);
        INFO(result.err);
        REQUIRE(result.exit == 0);
        const Json evaluated = Json::parse(result.out)["outputs"];
        for (const auto& item : evaluated.items()) {
            const std::string claim = claims[static_cast<std::size_t>(std::stoi(item.key().substr(1)))];
            CAPTURE(claim);
            CHECK(std::abs(item.value().get<double>()) < 1e-12);
            ++held;
        }
    };
    check(filled(slanting_rod, {{"m", 2}, {"l", 0.8}, {"v", 1.5}, {"e", 0.4}, {"alpha", 0.6}}), {});
    check(double_pendulum + lock + "[[impulse]]\nat = \"B\"\nvector = [0.3, -0.2]\n", {});
    for (const std::string& file : alembert::test::scenes_in("scenes/textbook")) {
        const alembert::Scene scene = alembert::read_scene(file);
        std::vector<std::string> claims;
        for (const alembert::Claim& claim : scene.claims)
            if (claim.at == alembert::Claim::At::impact)
                claims.push_back(claim.equation.lhs.text + " = " + claim.equation.rhs.text);
        if (!claims.empty()) check(scene.text, claims);
    }
    CHECK(held >= 12);
}

TEST_CASE("impact: if nothing is struck, the rates do not change, and the output says so") {
    for (const std::string more :
         {"", "[[unilateral]]\nname = \"far\"\ngap = \"1 - theta1\"\n",
          "[[unilateral]]\nname = \"opening\"\ngap = \"theta1 - 0.3\"\nrestitution = 1\n"}) {
        const Json json = impact_of(double_pendulum + more);
        CHECK(json["after"] == json["before"]);
        CHECK(number(json["energy_loss"]) == 0);
        CHECK(run({"impact", temporary("calm.toml", double_pendulum + more)}).out.find("Nothing is struck") !=
              std::string::npos);
    }
}

TEST_CASE("impact: a long chain is computed in numbers only, and the output says so") {
    std::string text = "[coordinates]\n";
    for (int i = 0; i < 12; ++i) text += fmt::format("a{} = {}\n", i, 0.1 * i);
    text += "[parameters]\nm = 1\nS = 1\n";
    for (int i = 0; i < 12; ++i)
        text += fmt::format(
            "[[particle]]\nname = \"P{}\"\nmass = \"m\"\nfrom = \"{}\"\nposition = [\"sin(a{})\", \"cos(a{})\"]\n",
            i, i == 0 ? "O" : fmt::format("P{}", i - 1), i, i);
    const Json json = impact_of(text + "[[impulse]]\nat = \"P5\"\nvector = [\"S\", 0]\n");
    CHECK(json["solution"].empty());
    CHECK(json["note"].get<std::string>().find("beyond the readable size") != std::string::npos);
    CHECK(number(json["loss_in_constraints"]) == 0);
    CHECK(number(json["energy_loss"]) == doctest::Approx(-number(json["work_of_impulses"])).epsilon(1e-12));
}

TEST_CASE("impact: impossible impacts are refused with the reason") {
    const auto refused = [](const std::string& more, int code, const char* reason) {
        const auto result = run({"impact", temporary("refused.toml", double_pendulum + more)});
        INFO(result.err);
        CHECK(result.exit == code);
        CHECK(result.err.find(reason) != std::string::npos);
    };
    refused("[[unilateral]]\nname = \"wall\"\ngap = \"0.2 - theta1\"\n", 3, "the gap 'wall' is -0.1");
    refused("[[constraint]]\nname = \"far\"\nholonomic = \"theta1 - 0.4\"\n", 3, "constraint 'far' is off by 0.1");
    refused(
        "[[constraint]]\nname = \"a\"\nnonholonomic = \"theta1' - 1\"\n[[constraint]]\nname = \"b\"\nnonholonomic "
        "= \"theta1' - 2\"\n",
        4, "the constraints contradict each other");
    const auto singular = run(
        {"impact", temporary("massless.toml",
                             "[coordinates]\nx = 0\ny = 0\n[energy]\nkinetic = \"x'^2\"\n[impulses]\ny = 1\n")});
    CHECK(singular.exit == 4);
    CHECK(singular.err.find("mass matrix is singular") != std::string::npos);
}

}  // namespace commands_impact_routes
