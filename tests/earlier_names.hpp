// SPDX-License-Identifier: MIT
#pragma once

/// The verbs that are options of other verbs now, or of the program (docs/commands.md, "Earlier names").

namespace alembert::test {

struct EarlierVerb {
    const char *name, *verb, *option;  ///< "inverse" is "eval" with "--inverse"; an empty verb: of the program
};

inline constexpr EarlierVerb earlier_verbs[] = {{"agree", "check", "--formalisms"},
                                                {"kinematics", "eval", "--kinematics"},
                                                {"inertia", "eval", "--inertia"},
                                                {"identify", "eval", "--identify"},
                                                {"inverse", "eval", "--inverse"},
                                                {"impact", "eval", "--impact"},
                                                {"linearize", "stability", "--matrices"},
                                                {"fmu", "emit", "--fmu"},
                                                {"watch", "report", "--watch"},
                                                {"completion", "", "--completion"},
                                                {"man", "", "--man"}};

}  // namespace alembert::test
