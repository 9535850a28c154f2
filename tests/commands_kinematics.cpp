// SPDX-License-Identifier: MIT
// `kinematics` as a user runs it, and claims about positions, velocities and accelerations.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "files.hpp"
#include "json.hpp"
#include "shell.hpp"

namespace commands_kinematics {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using alembert::test::temporary_folder;

namespace {

Json kinematics(const std::vector<std::string>& args) {
    return json_of({"kinematics"}, args);
}

std::vector<std::string> texts(const Json& list) {
    return list.get<std::vector<std::string>>();
}

}  // namespace

TEST_CASE("kinematics: claims are decided without masses, and are reported as kinematics") {
    const std::string frames = R"toml(
[parameters]
l = 1.5
[coordinates]
theta = 0.3
phi = 0.2
[definitions]
r = ["l*sin(theta)", "l*cos(theta)"]
[[frame]]
name = "A"
rotate = [["z", "-theta"]]
[[frame]]
name = "B"
parent = "A"
rotate = [["x", "phi"]]
[[point]]
name = "P"
offset = ["l*sin(theta)", "l*cos(theta)"]
)toml";
    const auto judged = [](const std::string& scene, const std::vector<std::string>& claims) {
        std::string text = scene;
        for (const std::string& claim : claims) text += "[[claim]]\nequation = \"" + claim + "\"\n";
        const auto result = run({"check", temporary("claims.toml", text), "--json"});
        INFO(result.err);
        REQUIRE((result.exit == 0 || result.exit == 1));
        return Json::parse(result.out)["claims"];
    };
    const std::vector<std::string> right{"dot(acc(P), ex(A)) = l*theta''",
                                         "dot(acc(P), ey(A)) = -l*theta'^2",
                                         "dot(alpha(B), ey(N)) = -phi''*sin(theta) - phi'*theta'*cos(theta)",
                                         "dot(alpha(B), ex(B)) = phi''",
                                         "norm(acc(P))^2 = l^2*(theta''^2 + theta'^4)",
                                         "dot(r, vel(P)) = 0",
                                         "norm(pos(P) - r) = 0"};
    const std::vector<std::string> wrong{"dot(acc(P), ex(A)) = l*theta'^2", "dot(acc(P), ey(A)) = l*theta'^2",
                                         "dot(alpha(B), ey(N)) = -phi''*sin(theta)", "dot(alpha(B), ex(B)) = 0"};
    const auto heavy = [&](const std::string& inertia) {
        return frames + "[[body]]\nname = \"D\"\nat = \"P\"\nframe = \"B\"\nmass = \"l\"\ninertia = " + inertia +
               "\n";
    };
    const std::string turning = heavy("[1, 2, 3]"), symmetric = heavy("[1, 2, 2]");
    for (const std::string& scene : {frames, turning}) {
        for (const Json& claim : judged(scene, right)) {
            INFO(claim["equation"].get<std::string>());
            CHECK(claim["verdict"] == "proved");
            CHECK(claim["kinematic"] == true);
            CHECK_FALSE(claim["reason"].get<std::string>().empty());
        }
        for (const Json& claim : judged(scene, wrong)) {
            INFO(claim["equation"].get<std::string>());
            CHECK(claim["verdict"] == "refuted");
            CHECK(claim["kinematic"] == false);
            CHECK_FALSE(claim["counterexample"].empty());
        }
    }
    // A claim that needs a force is not kinematics; a claim that the constraints imply is.
    const Json pushed = judged(symmetric + "[forces]\nphi = \"l\"\n", {"phi'' = l", "phi'' - l = 0*theta''"});
    CHECK(pushed[0]["verdict"] == "proved");
    CHECK(pushed[0]["kinematic"] == false);
    const Json bound = judged(turning + "[[constraint]]\nname = \"gear\"\nholonomic = \"phi = 2*theta\"\n",
                              {"dot(alpha(B), ex(B)) = 2*theta''", "phi'' = 2*theta''"});
    for (const Json& claim : bound) {
        CHECK(claim["verdict"] == "proved");
        CHECK(claim["kinematic"] == true);
    }
}

