// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which options of a verb go together: the one table of options that would have no effect beside another one, or
/// without it. What depends on the scene or on the method is said where these are known.
///
///     tie_options(app);            // after all verbs have been added
///     // CLI11 then refuses, in the words of help_mistakes.hpp.

namespace CLI {
class App;
}

namespace alembert {

void tie_options(CLI::App& app);

}  // namespace alembert
