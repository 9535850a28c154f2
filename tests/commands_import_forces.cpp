// SPDX-License-Identifier: MIT
// What MJCF files say of forces: springs with play, inertia along tendons and weight that is borne, against
// formulas by hand; and what changes the motion and is left out is told apart from what does not. (What libmujoco
// computes too is in commands_mujoco.cpp.)
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"

namespace commands_import_forces {

using alembert::test::contents;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

std::string model(const std::string& bodies, const std::string& rest = "") {
    return temporary("forces.xml", "<mujoco><compiler angle=\"radian\"/><worldbody>" + bodies + "</worldbody>" +
                                       rest + "</mujoco>");
}

struct Imported {
    std::string scene;
    Json told;

    /// The acceleration of a coordinate at a state.
    double acceleration(const std::string& of, const std::vector<std::string>& at = {}) const {
        std::vector<std::string> args{"eval", scene};
        for (const std::string& value : at) {
            args.emplace_back("--at");
            args.push_back(value);
        }
        return json_of(args)["accelerations"][of];
    }
};

Imported imported(const std::string& file, const std::vector<std::string>& options = {}) {
    const std::string scene = temporary("forces.toml", "");
    return {scene, json_of({"import", file, "-o", scene}, options)};
}

constexpr double tolerance = 1e-12;

/// A block of 2 kg on a rail across gravity; sites in it, at 1.5 m on its way, and at 1 m beside it.
std::string block(const std::string& joint = "") {
    return "<site name=\"wall\" pos=\"1.5 0 0\"/><site name=\"side\" pos=\"0 1 0\"/><body name=\"b\"><joint "
           "name=\"x\" type=\"slide\" axis=\"1 0 0\" " +
           joint + "/><geom type=\"sphere\" size=\"0.1\" mass=\"2\"/><site name=\"s\"/></body>";
}
std::string fixed_tendon(const std::string& values) {
    return "<tendon><fixed name=\"T\" " + values + "><joint joint=\"x\" coef=\"2\"/></fixed></tendon>";
}
std::string string_to(const std::string& site, const std::string& values) {
    return "<tendon><spatial name=\"T\" " + values + "><site site=\"s\"/><site site=\"" + site +
           "\"/></spatial></tendon>";
}

}  // namespace

// L = 2 x: outside of [a, b] the force on x is −2 k (L − b) or −2 k (L − a).
TEST_CASE("import: the spring of a tendon is slack between its two lengths") {
    const Imported rod = imported(model(block(), fixed_tendon("stiffness=\"5\" springlength=\"-0.4 0.6\"")));
    CHECK(std::abs(rod.acceleration("x", {"x=0.5"}) + 5 * 0.4) < tolerance);
    CHECK(std::abs(rod.acceleration("x", {"x=-0.5"}) - 5 * 0.6) < tolerance);
    CHECK(rod.acceleration("x", {"x=0.1"}) == 0);
    // L = |1.5 − x|, and a rope only pulls.
    const Imported rope = imported(model(block(), string_to("wall", "stiffness=\"4\" springlength=\"0 1\"")));
    CHECK(std::abs(rope.acceleration("x", {"x=0.2"}) - 4 * 0.3 / 2) < tolerance);
    CHECK(std::abs(rope.acceleration("x", {"x=2.9"}) + 4 * 0.4 / 2) < tolerance);
    CHECK(rope.acceleration("x", {"x=0.8"}) == 0);
}

// A rope of 1.2 m from a hook holds a ball that falls from 1 m below it: after 0.2 m of fall it is taut.
TEST_CASE("import: the range of a tendon through sites holds it, and its least length of 0 needs no stop") {
    const Imported rope = imported(model("<site name=\"hook\"/><body pos=\"0 0 -1\"><joint name=\"z\" "
                                         "type=\"slide\"/><geom size=\"0.1\"/><site name=\"s\"/></body>",
                                         "<tendon><spatial name=\"rope\" range=\"0 1.2\"><site "
                                         "site=\"hook\"/><site site=\"s\"/></spatial></tendon>"),
                                   {"--stops"});
    CHECK(contents(rope.scene).find("rope_low") == std::string::npos);
    const Json impact = json_of({"simulate", rope.scene, "--duration", "0.3", "--no-estimate"})["contacts"][0];
    CHECK(impact["name"] == "rope_high");
    CHECK(std::abs(impact["time"].get<double>() - std::sqrt(2 * 0.2 / 9.81)) < 1e-9);
    CHECK(std::abs(impact["speed_before"].get<double>() + std::sqrt(2 * 0.2 * 9.81)) < 1e-9);
}

