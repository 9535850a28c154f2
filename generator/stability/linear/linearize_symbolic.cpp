// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/linearize_symbolic.hpp"

#include <algorithm>
#include <stdexcept>

#include "algebra/notation/readable.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "model/formalism/with_states.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_coordinates = 4;
constexpr std::size_t most_terms = 12;
constexpr double largest_tree = 2000;

/// Does `e` contain a derivative that GiNaC does not know: of abs, sign, min or max?
bool has_unknown_derivative(const ex& e) {
    if (GiNaC::is_a<GiNaC::fderivative>(e)) return true;
    for (const ex& part : e)
        if (has_unknown_derivative(part)) return true;
    return false;
}

/// The values of q, q' and of the states.
GiNaC::exmap state_at(const Mechanism& m, const std::vector<ex>& q0, const std::vector<ex>& u0,
                      const std::vector<ex>& z0) {
    GiNaC::exmap there;
    for (int i = 0; i < m.size(); ++i) {
        there[m.q[i]] = m.z->expand(q0[i]);
        there[m.qdot[i]] = m.z->expand(u0[i]);
    }
    for (std::size_t k = 0; k < z0.size(); ++k) there[m.states[k].derivative[0]] = m.z->expand(z0[k]);
    return there;
}

/// Adds the values of inputs that do not change with time, and of those from outside, which keep theirs.
void know_inputs(GiNaC::exmap& there, const Mechanism& m) {
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.from_outside) there[p.symbol] = p.value;
    for (std::size_t round = 0; round < m.inputs.size(); ++round)  // they may stand in each other, in any order
        for (const Mechanism::Input& input : m.inputs) {
            const ex value = m.z->expand(input.value).subs(there);
            if (m.z->depends(value, m.clock())) continue;
            there[input.derivative[0]] = value;
            there[input.derivative[1]] = there[input.derivative[2]] = 0;
        }
}

/// Nothing if it is long, or has no derivative that GiNaC knows.
std::optional<ex> readable_at(const ex& derivative, const GiNaC::exmap& there, const Mechanism& m) {
    const ex value = derivative.subs(there);
    if (has_unknown_derivative(value)) return {};
    const auto f = fourier(value, *m.symbols, 400);
    if (!f || f->size() > most_terms) return {};
    return expression(readable(*f));
}

bool is_zero_at(const ex& e, const GiNaC::exmap& there, const Mechanism& m) {
    const auto value = fourier(e.subs(there), *m.symbols, 400);
    return value && is_zero(*value);
}

std::optional<SymbolicMatrices> matrices(const Mechanism& m, const Equations& e, const GiNaC::exmap& there) {
    const int n = m.size();
    if (!m.constraints.empty() || !e.speeds_are_rates() || n > most_coordinates) return {};
    const auto readable_there = [&](const ex& derivative) { return readable_at(derivative, there, m); };
    const unsigned size = static_cast<unsigned>(n);
    SymbolicMatrices result{
        .M = {size, size}, .C = {size, size}, .G = {size, size}, .K = {size, size}, .N = {size, size}};
    std::vector<ex> f;
    for (int i = 0; i < n; ++i) {
        if (m.z->tree_size(e.forcing(i)) > largest_tree) return {};
        f.push_back(m.z->expand(without_state_rates(e.forcing(i), m)));
    }
    const ex half = GiNaC::numeric(1, 2);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            if (m.z->tree_size(e.M(i, j)) > largest_tree) return {};
            const auto part = [&](const std::vector<GiNaC::symbol>& by, int sign) {
                return half * (-f[i].diff(by[j]) - sign * f[j].diff(by[i]));
            };
            for (const auto& [matrix, value] :
                 {std::pair(&result.M, m.z->expand(e.M(i, j))), std::pair(&result.C, ex(part(m.qdot, 1))),
                  std::pair(&result.G, ex(part(m.qdot, -1))), std::pair(&result.K, ex(part(m.q, 1))),
                  std::pair(&result.N, ex(part(m.q, -1)))}) {
                const std::optional<ex> element = readable_there(value);
                if (!element) return {};
                (*matrix)(i, j) = *element;
            }
        }
    result.stays = std::all_of(f.begin(), f.end(), [&](const ex& force) { return is_zero_at(force, there, m); });
    return result;
}

