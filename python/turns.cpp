// SPDX-License-Identifier: GPL-2.0-or-later
#include "turns.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace alembert {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds moment{50};

struct Turns {
    std::mutex guard;
    std::condition_variable is_free;
    bool taken = false;
    std::vector<std::function<void()>> postponed;
};

/// It is never destroyed, because threads may still have turns when the process ends.
Turns& turns() {
    static Turns* const all = new Turns;
    return *all;
}

thread_local bool has_turn = false;

void do_postponed() {
    std::vector<std::function<void()>> work;
    {
        const std::lock_guard guard(turns().guard);
        work = std::exchange(turns().postponed, {});
    }
    for (const std::function<void()>& one : work) one();
}

void take() {
    Turns& all = turns();
    std::unique_lock lock(all.guard);
    while (!all.is_free.wait_for(lock, moment, [&] { return !all.taken; })) {
        lock.unlock();
        look_for_interrupt({}, 0);
        lock.lock();
    }
    all.taken = has_turn = true;
}

void give_back() {
    {
        const std::lock_guard guard(turns().guard);
        turns().taken = has_turn = false;
    }
    turns().is_free.notify_one();
}

}  // namespace

SymbolicTurn::SymbolicTurn() : is_outer_(!has_turn) {
    if (!is_outer_) return;
    take();
    do_postponed();
}

SymbolicTurn::~SymbolicTurn() {
    if (is_outer_) give_back();
}

void in_some_turn(std::function<void()> function) {
    if (has_turn) return function();
    {
        const std::lock_guard guard(turns().guard);
        if (turns().taken) {
            turns().postponed.push_back(std::move(function));
            return;
        }
        turns().taken = has_turn = true;
    }
    function();
    give_back();
}

void look_for_interrupt(std::string_view, double) {
    thread_local Clock::time_point last = Clock::now();
    if (Clock::now() - last < moment) return;
    last = Clock::now();
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace alembert
