// SPDX-License-Identifier: MIT
// The same robots in URDF and SDF, with and without closed loops, and rotors behind gears: they accelerate alike,
// and as scenes that are written by hand.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_import_formats {

using alembert::test::contents;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

Json imported(const std::string& file, const std::string& scene, std::vector<std::string> options = {}) {
    return json_of({"import", file, "-o", scene}, options);
}

Json accelerations(const std::string& scene, const std::vector<std::string>& at) {
    std::vector<std::string> args{"eval", scene, "--json"};
    for (const std::string& value : at) {
        args.emplace_back("--at");
        args.push_back(value);
    }
    return json_of(args)["accelerations"];
}

void check_same(const Json& one, const Json& other) {
    REQUIRE(one.size() == other.size());
    double size = 1;
    for (const auto& [name, value] : one.items()) size = std::max(size, std::abs(value.get<double>()));
    for (const auto& [name, value] : one.items()) {
        CAPTURE(name);
        CHECK(std::abs(value.get<double>() - other[name].get<double>()) < 1e-10 * size);
    }
}

const char* const urdf_arm = R"(<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0.1" rpy="0.1 0.2 0.3"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.2" izz="0.15" ixy="0.01" ixz="0.02" iyz="-0.01"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0 0.1 0"/><mass value="1"/>
    <inertia ixx="0.05" iyy="0.02" izz="0.04"/></inertial></link>
  <link name="rod"><inertial><mass value="0.5"/><inertia ixx="0.01" iyy="0.02" izz="0.03"/></inertial></link>
  <link name="tool"/>
  <joint name="j1" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0.1 0 0.5" rpy="0.3 0 0"/><axis xyz="0 0.6 0.8"/><dynamics damping="0.3"/>
    <limit lower="-2" upper="2" effort="5" velocity="3"/></joint>
  <joint name="j2" type="continuous"><parent link="upper"/><child link="lower"/>
    <origin xyz="0.4 0 0" rpy="0 0.5 0.2"/><axis xyz="1 0 0"/></joint>
  <joint name="j3" type="prismatic"><parent link="lower"/><child link="rod"/>
    <origin xyz="0 0.3 0.1"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="5" velocity="3"/></joint>
  <joint name="tip" type="fixed"><parent link="rod"/><child link="tool"/><origin xyz="0 0 0.2" rpy="0 0.1 0"/></joint>
  <transmission name="t1"><joint name="j1"/><actuator name="m1"><mechanicalReduction>50</mechanicalReduction>
    <drake:rotor_inertia value="2e-5"/></actuator></transmission>
  <transmission name="t2"><joint name="j2"/><actuator name="m2"><drake:gear_ratio value="20"/></actuator></transmission>
</robot>)";

// The pose of `upper` is that of j1 in the URDF; rod is the parent of the reversed joint j3, and its axis is given
// along that of the model, whose axes are those of `lower` turned back.
const char* const sdf_arm = R"(<sdf version="1.9"><world name="w"><gravity>0 0 -9.81</gravity>
<model name="arm"><pose>1 2 3 0 0 0</pose>
  <link name="upper"><pose>0.1 0 0.5 0.3 0 0</pose><inertial><pose>0.2 0 0.1 0.1 0.2 0.3</pose><mass>2</mass>
    <inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.15</izz><ixy>0.01</ixy><ixz>0.02</ixz><iyz>-0.01</iyz></inertia>
    </inertial><visual name="v"/></link>
  <link name="rod"><pose relative_to="socket">0 0.3 0.1 0 0 0</pose><inertial><mass>0.5</mass>
    <inertia><ixx>0.01</ixx><iyy>0.02</iyy><izz>0.03</izz></inertia></inertial></link>
  <link name="lower"><pose relative_to="socket"/><inertial><pose>0 0.1 0 0 0 0</pose><mass>1</mass>
    <inertia><ixx>0.05</ixx><iyy>0.02</iyy><izz>0.04</izz></inertia></inertial></link>
  <frame name="socket" attached_to="upper"><pose degrees="true">0.4 0 0 0 28.64788975654116 11.459155902616466</pose></frame>
  <frame name="tool" attached_to="rod"><pose>0 0 0.2 0 0.1 0</pose></frame>
  <joint name="j1" type="revolute"><parent>world</parent><child>upper</child>
    <axis><xyz>0 0.6 0.8</xyz><dynamics><damping>0.3</damping></dynamics><limit><lower>-2</lower><upper>2</upper>
    <effort>5</effort></limit></axis><drake:rotor_inertia>2e-5</drake:rotor_inertia>
    <drake:gear_ratio>50</drake:gear_ratio></joint>
  <joint name="j2" type="revolute"><pose>0.05 0 0 0 0 0</pose><parent>socket</parent><child>lower</child>
    <axis><xyz expressed_in="socket">1 0 0</xyz><limit><lower>-1e16</lower><upper>inf</upper></limit></axis></joint>
  <joint name="j3" type="prismatic"><pose>0 0 0 1 0 0</pose><parent>rod</parent><child>lower</child>
    <axis><xyz expressed_in="lower">0 0 -1</xyz></axis></joint>
