// SPDX-License-Identifier: GPL-2.0-or-later
// The elimination of a symmetric matrix G, xᵀGx = Σ_k d_k (x_k + Σ_{j>k} G_kj x_j / d_k)², proves G positive
// semidefinite if each d_k is positive, or is zero together with its whole row (G. Golub & C. Van Loan, Matrix
// Computations (2013), §4.2.8).
#include "analysis/state/sum_of_squares.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/parameter_values.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double largest_tree = 2000;    // nodes of a constraint; one of a distance in space has about 30
constexpr std::size_t most_atoms = 128;  // which take a few seconds, if the matrix is that of distances
// Nodes of an entry of the matrix: those of a ring of 32 symbols have about 100, and one that is larger takes
// seconds.
constexpr std::size_t largest_entry = 1000;
constexpr long largest_denominator = 1000;
constexpr double surely_not_zero = 1e-9;  // of the terms of a pivot; rounding leaves about 1e-16 of them
constexpr double same_share = 1e-4;  // positions on a double root are known to √ε, and λ is not better known

using SymbolicMatrix = std::vector<std::vector<ex>>;

/// The exact values of the parameters decide what is zero; signs are those of floating-point numbers.
class Values {
public:
    explicit Values(const Mechanism& m) : numbers_(m) {
        for (std::size_t round = 0; round <= m.parameters.size(); ++round)
            for (const Mechanism::Parameter& p : m.parameters) exact_[p.symbol] = p.value.subs(exact_, no_pattern);
    }

    bool is_zero(const ex& e) const {
        return e.is_zero() || e.subs(exact_, no_pattern).normal().expand().is_zero();
    }
    double number(const ex& e) const { return numbers_.number(e); }

private:
    static constexpr unsigned no_pattern = GiNaC::subs_options::no_pattern;
    GiNaC::exmap exact_;
    ParameterValues numbers_;
};

/// Replaces functions of what moves by symbols, in which the rest may be a polynomial.
class Atoms {
public:
    explicit Atoms(const Mechanism& m) : moving_(m.moving()) {
        for (const GiNaC::symbol& s : moving_) all_.emplace_back(s);
    }

    ex polynomial_in(const ex& e) {
        if (!moves(e) || GiNaC::is_a<GiNaC::symbol>(e)) return e;
        if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
            ex result = GiNaC::is_a<GiNaC::add>(e) ? 0 : 1;
            for (const ex& part : e)
                result = GiNaC::is_a<GiNaC::add>(e) ? result + polynomial_in(part) : result * polynomial_in(part);
            return result;
        }
        if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint))
            return GiNaC::pow(polynomial_in(e.op(0)), e.op(1));
        const auto known = named_.find(e);
        if (known != named_.end()) return known->second;
        const GiNaC::symbol name;
        all_.emplace_back(name);
        meaning_[name] = e;
        return named_[e] = name;
    }
    ex meaning(const ex& e) const { return e.subs(meaning_, GiNaC::subs_options::no_pattern); }
    const std::vector<ex>& all() const { return all_; }

private:
    bool moves(const ex& e) const {
        return std::any_of(moving_.begin(), moving_.end(), [&](const ex& s) { return e.has(s); });
    }

    std::vector<GiNaC::symbol> moving_;
    std::vector<ex> all_;
    GiNaC::exmap named_, meaning_;
};

/// The symmetric matrix of a polynomial of second degree in `atoms` and 1; nothing for other expressions.
std::optional<SymbolicMatrix> matrix_of(const ex& polynomial, const std::vector<ex>& atoms) {
    const std::size_t n = atoms.size();
    SymbolicMatrix G(n + 1, std::vector<ex>(n + 1, 0));
    ex rest = polynomial.expand();
    for (std::size_t i = 0; i < n; ++i) {
        if (!rest.is_polynomial(atoms[i]) || rest.degree(atoms[i]) > 2) return std::nullopt;
        G[i][i] = rest.coeff(atoms[i], 2);
        const ex linear = rest.coeff(atoms[i], 1).expand();
        for (std::size_t j = i + 1; j < n; ++j) {
            if (!linear.is_polynomial(atoms[j]) || linear.degree(atoms[j]) > 1) return std::nullopt;
            G[i][j] = G[j][i] = linear.coeff(atoms[j], 1) / 2;
        }
        ex alone = linear;
        for (std::size_t j = i + 1; j < n; ++j) alone = alone.coeff(atoms[j], 0);
        G[i][n] = G[n][i] = alone / 2;
        rest = rest.coeff(atoms[i], 0).expand();
    }
    G[n][n] = rest;
    for (const auto& row : G)
        for (const ex& e : row)
            if (std::any_of(atoms.begin(), atoms.end(), [&](const ex& atom) { return e.has(atom); }))
                return std::nullopt;
    return G;
}

