// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "stability/linear/about.hpp"

namespace alembert {

/// What is told where the start was no equilibrium and another state was taken; empty otherwise.
std::string words_of_reached(const LinearizedScene& d);

Json as_json(const LinearizedScene& near);
std::string as_text(const LinearizedScene& near, bool with_modes = false);
/// Of a motion: a row for each of its rows, t, x, c, A and B; "A(theta';theta)" is an element by its names.
std::string as_csv(const LinearizedScene& near);

}  // namespace alembert
