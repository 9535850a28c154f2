// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The command that makes a file, for the file's head: without folders, so that the same scene gives the same
/// bytes wherever it stands.
///
///     EmitCommand command("scenes/my arm.toml");
///     command.add("-o", ".");
///     command.flag("--fold", true);
///     command.text;                                  // "alembert emit 'my arm.toml' -o . --fold"

#include <filesystem>
#include <string>
#include <string_view>

namespace alembert {

/// The word as a shell has to be given it.
inline std::string shell_word(const std::string& word) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./,@:+=-";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string quoted = "'";
    for (const char c : word)
        if (c == '\'')
            quoted += "'\"'\"'";  // comments have no backslashes
        else
            quoted += c;
    return quoted + "'";
}

struct EmitCommand {
    std::string text;

    explicit EmitCommand(const std::string& scene_file) {
        const std::string file = std::filesystem::path(scene_file).filename().string();
        text = "alembert emit " + shell_word(file.starts_with('-') ? "./" + file : file);
    }
    /// Nothing if there is no value.
    void add(const char* name, const std::string& value) {
        if (!value.empty()) text += std::string(" ") + name + " " + shell_word(value);
    }
    void flag(const char* name, bool is_given) {
        if (is_given) text += std::string(" ") + name;
    }
};

}  // namespace alembert
