// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A class at once: a row for each derivation, and how often each slip occurs.
///
///     Gradebook book;
///     book.rows.push_back(graded(marked));
///     as_csv(book);

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "check/derivation/marked.hpp"
#include "present/report/ink.hpp"
#include "present/report/json.hpp"

namespace alembert {

struct GradedRow {
    std::string file;
    std::optional<int> first_mistake;  ///< its line in the file
    std::string kind;                  ///< of the slip there
    std::size_t right = 0, mistakes = 0, follows = 0, open = 0;
    std::vector<std::string> missing;
    std::vector<std::string> kinds;  ///< of all mistakes
    std::string problem;             ///< why the file could not be read; empty if it was
    std::string page;                ///< its marked derivation in HTML (marked_page.hpp)
};

struct Gradebook {
    std::vector<GradedRow> rows;
    /// Slip → in how many derivations, the most frequent first.
    std::vector<std::pair<std::string, std::size_t>> slips() const;
};

/// Without its page.
GradedRow graded(const Marked& marked);

/// Both ways, for processes that share the work.
Json to_json(const GradedRow& row);
GradedRow row_from(const Json& json);

std::string as_csv(const Gradebook& book);
Json as_json(const Gradebook& book);
std::string as_text(const Gradebook& book, const Ink& ink = {});

}  // namespace alembert
