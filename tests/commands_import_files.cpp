// SPDX-License-Identifier: MIT
// The files that a description includes: found beside it, in packages and in folders above, and never where they
// must not be read. Robots that are put together from several files accelerate as those that are written in one.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"

namespace commands_import_files {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

namespace fs = std::filesystem;

/// A folder of files of its own.
class Folder {
public:
    explicit Folder(const std::string& name) : root_(fs::path(temporary(name + ".txt", "")).parent_path() / name) {
        fs::remove_all(root_);
    }
    std::string write(const std::string& file, const std::string& text) const {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text;
        return path(file);
    }
    std::string path(const std::string& file) const { return (root_ / file).string(); }

private:
    fs::path root_;
};

const std::string pendulum =
    R"(<worldbody><body name="a"><joint name="j" axis="0 1 0"/><geom size="0.1" pos="0 0 0.2"/></body></worldbody>)";

std::string refusal(const std::string& file, const std::vector<std::string>& options = {}) {
    std::vector<std::string> args{"import", file, "-o", temporary("none.toml", "")};
    args.insert(args.end(), options.begin(), options.end());
    const auto result = run(args);
    CHECK(result.exit == 3);
    CHECK(result.seconds < 20);
    return result.err;
}

}  // namespace

TEST_CASE("import: an included file is read only in the folder of the robot, and only if it is a regular file") {
    const Folder folder("included");
    const auto including = [&](const std::string& name) {
        return folder.write("robots/arm.xml", "<mujoco>\n<include file=\"" + name + "\"/></mujoco>");
    };
    const std::string whole = "<mujoco>" + pendulum + "</mujoco>", scene = temporary("included.toml", "");
    folder.write("robots/parts/pendulum.xml", whole);
    const std::string outside = folder.write("other/pendulum.xml", whole);
    for (const char* name : {"parts/pendulum.xml", "../robots/parts/pendulum.xml"})
        CHECK(json_of({"import", including(name), "-o", scene})["coordinates"] == Json({"j"}));
    fs::create_symlink(outside, folder.path("robots/link.xml"));
    for (const std::string& name : {std::string("../other/pendulum.xml"), std::string("link.xml"), outside}) {
        CHECK(refusal(including(name)).find("arm.xml:2:1: '" + name + "' is outside the folder of this file") !=
              std::string::npos);
        CHECK(json_of({"import", including(name), "-o", scene, "--allow-outside"})["coordinates"] == Json({"j"}));
    }
    REQUIRE(mkfifo(folder.path("robots/pipe").c_str(), 0600) == 0);
    for (const char* options : {"", "--allow-outside"})
        CHECK(refusal(including("pipe"),
                      *options != 0 ? std::vector<std::string>{options} : std::vector<std::string>{})
                  .find("'pipe' is no regular file, but a pipe or a device") != std::string::npos);
    CHECK(refusal(including("/dev/zero"), {"--allow-outside"}).find("is no regular file") != std::string::npos);
    CHECK(refusal(including("parts")).find("'parts' is a folder") != std::string::npos);
    CHECK(refusal(including("nothing.xml")).find("there is no file 'nothing.xml'") != std::string::npos);
    CHECK(refusal(including("arm.xml")).find("more than 100 files are included") != std::string::npos);
}

/// Accelerations of coordinates at a state in which all have the same values and rates.
Json accelerations(const std::string& file, const std::vector<std::string>& options = {}) {
    const std::string scene = temporary("put_together.toml", "");
    std::vector<std::string> at{"eval", scene};
    double value = 0.1;
    const Json imported = json_of({"import", file, "-o", scene, "--quaternion"}, options);
    for (const Json& name : imported["coordinates"]) {
        if (name.get<std::string>().find("_e") != std::string::npos) continue;
        for (const char* prime : {"", "'"}) {
            at.emplace_back("--at");
            at.push_back(fmt::format("{}{}={}", name.get<std::string>(), prime, value += 0.07));
        }
    }
    return json_of(at)["accelerations"];
}

