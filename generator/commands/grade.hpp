// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Marks the derivations of a folder, several at a time.
///
///     const Gradebook book = grade(scene, derivations_in("homework"), {});

#include <string>
#include <vector>

#include "check/derivation/marked.hpp"
#include "present/report/gradebook.hpp"

namespace alembert {

/// The files of the folder itself that end with .tex, .md or .txt, by name. Throws ModelError if there are none.
std::vector<std::string> derivations_in(const std::string& folder);

/// A row for each file, in their order. `with_pages`: whether rows have their marked derivation as HTML. GiNaC is
/// not thread-safe, so each core has a process of its own. A file at which one dies costs its own row only.
Gradebook grade(const Scene& scene, const std::vector<std::string>& files, const MarkOptions& options,
                bool with_pages);

}  // namespace alembert
