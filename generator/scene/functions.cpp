// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/functions.hpp"

#include <limits>
#include <string>
#include <vector>

namespace alembert {
namespace {

using Takes = Function::Takes;
constexpr int any = std::numeric_limits<int>::max();

constexpr Function functions[] = {
    {"sin", 1, 1, Takes::scalars, false, "sin(x)"},
    {"cos", 1, 1, Takes::scalars, false, "cos(x)"},
    {"tan", 1, 1, Takes::scalars, false, "tan(x)"},
    {"asin", 1, 1, Takes::scalars, false, "asin(x)"},
    {"acos", 1, 1, Takes::scalars, false, "acos(x)"},
    {"atan", 1, 1, Takes::scalars, false, "atan(x)"},
    {"atan2", 2, 2, Takes::scalars, false, "atan2(y, x)"},
    {"sinh", 1, 1, Takes::scalars, false, "sinh(x)"},
    {"cosh", 1, 1, Takes::scalars, false, "cosh(x)"},
    {"tanh", 1, 1, Takes::scalars, false, "tanh(x)"},
    {"exp", 1, 1, Takes::scalars, false, "exp(x)"},
    {"log", 1, 1, Takes::scalars, false, "log(x)"},
    {"sqrt", 1, 1, Takes::scalars, false, "sqrt(x)"},
    {"abs", 1, 1, Takes::scalars, false, "abs(x)"},
    {"min", 2, any, Takes::scalars, false, "min(x, y)"},
    {"max", 2, any, Takes::scalars, false, "max(x, y)"},
    {"sign", 1, 1, Takes::scalars, false, "sign(x)"},
    {"dot", 2, 2, Takes::vectors, false, "dot(u, v)"},
    {"norm", 1, 1, Takes::vectors, false, "norm(u)"},
    {"cross", 2, 2, Takes::vectors, true, "cross(u, v)"},
    {"pos", 1, 2, Takes::points, true, "pos(P) or pos(P, Q)"},
    {"vel", 1, 1, Takes::points, true, "vel(P)", 1},
    {"acc", 1, 1, Takes::points, true, "acc(P)", 2},
    {"omega", 1, 1, Takes::frames, true, "omega(B)", 1},
    {"alpha", 1, 1, Takes::frames, true, "alpha(B)", 2},
    {"ex", 1, 1, Takes::frames, true, "ex(B)"},
    {"ey", 1, 1, Takes::frames, true, "ey(B)"},
    {"ez", 1, 1, Takes::frames, true, "ez(B)"},
    {"diff", 2, any, Takes::derivative, false, "diff(V(r), r)"},
};

}  // namespace

const Function* find_function(std::string_view name) {
    for (const Function& function : functions)
        if (function.name == name) return &function;
    return nullptr;
}

bool is_reserved_function(std::string_view name) {
    const Function* const function = find_function(name);
    return function != nullptr && function->takes == Takes::scalars;
}

std::vector<DerivativeStep> derivative_steps(const Tree& call) {
    std::vector<DerivativeStep> steps;
    for (std::size_t k = 1; k < call.args.size(); ++k) {
        const bool counted = k + 1 < call.args.size() && call.args[k + 1]->kind == Tree::Kind::number;
        steps.push_back({call.args[k], counted ? std::stoi(call.args[k + 1]->text) : 1});
        if (counted) ++k;
    }
    return steps;
}

const std::vector<std::string>& function_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Function& function : functions) list.emplace_back(function.name);
        return list;
    }();
    return names;
}

}  // namespace alembert
