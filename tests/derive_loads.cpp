// SPDX-License-Identifier: MIT
// What `derive` prints holds at the accelerations and multipliers that are computed: no load is lost on the way to
// the page, whether equations are written out or with intermediate symbols.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "algebra/notation/text.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/derive/derive.hpp"
#include "analysis/derive/intermediate_form.hpp"
#include "model/formalism/dalembert.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/routh.hpp"
#include "oracle.hpp"
#include "program/lower/lower.hpp"
#include "scenes.hpp"

namespace derive_loads {

using namespace alembert;

namespace {

Expression parsed(const Phrase& phrase) {
    std::vector<Diagnostic> mistakes;
    Expression e = parse_expression(text(phrase), {}, mistakes);
    REQUIRE(mistakes.empty());
    return e;
}

/// Equations as they are printed, with the names that they use.
struct Printed {
    std::vector<std::pair<Phrase, Phrase>> names, equalities;
};

Printed printed(const Derivation& shown) {
    Printed result{.names = shown.speeds, .equalities = shown.kinematics};
    for (const auto* list : {&shown.definitions, &shown.abbreviations})
        result.names.insert(result.names.end(), list->begin(), list->end());
    for (const ReadableEquation& e : shown.equations) result.equalities.emplace_back(e.lhs, e.rhs);
    return result;
}

/// The same equations with intermediate symbols, which derivations have only where they are long.
Printed with_symbols(const DerivedScene& d) {
    const Mechanism m = in_terms_of(d.equations, d.mechanism);
    const IntermediateForm form = intermediate_form(
        lower(m, d.equations, energy_of(m), {.reactions_are_letters = true}), m, d.equations, {});
    Printed result{.names = d.shown.speeds, .equalities = form.kinematics};
    result.names.insert(result.names.end(), form.definitions.begin(), form.definitions.end());
    for (const ReadableEquation& e : form.equations) result.equalities.emplace_back(e.lhs, e.rhs);
    return result;
}

/// Of how many equations the truth is known. The motion that they are held against comes from d'Alembert's
/// equations where these apply, and from a program in which reactions are no letters.
int check_holds(const DerivedScene& d, const Printed& what, unsigned seed) {
    Scene scene = d.scene;
    for (const auto& [name, value] : what.names)
        scene.definitions.push_back({.name = {text(name), {}}, .value = parsed(value)});
    Mechanism m = d.mechanism;  // contacts are closed, at other places than the start
    m.q_is_guess.assign(m.q.size(), true);
    m.qdot_is_guess.assign(m.q.size(), true);
    const Equations e = m.size() > 0 && masses_are_known(m) ? dalembert(m) : routh(m);
    const test::Oracle oracle(scene, m, e, seed);
    int known = 0;
    for (const auto& [lhs, rhs] : what.equalities) {
        const std::string line = text(lhs) + " = " + text(rhs);
        CAPTURE(line);
        const Equality equality{.lhs = parsed(lhs), .rhs = parsed(rhs)};
        const std::optional<bool> holds = oracle.holds(equality);
        known += holds.has_value();
        CHECK(holds != false);
    }
    return known;
}

}  // namespace

TEST_CASE("derive: printed equations hold at computed motions, written out and with intermediate symbols") {
    std::vector<std::string> files;
    for (const char* const folder : {"scenes/textbook", "scenes/friction", "scenes/benchmark", "scenes/gallery",
                                     "scenes/stability", "tests/odd"})
        for (const std::string& file : test::scenes_in(folder)) files.push_back(file);
    constexpr int largest = 12;  // coordinates; more take long
    std::size_t known = 0, all = 0;
    for (const std::string& file : test::every_third(files, 0)) {
        CAPTURE(file);
        Derived one = derived(read_scene(file), {});
        if (one.mechanism.size() > largest) continue;
        const DerivedScene d = explained(std::move(one));
        for (const Printed& what : {printed(d.shown), with_symbols(d)}) {
            all += what.equalities.size();
            known += check_holds(d, what, 7);
        }
    }
    CHECK(known >= all * 97 / 100);  // tippe_top's have no values at its random states
}

TEST_CASE("derive: friction in a plane by a reaction is printed, written out and with intermediate symbols") {
    for (const bool is_flat : {true, false}) {
        CAPTURE(is_flat);
        const std::string turns = is_flat ? "" : "a = 0.1\nb = 0.1\n",
                          frame = is_flat ? "rotate = [[\"z\", \"psi\"]]"
                                          : "rotate = [[\"z\", \"psi\"], [\"x\", \"a\"], [\"y\", \"b\"]]";
        const Scene scene = parse_scene(
            "gravity = [0, 0, \"-g\"]\n[parameters]\nm = 2\nA = 0.05\nJ = 0.08\nR = 0.3\ng = 9.81\nmu = 0.2\n"
            "[coordinates]\nx = { initial = 0, rate = 1 }\ny = 0\nz = 0.5\npsi = 0.3\n" +
                turns + "[[frame]]\nname = \"B\"\n" + frame +
                "\n[[body]]\nname = \"plate\"\nmass = \"m\"\nframe = \"B\"\nposition = [\"x\", \"y\", \"z\"]\n"
                "inertia = [\"A\", \"A\", \"J\"]\n[[point]]\nname = \"F\"\nfrom = \"plate\"\n"
                "offset = [\"R\", 0, \"-R\"]\naxes = \"B\"\n[[unilateral]]\nname = \"floor\"\n"
                "gap = \"dot(pos(F), ez(N))\"\n[[friction]]\nname = \"sole\"\ncoefficient = \"mu\"\n"
                "slip = [\"dot(vel(F), ex(N))\", \"dot(vel(F), ey(N))\"]\non = \"floor\"\n",
            "plate.toml");
        const DerivedScene d = explained(derived(scene, {}));
        CHECK(d.shown.definitions.empty() == is_flat);
        REQUIRE(d.shown.frictions.size() == 1);
        CHECK(text(d.shown.frictions[0].sliding) == "mu*lambda_floor");
        for (const Printed& what : {printed(d.shown), with_symbols(d)})
            CHECK(check_holds(d, what, 3) == d.equations.size());
    }
}

// Written out, the sliding velocity X' has hundreds of terms.
TEST_CASE("derive: what slides against friction, and what a constraint holds, are told however long they are") {
    const Scene scene = parse_scene(
        "coordinates = { a = 0.1, b = 0.2, c = { guess = 0.3 } }\n[definitions]\n"
        "X = \"(1 + a + b)^5*(2 + b + c)^5*sin(a)/1000\"\nY = \"c + (1 + a*b)^4*(1 + c)^4*(1 + a - c)^3/100\"\n"
        "[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"a\", \"b\", \"c\"]\n"
        "[[constraint]]\nname = \"surface\"\nholonomic = \"Y - 0.5\"\n"
        "[[friction]]\nname = \"tip\"\ncoefficient = 0.3\nslip = \"X'\"\non = \"surface\"\n",
        "long.toml");
    const DerivedScene d = explained(derived(scene, {}));
    REQUIRE(d.shown.frictions.size() == 1);
    REQUIRE(d.shown.constraints.size() == 1);
    Printed what = printed(d.shown);
    CHECK(!d.shown.definitions.empty());
    const auto given = [](const std::string& name, int order) {
        SymbolInfo info;
        info.name = name;
        info.order = order;
        return phrases::symbol(GiNaC::symbol(name), info);
    };
    const Phrase half = phrases::number(Rational(1) / 2);
    what.equalities.emplace_back(d.shown.frictions[0].sliding_velocity, given("X", 1));
    what.equalities.emplace_back(d.shown.constraints[0].second,
                                 phrases::sum({given("Y", 0), phrases::negative(half)}));
    CHECK(check_holds(d, what, 5) == 5);
}

}  // namespace derive_loads
