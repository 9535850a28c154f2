// SPDX-License-Identifier: MIT
// The targets of -o: ordinary files, links, pipes, devices, and files that must not be overwritten.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "scenes.hpp"
#include "shell.hpp"

namespace commands_output {

using namespace alembert::test;
namespace fs = std::filesystem;

namespace {

const std::string falling = R"toml(
[coordinates]
x = 1
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[simulation]
duration = 1
sample = 0.5
)toml";

const std::string header = "t,x,x',energy\n";

std::string contents(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// A folder with a scene in it.
struct Place {
    fs::path folder = temporary_folder("output"), scene = folder / "falling.toml";
    Place() { std::ofstream(scene) << falling; }
    Run simulate(const fs::path& output) const {
        return run({"simulate", scene.string(), "--no-estimate", "-o", output.string()});
    }
    std::ptrdiff_t files() const {
        return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
    }
};

}  // namespace

TEST_CASE("output: a file is replaced as a whole and keeps its mode; nothing else is left in the folder") {
    const Place place;
    const fs::path file = place.folder / "motion.csv";
    std::ofstream(file) << "before";
    chmod(file.c_str(), 0604);
    REQUIRE(place.simulate(file).exit == 0);
    CHECK(contents(file).starts_with(header));
    struct stat info {};
    REQUIRE(stat(file.c_str(), &info) == 0);
    CHECK((info.st_mode & 07777) == 0604);
    CHECK(place.files() == 2);
}

TEST_CASE(
    "output: of a symbolic link the target is written, and the link stays; one that leads nowhere yet makes its "
    "target") {
    const Place place;
    const fs::path link = place.folder / "link.csv", far = place.folder / "far.csv",
                   target = place.folder / "target.csv";
    fs::create_symlink("far.csv", link);
    fs::create_symlink(target, far);
    for (int k = 0; k < 2; ++k) {
        REQUIRE(place.simulate(link).exit == 0);
        CHECK(fs::is_symlink(link));
        CHECK(fs::is_symlink(far));
        CHECK(!fs::is_symlink(target));
        CHECK(contents(target).starts_with(header));
        std::ofstream(target) << "before";
    }
}

TEST_CASE("output: a pipe and a link to /dev/stdout get the same text as a file") {
    const Place place;
    REQUIRE(place.simulate(place.folder / "motion.csv").exit == 0);
    const std::string expected = contents(place.folder / "motion.csv");
    const Run piped = run_shell(
        R"(cd "$1" && mkfifo pipe && { cat pipe >got & }
           "$ALEMBERT" simulate falling.toml --no-estimate -o pipe
           code=$?
           : <>pipe  # ends a reader whom nobody has written to
           wait
           test -p pipe && exit $code)",
        {place.folder.string()});
    CHECK(piped.exit == 0);
    CHECK(contents(place.folder / "got") == expected);
    const Run shown = run_shell(
        R"(cd "$1" && ln -s /dev/stdout link &&
           "$ALEMBERT" simulate falling.toml --no-estimate -o link && test -L link)",
        {place.folder.string()});
    CHECK(shown.exit == 0);
    CHECK(shown.out.starts_with(expected));
    CHECK(contains(shown.out, "at t = 1\n"));
    const Run other =
        run_shell(R"(cd "$1" && "$ALEMBERT" simulate falling.toml --no-estimate -o /dev/fd/7 7>seventh)",
                  {place.folder.string()});
    CHECK(other.exit == 0);
    CHECK(contents(place.folder / "seventh") == expected);
    const Run gone = run_shell(
        R"(cd "$1" && mkfifo lost && { true <lost & }
           "$ALEMBERT" sweep falling.toml --vary x=1:2:2000 --duration 0.01 -o lost
           code=$?
           : <>lost
           exit $code)",
        {place.folder.string()});
    CHECK(gone.exit == 5);
    CHECK(contains(gone.err, "cannot write 'lost': Broken pipe"));
}

TEST_CASE("output: a device is written to, also through a link, and a full one is an error of the environment") {
    const Place place;
    for (const auto& [device, exit] : {std::pair{"/dev/null", 0}, std::pair{"/dev/full", 5}}) {
        const fs::path link = place.folder / fs::path(device).filename();
        fs::create_symlink(device, link);
        const Run result = place.simulate(link);
        CAPTURE(result.err);
        CHECK(result.exit == exit);
        CHECK(fs::is_symlink(link));
        CHECK(fs::is_character_file(device));
        if (exit == 5) CHECK(contains(result.err, "No space left on device"));
    }
}

