// SPDX-License-Identifier: MIT
// `linearize` as a user runs it, and the bicycle in motion against its first approximation.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include <Eigen/Dense>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_linearize {

using alembert::test::contents;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::number;
using alembert::test::Run;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

const std::string bicycle = source_path("scenes/gallery/bicycle.toml");

Eigen::MatrixXd matrix(const Json& rows) {
    Eigen::MatrixXd result(rows.size(), rows.empty() ? 0 : rows[0].size());
    for (Eigen::Index i = 0; i < result.rows(); ++i)
        for (Eigen::Index j = 0; j < result.cols(); ++j) result(i, j) = rows[i][j].get<double>();
    return result;
}

}  // namespace

TEST_CASE("linearize: JSON has the matrices, the states and the eigenvalues") {
    const Json near = json_of({"linearize", bicycle, "--json", "--at", "kick=0", "--at", "v=5"});
    for (const char* key : {"M", "C", "G", "K", "N", "A", "B"}) CHECK(near["matrices"].contains(key));
    const Eigen::MatrixXd C = matrix(near["matrices"]["C"]), G = matrix(near["matrices"]["G"]),
                          K = matrix(near["matrices"]["K"]), N = matrix(near["matrices"]["N"]),
                          A = matrix(near["matrices"]["A"]);
    CHECK(C == C.transpose());
    CHECK(G == -G.transpose());
    CHECK(K == K.transpose());
    CHECK(N == -N.transpose());
    CHECK(near["states"].size() == static_cast<std::size_t>(A.rows()));
    CHECK(near["eigenvalues"].size() == static_cast<std::size_t>(A.rows()));
    CHECK(near["motion"] == "steady");
    std::complex<double> sum = 0;
    for (const Json& value : near["eigenvalues"]) sum += std::complex<double>(value[0], value[1]);
    CHECK(std::abs(sum - A.trace()) < 1e-13);
}

TEST_CASE("linearize: a state that is not steady gives exit 3 and the residual") {
    const auto result = run({"linearize", bicycle, "--at", "lean'=0.5"});
    CHECK(result.exit == 3);
    CHECK(result.out.empty());
    CHECK(result.err.find("lean' = 0.5, and lean is not cyclic") != std::string::npos);
    CHECK(run({"linearize", bicycle, "--at", "nonsense=1"}).exit == 3);
}

// With the mass centre on the blade: v' = 0, J phi'' = 0.
TEST_CASE("linearize: a blade that runs on a circle is steady in speeds that the program finds") {
    const Json near =
        json_of({"linearize", source_path("scenes/textbook/chaplygin_sleigh.toml"), "--json", "--at", "a=0"});
    CHECK(near["formalism"] == "kane");
    CHECK(near["moving"] == Json{"x", "phi"});
    CHECK(near["states"] == Json{"u1", "phi'"});
    CHECK(matrix(near["matrices"]["A"]).isZero(0));
    CHECK(matrix(near["matrices"]["M"])(1, 1) == 1);
}

TEST_CASE("bicycle: energy and constraints are kept, and the speed settles") {
    const Json run = json_of({"simulate", bicycle, "--json", "--duration", "20"});
    CHECK(run["energy_drift"].get<double>() < 1e-10);
    CHECK(run["constraint_drift"].get<double>() < 1e-10);
    // The energy of the kick that does not return to the lean has become forward motion: weave and capsize are
    // stable at 4.6 m/s.
    const Json& rates = run["final"]["rates"];
    CHECK(std::abs(rates["lean"].get<double>()) < 1e-3);
    CHECK(-0.3 * rates["rear"].get<double>() > 4.6);
}

