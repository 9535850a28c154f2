// SPDX-License-Identifier: MIT
// Dry friction on several constraints, which press from either side (scenes/friction/trammel.toml): a rod of mass
// m and half length l, whose end A slides along x and whose end B slides along y. The forces of the slots are λ_A
// and −μ|λ_A| sign(v_A) on A, λ_B and −ν|λ_B| sign(v_B) on B.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <set>

#include "contacts.hpp"
#include "edits.hpp"
#include "files.hpp"
#include "solved.hpp"

namespace commands_friction_slots {

using namespace alembert::test;

namespace {

const std::string trammel = source_path("scenes/friction/trammel.toml");
constexpr double m = 1.2, l = 2, mu = 0.3, nu = 0.25;

struct Solved {
    double acceleration, a, b;  ///< θ'', λ_A and λ_B
};

/// Newton's and Euler's equations for x = −l cos θ, y = l sin θ, with the given signs of λ_A and λ_B. `p` and `q`
/// are the friction coefficients with the signs of v_A and v_B. If θ'' is given, the torque about z is sought in
/// place of it.
Solved solved(double theta, double rate, double p, double q, double sign_a, double sign_b) {
    const double c = std::cos(theta), s = std::sin(theta), fa = p * sign_a, fb = q * sign_b;
    // m x'' = λ_B − fa λ_A and m y'' = λ_A − m g − fb λ_B, with x'' = l (s θ'' + c θ'²), y'' = l (c θ'' − s θ'²)
    const double det = 1 - fa * fb;
    const auto forces = [&](double acceleration) {
        const double x = m * l * (s * acceleration + c * rate * rate),
                     y = m * l * (c * acceleration - s * rate * rate) + m * g;
        const double a = (y + fb * x) / det;
        return Solved{acceleration, a, x + fa * a};
    };
    // m l²/3 θ'' = moment about the mass centre of the forces on A at −l (c, s) and on B at l (c, s)
    const auto excess = [&](const Solved& f) {
        return l * (-c * f.a - s * fa * f.a - c * fb * f.b - s * f.b) - m * l * l / 3 * f.acceleration;
    };
    const double at_zero = excess(forces(0)), at_one = excess(forces(1));
    return forces(-at_zero / (at_one - at_zero));
}

/// All choices of signs that agree with the reactions that they give.
std::vector<Solved> consistent(double theta, double rate) {
    const double p = std::copysign(mu, std::sin(theta) * rate), q = std::copysign(nu, std::cos(theta) * rate);
    std::vector<Solved> found;
    for (const double sign_a : {-1.0, 1.0})
        for (const double sign_b : {-1.0, 1.0}) {
            const Solved one = solved(theta, rate, p, q, sign_a, sign_b);
            if (sign_a * one.a >= 0 && sign_b * one.b >= 0) found.push_back(one);
        }
    return found;
}

std::string with(const std::vector<std::pair<std::string, std::string>>& edits, const std::string& more = "") {
    return temporary("trammel_changed.toml", edited(contents(trammel), edits) + more);
}

}  // namespace

TEST_CASE("friction: in two slots the accelerations and reactions are those of the only consistent signs") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(-3, 3), speed(-4, 4);
    bool pulls_a = false, pulls_b = false, presses_a = false, presses_b = false;
    for (int trial = 0; trial < 24; ++trial) {
        const double theta = angle(random), rate = speed(random);
        const auto expected = consistent(theta, rate);
        REQUIRE(expected.size() == 1);
        const auto result = run({"eval", trammel, "--at", fmt::format("theta={:.17g}", theta), "--at",
                                 fmt::format("theta'={:.17g}", rate), "--json"});
        REQUIRE(result.exit == 0);
        const Json state = Json::parse(result.out);
        const auto near = [](double value) { return doctest::Approx(value).epsilon(1e-11); };
        CHECK(state["accelerations"]["theta"].get<double>() == near(expected[0].acceleration));
        CHECK(state["multipliers"]["lambda_A"].get<double>() == near(expected[0].a));
        CHECK(state["multipliers"]["lambda_B"].get<double>() == near(expected[0].b));
        (expected[0].a < 0 ? pulls_a : presses_a) = true;
        (expected[0].b < 0 ? pulls_b : presses_b) = true;
    }
    CHECK((pulls_a && pulls_b && presses_a && presses_b));
}

