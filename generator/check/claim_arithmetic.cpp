// SPDX-License-Identifier: GPL-2.0-or-later
// (fg)' = f'g + fg',  (fg)'' = f''g + 2f'g' + fg'';  (1/f)' = −f'/f²,  (1/f)'' = 2f'²/f³ − f''/f².
#include "check/claim_arithmetic.hpp"

#include <algorithm>

namespace alembert {

using GiNaC::ex;
using Kind = Tree::Kind;

namespace {

TimeValue operator*(const TimeValue& a, const TimeValue& b) {
    const auto& [f, g] = std::pair(a.value, b.value);
    return {{f[0] * g[0], f[1] * g[0] + f[0] * g[1], f[2] * g[0] + 2 * f[1] * g[1] + f[0] * g[2]},
            std::min(a.known, b.known)};
}

std::optional<TimeValue> inverse(const TimeValue& a) {
    if (a.value[0].is_zero()) return std::nullopt;
    const Prime i = a.value[0].inverse(), square = i * i;
    return TimeValue{{i, -a.value[1] * square, 2 * a.value[1] * a.value[1] * square * i - a.value[2] * square},
                     a.known};
}

/// The whole exponent of a power, with its sign.
std::optional<int> whole_exponent(const Tree& exponent) {
    if (exponent.kind == Kind::negate) {
        const auto inner = whole_exponent(*exponent.args[0]);
        return inner ? std::optional(-*inner) : std::nullopt;
    }
    if (exponent.kind != Kind::number || exponent.text.size() > 2 ||
        exponent.text.find_first_not_of("0123456789") != std::string::npos)
        return std::nullopt;
    return std::stoi(exponent.text);
}

std::optional<TimeValue> power(const TimeValue& base, int exponent) {
    TimeValue result{{1, 0, 0}};
    for (int k = 0; k < std::abs(exponent); ++k) result = result * base;
    return exponent < 0 ? inverse(result) : std::optional(result);
}

}  // namespace

ClaimArithmetic::ClaimArithmetic(Claims& claims, const Claim& claim, std::vector<ModularPoint> points,
                                 int derivative, bool is_closed)
    : claims_(claims),
      points_(std::move(points)),
      derivative_(derivative),
      is_closed_(is_closed),
      at_impact_(claim.at == Claim::At::impact) {
    remember(*claim.equation.lhs.tree);
    remember(*claim.equation.rhs.tree);
}

void ClaimArithmetic::remember(const Tree& tree) {
    if (tree.kind == Kind::name || tree.kind == Kind::call) own_[&tree] = &atom(tree);
    if (tree.kind != Kind::call)
        for (const TreePtr& arg : tree.args) remember(*arg);
}

ex ClaimArithmetic::reading(const Tree& tree) {
    const Expression whole = expression_of(tree);
    if (at_impact_) return claims_.read_at_impact(whole);
    return is_closed_ ? claims_.read_with_constants(whole) : claims_.read(whole);
}

ClaimArithmetic::Atom ClaimArithmetic::read(const Tree& tree) {
    const Mechanism& m = claims_.mechanism();
    Atom result(points_.size());
    std::vector<ex> values;
    try {
        values.push_back(reading(tree));
        std::vector<GiNaC::symbol> last = m.qddot;
        last.insert(last.end(), claims_.equations().lambda.begin(), claims_.equations().lambda.end());
        for (const Mechanism::Constraint* c : m.undetermined()) last.push_back(c->multiplier);
        for (const Mechanism::Input& input : m.inputs) last.push_back(input.derivative[2]);
        for (const Open& open : claims_.open())
            if (!open.constant) last.push_back(open.symbol);
        while (!at_impact_ && values.size() < 3 && !m.z->depends(values.back(), last))
            values.push_back(m.time_derivative({values.back()})[0]);
        const std::vector<int> nodes = claims_.lower(program_, values);
        for (std::size_t k = 0; k < points_.size(); ++k)
            if (const auto at = evaluate_mod(program_, points_[k], nodes)) {
                result[k] = TimeValue{{}, static_cast<int>(nodes.size())};
                for (std::size_t d = 0; d < nodes.size(); ++d) result[k]->value[d] = at->value[nodes[d]];
            }
    } catch (const SceneMistake&) {
    } catch (const std::runtime_error&) {  // it divides by zero, for instance
    }
    return result;
}

const ClaimArithmetic::Atom& ClaimArithmetic::atom(const Tree& tree) {
    if (const auto own = own_.find(&tree); own != own_.end()) return *own->second;
    const std::string text = plain_text_of(tree);
    const auto found = atoms_.find(text);
    return found != atoms_.end() ? found->second : atoms_.emplace(text, read(tree)).first->second;
}

std::optional<TimeValue> ClaimArithmetic::at(const Tree& tree, std::size_t point) {
    auto result = unscaled(tree, point);
    if (&tree == scaled_ && result)
        for (Prime& value : result->value) value *= scale_;
    return result;
}

std::optional<TimeValue> ClaimArithmetic::unscaled(const Tree& tree, std::size_t point) {
    ++effort_;
    switch (tree.kind) {
        case Kind::number: {
            if (tree.text.size() == 1) return TimeValue{{tree.text[0] - '0', 0, 0}};
            const auto number = Prime::from(cln::the<cln::cl_RA>(exact_number(tree.text).to_cl_N()));
            return number ? std::optional(TimeValue{{*number, 0, 0}}) : std::nullopt;
        }
        case Kind::name:
        case Kind::call:
            return atom(tree)[point];
        case Kind::negate: {
            auto inner = at(*tree.args[0], point);
            if (inner)
                for (Prime& value : inner->value) value = -value;
            return inner;
        }
        case Kind::sum: {
            TimeValue sum;
            for (const TreePtr& arg : tree.args) {
                const auto term = at(*arg, point);
                if (!term) return std::nullopt;
                for (std::size_t d = 0; d < 3; ++d) sum.value[d] += term->value[d];
                sum.known = std::min(sum.known, term->known);
            }
            return sum;
        }
        case Kind::product: {
            TimeValue product{{1, 0, 0}};
            for (const TreePtr& arg : tree.args) {
                const auto factor = at(*arg, point);
                if (!factor) return std::nullopt;
                product = product * *factor;
            }
            return product;
        }
        case Kind::reciprocal: {
            const auto inner = at(*tree.args[0], point);
            return inner ? inverse(*inner) : std::nullopt;
        }
        case Kind::power: {
            const auto exponent = whole_exponent(*tree.args[1]);
            if (!exponent) return atom(tree)[point];
            const auto base = at(*tree.args[0], point);
            return base ? power(*base, *exponent) : std::nullopt;
        }
        case Kind::derivative: {
            const auto inner = at(*tree.args[0], point);
            if (!inner || inner->known <= tree.primes) return std::nullopt;
            TimeValue result{{}, inner->known - tree.primes};
            for (std::size_t d = 0; d + static_cast<std::size_t>(tree.primes) < 3; ++d)
                result.value[d] = inner->value[d + static_cast<std::size_t>(tree.primes)];
            return result;
        }
    }
    return std::nullopt;
}

std::optional<Prime> ClaimArithmetic::value(const Tree& tree, std::size_t point) {
    const auto result = at(tree, point);
    return result ? std::optional(result->value[0]) : std::nullopt;
}

std::optional<Prime> ClaimArithmetic::residual(const Tree& lhs, const Tree& rhs, std::size_t point) {
    const auto left = at(lhs, point), right = at(rhs, point);
    if (!left || !right || std::min(left->known, right->known) <= derivative_) return std::nullopt;
    return left->value[static_cast<std::size_t>(derivative_)] -
           right->value[static_cast<std::size_t>(derivative_)];
}

bool ClaimArithmetic::vanishes(const Tree& lhs, const Tree& rhs) {
    for (std::size_t k = 0; k < points_.size(); ++k)
        if (const auto value = residual(lhs, rhs, k); !value || !value->is_zero()) return false;
    return points_.size() > 0;
}

}  // namespace alembert
