// SPDX-License-Identifier: MIT
#pragma once

/// Emitted files in a folder, and what programs print that are made of them.
///
///     const test::Folder folder;
///     folder.emit(scene, {.language = CodeLanguage::c});
///     REQUIRE(folder.runs("cc main.c pendulum.c -lm -o program"));
///     folder.numbers("./program");

#include <stdlib.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulate/emission.hpp"

namespace alembert::test {

/// A folder in the temporary folder, which goes with this.
class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "alembert-emitted-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path = name;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string file(const std::string& name) const { return (path / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
    void write(const Emission& emission) const {
        for (const SourceFile& one : files_of(emission)) write(one.name, one.text);
    }
    void emit(Scene scene, const EmissionOptions& options = {}) const {
        write(emission(std::move(scene), options));
    }

    /// Whether a command succeeds in the folder, in silence.
    bool runs(const std::string& command) const {
        return std::system(within("(" + command + ") >/dev/null 2>&1").c_str()) == 0;
    }
    /// What a command in the folder prints; its status first, where it fails.
    std::string told(const std::string& command) const {
        FILE* const pipe = popen(within("(" + command + ") 2>&1").c_str(), "r");
        std::string text;
        for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
        const int status = pclose(pipe);
        return (status == 0 ? "" : "status " + std::to_string(status) + "\n") + text;
    }
    /// The numbers that it prints, one after the other.
    std::vector<double> numbers(const std::string& command) const {
        std::vector<double> list;
        std::istringstream stream(told(command));
        for (std::string word; stream >> word;) list.push_back(std::stod(word));
        return list;
    }

    std::filesystem::path path;

private:
    std::string within(const std::string& command) const { return "cd '" + path.string() + "' && " + command; }
};

}  // namespace alembert::test
