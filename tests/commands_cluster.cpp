// SPDX-License-Identifier: MIT
// Sweeps that several processes share, that were interrupted, and that are reduced to statistics: the table is
// that of a quiet sweep by one process, byte for byte.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "files.hpp"
#include "shell.hpp"
#include "simulate/exact_sum.hpp"
#include "simulate/quantile_sketch.hpp"
#include "simulate/samples.hpp"
#include "simulate/sweep_queue.hpp"
#include "tools.hpp"

namespace commands_cluster {

using namespace alembert::test;
using alembert::ExactSum;
using alembert::QuantileSketch;
using alembert::SweepPart;
using alembert::SweepQueue;
using Json = nlohmann::json;

namespace {

/// A pendulum whose motions take longer the larger n is.
std::string scene() {
    return temporary("pendulum.toml", R"toml(
gravity = [0, -9.81]
[parameters]
n = 1
[coordinates]
theta = 1
[[particle]]
name = "P"
mass = 1
position = ["sin(theta)", "-cos(theta)"]
[simulation]
duration = "n"
tolerance = 1e-12
)toml");
}

/// A block on a spring that dry friction holds again and again, while a force swings: its motion is in pieces.
std::string scene_in_pieces() {
    return temporary("pieces.toml", R"toml(
[parameters]
n = 1
mu = 0.3
[coordinates]
x = 1
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[[spring]]
along = "x"
stiffness = 1
[[force]]
at = "P"
vector = ["sin(t)", 0]
[[friction]]
name = "floor"
coefficient = "mu"
slip = "x'"
normal = 2
[simulation]
duration = "n"
tolerance = 1e-12
)toml");
}

/// The script gets the scene as $1 and the options of the sweep as words after it. It works in a new folder.
Run in_folder(const std::string& script, const std::vector<std::string>& options,
              const std::string& of = scene()) {
    std::vector<std::string> words{temporary_folder("cluster"), of};
    words.insert(words.end(), options.begin(), options.end());
    return run_shell(R"sh(cd "$1"; shift
        export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
        export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe # the same for Open MPI 5
        export ASAN_OPTIONS=detect_leaks=0 # MPI's libraries do not free everything
        quiet() { "$ALEMBERT" sweep "$@" -o quiet.csv >/dev/null; }
        # begun PROCESS: waits until it has done something, but not all, or has ended.
        begun() { until [ "$(stat -c %s t.csv.unfinished 2>/dev/null || echo 0)" -gt 60 ] || ! grep -q ') [^Z]' /proc/$1/stat 2>/dev/null; do sleep 0.005; done; }
        )sh" + script,
                     words);
}

const std::vector<std::string> some{"--vary", "theta=0.1:2:40", "--vary", "n=1:300:30"};

/// What is left of a sweep that a signal ends, and what goes on from there.
const std::string interrupted = R"sh(
        quiet "$@"
        "$ALEMBERT" sweep "$@" -o t.csv --chunk 8 >out 2>err & program=$!
        begun $program
        kill -TERM $program; wait $program; echo "exit $?"
        sed 's/.*: interrupted; [0-9]* of/interrupted at some of/' err
        printf 'cut short' >>t.csv.unfinished
        "$ALEMBERT" sweep "$@" -o t.csv --resume --tolerance 1e-9 2>&1 | grep -o 'belongs to another sweep'
        "$ALEMBERT" sweep "$@" -o t.csv --resume --threads 1 --json >again.json || cat again.json
        cmp t.csv quiet.csv && ls)sh";
const std::string as_quiet =
    "exit 143\ninterrupted at some of 1200 motions are kept in t.csv.unfinished, and the same command with "
    "--resume "
    "goes on\nbelongs to another sweep\nagain.json\nerr\nout\nquiet.csv\nt.csv\n";

bool has_mpi() {
    return has_program("mpirun") && has_part("alembert-mpi.so");
}

}  // namespace

