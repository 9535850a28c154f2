// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/progress.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <tuple>

#include "commands/streams.hpp"

namespace alembert {

namespace {

constexpr int bar_width = 40;
constexpr auto first_after = std::chrono::seconds(1);
constexpr auto redraw_after = std::chrono::milliseconds(100);

}  // namespace

Progress::Progress(bool is_shared) : on_terminal_(isatty(STDERR_FILENO) != 0), next_(Clock::now() + first_after) {
    if (on_terminal_ || !is_shared) return;
    terminal_ = open("/dev/tty", O_WRONLY | O_NOCTTY | O_CLOEXEC);
    on_terminal_ = terminal_ >= 0;
}

Progress::~Progress() {
    wipe();
    if (terminal_ >= 0) close(terminal_);
}

void Progress::write(const std::string& text) const {
    if (terminal_ < 0) return raw_to_terminal(text);
    std::ignore = ::write(terminal_, text.data(), text.size());
}

void Progress::wipe() {
    if (drawn_) write("\r\033[K");
    drawn_ = false;
}

void Progress::at(std::string_view what, double part) {
    if (!on_terminal_ || Clock::now() < next_) return;
    next_ = Clock::now() + redraw_after;
    drawn_ = true;
    part = std::clamp(part, 0.0, 1.0);
    const int full = static_cast<int>(part * bar_width);
    write(fmt::format("\r\033[K{} [{}{}] {:3.0f} %", what, std::string(full, '='),
                      std::string(bar_width - full, ' '), 100 * part));
}

}  // namespace alembert
