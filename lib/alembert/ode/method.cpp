// SPDX-License-Identifier: MIT
#include "alembert/ode/method.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "alembert/ode/method_table.hpp"

namespace alembert {
namespace {

constexpr std::array method_table = for_each_method([](const auto& row) { return row.traits; });

constexpr bool is_in_order() {
    for (std::size_t i = 0; i < method_table.size(); ++i)
        if (method_table[i].method != static_cast<Method>(i)) return false;
    return true;
}
static_assert(is_in_order());

}  // namespace

const MethodTraits& traits(Method method) {
    return method_table[static_cast<std::size_t>(method)];
}

std::string_view name(Method method) {
    return traits(method).name;
}

std::optional<Method> method_named(std::string_view name) {
    const auto found = std::find_if(method_table.begin(), method_table.end(),
                                    [&](const MethodTraits& one) { return one.name == name; });
    return found != method_table.end() ? std::optional(found->method) : std::nullopt;
}

bool has_fixed_step(Method method) {
    return traits(method).fixed_step;
}
bool uses_jacobian(Method method) {
    return traits(method).jacobian;
}
bool needs_separable(Method method) {
    return traits(method).separable;
}
bool needs_series(Method method) {
    return traits(method).series;
}
bool needs_canonical(Method method) {
    return traits(method).canonical;
}

std::vector<Method> all_methods() {
    std::vector<Method> list;
    for (const MethodTraits& one : method_table) list.push_back(one.method);
    return list;
}

std::string method_names() {
    std::string names;
    for (const MethodTraits& one : method_table) {
        if (&one != method_table.begin()) names += &one + 1 == method_table.end() ? " or " : ", ";
        names += one.name;
    }
    return names;
}

std::span<const std::string_view> sundials_methods() {
    static constexpr std::array<std::string_view, 2> names = {"cvode", "ida"};
    return names;
}

std::vector<std::string> method_words() {
    std::vector<std::string> words{std::string(automatic_method)};
    for (const MethodTraits& one : method_table) words.emplace_back(one.name);
    for (const std::string_view method : sundials_methods()) words.emplace_back(method);
    return words;
}

}  // namespace alembert
