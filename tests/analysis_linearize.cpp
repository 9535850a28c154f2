// SPDX-License-Identifier: MIT
// Linearized equations against closed forms, against a published benchmark, and against differences of the
// nonlinear accelerations in 60 digits, for which dependent coordinates and rates are solved at each state.
#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "alembert/base/error.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/prepared.hpp"
#include "analysis/state/redundancy.hpp"
#include "digits.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/lower/lower.hpp"
#include "scenes.hpp"
#include "stability/linear/linearize.hpp"

namespace analysis_linearize {

using namespace alembert;
using test::Digits;

namespace {

struct Case {
    Mechanism mechanism;
    Equations equations;
    Start start;
    Linearization near;
};

Case linearized(const Scene& scene, const std::string& by, const Overrides& at) {
    Mechanism m = prepared(scene).mechanism;
    m = without_constraints(m, redundant_constraints(m));
    Case result{.mechanism = m, .equations = formalism(by).derive(m), .start = start_of(m, at), .near = {}};
    assemble(result.start, m, lower_constraints(m), at);
    result.near = linearize(m, result.equations, result.start);
    return result;
}

Case textbook(const std::string& name, const std::string& by, const Overrides& at) {
    return linearized(read_scene(test::source_path("scenes/textbook/" + name + ".toml")), by, at);
}

/// The solution x of S x = b by elimination with row exchanges.
std::vector<Digits> solved(std::vector<std::vector<Digits>> S, std::vector<Digits> b) {
    const std::size_t n = b.size();
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t best = c;
        for (std::size_t r = c; r < n; ++r)
            if (abs(S[r][c]) > abs(S[best][c])) best = r;
        std::swap(S[c], S[best]);
        std::swap(b[c], b[best]);
        for (std::size_t r = 0; r < n; ++r) {
            if (r == c) continue;
            const Digits factor = S[r][c] / S[c][c];
            for (std::size_t k = c; k < n; ++k) S[r][k] = S[r][k] - factor * S[c][k];
            b[r] = b[r] - factor * b[c];
        }
    }
    for (std::size_t c = 0; c < n; ++c) b[c] = b[c] / S[c][c];
    return b;
}

/// The nonlinear equations with rates as speeds: (r', w') of independent coordinates and rates.
class Nonlinear {
public:
    explicit Nonlinear(const Case& c) : m_(c.mechanism) {
        REQUIRE(c.equations.speeds_are_rates());
        program_ = lower(m_, c.equations, energy_of(m_));
        for (const double x : c.start.parameters) at_.parameters.push_back(Digits(x));
        for (const double x : c.start.q) at_.q.push_back(Digits(x));
        for (const double x : c.start.qdot) at_.qdot.push_back(Digits(x));
        at_.t = Digits(c.start.t);
        const auto is = [](const std::vector<std::string>& list, const std::string& name) {
            return std::find(list.begin(), list.end(), name) != list.end();
        };
        for (int i = 0; i < m_.size(); ++i) {
            (is(c.near.dependent, m_.q[i].get_name()) ? dependent_q_ : q_).push_back(i);
            (is(c.near.dependent, m_.qdot[i].get_name()) ? dependent_u_ : u_).push_back(i);
        }
    }

    std::vector<std::string> names() const {
        std::vector<std::string> result;
        for (const int i : q_) result.push_back(m_.q[i].get_name());
        for (const int i : u_) result.push_back(m_.qdot[i].get_name());
        return result;
    }

