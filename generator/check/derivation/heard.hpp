// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the words of a derivation have said so far: of rest, of small motions, under a condition, from a start at
/// rest. What a sentence says holds for its formulas; some of it until the words turn to something else.
///
///     Heard heard;
///     heard.take_in(written, statement);        // the words before the statement, and those behind it
///     heard.rest                                // "in equilibrium"
///     heard.condition_lines > 0                 // "if the wedge is held, …"
///
/// Lines may add to it: θ' = 0 speaks of rest as well as words do.

#include <string>

#include "check/written/read.hpp"

namespace alembert {

struct Heard {
    void take_in(const Written& written, const WrittenStatement& statement);
    void put_under_condition() { condition_lines = lines_of_condition; }

    std::string behind;  ///< the words behind the statement
    std::string around;  ///< with those before it

    // of this sentence
    bool goes_on = false;           ///< the words only join two formulas of one sentence
    bool rest = false;              ///< "at rest we have"
    bool roots = false;             ///< "with the roots"
    bool no_accelerations = false;  ///< "where q'' = 0"
    bool frequency = false, period = false;
    bool abbreviations = false;     ///< letters are introduced
    bool condition_behind = false;  ///< the formula is followed by "at y = −l"

    // until the words turn to something else
    bool small = false;         ///< whether the derivation has begun to linearize
    bool assumed_rest = false;  ///< words or lines speak of rest, until a line has rates
    bool impact = false;        ///< "after the impact"
    int condition_lines = 0;    ///< how many lines the condition that the words state may govern
    int approximate_lines = 0;  ///< how many lines the words "neglecting …" may govern
    int steady_lines = 0;       ///< how many lines what the words say of steady motion may govern

    // from then on
    bool mentioned_impact = false;
    bool start_from_rest = false;
    bool axes = false;          ///< the author has laid axes of his own
    bool turning_axes = false;  ///< and these turn
    bool energy_of_accelerations = false;

private:
    static constexpr int lines_of_condition = 3;  ///< a display ends a sentence without a full stop
    void take_in_sentence(const std::string& words, bool displayed);
    void take_in_conditions(const std::string& words, bool is_limit);
    void take_in_approximation(const std::string& words);
    void take_in_steady_motion(const std::string& words);
};

}  // namespace alembert
