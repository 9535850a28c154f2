// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/translate.hpp"

#include <cln/exception.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "algebra/symbolic/distance.hpp"
#include "algebra/symbolic/functions.hpp"
#include "algebra/symbolic/unspecified.hpp"
#include "base/language/say.hpp"
#include "scene/functions.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

numeric exact_number(const std::string& literal) {
    std::string digits;
    long exponent = 0;
    bool after_point = false;
    for (std::size_t i = 0; i < literal.size(); ++i) {
        const char c = literal[i];
        if (c == '.') {
            after_point = true;
        } else if (c == 'e' || c == 'E') {
            exponent += std::stol(literal.substr(i + 1));
            break;
        } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
            digits += c;
            if (after_point) --exponent;
        } else {
            throw std::invalid_argument(literal + " is no literal of a number");
        }
    }
    const numeric mantissa(digits.empty() ? "0" : digits.c_str());
    return mantissa * GiNaC::pow(numeric(10), numeric(exponent));
}

ex Translator::scalar(const Expression& expression) {
    const Expression* const former = current_;
    current_ = &expression;
    const ex value = scalar_of(*expression.tree);
    current_ = former;
    return value;
}

Value Translator::value(const Expression& expression) {
    const Expression* const former = current_;
    current_ = &expression;
    Value value = evaluate(*expression.tree);
    current_ = former;
    if (ex* scalar = std::get_if<ex>(&value)) *scalar = mechanism_.z->name(*scalar);
    return value;
}

ex Translator::scalar_of(const Tree& tree) {
    const Value value = evaluate(tree);
    if (const ex* scalar = std::get_if<ex>(&value)) return *scalar;
    throw SceneMistake{
        {current_->place(tree.offset), say("a vector stands where a number is expected; take a component "
                                           "with dot(…, ex(N)) or its length with norm(…)")}};
}

bool Translator::knows(const std::string& name) const {
    const auto is_it = [&](const GiNaC::symbol& q) { return q.get_name() == name; };
    return name == "t" || name == "pi" || values_.contains(name) || later_.contains(name) ||
           functions_.contains(name) || std::any_of(mechanism_.q.begin(), mechanism_.q.end(), is_it);
}

ex Translator::scalar_named(const std::string& name) {
    return scalar_of(Tree{.kind = Tree::Kind::name, .text = name});
}

Vector3 Translator::vector_of(const Tree& tree) {
    const Value value = evaluate(tree);
    if (const Vector3* vector = std::get_if<Vector3>(&value)) return *vector;
    throw SceneMistake{{current_->place(tree.offset), say("a number stands where a vector is expected")}};
}

ex Translator::differentiated(ex value, int times, const Tree& tree) {
    for (int i = 0; i < times; ++i) {
        if (mechanism_.z->depends(value, without_derivative_))
            throw SceneMistake{{current_->place(tree.offset),
                                say("the derivative of an acceleration, a multiplier or an unknown function: "
                                    "mechanics gives none; differentiate what has rates only")}};
        value = mechanism_.time_derivative({value})[0];
    }
    return value;
}

/// diff(e, x, 2, y): the partial derivative, all other quantities of the scene being held.
ex Translator::partial(const Tree& tree) {
    if (partials_ && tree.args.size() == 2)
        if (const auto known = partials_(*tree.args[0], *tree.args[1])) return *known;
    ex value = scalar_of(*tree.args[0]);
    for (const auto& [by, times] : derivative_steps(tree)) {
        const ex variable = mechanism_.z->name(scalar_of(*by));
        const bool is_free = GiNaC::is_a<GiNaC::symbol>(variable) &&
                             mechanism_.z->find(GiNaC::ex_to<GiNaC::symbol>(variable)) == nullptr;
        for (int i = 0; i < times; ++i)
            value = is_free ? mechanism_.z->push_forward({value}, {{GiNaC::ex_to<GiNaC::symbol>(variable), 1}})[0]
                            : by_argument(value, *by);
        if (is_free && variable.is_equal(mechanism_.t) && value.is_zero() &&
            !offered_.contains(tree.args[0]->text))
            throw SceneMistake{
                {current_->place(tree.offset),
                 say("this does not depend on t by itself; a derivative in the course of the motion is "
                     "written with a prime: x' or (…)'")}};
    }
    return value;
}

/// The derivative of a call of a function of [functions] by one of its arguments, which `by` is equal to, or whose
/// position it is.
ex Translator::by_argument(const ex& value, const Tree& by) {
    ex call = value;
    if (GiNaC::is_a<GiNaC::symbol>(call))
        if (const auto* entry = mechanism_.z->find(GiNaC::ex_to<GiNaC::symbol>(call))) call = entry->definition;
    const auto of = unspecified_call(call);
    const ex argument = mechanism_.z->name(scalar_of(by));
    ex result = 0;
    for (std::size_t k = 0; of && k < of->arguments.size(); ++k) {
        const bool is_it = by.kind == Tree::Kind::number ? argument.is_equal(static_cast<int>(k + 1))
                                                         : argument.is_equal(of->arguments[k]);
        if (is_it) result += unspecified_value(differentiated_by(*of, k));
    }
    if (result.is_zero())
        throw SceneMistake{
            {current_->place(by.offset),
             say("expected by what is differentiated: a coordinate, a rate, a parameter, an input or t, or "
                 "for a function of [functions] one of its arguments or the position of one")}};
    return result;
}