// x(t) = exp(A t) x(0) + O(kick²).
TEST_CASE("bicycle: after a small kick it moves according to the eigenvalues") {
    std::string scene = alembert::test::contents(bicycle);
    const std::string kick = "kick = { value = 0.5,";
    REQUIRE(scene.find(kick) != std::string::npos);
    scene.replace(scene.find(kick), kick.size(), "kick = { value = 1e-5,");
    const Json end = json_of({"simulate", temporary("bicycle.toml", scene), "--json", "--duration", "2",
                              "--tolerance", "1e-13"})["final"];
    const Json near = json_of({"linearize", bicycle, "--json", "--at", "kick=0"});
    const Eigen::MatrixXd A = matrix(near["matrices"]["A"]);
    const auto state = [&](const std::string& name) {
        for (std::size_t i = 0; i < near["states"].size(); ++i)
            if (near["states"][i] == name) return static_cast<Eigen::Index>(i);
        FAIL(name);
        return Eigen::Index{0};
    };
    Eigen::VectorXd x = Eigen::VectorXd::Zero(A.rows());
    x[state("lean'")] = 1;
    const int steps = 4000;  // of the Taylor series of exp, to order 6: off by (|A| h)^7
    for (int k = 0; k < steps; ++k) {
        Eigen::VectorXd term = x;
        for (int n = 1; n <= 6; ++n) x += term = A * term * (2.0 / steps / n);
    }
    for (const char* name : {"lean", "steer"}) {
        CHECK(std::abs(end["coordinates"][name].get<double>() / 1e-5 - x[state(name)]) < 1e-6);
        CHECK(std::abs(end["rates"][name].get<double>() / 1e-5 - x[state(name + std::string("'"))]) < 1e-5);
    }
    CHECK(std::abs(x[state("lean")]) > 1e-3);
}

// m (x'' − 2Ω y' − Ω² x) + c x' + k x = −n y,  m (y'' + 2Ω x' − Ω² y) + k y = n x.
TEST_CASE("linearize: small matrices are shown in the parameters, and are the numbers at the scene's") {
    const std::string text = R"toml(
[parameters]
m = 2
k = 50
c = 0.3
n = 1.5
Omega = 1.2
[coordinates]
x = 0
y = 0
[[frame]]
name = "R"
rotate = [["z", "Omega*t"]]
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
axes = "R"
[[spring]]
between = ["O", "P"]
stiffness = "k"
[[damper]]
along = "x"
damping = "c"
[forces]
x = "-n*y"
y = "n*x"
)toml";
    const Json turning = json_of({"linearize", temporary("turning.toml", text), "--json"});
    const Json& symbols = turning["symbolic"];
    CHECK(symbols["M"] == Json::parse(R"([["m","0"],["0","m"]])"));
    CHECK(symbols["C"] == Json::parse(R"([["c","0"],["0","0"]])"));
    CHECK(symbols["N"] == Json::parse(R"([["0","n"],["-n","0"]])"));
    const Json pendulum = json_of({"linearize", source_path("scenes/textbook/double_pendulum.toml"), "--at",
                                   "theta1=0", "--at", "theta2=0", "--json"});
    for (const auto& [scene, near] :
         {std::pair(text, turning),
          std::pair(
              std::string("[parameters]\nm1 = 1.0\nm2 = 1.0\nl1 = 1.0\nl2 = 0.8\ng = 9.81\n[coordinates]\nx = 0\n"
                          "[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", 0]\n"),
              pendulum)}) {
        for (const char* letter : {"M", "C", "G", "K", "N"}) {
            std::string outputs = scene + "\n[outputs]\n";
            for (int i = 0; i < 2; ++i)
                for (int j = 0; j < 2; ++j)
                    outputs += "e" + std::to_string(2 * i + j) + " = \"" +
                               near["symbolic"][letter][i][j].get<std::string>() + "\"\n";
            const Json values = json_of({"eval", temporary("entries.toml", outputs), "--json"})["outputs"];
            const Eigen::MatrixXd numbers = matrix(near["matrices"][letter]);
            for (int i = 0; i < 2; ++i)
                for (int j = 0; j < 2; ++j) {
                    CAPTURE(letter);
                    CHECK(std::abs(values["e" + std::to_string(2 * i + j)].get<double>() - numbers(i, j)) < 1e-12);
                }
        }
    }
    CHECK(matrix(turning["matrices"]["G"])(1, 0) == doctest::Approx(4.8));
    CHECK(matrix(pendulum["matrices"]["K"])(0, 0) == doctest::Approx(2 * 9.81));
    CHECK_FALSE(json_of({"linearize", bicycle, "--at", "kick=0", "--json"}).contains("symbolic"));
}

