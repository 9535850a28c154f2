// SPDX-License-Identifier: MIT
// `sweep` of motions with contacts, dry friction, impulses at events and signs: each is that of `simulate`, bit by
// bit, whatever runs beside it; and closed forms.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "contacts.hpp"
#include "edits.hpp"
#include "files.hpp"
#include "json.hpp"
#include "shell.hpp"

namespace commands_sweep_phased {

using namespace alembert::test;

namespace {

/// The scene with some text replaced.
std::string changed(const std::string& file, const std::string& from, const std::string& to) {
    return temporary("changed.toml", edited(contents(source_path(file)), {{from, to}}));
}

/// Are a motion of a sweep and one of `simulate` the same, to the last bit?
void check_same(const Json& row, const Json& motion) {
    CHECK(row["final"] == motion["final"]);
    for (const char* count : {"steps", "rejected", "evaluations"}) CHECK(row[count] == motion[count]);
    if (motion.contains("work_balance")) CHECK(row["work_balance"] == motion["work_balance"]);
}

}  // namespace

TEST_CASE("sweep: motions with friction, contacts and impulses are those of simulate, bit by bit") {
    for (const char* scene :
         {"friction/stick_slip", "friction/belt_blocks", "friction/clutch", "friction/billiard_ball_struck",
          "friction/puck_on_slope", "friction/rocking_block", "friction/superball", "friction/trammel",
          "textbook/bouncing_ball", "textbook/slack_pendulum", "gallery/clock"}) {
        CAPTURE(scene);
        const std::string file = source_path(std::string("scenes/") + scene + ".toml");
        const Json table = swept({file, "--vary", "t=0:0:1"}), motion = simulated(file, {"--no-estimate"});
        check_same(table["rows"][0], motion);
        CHECK(table["method"] == motion["method"]);
        CHECK(table["side_by_side"] == 1);
    }
    const Json table = swept({source_path("scenes/friction/stick_slip.toml"), "--vary", "mu=0.125:0.375:3"});
    for (const auto& [row, mu] : {std::pair(0, "0.125"), {1, "0.25"}, {2, "0.375"}})
        check_same(table["rows"][row], simulated(changed("scenes/friction/stick_slip.toml", "mu   = { value = 0.2",
                                                         std::string("mu   = { value = ") + mu)));
    for (const char* method : {"dopri5", "taylor", "radau", "bdf"}) {
        CAPTURE(method);
        const std::string file = source_path("scenes/friction/coulomb_oscillator.toml");
        check_same(swept({file, "--vary", "t=0:0:1", "--method", method})["rows"][0],
                   simulated(file, {"--no-estimate", "--method", method}));
    }
}

TEST_CASE("sweep: motions in pieces depend neither on threads nor on processes' parts") {
    const std::string scene = source_path("scenes/friction/braking_box.toml"), plain = temporary("plain.csv", ""),
                      parts = temporary("parts.csv", "");
    const std::vector<std::string> words{"sweep", scene, "--vary", "mu=0.1:0.9:12", "--vary", "x'=1:4:3"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return run(more);
    };
    const auto one = with({"--threads", "1"}), many = with({"--threads", "5"});
    CHECK(one.exit == many.exit);
    CHECK(one.out == many.out);
    CHECK(one.out.size() > 2000);
    CHECK(with({"-o", plain}).exit == one.exit);
    CHECK(with({"-o", parts, "--resume", "--chunk", "5"}).exit == one.exit);
    CHECK(alembert::test::contents(plain) == one.out);
    CHECK(alembert::test::contents(parts) == one.out);
    const auto reduced = with({"--reduce", "min,max,mean"});
    CHECK(reduced.exit == one.exit);
    CHECK(reduced.out.find("final_x") != std::string::npos);
}

// A bouncing ball that falls from h reaches e² h, e⁴ h …: the greatest height of a motion that starts in an
// impact.
TEST_CASE("sweep: extremes along motions with impacts are those of the closed form") {
    const std::string scene = ball(0.5, 1.2);
    const Json table = swept({scene, "--vary", "y=0.5:1:3", "--along", "min,max"});
    for (const Json& row : table["rows"]) {
        const double h = row["varied"]["y"], fall = std::sqrt(2 * h / g);
        CHECK(row["along"]["max_y"].get<double>() == doctest::Approx(h).epsilon(1e-14));
        CHECK(std::abs(row["along"]["min_y"].get<double>()) < 1e-12);
        CHECK(row["along"]["min_y'"].get<double>() == doctest::Approx(-g * fall).epsilon(1e-12));
        CHECK(row["along"]["max_y'"].get<double>() == doctest::Approx(g * fall / 2).epsilon(1e-12));
        CHECK(row["status"] == "done");
    }
}

TEST_CASE("sweep: a block with a sign for its friction stops at the closed form's time and place, in few steps") {
    const std::string scene = temporary("sign.toml", R"toml(
[parameters]
m = 2
mu = 0.25
g = 10
v0 = 3
[coordinates]
x = { initial = 0, rate = "v0" }
[[particle]]
name = "P"
mass = "m"
position = ["x", 0]
[[force]]
at = "P"
vector = ["-mu*m*g*sign(x')", 0]
[simulation]
duration = 5
tolerance = 1e-10
)toml");
    const Json table = swept({scene, "--vary", "v0=-4:4:9", "--vary", "mu=0.2:0.5:4"});
    for (const Json& row : table["rows"]) {
        const double v = row["varied"]["v0"], a = row["varied"]["mu"].get<double>() * 10;
        CHECK(row["final"]["coordinates"]["x"].get<double>() ==
              doctest::Approx(v * std::abs(v) / (2 * a)).epsilon(1e-12));
        CHECK(std::abs(row["final"]["rates"]["x"].get<double>()) < 1e-14);
        CHECK(row["evaluations"].get<long>() < 2000);
        CHECK(row["status"] == "done");
    }
}

TEST_CASE("sweep: a motion in pieces that cannot begin or go on says why in its row, and the others run") {
    const auto started = run({"sweep", ball(0.5, 1), "--vary", "y=-1:1:3"});
    CHECK(started.exit == 4);
    CHECK(started.out.find("the gap of 'floor' is -1 at the start") != std::string::npos);
    CHECK(started.out.find("\n1,1,") != std::string::npos);
    const std::string rod =
        changed("scenes/friction/painleve_rod.toml", "initial = 1.5, rate = -1", "initial = 1.1");
    const Json rods = swept({rod, "--vary", "mu=1.2:2:2", "--duration", "0.05"}, 4);
    CHECK(rods["rows"][0]["status"] == "done");
    CHECK(rods["rows"][1]["status"].get<std::string>().find("Painlevé") != std::string::npos);
    CHECK(rods["failed"] == 1);
}

// The ball lands and stays in the last motions only, whose equations with the closed contact are compiled then.
TEST_CASE("sweep: where a closed mode cannot be compiled, the message is told, and --resume goes on from there") {
    const Run result = run_shell(R"sh(cd "$1"
        export XDG_CACHE_HOME=$PWD/cache CXX=$PWD/compiler
        printf '#!/bin/sh\n[ -e broken ] && { echo "the disk is full" >&2; exit 1; }\nexec c++ "$@"\n' >compiler
        chmod +x compiler
        sweep() { "$ALEMBERT" sweep --code compiled --chunk 4 --threads 1 -o "$@"; }
        sweep free.csv "$2" --vary y=8:16:16 >/dev/null
        touch broken
        sweep t.csv "$2" --vary y=8:0.5:16 >out 2>err; echo "exit $?"
        grep -c "the disk is full" err
        rm broken
        sweep t.csv "$2" --vary y=8:0.5:16 --resume >out; grep "from before" out
        sweep quiet.csv "$2" --vary y=8:0.5:16 >out
        cmp t.csv quiet.csv && ls *.csv*)sh",
                                 {temporary_folder("compiler"), ball(0, 0.5)});
    CHECK(result.out == "exit 5\n1\n12 motions were there from before\nfree.csv\nquiet.csv\nt.csv\n");
}

}  // namespace commands_sweep_phased
