// SPDX-License-Identifier: GPL-2.0-or-later
// With s = sin x, c = cos x the ring consists of polynomials modulo s² + c² − 1. If c is reduced to its first
// power, a numerator N₀ + N₁ c is divisible by s^k if and only if N₀ and N₁ are; the same with s and c exchanged.
#include "model/formalism/cancel.hpp"

#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::symbol;

namespace {

constexpr double largest_tree = 1500;

bool is_circular(const ex& e) {
    if (!GiNaC::is_a<GiNaC::function>(e)) return false;
    const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
    return name == "sin" || name == "cos";
}

bool has_circular(const ex& e) {
    if (is_circular(e)) return true;
    for (const ex& part : e)
        if (has_circular(part)) return true;
    return false;
}

/// The divisors in `e`: powers of a sine or cosine, which may be cancelled, and sums of these, which are not.
struct Divisors {
    bool wave = false, sum = false;
};

void gather(const ex& e, Divisors& found) {
    if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::negative))
        (is_circular(e.op(0)) ? found.wave : found.sum) |= has_circular(e.op(0));
    for (const ex& part : e) gather(part, found);
}

int size(const ex& e) {
    int sum = 1;
    for (const ex& part : e) sum += size(part);
    return sum;
}

/// Sines and cosines as variables s, c, one pair for each angle; functions of whole multiples of an angle are
/// written in its pair.
class Circle {
public:
    ex in_letters(const ex& e) {
        if (is_circular(e)) {
            ex angle = e.op(0);
            int times = 1;
            if (GiNaC::is_a<GiNaC::mul>(angle) && GiNaC::is_a<GiNaC::numeric>(angle.op(angle.nops() - 1))) {
                const auto number = GiNaC::ex_to<GiNaC::numeric>(angle.op(angle.nops() - 1));
                if (number.is_integer() && abs(number) <= 6) {
                    times = number.to_int();
                    angle = angle / number;
                }
            }
            const auto& [s, c] = pair(angle);
            ex sine = 0, cosine = 1;
            for (int k = 0; k < std::abs(times); ++k) {
                const ex next = (sine * c + cosine * s).expand();
                cosine = (cosine * c - sine * s).expand();
                sine = next;
            }
            if (GiNaC::ex_to<GiNaC::function>(e).get_name() == "cos") return cosine;
            return times < 0 ? ex(-sine) : sine;
        }
        if (e.nops() == 0) return e;
        GiNaC::exvector parts;
        for (const ex& part : e) parts.push_back(in_letters(part));
        if (GiNaC::is_a<GiNaC::add>(e)) return GiNaC::add(std::move(parts));
        if (GiNaC::is_a<GiNaC::mul>(e)) return GiNaC::mul(std::move(parts));
        if (GiNaC::is_a<GiNaC::power>(e)) return pow(parts[0], parts[1]);
        return e;  // angles inside other functions are not replaced
    }

    ex in_angles(const ex& e) const { return e.subs(back_, GiNaC::subs_options::no_pattern); }

    /// Cancels the powers of one letter that numerator and denominator share; the other letter is first reduced to
    /// its first power.
    void cancel(ex& above, ex& below) const {
        for (const auto& [angle, letters] : pairs_)
            for (const auto& [s, c] : {letters, std::pair(letters.second, letters.first)}) {
                if (below.degree(s) == 0) continue;
                above = rem(above.expand(), pow(c, 2) + pow(s, 2) - 1, c).expand();
                const int common = std::min(above.ldegree(s), below.expand().ldegree(s));
                if (above.is_zero() || common <= 0) continue;
                above = (above / pow(s, common)).expand();
                below = (below / pow(s, common)).expand();
            }
    }

private:
    const std::pair<symbol, symbol>& pair(const ex& angle) {
        for (const auto& [known, letters] : pairs_)
            if (known.is_equal(angle)) return letters;
        pairs_.emplace_back(angle, std::pair(symbol("s"), symbol("c")));
        back_[pairs_.back().second.first] = sin(angle);
        back_[pairs_.back().second.second] = cos(angle);
        return pairs_.back().second;
    }

    std::vector<std::pair<ex, std::pair<symbol, symbol>>> pairs_;
    GiNaC::exmap back_;
};

}  // namespace

ex cancelled(const ex& e, const Mechanism& m) {
    if (m.z->tree_size(e) > largest_tree) return e;
    const ex plain = m.z->expand(e);
    Divisors found;
    gather(plain, found);
    if (!found.wave || found.sum) return e;
    Circle circle;
    try {
        const ex quotient = circle.in_letters(plain).numer_denom();
        ex above = quotient.op(0).expand(), below = quotient.op(1).expand();
        circle.cancel(above, below);
        const ex result = circle.in_angles(above / below);
        if (size(result) >= size(plain)) return e;
        return short_form(m.z->name(result), m);
    } catch (const std::exception&) {  // `e` is not a quotient of polynomials
        return e;
    }
}

}  // namespace alembert