TEST_CASE(
    "linearize: a kink at the state exits with 3 and names the function, and beside it the scene is linearized") {
    const std::string text =
        "[parameters]\nk = 2\n[coordinates]\nx = 0\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", 0]\n"
        "[[force]]\nat = \"P\"\nvector = [\"k*(1 - abs(x)) - k*max(1 - 2*abs(x), 0)\", 0]\n";
    const std::string scene = temporary("kink.toml", text);
    const auto result = run({"linearize", scene, "--json"});
    CHECK(result.exit == 3);
    CHECK(result.out.empty());
    CHECK(result.err.find("abs(x)") != std::string::npos);
    const Json beside = json_of({"linearize", scene, "--at", "x=-1", "--json"});
    CHECK(beside["matrices"]["A"][1][0] == 2);
    const std::string drag =
        temporary("drag.toml",
                  "[coordinates]\nx = 0\ny = 0\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", \"y\"]\n"
                  "[[force]]\nat = \"P\"\nvector = [\"-x'*sqrt(x'^2+y'^2)-4*x\", \"-y\"]\n");
    const Json near = json_of({"linearize", drag, "--json"});
    CHECK(near["matrices"]["K"] == Json::parse("[[4.0, 0.0], [0.0, 1.0]]"));
    CHECK(near["matrices"]["C"] == Json::parse("[[0.0, 0.0], [0.0, 0.0]]"));
}

// On the floor y = 0: x'' = -4 x while the weight W presses. Without weight the particle leaves upwards, and after
// a bounce it returns.
TEST_CASE("linearize: a contact that presses is a constraint, and one that touches without a force is refused") {
    const auto scene = [](const std::string& weight) {
        return temporary("floor" + weight + ".toml",
                         "[coordinates]\nx = 0\ny = 0\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", "
                         "\"y\"]\n[[force]]\n"
                         "at = \"P\"\nvector = [\"-4*x\", \"-3*y - " +
                             weight +
                             "\"]\n[[unilateral]]\nname = \"floor\"\ngap = \"y\"\n"
                             "restitution = 0.5\n");
    };
    CHECK(json_of({"linearize", scene("1"), "--json"})["matrices"]["A"] ==
          Json::parse("[[0.0, 1.0], [-4.0, 0.0]]"));
    const auto open = run({"linearize", scene("-3"), "--at", "y=1", "--json"});  // above the floor: y'' = -3 y + 3
    CHECK(open.exit == 0);
    CHECK(Json::parse(open.out)["matrices"]["A"][3][1] == -3);
    const auto touching = run({"linearize", scene("0"), "--json"});
    CHECK(touching.exit == 3);
    CHECK(touching.err.find("contact floor touches at this state without a force") != std::string::npos);
}

// A bead on y = x² under unit weight: x'' = -2 x + f(x). The constraint force contributes to the slope, and |y| =
// x² has no kink on the curve.
TEST_CASE("linearize: on a constraint a kink counts where the curve crosses it, and not where it runs along it") {
    const auto bead = [](const std::string& name, const std::string& force) {
        return temporary(name + ".toml",
                         "[coordinates]\nx = 0\ny = { guess = 0 }\n[[particle]]\nname = \"P\"\nmass = 1\nposition "
                         "= [\"x\", \"y\"]\n"
                         "[[force]]\nat = \"P\"\nvector = [\"" +
                             force +
                             "\", \"-1\"]\n[[constraint]]\nname = \"curve\"\n"
                             "holonomic = \"y - x^2\"\n");
    };
    CHECK(json_of({"linearize", bead("along", "-abs(y)"), "--json"})["matrices"]["A"] ==
          Json::parse("[[0.0, 1.0], [-2.0, 0.0]]"));
    CHECK(run({"linearize", bead("across", "-abs(x)")})
              .err.find("the slope -3 in x where x grows, and -1 where it falls") != std::string::npos);
    CHECK(run({"linearize", bead("root", "-sqrt(y)")}).exit == 3);
}

