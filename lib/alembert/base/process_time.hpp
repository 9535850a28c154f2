// SPDX-License-Identifier: MIT
#pragma once

namespace alembert {

/// Processor time of this process and its finished children, in seconds.
double process_seconds();

/// The same of this thread alone, and of the finished children.
double thread_seconds();
double children_seconds();

}  // namespace alembert
