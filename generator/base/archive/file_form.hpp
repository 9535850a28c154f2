// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a file holds, and the names that it may have: a picture called x.png that holds SVG opens nowhere.
///
///     need_form("motion.svg", FileForm::picture);      // before the work begins
///
/// A name without an ending is right for everything, and so are devices. A table may have any ending that names no
/// other format (run.dat), everything else only its own.

#include <string>

namespace alembert {

enum class FileForm {
    picture,  ///< SVG
    page,     ///< HTML
    scene,    ///< TOML
    json,     ///< one JSON object
    unit,     ///< a functional mock-up unit; other tools know it by its ending, which it needs
    csv,      ///< a table as CSV
    table     ///< a table as CSV, or by its ending for NumPy (.npz) or HDF5 (.h5, .hdf5)
};

/// The ending in small letters, with its dot; empty if there is none.
std::string ending_of(const std::string& path);

/// Throws ModelError if the name of the file promises another format. An empty path names no file.
void need_form(const std::string& path, FileForm form);

}  // namespace alembert