TEST_CASE("kinematics: what is written of textbook scenes are right claims, and steps add up to the whole") {
    for (const std::string name :
         {"heavy_top", "spherical_coordinates", "turning_axes", "heavy_top_quaternion", "turntable_particle",
          "rolling_cone", "double_pendulum_joints", "heavy_top_joint"}) {
        const std::string file = std::string(ALEMBERT_SOURCE_DIR) + "/scenes/textbook/" + name + ".toml";
        const Json json = kinematics({file, "--steps"});
        std::string claims;
        const auto claim = [&](const std::string& vector, const Json& shown, const std::string& along) {
            for (std::size_t k = 0; k < 3; ++k)
                if (shown[k].is_string())
                    claims += fmt::format("dot({},e{}({})) = {}\n", vector, "xyz"[k], along,
                                          shown[k].get<std::string>());
        };
        const auto sum = [&](const std::string& vector, const std::vector<Json>& parts, const std::string& along) {
            for (std::size_t k = 0; k < 3; ++k) {
                std::string right;
                for (const Json& part : parts)
                    right += (right.empty() ? "(" : " + (") +
                             (part[k].is_string() ? part[k].get<std::string>() : "?") + ")";
                if (right.find('?') == std::string::npos && !right.empty())
                    claims += fmt::format("dot({},e{}({})) = {}\n", vector, "xyz"[k], along, right);
            }
        };
        for (const auto& [of, frame] : json["frames"].items()) {
            claim("omega(" + of + ")", frame["omega"], "N");
            claim("alpha(" + of + ")", frame["alpha"], "N");
            claim("omega(" + of + ")", frame["own"]["omega"], of);
            claim("alpha(" + of + ")", frame["own"]["alpha"], of);
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < 3; ++k)
                    if (frame["direction_cosines"][i][k].is_string())
                        claims += fmt::format("dot(e{}(N),e{}({})) = {}\n", "xyz"[i], "xyz"[k], of,
                                              frame["direction_cosines"][i][k].get<std::string>());
            std::vector<Json> omegas, alphas;
            for (const Json& step : frame["steps"]) {
                omegas.push_back(step["omega"]);
                alphas.push_back(step["alpha"]);
                alphas.push_back(step["omega_cross_omega"]);
            }
            sum("omega(" + of + ")", omegas, frame["parent"]);
            sum("alpha(" + of + ")", alphas, frame["parent"]);
        }
        for (const auto& [of, point] : json["points"].items()) {
            claim("pos(" + of + ")", point["position"], "N");
            claim("vel(" + of + ")", point["velocity"], "N");
            claim("acc(" + of + ")", point["acceleration"], "N");
            if (!point.contains("own")) continue;
            const std::string along = point["own"]["along"];
            claim("pos(" + of + ")", point["own"]["position"], along);
            claim("vel(" + of + ")", point["own"]["velocity"], along);
            claim("acc(" + of + ")", point["own"]["acceleration"], along);
            if (point["from"] != "O" || point["steps"].size() != 1 || point["steps"][0]["along"] != along)
                continue;
            const Json& step = point["steps"][0];
            sum("vel(" + of + ")", {step["relative_velocity"], step["turning_velocity"]}, along);
            sum("acc(" + of + ")", {step["relative"], step["tangential"], step["centripetal"], step["coriolis"]},
                along);
        }
        const auto result = run({"check", file, temporary("kinematics.txt", claims), "--json"});
        INFO(name);
        INFO(result.err);
        REQUIRE((result.exit == 0 || result.exit == 1));
        const Json judged = Json::parse(result.out)["claims"];
        CHECK(judged.size() > 10);
        for (const Json& one : judged) {
            INFO(one["equation"].get<std::string>());
            CHECK(one["verdict"] == "proved");
            CHECK(one["kinematic"] == true);
        }
    }
}

TEST_CASE("kinematics: formulas are those of the books") {
    using Texts = std::vector<std::string>;
    const auto book = [](const std::string& name) {
        return kinematics({std::string(ALEMBERT_SOURCE_DIR) + "/scenes/textbook/" + name + ".toml"});
    };
    const Json euler = book("euler_angles")["frames"];
    CHECK(texts(euler["F"]["own"]["omega"]) == Texts{"psi'*sin(theta)*sin(phi) + theta'*cos(phi)",
                                                     "psi'*sin(theta)*cos(phi) - theta'*sin(phi)",
                                                     "psi'*cos(theta) + phi'"});
    CHECK(texts(euler["E"]["own"]["alpha"])[0] == "theta''");
    const Json spherical = book("spherical_coordinates")["points"]["P"]["own"];
    CHECK(texts(spherical["velocity"]) == Texts{"r*theta'", "r*phi'*sin(theta)", "r'"});
    CHECK(texts(spherical["acceleration"])[2] == "r'' - r*theta'^2 - r*phi'^2*sin(theta)^2");
    const Json polar = kinematics({temporary("polar.toml",
                                             "[coordinates]\nr = 1\ntheta = 0.2\nz = 0\n[[frame]]\nname = \"A\"\n"
                                             "rotate = [[\"z\", \"theta\"]]\n[[point]]\nname = \"P\"\n"
                                             "offset = [\"r\", 0, \"z\"]\naxes = \"A\"\n"),
                                   "--at", "theta'=2", "--at", "r'=3", "--at", "theta''=0.5"});
    CHECK(texts(polar["points"]["P"]["own"]["acceleration"]) ==
          Texts{"r'' - r*theta'^2", "r*theta'' + 2*r'*theta'", "z''"});
    CHECK(polar["points"]["P"]["values"]["own"]["acceleration"][1].get<double>() == doctest::Approx(12.5));
    CHECK(polar["frames"]["A"]["angle"] == "theta");
    CHECK(texts(polar["frames"]["A"]["axis"]) == Texts{"0", "0", "1"});
    const Json table = book("turntable_particle")["points"]["P"]["own"];
    CHECK(texts(table["acceleration"])[2] == "0");
    // A top whose figure axis precesses at a constant rate: alpha is psi' phi' sin(theta) along the nodes.
    const Json cone = book("rolling_cone")["frames"]["B"];
    CHECK(cone["values"]["omega"][2].get<double>() == doctest::Approx(0));
}