/// p √S + q = 0 with constant p and q, the form of a distance, as (p² S − q²)/(−2q) = 0, which has the same row
/// where it holds; other expressions as they are.
ex without_root(const ex& e, const Mechanism& m) {
    const auto moves = [&](const ex& part) {
        const std::vector<GiNaC::symbol> moving = m.moving();
        return std::any_of(moving.begin(), moving.end(), [&](const ex& s) { return part.has(s); });
    };
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        if (!GiNaC::is_a<GiNaC::power>(*part) || !part->op(1).is_equal(ex(1) / 2) || !moves(*part)) continue;
        const GiNaC::symbol root;
        const ex whole = e.subs(*part == root, GiNaC::subs_options::no_pattern).expand();
        const ex p = whole.coeff(root, 1), q = whole.coeff(root, 0);
        const bool is_linear = (whole - p * root - q).expand().is_zero();
        if (!is_linear || moves(p) || moves(q) || p.has(root) || q.has(root) || q.is_zero()) return e;
        return (p * p * part->op(0) - q * q) / (-2 * q);
    }
    return e;
}

struct Squares {
    std::vector<double> pivots;
    std::vector<ex> forms;  ///< x_k + Σ_{j>k} G_kj x_j / d_k
    ex last = 0;            ///< the pivot of 1, before which all others are eliminated
};

bool is_large(const ex& e) {
    std::size_t nodes = 0;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (++nodes > largest_entry) return true;
    return false;
}

/// Nothing if entries grow beyond what is worth its time, as they do for many symbols, or if the elimination meets
/// a zero pivot in a row that is not zero, or one whose number is zero as far as rounding shows, but not its
/// symbols (√(5 + 2√6) − √2 − √3): as a square it would hold what nothing holds.
std::optional<Squares> eliminated(SymbolicMatrix G, std::vector<ex> atoms, const Values& values) {
    const std::size_t n = atoms.size();
    atoms.emplace_back(1);
    Squares result;
    std::vector<double> terms;  // the sum of the sizes of those that have made G_kk
    for (std::size_t k = 0; k < n; ++k) terms.push_back(std::abs(values.number(G[k][k])));
    for (std::size_t k = 0; k < n; ++k) {
        const ex pivot = G[k][k];
        if (values.is_zero(pivot)) {
            for (std::size_t j = k + 1; j <= n; ++j)
                if (!values.is_zero(G[k][j])) return std::nullopt;
            continue;
        }
        const double number = values.number(pivot);
        if (!(std::abs(number) > surely_not_zero * terms[k])) return std::nullopt;
        for (std::size_t j = k + 1; j < n; ++j) {
            const double entry = values.number(G[k][j]);
            terms[j] += entry * entry / std::abs(number);
        }
        ex form = atoms[k];
        for (std::size_t j = k + 1; j <= n; ++j) form += (G[k][j] / pivot).normal() * atoms[j];
        result.pivots.push_back(number);
        result.forms.push_back(form);
        for (std::size_t i = k + 1; i <= n; ++i)
            for (std::size_t j = k + 1; j <= n; ++j) {
                if (G[k][i].is_zero() || G[k][j].is_zero()) continue;
                G[i][j] = (G[i][j] - G[k][i] * G[k][j] / pivot).normal();
                if (is_large(G[i][j])) return std::nullopt;
            }
    }
    result.last = G[n][n];
    return result;
}

/// √e of a square e in parameters, positive at their values; √e itself for others.
ex root_of(const ex& e, const Values& values) {
    const ex parts = e.normal();
    ex result = 1;
    for (const ex& part : {parts.numer(), parts.denom()}) {
        ex root = 1;
        const ex product = part.info(GiNaC::info_flags::rational_polynomial) ? GiNaC::sqrfree(part) : part;
        const auto take = [&](const ex& factor) {
            root *= GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::even)
                        ? GiNaC::pow(factor.op(0), factor.op(1) / 2)
                        : GiNaC::sqrt(factor);
        };
        if (GiNaC::is_a<GiNaC::mul>(product))
            for (const ex& factor : product) take(factor);
        else
            take(product);
        result = result.is_equal(1) ? root : result / root;
    }
    return values.number(result) < 0 ? -result : result;
}