TEST_CASE("friction: a rod in two rough slots comes to rest, and no work is lost from sight") {
    const Json motion = simulated(trammel);
    CHECK(motion["work_balance"].get<double>() < 1e-12);
    const auto stops = of_kind(motion, "stick");
    REQUIRE(stops.size() == 2);
    CHECK(stops[0]["time"] == stops[1]["time"]);
    // A rod that sticks has the speed that rounding leaves in the projection of rates near 1.
    CHECK(std::abs(motion["final"]["rates"]["theta"].get<double>()) < 1e-14);
}

TEST_CASE("friction: a rod that sticks in two slots gives way when no forces within their bounds hold it") {
    // Just before it turns, both frictions have their full size against θ' < 0, and the torque −2 t is in balance
    // with them and the weight.
    const double p = -0.5, q = -0.6, c = std::cos(0.9), s = std::sin(0.9);
    double time = 0;
    for (const double sign_a : {-1.0, 1.0})
        for (const double sign_b : {-1.0, 1.0}) {
            const double fa = p * sign_a, fb = q * sign_b, a = m * g / (1 - fa * fb), b = fa * a;
            if (sign_a * a >= 0 && sign_b * b >= 0) time = l * (-c * a - s * fa * a - c * fb * b - s * b) / 2;
        }
    REQUIRE(time > 0);
    const Json motion = simulated(with({{"value = 0.3,", "value = 0.5,"},
                                        {"value = 0.25,", "value = 0.6,"},
                                        {"rate_guess = 3.9, ", ""},
                                        {"rate_guess = 4.6, ", ""},
                                        {"initial = 0.7, rate = 3.0", "initial = 0.9"},
                                        {"duration = 5.0", "duration = 30.0"}},
                                       "\n[[torque]]\non = \"rod\"\nvector = [0, 0, \"-2*t\"]\n"));
    std::set<std::string> sticking;
    double moves = 0;
    for (const Json& change : motion["contacts"]) {
        if (change["event"] == "stick")
            sticking.insert(change["name"]);
        else
            sticking.erase(change["name"]);
        moves = change["time"];
        if (sticking.empty()) break;
    }
    CHECK(moves == doctest::Approx(time).epsilon(1e-12));
}

namespace {

/// A unit mass in four coordinates q at 0 that three constraints A q = 0 hold, each of which rubs along a
/// direction of its own: q'' = F + Aᵀλ − Σ μ |λ_k| sign(w_k·q') w_k.
struct Rubbed {
    Eigen::Matrix<double, 3, 4> A, w;
    Eigen::Vector4d F, rate;
    double mu;

    explicit Rubbed(unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> uniform(-1, 1);
        for (auto* matrix : {&A, &w})
            for (Eigen::Index i = 0; i < 12; ++i) (*matrix)(i / 4, i % 4) = uniform(random);
        for (Eigen::Index i = 0; i < 4; ++i) F[i] = 5 * uniform(random);
        const Eigen::Matrix3d first = A.leftCols<3>();
        rate << alembert::test::solved(first, -A.col(3)).value(), 1;  // A rate = 0
        rate.normalize();
        mu = 0.25 + 0.25 * uniform(random);
    }

