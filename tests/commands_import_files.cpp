// SPDX-License-Identifier: MIT
// The files that a description includes: found beside it, in packages and in folders above, and never where they
// must not be read. Robots that are put together from several files accelerate as those that are written in one.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"

namespace commands_import_files {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

namespace fs = std::filesystem;

/// A folder of files of its own.
class Folder {
public:
    explicit Folder(const std::string& name) : root_(fs::path(temporary(name + ".txt", "")).parent_path() / name) {
        fs::remove_all(root_);
    }
    std::string write(const std::string& file, const std::string& text) const {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text;
        return path(file);
    }
    std::string path(const std::string& file) const { return (root_ / file).string(); }

private:
    fs::path root_;
};

const std::string pendulum =
    R"(<worldbody><body name="a"><joint name="j" axis="0 1 0"/><geom size="0.1" pos="0 0 0.2"/></body></worldbody>)";

std::string refusal(const std::string& file, const std::vector<std::string>& options = {}) {
    std::vector<std::string> args{"import", file, "-o", temporary("none.toml", "")};
    args.insert(args.end(), options.begin(), options.end());
    const auto result = run(args);
    CHECK(result.exit == 3);
    CHECK(result.seconds < 20);
    return result.err;
}

}  // namespace

TEST_CASE("import: an included file is read only in the folder of the robot, and only if it is a regular file") {
    const Folder folder("included");
    const auto including = [&](const std::string& name) {
        return folder.write("robots/arm.xml", "<mujoco>\n<include file=\"" + name + "\"/></mujoco>");
    };
    const std::string whole = "<mujoco>" + pendulum + "</mujoco>", scene = temporary("included.toml", "");
    folder.write("robots/parts/pendulum.xml", whole);
    const std::string outside = folder.write("other/pendulum.xml", whole);
    for (const char* name : {"parts/pendulum.xml", "../robots/parts/pendulum.xml"})
        CHECK(json_of({"import", including(name), "-o", scene})["coordinates"] == Json({"j"}));
    fs::create_symlink(outside, folder.path("robots/link.xml"));
    for (const std::string& name : {std::string("../other/pendulum.xml"), std::string("link.xml"), outside}) {
        CHECK(refusal(including(name)).find("arm.xml:2:1: '" + name + "' is outside the folder of this file") !=
              std::string::npos);
        CHECK(json_of({"import", including(name), "-o", scene, "--allow-outside"})["coordinates"] == Json({"j"}));
    }
    REQUIRE(mkfifo(folder.path("robots/pipe").c_str(), 0600) == 0);
    for (const char* options : {"", "--allow-outside"})
        CHECK(refusal(including("pipe"),
                      *options != 0 ? std::vector<std::string>{options} : std::vector<std::string>{})
                  .find("'pipe' is no regular file, but a pipe or a device") != std::string::npos);
    CHECK(refusal(including("/dev/zero"), {"--allow-outside"}).find("is no regular file") != std::string::npos);
    CHECK(refusal(including("parts")).find("'parts' is a folder") != std::string::npos);
    CHECK(refusal(including("nothing.xml")).find("there is no file 'nothing.xml'") != std::string::npos);
    CHECK(refusal(including("arm.xml")).find("more than 100 files are included") != std::string::npos);
}

}  // namespace commands_import_files
