// SPDX-License-Identifier: MIT
// Thirty broken or unusual robot descriptions: a mass, an inertia or a joint never changes silently. The result is
// compared with the same robot read from a plain description.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "json.hpp"
#include "program.hpp"

namespace commands_import_unusual {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

const std::string mass = R"(<mass value="1.5"/>)";
const std::string inertia = R"(<inertia ixx="0.1" iyy="0.2" izz="0.15" ixy="0" iyz="0" ixz="0"/>)";
const std::string limit = R"(<limit lower="-1" upper="1" effort="1" velocity="1"/>)";

struct Parts {
    std::string origin = R"(<origin xyz="0 0 0.5" rpy="0 0 1.5707963267948966"/>)";
    std::string mass = commands_import_unusual::mass, inertia = commands_import_unusual::inertia, inertial = "",
                link = "";
    std::string joint = R"(<origin xyz="0.1 0 0"/><axis xyz="0 1 0"/>)" + limit;
    std::string base = R"(<link name="base"/>)", more = "", robot = R"(<robot name="r">)";
    std::string type = "revolute";
};

std::string file_of(const Parts& p) {
    const std::string inertial =
        p.inertial.empty() ? "<inertial>\n" + p.origin + "\n" + p.mass + "\n" + p.inertia + "\n</inertial>"
                           : p.inertial;
    return temporary("unusual.urdf", p.robot + "\n" + p.base + "\n<link name=\"arm\">" + inertial + p.link +
                                         "</link>\n<joint name=\"j\" type=\"" + p.type +
                                         "\"><parent link=\"base\"/><child link=\"arm\"/>" + p.joint +
                                         "</joint>\n" + p.more + "</robot>\n");
}

/// The acceleration of j from gravity, which mass, centre, inertia and the joint's place decide.
double acceleration(const std::string& urdf) {
    const std::string scene = temporary("unusual.toml", "");
    REQUIRE(run({"import", urdf, "-o", scene}).exit == 0);
    return json_of({"eval", scene, "--at", "j=0.4"})["accelerations"]["j"];
}

}  // namespace

TEST_CASE("import: unreadable values of a mass, an inertia or a joint are refused with their line") {
    struct Case {
        Parts parts;
        int line;
        const char* told;
    };
    const std::string nothing;
    const std::vector<Case> cases{
        {{.mass = R"(<mass value="1,5"/>)"}, 5, "'1,5' is no number, the decimal sign is a point"},
        {{.mass = "<mass value=\"1.\n5\"/>"}, 5, "these are 2 numbers; expected one number"},
        {{.mass = "<mass>1.5</mass>"}, 5, "<mass> has no value"},
        {{.mass = R"(<mass val="1.5"/>)"}, 5, "<mass> has no value"},
        {{.mass = R"(<mass value=""/>)"}, 5, "these are 0 numbers"},
        {{.mass = R"(<mass value="1.5kg"/>)"}, 5, "'1.5kg' is no number"},
        {{.mass = R"(<mass value="nan"/>)"}, 5, "'nan' is not finite"},
        {{.mass = R"(<mass value="1e999"/>)"}, 5, "beyond the range"},
        {{.mass = R"(<mass value="${m}"/>)"}, 5, "is no number"},
        {{.mass = mass + mass}, 5, "a second <mass> inside <inertial>"},
        {{.mass = nothing}, 3, "<inertial> of link 'arm' has no mass"},
        {{.inertia = R"(<inertia ixx="0.1" iyy="0.2" izz="0.1 5" ixy="0" iyz="0" ixz="0"/>)"}, 6, "izz=\"0.1 5\""},
        {{.inertia = R"(<inertia ixx="0.1" iyy="0.2" ixy="0" iyz="0" ixz="0"/>)"}, 6, "<inertia> has no izz"},
        {{.inertia = R"(<inertia ixx="0.1" iyy="0.2" izz="0.15" ixy="O" iyz="0" ixz="0"/>)"},
         6,
         "'O' is no number"},
        {{.inertia = R"(<inertia/>)"}, 6, "<inertia> has no ixx"},
        {{.inertia = R"(<inertia ixx="-0.1" iyy="0.2" izz="0.15"/>)"}, 0, "link 'arm' has the principal moments"},
        {{.origin = R"(<origin xyz="0 0,5 0"/>)"}, 4, "'0,5' is no number"},
        {{.origin = R"(<origin rpy="0 0 0" quat_xyzw="0 0 0 1"/>)"}, 4, "rpy and quat_xyzw; expected one of them"},
        {{.origin = R"(<origin quat_xyzw="0 0 0 0"/>)"}, 4, "quat_xyzw is zero"},
        {{.link = "<inertial/>"}, 7, "a second <inertial>"},
        {{.joint = R"(<axis xyz="0 1"/>)" + limit}, 8, "xyz=\"0 1\" of <axis>: these are 2 numbers"},
        {{.joint = R"(<axis xyz="0 1 0"/><axis xyz="1 0 0"/>)" + limit}, 8, "a second <axis>"},
        {{.joint = R"(<axis xyz="0 1 0"/><dynamics damping="x"/>)" + limit}, 8, "damping=\"x\" of <dynamics>"},
        {{.type = "hinge"}, 8, "urdfdom refuses it"},
    };
    for (const Case& one : cases) {
        const auto result = run({"import", file_of(one.parts), "-o", temporary("unusual.toml", "untouched")});
        INFO(one.told << ": " << result.err);
        CHECK(result.exit == 3);
        CHECK(result.err.find(one.told) != std::string::npos);
        if (one.line > 0) CHECK(result.err.find(fmt::format("unusual.urdf:{}:", one.line)) != std::string::npos);
    }
}

