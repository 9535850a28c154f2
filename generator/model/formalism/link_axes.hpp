// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace alembert {

/// The axes along which a recursion takes its components.
enum class LinkAxes {
    own,   ///< axes that turn with each link
    still  ///< in a chain of parallel axes, axes that do not turn
};

}  // namespace alembert
