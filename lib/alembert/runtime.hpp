// SPDX-License-Identifier: MIT
#pragma once

/// All of the runtime that a program needs, in one header: systems, methods, motions, events, contacts, ensembles,
/// and emitted code compiled and loaded. docs/cpp.md describes it with examples.

#include "alembert/base/error.hpp"
#include "alembert/base/inertia.hpp"
#include "alembert/base/rotation.hpp"
#include "alembert/batch/ensemble.hpp"
#include "alembert/hybrid/automaton.hpp"
#include "alembert/hybrid/filippov_system.hpp"
#include "alembert/hybrid/hybrid_motion.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "alembert/ode/events.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/method.hpp"
#include "alembert/ode/projection.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/trajectory.hpp"
