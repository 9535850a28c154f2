// SPDX-License-Identifier: GPL-2.0-or-later
#include "symbolic_turn.hpp"

#include <pthread.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "alembert/base/interrupt.hpp"

namespace py = pybind11;

namespace alembert {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds moment{50};

struct Turns {
    std::mutex guard;
    std::condition_variable is_free;
    bool taken = false;
    bool is_lost = false;  ///< with a thread that this process, which was forked, does not have
    std::vector<std::function<void()>> postponed;
};

Turns* made();

/// It is never destroyed, because threads may still have turns when the process ends.
Turns& turns() {
    static Turns* const all = made();
    return *all;
}

thread_local bool has_turn = false;

/// Whom the thread tells of its progress, or null. It owns a reference, which no end of a thread gives back: there
/// is no lock of the interpreter then.
thread_local PyObject* listener = nullptr;

/// A process that is forked has the thread alone that forked it. Whoever else had a turn has left its work half
/// done; no other verb can begin then.
Turns* made() {
    pthread_atfork([] { turns().guard.lock(); }, [] { turns().guard.unlock(); },
                   [] {
                       Turns& all = turns();
                       all.guard.unlock();
                       new (&all.is_free) std::condition_variable;  // nobody waits in this process
                       all.is_lost = all.taken && !has_turn;
                   });
    return new Turns;
}

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
    if (all.is_lost)
        throw std::runtime_error(
            "this process was forked while another thread was in a verb of alembert, and cannot use alembert; "
            "start "
            "processes by multiprocessing's 'spawn' or 'forkserver', or fork while no verb runs");
    while (!all.is_free.wait_for(lock, moment, [&] { return !all.taken; })) {
        lock.unlock();
        look_for_interrupt({}, 0);
        lock.lock();
    }
    all.taken = has_turn = true;
    on_long_work = [] { look_for_interrupt({}, 0); };
}

void give_back() {
    on_long_work = nullptr;
    {
        const std::lock_guard guard(turns().guard);
        turns().taken = has_turn = false;
    }
    turns().is_free.notify_one();
}

}  // namespace

WorkCanEnd::WorkCanEnd() : before_(on_long_work) {
    on_long_work = [] { look_for_interrupt({}, 0); };
}

WorkCanEnd::~WorkCanEnd() {
    on_long_work = before_;
}

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

py::object listen(const py::object& next) {
    const py::object before = listener == nullptr ? py::none() : py::reinterpret_steal<py::object>(listener);
    listener = next.is_none() ? nullptr : py::object(next).release().ptr();
    return before;
}

void look_for_interrupt(std::string_view what, double part) {
    // What tells of its progress and what only asks whether it is wanted have a time each, so that neither is kept
    // from the interpreter by the other.
    thread_local Clock::time_point last_question = Clock::now(), last_progress = last_question;
    Clock::time_point& last = what.empty() ? last_question : last_progress;
    if (Clock::now() - last < moment) return;
    last = Clock::now();
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw Interrupted{std::make_shared<py::error_already_set>()};
    if (listener == nullptr || what.empty()) return;
    try {
        py::reinterpret_borrow<py::object>(listener)(std::string(what), part);
    } catch (const py::error_already_set& raised) {
        throw Interrupted{std::make_shared<py::error_already_set>(raised)};
    }
}

}  // namespace alembert
