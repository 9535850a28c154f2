// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/show.hpp"

#include <iostream>

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

void warn(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) std::cerr << warning;
}

}  // namespace alembert
