// SPDX-License-Identifier: GPL-2.0-or-later
// Lines between vectors, component by component.
#include "check/derivation/marker.hpp"

#include <algorithm>

#include "base/language/say.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

MathPtr letter_of(const Letter& letter, const Math& at, int dots = 0) {
    auto result = std::make_shared<Math>();
    result->kind = Kind::letter;
    result->letter = letter;
    result->dots = dots;
    result->offset = at.offset;
    result->length = at.length;
    return result;
}

MathPtr made(Kind kind, std::vector<MathPtr> args, const Math& at, int dots = 0) {
    auto result = std::make_shared<Math>();
    result->kind = kind;
    result->args = std::move(args);
    result->dots = dots;
    result->offset = at.offset;
    result->length = at.length;
    return result;
}

MathPtr number(const char* text, const Math& at) {
    auto result = std::make_shared<Math>();
    result->kind = Kind::number;
    result->text = text;
    result->offset = at.offset;
    result->length = at.length;
    return result;
}

/// The axis of a unit vector: \mathbf i, \hat x, e_y; −1 if it is none.
int axis_of(const Letter& letter) {
    const bool marked = letter.accent == "mathbf" || letter.accent == "hat" || letter.accent == "vec" ||
                        letter.accent == "boldsymbol";
    for (int axis = 0; axis < 3; ++axis) {
        const std::string unit(1, "ijk"[axis]), name(1, "xyz"[axis]);
        if (marked && letter.index.empty() && (letter.base == unit || letter.base == name)) return axis;
        if (letter.base == "e" && (letter.index == name || letter.index == std::to_string(axis + 1))) return axis;
    }
    return -1;
}

}  // namespace

/// M q'' with a matrix that is written out, and factors before it; nothing if it is none.
std::optional<Marker::Components> Marker::matrix_times_vector(const Math& product) const {
    if (product.args.size() < 2) return std::nullopt;
    const Math& matrix = *product.args[product.args.size() - 2];
    const auto of = components(*product.args.back());
    if (matrix.kind != Kind::matrix || !of || matrix.args.size() > 3) return std::nullopt;
    Components result(3, number("0", product));
    for (std::size_t i = 0; i < matrix.args.size(); ++i) {
        std::vector<MathPtr> terms;
        const std::vector<MathPtr>& row = matrix.args[i]->args;
        if (row.size() > 3) return std::nullopt;
        for (std::size_t j = 0; j < row.size(); ++j) {
            if (row[j]->kind == Kind::number && row[j]->text == "0") continue;
            std::vector<MathPtr> factors(product.args.begin(), product.args.end() - 2);
            factors.push_back(row[j]);
            factors.push_back((*of)[j]);
            terms.push_back(made(Kind::product, std::move(factors), product));
        }
        if (terms.size() == 1) result[i] = terms[0];
        if (terms.size() > 1) result[i] = made(Kind::sum, std::move(terms), product);
    }
    return result;
}

/// The components of an expression that is a vector; nothing if it is none.
std::optional<Marker::Components> Marker::components(const Math& math) const {
    const auto nothing = number("0", math);
    switch (math.kind) {
        case Kind::vector: {
            Components result = math.args;
            if (result.size() < 2 || result.size() > 3) return std::nullopt;
            result.resize(3, nothing);
            return result;
        }
        case Kind::letter: {
            if (const auto known = vectors_.find(math.letter); known != vectors_.end()) {
                Components result;
                for (const MathPtr& part : known->second) {
                    const Math& zero = *part;
                    result.push_back(zero.kind == Kind::letter ? letter_of(zero.letter, math, math.dots) : part);
                }
                return result;
            }
            const int axis = axis_of(math.letter);
            if (axis < 0 || letters_.name_of(math.letter)) return std::nullopt;
            Components result(3, nothing);
            result[static_cast<std::size_t>(axis)] = number("1", math);
            return result;
        }
        case Kind::negate:
        case Kind::rate: {
            auto of = components(*math.args[0]);
            if (!of) return std::nullopt;
            for (MathPtr& part : *of)
                if (part->kind != Kind::number || part->text != "0")
                    part = made(math.kind, {part}, math, math.dots);
            return of;
        }
        case Kind::sum: {
            Components result(3, nothing);
            for (const MathPtr& term : math.args) {
                const auto of = components(*term);
                if (!of) return std::nullopt;
                for (std::size_t k = 0; k < 3; ++k) {
                    const bool zero = (*of)[k]->kind == Kind::number && (*of)[k]->text == "0";
                    if (!zero)
                        result[k] = result[k] == nothing ? (*of)[k] : made(Kind::sum, {result[k], (*of)[k]}, math);
                }
            }
            return result;
        }
        case Kind::product: {
            std::optional<Components> vector;
            std::vector<MathPtr> factors;
            if (const auto turned = matrix_times_vector(math)) return turned;
            for (const MathPtr& factor : math.args) {
                auto of = components(*factor);
                if (of && vector) return std::nullopt;
                if (of)
                    vector = std::move(of);
                else
                    factors.push_back(factor);
            }
            if (!vector) return std::nullopt;
            for (MathPtr& part : *vector) {
                if (part->kind == Kind::number && part->text == "0") continue;
                std::vector<MathPtr> all = factors;
                if (part->kind != Kind::number || part->text != "1" || all.empty()) all.push_back(part);
                part = all.size() == 1 ? all[0] : made(Kind::product, all, math);
            }
            return vector;
        }
        default:
            return std::nullopt;
    }
}

