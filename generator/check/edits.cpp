// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/edits.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "scene/functions.hpp"

namespace alembert {

using Kind = Tree::Kind;

namespace {

// The sizes of changes. Only their order matters.
constexpr double of_sign = 1, of_turn = 1.3, of_square = 1.5, of_number = 1.55, of_dot = 1.6, of_angle = 1.8,
                 of_name = 2, of_power = 2.05, of_parameter = 2.2, of_factor = 2.4, of_inner_term = 2.7,
                 of_other_rate = 2.75, of_term = 3, of_digit = 0.03;

/// Terms and factors in all changes: some 100 MB.
constexpr std::size_t most_room = 4000000;

/// The terms of all sums and the factors of all products.
std::size_t terms_in(const Tree& tree) {
    std::size_t count = tree.kind == Kind::sum || tree.kind == Kind::product ? tree.args.size() : 0;
    for (const TreePtr& arg : tree.args) count += terms_in(*arg);
    return count;
}

bool contains(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

/// pos(P), ex(B) …, whose names are those of points and frames.
bool is_of_geometry(const Tree& tree) {
    const Function* const function = tree.kind == Kind::call ? find_function(tree.text) : nullptr;
    return function != nullptr &&
           (function->takes == Function::Takes::points || function->takes == Function::Takes::frames);
}

bool is_turn(const Tree& tree) {
    return tree.kind == Kind::call && (tree.text == "sin" || tree.text == "cos" || tree.text == "tan");
}

bool is_zero_number(const Tree& tree) {
    return tree.kind == Kind::number && tree.text == "0";
}

bool is_name(const Tree& tree) {
    return tree.kind == Kind::name || tree.kind == Kind::call;
}

bool has_loose_inner_sum(const Tree& tree, const std::string& source, bool outermost) {
    if (tree.kind == Kind::sum && !outermost && is_loose(tree, source)) return true;
    return std::any_of(tree.args.begin(), tree.args.end(), [&](const TreePtr& arg) {
        return has_loose_inner_sum(*arg, source, outermost && tree.kind == Kind::negate);
    });
}

}  // namespace

bool is_accelerated(const Tree& tree) {
    return (tree.kind == Kind::name && tree.primes >= 2) || tree.kind == Kind::derivative ||
           std::any_of(tree.args.begin(), tree.args.end(), [](const TreePtr& a) { return is_accelerated(*a); });
}

bool has_derivative(const Tree& tree) {
    return tree.kind == Kind::derivative ||
           std::any_of(tree.args.begin(), tree.args.end(), [](const TreePtr& a) { return has_derivative(*a); });
}

bool ClaimWords::is_steady(const Tree& tree) const {
    if (tree.kind == Kind::name) return is_parameter(tree.text) || tree.text == "pi";
    if (tree.kind == Kind::derivative || is_of_geometry(tree)) return false;
    return std::all_of(tree.args.begin(), tree.args.end(), [&](const TreePtr& arg) { return is_steady(*arg); });
}
bool ClaimWords::is_parameter(const std::string& name) const {
    return contains(parameters, name);
}
bool ClaimWords::has_rate(const std::string& name) const {
    return contains(coordinates, name) || contains(inputs, name);
}

Edits::Edits(const Claim& claim, const ClaimWords& words)
    : claim_(claim), words_(words), steady_([this](const Tree& tree) { return words_.is_steady(tree); }) {
    for (const bool left : {true, false}) loose_ = loose_ || has_loose_inner_sum(*side(left), source(left), true);
    width_ = terms_in(*side(true)) + terms_in(*side(false));
    for (const bool left : {true, false}) terms_of(side(left), left, false, false);
    std::stable_sort(list.begin(), list.end(), [](const Edit& a, const Edit& b) { return a.size < b.size; });
}

// Changes

Edit Edits::with_part_of(const Summand& s, const Tree* part, const TreePtr& by, std::string kind,
                         double size) const {
    const TreePtr changed = with_part(s.whole, part, by, source(s.left));
    const TreePtr whole = with_part(side(s.left), s.whole.get(), changed, source(s.left));
    const TreePtr body = without_sign(changed).first;
    return {.size = size + burden(s),
            .kind = std::move(kind),
            .lhs = s.left ? whole : side(true),
            .rhs = s.left ? side(false) : whole,
            .term = in_source(*s.body, s.left),
            .should_be = in_source(*body, s.left),
            .changed = body};
}

Edit Edits::named(Edit edit, std::string written, std::string meant) {
    edit.written = std::move(written);
    edit.meant = std::move(meant);
    return edit;
}

void Edits::name_factor(Edit& edit, const TreePtr& body, const TreePtr& base, int exponent) const {
    const int before = ProductTree(body, steady_).exponent_of(base), after = before + exponent;
    const auto raised = [&](int to) {
        return plain_text_of(to == 1 ? *base : *made(Kind::power, {base, number_tree(to)}));
    };
    if (before * after > 0 && base->kind == Kind::name)  // l^2 for l
        edit = named(std::move(edit), raised(std::abs(before)), raised(std::abs(after)));
    else if (before * after >= 0 && exponent * (before + after) > 0)
        edit = named(std::move(edit), "", exponent > 0 ? raised(exponent) : "1/" + raised(-exponent));
    else if (before * after >= 0)
        edit = named(std::move(edit), exponent < 0 ? raised(-exponent) : "1/" + raised(exponent), "");
}

Edit Edits::with_body(const Summand& s, const TreePtr& body, std::string kind, double size) const {
    const TreePtr changed = s.negative ? made(Kind::negate, {body}) : body;
    return with_part_of(s, s.whole.get(), changed, std::move(kind), size);
}

Edit Edits::with_term(const TreePtr& term, bool accelerated, double size) const {
    const auto is_alone = [&](bool left) { return is_name(*without_sign(side(left)).first); };
    const bool on_left =
        is_zero_number(*side(false)) ||
        (!is_zero_number(*side(true)) && !is_alone(true) &&
         (is_alone(false) || (accelerated && is_accelerated(*side(true)) && !is_accelerated(*side(false)))));
    // The term makes left − right vanish if it is added on the left.
    std::vector<TreePtr> terms;
    if (!on_left && term->kind == Kind::sum)
        for (const TreePtr& part : term->args) terms.push_back(negated(part));
    const TreePtr added = on_left ? term : terms.empty() ? negated(term) : made(Kind::sum, std::move(terms));
    const TreePtr sum = plus(side(on_left), added, true);
    return {.size = size,
            .kind = "missing_term",
            .lhs = on_left ? sum : side(true),
            .rhs = on_left ? side(false) : sum,
            .term = text_of(*added, {}),
            .should_be = {},
            .changed = added};
}

Edit Edits::with_inner_term(const Summand& s, const TreePtr& part, const TreePtr& term, double size) const {
    Edit edit = with_part_of(s, part.get(), plus(part, term, loose_), "missing_term", size);
    edit.written = edit.term;
    edit.meant = std::exchange(edit.should_be, {});
    edit.term = plain_text_of(*term);
    return edit;
}

Edit Edits::without(const Summand& s, double size) const {
    const TreePtr whole = without_term(side(s.left), s.whole.get(), source(s.left));
    return {.size = size + burden(s),
            .kind = "extra_term",
            .lhs = s.left ? whole : side(true),
            .rhs = s.left ? side(false) : whole,
            .term = in_source(*s.body, s.left),
            .should_be = {},
            .changed = {}};
}

std::vector<Edit> Edits::in_place_of(const TreePtr& alien, const TreePtr& own, double size) const {
    std::vector<Edit> result;
    for (const Summand& s : summands) {
        if (s.in_angle || s.in_derivative) continue;
        if (own) {
            result.push_back(with_part_of(s, s.whole.get(), s.left ? own : negated(own), "wrong_row", size));
        } else if (!s.alone) {
            result.push_back(without(s, size));
            result.back().kind = "wrong_row";
        }
    }
    // It may be more than one term.
    Edit whole = with_term(own ? plus(negated(alien), own, true) : negated(alien), false, size + 0.01);
    whole.kind = "wrong_row";
    whole.term = plain_text_of(*alien);
    result.push_back(std::move(whole));
    return result;
}

std::optional<Edit> Edits::with_two_signs(const Summand& a, const Summand& b, double size) const {
    Edit edit{.size = size + burden(a) + burden(b),
              .kind = "sign",
              .lhs = side(true),
              .rhs = side(false),
              .term = in_source(*a.body, a.left),
              .should_be = {},
              .changed = a.body,
              .also = in_source(*b.body, b.left)};
    for (const Summand* s : {&a, &b}) {
        TreePtr& root = s->left ? edit.lhs : edit.rhs;
        const TreePtr changed = with_part(root, s->whole.get(), turned(*s), source(s->left));
        if (changed == root) return std::nullopt;
        root = changed;
    }
    return edit;
}

std::vector<Edit> Edits::with_factor_on_rest(double size) const {
    constexpr std::size_t fewest_terms = 3;  // of two terms the factor is missing on one
    std::vector<Edit> result;
    for (const bool left : {true, false}) {
        const Tree& sum = *side(left);
        if (sum.kind != Kind::sum || sum.args.size() < fewest_terms) continue;
        const ProductTree first(without_sign(sum.args[0]).first, steady_);
        for (const std::string& name : words_.parameters) {
            const TreePtr factor = name_tree(name);
            if (first.exponent_of(factor) < 1) continue;
            std::vector<TreePtr> terms{sum.args[0]};
            std::string rest;
            for (std::size_t k = 1; k < sum.args.size(); ++k) {
                const auto [body, is_negative] = without_sign(sum.args[k]);
                const TreePtr product = made(Kind::product, {factor, body});
                terms.push_back(is_negative ? made(Kind::negate, {product}) : product);
                rest += (rest.empty() ? "" : ", ") + in_source(*body, left);
            }
            const TreePtr changed = made(Kind::sum, std::move(terms));
            Edit edit{.size = size,
                      .kind = "factor",
                      .lhs = left ? changed : side(true),
                      .rhs = left ? side(false) : changed,
                      .term = std::move(rest),
                      .should_be = {},
                      .changed = side(left)};
            result.push_back(named(std::move(edit), "", name));
        }
    }
    return result;
}

bool Edits::is_whole(const Summand& s) const {
    return s.whole == side(s.left) && is_zero_number(*side(!s.left));
}

double Edits::burden(const Summand& s) const {
    double result = s.first && !s.alone ? 0.01 : 0;
    if (s.in_angle) return result;
    if (s.whole == side(true) && !is_zero_number(*side(false))) result += is_name(*s.body) ? 0.6 : 0.05;
    if (is_accelerated(*s.body)) result += 0.02;
    return result;
}

// Terms

void Edits::terms_of(const TreePtr& tree, bool left, bool in_angle, bool in_derivative) {
    if (tree->kind != Kind::sum) return summand(tree, left, true, true, in_angle, in_derivative);
    for (std::size_t k = 0; k < tree->args.size(); ++k)
        summand(tree->args[k], left, k == 0, false, in_angle, in_derivative);
}

void Edits::summand(const TreePtr& tree, bool left, bool first, bool alone, bool in_angle, bool in_derivative) {
    if (is_zero_number(*tree)) return;
    const auto [body, negative] = without_sign(tree);
    summands.push_back({.left = left,
                        .whole = tree,
                        .body = body,
                        .negative = negative,
                        .first = first,
                        .alone = alone,
                        .in_angle = in_angle,
                        .in_derivative = in_derivative});
    if (!has_room()) return;
    const Summand s = summands.back();
    const std::size_t number = summands.size() - 1;
    const bool is_sole = alone && (tree == side(left));
    sign(s);
    if (!is_whole(s)) numbers(s);
    if (!is_whole(s) && !in_angle) factors(s);
    if (!in_angle && (!alone || (is_sole && !is_name(*side(!left)) && !is_zero_number(*side(!left)))))
        list.push_back(without(s, of_term));
    leaves(tree, number, false);
}

bool Edits::has_room() {
    complete = complete && list.size() * width_ <= most_room;
    return complete;
}

TreePtr Edits::turned(const Summand& s) {
    return s.alone || s.negative ? negated(s.whole) : made(Kind::negate, {s.whole});
}

void Edits::sign(const Summand& s) {
    if (s.in_angle && s.alone) return;
    Edit edit = with_part_of(s, s.whole.get(), turned(s), s.in_angle ? "wrong_argument" : "sign",
                             s.in_angle ? of_angle : of_sign);
    if (!s.in_angle) edit.should_be.clear();
    edit.changed = s.body;
    list.push_back(std::move(edit));
}

void Edits::numbers(const Summand& s) {
    static constexpr std::array<std::tuple<long, long, double>, 18> ratios{{{2, 1, 0},
                                                                            {1, 2, 0},
                                                                            {3, 1, 0.2},
                                                                            {1, 3, 0.2},
                                                                            {4, 1, 0.2},
                                                                            {1, 4, 0.2},
                                                                            {3, 2, 0.7},
                                                                            {2, 3, 0.7},
                                                                            {4, 3, 1.6},
                                                                            {3, 4, 1.6},
                                                                            {6, 1, 0.9},
                                                                            {1, 6, 0.9},
                                                                            {8, 1, 1},
                                                                            {1, 8, 1},
                                                                            {12, 1, 1},
                                                                            {1, 12, 1},
                                                                            {5, 2, 1},
                                                                            {2, 5, 1}}};
    for (const auto& [n, d, more] : ratios) {
        ProductTree product(s.body, steady_);
        product.times(n, d);
        Edit edit = with_body(s, product.tree(), s.in_angle ? "wrong_argument" : "factor",
                              (s.in_angle ? of_angle + 0.1 : of_number) + more +
                                  of_digit * static_cast<double>(size_of_numbers(product.tree()) - 2));
        if (n == 1 || d == 1)
            edit = named(std::move(edit), d == 1 ? "" : std::to_string(d), n == 1 ? "" : std::to_string(n));
        list.push_back(std::move(edit));
    }
}

void Edits::factors(const Summand& s) {
    const auto times = [&](const TreePtr& base, int exponent, const std::string& kind, double size) {
        if (!has_room()) return;
        ProductTree product(s.body, steady_);
        const bool was_there = product.times(base, exponent);
        Edit edit = with_body(s, product.tree(), kind, size - (was_there ? 0.1 : 0));
        name_factor(edit, s.body, base, exponent);
        list.push_back(std::move(edit));
    };
    if (s.body->kind == Kind::number) return;
    const ProductTree own(s.body, steady_);
    for (const std::string& name : words_.parameters) {
        const bool is_length = words_.lengths.contains(name);
        const TreePtr base = name_tree(name);
        if (const int there = own.exponent_of(base); there != 0)  // n^2 for 1/n^2
            times(base, -2 * there, "factor", of_factor + 0.1);
        for (const int exponent : {-1, 1})
            times(base, exponent, is_length ? "wrong_arm" : "factor", of_parameter - (is_length ? 0.05 : 0));
    }
    for (const TreePtr& angle : words_.angles)
        for (const char* function : {"cos", "sin"}) {
            const TreePtr base = made(Kind::call, {angle}, function);
            if (const int there = own.exponent_of(base); there != 0)
                times(base, -2 * there, "factor", of_factor + 0.1);
            for (const int exponent : {1, 2, -1})
                times(base, exponent, "factor", of_factor + (exponent == 2 ? 0.15 : 0));
        }
    for (const TreePtr& angle : words_.angles) {  // tan² α for tan α
        const TreePtr base = made(Kind::call, {angle}, "tan");
        if (own.exponent_of(base) == 0) continue;
        for (const int exponent : {1, -1}) times(base, exponent, "factor", of_factor + 0.05);
    }
    for (const std::string& name : words_.coordinates) {
        for (const int exponent : {1, -1}) times(name_tree(name), exponent, "factor", of_factor);
        times(name_tree(name, 1), 1, "factor", of_factor + 0.1);
    }
}

// Parts of terms

void Edits::leaves(const TreePtr& tree, std::size_t number, bool is_power_base) {
    if (!has_room()) return;
    const Summand s = summands[number];
    switch (tree->kind) {
        case Kind::name:
            return name(tree, number, is_power_base);
        case Kind::number:
            return;
        case Kind::power:
            if (tree->args[1]->kind == Kind::number) power(tree, number);
            return leaves(tree->args[0], number, true);
        case Kind::call:
            if (is_of_geometry(*tree) || tree->text == "(-)") return;
            if (is_turn(*tree)) {
                turn(tree, number);
                return terms_of(tree->args[0], s.left, true, s.in_derivative);
            }
            for (const TreePtr& arg : tree->args) leaves(arg, number, false);
            return;
        case Kind::derivative:
            return terms_of(tree->args[0], s.left, s.in_angle, true);
        case Kind::sum:
            steady_sum(tree, number);
            dots(tree, number);
            return terms_of(tree, s.left, s.in_angle, s.in_derivative);
        default:
            for (const TreePtr& arg : tree->args) leaves(arg, number, false);
    }
}

void Edits::name(const TreePtr& tree, std::size_t number, bool is_power_base) {
    const Summand s = summands[number];
    const std::string& own = tree->text;
    const bool is_rate = tree->primes == 1 && is_power_base && !s.in_derivative && words_.has_rate(own);
    for (const std::string& other : words_.coordinates)  // of a turn relative to another one
        if (is_rate && other != own) {
            const TreePtr rate = name_tree(other, 1);
            for (const TreePtr& added : {rate, made(Kind::negate, {rate})}) {
                const TreePtr sum = made(Kind::sum, {tree, added});
                list.push_back(named(with_part_of(s, tree.get(), sum, "factor", of_other_rate),
                                     plain_text_of(*tree), plain_text_of(*sum)));
            }
        }
    const auto swap = [&](const TreePtr& by, const std::string& kind, double size) {
        list.push_back(named(with_part_of(s, tree.get(), by, s.in_angle ? "wrong_argument" : kind, size),
                             plain_text_of(*tree), plain_text_of(*by)));
    };
    if (words_.is_parameter(own)) {
        const bool is_length = words_.lengths.contains(own);
        for (const std::string& other : words_.parameters)
            if (other != own && words_.lengths.contains(other) == is_length)
                swap(name_tree(other), is_length ? "wrong_arm" : "factor", of_name);
        if (!s.in_angle && !is_power_base) {
            swap(made(Kind::power, {tree, number_tree(3)}), is_length ? "wrong_arm" : "factor", of_parameter);
            if (tree != s.body || s.alone) steady_sum(tree, number);
        }
        return;
    }
    if (contains(words_.multipliers, own))
        for (const std::string& other : words_.multipliers)
            if (other != own) swap(name_tree(other), "wrong_row", of_name);
    if (!words_.has_rate(own) || s.in_angle) return;
    for (const auto* list : {&words_.coordinates, &words_.inputs})
        if (contains(*list, own))
            for (const std::string& other : *list)
                if (other != own) swap(name_tree(other, tree->primes), "wrong_argument", of_name);
    for (const int more : {1, -1, 2, -2})
        if (const int primes = tree->primes + more; primes >= 0 && primes <= 2)
            swap(name_tree(own, primes), "lost_dot", of_dot + (std::abs(more) > 1 ? 0.2 : 0));
    if (tree->primes == 1 && !is_power_base)
        swap(made(Kind::power, {tree, number_tree(2)}), "lost_dot", of_square);
}

void Edits::power(const TreePtr& tree, std::size_t number) {
    const Tree& base = *tree->args[0];
    const bool is_rate = base.kind == Kind::name && base.primes > 0,
               is_length = base.kind == Kind::name && words_.lengths.contains(base.text);
    for (const long other : {1, 2, 3, 4}) {
        if (tree->args[1]->text == std::to_string(other)) continue;
        const TreePtr by = other == 1 ? tree->args[0] : made(Kind::power, {tree->args[0], number_tree(other)});
        list.push_back(named(with_part_of(summands[number], tree.get(), by,
                                          is_rate     ? "lost_dot"
                                          : is_length ? "wrong_arm"
                                                      : "factor",
                                          of_power),
                             plain_text_of(*tree), plain_text_of(*by)));
    }
}

void Edits::turn(const TreePtr& tree, std::size_t number) {
    const Summand s = summands[number];
    if (tree->text != "tan") {
        const std::string other = tree->text == "sin" ? "cos" : "sin";
        list.push_back(
            named(with_part_of(s, tree.get(), made(Kind::call, tree->args, other), "swapped_trig", of_turn),
                  tree->text, other));
    }
    for (const TreePtr& angle : words_.angles) {
        if (same(*angle, *tree->args[0])) continue;
        const TreePtr by = made(Kind::call, {angle}, tree->text);
        list.push_back(named(with_part_of(s, tree.get(), by, "wrong_argument", of_angle), plain_text_of(*tree),
                             plain_text_of(*by)));
    }
}

/// M·x'' in place of (M + m)·x''. `tree` is a name or a sum in `summand`.
void Edits::steady_sum(const TreePtr& tree, std::size_t number) {
    const Summand s = summands[number];
    if (!words_.is_steady(*tree) || s.in_angle) return;
    for (const TreePtr& term : words_.steady) {
        if (plain_text_of(*term) == plain_text_of(*tree)) continue;
        for (const bool minus : {false, true}) {
            const TreePtr more = minus ? made(Kind::negate, {term}) : term;
            list.push_back(with_inner_term(s, tree, more, of_inner_term + (minus ? 0.1 : 0)));
        }
    }
}

/// c·(x' − y') for c·(x − y), and the other way.
void Edits::dots(const TreePtr& tree, std::size_t number) {
    const Summand s = summands[number];
    if (s.in_angle || tree == side(s.left)) return;
    for (const int more : {1, -1}) {
        const TreePtr by = with_dots(tree, more);
        if (!by) continue;
        list.push_back(
            named(with_part_of(s, tree.get(), by, "lost_dot", of_dot), plain_text_of(*tree), plain_text_of(*by)));
    }
}

/// A sum of rates of one order, each perhaps with a steady factor, with more dots; null if it is none.
TreePtr Edits::with_dots(const TreePtr& tree, int more) const {
    switch (tree->kind) {
        case Kind::name: {
            const int primes = tree->primes + more;
            return words_.has_rate(tree->text) && primes >= 0 && primes <= 2 ? name_tree(tree->text, primes)
                                                                             : nullptr;
        }
        case Kind::sum:
        case Kind::negate:
        case Kind::product: {
            std::vector<TreePtr> args;
            std::size_t moving = 0;
            for (const TreePtr& arg : tree->args) {
                const bool is_factor = tree->kind == Kind::product && words_.is_steady(*arg);
                args.push_back(is_factor ? detached(arg) : with_dots(arg, more));
                if (!args.back()) return nullptr;
                if (!is_factor) ++moving;
            }
            return tree->kind == Kind::product && moving != 1 ? nullptr : made(tree->kind, std::move(args));
        }
        default:
            return nullptr;
    }
}

}  // namespace alembert