</model></world></sdf>)";

// Two bars that hang from the ground, 1 m apart, and a coupler between them, which the pin closes.
std::string four_bar(const std::string& how) {
    const auto inertial = [&](const char* x) {
        return how == "urdf" ? fmt::format(
                                   "<inertial><origin xyz=\"{} 0 0\"/><mass value=\"1\"/><inertia ixx=\"0.01\" "
                                   "iyy=\"0.1\" izz=\"0.1\"/></inertial>",
                                   x)
                             : fmt::format(
                                   "<inertial><pose>{} 0 0 0 0 0</pose><mass>1</mass><inertia><ixx>0.01</ixx>"
                                   "<iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>",
                                   x);
    };
    if (how == "urdf")
        return fmt::format(
            "<robot name=\"bars\"><link name=\"ground\"/><link name=\"left\">{0}</link><link "
            "name=\"right\">{0}</link>"
            "<link name=\"coupler\">{1}</link>"
            "<joint name=\"a\" type=\"continuous\"><parent link=\"ground\"/><child link=\"left\"/><origin "
            "rpy=\"0 1.5707963267948966 0\"/><axis xyz=\"0 1 0\"/></joint>"
            "<joint name=\"b\" type=\"continuous\"><parent link=\"left\"/><child link=\"coupler\"/><origin "
            "xyz=\"0.8 0 0\" rpy=\"0 -1.5707963267948966 0\"/><axis xyz=\"0 1 0\"/></joint>"
            "<joint name=\"c\" type=\"continuous\"><parent link=\"ground\"/><child link=\"right\"/><origin "
            "xyz=\"1 0 "
            "0\" rpy=\"0 1.5707963267948966 0\"/><axis xyz=\"0 1 0\"/></joint></robot>",
            inertial("0.4"), inertial("0.5"));
    return fmt::format(
        "<sdf version=\"1.7\"><model name=\"bars\"><link name=\"left\"><pose>0 0 0 0 1.5707963267948966 "
        "0</pose>{0}"
        "</link><link name=\"right\"><pose>1 0 0 0 1.5707963267948966 0</pose>{0}</link><link "
        "name=\"coupler\"><pose>0 0 "
        "-0.8 0 0 0</pose>{1}</link>"
        "<joint name=\"a\" type=\"revolute\"><parent>world</parent><child>left</child><axis><xyz>0 1 "
        "0</xyz></axis></joint>"
        "<joint name=\"b\" type=\"revolute\"><parent>left</parent><child>coupler</child><axis><xyz>0 1 "
        "0</xyz></axis></joint>"
        "<joint name=\"c\" type=\"revolute\"><parent>world</parent><child>right</child><axis><xyz>0 1 "
        "0</xyz></axis></joint>"
        "<joint name=\"pin\" type=\"revolute\"><pose>1 0 0 0 0 "
        "0</pose><parent>right</parent><child>coupler</child><axis>"
        "<xyz>0 1 0</xyz></axis></joint></model></sdf>",
        inertial("0.4"), inertial("0.5"));
}

}  // namespace

