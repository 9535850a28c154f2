// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Files that a user asked for (-o, --csv, --svg).

#include <string>
#include <vector>

namespace alembert {

/// Before the work begins: throws what write_file would throw for this path now, as far as it can be seen without
/// writing. An empty path is no wish, and good. `inputs`: files that were read, which no output may overwrite;
/// empty names are none.
void check_output(const std::string& path, const std::vector<std::string>& inputs);

/// Writes the text to the file of that name. An ordinary file is written beside its place and renamed, so that it
/// is there as a whole or not at all, and keeps the mode of the file that it replaces; of a symbolic link the
/// target is replaced. Devices, pipes and /dev/stdout are written to as they are. Throws ModelError (the input is
/// wrong) if it is one of `inputs`, by whichever name; CompileError (the environment failed) with the
/// reason if it cannot be written, or is read-only by its mode.
void write_file(const std::string& path, const std::string& text, const std::vector<std::string>& inputs);

}  // namespace alembert
