// SPDX-License-Identifier: MIT
// Forces at places that move within a body: Reut's column of two rods is pushed along a fixed line. The equations
// are by hand: δW = −P·δx of the rod's point that is on the line.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "analysis/derive/derived.hpp"
#include "checked.hpp"

namespace model_moving_place {

using namespace alembert;
using namespace alembert::test;

namespace {

std::string column(const std::string& on, bool bodies = false) {
    return std::string(
               "allow = [\"unused\"]\n[parameters]\nm = 1\nl = 1\nk = 1\nP = 1\n[coordinates]\na1 = 0\na2 = 0\n"
               "[[point]]\nname = \"A\"\noffset = [\"l*cos(a1)\", \"l*sin(a1)\"]\n"
               "[[particle]]\nname = \"one\"\nmass = \"2*m\"\nat = \"A\"\n"
               "[[frame]]\nname = \"F\"\nrotate = [[\"z\", \"a2\"]]\n") +
           (bodies ? "[[body]]\nname = \"two\"\nframe = \"F\"\ninertia = 0\n" : "[[particle]]\nname = \"two\"\n") +
           "mass = \"m\"\nfrom = \"A\"\nposition = [\"l*cos(a2)\", \"l*sin(a2)\"]\n"
           "[[spring]]\nalong = \"a1\"\nstiffness = \"k\"\n[[spring]]\nalong = \"a2 - a1\"\nstiffness = \"k\"\n"
           "[[point]]\nname = \"push\"\nfrom = \"A\"\n"
           "offset = [\"l*cos(a2) + (l*sin(a1)+l*sin(a2))*tan(a2)\", \"-l*sin(a1)\"]\n"
           "[[force]]\nat = \"push\"\nvector = [\"-P\", 0]\n" +
           (on.empty() ? "" : "on = \"" + on + "\"\n");
}

const std::string along_the_body =
    "3*m*l^2*a1'' + m*l^2*cos(a1-a2)*a2'' + m*l^2*sin(a1-a2)*a2'^2 + k*a1 - k*(a2-a1) = P*l*sin(a1)\n"
    "m*l^2*a2'' + m*l^2*cos(a1-a2)*a1'' - m*l^2*sin(a1-a2)*a1'^2 + k*(a2-a1) = -P*l*sin(a1)\n";

}  // namespace

TEST_CASE("force: on a body it works along the body's point, and without it along the way of the place") {
    for (const auto& [on, bodies] : {std::pair{"F", false}, std::pair{"F", true}, std::pair{"two", true}}) {
        CAPTURE(on);
        const Scene scene = parse_scene(column(on, bodies), "reut.toml");
        check_verdicts(checked(with_claims(scene, along_the_body, "claims.txt")),
                       {Verdict::proved, Verdict::proved});
        CHECK(derived(scene).warnings.empty());
    }
    const Scene without = parse_scene(column(""), "reut.toml");
    CHECK(checked(with_claims(without, along_the_body, "claims.txt")).claims[0].verdict == Verdict::refuted);
    const Derived d = derived(without);
    REQUIRE(d.warnings.size() == 1);
    CHECK(d.warnings[0].find("'push' is fixed in no body") != std::string::npos);
}

TEST_CASE("force: places that are fixed in a body, a frame or the ground need no word") {
    const std::string scene =
        "[parameters]\nl = 1\n[coordinates]\na = 0.3\nx = 0\n[[frame]]\nname = \"F\"\nrotate = [[\"z\", \"a\"]]\n"
        "[[body]]\nname = \"B\"\nmass = 1\nframe = \"F\"\ninertia = 1\nposition = [\"x + l*cos(a)\", "
        "\"l*sin(a)\"]\n";
    for (const char* const point : {"offset = [\"x\", 0]", "offset = [\"x + 2*l*cos(a)\", \"2*l*sin(a)\"]",
                                    "from = \"B\"\noffset = [1, 2]\naxes = \"F\"", "offset = [1, 2]"}) {
        CAPTURE(point);
        const Derived d = derived(
            parse_scene(scene + "[[point]]\nname = \"P\"\n" + point + "\n[[force]]\nat = \"P\"\nvector = [1, 2]\n",
                        "places.toml"));
        // A force on the ground moves nothing, which is another matter.
        for (const std::string& warning : d.warnings) CHECK(warning.find("fixed in no body") == std::string::npos);
    }
}

TEST_CASE("force: a point of the last body of a chain of turning joints is fixed in that body") {
    std::string scene = "[parameters]\na = 0.1\n";
    for (int k = 0; k < 6; ++k)
        scene += fmt::format(
            "[[body]]\nname = \"b{0}\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = \"j{0}\"\nparent = "
            "\"{1}\"\n"
            "child = \"b{0}\"\nparent_point = [\"a\", 0.2, 0.3]\nchild_point = [0, 0.1, -0.2]\ntype = "
            "\"revolute\"\n"
            "axis = \"{2}\"\ncoordinates = {{ q{0} = 0 }}\n",
            k, k == 0 ? "N" : fmt::format("b{}", k - 1), std::string(1, "xyz"[k % 3]));
    scene += "[[frame]]\nname = \"tool\"\nparent = \"b5\"\nrotate = [[\"x\", \"a\"]]\n";
    const std::string force = "[[force]]\nat = \"tip\"\nvector = [1, 0, 0.3]\n";
    const auto warnings = [&](const std::string& points) {
        std::size_t count = 0;
        for (const std::string& warning : derived(parse_scene(scene + points + force, "chain.toml")).warnings)
            count += warning.find("fixed in no body") != std::string::npos ? 1 : 0;
        return count;
    };
    const std::string tip =
        "[[point]]\nname = \"tip\"\nfrom = \"{}\"\noffset = [0.1, \"{}\", 0.03]\naxes = \"{}\"\n";
    const std::string hand = "[[point]]\nname = \"hand\"\nfrom = \"b5\"\noffset = [\"a\", 0, 0]\naxes = \"b5\"\n";
    CHECK(warnings(fmt::format(fmt::runtime(tip), "b5", "0.02", "b5")) == 0);
    CHECK(warnings(hand + fmt::format(fmt::runtime(tip), "hand", "0.02*a", "tool")) == 0);
    // At a distance that changes it is not.
    CHECK(warnings(hand + fmt::format(fmt::runtime(tip), "hand", "0.02*q2", "b5")) == 1);
}

TEST_CASE("force: 'on' needs a body, or a frame and a place given from a point of it") {
    const auto message = [](std::string text) {
        try {
            derived(parse_scene(std::move(text), "reut.toml"));
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(message(column("G")).find("'G'") != std::string::npos);
    std::string from_origin = column("F");
    const std::string from = "name = \"push\"\nfrom = \"A\"\n";
    from_origin.replace(from_origin.find(from), from.size(), "name = \"push\"\n");
    CHECK(message(from_origin).find("no place of its own") != std::string::npos);
}

}  // namespace model_moving_place
