// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/on_sides.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "algebra/symbolic/functions.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// On whose sign the value of this function depends.
std::optional<ex> side_of(const ex& call) {
    if (!GiNaC::is_a<GiNaC::function>(call)) return std::nullopt;
    const std::string name = GiNaC::ex_to<GiNaC::function>(call).get_name();
    if (name == "absolute" || name == "signum") return call.op(0);
    if (name == "minimum" || name == "maximum") return call.op(0) - call.op(1);
    return std::nullopt;
}

/// 1, -1, or 0 if none of these tells.
int sign_of(const ex& e, const std::vector<ex>& positive) {
    for (const ex& p : positive) {
        if ((e - p).expand().is_zero()) return 1;
        if ((e + p).expand().is_zero()) return -1;
    }
    return 0;
}

void gather_sides(const ex& e, std::vector<ex>& sides) {
    for (const ex& part : e) gather_sides(part, sides);
    if (const auto side = side_of(e); side && sign_of(*side, sides) == 0) sides.push_back(*side);
}

struct WherePositive : GiNaC::map_function {
    explicit WherePositive(const std::vector<ex>& list) : positive(list) {}

    ex operator()(const ex& e) override {
        const ex inner = e.map(*this);
        const auto side = side_of(inner);
        const int sign = side ? sign_of(*side, positive) : 0;
        if (sign == 0) return inner;
        const std::string name = function_name(inner);
        if (name == "sign") return sign;
        if (name == "abs") return sign * inner.op(0);
        return inner.op((name == "max") == (sign > 0) ? 0 : 1);
    }

    const std::vector<ex>& positive;
};

}  // namespace

std::vector<ex> sides_of(const ex& e) {
    std::vector<ex> sides;
    gather_sides(e, sides);
    return sides;
}

ex where_positive(const ex& e, const std::vector<ex>& positive) {
    return WherePositive(positive)(e);
}

}  // namespace alembert
