// SPDX-License-Identifier: MIT
// Features for people at a terminal: colours, lines that fit, help, completion, the manual, and messages about
// mistakes on the command line.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "earlier_names.hpp"
#include "present/report/wrap.hpp"
#include "scenes.hpp"
#include "shell.hpp"
#include "tools.hpp"

namespace commands_terminal {

using namespace alembert;
using alembert::test::earlier_verbs;
using alembert::test::EarlierVerb;
using alembert::test::has_program;
using alembert::test::on_terminal;
using alembert::test::run;
using alembert::test::run_shell;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

const std::string pendulum =
    "gravity = [0, \"-g\"]\n[parameters]\nm = 1\nl = 2\ng = 9.81\n[coordinates]\ntheta = 1\n[[particle]]\n"
    "name = \"bob\"\nmass = \"m\"\nposition = [\"l*sin(theta)\", \"-l*cos(theta)\"]\n";
const std::string two_claims =
    "[[claim]]\nequation = \"l*theta'' + g*sin(theta) = 0\"\n[[claim]]\nequation = \"theta'' = 0\"\n";

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Characters, all of which are one column wide here.
std::size_t columns(const std::string& line) {
    return static_cast<std::size_t>(std::count_if(
        line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

TEST_CASE("terminal: verdicts and carets are in colour there, and nowhere else, and NO_COLOR is obeyed") {
    const std::string scene = temporary("claims.toml", pendulum + two_claims);
    const std::string command = "TERM=xterm \"$ALEMBERT\" check \"$1\"";
    const std::string shown = on_terminal(command, {scene}, 100);
    CHECK(shown.find("\033[32mproved") != std::string::npos);
    CHECK(shown.find("\033[1;31mrefuted") != std::string::npos);
    CHECK(on_terminal("NO_COLOR=1 " + command, {scene}, 100).find('\033') == std::string::npos);
    CHECK(on_terminal("TERM=dumb \"$ALEMBERT\" check \"$1\"", {scene}, 100).find('\033') == std::string::npos);
    CHECK(run({"check", scene}).out.find('\033') == std::string::npos);
    const std::string broken = temporary("broken.toml", "[coordinates]\nx = \"1 +* 2\"\n");
    const std::string error = on_terminal("TERM=xterm \"$ALEMBERT\" derive \"$1\"", {broken}, 100);
    CHECK(std::regex_search(error, std::regex("\033\\[1;31m +\\^\033\\[0m")));
    CHECK(run({"derive", broken}).err.find('\033') == std::string::npos);
    // Escape sequences from outside stay text.
    const std::string hostile = temporary("hostile.toml", "title = \"\\u001b[31mred\"\n" + pendulum);
    CHECK(on_terminal("TERM=xterm \"$ALEMBERT\" derive \"$1\"", {hostile}, 100).find("\033[31m") ==
          std::string::npos);
}

TEST_CASE("terminal: equations are wrapped at operators to its width, and read the same as in a pipe") {
    const std::string scene = source_path("scenes/textbook/double_pendulum.toml");
    const std::string piped = run({"derive", scene}).out;
    std::string shown = on_terminal("\"$ALEMBERT\" derive \"$1\"", {scene}, 50);
    std::erase(shown, '\r');
    const std::vector<std::string> lines = lines_of(shown);
    CHECK(lines.size() > lines_of(piped).size());
    for (const std::string& line : lines) CHECK(columns(line) <= 50);
    const auto words = [](const std::string& text) {
        std::istringstream stream(text);
        std::string all;
        for (std::string word; stream >> word;) all += word + " ";
        return all;
    };
    CHECK(words(shown) == words(piped));
}

TEST_CASE("wrap: a line is broken before operators, outside parentheses where that is possible") {
    CHECK(wrapped("  a*b + c*d = e*f\n", 60) == "  a*b + c*d = e*f\n");
    CHECK(wrapped("  aaaa*(b + c) + dddd*(e + f)\n", 24) == "  aaaa*(b + c)\n      + dddd*(e + f)\n");
    CHECK(wrapped("no_space_in_this_very_long_word_at_all", 20) == "no_space_in_this_very_long_word_at_all");
    const std::string row = "name            12345678             12345678";
    CHECK(wrapped(row, 30) == row);
    CHECK(wrapped("θ″ + ω²·sin θ + ω²·θ³ = 0", 20) == "θ″ + ω²·sin θ\n    + ω²·θ³ = 0");
}

TEST_CASE("command line: mistakes in verbs, options and formalisms are reported with the nearest name") {
    const std::string scene = temporary("pendulum.toml", pendulum);
    const auto says = [](const std::vector<std::string>& words, const std::string& what) {
        const auto result = run(words);
        CAPTURE(result.err);
        CHECK(result.exit == 3);
        CHECK(result.err.find(what) != std::string::npos);
    };
    says({"foo"}, "unknown verb 'foo'");
    says({"simlate", scene}, "did you mean simulate?");
    says({"derive", scene, "--stesp"}, "did you mean --steps?");
    for (const char* const verb : {"audit", "agree", "impact"})
        says({verb, scene, "--by", "kane"}, " has no option '--by'");
    says({"derive", scene, "--by", "lagrang"}, "did you mean 'lagrange'?");
    says({"derive", scene, "--by", "nonsense"}, "expected one of: lagrange, ");
    says({"completion", "tcsh"}, "expected bash, zsh, fish");
    says({"man", "simulat"}, "there is no verb 'simulat'");
    says({"derive"}, "derive needs SCENE");
}

TEST_CASE("completion: bash completes verbs, options, methods and scenes") {
    const std::string folder = alembert::test::temporary_folder("completion");
    const auto completes = [&](const std::string& words, const std::string& result) {
        const auto got = run_shell(
            "cd \"$1\" && touch some.toml other.txt && \"$ALEMBERT\" --completion bash >c.bash && bash -n c.bash "
            "&& "
            "bash -c '. "
            "./c.bash; COMP_WORDS=(" +
                words +
                "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); compopt() { :; }; _alembert; "
                "printf \"%s \" \"${COMPREPLY[@]}\"'",
            {folder});
        INFO(got.err);
        CHECK(got.exit == 0);
        CHECK(got.out == result);
    };
    completes("alembert simu", "simulate ");
    completes("alembert so", "some.toml ");
    completes("alembert agr", " ");
    completes("alembert --com", "--completion ");
    completes("alembert --completion z", "zsh ");
    completes("alembert --man eq", "equilibrium ");
    completes("alembert check --form", "--formalisms ");
    completes("alembert eval some.toml --jac", "--jacobian ");
    completes("alembert emit some.toml --fmu oth", "other.txt ");
    completes("alembert sweep some.toml --ov", " ");
    completes("alembert simulate some.toml --method ver", "verner76 verner98 verlet ");
    completes("alembert derive --by mag", "maggi ");
    completes("alembert derive --ste", "--steps ");
    completes("alembert derive so", "some.toml ");
    completes("alembert derive \"\"", "some.toml ");
    completes("alembert --man be", "bench ");
    for (const char* const shell : {"zsh", "fish"}) {
        if (!has_program(shell)) continue;
        const auto checked =
            run_shell("\"$ALEMBERT\" --completion $1 >\"$2/c\" && $1 -n \"$2/c\"", {shell, folder});
        INFO(shell << checked.err);
        CHECK(checked.exit == 0);
    }
    if (!has_program("fish")) return;
    const auto fish = run_shell(
        "HOME=$1 fish -c "
        "'\"$ALEMBERT\" --completion fish | source; complete -C \"alembert simulate --method verl\"'",
        {folder});
    CHECK(fish.out.find("verlet") != std::string::npos);
}

TEST_CASE("man: every page passes mandoc, and names every option of its verb") {
    std::vector<std::string> verbs{""};
    for (const std::string& line : lines_of(run({"--help"}).out))
        if (line.starts_with("  ") && line[2] != ' ') verbs.push_back(line.substr(2, line.find(' ', 2) - 2));
    REQUIRE(verbs.size() == 1 + 13);
    for (const EarlierVerb& verb : earlier_verbs) verbs.emplace_back(verb.name);
    const bool can_check = has_program("mandoc");
    for (const std::string& verb : verbs) {
        CAPTURE(verb);
        const auto page = verb.empty() ? run({"--man"}) : run({"--man", verb});
        REQUIRE(page.exit == 0);
        if (can_check) {
            const auto checked = run_shell("mandoc -T lint -W error \"$1\"", {temporary("page.1", page.out)});
            CAPTURE(checked.out);
            CHECK(checked.exit == 0);
        }
        CHECK(page.out.find(".SH \"EXIT STATUS\"") + page.out.find(".SH EXIT STATUS") != 2 * std::string::npos);
        const std::string help = verb.empty() ? std::string() : run({verb, "--help"}).out;
        static const std::regex option("\n  (?:-[a-z], )?(--[a-z-]+)");
        for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it)
            CHECK(page.out.find(std::regex_replace((*it)[1].str(), std::regex("-"), "\\-")) != std::string::npos);
    }
}

TEST_CASE("warnings: those found before an error are printed too") {
    // The inertia breaks the triangle inequality (a warning), and the formalism does not exist (an error).
    const std::string scene = temporary(
        "warned.toml",
        "[coordinates]\nphi = 0\n[[frame]]\nname = \"F\"\nrotate = [[\"z\", \"phi\"]]\n[[body]]\nname = \"B\"\n"
        "mass = 1\nframe = \"F\"\nposition = [0, 0]\ninertia = [1, 1, 3]\n");
    const auto fine = run({"eval", scene});
    INFO(fine.err);
    REQUIRE(fine.err.find("warning") != std::string::npos);
    const auto result = run({"eval", scene, "--by", "nonsense"});
    CHECK(result.exit == 3);
    CHECK(result.err.find("warning") != std::string::npos);
    CHECK(result.err.find("there is no formalism") != std::string::npos);
    CHECK(result.err.find("warning") == result.err.rfind("warning"));  // once
}

TEST_CASE("wording: singulars, fractions, rounding and digits read as a person would write them") {
    const std::string scene = temporary("pendulum.toml", pendulum);
    CHECK(run({"emit", scene, "-o", alembert::test::temporary_folder("solver")}).out.find("1 multiplication,") !=
          std::string::npos);
    CHECK(
        run({"derive", source_path("scenes/gallery/universal_double_pendulum.toml")}).out.find("divided by 1/") ==
        std::string::npos);
    const auto ball = run({"simulate", source_path("scenes/textbook/bouncing_ball.toml"), "--no-estimate"});
    CHECK(ball.out.find("of 0 operations") == std::string::npos);
    const auto rest = run({"check", scene, temporary("rest.txt", "rest\ntheta = 0\n")});
    CHECK(rest.out.find("theta = pi,") != std::string::npos);
    CHECK(rest.out.find("3.14159") == std::string::npos);
    // A hinge transmits no moment about its free axis: the balance of moments of the two rods.
    const auto joints = nlohmann::json::parse(
        run({"eval", source_path("scenes/textbook/double_pendulum_joints.toml"), "--reactions", "--json"}).out);
    for (const char* const joint : {"hook", "elbow"}) {
        CHECK(joints["joint_reactions"][joint]["moment"][2] == 0.0);
        CHECK(std::abs(joints["joint_reactions"][joint]["force"][0].get<double>()) > 1);
    }
}

}  // namespace commands_terminal
