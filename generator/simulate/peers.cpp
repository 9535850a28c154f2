// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/peers.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "alembert/base/error.hpp"
#include "alembert/native/process.hpp"
#include "alembert/native/temporary_file.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

void write_list(std::ofstream& out, const std::vector<double>& list) {
    out << list.size();
    for (const double x : list) out << fmt::format(" {:.17g}", x);
    out << "\n";
}

/// A new empty file in the folder for temporary files, with a name that nobody can predict.
std::filesystem::path new_file() {
    std::string pattern = (std::filesystem::temp_directory_path() / "alembert-peers-XXXXXX").string();
    const int made = mkstemp(pattern.data());
    if (made < 0)
        throw CompileError(say("cannot make a temporary file {}: {}; name a writable folder with $TMPDIR", pattern,
                               std::strerror(errno)));
    close(made);
    return pattern;
}

}  // namespace

Peers measure_peers(const PeerRequest& request, const std::function<double(const std::vector<double>&)>& judge) {
    const std::filesystem::path program = beside_this_program("alembert-peers");
    if (program.empty())
        return {
            .runs = {},
            .missing = say(
                "alembert-peers is not beside this program; cmake --build build/release --target alembert-peers "
                "makes it, where libsundials-dev, libgsl-dev or libboost-dev are installed (Debian)")};
    const TemporaryFile task(new_file());
    {
        std::ofstream out(task.path());
        write_list(out, request.parameters);
        write_list(out, request.initial);
        write_list(out, request.tolerances);
        out << fmt::format("{:.17g} {:.17g} {:.17g}\n", request.start, request.duration, request.most_seconds);
    }
    const Process finished = run({program.string(), request.object.string(), task.path().string()});

    Peers peers;
    std::istringstream lines(finished.output);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string tag;
        Measured one;
        double tolerance = 0;
        int failed = 0;
        if (!(words >> tag >> one.who >> one.method >> tolerance >> one.seconds >> one.evaluations >> one.steps >>
              failed) ||
            tag != "run")
            continue;
        one.tolerance = tolerance;
        std::vector<double> state(request.initial.size());
        for (double& y : state) {
            std::string word;
            words >> word;
            y = std::strtod(word.c_str(), nullptr);
        }
        if (failed != 0)
            one.failure = "failed";
        else
            one.error = judge(state);
        peers.runs.push_back(std::move(one));
    }
    if (finished.status != 0)
        peers.missing = say("alembert-peers ended with {}: {}", finished.status, finished.output.substr(0, 400));
    return peers;
}

}  // namespace alembert