Value Translator::named(const Tree& tree) {
    const auto place = current_->place(tree.offset);
    if (tree.text == "pi") return GiNaC::Pi;
    for (std::size_t i = 0; i < mechanism_.q.size(); ++i)
        if (mechanism_.q[i].get_name() == tree.text) {
            if (tree.primes > 2) {  // known to those who can eliminate it
                const auto third = values_.find(tree.text + "'''");
                if (tree.primes > 3 || third == values_.end()) break;
                return third->second;
            }
            return ex(tree.primes == 0   ? mechanism_.q[i]
                      : tree.primes == 1 ? mechanism_.qdot[i]
                                         : mechanism_.qddot[i]);
        }
    if (auto found = later_.find(tree.text); found != later_.end()) {
        const auto make = std::move(found->second);
        later_[tree.text] = [&tree, place]() -> Value {
            throw SceneMistake{{place, say("'{}' is defined by itself, through the geometry", tree.text)}};
        };
        const Expression* const here = current_;
        values_[tree.text] = make();
        current_ = here;
        later_.erase(tree.text);
    }
    if (const auto found = values_.find(tree.text); found != values_.end()) {
        const ex* const scalar = std::get_if<ex>(&found->second);
        return scalar ? differentiated(*scalar, tree.primes, tree) : found->second;
    }
    throw SceneMistake{{place, say("unknown name '{}' in this expression", tree.text)}};
}

Vector3 Translator::rate_of(const Vector3& v) const {
    const std::vector<ex> rate = mechanism_.time_derivative({v[0], v[1], v[2]});
    return {rate[0], rate[1], rate[2]};
}

std::optional<ex> Translator::own_component(const Tree& u, const Tree& v) const {
    const auto is_call = [](const Tree& tree) { return tree.kind == Tree::Kind::call; };
    if (!is_call(u) || !is_call(v)) return std::nullopt;
    const auto turns = [](const Tree& tree) { return tree.text == "omega" || tree.text == "alpha"; };
    if (turns(v)) return turns(u) ? std::nullopt : own_component(v, u);
    const std::string axes[] = {"ex", "ey", "ez"};
    const auto axis = std::find(std::begin(axes), std::end(axes), v.text);
    if (!turns(u) || axis == std::end(axes)) return std::nullopt;
    const Orientation &turning = queries_.orientation(u.args.at(0)->text),
                      &frame = queries_.orientation(v.args.at(0)->text);
    if (&turning != &frame) return std::nullopt;
    const Vector3& omega = frame.angular_velocity();
    return (u.text == "omega" ? omega : rate_of(omega))[static_cast<std::size_t>(axis - std::begin(axes))];
}

ex Translator::length(const Vector3& v) {
    Intermediates& z = *mechanism_.z;
    if (sheets_)
        if (const auto e = sheets_->root(dot(v, v, z), z, RootSheets::Of::distance)) return *e;
    return norm(v, z);
}

std::optional<ex> Translator::applied(const std::string& function, const std::vector<ex>& args) {
    Intermediates& z = *mechanism_.z;
    std::optional<ex> on_sheet;
    if (sheets_ && function == "sqrt") on_sheet = sheets_->root(args[0], z);
    if (sheets_ && function == "abs") on_sheet = sheets_->magnitude(args[0], z);
    if (sheets_ && function == "sign") on_sheet = sheets_->sign(args[0], z);
    if (sheets_ && (function == "min" || function == "max")) {
        ex value = args.at(0);
        for (std::size_t k = 1; k < args.size(); ++k)
            if (const auto first_is_larger = sheets_->is_larger(value, args[k], z))
                value = *first_is_larger == (function == "max") ? value : args[k];
            else
                value = z.name(*apply_function(function, {value, args[k]}));
        on_sheet = value;
    }
    return on_sheet ? on_sheet : apply_function(function, args);
}

ex Translator::power(const ex& base, const ex& exponent) {
    const ex twice = 2 * exponent;
    if (sheets_ && twice.info(GiNaC::info_flags::odd))
        if (const auto e = sheets_->root(base, *mechanism_.z)) return pow(*e, twice);
    return pow(base, exponent);
}