/// The λ_i of f_i = k_i (|v_i|² − a_i²): 1/(k_i a_i), with the sign of the given one.
std::optional<std::vector<ex>> of_distances(const std::vector<SymbolicMatrix>& G, const std::vector<ex>& atoms,
                                            const Eigen::VectorXd& lambda, const Values& values) {
    std::vector<ex> result;
    for (std::size_t i = 0; i < G.size(); ++i) {
        const std::optional<Squares> squares = eliminated(G[i], atoms, values);
        if (!squares || squares->pivots.empty() || values.is_zero(squares->last)) return std::nullopt;
        std::size_t k = 0;
        while (values.is_zero(G[i][k][k])) ++k;
        const ex scale = G[i][k][k], square = (-squares->last / scale).normal();
        if (!(values.number(square) > 0)) return std::nullopt;
        const ex size = 1 / (scale * root_of(square, values));
        result.push_back(values.number(size) * lambda[static_cast<Eigen::Index>(i)] < 0 ? -size : size);
    }
    return result;
}

/// The rational numbers of least denominator next to λ_i/λ_0 (continued fractions).
std::optional<std::vector<ex>> of_rationals(const Eigen::VectorXd& lambda) {
    std::vector<ex> result;
    for (const double share : lambda / lambda[0]) {
        long above = 1, below = 0, above_before = 0, below_before = 1;
        double rest = share;
        bool found = false;
        for (int step = 0; step < 20 && !found; ++step) {
            if (!(std::abs(rest) < 1e6)) return std::nullopt;
            const long whole = std::lround(std::floor(rest));
            above_before = std::exchange(above, whole * above + above_before);
            below_before = std::exchange(below, whole * below + below_before);
            if (below > largest_denominator) return std::nullopt;
            found = std::abs(static_cast<double>(above) / static_cast<double>(below) - share) <
                    same_share * std::abs(share);
            rest = 1 / (rest - static_cast<double>(whole));
        }
        if (!found) return std::nullopt;
        result.emplace_back(GiNaC::numeric(above, below));
    }
    return result;
}

/// The forms of Σ λ_i G_i if it is semidefinite and has no rest.
std::optional<std::vector<ex>> proved(const std::vector<SymbolicMatrix>& G, const std::vector<ex>& lambda,
                                      const std::vector<ex>& atoms, const Values& values) {
    SymbolicMatrix sum = G[0];
    for (std::size_t r = 0; r < sum.size(); ++r)
        for (std::size_t c = 0; c < sum.size(); ++c) {
            sum[r][c] = 0;
            for (std::size_t i = 0; i < G.size(); ++i) sum[r][c] += lambda[i] * G[i][r][c];
            sum[r][c] = sum[r][c].normal();
        }
    const std::optional<Squares> squares = eliminated(std::move(sum), atoms, values);
    if (!squares || squares->pivots.empty() || !values.is_zero(squares->last)) return std::nullopt;
    const auto all = [&](double sign) {
        return std::all_of(squares->pivots.begin(), squares->pivots.end(), [&](double d) { return sign * d > 0; });
    };
    if (!all(1) && !all(-1)) return std::nullopt;
    return squares->forms;
}

}  // namespace

std::optional<std::vector<ex>> sum_of_squares(const Mechanism& m, const std::vector<int>& which,
                                              const Eigen::VectorXd& lambda) {
    Atoms names(m);
    std::vector<ex> polynomials;
    for (const int k : which) {
        const ex f = *m.constraints[static_cast<std::size_t>(k)].position;
        if (m.z->tree_size(f) > largest_tree) return std::nullopt;
        polynomials.push_back(names.polynomial_in(without_root(m.z->expand(f), m)));
    }
    std::vector<ex> atoms;  // those that the constraints hold
    for (const ex& atom : names.all())
        if (std::any_of(polynomials.begin(), polynomials.end(), [&](const ex& p) { return p.has(atom); }))
            atoms.push_back(atom);
    if (atoms.size() > most_atoms) return std::nullopt;
    std::vector<SymbolicMatrix> G;
    for (const ex& polynomial : polynomials) {
        std::optional<SymbolicMatrix> matrix = matrix_of(polynomial, atoms);
        if (!matrix) return std::nullopt;
        G.push_back(*std::move(matrix));
    }
    const Values values(m);
    for (const auto& guess : {of_distances(G, atoms, lambda, values), of_rationals(lambda)}) {
        if (!guess) continue;
        if (auto forms = proved(G, *guess, atoms, values)) {
            for (ex& form : *forms) form = names.meaning(form);
            return forms;
        }
    }
    return std::nullopt;
}

}  // namespace alembert
