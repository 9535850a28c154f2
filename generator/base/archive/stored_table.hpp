// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A table for other people's programs, and its file as NumPy reads it.
///
///     const StoredTable table{.columns = {{"t", "s", {0.0, 0.1}}, {"theta", "rad", {1.0, 0.9}}}, .texts = {}};
///     as_npz(table);                       // numpy.load(...)["theta"] is an array of two numbers
///
/// Besides an array for each column the file has `columns` (the names in their order), `units` (of each, empty
/// where none is known) and the texts. Where a column has one of these names, they end in `_`.

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace alembert {

struct StoredColumn {
    std::string name, unit;
    /// All columns of a table are equally long.
    std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>> values;
};

struct StoredTable {
    std::vector<StoredColumn> columns;
    std::vector<std::pair<std::string, std::string>> texts;  ///< what holds for the whole: scene, version …
};

/// The names that `columns`, `units` and the texts get, in this order.
std::vector<std::string> names_beside_columns(const StoredTable& table);

/// The bytes of an .npz file, without compression (NumPy Enhancement Proposal 1, version 1.0 of the format). The
/// same table gives the same bytes.
std::string as_npz(const StoredTable& table);

}  // namespace alembert
