// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verbs of the program as functions from the text of a scene, and options in JSON, to a value in JSON.
///
///     const Answer found = answer_of("stability", text, "top.toml", R"({"at": ["omega=3"]})", {});
///     found.json["verdict"], found.text;
///
/// JSON keeps the interface to Python small: a verb is a row of a table and not a function with its own arguments.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "present/report/json.hpp"
#include "simulate/rows.hpp"

namespace alembert {

struct Answer {
    Json json;
    std::string text = {};  ///< the page that the program prints
    std::vector<std::string> warnings = {};
    std::map<std::string, std::string> files = {};  ///< by name: pictures, sources, pages
    MotionTable table = {};                         ///< of a sweep
};

/// The form of a callback that is told of progress; it may throw to end the work.
using ToldProgress = std::function<void(std::string_view what, double part)>;

/// Options have the names of the command's; `at` is a list of NAME=VALUE. Throws what the verb throws, and
/// std::invalid_argument for an unknown verb or an option that is not of its type.
Answer answer_of(const std::string& verb, const std::string& text, const std::string& file,
                 const std::string& options, const ToldProgress& progress);

}  // namespace alembert