TEST_CASE("linearize: for a state that is not steady, the message names one that is") {
    const auto result = run({"linearize", source_path("scenes/textbook/rotating_hoop.toml"), "--at", "theta=0.8"});
    CHECK(result.exit == 3);
    CHECK(result.err.find("theta'' = ") != std::string::npos);
    CHECK(result.err.find("--at theta=0.99440721205869") != std::string::npos);
}

// M x'' = F − m g θ − b x', l θ'' = g θ − x''; the outputs see accelerations and the force itself.
TEST_CASE("linearize: a cart's matrices of inputs and outputs are those derived by hand") {
    const std::string cart = temporary("cart.toml", R"toml(
gravity = [0, "-g"]
[parameters]
M = 2
m = 0.3
l = 0.5
b = 0.2
g = 9.81
[inputs]
F = "0*t"
[coordinates]
x = 0
theta = 0
[[particle]]
name = "cart"
mass = "M"
position = ["x", 0]
[[particle]]
name = "bob"
mass = "m"
from = "cart"
position = ["l*sin(theta)", "l*cos(theta)"]
[[force]]
at = "cart"
vector = ["F", 0]
[[damper]]
along = "x"
damping = "b"
[outputs]
place = "x + l*sin(theta)"
push = "x'' + 3*F"
)toml");
    const Json near = json_of({"linearize", cart, "--json"});
    REQUIRE(near["states"] == Json{"x", "theta", "x'", "theta'"});
    REQUIRE(near["inputs"] == Json{"F"});
    REQUIRE(near["outputs"] == Json{"place", "push"});
    const Eigen::MatrixXd B = matrix(near["matrices"]["B"]), C = matrix(near["matrices"]["output_state"]),
                          D = matrix(near["matrices"]["output_input"]);
    const double M = 2, m = 0.3, l = 0.5, b = 0.2, g = 9.81;
    CHECK((B - Eigen::Vector4d(0, 0, 1 / M, -1 / (M * l))).norm() < 1e-15);
    Eigen::MatrixXd by_hand(2, 4);
    by_hand << 1, l, 0, 0, 0, -m * g / M, -b / M, 0;
    CHECK((C - by_hand).norm() < 1e-15);
    CHECK((D - Eigen::Vector2d(0, 1 / M + 3)).norm() < 1e-15);
}

// On the line y = x: 2 m x'' = F − k x − m g,  N = m y'' + m g = (F − k x + m g)/2.
TEST_CASE("linearize: multipliers among the outputs follow state and input") {
    const std::string bead = temporary("incline.toml", R"toml(
[parameters]
m = 2
g = 10
k = 5
[inputs]
F = "20 + 0*t"
[coordinates]
x = 0
y = 0
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
[forces]
x = "F - k*x"
y = "-m*g"
[[constraint]]
name = "line"
holonomic = "y - x"
multiplier = "N"
[outputs]
normal = "N"
)toml");
    const Json near = json_of({"linearize", bead, "--json"});
    REQUIRE(near["states"].size() == 2);
    CHECK(matrix(near["matrices"]["output_state"])(0, 0) == doctest::Approx(-2.5).epsilon(1e-14));
    CHECK(matrix(near["matrices"]["output_input"])(0, 0) == doctest::Approx(0.5).epsilon(1e-14));
    CHECK(matrix(near["matrices"]["B"])(1, 0) == doctest::Approx(0.25).epsilon(1e-14));
}

namespace {

/// theta'' = -g/l sin theta - d theta' + F/(m l^2)
const std::string driven = R"toml(
gravity = [0, "-g"]
[parameters]
m = 2
l = 1.5
g = 9.81
d = 0.3
[inputs]
F = { value = "0.7*sin(2*t)" }
[coordinates]
theta = { initial = 0.5, rate = 0.3 }
[[particle]]
name = "P"
mass = "m"
position = ["l*sin(theta)", "-l*cos(theta)"]
[forces]
theta = "F - d*m*l^2*theta'"
[outputs]
height = "-l*cos(theta)"
[simulation]
duration = 2
)toml";

}  // namespace

