// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/grade.hpp"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <thread>

#include "alembert/base/error.hpp"
#include "base/archive/file_form.hpp"
#include "base/language/say.hpp"
#include "check/derivation/system.hpp"
#include "commands/progress.hpp"
#include "present/report/marked_page.hpp"
#include "scene/text_file.hpp"

namespace alembert {

namespace {

namespace fs = std::filesystem;

/// Whether a file is in its folder or below it, after links: those that lead out of it are nobody's homework.
bool stays_in_folder(const fs::path& file) {
    std::error_code error;
    const fs::path whole = fs::canonical(file, error), root = fs::canonical(file.parent_path(), error);
    return !error && std::mismatch(root.begin(), root.end(), whole.begin(), whole.end()).first == root.end();
}

GradedRow row_of(DerivedSystem& system, const std::string& file, const MarkOptions& options, bool with_page) {
    const std::string name = fs::path(file).filename().string();
    try {
        if (!stays_in_folder(file))
            throw ModelError(
                say("the file is a link that leads out of the folder, which is not followed; put the "
                    "derivation itself there"));
        const Marked marked = mark(system, read_derivation(text_of_file(file), name), options);
        GradedRow row = graded(marked);
        if (with_page) row.page = marked_fragment(marked);
        return row;
    } catch (const std::exception& problem) {
        GradedRow row;
        row.file = name;
        row.problem = problem.what();
        return row;
    }
}

/// What the processes share: the next file that nobody has taken.
class SharedCount {
public:
    SharedCount() {
        void* const memory =
            mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED)
            throw CompileError(say("there is no memory for {} bytes", sizeof(std::atomic<int>)));
        count_ = new (memory) std::atomic<int>(0);
    }
    ~SharedCount() { munmap(count_, sizeof(std::atomic<int>)); }
    SharedCount(const SharedCount&) = delete;
    SharedCount& operator=(const SharedCount&) = delete;
    std::size_t take() { return static_cast<std::size_t>(count_->fetch_add(1)); }
    std::size_t taken() const { return static_cast<std::size_t>(count_->load()); }

private:
    std::atomic<int>* count_;
};

/// One process, and the file without a name to which it writes its rows, a line of JSON each.
struct Worker {
    pid_t process = 0;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> rows{nullptr, std::fclose};
};

/// The same work for each process: takes files until none are left.
[[noreturn]] void work(DerivedSystem& system, const std::vector<std::string>& files, const MarkOptions& options,
                       bool with_pages, std::pair<SharedCount&, std::FILE*> shared) {
    for (std::size_t k = shared.first.take(); k < files.size(); k = shared.first.take()) {
        Json line = to_json(row_of(system, files[k], options, with_pages));
        line["index"] = k;
        const std::string text = line.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
        if (std::fputs(text.c_str(), shared.second) < 0 || std::fflush(shared.second) != 0) _exit(1);
    }
    _exit(0);
}

void collect(std::FILE* rows, Gradebook& book) {
    std::rewind(rows);
    std::string text;
    std::array<char, 65536> part{};
    for (std::size_t read = 0; (read = std::fread(part.data(), 1, part.size(), rows)) > 0;)
        text.append(part.data(), read);
    for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
        const Json line = Json::parse(text.substr(begin, end - begin));
        book.rows.at(line.at("index").get<std::size_t>()) = row_from(line);
    }
}

}  // namespace

std::vector<std::string> derivations_in(const std::string& folder) {
    std::vector<std::string> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string ending = ending_of(entry.path().string());
        std::error_code none;
        if ((entry.is_regular_file(none) || entry.is_symlink(none)) &&
            (ending == ".tex" || ending == ".md" || ending == ".txt"))
            files.push_back(entry.path().string());
    }
    if (error) throw ModelError(say("{}: the folder cannot be read: {}", folder, error.message()));
    if (files.empty())
        throw ModelError(
            say("{}: the folder has no derivations; expected files that end with .tex, .md or .txt", folder));
    std::sort(files.begin(), files.end());
    return files;
}

Gradebook grade(const Scene& scene, const std::vector<std::string>& files, const MarkOptions& options,
                bool with_pages) {
    Gradebook book;
    for (const std::string& file : files) {
        GradedRow lost;
        lost.file = fs::path(file).filename().string();
        lost.problem = say("the process that checked this file ended early");
        book.rows.push_back(std::move(lost));
    }
    DerivedSystem system(scene, options.by);  // once, before there are several processes
    SharedCount next;
    std::cout.flush();
    std::fflush(nullptr);
    std::vector<Worker> workers;
    const auto begin = [&] {
        Worker worker;
        worker.rows.reset(std::tmpfile());
        if (!worker.rows) throw CompileError(say("a temporary file cannot be made"));
        worker.process = fork();
        if (worker.process < 0) return false;
        if (worker.process == 0) work(system, files, options, with_pages, {next, worker.rows.get()});
        workers.push_back(std::move(worker));
        return true;
    };
    const std::size_t cores = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, files.size());
    for (std::size_t k = 0; k < cores && begin(); ++k) {
    }
    if (workers.empty()) {  // where there are no processes, this one does it all
        for (std::size_t k = 0; k < files.size(); ++k)
            book.rows[k] = row_of(system, files[k], options, with_pages);
        return book;
    }
    Progress progress;
    for (std::size_t running = workers.size(); running > 0;) {
        progress.at(say("checking"), static_cast<double>(next.taken()) / static_cast<double>(files.size()));
        bool has_ended = false;
        for (std::size_t k = 0; k < workers.size(); ++k) {
            int status = 0;
            if (workers[k].process == 0 || waitpid(workers[k].process, &status, WNOHANG) == 0) continue;
            workers[k].process = 0;
            has_ended = true;
            --running;
            const bool died = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
            if (!died || next.taken() >= files.size()) continue;
            if (!begin()) throw CompileError(say("a process cannot be started"));  // another takes its place
            ++running;
        }
        if (!has_ended) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    for (const Worker& worker : workers) collect(worker.rows.get(), book);
    return book;
}

}  // namespace alembert