void check_same(const Json& one, const Json& other) {
    REQUIRE(one.size() == other.size());
    double size = 0;
    for (const auto& [name, value] : one.items()) size = std::max(size, std::abs(value.get<double>()));
    CHECK(size > 0.1);
    for (const auto& [name, value] : one.items()) {
        CAPTURE(name);
        REQUIRE(other.contains(name));
        CHECK(std::abs(value.get<double>() - other[name].get<double>()) < 1e-11 * size);
    }
}

TEST_CASE("import: <replicate> of MJCF makes the bodies, motors and tendons that are written out by hand") {
    const Folder folder("replicated");
    // Each copy stands one step (0.5 along x, then a turn about z) from the last; the inner ones stand 0.2 apart.
    const auto arm = [](const std::string& name) {
        return fmt::format(
            R"(<body name="a{0}" pos="0 0 0.1"><joint name="j{0}" axis="0 1 0"/><geom size="0.1" pos="0.1 0.3 0.2"/>
               <site name="s{0}" pos="0 0 0.3"/></body>)",
            name);
    };
    const auto rest = [](const std::string& name) {
        return std::pair(
            fmt::format(R"(<fixed name="t{0}" stiffness="3" springlength="1"><joint joint="j{0}" coef="2"/></fixed>
                           <spatial stiffness="5" springlength="0.2"><site site="s{0}"/><site site="hook"/></spatial>)",
                        name),
            fmt::format(R"(<position name="p{0}" tendon="t{0}" kp="4"/>)", name));
    };
    const std::string hook = R"(<site name="hook" pos="1 1 1"/>)";
    std::string bodies = hook, tendons, motors;
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 2; ++i) {
            const std::string name = fmt::format("{}-{}", i, k);
            bodies += fmt::format(R"(<frame pos="{} 0 0" euler="0 0 {}"><frame pos="0 {} 0">{}</frame></frame>)",
                                  0.5 * k, 40 * k, 0.2 * i, arm(name));
            tendons += rest(name).first;
            motors += rest(name).second;
        }
    const auto whole = [](const std::string& inside, const std::string& all, const std::string& pulling) {
        return "<mujoco><worldbody>" + inside + "</worldbody><tendon>" + all + "</tendon><actuator>" + pulling +
               "</actuator></mujoco>";
    };
    const std::string by_hand = folder.write("by_hand.xml", whole(bodies, tendons, motors));
    const std::string by_rule = folder.write(
        "by_rule.xml",
        whole(
            hook +
                R"(<replicate count="2" offset="0.5 0 0" euler="0 0 40" sep="-"><replicate count="2" offset="0 0.2 0">)" +
                arm("") + "</replicate></replicate>",
            rest("").first, rest("").second));
    check_same(accelerations(by_hand, {"--drives"}), accelerations(by_rule, {"--drives"}));
    const auto of = [&](const std::string& count) {
        return folder.write("wrong.xml", "<mujoco><worldbody>\n<replicate count=\"" + count + "\">" + arm("") +
                                             "</replicate></worldbody></mujoco>");
    };
    for (const char* count : {"0", "-3", "1.5", "1e9"})
        CHECK(refusal(of(count)).find("wrong.xml:2:1: the count of <replicate> is ") != std::string::npos);
    // Nine to the thirtieth of a shape without a name.
    std::string many = "<geom size=\"1\"/>";
    for (int k = 0; k < 30; ++k) many = "<replicate count=\"9\">" + many + "</replicate>";
    CHECK(refusal(folder.write("wrong.xml", whole(many, "", "")))
              .find("more than 100000 elements are made by rules") != std::string::npos);
}

