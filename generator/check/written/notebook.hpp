// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The pages of Jupyter: derivations in the Markdown cells of a file of JSON.

#include <string>

namespace alembert {

/// The Markdown cells, each byte where it stands in the file and blanks in place of all else, so that places in
/// the result are places in the file. Empty if it is no notebook.
std::string cells_of_notebook(const std::string& json);

}  // namespace alembert
