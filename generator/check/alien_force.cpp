// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/alien_force.hpp"

#include "algebra/notation/readable.hpp"
#include "check/phrase_tree.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// The forces in row i of the equations at rest, and their terms.
std::vector<Fourier> forces_of(int i, const Mechanism& m, const Equations& e) {
    constexpr double largest_tree = 3000;
    constexpr std::size_t most_terms = 2000;
    std::vector<Fourier> result;
    GiNaC::exmap still;
    for (const GiNaC::symbol& rate : m.qdot) still[rate] = 0;
    for (const ex& force : {e.applied[i], ex(m.z->expand(e.own[i]).subs(still, GiNaC::subs_options::no_pattern))})
        if (m.z->tree_size(force) < largest_tree)
            if (const auto f = fourier(m.z->expand(force), *m.symbols, most_terms); f && f->size() > 0) {
                result.push_back(*f);
                const std::vector<Fourier> parts = parts_of(*f);
                if (parts.size() > 1) result.insert(result.end(), parts.begin(), parts.end());
            }
    return result;
}

}  // namespace

std::vector<Edit> alien_forces(const Nearest& nearest, const Edits& edits, const Mechanism& m, const Equations& e,
                               double size) {
    std::vector<Edit> result;
    if (nearest.row >= e.size()) return result;
    std::vector<std::pair<Fourier, std::optional<Fourier>>> left{
        {nearest.wrong, std::nullopt}};  // what is alien, and
                                         // what it replaces
    for (const Fourier& own : forces_of(nearest.row, m, e))
        left.emplace_back(nearest.wrong - nearest.scale * own, nearest.scale * own);
    for (const auto& [alien, own] : left)
        for (int j = 0; j < e.size(); ++j) {
            if (j == nearest.row || alien.size() == 0) continue;
            for (const Fourier& other : forces_of(j, m, e)) {
                const auto ratio = steady_ratio(other.terms()[0], alien.terms()[0]);
                if (!ratio || !is_zero(alien - *ratio * other)) continue;
                const TreePtr term = tree_of(readable(alien));
                const TreePtr instead = own ? tree_of(readable(Rational(-1) * *own)) : nullptr;
                for (Edit& edit : edits.in_place_of(term, instead, size)) result.push_back(std::move(edit));
            }
        }
    return result;
}

}  // namespace alembert