TEST_CASE("output: the scene itself is refused as output, under its name and through links, and is not changed") {
    const Place place;
    const fs::path soft = place.folder / "soft.toml", hard = place.folder / "hard.toml";
    fs::create_symlink(place.scene, soft);
    fs::create_hard_link(place.scene, hard);
    fs::create_directory(place.folder / "code");
    fs::create_hard_link(place.scene, place.folder / "code" / "falling.cpp");
    const std::string scene = place.scene.string();
    for (const fs::path& file : {place.scene, soft, hard})
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"simulate", scene, "-o", file.string()},
              {"sweep", scene, "--vary", "x=1:2:2", "-o", file.string()},
              {"bench", scene, "--csv", file.string()},
              {"bench", scene, "--svg", file.string()}}) {
            const Run result = run(words);
            CAPTURE(words[0]);
            CHECK(result.exit == 3);
            CHECK(contains(result.err, "is the same file as the input"));
        }
    CHECK(run({"emit", scene, "-o", (place.folder / "code").string()}).exit == 3);
    CHECK(contents(place.scene) == falling);
    const fs::path robot = place.folder / "robot.urdf";
    fs::copy_file(source_path("tests/robots/torso.urdf"), robot);
    const std::string before = contents(robot);
    CHECK(run({"import", robot.string(), "-o", robot.string()}).exit == 3);
    CHECK(contents(robot) == before);
}

TEST_CASE(
    "output: a read-only file, a folder and a missing folder are errors of the environment, told before the work "
    "begins") {
    const Place place;
    const fs::path file = place.folder / "kept.csv";
    std::ofstream(file) << "kept";
    chmod(file.c_str(), 0444);
    const Run kept = place.simulate(file);
    CHECK(kept.exit == 5);
    CHECK(contains(kept.err, "kept.csv': it is read-only (mode 0444)"));
    CHECK(contents(file) == "kept");
    CHECK(kept.out.empty());
    const Run folder = place.simulate(place.folder), missing = place.simulate(place.folder / "none" / "x.csv");
    CHECK(folder.exit == 5);
    CHECK(contains(folder.err, "it is a folder"));
    CHECK(missing.exit == 5);
    CHECK(contains(missing.err, "there is no folder"));
}

TEST_CASE(
    "output: a name that promises another format is refused before the work begins, by every verb that writes") {
    const Place place;
    const std::string scene = place.scene.string(), hoop = source_path("scenes/textbook/rotating_hoop.toml");
    struct Case {
        std::vector<std::string> words;
        std::vector<std::string> right, wrong;
    };
    const std::vector<std::string> pictures{"x.svg", "x.SVG", "x"},
        no_pictures{"x.png", "x.pdf", "x.jpg", "x.csv"}, tables{"x.csv", "x.txt", "x.dat", "x.npz", "x"},
        no_tables{"x.svg", "x.json", "x.xlsx", "x.mat", "x.npy", "x.html"}, plain{"x.csv", "x.txt"},
        no_plain{"x.npz", "x.h5", "x.png"}, pages{"x.html", "x.htm"}, no_pages{"x.pdf", "x.md"};
    const std::vector<std::string> follow{"equilibrium", hoop, "--follow", "Omega=1:5"},
        locus{"stability", hoop, "--at", "theta=0", "--locus", "Omega=1:5:4"};
    const auto with = [](std::vector<std::string> words, const char* option) {
        words.emplace_back(option);
        return words;
    };
    const Case cases[] = {
        {{"simulate", scene, "--plot"}, pictures, no_pictures},
        {{"simulate", scene, "-o"}, tables, no_tables},
        {{"sweep", scene, "--vary", "x=1:2:2", "--svg"}, pictures, no_pictures},
        {{"sweep", scene, "--vary", "x=1:2:2", "-o"}, tables, no_tables},
        {{"derive", scene, "--draw"}, pictures, no_pictures},
        {with(follow, "--svg"), {"x.svg"}, no_pictures},
        {with(follow, "-o"), plain, no_plain},
        {with(locus, "--svg"), {"x.svg"}, no_pictures},
        {with(locus, "-o"), plain, no_plain},
        {{"bench", scene, "--method", "rk4", "--csv"}, {}, no_plain},
        {{"bench", scene, "--method", "rk4", "--svg"}, {}, no_pictures},
        {{"linearize", hoop, "--along", "--duration", "0.1", "-o"}, plain, no_plain},
        {{"report", scene, "--no-motion", "-o"}, pages, no_pages},
        {{"fmu", scene, "-o"}, {"x.fmu"}, {"x.zip", "x"}},
        {{"import", source_path("tests/robots/torso.urdf"), "-o"}, {"x.toml"}, {"x.json", "x.xml"}},
    };
    for (const Case& one : cases) {
        CAPTURE(one.words[0]);
        CAPTURE(one.words.back());
        for (const auto& [names, is_right] : {std::pair{one.right, true}, std::pair{one.wrong, false}})
            for (const std::string& name : names) {
                CAPTURE(name);
                const fs::path file = place.folder / name;
                fs::remove(file);
                const Run result = run(with(one.words, file.c_str()));
                CAPTURE(result.err);
                CHECK(result.exit == (is_right ? 0 : 3));
                CHECK(fs::exists(file) == is_right);
                if (is_right) continue;
                CHECK(contains(result.err, name));
                CHECK(result.out.empty());
            }
    }
}

}  // namespace commands_output
