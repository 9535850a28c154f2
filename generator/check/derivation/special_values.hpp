// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values of parameters that a derivation states as it goes on: c = 0, k_1 = k_2, m = 2 kg.
///
///     SpecialValues special;
///     special.hear("Without damping, ");                  // in general would end all cases
///     special.state(c, 0, SpecialValues::From::words);
///     for (const GiNaC::exmap* values : special.cases())  // all that was stated; that of the last sentence alone
///
/// A value holds on, until the words turn to the general case; whether it is still meant is another matter:
/// `is_over` after the sentence that states it, numbers of data excepted.

#include <ginac/ginac.h>

#include <string>
#include <vector>

namespace alembert {

class SpecialValues {
public:
    /// What says a value: a line that states nothing else, or words and conditions that stand before a line.
    enum class From { line, words };

    /// The words before a statement, and then, once their own values are stated, where their sentences end.
    void hear(const std::string& words);
    void hear_end(const std::string& words);
    /// The values stay in letters that have none: c_1 = c_2, then c_2 = 0.
    void state(const GiNaC::ex& name, const GiNaC::ex& value, From from);
    /// The words or a line have just stated a case that holds for the lines to come.
    void open() { is_settled_ = false; }
    /// A line has been judged.
    void pass_line();

    bool empty() const { return all_.empty(); }
    bool contains(const GiNaC::ex& name) const { return all_.contains(name); }
    const GiNaC::exmap& all() const { return all_; }
    /// All values; those of the last sentence or item of a list, where these are others.
    std::vector<const GiNaC::exmap*> cases() const;
    /// Whether they were stated for a line with these words before it: in its sentence, or by the line just before
    /// it, with words that only go on between them. Numbers that were given, k = 40 N/m, hold for the page.
    bool is_fresh(const std::string& words) const;
    /// Whether they may be meant no longer, before a line with these words.
    bool is_over(const std::string& words) const;

private:
    bool are_data() const;

    GiNaC::exmap all_, sentence_;
    int lines_since_ = 0;
    bool states_now_ = false;  ///< whether the line that is judged has stated one
    bool begins_case_ = true;  ///< whether a sentence or an item of a list has begun since the last of them
    bool is_settled_ = false;  ///< whether a sentence has ended since
};

}  // namespace alembert
