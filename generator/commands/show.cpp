// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/show.hpp"

#include <unistd.h>

#include <iostream>

#include "commands/terminal.hpp"
#include "report/wrap.hpp"

namespace alembert {

void show(const Json& result) {
    std::cout << result.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

void show(const std::string& text) {
    std::cout << text;
}

Scene scene_of(const std::string& file) {
    Scene scene = read_scene(file);
    scene.on_warning = [](const std::string& warning) { warn({warning}); };
    return scene;
}

void show_formulas(const std::string& text) {
    const std::optional<int> columns = columns_of(STDOUT_FILENO);
    show(columns ? wrapped(text, *columns) : text);
}

void warn(const std::vector<std::string>& warnings) {
    const Ink ink = ink_for(STDERR_FILENO);
    for (const std::string& warning : warnings) std::cerr << marked_message(warning, ink, ink.unsure);
}

}  // namespace alembert
