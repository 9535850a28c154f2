// SPDX-License-Identifier: MIT
// Verbs and options that have another name now give the same under their earlier name, to the byte; and the words
// with which somebody begins: none, a scene alone, help, new, a wrong verb.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "earlier_names.hpp"
#include "files.hpp"
#include "shell.hpp"

namespace commands_earlier_names {

using namespace alembert;
using alembert::test::contents;
using alembert::test::earlier_verbs;
using alembert::test::EarlierVerb;
using alembert::test::on_terminal;
using alembert::test::Run;
using alembert::test::run;
using alembert::test::run_shell;
using alembert::test::source_path;
using alembert::test::temporary;
using alembert::test::temporary_folder;

namespace {

using Words = std::vector<std::string>;

std::string textbook(const std::string& name) {
    return source_path("scenes/textbook/" + name + ".toml");
}

/// Times are not the same from run to run.
std::string without_times(std::string text) {
    for (const char* const time : {"\"seconds\": [0-9.e+-]+", "\n[0-9.e+-]+ s\n", "\nseconds: [^\n]*",
                                   "[0-9.e+-]+ *s of", "\"(derive|emit|compile|integrate|estimate)\": [0-9.e+-]+"})
        text = std::regex_replace(text, std::regex(time), "TIME");
    return text;
}

struct Pair {
    Words earlier, now;  ///< FILE stands for a file of its own, the same for both
    bool has_json = true;
};

const std::vector<Pair>& pairs() {
    static const std::string hoop = textbook("rotating_hoop"), arm = textbook("double_pendulum"),
                             ziegler = source_path("scenes/stability/ziegler.toml"),
                             rods = textbook("struck_rods"), governor = textbook("watt_governor"),
                             cart = textbook("cart_pole"),
                             homework = source_path("tests/derivations/central_force_slip.tex");
    static const std::vector<Pair> all = {
        {{"agree", arm}, {"check", arm, "--formalisms"}},
        {{"agree", "nothing.toml"}, {"check", "--formalisms", "nothing.toml"}},
        {{"agree", arm, "--by", "kane"}, {"check", arm, "--formalisms", "--by", "kane"}},
        {{"kinematics", arm, "--of", "B1", "--steps"}, {"eval", arm, "--kinematics", "--of", "B1", "--steps"}},
        {{"kinematics", arm, "--jacobian", "--at", "theta1=0.3"},
         {"eval", arm, "--jacobian", "--kinematics", "--at", "theta1=0.3"}},
        {{"inertia", textbook("gyrocompass")}, {"eval", textbook("gyrocompass"), "--inertia"}},
        {{"identify", arm}, {"eval", arm, "--identify"}},
        {{"inverse", arm, "--at", "theta1''=2"}, {"eval", arm, "--inverse", "--at", "theta1''=2"}},
        {{"inverse", arm, "--reactions"}, {"eval", arm, "--inverse", "--reactions"}},
        {{"impact", rods}, {"eval", rods, "--impact"}},
        {{"linearize", governor, "--at", "alpha=0"}, {"stability", governor, "--matrices", "--at", "alpha=0"}},
        {{"linearize", governor}, {"stability", governor, "--matrices"}},
        {{"linearize", arm, "--along", "--duration", "0.2", "-o", "FILE.csv"},
         {"stability", arm, "--matrices", "--along", "--duration", "0.2", "--csv", "FILE.csv"}},
        {{"fmu", cart, "-o", "FILE.fmu", "--fmi", "3"}, {"emit", cart, "--fmu", "FILE.fmu", "--fmi", "3"}},
        {{"fmu", cart, "--output=FILE.fmu"}, {"emit", cart, "--fmu=FILE.fmu"}},
        {{"watch", arm, "--port", "0"}, {"report", arm, "--watch", "--port", "0"}, false},
        {{"watch", "nothing.toml"}, {"report", "nothing.toml", "--watch"}, false},
        {{"completion", "bash"}, {"--completion", "bash"}, false},
        {{"completion", "zsh"}, {"--completion=zsh"}, false},
        {{"man"}, {"--man"}, false},
        {{"man", "sweep"}, {"--man", "sweep"}, false},
        {{"derive", arm, "--draw", "FILE.svg"}, {"derive", arm, "--svg", "FILE.svg"}},
        {{"simulate", arm, "--plot", "FILE.svg", "--show", "theta1", "--duration", "0.1"},
         {"simulate", arm, "--svg", "FILE.svg", "--show", "theta1", "--duration", "0.1"}},
        {{"simulate", arm, "-o", "FILE.csv", "--duration", "0.1"},
         {"simulate", arm, "--csv", "FILE.csv", "--duration", "0.1"}},
        {{"equilibrium", hoop, "--follow", "Omega=0:10", "-o", "FILE.csv"},
         {"equilibrium", hoop, "--vary", "Omega=0:10", "-o", "FILE.csv"}},
        {{"equilibrium", hoop, "--follow", "Omega=1"}, {"equilibrium", hoop, "--vary", "Omega=1"}},
        {{"stability", ziegler, "--over", "c=0.1:1:5", "--over", "P=0:3:5", "--svg", "FILE.svg"},
         {"stability", ziegler, "--vary", "c=0.1:1:5", "--vary", "P=0:3:5", "--plot", "FILE.svg"}},
        {{"stability", ziegler, "--locus", "P=0:3:9", "-o", "FILE.csv"},
         {"stability", ziegler, "--vary", "P=0:3:9", "-o", "FILE.csv"}},
        {{"stability", "--locus", "P=0:3:9", ziegler}, {"stability", "--vary", "P=0:3:9", ziegler}, false},
        {{"check", textbook("central_force"), homework, "--csv", "FILE.csv"},
         {"check", textbook("central_force"), homework, "-o", "FILE.csv"}},
    };
    return all;
}

/// One of the two commands in a folder of its own, and what it has written there.
struct Answer {
    Run run;
    std::string file;
};

Answer answer(Words words, const std::string& folder) {
    const std::string base = folder + "/FILE";
    std::filesystem::path written;
    for (std::string& word : words)
        if (const std::size_t at = word.find("FILE."); at != word.npos) {
            word.replace(at, 4, base);
            written = word.substr(at);
        }
    Answer result{run(words), {}};
    if (!written.empty()) {
        result.file = contents(written);
        std::filesystem::remove(written);
    }
    return result;
}

}  // namespace

TEST_CASE("earlier names: each gives the same output, files, messages and exit code as the one of now") {
    const std::string folder = temporary_folder("earlier");
    for (const Pair& pair : pairs())
        for (const bool json : {false, true}) {
            if (json && !pair.has_json) continue;
            Words earlier = pair.earlier, now = pair.now;
            if (json) earlier.emplace_back("--json"), now.emplace_back("--json");
            const Answer before = answer(earlier, folder), after = answer(now, folder);
            CAPTURE(earlier);
            CAPTURE(before.run.err);
            CHECK(before.run.exit == after.run.exit);
            CHECK(without_times(before.run.out) == without_times(after.run.out));
            CHECK(before.run.err == after.run.err);
            CHECK(before.file == after.file);
            const bool has_file = std::any_of(earlier.begin(), earlier.end(), [](const std::string& word) {
                return word.find("FILE.") != word.npos;
            });
            CHECK(before.file.empty() != has_file);
            CHECK((before.run.out.empty() ? before.run.exit == 3 : before.run.exit <= 2));
        }
}

TEST_CASE("earlier names: help answers to both, and lists only the ones of now") {
    const std::string list = run({"--help"}).out;
    for (const EarlierVerb& verb : earlier_verbs) {
        CAPTURE(verb.name);
        CHECK(list.find(std::string("\n  ") + verb.name + " ") == list.npos);
        const Run before = run({verb.name, "--help"});
        CHECK(before.exit == 0);
        CHECK(before.out.find(verb.option) != before.out.npos);
        const std::string of = *verb.verb == '\0' ? verb.option : verb.verb;
        CHECK((*verb.verb == '\0' ? run({verb.option, "--help"}) : run({verb.verb, verb.option, "--help"})).out ==
              before.out);
        if (*verb.verb != '\0')
            CHECK(run({verb.verb, "--help"}).out.find(std::string("\n  ") + verb.option + " ") !=
                  std::string::npos);
    }
    for (const char* const name : {"--over", "--follow", "--locus", "--plot", "--draw", "--csv"})
        for (const char* const verb : {"stability", "equilibrium", "simulate", "derive", "bench", "check"})
            CHECK(run({verb, "--help"}).out.find(name) == std::string::npos);
    CHECK(run({"eval", textbook("sled"), "--inverse", "--inertia"}).err.find("has no option") !=
          std::string::npos);
}

TEST_CASE("command line: without a verb there are the groups on one screen, for people who read Chinese too") {
    const Run bare = run({}), help = run({"help"}), chinese = run({"--language", "zh"});
    CHECK(bare.exit == 0);
    CHECK(bare.err.empty());
    CHECK(bare.out == run({"--help"}).out);
    CHECK(bare.out == help.out);
    static const std::regex verb("\n  [a-z]+ ");
    for (const std::string& text : {bare.out, chinese.out}) {
        CHECK(std::count(text.begin(), text.end(), '\n') <= 24);
        CHECK(std::distance(std::sregex_iterator(text.begin(), text.end(), verb), std::sregex_iterator()) == 13);
    }
    for (const char* const group : {"Equations\n", "One state\n", "Equilibria\n", "Motion\n", "Code and page\n"})
        CHECK(bare.out.find(group) != std::string::npos);
    CHECK(run({"help", "sweep"}).out == run({"sweep", "--help"}).out);
    CHECK(run({"help", "eval", "--inverse"}).out == run({"inverse", "--help"}).out);
}

TEST_CASE("new: a first scene without warnings, in either language, which replaces nothing") {
    const std::string folder = temporary_folder("new");
    for (const char* const language : {"en", "zh"}) {
        const std::string file = folder + "/" + language + ".toml";
        const Run made = run({"new", file, "--language", language});
        CHECK(made.exit == 0);
        CHECK(made.out.find("alembert derive " + file) != std::string::npos);
        const std::string text = contents(file);
        CHECK(run({"check", file, "--strict"}).exit == 0);
        CHECK(run({"check", file, "--formalisms"}).exit == 0);
        CHECK(run({"simulate", file, "--duration", "0.1"}).exit == 0);
        const Run again = run({"new", file});
        CHECK(again.exit == 3);
        CHECK(again.err.find("stays as it is") != std::string::npos);
        CHECK(contents(file) == text);
    }
    CHECK(contents(folder + "/en.toml") != contents(folder + "/zh.toml"));
    CHECK(run_shell("cd \"$1\" && ln -s nowhere hanging && \"$ALEMBERT\" new hanging", {folder}).exit == 3);
    const Run usual = run_shell("cd \"$1\" && \"$ALEMBERT\" new --json && cat pendulum.toml", {folder});
    CHECK(usual.out.find("\"file\": \"pendulum.toml\"") != std::string::npos);
    CHECK(usual.out.ends_with(contents(folder + "/en.toml")));
    CHECK(run({"new", folder + "/scene.csv"}).exit == 3);
}

TEST_CASE("command line: a scene alone makes its page, and opens it on a terminal with a display alone") {
    const std::string folder = temporary_folder("alone");
    const std::string script =
        "cd \"$1\" && \"$ALEMBERT\" new a.toml >/dev/null; mkdir -p bin && "
        "printf '#!/bin/sh\\nprintf %%s \"$1\" >\"%s/opened\"\\n' \"$1\" >bin/xdg-open && chmod +x bin/xdg-open "
        "&& "
        "rm -f opened a.html && export PATH=\"$1/bin:$PATH\" && unset DISPLAY WAYLAND_DISPLAY; ";
    const auto opened = [&] { return contents(folder + "/opened"); };
    const Run piped = run_shell(script + "DISPLAY=:9 \"$ALEMBERT\" a.toml --no-motion", {folder});
    CHECK(piped.exit == 0);
    CHECK(piped.out == "wrote a.html\n");
    CHECK(contents(folder + "/a.html").find("</html>") != std::string::npos);
    on_terminal(script + "\"$ALEMBERT\" a.toml --no-motion", {folder}, 80);
    on_terminal(script + "DISPLAY=:9 \"$ALEMBERT\" report a.toml --no-motion; sleep 0.3", {folder}, 80);
    on_terminal(script + "DISPLAY=:9 \"$ALEMBERT\" a.toml --no-motion --json; sleep 0.3", {folder}, 80);
    CHECK(opened().empty());
    on_terminal(script +
                    "DISPLAY=:9 \"$ALEMBERT\" a.toml --no-motion; for i in 1 2 3 4 5 6 7 8 9 10; do "
                    "[ -s opened ] || sleep 0.2; done",
                {folder}, 80);
    CHECK(opened() == std::filesystem::canonical(folder).string() + "/a.html");
    const Run mistyped = run_shell("cd \"$1\" && \"$ALEMBERT\" none.toml", {folder});
    CHECK(mistyped.exit == 3);
    CHECK(mistyped.err.find("none.toml: no such file") != std::string::npos);
    CHECK(!std::filesystem::exists(folder + "/none.html"));
}

}  // namespace commands_earlier_names
