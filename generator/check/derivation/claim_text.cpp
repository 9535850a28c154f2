// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/claim_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/language/say.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

/// How strongly a text holds together: what stands in a power must be an atom, in a product at least a product.
enum class Bond { sum, product, power, atom };

class Writer {
public:
    explicit Writer(const ClaimWriting& writing) : how_(writing) {}

    ClaimText write(const Math& math) {
        if (how_.alone_is_quantity && math.kind == Kind::letter) {
            letter(math, true);
            result_.parts.push_back({0, out().size(), math.offset, math.length});
        } else {
            term(math);
        }
        return std::move(result_);
    }

private:
    using Kind = Math::Kind;

    std::string& out() { return result_.text; }

    [[noreturn]] void refuse(const Math& math, std::string reason) const {
        throw NoMeaning{.reason = std::move(reason), .offset = math.offset, .length = math.length};
    }

    static Bond bond(const Math& math) {
        switch (math.kind) {
            case Kind::sum:
            case Kind::negate:
                return Bond::sum;
            case Kind::product:
            case Kind::quotient:
            case Kind::quantity:
            case Kind::applied:  // perhaps a product that was written without a sign
                return Bond::product;
            case Kind::power:
                return math.args[0]->kind == Kind::applied && !math.args[0]->grouped ? Bond::product : Bond::power;
            default:
                return Bond::atom;
        }
    }

    /// In parentheses if it would fall apart.
    void inside(const Math& math, Bond least) {
        const bool loose = bond(math) < least;
        if (loose) out() += '(';
        term(math);
        if (loose) out() += ')';
    }

    void term(const Math& math) {
        const std::size_t begin = out().size();
        plain_term(math);
        if (how_.steps != nullptr && may_be_step(math)) {
            const std::string key =
                claim_text(math, {.letters = how_.letters, .displacements = how_.displacements}).text;
            if (const auto step = how_.steps->find(key); step != how_.steps->end()) {
                out().resize(begin);
                std::erase_if(result_.parts, [&](const ClaimText::Part& part) { return part.begin >= begin; });
                out() += step->second;
                result_.names.insert(step->second);
            }
        }
        result_.parts.push_back({begin, out().size(), math.offset, math.length});
    }

    bool may_be_step(const Math& math) const {
        if (math.kind == Kind::variation) return how_.displacements != nullptr && !how_.differentials_are_rates;
        return math.kind == Kind::rate || math.kind == Kind::partial ||
               (math.kind == Kind::letter && math.dots > 0);
    }

    void plain_term(const Math& math) {
        switch (math.kind) {
            case Kind::number:
                out() += math.text;
                return;
            case Kind::letter:
                return letter(math, false);
            case Kind::call:
                return call(math);
            case Kind::applied:
                return applied(math);
            case Kind::sum:
                return sum(math);
            case Kind::product:
                return product(math);
            case Kind::negate:
                out() += '-';
                return inside(*math.args[0], Bond::product);
            case Kind::quotient:
                inside(*math.args[0], Bond::product);
                out() += '/';
                return inside(*math.args[1], Bond::power);
            case Kind::power:
                return power(math);
            case Kind::rate:
                out() += '(';
                term(*math.args[0]);
                out() += ')' + std::string(static_cast<std::size_t>(math.dots), '\'');
                return;
            case Kind::partial:
                return partial(math);
            case Kind::variation:
                return variation(math);
            case Kind::quantity:
                return quantity(math);
            case Kind::vector:
            case Kind::matrix:
                refuse(math, say("a vector stands where a number is expected"));
        }
    }

    std::string name(const Math& math, bool as_quantity) const {
        if (const auto known = how_.letters.name_of(math.letter, as_quantity)) return *known;
        throw NoMeaning{.reason = say("the letter {} is neither a name of the scene nor defined before",
                                      fmt::format("'{}'", identifier_of(math.letter))),
                        .offset = math.offset,
                        .length = math.length,
                        .unknown = math.letter,
                        .dots = math.dots};
    }

    void letter(const Math& math, bool as_quantity) {
        const std::string known = name(math, as_quantity);
        result_.names.insert(known);
        if (math.dots > 0 && !how_.letters.moves(known) && how_.letters.is_of_scene(known))
            refuse(math, say("'{}' is constant in this scene, and has no rate", known));
        out() += known + std::string(static_cast<std::size_t>(math.dots), '\'');
    }

    void call(const Math& math) {
        static const std::map<std::string, std::string> renamed{{"ln", "log"}, {"sgn", "sign"}};
        static const std::map<std::string, std::string> inverted{{"cot", "tan"}, {"sec", "cos"}, {"csc", "sin"}};
        if (const auto of = inverted.find(math.text); of != inverted.end()) {
            out() += "(1/" + of->second + '(';
            term(*math.args[0]);
            out() += "))";
            return;
        }
        const auto other = renamed.find(math.text);
        arguments(other == renamed.end() ? math.text : other->second, math);
    }

