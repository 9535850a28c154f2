// SPDX-License-Identifier: MIT
// The error of emitted sines and cosines against 50-digit values: sines.sh says how it is called.
//
//   bench_sines POINTS SOURCE.cpp [SOURCE.cpp …]      emitted with --batch; outputs sin q₁, cos q₁, sin q₂ …
//
// A way to a sine: alone or in a group of as many angles as the source has coordinates, a state at a time or eight
// in packs, compiled for this processor or for any of its kind. Every way sees every angle (angles.hpp). Its value
// is CLN's: 80 digits and as many more as the angle has before the point, of which the reduction loses 28 at most
// up to 1e8; it is kept as two doubles, so that errors are good to 1e-16 ulp. An ulp is that of the exact value
// (of its own binade, not of the one it rounds to). Zeros must keep their sign, infinities and NaN give NaN, and
// beyond 1e8 the bits must be those of libm.
//
// CLN counts its references without locks: workers are processes, and each takes the next chunk of angles. Angles
// depend on the number of the chunk alone, so the report is the same whatever the number of processors.
#include <cln/cln.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "alembert/batch/packs.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "angles.hpp"

using namespace alembert;
using bench::farthest;

namespace {

constexpr int chunk = 4800, most_ways = 64,
              most_workers = 256;  // a chunk is whole packs of 1, 2, 3, 5 and 8 angles
constexpr double allowed = 2.5, rounding = 0.5;

/// A sine or cosine as (hi + lo) 2^exponent with 0.5 ≤ |hi| ≤ 1.
struct Exact {
    double hi = 0, lo = 0, ulp = 0;
    long exponent = 0;
    double error(double value) const {
        const double scaled = std::ldexp(value, static_cast<int>(-exponent));
        const double apart = std::abs((hi - scaled) + lo) / ulp;
        return std::isnan(apart) ? bench::infinity : apart;
    }
};

Exact exact(const cln::cl_F& value) {
    Exact result;
    result.exponent = std::max(cln::cl_I_to_long(cln::float_exponent(value)), -2000L);
    const cln::cl_F scaled = cln::scale_float(value, -result.exponent);
    result.hi = cln::double_approx(scaled);
    result.lo = cln::double_approx(scaled - cln::cl_float(cln::cl_DF(result.hi), scaled));
    result.ulp = std::ldexp(1.0, static_cast<int>(std::max(-53L, -1074 - result.exponent)));
    return result;
}

/// Of x ≠ 0, finite.
cln::cos_sin_t fifty_digits(double x) {
    int exponent;
    const auto mantissa = static_cast<long>(std::ldexp(std::frexp(x, &exponent), 53));
    const cln::float_format_t digits = cln::float_format(80 + std::max(0, static_cast<int>(exponent * 0.302)));
    return cln::cos_sin(cln::scale_float(cln::cl_float(cln::cl_I(mantissa), digits), exponent - 53));
}

struct Way {
    Module module;
    std::string target;
    bool is_pack = false;
    int angles() const { return module.table().coordinates; }

