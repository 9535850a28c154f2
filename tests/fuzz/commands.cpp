// SPDX-License-Identifier: MIT
// Whole commands on mutated scenes. The verb depends on the scene's text alone, so that an input can be repeated.
// Verbs that run the compiler are left out: tests/every_verb.sh runs them.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <random>
#include <sstream>
#include <vector>

#include "commands/command_line.hpp"
#include "target.hpp"

namespace {

using Words = std::vector<std::string>;

const std::vector<Words> verbs = {{"derive"},
                                  {"derive", "--steps", "--format", "latex"},
                                  {"derive", "--by", "kane", "--reactions"},
                                  {"derive", "--by", "hamilton"},
                                  {"derive", "--by", "recursive", "--json"},
                                  {"check", "--json"},
                                  {"audit"},
                                  {"eval", "--reactions", "--json"},
                                  {"inverse"},
                                  {"impact", "--json"},
                                  {"inertia"},
                                  {"kinematics", "--steps"},
                                  {"linearize", "--json"},
                                  {"equilibrium", "--starts", "3"},
                                  {"stability"},
                                  {"agree"}};

/// A folder that goes with the process.
struct TemporaryFolder {
    std::string name = (std::filesystem::temp_directory_path() / "fuzz-XXXXXX").string();
    TemporaryFolder() {
        if (!mkdtemp(name.data())) std::abort();
    }
    ~TemporaryFolder() { std::filesystem::remove_all(name); }
};

/// The folder in which the scene is written, for each process its own.
std::filesystem::path folder() {
    static const TemporaryFolder made;
    return made.name;
}

/// Words, numbers, and single other bytes.
std::vector<std::string> tokens_of(const std::string& text) {
    std::vector<std::string> tokens;
    for (std::size_t i = 0; i < text.size();) {
        const auto is_word = [&](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
        };
        std::size_t end = i + 1;
        if (is_word(text[i]))
            while (end < text.size() && is_word(text[end])) ++end;
        tokens.push_back(text.substr(i, end - i));
        i = end;
    }
    return tokens;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line + "\n");
    return lines;
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += part;
    return text;
}

const Words usual = {"0",     "1",     "-1",   "2",  "1e-9", "1e9", "1/3", "sin", "cos",  "sqrt", "exp", "abs",
                     "t",     "'",     "''",   "^2", "*",    "+",   "-",   "/",   "(",    ")",    "pi",  "sign",
                     "\"x\"", "\"z\"", "true", "[",  "]",    ",",   "0.5", "min", "diff", "tan",  "log", "atan2"};

}  // namespace

/// Scenes stay readable for longer if whole tokens and lines are exchanged rather than bytes.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    const bool by_lines = below(4) == 0;
    std::vector<std::string> parts =
        by_lines ? lines_of(alembert::fuzz::text(data, size)) : tokens_of(alembert::fuzz::text(data, size));
    if (parts.empty()) parts.push_back(usual[below(usual.size())]);
    for (std::size_t count = 1 + below(3); count > 0 && !parts.empty(); --count) {
        const std::size_t at = below(parts.size());
        switch (below(5)) {
            case 0:
                parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(at));
                break;
            case 1:
                parts[at] = parts[below(parts.size())];
                break;
            case 2:
                parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(at), parts[below(parts.size())]);
                break;
            case 3:
                std::swap(parts[at], parts[below(parts.size())]);
                break;
            default:
                if (!by_lines) parts[at] = usual[below(usual.size())];
        }
    }
    const std::string text = joined(parts).substr(0, most);
    std::copy(text.begin(), text.end(), data);
    return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string scene = alembert::fuzz::text(data, size);
    const std::string file = (folder() / "scene.toml").string();
    std::ofstream(file, std::ios::binary) << scene;
    Words words = verbs[std::hash<std::string>{}(scene) % verbs.size()];
    words.insert(words.begin() + 1, file);
    std::ostringstream out, err;
    auto* const usual_out = std::cout.rdbuf(out.rdbuf());
    auto* const usual_err = std::cerr.rdbuf(err.rdbuf());
    alembert::command_line(words);
    std::cout.rdbuf(usual_out);
    std::cerr.rdbuf(usual_err);
    if (err.str().find("internal error") != std::string::npos) {
        std::cerr << "alembert " << words[0] << ": " << err.str();
        __builtin_trap();
    }
    return 0;
}