    void arguments(const std::string& function, const Math& math) {
        out() += function + '(';
        for (std::size_t k = 0; k < math.args.size(); ++k) {
            if (k > 0) out() += ',';
            term(*math.args[k]);
        }
        out() += ')';
    }

    /// F(t), V(r), L(q, q', t), or a product m(g + a).
    void applied(const Math& math) {
        const std::string known = name(math, false);
        if (how_.letters.is_function(known)) {
            result_.names.insert(known);
            return arguments(known, math);
        }
        const bool of_scene = how_.letters.is_of_scene(known);
        if (math.dots > 0 && !of_scene && math.args.size() == 1 && math.args[0]->kind == Kind::letter &&
            math.args[0]->dots == 0 && math.args[0]->letter.base != "t")
            return slope_of_function(math);  // U'(θ) is dU/dθ
        const bool is_state = std::all_of(math.args.begin(), math.args.end(), [&](const MathPtr& arg) {
            if (arg->kind != Kind::letter) return false;
            const auto name = how_.letters.name_of(arg->letter);
            return name == "t" || (math.args.size() > 1 || !of_scene);
        });
        if (is_state || math.args.size() != 1) return letter(math, false);
        letter(math, false);
        out() += '*';
        inside(*math.args[0], Bond::atom);
    }

    void slope_of_function(const Math& math) {
        Math of = math, slope{.kind = Kind::partial};
        of.kind = Kind::letter, of.dots = 0, of.args.clear();
        slope.text = "d";
        slope.offset = math.offset, slope.length = math.length;
        slope.args.push_back(std::make_shared<Math>(of));
        for (int k = 0; k < math.dots; ++k) slope.args.push_back(math.args[0]);
        term(slope);
    }

    void sum(const Math& math) {
        for (std::size_t k = 0; k < math.args.size(); ++k) {
            const bool minus = math.args[k]->kind == Kind::negate;
            if (k > 0) out() += minus ? " - " : " + ";
            if (minus && k == 0) out() += '-';
            if (minus) {
                const std::size_t begin = out().size();
                inside(*math.args[k]->args[0], Bond::product);
                result_.parts.push_back({begin, out().size(), math.args[k]->offset, math.args[k]->length});
            } else {
                inside(*math.args[k], Bond::product);
            }
        }
    }

    void product(const Math& math) {
        bool is_first = true;
        for (const MathPtr& factor : math.args) {
            if (is_along(*factor) && math.args.size() > 1) continue;
            if (!is_first) out() += '*';
            inside(*factor, Bond::product);
            is_first = false;
        }
    }

    /// The displacement along which the work is looked at: δθ = 1.
    bool is_along(const Math& math) const {
        if (math.kind != Kind::variation || how_.displacements == nullptr || how_.differentials_are_rates ||
            math.args[0]->kind != Kind::letter || math.args[0]->dots > 0)
            return false;
        const auto known = how_.letters.name_of(math.args[0]->letter);
        const auto value = known ? how_.displacements->find(*known) : how_.displacements->end();
        return value != how_.displacements->end() && value->second == "1";
    }

    void power(const Math& math) {
        const Math& base = *math.args[0];
        if (base.kind == Kind::letter && base.dots == 0 && base.letter.base == "e" && base.letter.index.empty() &&
            !how_.letters.name_of(base.letter)) {
            out() += "exp(";
            term(*math.args[1]);
            out() += ')';
            return;
        }
        if (base.kind == Kind::applied && !base.grouped)
            term(base);  // m (a + b)^2 is a product in which the parentheses are squared
        else
            inside(base, Bond::atom);
        out() += '^';
        inside(*math.args[1], Bond::atom);
    }

    /// ∂v/∂u = Σ ∂v/∂q' ∂q'/∂u, the coordinates being held; ∂S/∂u' = Σ ∂S/∂q'' ∂q'/∂u, the rates too. Returns
    /// false if it is by no generalized speed.
    bool partial_by_speed(const Math& math) {
        if (how_.speeds == nullptr || math.args.size() != 2 || math.args[1]->kind != Kind::letter) return false;
        const auto by = how_.letters.name_of(math.args[1]->letter);
        auto speed = by ? how_.speeds->find(*by) : how_.speeds->end();
        int order = math.args[1]->dots;
        if (by && speed == how_.speeds->end() && how_.rates_are_speeds && order-- > 0)
            speed = how_.speeds->find(*by + "'");
        if (speed == how_.speeds->end() || order > 1) return false;
        out() += '(';
        for (std::size_t k = 0; k < speed->second.size(); ++k) {
            const auto& [rate, slope] = speed->second[k];
            out() += k > 0 ? " + diff(" : "diff(";
            term(*math.args[0]);
            out() += "," + rate + (order == 1 ? "')*" : ")*") + slope;
        }
        out() += ')';
        return true;
    }

