// SPDX-License-Identifier: GPL-2.0-or-later
// Bounds in units of the roundoff: of a sum Σ b + |s|, of a product |p| (Σ b/|x| + count), of f(x) |f'(x)| b +
// |f(x)|.
#include "algebra/symbolic/nonzero.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>

namespace alembert {

using GiNaC::ex;
using GiNaC::is_a;

namespace {

struct Rounded {
    double value, bound;
};

class Sampling {
public:
    explicit Sampling(const Intermediates& z) : z_(z) {}

    Rounded operator()(const ex& e) {
        std::set<const Intermediates::Entry*> needed;  // in the order in which they were made
        std::vector<ex> stack{e};
        while (!stack.empty()) {
            const ex top = stack.back();
            stack.pop_back();
            if (!is_a<GiNaC::symbol>(top)) {
                for (const ex& part : top) stack.push_back(part);
            } else if (const auto* entry = z_.find(GiNaC::ex_to<GiNaC::symbol>(top));
                       entry && needed.insert(entry).second) {
                stack.insert(stack.end(), entry->uses.begin(), entry->uses.end());
            }
        }
        for (const auto* entry : needed) known_.emplace(entry->symbol.gethash(), at(entry->definition));
        return at(e);
    }

private:
    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    Rounded at(const ex& e) {
        if (is_a<GiNaC::symbol>(e)) return symbol(GiNaC::ex_to<GiNaC::symbol>(e));
        if (is_a<GiNaC::numeric>(e) || is_a<GiNaC::constant>(e)) {
            const ex number = e.evalf();
            const double value =
                number.info(GiNaC::info_flags::real) ? GiNaC::ex_to<GiNaC::numeric>(number).to_double() : nan;
            return {value, std::abs(value)};
        }
        if (is_a<GiNaC::add>(e)) {
            Rounded sum{0, 0};
            for (const ex& term : e) {
                const Rounded x = at(term);
                sum = {sum.value + x.value, sum.bound + x.bound + std::abs(x.value)};
            }
            return sum;
        }
        if (is_a<GiNaC::mul>(e)) {
            Rounded product{1, 0};
            for (const ex& factor : e) {
                const Rounded x = at(factor);
                product = {product.value * x.value, std::abs(product.value) * x.bound +
                                                        product.bound * std::abs(x.value) +
                                                        std::abs(product.value * x.value)};
            }
            return product;
        }
        if (is_a<GiNaC::power>(e) && is_a<GiNaC::numeric>(e.op(1))) {
            const Rounded x = at(e.op(0));
            const double k = GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_double(), value = std::pow(x.value, k);
            return {value, std::abs(value) * (std::abs(k) * x.bound / std::abs(x.value) + 1)};
        }
        if (GiNaC::is_the_function<GiNaC::sin_SERIAL>(e) || GiNaC::is_the_function<GiNaC::cos_SERIAL>(e)) {
            const Rounded x = at(e.op(0));
            const double s = std::sin(x.value), c = std::cos(x.value);
            return GiNaC::is_the_function<GiNaC::sin_SERIAL>(e) ? Rounded{s, std::abs(c) * x.bound + 1}
                                                                : Rounded{c, std::abs(s) * x.bound + 1};
        }
        return {nan, nan};
    }

    Rounded symbol(const GiNaC::symbol& s) const {
        if (const auto found = known_.find(s.gethash()); found != known_.end()) return found->second;
        // Multiples of the golden ratio, modulo 1: no two are equal, and none is near 0.
        const double turn = 0.6180339887498949 * (z_.symbols().info(s).rank + 1),
                     value = 0.4 + turn - std::floor(turn);
        return {value, value};
    }

    const Intermediates& z_;
    std::unordered_map<unsigned, Rounded> known_;
};

}  // namespace

bool shows_nonzero(const ex& e, const Intermediates& z) {
    const Rounded x = Sampling(z)(e);
    return std::isfinite(x.bound) && std::abs(x.value) > 1e5 * std::numeric_limits<double>::epsilon() * x.bound;
}

}  // namespace alembert
