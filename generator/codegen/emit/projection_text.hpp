// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// C for programs that integrate the emitted equations: the projection on the constraints that `simulate` uses,
/// also near singular poses, and the balance of energy. The main program beside a file and the functional mock-up
/// unit have the same text.
///
///     projection_text(program, CodeLanguage::c);

#include <string>

#include "codegen/emit/statement.hpp"
#include "program/program.hpp"

namespace alembert {

struct ProjectionParts {
    bool watches_energy = true;  ///< whether the balance of energy is wanted, if the program has energies
    std::size_t contacts = 0;    ///< of a unit: each has a row in the function contacts_at
    std::size_t responses = 0;   ///< to how many impulses rates are asked for at once, at most
};

/// The text expects the constants n, speeds and constraints, the emitted functions, and <float.h>, <math.h>,
/// <string.h>; with contacts also the constants contacts and first_contact_force. The templates are
/// templates/projection.c.mustache and templates/contacts.c.mustache.
std::string projection_text(const Program& program, CodeLanguage language, const ProjectionParts& parts = {});

/// In such text the number of rows that constraints_at gives: `constraints`, or more where some follow from these.
std::string all_constraints(const Program& program);

}  // namespace alembert
