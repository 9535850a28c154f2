// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The table of a run or a sweep as the bytes of a file, in the form that the name of the file asks for: `.npz`
/// for NumPy, `.h5` or `.hdf5` for HDF5, else CSV.
///
///     need_table_form("run.h5");                            // before the work begins
///     write_file("run.npz", table_file(run, "run.npz"), {});

#include <functional>
#include <string_view>

#include "base/archive/stored_table.hpp"
#include "simulate/simulate.hpp"
#include "simulate/sweep_job.hpp"

namespace alembert {

/// Throws CompileError if the form is HDF5 and the program was built without it, ModelError if the name promises a
/// form in which no table is written (base/archive/file_form.hpp).
void need_table_form(const std::string& path);

std::string table_file(const Run& run, const std::string& path);
/// `rows` gives the motions, some at a time, to its argument. Not for CSV.
using MotionsOf = std::function<void(const std::function<void(const std::vector<SweptMotion>&)>&)>;
std::string table_file(const Sweep& sweep, const MotionsOf& rows, const std::string& path);
std::string table_file(const Sweep& sweep, const SweepReduction& reduction, const std::string& path);

/// The table of a job that is done, statistics if it was reduced, piece by piece: a CSV need not fit into memory.
void put_table(SweepJob& job, const std::string& path, const std::function<void(std::string_view)>& put);

/// The columns of the CSV with their units, the scene's text (`scene`) and the version of the program (`version`).
StoredTable stored(const Run& run);
StoredTable stored(const Sweep& sweep, const MotionsOf& rows);

}  // namespace alembert
