// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes the files that a user requests (-o, --csv, --svg).

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/archive/file_form.hpp"

namespace alembert {

/// To be called before the work begins. Throws what write_file would throw for this path now, as far as that can
/// be found out without writing. An empty path means that no file is requested. `inputs` are files that were read,
/// which no output may overwrite; empty names are ignored.
void check_output(const std::string& path, const std::vector<std::string>& inputs);
/// The same, and a check of the name by what the file will hold (base/archive/file_form.hpp).
void check_output(const std::string& path, FileForm form, const std::vector<std::string>& inputs);

/// Writes the text to the file of that name. An ordinary file is written under a temporary name in the same folder
/// and renamed, so that it is there as a whole or not at all. It keeps the mode of the file that it replaces; if
/// the name is a symbolic link, the target is replaced. Devices, pipes and /dev/stdout are written directly.
/// Throws ModelError (the input is wrong) if the file is one of `inputs`, under any name; CompileError (the
/// environment failed) with the reason if it cannot be written, or is read-only by its mode.
void write_file(const std::string& path, const std::string& text, const std::vector<std::string>& inputs);

/// The same piece by piece, for what is larger than memory: `produce` gives each piece to its argument.
using PieceTaker = std::function<void(std::string_view)>;
void write_file(const std::string& path, const std::function<void(const PieceTaker&)>& produce,
                const std::vector<std::string>& inputs);

/// Is the path that of an ordinary file, or of none yet?
bool is_ordinary_file(const std::string& path);

}  // namespace alembert
