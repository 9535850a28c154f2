// SPDX-License-Identifier: MIT
// The links of an imported robot are where their file has them: a link's name is its origin for all verbs, and its
// mass centre has another name. What SDF merges stands where an included model does.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"

namespace commands_import_links {

using alembert::test::contents;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

const char* const arm = R"(<robot name="r"><link name="base"/>
<link name="arm"><inertial><origin xyz="0.3 0 0"/><mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="tool"><inertial><origin xyz="0 0 0.1"/><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="hand"><inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j" type="continuous"><parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/></joint>
<joint name="t" type="fixed"><parent link="arm"/><child link="tool"/><origin xyz="0.5 0 0"/></joint>
<joint name="h" type="continuous"><parent link="tool"/><child link="hand"/><origin xyz="0.5 0 0"/><axis xyz="0 1 0"/></joint></robot>)";

void check_at(const Json& kinematics, const std::string& point, double x, double z) {
    CAPTURE(point);
    const Json& place = kinematics["points"][point]["values"]["position"];
    CHECK(std::abs(place[0].get<double>() - x) < 1e-14);
    CHECK(std::abs(place[1].get<double>()) < 1e-14);
    CHECK(std::abs(place[2].get<double>() - z) < 1e-14);
}

}  // namespace

TEST_CASE("import: the name of each link is its origin, whether a joint moves it or it is fixed to another") {
    const std::string scene = temporary("links.toml", "");
    json_of({"import", temporary("links.urdf", arm), "-o", scene});
    const Json k = json_of({"eval", scene, "--kinematics", "--jacobian", "--at", "j=pi/2"});
    check_at(k, "arm", 0, 1);  // turned down
    check_at(k, "tool", 0, 0.5);
    check_at(k, "hand", 0, 0);
    // (2·0.3 + 1·0.5)/3 along the arm and 0.1/3 across it, which is turned to −x … +x of the world.
    check_at(k, "arm_centre", 0.1 / 3, 1 - 1.1 / 3);
    CHECK(k["points"]["arm"]["jacobian"][0][0] == 0);
    CHECK(std::abs(k["points"]["tool"]["jacobian"][0][0].get<double>() + 0.5) < 1e-14);
    CHECK(k["points"].contains("hand_centre") == false);  // its mass centre is its origin
    // The same function in C++.
    const std::string folder = temporary("emitted", "");
    std::filesystem::remove(folder);
    CHECK(run({"emit", scene, "-o", folder, "--frame", "arm", "--frame", "tool"}).exit == 0);
    const auto wrong = run({"emit", scene, "-o", folder, "--frame", "arms"});
    CHECK(wrong.exit == 3);
    CHECK(wrong.err.find("there is no point or body 'arms'") != std::string::npos);
    // The motion is that of the same three masses in frames that turn by hand.
    const std::string by_frames = temporary("frames.toml", R"(gravity = [0, 0, -9.81]
coordinates = { j = 0.3, h = -0.7 }
[[frame]]
name = "A"
rotate = [["y", "j"]]
[[frame]]
name = "B"
parent = "A"
rotate = [["y", "h"]]
[[point]]
name = "pivot"
offset = [0, 0, 1]
[[body]]
name = "arm"
mass = 2
inertia = { xx = 0.1, yy = 0.1, zz = 0.1 }
frame = "A"
from = "pivot"
position = [0.3, 0, 0]
axes = "A"
[[body]]
name = "tool"
mass = 1
inertia = { xx = 0.1, yy = 0.1, zz = 0.1 }
frame = "A"
from = "pivot"
position = [0.5, 0, 0.1]
axes = "A"
[[body]]
name = "hand"
mass = 1
inertia = { xx = 0.1, yy = 0.1, zz = 0.1 }
frame = "B"
from = "pivot"
position = [1, 0, 0]
axes = "A"
)");
    const std::vector<std::string> state{"j'=0.5", "h'=-1.5"};
    const auto accelerations = [&](const std::string& file, std::vector<std::string> at) {
        std::vector<std::string> args{"eval", file, "--at"};
        at.insert(at.end(), state.begin(), state.end());
        args.insert(args.end(), at.begin(), at.end());
        return json_of(args)["accelerations"];
    };
    const Json found = accelerations(scene, {"j=0.3", "h=-0.7"}), expected = accelerations(by_frames, {});
    CHECK(found.size() == 2);
    for (const auto& [name, a] : expected.items())
        CHECK(std::abs(found[name].get<double>() - a.get<double>()) < 1e-12 * std::abs(a.get<double>()));
}