/// Rows s δz − ∂r/∂q' s δq − ∂r/∂q δq − ∂r/∂z δz = 0 of z' = r, and a column −∂f/∂z for each state.
std::optional<SymbolicPencil> with_rows_of_states(const Mechanism& m, const Equations& e,
                                                  const SymbolicPencil& found, const GiNaC::exmap& there) {
    const auto n = static_cast<unsigned>(m.size()), all = n + static_cast<unsigned>(m.states.size());
    SymbolicPencil result{.S2 = {all, all}, .S1 = {all, all}, .S0 = {all, all}, .stays = found.stays};
    for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) {
            result.S2(i, j) = found.S2(i, j);
            result.S1(i, j) = found.S1(i, j);
            result.S0(i, j) = found.S0(i, j);
        }
    bool is_short = true;
    const auto put = [&](ex& to, const ex& derivative) {
        const auto value = readable_at(-derivative, there, m);
        is_short = is_short && value;
        if (value) to = *value;
    };
    for (unsigned k = n; k < all; ++k) {
        const GiNaC::symbol& z = m.states[k - n].derivative[0];
        for (unsigned i = 0; i < n; ++i)
            put(result.S0(i, k), m.z->expand(without_state_rates(e.forcing(static_cast<int>(i)), m)).diff(z));
        const ex rate = m.z->expand(without_state_rates(m.states[k - n].rate, m));
        for (unsigned j = 0; j < n; ++j) {
            put(result.S1(k, j), rate.diff(m.qdot[j]));
            put(result.S0(k, j), rate.diff(m.q[j]));
        }
        for (unsigned l = n; l < all; ++l) put(result.S0(k, l), rate.diff(m.states[l - n].derivative[0]));
        result.S1(k, k) = 1;
        result.stays = result.stays && is_zero_at(rate, there, m);
    }
    return is_short ? std::optional(result) : std::nullopt;
}

/// The pencil of a scene with constraints. GiNaC's expressions are all in q, q' and parameters.
class ConstrainedPencil {
public:
    ConstrainedPencil(const Mechanism& m, const Equations& e, const std::vector<ex>& q0, const std::vector<ex>& u0)
        : m_(m), e_(e), n_(m.size()), rows_(static_cast<int>(m.constraints.size())) {
        for (int i = 0; i < n_; ++i) {
            there_[m.q[i]] = m.z->expand(q0[i]);
            there_[m.qdot[i]] = m.z->expand(u0[i]);
        }
        know_inputs(there_, m);
    }

    std::optional<SymbolicPencil> find() {
        if (!m_.unilateral.empty() || n_ + rows_ > most_rows || !expand_forces()) return {};
        if (!holds_at_start()) return SymbolicPencil{};
        if (!find_reactions()) return {};
        const auto size = static_cast<unsigned>(n_ + rows_);
        SymbolicPencil result{.S2 = {size, size}, .S1 = {size, size}, .S0 = {size, size}, .stays = true};
        bool short_enough = true;
        const auto put = [&](GiNaC::matrix& to, int i, int j, const ex& value) {
            const auto there = readable_there(value);
            if (!there) return void(short_enough = false);
            to(static_cast<unsigned>(i), static_cast<unsigned>(j)) = *there;
        };
        for (int i = 0; i < n_; ++i)
            for (int j = 0; j < n_ && short_enough; ++j) {
                put(result.S2, i, j, m_.z->expand(e_.M(i, j)));
                put(result.S1, i, j, -force_[i].diff(m_.qdot[j]));
                put(result.S0, i, j, -loaded_[i].diff(m_.q[j]));
            }
        for (int k = 0; k < rows_; ++k)
            for (int j = 0; j < n_ && short_enough; ++j) {
                put(result.S0, j, n_ + k, -row_[k][j]);
                if (m_.constraints[k].position) {
                    put(result.S0, n_ + k, j, row_[k][j]);
                } else {
                    put(result.S1, n_ + k, j, row_[k][j]);
                    put(result.S0, n_ + k, j, speed_[k].diff(m_.q[j]));
                }
            }
        if (!short_enough) return {};
        return result;
    }

private:
    static constexpr int most_rows = 8;