// T = m x'²/2 + J L'²/2. For L = √(x² + 1): (m + J x²/L²) x'' = −J x x'²/L⁴.
TEST_CASE("import: a tendon has inertia along its length") {
    const Imported rod = imported(model(block("stiffness=\"6\""), fixed_tendon("armature=\"0.25\"")));
    CHECK(std::abs(rod.acceleration("x", {"x=0.5"}) + 6 * 0.5 / (2 + 4 * 0.25)) < tolerance);
    const Imported side = imported(model(block(), string_to("side", "armature=\"4\"")));
    CHECK(std::abs(side.acceleration("x", {"x=1", "x'=1"}) + (4 * 1 / 4.) / (2 + 4 / 2.)) < tolerance);
}

// A rod along x that turns about y: m₁ at 0.3, of whose weight a fourth is borne, and m₂ at 0.5, borne as a whole.
TEST_CASE("import: gravity compensation bears a part of the weight of each body, also where bodies are one") {
    const char* const rod = R"(<body name="b" gravcomp="0.25"><joint name="q" axis="0 1 0"/>
        <geom size="0.1" mass="2" pos="0.3 0 0"/>
        <body name="c" pos="0.5 0 0" gravcomp="1"><geom size="0.1" mass="1"/></body></body>)";
    const double inertia = 2 * (0.09 + 0.004) + 1 * (0.25 + 0.004);
    const Imported held = imported(model(rod));
    CHECK(held.told["changes_motion"].empty());
    for (const double q : {0., 0.8})
        CHECK(std::abs(held.acceleration("q", {fmt::format("q={}", q)}) -
                       0.75 * 2 * 9.81 * 0.3 * std::cos(q) / inertia) < tolerance);
    const Imported off = imported(model(rod, "<option><flag passive=\"disable\"/></option>"));
    CHECK(std::abs(off.acceleration("q") - 9.81 * (2 * 0.3 + 0.5) / inertia) < tolerance);
}

// x'' = −(k x + d x')/m with what is left of k = 6 and d = 4 for m = 2.
TEST_CASE("import: what <flag> of MJCF switches off is not in the scene, and nothing else is") {
    struct Case {
        const char* flag;
        double force;
        bool falls, has_limits, has_equality;
    };
    const Case cases[] = {{"energy", 5, true, true, true},      {"gravity", 5, false, true, true},
                          {"passive", 0, true, true, true},     {"spring", 2, true, true, true},
                          {"damper", 3, true, true, true},      {"constraint", 5, true, false, false},
                          {"equality", 5, true, true, false},   {"limit", 5, true, false, true},
                          {"frictionloss", 5, true, true, true}};
    for (const Case& c : cases) {
        CAPTURE(c.flag);
        const Imported one = imported(
            model(
                block("stiffness=\"6\" damping=\"4\" range=\"-1 1\"") +
                    "<body name=\"c\"><joint name=\"y\" type=\"slide\" axis=\"0 0 1\"/><geom size=\"0.1\"/></body>"
                    "<body name=\"d\"><joint name=\"z\" type=\"slide\"/><geom size=\"0.1\"/></body>",
                fmt::format("<option><flag {}=\"disable\"/></option><equality><joint name=\"same\" "
                            "joint1=\"y\" joint2=\"z\"/></equality>",
                            c.flag)),
            {"--stops"});
        CHECK(std::abs(one.acceleration("x", {"x=0.5", "x'=0.5"}) + c.force / 2) < tolerance);
        CHECK(std::abs(one.acceleration("y") + (c.falls ? 9.81 : 0)) < tolerance);
        CHECK((contents(one.scene).find("name = \"x_low\"") != std::string::npos) == c.has_limits);
        CHECK(one.told.contains("couplings") == c.has_equality);
    }
}

