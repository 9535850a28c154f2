// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/functions.hpp"

#include <array>
#include <stdexcept>

#include "algebra/symbolic/unspecified.hpp"
#include "base/language/say.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Of two real numbers, whether the first is smaller.
std::optional<bool> is_smaller(const ex& a, const ex& b) {
    const auto is_real = [](const ex& x) {
        return GiNaC::is_a<GiNaC::numeric>(x) && GiNaC::ex_to<GiNaC::numeric>(x).is_real();
    };
    if (!is_real(a) || !is_real(b)) return std::nullopt;
    return GiNaC::ex_to<GiNaC::numeric>(a) < GiNaC::ex_to<GiNaC::numeric>(b);
}

ex minimum_eval(const ex& a, const ex& b) {
    const std::optional<bool> is_first = is_smaller(a, b);
    return is_first ? (*is_first ? a : b) : ex(minimum(a, b).hold());
}

ex maximum_eval(const ex& a, const ex& b) {
    const std::optional<bool> is_second = is_smaller(a, b);
    return is_second ? (*is_second ? b : a) : ex(maximum(a, b).hold());
}

ex derivative_of_minimum(const ex& a, const ex& b, unsigned k) {
    return function_derivative(minimum(a, b), static_cast<int>(k));
}
ex derivative_of_maximum(const ex& a, const ex& b, unsigned k) {
    return function_derivative(maximum(a, b), static_cast<int>(k));
}

ex absolute_eval(const ex& x) {
    if (GiNaC::is_a<GiNaC::numeric>(x)) return GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(x));
    return absolute(x).hold();
}
ex derivative_of_absolute(const ex& x, unsigned) {
    return signum(x);
}

ex signum_eval(const ex& x) {
    if (GiNaC::is_a<GiNaC::numeric>(x)) return GiNaC::ex_to<GiNaC::numeric>(x).csgn();
    if (GiNaC::is_a<GiNaC::mul>(x))
        if (const ex factor = x.op(x.nops() - 1); GiNaC::is_a<GiNaC::numeric>(factor))
            return factor.info(GiNaC::info_flags::positive) ? ex(signum(x / factor)) : ex(-signum(x / factor));
    return signum(x).hold();
}
ex derivative_of_signum(const ex&, unsigned) {
    return 0;
}
/// sign³ is sign.
ex signum_power(const ex& x, const ex& exponent) {
    const bool is_whole = exponent.info(GiNaC::info_flags::posint);
    if (is_whole && exponent.info(GiNaC::info_flags::odd)) return signum(x).hold();
    return GiNaC::power(signum(x), is_whole ? ex(2) : exponent).hold();
}

}  // namespace

REGISTER_FUNCTION(minimum, eval_func(minimum_eval).evalf_func(minimum_eval).derivative_func(derivative_of_minimum))
REGISTER_FUNCTION(maximum, eval_func(maximum_eval).evalf_func(maximum_eval).derivative_func(derivative_of_maximum))
REGISTER_FUNCTION(absolute, eval_func(absolute_eval).derivative_func(derivative_of_absolute))
REGISTER_FUNCTION(
    signum,
    eval_func(signum_eval).evalf_func(signum_eval).derivative_func(derivative_of_signum).power_func(signum_power))

namespace {

/// Whether the value would contain nested roots, as for multiples of π/10, π/12 …
bool would_be_nested_roots(const ex& angle) {
    const ex half_turns = angle / GiNaC::Pi;
    if (!GiNaC::is_a<GiNaC::numeric>(half_turns)) return false;
    const GiNaC::numeric c = GiNaC::ex_to<GiNaC::numeric>(half_turns);
    return c.is_rational() && !(c * 6).is_integer() && !(c * 4).is_integer();
}

}  // namespace

ex exact_sine(const ex& angle) {
    return would_be_nested_roots(angle) ? ex(GiNaC::sin(angle).hold()) : ex(GiNaC::sin(angle));
}

ex exact_cosine(const ex& angle) {
    return would_be_nested_roots(angle) ? ex(GiNaC::cos(angle).hold()) : ex(GiNaC::cos(angle));
}