TEST_CASE(
    "import: SDF with frames, reversed joints and poses relative to others accelerates as the same robot in "
    "URDF") {
    const std::string a = temporary("arm.toml", ""), b = temporary("arm_sdf.toml", "");
    const Json urdf = imported(temporary("arm.urdf", urdf_arm), a),
               sdf = imported(temporary("arm.sdf", sdf_arm), b);
    CHECK(contents(a).find("armature = { j1 = 0.05 }") != std::string::npos);  // 50² · 2e-5
    CHECK(urdf["dropped"]["<transmission>"] == Json({"t2"}));  // a ratio without a rotor changes nothing
    for (const Json* told : {&urdf, &sdf}) {
        CHECK((*told)["names"]["coordinates"] == Json({{"j1", {"j1"}}, {"j2", {"j2"}}, {"j3", {"j3"}}}));
        CHECK((*told)["names"]["links"]["tool"] == "tool");
        CHECK((*told)["dropped"].contains("limits of joints, without --stops"));
    }
    CHECK(sdf["dropped"]["<visual>"] == Json({"v"}));
    const std::vector<std::string> at{"j1=0.4", "j2=-0.7", "j3=0.2", "j1'=1.1", "j2'=-0.6", "j3'=0.5"};
    check_same(accelerations(a, at), accelerations(b, at));
    const auto tool = [&](const std::string& scene) {
        const Json k = Json::parse(
            run({"kinematics", scene, "--of", "tool", "--json", "--at", "j1=0.4", "--at", "j2=0.3"}).out);
        return std::pair(k["points"]["tool"]["values"]["position"],
                         k["frames"]["tool"]["values"]["direction_cosines"]);
    };
    const auto [r, R] = tool(a);
    const auto [s, S] = tool(b);
    for (int i = 0; i < 3; ++i) {
        CHECK(std::abs(s[i].get<double>() - r[i].get<double>() - (i + 1)) < 1e-12);  // where the model stands
        for (int k = 0; k < 3; ++k) CHECK(std::abs(S[i][k].get<double>() - R[i][k].get<double>()) < 1e-12);
    }
}

TEST_CASE("import: a loop that a file of joints closes moves as in SDF, and as two bars on a coupler do") {
    const std::string a = temporary("bars.toml", ""), b = temporary("bars_sdf.toml", "");
    const std::string pins =
        temporary("pins.toml",
                  "[[joint]]\nname = \"pin\"\ntype = \"revolute\"\nparent = \"right\"\nchild = "
                  "\"coupler\"\nparent_point = [\"2*0.4\", 0, 0]\nchild_point = [1, 0, 0]\naxis = "
                  "\"y\"\n");
    const Json urdf = imported(temporary("bars.urdf", four_bar("urdf")), a, {"--loops", pins});
    const Json sdf = imported(temporary("bars.sdf", four_bar("sdf")), b);
    CHECK(urdf["loops"] == Json({"pin"}));
    CHECK(sdf["loops"] == Json({"pin"}));
    // The coupler shifts without turning. With φ' = 1 from φ = 0.5 (b = −φ, c = φ): φ'' (2 (0.1 + 0.4²) + 0.8²) =
    // −9.81 (2·0.4 + 0.8) sin φ.
    const std::vector<std::string> at{"a=0.5", "b=-0.5", "c=0.5", "a'=1", "b'=-1", "c'=1"};
    const double expected = -9.81 * 1.6 * std::sin(0.5) / (2 * (0.1 + 0.16) + 0.64);
    for (const std::string& scene : {a, b}) {
        const Json second = accelerations(scene, at);
        CHECK(std::abs(second["a"].get<double>() - expected) < 1e-11);
        CHECK(std::abs(second["b"].get<double>() + expected) < 1e-11);
        CHECK(std::abs(second["c"].get<double>() - expected) < 1e-11);
    }
    const auto refused = run({"import", temporary("bars.urdf", four_bar("urdf")), "-o", a, "--loops",
                              temporary("wrong.toml",
                                        "[[joint]]\nname = \"pin\"\ntype = \"revolute\"\nparent = "
                                        "\"rigth\"\nchild = \"coupler\"\nchild_point = [\"l\", 0, 0]\n")});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("wrong.toml:4:11: ") != std::string::npos);
    CHECK(refused.err.find("the robot has no link 'rigth'; did you mean 'right'?") != std::string::npos);
    CHECK(refused.err.find("l is no number") != std::string::npos);
}

