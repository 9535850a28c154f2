// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The language of what people read: English, or Chinese.

#include <string>
#include <string_view>
#include <vector>

namespace alembert {

/// The bytes of po/zh.po as msgfmt compiles it (cmake/catalogue.cmake); empty if there was no msgfmt.
extern const std::string_view chinese_catalogue;

/// Chooses the language by `--language en` or `--language zh`, which are removed from the words of the command
/// line, or by the environment: LANGUAGE, LC_ALL, LC_MESSAGES, LANG. What is printed as JSON is English. Throws
/// CompileError if --language asks for Chinese and the program was built without it.
void choose_language(std::vector<std::string>& words);

}  // namespace alembert
