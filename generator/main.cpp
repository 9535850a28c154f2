// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/command_line.hpp"
#include "commands/streams.hpp"

int main(int argc, char** argv) {
    alembert::guard_streams();
    return alembert::finished(alembert::command_line({argv + 1, argv + argc}));
}
