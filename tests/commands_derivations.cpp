// SPDX-License-Identifier: MIT
// Derivations on the command line: exit codes, JSON, pages and gradebooks. What each line of a derivation is worth
// is held by tests/derivations.py.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"
#include "shell.hpp"

namespace commands_derivations {

using namespace alembert::test;

namespace {

const std::string pendulum = R"toml(gravity = [0, "-g"]
[parameters]
m = 1.5
l = 0.4
g = 9.81
[coordinates]
theta = 0.3
[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)", "-l*cos(theta)"]
)toml";

const std::string right = R"tex(
\[ T = \frac12 m\ell^2\dot\theta^2, \qquad V = -m g\ell\cos\theta \]
\[ m\ell^2\ddot\theta + m g\ell\sin\theta = 0 \]
)tex";

const std::string wrong = R"tex(
\[ T = \frac12 m\ell^2\dot\theta^2, \qquad V = m g\ell\cos\theta \]
\[ m\ell^2\ddot\theta - m g\ell\sin\theta = 0 \]
)tex";

Json marked(const std::string& file, const std::string& text) {
    return Json::parse(run({"check", temporary("pendulum.toml", pendulum), temporary(file, text), "--json"}).out);
}

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

}  // namespace

TEST_CASE("derivations: the exit code says whether there is a mistake, and whether all is there") {
    const std::string scene = temporary("pendulum.toml", pendulum);
    CHECK(run({"check", scene, temporary("right.tex", right), "--complete"}).exit == 0);
    CHECK(run({"check", scene, temporary("wrong.tex", wrong)}).exit == 1);
    const std::string energies = temporary("energies.md", "$T = \\frac12 m l^2\\dot\\theta^2$ is known.\n");
    CHECK(run({"check", scene, energies}).exit == 0);
    CHECK(run({"check", scene, energies, "--complete"}).exit == 2);
    const Run none = run({"check", scene, temporary("none.tex", "No formula stands here.\n")});
    CHECK(none.exit == 3);
    CHECK(none.err.find("no mathematics") != std::string::npos);
}

TEST_CASE("derivations: JSON names the first mistake, what follows from it, and the letters") {
    const Json json = marked("wrong.tex", wrong);
    REQUIRE(json["lines"].size() == 3);
    CHECK(json["first_mistake"] == 1);
    CHECK(json["lines"][0]["status"] == "right");
    CHECK(json["lines"][1]["status"] == "mistake");
    CHECK(json["lines"][1]["line"] == 2);
    CHECK(json["lines"][1]["likely"]["kind"] == "sign");
    CHECK(json["lines"][2]["status"] == "follows");
    CHECK(json["lines"][2]["follows_from"] == 1);
    CHECK(json["missing"] == Json{"theta"});
    CHECK(json["letters"]["\\ell"] == "l");
    CHECK(marked("right.tex", right)["first_mistake"].is_null());
}

TEST_CASE("derivations: standard input is one, and a plain file of equations still is a file of claims") {
    const std::string scene = temporary("pendulum.toml", pendulum);
    const Run piped = run_shell(R"(printf '%s' "$2" | "$ALEMBERT" check "$1" - --json)", {scene, wrong});
    CHECK(piped.exit == 1);
    CHECK(Json::parse(piped.out)["first_mistake"] == 1);
    const std::string claims =
        temporary("claims.txt", "l*theta'' + g*sin(theta) = 0\n# a comment\nrest\nsin(theta) = 0\n");
    const Json plain = Json::parse(run({"check", scene, claims, "--json"}).out);
    CHECK(plain["claims"].size() == 2);
    const std::string words = temporary("words.txt", "The equation of motion is\nl θ̈ + g sin θ = 0\n");
    CHECK(Json::parse(run({"check", scene, words, "--json"}).out)["lines"].size() == 1);
}

