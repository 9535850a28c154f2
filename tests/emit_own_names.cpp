// SPDX-License-Identifier: MIT
// Names of emitted files: no header is linked with the source of another one, whatever a scene is called its files
// compile, and what the head says can be done.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <regex>
#include <set>
#include <sstream>

#include "alembert/base/error.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "codegen/emit/interface.hpp"
#include "emitted.hpp"
#include "files.hpp"
#include "near.hpp"
#include "program/interpret.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"
#include "shell.hpp"
#include "simulate/evaluate.hpp"
#include "simulate/simulate.hpp"

namespace emit_own_names {

using namespace alembert;

namespace {

/// A pendulum of this length, which begins at rest at 0.3 rad.
Scene pendulum(const std::string& length) {
    return parse_scene("gravity = [0, -9.81]\n[parameters]\nl = " + length +
                           "\n[coordinates]\ntheta = 0.3\n[[particle]]\nname = \"p\"\nmass = 1\nposition = "
                           "[\"l*sin(theta)\", \"-l*cos(theta)\"]\n",
                       "pendulum.toml");
}

/// A particle that falls from 5 m, in a scene of this name.
Scene falling(const std::string& name, const std::string& more = "") {
    return parse_scene(
        "gravity = [0, -10]\n[coordinates]\ny = 5\n[[particle]]\nname = \"p\"\nmass = 2\n"
        "position = [0, \"y\"]\n" +
            more,
        name + ".toml");
}

std::string acceleration_of(const std::string& folder) {
    return fmt::format(
        "#include \"{0}/pendulum.hpp\"\ndouble {0}() {{ return pendulum::rhs(0, pendulum::initial_state, "
        "pendulum::defaults()).theta_dot; }}\n",
        folder);
}

std::string command_in(const std::string& text) {
    const std::size_t begin = text.find("  alembert emit ");
    return begin == std::string::npos ? "" : text.substr(begin + 2, text.find('\n', begin) - begin - 2);
}

}  // namespace

TEST_CASE("emitted C++: two systems of one name in a program each keep to their own numbers") {
    const test::Folder folder;
    for (const char* const name : {"a", "b"}) std::filesystem::create_directory(folder.path / name);
    const auto emit_to = [&](const std::string& name, const std::string& length) {
        for (const SourceFile& file : files_of(emission(pendulum(length))))
            folder.write(name + "/" + file.name, file.text);
        folder.write(name + ".cpp", acceleration_of(name));
    };
    emit_to("a", "1");
    emit_to("b", "2");
    folder.write(
        "main.cpp",
        "#include <cstdio>\ndouble a(), b();\nint main() { std::printf(\"%.17g\\n%.17g\\n\", a(), b()); }\n");
    const double g = -9.81 * std::sin(0.3);
    test::check_near(
        folder.numbers("c++ -std=c++17 main.cpp a.cpp b.cpp a/pendulum.cpp b/pendulum.cpp -o program && "
                       "./program"),
        {g, g / 2}, 1e-14);
    // In one unit they are told to be two.
    folder.write("both.cpp", "#include \"a/pendulum.hpp\"\n#include \"b/pendulum.hpp\"\n");
    CHECK(folder.told("c++ -std=c++17 -fsyntax-only both.cpp").find("two systems are called pendulum") !=
          std::string::npos);
    // A header that is older than the source is not linked with it.
    folder.write("only.cpp", "double a();\nint main() { return a() < 0 ? 0 : 1; }\n");
    CHECK(folder.runs("c++ -std=c++17 only.cpp a.cpp a/pendulum.cpp -o program && ./program"));
    const std::string told = folder.told("c++ -std=c++17 only.cpp a.cpp b/pendulum.cpp -o program");
    CHECK(told.find("undefined reference to `pendulum_") != std::string::npos);
    // The same source in two namespaces of a unit, and in another unit.
    folder.write(
        "spaces.cpp",
        "namespace one {\n#include \"a/pendulum.cpp\"\n}\nnamespace two {\n#include \"a/pendulum.cpp\"\n}\n"
        "double a();\nint main() { return one::pendulum::table.coordinates == "
        "two::pendulum::table.coordinates && a() < 0 ? 0 : 1; }\n");
    CHECK(folder.told("c++ -std=c++20 spaces.cpp a.cpp a/pendulum.cpp -o program && ./program") == "");
}

TEST_CASE("emitted C++: no namespace has a name that a header of C, C++ or POSIX declares") {
    const test::Folder folder;
    std::string headers;
    for (const char* const header : {"aio.h",
                                     "arpa/inet.h",
                                     "dirent.h",
                                     "dlfcn.h",
                                     "err.h",
                                     "error.h",
                                     "execinfo.h",
                                     "fcntl.h",
                                     "fenv.h",
                                     "fmtmsg.h",
                                     "fnmatch.h",
                                     "ftw.h",
                                     "getopt.h",
                                     "glob.h",
                                     "grp.h",
                                     "iconv.h",
                                     "langinfo.h",
                                     "libgen.h",
                                     "malloc.h",
                                     "math.h",
                                     "monetary.h",
                                     "mqueue.h",
                                     "net/if.h",
                                     "netdb.h",
                                     "nl_types.h",
                                     "poll.h",
                                     "pthread.h",
                                     "pwd.h",
                                     "regex.h",
                                     "sched.h",
                                     "search.h",
                                     "semaphore.h",
                                     "setjmp.h",
                                     "signal.h",
                                     "spawn.h",
                                     "stdio.h",
                                     "stdlib.h",
                                     "string.h",
                                     "strings.h",
                                     "sys/epoll.h",
                                     "sys/ipc.h",
                                     "sys/mman.h",
                                     "sys/mount.h",
                                     "sys/msg.h",
                                     "sys/select.h",
                                     "sys/sem.h",
                                     "sys/shm.h",
                                     "sys/socket.h",
                                     "sys/stat.h",
                                     "sys/time.h",
                                     "sys/times.h",
                                     "sys/uio.h",
                                     "sys/un.h",
                                     "sys/utsname.h",
                                     "sys/wait.h",
                                     "syslog.h",
                                     "termios.h",
                                     "time.h",
                                     "unistd.h",
                                     "utime.h",
                                     "utmpx.h",
                                     "wchar.h",
                                     "wctype.h",
                                     "wordexp.h",
                                     "algorithm",
                                     "atomic",
                                     "chrono",
                                     "complex",
                                     "filesystem",
                                     "functional",
                                     "iostream",
                                     "memory",
                                     "mutex",
                                     "random",
                                     "regex",
                                     "string",
                                     "thread",
                                     "vector",
                                     "condition_variable"})
        headers += fmt::format("#if __has_include(<{0}>)\n#include <{0}>\n#endif\n", header);
    folder.write("headers.cpp", headers);
    // All words of the headers, also those of arguments and members.
    std::istringstream text(folder.told("c++ -std=gnu++20 -E -P headers.cpp"));
    const std::string all{std::istreambuf_iterator<char>(text), {}};
    const std::regex word("[A-Za-z_][A-Za-z0-9_]*");
    std::set<std::string> words;
    for (std::sregex_iterator w(all.begin(), all.end(), word), end; w != end; ++w) words.insert(w->str());
    REQUIRE(words.size() > 4000);
    Program program;
    std::size_t kept = 0;
    for (const std::string& name : words) {
        if (name.find("__") != std::string::npos || name[0] == '_') continue;
        program.name = name;
        const std::string space = namespace_of(program);
        if (space == name) ++kept;
        headers += fmt::format("namespace {} {{ }}\n", space);
    }
    CHECK(kept > 2000);  // arguments and members, which hinder nobody
    folder.write("spaces.cpp", headers);
    CHECK(folder.told("c++ -std=gnu++20 -w -fsyntax-only spaces.cpp") == "");
}

TEST_CASE("emitted C++: scenes called after what emitted files or main programs declare compile and run") {
    const test::Folder folder;
    const char* const uses =
        "#include <alembert/native/abi.hpp>\n#include <cstdio>\n#include \"{0}.hpp\"\nint main() {{ "
        "std::printf(\"%.17g\\n\", {1}::rhs(0, {1}::initial_state, {1}::defaults()).y_dot); }}\n";
    for (const std::string name :
         {"code", "interface", "alembert", "alembert_solver", "alembert_tables", "main"}) {
        CAPTURE(name);
        const Scene scene = falling(name);
        const Emission e = emission(scene);
        folder.write(e);
        folder.write("main_.cpp", fmt::format(fmt::runtime(uses), name, namespace_of(e.choice.program)));
        CHECK(folder.numbers(fmt::format("c++ -std=c++20 -I{} main_.cpp {}.cpp -o program && ./program",
                                         test::source_path("lib"), name)) == std::vector<double>{-10});
        const Module module = load(compile(e.source.text, "named", {}).object);
        double state[] = {5, 0}, rate[2];
        module.table().rhs(0, state, prepared(module).data(), rate);
        CHECK(rate[1] == -10);
    }
    const std::string floor = "[[event]]\nname = \"floor\"\nwhen = \"y\"\nstop = true\n";
    for (const std::string name : {"step", "events", "size", "held", "hold", "Hold", "rates", "run", "stages",
                                   "print_row", "number", "balance", "vertex", "n", "table", "code"})
        for (const CodeLanguage language : {CodeLanguage::cpp, CodeLanguage::c}) {
            CAPTURE(name);
            folder.emit(falling(name, floor), {.language = language, .standalone = true});
            const std::string build =
                language == CodeLanguage::c
                    ? fmt::format("cc -std=c99 -Wall -Werror {0}_main.c {0}.c -lm -o alone", name)
                    : fmt::format("c++ -std=c++20 -Wall -Werror {}_main.cpp -o alone", name);
            CHECK(folder.told(build) == "");
            const std::string rows = folder.told("./alone 3 1e-12 1");
            CHECK(std::abs(std::stod(rows.substr(rows.rfind('\n', rows.size() - 2) + 1)) - 1) < 1e-10);
        }
}

TEST_CASE("emit: the function of a frame that has the name of another function is refused") {
    CHECK_THROWS_WITH_AS(emission(falling("x", "[[point]]\nname = \"parameter\"\noffset = [0, \"y\"]\n"),
                                  {.jacobian = true, .frames = {"parameter"}}),
                         doctest::Contains("'parameter_jacobian'"), ModelError);
    CHECK_NOTHROW(emission(falling("x", "[[point]]\nname = \"parameter\"\noffset = [0, \"y\"]\n"),
                           {.frames = {"parameter"}}));
    CHECK_THROWS_WITH_AS(emission(falling("x", "[[point]]\nname = \"com\"\noffset = [0, \"y\"]\n"),
                                  {.functions = {"com_jacobian"}, .frames = {"com"}}),
                         doctest::Contains("'com_jacobian'"), ModelError);
}

TEST_CASE("emit: the command in the head makes the same files, whatever the scene's file is called") {
    const test::Folder folder;
    for (const std::string file : {"pendulum.toml", "it's mine; two words.toml", "-dash.toml"}) {
        CAPTURE(file);
        const Scene scene = parse_scene(pendulum("1").text, file);
        folder.write(file, scene.text);
        EmissionOptions options{.jacobian = true, .functions = {"mass", "bias"}, .frames = {"p"}};
        const Emission e = emission(scene, options);
        const std::string command = command_in(e.source.text);
        CAPTURE(command);
        CHECK(command == command_in(e.source.header->text));
        REQUIRE(command.starts_with("alembert "));
        const test::Run made = test::run_shell("cd \"$1\" && alembert() { \"$ALEMBERT\" \"$@\"; } && " + command,
                                               {folder.path.string()});
        CHECK(made.exit == 0);
        for (const SourceFile& one : files_of(e)) CHECK(test::contents(folder.file(one.name)) == one.text);
    }
}

TEST_CASE("emit: a head says that M has a term for norms of quaternions just where it has") {
    int with = 0, without = 0;
    for (const char* const name :
         {"benchmark/free_body", "textbook/free_body_quaternion", "textbook/heavy_top_quaternion",
          "textbook/heavy_top_joint", "textbook/double_pendulum"})
        for (const char* const by : {"", "routh", "recursive"}) {
            CAPTURE(name);
            CAPTURE(by);
            const Scene scene = read_scene(test::source_path(fmt::format("scenes/{}.toml", name)));
            std::optional<Emission> e;
            try {
                e = emission(scene, {.by = by});
            } catch (const ModelError&) {
                continue;  // not for this scene
            }
            const Program& program = e->choice.program;
            const std::vector<int> mass = program.nodes_of(Group::mass);
            if (mass.empty() || !program.speeds.empty()) continue;
            const Evaluation at = evaluate(scene, {.matrices = true});
            REQUIRE(at.mass.size() == program.coordinates.size());
            const std::vector<double> value =
                interpret(program, state_of(start_of(e->mechanism), e->mechanism, e->equations));
            double differs = 0;
            for (std::size_t i = 0, k = 0; i < at.mass.size(); ++i)
                for (std::size_t j = 0; j <= i; ++j)
                    differs =
                        std::max(differs, std::abs(value[static_cast<std::size_t>(mass[k++])] - at.mass[i][j]));
            const bool is_told = e->source.text.find("M + c A^T A row by row") != std::string::npos;
            CHECK(is_told == (differs > 1e-12));
            ++(is_told ? with : without);
        }
    CHECK(with > 0);
    CHECK(without > 0);
}

TEST_CASE("emit: a scene that cannot be assembled has no initial state in its header") {
    const Scene apart = parse_scene(R"toml(
[coordinates]
x = { guess = 1 }
y = { guess = 0 }
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "nowhere"
holonomic = "x^2 + y^2 + 1"
)toml",
                                    "apart.toml");
    const Emission e = emission(apart);
    CHECK(e.source.header->text.find("initial_state") == std::string::npos);
    CHECK(e.source.header->text.find("apart::State state = {}") != std::string::npos);
    const test::Folder folder;
    folder.write(e);
    CHECK(folder.told("c++ -std=c++17 -Wall -Wextra -Werror -c apart.cpp") == "");
    const std::string own = emission(pendulum("1")).source.header->text;
    CHECK(own.find("initial_state = {\n    0.3,  // theta\n") != std::string::npos);
}

