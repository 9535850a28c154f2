// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The file for the table of a sweep, and the one beside it for what is done (simulate/sweep_job.hpp). The command
/// and Python store tables with these.
///
///     check_sweep_table("t.csv", resume, {"scene.toml"});                     // before the work begins
///     SweepJob job({.scene = …, .journal = journal_beside("t.csv"), .resume = resume});
///     …
///     write_sweep_table(job, "t.csv", {"scene.toml"});

#include "simulate/sweep_job.hpp"

namespace alembert {

/// What could only fail at the end. An empty path means that no table is stored. Throws what check_output and
/// need_table_form throw; ModelError if a sweep cannot go on without an ordinary file.
void check_sweep_table(const std::string& path, bool resume, const std::vector<std::string>& inputs);

/// FILE.unfinished; empty where the path is none of an ordinary file, such as a pipe.
std::string journal_beside(const std::string& path);

/// Throws what write_file throws.
void write_sweep_table(SweepJob& job, const std::string& path, const std::vector<std::string>& inputs);

}  // namespace alembert
