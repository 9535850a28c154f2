// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "commands/streams.hpp"

namespace alembert {

namespace {

constexpr int width = 40;
constexpr auto first_after = std::chrono::seconds(1);
constexpr auto redraw_after = std::chrono::milliseconds(100);

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), on_terminal_(isatty(STDERR_FILENO) != 0), next_(Clock::now() + first_after) {}

Progress::~Progress() {
    if (drawn_) raw_to_terminal("\r\033[K");
}

void Progress::at(double fraction) {
    // Looking at the clock costs more than a step of a small system.
    if (!on_terminal_ || ++skipped_ < 1000) return;
    skipped_ = 0;
    at_stage(fraction);
}

void Progress::at_stage(double fraction) {
    if (!on_terminal_) return;
    if (Clock::now() < next_) return;
    next_ = Clock::now() + redraw_after;
    drawn_ = true;
    fraction = std::clamp(fraction, 0.0, 1.0);
    const int full = static_cast<int>(fraction * width);
    raw_to_terminal(fmt::format("\r{} [{}{}] {:3.0f} %", what_, std::string(full, '='), std::string(width - full, ' '), 100 * fraction));
}

}  // namespace alembert