TEST_CASE("sweep: what a signal interrupted goes on with --resume, and the table is that of a quiet sweep") {
    CHECK(in_folder(interrupted, some).out == as_quiet);
    // Each motion has several pieces with and without friction that holds.
    CHECK(in_folder(interrupted, {"--vary", "mu=0.2:0.6:40", "--vary", "n=1:60:30"}, scene_in_pieces()).out ==
          as_quiet);
    const std::string folder = temporary_folder("cluster");
    CHECK(run({"sweep", scene(), "--vary", "n=1:2:3", "--resume"}).err.find("--resume needs -o FILE") !=
          std::string::npos);
    CHECK(run({"sweep", scene(), "--vary", "n=1:2:3", "--resume", "-o", "/dev/null"}).exit == 3);
    // Where nothing is left from before, it begins.
    CHECK(run({"sweep", scene(), "--vary", "n=1:2:3", "--resume", "-o", folder + "/t.npz"}).exit == 0);
}

TEST_CASE("sweep: of 8 processes one is killed, and with --resume the table is that of a quiet sweep") {
    if (!has_mpi()) return;
    const Run result = in_folder(R"sh(
        quiet "$@"
        mpirun -n 8 sh -c '[ "$OMPI_COMM_WORLD_RANK" != 3 ] || echo $$ >third; exec "$ALEMBERT" sweep "$@" -o t.csv --chunk 4' \
            sh "$@" >out 2>err & launcher=$!
        begun $launcher
        kill -KILL $(cat third) || cat err; wait $launcher; [ $? != 0 ] && echo failed
        mpirun -n 3 "$ALEMBERT" sweep "$@" -o t.csv --resume --json >out 2>err || cat err
        grep -o '"ranks": 3' out
        cmp t.csv quiet.csv && ls t.csv*)sh",
                                 some);
    CHECK(result.out == "failed\n\"ranks\": 3\nt.csv\n");
}

TEST_CASE("sweep: of processes that share a sweep only one speaks") {
    if (!has_mpi()) return;
    const Run result = in_folder(R"sh(
        mpirun -n 2 "$ALEMBERT" sweep "$@" 2>&1 | grep -c 'nn=…')sh",
                                 {"--vary", "nn=0.1:2:4"});
    CHECK(result.out == "1\n");
}

TEST_CASE(
    "sweep: --reduce gives the statistics of the rows, whatever the parts and the order in which they come") {
    const std::string model = scene();
    const std::vector<std::string> words{"sweep", model, "--vary", "theta=0.1:2:41", "--vary", "n=1:3:5"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return run(more);
    };
    std::istringstream rows(with({}).out);
    std::string line;
    std::getline(rows, line);
    std::vector<double> ends;
    while (std::getline(rows, line)) {
        std::istringstream fields(line);
        for (int k = 0; k < 4; ++k) std::getline(fields, line, ',');
        ends.push_back(std::stod(line));
    }
    REQUIRE(ends.size() == 205);
    std::sort(ends.begin(), ends.end());
    long double sum = 0, squares = 0;
    for (const double x : ends) sum += x;
    for (const double x : ends) squares += (x - sum / 205) * (x - sum / 205);

    const std::vector<std::string> reduced{"--reduce", "min,max,mean,deviation,median,0.25,0.99"};
    const std::string text = with(reduced).out;
    const Json all = Json::parse(with({"--reduce", "min,max,mean,deviation,median,0.25,0.99", "--json"}).out);
    const Json& theta = all["reduced"][1];
    CHECK(theta["name"] == "final_theta");
    CHECK(theta["motions"] == 205);
    CHECK(theta["min"] == ends.front());
    CHECK(theta["max"] == ends.back());
    CHECK(theta["mean"].get<double>() == doctest::Approx(static_cast<double>(sum / 205)).epsilon(1e-15));
    CHECK(theta["deviation"].get<double>() ==
          doctest::Approx(static_cast<double>(std::sqrt(squares / 204))).epsilon(1e-14));
    CHECK(theta["q0.5"] == ends[102]);
    CHECK(theta["q0.25"] == ends[51]);
    CHECK(theta["q0.99"].get<double>() ==
          doctest::Approx(ends[201] + 0.96 * (ends[202] - ends[201])).epsilon(1e-15));
    CHECK(theta["quantile_error"] == 0);
    CHECK(all["reduced"].back()["name"] == "event_t");
    CHECK(all["reduced"].back()["motions"] == 0);
    for (const std::vector<std::string>& parts :
         std::vector<std::vector<std::string>>{{"--chunk", "1", "--threads", "3"}, {"--chunk", "7"}}) {
        std::vector<std::string> more = reduced;
        more.insert(more.end(), parts.begin(), parts.end());
        CHECK(with(more).out == text);
    }
    for (const char* const wrong : {"maximum", "min,", "1.5", "min,min"})
        CHECK(with({"--reduce", wrong}).exit == 3);
    CHECK(with({"--reduce", "min", "--svg", temporary("s.svg", "")}).exit == 3);
    CHECK(run({"sweep", model, "--vary", "n=1:2:2000000", "--json"}).err.find("add -o FILE, or --reduce") !=
          std::string::npos);
}

