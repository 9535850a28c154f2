// SPDX-License-Identifier: MIT
#include "oracle.hpp"

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "analysis/state/assemble.hpp"
#include "model/energy.hpp"
#include "program/lower/lower.hpp"

namespace alembert::test {

namespace {

struct Unknown : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// value, rate, second derivative with respect to time; the last are missing where accelerations would have to be
/// differentiated. `size`: the same with every term taken positive, to which a difference of zero is compared.
struct Series {
    std::array<Digits, 3> at;
    int known = 2;
    std::array<Digits, 3> size;

    Series(std::array<Digits, 3> values, int order)
        : at(values), known(order), size{abs(values[0]), abs(values[1]), abs(values[2])} {}
    Series(std::array<Digits, 3> values, int order, std::array<Digits, 3> sizes)
        : at(values), known(order), size(sizes) {}
    Series derivative() const {
        if (known == 0) throw Unknown("a third derivative");
        return {{at[1], at[2], 0}, known - 1, {size[1], size[2], 0}};
    }
};

using Triple = std::array<Digits, 3>;
Series constant(const Digits& x) {
    return {{x, 0, 0}, 2};
}
Triple plus(const Triple& a, const Triple& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Triple times(const Triple& a, const Triple& b) {
    return {a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2 * a[1] * b[1] + a[0] * b[2]};
}
Series operator+(const Series& a, const Series& b) {
    return {plus(a.at, b.at), std::min(a.known, b.known), plus(a.size, b.size)};
}
Series operator*(const Series& a, const Series& b) {
    return {times(a.at, b.at), std::min(a.known, b.known), times(a.size, b.size)};
}
/// f(a) from f, f′, f″ at a.
Series chain(const Series& a, const Digits& f, const Digits& f1, const Digits& f2) {
    const auto by = [&](const Triple& x, const Digits& d1, const Digits& d2) {
        return Triple{f, d1 * x[1], d1 * x[2] + d2 * x[1] * x[1]};
    };
    Series result(by(a.at, f1, f2), a.known, by(a.size, abs(f1), abs(f2)));
    result.size[0] = abs(f);
    return result;
}
Series power(const Series& a, int n) {
    Series result = constant(1),
           base = n < 0 ? chain(a, 1 / a.at[0], -1 / (a.at[0] * a.at[0]), 2 / (a.at[0] * a.at[0] * a.at[0])) : a;
    for (int k = 0; k < std::abs(n); ++k) result = result * base;
    return result;
}

class Reading {
public:
    Reading(const Scene& scene, const Mechanism& m, const State<Digits>& s) : scene_(scene) {
        known_.emplace("t", Series({s.t, 1, 0}, 2));
        known_.emplace("pi", constant(acos(Digits(-1))));
        std::size_t independent = 0;
        for (const Mechanism::Parameter& p : m.parameters)
            if (p.independent) known_.emplace(p.symbol.get_name(), constant(s.parameters[independent++]));
        for (std::size_t i = 0; i < m.q.size(); ++i)
            known_.emplace(m.q[i].get_name(), Series({s.q[i], s.qdot[i], s.qddot[i]}, 2));
        std::size_t next = 0;
        for (const auto* list : {&m.constraints, &m.redundant})
            for (const Mechanism::Constraint& c : *list)
                known_.emplace(c.multiplier.get_name(), Series({s.unknown[next++], 0, 0}, 0));
        for (std::size_t k = 0; k < m.speeds.size(); ++k)
            known_.emplace(m.speeds[k].u.get_name(),
                           Series({s.unknown[next + 2 * k], s.unknown[next + 2 * k + 1], 0}, 1));
    }

    Series of(const Tree& tree) {
        using Kind = Tree::Kind;
        const auto arg = [&](std::size_t k) { return of(*tree.args[k]); };
        switch (tree.kind) {
            case Kind::number:
                return constant(Digits(cln::cl_R(cln::the<cln::cl_RA>(exact_number(tree.text).to_cl_N()))));
            case Kind::name:
                return differentiated(named(tree.text), tree.primes);
            case Kind::derivative:
                return differentiated(arg(0), tree.primes);
            case Kind::negate:
                return constant(-1) * arg(0);
            case Kind::reciprocal:
                return power(arg(0), -1);
            case Kind::sum: {
                Series sum = arg(0);
                for (std::size_t k = 1; k < tree.args.size(); ++k) sum = sum + arg(k);
                return sum;
            }
            case Kind::product: {
                Series product = arg(0);
                for (std::size_t k = 1; k < tree.args.size(); ++k) product = product * arg(k);
                return product;
            }
            case Kind::power:
                return raised(arg(0), *tree.args[1]);
            case Kind::call:
                return called(tree);
        }
        throw Unknown("a node");
    }

private:
    static Series differentiated(Series s, int times) {
        for (; times > 0; --times) s = s.derivative();
        return s;
    }

    Series named(const std::string& name) {
        if (const auto found = known_.find(name); found != known_.end()) return found->second;
        const auto from = [&](const auto& list) -> std::optional<Series> {
            for (const auto& item : list)
                if (item.name.text == name) return of(*item.value.tree);
            return std::nullopt;
        };
        std::optional<Series> value = from(scene_.parameters);
        if (!value) value = from(scene_.inputs);
        if (!value) value = from(scene_.definitions);
        if (!value) throw Unknown(name);
        return known_.emplace(name, *value).first->second;
    }

    Series raised(const Series& base, const Tree& exponent) {
        const Digits e = of(exponent).at[0];
        for (int n = -64; n <= 64; ++n)
            if ((e - n).is_zero()) return power(base, n);
        const Digits& x = base.at[0];
        const Digits y = pow(x, e);
        return chain(base, y, e * y / x, e * (e - 1) * y / (x * x));
    }

    /// The angle φ of (x, y) up to a positive factor, by φ' = (x y' − y x')/(x² + y²).
    Series angle(const std::string& f, const Tree& tree) {
        const Series a = of(*tree.args[0]), one = constant(1);
        const auto leg = [&] {
            const Series square = one + constant(-1) * a * a;
            const Digits y = sqrt(square.at[0]);
            return chain(square, y, 1 / (2 * y), -1 / (4 * y * square.at[0]));
        };
        const Series y = f == "acos" ? leg() : a, x = f == "atan2"  ? of(*tree.args[1])
                                                      : f == "atan" ? one
                                                      : f == "asin" ? leg()
                                                                    : a;
        Series result({atan2(y.at[0], x.at[0]), 0, 0}, std::min(x.known, y.known));
        if (result.known == 0) return result;
        const Series rate = (x * y.derivative() + constant(-1) * y * x.derivative()) * power(x * x + y * y, -1);
        for (std::size_t k = 0; k < 2; ++k) result.at[k + 1] = rate.at[k], result.size[k + 1] = rate.size[k];
        return result;
    }

    Series called(const Tree& tree) {
        const std::string& f = tree.text;
        const auto arg = [&](std::size_t k) { return of(*tree.args[k]); };
        if (f == "sin" || f == "cos" || f == "tan") {
            const Series a = arg(0);
            const Digits s = sin(a.at[0]), c = cos(a.at[0]);
            if (f == "sin") return chain(a, s, c, -s);
            if (f == "cos") return chain(a, c, -s, -c);
            return chain(a, s / c, 1 / (c * c), 2 * s / (c * c * c));
        }
        if (f == "sqrt") {
            const Series a = arg(0);
            const Digits y = sqrt(a.at[0]);
            return chain(a, y, 1 / (2 * y), -1 / (4 * y * a.at[0]));
        }
        if (f == "exp") {
            const Series a = arg(0);
            const Digits y = exp(a.at[0]);
            return chain(a, y, y, y);
        }
        if (f == "log") {
            const Series a = arg(0);
            return chain(a, log(a.at[0]), 1 / a.at[0], -1 / (a.at[0] * a.at[0]));
        }
        if (f == "abs") {
            const Series a = arg(0);
            return a.at[0] < 0 ? constant(-1) * a : a;
        }
        if (f == "sign") return constant(arg(0).at[0] < 0 ? -1 : 1);
        if (f == "min" || f == "max") {
            Series result = arg(0);
            for (std::size_t k = 1; k < tree.args.size(); ++k)
                if (const Series next = arg(k); (next.at[0] < result.at[0]) == (f == "min")) result = next;
            return result;
        }
        if (f == "atan2" || f == "atan" || f == "asin" || f == "acos") return angle(f, tree);
        if (f == "tanh") {
            const Series a = arg(0);
            const Digits y = tanh(a.at[0]), slope = 1 - y * y;
            return chain(a, y, slope, -2 * y * slope);
        }
        if (f == "sinh" || f == "cosh") {
            const Series a = arg(0);
            const Digits s = sinh(a.at[0]), c = cosh(a.at[0]);
            return f == "sinh" ? chain(a, s, c, s) : chain(a, c, s, c);
        }
        throw Unknown(f);
    }

    const Scene& scene_;
    std::map<std::string, Series> known_;
};

/// x of A x = b; nothing where A is singular.
std::optional<std::vector<Digits>> solved(std::vector<std::vector<Digits>> A, std::vector<Digits> b) {
    const std::size_t n = b.size();
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t r = c + 1; r < n; ++r)
            if (abs(A[r][c]) > abs(A[pivot][c])) pivot = r;
        if (A[pivot][c].magnitude() < -30) return std::nullopt;
        std::swap(A[c], A[pivot]);
        std::swap(b[c], b[pivot]);
        for (std::size_t r = 0; r < n; ++r) {
            if (r == c) continue;
            const Digits factor = A[r][c] / A[c][c];
            for (std::size_t k = c; k < n; ++k) A[r][k] -= factor * A[c][k];
            b[r] -= factor * b[c];
        }
    }
    for (std::size_t c = 0; c < n; ++c) b[c] = b[c] / A[c][c];
    return b;
}

/// x less Aᵀ (A Aᵀ)⁻¹ misfit.
bool project(std::vector<Digits>& x, const std::vector<std::vector<Digits>>& A,
             const std::vector<Digits>& misfit) {
    std::vector<std::vector<Digits>> square(A.size(), std::vector<Digits>(A.size()));
    for (std::size_t a = 0; a < A.size(); ++a)
        for (std::size_t b = 0; b < A.size(); ++b)
            for (std::size_t i = 0; i < x.size(); ++i) square[a][b] += A[a][i] * A[b][i];
    const auto weights = solved(std::move(square), misfit);
    if (!weights) return false;
    for (std::size_t a = 0; a < A.size(); ++a)
        for (std::size_t i = 0; i < x.size(); ++i) x[i] -= (*weights)[a] * A[a][i];
    return true;
}

bool obey(State<Digits>& state, const Program& p, const Mechanism& m) {
    const auto rows = p.nodes_of(Group::row), position = p.nodes_of(Group::position),
               velocity = p.nodes_of(Group::velocity);
    const std::size_t n = m.q.size();
    const auto gather = [&](const std::vector<int>& nodes, bool positions, std::vector<std::vector<Digits>>& A,
                            std::vector<Digits>& off) {
        const std::vector<Digits> value = interpret<Digits>(p, state);
        A.clear(), off.clear();
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            if (positions && !m.constraints[k].position) continue;
            off.push_back(value[nodes[k]]);
            A.emplace_back();
            for (std::size_t i = 0; i < n; ++i) A.back().push_back(value[rows[k * n + i]]);
        }
    };
    std::vector<std::vector<Digits>> A;
    std::vector<Digits> off;
    for (int round = 0; round < 40; ++round) {
        gather(position, true, A, off);
        if (off.empty() ||
            std::all_of(off.begin(), off.end(), [](const Digits& x) { return x.magnitude() < -55; }))
            break;
        if (round == 39 || !project(state.q, A, off)) return false;
    }
    gather(velocity, false, A, off);
    return off.empty() || project(state.qdot, A, off);
}

