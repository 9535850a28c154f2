// SPDX-License-Identifier: MIT
// Equilibria where tables are flat in part, and continua along states and along flat pieces, with their ends. What
// is right follows from the points of the tables.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "json.hpp"
#include "program.hpp"

namespace commands_detents {

using namespace alembert::test;

namespace {

constexpr double degree = std::numbers::pi / 180;

std::string rotor(const std::string& load, const std::string& unit = "", double start = 0) {
    return temporary("rotor.toml", fmt::format(R"toml([parameters]
J = 0.1
[tables]
detent = {{ arguments = ["a"], units = ["deg"], period = 360, points = [[0, 0], [80, 0], [85, 1], [95, -1], [100, 0], [359, 0]] }}
[coordinates]
phi = {{ initial = {}, rate = 2{} }}
[energy]
kinetic = "J*phi'^2/2"
[forces]
phi = "detent(phi){} - 0.1*phi'"
)toml",
                                               start, unit.empty() ? "" : ", unit = \"" + unit + "\"", load));
}

std::vector<double> places(const Json& found, const std::string& name) {
    std::vector<double> result;
    for (const Json& one : found["equilibria"]) result.push_back(one["coordinates"][name]);
    return result;
}

}  // namespace

// The detent's torque is −0.2 at 91 and 99 degrees.
TEST_CASE("equilibrium: a detent that acts on a part of the turn has its equilibria wherever the search begins") {
    for (const double start : {0.0, 1.5, 4.0}) {
        CAPTURE(start);
        const Json found = json_of({"equilibrium", rotor(" + 0.2", "", start), "--json"});
        CHECK(found["cyclic"].empty());
        REQUIRE(found["equilibria"].size() == 2);
        const std::vector<double> at = places(found, "phi");
        CHECK(std::abs(at[0] - 91 * degree) < 1e-12);
        CHECK(std::abs(at[1] - 99 * degree) < 1e-12);
        CHECK(found["equilibria"][0]["stable"] == "yes");
        CHECK(found["equilibria"][1]["stable"] == "no");
    }
    const Run judged = run({"stability", rotor(" + 0.2", "", 91 * degree), "--at", "phi'=0"});
    INFO(judged.err);
    CHECK(judged.exit == 0);
}

TEST_CASE("equilibrium: a flat piece without a load is a continuum with its ends") {
    const Json found = json_of({"equilibrium", rotor(""), "--json"});
    int continua = 0, alone = 0;
    for (const Json& one : found["equilibria"]) {
        if (one["isolated"] == true) {
            ++alone;
            CHECK(std::abs(one["coordinates"]["phi"].get<double>() - 90 * degree) < 1e-12);
            continue;
        }
        ++continua;
        REQUIRE(one["family"].contains("from"));
        REQUIRE(one["family"].contains("to"));
        CHECK(std::abs(one["family"]["from"].get<double>() - -260 * degree) < 1e-10);
        CHECK(std::abs(one["family"]["to"].get<double>() - 80 * degree) < 1e-10);
    }
    CHECK(continua == 1);
    CHECK(alone == 1);
    const Run text = run({"equilibrium", rotor("", "deg")});
    CHECK_MESSAGE(text.out.find("each value of phi from -260 deg to 80 deg") != std::string::npos, text.out);
}

