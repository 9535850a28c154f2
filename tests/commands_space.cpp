// SPDX-License-Identifier: MIT
// Rolling contacts and quaternion frames, as a user runs them: against constraints written by hand, closed forms
// in elliptic functions, Euler angles, and what is conserved.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"
#include "scenes.hpp"

namespace commands_space {

using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

Json json_of(const std::vector<std::string>& args) {
    const auto result = run(args);
    CAPTURE(result.err);
    REQUIRE(result.exit == 0);
    return Json::parse(result.out);
}

double number(const Json& object, const char* group, const std::string& name) {
    return object[group][name].get<double>();
}

std::string textbook(const std::string& name) {
    return alembert::test::contents(source_path("scenes/textbook/" + name + ".toml"));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    CAPTURE(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// The text without the tables that begin with `header`.
std::string without(std::string text, const std::string& header) {
    for (std::size_t at; (at = text.find(header)) != std::string::npos;) {
        const std::size_t end = text.find("\n[", at + 1);
        text.erase(at, end == std::string::npos ? end : end + 1 - at);
    }
    return text;
}

/// A column of a CSV file.
std::vector<double> column(const std::string& file, const std::string& name) {
    std::ifstream stream(file);
    std::string line, cell;
    std::getline(stream, line);
    std::istringstream names(line);
    int k = 0;
    while (std::getline(names, cell, ',') && cell != name) ++k;
    CAPTURE(name);
    REQUIRE(cell == name);
    std::vector<double> result;
    while (std::getline(stream, line)) {
        std::istringstream cells(line);
        for (int i = 0; i <= k; ++i) std::getline(cells, cell, ',');
        result.push_back(std::stod(cell));
    }
    return result;
}

/// sn, cn, dn by descending Landen transformations (Abramowitz & Stegun, 16.4): φ_N = 2^N a_N u,
/// sin(2φ_{n−1} − φ_n) = (c_n/a_n) sin φ_n.
struct Jacobi {
    double sn, cn, dn;
};
Jacobi jacobi(double u, double m) {
    std::vector<double> a{1}, c{std::sqrt(m)};
    for (double b = std::sqrt(1 - m); std::abs(c.back()) > 1e-17 && a.size() < 12;) {
        const double next = (a.back() + b) / 2;
        c.push_back((a.back() - b) / 2);
        b = std::sqrt(a.back() * b);
        a.push_back(next);
    }
    double phi = std::ldexp(a.back() * u, static_cast<int>(a.size()) - 1);
    for (std::size_t n = a.size() - 1; n > 0; --n) phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
    return {std::sin(phi), std::cos(phi), std::sqrt(1 - m * std::sin(phi) * std::sin(phi))};
}

const std::string table =
    "[[frame]]\nname = \"T\"\nrotate = [[\"z\", \"Omega*t\"]]\n[[body]]\nname = \"table\"\nmass = 1\nframe = "
    "\"T\"\n"
    "position = [0, 0, 0]\n[[rolling]]\nname = \"roll\"\nbody = \"ball\"\non = \"table\"\n";

}  // namespace

TEST_CASE(
    "space: a rolling contact on a turning table is the constraints written by hand, with their multipliers") {
    const std::string by_rows = without(without(textbook("turntable_ball"), "[[constraint]]"), "[[claim]]");
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
    std::string text = without(without(textbook("ball_on_turntable"), "[[constraint]]"), "[[claim]]");
    text = replaced(text, "rotate = [[\"z\", \"psi\"], [\"x\", \"theta\"], [\"z\", \"phi\"]]",
                    "quaternion = [\"a\", \"b\", \"c\", \"d\"]");
    for (const char* angle : {"psi   = ", "theta = ", "phi   = "}) {
        const std::size_t at = text.find(angle);
        REQUIRE(at != std::string::npos);
        text.erase(at, text.find('\n', at) + 1 - at);
    }
    text = replaced(text, "[speeds]", "a = 0.5\nb = 0.5\nc = -0.5\nd = 0.5\n\n[speeds]");
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
    const std::string text = without(without(textbook("rolling_coin"), "[[constraint]]"), "[[claim]]") +
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
    std::string text = textbook("rolling_disc_in_space");
    std::ostringstream spin, heading;
    spin.precision(17);
    heading.precision(17);
    spin << "rate = " << phi_dot << ",";
    heading << "rate = " << psi_dot << ",";
    text = replaced(replaced(replaced(text, "rate = 6.0,", spin.str()), "rate = 0.4,", heading.str()),
                    "rate = 0.2,", "rate = 0.0,");
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

// Landau & Lifshitz, Mechanics, §37, for L² < 2 T B (A, B, C = 1, 2, 3): w1 = a dn, w2 = b sn, w3 = c cn of p t +
// K, where p² and m are as here; w2 starts at its largest.
TEST_CASE("space: the free body moves by Jacobi's elliptic functions, and its moment of momentum stays") {
    const double A = 1, B = 2, C = 3, w1 = 0.01, w2 = 1, T2 = A * w1 * w1 + B * w2 * w2,
                 L2 = A * A * w1 * w1 + B * B * w2 * w2;
    const double a = std::sqrt((T2 * C - L2) / (A * (C - A))), b = std::sqrt((L2 - T2 * A) / (B * (B - A))),
                 c = std::sqrt((L2 - T2 * A) / (C * (C - A))),
                 p = std::sqrt((T2 * C - L2) * (B - A) / (A * B * C)),
                 m = (C - B) * (L2 - T2 * A) / ((B - A) * (T2 * C - L2));
    const std::string scene = source_path("scenes/textbook/free_body_quaternion.toml"),
                      file = temporary("free.csv", "");
    for (const std::string t : {"5", "10", "20"}) {
        CAPTURE(t);
        const Json end = json_of({"simulate", scene, "--json", "--duration", t, "-o", file})["final"];
        const Jacobi e = jacobi(p * std::stod(t) + std::comp_ellint_1(std::sqrt(m)), m);
        CHECK(std::abs(number(end, "speeds", "w1") - a * e.dn) < 1e-10);
        CHECK(std::abs(number(end, "speeds", "w2") - b * e.sn) < 1e-10);
        CHECK(std::abs(number(end, "speeds", "w3") - c * e.cn) < 1e-10);
    }
    const Json end = json_of({"simulate", scene, "--json", "-o", file})["final"];  // by 30 digits, at t = 50
    CHECK(std::abs(number(end, "speeds", "w1") - 0.604575658803382887802411991357) < 1e-10);
    CHECK(std::abs(number(end, "speeds", "w2") - 0.796610490002771404200565729169) < 1e-10);
    CHECK(std::abs(number(end, "speeds", "w3") + 0.349004167700780922294980873671) < 1e-10);
    for (const auto& [name, value] : {std::pair("Hx", 0.01), std::pair("Hy", 2.0), std::pair("Hz", 0.0)})
        for (const double h : column(file, name)) CHECK(std::abs(h - value) < 1e-12);
}

// The same with a free joint and without speeds: four coordinates, their multiplier, and a mass centre that
// drifts.
TEST_CASE("space: a body on a free joint tumbles by Jacobi's elliptic functions") {
    const double A = 1, B = 2, C = 3, w1 = 0.3, w2 = 1, T2 = A * w1 * w1 + B * w2 * w2,
                 L2 = A * A * w1 * w1 + B * B * w2 * w2;
    const double a = std::sqrt((T2 * C - L2) / (A * (C - A))), b = std::sqrt((L2 - T2 * A) / (B * (B - A))),
                 c = std::sqrt((L2 - T2 * A) / (C * (C - A))),
                 p = std::sqrt((T2 * C - L2) * (B - A) / (A * B * C)),
                 m = (C - B) * (L2 - T2 * A) / ((B - A) * (T2 * C - L2));
    const std::string scene = temporary("tumble.toml", R"toml(
[[body]]
name = "brick"
mass = 2
inertia = [1, 2, 3]
[[joint]]
name = "flight"
type = "free"
parent = "N"
child = "brick"
coordinates = { x = { initial = 0, rate = 0.5 }, y = 0, z = 0, e0 = 1, e1 = { initial = 0, rate = 0.15 }, e2 = { initial = 0, rate = 0.5 }, e3 = 0 }
[outputs]
w1 = "dot(omega(brick), ex(brick))"
w2 = "dot(omega(brick), ey(brick))"
w3 = "dot(omega(brick), ez(brick))"
[simulation]
tolerance = 1e-13
)toml"),
                      file = temporary("tumble.csv", "");
    for (const char* by : {"routh", "schiehlen", "roberson-wittenburg"}) {
        CAPTURE(by);
        const Json end = json_of({"simulate", scene, "--json", "--duration", "20", "--by", by, "-o", file});
        const Jacobi e = jacobi(p * 20 + std::comp_ellint_1(std::sqrt(m)), m);
        CHECK(std::abs(column(file, "w1").back() - a * e.dn) < 1e-10);
        CHECK(std::abs(column(file, "w2").back() - b * e.sn) < 1e-10);
        CHECK(std::abs(column(file, "w3").back() - c * e.cn) < 1e-10);
        CHECK(std::abs(number(end["final"], "coordinates", "x") - 10) < 1e-10);
        CHECK(end["constraint_drift"].get<double>() < 1e-13);
    }
}

TEST_CASE("space: a body turned by a quaternion and by Euler angles goes through the same attitudes") {
    std::string by_e = textbook("free_body_quaternion");
    by_e = replaced(replaced(by_e, "e0 = 1", "e0 = \"cos(0.5)\""), "e1 = 0", "e1 = \"sin(0.5)\"");
    by_e = replaced(by_e, "initial = 0.01", "initial = 0.3");
    by_e = without(by_e, "[[claim]]");
    by_e = replaced(
        by_e, "[outputs]",
        "[outputs]\nup1 = \"dot(ex(F), ez(N))\"\nup2 = \"dot(ey(F), ez(N))\"\nside = \"dot(ex(F), ex(N))\"");
    std::string by_angles = replaced(by_e, "quaternion = [\"e0\", \"e1\", \"e2\", \"e3\"]",
                                     "rotate = [[\"z\", \"psi\"], [\"x\", \"theta\"], [\"z\", \"phi\"]]");
    by_angles =
        replaced(by_angles, "e0 = \"cos(0.5)\"\ne1 = \"sin(0.5)\"\ne2 = 0\ne3 = 0", "psi = 0\ntheta = 1\nphi = 0");
    const auto end = [](const std::string& name, const std::string& text, const std::string& by) {
        const std::string file = temporary(name + ".csv", "");
        json_of(
            {"simulate", temporary(name + ".toml", text), "--json", "--duration", "5", "--by", by, "-o", file});
        std::vector<double> last;
        for (const char* item : {"Hx", "Hy", "Hz", "up1", "up2", "side"})
            last.push_back(column(file, item).back());
        return last;
    };
    const std::vector<double> angles = end("angles", by_angles, "kane");
    for (const char* by : {"kane", "routh"}) {  // in three speeds; with the multiplier of e·e = 1
        CAPTURE(by);
        const std::vector<double> e = end(by, by_e, by);
        for (std::size_t k = 0; k < e.size(); ++k) CHECK(std::abs(e[k] - angles[k]) < 1e-10);
    }
    const Json at = json_of({"eval", temporary("routh.toml", by_e), "--json", "--by", "routh"});
    CHECK(std::abs(number(at, "multipliers", "lambda_F")) < 1e-13);
}

// θ, φ, ψ by elliptic functions and quadratures in 30 digits.
TEST_CASE("space: the heavy top follows its elliptic solution, by Euler angles and by a quaternion") {
    const struct {
        const char* t;
        double theta, phi, psi;
    } points[] = {
        {"1", 1.32085057941545680726672145344, 0.24603306559641322029112297, 3.9107935553460414576393327},
        {"5", 1.51400137056292675729735384434, 2.4391451410679134801863664, 19.538898839500581892306919},
        {"10", 1.05359445026001034108299428212, 5.2230966662866849375478739, 39.068918627314689980628869}};
    for (const auto& point : points) {
        CAPTURE(point.t);
        const Json angles = json_of(
            {"simulate", source_path("scenes/textbook/heavy_top.toml"), "--json", "--duration", point.t})["final"];
        CHECK(std::abs(number(angles, "coordinates", "theta") - point.theta) < 1e-10);
        CHECK(std::abs(number(angles, "coordinates", "phi") - point.phi) < 1e-10);
        CHECK(std::abs(number(angles, "coordinates", "psi") - point.psi) < 1e-10);
        const std::string file = temporary("top.csv", "");
        for (const char* name : {"heavy_top_quaternion", "heavy_top_joint"}) {
            CAPTURE(name);
            const Json e = json_of({"simulate", source_path(std::string("scenes/textbook/") + name + ".toml"),
                                    "--json", "--duration", point.t, "-o", file});
            CHECK(std::abs(column(file, "height").back() - std::cos(point.theta)) < 1e-10);
            // z-x-z: e0 = cos θ/2 cos (φ+ψ)/2, e3 = cos θ/2 sin (φ+ψ)/2; both signs are the same attitude,
            // continued from the start.
            const double half = (point.phi + point.psi) / 2;
            CHECK(std::abs(number(e["final"], "coordinates", "e0") - std::cos(point.theta / 2) * std::cos(half)) <
                  1e-10);
            CHECK(std::abs(number(e["final"], "coordinates", "e3") - std::cos(point.theta / 2) * std::sin(half)) <
                  1e-10);
            for (const double v : column(file, "vertical")) CHECK(std::abs(v - 0.5 * 4 * std::cos(1.0)) < 1e-12);
        }
    }
}

// The same disc with its height as a coordinate, kept on the plane by a constraint, and the contact given by the
// normal; the third row of the rolling condition then follows.
TEST_CASE("space: the disc by a quaternion and by angles rolls the same way") {
    std::string text =
        without(without(without(textbook("rolling_disc_in_space"), "[[frame]]"), "[[point]]"), "[[claim]]");
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

TEST_CASE("space: gimbal lock is reported with the frame, and a quaternion passes through the pose") {
    const std::string by_angles = source_path("scenes/textbook/heavy_top.toml");
    const std::string upright = temporary(
        "upright.toml", replaced(textbook("heavy_top"), "theta = { initial = 1,", "theta = { initial = 0,"));
    for (const auto& result : {run({"eval", by_angles, "--at", "theta=0"}), run({"simulate", upright})}) {
        CHECK(result.exit == 4);
        CHECK(result.err.find("the angles phi, theta, psi of frame 'F' are in gimbal lock") != std::string::npos);
        CHECK(result.err.find("give the frame a quaternion") != std::string::npos);
    }
    std::string joint = textbook("heavy_top_joint");
    joint = without(without(without(joint, "[speeds]"), "[outputs]"), "[[claim]]");
    joint = replaced(joint, "coordinates = { e0 = \"cos(theta0/2)\", e1 = \"sin(theta0/2)\", e2 = 0, e3 = 0 }",
                     "angles = \"zxz\"\ncoordinates = { phi = 0, theta = 0, psi = { initial = 0, rate = 4 } }");
    const auto held = run({"simulate", temporary("held.toml", joint)});
    CHECK(held.exit == 4);
    CHECK(held.err.find("give joint 'tip' a quaternion: four coordinates, { e0 = 1, e1 = 0, e2 = 0, e3 = 0 }, in "
                        "place of its three angles") != std::string::npos);
    const std::string passes =
        temporary("passes.toml",
                  replaced(textbook("heavy_top_quaternion"), "theta0 = { value = 1.0", "theta0 = { value = 0.0"));
    const Json end = json_of({"simulate", passes, "--json"})["final"];  // the top sleeps
    CHECK(std::abs(number(end, "coordinates", "e0") - std::cos(20.0)) < 1e-10);
}

TEST_CASE("space: a singular matrix that is no gimbal lock is not called one") {
    const auto result =
        run({"eval", temporary("massless.toml",
                               "[coordinates]\nx = 0\ny = 0\n[[particle]]\nname = \"P\"\nmass = 1\n"
                               "position = [\"x + y\", 0]\n")});
    CHECK(result.exit == 4);
    CHECK(result.err.find("gimbal") == std::string::npos);
}

TEST_CASE("space: the rattleback turns back in one sense and goes on in the other") {
    const std::string text = textbook("rattleback"), file = temporary("rattle.csv", "");
    const auto spins = [&](const std::string& start) {
        const std::string scene = temporary("rattle.toml", replaced(text, "initial = -5.0", "initial = " + start));
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

TEST_CASE("space: mistakes in a quaternion or a contact at the scene's values are reported") {
    const auto off =
        run({"derive", temporary("off.toml", replaced(textbook("free_body_quaternion"), "e1 = 0", "e1 = 0.01"))});
    CHECK(off.exit == 3);
    CHECK(off.err.find("the sum of squares of the quaternion of frame 'F' is 1.0001 at the start; expected 1") !=
          std::string::npos);
    const auto near =
        run({"eval",
             temporary("near.toml", replaced(textbook("free_body_quaternion"), "e0 = 1", "e0 = 1.0000000001"))});
    CHECK(near.exit == 0);
    const std::string still =
        "[coordinates]\nx = 0\n[[body]]\nname = \"B\"\nmass = 1\nposition = [0, 0, \"x\"]\n[[body]]\nname = "
        "\"D\"\nmass = 1\n"
        "position = [0, 1, \"x\"]\n[[rolling]]\nname = \"r\"\nbody = \"B\"\non = \"D\"\ncontact = [0, 0, -1]\n";
    const auto idle = run({"derive", temporary("idle.toml", still)});
    CHECK(idle.exit == 3);
    CHECK(idle.err.find("rolling 'r' says nothing") != std::string::npos);
    const auto torn =
        run({"derive", temporary("torn.toml", replaced(still, "[0, 1, \"x\"]", "[0, \"t\", \"x\"]"))});
    CHECK(torn.exit == 3);
    CHECK(torn.err.find("rolling 'r' cannot hold: along y the contact moves by itself") != std::string::npos);
}

TEST_CASE("space: the gallery's mechanisms in space keep their energy and their loops") {
    for (const char* name : {"rssr", "six_joint_arm", "stewart"}) {
        CAPTURE(name);
        const Json motion = json_of({"simulate", source_path(std::string("scenes/gallery/") + name + ".toml"),
                                     "--json", "--duration", "1"});
        CHECK(motion["energy_drift"].get<double>() < 1e-9);
        if (!motion["constraint_drift"].is_null()) CHECK(motion["constraint_drift"].get<double>() < 1e-12);
    }
}

// The crank's end, the rocker's foot and end: the coupler connects them with its length at every position of the
// crank.
TEST_CASE("space: the rocker of the spatial four-bar stands where the crank's angle puts it") {
    const Json end = json_of({"simulate", source_path("scenes/gallery/rssr.toml"), "--json"})["final"];
    const double alpha = number(end, "coordinates", "alpha"), beta = number(end, "coordinates", "beta");
    const double a = 0.3, b = 1.2, c = 0.8, d = 1.0, h = 0.2;
    // The rocker turns about -y: its end is (d + c cos beta, h, c sin beta).
    const double x = d + c * std::cos(beta) - a * std::cos(alpha), y = h - a * std::sin(alpha),
                 z = c * std::sin(beta);
    CHECK(std::abs(std::sqrt(x * x + y * y + z * z) - b) < 1e-11);
    CHECK(std::abs(alpha - 0.5) > 2 * M_PI);  // the crank goes round
}

TEST_CASE("space: the Furuta pendulum of bodies obeys its hand derivation, and its work is accounted for") {
    const std::string scene = source_path("scenes/gallery/furuta_joints.toml");
    CHECK(run({"check", scene}).out.rfind("proved", 0) == 0);
    CHECK(json_of({"simulate", scene, "--json"})["work_balance"].get<double>() < 1e-10);
}

TEST_CASE("space: impossible moments are refused or reported with the body, at the values of the run") {
    const std::string text =
        "[parameters]\nJ = 1\n[coordinates]\nphi = 0\n[[frame]]\nname = \"F\"\nrotate = [[\"z\", "
        "\"phi\"]]\n[[body]]\nname = \"B\"\n"
        "mass = 1\nframe = \"F\"\nposition = [0, 0]\ninertia = [1, 1, \"J\"]\n";
    const auto with = [&](const std::string& inertia) {
        return temporary("moments.toml", replaced(text, "[1, 1, \"J\"]", inertia));
    };
    CHECK(run({"derive", with("[1, 1, \"2*J\"]")}).err.empty());
    const auto wide = run({"derive", with("[1, 1, \"3*J\"]")});
    CHECK(wide.exit == 0);
    CHECK(wide.err.find("moments.toml:13:11: warning: the principal moments of inertia of body 'B', 1, 1 and 3, "
                        "break the triangle inequality") != std::string::npos);
    const auto negative = run({"derive", with("[1, 1, \"-J\"]")});
    CHECK(negative.exit == 3);
    CHECK(negative.err.find("the moment of inertia of body 'B' is -1; expected zero or more") !=
          std::string::npos);
    const auto tilted = run({"agree", with("{ xx = 1, yy = 1, zz = 1, xy = 2 }")});
    CHECK(tilted.exit == 3);
    CHECK(tilted.err.find("the principal moments of inertia of body 'B', -1, 1 and 3, are not all zero or more") !=
          std::string::npos);
    const auto later = run({"eval", with("[1, 1, \"J\"]"), "--at", "J=-0.5"});
    CHECK(later.exit == 3);
    CHECK(later.err.find("of body 'B', -0.5, 1 and 1, are not all") != std::string::npos);
    // About a point half a metre away: the contribution of the mass centre exceeds the given moment.
    const auto about = run({"derive", with("[1, 0.1, 1]\nabout = \"P\"\n[[point]]\nname = \"P\"\nfrom = "
                                           "\"B\"\noffset = [0.5, 0]\naxes = \"F\"")});
    CHECK(about.exit == 3);
    CHECK(about.err.find("(about its mass centre; they are given about 'P'), -0.15, ") != std::string::npos);
}

TEST_CASE("space: a loop that cannot close is reported with its joint and the distance of its bodies") {
    const std::string text =
        "[[body]]\nname = \"A\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = \"a\"\ntype = "
        "\"revolute\"\nparent = \"N\"\n"
        "child = \"A\"\ncoordinates = { q = 0 }\n[[joint]]\nname = \"b\"\ntype = \"revolute\"\nparent = "
        "\"A\"\nchild = \"N\"\n";
    const auto apart = run({"derive", temporary("apart.toml", text + "parent_point = [0, 0, 1]\n")});
    CHECK(apart.exit == 3);
    CHECK(apart.err.find("joint 'b' cannot close: in its locked direction 3") != std::string::npos);
    CHECK(apart.err.find("the bodies stand apart by -1, and no coordinate can change that") != std::string::npos);
    // The coordinates move these bodies, but never far enough.
    const auto far =
        run({"derive", temporary("far.toml", text + "parent_point = [1, 0, 0]\nchild_point = [3, 0, 0]\n")});
    CHECK(far.exit == 3);
    CHECK(far.err.find("joint 'b' cannot close its loop: constraints 'b_1' and 'b_2' contradict each other") !=
          std::string::npos);
    CHECK(far.out.empty());
}

TEST_CASE(
    "space: an arm of seven joints with all its parameters as symbols accelerates as the one with numbers, by "
    "every formalism of joints") {
    const auto evaluated = [](const std::string& name, const std::string& by) {
        return json_of({"eval", source_path("scenes/benchmark/trees/" + name + ".toml"), "--by", by, "--json"});
    };
    const Json numbers = evaluated("arm7", "recursive")["accelerations"];
    for (const char* by : {"recursive", "kane", "schiehlen", "roberson-wittenburg"}) {
        CAPTURE(by);
        const Json symbols = evaluated("arm7_symbols", by)["accelerations"];
        for (const auto& [name, value] : numbers.items()) {
            CAPTURE(name);
            CHECK(std::abs(symbols[name].get<double>() - value.get<double>()) <
                  1e-12 * std::max(1.0, std::abs(value.get<double>())));
        }
    }
    // The numbers are symbols: another mass and another offset give another arm.
    const Json other = json_of({"eval", source_path("scenes/benchmark/trees/arm7_symbols.toml"), "--at", "m7=0.9",
                                "--at", "px4=0.01", "--json"})["accelerations"];
    CHECK(std::abs(other["q7"].get<double>() - numbers["q7"].get<double>()) > 1e-3);
}

}  // namespace commands_space