TEST_CASE("linearize: about any state, A, B and the rest are the derivatives and the rates there") {
    const std::string scene = temporary("driven.toml", driven);
    const Run refused = run({"linearize", scene, "--at", "theta=0.8"});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("--affine") != std::string::npos);
    const Json json = json_of({"linearize", scene, "--affine", "--at", "t=0.4", "--at", "theta=0.8"});
    const double k = 9.81 / 1.5, inertia = 2 * 1.5 * 1.5;
    CHECK(json["motion"] == "any");
    CHECK(json["form"] == "x' = A dx + B du + c");
    CHECK(json["states"] == Json({"theta", "theta'"}));
    CHECK(json["inputs"] == Json({"F"}));
    CHECK(
        (matrix(json["matrices"]["A"]) - (Eigen::Matrix2d() << 0, 1, -k * std::cos(0.8), -0.3).finished()).norm() <
        1e-13);
    CHECK((matrix(json["matrices"]["B"]) - Eigen::Vector2d(0, 1 / inertia)).norm() < 1e-14);
    CHECK(json["x0"] == Json({0.8, 0.3}));
    CHECK(json["c"][0].get<double>() == 0.3);
    CHECK(json["c"][1].get<double>() ==
          doctest::Approx(-k * std::sin(0.8) - 0.3 * 0.3 + 0.7 * std::sin(0.8) / inertia).epsilon(1e-13));
    CHECK(matrix(json["matrices"]["output_state"])(0, 0) == doctest::Approx(1.5 * std::sin(0.8)).epsilon(1e-13));
    CHECK(run({"linearize", scene, "--affine"}).out.find("x' = A dx + B du + c") != std::string::npos);
    CHECK(run({"linearize", scene, "--duration", "3"}).exit == 3);  // without --along
}

TEST_CASE("linearize: a steady state is the same without and with a rest, which is zero there") {
    const std::string hoop = source_path("scenes/textbook/rotating_hoop.toml");
    const Json steady = json_of({"linearize", hoop, "--at", "theta=0", "--at", "theta'=0"}),
               any = json_of({"linearize", hoop, "--affine", "--at", "theta=0", "--at", "theta'=0"});
    CHECK(steady["matrices"]["A"] == any["matrices"]["A"]);
    CHECK(steady["eigenvalues"] == any["eigenvalues"]);
    CHECK(!steady.contains("c"));
    for (const Json& rest : any["c"]) CHECK(std::abs(rest.get<double>()) < 1e-15);
}

