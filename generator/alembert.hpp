// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The whole library in one header: a scene, its equations, what can be asked of them, and its motion. Each verb
/// of the command line is a function here. docs/cpp.md describes it with examples.

#include "alembert/runtime.hpp"
#include "algebra/notation/latex.hpp"
#include "algebra/notation/text.hpp"
#include "analysis/derive/derive.hpp"
#include "check/check.hpp"
#include "codegen/emit/emit.hpp"
#include "program/lower/choose.hpp"
#include "scene/claims_file.hpp"
#include "scene/draft.hpp"
#include "scene/scene.hpp"
#include "simulate/evaluate.hpp"
#include "simulate/inverse.hpp"
#include "simulate/kinematics/kinematics.hpp"
#include "simulate/simulate.hpp"
#include "simulate/sweep.hpp"
#include "stability/equilibrium/equilibria.hpp"
#include "stability/judged_equilibria.hpp"
#include "stability/linear/about.hpp"
#include "stability/stability.hpp"
