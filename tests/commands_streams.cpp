// SPDX-License-Identifier: MIT
// Standard output that is full, closed or no longer read, and text from outside on its way to a terminal.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "scenes.hpp"
#include "shell.hpp"

namespace commands_streams {

using namespace alembert::test;

namespace {

const std::string pendulum = R"toml(
gravity = [0, "-g"]
[parameters]
l = 1.5
g = 9.81
[coordinates]
theta = 0
[[particle]]
name = "P"
mass = 2
position = ["l*sin(theta)", "-l*cos(theta)"]
[simulation]
duration = 0.5
)toml";

const std::vector<std::string> every_verb{"derive S",
                                          "derive S --json --steps",
                                          "derive S --format latex",
                                          "agree S",
                                          "agree S --json",
                                          "audit S",
                                          "audit S --json",
                                          "check S C",
                                          "check S C --json",
                                          "eval S",
                                          "eval S --json",
                                          "linearize S",
                                          "linearize S --json",
                                          "inverse S",
                                          "inverse S --json",
                                          "impact S",
                                          "impact S --json",
                                          "emit S -o D",
                                          "emit S -o D --json",
                                          "simulate S --no-estimate",
                                          "simulate S --json --no-estimate",
                                          "sweep S --vary t=0:1:2",
                                          "sweep S --vary t=0:1:2 --json",
                                          "bench S --method dop853 --reference-seconds 0.1 --budget 2000",
                                          "import R -o D/robot.toml",
                                          "import R -o D/robot.toml --json",
                                          "--help",
                                          "--version",
                                          "derive --help"};

/// The exit code and the standard error of each command with its standard output redirected as given.
std::string with_output(const std::string& redirection) {
    std::string script = "S=$1 C=$2 D=$3 R=$4\ntry() { code=0; \"$ALEMBERT\" \"$@\" 2>\"$D/err\" " + redirection +
                         " || code=$?; message=$(tail -n 1 \"$D/err\"); echo \"$code $* $message\"; }\n";
    for (const std::string& line : every_verb) {
        script += "try";
        std::istringstream words(line);
        for (std::string word; words >> word;) {
            const bool is_name = word.size() == 1 || word.starts_with("D/");
            script += is_name ? " \"$" + word + "\"" : " " + word;
        }
        script += "\n";
    }
    return run_shell(script, {temporary("pendulum.toml", pendulum),
                              temporary("claims.txt", "l*theta'' + g*sin(theta) = 0\n"),
                              temporary_folder("streams"), source_path("tests/robots/torso.urdf")})
        .out;
}

/// Is it free of bytes that control a terminal?
bool is_harmless(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7F || byte == 0xFF) return false;
        if (byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0)
            return false;  // U+0080 … U+009F
    }
    return true;
}

}  // namespace

TEST_CASE("streams: a standard output that is full or closed is exit 5 with a message, for every verb") {
    for (const auto& [redirection, reason] :
         {std::pair{">/dev/full", "No space left on device"}, std::pair{">&-", "Bad file descriptor"}}) {
        std::istringstream lines(with_output(redirection));
        std::size_t count = 0;
        for (std::string line; std::getline(lines, line);) {
            ++count;
            CAPTURE(line);
            CHECK(line.starts_with("5 "));
            CHECK(line.ends_with(std::string("cannot write to the standard output: ") + reason));
        }
        CHECK(count == every_verb.size());
    }
}

TEST_CASE("streams: a reader that stops reading ends the program silently") {
    const Run result = run_shell(R"({ sleep 0.1; "$ALEMBERT" derive "$1" --json; echo $? >&3; } 3>&2 | true)",
                                 {source_path("scenes/textbook/cart_pole.toml")});
    CHECK(result.err == "141\n");  // 128 + SIGPIPE
}

TEST_CASE("streams: no control character of a scene, a claim or a file's name reaches the terminal") {
    const std::string scene = source_path("scenes/textbook/cart_pole.toml"),
                      folder = temporary_folder("esc\033[31m\xC2\x9B\xFFname");
    const std::string titled = temporary(
        "titled.toml",
        "title = \"a\\u001B[2Jb\\u009B\"\n[parameters]\nm = { value = 1, unit = \"kg\", about = \"\\u001B[5m\" }\n"
        "[coordinates]\nx = 0\n[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", 0]\n");
    const std::string unit = temporary("unit.toml",
                                       "[parameters]\nm = { value = 1, unit = \"\\u001B[5m\" }\n[units]\n"
                                       "\"\\u001B[5m\" = \"\\u001B[5m\"\n[coordinates]\nx = 0\n");
    const std::string raw = temporary("raw.toml", "title = \"a\033[2Jb\"\n[coordinates]\nx = 0\n");
    const std::string claims = temporary("claims.txt", "theta\033[2J'' = 0\n\xC2\x9B = 1\n");
    const std::vector<std::vector<std::string>> commands{
        {"derive", titled},
        {"derive", titled, "--json"},
        {"impact", titled},
        {"emit", titled, "-o", folder},
        {"emit", titled, "-o", folder, "--json"},
        {"simulate", titled, "--duration", "0.1", "-o", folder + "/motion.csv", "--json"},
        {"simulate", titled, "--duration", "0.1", "-o", folder + "/motion.csv"},
        {"simulate", scene, "--method", "\033[31m"},
        {"simulate", scene, "-o", folder + "/\033none/x"},
        {"sweep", scene, "--vary", "\033=0:1:2"},
        {"derive", raw},
        {"derive", unit},
        {"derive", folder + "/\033none.toml"},
        {"derive", scene, "--by", "\033[31m"},
        {"derive", scene, "--\033[31m"},
        {"eval", scene, "--at", "\033=1"},
        {"check", scene, claims},
        {"check", scene, claims, "--json"},
        {"import", folder + "/\033none.urdf", "-o", folder + "/x.toml"},
        {"\033[31m"}};
    for (const std::vector<std::string>& words : commands) {
        const Run result = run(words);
        CAPTURE(words[0]);
        CAPTURE(result.err);
        CHECK(is_harmless(result.out));
        CHECK(is_harmless(result.err));
        CHECK(result.err.find("internal error") == std::string::npos);
        CHECK(!(result.out + result.err).empty());
        if (std::find(words.begin(), words.end(), "--json") != words.end() && result.exit == 0)
            CHECK(nlohmann::json::accept(result.out));
    }
}

}  // namespace commands_streams