TEST_CASE("equilibrium: pieces of a table that are narrow and far away are searched, in two arguments too") {
    const auto scene = [](const std::string& table, const std::string& load) {
        return temporary("narrow.toml", fmt::format(R"toml([parameters]
c = 0.3
[tables]
f = {{ {} }}
[coordinates]
x = 0
y = {{ initial = 0.2 }}
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[forces]
x = "{} - x'"
y = "0.5 - y - y'"
)toml",
                                                    table, load));
    };
    // Between 1000.5 and 1001.5 the force is 1 − 2 (x − 1000.5).
    const std::string far =
        "arguments = [\"x\"], outside = \"hold\", points = [[0, 0.25], [1000, 0.25], [1000.5, 1], "
        "[1001.5, -1], [1002, 0.25], [2000, 0.25]]";
    const std::vector<double> one = places(json_of({"equilibrium", scene(far, "f(x)"), "--json"}), "x");
    REQUIRE(one.size() == 2);
    CHECK(std::abs(one[0] - 1001) < 1e-9);
    CHECK(std::abs(one[1] - 1001.9) < 1e-9);
    // The same along the second argument; along the first there is nothing.
    const std::string map =
        "arguments = [\"y\", \"x\"], outside = \"hold\", points = [[-1, 0, 0.25], [-1, 50, 0.25], "
        "[-1, 51, -1], [-1, 52, 0.25], [1, 0, 0.25], [1, 50, 0.25], [1, 51, -1], [1, 52, 0.25]]";
    const std::vector<double> two = places(json_of({"equilibrium", scene(map, "f(y, x)"), "--json"}), "x");
    REQUIRE(two.size() == 2);
    CHECK(std::abs(two[0] - 50.2) < 1e-9);
    CHECK(std::abs(two[1] - 51.8) < 1e-9);
}

// y = u/(1 + w) whatever w is, and y = 0 without u.
TEST_CASE("equilibrium: a state that chooses in a continuum is told, and none of its states is listed alone") {
    const auto scene = [](double u, double wear) {
        return temporary("wear.toml", fmt::format(R"toml([coordinates]
y = {{ initial = 0.1 }}
[states]
wear = {{ rate = "0.2*abs(y')*(1 - wear)", initial = {} }}
[[particle]]
name = "p"
mass = 1
position = ["y", 0]
[forces]
y = "{} - y*(1 + wear) - 3*y'"
)toml",
                                                  wear, u));
    };
    for (const double wear : {0.0, 0.3, 0.9}) {
        for (const Json& one :
             json_of({"equilibrium", scene(0, wear), "--starts", "400", "--json"})["equilibria"]) {
            CAPTURE(one.dump());
            CHECK(one["isolated"] == false);
        }
        const Json found = json_of({"equilibrium", scene(2, wear), "--starts", "1500", "--json"});
        CHECK(found["equilibria"].size() == 2);  // y > 0 and y < 0 are two branches of the hyperbola
        for (const Json& one : found["equilibria"]) CHECK(one["isolated"] == false);
    }
}

// z' = 0 with ε = 0: z stays as it is, and x rests at z.
TEST_CASE("equilibrium: a state whose rate is zero with the values of the parameters keeps its value") {
    const auto found = [](const std::string& rate) {
        return json_of({"equilibrium",
                        temporary("kept.toml", fmt::format(R"toml([parameters]
eps = 0
a = 0.3
b = 0.1
[coordinates]
x = 1
[states]
z = {{ rate = "{}", initial = 0.7 }}
[[particle]]
name = "p"
mass = 1
position = ["x", 0]
[forces]
x = "z - x - x'"
)toml",
                                                           rate)),
                        "--json"});
    };
    for (const char* rate : {"eps*(1 - z)", "(a - 3*b)*z*x", "0*z"}) {
        CAPTURE(std::string(rate));
        const Json kept = found(rate);
        REQUIRE(kept["equilibria"].size() == 1);
        CHECK(kept["equilibria"][0]["isolated"] == true);
        CHECK(std::abs(kept["equilibria"][0]["coordinates"]["x"].get<double>() - 0.7) < 1e-12);
    }
}

TEST_CASE("stability: the state near by is told in the units in which it is to be given") {
    const Run asked = run({"stability", rotor(" + 0.2", "deg", 88), "--at", "phi'=0"});
    const std::size_t at = asked.err.find("--at phi=");
    REQUIRE_MESSAGE(at != std::string::npos, asked.err);
    const std::string word = asked.err.substr(at + 5, asked.err.find_first_of(" ;", at + 5) - at - 5);
    CHECK_MESSAGE(std::abs(std::stod(word.substr(4)) - 91) < 1e-6, word);
    CHECK(run({"stability", rotor(" + 0.2", "deg", 88), "--at", word, "--at", "phi'=0"}).exit == 0);
}

namespace {

/// A particle in the plane under these forces.
std::string in_plane(const std::string& start, const std::string& forces) {
    return temporary("plane.toml", fmt::format(R"toml(
[coordinates]
{}
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[forces]
{}
)toml",
                                               start, forces));
}

