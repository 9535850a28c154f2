// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "scene/advice.hpp"
#include "scene/book_letters.hpp"
#include "scene/functions.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

using Kind = Tree::Kind;

constexpr int most_suggestions = 200;  // a limit, because finding them takes time and nobody reads more

constexpr const char* no_derivative =
    to_say("a vector has no plain derivative; the rate of pos(P) is vel(P), that of vel(P) is acc(P)");

struct RateSpelling {
    std::string_view before, after, primes;
};
/// Spellings that are not certain.
constexpr RateSpelling spellings_of_rates[] = {
    {"dd", "", "''"},  {"d", "", "'"},      {"", "_dd", "''"}, {"", "_d", "'"},     {"", "dd", "''"},
    {"", "d", "'"},    {"", "_tt", "''"},   {"", "_t", "'"},   {"", "_pp", "''"},   {"", "_p", "'"},
    {"", "pp", "''"},  {"", "p", "'"},      {"", "_dot", "'"}, {"", "dot", "'"},    {"", "_ddot", "''"},
    {"dot_", "", "'"}, {"ddot_", "", "''"}, {"v_", "", "'"},   {"omega_", "", "'"}, {"a_", "", "''"}};

std::string order_name(int order) {
    return order == 1 ? say("rates") : say("accelerations");
}

bool begins_with(const std::string& text, const char* beginning) {
    return text.rfind(beginning, 0) == 0;
}

/// z1, z2 …, the intermediate symbols that `derive` prints when the equations are too long to be read, or u1, u2
/// …, the speeds that a formalism chooses.
bool is_given_by_derive(const std::string& text) {
    return text.size() > 1 && (text[0] == 'z' || text[0] == 'u') &&
           text.find_first_not_of("0123456789", 1) == std::string::npos;
}

}  // namespace

void Quantities::complain(const Context& context, const Tree& tree, std::string message) {
    diagnostics_.push_back({context.expression.place(tree.offset), std::move(message)});
}

std::string Quantities::suggestion(const std::string& word, const std::vector<std::string>& known) {
    if (++suggestions_ > most_suggestions) return {};
    const std::string meant = word == "π" ? "pi" : nearest(word, known);
    return meant.empty() ? "" : say("; did you mean '{}'?", meant);
}

bool Quantities::is_used(Declared::Kind kind, const std::string& name) const {
    if (kind == Declared::Kind::frame) return used_frames_.contains(name);
    return (kind == Declared::Kind::point ? used_points_ : used_values_).contains(name);
}

namespace {

constexpr double whole_turn = 6.2832;

/// A plain number beyond a whole turn, as it is written: hardly radians.
std::optional<std::string> many_turns(const Tree& angle) {
    const bool is_negative = angle.kind == Kind::negate;
    const Tree& number = is_negative ? *angle.args[0] : angle;
    if (number.kind != Kind::number || value_of_digits(number.text) < whole_turn) return std::nullopt;
    return (is_negative ? "-" : "") + number.text;
}

}  // namespace

void Quantities::doubt_angle(const Context& context, const Tree& call) {
    const Tree& arg = *call.args[0];
    if (const auto number = many_turns(arg))
        warnings_.push_back(
            {context.expression.place(arg.offset),
             say("{0}({1}) takes {1} as radians; an angle in degrees is written {0}({1} deg)", call.text, *number),
             Severity::warning, "suspicious_number"});
}

void Quantities::doubt_rotation(const Expression& angle) {
    if (!angle.tree) return;
    if (const auto number = many_turns(*angle.tree))
        warnings_.push_back({angle.place(),
                             say("a rotation takes {0} as radians; an angle in degrees is written {1}", *number,
                                 in_quotes(*number + " deg")),
                             Severity::warning, "suspicious_number"});
}

void Quantities::describe(const Definition& definition) {
    if (!definition.value.tree) return;
    const Legal anything{.subject = say("a definition"), .order = 2, .input_order = 2, .time = true};
    const Legal motion{.subject = say("a prescribed motion"), .input_order = 0, .time = true};
    Context context{definition.value, definition.is_motion ? motion : anything};
    if (definition.is_motion) {
        need_scalar(context, *definition.value.tree, 0);
    } else if (definition.has_components) {
        for (const TreePtr& term : definition.value.tree->args)
            if (rank(context, *term->args[0], 0) == Rank::vector)
                complain(context, *term->args[0],
                         say("a component of a vector is a number, and this is a vector; take its component "
                             "with dot(…, ex(N)), or write a sum of vectors without brackets"));
        vectors_.insert(definition.name.text);
    } else if (rank(context, *definition.value.tree, 0) == Rank::vector)
        vectors_.insert(definition.name.text);
    definitions_[definition.name.text] = context.contents;
}

