// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/shared_sweep.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <thread>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "simulate/byte_text.hpp"

namespace alembert {

namespace {

/// The first letter of a message.
enum class Message : char {
    begin = 'b',    ///< to the others: the solver is compiled; with the key of the sweep
    want = 'w',     ///< to the first: a part, please
    part = 'p',     ///< its answer
    no_more = 'n',  ///< or this
    done = 'd',     ///< to the first: a part and its results
    ended = 'e',    ///< to the first: all my parts are done; with the processor time
    failed = 'f',   ///< to the first: with the reason
    go = 'g'        ///< to the others: you may end
};

std::string message_of(Message kind) {
    return std::string(1, static_cast<char>(kind));
}
std::string message_of(Message kind, SweepPart which) {
    std::string text = message_of(kind);
    put_bytes(text, which);
    return text;
}
Message kind_of(const std::string& message) {
    return static_cast<Message>(message.at(0));
}

/// A sweep that runs on threads of its own while this thread exchanges messages.
class Integration {
public:
    Integration(Sweeper& sweeper, const SweepDesk& desk, int threads)
        : thread_([this, &sweeper, &desk, threads] {
              try {
                  sweeper.run(desk, threads);
              } catch (...) {
                  error_ = std::current_exception();
              }
              ended_ = true;
          }) {}
    Integration(const Integration&) = delete;
    Integration& operator=(const Integration&) = delete;
    ~Integration() { thread_.join(); }

    bool has_ended() const { return ended_; }
    /// Of an integration that has ended.
    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

private:
    std::exception_ptr error_;
    std::atomic<bool> ended_ = false;
    std::thread thread_;
};

/// What passes between the thread that integrates and the one that exchanges messages.
class Mailbox {
public:
    std::optional<SweepPart> next() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !parts_.empty() || is_closed_; });
        if (parts_.empty()) return {};
        const SweepPart part = parts_.front();
        parts_.pop_front();
        return part;
    }
    void add(const SweepPart& part) {
        const std::lock_guard lock(mutex_);
        parts_.push_back(part);
        changed_.notify_all();
    }
    void close() {
        const std::lock_guard lock(mutex_);
        is_closed_ = true;
        changed_.notify_all();
    }
    /// Is there neither a part that waits nor the end?
    bool needs_more() {
        const std::lock_guard lock(mutex_);
        return parts_.empty() && !is_closed_;
    }
    void post(std::string message) {
        const std::lock_guard lock(mutex_);
        results_.push_back(std::move(message));
    }
    std::optional<std::string> posted() {
        const std::lock_guard lock(mutex_);
        if (results_.empty()) return {};
        std::string message = std::move(results_.front());
        results_.pop_front();
        return message;
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<SweepPart> parts_;
    std::deque<std::string> results_;
    bool is_closed_ = false;
};

/// Waits for a message.
std::string awaited(const Ranks& ranks) {
    std::string message;
    Nap nap;
    for (int from = 0; !ranks.receive(from, message);) nap.take();
    return message;
}

/// Takes parts, integrates them and sends the results until there are no more.
void integrate_for_first(Sweeper& sweeper, const SweepShelf& shelf, int threads, const Ranks& ranks) {
    Mailbox mail;
    const SweepDesk desk{.next = [&] { return mail.next(); },
                         .done =
                             [&](SweepPart which, const std::vector<SweptMotion>& motions) {
                                 mail.post(message_of(Message::done, which) + shelf.pack(which, motions));
                             }};
    const Integration integration(sweeper, desk, threads);
    Nap nap;
    bool has_asked = false;
    for (std::string message;;) {
        const bool was_last = integration.has_ended();
        bool is_idle = true;
        while (const std::optional<std::string> result = mail.posted()) {
            ranks.send(0, *result);
            is_idle = false;
        }
        if (was_last) break;
        if (!has_asked && mail.needs_more()) {
            ranks.send(0, message_of(Message::want));
            has_asked = true;
        }
        for (int from = 0; ranks.receive(from, message); is_idle = has_asked = false) {
            if (kind_of(message) == Message::part)
                mail.add(ByteReader(std::string_view(message).substr(1)).take<SweepPart>());
            else
                mail.close();
        }
        if (is_idle)
            nap.take();
        else
            nap.wake();
    }
    integration.rethrow();
}

}  // namespace

