// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace alembert {

namespace {

constexpr int usual_columns = 80;

bool has_colours(int descriptor) {
    const char* const forbidden = std::getenv("NO_COLOR");
    const char* const kind = std::getenv("TERM");
    return isatty(descriptor) != 0 && (forbidden == nullptr || *forbidden == '\0') &&
           (kind == nullptr || std::string_view(kind) != "dumb");
}

bool is_caret(std::string_view line) {
    const std::size_t at = line.find_first_not_of(' ');
    return at != std::string_view::npos && line.substr(at) == "^";
}

}  // namespace

std::string_view colour_of(char letter) {
    switch (letter) {
        case 'g':
            return "\033[32m";
        case 'b':
            return "\033[1;31m";
        case 'u':
            return "\033[33m";
        case 's':
            return "\033[1m";
        case 'e':
            return "\033[0m";
        default:
            return {};
    }
}

Ink ink_for(int descriptor) {
    return has_colours(descriptor) ? marking_ink() : Ink{};
}

std::optional<int> columns_of(int descriptor) {
    if (isatty(descriptor) == 0) return {};
    winsize size{};
    return ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual_columns;
}

std::string marked_message(const std::string& message, const Ink& ink, const std::string& tone) {
    std::string result;
    std::string_view rest = message;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, end);
        const std::size_t place = line.starts_with(' ') ? line.npos : line.find(": ");
        if (is_caret(line))
            result += tone + std::string(line) + ink.end;
        else if (place != line.npos)
            result += ink.strong + std::string(line.substr(0, place + 1)) + ink.end +
                      std::string(line.substr(place + 1));
        else
            result += line;
        if (end < rest.size()) result += '\n';
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return result;
}

}  // namespace alembert