void Quantities::describe(const Speed& speed) {
    if (!speed.form.tree) return;
    const Legal form{.subject = say("a generalized speed"), .order = 1, .input_order = 1, .time = true};
    unknown_.clear();
    Context context{speed.form, form};
    need_scalar(context, *speed.form.tree, 0);
    definitions_[speed.name.text] = context.contents;
}

void Quantities::check(const Expression& expression, const Legal& legal) {
    if (!expression.tree) return;
    unknown_.clear();
    Context context{expression, legal};
    need_scalar(context, *expression.tree, 0);
}

void Quantities::need_scalar(Context& context, const Tree& tree, int raised) {
    if (rank(context, tree, raised) == Rank::vector)
        complain(context, tree,
                 say("a vector stands where a number is expected; take a component, dot(…, ex(N)), or norm(…)"));
}

Quantities::Rank Quantities::rank(Context& context, const Tree& tree, int raised) {
    const auto refuse_vector = [&](const Tree& arg, int further, const std::string& message) {
        if (rank(context, arg, raised + further) == Rank::vector) complain(context, arg, message);
        return Rank::number;
    };
    switch (tree.kind) {
        case Kind::number:
            return Rank::number;
        case Kind::name:
            meet_name(context, tree, raised);
            if (!vectors_.contains(tree.text)) return Rank::number;
            if (tree.primes > 0) complain(context, tree, translated(no_derivative));
            return Rank::vector;
        case Kind::call:
            return rank_of_call(context, tree, raised);
        case Kind::sum:
            return rank_of_sum(context, tree, raised);
        case Kind::product:
            return rank_of_product(context, tree, raised);
        case Kind::negate:
            return rank(context, *tree.args[0], raised);
        case Kind::reciprocal:
            return refuse_vector(*tree.args[0], 0, say("a division by a vector"));
        case Kind::power:
            for (const TreePtr& arg : tree.args)
                refuse_vector(*arg, 0, say("a vector in a power; its square is dot(u, u)"));
            return Rank::number;
        case Kind::derivative:
            return refuse_vector(*tree.args[0], tree.primes, translated(no_derivative));
    }
    return Rank::number;
}

Quantities::Rank Quantities::rank_of_sum(Context& context, const Tree& tree, int raised) {
    Rank first = Rank::wrong;
    bool is_consistent = true;
    for (const TreePtr& arg : tree.args) {
        const Rank next = rank(context, *arg, raised);
        if (first == Rank::wrong) first = next;
        if (next == first || next == Rank::wrong || !is_consistent) continue;
        complain(
            context, *arg,
            next == Rank::vector ? say("a vector is added to a number") : say("a number is added to a vector"));
        is_consistent = false;
    }
    return is_consistent ? first : Rank::wrong;
}

/// "2m" may be meant as twice the mass m.
void Quantities::refuse_ambiguous_unit(Context& context, const Tree& tree) {
    const std::string& number = tree.args[0]->text;
    const std::size_t after = static_cast<std::size_t>(tree.offset) + number.size();
    const bool is_apart = after >= context.expression.text.size() || context.expression.text[after] == ' ';
    if (is_apart || NameSpaces::find(names_.values, tree.unit) == nullptr) return;
    complain(context, tree,
             say("an operator is missing here, or a blank; write {0}*{1} for the product with {1} of this scene, "
                 "and {0} {1} "
                 "for the unit",
                 number, tree.unit));
}

Quantities::Rank Quantities::rank_of_product(Context& context, const Tree& tree, int raised) {
    if (!tree.unit.empty()) {
        refuse_ambiguous_unit(context, tree);
        return Rank::number;
    }
    Rank product = Rank::number;
    for (const TreePtr& arg : tree.args) {
        const Rank factor = rank(context, *arg, raised);
        if (factor == Rank::vector && product == Rank::vector) {
            complain(context, *arg, say("a product of two vectors; write dot(u, v) or cross(u, v)"));
            product = Rank::wrong;
        }
        if (factor != Rank::number && product != Rank::wrong) product = factor;
    }
    return product;
}