void run_alone(Sweeper& sweeper, SweepQueue& queue, const SweepShelf& shelf, const SharingOptions& options) {
    const std::size_t all = sweeper.sweep().grid.size();
    SweepDesk desk{.next = [&] { return queue.next(); },
                   .done =
                       [&](SweepPart which, const std::vector<SweptMotion>& motions) {
                           shelf.keep(which, shelf.pack(which, motions));
                           queue.done(which);
                       },
                   .breathe = {},
                   .most = all};
    if (options.progress) desk.breathe = [&] { options.progress(queue.fraction(all)); };
    sweeper.run(desk, options.threads);
}

void run_first(Sweeper& sweeper, SweepQueue& queue, const SweepShelf& shelf, const SharingOptions& options,
               const Ranks& ranks) {
    for (int rank = 1; rank < ranks.size; ++rank) ranks.send(rank, message_of(Message::begin) + sweeper.key());
    std::mutex keeping;
    const auto keep = [&](SweepPart which, std::string bytes) {
        const std::lock_guard lock(keeping);
        shelf.keep(which, std::move(bytes));
        queue.done(which);
    };
    const SweepDesk desk{
        .next = [&] { return queue.next(); },
        .done = [&](SweepPart which,
                    const std::vector<SweptMotion>& motions) { keep(which, shelf.pack(which, motions)); }};
    double seconds = 0, computed = 0;  // of the other processes
    int ended_ones = 0;
    const auto answer = [&](int from, const std::string& message) {
        ByteReader rest(std::string_view(message).substr(1));
        if (kind_of(message) == Message::want) {
            const std::optional<SweepPart> next = queue.next();
            ranks.send(from, next ? message_of(Message::part, *next) : message_of(Message::no_more));
        } else if (kind_of(message) == Message::done) {
            const auto which = rest.take<SweepPart>();
            keep(which, std::string(rest.rest()));
        } else if (kind_of(message) == Message::ended) {
            seconds += rest.take<double>();
            computed += rest.take<double>();
            ++ended_ones;
        } else {
            throw CompileError(say("process {}: {}", from, rest.rest()));
        }
    };
    {
        const Integration integration(sweeper, desk, options.threads);
        Nap nap;
        try {
            for (std::string message; !integration.has_ended() || ended_ones + 1 < ranks.size;) {
                bool is_idle = true;
                for (int from = 0; ranks.receive(from, message); is_idle = false) answer(from, message);
                if (integration.has_ended()) integration.rethrow();
                if (options.progress) options.progress(queue.fraction(sweeper.sweep().grid.size()));
                if (is_idle)
                    nap.take();
                else
                    nap.wake();
            }
        } catch (...) {
            queue.close();
            throw;
        }
    }
    sweeper.sweep().timings.integrate += seconds;
    sweeper.sweep().computed += computed;
}

void dismiss(const Ranks& ranks) {
    for (int rank = 1; rank < ranks.size; ++rank) ranks.send(rank, message_of(Message::go));
    ranks.finish();
}

void run_other(const std::function<std::unique_ptr<Sweeper>()>& make,
               const std::function<SweepShelf(const Sweeper&)>& shelf_of, const SharingOptions& options,
               const Ranks& ranks) {
    try {
        const std::unique_ptr<Sweeper> sweeper = make();
        if (awaited(ranks).substr(1) != sweeper->key())
            throw CompileError(
                say("it reads another scene, or has another version of this program than process 0"));
        sweeper->compile();
        integrate_for_first(*sweeper, shelf_of(*sweeper), options.threads, ranks);
        std::string message = message_of(Message::ended);
        put_bytes(message, sweeper->sweep().timings.integrate);
        put_bytes(message, sweeper->sweep().computed);
        ranks.send(0, message);
    } catch (const std::exception& error) {
        // If the first process has the same error, it is the one to say so, and its end is that of all.
        ranks.send(0, message_of(Message::failed) + error.what());
    }
    awaited(ranks);
    ranks.finish();
}

}  // namespace alembert
