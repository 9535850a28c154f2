// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "alembert/base/error.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/native/fingerprint.hpp"
#include "alembert/native/module.hpp"
#include "alembert/native/process.hpp"
#include "alembert/ode/integrate.hpp"
#include "tools.hpp"

namespace runtime_compile {

using namespace alembert;
namespace fs = std::filesystem;

namespace {

/// A simple pendulum with a damper, as the emitter would write it: par = l, g, d; then the constant g/l.
std::string pendulum_source(int abi = abi_version) {
    return R"(
extern "C" {
double sin(double);
double cos(double);
struct alembert_solver_table {
    int abi, coordinates, speeds, parameters, constants, outputs, events, constraints;
    const char* scene;
    const char* formulation;
    const char* const* coordinate_names;
    const char* const* speed_names;
    const char* const* parameter_names;
    const char* const* output_names;
    const char* const* event_names;
    const double* parameter_values;
    void (*prepare)(double*);
    void (*rhs)(double, const double*, const double*, double*);
    void (*mass_forcing)(double, const double*, const double*, double*, double*);
    void (*energy)(double, const double*, const double*, const double*, double*, double*);
    void (*outputs_at)(double, const double*, const double*, const double*, double*);
    void (*events_at)(double, const double*, const double*, const double*, double*);
    void (*constraints_at)(double, const double*, const double*, double*, double*, double*);
    void (*multipliers_at)(double, const double*, const double*, double*);
};
}
namespace {
void prepare(double* par) { par[3] = par[1] / par[0]; }
void rhs(double, const double* state, const double* par, double* rate) {
    rate[0] = state[1];
    rate[1] = -par[3] * sin(state[0]) - par[2] * state[1];
}
void mass_forcing(double, const double* state, const double* par, double* mass, double* forcing) {
    mass[0] = par[0] * par[0];
    forcing[0] = -par[1] * par[0] * sin(state[0]) - par[2] * par[0] * par[0] * state[1];
}
void energy(double, const double* state, const double*, const double* par, double* energy, double* jacobi) {
    energy[0] = par[0] * par[0] * state[1] * state[1] / 2;
    energy[1] = -par[1] * par[0] * cos(state[0]);
    energy[2] = energy[0] + energy[1];
    energy[3] = -par[2] * par[0] * par[0] * state[1] * state[1];
    *jacobi = energy[2];
}
void outputs_at(double, const double* state, const double*, const double* par, double* out) {
    out[0] = par[0] * sin(state[0]);
}
void events_at(double, const double* state, const double*, const double*, double* out) { out[0] = state[0]; }
const char* const coordinates[] = {"theta"};
const char* const parameters[] = {"l", "g", "d"};
const char* const outputs[] = {"x"};
const char* const events[] = {"bottom"};
const double values[] = {1.0, 9.81, 0.0};
const alembert_solver_table table = {
    )" + std::to_string(abi) +
           R"(, 1, 1, 3, 1, 1, 1, 0, "pendulum", "by hand", coordinates, nullptr, parameters, outputs, events, values,
    prepare, rhs, mass_forcing, energy, outputs_at, events_at, nullptr, nullptr};
}
extern "C" const alembert_solver_table* alembert_solver() { return &table; }
)";
}

/// A separate cache for each test, removed at its end.
struct Cache {
    Cache() {
        std::string pattern = (fs::temp_directory_path() / "alembert-test-XXXXXX").string();
        REQUIRE(mkdtemp(pattern.data()) != nullptr);
        path = pattern;
    }
    Cache(const Cache&) = delete;
    Cache& operator=(const Cache&) = delete;
    ~Cache() { fs::remove_all(path); }
    CompileOptions options() const { return {.cache = path}; }
    std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(path), fs::directory_iterator()); }
    fs::path path;
};