TEST_CASE("kinematics: names, formats and impossible states are told") {
    const std::string top = std::string(ALEMBERT_SOURCE_DIR) + "/scenes/textbook/heavy_top.toml";
    const auto refused = [](const std::vector<std::string>& args, const std::string& why) {
        const auto result = run(args);
        CHECK(result.exit == 3);
        INFO(result.err);
        CHECK(result.err.find(why) != std::string::npos);
    };
    refused({"kinematics", top, "--of", "G"}, "there is no frame, body or point 'G'");
    refused({"kinematics", top, "--at", "thta''=1"},
            "no coordinate has the acceleration thta''; did you mean 'theta'''?");
    refused({"kinematics", std::string(ALEMBERT_SOURCE_DIR) + "/scenes/textbook/two_body.toml"},
            "the scene has no frames, bodies or points");
    const std::string joint = std::string(ALEMBERT_SOURCE_DIR) + "/scenes/textbook/universal_joint.toml";
    refused({"kinematics", joint, "--at", "theta1''=1", "--at", "theta2''=0"},
            "the accelerations given break constraint 'cross'");
    const Json follows = kinematics({joint, "--at", "theta1''=1"});
    CHECK(follows["accelerations"]["theta2"].get<double>() == doctest::Approx(1 / std::cos(0.5)).epsilon(1e-14));
    CHECK(kinematics({top, "--of", "top"})["frames"].size() == 1);
    CHECK(run({"kinematics", top, "--steps", "--format", "latex"}).out.find("\\omega_x^{\\text{F}}") !=
          std::string::npos);
    CHECK(run({"kinematics", top, "--steps", "--format", "mathml"}).out.find("<mi>ω</mi>") != std::string::npos);
    // Without accelerations the rest is told.
    const Json still =
        kinematics({temporary("massless.toml",
                              "[coordinates]\nx = 1\ny = 2\n[[particle]]\nname = \"P\"\nmass = 1\n"
                              "position = [\"x\", 0]\n[[point]]\nname = \"Q\"\noffset = [\"y\", 0]\n")});
    CHECK(still["accelerations"].is_null());
    CHECK(still["points"]["Q"]["values"]["acceleration"][0].is_null());
    CHECK(still["points"]["Q"]["values"]["position"][0] == 2);
    CHECK(still["no_accelerations"].get<std::string>().find("nothing has inertia along y'") != std::string::npos);
}

