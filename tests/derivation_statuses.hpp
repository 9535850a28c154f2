// SPDX-License-Identifier: MIT
#pragma once

/// The status of each line of a derivation, one letter for each.

#include <string>

#include "check/derivation/marked.hpp"
#include "scene/scene.hpp"

namespace alembert::test {

/// One letter a line: R right, D definition, M mistake, F follows, U unfounded, and - for what is not judged.
inline std::string statuses(const std::string& scene, const std::string& text,
                            const std::string& file = "test.md") {
    const Marked marked = mark(parse_scene(scene, "scene.toml"), read_derivation(text, file));
    std::string result;
    for (const MarkedLine& line : marked.lines)
        result += is_right(line.status)                   ? 'R'
                  : line.status == LineStatus::definition ? 'D'
                  : line.status == LineStatus::mistake    ? 'M'
                  : line.status == LineStatus::follows    ? 'F'
                  : line.status == LineStatus::unfounded  ? 'U'
                                                          : '-';
    return result;
}

}  // namespace alembert::test
