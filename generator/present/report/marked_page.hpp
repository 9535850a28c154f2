// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A marked derivation as one HTML page that needs nothing else: typeset as written, line by line with its
/// verdict, the wrong term in colour, the right line beside it. And the pages of a class.

#include "check/derivation/marked.hpp"
#include "present/report/gradebook.hpp"

namespace alembert {

struct MarkedPageOptions {
    std::string title = {};    ///< of the scene
    std::string version = {};  ///< of the program
};

std::string as_html(const Marked& marked, const MarkedPageOptions& options = {});

/// The part of the page between the headings: for pages of several derivations.
std::string marked_fragment(const Marked& marked);

std::string as_html(const Gradebook& book, const MarkedPageOptions& options = {});

}  // namespace alembert
