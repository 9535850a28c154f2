// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace alembert {

/// Along which axes a recursion takes its components.
enum class LinkAxes {
    own,   ///< those that turn with each link
    still  ///< those that do not turn within a chain of parallel ones
};

}  // namespace alembert
