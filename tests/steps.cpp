// SPDX-License-Identifier: MIT
#include "steps.hpp"

namespace {

std::size_t steps = 0;

}  // namespace

// The name that the compiler calls.
extern "C" void __sanitizer_cov_trace_pc();   // NOLINT
extern "C" void __sanitizer_cov_trace_pc() {  // NOLINT
    ++steps;
}

namespace alembert::test {

std::size_t steps_of(const std::function<void()>& work) {
    const std::size_t before = steps;
    work();
    return steps - before;
}

}  // namespace alembert::test
