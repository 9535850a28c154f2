// SPDX-License-Identifier: GPL-2.0-or-later
// alembert-peers OBJECT TASK: runs each of the peers on an emitted solver and prints, a line for each run,
//   run WHO METHOD TOLERANCE SECONDS EVALUATIONS STEPS FAILED STATE…
// TASK has lists, each preceded by its length: parameters, initial state, tolerances; then start, duration, and
// the seconds that a run may take. SECONDS is processor time of this thread, the median of the runs that fit in 20
// ms, including the set-up of the peer's memory.
#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "alembert/native/module.hpp"
#include "peers.hpp"

namespace {

using namespace alembert;

double seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<double> list_from(std::istream& in) {
    std::size_t size = 0;
    in >> size;
    std::vector<double> list(size);
    for (double& x : list) in >> x;
    return list;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: alembert-peers OBJECT TASK\n");
        return 3;
    }
    try {
        std::ifstream in(argv[2]);
        const std::vector<double> parameters = list_from(in), initial = list_from(in), tolerances = list_from(in);
        double start = 0, duration = 0, most = 0;
        if (!(in >> start >> duration >> most)) return 3;
        const Rhs rhs = make_rhs(load(argv[1]), parameters);

        std::vector<double> rate(initial.size());
        long calls = 0;
        const double begin = seconds();
        for (; seconds() - begin < 2e-3; ++calls) rhs(start, initial.data(), rate.data());
        const long budget = static_cast<long>(most / ((seconds() - begin) / static_cast<double>(calls))) + 1000;

        std::vector<peers::Peer> all;
        for (const auto& some : {
#ifdef ALEMBERT_SUNDIALS
                 peers::sundials(),
#endif
#ifdef ALEMBERT_GSL
                 peers::gsl(),
#endif
#ifdef ALEMBERT_ODEINT
                 peers::odeint(),
#endif
#ifdef ALEMBERT_HAIRER
                 peers::hairer(),
#endif
                 std::vector<peers::Peer>{}})
            all.insert(all.end(), some.begin(), some.end());
        for (const peers::Peer& peer : all) {
            for (const double tolerance : tolerances) {
                const peers::Task task{.rhs = rhs,
                                       .initial = initial,
                                       .start = start,
                                       .end = start + duration,
                                       .tolerance = tolerance,
                                       .budget = budget};
                std::vector<double> times;
                double sum = 0;
                peers::Answer answer;
                do {
                    const double before = seconds();
                    answer = peer.solve(task);
                    times.push_back(seconds() - before);
                    sum += times.back();
                } while (times.size() < 200 && sum < 0.3 && (times.size() < 3 || sum < 0.02));
                std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                                 times.end());
                std::printf("run %s %s %.17g %.17g %ld %ld %d", peer.who.c_str(), peer.method.c_str(), tolerance,
                            times[times.size() / 2], answer.evaluations, answer.steps, answer.failed ? 1 : 0);
                for (const double y : answer.state) std::printf(" %.17g", y);
                std::printf("\n");
                std::fflush(stdout);                     // Fortran writes its messages there, too
                if (answer.failed || sum > most) break;  // a stricter tolerance takes longer
            }
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 5;
    }
    return 0;
}
