// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What an emitted C++ file offers to other files: the functions that it exports under names that begin with that
/// of the scene, and the header beside it, whose state, parameters and outputs are structs with a member for each
/// name.
///
///     namespace_of(program);   // "double_pendulum"; "switch_" for a scene switch.toml
///     describe_interface(file, program, words, functions, options);   // for solver.cpp.mustache and solver.hpp
///
/// The names of the functions that a module exports are those of lib/alembert/native/abi.hpp.

#include <kainjow/mustache.hpp>

#include "codegen/emit/emit.hpp"
#include "codegen/emit/function.hpp"
#include "codegen/emit/vocabulary.hpp"

namespace alembert {

/// The namespace of a scene's C++: its name, with a `_` where that is a word of the language or the name of a
/// function of the libraries of C.
std::string namespace_of(const Program& program);

/// `functions`: those that the file has.
void describe_interface(kainjow::mustache::data& file, const Program& program, const Vocabulary& words,
                        const std::vector<FunctionTask>& functions, const EmitOptions& options);

/// The members of state, parameters, inputs, outputs and events, in their order, for a header of C.
void name_members(kainjow::mustache::data& file, const Program& program, const Vocabulary& words,
                  const EmitOptions& options);

}  // namespace alembert
