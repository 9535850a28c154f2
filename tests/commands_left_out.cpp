// SPDX-License-Identifier: MIT
// What was left out because it follows from the rest does so at the scene's values. No verb that takes other
// values goes on where it no longer holds, and none refuses values at which it does.
#include <doctest/doctest.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "earlier_names.hpp"
#include "program.hpp"

namespace commands_left_out {

using alembert::test::run;
using alembert::test::temporary;
using alembert::test::temporary_folder;

namespace {

using Words = std::vector<std::string>;

/// A pendulum, given by its circle and by another one, which is the same for d = 0. With d > 0 it is larger and
/// touches the first in the lowest pose, where its row is parallel, too: the point could not move.
const std::string circles = R"toml(
gravity = [0, "-k*g"]
[parameters]
g = 9.81
m = 1
d = 0
k = 1
[coordinates]
x = { guess = 0, rate_guess = 0 }
y = { guess = -1, rate_guess = 0 }
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
[[constraint]]
name = "first"
holonomic = "x^2 + y^2 = 1"
[[constraint]]
name = "second"
holonomic = "x^2 + (y - d)^2 = (1 + d)^2"
[[claim]]
equation = "x*x' + y*y' = 0"
[simulation]
duration = 1
)toml";

/// Three points on a line, by |AC| = |AB| + |BC|.
const std::string rod = R"toml(
gravity = [0, "-k*g"]
[parameters]
g = 9.81
d = 0
b = 2
k = 1
[coordinates]
xa = { guess = 0, rate_guess = 0 }
ya = { guess = 0, rate_guess = 0 }
xb = { guess = 0, rate_guess = 0 }
yb = { guess = -1, rate_guess = 0 }
xc = { guess = 0, rate_guess = 0 }
yc = { guess = -3, rate_guess = 0 }
[[particle]]
name = "A"
mass = 1
position = ["xa", "ya"]
[[particle]]
name = "B"
mass = 1
position = ["xb", "yb"]
[[particle]]
name = "C"
mass = 1
position = ["xc", "yc"]
[[constraint]]
name = "ab"
holonomic = "(xa - xb)^2 + (ya - yb)^2 = (1 + d)^2"
[[constraint]]
name = "bc"
holonomic = "(xb - xc)^2 + (yb - yc)^2 = b^2"
[[constraint]]
name = "ac"
holonomic = "(xa - xc)^2 + (ya - yc)^2 = 9"
[[claim]]
equation = "xa' = 0"
[[constraint]]
name = "x"
holonomic = "xa = 0"
[[constraint]]
name = "y"
holonomic = "ya = 0"
[simulation]
duration = 1
)toml";

/// A verb with options, between which the values come. `keeps` is set if it works with all constraints, for which
/// a pose is right that obeys them, or derives the equations for the values. (`report` writes a page in any case,
/// and `identify` knows no states of such mechanisms.)
struct Asked {
    std::string verb;
    Words options = {};
    bool keeps = false;
    bool needs_state = true;  ///< whether there must be a pose that obeys the constraints
};

const std::vector<Asked>& with_at() {
    static const std::vector<Asked> verbs = {
        {"eval"},
        {"linearize"},
        {"equilibrium"},
        {"derive", {}, true, false},
        {"check", {}, true, false},
        {"agree", {}, true, false},
        {"audit", {}, true},
        {"emit", {"-o", temporary_folder("left_out")}, true, false},
        {"fmu", {"--fmu", temporary_folder("left_out_unit") + ".fmu"}, true},
        {"impact", {}, true},
        {"stability"},
        {"stability", {"--exponents", "1", "--duration", "1"}},
        {"stability", {"--locus", "k=1:2"}},
        {"equilibrium", {"--follow", "k=1:2"}},
        {"inverse"},
        {"kinematics", {}, true},
        {"inertia", {}, true},
        {"simulate", {"--no-estimate"}, true},
        {"sweep", {"--vary", "k=1:2:2"}, true},
        {"bench", {"--method", "dop853", "--reference-seconds", "0.2"}, true}};
    return verbs;
}
/// Those that vary d themselves.
const std::vector<Asked> of_ranges = {{"equilibrium", {"--follow", "d=0:0.4"}},
                                      {"stability", {"--locus", "d=0:0.4"}},
                                      {"stability", {"--over", "d=0:0.4", "--over", "g=9:10"}},
                                      {"sweep", {"--vary", "d=0.1:0.4:2"}}};

Words line(const Asked& asked, const std::string& file, const Words& values) {
    Words words{asked.verb, file};
    words.insert(words.end(), asked.options.begin(), asked.options.end());
    for (const std::string& value : values) words.insert(words.end(), {"--at", value});
    return words;
}

}  // namespace

TEST_CASE("left out: the list has every verb that takes --at") {
    std::set<std::string> listed, found;
    for (const Asked& asked : with_at()) listed.insert(asked.verb);
    listed.insert({"report", "identify"});
    std::string verbs = run({"--help"}).out;
    for (const alembert::test::EarlierVerb& earlier : alembert::test::earlier_verbs)
        verbs += std::string("  ") + earlier.name + "\n";
    std::istringstream help(verbs);
    for (std::string text; std::getline(help, text);) {
        std::istringstream words(text);
        std::string verb;
        if (text.rfind("  ", 0) == 0 && words >> verb && verb[0] != '-' &&
            run({verb, "--help"}).out.find("--at ") != std::string::npos)
            found.insert(verb);
    }
    CHECK(found == listed);
}

TEST_CASE("left out: no verb goes on with values at which what was left out does not hold") {
    const std::string of_circles = temporary("circles.toml", circles), of_rod = temporary("rod.toml", rod);
    for (const Asked& asked : with_at()) {
        const auto rigid = run(line(asked, of_circles, {"d=0.2"})), torn = run(line(asked, of_rod, {"d=0.2"}));
        CAPTURE(asked.verb);
        CAPTURE(asked.options);
        INFO(rigid.out << rigid.err << torn.out << torn.err);
        CHECK((rigid.exit == 0) == asked.keeps);
        CHECK((rigid.err.find("constraint 'second' follows from the others at the values of the scene") !=
               std::string::npos) != asked.keeps);
        CHECK((torn.exit != 0) == asked.needs_state);
    }
    for (const Asked& asked : of_ranges) {
        const auto rigid = run(line(asked, of_circles, {}));
        CAPTURE(asked.verb);
        CAPTURE(asked.options);
        INFO(rigid.out << rigid.err);
        CHECK(rigid.exit != 0);
        CHECK((rigid.out + rigid.err).find("'second' follows from the others") != std::string::npos);
    }
}

TEST_CASE("left out: every verb takes values at which what was left out holds") {
    const std::string of_circles = temporary("circles.toml", circles), of_rod = temporary("rod.toml", rod);
    for (const Asked& asked : with_at()) {
        const auto other = run(line(asked, of_circles, {"g=9.5"})),
                   moved = run(line(asked, of_rod, {"d=0.2", "b=1.8"}));
        CAPTURE(asked.verb);
        CAPTURE(asked.options);
        INFO(other.out << other.err << moved.out << moved.err);
        CHECK(other.exit == 0);
        CHECK(moved.exit == 0);
    }
    const auto swept = run({"sweep", of_circles, "--vary", "m=1:2:2"});
    INFO(swept.out << swept.err);
    CHECK(swept.exit == 0);
}

}  // namespace commands_left_out