TEST_CASE("scene: a body's mass centre has a name of its own, and a point may then have the body's") {
    const auto body = [](const std::string& centre, const std::string& uses) {
        return temporary("centre.toml", fmt::format(R"(gravity = [0, 0, -9.81]
[[body]]
name = "a"
{}mass = 2
inertia = {{ xx = 0.1, yy = 0.2, zz = 0.3 }}
[[joint]]
name = "j"
type = "revolute"
parent = "N"
child = "a"
child_point = [-0.3, 0, 0]
axis = "y"
coordinates = {{ q = 0.4 }}
{}
)",
                                                    centre, uses));
    };
    const Json plain = json_of({"eval", body("", "[outputs]\nz = \"dot(pos(a), ez(N))\"")});
    const Json named = json_of({"eval", body("centre = \"c\"\n",
                                             "[[point]]\nname = \"a\"\nfrom = \"c\"\noffset = "
                                             "[-0.3, 0, 0]\naxes = \"a\"\n[outputs]\nz = "
                                             "\"dot(pos(c), ez(N))\"\no = \"norm(pos(a))\"")});
    CHECK(plain["accelerations"] == named["accelerations"]);
    CHECK(plain["outputs"]["z"] == named["outputs"]["z"]);
    CHECK(std::abs(named["outputs"]["o"].get<double>()) < 1e-15);
    // Every verb takes the centre's name for a place, and the body's for a frame only.
    const Json expected = json_of({"eval", body("", ""), "--inertia", "--about", "a"});
    const std::string scene = body("centre = \"c\"\n", "");
    CHECK(json_of({"eval", scene, "--inertia", "--about", "c"})["tensor"] == expected["tensor"]);
    const auto no_point = run({"eval", scene, "--inertia", "--about", "a"});
    CHECK(no_point.exit == 3);
    CHECK(no_point.err.find("there is no point 'a'") != std::string::npos);
    const std::string folder = temporary("wrench", "");
    for (const auto& [place, exit] :
         {std::pair("a", 3), std::pair("N", 3), std::pair("c", 0), std::pair("c@a", 0)}) {
        CAPTURE(place);
        std::filesystem::remove_all(folder);
        const auto emitted = run({"emit", scene, "-o", folder, "--wrench", place});
        CHECK(emitted.exit == exit);
        if (exit == 3)
            CHECK(emitted.err.find("is a frame, which has directions but no place") != std::string::npos);
    }
    // In a derivation the body's letter is that of its mass centre, which turns about a point 0.3 m away.
    const auto judged =
        run({"check", scene, temporary("centre.md", "The velocity of body a is $v_a = 0.3 \\dot q$.\n")});
    INFO(judged.out);
    CHECK(judged.out.find("right") != std::string::npos);
    CHECK(judged.exit == 0);
    CHECK(run({"eval", body("centre = \"O\"\n", "")}).exit == 3);
    CHECK(run({"eval", body("centre = \"c\"\n", "[[point]]\nname = \"c\"\noffset = [0, 0, 0]")}).exit == 3);
}

TEST_CASE("import: right angles that are exact leave no rounding in places and inertias") {
    const std::string scene = temporary("right.toml", "");
    const std::string robot =
        "<robot name=\"r\"><link name=\"base\"/><link name=\"a\"><inertial><origin xyz=\"0.1 0.2 0.3\" rpy=\"0 "
        "1.5708 "
        "0\"/><mass value=\"1\"/><inertia ixx=\"0.1\" iyy=\"0.2\" izz=\"0.15\" ixy=\"0\" ixz=\"0\" "
        "iyz=\"0\"/></inertial></link><link name=\"b\"/><link name=\"c\"/><joint name=\"j\" "
        "type=\"continuous\"><parent "
        "link=\"base\"/><child link=\"a\"/><origin xyz=\"0 0 1\" rpy=\"1.5708 0 -1.5708\"/><axis xyz=\"0 1 "
        "0\"/></joint>"
        "<joint name=\"f\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/><origin xyz=\"0.1 0.1 "
        "0\"/></joint><joint "
        "name=\"g\" type=\"fixed\"><parent link=\"b\"/><child link=\"c\"/><origin xyz=\"0.2 0.1 0.3\" rpy=\"0 0 "
        "1.5708\"/></joint></robot>";
    json_of({"import", temporary("right.urdf", robot), "-o", scene, "--right-angles"});
    const std::string text = contents(scene);
    CHECK(text.find("inertia = { xx = 0.15, yy = 0.2, zz = 0.1, xy = 0, yz = 0, zx = 0 }") != std::string::npos);
    CHECK(text.find("e-") == std::string::npos);
    json_of({"import", temporary("right.urdf", robot), "-o", scene});
    CHECK(contents(scene).find("inertia = { xx = 0.15, yy = 0.2, zz = 0.1, xy = 0") == std::string::npos);
}

TEST_CASE("import: an inertia that no body has becomes the nearest that a body has on request, and this is told") {
    std::string bad = arm;
    const std::string good = "ixx=\"0.1\" iyy=\"0.1\" izz=\"0.1\"";
    bad.replace(bad.rfind(good), good.size(), "ixx=\"0.2\" iyy=\"0.1\" izz=\"-0.01\"");
    const std::string file = temporary("bad.urdf", bad), scene = temporary("bad.toml", "");
    const auto refused = run({"import", file, "-o", scene});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("--mend-inertia") != std::string::npos);
    const auto mended = run({"import", file, "-o", scene, "--mend-inertia"});
    CHECK(mended.exit == 0);
    // tr/2 − I = (−0.055, 0.045, 0.155); without the first: moments 0.2, 0.155, 0.045.
    CHECK(mended.err.find(
              "the inertia of link 'hand' is none of a body: its principal moments -0.01, 0.1 and 0.2 became "
              "0.045, 0.155 and 0.2") != std::string::npos);
    CHECK(run({"eval", scene, "--strict"}).exit == 0);
}

