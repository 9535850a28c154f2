// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The whole library in one header: a scene, its equations, what can be asked of them, and its motion. Each verb
/// of the command line is a function here. docs/cpp.md describes it with examples.

#include "alembert/runtime.hpp"
#include "check/check.hpp"
#include "derive/derive.hpp"
#include "emit/emit.hpp"
#include "equilibrium/equilibria.hpp"
#include "kinematics/kinematics.hpp"
#include "linear/about.hpp"
#include "lower/choose.hpp"
#include "notation/latex.hpp"
#include "notation/text.hpp"
#include "run/evaluate.hpp"
#include "run/inverse.hpp"
#include "run/simulate.hpp"
#include "run/sweep.hpp"
#include "scene/claims_file.hpp"
#include "scene/draft.hpp"
#include "scene/scene.hpp"
#include "stability/stability.hpp"
