// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/quotient_signs.hpp"

#include <cln/rational.h>

#include <algorithm>
#include <map>
#include <set>

#include "program/rewriting.hpp"

namespace alembert {

namespace {

class QuotientSigns {
public:
    explicit QuotientSigns(const Program& old) : old_(old), rewriting_(old) {}

    Program finish() {
        return rewriting_.finish([this](int id) { return rebuilt(id); });
    }

    bool found() const { return !signs_.empty(); }
    std::vector<QuotientSign> signs() const {
        std::vector<QuotientSign> result;
        for (const auto& [argument, found] : signs_) {
            QuotientSign sign{argument, found.sources};
            for (const int id : rewriting_.needed)
                if (rewriting_.image(id) == found.size)
                    sign.sources.insert(old_[id].sources.begin(), old_[id].sources.end());
            result.push_back(std::move(sign));
        }
        return result;
    }

private:
    struct Found {
        int size;               ///< |x|
        std::set<int> sources;  ///< of the quotients
    };
    Program& made() { return rewriting_.made(); }

    int rebuilt(int id) {
        const Node& node = old_[id];
        if (node.is_constant()) return rewriting_.plain(id);
        if (node.op == Op::sqrt) return root(id);
        if (node.op == Op::product && !node.is_reciprocal()) return product(id);
        return rewriting_.plain(id);
    }

    /// |x| |y|² … for the root of c² x² y⁴ …
    int root(int id) {
        Rational size = 1;
        int inner = rewriting_.image(old_[id].args[0]);
        if (made()[inner].is_scaled()) {
            const Rational c = made()[inner].coefficients[0];
            if (cln::minusp(c) || !cln::sqrtp(c, &size)) return rewriting_.plain(id);
            inner = made()[inner].args[0];
        }
        const Node square = made()[inner];
        if (square.op != Op::product || square.is_constant() || square.is_reciprocal())
            return rewriting_.plain(id);
        std::vector<Program::Factor> roots;
        for (std::size_t k = 0; k < square.args.size(); ++k) {
            if (square.exponents[k] % 2 != 0) return rewriting_.plain(id);
            roots.emplace_back(made().call(Op::abs, {square.args[k]}), square.exponents[k] / 2);
        }
        return made().product(size, roots);
    }

    /// The factors of a node of the new program, with quotients as negative exponents.
    void collect(int id, int times, std::map<int, int>& exponents, Rational& content) {
        const Node& node = made()[id];
        if (node.is_scaled()) {
            content = content * cln::expt(node.coefficients[0], times);
            collect(node.args[0], times, exponents, content);
        } else if (node.op == Op::product) {
            for (std::size_t k = 0; k < node.args.size(); ++k)
                collect(node.args[k], times * node.exponents[k], exponents, content);
        } else {
            exponents[id] += times;
        }
    }

    int product(int id) {
        const int plain = rewriting_.plain(id);
        std::map<int, int> exponents;
        Rational content = 1;
        collect(plain, 1, exponents, content);
        bool changed = false;
        const std::map<int, int> before = exponents;
        for (const auto& [size, exponent] : before) {
            if (made()[size].op != Op::abs || made()[size].is_constant()) continue;
            const int inner = made()[size].args[0];
            const auto other = exponents.find(inner);
            if (exponent == 0 || other == exponents.end() || other->second * exponent >= 0) continue;
            // x^m/|x|^k: as many signs as cancel
            const int down = exponent > 0 ? 1 : -1, count = std::min(std::abs(exponent), std::abs(other->second));
            exponents[inner] += down * count;
            exponents[size] -= down * count;
            const int sign = made().call(Op::sign, {inner});
            if (count % 2 == 1) exponents[sign] += 1;
            if (count % 2 == 0) exponents[sign] += 2;
            Found& one = signs_.try_emplace(inner, Found{size, {}}).first->second;
            one.sources.insert(old_[id].sources.begin(), old_[id].sources.end());
            changed = true;
        }
        if (!changed) return plain;
        return made().product(content, std::vector<Program::Factor>(exponents.begin(), exponents.end()));
    }

    const Program& old_;
    Rewriting rewriting_;
    std::map<int, Found> signs_;  // by x
};

}  // namespace

Program with_quotient_signs(const Program& program, std::vector<QuotientSign>& signs) {
    QuotientSigns pass(program);
    Program made = pass.finish();
    if (!pass.found()) return program;
    signs = pass.signs();
    return made;
}

}  // namespace alembert