// A spring from x = 1 at rest, with ω = k: over whole periods from -1 to 1, the rate from -k to k, and both means
// are 0; until kt = π/2 the means are 2/π and -2k/π. With steps of h = 0.02 the rates err by (k h)⁴/384 of k.
TEST_CASE("sweep: --along has the extremes and means of whole motions, side by side and one by one") {
    const std::string spring = temporary("spring.toml", R"toml(
[parameters]
k = 1
[coordinates]
x = 1
y = 0
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[[force]]
at = "P"
vector = ["-k^2*x", "-y"]
[simulation]
tolerance = 1e-13
max_step = 0.02
)toml");
    const auto rows = [&](const char* duration, std::vector<std::string> more) {
        more.insert(more.begin(),
                    {"sweep", spring, "--vary", "k=1:2:2", "--along", "min,max,mean", "--duration", duration});
        return run(more);
    };
    for (const std::vector<std::string>& method : {std::vector<std::string>{}, {"--method", "radau"}}) {
        std::vector<std::string> json = method;
        json.emplace_back("--json");
        const Json whole = Json::parse(rows("6.283185307179586", json).out)["rows"],
                   quarter = Json::parse(rows("0.78539816339744831", json).out)["rows"][1]["along"];
        for (const double k : {1.0, 2.0}) {
            const Json& along = whole[k == 1 ? 0 : 1]["along"];
            CHECK(along["min_x"].get<double>() == doctest::Approx(-1).epsilon(1e-12));
            CHECK(along["max_x"] == 1.0);
            CHECK(along["min_x'"].get<double>() == doctest::Approx(-k).epsilon(1e-8));
            CHECK(along["max_x'"].get<double>() == doctest::Approx(k).epsilon(1e-8));
            CHECK(std::abs(along["mean_x"].get<double>()) < 1e-12);
            CHECK(std::abs(along["mean_x'"].get<double>()) < 1e-8);
            CHECK(along["max_y"] == 0.0);
        }
        CHECK(quarter["mean_x"].get<double>() == doctest::Approx(2 / M_PI).epsilon(1e-12));
        CHECK(quarter["mean_x'"].get<double>() == doctest::Approx(-4 / M_PI).epsilon(1e-8));
        CHECK(std::abs(quarter["min_x"].get<double>()) < 1e-12);
    }
    const auto reduced = rows("1", {"--reduce", "max"});
    CHECK(reduced.out.find("\nmax_x,2,1\n") != std::string::npos);
    CHECK(run({"sweep", spring, "--vary", "k=1:2:2", "--along", "last"}).exit == 3);
}

TEST_CASE("sweep: --reduce leaves failed motions out, and has the times of those that an event ended") {
    const std::string falling = temporary("falling.toml", R"toml(
[parameters]
h = 1
[coordinates]
x = "h"
[[particle]]
name = "P"
mass = 1
position = [0, "x"]
[[force]]
at = "P"
vector = [0, -2]
[[event]]
name = "ground"
when = "x"
stop = true
[simulation]
duration = 3
)toml");
    const auto result = run({"sweep", falling, "--vary", "h=0.5:15.5:16", "--reduce", "min,max", "--json"});
    CAPTURE(result.err);
    REQUIRE(result.exit == 0);
    const Json event = Json::parse(result.out)["reduced"].back();  // x = h - t²
    CHECK(event["motions"] == 9);
    CHECK(event["min"].get<double>() == doctest::Approx(std::sqrt(0.5)).epsilon(1e-12));
    CHECK(event["max"].get<double>() == doctest::Approx(std::sqrt(8.5)).epsilon(1e-12));
}

