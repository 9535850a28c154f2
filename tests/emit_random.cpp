// SPDX-License-Identifier: MIT
// Every file that is emitted has to compile: many small scenes at random, with all options of `emit`.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "alembert/base/error.hpp"
#include "codegen/emit/emit.hpp"
#include "codegen/emit/taylor.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/differentiate.hpp"
#include "program/lower/choose.hpp"
#include "random_scene.hpp"
#include "scenes.hpp"

namespace emit_random {

using namespace alembert;

namespace {

/// The options of an emitted file, chosen by the seed of its scene so that all pairs of them occur.
struct Wishes {
    bool fold, jacobian, batch, taylor;
};

Choice chosen(const Mechanism& m, bool fold) {
    const bool in_speeds = !m.speeds.empty() && m.unilateral.empty() && masses_are_known(m);
    std::vector<Equations> all{formalism(in_speeds               ? "kane"
                                         : m.constraints.empty() ? "lagrange"
                                                                 : "routh")
                                   .derive(m)};
    try {
        if (!in_speeds) all.push_back(formalism("recursive").derive(m));
    } catch (const ModelError&) {  // the formalism does not apply
    }
    return choose(m, all, {.fold = fold});
}

/// Several files of the same functions can stand in one when each has a name space and its own names for the
/// loader.
std::string apart(std::string text, const std::string& name) {
    for (std::size_t at = 0; (at = text.find("const void* alembert_", at)) != std::string::npos;)
        text.insert(at += std::string_view("const void* alembert_").size(), name + "_");
    return fmt::format("namespace {} {{\n{}}}\n", name, text);
}

std::string emitted(const std::string& scene, const std::string& name, const Wishes& wishes) {
    const Mechanism m = build(parse_scene(scene, "random.toml"));
    const Program program = chosen(m, wishes.fold).program;
    const std::optional<Differentiated> d =
        wishes.jacobian ? differentiated(program, {.parameters = true, .power = true}) : std::nullopt;
    std::string text = apart(emit(d ? d->program : program, {.batch = wishes.batch}).text, name);
    if (!wishes.taylor) return text;
    try {
        text += apart(emit_taylor(program).text, name + "_taylor");
    } catch (const ModelError&) {  // abs and max have no power series
    }
    return text;
}

/// The compiler's messages about a text that it parses and instantiates without generating code.
std::string complaints(const std::string& text) {
    const std::filesystem::path source = std::filesystem::temp_directory_path() /
                                         fmt::format("alembert_random_{}.cpp", getpid()),
                                said = source.string() + ".txt";
    std::ofstream(source) << text;
    const char* const compiler = std::getenv("CXX");
    const std::string command =
        fmt::format("{} -std=c++20 -fsyntax-only -w '{}' > '{}' 2>&1", compiler != nullptr ? compiler : "g++",
                    source.string(), said.string());
    const int status = std::system(command.c_str());
    std::ifstream file(said);
    const std::string found{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(source);
    std::filesystem::remove(said);
    return status != 0 && found.empty() ? "the compiler could not be run" : found;
}

}  // namespace

TEST_CASE("emit: the files of two hundred small random scenes compile, with every option") {
    const char* const asked = std::getenv("ALEMBERT_RANDOM_SCENES");
    const unsigned count = asked != nullptr ? static_cast<unsigned>(std::atoi(asked)) : 200U, together = 50;
    unsigned refused = 0;
    for (unsigned first = 0; first < count; first += together) {
        std::string text;
        for (unsigned seed = first; seed < std::min(count, first + together); ++seed) {
            const std::string scene = test::random_scene(seed);
            CAPTURE(scene);
            const Wishes wishes{
                .fold = seed % 5 == 0, .jacobian = seed % 3 == 0, .batch = seed % 4 == 0, .taylor = seed % 7 == 0};
            try {
                text += emitted(scene, fmt::format("scene{}", seed), wishes);
            } catch (const ModelError&) {  // singular at every state
                ++refused;
            }
        }
        CHECK(complaints(text) == "");
    }
    CHECK(refused <= count / 10);
}

}  // namespace emit_random
