// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The sections of a scene's page. Each adds its markup to the page, and the data that the script needs.

#include "present/overview/overview.hpp"
#include "present/report/html.hpp"
#include "present/report/page.hpp"

namespace alembert {

/// Whether a section is a fold that a reader opens, or stands there at once.
enum class Fold { closed, open, never };

struct PageParts {
    std::string body = {};
    Json data = Json::object();
    std::vector<std::string> scripts = {};                           ///< before that of all pages
    std::vector<std::pair<std::string, std::string>> contents = {};  ///< id and heading of each section

    /// Begins a section with its heading.
    void section(const std::string& id, const std::string& heading, Fold fold = Fold::closed);
    void end();
    /// Adds a button that copies the text.
    void copy(const std::string& what, const std::string& text);
    /// Adds the reason why a part is missing.
    void problem(const std::string& message);

private:
    bool in_fold_ = false;
};

/// A table of cells in HTML, the first of each row as its heading; columns in which nothing stands are left out.
void add_table(std::string& body, const std::string& caption, const std::vector<std::string>& columns,
               const std::vector<std::vector<std::string>>& rows);

/// A fold with the state at which a claim fails.
void add_failing_state(std::string& body, const CheckedClaim& claim);

/// Begins a table, whose rows follow, with a heading for each column.
void begin_table(std::string& body, const std::string& caption, const std::vector<std::string>& columns);

/// "m^2" as m².
std::string unit_text(std::string unit);

void add_figure(PageParts& page, const Overview& all);
/// The sliders of a figure that has so many points, or why there are none. There must be a motion with poses.
void add_live(PageParts& page, const Overview& all, std::size_t points);
void add_mechanism(PageParts& page, const Overview& all);
void add_badges(PageParts& page, const Overview& all);
void add_equations(PageParts& page, const Overview& all);
void add_derivation(PageParts& page, const Overview& all);
void add_claims(PageParts& page, const Overview& all);
void add_agreement(PageParts& page, const Overview& all);
void add_constraints(PageParts& page, const Overview& all);
void add_plots(PageParts& page, const Overview& all);
void add_section_of_poincare(PageParts& page, const Overview& all);
void add_stability(PageParts& page, const Overview& all);
void add_bench(PageParts& page, const Overview& all);
void add_motion(PageParts& page, const Overview& all);
void add_code(PageParts& page, const Overview& all);
void add_commands(PageParts& page, const Overview& all, const std::string& by);

}  // namespace alembert
