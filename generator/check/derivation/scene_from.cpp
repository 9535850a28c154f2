// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/scene_from.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "check/derivation/claim_text.hpp"
#include "check/derivation/letters.hpp"
#include "scene/draft.hpp"

namespace alembert {

namespace {

using Kind = Math::Kind;

constexpr double first_coordinate = 0.5, next_coordinate = 0.1;  // none of them at a special place

bool is_plain_letter(const Math& math) {
    return math.kind == Kind::letter && math.dots == 0;
}

/// A quantity of mechanics written as T, as T(q, q'), or as K.
std::optional<MechanicalQuantity> energy_named(const Math& math) {
    const bool is_letter = (math.kind == Kind::letter || math.kind == Kind::applied) && math.dots == 0;
    return is_letter ? quantity_of(math.letter) : std::nullopt;
}

bool has_quantity(const Math& math) {
    if (energy_named(math)) return true;
    return std::any_of(math.args.begin(), math.args.end(), [](const MathPtr& arg) { return has_quantity(*arg); });
}

bool has_derivative(const Math& math) {
    if (math.kind == Kind::rate || math.kind == Kind::partial || math.kind == Kind::variation) return true;
    return std::any_of(math.args.begin(), math.args.end(),
                       [](const MathPtr& arg) { return has_derivative(*arg); });
}

class Drafting {
public:
    explicit Drafting(const Written& written) : written_(written), letters_(Scene{}) {}

    DraftedScene draft() {
        find_energies();
        collect();
        find_definitions();
        find_forces();
        return written_out();
    }

private:
    const Written& written_;
    Letters letters_;
    const Math *kinetic_ = nullptr, *potential_ = nullptr, *lagrangian_ = nullptr;
    std::map<Letter, int> dots_;  ///< every letter, with the most dots that it has anywhere
    std::set<Letter> of_time_;    ///< F(t)
    std::map<Letter, const Math*> defined_;
    std::set<Letter> squared_;                                      ///< v in v^2 = …
    std::map<Letter, std::pair<std::string, const Math*>> forces_;  ///< Q with its coordinate and its value
    std::vector<std::string> assumed_;

    /// The first statement of each, and its last side that has no other quantity in it: L = T - V = ….
    void find_energies() {
        for (const WrittenStatement& statement : written_.statements) {
            if (statement.sides.size() < 2) continue;
            const auto quantity = energy_named(*statement.sides[0]);
            const Math** const place = quantity == MechanicalQuantity::kinetic      ? &kinetic_
                                       : quantity == MechanicalQuantity::potential  ? &potential_
                                       : quantity == MechanicalQuantity::lagrangian ? &lagrangian_
                                                                                    : nullptr;
            if (place == nullptr || *place != nullptr) continue;
            for (std::size_t k = 1; k < statement.sides.size(); ++k)
                if (!has_quantity(*statement.sides[k]) && !has_derivative(*statement.sides[k]))
                    *place = statement.sides[k].get();
        }
        if (kinetic_ != nullptr) lagrangian_ = nullptr;
        if (kinetic_ == nullptr && lagrangian_ == nullptr)
            throw ModelError(
                say("no scene can be drafted, because no line states T or L; expected a line such as "
                    "T = m*l^2*theta'^2/2"));
    }

    void collect_time(const Math& math) {
        if (math.kind == Kind::applied && math.args.size() == 1 && is_plain_letter(*math.args[0]) &&
            math.args[0]->letter.base == "t")
            of_time_.insert(math.letter);
        // d/dt of a letter counts as a dot.
        if (math.kind == Kind::rate && math.args[0]->kind == Kind::letter) {
            int& most = dots_[math.args[0]->letter];
            most = std::max(most, math.dots + math.args[0]->dots);
        }
        for (const MathPtr& arg : math.args) collect_time(*arg);
    }

    void collect() {
        for (const WrittenStatement& statement : written_.statements)
            for (const MathPtr& side : statement.sides) collect_letters(*side, dots_), collect_time(*side);
    }

    /// x = l sin θ before the energies are stated.
    void find_definitions() {
        for (const WrittenStatement& statement : written_.statements) {
            if (statement.sides.size() < 2) continue;
            const Math &left = *statement.sides.front(), &right = *statement.sides.back();
            if (left.kind == Kind::power && is_plain_letter(*left.args[0])) squared_.insert(left.args[0]->letter);
            if (!is_plain_letter(left) || quantity_of(left.letter) || has_quantity(right)) continue;
            std::map<Letter, int> inside;
            collect_letters(right, inside);
            const bool is_static =
                std::all_of(inside.begin(), inside.end(), [](const auto& one) { return one.second == 0; });
            if (is_static && !inside.empty() && !inside.contains(left.letter) && is_used(left.letter))
                defined_.emplace(left.letter, &right);
        }
    }

    bool is_used(const Letter& letter) const {
        std::map<Letter, int> inside;
        for (const Math* energy : {kinetic_, potential_, lagrangian_})
            if (energy != nullptr) collect_letters(*energy, inside);
        return inside.contains(letter);
    }

    bool is_coordinate(const Letter& letter) const {
        return dots_.at(letter) > 0 && !defined_.contains(letter) && !quantity_of(letter);
    }