TEST_CASE("derivations: letters are said by the scene and by the option, and a name that is none is refused") {
    const std::string text = R"tex(\[ T = \frac12 m a^2\dot\chi^2 \])tex";
    const std::string file = temporary("letters.tex", text);
    const std::string scene = temporary("pendulum.toml", pendulum);
    const Run told = run({"check", scene, file, "--letters", "a=l", "--letters", "\\chi=theta", "--json"});
    CHECK(Json::parse(told.out)["lines"][0]["status"] == "right");
    const std::string with =
        temporary("letters.toml", pendulum + "[letters]\na = \"l\"\n\"\\\\chi\" = \"theta\"\n");
    CHECK(Json::parse(run({"check", with, file, "--json"}).out)["lines"][0]["status"] == "right");
    const Run refused = run({"check", scene, file, "--letters", "a=length"});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("'length'") != std::string::npos);
    CHECK(run({"check", scene, file, "--letters", "a"}).exit == 3);
}

// The accelerations of 32 rods at a state of small numbers are fractions of hundreds of digits.
TEST_CASE("check: fractions that nobody can read are told by four digits, and JSON has all of them") {
    const std::string scene = source_path("scenes/benchmark/trees/pend32.toml"),
                      claim = temporary("wrong.txt", "T = 1/2*q1dot^2\n");
    const auto text = run({"check", scene, claim});
    CHECK(text.exit == 1);
    CHECK(text.out.size() < 4000);
    const Json json = json_of({"check", scene, claim}, {}, 1);
    const std::string value = json["claims"][0]["counterexample"]["q32''"];
    REQUIRE(value.size() > 60);
    const std::size_t bar = value.find('/');
    // Both have more digits than a double has powers of ten.
    const long double told = std::strtold(value.c_str(), nullptr) / std::strtold(value.c_str() + bar + 1, nullptr);
    CHECK(text.out.find(fmt::format("q32'' ≈ {:.4g}", static_cast<double>(told))) != std::string::npos);
}

TEST_CASE("check --json-file: one run prints for people and writes what --json prints") {
    const std::string scene = temporary("pendulum.toml", pendulum), file = temporary("wrong.tex", wrong);
    const std::string claims = temporary("claims.txt", "l*theta'' + g*sin(theta) = 0\ntheta = 1\n");
    const std::string folder = temporary_folder("papers");
    std::ofstream(folder + "/a.tex") << wrong;
    const std::string object = temporary("verdicts.json", "");
    for (const std::string& of : {file, claims, folder}) {
        CAPTURE(of);
        const Run both = run({"check", scene, of, "--json-file", object}), text = run({"check", scene, of});
        CHECK(both.exit == text.exit);
        CHECK(both.out == text.out);
        CHECK(contents(object) == run({"check", scene, of, "--json"}).out);
    }
    CHECK(run({"check", scene, file, "--json-file", "verdicts.html"}).exit == 3);
}

TEST_CASE(
    "derivations: the page has each line with its verdict, the wrong term marked, and no markup of its author") {
    const std::string page = temporary("page.html", "");
    const std::string text = wrong + "\nThis is <script>alert(1)</script> text: $m > 0$ and $T = V$\n";
    run({"check", temporary("pendulum.toml", pendulum), temporary("wrong.tex", text), "--html", page});
    const std::string html = contents(page);
    CHECK(html.find("<script") == std::string::npos);
    CHECK(html.find("default-src 'none'") != std::string::npos);
    CHECK(occurrences(html, "<div class=\"marked right\">") >= 1);
    CHECK(occurrences(html, "<div class=\"marked mistake\">") >= 1);
    CHECK(occurrences(html, "<div class=\"marked follows\">") == 1);
    CHECK(occurrences(html, "<mrow class=\"wrong\">") >= 1);
    CHECK(occurrences(html, "<math") == occurrences(html, "</math>"));
    CHECK(occurrences(html, "<mrow") == occurrences(html, "</mrow>"));
}

