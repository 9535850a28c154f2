// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The table of a run or a sweep as the bytes of a file, in the form that the name of the file asks for: `.npz`
/// for NumPy, else CSV.
///
///     write_file("run.npz", table_file(run, "run.npz"), {});

#include "archive/stored_table.hpp"
#include "run/simulate.hpp"
#include "run/sweep.hpp"

namespace alembert {

std::string table_file(const Run& run, const std::string& path);
std::string table_file(const Sweep& sweep, const std::string& path);

/// The columns of the CSV with their units, the scene's text (`scene`) and the version of the program (`version`).
StoredTable stored(const Run& run);
StoredTable stored(const Sweep& sweep);

}  // namespace alembert