    /// Sine and cosine of each angle.
    void operator()(const std::vector<double>& x, std::vector<double>& s, std::vector<double>& c) const {
        const int n = angles(), side = is_pack ? lanes : 1, group = n * side;
        std::vector<Lanes> state(2 * n), rate(2 * n), out(2 * n);
        const Lanes t{};
        double *const q = reals(state.data()), *const values = reals(out.data());
        for (int first = 0; first < chunk; first += group) {
            std::copy_n(&x[first], group, q);
            if (is_pack)
                module.pack()->outputs_at(reals(&t), q, reals(rate.data()), nullptr, values);
            else
                module.table().outputs_at(0, q, reals(rate.data()), nullptr, values);
            for (int i = 0; i < n; ++i)
                for (int lane = 0; lane < side; ++lane) {
                    s[first + i * side + lane] = values[2 * i * side + lane];
                    c[first + i * side + lane] = values[(2 * i + 1) * side + lane];
                }
        }
    }
};

/// The largest error, and where. Of equals the smallest angle, so that the report does not depend on who came
/// first.
struct Worst {
    double error = 0, angle = 0;
    bool is_cosine = false;
    void meet(const Worst& other) {
        if (other.error < error || (other.error == error && std::abs(other.angle) >= std::abs(angle))) return;
        *this = other;
    }
};

struct Verdict {
    Worst near, far;  ///< up to 1e8 and beyond
    long wrong = 0;   ///< beyond 1e8 not as libm has it, a zero that lost its sign, an infinity that gave a number
    double wrong_angle = 0;
    void meet(const Verdict& other) {
        near.meet(other.near);
        far.meet(other.far);
        if (other.wrong > 0) wrong_angle = other.wrong_angle;
        wrong += other.wrong;
    }
};

/// In memory that all processes see; zeros to begin with.
struct Board {
    std::atomic<long> next, done;
    Verdict verdicts[most_workers][most_ways];
};

bool is_same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool is_right_kind(double x, double s, double c) {
    if (!std::isfinite(x)) return std::isnan(s) && std::isnan(c);
    if (x == 0) return is_same(s, x) && is_same(c, 1);
    return std::abs(x) <= farthest || (is_same(s, std::sin(x)) && is_same(c, std::cos(x)));
}

void judge(const std::vector<double>& x, const std::vector<Exact>& sine, const std::vector<Exact>& cosine,
           const std::vector<double>& s, const std::vector<double>& c, Verdict& verdict) {
    for (int k = 0; k < chunk; ++k) {
        if (!is_right_kind(x[k], s[k], c[k]))
            verdict.meet({.near = {}, .far = {}, .wrong = 1, .wrong_angle = x[k]});
        if (!std::isfinite(x[k]) || x[k] == 0) continue;
        Worst& worst = std::abs(x[k]) <= farthest ? verdict.near : verdict.far;
        worst.meet({.error = sine[k].error(s[k]), .angle = x[k], .is_cosine = false});
        worst.meet({.error = cosine[k].error(c[k]), .angle = x[k], .is_cosine = true});
    }
}

void work(const std::vector<Way>& ways, const std::vector<double>& hard, long chunks, Board& board,
          Verdict* verdicts) {
    std::vector<double> x(chunk), s(chunk), c(chunk);
    std::vector<Exact> sine(chunk), cosine(chunk);
    for (long k = board.next++; k < chunks; k = board.next++) {
        bench::fill_angles(k, x);
        for (long i = k * chunk; i < std::min<long>((k + 1) * chunk, static_cast<long>(hard.size())); ++i)
            x[i - k * chunk] = hard[i];
        for (int i = 0; i < chunk; ++i)
            if (x[i] != 0 && std::isfinite(x[i])) {
                const cln::cos_sin_t value = fifty_digits(x[i]);
                sine[i] = exact(cln::cl_float(value.sin));
                cosine[i] = exact(cln::cl_float(value.cos));
            }
        for (std::size_t w = 0; w < ways.size(); ++w) {
            ways[w](x, s, c);
            judge(x, sine, cosine, s, c, verdicts[w]);
        }
        ++board.done;
    }
}

std::vector<Way> ways_of(const std::vector<std::string>& files) {
    std::vector<std::pair<std::string, std::vector<std::string>>> targets{{"this processor", {}}};
#if defined(__x86_64__)
    targets.push_back({"any x86-64", {"-march=x86-64", "-ffp-contract=off"}});
#endif
    std::vector<Way> ways;
    for (const auto& [target, flags] : targets)
        for (const bool is_pack : {false, true})
            for (const std::string& file : files) {
                std::ostringstream text;
                text << std::ifstream(file, std::ios::binary).rdbuf();
                const Module module =
                    load(compile(text.str(), "sines", {.compiler = {}, .extra_flags = flags, .cache = {}}).object);
                if (module.pack() == nullptr || module.table().outputs != 2 * module.table().coordinates ||
                    chunk % (lanes * module.table().coordinates) != 0)
                    throw std::runtime_error(file + ": not a solver of sines and cosines emitted with --batch");
                ways.push_back({module, target, is_pack});
            }
    if (ways.size() > most_ways)
        throw std::runtime_error(fmt::format("{} ways are too many: {} at most", ways.size(), most_ways));
    return ways;
}

/// True if every worker came to its end.
bool attend(const std::vector<pid_t>& workers, const Board& board, long chunks) {
    bool is_whole = true;
    for (const pid_t worker : workers)
        for (int status = 0;; std::this_thread::sleep_for(std::chrono::milliseconds(100))) {
            const pid_t ended = waitpid(worker, &status, WNOHANG);
            if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r{:3} %", 100 * board.done / chunks);
            if (ended == 0) continue;
            is_whole = is_whole && ended == worker && WIFEXITED(status) && WEXITSTATUS(status) == 0;
            break;
        }
    if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r     \r");
    return is_whole && board.done == chunks;
}

std::string place(const Worst& worst) {
    return fmt::format("{}({:.17g})", worst.is_cosine ? "cos" : "sin", worst.angle);
}

/// Prints a row; false where it is not as it must be. Sines of which none is off by half an ulp have not been
/// looked at.
bool report(const Way& way, const Verdict& verdict) {
    fmt::print("{:<16} {:<8} {:>7} {:>12.4f}   {}\n", way.target, way.is_pack ? "in packs" : "a state",
               way.angles(), verdict.near.error, place(verdict.near));
    if (verdict.wrong > 0)
        fmt::print("  {} angles give what they must not, {:.17g} among them\n", verdict.wrong,
                   verdict.wrong_angle);
    return verdict.wrong == 0 && verdict.near.error <= allowed && verdict.near.error > rounding;
}

}  // namespace

