// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cctype>

#include "scene/import/robot.hpp"
#include "scene/text_file.hpp"

namespace alembert {

namespace {

/// The name of the outermost element: the first after '<' that is no comment, declaration or instruction.
std::string outermost(const std::string& text) {
    for (std::size_t i = text.find('<'); i != std::string::npos; i = text.find('<', i + 1)) {
        if (text.compare(i, 4, "<!--") == 0) {
            i = std::min(text.find("-->", i), text.size() - 1);
            continue;
        }
        std::size_t end = i + 1;
        while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_'))
            ++end;
        if (end > i + 1) return text.substr(i + 1, end - i - 1);
    }
    return "";
}

}  // namespace

Robot parse_robot(const std::string& text, const std::string& file, const OtherFiles& others) {
    const std::string tag = outermost(text);
    return tag == "mujoco" ? parse_mjcf(text, file, others)
           : tag == "sdf"  ? parse_sdf(text, file, others)
                           : parse_urdf(text, file);
}
Robot read_robot(const std::string& file, const OtherFiles& others) {
    return parse_robot(text_of_file(file), file, others);
}

}  // namespace alembert
