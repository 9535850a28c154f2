// SPDX-License-Identifier: MIT
// doctest's main program, with two additions:
//
//     test_commands --jobs=2                       the cases are shared out among two processes
//     test_commands --reporters=cost | sort -rn    what each case cost in processor time, children included
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

namespace {

/// What a reporter need not look at.
class Quiet : public doctest::IReporter {
public:
    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_run_end(const doctest::TestRunStats&) override {}
    void test_case_start(const doctest::TestCaseData&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_end(const doctest::CurrentTestCaseStats&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
};

class Cost : public Quiet {
public:
    explicit Cost(const doctest::ContextOptions&) {}
    void test_case_start(const doctest::TestCaseData& data) override {
        name = data.m_name;
        before = seconds();
    }
    void test_case_end(const doctest::CurrentTestCaseStats&) override {
        std::printf("%8.3f %s\n", seconds() - before, name);
    }

private:
    const char* name = "";
    double before = 0;

    static double seconds() {
        double sum = 0;
        for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
            rusage used{};
            getrusage(who, &used);
            sum += static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                   1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
        }
        return sum;
    }
};

/// What the processes have in common.
struct Shared {
    std::atomic<std::size_t> next{0};  ///< the case that the next free process takes
    std::atomic<std::size_t> ended{0};
};

Shared* shared = nullptr;  ///< null where there is one process

/// Lets a process run those cases that it takes one after the other, in the order of doctest's set of them.
class Taker : public Quiet {
public:
    explicit Taker(const doctest::ContextOptions&) {}
    void test_run_start() override {
        if (shared == nullptr) return;
        for (const doctest::detail::TestCase& one : doctest::detail::getRegisteredTests()) {
            cases.push_back(const_cast<doctest::detail::TestCase*>(&one));
            cases.back()->m_skip = true;
        }
        take();
    }
    void test_case_end(const doctest::CurrentTestCaseStats&) override { end(); }
    void test_case_skipped(const doctest::TestCaseData& data) override {
        if (&data == mine) end();  // the options leave it out
    }

private:
    std::vector<doctest::detail::TestCase*> cases;
    const doctest::TestCaseData* mine = nullptr;

    void take() {
        const std::size_t next = shared->next++;
        mine = next < cases.size() ? cases[next] : nullptr;
        if (mine != nullptr) cases[next]->m_skip = false;
    }
    void end() {
        if (shared == nullptr) return;
        ++shared->ended;
        take();
    }
};

REGISTER_REPORTER("cost", 0, Cost);
REGISTER_LISTENER("taker", 0, Taker);

int run(const std::vector<char*>& args) {
    doctest::Context context(static_cast<int>(args.size()), args.data());
    if (shared != nullptr) context.setOption("order-by", "none");
    return context.run();
}

/// What was written to the file so far goes to the standard output.
void show(std::FILE* file) {
    std::rewind(file);
    for (int c = 0; (c = std::getc(file)) != EOF;) std::putchar(c);
}

int run_together(const std::vector<char*>& args, int jobs) {
    void* const memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return 5;
    shared = new (memory) Shared;
    std::vector<std::FILE*> outputs;
    for (int k = 0; k < jobs; ++k) {
        outputs.push_back(std::tmpfile());
        const pid_t child = outputs.back() == nullptr ? -1 : fork();
        if (child < 0) return 5;
        if (child != 0) continue;
        dup2(fileno(outputs.back()), STDOUT_FILENO);
        dup2(fileno(outputs.back()), STDERR_FILENO);
        std::exit(run(args));
    }
    int failed = 0;
    for (int status = 0; wait(&status) > 0;)
        if (status != 0) ++failed;
    for (std::FILE* const output : outputs) show(output);
    const std::size_t all = doctest::detail::getRegisteredTests().size();
    std::printf("%zu of %zu test cases ended, in %d processes: %s\n", shared->ended.load(), all, jobs,
                failed == 0 ? "none failed" : "some failed");
    return failed == 0 && shared->ended == all ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    int jobs = 1;
    std::vector<char*> args;
    for (char** arg = argv; arg != argv + argc; ++arg) {
        const std::string text = *arg;
        if (text.starts_with("--jobs="))
            jobs = std::atoi(text.c_str() + 7);
        else
            args.push_back(*arg);
    }
    return jobs < 2 ? run(args) : run_together(args, jobs);
}