TEST_CASE("emit: what a header says of a value in degrees stands beside that value") {
    const Scene scene = parse_scene(R"toml(
[parameters]
slope = { value = 40, unit = "deg", about = "of the plane" }
[coordinates]
theta = { initial = 60, unit = "deg", about = "from the vertical" }
phi = { guess = 30, unit = "deg" }
psi = { guess = 30, unit = "deg" }
[[particle]]
name = "p"
mass = 1
position = ["cos(theta)", "sin(theta) + phi + psi", "slope*phi"]
[[constraint]]
name = "together"
holonomic = "phi - theta"
)toml",
                                    "angles.toml");
    const std::string header = emission(scene).source.header->text;
    CAPTURE(header);
    CHECK(header.find("double slope = 0.6981317007977318;  ///< [rad] 40 deg, of the plane\n") !=
          std::string::npos);
    CHECK(header.find("double theta = 0;  ///< [rad] from the vertical\n") != std::string::npos);
    CHECK(header.find("    1.0471975511965976,  // theta, 60 deg\n") != std::string::npos);
    CHECK(std::regex_search(header, std::regex("    1\\.0471975511965976,  // phi\n")));  // moved from 30 deg
    CHECK(header.find("    0.5235987755982988,  // psi, 30 deg\n") != std::string::npos);
}