/// diff(x, t) holds x constant, and is hardly meant.
void Quantities::refuse_rate_by_diff(Context& context, const Tree& call) {
    if (call.args.size() < 2 || call.args[1]->kind != Kind::name || call.args[1]->text != "t") return;
    const Tree& of = *call.args[0];
    const Declared* const declared = of.kind == Kind::name ? NameSpaces::find(names_.values, of.text) : nullptr;
    if (declared == nullptr || declared->kind != Declared::Kind::coordinate) return;
    const bool is_twice = call.args.size() > 2 && call.args[2]->text != "1";
    complain(context, call,
             say("diff is a partial derivative, which holds {0} constant; its rate: write {0}{1}",
                 of.text + std::string(static_cast<std::size_t>(of.primes), '\''), is_twice ? "''" : "'"));
}

Quantities::Rank Quantities::rank_of_call(Context& context, const Tree& tree, int raised) {
    const Function* const function = find_function(tree.text);
    if (!function) {
        if (context.legal.claim && is_book_call(tree, names_)) {
            meet_book_call(context, tree);
            return Rank::number;
        }
        if (tree.text != "(-)") meet_function(context, tree);
        for (const TreePtr& arg : tree.args) need_scalar(context, *arg, raised);
        return Rank::number;
    }
    if (tree.text == "sin" || tree.text == "cos" || tree.text == "tan") doubt_angle(context, tree);
    for (const TreePtr& arg : tree.args) switch (function->takes) {
            case Function::Takes::derivative:
            case Function::Takes::scalars:
                if (rank(context, *arg, raised) == Rank::vector)
                    complain(context, *arg, say("'{}' takes numbers, and this is a vector", function->name));
                break;
            case Function::Takes::vectors:
                if (rank(context, *arg, raised) == Rank::number)
                    complain(context, *arg,
                             say("'{}' takes vectors (pos(P), vel(P), omega(B), ex(B) and what is made of them), "
                                 "and this is a number",
                                 function->name));
                break;
            case Function::Takes::points:
                check_place(arg->text, context.expression.place(arg->offset), "point");
                break;
            case Function::Takes::frames:
                check_place(arg->text, context.expression.place(arg->offset), "frame");
                break;
        }
    if (tree.text == "diff") refuse_rate_by_diff(context, tree);
    if (function->takes == Function::Takes::points || function->takes == Function::Takes::frames)
        meet(context, tree, {.order = function->order}, raised);
    return function->gives_vector ? Rank::vector : Rank::number;
}

/// A call of a function of [functions].
void Quantities::meet_function(Context& context, const Tree& tree) {
    used_values_.insert(tree.text);
    const Declared* const declared = NameSpaces::find(names_.values, tree.text);
    if (!declared || declared->kind != Declared::Kind::function) {
        const std::string& text = context.expression.text;
        const std::size_t opening = text.find('(', static_cast<std::size_t>(tree.offset));
        const std::size_t end = static_cast<std::size_t>(tree.offset + tree.length);
        const std::string argument =
            opening < end && end - opening <= 24 ? escaped(text.substr(opening, end - opening)) : "(…)";
        std::vector<std::string> known = function_names();
        for (const UnspecifiedFunction& f : names_.functions) known.push_back(f.name.text);
        if (const std::string advice = advice_on_function(tree.text); !advice.empty())
            return complain(context, tree, say("unknown function {}; {}", in_quotes(tree.text), advice));
        const std::string meant = nearest(tree.text, known);
        return complain(
            context, tree,
            say("unknown function {}{}; if a product was meant write {}*{}", in_quotes(tree.text),
                meant.empty() ? "" : say("; did you mean '{}'?", meant), escaped(tree.text), argument));
    }
    const UnspecifiedFunction& function = names_.functions[declared->index];
    if (tree.args.size() != function.arguments.size())
        complain(context, tree,
                 say("{} takes {} argument{}, not {}: {}", in_quotes(tree.text), function.arguments.size(),
                     function.arguments.size() == 1 ? "" : "s", tree.args.size(), function.usage()));
    if (function.table) return;
    if (context.legal.order < 0)
        complain(context, tree,
                 say("{} needs a value, and {} has none: [functions] leaves it open", context.legal.subject,
                     in_quotes(tree.text)));
    context.contents.order = std::max(context.contents.order, 0);  // where it is open, so are values
}

