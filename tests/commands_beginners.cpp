// SPDX-License-Identifier: MIT
// Scenes of beginners with one mistake each. The first lines of tests/beginners/*.toml say the mistake and what
// must follow: `message LINE: words` of the first message, `warning LINE: words`, or `accepted: OUTPUT = VALUE`,
// the value at the initial state. Written anew after questions that people ask about other programs.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_beginners {

using namespace alembert::test;

namespace {

struct Lesson {
    std::string file, kind, words;
    int line = 0;
};

Lesson lesson_of(const std::filesystem::path& path) {
    std::string text = contents(path);
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    std::istringstream lines(text);
    std::string mistake, expected;
    std::getline(lines, mistake);
    std::getline(lines, expected);
    if (expected.ends_with('\r')) expected.pop_back();
    REQUIRE(mistake.starts_with("# mistake: "));
    Lesson lesson{.file = path.string(), .kind = {}, .words = {}};
    if (expected.starts_with("# accepted: ")) {
        lesson.kind = "accepted";
        lesson.words = expected.substr(12);
        return lesson;
    }
    char kind[16] = {};
    int length = 0;
    REQUIRE(std::sscanf(expected.c_str(), "# %15[a-z] %d: %n", kind, &lesson.line, &length) == 2);
    lesson.kind = kind;
    lesson.words = expected.substr(static_cast<std::size_t>(length));
    REQUIRE((lesson.kind == "message" || lesson.kind == "warning"));
    REQUIRE_FALSE(lesson.words.empty());
    return lesson;
}

std::vector<Lesson> lessons() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(source_path("tests/beginners")))
        paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<Lesson> all;
    for (const auto& path : paths) {
        CAPTURE(path.string());
        all.push_back(lesson_of(path));
    }
    return all;
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

bool has_chinese(const std::string& text) {
    for (std::size_t k = 0; k + 2 < text.size(); ++k)
        if (static_cast<unsigned char>(text[k]) >= 0xE4 && static_cast<unsigned char>(text[k]) <= 0xE9)
            return true;
    return false;
}

void check_value(const Lesson& lesson) {
    const std::size_t equals = lesson.words.find(" = ");
    const std::string output = lesson.words.substr(0, equals);
    const double value = std::stod(lesson.words.substr(equals + 3));
    const Json state = json_of({"eval", lesson.file});
    CHECK(state["outputs"][output].get<double>() == doctest::Approx(value).epsilon(1e-13));
    CHECK(state["warnings"].empty());
}

}  // namespace

TEST_CASE("beginners: what is certain is read, and the first message names any other mistake at its line") {
    const std::vector<Lesson> all = lessons();
    CHECK(all.size() >= 60);
    for (const Lesson& lesson : all) {
        CAPTURE(lesson.file);
        if (lesson.kind == "accepted") {
            check_value(lesson);
            continue;
        }
        const bool is_warning = lesson.kind == "warning";
        const Run english = run({"derive", lesson.file}),
                  chinese = run({"derive", lesson.file, "--language", "zh"});
        const std::string first = first_line(english.err);
        CAPTURE(first);
        CHECK(english.exit == (is_warning ? 0 : 3));
        CHECK(first.starts_with(lesson.file + ":" + (lesson.line > 0 ? std::to_string(lesson.line) + ":" : " ")));
        CHECK(first.find(lesson.words) != std::string::npos);
        CHECK((first.find(": warning: ") != std::string::npos) == is_warning);
        CHECK(has_chinese(first_line(chinese.err)));
    }
}

TEST_CASE("beginners: the command line takes words in capitals, and Greek letters as the scene has them") {
    const std::string scene = source_path("scenes/textbook/double_pendulum.toml");
    const auto same = [](const std::vector<std::string>& words, const std::vector<std::string>& others) {
        Json one = json_of(words), other = json_of(others);
        one.erase("seconds"), other.erase("seconds");
        CHECK(one == other);
    };
    same({"derive", scene, "--by", "Kane"}, {"derive", scene, "--by", "kane"});
    same({"eval", scene, "--at", "θ1=0.7"}, {"eval", scene, "--at", "theta1=0.7"});
    same({"eval", scene, "--at", "theta1dot = 2"}, {"eval", scene, "--at", "theta1'=2"});
    same({"eval", scene, "--at", "θ1′＝2"}, {"eval", scene, "--at", "theta1'=2"});
    const std::string claims = temporary("claims.txt",
                                         "m2*l1*θ1ddot*cos(θ1−θ2)＋m2*l2*ddot(theta2) − "
                                         "m2*l1*\\dot{\\theta_1}**2*\\sin(θ1(t) - θ2) + m2*g*sin(θ2) ＝ "
                                         "F(t)*Cos(θ2)\n");
    const Json proved = json_of({"check", scene, claims})["claims"];
    REQUIRE(proved.size() == 1);
    CHECK(proved[0]["verdict"] == "proved");
    const std::string own = temporary("own.txt", "unknowns theta1dot\ntheta1dot = θ1dot^2*θ2′\n");
    CHECK(json_of({"check", scene, own}, {}, 2)["claims"][0]["equation"] == "theta1dot = theta1dot^2*theta2'");
    CHECK(json_of({"simulate", scene, "--duration", "0.1", "--method", "DOP853"})["method"] == "dop853");
}

