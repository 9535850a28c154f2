// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/command_line.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "alembert/base/error.hpp"
#include "algebra/symbolic/number_mistake.hpp"
#include "base/language/libraries.hpp"
#include "base/language/say.hpp"
#include "commands/help.hpp"
#include "commands/help_mistakes.hpp"
#include "commands/language.hpp"
#include "commands/modes.hpp"
#include "commands/streams.hpp"
#include "commands/terminal.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

constexpr int input_is_wrong = 3, numbers_failed = 4, environment_failed = 5;

/// Runs a verb and turns what it throws into one message and an exit code.
int guarded(const Chosen& chosen) {
    const auto complain = [](const std::string& text, int code) {
        std::cout.flush();
        std::fflush(stdout);
        const Ink ink = ink_for(STDERR_FILENO);
        std::cerr << marked_message(text, ink, ink.bad) << (text.ends_with('\n') ? "" : "\n");
        return code;
    };
    const std::string& subject = chosen.subject;
    const auto of_subject = [&](const std::exception& e) {
        return fmt::format("{}: {}", subject, translated_from_library(e.what()));
    };
    try {
        return chosen.action();
    } catch (const SceneError& e) {
        return complain(e.what(), input_is_wrong);
    } catch (const ModelError& e) {
        return complain(of_subject(e), input_is_wrong);
    } catch (const std::invalid_argument& e) {
        return complain(of_subject(e), input_is_wrong);
    } catch (const IntegrationError& e) {
        return complain(of_subject(e), numbers_failed);
    } catch (const CompileError& e) {
        return complain(translated_from_library(e.what()), environment_failed);
    } catch (const std::bad_alloc&) {
        return complain(say("out of memory"), environment_failed);
    } catch (const std::exception& e) {
        if (output_failed()) return environment_failed;  // told at the end
        if (const auto why = number_mistake(e))
            return complain(
                say("{}: {} in what follows from the values of the scene; give other values", subject, *why),
                numbers_failed);
        return complain(say("{}: internal error: {}", subject, e.what()), environment_failed);
    }
}

/// What is short for something else: a scene alone for its page, `help VERB`, an option for what was a verb.
void spell_out(std::vector<std::string>& words) {
    if (!words.empty() && words[0] == "help") {
        words.erase(words.begin());
        words.push_back("--help");
    }
    if (words.empty()) words.push_back("--help");
    if (words[0].ends_with(".toml")) words.insert(words.begin(), {"report", "--open"});
    choose_mode(words);
}

}  // namespace

int command_line(std::vector<std::string> words) {
    try {
        choose_language(words);
    } catch (const CompileError& e) {
        std::cerr << e.what() << "\n";
        return environment_failed;
    }
    CLI::App app{say("alembert derives, proves and runs the equations of motion of mechanical systems."),
                 "alembert"};
    app.footer("alembert derive scenes/textbook/double_pendulum.toml");
    set_help(app);
    app.failure_message(failure_message);
    app.set_version_flag("--version", std::string("alembert ") + ALEMBERT_VERSION);
    app.require_subcommand(1);
    Chosen chosen;
    add_verbs(app, chosen);
    spell_out(words);
    if (const std::string mistake = mistake_in(app, words); !mistake.empty()) {
        std::cerr << mistake;
        return input_is_wrong;
    }
    try {
        std::reverse(words.begin(), words.end());  // the order in which CLI11 wants them
        app.parse(std::move(words));
    } catch (const CLI::ParseError& e) {
        const int code = app.exit(e);
        return code == 0 ? 0 : input_is_wrong;
    }
    return guarded(chosen);
}

}  // namespace alembert