TEST_CASE("quantiles: they are exact for few values, within their error for many, and of no order") {
    std::mt19937_64 random(7);
    std::vector<double> values;
    for (int k = 0; k <= 200'000; ++k)
        values.push_back((k % 3 == 0 ? -1 : 1) * std::exp(std::normal_distribution<double>(0, 3)(random)));
    QuantileSketch forward, one, other;
    for (const double x : values) forward.add(x);
    for (std::size_t k = values.size(); k-- > 0;) (k % 7 < 2 ? one : other).add(values[k]);
    one.add(other);
    CHECK(forward.buckets() == one.buckets());
    CHECK(forward.dropped() == one.dropped());
    std::sort(values.begin(), values.end());
    CHECK(forward.relative_error() < 1e-3);
    CHECK(forward.relative_error() > 0);
    for (const double q : {0.0, 0.01, 0.25, 0.5, 0.9, 1.0}) {
        const double exact = values[static_cast<std::size_t>(std::lround(q * 200'000))];
        CHECK(std::abs(forward.quantile(q) - exact) <= forward.relative_error() * std::abs(exact));
    }
    QuantileSketch few;
    for (const double x : {3.0, -1.0, 0.0, 2.0}) few.add(x);
    CHECK(few.quantile(0) == -1);
    CHECK(few.quantile(0.5) == 1);
    CHECK(few.quantile(1) == 3);
    CHECK(std::isnan(QuantileSketch().quantile(0.5)));
}

TEST_CASE("sums: they are exact, and do not depend on the order") {
    ExactSum sum, backward;
    const std::vector<double> values{1e300, 1, -3e-310, -1e300, 2.5, 3e-310, -0.0, 0x1p-1074, 1e16, 1, -1e16};
    for (const double x : values) sum.add(x);
    for (std::size_t k = values.size(); k-- > 0;) backward.add(values[k]);
    CHECK(sum.normal() == backward.normal());
    backward.add(-4.5);
    CHECK(static_cast<double>(backward.value()) == 0x1p-1074);
    ExactSum negative;
    for (int k = 0; k < 10; ++k) negative.add(-0.1);
    CHECK(static_cast<double>(negative.value()) == -1.0);
    negative.add(sum);
    CHECK(static_cast<double>(negative.value()) == 3.5);
    ExactSum square;
    square.add_square(0.1);
    CHECK(static_cast<double>(square.value() -
                              static_cast<alembert::Quad>(0.1) * static_cast<alembert::Quad>(0.1)) == 0);
}

TEST_CASE("sweep: the queue gives every motion once, in shorter parts near its end") {
    SweepQueue queue(alembert::parts_left(1000, {{10, 20}, {900, 100}, {0, 5}}), {.takers = 4});
    std::vector<int> given(1000);
    std::size_t last = 0;
    while (const std::optional<SweepPart> part = queue.next()) {
        for (std::size_t k = 0; k < part->count; ++k) ++given[part->first + k];
        last = part->count;
        CHECK(!queue.is_done());
        queue.done(*part);
    }
    CHECK(queue.is_done());
    CHECK(last == 1);
    for (std::size_t k = 0; k < 1000; ++k) CHECK(given[k] == (k < 5 || (k >= 10 && k < 30) || k >= 900 ? 0 : 1));
}

TEST_CASE("sweep: a Latin hypercube of more than a million points has one in each part, without memory for them") {
    constexpr std::size_t count = 1'000'003;
    const alembert::Grid grid =
        alembert::sampled({{.name = "x", .from = 0, .to = 1}}, count, alembert::Sampling::latin, 4);
    std::vector<bool> hit(count);
    std::size_t hits = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const auto part = static_cast<std::size_t>(grid.point(k)[0] * count);
        if (!hit.at(part)) ++hits;
        hit[part] = true;
    }
    CHECK(hits >= count - 2);  // a point at the very edge of its part may be rounded into the next
}

}  // namespace commands_cluster