    std::vector<Digits> operator()(std::size_t which, const Digits& by) {
        State<Digits> state = at_;
        (which < q_.size() ? state.q[q_[which]] : state.qdot[u_[which - q_.size()]]) += by;
        for (int round = 0; round < 8; ++round) {
            const std::vector<Digits> value = interpret(program_, state);
            move(state.q, dependent_q_, Group::position, value);
            move(state.qdot, dependent_u_, Group::velocity, value);
        }
        const std::vector<Digits> value = interpret(program_, state);
        for (const Group group : {Group::position, Group::velocity})
            for (const int id : program_.nodes_of(group)) REQUIRE(value[id].magnitude() < -50);
        std::vector<Digits> result;
        for (const int i : q_) result.push_back(state.qdot[i]);
        const std::vector<int> acceleration = program_.nodes_of(Group::acceleration);
        for (const int i : u_) result.push_back(value[acceleration[i]]);
        return result;
    }

private:
    void move(std::vector<Digits>& x, const std::vector<int>& dependent, Group group,
              const std::vector<Digits>& value) const {
        const std::vector<int> residual = program_.nodes_of(group), rows = program_.nodes_of(Group::row);
        std::vector<std::vector<Digits>> S;
        std::vector<Digits> b;
        for (std::size_t k = 0; k < residual.size(); ++k) {
            if (group == Group::position && !m_.constraints[k].position) continue;
            S.emplace_back();
            for (const int j : dependent)
                S.back().push_back(value[rows[k * m_.q.size() + static_cast<std::size_t>(j)]]);
            b.push_back(value[residual[k]]);
        }
        const std::vector<Digits> step = solved(S, b);
        for (std::size_t j = 0; j < dependent.size(); ++j) x[dependent[j]] = x[dependent[j]] - step[j];
    }

    const Mechanism& m_;
    Program program_;
    State<Digits> at_;
    std::vector<int> q_, u_, dependent_q_, dependent_u_;
};

double approximately(const Digits& x) {
    return cln::double_approx(x.value());
}

/// A against central differences with a step of 1e-20: they are off by 1e-40 of the third derivatives.
void check_differences(const Case& c) {
    Nonlinear f(c);
    const std::vector<std::string> names = f.names();
    const auto position = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) - names.begin();
    };
    Digits h = 1;
    for (int k = 0; k < 20; ++k) h = h / 10;
    const double size = c.near.A.cwiseAbs().maxCoeff();
    for (std::size_t j = 0; j < c.near.states.size(); ++j) {
        const auto column = static_cast<std::size_t>(position(c.near.states[j]));
        const std::vector<Digits> plus = f(column, h), minus = f(column, -h);
        for (std::size_t i = 0; i < c.near.states.size(); ++i) {
            const auto row = position(c.near.states[i]);
            const double expected = approximately((plus[row] - minus[row]) / (2 * h));
            CAPTURE(c.near.states[i]);
            CAPTURE(c.near.states[j]);
            CHECK(std::abs(c.near.A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) - expected) <=
                  1e-15 * size);
        }
    }
}

Eigen::Matrix2d lean_and_steer(const Case& c, const Eigen::MatrixXd& matrix) {
    REQUIRE(c.near.speeds[0] == "lean'");
    REQUIRE(c.near.speeds[1] == "steer'");
    return matrix.topLeftCorner(2, 2);
}

