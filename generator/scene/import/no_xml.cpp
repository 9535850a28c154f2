// SPDX-License-Identifier: GPL-2.0-or-later
// Replaces the readers of MJCF and SDF if the program is built without TinyXML-2.
#include "base/language/say.hpp"
#include "scene/import/robot.hpp"

namespace alembert {

namespace {

[[noreturn]] void refuse(const char* format) {
    throw CompileError(say(
        "import of {} is missing: this program was built without TinyXML-2; install libtinyxml2-dev, configure "
        "and build again",
        format));
}

}  // namespace

Robot parse_mjcf(const std::string&, const std::string&, const OtherFiles&) {
    refuse("MJCF");
}
Robot parse_sdf(const std::string&, const std::string&, const OtherFiles&) {
    refuse("SDF");
}

}  // namespace alembert