Value Translator::call(const Tree& tree) {
    Intermediates& z = *mechanism_.z;
    const auto name_of = [&](std::size_t k) -> const std::string& { return tree.args.at(k)->text; };
    if (tree.text == "pos") {
        if (tree.args.size() == 1) return queries_.position(name_of(0));
        return add(queries_.position(name_of(1)), scale(-1, queries_.position(name_of(0)), z), z);
    }
    if (tree.text == "(-)") {  // x'(-), if it is known
        const std::string name = name_of(0) + "'(-)";
        if (const auto found = values_.find(name); found != values_.end()) return found->second;
        throw SceneMistake{{current_->place(tree.offset), say("unknown rate '{}'", name)}};
    }
    if (tree.text == "vel") return queries_.velocity(name_of(0));
    if (tree.text == "acc") return rate_of(queries_.velocity(name_of(0)));
    if (tree.text == "omega" || tree.text == "alpha") {
        // dω/dt is the same in N and in the frame itself, since ω × ω = 0.
        const Orientation& frame = queries_.orientation(name_of(0));
        const Vector3& omega = frame.angular_velocity();
        return frame.to_inertial(tree.text == "omega" ? omega : rate_of(omega), z);
    }
    if (tree.text == "ex") return queries_.orientation(name_of(0)).axis(0);
    if (tree.text == "ey") return queries_.orientation(name_of(0)).axis(1);
    if (tree.text == "ez") return queries_.orientation(name_of(0)).axis(2);
    if (tree.text == "dot")
        if (const auto own = own_component(*tree.args[0], *tree.args[1])) return *own;
    if (tree.text == "dot") return dot(vector_of(*tree.args[0]), vector_of(*tree.args[1]), z);
    if (tree.text == "cross") return cross(vector_of(*tree.args[0]), vector_of(*tree.args[1]), z);
    if (tree.text == "norm") return length(vector_of(*tree.args[0]));
    std::vector<ex> args;
    if (tree.text == "diff") return partial(tree);
    if (calls_ && !functions_.contains(tree.text))
        if (const auto value = calls_(tree)) return *value;
    for (const TreePtr& arg : tree.args) args.push_back(z.name(scalar_of(*arg)));
    if (const auto open = functions_.find(tree.text); open != functions_.end())
        return unspecified_value(
            {.function = open->second, .arguments = args, .orders = std::vector<int>(args.size(), 0)});
    if (const auto value = applied(tree.text, args)) return *value;
    throw SceneMistake{{current_->place(tree.offset), say("unknown function '{}'", tree.text)}};
}

Value Translator::evaluate(const Tree& tree) {
    Intermediates& z = *mechanism_.z;
    try {
        switch (tree.kind) {
            case Tree::Kind::number:
                return ex(exact_number(tree.text));
            case Tree::Kind::name:
                return named(tree);
            case Tree::Kind::call:
                return call(tree);
            case Tree::Kind::derivative:
                return differentiated(scalar_of(*tree.args[0]), tree.primes, tree);
            case Tree::Kind::power:
                return power(scalar_of(*tree.args[0]), scalar_of(*tree.args[1]));
            case Tree::Kind::reciprocal:
                return ex(1 / scalar_of(*tree.args[0]));
            case Tree::Kind::negate: {
                const Value value = evaluate(*tree.args[0]);
                if (const Vector3* v = std::get_if<Vector3>(&value)) return scale(-1, *v, z);
                return ex(-std::get<ex>(value));
            }
            case Tree::Kind::sum: {
                const Value first = evaluate(*tree.args[0]);
                if (const Vector3* v = std::get_if<Vector3>(&first)) {
                    Vector3 sum = *v;
                    for (std::size_t i = 1; i < tree.args.size(); ++i) sum = add(sum, vector_of(*tree.args[i]), z);
                    return sum;
                }
                GiNaC::exvector terms{std::get<ex>(first)};
                for (std::size_t i = 1; i < tree.args.size(); ++i) terms.push_back(scalar_of(*tree.args[i]));
                const ex sum = GiNaC::add(std::move(terms));
                return is_distance_from_number(sum, z) ? z.name(sum) : sum;
            }
            case Tree::Kind::product: {
                GiNaC::exvector factors;
                std::optional<Vector3> vector;
                for (const TreePtr& arg : tree.args) {
                    const Value value = evaluate(*arg);
                    if (const ex* scalar = std::get_if<ex>(&value))
                        factors.push_back(*scalar);
                    else if (!vector)
                        vector = std::get<Vector3>(value);
                    else
                        throw SceneMistake{{current_->place(arg->offset),
                                            say("a product of two vectors; write dot(a,b) or cross(a,b)")}};
                }
                const ex product = GiNaC::mul(std::move(factors));
                if (vector) return scale(product, *vector, z);
                return product;
            }
        }
    } catch (const GiNaC::pole_error&) {
        throw SceneMistake{{current_->place(tree.offset), say("this divides by zero")}};
    } catch (const std::overflow_error&) {
        throw SceneMistake{{current_->place(tree.offset), say("this divides by zero")}};
    } catch (const std::domain_error&) {
        throw SceneMistake{{current_->place(tree.offset),
                            say("this is 0^0, which has no value; expected another base or exponent")}};
    } catch (const cln::runtime_exception&) {
        throw SceneMistake{{current_->place(tree.offset), say("a number beyond the range of double precision")}};
    }
    return ex(0);
}

}  // namespace alembert
