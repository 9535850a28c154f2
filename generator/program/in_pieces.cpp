// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/in_pieces.hpp"

#include "program/known_knots.hpp"
#include "program/rewriting.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_points = 501;

class Pieces {
public:
    explicit Pieces(const Program& old) : old_(old), rewriting_(old) {}

    Program finish() {
        return rewriting_.finish([this](int id) { return fits(id) ? sum_of(id) : rewriting_.plain(id); });
    }

private:
    bool fits(int id) const {
        const Node& node = old_[id];
        if (node.op != Op::unspecified || old_.table_of(node) == nullptr) return false;
        const TabulatedFunction& table = *old_.table_of(node);
        return table.arguments() == 1 && table.axes()[0].period == 0 && table.axes()[0].at.size() <= most_points &&
               table.outside() != TabulatedFunction::Outside::error && !old_.table_call(node).is_held &&
               old_.table_call(node).orders[0] < TabulatedFunction::side_function;
    }

    int sum_of(int id) {
        const Program::TableCall call = old_.table_call(old_[id]);
        const TabulatedFunction& table = *old_.table_of(old_[id]);
        const std::vector<double>& at = table.axes()[0].at;
        const int s = rewriting_.image(call.argument[0]), order = call.orders[0];
        const auto columns = static_cast<std::size_t>(table.degree()) + 1;
        std::vector<int> signs;
        for (const double x : at) signs.push_back(made().call(Op::sign, {from(s, x)}));
        std::vector<Program::Term> terms;
        const auto add = [&](int polynomial, int chosen) {
            terms.emplace_back(Rational(1) / 2, made().product(1, {{polynomial, 1}, {chosen, 1}}));
        };
        const double *const c = table.coefficients().data(), *const last = c + columns * (at.size() - 2);
        add(beyond(table, c, s, at.front(), 0, order), made().sum(1, {{-1, signs.front()}}));
        for (std::size_t k = 0; k + 1 < at.size(); ++k)
            add(polynomial(c + columns * k, columns, from(s, at[k]), order),
                made().sum(0, {{1, signs[k]}, {-1, signs[k + 1]}}));
        add(beyond(table, last, s, at.back(), at.back() - at[at.size() - 2], order),
            made().sum(1, {{1, signs.back()}}));
        return made().sum(0, terms);
    }

    int from(int s, double x) { return made().sum(-exact(x), {{1, s}}); }

    /// Σ j!/(j − order)! c_j u^(j − order)
    int polynomial(const double* c, std::size_t columns, int u, int order) {
        int value = made().number(0);
        for (std::size_t j = columns; j-- > static_cast<std::size_t>(order);) {
            Rational factor = exact(c[j]);
            for (int k = 0; k < order; ++k) factor = factor * (static_cast<int>(j) - k);
            value = made().sum(factor, {{1, made().product(1, {{u, 1}, {value, 1}})}});
        }
        return value;
    }

    /// The last value, or the tangent, of the polynomial of this piece at u.
    int beyond(const TabulatedFunction& table, const double* c, int s, double end, double u, int order) {
        const auto columns = static_cast<std::size_t>(table.degree()) + 1;
        const int there = made().number(exact(u));
        const int value = polynomial(c, columns, there, 0), slope = polynomial(c, columns, there, 1);
        const bool holds = table.outside() == TabulatedFunction::Outside::hold;
        if (order > 1 || (order == 1 && holds)) return made().number(0);
        if (order == 1) return slope;
        if (holds) return value;
        return made().sum(0, {{1, value}, {1, made().product(1, {{slope, 1}, {from(s, end), 1}})}});
    }

    Program& made() { return rewriting_.made(); }

    const Program& old_;
    Rewriting rewriting_;
};

}  // namespace

Program in_pieces(const Program& program) {
    return Pieces(program).finish();
}

}  // namespace alembert
