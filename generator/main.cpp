// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "alembert/error.hpp"
#include "commands/help.hpp"
#include "commands/language.hpp"
#include "commands/streams.hpp"
#include "commands/terminal.hpp"
#include "commands/verb.hpp"
#include "language/libraries.hpp"
#include "language/say.hpp"

namespace {

constexpr int input_is_wrong = 3, numbers_failed = 4, environment_failed = 5;

/// Runs a verb and turns what it throws into one message and an exit code.
int guarded(const alembert::Chosen& chosen) {
    const auto complain = [](const std::string& text, int code) {
        std::cout.flush();
        std::fflush(stdout);
        const alembert::Ink ink = alembert::ink_for(STDERR_FILENO);
        std::cerr << alembert::marked_message(text, ink, ink.bad) << (text.ends_with('\n') ? "" : "\n");
        return code;
    };
    const std::string& subject = chosen.subject;
    try {
        return chosen.action();
    } catch (const alembert::SceneError& e) {
        return complain(e.what(), input_is_wrong);
    } catch (const alembert::ModelError& e) {
        return complain(fmt::format("{}: {}", subject, alembert::translated_from_library(e.what())),
                        input_is_wrong);
    } catch (const std::invalid_argument& e) {
        return complain(fmt::format("{}: {}", subject, alembert::translated_from_library(e.what())),
                        input_is_wrong);
    } catch (const alembert::IntegrationError& e) {
        return complain(fmt::format("{}: {}", subject, alembert::translated_from_library(e.what())),
                        numbers_failed);
    } catch (const alembert::CompileError& e) {
        return complain(alembert::translated_from_library(e.what()), environment_failed);
    } catch (const std::bad_alloc&) {
        return complain(alembert::say("out of memory"), environment_failed);
    } catch (const std::exception& e) {
        if (alembert::output_failed()) return environment_failed;  // told at the end
        return complain(alembert::say("{}: internal error: {}", subject, e.what()), environment_failed);
    }
}

}  // namespace

int main(int argc, char** argv) {
    alembert::guard_streams();
    std::vector<std::string> words(argv + 1, argv + argc);
    try {
        alembert::choose_language(words);
    } catch (const alembert::CompileError& e) {
        std::cerr << e.what() << "\n";
        return alembert::finished(environment_failed);
    }
    CLI::App app{alembert::say("alembert derives, proves and runs the equations of motion of mechanical systems."),
                 "alembert"};
    app.footer("alembert derive scenes/textbook/double_pendulum.toml");
    alembert::set_help(app);
    app.failure_message(alembert::failure_message);
    app.set_version_flag("--version", std::string("alembert ") + ALEMBERT_VERSION);
    app.require_subcommand(1);
    alembert::Chosen chosen;
    alembert::add_verbs(app, chosen);
    if (const std::string mistake = alembert::mistake_in(app, words); !mistake.empty()) {
        std::cerr << mistake;
        return alembert::finished(input_is_wrong);
    }
    try {
        std::reverse(words.begin(), words.end());  // the order in which CLI11 wants them
        app.parse(std::move(words));
    } catch (const CLI::ParseError& e) {
        const int code = app.exit(e);
        return alembert::finished(code == 0 ? 0 : input_is_wrong);
    }
    return alembert::finished(guarded(chosen));
}
