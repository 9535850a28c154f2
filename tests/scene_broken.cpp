// SPDX-License-Identifier: GPL-2.0-or-later
// Scenes that must be refused: the first lines of tests/broken/*.toml give the expected messages and their places.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "files.hpp"
#include "scene/scene.hpp"
#include "steps.hpp"

namespace scene_broken {

using namespace alembert;

namespace {

struct Expected {
    Place place;
    std::string message;
};

std::vector<Expected> expectations(const std::string& text) {
    std::vector<Expected> list;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line) && line.rfind("# expect ", 0) == 0;) {
        Expected expected;
        int length = 0;
        REQUIRE(std::sscanf(line.c_str(), "# expect %d:%d: %n", &expected.place.line, &expected.place.column,
                            &length) == 2);
        expected.message = line.substr(static_cast<std::size_t>(length));
        list.push_back(expected);
    }
    return list;
}

std::vector<std::filesystem::path> broken_scenes() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(ALEMBERT_SOURCE_DIR "/tests/broken"))
        if (entry.path().extension() == ".toml") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// All diagnostics, or none if the scene was read.
std::vector<Diagnostic> told(const std::string& text) {
    try {
        parse_scene(text, "scene.toml");
    } catch (const SceneError& error) {
        return error.diagnostics;
    }
    return {};
}

constexpr std::size_t mebibyte = 1024 * 1024;

/// The text with as many pieces after it as there is room for.
std::string filled(std::size_t size, std::string text, const std::string& piece) {
    while (text.size() + piece.size() <= size) text += piece;
    return text;
}

/// Definitions, each of which names the next one.
std::string chain(std::size_t size) {
    std::string text = "[coordinates]\nx = 0\n[definitions]\n";
    int k = 0;
    for (; text.size() + 100 < size; ++k) text += fmt::format("d{} = \"d{}+x\"\n", k, k + 1);
    return text + fmt::format("d{} = \"x\"\n", k);
}

struct Flood {
    const char* name;
    std::function<std::string(std::size_t size)> text;
};

Flood repeated(const char* name, const std::string& begin, const std::string& piece) {
    return {name, [=](std::size_t size) { return filled(size, begin, piece); }};
}

const std::string coordinates = "[coordinates]\nx = 0\n", output = coordinates + "[outputs]\ny = ";
const Flood floods[] = {
    {"chain of definitions", chain},
    repeated("unknown tables", coordinates, "[[a]]\n"),
    repeated("open arrays", output, "["),
    repeated("open inline tables", output, "{a="),
    repeated("dotted key", "a", ".a"),
    repeated("dotted header", "[a", ".a"),
    repeated("unknown names", output + "[", "\"zz\","),
    repeated("particles", coordinates, "[[particle]]\n"),
    repeated("one line", "x = \"", "a"),
    repeated("quotes", coordinates, "\""),
    repeated("brackets", coordinates, "]"),
};

}  // namespace

TEST_CASE("broken scenes: each is refused for the mistake that it announces, at its place, and for no other") {
    const auto paths = broken_scenes();
    CHECK(paths.size() >= 40);
    for (const auto& path : paths) {
        CAPTURE(path.filename().string());
        const std::vector<Expected> expected = expectations(test::contents(path));
        REQUIRE_FALSE(expected.empty());
        std::string what;
        std::vector<Diagnostic> diagnostics;
        const std::size_t steps = test::steps_of([&] {
            try {
                read_scene(path.string());
            } catch (const SceneError& error) {
                what = error.what();
                diagnostics = error.diagnostics;
            }
        });
        CHECK(steps < 1000 * std::filesystem::file_size(path));  // none needs more than 300 for a byte
        CAPTURE(what);
        REQUIRE(diagnostics.size() == expected.size());
        for (const Expected& e : expected) {
            CAPTURE(e.message);
            CHECK(std::any_of(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& d) {
                return d.place == e.place && d.message.find(e.message) != std::string::npos;
            }));
            if (e.place.line > 0)
                CHECK(what.find(fmt::format("{}:{}:{}: ", path.string(), e.place.line, e.place.column)) !=
                      std::string::npos);
        }
        const bool is_raw =
            std::any_of(what.begin(), what.end(), [](unsigned char c) { return c < 0x20 && c != '\n'; });
        CHECK_FALSE(is_raw);
        CHECK(what.find("\u202e") == std::string::npos);
    }
}

TEST_CASE("broken scenes: a message shows the line with a caret under the word") {
    const std::string text = "[coordinates]\nθ = 0.1\n[outputs]\n\ty = \"角度 + θθ\" # 角\n";
    try {
        parse_scene(text, "scenes/p.toml");
        FAIL("was read");
    } catch (const SceneError& error) {
        CHECK(std::string(error.what()) ==
              "scenes/p.toml:4:7: unknown name '角度' in this expression\n"
              "     y = \"角度 + θθ\" # 角\n"
              "          ^\n"
              "scenes/p.toml:4:12: unknown name 'θθ' in this expression; did you mean 'θ'?\n"
              "     y = \"角度 + θθ\" # 角\n"
              "                 ^\n");
    }
}