TEST_CASE("import: a model that SDF merges stands with its links, frames and joints in the one around it") {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(temporary("merge", "")).parent_path() / "models";
    for (const char* name : {"base", "drone", "nested"}) fs::create_directories(folder / name);
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(folder / name / "model.sdf") << text;
        return (folder / name / "model.sdf").string();
    };
    const std::string link =
        "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>";
    write("base",
          "<sdf version=\"1.9\"><model name=\"base\"><pose>9 9 9 0 0 0</pose><link name=\"a\">" + link +
              "</link><link name=\"b\"><pose>0 0 1 0 0 0</pose>" + link +
              "</link><frame name=\"f\"><pose>0 0.5 0 0 0 0</pose></frame><joint name=\"j\" type=\"revolute\">"
              "<parent>a</parent><child>b</child><axis><xyz expressed_in=\"__model__\">1 0 0</xyz></axis></joint>"
              "</model></sdf>");
    const auto around = [&](const char* name, const std::string& attribute) {
        return write(
            name, "<sdf version=\"1.9\"><model name=\"drone\"><include" + attribute +
                      "><uri>model://base</uri><pose>1 2 3 0 0 1.5707963267948966</pose></include></model></sdf>");
    };
    const std::string merged = temporary("merged.toml", ""), nested = temporary("nested.toml", "");
    json_of({"import", around("drone", " merge=\"true\""), "-o", merged});
    json_of({"import", around("nested", ""), "-o", nested});
    const Json one = json_of({"eval", merged, "--kinematics"}), two = json_of({"eval", nested, "--kinematics"});
    for (const auto& [plain, deep] :
         {std::pair("a", "base__a"), std::pair("b", "base__b"), std::pair("f", "base__f")}) {
        CAPTURE(plain);
        REQUIRE(one["points"].contains(plain));
        std::string found;
        for (const auto& [name, point] : two["points"].items())
            if (name.ends_with(std::string("_") + plain)) found = name;
        REQUIRE(!found.empty());
        for (int i = 0; i < 3; ++i)
            CHECK(std::abs(one["points"][plain]["values"]["position"][i].get<double>() -
                           two["points"][found]["values"]["position"][i].get<double>()) < 1e-14);
    }
    CHECK(std::abs(one["points"]["f"]["values"]["position"][0].get<double>() - 0.5) < 1e-14);
    // __model__ in a model nested in the merged one is that one.
    write("nested",
          "<sdf version=\"1.9\"><model name=\"drone\"><include merge=\"true\"><uri>model://deep</uri>"
          "<pose>1 0 0 0 0 0</pose></include></model></sdf>");
    fs::create_directories(folder / "deep");
    const auto deep = [&](const std::string& more) {
        write("deep", "<sdf version=\"1.9\"><model name=\"deep\">" + more + "<link name=\"a\">" + link +
                          "</link><model name=\"inner\"><pose relative_to=\"__model__\">0 2 0 0 0 0</pose><frame "
                          "name=\"g\" attached_to=\"__model__\"><pose relative_to=\"__model__\">0 0 3 0 0 0</pose>"
                          "</frame><link name=\"c\"><pose relative_to=\"__model__\">0 0 1 0 0 0</pose>" +
                          link + "</link></model></model></sdf>");
        return run({"import", (folder / "nested" / "model.sdf").string(), "-o", nested, "--strict"});
    };
    CHECK(deep("").exit == 0);
    const Json inner = json_of({"eval", nested, "--kinematics"});
    for (const auto& [point, z] : {std::pair("inner__c", 1.), std::pair("inner__g", 3.)}) {
        CAPTURE(point);
        REQUIRE(inner["points"].contains(point));
        const Json& place = inner["points"][point]["values"]["position"];
        CHECK(place == Json({1., 2., z}));
    }
    const auto still = deep("<static>true</static>");
    CHECK(still.exit == 3);
    CHECK(still.err.find("<static> of a model that is merged into one that moves") != std::string::npos);
    // A fixed joint has no use for an axis: nothing is lost.
    const auto fixed =
        run({"import",
             temporary("fixed.sdf", "<sdf version=\"1.6\"><model name=\"m\"><link name=\"a\">" + link +
                                        "</link><link name=\"b\">" + link +
                                        "</link><joint name=\"j\" type=\"fixed\"><parent>a</parent><child>"
                                        "b</child><axis><xyz>0 0 1</xyz></axis></joint></model></sdf>"),
             "-o", merged, "--strict"});
    CHECK(fixed.exit == 0);
    CHECK(fixed.err.empty());
}

}  // namespace commands_import_links
