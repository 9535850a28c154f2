// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A progress bar on standard error for work that takes longer than a second; only on a terminal.
///
///     Progress progress("integrating");
///     progress.at(0.3);              // as often as you like
///
/// The bar is wiped when it goes out of scope.

#include <chrono>
#include <string>

namespace alembert {

class Progress {
public:
    explicit Progress(std::string what);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void at(double fraction);
    void at_stage(double fraction);  ///< where it is not called in every step: looks at the clock each time

private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    bool on_terminal_, drawn_ = false;
    Clock::time_point next_;
    int skipped_ = 0;
};

}  // namespace alembert
