// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/sweep_table.hpp"

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "present/report/table_file.hpp"

namespace alembert {

void check_sweep_table(const std::string& path, bool resume, const std::vector<std::string>& inputs) {
    check_output(path, FileForm::table, inputs);
    need_table_form(path);
    if (resume && path.empty())
        throw ModelError(say("--resume needs -o FILE: what is done is kept beside it, in FILE.unfinished"));
    if (resume && !is_ordinary_file(path))
        throw ModelError(say("--resume: '{}' is no ordinary file, beside which the results could be kept", path));
}

std::string journal_beside(const std::string& path) {
    return path.empty() || !is_ordinary_file(path) ? std::string() : path + ".unfinished";
}

void write_sweep_table(SweepJob& job, const std::string& path, const std::vector<std::string>& inputs) {
    write_file(
        path, [&](const PieceTaker& put) { put_table(job, path, put); }, inputs);
}

}  // namespace alembert