TEST_CASE("beginners: mistakes on the command line are named in our words, in both languages") {
    const std::string scene = source_path("scenes/textbook/double_pendulum.toml");
    struct Call {
        std::vector<std::string> words;
        const char* told;
    };
    const Call calls[] = {
        {{"run", scene}, "did you mean simulate?"},
        {{"Derive", scene}, "did you mean derive?"},
        {{"solve", scene}, "did you mean simulate?"},
        {{"plot", scene}, "did you mean simulate --svg?"},
        {{"draw", scene}, "did you mean derive --svg?"},
        {{"animate", scene}, "did you mean report --watch?"},
        {{"list"}, "did you mean --help?"},
        {{"kinematic", scene}, "did you mean eval --kinematics?"},
        {{scene, "derive"}, "'derive' is not expected here; write: alembert report SCENE"},
        {{"--tolerance"}, "stands where a verb is expected"},
        {{"derive"}, "derive needs SCENE"},
        {{"emit", scene}, "emit needs --output DIR"},
        {{"derive", scene, "more"}, "'more' is not expected here; write: alembert derive SCENE"},
        {{"derive", scene, "-q"}, "'-q' is not expected here"},
        {{"simulate", scene, "--tol", "1e-6"}, "has no option '--tol'; did you mean --tolerance?"},
        {{"simulate", scene, "--rtol=1e-6"}, "did you mean --tolerance?"},
        {{"simulate", scene, "--time", "5"}, "did you mean --duration?"},
        {{"simulate", scene, "--solver", "radau"}, "did you mean --method?"},
        {{"simulate", scene, "--dur", "5"}, "did you mean --duration?"},
        {{"simulate", scene, "-tolerance", "1e-6"}, "did you mean --tolerance?"},
        {{"simulate", scene, "—json"}, "did you mean --json?"},
        {{"simulate", scene, "--duration"}, "--duration needs a value: --duration S"},
        {{"simulate", scene, "--duration", "long"}, "--duration long: expected a number"},
        {{"simulate", scene, "--budget", "1.5"}, "--budget 1.5: expected a whole number"},
        {{"simulate", scene, "--tolerance", "0"}, "--tolerance 0: expected a number above zero"},
        {{"simulate", scene, "--step", "1", "--step", "2"}, "--step is given more than once"},
        {{"simulate", scene, "--method", "RK45"}, "did you mean 'dopri5'?"},
        {{"simulate", scene, "--method", "DPRKN12"}, "did you mean 'rkn1210'?"},
        {{"derive", scene, "--format", "html"}, "--format html: expected text, latex, mathml"},
        {{"derive", scene, "--by", "newton"}, "did you mean 'schiehlen'?"},
        {{"watch", scene, "--port", "0"}, "--port 0: expected a whole number from 1 to 65535"},
        {{"sweep", scene, "--sampling", "sobol"}, "--sampling goes with --samples; give both"},
    };
    // What CLI11 says in these places.
    const char* const foreign[] = {"is required",  "not expected:", "Could not convert", "required but",
                                   "not in range", " requires ",    "excludes",          "not in {"};
    for (const Call& call : calls) {
        const Run english = run(call.words);
        CAPTURE(english.err);
        CHECK(english.exit == 3);
        CHECK(english.err.find(call.told) != std::string::npos);
        for (const char* const words : foreign) CHECK(english.err.find(words) == std::string::npos);
        std::vector<std::string> words = call.words;
        words.insert(words.end(), {"--language", "zh"});
        const Run chinese = run(words);
        CAPTURE(chinese.err);
        CHECK(chinese.exit == 3);
        CHECK(has_chinese(first_line(chinese.err)));
    }
}

}  // namespace commands_beginners
