// SPDX-License-Identifier: MIT
// Rolling contacts in space, as a user runs them: against constraints written by hand, closed forms and what is
// conserved.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "edits.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"
#include "tables.hpp"

namespace space_rolling {

using alembert::test::column;
using alembert::test::edited;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::number;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using alembert::test::textbook_text;
using alembert::test::without;

namespace {

const std::string table =
    "[[frame]]\nname = \"T\"\nrotate = [[\"z\", \"Omega*t\"]]\n[[body]]\nname = \"table\"\nmass = 1\nframe = "
    "\"T\"\n"
    "position = [0, 0, 0]\n[[rolling]]\nname = \"roll\"\nbody = \"ball\"\non = \"table\"\n";

}  // namespace

TEST_CASE(
    "space: a rolling contact on a turning table is the constraints written by hand, with their multipliers") {
    const std::string by_rows = without(without(textbook_text("turntable_ball"), "[[constraint]]"), "[[claim]]");
    const std::string contact = temporary("turntable.toml", by_rows + table + "contact = [0, 0, \"-a\"]\n");
    const std::vector<std::string> state{"--json", "--at",      "x=0.3", "--at",   "y=-0.7",
                                         "--at",   "theta=1.1", "--at",  "psi=0.4"};
    std::vector<std::string> a{"eval", contact}, b{"eval", source_path("scenes/textbook/turntable_ball.toml")};
    a.insert(a.end(), state.begin(), state.end());
    b.insert(b.end(), state.begin(), state.end());
    const Json rolling = json_of(a), rows = json_of(b);
    for (const char* q : {"x", "y", "psi", "theta", "phi"}) {
        CHECK(std::abs(number(rolling, "accelerations", q) - number(rows, "accelerations", q)) < 1e-11);
        CHECK(std::abs(number(rolling, "rates", q) - number(rows, "rates", q)) < 1e-11);
    }
    CHECK(rolling["multipliers"].size() == 2);  // the third row holds identically
    CHECK(std::abs(number(rolling, "multipliers", "lambda_roll_x") - number(rows, "multipliers", "lambda_x")) <
          1e-11);
    CHECK(std::abs(number(rolling, "multipliers", "lambda_roll_y") - number(rows, "multipliers", "lambda_y")) <
          1e-11);
    CHECK(std::abs(number(rows, "multipliers", "lambda_x")) > 0.1);
}

// 7 x'' = −2 Ω y', 7 y'' = 2 Ω x': a circle with the rate 2Ω/7 from the state at the start, however the rotation
// of the ball is described.
TEST_CASE("space: a ball turned by a quaternion runs on the turntable's circle") {
    std::string text = without(without(textbook_text("ball_on_turntable"), "[[constraint]]"), "[[claim]]");
    text = edited(text, {{"rotate = [[\"z\", \"psi\"], [\"x\", \"theta\"], [\"z\", \"phi\"]]",
                          "quaternion = [\"a\", \"b\", \"c\", \"d\"]"}});
    for (const char* angle : {"psi   = ", "theta = ", "phi   = "}) {
        const std::size_t at = text.find(angle);
        REQUIRE(at != std::string::npos);
        text.erase(at, text.find('\n', at) + 1 - at);
    }
    text = edited(text, {{"[speeds]", "a = 0.5\nb = 0.5\nc = -0.5\nd = 0.5\n\n[speeds]"}});
    const std::string scene = temporary("ball.toml", text + table + "contact = [0, 0, \"-r\"]\n");
    const Json start = json_of({"eval", scene, "--json"});
    const double x = 0.3, y = -0.1, vx = number(start, "rates", "x"), vy = number(start, "rates", "y"),
                 k = 2 * 3.0 / 7, t = 2;
    CHECK(std::abs(vx - (0.05 * 4.0 - 3.0 * y)) < 1e-13);
    const double s = std::sin(k * t) / k, h = (1 - std::cos(k * t)) / k;
    for (const char* by : {"kane", "routh"}) {
        CAPTURE(by);
        const Json end = json_of({"simulate", scene, "--json", "--by", by, "--tolerance", "1e-11"})["final"];
        CHECK(std::abs(number(end, "coordinates", "x") - (x + vx * s - vy * h)) < 1e-9);
        CHECK(std::abs(number(end, "coordinates", "y") - (y + vy * s + vx * h)) < 1e-9);
    }
}

// For a wheel of radius r that rolls on a turning wheel of radius R: r psi' = (R + r) phi' − R alpha'. With T in
// alpha' and phi',
//   M = (I1 + I2 R²/r²,  −I2 R (R + r)/r²;  …,  (m + I2/r²)(R + r)²),   M (alpha'', phi'') = (tau, 0),   and along
//   the rim the force on the planet is −I2 psi''/r.
TEST_CASE("space: a planet rolls on a driven sun as gears do, the force between them is that of its spin") {
    const double R = 0.5, r = 0.2, m = 1.5, I1 = 0.3, I2 = 0.04, tau = 2, phi = 0.7;
    const std::string scene = temporary("planet.toml", R"toml(
[coordinates]
alpha = { initial = 0.1, rate = 2 }
phi = { initial = 0.7, rate = 0.5 }
psi = { initial = 0.3, rate_guess = 0 }
[[frame]]
name = "S"
rotate = [["z", "alpha"]]
[[frame]]
name = "P"
rotate = [["z", "psi"]]
[[body]]
name = "sun"
mass = 3
frame = "S"
position = [0, 0]
inertia = 0.3
[[body]]
name = "planet"
mass = 1.5
frame = "P"
position = ["0.7*cos(phi)", "0.7*sin(phi)"]
inertia = 0.04
[[rolling]]
name = "teeth"
body = "planet"
on = "sun"
contact = ["-0.2*cos(phi)", "-0.2*sin(phi)"]
[forces]
alpha = 2
)toml");
    const Json json = json_of({"eval", scene, "--json"});
    const double a = I1 + I2 * R * R / (r * r), b = -I2 * R * (R + r) / (r * r),
                 c = (m + I2 / (r * r)) * (R + r) * (R + r), det = a * c - b * b;
    const double alpha = c * tau / det, phi2 = -b * tau / det, psi = ((R + r) * phi2 - R * alpha) / r;
    CHECK(std::abs(number(json, "rates", "psi") - ((R + r) * 0.5 - R * 2) / r) < 1e-13);
    CHECK(std::abs(number(json, "accelerations", "alpha") - alpha) < 1e-12);
    CHECK(std::abs(number(json, "accelerations", "phi") - phi2) < 1e-12);
    CHECK(std::abs(number(json, "accelerations", "psi") - psi) < 1e-12);
    // The multipliers push the planet at the contact: their part along the rim turns it, against psi for a push
    // along (−sin phi, cos phi).
    double force = 0;
    for (const auto& [name, lambda] : json["multipliers"].items())
        force += lambda.get<double>() * (name.ends_with("_x") ? -std::sin(phi) : std::cos(phi));
    CHECK(std::abs(force + I2 * psi / r) < 1e-11);
    CHECK(json_of({"simulate", scene, "--json", "--duration", "3"})["work_balance"].get<double>() < 1e-10);
}

TEST_CASE("space: a coin that rolls upright by a contact moves as by its two velocity constraints") {
    const std::string text = without(without(textbook_text("rolling_coin"), "[[constraint]]"), "[[claim]]") +
                             "\n[[rolling]]\nname = \"rim\"\nbody = \"coin\"\ncontact = [0, 0, \"-r\"]\n";
    const Json contact = json_of({"simulate", temporary("coin.toml", text), "--json"}),
               rows = json_of({"simulate", source_path("scenes/textbook/rolling_coin.toml"), "--json"});
    for (const char* q : {"x", "y", "phi", "theta"})
        CHECK(std::abs(number(contact["final"], "coordinates", q) - number(rows["final"], "coordinates", q)) <
              1e-8);
}

TEST_CASE("space: the disc keeps its energy while it leans and turns") {
    const Json motion = json_of({"simulate", source_path("scenes/textbook/rolling_disc_in_space.toml"), "--json"});
    CHECK(motion["energy_drift"].get<double>() < 1e-10);
    CHECK(motion["constraint_drift"].get<double>() < 1e-13);
    CHECK(std::abs(number(motion["final"], "coordinates", "theta") - 0.3) > 1e-3);
}

// Steady rolling, by moments about the contact P along the heading: r_PC × m a_C = r_PC × m g − H', with H' = Ω ×
// H, Ω = ψ'(0, s, c), H = m r²/4 (0, 2(φ' + ψ's), ψ'c), the centre going round with ψ' on the radius R − r s, R ψ'
// = −r φ'… in one line
//   6 ψ'φ' c + 5 ψ'² s c + 4 (g/r) s = 0.
TEST_CASE("space: a disc that starts in steady rolling keeps its lean and returns after a turn") {
    const double r = 0.5, g = 9.81, theta = 0.3, psi_dot = -0.8, c = std::cos(theta), s = std::sin(theta);
    const double phi_dot = -(5 * psi_dot * psi_dot * s * c + 4 * g / r * s) / (6 * psi_dot * c);
    std::string text = textbook_text("rolling_disc_in_space");
    std::ostringstream spin, heading;
    spin.precision(17);
    heading.precision(17);
    spin << "rate = " << phi_dot << ",";
    heading << "rate = " << psi_dot << ",";
    text = edited(text,
                  {{"rate = 6.0,", spin.str()}, {"rate = 0.4,", heading.str()}, {"rate = 0.2,", "rate = 0.0,"}});
    std::ostringstream turn;
    turn.precision(17);
    turn << 2 * M_PI / std::abs(psi_dot);
    const Json end =
        json_of({"simulate", temporary("steady.toml", text), "--json", "--duration", turn.str()})["final"];
    CHECK(std::abs(number(end, "coordinates", "theta") - theta) < 1e-10);
    CHECK(std::abs(number(end, "coordinates", "psi") + 2 * M_PI) < 1e-10);
    CHECK(std::abs(number(end, "coordinates", "x")) < 1e-9);
    CHECK(std::abs(number(end, "coordinates", "y")) < 1e-9);
}

// The same disc with its height as a coordinate, kept on the plane by a constraint, and the contact given by the
// normal; the third row of the rolling condition then follows.
TEST_CASE("space: the disc by a quaternion and by angles rolls the same way") {
    std::string text =
        without(without(without(textbook_text("rolling_disc_in_space"), "[[frame]]"), "[[point]]"), "[[claim]]");
    text = without(without(without(text, "[[body]]"), "[[rolling]]"), "[coordinates]");
    text += R"toml(
[coordinates]
x = 0
y = 0
z = { guess = 0.5 }
e0 = "cos(0.15)"
e1 = "sin(0.15)"
e2 = 0
e3 = 0
[speeds]
w1 = { form = "dot(omega(disc), ex(D))", initial = 0.2 }
w2 = { form = "dot(omega(disc), ey(D))", initial = "6 + 0.4*sin(0.3)" }
w3 = { form = "dot(omega(disc), ez(D))", initial = "0.4*cos(0.3)" }
[definitions]
tilt = "dot(ez(N), ey(D))"
s = "sqrt(1 - tilt^2)"
[[frame]]
name = "D"
quaternion = ["e0", "e1", "e2", "e3"]
[[body]]
name = "disc"
mass = "m"
frame = "D"
inertia = ["m*r^2/4", "m*r^2/2", "m*r^2/4"]
position = ["x", "y", "z"]
[[constraint]]
name = "touch"
holonomic = "z = r*s"
[[rolling]]
name = "rim"
body = "disc"
contact = ["-r*dot(ez(N), ex(D))/s", 0, "-r*dot(ez(N), ez(D))/s"]
axes = "D"
[outputs]
lean = "tilt"
)toml";
    const std::string scene = temporary("disc.toml", text), file = temporary("disc.csv", "");
    const Json angles =
        json_of({"simulate", source_path("scenes/textbook/rolling_disc_in_space.toml"), "--json"})["final"];
    const double theta = number(angles, "coordinates", "theta"), psi = number(angles, "coordinates", "psi");
    for (const char* by : {"kane", "routh"}) {
        CAPTURE(by);
        const Json end = json_of({"simulate", scene, "--json", "--by", by, "-o", file})["final"];
        CHECK(std::abs(column(file, "lean").back() - std::sin(theta)) < 1e-9);
        // From the foot of the contact to the mass centre: r sin θ across the heading.
        CHECK(std::abs(number(end, "coordinates", "x") -
                       (number(angles, "coordinates", "x") + 0.5 * std::sin(theta) * std::sin(psi))) < 1e-9);
        CHECK(std::abs(number(end, "coordinates", "y") -
                       (number(angles, "coordinates", "y") - 0.5 * std::sin(theta) * std::cos(psi) +
                        0.5 * std::sin(0.3))) < 1e-9);
    }
    const auto proved = run({"agree", scene});
    CHECK(proved.out.starts_with("routh, kane, dalembert, nielsen, schiehlen, "));
    CHECK(proved.out.substr(0, proved.out.find('\n')).ends_with(": proved"));
}

TEST_CASE("space: the rattleback turns back in one sense and goes on in the other") {
    const std::string text = textbook_text("rattleback"), file = temporary("rattle.csv", "");
    const auto spins = [&](const std::string& start) {
        const std::string scene =
            temporary("rattle.toml", edited(text, {{"initial = -5.0", "initial = " + start}}));
        const Json motion =
            json_of({"simulate", scene, "--json", "--duration", "12", "--sample", "0.1", "-o", file});
        CHECK(motion["energy_drift"].get<double>() < 1e-9);
        CHECK(motion["constraint_drift"].get<double>() < 1e-12);
        return column(file, "spin");
    };
    const std::vector<double> back = spins("-5.0"), on = spins("5.0");
    CHECK(back.front() < -4.9);
    CHECK(back.back() > 4.5);
    for (const double spin : on) CHECK(spin > 4.9);
}

}  // namespace space_rolling
