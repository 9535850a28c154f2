// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a user asked for, and the commands that answer. Each returns the exit code of commands.md, prints for a
/// person, or one JSON object where `json` is set. Mistakes leave as exceptions; main maps them.

#include <string>
#include <vector>

namespace alembert {

struct Request {
    std::string scene;
    std::string claims;           ///< check: a file; empty: the claims of the scene
    std::string by;               ///< formalism; empty: the program chooses
    bool json = false;
    std::string format = "text";  ///< derive: text, latex, mathml
    bool steps = false;           ///< derive
    bool reactions = false;       ///< derive, eval, simulate: A^T lambda of each constraint
    bool fold = false;            ///< emit: parameters as constants
    bool jacobian = false;        ///< emit: with derivatives by state and parameters
    bool batch = false;           ///< emit: functions for eight systems at once too
    bool fast_math = false;
    std::vector<std::string> at;  ///< eval: NAME=VALUE
    std::vector<std::string> vary;  ///< sweep: NAME=FROM:TO:COUNT
    int threads = 0;              ///< sweep; 0: as many as there are cores
    std::string output;           ///< a file or folder
    std::string method;           ///< simulate; empty: the scene's
    double duration = -1, tolerance = -1, step = -1, sample = -1, max_step = -1;  ///< simulate; negative: the scene's
    long budget = 10'000'000;
    bool floating = false, quaternion = false;  ///< import
    bool estimate = true;         ///< simulate: the error, by a second run
    bool peers = false;           ///< bench: other people's integrators too
    std::string csv, svg;         ///< bench: files
    double reference_seconds = 30;  ///< bench: for each method of the reference
};

int agree(const Request& request);
int audit(const Request& request);
int bench(const Request& request);
int check(const Request& request);
int derive(const Request& request);
int eval(const Request& request);
int emit_files(const Request& request);
int impact(const Request& request);
int import_robot(const Request& request);
int inverse(const Request& request);
int linearize(const Request& request);
int simulate(const Request& request);
int sweep(const Request& request);

}  // namespace alembert