TEST_CASE("broken scenes: a long line is shown around the caret") {
    std::string text = "[coordinates]\nx = 0\n[outputs]\ny = \"";
    for (int i = 0; i < 500; ++i) text += "x + ";
    text += "zz";
    for (int i = 0; i < 500; ++i) text += " + x";
    text += "\"\n";
    try {
        parse_scene(text, "p.toml");
        FAIL("was read");
    } catch (const SceneError& error) {
        std::istringstream lines(error.what());
        std::string message, line, caret;
        std::getline(lines, message);
        std::getline(lines, line);
        std::getline(lines, caret);
        CHECK(message == "p.toml:4:2006: unknown name 'zz' in this expression");
        CHECK(line.size() < 120);
        CHECK(line.find("zz") == caret.find('^') + 2);  // the leading … is one column and three bytes
    }
}

TEST_CASE("broken scenes: after twenty mistakes the rest are counted") {
    std::string text = "[coordinates]\nx = 0\n[outputs]\n";
    for (int i = 0; i < 33; ++i) text += fmt::format("y{} = \"zz{}\"\n", i, i);
    try {
        parse_scene(text, "p.toml");
        FAIL("was read");
    } catch (const SceneError& error) {
        CHECK(error.diagnostics.size() == 33);
        CHECK(std::string(error.what()).find("p.toml: and 13 more\n") != std::string::npos);
    }
}

TEST_CASE("broken scenes: files that cannot be read are reported as such") {
    const auto message = [](const std::string& file) -> std::string {
        try {
            read_scene(file);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(message("/nonexistent/scene.toml") == "/nonexistent/scene.toml: no such file\n");
    CHECK(message("/") == "/: is a directory; expected a scene file\n");
    CHECK(message("/nonexistent/\x1b[31m.toml") == "/nonexistent/\\u001B[31m.toml: no such file\n");
    CHECK(message("") == "\"\": the name of the file is empty; expected the path of a scene\n");
}

TEST_CASE("broken scenes: more than a mebibyte is refused") {
    const std::string head = "[coordinates]\nx = 0\n";
    const std::string most = filled(mebibyte, head, "# comment\n");
    CHECK(told(most).empty());
    REQUIRE(told(most + std::string(100, '\n')).size() == 1);
    CHECK(told(most + std::string(100, '\n'))[0].message.find("the limit is 1048576 (1 MiB)") !=
          std::string::npos);
}

// What is looked up in a tree takes log₂(16 n) / log₂ n times 16 as many steps for 16 times as much: at most 1.25
// times 16 for n of 16 KiB. What is compared with all the rest takes 256 times as many.
TEST_CASE("broken scenes: the steps that a flood of anything takes grow in proportion to its length") {
    for (const Flood& flood : floods) {
        const auto steps = [&](std::size_t size) {
            const std::string text = flood.text(size);
            return test::steps_of([&] { CHECK_MESSAGE(!told(text).empty(), std::string(flood.name)); });
        };
        const std::size_t few = steps(mebibyte / 64), many = steps(mebibyte / 4);
        CAPTURE(std::string(flood.name));
        CHECK(few > mebibyte / 64);
        CHECK(many < 20 * few);
    }
}

TEST_CASE("broken scenes: a misspelled key is told, and nothing that follows from it") {
    const std::string whole = test::contents(ALEMBERT_SOURCE_DIR "/tests/whole.toml");
    std::size_t told_of = 0;
    for (std::size_t line = 0; line < whole.size(); line = whole.find('\n', line) + 1) {
        const std::size_t end = whole.find('\n', line), equals = whole.find(" = ", line);
        if (end == std::string::npos) break;
        if (whole[line] == '[' || whole[line] == '#' || equals >= end || equals < line + 4) continue;
        if (whole.compare(line, 8, "unknowns") == 0) continue;  // what it would name stands above it
        std::string text = whole;
        text.erase(line + 1, 1);
        CAPTURE(text.substr(line, end - line - 1));
        const std::vector<Diagnostic> found = told(text);
        for (const Diagnostic& one : found)
            if (one.message.starts_with("unknown key")) {
                ++told_of;
                CHECK(found.front().message == one.message);
            }
    }
    CHECK(told_of > 40);
}

TEST_CASE("broken scenes: every mutation of a scene is read or refused") {
    std::string whole = test::contents(ALEMBERT_SOURCE_DIR "/tests/whole.toml");
    REQUIRE(told(whole).empty());
    const std::vector<std::string> pieces{
        "\"",  "'",  "[",   "]",     "[[",   "]]",           "{",  "}",    "=", ".", ",", "\n",  "#",     "\"\"\"",
        "'''", "\\", "nan", "1e999", "\xC3", "\xE2\x80\xAE", "0x", "true", "(", "^", "-", "\\u", "[a.b]", "\r"};
    constexpr unsigned seed = 20240301;
    std::mt19937 random(seed);
    for (int i = 0; i < 3000; ++i) {
        std::string text = whole;
        for (unsigned edits = 1 + random() % 4; edits > 0; --edits) {
            const std::size_t at = random() % text.size();
            switch (random() % 4) {
                case 0:
                    text[at] = static_cast<char>(random() % 256);
                    break;
                case 1:
                    text.erase(at, 1 + random() % 8);
                    break;
                case 2:
                    text.insert(at, pieces[random() % pieces.size()]);
                    break;
                default:
                    text.insert(at, text.substr(random() % text.size(), random() % 40));
            }
        }
        try {
            parse_scene(text, "p.toml");
        } catch (const SceneError& error) {
            CHECK_FALSE(error.diagnostics.empty());
        } catch (const std::exception& error) {
            FAIL("seed ", seed, " case ", i, ": ", error.what(), "\n", text);
        }
    }
}

}  // namespace scene_broken
