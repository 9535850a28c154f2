// SPDX-License-Identifier: MIT
// Claims about motions while contacts are closed, and claims that assume inequalities.
#include <doctest/doctest.h>

#include "checked.hpp"

namespace check_closed_contacts {

using namespace alembert;
using namespace alembert::test;

namespace {

constexpr Verdict proved = Verdict::proved, refuted = Verdict::refuted, undecided = Verdict::undecided;

Checked checked_with(const std::string& scene, const std::string& claims) {
    return checked(with_claims(parse_scene(scene, "closed.toml"), claims, "claims.txt"));
}

const std::string ladder = R"toml(
gravity = [0, "-g"]
[parameters]
m = 1.0
l = 1.0
a0 = 1.2
g = 9.81
[coordinates]
x = { initial = "l*cos(a0)"
}
y = { initial = "l*sin(a0)" }
alpha = { initial = "a0" }
[[frame]]
name = "L"
rotate = [["z", "-alpha"]]
[[body]]
name = "ladder"
mass = "m"
frame = "L"
inertia = "m*l^2/3"
position = ["x", "y"]
[[unilateral]]
name = "wall"
gap = "x - l*cos(alpha)"
[[unilateral]]
name = "floor"
gap = "y - l*sin(alpha)"
)toml";

}  // namespace

// The ladder's equation while it touches both: 4 l α'' = −3 g cos α.
TEST_CASE("check: claims about a ladder at the wall are proved while the contacts are closed, else undecided") {
    const std::string claims = "4*l*alpha'' = -3*g*cos(alpha)\nx = l*cos(alpha)\n4*l*alpha'' = -2*g*cos(alpha)\n";
    const Checked open = checked_with(ladder, claims);
    check_verdicts(open, {undecided, undecided, refuted});
    CHECK(open.claims[0].reason.find("at = \"closed wall floor\"") != std::string::npos);
    CHECK(open.claims[1].reason.find("at = \"closed wall\"") != std::string::npos);
    check_verdicts(checked_with(ladder, "closed\n" + claims), {proved, proved, refuted});
    check_verdicts(checked_with(ladder, "closed floor wall\n" + claims), {proved, proved, refuted});
    check_verdicts(checked_with(ladder, "closed wall\n" + claims), {refuted, proved, refuted});
    check_verdicts(checked_with(ladder, "where lambda_wall > 0\nwhere lambda_floor > 0\n" + claims),
                   {proved, proved, refuted});
    check_verdicts(checked_with(ladder,
                                "closed\nlambda_wall = m*x''\nlambda_floor = m*y'' + m*g\n"
                                "lambda_floor = m*y''\n"),
                   {proved, proved, refuted});
    check_verdicts(checked_with(ladder, "m*x'' = lambda_wall\nx'' = 0\n"), {proved, proved});
}

// On a ring from which it may fall, a bead obeys m a θ'' = m g sin θ while it touches, and leaves where
// cos θ = 2/3 from rest at the top: λ = m g cos θ − m a θ'².
TEST_CASE("check: a bead on a ball obeys the ball's equations while it touches") {
    const std::string bead =
        "gravity = [0, \"-g\"]\n[parameters]\nm = 1\na = 0.5\ng = 9.81\n[coordinates]\nr = 0.5\n"
        "th = 0.1\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
        "position = [\"r*sin(th)\", \"r*cos(th)\"]\n"
        "[[unilateral]]\nname = \"ball\"\ngap = \"r - a\"\n";
    const std::string claims =
        "a*th'' = g*sin(th)\nlambda_ball = m*g*cos(th) - m*a*th'^2\n"
        "lambda_ball = m*g*cos(th) + m*a*th'^2\n";
    check_verdicts(checked_with(bead, "closed ball\n" + claims), {proved, proved, refuted});
    check_verdicts(checked_with(bead, "where lambda_ball > 0\n" + claims), {proved, proved, refuted});
    CHECK(checked_with(bead, claims).claims[0].verdict == undecided);
}

TEST_CASE("check: a claim that assumes an inequality is refuted only by states that obey it") {
    const std::string scene =
        "[parameters]\nm = 1\nk = 2\n[coordinates]\nx = 0.1\n[[particle]]\nname = \"P\"\n"
        "mass = \"m\"\nposition = [\"x\", 0]\n[[force]]\nat = \"P\"\nvector = [\"-k*abs(x)\", 0]\n";
    check_verdicts(checked_with(scene, "where x > 0\nm*x'' = -k*x\nm*x'' = k*x\n"), {proved, refuted});
    check_verdicts(checked_with(scene, "where x < 0\nm*x'' = k*x\nm*x'' = -k*x\nwhere\nm*x'' = -k*abs(x)\n"),
                   {proved, refuted, proved});
}

TEST_CASE("check: contacts that do not exist and assumptions without a sign are refused with the place") {
    const auto message = [](const std::string& claims) {
        try {
            checked_with(ladder, claims);
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(message("closed wal\nx = 0\n").find("wall") != std::string::npos);
    CHECK(message("where lambda_wall\nx = 0\n").find("one sign > or <") != std::string::npos);
    CHECK(message("where x > 0 > y\nx = 0\n").find("one sign > or <") != std::string::npos);
    CHECK(message("where nothing > 0\nx = 0\n").find("nothing") != std::string::npos);
    CHECK(message("solution\nwhere x > 0\nx = t\n").find("'where'") != std::string::npos);
}

}  // namespace check_closed_contacts