namespace {

struct Unary {
    const char* name;   // in the scene language
    const char* ginac;  // as GiNaC calls it
    ex (*apply)(const ex& x);
    ex (*derivative)(const ex& x, const ex& call);
};

const std::array<Unary, 13> unary{{
    {"sin", "sin", exact_sine, [](const ex& x, const ex&) -> ex { return exact_cosine(x); }},
    {"cos", "cos", exact_cosine, [](const ex& x, const ex&) -> ex { return -exact_sine(x); }},
    {"tan", "tan", [](const ex& x) -> ex { return tan(x); },
     [](const ex&, const ex& y) -> ex { return 1 + y * y; }},
    {"asin", "asin", [](const ex& x) -> ex { return asin(x); },
     [](const ex& x, const ex&) -> ex { return 1 / sqrt(1 - x * x); }},
    {"acos", "acos", [](const ex& x) -> ex { return acos(x); },
     [](const ex& x, const ex&) -> ex { return -1 / sqrt(1 - x * x); }},
    {"atan", "atan", [](const ex& x) -> ex { return atan(x); },
     [](const ex& x, const ex&) -> ex { return 1 / (1 + x * x); }},
    {"sinh", "sinh", [](const ex& x) -> ex { return sinh(x); },
     [](const ex& x, const ex&) -> ex { return cosh(x); }},
    {"cosh", "cosh", [](const ex& x) -> ex { return cosh(x); },
     [](const ex& x, const ex&) -> ex { return sinh(x); }},
    {"tanh", "tanh", [](const ex& x) -> ex { return tanh(x); },
     [](const ex&, const ex& y) -> ex { return 1 - y * y; }},
    {"exp", "exp", [](const ex& x) -> ex { return exp(x); }, [](const ex&, const ex& y) -> ex { return y; }},
    {"log", "log", [](const ex& x) -> ex { return log(x); }, [](const ex& x, const ex&) -> ex { return 1 / x; }},
    {"abs", "absolute", [](const ex& x) -> ex { return absolute(x); },
     [](const ex& x, const ex&) -> ex { return signum(x); }},
    {"sign", "signum", [](const ex& x) -> ex { return signum(x); }, [](const ex&, const ex&) -> ex { return 0; }},
}};

const Unary& find_unary(const std::string& ginac_name) {
    for (const Unary& f : unary)
        if (ginac_name == f.ginac) return f;
    throw std::invalid_argument(say("the function '{}' is not one of the scene language's", ginac_name));
}

}  // namespace

std::optional<ex> apply_function(const std::string& name, const std::vector<ex>& args) {
    if (args.size() == 1) {
        if (name == "sqrt") return sqrt(args[0]);
        for (const Unary& f : unary)
            if (name == f.name) return f.apply(args[0]);
    }
    if (name == "atan2" && args.size() == 2) return ex(atan2(args[0], args[1]));
    if ((name == "min" || name == "max") && args.size() >= 2) {
        ex value = args[0];
        for (std::size_t i = 1; i < args.size(); ++i)
            value = name == "min" ? ex(minimum(value, args[i])) : ex(maximum(value, args[i]));
        return value;
    }
    return std::nullopt;
}

std::string function_name(const ex& call) {
    const std::string name = GiNaC::ex_to<GiNaC::function>(call).get_name();
    if (name == "atan2" || name == unspecified_name) return name;
    if (name == "minimum") return "min";
    if (name == "maximum") return "max";
    return find_unary(name).name;
}

ex function_derivative(const ex& call, int k) {
    const std::string name = GiNaC::ex_to<GiNaC::function>(call).get_name();
    if (name == unspecified_name) {
        if (k == 0 || k % 2 == 1) return 0;  // the function, or an order
        return unspecified_value(differentiated_by(*unspecified_call(call), static_cast<std::size_t>(k / 2 - 1)));
    }
    if (name == "atan2") {
        const ex &y = call.op(0), &x = call.op(1);
        return (k == 0 ? x : -y) / (x * x + y * y);
    }
    if (name == "minimum" || name == "maximum") {  // 1 where this argument is the one chosen, else 0
        const ex difference = name == "minimum" ? call.op(1) - call.op(0) : call.op(0) - call.op(1);
        const ex chosen = (1 + signum(difference)) / 2;
        return k == 0 ? chosen : 1 - chosen;
    }
    return find_unary(name).derivative(call.op(0), call);
}

}  // namespace alembert