TEST_CASE("import: <attach> of MJCF takes a part of another model, with its classes, units and what acts on it") {
    const Folder folder("attached");
    folder.write("parts/leg.xml",
                 R"(<mujoco model="leg"><compiler angle="radian"/>
        <default><joint damping="0.3"/><default class="knee"><joint damping="0.9" armature="0.1"/></default></default>
        <worldbody><body name="thigh" pos="0 0 1"><joint name="hip" axis="0 1 0" springref="0.5" stiffness="2"/>
          <geom size="0.1" pos="0.1 0 -0.2"/>
          <body name="shin" pos="0 0 -0.4" euler="0.3 0 0"><joint class="knee" name="knee" axis="1 0 0"/>
            <geom size="0.1" pos="0 0.2 0"/></body></body>
          <body name="other"><joint name="o"/><geom size="1" pos="1 0 0"/></body></worldbody>
        <equality><joint joint1="o"/></equality>
        <tendon><fixed name="t" stiffness="3"><joint joint="hip" coef="1"/><joint joint="knee" coef="2"/></fixed></tendon>
        <actuator><position name="m" joint="knee" kp="5"/></actuator></mujoco>)");
    const std::string attached = folder.write("robot.xml", R"(<mujoco><default><joint damping="50"/></default>
        <asset><model name="leg" file="parts/leg.xml"/></asset>
        <worldbody><body name="trunk"><joint name="x" type="slide" axis="0 0 1"/><geom size="0.2"/>
          <frame pos="0.3 0 0" euler="0 0 90"><attach model="leg" body="thigh" prefix="L_"/></frame>
          <attach model="leg" body="thigh" prefix="R_"/></body></worldbody></mujoco>)");
    const auto leg = [](const std::string& prefix) {
        return fmt::format(R"(<body name="{0}thigh" pos="0 0 1"><joint name="{0}hip" axis="0 1 0" damping="0.3"
            stiffness="2" springref="28.64788975654116"/><geom size="0.1" pos="0.1 0 -0.2"/>
          <body name="{0}shin" pos="0 0 -0.4" euler="17.188733853924695 0 0"><joint damping="0.9" armature="0.1"
            name="{0}knee" axis="1 0 0"/><geom size="0.1" pos="0 0.2 0"/></body></body>)",
                           prefix);
    };
    const auto acts = [](const std::string& prefix) {
        return fmt::format(R"(<tendon><fixed name="{0}t" stiffness="3"><joint joint="{0}hip" coef="1"/>
            <joint joint="{0}knee" coef="2"/></fixed></tendon>
            <actuator><position name="{0}m" joint="{0}knee" kp="5"/></actuator>)",
                           prefix);
    };
    const std::string by_hand = folder.write(
        "by_hand.xml",
        R"(<mujoco><worldbody><body name="trunk"><joint name="x" type="slide" axis="0 0 1" damping="50"/>
          <geom size="0.2"/><frame pos="0.3 0 0" euler="0 0 90">)" +
            leg("L_") + "</frame>" + leg("R_") + "</body></worldbody>" + acts("L_") + acts("R_") + "</mujoco>");
    check_same(accelerations(by_hand, {"--drives"}), accelerations(attached, {"--drives"}));
    const auto attaching = [&](const std::string& asset, const std::string& rule) {
        return refusal(folder.write("wrong.xml", "<mujoco><asset><model " + asset +
                                                     "/></asset><worldbody>\n<attach " + rule +
                                                     " prefix=\"p\"/></worldbody></mujoco>"));
    };
    CHECK(attaching(R"(name="a" file="parts/leg.xml")", R"(model="b")")
              .find("wrong.xml:2:1: <attach> names the model 'b'") != std::string::npos);
    CHECK(
        attaching(R"(name="a" file="parts/leg.xml")", R"(model="a" body="foot")").find("names the body 'foot'") !=
        std::string::npos);
    CHECK(attaching(R"(name="a" file="wrong.xml")", R"(model="a")").find("attached in each other") !=
          std::string::npos);
    for (const char* twice : {"", R"(<attach body="b" prefix="q"/>)"})
        CHECK(refusal(folder.write("self.xml",
                                   fmt::format(R"(<mujoco><worldbody><body name="b"><joint/><geom size="1"/>
                <attach body="b" prefix="p"/>{}</body></worldbody></mujoco>)",
                                               twice)))
                  .find("attached in each other") != std::string::npos);
    CHECK(attaching(R"(name="a" file="../leg.xml")", R"(model="a")").find("is outside the folder") !=
          std::string::npos);
}

