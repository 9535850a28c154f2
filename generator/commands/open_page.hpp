// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Shows a page that was written to the person who asked for it.

#include <string>

namespace alembert {

/// Starts xdg-open on the file, and does not wait for it: only where standard output is a terminal, there is a
/// display (DISPLAY or WAYLAND_DISPLAY is set) and the program is there. Otherwise it does nothing. No shell is
/// used.
void open_page(const std::string& file);

}  // namespace alembert