    /// λ = alone + D N for the normal forces N.
    Eigen::Vector3d alone() const { return -alembert::test::solved(A * A.transpose(), A * F).value(); }
    Eigen::Matrix3d D() const {
        Eigen::Matrix<double, 4, 3> c;
        for (Eigen::Index k = 0; k < 3; ++k)
            c.col(k) = -mu * std::copysign(1.0, w.row(k).dot(rate)) * w.row(k).transpose();
        return -alembert::test::solved(A * A.transpose(), A * c).value();
    }
    Eigen::Vector3d normal(const Eigen::Vector3d& signs) const {
        const Eigen::Matrix3d S = signs.asDiagonal();
        return alembert::test::solved(Eigen::Matrix3d::Identity() - S * D(), S * alone()).value();
    }
    /// λ for each choice of signs that agrees with the λ that it gives. There is one if no choice has a
    /// determinant that is small or negative.
    std::vector<Eigen::Vector3d> consistent() const {
        std::vector<Eigen::Vector3d> found;
        for (unsigned choice = 0; choice < 8; ++choice) {
            const Eigen::Vector3d signs(choice & 1 ? 1 : -1, choice & 2 ? 1 : -1, choice & 4 ? 1 : -1);
            const Eigen::Matrix3d S = signs.asDiagonal();
            if ((Eigen::Matrix3d::Identity() - S * D()).determinant() < 0.1) return {};
            const Eigen::Vector3d N = normal(signs);
            if (N.minCoeff() > 0) found.push_back(signs.cwiseProduct(N));
        }
        return found;
    }
    /// How often the signs are chosen until they stay: those of λ without friction are the first.
    int rounds() const {
        Eigen::Vector3d signs = alone().cwiseSign();
        for (int round = 1;; ++round) {
            const Eigen::Vector3d next = (alone() + D() * normal(signs)).cwiseSign();
            if (next == signs || round == 9) return round;
            signs = next;
        }
    }
    std::string scene() const {
        const auto form = [](const auto& row, const char* of) {
            std::string text = "0";
            for (int i = 0; i < 4; ++i) text += fmt::format(" + ({:.17g})*q{}{}", row[i], i + 1, of);
            return text;
        };
        std::string text = "[coordinates]\n", more;
        for (int i = 0; i < 4; ++i)
            text += fmt::format("q{} = {{ initial = 0, rate = {:.17g} }}\n", i + 1, rate[i]);
        text += "[energy]\nkinetic = \"(q1'^2 + q2'^2 + q3'^2 + q4'^2)/2\"\n[forces]\n";
        for (int i = 0; i < 4; ++i) text += fmt::format("q{} = {:.17g}\n", i + 1, F[i]);
        for (int k = 0; k < 3; ++k)
            text += fmt::format(
                "[[constraint]]\nname = \"c{0}\"\nholonomic = \"{1}\"\n[[friction]]\nname = \"f{0}\"\non = "
                "\"c{0}\"\n"
                "coefficient = {2:.17g}\nslip = \"{3}\"\n",
                k + 1, form(A.row(k), ""), mu, form(w.row(k), "'"));
        return text;
    }
};

}  // namespace

TEST_CASE(
    "friction: of three coupled reactions the signs are found that agree with the forces, however many rounds "
    "it takes") {
    std::set<int> met;
    for (unsigned seed = 0; seed < 3000 && met.size() < 3; ++seed) {
        const Rubbed system(seed);
        const std::vector<Eigen::Vector3d> expected = system.consistent();
        if (expected.empty() || !met.insert(system.rounds()).second) continue;
        CAPTURE(seed);
        REQUIRE(expected.size() == 1);
        const Json state = json_of({"eval", temporary("rubbed.toml", system.scene())});
        for (int k = 0; k < 3; ++k)
            CHECK(state["multipliers"][fmt::format("lambda_c{}", k + 1)].get<double>() ==
                  doctest::Approx(expected[0][k]).epsilon(1e-9));
    }
    CHECK(met == std::set{1, 2, 3});
}

TEST_CASE("friction: a reaction that changes its sign is told by the name of its friction") {
    const auto result = run({"simulate", trammel});
    CHECK(result.out.find(": the reaction of friction 'slot_A' changes sign\n") != std::string::npos);
    CHECK(result.out.find("sign(") == std::string::npos);
}

}  // namespace commands_friction_slots
