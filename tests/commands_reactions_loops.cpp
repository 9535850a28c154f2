// SPDX-License-Identifier: MIT
// Reactions of joints in linkages: the same wherever the loop is closed.
#include "edits.hpp"
#include "inverse_and_reactions.hpp"

namespace commands_reactions_loops {

using namespace alembert::test;

namespace {

void check_same_reactions(const Json& one, const Json& other, double tolerance) {
    REQUIRE(one.size() == other.size());
    for (const auto& entry : one.items()) {
        const std::string joint = entry.key();
        const Json& load = entry.value();
        CAPTURE(joint);
        REQUIRE(other.contains(joint));
        check_near(three(load["force"]), three(other[joint]["force"]), tolerance);
        check_near(three(load["moment"]), three(other[joint]["moment"]), tolerance);
    }
}

/// The same text with what is between `from` and `to` replaced.
std::string closed_elsewhere(const std::string& text, const std::string& opened, const std::string& coordinates) {
    // The joint `opened` closed the loop and now gets coordinates. It becomes a joint of the tree because it
    // stands before the joint that closes the loop now.
    const std::size_t at = text.find("name = \"" + opened + "\"");
    REQUIRE(at != std::string::npos);
    const std::size_t end = std::min(text.find("\n\n", at), text.size());
    return text.substr(0, end) + "\ncoordinates = { " + coordinates + " }" + text.substr(end);
}

std::string moved_to_the_end(const std::string& text, const std::string& joint, const std::string& coordinates) {
    const std::size_t at = text.rfind("[[joint]]", text.find("name = \"" + joint + "\""));
    const std::size_t end = text.find("\n\n", at);
    const std::string block = text.substr(at, end - at);
    return text.substr(0, at) + text.substr(end) + "\n" + edited(block, {{"\n" + coordinates, ""}}) + "\n";
}

using Q4 = std::array<double, 4>;

Q4 times(const Q4& p, const Q4& q) {
    return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

}  // namespace

TEST_CASE("reactions: those of a four-bar's joints are the same wherever its loop is closed") {
    const std::string text = contents(source_path("scenes/gallery/four_bar_joints.toml"));
    const Json one = json_of({"eval", temporary("one.toml", text), "--reactions"});
    const auto q = [&](const char* name) { return one["coordinates"][name].get<double>(); };
    const std::string guess =
        fmt::format("delta = {{ guess = {:.17g}, rate_guess = 0 }}", q("gamma") - q("alpha") - q("beta"));
    const std::string other =
        moved_to_the_end(closed_elsewhere(text, "J4", guess), "J3",
                         "coordinates = { gamma = { guess = 1.4, rate_guess = 0, unit = \"rad\" } }");
    const Json two = json_of({"eval", temporary("two.toml", other), "--reactions"});
    CHECK(std::abs(two["accelerations"]["beta"].get<double>() - one["accelerations"]["beta"].get<double>()) <
          1e-10);
    check_same_reactions(one["joint_reactions"], two["joint_reactions"], 1e-9);
    CHECK(std::abs(one["joint_reactions"]["J4"]["force"][0].get<double>()) > 1);
    // The rocker by itself: m a at its middle, and no moment at either pin: ½ c e × (F4 − F3) = I γ''.
    const double gamma = q("gamma"), rate = one["rates"]["gamma"].get<double>(),
                 second = one["accelerations"]["gamma"].get<double>(), turn = q("alpha") + q("beta");
    const auto force = [&](const char* joint, double by) {
        const V3 f = three(one["joint_reactions"][joint]["force"]);
        return std::array{f[0] * std::cos(by) - f[1] * std::sin(by), f[0] * std::sin(by) + f[1] * std::cos(by)};
    };
    const auto F3 = force("J3", 0), F4 = force("J4", turn);  // J4's axes are the coupler's
    const double ax = -1.75 * (second * std::sin(gamma) + rate * rate * std::cos(gamma)),
                 ay = 1.75 * (second * std::cos(gamma) - rate * rate * std::sin(gamma));
    CHECK(std::abs(F3[0] + F4[0] - 1.5 * ax) < 1e-10);
    CHECK(std::abs(F3[1] + F4[1] - 1.5 * ay) < 1e-10);
    const double about_centre = 1.75 * (std::cos(gamma) * (F4[1] - F3[1]) - std::sin(gamma) * (F4[0] - F3[0]));
    CHECK(std::abs(about_centre - 1.5 * 3.5 * 3.5 / 12 * second) < 1e-10);
}

TEST_CASE("reactions: at a hinge that closes a spatial linkage they are those of the same hinge in a tree") {
    const std::string text = contents(source_path("scenes/gallery/rssr.toml"));
    const Json one = json_of({"eval", temporary("one.toml", text), "--reactions"});
    const auto q = [&](const char* name) { return one["coordinates"][name].get<double>(); };
    const double alpha = q("alpha") / 2, beta = q("beta") / 2, half = std::sqrt(0.5);
    Q4 back = times({std::cos(alpha), 0, 0, std::sin(alpha)}, {q("e0"), q("e1"), q("e2"), q("e3")});
    for (std::size_t k = 1; k < 4; ++k) back[k] = -back[k];
    const Q4 f = times(back, times({half, half, 0, 0}, {std::cos(beta), 0, 0, std::sin(beta)}));
    std::string coordinates, ball = "coordinates = {";
    for (std::size_t k = 0; k < 4; ++k) {
        const std::string e = fmt::format("e{}", k);
        coordinates += fmt::format("{}f{} = {{ guess = {:.17g}, rate_guess = 0 }}", k == 0 ? "" : ", ", k, f[k]);
        ball += fmt::format("{} {} = {{ initial = {:.17g}, rate = {:.17g} }}", k == 0 ? "" : ",", e, q(e.c_str()),
                            one["rates"][e].get<double>());
    }
    std::string other = closed_elsewhere(text, "socket", coordinates);
    const std::size_t old = other.find("coordinates = { e0"), end = other.find('\n', old);
    other = other.substr(0, old) + ball + " }" + other.substr(end);
    other = edited(moved_to_the_end(other, "foot",
                                    "coordinates = { beta = { guess = 1.3, rate_guess = 0, unit = \"rad\" } }"),
                   {{"spread", "# spread"}});
    const Json two = json_of({"eval", temporary("two.toml", other), "--reactions"});
    CHECK(std::abs(two["accelerations"]["alpha"].get<double>() - one["accelerations"]["alpha"].get<double>()) <
          1e-9);
    check_same_reactions(one["joint_reactions"], two["joint_reactions"], 1e-9);
    CHECK(std::abs(one["joint_reactions"]["foot"]["moment"][0].get<double>()) > 0.1);
}

TEST_CASE(
    "reactions: a slider's rail bears force and moment about the slider's point, as the joint that closes the "
    "loop too") {
    const std::string bodies = R"toml(gravity = [0, -9.81, 0]
[[body]]
name = "crank"
mass = 1
inertia = [0.01, 0.02, 0.02]
[[body]]
name = "rod"
mass = 0.8
inertia = [0.01, 0.05, 0.05]
[[body]]
name = "slider"
mass = 2
inertia = [0.03, 0.04, 0.05]
[outputs]
ax = "(dot(vel(slider), ex(N)))'"
ay = "(dot(vel(slider), ey(N)))'"
s = "dot(pos(slider), ex(N))"
[[joint]]
name = "hub"
type = "revolute"
parent = "N"
child = "crank"
child_point = [-0.2, 0, 0]
coordinates = { phi = { initial = 0.7, rate = 3 } }
[[joint]]
name = "knee"
type = "revolute"
parent = "crank"
child = "rod"
parent_point = [0.2, 0, 0]
child_point = [-0.5, 0, 0]
coordinates = { psi = { guess = -1, rate_guess = 0 } }
)toml";
    const std::string rail =
        "[[joint]]\nname = \"rail\"\ntype = \"prismatic\"\nparent = \"N\"\nchild = \"slider\"\nparent_point = "
        "[0.3, 0.05, 0]\n"
        "parent_rotate = [[\"z\", 0.2]]\nchild_point = [0.1, -0.15, 0]\naxis = \"x\"\n";
    const std::string pin =
        "[[joint]]\nname = \"pin\"\ntype = \"revolute\"\nparent = \"rod\"\nchild = \"slider\"\nparent_point = "
        "[0.5, 0, 0]\n"
        "child_point = [-0.05, 0.02, 0]\n";
    const Json one = json_of(
        {"eval",
         temporary("one.toml", bodies + rail + "coordinates = { x = { guess = 1, rate_guess = 0 } }\n" + pin),
         "--reactions"});
    const double psi = one["coordinates"]["psi"].get<double>();
    const std::string chi =
        fmt::format("coordinates = {{ chi = {{ guess = {:.17g}, rate_guess = 0 }} }}\n", 0.2 - 0.7 - psi);
    const Json two =
        json_of({"eval",
                 temporary("two.toml", edited(bodies, {{"guess = -1", fmt::format("guess = {:.17g}", psi)}}) +
                                           pin + chi + rail),
                 "--reactions"});
    check_same_reactions(one["joint_reactions"], two["joint_reactions"], 1e-9);
    // Newton and Euler for the slider, which does not turn: its two joints along N, moments about its mass centre.
    const auto along_ground = [](const V3& v, double by) {
        return V3{v[0] * std::cos(by) - v[1] * std::sin(by), v[0] * std::sin(by) + v[1] * std::cos(by), v[2]};
    };
    const Json& load = two["joint_reactions"];
    const V3 F = along_ground(three(load["rail"]["force"]), 0.2),
             P = along_ground(three(load["pin"]["force"]), 0.7 + psi);
    const V3 at = along_ground({0.1, -0.15, 0}, 0.2), to = along_ground({-0.05, 0.02, 0}, 0.2);
    CHECK(std::abs(F[0] + P[0] - 2 * two["outputs"]["ax"].get<double>()) < 1e-10);
    CHECK(std::abs(F[1] + P[1] - 2 * (two["outputs"]["ay"].get<double>() + 9.81)) < 1e-10);
    const double M = load["rail"]["moment"][2].get<double>();
    CHECK(std::abs(M + at[0] * F[1] - at[1] * F[0] + to[0] * P[1] - to[1] * P[0]) < 1e-10);
    CHECK(std::abs(M) > 0.1);
}

}  // namespace commands_reactions_loops
