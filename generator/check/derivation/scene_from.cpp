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
#include "check/written/words.hpp"
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

bool holds(const Math& math, Kind kind) {
    return math.kind == kind ||
           std::any_of(math.args.begin(), math.args.end(), [&](const MathPtr& arg) { return holds(*arg, kind); });
}

class Drafting {
public:
    explicit Drafting(const Written& written) : written_(written), letters_(Scene{}) {}

    DraftedScene draft() {
        find_energies();
        collect();
        number_coordinates();
        if (kinetic_ == nullptr && lagrangian_ == nullptr) find_particles();
        if (kinetic_ == nullptr && lagrangian_ == nullptr && particles_.empty())
            throw ModelError(
                say("no scene can be drafted, because no line states T, L or the position of a mass; expected a "
                    "line such as T = m*l^2*theta'^2/2"));
        find_definitions();
        find_forces();
        find_constraints();
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
    std::map<std::string, Letter> numbered_;                        ///< q_1 = x: the coordinate of the index 1
    struct Placed {
        std::string index;
        const Math* place[3] = {};  ///< x, y and z, null where none is stated
    };
    std::vector<Placed> particles_;  ///< where no energy is stated
    std::vector<const WrittenStatement*> constraints_;
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
    }

    /// q_1 = x, q_2 = θ
    void number_coordinates() {
        for (const WrittenStatement& statement : written_.statements) {
            if (statement.sides.size() != 2 || !is_plain_letter(*statement.sides[0]) ||
                !is_plain_letter(*statement.sides[1]))
                continue;
            const Letter &left = statement.sides[0]->letter, &right = statement.sides[1]->letter;
            if (left.base == "q" && !left.index.empty()) numbered_.emplace(left.index, right);
            if (right.base == "q" && !right.index.empty()) numbered_.emplace(right.index, left);
        }
    }

    /// Masses where places x, y, z are stated, those with one index together.
    void find_particles() {
        for (const WrittenStatement& statement : written_.statements) {
            if (statement.sides.size() < 2 || !is_plain_letter(*statement.sides[0])) continue;
            const Letter& letter = statement.sides[0]->letter;
            const std::size_t axis =
                letter.base.size() == 1 ? std::string("xyz").find(letter.base) : std::string::npos;
            const Math& value = *statement.sides.back();
            std::map<Letter, int> inside;
            collect_letters(value, inside);
            const bool is_place =
                std::all_of(inside.begin(), inside.end(), [](const auto& one) { return one.second == 0; }) &&
                std::any_of(inside.begin(), inside.end(),
                            [&](const auto& one) { return dots_.at(one.first) > 0; });
            if (axis == std::string::npos || !is_place || has_derivative(value)) continue;
            auto placed = std::find_if(particles_.begin(), particles_.end(),
                                       [&](const Placed& one) { return one.index == letter.index; });
            if (placed == particles_.end()) placed = particles_.insert(placed, Placed{.index = letter.index});
            if (placed->place[axis] == nullptr) placed->place[axis] = &value;
        }
    }

    /// λ and μ, which stand in no energy.
    bool has_multiplier() const {
        return std::any_of(dots_.begin(), dots_.end(), [&](const auto& item) {
            return (item.first.base == "lambda" || item.first.base == "mu") && !is_used(item.first) &&
                   !defined_.contains(item.first);
        });
    }

    /// r dθ = dx, x² + y² = l²: relations of coordinates beside the energies, where the words call them
    /// constraints or a multiplier shows that there are some.
    void find_constraints() {
        const bool has_some = has_multiplier();
        for (const WrittenStatement& statement : written_.statements) {
            if (statement.sides.size() != 2 || !(has_some || speaks_of_constraint(statement.words))) continue;
            if (is_plain_letter(*statement.sides[0]) && defined_.contains(statement.sides[0]->letter)) continue;
            std::map<Letter, int> inside;
            int coordinates = 0;
            for (const MathPtr& side : statement.sides) collect_letters(*side, inside);
            const bool is_relation = std::all_of(inside.begin(), inside.end(), [&](const auto& item) {
                const bool is_one = dots_.at(item.first) > 0 && !defined_.contains(item.first);
                coordinates += is_one ? 1 : 0;
                return !quantity_of(item.first) && (item.second == 0 || (is_one && item.second == 1)) &&
                       (is_one || is_used(item.first) || item.second == 0);
            });
            const bool is_derived = std::any_of(
                statement.sides.begin(), statement.sides.end(),
                [](const MathPtr& side) { return has_quantity(*side) || holds(*side, Kind::partial); });
            const bool is_multiplied = std::any_of(inside.begin(), inside.end(), [&](const auto& item) {
                return (item.first.base == "lambda" || item.first.base == "mu") && !is_used(item.first);
            });
            if (is_relation && coordinates > 1 && !is_derived && !is_multiplied)
                constraints_.push_back(&statement);
        }
    }

