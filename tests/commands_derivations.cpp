// SPDX-License-Identifier: GPL-2.0-or-later
// What `derive --steps --format latex` prints is read by the reader of hand derivations without a statement that
// is not understood.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "derivation/written/read.hpp"
#include "program.hpp"

namespace {

const std::vector<std::string> formalisms = {
    "lagrange", "lagrange1",           "routh",     "kane",     "dalembert", "nielsen", "schiehlen",
    "hamilton", "roberson-wittenburg", "recursive", "routhian", "appell",    "maggi"};

/// What is printed for the scene; empty if the formalism does not treat it.
std::string printed_steps(const std::string& scene, const std::string& formalism) {
    std::vector<std::string> args = {"derive", scene, "--steps", "--format", "latex"};
    if (!formalism.empty()) args.insert(args.end(), {"--by", formalism});
    const alembert::test::Run run = alembert::test::run(args);
    if (formalism.empty()) CHECK(run.exit == 0);
    return run.exit == 0 ? run.out : "";
}

void check_is_understood(const std::string& text) {
    const alembert::Written written = alembert::read_derivation(text, "steps.tex");
    CHECK(written.statements.size() > 1);
    for (const alembert::WrittenStatement& one : written.statements) {
        CAPTURE(text.substr(one.offset, 200));
        CHECK(one.reason == "");
    }
}

}  // namespace

TEST_CASE(
    "commands: the steps of a derivation in LaTeX are read back, by the formalism of choice and by one other") {
    std::vector<std::string> scenes;
    for (const auto& entry : std::filesystem::directory_iterator(ALEMBERT_SOURCE_DIR "/scenes/textbook"))
        if (entry.path().extension() == ".toml") scenes.push_back(entry.path().string());
    std::sort(scenes.begin(), scenes.end());
    REQUIRE(scenes.size() > 50);
    std::size_t by_others = 0;
    for (std::size_t k = 0; k < scenes.size(); ++k) {
        CAPTURE(scenes[k]);
        check_is_understood(printed_steps(scenes[k], ""));
        const std::string other = printed_steps(scenes[k], formalisms[k % formalisms.size()]);
        if (other.empty()) continue;
        check_is_understood(other);
        ++by_others;
    }
    CHECK(by_others > 50);
}
