// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A progress bar on standard error for work that takes longer than a second; only on a terminal.
///
///     Progress progress;
///     progress.at("integrating", 0.3);              // as often as you like: it looks at the clock
///
/// Of processes that share a sweep, the first one shows the bar of all. A launcher takes its standard error, so
/// that it writes to the terminal of the session, if there is one.
///
/// The bar is erased when the object goes out of scope.

#include <chrono>
#include <string>
#include <string_view>

namespace alembert {

class Progress {
public:
    explicit Progress(bool is_shared = false);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Sets the current task and the part of it that is done, from 0 to 1.
    void at(std::string_view what, double part);

    /// To be called before something else is printed.
    void wipe();

private:
    using Clock = std::chrono::steady_clock;
    void write(const std::string& text) const;
    bool on_terminal_, drawn_ = false;
    int terminal_ = -1;  ///< a descriptor of its own; negative for standard error
    Clock::time_point next_;
};

}  // namespace alembert
