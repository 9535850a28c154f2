// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/constant.hpp"

#include <fmt/format.h>

#include <cmath>

#include "alembert/base/error.hpp"
#include "algebra/symbolic/functions.hpp"
#include "base/language/say.hpp"
#include "model/translate.hpp"

namespace alembert {

namespace {

GiNaC::ex value_of(const Tree& tree) {
    std::vector<GiNaC::ex> args;
    for (const TreePtr& arg : tree.args) args.push_back(value_of(*arg));
    switch (tree.kind) {
        case Tree::Kind::number:
            return exact_number(tree.text);
        case Tree::Kind::name:
            if (tree.text == "pi" && tree.primes == 0) return GiNaC::Pi;
            throw ModelError(say("'{}' is no number; expected numbers, pi and functions of them", tree.text));
        case Tree::Kind::call:
            if (const auto value = apply_function(tree.text, args)) return *value;
            throw ModelError(say("{}(…) gives no number here", tree.text));
        case Tree::Kind::sum:
            return GiNaC::add(GiNaC::exvector(args.begin(), args.end()));
        case Tree::Kind::product:
            return GiNaC::mul(GiNaC::exvector(args.begin(), args.end()));
        case Tree::Kind::negate:
            return -args[0];
        case Tree::Kind::reciprocal:
            return 1 / args[0];
        case Tree::Kind::power:
            return pow(args[0], args[1]);
        case Tree::Kind::derivative:
            break;
    }
    throw ModelError(say("a derivative is no number; expected numbers, pi and functions of them"));
}

double nearest_double(const GiNaC::ex& value) {
    const GiNaC::ex number = value.evalf();
    if (!GiNaC::is_a<GiNaC::numeric>(number) || !GiNaC::ex_to<GiNaC::numeric>(number).is_real())
        throw ModelError(say("this is no real number"));
    const double result = GiNaC::ex_to<GiNaC::numeric>(number).to_double();
    if (!std::isfinite(result)) throw ModelError(say("this is beyond the range of double precision"));
    return result;
}

}  // namespace

GiNaC::ex constant_value(const std::string& text) {
    std::vector<Diagnostic> mistakes;
    const Expression expression = parse_expression(text, {}, mistakes);
    if (!expression) throw ModelError(mistakes.empty() ? say("this is no expression") : mistakes[0].message);
    try {
        const GiNaC::ex value = value_of(*expression.tree);
        nearest_double(value);
        return value;
    } catch (const ModelError&) {
        throw;
    } catch (const std::exception&) {  // thrown by GiNaC and CLN at poles, for 0^0 and on overflow
        throw ModelError(say("this has no value: it divides by zero, or is too large"));
    }
}

double constant_number(const std::string& text) {
    return nearest_double(constant_value(text));
}

}  // namespace alembert