TEST_CASE(
    "derivations: a folder gives a row for each, in the order of their names, also where one cannot be read") {
    const std::string folder = temporary_folder("class");
    const auto put = [&folder](const std::string& name, const std::string& text) {
        std::ofstream(folder + "/" + name) << text;
    };
    put("b.tex", wrong);
    put("a.tex", right);
    put("c, \"d\".md", "Nothing.\n");
    put("notes.toml", "x = 1\n");
    const std::string table = folder + "/grades.csv";
    const Run graded = run({"check", temporary("pendulum.toml", pendulum), folder, "--csv", table, "--json",
                            "--html", folder + "/all.html"});
    CHECK(graded.exit == 1);
    const Json json = Json::parse(graded.out);
    REQUIRE(json["derivations"].size() == 3);
    CHECK(json["derivations"][0]["file"] == "a.tex");
    CHECK(json["derivations"][0]["first_mistake"].is_null());
    CHECK(json["derivations"][1]["first_mistake"] == 2);
    CHECK(json["derivations"][1]["kind"] == "sign");
    CHECK(json["derivations"][1]["follows"] == 1);
    CHECK(json["derivations"][2].contains("problem"));
    CHECK(json["slips"] == Json{{"sign", 1}});
    const std::string csv = contents(table);
    CHECK(csv.find("a.tex,,,3,0,0,,0,\n") != std::string::npos);
    CHECK(csv.find("b.tex,2,sign,1,1,1,theta,0,\n") != std::string::npos);
    CHECK(csv.find("\n\"c, \"\"d\"\".md\",") != std::string::npos);
    CHECK(occurrences(contents(folder + "/all.html"), "<section id=\"derivation-") == 3);
    CHECK(run({"check", temporary("pendulum.toml", pendulum), temporary_folder("empty")}).exit == 3);
}

TEST_CASE("derivations: a scene is drafted from the lines, and what is printed is that scene") {
    const std::string file = temporary("draft.tex", R"tex(
\[ T = \frac12 m\ell^2\dot\varphi^2, \qquad V = -m g\ell\cos\varphi \]
\[ \ell\ddot\varphi + g\cos\varphi = 0 \]
)tex");
    const Run drafted = run({"check", "--scene-from", file});
    CHECK(drafted.exit == 1);
    const std::string scene = temporary("drafted.toml", drafted.out);
    const Json derived = Json::parse(run({"derive", scene, "--json"}).out);
    CHECK(derived["coordinates"] == Json{"phi"});
    CHECK(derived["equations"][0]["text"] == "l*phi'' + g*sin(phi) = 0");
    CHECK(run({"check", "--scene-from", temporary("none.tex", "$a = b$\n")}).exit == 3);
}

TEST_CASE("derivations: two hundred of a class take less than a minute") {
    const std::string folder = temporary_folder("many");
    for (int k = 0; k < 200; ++k)
        std::ofstream(folder + "/" + std::to_string(k) + ".tex") << (k % 3 == 0 ? right : wrong);
    const Run graded = run({"check", temporary("pendulum.toml", pendulum), folder, "--json"});
    CHECK(Json::parse(graded.out)["slips"]["sign"] == 133);
    CHECK(graded.seconds < 60);
}

// All changes that may be a slip, each with the claim around it, took 6.6 GB for 3,000 terms.
TEST_CASE("derivations: lines of thousands of terms or factors are judged in a gigabyte") {
    const std::string scene = temporary("pendulum.toml", pendulum);
    const auto repeated = [](const char* sign, int count, const auto& part) {
        std::string text = "$$m l^2 \\ddot\\theta = l";
        for (int k = 1; k <= count; ++k) text += sign + part(k);
        return text + "$$\n";
    };
    const auto l = [](int) { return std::string("l"); };
    const std::string lines[] = {
        repeated("+", 3000, l), repeated("*", 3000, l),
        repeated("+", 380, [](int k) { return fmt::format("{0}\\dot\\theta \\sin({0}\\theta)", k); }),
        repeated("", 399, [](int k) { return fmt::format("(l+{})", k); })};
    for (const std::string& line : lines) {
        CAPTURE(line.substr(0, 40));
        const std::string file = temporary("long.tex", line);
        const Run checked = run_shell(R"(ulimit -v 1000000; "$ALEMBERT" check "$1" "$2")", {scene, file});
        INFO(checked.err);
        CHECK(checked.exit == 1);
        CHECK(checked.out.find("mistake") != std::string::npos);
    }
}

}  // namespace commands_derivations
