// SPDX-License-Identifier: MIT
#pragma once

/// Long work asks often whether it is still wanted, so that whoever waits for it can end it.
///
///     on_long_work = [] { if (was_asked_to_end) throw Ended(); };      // for this thread
///     while (…) { ask_whether_wanted(); … }
///
/// What it throws passes through all that works, so it is best no std::exception, which some of that catches.

namespace alembert {

/// Null if nobody may end the work of this thread.
inline thread_local void (*on_long_work)() = nullptr;

inline void ask_whether_wanted() {
    if (on_long_work != nullptr) on_long_work();
}

}  // namespace alembert