TEST_CASE("kinematics: wrong claims on the scenes of chapters 2 and 3 are refuted") {
    const std::vector<std::pair<std::string, std::vector<std::string>>> wrong{
        {"simple_rotation", {"dot(ex(N), ex(B)) = (1 + cos(theta))/3", "dot(alpha(B), n) = theta'"}},
        {"euler_angles",
         {"dot(omega(F), ex(F)) = psi'*sin(theta)*cos(phi) + theta'*cos(phi)", "dot(alpha(F), ex(E)) = theta''"}},
        {"turning_axes", {"norm(alpha(C) - second)^2 = 0", "dot(alpha(C), ey(B)) = q2'' - q1'*q3'*cos(q2)"}},
        {"spherical_coordinates",
         {"dot(acc(P), ez(S)) = r'' - r*theta'^2 - r*phi'^2", "dot(acc(P), ex(S)) = r*theta'' + 2*r'*theta'"}},
        {"turntable_particle",
         {"norm(acc(P) - transport - x''*ex(T) - y''*ey(T))^2 = 0",
          "m*(x'' - angle'*y' - angle'^2*x - angle''*y) = -k*x"}},
        {"rolling_cone", {"dot(alpha(cone), ey(A)) = 0", "dot(omega(cone), ex(A)) = -phi'/sin(beta)"}},
        {"universal_joint", {"theta2' = theta1'", "theta2'*(1 - sin(beta)^2*sin(theta1)^2) = theta1'*cos(beta)"}},
        {"parallel_axes",
         {"(m1*l^2/12 + m2*r^2/2 + m2*(l + r)^2)*theta'' + (m1*l/2 + m2*(l + r))*g*sin(theta) = 0"}},
        {"unbalanced_rotor",
         {"Izz*theta'' + D*a'' + ((Ixx - Iyy)*sin(theta)*cos(theta) - Ixy*cos(2*theta))*a'^2 = M",
          "Izz*theta'' = M"}},
        {"principal_axes", {"A*p' + (B - C)*q*r = 0", "dot(alpha(body), ex(B)) = p'"}}};
    for (const auto& [name, claims] : wrong) {
        std::string text;
        for (const std::string& claim : claims) text += claim + "\n";
        const auto result = run({"check", std::string(ALEMBERT_SOURCE_DIR) + "/scenes/textbook/" + name + ".toml",
                                 temporary("wrong.txt", text), "--json"});
        INFO(name);
        CHECK(result.exit == 1);
        const Json claims_found = Json::parse(result.out)["claims"];
        for (const Json& claim : claims_found) {
            INFO(claim["equation"].get<std::string>());
            CHECK(claim["verdict"] == "refuted");
            CHECK_FALSE(claim["counterexample"].empty());
        }
    }
}

TEST_CASE("kinematics: the Jacobian times the rates is the velocity, and J' q' with J q'' the acceleration") {
    const Json k = Json::parse(run({"kinematics", source_path("scenes/gallery/six_joint_arm.toml"), "--of",
                                    "flange", "--jacobian", "--json"})
                                   .out);
    const Json &point = k["points"]["flange"], &turning = k["frames"]["flange"]["values"];
    std::vector<std::string> names;
    for (int i = 1; i <= 6; ++i) names.push_back("q" + std::to_string(i));
    for (int i = 0; i < 6; ++i) {
        double v = 0, a = point["drift"][i].get<double>();
        for (int j = 0; j < 6; ++j) {
            const double entry = point["jacobian"][i][j].get<double>();
            v += entry * k["rates"][names[static_cast<std::size_t>(j)]].get<double>();
            a += entry * k["accelerations"][names[static_cast<std::size_t>(j)]].get<double>();
        }
        const Json& linear = point["values"];
        CHECK(std::abs(v - (i < 3 ? linear["velocity"][i] : turning["omega"][i - 3]).get<double>()) < 1e-10);
        CHECK(std::abs(a - (i < 3 ? linear["acceleration"][i] : turning["alpha"][i - 3]).get<double>()) < 1e-9);
    }
    CHECK(k["mass_centre"]["jacobian"].size() == 3);
}

TEST_CASE("kinematics: under --strict a point that only an option names is used, and no other") {
    const std::string scene = temporary("tip.toml", R"toml(
[[body]]
name = "arm"
mass = 1
inertia = [1, 1, 1]
[[joint]]
name = "j"
parent = "N"
child = "arm"
type = "revolute"
axis = "z"
coordinates = { theta = { initial = 0.3 } }
[[point]]
name = "tip"
from = "arm"
offset = [1, 0, 0]
axes = "arm"
)toml"),
                      folder = temporary_folder("tip");
    using Words = std::vector<std::string>;
    const auto exit_of = [&](Words words) {
        words.emplace_back("--strict");
        const auto result = run(words);
        CAPTURE(result.err);
        CHECK((result.exit == 3) == (result.err.find("point 'tip' is not used") != std::string::npos));
        return result.exit;
    };
    for (const Words& uses :
         {Words{"emit", scene, "-o", folder, "--frame", "tip"},
          Words{"emit", scene, "-o", folder, "--wrench", "tip"},
          Words{"emit", scene, "-o", folder, "--frame", "tip@arm"}, Words{"eval", scene, "--kinematics"},
          Words{"eval", scene, "--kinematics", "--of", "arm,tip"},
          Words{"eval", scene, "--inertia", "--about", "tip"}})
        CHECK(exit_of(uses) == 0);
    for (const Words& does_not :
         {Words{"emit", scene, "-o", folder}, Words{"eval", scene, "--kinematics", "--of", "arm"},
          Words{"eval", scene, "--inertia"}, Words{"emit", scene, "-o", folder, "--frame", "arm"}})
        CHECK(exit_of(does_not) == 3);
}

}  // namespace commands_kinematics
