// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/values.hpp"

#include <algorithm>

#include "alembert/ode/method.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/dialect.hpp"
#include "model/formalism/formalisms.hpp"

namespace alembert {

namespace {

std::vector<std::string> formalism_words() {
    std::vector<std::string> words;
    for (const Formalism& f : formalisms()) words.push_back(f.name);
    return words;
}

std::vector<std::string> code_words() {
    std::vector<std::string> words;
    for (const Dialect& dialect : dialects()) words.emplace_back(dialect.option);
    return words;
}

std::vector<ValueKind> all_kinds() {
    using Files = ValueKind::Files;
    return {{.name = values::scene, .files = Files::ending, .ending = "toml"},
            {.name = values::robot, .files = Files::ending, .ending = "urdf"},
            {.name = values::claims, .files = Files::any},
            {.name = values::file, .files = Files::any},
            {.name = values::folder, .files = Files::folders},
            {.name = values::formalism, .plural = say("Formalisms"), .words = formalism_words()},
            {.name = values::method, .plural = say("Methods"), .words = method_words()},
            {.name = values::format, .words = {"text", "latex", "mathml"}},
            {.name = values::reading, .words = {"en", "zh"}},
            {.name = values::sampling, .words = {"sobol", "latin", "uniform"}},
            {.name = values::code, .words = {"auto", "memory", "compiled"}},
            {.name = values::interface_version, .words = {"2", "3"}},
            {.name = values::language, .words = code_words()},
            {.name = values::shell, .words = {"bash", "zsh", "fish"}}};
}

}  // namespace

const ValueKind* value_kind(const std::string& name) {
    static const std::vector<ValueKind> all = all_kinds();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const ValueKind& kind) { return kind.name == name; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace alembert