    void collect_time(const Math& math) {
        if (math.kind == Kind::applied && math.args.size() == 1 && is_plain_letter(*math.args[0]) &&
            math.args[0]->letter.base == "t")
            of_time_.insert(math.letter);
        // d/dt of a letter counts as a dot, and its differential.
        if ((math.kind == Kind::rate || math.kind == Kind::variation) && math.args[0]->kind == Kind::letter) {
            int& most = dots_[math.args[0]->letter];
            const int order = math.kind == Kind::variation ? 1 : math.dots;
            most = std::max(most, order + math.args[0]->dots);
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
        for (const Placed& particle : particles_)
            for (const Math* place : particle.place)
                if (place != nullptr) collect_letters(*place, inside);
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
                const auto numbered = numbered_.find(letter.index);
                const bool is_its_number = numbered != numbered_.end() && numbered->second == other;
                if (is_its_number || letter.index == other.base + (other.index.empty() ? "" : "_" + other.index) ||
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

    static Letter gravity() { return {.base = "g"}; }

    Letter mass_of(const Placed& particle) const {
        const Letter own{.base = "m", .index = particle.index};
        return dots_.contains(own) ? own : Letter{.base = "m"};
    }

    void add_particles(SceneDraft& draft) {
        std::size_t axes = 0;
        for (const Placed& particle : particles_)
            for (std::size_t k = 0; k < 3; ++k)
                if (particle.place[k] != nullptr) axes = std::max(axes, k + 1);
        for (const Placed& particle : particles_) {
            std::vector<DraftValue> place;
            for (std::size_t k = 0; k < std::max<std::size_t>(axes, 2); ++k)
                place.push_back(particle.place[k] == nullptr ? DraftValue(0)
                                                             : DraftValue(text_of(*particle.place[k])));
            draft.add("particle")
                .set("name", "particle" + particle.index)
                .set("mass", name_for(mass_of(particle)))
                .set("position", place);
        }
        assumed_.push_back(say("No line states T: the masses {} are taken where the lines place them.",
                               fmt::join(masses(), ", ")));
        if (!dots_.contains(gravity())) return;
        std::vector<DraftValue> field(std::max<std::size_t>(axes, 2), DraftValue(0));
        field.back() = DraftValue("-g");
        draft.set("gravity", field);
        assumed_.push_back(say("Gravity is taken against the direction of {}.", axes > 2 ? "z" : "y"));
    }

    std::vector<std::string> masses() const {
        std::vector<std::string> result;
        for (const Placed& particle : particles_) result.push_back(name_for(mass_of(particle)));
        return result;
    }

    void add_constraints(SceneDraft& draft) {
        std::vector<std::string> told;
        for (const WrittenStatement* constraint : constraints_) {
            std::string sides[2];
            bool is_of_rates = false;
            for (std::size_t k = 0; k < 2; ++k) {
                const Math& side = *constraint->sides[k];
                sides[k] = claim_text(side, {.letters = letters_, .differentials_are_rates = true}).text;
                is_of_rates = is_of_rates || sides[k].find('\'') != std::string::npos;
            }
            const std::string text = sides[0] + " = " + sides[1];
            draft.add("constraint")
                .set("name", fmt::format("constraint{}", told.size() + 1))
                .set(is_of_rates ? "nonholonomic" : "holonomic", text);
            told.push_back(text);
        }
        if (!told.empty()) assumed_.push_back(say("Constraints: {}.", fmt::join(told, "; ")));
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
        for (const WrittenStatement* constraint : constraints_)
            for (const MathPtr& side : constraint->sides) collect_letters(*side, inside);
        for (const Placed& particle : particles_) {
            inside[mass_of(particle)];
            for (const Math* place : particle.place)
                if (place != nullptr) collect_letters(*place, inside);
        }
        if (!particles_.empty() && dots_.contains(gravity())) inside[gravity()];
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
        if (!particles_.empty()) add_particles(draft);
        add_constraints(draft);
        assumed_.push_back(say("Coordinates, because they carry dots: {}.", fmt::join(coordinates, ", ")));
        if (!parameters.empty())
            assumed_.push_back(say("Parameters: {}; their values are assumed.", fmt::join(parameters, ", ")));
        if (!inputs.empty())
            assumed_.push_back(say("Functions of time: {}; sin(t) is assumed.", fmt::join(inputs, ", ")));
        if (particles_.empty())
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