/// A variable of the environment for the length of a block.
struct Variable {
    Variable(const char* key, const char* value)
        : name(key), had(std::getenv(key) != nullptr), before(had ? std::getenv(key) : "") {
        if (value != nullptr)
            setenv(key, value, 1);
        else
            unsetenv(key);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() {
        if (had)
            setenv(name, before.c_str(), 1);
        else
            unsetenv(name);
    }
    const char* name;
    bool had;
    std::string before;
};

std::string compile_error(const std::function<void()>& action) {
    try {
        action();
    } catch (const CompileError& error) {
        return error.what();
    }
    return "";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Runs `child` in that many processes at once; how many of them returned true.
int in_processes(int count, const std::function<bool()>& child) {
    std::vector<pid_t> children;
    for (int i = 0; i < count; ++i) {
        const pid_t process = fork();
        if (process == 0) {
            bool good = false;
            try {
                good = child();
            } catch (...) {
            }
            _exit(good ? 0 : 1);
        }
        children.push_back(process);
    }
    int good = 0;
    for (const pid_t process : children) {
        int status = 1;
        waitpid(process, &status, 0);
        good += status == 0;
    }
    return good;
}

}  // namespace

TEST_CASE("fingerprint: the published values of FNV-1a with 128 bits") {
    const auto of = [](std::string_view text) {
        Fingerprint print;
        print.add_bytes(text);
        return print.hex();
    };
    CHECK(of("") == "6c62272e07bb014262b821756295c58d");
    CHECK(of("a") == "d228cb696f1a8caf78912b704e4a8964");
    CHECK(of("abc") == "a68d622cec8b5822836dbc7977af7f3b");
}

TEST_CASE("process: arguments reach the program unchanged, and its output comes back") {
    const Process echo = run({find_program("printf").string(), "%s|", "a b", "$HOME", "`id`; *"});
    CHECK(echo.status == 0);
    CHECK(echo.output == "a b|$HOME|`id`; *|");
    CHECK(run({find_program("false").string()}).status == 1);
    CHECK(find_program("no-such-program-anywhere").empty());
    CHECK(contains(compile_error([] { run({"/no/such/program"}); }), "/no/such/program"));
}

TEST_CASE("compile: the second time it comes from the cache; other text or flags do not") {
    const Cache cache;
    const Compilation first = compile(pendulum_source(), "a pendulum/../x", cache.options());
    CHECK(!first.from_cache);
    CHECK(first.object.parent_path() == cache.path);
    CHECK(first.object.filename().string().starts_with("a_pendulum____x-"));
    CHECK(cache.files() == 2);  // object and source
    const Compilation second = compile(pendulum_source(), "a pendulum/../x", cache.options());
    CHECK(second.from_cache);
    CHECK(second.object == first.object);
    CHECK(!compile(pendulum_source() + "// another\n", "a pendulum/../x", cache.options()).from_cache);
    CompileOptions fast = cache.options();
    fast.fast_math = true;
    CHECK(!compile(pendulum_source(), "a pendulum/../x", fast).from_cache);
}

TEST_CASE("compile: an entry that was cut short or altered is compiled again") {
    const Cache cache;
    const fs::path object = compile(pendulum_source(), "pendulum", cache.options()).object;
    const auto size = fs::file_size(object);
    fs::resize_file(object, size / 2);
    CHECK(!compile(pendulum_source(), "pendulum", cache.options()).from_cache);
    CHECK(fs::file_size(object) == size);
    {
        std::fstream file(object, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(size / 2));
        file.put('\x5a').put('\xa5').put('\x5a');
    }
    CHECK(!compile(pendulum_source(), "pendulum", cache.options()).from_cache);
    fs::resize_file(object, 0);
    CHECK(!compile(pendulum_source(), "pendulum", cache.options()).from_cache);
    CHECK(compile(pendulum_source(), "pendulum", cache.options()).from_cache);
    CHECK(load(object).table().coordinates == 1);
}

TEST_CASE("compile: several processes that compile the same thing at once do not disturb each other") {
    const Cache cache;
    const int good = in_processes(4, [&] {
        const Module module = load(compile(pendulum_source(), "pendulum", cache.options()).object);
        double rate[2];
        const double state[2] = {0.5, 0.25};
        make_rhs(module)(0, state, rate);
        return rate[0] == 0.25 && std::abs(rate[1] + 9.81 * std::sin(0.5)) < 1e-14;
    });
    CHECK(good == 4);
    CHECK(compile(pendulum_source(), "pendulum", cache.options()).from_cache);
    CHECK(cache.files() == 2);  // no further files
}

TEST_CASE("compile: the error contains the compiler's messages") {
    const Cache cache;
    const std::string message =
        compile_error([&] { compile("int f() { return nothing_here; }", "bad", cache.options()); });
    CHECK(contains(message, "nothing_here"));
    CHECK(contains(message, "-ffp-contract=fast"));
    CHECK(contains(message, "status 1"));
    CHECK(cache.files() == 0);
}

TEST_CASE("compile: the message about a missing compiler says what was looked for and what to install") {
    const Cache cache;
    CompileOptions options = cache.options();
    options.compiler = "no-such-compiler";
    std::string message = compile_error([&] { compile("", "x", options); });
    CHECK(contains(message, "no-such-compiler"));
    CHECK(contains(message, "apt install g++"));
    {
        const Variable path("PATH", "/nowhere");
        const Variable cxx("CXX", nullptr);
        message = compile_error([&] { compile("", "x", cache.options()); });
        CHECK(contains(message, "g++ and clang++"));
    }
    const Variable cxx("CXX", "no-such-cxx -m64");
    message = compile_error([&] { compile("", "x", cache.options()); });
    CHECK(contains(message, "no-such-cxx -m64 (from $CXX)"));
}

TEST_CASE("compile: $CXX may carry arguments") {
    const Cache cache;
    const std::string compiler = find_program("g++").string() + " -DVALUE=7";
    const Variable cxx("CXX", compiler.c_str());
    CHECK(compile_error([&] { compile("static_assert(VALUE == 7);", "x", cache.options()); }).empty());
}

TEST_CASE("compile: every installed compiler accepts the flags") {
    const Cache cache;
    for (const char* compiler : {"g++", "clang++"}) {
        if (!test::has_program(compiler)) continue;
        for (const bool fast : {false, true}) {
            CAPTURE(compiler);
            CompileOptions options = cache.options();
            options.compiler = compiler;
            options.fast_math = fast;
            const Compilation compiled = compile(pendulum_source(), "pendulum", options);
            CHECK(!compiled.from_cache);
            CHECK(load(compiled.object).table().parameters == 3);
        }
    }
    volatile double tiny = 1e-310;  // no object may switch the process to flush-to-zero
    CHECK(tiny / 2 > 0);
}

TEST_CASE("compile: if the cache cannot be written, a private folder is used") {
    const Cache cache;
    const fs::path file = cache.path / "file";
    std::ofstream(file) << "in the way";
    const Compilation compiled = compile(pendulum_source(), "pendulum", {.cache = file / "below"});
    CHECK(load(compiled.object).table().coordinates == 1);
    CHECK(compiled.object.parent_path() != file);
    const Variable xdg("XDG_CACHE_HOME", "relative/paths/are/ignored");
    const Variable home("HOME", nullptr);
    CHECK(compile(pendulum_source(), "pendulum", {}).object.parent_path() == compiled.object.parent_path());
}

TEST_CASE("compile: $XDG_CACHE_HOME is where the cache is") {
    const Cache cache;
    const Variable xdg("XDG_CACHE_HOME", cache.path.c_str());
    CHECK(compile(pendulum_source(), "pendulum", {}).object.parent_path() == cache.path / "alembert");
}

TEST_CASE(
    "compile: of what is known about the processor the first text is kept, and none that somebody has changed") {
    const Cache cache;
    const Variable xdg("XDG_CACHE_HOME", cache.path.c_str());
    CHECK(!kept_about_processor("times"));
    keep_about_processor("times", "1 2\n");
    keep_about_processor("times", "3 4\n");  // as another process that has measured at the same time
    CHECK(kept_about_processor("times") == "1 2\n");
    CHECK(!kept_about_processor("other"));
    for (const fs::directory_entry& file : fs::directory_iterator(cache.path / "alembert"))
        std::ofstream(file.path(), std::ios::app) << "5";
    CHECK(!kept_about_processor("times"));
    keep_about_processor("times", "3 4\n");
    CHECK(kept_about_processor("times") == "3 4\n");
    CHECK(std::distance(fs::directory_iterator(cache.path / "alembert"), {}) == 1);  // nothing else is left
    const Variable nowhere("XDG_CACHE_HOME", "/dev/null");
    keep_about_processor("times", "5 6\n");
    CHECK(!kept_about_processor("times"));
}

TEST_CASE("compile: folders of the cache and their contents belong to the owner only, whatever the umask is") {
    const Cache cache;
    const mode_t before = umask(0);
    const Compilation compiled = compile(pendulum_source(), "pendulum", {.cache = cache.path / "a" / "b"});
    umask(before);
    for (const fs::path& path : {cache.path / "a", cache.path / "a" / "b", compiled.object})
        CHECK(fs::status(path).permissions() == fs::perms::owner_all);
    CHECK(compile(pendulum_source(), "pendulum", {.cache = cache.path / "a" / "b"}).from_cache);
}

TEST_CASE("compile: a cache in which others can write, or that belongs to somebody else, is refused") {
    const Cache cache;
    compile(pendulum_source(), "pendulum", cache.options());
    for (const fs::perms right : {fs::perms::group_write, fs::perms::others_write}) {
        fs::permissions(cache.path, fs::perms::owner_all | right);
        const std::string message =
            compile_error([&] { compile(pendulum_source(), "pendulum", cache.options()); });
        CHECK(contains(message, cache.path.string()));
        CHECK(contains(message, "chmod go-w"));
    }
    fs::permissions(cache.path, fs::perms::owner_all);
    CHECK(compile(pendulum_source(), "pendulum", cache.options()).from_cache);
    if (geteuid() != 0) return;  // only the superuser can give a folder away
    REQUIRE(chown(cache.path.c_str(), 1, 1) == 0);
    CHECK(contains(compile_error([&] { compile(pendulum_source(), "pendulum", cache.options()); }),
                   "belongs to user 1"));
}

TEST_CASE(
    "compile: an entry that is a link, a pipe, or that somebody else can write is not loaded but compiled again") {
    const Cache cache;
    const fs::path object = compile(pendulum_source(), "pendulum", cache.options()).object,
                   elsewhere = cache.path / "elsewhere";
    const auto is_renewed = [&] {
        const bool renewed = !compile(pendulum_source(), "pendulum", cache.options()).from_cache;
        return renewed && fs::symlink_status(object).type() == fs::file_type::regular &&
               compile(pendulum_source(), "pendulum", cache.options()).from_cache;
    };
    fs::rename(object, elsewhere);
    fs::create_symlink(elsewhere, object);  // the same bytes as an ordinary file would be accepted
    CHECK(is_renewed());
    fs::remove(object);
    REQUIRE(mkfifo(object.c_str(), 0600) == 0);
    CHECK(is_renewed());
    fs::permissions(object, fs::perms::owner_all | fs::perms::others_write);
    CHECK(is_renewed());
    if (geteuid() != 0) return;
    REQUIRE(chown(object.c_str(), 1, 1) == 0);
    CHECK(is_renewed());
}

TEST_CASE("compile: a source that cannot be written whole is an error of the environment") {
    const Cache cache;
    const int good = in_processes(1, [&] {
        signal(SIGXFSZ, SIG_IGN);  // a full disk, for this process
        const rlimit limit{.rlim_cur = 100, .rlim_max = 100};
        setrlimit(RLIMIT_FSIZE, &limit);
        return contains(compile_error([&] { compile(pendulum_source(), "x", cache.options()); }),
                        "is the disk full?");
    });
    CHECK(good == 1);
    CHECK(cache.files() == 0);
}

TEST_CASE("module: another version of the ABI is refused with both numbers") {
    const Cache cache;
    const fs::path object = compile(pendulum_source(abi_version + 41), "old", cache.options()).object;
    const std::string message = compile_error([&] { load(object); });
    CHECK(contains(message, "version " + std::to_string(abi_version + 41)));
    CHECK(contains(message, "has version " + std::to_string(abi_version)));
}

TEST_CASE("module: a file that is no solver is refused") {
    const Cache cache;
    CHECK(contains(compile_error([&] { load(cache.path / "missing.so"); }), "missing.so"));
    const fs::path object = compile("int nothing;", "empty", cache.options()).object;
    CHECK(contains(compile_error([&] { load(object); }), "alembert_solver"));
}

TEST_CASE("module: it stays loaded as long as a right-hand side needs it") {
    const Cache cache;
    const Rhs rhs = make_rhs(load(compile(pendulum_source(), "pendulum", cache.options()).object));
    double rate[2];
    const double state[2] = {std::numbers::pi / 2, 0};
    rhs(0, state, rate);
    CHECK(rate[1] == -9.81);
    CHECK(rhs.names == std::vector<std::string>{"theta", "theta'"});
    CHECK_THROWS_AS(make_rhs(load(compile(pendulum_source(), "pendulum", cache.options()).object), {1.0}),
                    std::invalid_argument);
}

// θ'' = −(g/l) sin θ from θ₀ at rest: a quarter of the period is √(l/g) K(sin(θ₀/2)); there θ' = −2 √(g/l)
// sin(θ₀/2).
TEST_CASE("solver: an emitted pendulum swings with the period of the elliptic integral") {
    const Cache cache;
    const Module module = load(compile(pendulum_source(), "pendulum", cache.options()).object);
    const double l = 0.7, g = 9.7, start = 2.5;
    const std::vector<double> values = {l, g, 0};
    const double quarter = std::sqrt(l / g) * std::comp_ellint_1(std::sin(start / 2));
    const Trajectory motion =
        integrate(make_rhs(module, values), {start, 0}, {.duration = 4 * quarter, .tolerance = 1e-13},
                  make_events(module, values, {}));
    // Some hundred steps with a local error of 1e-13; the rate is about 7, the acceleration about 14.
    CHECK(std::abs(motion.final_state()[0] - start) < 1e-11);
    CHECK(std::abs(motion.final_state()[1]) < 1e-10);
    REQUIRE(motion.events.size() == 2);
    CHECK(motion.events[0].name == "bottom");
    CHECK(std::abs(motion.events[0].time - quarter) < 1e-11);
    CHECK(std::abs(motion.events[1].time - 3 * quarter) < 1e-11);
    CHECK(std::abs(motion.events[0].state[1] + 2 * std::sqrt(g / l) * std::sin(start / 2)) < 1e-10);
}

TEST_CASE("solver: the work of a damper is the loss of energy") {
    const Cache cache;
    const Module module = load(compile(pendulum_source(), "pendulum", cache.options()).object);
    const std::vector<double> values = {1, 9.81, 0.3};
    const std::vector<double> par = prepared(module, values);
    CHECK(par[3] == 9.81);
    const auto energy = [&](std::span<const double> state) {
        double energy[4], jacobi = 0;
        const double rate[2] = {};
        module.table().energy(0, state.data(), rate, par.data(), energy, &jacobi);
        return energy[2];
    };
    const Trajectory motion =
        integrate(make_rhs(module, values, Work::integrated), {2, 0, 0}, {.duration = 5, .tolerance = 1e-12});
    CHECK(motion.names.back() == "work");
    for (std::size_t row = 0; row < motion.rows(); ++row)
        // the work has no error control of its own, but the same stages
        CHECK(std::abs(energy(motion.state(row)) - energy(motion.state(0)) - motion.state(row)[2]) < 1e-10);
    CHECK(motion.final_state()[2] < -3);
}

}  // namespace runtime_compile
