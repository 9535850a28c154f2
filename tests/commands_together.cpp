// SPDX-License-Identifier: MIT
// Options that would have no effect, beside another one or by themselves, are refused with what goes with what.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <regex>

#include "files.hpp"
#include "shell.hpp"

namespace commands_together {

using namespace alembert::test;

namespace {

std::string pendulum() {
    return temporary("pendulum.toml", R"toml(gravity = [0, -9.81]
[parameters]
l = 1
c = 0.1
[coordinates]
theta = 0.5
[[particle]]
name = "bob"
mass = 1
position = ["l*sin(theta)", "-l*cos(theta)"]
[forces]
theta = "-c*theta'"
[simulation]
duration = 1
)toml");
}

void refused(std::vector<std::string> words, const std::string& why, int code = 3) {
    words.insert(words.begin() + 1, pendulum());
    const auto result = run(words);
    CAPTURE(fmt::format("{}", why));
    CHECK(result.exit == code);
    CHECK_MESSAGE(result.err.find(why) != std::string::npos, result.err);
}

using Option = std::vector<std::string>;

/// What a run prints and writes, without times; its exit code first.
std::string outcome(const std::string& verb, const std::string& scene, const std::vector<Option>& options,
                    std::string& error) {
    const std::string folder = temporary_folder("together");
    std::vector<std::string> words{verb, scene};
    for (const Option& option : options)
        for (const std::string& word : option)
            words.push_back(word.starts_with("x.") ? folder + "/" + word : word);
    const auto result = run(words);
    error = result.err;
    std::string all = std::to_string(result.exit) + std::regex_replace(result.out, std::regex("seconds:?.*"), "");
    all = std::regex_replace(all, std::regex("\"seconds\": \\{[^}]*\\}"), "");
    std::map<std::string, std::string> files;
    for (const auto& file : std::filesystem::directory_iterator(folder))
        files[file.path().filename().string()] = contents(file.path().string());
    for (const auto& [name, text] : files) all += name + text;
    std::filesystem::remove_all(folder);
    return all;
}

/// Pairs of options: the second, which does something by itself, does something beside the first, or is refused.
void check_pairs(const std::string& verb, const std::vector<Option>& options,
                 const std::vector<Option>& always = {}) {
    const std::string scene = pendulum();
    std::string error;
    const auto with = [&](std::vector<Option> more) {
        more.insert(more.begin(), always.begin(), always.end());
        return outcome(verb, scene, more, error);
    };
    const std::string plain = with({});
    REQUIRE_MESSAGE(plain[0] == '0', error);
    std::map<Option, std::string> alone;
    for (const Option& one : options) alone[one] = with({one});
    std::mt19937 random(7);
    for (int k = 0; k < 60; ++k) {
        const Option &first = options[random() % options.size()], &second = options[random() % options.size()];
        if (first[0] == second[0] || alone[first][0] != '0') continue;
        if (alone[second] == plain || alone[second][0] != '0') continue;
        CAPTURE(first[0]);
        CAPTURE(second[0]);
        const std::string both = with({first, second});
        if (both[0] != '0')
            CHECK_MESSAGE(
                (error.find(second[0]) != std::string::npos || error.find("fixed step") != std::string::npos),
                error);
        else
            CHECK(both != alone[first]);
    }
}

}  // namespace

TEST_CASE("together: options that exclude each other, or need another one, are refused with it") {
    refused({"simulate", "--step", "0.01", "--tolerance", "1e-6"}, "--tolerance does not go with --step");
    refused({"simulate", "--max-step", "0.01", "--step", "0.1"}, "rk4 has a fixed step");
    refused({"simulate", "--method", "rk4", "--tolerance", "1e-6"}, "rk4 has a fixed step");
    refused({"simulate", "--reactions"}, "--reactions goes with --output");
    refused({"simulate", "--digits", "--json"}, "does not go with");
    refused({"sweep", "--vary", "l=1:2:2", "--step", "0.01", "--tolerance", "1e-6"}, "does not go with");
    refused({"sweep", "--vary", "l=1:2:2", "--resume"}, "--resume needs -o FILE");
    refused({"stability", "--modes", "--vary", "c=0:1"}, "--modes does not go with --vary");
    refused({"stability", "--matrices", "--along", "--affine"}, "does not go with");
    refused({"report", "--no-motion", "--duration", "2"}, "does not go with");
    refused({"bench", "--method", "rk4", "--max-step", "0.01"}, "rk4 has a fixed step");
    refused({"bench", "--method", "verlet"}, "method 'verlet' needs");
    refused({"bench", "--method", "dop853", "--budget", "5"}, "", 4);
}

TEST_CASE("together: every verb of a scene takes values in place of the scene's") {
    const std::string scene = temporary("on_two_sides.toml", R"toml(
[parameters]
m = 2
k = 5
a = 1
[coordinates]
x = 1
[energy]
kinetic = "m*x'^2/2"
potential = "k*(sqrt(x^2) - a)^2/2"
[[claim]]
equation = "m*x'' + k*(x - a) = 0"
)toml");
    const auto printed = [&](std::vector<std::string> command) {
        const auto result = run(command);
        CHECK(result.exit == 0);
        return result.out;
    };
    CHECK(printed({"derive", scene}).find("k*(x-a)") != std::string::npos);
    CHECK(printed({"derive", scene, "--at", "x=-1"}).find("k*(a+x)") != std::string::npos);
    CHECK(run({"check", scene}).exit == 0);
    CHECK(run({"check", scene, "--at", "x=-1"}).exit == 1);
    CHECK(run({"audit", scene, "--at", "x=-1"}).exit == 0);
    const std::string folder = temporary_folder("emitted_at");
    CHECK(run({"emit", scene, "-o", folder, "--at", "x=-3", "m=7"}).exit == 0);
    const std::string header = contents(folder + "/on_two_sides.hpp");
    CHECK(header.find("double m = 7;") != std::string::npos);
    CHECK(header.find("    -3,  // x") != std::string::npos);
    CHECK(header.find("--at x=-3 --at m=7") != std::string::npos);
    CHECK(run({"emit", scene, "--fmu", folder + ".fmu", "--at", "x=-3"}).exit == 0);
    for (const char* const verb : {"agree", "impact", "identify", "audit", "derive", "check"})
        refused({verb, "--at", "y=1"}, "'y'");
}

TEST_CASE("together: an empty value is refused, and so is one of an option that takes none") {
    refused({"simulate", "-o", ""}, "-o is given an empty value");
    refused({"simulate", "--svg="}, "--svg is given an empty value");
    refused({"simulate", "--duration", ""}, "--duration is given an empty value");
    refused({"derive", "--steps=false"}, "--steps takes no value");
    refused({"simulate", "--no-estimate=xyz"}, "--no-estimate takes no value");
}

TEST_CASE("together: report ends at a warning with --strict, as other verbs do") {
    const std::string unused =
        temporary("unused.toml",
                  "[parameters]\nm = 1\nk = 2\n[coordinates]\nx = 1\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
                  "position = [\"x\", 0]\n");
    const std::string page = temporary("page.html", "");
    CHECK(run({"report", unused, "--no-motion", "-o", page}).exit == 0);
    CHECK(run({"report", unused, "--no-motion", "-o", page, "--strict"}).exit == 3);
}

TEST_CASE("together: an option that does something by itself does it beside others, or is refused by its name") {
    check_pairs("simulate", {{"--duration", "0.5"},
                             {"--tolerance", "1e-6"},
                             {"--method", "dop853"},
                             {"--step", "0.01"},
                             {"--max-step", "0.01"},
                             {"-o", "x.csv"},
                             {"--svg", "x.svg"},
                             {"--digits"},
                             {"--json"},
                             {"--poincare", "theta = 0"},
                             {"--no-estimate"},
                             {"--by", "kane"},
                             {"--at", "l=2"}});
    check_pairs("sweep",
                {{"--duration", "0.5"},
                 {"--tolerance", "1e-6"},
                 {"--method", "radau"},
                 {"--step", "0.01"},
                 {"--max-step", "0.01"},
                 {"--along", "max"},
                 {"--reduce", "mean"},
                 {"-o", "x.csv"},
                 {"--json"},
                 {"--at", "c=0.3"}},
                {{"--vary", "l=1:2:3"}});
    check_pairs("stability", {{"--modes"}, {"--vary", "c=0:1"}, {"--exponents", "1"}}, {{"--at", "theta=0"}});
}

}  // namespace commands_together
