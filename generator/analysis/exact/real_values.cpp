// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/real_values.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "program/echelon.hpp"
#include "program/table_value.hpp"

namespace alembert {

using GiNaC::numeric;

namespace {

using Key = RealState::Key;

struct Turned {
    numeric cos = 1, sin = 0;
};
Turned operator*(const Turned& a, const Turned& b) {
    return {a.cos * b.cos - a.sin * b.sin, a.cos * b.sin + a.sin * b.cos};
}

/// An expression of the form Σ c·variable + c·π.
struct Linear {
    std::map<Key, Rational> angles;
    Rational pi = 0;
};

/// A fraction or a float of fifty digits; coefficients of tables are doubles, which are fractions.
struct ExactNumber {
    numeric n = 0;
    ExactNumber() = default;
    explicit ExactNumber(const numeric& value) : n(value) {}
    explicit ExactNumber(double value) : n(cln::cl_N(cln::rational(cln::cl_DF(value)))) {}
    friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) { return ExactNumber(a.n + b.n); }
    friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) { return ExactNumber(a.n - b.n); }
    friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) { return ExactNumber(a.n * b.n); }
    friend ExactNumber operator/(const ExactNumber& a, const ExactNumber& b) { return ExactNumber(a.n / b.n); }
    ExactNumber& operator+=(const ExactNumber& b) { return *this = *this + b; }
    ExactNumber& operator*=(const ExactNumber& b) { return *this = *this * b; }
    friend double place_of(const ExactNumber& x) { return x.n.to_double(); }
};

class Evaluation {
public:
    Evaluation(const Program& program, const RealState& state) : p_(program), s_(state) {}

    std::optional<std::vector<numeric>> run(const std::vector<int>& roots) {
        value_.resize(p_.size());
        for (const int id : p_.needed(roots)) {
            const std::optional<numeric> value = of(id);
            if (!value || !value->is_real()) return std::nullopt;
            value_[id] = *value;
        }
        std::vector<numeric> result;
        for (const int id : roots) result.push_back(value_[id]);
        return result;
    }

private:
    static numeric number(const Rational& r) { return numeric(cln::cl_N(r)); }

    std::optional<numeric> of(int id) try {
        const Node& node = p_[id];
        const auto arg = [&](std::size_t k) -> const numeric& { return value_[node.args[k]]; };
        switch (node.op) {
            case Op::number:
                return number(node.number);
            case Op::pi:
                return GiNaC::ex_to<numeric>(GiNaC::Pi.evalf());
            case Op::variable:
                return s_.value.at({node.variable.kind, node.variable.index});
            case Op::sum: {
                numeric sum = number(node.number);
                for (std::size_t k = 0; k < node.args.size(); ++k) sum += number(node.coefficients[k]) * arg(k);
                return sum;
            }
            case Op::product: {
                numeric product = 1;
                for (std::size_t k = 0; k < node.args.size(); ++k) {
                    if (node.exponents[k] < 0 && arg(k).is_zero()) return std::nullopt;
                    product *= GiNaC::pow(arg(k), numeric(node.exponents[k]));
                }
                return product;
            }
            case Op::sin:
            case Op::cos:
            case Op::tan: {
                if (const auto turn = turned(node.args[0])) {
                    if (node.op == Op::tan && turn->cos.is_zero()) return std::nullopt;
                    return node.op == Op::sin ? turn->sin : node.op == Op::cos ? turn->cos : turn->sin / turn->cos;
                }
                const numeric x = real(arg(0));
                return node.op == Op::sin ? GiNaC::sin(x) : node.op == Op::cos ? GiNaC::cos(x) : GiNaC::tan(x);
            }
            case Op::sqrt:
                return GiNaC::sqrt(arg(0));  // exact for squares of fractions
            case Op::abs:
                return GiNaC::abs(arg(0));
            case Op::sign:
                return numeric(arg(0).csgn());
            case Op::asin:
                return GiNaC::asin(real(arg(0)));
            case Op::acos:
                return GiNaC::acos(real(arg(0)));
            case Op::atan:
                return GiNaC::atan(real(arg(0)));
            case Op::sinh:
                return GiNaC::sinh(real(arg(0)));
            case Op::cosh:
                return GiNaC::cosh(real(arg(0)));
            case Op::tanh:
                return GiNaC::tanh(real(arg(0)));
            case Op::exp:
                return arg(0).is_zero() ? numeric(1) : GiNaC::exp(real(arg(0)));
            case Op::log:
                return arg(0).is_positive() ? std::optional(GiNaC::log(real(arg(0)))) : std::nullopt;
            case Op::pow:
                return GiNaC::pow(real(arg(0)), real(arg(1)));
            case Op::atan2:
                return GiNaC::atan(real(arg(0)), real(arg(1)));
            case Op::min:
                return std::min(arg(0), arg(1));
            case Op::max:
                return std::max(arg(0), arg(1));
            case Op::unspecified: {
                std::vector<numeric> args;
                for (const int a : node.args) args.push_back(value_[a]);
                return p_.table_of(node) != nullptr ? of_table(node) : unspecified_sample(args);
            }
        }
        return std::nullopt;
    } catch (const std::exception&) {  // a pole
        return std::nullopt;
    }

    /// By the polynomials of the table, in the numbers of the arguments; nothing where it has no value.
    std::optional<numeric> of_table(const Node& node) {
        const TabulatedFunction& table = *p_.table_of(node);
        const Program::TableCall call = p_.table_call(node);
        for (std::size_t k = 0; k < call.arguments; ++k)
            if (!table.has(k, value_[call.argument[k]].to_double())) return std::nullopt;
        std::map<int, ExactNumber> at;
        for (std::size_t k = 0; k < call.arguments; ++k)
            for (const int id : {call.argument[k], call.number[k]}) at[id] = ExactNumber(value_[id]);
        return table_value<ExactNumber>(table, call, [&](int id) -> const ExactNumber& { return at.at(id); }).n;
    }

