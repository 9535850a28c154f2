// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// GiNaC counts its references without atomic operations, so that one thread at a time may work with expressions,
/// or destroy them. A thread takes its turn without the interpreter's lock: other threads of Python go on
/// meanwhile, and those that ask for a turn wait.
///
///     const Answer answer = in_turn([&] { return answer_of(verb, …); });
///     py::class_<Motion, std::unique_ptr<Motion, DestroyedInTurn<Motion>>>(module, "Run");
///
/// No object of Python may be touched in a turn, except by a thread that takes the lock again. In a process that
/// was forked while another thread had its turn, asking for one throws std::runtime_error.

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <string_view>

namespace alembert {

/// The calling thread has its turn while this exists; one that has it already keeps it. Ctrl-C ends the wait for
/// it.
class SymbolicTurn {
public:
    SymbolicTurn();
    ~SymbolicTurn();
    SymbolicTurn(const SymbolicTurn&) = delete;
    SymbolicTurn& operator=(const SymbolicTurn&) = delete;

private:
    pybind11::gil_scoped_release released_;
    bool is_outer_;
};

/// While it exists, Ctrl-C ends the thread's work outside of a turn, such as a compiler's.
class WorkCanEnd {
public:
    WorkCanEnd();
    ~WorkCanEnd();
    WorkCanEnd(const WorkCanEnd&) = delete;
    WorkCanEnd& operator=(const WorkCanEnd&) = delete;

private:
    void (*before_)();
};

template <typename Function>
decltype(auto) in_turn(Function function) {
    const SymbolicTurn turn;
    return function();
}

/// Calls the function at once if the turn is free or the thread's own, and otherwise when the next turn begins.
void in_some_turn(std::function<void()> function);

/// A deleter for values with expressions, which Python destroys whenever it likes.
template <typename Value>
struct DestroyedInTurn {
    void operator()(Value* value) const {
        in_some_turn([value] { delete value; });
    }
};

/// What ends the work of a thread: the exception of Python that a signal's function raised, KeyboardInterrupt
/// after Ctrl-C. No std::exception, which some of the work catches.
struct Interrupted {
    std::shared_ptr<pybind11::error_already_set> raised;
};

/// Lets the user interrupt the work (Ctrl-C, or the stop button of a notebook): throws Interrupted. May be called
/// with or without the interpreter's lock, and often: it looks twenty times a second. Long work in a turn does so
/// by itself (alembert/base/interrupt.hpp).
void look_for_interrupt(std::string_view what, double part);

/// From now on `listener(what, part)` is called with the progress of the verbs of this thread, as often as that
/// looks; an exception that it raises ends the verb. None: nobody is told. Gives the one before.
pybind11::object listen(const pybind11::object& listener);

}  // namespace alembert
