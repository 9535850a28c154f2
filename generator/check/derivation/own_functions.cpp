// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/own_functions.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "check/derivation/parts.hpp"

namespace alembert {

namespace {

using Kind = Math::Kind;

bool is_coordinate(const Math& math, const Letters& letters) {
    const auto name = math.kind == Kind::letter && math.dots == 0 ? letters.name_of(math.letter) : std::nullopt;
    return name && letters.moves(*name);
}

/// The letters of parameters of which a line says what they are as functions of a coordinate, with its letter.
std::map<Letter, Letter> own_functions(const Written& written, const Letters& letters) {
    std::map<Letter, Letter> result;
    for (const WrittenStatement& statement : written.statements) {
        if (statement.sides.size() < 2) continue;
        const Math& side = *statement.sides[0];
        if (side.kind != Kind::applied || side.dots > 0 || side.args.size() != 1) continue;
        const auto name = letters.name_of(side.letter);
        if (!name || !letters.is_of_scene(*name) || letters.moves(*name) || letters.is_function(*name) ||
            !is_coordinate(*side.args[0], letters))
            continue;
        std::map<Letter, int> other;
        collect_letters(*statement.sides[1], other);
        if (other.contains(side.args[0]->letter)) result.emplace(side.letter, side.args[0]->letter);
    }
    return result;
}

class Renaming {
public:
    Renaming(std::map<Letter, Letter> functions, const Letters& letters)
        : functions_(std::move(functions)), letters_(letters) {}

    MathPtr of(const MathPtr& math) const {
        Math copy = *math;
        for (MathPtr& arg : copy.args) arg = of(arg);
        const bool is_value =
            copy.kind == Kind::applied && copy.args.size() == 1 && is_coordinate(*copy.args[0], letters_);
        const bool is_slope = copy.kind == Kind::letter && copy.dots > 0;
        if ((is_value || is_slope) && functions_.contains(copy.letter)) copy.letter = named(copy.letter);
        if (copy.kind == Kind::partial && copy.args[0]->kind == Kind::letter &&
            functions_.contains(copy.args[0]->letter)) {
            Math function = *copy.args[0];
            function.letter = named(function.letter);
            copy.args[0] = std::make_shared<const Math>(std::move(function));
        }
        return std::make_shared<const Math>(std::move(copy));
    }

private:
    /// m of m(φ) in messages: m_of_phi
    Letter named(Letter letter) const {
        letter.raised = "of_" + identifier_of(functions_.at(letter));
        return letter;
    }

    std::map<Letter, Letter> functions_;
    const Letters& letters_;
};

}  // namespace

Written with_own_functions(Written written, const Letters& letters, std::vector<std::string>& remarks) {
    const std::map<Letter, Letter> functions = own_functions(written, letters);
    if (functions.empty()) return written;
    for (const auto& [letter, coordinate] : functions)
        remarks.push_back(say("{}({}) is read as a function of the author's own, not as the scene's {}",
                              identifier_of(letter), identifier_of(coordinate),
                              letters.name_of(letter).value_or("")));
    const Renaming renaming(functions, letters);
    for (WrittenStatement& statement : written.statements)
        for (MathPtr& side : statement.sides) side = renaming.of(side);
    return written;
}

}  // namespace alembert
