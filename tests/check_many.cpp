// SPDX-License-Identifier: MIT
// Many claims about one scene: the equations are derived once, and each claim is judged as if it were alone.
#include <doctest/doctest.h>

#include <algorithm>

#include "algebra/notation/text.hpp"
#include "analysis/derive/derive.hpp"
#include "check/claim_tree.hpp"
#include "check/phrase_tree.hpp"
#include "checked.hpp"

namespace check_many {

using namespace alembert;

namespace {

/// How many intermediate symbols the scene has: every derivation declares some.
std::size_t intermediates(const Mechanism& m) {
    const std::vector<GiNaC::symbol>& all = m.symbols->all();
    return static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [&](const GiNaC::symbol& s) { return m.symbols->info(s).intermediate; }));
}

/// The phrase that a reader sees and the tree that a checker reads are of one formula.
void check_tree(const Phrase& phrase) {
    std::vector<Diagnostic> mistakes;
    const std::string written = text(phrase);
    const Expression parsed = parse_expression(written, {}, mistakes);
    if (!parsed.tree) return;  // names that no claim can hold
    CAPTURE(written);
    CHECK(same(*tree_of(phrase), *parsed.tree));
}

}  // namespace

TEST_CASE("check: the tree of a formula is that of its text, in derivations of textbook scenes") {
    int formulas = 0;
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 1)) {
        CAPTURE(file);
        const Derivation shown = derive(read_scene(file)).shown;
        for (const ReadableEquation& equation : shown.equations)
            for (const Phrase* side : {&equation.lhs, &equation.rhs}) check_tree(*side), ++formulas;
        for (const auto* list : {&shown.energies, &shown.forces, &shown.derivatives})
            for (const Statement& statement : *list) check_tree(statement.value), ++formulas;
        for (const auto* list : {&shown.definitions, &shown.speeds, &shown.kinematics})
            for (const auto& [name, value] : *list) check_tree(value), ++formulas;
        for (const auto& [name, zero] : shown.constraints) check_tree(zero), ++formulas;
    }
    CHECK(formulas > test::at_least(300));
}

TEST_CASE("check: signs, quotients and functions of a formula are where its text has them") {
    using namespace phrases;
    const auto name = [](const std::string& letter, int order = 0) {
        SymbolInfo info;
        info.name = letter;
        info.order = order;
        return symbol(GiNaC::symbol(letter), info);
    };
    const Phrase x = name("x"), y = name("y", 2), half = number(Rational(1) / 2);
    for (const Phrase& phrase : {negative(product({x, y})), product({half, x, quotient(y, product({x, x}))}),
                                 sum({negative(quotient(x, y)), negative(sum({x, y})), negative(power(x, 2))}),
                                 product({negative(x), y}), power(sum({x, y}), Rational(-3) / 2),
                                 quotient(sum({x, y}), half), call("signum", {negative(product({half, x}))}),
                                 call("maximum", {x, sum({y, number(Rational(981) / 100, true)})}),
                                 power(quotient(x, y), 3), quotient(quotient(x, y), quotient(y, x))})
        check_tree(phrase);
}

TEST_CASE("check: a scene's equations are derived once, however many claims are judged") {
    const Scene scene = read_scene(test::source_path("scenes/textbook/double_pendulum.toml"));
    for (const char* by : {"", "lagrange", "kane"}) {
        CAPTURE(by);
        const Derived d = derived(scene, {.by = by, .on_sheets = true});
        Checker checker(d);
        checker.check(scene);
        const std::size_t after_one = intermediates(d.mechanism);
        for (int k = 0; k < 3; ++k) test::check_verdicts(checker.check(scene), {Verdict::proved, Verdict::proved});
        CHECK(intermediates(d.mechanism) == after_one);
    }
}

TEST_CASE("check: claims are judged one by one as they are judged together") {
    const std::vector<std::pair<std::string, std::string>> scenes{
        {"double_pendulum",
         "m2*l1*theta1''*cos(theta1-theta2) + m2*l2*theta2'' - m2*l1*theta1'^2*sin(theta1-theta2) + "
         "m2*g*sin(theta2) = F*cos(theta2)\n"
         "m2*l1*theta1''*cos(theta1-theta2) + m2*l2*theta2'' + m2*l1*theta1'^2*sin(theta1-theta2) + "
         "m2*g*sin(theta2) = F*cos(theta2)\n"
         "theta1'' = theta2''\n"
         "sin(theta1)^2 + cos(theta1)^2 = 1\n"},
        {"slider_crank", ""},
        {"bouncing_ball", ""},
        {"rolling_coin", ""}};
    for (const auto& [name, claims] : scenes) {
        CAPTURE(name);
        Scene scene = read_scene(test::source_path("scenes/textbook/" + name + ".toml"));
        if (!claims.empty()) scene = with_claims(scene, claims, "claims.txt");
        std::erase_if(scene.claims, [](const Claim& claim) {  // these are judged with others
            return !claim.unknowns.empty() || !claim.constants.empty() || claim.at == Claim::At::solution;
        });
        REQUIRE(!scene.claims.empty());
        const Checked together = check(scene).checked;
        Checker checker(derived(scene, {.on_sheets = true}));
        for (std::size_t k = scene.claims.size(); k-- > 0;) {
            Scene one = scene;
            one.claims = {scene.claims[k]};
            const Checked alone = checker.check(one);
            REQUIRE(alone.claims.size() == 1);
            CAPTURE(text_of(scene.claims[k].equation));
            CHECK(alone.claims[0].verdict == together.claims[k].verdict);
            CHECK(alone.claims[0].reason == together.claims[k].reason);
            CHECK(alone.claims[0].counterexample == together.claims[k].counterexample);
            CHECK(alone.claims[0].nearest == together.claims[k].nearest);
        }
    }
}

}  // namespace check_many