Case bicycle(double v) {
    return linearized(read_scene(test::source_path("scenes/gallery/bicycle.toml")), "routh",
                      {{"kick", 0}, {"v", v}});
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

// Meijaard, Papadopoulos, Ruina & Schwab, Proc. R. Soc. A 463 (2007) 1955, equation (6.1): M q'' + v C1 q' + (g K0
// + v² K2) q = f.
TEST_CASE("linearize: the bicycle's matrices are the published ones") {
    const Eigen::Matrix2d M{{80.81722, 2.31941332208709}, {2.31941332208709, 0.29784188199686}},
        C1{{0, 33.86641391492494}, {-0.85035641456978, 1.68540397397560}},
        K0{{-80.95, -2.59951685249872}, {-2.59951685249872, -0.80329488458618}},
        K2{{0, 76.59734589573222}, {0, 2.65431523794604}};
    for (const double v : {0.0, 1.0, 4.6, 10.0}) {
        CAPTURE(v);
        const Case c = bicycle(v);
        CHECK(distance(lean_and_steer(c, c.near.M), M) < 1e-12);
        CHECK(distance(lean_and_steer(c, c.near.D), v * C1) < 1e-12 * std::max(1.0, v));
        CHECK(distance(lean_and_steer(c, c.near.K + c.near.N), 9.81 * K0 + v * v * K2) <
              1e-12 * std::max(9.81, v * v));
        CHECK(c.near.M.row(2).head(2).isZero(0));  // forward motion is uncoupled
        CHECK(c.near.D.row(2).isZero(0));
        CHECK(c.near.moving ==
              (v == 0 ? std::vector<std::string>{} : std::vector<std::string>{"x", "rear", "front"}));
    }
    const Case still = bicycle(0), five = bicycle(5);
    const Eigen::Matrix2d at0 = lean_and_steer(still, still.near.K + still.near.N),
                          at5 = lean_and_steer(five, five.near.K + five.near.N);
    CHECK(distance(at0 / 9.81, K0) < 1e-12);
    CHECK(distance((at5 - at0) / 25, K2) < 1e-12);
    CHECK(distance(lean_and_steer(five, five.near.D) / 5, C1) < 1e-12);
}

// The same paper, table 2, from a recomputation in 30 digits.
TEST_CASE("linearize: the bicycle's eigenvalues are the published ones") {
    const std::map<int, std::vector<std::complex<double>>> expected{
        {0, {-5.530943717653934639, -3.1316432479065556678, 3.1316432479065556678, 5.530943717653934639}},
        {1, {-7.1100801463744077273, -3.1342312506657842279, {3.5269617099006941697, 0.8077402751993100451}}},
        {2, {-8.6738798483173716281, -3.0715864564151425129, {2.6823451751274534547, 1.6806629659067577596}}},
        {3, {-10.351014672459228198, -2.6336613725366529572, {1.7067560566397351538, 2.315824473843243567}}},
        {4, {-12.158614265764439655, -1.4294442736132574503, {0.41325331521124132084, 3.079108186032053628}}},
        {5, {-14.078389692798247151, -0.32286642900408707758, {-0.77534188219584192547, 4.4648677137882251411}}},
        {6, {-16.085371230980284041, -0.004066900769703362423, {-1.5264448658414171457, 5.8767306059870840337}}},
        {7, {-18.157884661252020911, 0.10268170574766415884, {-2.1387564425836342792, 7.1952591332980425502}}},
        {8, {-20.279408943945662988, 0.14327879765712949831, {-2.6934868358109477186, 8.4603797139693359008}}},
        {9, {-22.437885590408590587, 0.15790184030917298232, {-3.2167540225249074692, 9.6937735153178219535}}},
        {10, {-24.624596350174000247, 0.16105338653171554193, {-3.7201684043728757266, 10.906811394762882004}}}};
    for (const auto& speed : expected) {
        const int v = speed.first;
        CAPTURE(v);
        const std::vector<std::complex<double>> found = bicycle(v).near.eigenvalues;
        CHECK(found.size() == 10);
        int zeros = 0;
        for (const std::complex<double>& value : found) zeros += value == 0.0 ? 1 : 0;
        CHECK(zeros == 6);
        for (const std::complex<double>& value : speed.second) {
            double nearest = HUGE_VAL;
            for (const std::complex<double>& other : found) nearest = std::min(nearest, std::abs(other - value));
            CAPTURE(value);
            CHECK(nearest < 2e-13 * std::max(1.0, std::abs(value)));
        }
    }
}

TEST_CASE("linearize: the matrix is that of differences of the nonlinear equations") {
    SUBCASE("bicycle") {
        check_differences(bicycle(4.6));
    }
    SUBCASE("double pendulum, one rod up") {
        check_differences(textbook("double_pendulum", "lagrange",
                                   {{"theta1", 0}, {"theta2", M_PI}, {"theta1'", 0}, {"theta2'", 0}}));
    }
    SUBCASE("rolling disc, straight") {
        check_differences(textbook("rolling_disc_in_space", "routh", {{"psi'", 0}, {"theta", 0}, {"theta'", 0}}));
    }
    SUBCASE("rolling disc, spinning in place") {
        check_differences(textbook("rolling_disc_in_space", "routh", {{"phi'", 0}, {"theta", 0}, {"theta'", 0}}));
    }
    SUBCASE("rolling disc, on a circle") {
        // 6 r ψ' φ' cos θ + 5 r ψ'² sin θ cos θ + 4 g sin θ = 0
        const double theta = 0.3, psi = 2.0,
                     phi =
                         -(5 * 0.5 * psi * psi * std::sin(theta) * std::cos(theta) + 4 * 9.81 * std::sin(theta)) /
                         (6 * 0.5 * psi * std::cos(theta));
        const Case c = textbook("rolling_disc_in_space", "routh",
                                {{"psi'", psi}, {"theta", theta}, {"theta'", 0}, {"phi'", phi}});
        CHECK(c.near.moving == std::vector<std::string>{"x", "psi", "phi"});
        CHECK(c.near.states == std::vector<std::string>{"theta", "psi'", "theta'", "phi'"});
        check_differences(c);
    }
    SUBCASE("pendulum in Cartesian coordinates") {
        check_differences(textbook("cartesian_pendulum", "routh", {{"x", 0}, {"y", 1}, {"x'", 0}, {"y'", 0}}));
    }
}

TEST_CASE("linearize: constraint forces act on independent coordinates to the second order") {
    const Case c = linearized(
        parse_scene(
            "gravity = [0, \"g\"]\n[parameters]\ng = 9.81\nl = 2\nm = 3\n[coordinates]\nx = 0\ny = { guess = 1 }\n"
            "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", \"y\"]\n"
            "[[constraint]]\nname = \"rod\"\nholonomic = \"x^2 + y^2 - l^2\"\n",
            "rod.toml"),
        "routh", {});
    CHECK(c.near.states == std::vector<std::string>{"x", "x'"});
    REQUIRE(c.near.eigenvalues.size() == 2);
    CHECK(std::abs(c.near.eigenvalues[1] - std::complex<double>(0, std::sqrt(9.81 / 2))) < 1e-15);
    CHECK(std::abs(c.near.K(0, 0) - 3 * 9.81 / 2) < 1e-14);
}

// 5 r θ'' = 6 r ψ' φ' + 5 r ψ'² θ + 4 g θ, ψ'' = −2 φ' θ' near straight rolling, φ' + 5/3 ψ' θ constant near
// spinning in place.
TEST_CASE("linearize: a disc stays up above the speeds of the textbook") {
    const double r = 0.5, g = 9.81;
    const auto largest = [](const Case& c) { return c.near.eigenvalues.back().real(); };
    for (const double factor : {0.99, 1.01}) {
        CAPTURE(factor);
        const double roll = factor * std::sqrt(g / (3 * r)), spin = factor * std::sqrt(4 * g / (5 * r));
        const double left_roll = 4 * g / (5 * r) - 12 * roll * roll / 5, left_spin = 4 * g / (5 * r) - spin * spin;
        const Case rolls =
            textbook("rolling_disc_in_space", "routh", {{"psi'", 0}, {"theta", 0}, {"theta'", 0}, {"phi'", roll}});
        const Case spins =
            textbook("rolling_disc_in_space", "routh", {{"psi'", spin}, {"theta", 0}, {"theta'", 0}, {"phi'", 0}});
        CHECK(std::abs(largest(rolls) - std::sqrt(std::max(0.0, left_roll))) < 1e-13);
        CHECK(std::abs(largest(spins) - std::sqrt(std::max(0.0, left_spin))) < 1e-13);
    }
}

// V(θ) = (a − b cos θ)²/(2 I1 sin² θ) + m g l cos θ with the momenta a, b about the vertical and the axis; ω² =
// V''/I1.
TEST_CASE("linearize: a top in regular precession nods with the frequency of its effective potential") {
    const Scene scene = parse_scene(
        "gravity = [0, 0, \"-g\"]\n[parameters]\ng = 9.81\nm = 1.5\nl = 0.3\nA = 0.4\nC = 0.1\n[coordinates]\npsi "
        "= 0\ntheta = 1\nphi = 0\n"
        "[[frame]]\nname = \"T\"\nrotate = [[\"z\",\"psi\"],[\"x\",\"theta\"],[\"z\",\"phi\"]]\n"
        "[[body]]\nname = \"top\"\nmass = \"m\"\nframe = \"T\"\ninertia = { xx = \"A\", yy = \"A\", zz = \"C\" "
        "}\nabout = \"O\"\n"
        "position = [0, 0, \"l\"]\naxes = \"T\"\n",
        "top.toml");
    const double A = 0.4, C = 0.1, w = 1.5 * 9.81 * 0.3, theta = 0.9, p = 1.7;
    // Steady where A cos θ p² − C w3 p + m g l = 0: the spin that belongs to the precession p.
    const double w3 = (A * std::cos(theta) * p * p + w) / (C * p), spin = w3 - p * std::cos(theta);
    for (const char* by : {"lagrange", "kane"}) {
        const Case c = linearized(scene, by, {{"theta", theta}, {"psi'", p}, {"phi'", spin}});
        CHECK(c.near.moving == std::vector<std::string>{"psi", "phi"});
        const double b = C * w3, a = A * std::sin(theta) * std::sin(theta) * p + b * std::cos(theta);
        const auto V = [&](const Digits& x) {
            const Digits f = Digits(a) - Digits(b) * cos(x);
            return f * f / (2 * Digits(A) * sin(x) * sin(x)) + Digits(w) * cos(x);
        };
        Digits h = 1;
        for (int k = 0; k < 15; ++k) h = h / 10;
        const Digits x = Digits(theta);
        const double omega = std::sqrt(approximately((V(x + h) - 2 * V(x) + V(x - h)) / (h * h)) / A);
        CHECK(std::abs(c.near.eigenvalues.back().real()) < 1e-14);
        CHECK(std::abs(std::abs(c.near.eigenvalues.back().imag()) - omega) < 1e-12);
        CHECK(c.near.eigenvalues.size() == 6);
    }
}

TEST_CASE("linearize: speeds of the scene are states, and inputs have columns") {
    const Case sleigh = textbook("chaplygin_sleigh_in_speeds", "kane", {{"v", 2}, {"w", 0}});
    CHECK(sleigh.near.speeds == std::vector<std::string>{"v", "w"});
    CHECK(sleigh.near.moving == std::vector<std::string>{"x"});
    CHECK(std::abs(sleigh.near.eigenvalues.front().real() + 0.8) < 1e-15);  // −m a v/(J + m a²)
    const Case cart = textbook("cart_pole", "lagrange", {{"theta", 0}, {"F0", 0}});
    CHECK(cart.near.inputs == std::vector<std::string>{"F"});
    const double M = 1, m = 0.3, l = 0.5, g = 9.81, b = 0.2;
    const Eigen::Matrix4d A{
        {0, 0, 1, 0}, {0, 0, 0, 1}, {0, -m * g / M, -b / M, 0}, {0, (M + m) * g / (M * l), b / (M * l), 0}};
    CHECK(distance(cart.near.A, A) < 1e-14);
    CHECK(distance(cart.near.B, Eigen::Vector4d(0, 0, 1 / M, -1 / (M * l))) < 1e-15);
}

TEST_CASE("linearize: a state that is neither at rest nor steady is refused with its residual") {
    const auto message = [](const std::string& name, const std::string& by, const Overrides& at) {
        try {
            textbook(name, by, at);
        } catch (const ModelError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    CHECK(message("cart_pole", "lagrange", {{"theta", 0.1}, {"F0", 0}}).find("theta'' = ") != std::string::npos);
    CHECK(message("chaplygin_sleigh", "routh", {}).find("phi is not cyclic") != std::string::npos);
    const Scene moved = parse_scene(
        "[coordinates]\nx = 0\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", 0]\n[[force]]\nat = "
        "\"P\"\nvector = [\"-x*(2+sin(t))\", 0]\n",
        "t.toml");
    CHECK_THROWS_WITH_AS(linearized(moved, "lagrange", {}), doctest::Contains("change with time (x'' holds t"),
                         ModelError);
}

}  // namespace analysis_linearize