void Quantities::meet_name(Context& context, const Tree& tree, int raised) {
    used_values_.insert(tree.text);
    const auto constant = [&](const std::string& what) {
        if (tree.primes > 0)
            complain(context, tree, say("{} {}: it has no derivative", in_quotes(tree.text), what));
    };
    if (context.legal.more && context.legal.more->count(tree.text) > 0) return;
    if (tree.text == "pi") return constant(say("is a number"));
    if (tree.text == "t") {
        constant(say("is the time, whose derivative is 1"));
        return meet(context, tree, {.time = true}, raised);
    }
    const Declared* const declared = NameSpaces::find(names_.values, tree.text);
    if (!declared) return meet_unknown(context, tree, raised);
    switch (declared->kind) {
        case Declared::Kind::parameter:
            return constant(say("is a parameter and does not change with time"));
        case Declared::Kind::coordinate:
            return meet(context, tree, {.order = 0}, raised + tree.primes);
        case Declared::Kind::state:
            return meet(context, tree, {.order = 0}, raised + tree.primes);
        case Declared::Kind::input:
            return meet(context, tree, {.input_order = 0, .time = true}, raised + tree.primes);
        case Declared::Kind::definition:
            if (!context.legal.definitions)
                return complain(
                    context, tree,
                    say("{} may not refer to a definition: {}", context.legal.subject, in_quotes(tree.text)));
            return meet(context, tree, definitions_[tree.text], raised + tree.primes);
        case Declared::Kind::speed: {
            Contents contents = definitions_[tree.text];
            contents.order = 1;
            return meet(context, tree, contents, raised + tree.primes);
        }
        case Declared::Kind::function:
            return complain(context, tree,
                            say("{} is a function; write {}{}", in_quotes(tree.text),
                                names_.functions[declared->index].usage(),
                                tree.primes > 0 ? say(", and diff(…) for its derivative") : ""));
        case Declared::Kind::multiplier:
            if (!context.legal.multipliers)
                complain(context, tree,
                         say("{} may not depend on a multiplier: {}; friction that grows with a normal "
                             "force is a table of its own, [[friction]]",
                             context.legal.subject, in_quotes(tree.text)));
            return constant(say("is a multiplier, whose derivative mechanics does not give"));
        default:
            return;
    }
}

void Quantities::meet(Context& context, const Tree& tree, Contents found, int raised) {
    if (found.order >= 0) found.order += raised;
    if (found.input_order >= 0) found.input_order += raised;
    context.contents.order = std::max(context.contents.order, found.order);
    context.contents.input_order = std::max(context.contents.input_order, found.input_order);
    context.contents.time |= found.time;

    const Legal& legal = context.legal;
    const Declared* const declared =
        tree.kind == Kind::name ? NameSpaces::find(names_.values, tree.text) : nullptr;
    const std::string word = in_quotes(tree.text + std::string(static_cast<std::size_t>(tree.primes), '\''));
    const bool is_speed = declared && declared->kind == Declared::Kind::speed;
    const bool is_state = declared && declared->kind == Declared::Kind::state;
    const bool indirect = is_speed || (declared && declared->kind == Declared::Kind::definition);
    if (found.order > std::max(2, legal.order) || found.input_order > 2)
        return complain(context, tree,
                        say("a third derivative, by {}; only claims about the motion may hold one", word));
    if (found.order >= 0 && legal.order < 0)
        return complain(context, tree,
                        say("{} may depend on {} only; {} {}", legal.subject,
                            legal.time ? say("the time and parameters") : say("parameters"), word,
                            is_speed   ? say("is a generalized speed")
                            : indirect ? say("contains a coordinate")
                            : is_state ? say("is a state")
                            : declared ? say("is a coordinate")
                                       : say("depends on the coordinates")) +
                            legal.if_changing);
    if (found.time && !legal.time)
        return complain(context, tree,
                        say("{} may depend on parameters only; {} {}", legal.subject, word,
                            tree.text == "t" ? say("is the time")
                            : indirect       ? say("contains the time")
                                             : say("is an input, a function of time")) +
                            legal.if_changing);
    if (found.order > legal.order)
        return complain(context, tree,
                        say("{} may not depend on {}: {}{}{}", legal.subject, order_name(found.order), word,
                            indirect ? say(" contains one") : "", legal.advice));
    if (found.input_order > legal.input_order)
        complain(context, tree,
                 say("{} may not depend on the {} derivative of an input: {}", legal.subject,
                     found.input_order == 1 ? say("first") : say("second"), word));
}

