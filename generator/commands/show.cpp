// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/show.hpp"

#include <unistd.h>

#include <iostream>

#include "commands/terminal.hpp"
#include "present/report/fold.hpp"
#include "present/report/wrap.hpp"

namespace alembert {

namespace {

/// What was warned of so far.
std::vector<Diagnostic>& told() {
    static std::vector<Diagnostic> list;
    return list;
}

Json as_json(const std::vector<Diagnostic>& warnings) {
    Json list = Json::array();
    for (const Diagnostic& one : warnings) {
        Json entry = {{"kind", one.kind}, {"message", one.message}};
        entry["line"] = one.place.line > 0 ? Json(one.place.line) : Json();
        entry["name"] = one.name.empty() ? Json() : Json(one.name);
        list.push_back(std::move(entry));
    }
    return list;
}

}  // namespace

bool& are_warnings_errors() {
    static bool strict = false;
    return strict;
}

std::string shown(const Json& result) {
    Json whole = result;
    if (whole.is_object() && !whole.contains("warnings")) whole["warnings"] = as_json(told());
    return whole.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void show(const Json& result) {
    std::cout << shown(result);
}

void show(const std::string& text) {
    std::cout << text;
}

Scene scene_of(const std::string& file) {
    Scene scene = read_scene(file);
    scene.on_warning = [](const Warning& warning) {
        if (are_warnings_errors()) throw SceneError(warning.text, warning.parts);
        warn({warning.text});
        told().insert(told().end(), warning.parts.begin(), warning.parts.end());
    };
    return scene;
}

void show_formulas(const std::string& text) {
    const std::optional<int> columns = columns_of(STDOUT_FILENO);
    show(columns ? wrapped(text, *columns) : text);
}

void show_page(const std::string& text, bool full) {
    show_formulas(full ? text : folded(text));
}

void warn(const std::vector<std::string>& warnings) {
    const Ink ink = ink_for(STDERR_FILENO);
    for (const std::string& warning : warnings) std::cerr << marked_message(warning, ink, ink.unsure);
}

}  // namespace alembert