    bool expand_forces() {
        for (int i = 0; i < n_; ++i) {
            if (m_.z->tree_size(e_.forcing(i)) > largest_tree) return false;
            force_.push_back(m_.z->expand(e_.forcing(i)));
        }
        for (const Mechanism::Constraint& c : m_.constraints) {
            std::vector<ex> row;
            ex speed = m_.z->expand(c.offset);
            for (int i = 0; i < n_; ++i) {
                row.push_back(m_.z->expand(c.row[i]));
                speed += row.back() * m_.qdot[i];
            }
            row_.push_back(std::move(row));
            speed_.push_back(std::move(speed));
        }
        return std::none_of(speed_.begin(), speed_.end(), [&](const ex& e) { return e.has(m_.t); });
    }

    bool vanishes(const ex& e) const {
        const auto value = fourier(e.subs(there_), *m_.symbols, 400);
        return value && is_zero(*value);
    }

    /// Do positions, rates and accelerations q'' = 0 obey the constraints?
    bool holds_at_start() const {
        for (std::size_t k = 0; k < m_.constraints.size(); ++k) {
            const Mechanism::Constraint& c = m_.constraints[k];
            if (c.position && !vanishes(m_.z->expand(*c.position))) return false;
            if (!vanishes(speed_[k]) || !vanishes(m_.z->expand(c.acceleration))) return false;
        }
        return true;
    }

    /// λ of f + Aᵀ λ = 0 from A Aᵀ λ = −A f, and whether all of f is then in balance.
    bool find_reactions() {
        const auto size = static_cast<unsigned>(rows_);
        GiNaC::matrix square(size, size), right(size, 1), unknown(size, 1);
        for (unsigned k = 0; k < size; ++k) {
            unknown(k, 0) = m_.constraints[k].multiplier;
            for (int i = 0; i < n_; ++i) {
                right(k, 0) -= (row_[k][i] * force_[i]).subs(there_);
                for (unsigned l = 0; l < size; ++l) square(k, l) += (row_[k][i] * row_[l][i]).subs(there_);
            }
        }
        GiNaC::matrix reaction(size, 1);
        try {
            reaction = square.solve(unknown, right);
        } catch (const std::runtime_error&) {
            return false;  // the rows depend on each other there
        }
        for (int i = 0; i < n_; ++i) {
            ex sum = force_[i], balance = force_[i].subs(there_);
            for (unsigned k = 0; k < size; ++k) {
                const ex value = reaction(k, 0).normal();
                if (value.has(unknown(k, 0))) return false;
                sum += row_[k][i] * value;
                balance += row_[k][i].subs(there_) * value;
            }
            loaded_.push_back(sum);
            if (!balance.normal().is_zero() && !vanishes(balance)) return false;
        }
        return true;
    }

    std::optional<ex> readable_there(const ex& e) const {
        const ex value = e.subs(there_);
        if (has_unknown_derivative(value)) return {};
        const ex short_value = value.normal();
        const auto f = fourier(short_value, *m_.symbols, 400);
        if (!f || f->size() > most_terms) return {};
        return expression(readable(*f));
    }

    const Mechanism& m_;
    const Equations& e_;
    const int n_, rows_;
    GiNaC::exmap there_;
    std::vector<ex> force_, loaded_, speed_;  ///< f, f + Aᵀ λ, A q' + b
    std::vector<std::vector<ex>> row_;
};

}  // namespace

std::optional<SymbolicMatrices> symbolic_matrices(const Mechanism& m, const Equations& e,
                                                  const std::vector<ex>& q0, const std::vector<ex>& u0) {
    try {
        return matrices(m, e, state_at(m, q0, u0, {}));
    } catch (const GiNaC::pole_error&) {  // 0·∞, as of sqrt(x^2)^3 at 0
        return {};
    }
}

std::optional<SymbolicPencil> symbolic_pencil(const Mechanism& m, const Equations& e, const std::vector<ex>& q0,
                                              const std::vector<ex>& u0, const std::vector<ex>& z0) {
    if (!e.speeds_are_rates() || (!m.constraints.empty() && !m.states.empty())) return {};
    try {
        if (m.constraints.empty()) {
            GiNaC::exmap there = state_at(m, q0, u0, z0);
            know_inputs(there, m);
            const auto found = matrices(m, e, there);
            if (!found) return {};
            const SymbolicPencil result{
                .S2 = found->M, .S1 = found->C.add(found->G), .S0 = found->K.add(found->N), .stays = found->stays};
            return m.states.empty() ? result : with_rows_of_states(m, e, result, there);
        }
        return ConstrainedPencil(m, e, q0, u0).find();
    } catch (const GiNaC::pole_error&) {
        return {};
    }
}

}  // namespace alembert