/// What to write in place of a name that the scene does not have, where it is known from elsewhere.
std::string Quantities::advice_on(const std::string& word) const {
    const auto moves = [&](const std::string& name) {
        const Declared* const declared = NameSpaces::find(names_.values, name);
        return declared != nullptr &&
               (declared->kind == Declared::Kind::coordinate || declared->kind == Declared::Kind::input ||
                declared->kind == Declared::Kind::speed || declared->kind == Declared::Kind::state);
    };
    for (const auto& [before, after, primes] : spellings_of_rates) {
        if (word.size() <= before.size() + after.size() || !word.starts_with(before) || !word.ends_with(after))
            continue;
        const std::string name = word.substr(before.size(), word.size() - before.size() - after.size());
        if (moves(name)) return say("; the rate of {0} is written {0}{1}", name, primes);
    }
    if (const std::string advice = advice_on_name(word); !advice.empty()) return say("; write {}", advice);
    if (word == "g") return say("; [parameters] has no g: write g = 9.81 there");
    return {};
}

/// T, V, Q_theta … in a claim. A virtual displacement is no function of time.
void Quantities::meet_book_letter(Context& context, const Tree& tree, int raised) {
    const bool is_virtual = !after_prefix(tree.text, "delta").empty();
    if (is_virtual && tree.primes > 0)
        complain(context, tree,
                 say("{} belongs to a virtual displacement: it has no derivative", in_quotes(tree.text)));
    meet(context, tree, {.order = tree.text == "V" || is_virtual ? 0 : 1}, raised + tree.primes);
}

/// T(M1), Q_theta(force_1), inertia(B, P, u, v): names first, then vectors.
void Quantities::meet_book_call(Context& context, const Tree& tree) {
    const bool is_inertia = tree.text == book_inertia;
    const std::size_t names = is_inertia ? 2 : 1, most = is_inertia ? 4 : 1;
    if (tree.args.size() < names || tree.args.size() > most)
        return complain(context, tree,
                        is_inertia
                            ? say("expected inertia(B, P), inertia(B, P, u) or inertia(B, P, u, v): a body, a "
                                  "point, and the axes that it is along")
                            : say("expected one name of a part of the mechanism: {}(M1)", tree.text));
    for (std::size_t k = 0; k < tree.args.size(); ++k) {
        const Tree& arg = *tree.args[k];
        if (k < names && (arg.kind != Kind::name || arg.primes > 0))
            complain(context, arg,
                     say("expected the name of a part of the mechanism; for a product write {}*(…)", tree.text));
        else if (k == 0 && is_inertia)
            check_place(arg.text, context.expression.place(arg.offset),
                        NameSpaces::find(names_.frames, arg.text) != nullptr ? "frame" : "point");
        else if (k == 1 && is_inertia)
            check_place(arg.text, context.expression.place(arg.offset), "point");
        else if (k >= names && rank(context, arg, 0) == Rank::number)
            complain(context, arg, say("a number stands where a vector is expected"));
    }
}

void Quantities::meet_unknown(Context& context, const Tree& tree, int raised) {
    if (context.legal.claim && is_book_letter(tree.text, names_)) return meet_book_letter(context, tree, raised);
    if (context.legal.claim &&
        (begins_with(tree.text, "p_") || begins_with(tree.text, "lambda") || is_given_by_derive(tree.text)))
        return;
    if (!unknown_.insert(tree.text).second) return;
    std::string message = say("unknown name {} in this expression", in_quotes(tree.text));
    if (const Declared* const other = NameSpaces::find(names_.points, tree.text)) {
        message += say("; {} is {}, whose position is pos({})", tree.text, described(other->kind), tree.text);
    } else if (const Declared* const frame = NameSpaces::find(names_.frames, tree.text)) {
        message += say("; {} is {}, not a number", tree.text, described(frame->kind));
    } else if (const Function* const function = find_function(tree.text)) {
        message += say("; the function needs its argument in parentheses: {}", function->usage);
    } else if (const std::string advice = advice_on(tree.text); !advice.empty()) {
        message += advice;
    } else {
        message += suggestion(tree.text, values_);
    }
    complain(context, tree, std::move(message));
}

void Quantities::check_place(const std::string& name, Place place, const std::string& kind) {
    const bool is_point = kind == "point";
    (is_point ? used_points_ : used_frames_).insert(name);
    const NameSpaces::Space& other = is_point ? names_.frames : names_.points;
    if (place.line == 0 || name == (is_point ? "O" : "N") ||
        NameSpaces::find(is_point ? names_.points : names_.frames, name))
        return;
    const std::string wanted = is_point ? say("point") : say("frame");
    std::string message = say("unknown {} {}", wanted, in_quotes(name));
    if (const Declared* const declared = NameSpaces::find(other, name))
        message = say("{} is {}; expected a {}", in_quotes(name), described(declared->kind), wanted);
    else
        message += suggestion(name, is_point ? points_ : frames_);
    diagnostics_.push_back({place, std::move(message)});
}

}  // namespace alembert