TEST_CASE("import: what changes the motion is told apart from what does not, and --strict refuses it") {
    struct Case {
        std::string joint, rest, kind;  ///< the kind is empty if nothing changes
        std::vector<std::string> options = {};
    };
    const std::vector<Case> cases{
        {"", "<asset/><statistic extent=\"2\"/><visual/><sensor><jointpos joint=\"x\"/></sensor><keyframe/>", ""},
        {"damping=\"1\" armature=\"2\" group=\"3\" solreflimit=\"0.1 1\"", "<contact><exclude/></contact>", ""},
        {"frictionloss=\"0.3\"", "", "Coulomb friction of joints, without --friction"},
        {"frictionloss=\"0.3\"", "", "", {"--friction"}},
        {"range=\"-1 1\"", "", "limits of joints, without --stops"},
        {"range=\"-1 1\"", "", "", {"--stops"}},
        {"range=\"-1 1\"", "<option><flag limit=\"disable\"/></option>", ""},
        {"", fixed_tendon("range=\"-1 1\""), "limits of tendons, without --stops"},
        {"", fixed_tendon("range=\"-1 1\""), "", {"--stops"}},
        {"", fixed_tendon("frictionloss=\"1\""), "Coulomb friction of tendons, without --friction"},
        {"", fixed_tendon("frictionloss=\"1\""), "", {"--friction"}},
        {"", fixed_tendon("stiffness=\"1 0 3\""), "<fixed stiffness=…> of higher degree"},
        {"actuatorfrcrange=\"-1 1\"", "", "<joint actuatorfrcrange=…>"},
        {"xais=\"0 1 0\"", "", "<joint xais=…>"},
        {"", "<option density=\"1.2\" viscosity=\"0\"/>", "<option density=…>"},
        {"", "<option density=\"0\" timestep=\"0.1\" integrator=\"RK4\"/>", ""},
        {"", "<actuator><motor joint=\"x\" ctrlrange=\"-1 1\"/></actuator>", ""},
        {"", "<actuator><motor joint=\"x\" ctrlrange=\"-1 1\"/></actuator>", "<motor ctrlrange=…>", {"--drives"}},
        {"", "<actuator><motor joint=\"x\" forcerange=\"-1 1\"/></actuator>", "<motor forcerange=…>"},
        {"", "<actuator><position joint=\"x\" kp=\"3\"/></actuator>",
         "motors that act without a control too, without --drives"},
        {"", "<actuator><position joint=\"x\" kp=\"3\"/></actuator>", "", {"--drives"}},
        {"", "<default><joint actuatorfrcrange=\"-1 1\"/></default>", "<joint actuatorfrcrange=…>"},
        {"", "<default><default class=\"unused\"><joint actuatorfrcrange=\"-1 1\"/></default></default>", ""},
        {"", "<default><general forcerange=\"-1 1\"/></default><actuator><motor joint=\"x\"/></actuator>",
         "<motor forcerange=…>"},
        {"", "<actuator><muscle joint=\"x\"/></actuator>", "<muscle>"},
        {"", "<actuator><motor site=\"s\"/></actuator>", ""},
        {"", "<actuator><motor site=\"s\"/></actuator>", "", {"--drives"}},
        {"",
         "<actuator><motor site=\"s\" refsite=\"wall\"/></actuator>",
         "<motor> between two sites",
         {"--drives"}},
        {"", "<equality><flex flex=\"a\"/></equality>", "<flex> of <equality>"},
        {"", "<equality><weld body1=\"b\" active=\"false\"/></equality>", ""},
        {"",
         "<tendon><spatial name=\"T\" stiffness=\"2\"><site site=\"s\"/><geom geom=\"g\"/><site site=\"wall\"/>"
         "</spatial></tendon>",
         "tendons that wrap around <geom>s"},
        {"",
         "<tendon><spatial name=\"T\"><site site=\"s\"/><geom geom=\"g\"/><site "
         "site=\"wall\"/></spatial></tendon>",
         ""},
        {"", "<deformable><skin/></deformable>", ""},
        {"", "<deformable><flex/></deformable>", "<flex>"},
    };
    for (const Case& c : cases) {
        CAPTURE(c.joint + c.rest);
        const std::string file = model(block(c.joint), c.rest);
        const Json changes = imported(file, c.options).told["changes_motion"];
        CHECK(changes.size() == (c.kind.empty() ? 0 : 1));
        if (!c.kind.empty()) CHECK(changes.contains(c.kind));
        const std::string scene = temporary("strict.toml", "before");
        std::vector<std::string> args{"import", file, "-o", scene, "--strict"};
        args.insert(args.end(), c.options.begin(), c.options.end());
        const auto strict = run(args);
        CHECK(strict.exit == (c.kind.empty() ? 0 : 3));
        CHECK((contents(scene) == "before") == !c.kind.empty());
        if (!c.kind.empty()) CHECK(strict.err.find(c.kind) != std::string::npos);
    }
    const auto text =
        run({"import", model(block("frictionloss=\"1\"") + "<light/>"), "-o", temporary("x.toml", "")});
    CHECK(text.err.find("forces.xml: dropped: <light>\n") != std::string::npos);
    CHECK(
        text.err.find("forces.xml: the motion is changed by what is dropped: Coulomb friction of joints, without "
                      "--friction\n") != std::string::npos);
}