    /// Q_q = … with a letter that stands in no energy: a force that has no potential.
    void find_forces() {
        for (const WrittenStatement& statement : written_.statements) {
            if (statement.sides.size() < 2 || !is_plain_letter(*statement.sides[0])) continue;
            const Letter& letter = statement.sides[0]->letter;
            if (quantity_of(letter) != MechanicalQuantity::force || forces_.contains(letter)) continue;
            const Math& value = *statement.sides.back();
            std::map<Letter, int> inside;
            collect_letters(value, inside);
            if (has_quantity(value) || has_derivative(value)) continue;
            if (std::all_of(inside.begin(), inside.end(), [this](const auto& one) { return is_used(one.first); }))
                continue;
            for (const auto& [other, dots] : dots_) {
                if (!is_coordinate(other)) continue;
                const std::string name = name_for(other);
                if (letter.index == other.base + (other.index.empty() ? "" : "_" + other.index) ||
                    letter.index == name)
                    forces_.emplace(letter, std::pair(name, &value));
            }
        }
    }

    /// As people type it: \varphi is phi, and \ell is l unless the derivation has both.
    std::string name_for(const Letter& letter) const {
        std::string name = identifier_of(letter);
        for (const auto& [variant, plain] : {std::pair("varphi", "phi"), std::pair("ell", "l"),
                                             std::pair("vartheta", "theta"), std::pair("varepsilon", "epsilon")}) {
            Letter other = letter;
            other.base = plain;
            if (letter.base == variant && !dots_.contains(other)) name = identifier_of(other);
        }
        return name;
    }

    std::string text_of(const Math& math) const {
        try {
            return claim_text(math, {.letters = letters_}).text;
        } catch (const NoMeaning& problem) {
            throw ModelError(
                say("line {}: no scene can be drafted: {}", written_.line(math.offset), problem.reason));
        }
    }

    void need_no_squares() const {
        for (const Letter& letter : squared_)
            if (!defined_.contains(letter) && is_used(letter))
                throw ModelError(
                    say("no scene can be drafted, because the energies hold {}, of which only the "
                        "square is given; write it out",
                        identifier_of(letter)));
    }

    /// The letters that a scene needs: of the energies, of what defines these, and of the forces.
    std::set<Letter> needed() const {
        std::map<Letter, int> inside;
        for (const Math* energy : {kinetic_, potential_, lagrangian_})
            if (energy != nullptr) collect_letters(*energy, inside);
        for (const auto& [letter, value] : defined_) collect_letters(*value, inside);
        for (const auto& [letter, force] : forces_) collect_letters(*force.second, inside);
        std::set<Letter> result;
        for (const auto& [letter, dots] : inside)
            if (letter.base != "t" && letter.base != "pi") result.insert(letter);
        return result;
    }

    DraftedScene written_out() {
        need_no_squares();
        letters_.bind(Letter{.base = "t", .index = {}, .raised = {}, .accent = {}}, "t");
        letters_.bind(Letter{.base = "pi", .index = {}, .raised = {}, .accent = {}}, "pi");
        const std::set<Letter> all = needed();
        for (const Letter& letter : all) letters_.bind(letter, name_for(letter));
        SceneDraft draft;
        draft.set("title", say("drafted from {}", written_.file));
        std::vector<std::string> coordinates, parameters, inputs;
        double start = first_coordinate;
        for (const Letter& letter : all) {
            const std::string name = name_for(letter);
            if (defined_.contains(letter)) continue;
            if (is_coordinate(letter)) {
                draft.table("coordinates").set(name, start);
                start += next_coordinate;
                coordinates.push_back(name);
            } else if (of_time_.contains(letter)) {
                draft.table("inputs").set(name, "sin(t)");
                inputs.push_back(name);
            } else {
                draft.table("parameters").set(name, name == "g" ? 9.81 : 1.0);
                parameters.push_back(name);
            }
        }
        if (coordinates.empty())
            throw ModelError(say("no scene can be drafted, because no letter of the energies carries a dot"));
        for (const auto& [letter, value] : defined_)
            draft.table("definitions").set(name_for(letter), text_of(*value));
        if (lagrangian_ != nullptr) draft.table("energy").set("lagrangian", text_of(*lagrangian_));
        if (kinetic_ != nullptr) draft.table("energy").set("kinetic", text_of(*kinetic_));
        if (kinetic_ != nullptr && potential_ != nullptr)
            draft.table("energy").set("potential", text_of(*potential_));
        for (const auto& [letter, force] : forces_) draft.table("forces").set(force.first, text_of(*force.second));
        assumed_.push_back(say("Coordinates, because they carry dots: {}.", fmt::join(coordinates, ", ")));
        if (!parameters.empty())
            assumed_.push_back(say("Parameters: {}; their values are assumed.", fmt::join(parameters, ", ")));
        if (!inputs.empty())
            assumed_.push_back(say("Functions of time: {}; sin(t) is assumed.", fmt::join(inputs, ", ")));
        assumed_.push_back(say("The stated energies are taken for granted. The lines are held against them."));
        if (kinetic_ != nullptr && potential_ == nullptr)
            assumed_.push_back(say("No potential energy is stated; it is taken as 0."));
        DraftedScene result{.text = {}, .assumed = std::move(assumed_)};
        for (const std::string& line : result.assumed) result.text += "# " + line + "\n";
        result.text += draft.text();
        return result;
    }
};

}  // namespace

DraftedScene scene_from(const Written& written) {
    return Drafting(written).draft();
}

}  // namespace alembert