TEST_CASE("import: unusual descriptions give the same motion as plain ones, and completed parts are reported") {
    const double plain = acceleration(file_of({}));
    const std::string no_products = R"(<inertia ixx="0.1" iyy="0.2" izz="0.15"/>)";
    struct Case {
        Parts parts;
        const char* told;  ///< null if no message is required
    };
    const std::vector<Case> cases{
        {{.origin = "<origin xyz=\"0\n0\t0.5 \" rpy=\"0 0\n 1.5707963267948966\"/>",
          .mass = "<mass value=\" 1.5\n\"/>"},
         nullptr},
        {{.origin = R"(<origin xyz="0 0 0.5" quat_xyzw="0 0 0.7071067811865476 0.7071067811865476"/>)"}, nullptr},
        {{.origin = R"(<origin xyz="0 0 0.5" quat_xyzw="0 0 2 2"/>)"}, "quat_xyzw has the length 2.82842712"},
        {{.inertia = no_products}, "6:1: warning: the inertia of link 'arm' has no ixy, iyz, ixz, taken as 0"},
        {{.joint = R"(<origin xyz="0.1 0 0" rpy="0 0 0"/><axis xyz="0 1 0"/>)"}, nullptr},
        {{.joint = R"(<origin xyz="0.1 0 0"/><axis xyz="0 1 0"/><limit lower="-1" upper="1"/>)"}, nullptr},
        {{.robot = "<robot>"}, "1:1: warning: <robot> has no name; it is called robot"},
        {{.base =
              R"(<link name="base"/><joint name="w" type="fixed"><parent link="world"/><child link="base"/></joint>)"},
         "the link 'world', from which joints hang, is not described; it is the ground"},
        {{.joint = R"(<origin xyz="0.1 0 0" frame="b"/><axis xyz="0 1 0"/>)" + limit}, "<origin frame=…>: j"},
        {{.link = R"(<visual><origin xyz="x"/></visual>)"}, "dropped: <visual>: arm"},
    };
    for (const Case& one : cases) {
        const std::string file = file_of(one.parts);
        const auto result = run({"import", file, "-o", temporary("unusual.toml", ""), "--json"});
        INFO(result.err);
        CHECK(result.exit == 0);
        if (one.told != nullptr) CHECK(result.err.find(one.told) != std::string::npos);
        CHECK(acceleration(file) == doctest::Approx(plain).epsilon(1e-14));
    }
}

TEST_CASE(
    "import: a link without an inertia is a point mass, and an antenna's bad tensor is judged with its link") {
    const std::string point = file_of({.inertia = ""});
    const auto told = run({"import", point, "-o", temporary("unusual.toml", ""), "--json"});
    CHECK(told.err.find("unusual.urdf:3:18: warning: link 'arm' has no <inertia>: its mass is a point") !=
          std::string::npos);
    CHECK(Json::parse(told.out)["warnings"][0]["line"] == 3);
    // A pendulum of length 0.5 from the y axis: j'' = +g/l sin j, for z points up.
    CHECK(acceleration(point) == doctest::Approx(9.81 / 0.5 * std::sin(0.4)).epsilon(1e-14));

    const std::string antenna = R"(<link name="antenna"><inertial><mass value="1e-6"/>
<inertia ixx="-1e-9" iyy="1e-9" izz="1e-9" ixy="0" iyz="0" ixz="0"/></inertial></link>
<joint name="k" type="fixed"><parent link="arm"/><child link="antenna"/></joint>)";
    const std::string file = file_of({.more = antenna});
    const auto merged = run({"import", file, "-o", temporary("unusual.toml", "")});
    CHECK(merged.exit == 0);
    CHECK(merged.err.find("warning: the principal moments of inertia of link 'antenna', -1e-09") !=
          std::string::npos);
    // Both about the y axis: I_yy = 0.1 after the turn, + 1.5·0.5² + 1e-9.
    CHECK(acceleration(file) ==
          doctest::Approx(1.5 * 9.81 * 0.5 * std::sin(0.4) / (0.1 + 1.5 * 0.25 + 1e-9)).epsilon(1e-13));
}

TEST_CASE("import: a tensor that breaks the triangle inequality is told for its link, with the line") {
    const std::string file =
        file_of({.inertia = R"(<inertia ixx="1" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/>)"});
    const std::string scene = temporary("unusual.toml", "");
    const auto told = run({"import", file, "-o", scene});
    CHECK(told.exit == 0);
    CHECK(told.err.find("warning: the principal moments of inertia of link 'arm' break the triangle inequality: "
                        "0.01 + 0.01 is less than 1; no body has them") != std::string::npos);
    CHECK(told.err.find("unusual.urdf:") != std::string::npos);
    const std::string model = R"(<mujoco><worldbody><body name="arm"><joint type="hinge"/>
<inertial pos="0 0 0" mass="1" diaginertia="1 0.01 0.01"/></body></worldbody></mujoco>)";
    const auto of_mjcf = run({"import", temporary("unusual.xml", model), "-o", scene});
    CHECK(of_mjcf.exit == 0);
    CHECK(of_mjcf.err.find("unusual.xml:2") != std::string::npos);
    CHECK(of_mjcf.err.find("of link 'arm' break the triangle inequality") != std::string::npos);
    // A plate has C = A + B, written with few digits.
    CHECK(run({"import", file_of({.inertia = R"(<inertia ixx=".1" iyy=".2" izz=".3" ixy="0" ixz="0" iyz="0"/>)"}),
               "-o", scene})
              .err.find("triangle") == std::string::npos);
}

}  // namespace commands_import_unusual