// The derivative Φ of the end by the start obeys Φ' = A(t) Φ, here by the method of Runge and Kutta over two rows.
TEST_CASE("linearize: A along a motion carries deviations from its start to its end") {
    for (const char* const name : {"double_pendulum", "spherical_pendulum", "elastic_pendulum"}) {
        CAPTURE(name);
        const std::string scene = source_path(std::string("scenes/textbook/") + name + ".toml");
        const Json near = json_of({"linearize", scene, "--along", "--duration", "1", "--sample", "0.0025"});
        const Json& rows = near["along"];
        REQUIRE(rows.size() == 401);
        const auto size = static_cast<Eigen::Index>(near["states"].size());
        const double h = 0.005;
        Eigen::MatrixXd phi = Eigen::MatrixXd::Identity(size, size);
        for (std::size_t row = 0; row + 2 < rows.size(); row += 2) {
            const Eigen::MatrixXd A = matrix(rows[row]["A"]), B = matrix(rows[row + 1]["A"]),
                                  C = matrix(rows[row + 2]["A"]);
            const Eigen::MatrixXd k1 = A * phi, k2 = B * (phi + h / 2 * k1), k3 = B * (phi + h / 2 * k2),
                                  k4 = C * (phi + h * k3);
            phi += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        std::string names;
        for (const Json& state : near["states"]) names += (names.empty() ? "" : ",") + state.get<std::string>();
        const Json told = json_of(
            {"simulate", scene, "--duration", "1", "--tolerance", "1e-12", "--sensitivity", names})["sensitivity"];
        REQUIRE(told["of"] == near["states"]);
        const Eigen::MatrixXd expected = matrix(told["values"]);
        CHECK((phi - expected).norm() < 1e-6 * expected.norm());
        const Json last = json_of({"simulate", scene, "--duration", "1", "--tolerance", "1e-12"})["final"];
        for (std::size_t k = 0; k < near["states"].size(); ++k) {
            const std::string state = near["states"][k];
            const bool is_rate = state.back() == '\'';
            const double there = is_rate ? number(last, "rates", state.substr(0, state.size() - 1))
                                         : number(last, "coordinates", state);
            CHECK(rows.back()["x"][k].get<double>() == doctest::Approx(there).epsilon(1e-8));
            if (!is_rate)
                CHECK(rows.back()["c"][k].get<double>() ==
                      doctest::Approx(number(last, "rates", state)).epsilon(1e-8));
        }
    }
}

TEST_CASE("linearize: along a linkage, A is the derivative along its constraints") {
    const std::string scene = source_path("scenes/textbook/slider_crank.toml");
    const Json near = json_of({"linearize", scene, "--along", "--duration", "0.2", "--sample", "0.05"});
    REQUIRE(near["states"] == Json({"alpha", "alpha'"}));
    for (const Json& row : near["along"]) {
        const auto acceleration = [&](double alpha, double rate) {
            return number(json_of({"eval", scene, "--at", fmt::format("alpha={:.17g}", alpha), "--at",
                                   fmt::format("alpha'={:.17g}", rate), "--at",
                                   fmt::format("t={:.17g}", row["time"].get<double>())}),
                          "accelerations", "alpha");
        };
        const double alpha = row["x"][0], rate = row["x"][1], h = 1e-4, size = 1 + rate * rate;
        CHECK(row["c"][1].get<double>() == doctest::Approx(acceleration(alpha, rate)).epsilon(1e-7));
        const double by_alpha = (acceleration(alpha + h, rate) - acceleration(alpha - h, rate)) / (2 * h),
                     by_rate = (acceleration(alpha, rate + h) - acceleration(alpha, rate - h)) / (2 * h);
        CHECK(std::abs(row["A"][1][0].get<double>() - by_alpha) < 1e-5 * size);
        CHECK(std::abs(row["A"][1][1].get<double>() - by_rate) < 1e-5 * size);
    }
}

TEST_CASE("linearize: the table along a motion has the numbers of the JSON, under names of rows and columns") {
    const std::string scene = temporary("driven.toml", driven), table = temporary("along.csv", "");
    const Json near = json_of({"linearize", scene, "--along", "--duration", "1", "--sample", "0.5", "-o", table});
    std::istringstream lines(contents(table));
    std::string header, line;
    std::getline(lines, header);
    CHECK(header ==
          "t,theta,theta',c(theta),c(theta'),A(theta;theta),A(theta;theta'),A(theta';theta),A(theta';theta'),"
          "B(theta;F),B(theta';F)");
    std::size_t row = 0;
    for (; std::getline(lines, line); ++row) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream numbers(line);
        std::vector<double> found, expected;
        for (double x = 0; numbers >> x;) found.push_back(x);
        const Json& here = near["along"][row];
        expected.push_back(here["time"]);
        for (const char* const column : {"x", "c"})
            for (const Json& x : here[column]) expected.push_back(x);
        for (const char* const letter : {"A", "B"})
            for (const Json& values : here[letter])
                for (const Json& x : values) expected.push_back(x);
        CHECK(found == expected);
    }
    CHECK(row == 3);
    const Run ball = run({"linearize", source_path("scenes/textbook/bouncing_ball.toml"), "--along"});
    CHECK(ball.exit == 3);
    CHECK(ball.err.find("deviations jump") != std::string::npos);
}

}  // namespace commands_linearize
