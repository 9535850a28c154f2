// SPDX-License-Identifier: MIT
// --at and --input in the verbs that integrate: values in place of the scene's, and functions of inputs from
// outside.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "json.hpp"
#include "shell.hpp"
#include "tables.hpp"

namespace commands_given {

using namespace alembert::test;

namespace {

/// A pendulum of a length and a start, with a torque from outside.
std::string pendulum(const std::string& l, const std::string& theta, const std::string& rate) {
    static int count = 0;
    return temporary(fmt::format("pendulum_{}.toml", count++), fmt::format(R"toml(gravity = [0, -9.81]
[parameters]
l = {}
heavy = 2
m = "heavy/2"
[inputs]
u = {{ value = 0, given = "outside" }}
wind = "0.1*sin(t)"
[coordinates]
theta = {{ initial = {}, rate = {} }}
[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)", "-l*cos(theta)"]
[forces]
theta = "u + wind"
[simulation]
duration = 3
tolerance = 1e-11
)toml",
                                                                           l, theta, rate));
}

double end_of(const std::string& scene, const std::vector<std::string>& more) {
    std::vector<std::string> words{"simulate", scene};
    words.insert(words.end(), more.begin(), more.end());
    return json_of(words)["final"]["coordinates"]["theta"];
}

std::string printed(const std::vector<std::string>& words) {
    const auto result = run(words);
    CHECK_MESSAGE(result.exit == 0, result.err);
    return result.out;
}

void refused(const std::vector<std::string>& words, const std::string& why) {
    const auto result = run(words);
    CAPTURE(why);
    CHECK(result.exit == 3);
    CHECK_MESSAGE(result.err.find(why) != std::string::npos, result.err);
}

}  // namespace

TEST_CASE("given: simulate, sweep, bench and report begin with the values of --at as if the scene had them") {
    const std::string scene = pendulum("1", "0.1", "0"), other = pendulum("2", "0.5", "1");
    const std::vector<std::string> at{"--at", "l=2", "--at", "theta=0.5", "--at", "theta'=1"};
    const double wanted = end_of(other, {});
    CHECK(end_of(scene, at) == wanted);
    CHECK(end_of(scene, {}) != wanted);
    CHECK(end_of(scene, {"--at", "t=1"}) != end_of(scene, {}));  // the wind is another
    std::vector<std::string> words{"sweep", scene, "--vary", "heavy=2:4:2"};
    words.insert(words.end(), at.begin(), at.end());
    const std::string rows = printed(words);
    CHECK(rows.find(fmt::format("{:.15g}", wanted).substr(0, 12)) != std::string::npos);
    words = {"bench", scene, "--method", "dop853", "--duration", "1", "--json"};
    words.insert(words.end(), at.begin(), at.end());
    const Json measured = json_of(words),
               same = json_of({"bench", other, "--method", "dop853", "--duration", "1", "--json"});
    CHECK(measured["reference"]["final"] == same["reference"]["final"]);
    words = {"report", scene, "--no-motion", "-o", temporary("page.html", "")};
    words.insert(words.end(), at.begin(), at.end());
    CHECK(run(words).exit == 0);
}

TEST_CASE("given: --input takes the place of an input from outside in all verbs that integrate") {
    const std::string scene = pendulum("1", "0.1", "0");
    const double plain = end_of(scene, {}), pushed = end_of(scene, {"--input", "u=2*sin(3*t)"});
    CHECK(plain != pushed);
    CHECK(end_of(scene, {"--at", "u=0.4"}) == doctest::Approx(end_of(scene, {"--input", "u=0.4"})).epsilon(1e-9));
    const std::string rows = printed({"sweep", scene, "--vary", "l=1:2:2", "--input", "u=2*sin(3*t)"});
    CHECK(rows.find(fmt::format("{:.15g}", pushed).substr(0, 9)) != std::string::npos);
}

