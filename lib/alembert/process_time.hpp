// SPDX-License-Identifier: MIT
#pragma once

namespace alembert {

/// Processor time of this process and its finished children, in seconds.
double process_seconds();

}  // namespace alembert