TEST_CASE("import: models that an SDF file includes stand, under their names, where the file puts them") {
    const Folder folder("worlds");
    const auto link = [](const std::string& pose, const std::string& axis) {
        return fmt::format(
            R"(<link name="l"><pose>{}</pose><inertial><pose>0.2 0 0.1 0 0 0</pose><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.2</iyy>
               <izz>0.15</izz></inertia></inertial></link><frame name="f" attached_to="l"><pose>0 0 0.1 0 0.2 0</pose></frame>
               <joint name="j" type="revolute"><parent>world</parent><child>l</child><axis><xyz{}</xyz></axis></joint>)",
            pose, axis);
    };
    // The model of version 1.4 gives the axis along its own axes, and the one in `world` along those of the link.
    folder.write("models/arm/model.sdf", "<sdf version=\"1.4\"><model name=\"arm\"><pose>9 9 9 0 0 0</pose>" +
                                             link("0.3 0 0 0 0.7 0", ">1 0 0") + "</model></sdf>");
    folder.write("models/lamp/model.sdf", "<sdf version=\"1.7\"><light name=\"lamp\" type=\"point\"/></sdf>");
    const auto world = [&](const std::string& inside) {
        return folder.write("worlds/w.sdf", "<sdf version=\"1.9\"><world name=\"w\"><gravity>0 1 -9</gravity>\n" +
                                                inside + "</world></sdf>");
    };
    const auto model = [&](const std::string& name, const std::string& pose) {
        return "<model name=\"" + name + "\"><pose>" + pose + "</pose>" +
               link("0.3 0 0 0 0.7 0", " expressed_in=\"__model__\">1 0 0") + "</model>";
    };
    const Json by_hand = accelerations(world(model("one", "1 2 3 0 0 0.4") + model("arm", "9 9 9 0 0 0")));
    for (const char* uri :
         {"model://arm", "model://arm/model.sdf", "../models/arm", "file://../models/arm/model.sdf"}) {
        CAPTURE(uri);
        const std::string file = world(fmt::format(
            "<include><uri>{0}</uri><name>one</name><pose>1 2 3 0 0 0.4</pose></include><include><uri>{0}"
            "</uri></include><include><uri>model://lamp</uri></include>",
            uri));
        const bool is_above = std::string(uri).find("..") != std::string::npos;
        if (is_above) CHECK(refusal(file).find("w.sdf:2:1: ") != std::string::npos);
        check_same(by_hand, accelerations(file, is_above ? std::vector<std::string>{"--allow-outside"}
                                                         : std::vector<std::string>{}));
    }
    const Folder elsewhere("elsewhere");
    const std::string alone =
        elsewhere.write("w.sdf",
                        "<sdf version=\"1.9\"><world name=\"w\"><gravity>0 1 -9</gravity>\n<include><uri>model://"
                        "arm</uri></include></world></sdf>");
    CHECK(refusal(alone).find("--package FOLDER names the folder") != std::string::npos);
    CHECK(accelerations(alone, {"--package", folder.path("models")}).size() == 1);
    folder.write(
        "models/ring/model.sdf",
        "<sdf version=\"1.7\"><model name=\"ring\"><include><uri>model://ring</uri></include></model></sdf>");
    const auto including = [&](const std::string& uri) {
        return refusal(world("<include><uri>" + uri + "</uri></include>"));
    };
    CHECK(including("model://ring").find("more than 200 files are included") != std::string::npos);
    CHECK(including("model://../models/arm").find("is outside the folder") != std::string::npos);
    CHECK(including("https://fuel.gazebosim.org/x").find("is not on this machine") != std::string::npos);
    CHECK(including("").find("has no <uri>") != std::string::npos);
}

}  // namespace commands_import_files