Json family_of_first(const std::string& scene) {
    const Json found = json_of({"equilibrium", scene, "--json"});
    REQUIRE(found["equilibria"].size() > 0);
    return found["equilibria"][0]["family"];
}

}  // namespace

// The states of rest are y = s max(0, x − 0.7): a corner at 0.7, no end.
TEST_CASE("equilibrium: a corner of a continuum is no end, and what was looked for in vain is told") {
    for (const char* const slope : {"2", "0.5", "200", "-3"}) {
        CAPTURE(slope);
        const std::string scene =
            in_plane("x = 0.3\ny = 0.3", fmt::format("y = \"{}*max(0, x - 0.7) - y\"", slope));
        const Json family = family_of_first(scene);
        CHECK(family["free"] == Json{"x"});
        CHECK_FALSE(family.contains("from"));
        CHECK_FALSE(family.contains("to"));
        CHECK(family["seen_from"].get<double>() < -1);
        CHECK(family["seen_to"].get<double>() > 0.75);
        CHECK(run({"equilibrium", scene}).out.find("no ends were found between") != std::string::npos);
    }
    // y = |x| turns by a right angle.
    const Json turned =
        json_of({"equilibrium", in_plane("x = 0.3\ny = 0.3", "x = \"abs(x) - y\"\ny = \"abs(x) - y\""), "--json"});
    CHECK(turned["equilibria"].size() == 1);
    CHECK_FALSE(turned["equilibria"][0]["family"].contains("from"));
    CHECK_FALSE(turned["equilibria"][0]["family"].contains("to"));
}

TEST_CASE("equilibrium: ends are found where numbers round beside them, and at the state itself") {
    const Json rounded =
        family_of_first(in_plane("x = 0.3\ny = 0.1", "x = \"-max(0, x-1.03)-min(0,x+1.03)\"\ny = \"-y\""));
    CHECK(rounded["from"].get<double>() == doctest::Approx(-1.03).epsilon(1e-12));
    CHECK(rounded["to"].get<double>() == doctest::Approx(1.03).epsilon(1e-12));
    const std::string flat = temporary("flat.toml", R"toml(
[coordinates]
x = 0
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[forces]
x = "-f(x)"
[tables]
f = { arguments = ["length"], points = [[-3,-1],[-2,0],[-1,0],[0,1],[1,0],[4,0],[4.01,2],[5,3]] }
)toml");
    const Json found = json_of({"equilibrium", flat, "--json"})["equilibria"];
    REQUIRE(found.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
        CHECK(found[k]["family"]["from"].get<double>() == doctest::Approx(k == 0 ? -2 : 1).epsilon(1e-12));
        CHECK(found[k]["family"]["to"].get<double>() == doctest::Approx(k == 0 ? -1 : 4).epsilon(1e-12));
    }
    // A strip between x − 0.5 and x: its edges are no continua of their own.
    const Json strip =
        json_of({"equilibrium",
                 in_plane("x = 0\ny = 0", "x = \"-max(0, x-1)-min(0,x+1)\"\ny = \"-max(0, y-x)-min(0,y-x+0.5)\""),
                 "--json"});
    REQUIRE(strip["equilibria"].size() == 1);
    CHECK(strip["equilibria"][0]["family"]["dimension"] == 2);
}

// Between the stops there is no force; phi is no angle, because turns lead to the stops.
TEST_CASE("equilibrium: a coordinate with a stop further off than a turn is no angle") {
    const auto stopped = [](const std::string& force) {
        return temporary("stop.toml", fmt::format(R"toml(
[coordinates]
phi = {{ initial = 0.2 }}
[[particle]]
name = "P"
mass = 1
position = ["cos(phi)", "sin(phi)"]
[forces]
phi = "{}"
)toml",
                                                  force));
    };
    const Json free = family_of_first(stopped("-max(0, phi - 23) - min(0, phi + 1)"));
    CHECK(free["from"].get<double>() == doctest::Approx(-1).epsilon(1e-9));
    CHECK((free.contains("to") ? free["to"] : free["seen_to"]).get<double>() > 7);
}

}  // namespace commands_detents