// On a block of m = 2 with the gear g = 3: the length is 3 x, m of the length 2/9, and d = 2 ζ √(k m).
TEST_CASE(
    "import: the damping ratio of a servo gives its damping, also as a positive damping of a general motor") {
    for (const char* motor :
         {"<position joint=\"x\" gear=\"3\" kp=\"8\" dampratio=\"0.7\"/>",
          "<general joint=\"x\" gear=\"3\" gainprm=\"8\" biastype=\"affine\" biasprm=\"0 -8 0.7\"/>"}) {
        const Imported servo =
            imported(model(block(), fmt::format("<actuator>{}</actuator>", motor)), {"--drives"});
        const double damping = 2 * 0.7 * std::sqrt(8 * 2 / 9.);
        CHECK(std::abs(servo.acceleration("x", {"x=0.2", "x'=0.5"}) + 9 * (8 * 0.2 + damping * 0.5) / 2) <
              tolerance);
        CHECK(servo.told["changes_motion"].empty());
    }
}

TEST_CASE("import: springs of ball joints and masses of meshes are told as changes of the motion") {
    const Json ball = imported(model("<body name=\"b\"><joint name=\"q\" type=\"ball\" stiffness=\"2\"/>"
                                     "<geom size=\"0.1\" pos=\"1 0 0\"/></body>"))
                          .told["changes_motion"];
    CHECK(ball == Json({{"<joint stiffness=…> of ball and free joints", {"q"}}}));
    const Json mesh = imported(model("<body name=\"b\"><joint name=\"q\"/><geom size=\"0.1\" pos=\"1 0 0\"/><geom "
                                     "type=\"mesh\" mesh=\"m\"/></body>"))
                          .told["changes_motion"];
    CHECK(mesh == Json({{"masses of <geom>s that are no homogeneous solids", {"b"}}}));
}

// j = 0.1 + k + 0.2 k² and k = 0.3 + l³: where l = 0, k = 0.3 and j = 0.418.
TEST_CASE("import: coordinates that a coupling moves at the start are guesses that obey it") {
    const Imported chain = imported(model(
        R"(<body name="b"><joint name="j" axis="0 1 0"/><joint name="k" axis="1 0 0"/><joint name="l" axis="0 0 1"/>
           <geom size="0.1" pos="0.1 0.2 0.3"/></body>)",
        R"(<equality><joint joint1="j" joint2="k" polycoef="0.1 1 0.2 0 0"/>
           <joint joint1="k" joint2="l" polycoef="0.3 0 0 1 0"/></equality>)"));
    const std::string text = contents(chain.scene);
    CHECK(text.find("j = { guess = 0.41") != std::string::npos);
    CHECK(text.find("k = { guess = 0.3, rate_guess = 0") != std::string::npos);
    CHECK(text.find("l = { initial = 0, rate = 0") != std::string::npos);
    const Json start = json_of({"eval", chain.scene});
    CHECK(std::abs(start["coordinates"]["j"].get<double>() - 0.418) < tolerance);
    CHECK(std::abs(start["coordinates"]["k"].get<double>() - 0.3) < tolerance);
}

// The second section adds to the class, and of two values the later one counts.
TEST_CASE("import: several <default> sections of MJCF make one class, and a class inside itself is refused") {
    const Imported one = imported(model(block(), R"(<default><joint stiffness="6" damping="9"/></default>
        <default><joint damping="4"/></default>)"));
    CHECK(std::abs(one.acceleration("x", {"x=0.5", "x'=0.25"}) + (6 * 0.5 + 4 * 0.25) / 2) < tolerance);
    const auto refused = run({"import",
                              model(block(),
                                    "<default class=\"a\"><default class=\"b\"><default class=\"a\"/>"
                                    "</default></default>"),
                              "-o", temporary("none.toml", "")});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("the class 'a' stands inside itself") != std::string::npos);
}

TEST_CASE("import: joints, shapes and inertias inside a <frame> of a body count as those of the body") {
    const Imported framed = imported(model(
        R"(<body name="b"><frame pos="0.1 0 0.2" euler="0 0.4 0"><joint name="q" axis="0 1 0" pos="0 0 0.1"/>
           <frame pos="0.3 0 0"><geom type="box" size="0.1 0.2 0.3"/></frame></frame></body>)"));
    const double c = std::cos(0.4), s = std::sin(0.4);
    const Imported plain = imported(model(fmt::format(
        R"(<body name="b"><joint name="q" axis="0 1 0" pos="{} 0 {}"/>
           <geom type="box" size="0.1 0.2 0.3" pos="{} 0 {}" euler="0 0.4 0"/></body>)",
        0.1 + 0.1 * s, 0.2 + 0.1 * c, 0.1 + 0.3 * c, 0.2 - 0.3 * s)));
    const double a = plain.acceleration("q", {"q=0.3"});
    CHECK(std::abs(a) > 1);
    CHECK(std::abs(framed.acceleration("q", {"q=0.3"}) - a) < 1e-10);
}

}  // namespace commands_import_forces