TEST_CASE("given: stability has columns of B for inputs from outside") {
    const Json told =
        json_of({"stability", pendulum("1", "0", "0"), "--matrices", "--at", "u=0", "--at", "theta=0"});
    const Json& B = told.contains("matrices") ? told["matrices"]["B"] : told["B"];
    REQUIRE(B.size() == 2);
    CHECK(std::abs(B[1][0].get<double>() - 1) < 1e-12);  // m l² = 1
}

TEST_CASE("given: wrong values and inputs are refused with what is wrong") {
    const std::string scene = pendulum("1", "0.1", "0");
    refused({"simulate", scene, "--at", "l=1", "--at", "l=2"}, "'l' is given twice");
    refused({"simulate", scene, "--at", "m=1"}, "defined by other parameters");
    refused({"simulate", scene, "--at", "thet=1"}, "did you mean 'theta'?");
    refused({"bench", scene, "--at", "l"}, "expected NAME=VALUE");
    refused({"sweep", scene, "--at", "l=1", "--vary", "l=1:2:3"}, "leave one out");
    refused({"simulate", scene, "--input", "wind=1"}, "has its function in the scene");
    refused({"simulate", scene, "--input", "v=1"}, "no input of this name");
    refused({"simulate", scene, "--input", "u=theta"}, "'theta' is a coordinate");
    refused({"simulate", scene, "--input", "u"}, "expected NAME=FILE.csv or NAME=EXPRESSION");
}

// The scene language warns where units contradict each other, and so does a function that is given for a run.
TEST_CASE("given: an expression for an input is read as the scene's own, with its units") {
    const std::string scene = temporary("pushed.toml", R"toml(
[parameters]
m = { value = 2, unit = "kg" }
[inputs]
u = { value = 0, unit = "kN", given = "outside" }
[coordinates]
x = { initial = 1, unit = "m" }
[[particle]]
name = "p"
mass = "m"
position = ["x", 0]
[[force]]
at = "p"
vector = ["u", 0]
[simulation]
duration = 1
)toml");
    const auto end = [&](const std::string& u) {
        const auto result = run({"simulate", scene, "--json", "--input", "u=" + u});
        CHECK_MESSAGE(result.exit == 0, result.err);
        return std::pair(Json::parse(result.out)["final"]["coordinates"]["x"].get<double>(), result.err);
    };
    for (const char* u : {"0.003", "3 N", "0.003 kN"}) {
        CHECK(std::abs(end(u).first - 1.75) < 1e-13);
        CHECK(end(u).second.empty());
    }
    const auto [place, told] = end("sin(m*t)");
    CHECK(told.find("warning: --input u=sin(m*t): the argument of sin is a number or an angle") !=
          std::string::npos);
    CHECK(end("m").second.find("--input u=m: the value of 'u' is in kg*m/s^2, but its units make kg") !=
          std::string::npos);
    CHECK(place > 1);
}

TEST_CASE("given: a table of an input is read line by line, and what is wrong is told with its line") {
    const std::string scene = pendulum("1", "0.1", "0");
    const auto with = [&](const char* text) {
        return std::vector<std::string>{"simulate", scene, "--input", "u=" + temporary("rows.csv", text)};
    };
    CHECK(run(with(" time , u\r\n 0 , 1e0\r\n\n+1,-2.5e-1 \n2,.5\n")).exit == 0);
    refused(with("t,u\n0,1\n1abc,2\n"), "line 3 is '1abc,2'; expected 2 numbers");
    refused(with("foo bar baz\n0,1\n"), "line 1 is 'foo bar baz'");
    refused(with("t,x,y\n0,1,2\n"), "line 1 is 't,x,y'");
    refused(with("1x,u\n0,1\n"), "line 1 is '1x,u'");
    refused(with("0,1\nt,u\n"), "line 2 is 't,u'");
    refused(with("0,1\n1,nan\n"), "line 2 is '1,nan'");
    refused(with("0,1\n1,1e999\n"), "line 2 is '1,1e999'");
    refused(with("0,1\n1,2\n1,3\n"), "line 3: t is 1 after 1");
    refused(with("t,u\n"), "fewer than two points");
}

}  // namespace commands_given