    /// d(θ'^2)/dθ along the motion: the rates of both, divided. Returns false where it is not taken so.
    bool slope_of_motion(const Math& math) {
        if (!how_.slopes_are_of_motion || math.text != "d") return false;
        for (std::size_t k = 1; k < math.args.size(); ++k)
            if (math.args[k]->kind != Kind::letter || math.args[k]->dots > 0) return false;
        std::string text = claim_text(*math.args[0], {.letters = how_.letters}).text;
        for (std::size_t k = 1; k < math.args.size(); ++k)
            text = fmt::format("(({})'/{}')", text, name(*math.args[k], false));
        out() += text;
        return true;
    }

    void partial(const Math& math) {
        const bool is_by_time = math.args.size() == 2 && math.text != "d" && math.args[1]->kind == Kind::letter &&
                                math.args[1]->letter == Letter{.base = "t"};
        if (is_by_time && how_.is_autonomous) {
            out() += '0';
            return;
        }
        if (slope_of_motion(math) || partial_by_speed(math)) return;
        out() += "diff(";
        const Math& of = *math.args[0];
        if (of.kind == Kind::letter || of.kind == Kind::applied)
            letter(of, true);
        else
            term(of);
        for (std::size_t k = 1; k < math.args.size(); ++k) {
            out() += ',';
            if (math.args[k]->kind != Kind::letter)
                refuse(*math.args[k], say("expected a letter to differentiate by"));
            letter(*math.args[k], false);
        }
        out() += ')';
    }

    /// δθ as its value, δx of a place x as Σ ∂x/∂q δq.
    void variation(const Math& math) {
        const Math& of = *math.args[0];
        if (how_.differentials_are_rates) {  // dx = v dt
            out() += '(';
            term(of);
            out() += ")'";
            return;
        }
        if (how_.displacements == nullptr || moves_in_time(of))
            refuse(math, say("a virtual displacement has a meaning for coordinates and places only"));
        if (of.kind == Kind::letter)
            if (const auto value = how_.displacements->find(name(of, false)); value != how_.displacements->end()) {
                out() += value->second;
                return;
            }
        const ClaimText text = claim_text(of, {.letters = how_.letters});
        result_.names.insert(text.names.begin(), text.names.end());
        std::string terms;
        for (const auto& [coordinate, value] : *how_.displacements)
            if (value != "0")
                terms += fmt::format("{}diff({},{}){}", terms.empty() ? "" : " + ", text.text, coordinate,
                                     value == "1" ? "" : '*' + value);
        out() += terms.empty() ? "0" : '(' + terms + ')';
    }

    /// Whether rates stand in it, or T and L, which hold some.
    bool moves_in_time(const Math& math) const {
        std::map<Letter, int> all;
        collect_letters(math, all);
        return std::any_of(all.begin(), all.end(), [&](const auto& item) {
            const auto quantity = quantity_of(item.first);
            const auto known = how_.letters.name_of(item.first);
            const bool is_own = quantity && known && !how_.letters.is_of_scene(*known);
            return item.second > 0 || (is_own && *quantity != MechanicalQuantity::potential);
        });
    }

    void quantity(const Math& math) {
        const UnitReading unit = read_unit(math.text);
        if (!unit.meaning || (!unit.doubts.empty() && unit.doubts[0].mass.empty()))
            refuse(math, say("the unit '{}' is not known", math.text));
        inside(*math.args[0], Bond::product);
        if (!unit.meaning->exact.empty()) out() += "*(" + unit.meaning->exact + ')';
    }

    const ClaimWriting& how_;
    ClaimText result_;
};

}  // namespace

ClaimText claim_text(const Math& math, const ClaimWriting& writing) {
    return Writer(writing).write(math);
}

Lone lone_letter(const Math& side) {
    using Kind = Math::Kind;
    if (side.kind == Kind::letter && side.dots == 0) return {&side, 1};
    const bool is_function = side.kind == Kind::applied && side.letter.base.size() == 1;
    if (is_function && std::all_of(side.args.begin(), side.args.end(),
                                   [](const MathPtr& arg) { return arg->kind == Kind::letter; }))
        return {&side, 1};
    const bool is_square = side.kind == Kind::power && side.args[0]->kind == Kind::letter &&
                           side.args[0]->dots == 0 && side.args[1]->kind == Kind::number &&
                           side.args[1]->text == "2";
    return is_square ? Lone{side.args[0].get(), 2} : Lone{};
}

bool holds_root(const Math& math) {
    return (math.kind == Math::Kind::call && math.text == "sqrt") ||
           std::any_of(math.args.begin(), math.args.end(), [](const MathPtr& arg) { return holds_root(*arg); });
}

bool is_accelerated(const Math& math) {
    return math.dots > 1 || std::any_of(math.args.begin(), math.args.end(),
                                        [](const MathPtr& arg) { return is_accelerated(*arg); });
}

void collect_letters(const Math& math, std::map<Letter, int>& to) {
    if (math.kind == Math::Kind::letter || math.kind == Math::Kind::applied) {
        int& most = to[math.letter];
        most = std::max(most, math.dots);
    }
    for (const MathPtr& arg : math.args) collect_letters(*arg, to);
}

std::string compact(std::string text) {
    std::erase(text, ' ');
    return text;
}

}  // namespace alembert
