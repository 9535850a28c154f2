// SPDX-License-Identifier: MIT
#include "alembert/base/process_time.hpp"

#include <sys/resource.h>

#include <ctime>

namespace alembert {

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

}  // namespace alembert
