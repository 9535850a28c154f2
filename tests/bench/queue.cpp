// SPDX-License-Identifier: MIT
// How many parts of a sweep a second the first process serves: it answers, and writes results to a journal, while
// the others ask for a part and send results without integrating anything.
//   mpirun -n 2 bench_queue PARTS BYTES JOURNAL
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "simulate/byte_text.hpp"
#include "simulate/ranks.hpp"
#include "simulate/sweep_journal.hpp"
#include "simulate/sweep_queue.hpp"

using namespace alembert;

namespace {

/// Asks, and sends results, until the queue is empty.
void work(const Ranks& ranks, std::size_t bytes) {
    const std::string results(bytes, 'x');
    std::string message;
    for (int from = 0;;) {
        ranks.send(0, "w");
        while (!ranks.receive(from, message)) {
        }
        if (message == "n") return;
        ranks.send(0, "d" + message + results);
    }
}

void serve(const Ranks& ranks, std::size_t parts, SweepJournal& journal) {
    SweepQueue queue({{0, parts}}, {.takers = static_cast<std::size_t>(ranks.size), .fixed = 1});
    std::string message;
    for (int ended = 1, from = 0; ended < ranks.size;) {
        if (!ranks.receive(from, message)) continue;
        if (message[0] == 'd') {
            ByteReader rest(std::string_view(message).substr(1));
            const auto part = rest.take<SweepPart>();
            journal.add(part, rest.rest());
            queue.done(part);
            continue;
        }
        std::string answer;
        if (const std::optional<SweepPart> part = queue.next())
            put_bytes(answer, *part);
        else
            ++ended;
        ranks.send(from, answer.empty() ? "n" : answer);
    }
}

}  // namespace

int main(int count, char** words) {
    const std::unique_ptr<Ranks> ranks = ranks_of_launcher();
    if (count != 4 || !ranks) return 3;
    const auto parts = static_cast<std::size_t>(std::atol(words[1])),
               bytes = static_cast<std::size_t>(std::atol(words[2]));
    if (ranks->rank > 0) {
        work(*ranks, bytes);
    } else {
        SweepJournal journal(words[3], "bench", SweepJournal::Begin::anew);
        const auto begin = std::chrono::steady_clock::now();
        serve(*ranks, parts, journal);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        std::printf("%zu parts of %zu bytes: %.0f a second, %.0f MB a second\n", parts, bytes,
                    static_cast<double>(parts) / seconds, static_cast<double>(parts * bytes) / seconds / 1e6);
        journal.remove();
    }
    ranks->finish();
    return 0;
}
