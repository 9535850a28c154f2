// SPDX-License-Identifier: GPL-2.0-or-later
// Replaces robot.cpp and elements.cpp if the program is built without urdfdom.
#include "base/language/say.hpp"
#include "scene/import/robot.hpp"

namespace alembert {

Robot parse_urdf(const std::string&, const std::string&) {
    throw CompileError(
        say("import of URDF is missing: this program was built without urdfdom; install liburdfdom-dev, configure "
            "and build again"));
}

}  // namespace alembert