// Two hinges on the ground with the moments J₁ = 0.3 and J₂ = 0.2, and a spring of 4 N m on the first: with
// θ₂ = −n θ₁ the motion is (J₁ + n² J₂) θ₁'' = −4 θ₁, whichever way the axes of the hinges and of the gearbox
// point.
TEST_CASE("import: a gearbox of SDF couples two hinges, and a link without gravity does not fall") {
    const auto model = [](const std::string& hinge_axis, const std::string& second, const std::string& more = "") {
        const auto link = [](const char* name, double moment) {
            return fmt::format(
                "<link "
                "name=\"{}\"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>{}</izz></inertia>"
                "</inertial></link>",
                name, moment);
        };
        const auto hinge = [](const char* name, const char* link, const std::string& axis, const char* stiffness) {
            return fmt::format(
                "<joint name=\"{}\" "
                "type=\"revolute\"><parent>world</parent><child>{}</child><axis><xyz>{}</xyz><dynamics>"
                "<spring_stiffness>{}</spring_stiffness></dynamics></axis></joint>",
                name, link, axis, stiffness);
        };
        return temporary(
            "gears.sdf",
            "<sdf version=\"1.9\"><model name=\"m\">" + link("a", 0.3) + link("b", 0.2) +
                hinge("one", "a", "0 0 1", "4") + hinge("two", "b", hinge_axis, "0") +
                "\n<joint name=\"gear\" type=\"gearbox\"><parent>a</parent><child>b</child><gearbox_ratio>3"
                "</gearbox_ratio><gearbox_reference_body>world</gearbox_reference_body><axis><xyz>0 0 1</xyz>"
                "</axis><axis2><xyz>" +
                second + "</xyz></axis2></joint>" + more + "</model></sdf>");
    };
    const std::string scene = temporary("gears.toml", "");
    for (const auto& [hinge, second, sign] :
         {std::tuple("0 0 1", "0 0 1", -1), std::tuple("0 0 -1", "0 0 1", 1), std::tuple("0 0 1", "0 0 -1", 1),
          std::tuple("0 0 -1", "0 0 -1", -1)}) {
        CHECK(imported(model(hinge, second), scene)["couplings"] == Json({"gear"}));
        const Json found = accelerations(scene, {"one=0.1", fmt::format("two={}", sign * 0.3)});
        const double expected = -4 * 0.1 / (0.3 + 9 * 0.2);
        CHECK(std::abs(found["one"].get<double>() - expected) < 1e-12);
        CHECK(std::abs(found["two"].get<double>() - 3 * sign * expected) < 1e-12);
    }
    const auto refused = run({"import", model("0 0 1", "0 1 0"), "-o", scene});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("gears.sdf:2:1: the gearbox 'm::gear' needs a hinge between 'world' and 'm::b'") !=
          std::string::npos);
    const std::string weightless = "<link name=\"c\"><gravity>false</gravity></link><link name=\"d\"/>";
    imported(model("0 0 1", "0 0 1", weightless), scene, {"--quaternion"});
    const Json fall = accelerations(scene, {});
    CHECK(std::abs(fall["c_z"].get<double>()) < 1e-12);
    CHECK(std::abs(fall["d_z"].get<double>() + 9.81) < 1e-12);
}

TEST_CASE("import: mistakes in MJCF and SDF are refused with their line") {
    const auto told = [](const char* name, const std::string& text) {
        const auto result = run({"import", temporary(name, text), "-o", temporary("none.toml", "")});
        CHECK(result.exit == 3);
        return result.err;
    };
    const auto body = [](const std::string& inside) {
        return "<mujoco><worldbody>\n<body name=\"a\">\n" + inside + "\n</body></worldbody></mujoco>";
    };
    CHECK(
        told("a.xml", body("<joint axis=\"0 0\"/>")).find(":3:1: axis=\"0 0\" of <joint>: these are 2 numbers") !=
        std::string::npos);
    CHECK(told("b.xml", body("<joint type=\"hing\"/>")).find("expected hinge, slide, ball or free") !=
          std::string::npos);
    CHECK(told("c.xml", body("<geom type=\"box\" size=\"1,2,3\"/>")).find("'1,2,3' is no finite number") !=
          std::string::npos);
    CHECK(told("d.xml", body("<flexcomp count=\"3\"/>")).find("makes bodies by a rule") != std::string::npos);
    CHECK(told("e.xml", "<mujoco><worldbody></mujoco>").find("this is no XML") != std::string::npos);
    CHECK(told("f.sdf",
               "<sdf version=\"1.9\"><model name=\"m\">\n<link name=\"a\"><pose relative_to=\"b\"/></link>"
               "</model></sdf>")
              .find(":2:1: 'b' is no link, joint, frame or model here") != std::string::npos);
    CHECK(told("g.sdf",
               "<sdf version=\"1.9\"><model name=\"m\"><link name=\"a\"/>\n<joint name=\"j\" type=\"geared\">"
               "<parent>world</parent><child>a</child></joint></model></sdf>")
              .find("expected revolute, continuous, prismatic") != std::string::npos);
}

}  // namespace commands_import_formats
