// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The page of a scene: one HTML file that needs no network, no script from elsewhere and no font.
///
///     write_file("page.html", as_html(overview(scene), {.commands = {"alembert derive pendulum.toml"}}));
///
/// Nothing in the scene can become markup or script there: all its text is escaped (html.hpp), and the page's
/// Content-Security-Policy names its own script and style by their hashes and allows nothing else.

#include "present/overview/overview.hpp"

namespace alembert {

struct ScenePageOptions {
    std::string version = {};
    std::string by = {};          ///< the requested formalism
    std::string derivation = {};  ///< a marked derivation in HTML (marked_page.hpp); empty for none
};

std::string as_html(const Overview& overview, const ScenePageOptions& options = {});

/// The head of a page and the beginning of its body, with the style and, if it has one, the script allowed by
/// hash, and further scripts.
std::string page_head(const std::string& title, bool has_script, const std::vector<std::string>& more = {});

/// The page of a scene that cannot be read.
std::string error_page(const std::string& file, const std::string& message);

}  // namespace alembert