    /// A small fraction that depends on the arguments alone, of which those that are floats are rounded.
    static numeric unspecified_sample(const std::vector<numeric>& args) {
        std::uint64_t h = 0;
        for (const numeric& x : args) {
            std::ostringstream digits;
            if (x.is_rational())
                digits << x;
            else
                digits << cln::round1(cln::realpart((x * GiNaC::pow(numeric(10), numeric(30))).to_cl_N()));
            for (const char c : digits.str() + ';') h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
        }
        h ^= h >> 29;
        const auto above = static_cast<int>(1 + h % 7), below = static_cast<int>(1 + h / 7 % 4);
        return numeric(h / 28 % 2 == 0 ? above : -above) / numeric(below);
    }

    static numeric real(const numeric& x) { return GiNaC::ex_to<numeric>(GiNaC::ex(x).evalf()); }

    std::optional<Linear> linear(int id) const {
        const Node& node = p_[id];
        Linear result;
        if (node.op == Op::pi) {
            result.pi = 1;
            return result;
        }
        if (node.op == Op::variable) {
            const Key key{node.variable.kind, node.variable.index};
            if (!s_.angle.contains(key)) return std::nullopt;
            result.angles[key] = 1;
            return result;
        }
        if (node.op != Op::sum || !cln::zerop(node.number)) return std::nullopt;
        for (std::size_t k = 0; k < node.args.size(); ++k) {
            const auto part = linear(node.args[k]);
            if (!part) return std::nullopt;
            result.pi = result.pi + node.coefficients[k] * part->pi;
            for (const auto& [key, c] : part->angles) {
                Rational& to = result.angles.emplace(key, 0).first->second;
                to = to + node.coefficients[k] * c;
            }
        }
        return result;
    }

    std::optional<Turned> turned(int id) const {
        const auto sum = linear(id);
        if (!sum) return std::nullopt;
        Turned result;
        const auto turn = [&](Turned by, const Rational& times) {
            if (cln::denominator(times) != 1 || cln::abs(times) > 1000) return false;
            int count = cln::cl_I_to_int(cln::numerator(times));
            if (count < 0) by.sin = -by.sin;
            for (count = std::abs(count); count > 0; --count) result = result * by;
            return true;
        };
        if (!turn({0, 1}, 2 * sum->pi)) return std::nullopt;
        for (const auto& [key, c] : sum->angles) {
            const RealState::Angle& angle = s_.angle.at(key);
            if (angle.half_turn) {
                if (!turn({0, 1}, 2 * c)) return std::nullopt;
                continue;
            }
            const numeric below = 1 + angle.tangent * angle.tangent;
            if (!turn({(1 - angle.tangent * angle.tangent) / below, 2 * angle.tangent / below}, c))
                return std::nullopt;
        }
        return result;
    }

    const Program& p_;
    const RealState& s_;
    std::vector<numeric> value_;
};

}  // namespace

void put_angle(RealState& state, const RealState::Key& key, const RealState::Angle& angle) {
    state.angle[key] = angle;
    state.value[key] = angle.half_turn ? GiNaC::ex_to<numeric>(GiNaC::Pi.evalf())
                                       : 2 * GiNaC::atan(GiNaC::ex_to<numeric>(GiNaC::ex(angle.tangent).evalf()));
}

std::optional<std::vector<numeric>> evaluate(const Program& program, const RealState& state,
                                             const std::vector<int>& roots) {
    const FiftyDigits digits;
    return Evaluation(program, state).run(roots);
}

namespace {

/// Fractions, or floats of fifty digits: entries that may be zero are no pivots.
struct NumericField {
    using Number = numeric;
    static constexpr bool makes_ones = false;
    static std::optional<std::size_t> pivot(const RowsOf<numeric>& rows, std::size_t first, std::size_t column) {
        const std::size_t best = largest_in(rows, first, column, [](const numeric& x) { return GiNaC::abs(x); });
        if (GiNaC::abs(rows[best][column]) < GiNaC::pow(numeric(10), numeric(-30))) return std::nullopt;
        return best;
    }
    static bool is_zero(const numeric& x) { return x.is_zero(); }
    static numeric quotient(const numeric& a, const numeric& b) { return a / b; }
    static void subtract(numeric& from, const numeric& factor, const numeric& of) { from -= factor * of; }
};

}  // namespace

std::optional<std::vector<numeric>> solve_rows(std::vector<std::vector<numeric>> rows, std::size_t columns) {
    const auto pivots = echelon(rows, columns, NumericField());
    if (!pivots || pivots->size() < columns) return std::nullopt;
    for (std::size_t r = columns; r < rows.size(); ++r)
        if (!is_almost_zero(rows[r][columns])) return std::nullopt;
    std::vector<numeric> result;
    for (std::size_t c = 0; c < columns; ++c) result.push_back(rows[c][columns] / rows[c][c]);
    return result;
}

std::string text_of(const numeric& value) {
    std::ostringstream stream;
    if (value.is_rational()) {
        stream << value;
        return stream.str();
    }
    return fmt::format("{:.17g}", value.to_double());  // as many digits as determine a double
}

std::string text_of(const RealState& state, const Key& key) {
    const auto angle = state.angle.find(key);
    if (angle == state.angle.end()) return text_of(state.value.at(key));
    if (angle->second.half_turn) return "pi";
    if (angle->second.tangent.is_zero()) return "0";
    return fmt::format("2*atan({})", text_of(angle->second.tangent));
}

}  // namespace alembert
