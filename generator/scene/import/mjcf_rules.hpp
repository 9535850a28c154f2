// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes out what an MJCF file makes by rules: <replicate> repeats bodies, <attach> takes a body, a frame or all
/// of another model (MuJoCo's documentation: "XML reference"). What refers to them, a motor or a tendon, is
/// repeated or taken with them, under names with a suffix or a prefix.
///
///     XmlFile file(text, "arm.xml");
///     write_out_rules(file, {"arm.xml", {}});        // afterwards only <frame>s and bodies are left
///
/// Only mjcf.cpp uses this.

#include "scene/import/other_files.hpp"
#include "scene/import/xml.hpp"

namespace alembert {

/// Replaces each <include>. `named` finds files.
void include_parts(XmlFile& file, const NamedFiles& named);

/// Throws SceneError at a rule that names what is not there, or that makes more than 100 000 elements.
void write_out_rules(XmlFile& file, const NamedFiles& named, int depth = 0);

/// The unit of angles or the sequence of Euler's angles that an attached model has: the value of "angle" or
/// "eulerseq" of its <compiler>; null where those of the file itself hold.
const char* of_attached_model(const XmlElement& e, const char* attribute);

}  // namespace alembert
