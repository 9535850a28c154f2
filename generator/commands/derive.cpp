// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/pipeline.hpp"

namespace alembert {

int derive(const Request& request) {
    derived(request);
    return 0;
}

}  // namespace alembert