int main(int argc, char** argv) try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const auto start = std::chrono::steady_clock::now();
    const std::vector<Way> ways = ways_of({arguments.begin() + 1, arguments.end()});
    const std::vector<double> hard = bench::hard_angles();
    const long chunks = (std::max(std::stol(arguments.at(0)), static_cast<long>(hard.size())) + chunk - 1) / chunk;

    void* const memory = mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no memory for the workers' results");
    Board& board = *new (memory) Board();
    std::vector<pid_t> workers;
    const unsigned count =
        std::clamp(std::thread::hardware_concurrency(), 1U, static_cast<unsigned>(most_workers));
    for (unsigned w = 0; w < count; ++w) {
        const pid_t worker = fork();
        if (worker < 0) throw std::runtime_error("cannot start a worker");
        if (worker > 0) {
            workers.push_back(worker);
            continue;
        }
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        work(ways, hard, chunks, board, board.verdicts[w]);
        _exit(0);
    }
    if (!attend(workers, board, chunks)) throw std::runtime_error("a worker was lost");

    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    fmt::print("{} angles, {} of them hard ones; {:.0f} s on {} processors\n\n", chunks * chunk, hard.size(),
               seconds.count(), count);
    fmt::print("{:<16} {:<8} {:>7} {:>12}   at\n", "compiled for", "", "at once", "worst, ulp");
    bool is_right = true;
    Verdict all;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        Verdict verdict;
        for (const auto& row : board.verdicts) verdict.meet(row[way]);
        is_right = report(ways[way], verdict) && is_right;
        all.meet(verdict);
    }
    fmt::print(
        "\nrequired: at most {} ulp up to 1e8 ({:.4f}), beyond libm's own bits (its worst: {:.4f} ulp, {}): {}\n",
        allowed, all.near.error, all.far.error, place(all.far), is_right ? "holds" : "FAILS");
    return is_right ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 5;
}