/// Each speed and its derivative, in q, q', q'', t and inputs.
std::vector<GiNaC::ex> forms_and_rates(const Mechanism& m) {
    std::vector<GiNaC::ex> list;
    for (const Mechanism::Speed& speed : m.speeds) {
        const GiNaC::ex form = m.z->expand(speed.form);
        GiNaC::ex rate = form.diff(m.t);
        for (std::size_t i = 0; i < m.q.size(); ++i)
            rate += form.diff(m.q[i]) * m.qdot[i] + form.diff(m.qdot[i]) * m.qddot[i];
        for (const Mechanism::Input& input : m.inputs)
            for (std::size_t k = 0; k < 2; ++k) rate += form.diff(input.derivative[k]) * input.derivative[k + 1];
        list.insert(list.end(), {form, rate});
    }
    return list;
}

}  // namespace

Oracle::Oracle(const Scene& scene, const Mechanism& m, const Equations& e, unsigned seed, int states)
    : scene_(scene), m_(m) {
    Mechanism plain = m;  // the motion is found in coordinates, and speeds are what their forms say
    plain.speeds.clear();
    const Program p = lower(plain, e, energy_of(plain));
    Program forms;
    const std::vector<int> form_nodes = lower_expressions(forms, m, forms_and_rates(m));
    Start start = start_of(m);
    assemble(start, m, lower_constraints(m), {});
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
        return Digits(low + (high - low) * static_cast<double>(random()) / 4294967296.0);
    };
    for (int tries = 0; tries < 60 && this->states() < states; ++tries) try {
            State<Digits> s;
            for (const double x : start.parameters)
                s.parameters.push_back(x == 0 ? uniform(0.1, 1) : Digits(x) * uniform(0.9, 1.15));
            s.t = uniform(0.1, 5);
            for (const double x : start.q) s.q.push_back(Digits(x) + uniform(-0.4, 0.6));
            for (const double x : start.qdot) s.qdot.push_back(Digits(x) / 2 + uniform(-1.5, 2));
            s.qddot.resize(s.q.size());
            const std::size_t multipliers = m.constraints.size() + m.redundant.size();
            s.unknown.resize(multipliers + form_nodes.size());
            if (!obey(s, p, m)) continue;
            const std::vector<Digits> value = interpret<Digits>(p, s);
            const auto take = [&](Group group, std::vector<Digits>& to) {
                const std::vector<int> nodes = p.nodes_of(group);
                for (std::size_t k = 0; k < nodes.size(); ++k) to[k] = value[nodes[k]];
            };
            take(Group::acceleration, s.qddot);
            take(Group::multiplier, s.unknown);
            const std::vector<Digits> speeds = interpret<Digits>(forms, s);
            for (std::size_t k = 0; k < form_nodes.size(); ++k) s.unknown[multipliers + k] = speeds[form_nodes[k]];
            states_.push_back(std::move(s));
        } catch (const std::exception&) {  // a pole, a root of a negative number
        }
}

std::optional<double> Oracle::misfit(const Equality& claim) const {
    std::optional<double> worst;
    for (const State<Digits>& state : states_) try {
            Reading reading(scene_, m_, state);
            const Series lhs = reading.of(*claim.lhs.tree), rhs = reading.of(*claim.rhs.tree);
            const Digits off = lhs.at[0] - rhs.at[0];
            // An acceleration that is zero has no size but that of its rounding.
            const double size = std::max(-8.0, (lhs.size[0] + rhs.size[0]).magnitude());
            worst = std::max(worst.value_or(-1000), off.is_zero() ? -1000 : off.magnitude() - size);
            if (*worst > -30) return worst;
        } catch (const std::exception&) {
        }
    return worst;
}

std::optional<bool> Oracle::holds(const Equality& claim) const {
    const auto off = misfit(claim);
    if (!off || (*off > -40 && *off < -30)) return std::nullopt;
    return *off <= -40;
}

}  // namespace alembert::test
