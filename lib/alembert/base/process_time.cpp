// SPDX-License-Identifier: MIT
#include "alembert/base/process_time.hpp"

#include <sys/resource.h>

#include <chrono>
#include <ctime>

namespace alembert {

#ifndef __EMSCRIPTEN__

namespace {

double seconds_of(int who) {
    rusage usage{};
    getrusage(who, &usage);
    const auto seconds = [](const timeval& part) {
        return static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

double process_seconds() {
    return seconds_of(RUSAGE_SELF) + children_seconds();
}

double children_seconds() {
    return seconds_of(RUSAGE_CHILDREN);
}

double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

#else

// An engine of WebAssembly tells no processor time. Its one thread does nothing else while the clock runs.

double process_seconds() {
    return thread_seconds();
}

double children_seconds() {
    return 0;
}

double thread_seconds() {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now().time_since_epoch();
    return time.count();
}

#endif

}  // namespace alembert
