// SPDX-License-Identifier: MIT
// What is too long to be read is not printed unless asked for, and not made in the form of a textbook.
#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"

namespace commands_length {

using namespace alembert::test;

namespace {

/// A plane chain of rods by the angles of its joints.
std::string chain(int n) {
    std::string coordinates = "gravity = [0, \"g\"]\nparameters = { m = 1, l = 1, g = 9.81 }\n[coordinates]\n",
                bodies;
    for (int k = 1; k <= n; ++k) {
        const std::string now = std::to_string(k), last = std::to_string(k - 1);
        const std::string from = k > 1 ? "from = \"J" + last + "\"\n" : "", axes = "axes = \"F" + now + "\"\n";
        coordinates += "q" + now + " = 0.1\n";
        bodies += "[[frame]]\nname = \"F" + now + "\"\nrotate = [[\"z\", \"q" + now + "\"]]\n" +
                  (k > 1 ? "parent = \"F" + last + "\"\n" : "") + "[[body]]\nname = \"rod" + now +
                  "\"\nmass = \"m\"\ninertia = \"m*l^2/12\"\nframe = \"F" + now + "\"\nposition = [\"l/2\", 0]\n" +
                  axes + from;
        if (k < n) bodies += "[[point]]\nname = \"J" + now + "\"\noffset = [\"l\", 0]\n" + axes + from;
    }
    return temporary("chain_" + std::to_string(n) + ".toml", coordinates + bodies);
}

std::ptrdiff_t lines_of(const std::string& page) {
    return std::count(page.begin(), page.end(), '\n');
}

}  // namespace

TEST_CASE("derive: what exceeds two screens is told with its size, and is all there when it is asked for") {
    const std::string scene = chain(12);
    const Json json = Json::parse(run({"derive", scene, "--json"}).out);
    const std::size_t symbols = json["definitions"].size();
    REQUIRE(symbols > 120);
    CHECK(json["equations"].size() == 12);
    const std::string page = run({"derive", scene}).out, full = run({"derive", scene, "--full"}).out;
    CHECK(page.size() < 20000);
    CHECK(lines_of(page) < 120);
    CHECK(page.find("(" + std::to_string(symbols) + " lines with ") != std::string::npos);
    CHECK(page.find("'derive --full'") != std::string::npos);
    CHECK(page.find("z1") == std::string::npos);  // nor are the equations printed that need the symbols
    CHECK(full.find("\n  z1 = ") != std::string::npos);
    CHECK(full.find("left out") == std::string::npos);
    CHECK(lines_of(full) > static_cast<std::ptrdiff_t>(symbols));
    const std::string short_scene = chain(2);
    CHECK(run({"derive", short_scene}).out == run({"derive", short_scene, "--full"}).out);
}

TEST_CASE("derive: equations whose few terms are pages long are not composed, and their length is told") {
    const Run derived = run({"derive", source_path("scenes/friction/falling_tripod.toml")});
    CHECK(derived.out.size() < 20000);
    for (const char* const foot : {"sole1", "sole2", "sole3"}) {
        CAPTURE(foot);
        const std::size_t at = derived.out.find(std::string("While '") + foot + "' sticks");
        REQUIRE(at != std::string::npos);
        CHECK(derived.out.find(" operations even with intermediate symbols", at) != std::string::npos);
    }
}

TEST_CASE("derive: equations of a large tree are counted as the program that emit would write") {
    const std::string scene = chain(60);
    const std::string page = run({"derive", scene}).out;
    CHECK(page.size() < 2000);
    const Json emitted = Json::parse(run({"emit", scene, "--json", "-o", temporary_folder("long_chain")}).out);
    const std::string operations = std::to_string(emitted["operations"].get<int>());
    CHECK(page.find("(60 lines, left out because of the length; as a program they take " + operations +
                    " operations") != std::string::npos);
}

TEST_CASE("long lists keep their first entries and the last one, and say how much is missing") {
    const std::string scene = chain(60);
    for (const std::string option : {"", "--kinematics", "--matrices"}) {
        CAPTURE(option);
        std::vector<std::string> words{"eval", scene};
        if (!option.empty()) words.push_back(option);
        const std::string page = run(words).out;
        words.emplace_back("--full");
        const std::string full = run(words).out;
        CHECK(lines_of(page) <= 105);
        CHECK(page.size() < 20000);
        if (option.empty()) CHECK(page == full);
        const std::string_view end = "--full prints everything";
        CHECK((page.find(end) != std::string::npos) == !option.empty());
        // Each line that is shown is one of the whole or its beginning, in the same order; others tell how many
        // are missing.
        std::istringstream shown(page), whole(full);
        std::size_t accounted = 0, lines = 0;
        for (std::string line; std::getline(whole, line);) lines += !line.empty();
        whole = std::istringstream(full);
        for (std::string line, other; std::getline(shown, line);) {
            if (line.empty() || line.find(end) != std::string::npos) continue;
            const std::size_t at = line.find("... (");
            if (line.ends_with(" more)") && !line.ends_with(" letters more)")) {
                accounted += std::stoul(line.substr(at + 5));
                continue;
            }
            ++accounted;
            const std::string begin = at == std::string::npos ? line : line.substr(0, at - 1);
            const auto is_it = [&] { return at == std::string::npos ? other == line : other.starts_with(begin); };
            while (std::getline(whole, other) && !is_it()) {
            }
            CHECK(is_it());
        }
        CHECK(accounted == lines);
    }
}

}  // namespace commands_length
