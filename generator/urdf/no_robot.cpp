// SPDX-License-Identifier: GPL-2.0-or-later
// Replaces robot.cpp and elements.cpp if the program is built without urdfdom.
#include "urdf/robot.hpp"

#include "language/say.hpp"

namespace alembert {

Robot parse_robot(const std::string&, const std::string&) {
    throw CompileError(say(
        "import is missing: this program was built without urdfdom; install liburdfdom-dev, configure and build "
        "again"));
}
Robot read_robot(const std::string& file) {
    return parse_robot({}, file);
}

}  // namespace alembert