TEST_CASE("emit: contacts, dry friction and impulses are told to be left out, and nothing else is") {
    const auto told = [](const char* name) {
        const Emission e = emission(read_scene(test::source_path(fmt::format("scenes/{}.toml", name))));
        const bool is_warned = std::any_of(e.warnings.begin(), e.warnings.end(), [](const std::string& w) {
            return w.find("are left out of emitted functions") != std::string::npos;
        });
        for (const CodeLanguage language : {CodeLanguage::cpp, CodeLanguage::c, CodeLanguage::javascript}) {
            const Scene scene = read_scene(test::source_path(fmt::format("scenes/{}.toml", name)));
            CHECK((emission(scene, {.language = language}).source.text.find("left out  ") != std::string::npos) ==
                  is_warned);
        }
        return is_warned;
    };
    CHECK(told("friction/stick_slip"));
    CHECK(told("benchmark/bouncing_ball"));
    CHECK_FALSE(told("textbook/double_pendulum"));
}

TEST_CASE("emit: a header of C names each place of state, parameters, inputs and outputs, in their order") {
    const Scene scene = parse_scene(R"toml(
[parameters]
m = 2
length = 1
[coordinates]
x = 0
state = 1
[inputs]
names = { value = 0, given = "outside" }
[energy]
kinetic = "m*(x'^2 + state'^2)/2"
[forces]
x = "names - x/length"
[outputs]
double = "2*x"
[[event]]
name = "at"
when = "x - 1"
)toml",
                                    "box.toml");
    const std::string header = emission(scene, {.language = CodeLanguage::c}).source.header->text;
    CAPTURE(header);
    const auto has = [&](const std::string& text) { return header.find(text) != std::string::npos; };
    CHECK(has(
        "enum {\n    box_state_x,\n    box_state_state_,\n    box_state_x_dot,\n    box_state_state_dot,\n};"));
    CHECK(has("enum {\n    box_par_m,\n    box_par_length,\n};"));
    CHECK(has("enum {\n    box_in_names,\n};"));
    CHECK(has("enum {\n    box_out_double_,\n};"));
    CHECK(has("enum {\n    box_event_at,\n};"));
    CHECK_FALSE(has("\n\n\n"));
}

TEST_CASE("emit: a main program ends at an event that passes and comes back within one step") {
    // Free flight is integrated exactly, by steps as long as the rows allow; above 1.2499 m there are 2 % of the
    // time.
    const std::string body = R"toml(gravity = [0, -10]
[coordinates]
x = 0
y = { initial = 0, rate = 5 }
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[[event]]
name = "top"
when = "y - 1.2499"
direction = "up"
stop = true
)toml";
    const double expected = 0.5 - std::sqrt(0.25 - 1.2499 / 5);
    const test::Folder folder;
    for (const CodeLanguage language : {CodeLanguage::cpp, CodeLanguage::c}) {
        folder.emit(parse_scene(body, "flight.toml"), {.language = language, .standalone = true});
        REQUIRE(folder.told(language == CodeLanguage::c ? "cc -std=c99 flight_main.c flight.c -lm -o alone"
                                                        : "c++ -std=c++20 flight_main.cpp -o alone") == "");
        const std::string rows = folder.told("./alone 0.97 1e-3 1");
        CAPTURE(rows);
        CHECK(std::abs(std::stod(rows.substr(rows.rfind('\n', rows.size() - 2) + 1)) - expected) < 1e-9);
    }
}

}  // namespace emit_own_names
