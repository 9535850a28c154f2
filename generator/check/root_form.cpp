// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/root_form.hpp"

#include <stdexcept>

#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double largest_claim = 4000;  // nodes, written out

/// All powers with exponents k/2, k odd.
void find_roots(const ex& e, GiNaC::exset& found) {
    if (GiNaC::is_a<GiNaC::power>(e) && ex(2 * e.op(1)).info(GiNaC::info_flags::odd)) found.insert(e);
    for (const ex& part : e) find_roots(part, found);
}

}  // namespace

std::optional<RootForm> root_form(const ex& residual, const Mechanism& m) {
    if (m.z->tree_size(residual) > largest_claim) return std::nullopt;
    const ex plain = m.z->expand(residual);
    GiNaC::exset roots;
    find_roots(plain, roots);
    if (roots.empty()) return std::nullopt;
    const ex s = roots.begin()->op(0);
    const GiNaC::symbol S("S");
    GiNaC::exmap by;  // s^(k/2) = s^((k − 1)/2) S
    for (const ex& root : roots) {
        if (!root.op(0).is_equal(s)) return std::nullopt;
        by[root] = pow(s, root.op(1) - GiNaC::numeric(1, 2)) * S;
    }
    const ex in_S = plain.subs(by, GiNaC::subs_options::no_pattern).expand();
    if (!in_S.is_polynomial(S)) return std::nullopt;
    ex A = 0, B = 0;
    for (int k = 0; k <= in_S.degree(S); ++k) (k % 2 == 0 ? A : B) += in_S.coeff(S, k) * pow(s, k / 2);
    if (A.is_zero() || B.is_zero()) return std::nullopt;
    return RootForm{.norm = m.z->name(A * A - B * B * s), .root = (-A / B).expand()};
}

std::vector<ex> squares_in(const ex& residual, const Mechanism& m) {
    if (m.z->tree_size(residual) > largest_claim) return {};
    GiNaC::exset roots, squares;
    find_roots(m.z->expand(residual), roots);
    for (const ex& root : roots) squares.insert(root.op(0));
    return {squares.begin(), squares.end()};
}

std::optional<ex> root_of_positions(const ex& s, const Mechanism& m) {
    for (const auto* list : {&m.constraints, &m.redundant})
        for (const Mechanism::Constraint& constraint : *list) {
            if (!constraint.position || m.z->tree_size(*constraint.position) > largest_claim) continue;
            const ex f = m.z->expand(*constraint.position).expand();
            for (const GiNaC::symbol& q : m.q) {
                if (!f.is_polynomial(q) || f.degree(q) != 2) continue;
                const ex a = f.coeff(q, 2), b = f.coeff(q, 1), c = f.coeff(q, 0);
                const ex ratio = ((b * b - 4 * a * c) / s).normal();
                if (!GiNaC::is_a<GiNaC::numeric>(ratio)) {
                    if (!is_identically_zero((b * b - 4 * a * c - 4 * a * a * s).expand(), m)) continue;
                    return ((2 * a * q + b) / (2 * a)).normal().expand();
                }
                const ex root = sqrt(ratio);
                if (root.info(GiNaC::info_flags::rational) && root.info(GiNaC::info_flags::positive))
                    return ((2 * a * q + b) / root).expand();
            }
        }
    return std::nullopt;
}

}  // namespace alembert
