// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A table as an HDF5 file, where the program was built with HDF5.
///
///     need_hdf5();                       // throws CompileError with what to install
///     const std::string bytes = as_hdf5(table);
///
/// Each column is a data set of its name with the attribute `unit`; the file itself has the attributes `columns`
/// (the names in their order) and the texts of the table. The library is not loaded before it is needed: it is
/// linked to alembert-hdf5.so, which stands beside the program.

#include <string>

#include "base/archive/stored_table.hpp"

namespace alembert {

void need_hdf5();

/// The same table gives the same bytes. Throws CompileError as need_hdf5, and if HDF5 reports an error.
std::string as_hdf5(const StoredTable& table);

}  // namespace alembert

/// What alembert-hdf5.so exports; false if HDF5 reports an error.
extern "C" bool alembert_hdf5(const alembert::StoredTable& table, std::string& bytes);