/// q = (ψ, ε): from then on a vector with these components.
bool Marker::lists_coordinates(const Math& lhs, const Math& rhs) {
    if (lhs.kind != Kind::letter || lhs.dots > 0 || rhs.kind != Kind::vector || letters_.name_of(lhs.letter))
        return false;
    const auto listed = components(rhs);
    const bool are_coordinates =
        listed && std::all_of(rhs.args.begin(), rhs.args.end(), [this](const MathPtr& part) {
            const auto name =
                part->kind == Kind::letter && part->dots == 0 ? letters_.name_of(part->letter) : std::nullopt;
            return name && letters_.is_of_scene(*name) && letters_.moves(*name);
        });
    if (!are_coordinates) return false;
    vectors_[lhs.letter] = *listed;
    letters_.leave_to_author(lhs.letter);
    return true;
}

/// Gives a vector letter the components of the point of the scene that it is, or of the one that its index names.
bool Marker::bind_vector(const Math& letter, const Components& value) {
    MotionRows& rows = system_.rows();
    const std::vector<VectorBinding> bindings = vector_bindings_of(letter.letter, system_.scene());
    std::optional<std::vector<std::string>> chosen;
    for (const VectorBinding& binding : bindings) {
        std::vector<std::string> signs;
        for (std::size_t k = 0; k < 3; ++k) {
            const ex stated = truth_.value(claim_text(*value[k], {.letters = letters_}).text);
            const ex truth = truth_.value(binding.component[k]);
            if (rows.is_identity(rows.row(stated - truth)) == true)
                signs.push_back(binding.component[k]);
            else if (rows.is_identity(rows.row(stated + truth)) == true)
                signs.push_back("-" + binding.component[k]);
        }
        if (signs.size() == 3) {
            chosen = signs;
            break;
        }
        const std::string& index = letter.letter.index;
        const bool may_count_otherwise = !index.empty() &&
                                         index.find_first_not_of("0123456789") == std::string::npos &&
                                         !is_counted(system_.scene());
        if (binding.named && !may_count_otherwise && !chosen)
            chosen = std::vector<std::string>(std::begin(binding.component), std::end(binding.component));
    }
    Components parts;
    for (std::size_t k = 0; k < 3; ++k) {
        Letter part = letter.letter;
        part.accent.clear();
        part.index += (part.index.empty() ? "" : ",") + std::string(1, "xyz"[k]);
        const ex truth = truth_.value(chosen ? (*chosen)[k] : claim_text(*value[k], {.letters = letters_}).text);
        bind(part, truth);
        parts.push_back(letter_of(part, letter));
    }
    vectors_[letter.letter] = std::move(parts);
    return chosen.has_value();
}

/// B_1 = (1, 0, 0, r): a column of more than three numbers is no vector of space, and says nothing that can be
/// judged.
bool Marker::is_column(MarkedLine& line, const Math& lhs, const Math& rhs) const {
    const bool column = rhs.kind == Kind::vector || rhs.kind == Kind::matrix;
    if (!column || lhs.kind != Kind::letter) return false;
    line.status = LineStatus::definition;
    line.claim.clear();
    return true;
}

/// Lines between vectors: each component is judged, and the worst is told.
bool Marker::judge_vector(MarkedLine& line, const Math& lhs, const Math& rhs) {
    std::optional<Components> left = components(lhs), right = components(rhs);
    if (!left && !right) return is_column(line, lhs, rhs);
    const Math& open = left ? rhs : lhs;
    bool is_defined = true;
    if (open.kind == Kind::number && open.text == "0") (left ? right : left) = Components(3, number("0", open));
    if (!left || !right) {
        const bool may_bind = open.kind == Kind::letter && open.dots == 0 && !letters_.name_of(open.letter);
        if (!may_bind)
            throw NoMeaning{
                .reason = say("a vector stands on one side only"), .offset = open.offset, .length = open.length};
        is_defined = bind_vector(open, left ? *left : *right);
        left = components(lhs);
        right = components(rhs);
    }
    std::optional<MarkedLine> worst;
    LineNotes notes;
    for (std::size_t k = 0; k < 3; ++k) {
        MarkedLine part = line;
        judge_pair(part, *(*left)[k], *(*right)[k]);
        if (!worst || is_worse(part.status, worst->status)) {
            worst = part;
            notes = notes_.back();
        }
    }
    line = *worst;
    notes_.back() = std::move(notes);
    if (!is_defined && line.status == LineStatus::right) line.status = LineStatus::definition;
    for (std::size_t k = 0; k < 3; ++k) {
        const Math &a = *(*left)[k], &b = *(*right)[k];
        if (a.kind != Kind::letter || a.dots > 0) continue;
        const auto name = letters_.name_of(a.letter);
        if (!name || !known_.contains(*name)) continue;
        const ex stated = own_.value(claim_text(b, {.letters = letters_, .steps = &own_.steps()}).text);
        const bool same = system_.rows().is_identity(system_.rows().row(stated - known_[*name])) == true;
        own_.state(*name, stated, same ? std::nullopt : std::optional(lines.size()));
    }
    return true;
}

}  // namespace alembert
