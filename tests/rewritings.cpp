// SPDX-License-Identifier: MIT
#include "rewritings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "algebra/notation/text.hpp"
#include "analysis/derive/derivation.hpp"
#include "model/formalism/kane.hpp"

namespace alembert::test {

namespace {

using Kind = Tree::Kind;

int pick(std::mt19937& random, std::size_t n) {
    return static_cast<int>(random() % n);
}
template <typename T>
const T& one_of(std::mt19937& random, const std::vector<T>& list) {
    return list[random() % list.size()];
}

std::pair<std::string, std::string> sides(const std::string& equation) {
    const std::size_t equals = equation.find('=');
    return {equation.substr(0, equals), equation.substr(equals + 1)};
}

/// Prints a tree, each node in parentheses where it needs them, with some nodes put in another way.
class Dresser {
public:
    Dresser(std::mt19937& random, int changes, int nodes, std::vector<std::string> zero_rates)
        : random_(random), changes_(changes), nodes_(nodes), zero_rates_(std::move(zero_rates)) {}

    std::string print(const Tree& tree) {
        const bool change =
            changes_ > 0 && pick(random_, static_cast<std::size_t>(std::max(1, nodes_ / changes_))) == 0;
        switch (tree.kind) {
            case Kind::number:
                return tree.text;
            case Kind::name:
                return name(tree, change);
            case Kind::call:
                return call(tree, change);
            case Kind::negate:
                return "(-" + print(*tree.args[0]) + ")";
            case Kind::reciprocal:
                return "(1/" + print(*tree.args[0]) + ")";
            case Kind::derivative:
                return "(" + print(*tree.args[0]) + ")" + std::string(static_cast<std::size_t>(tree.primes), '\'');
            case Kind::power:
                return power(tree, change);
            case Kind::sum: {
                std::vector<TreePtr> terms = tree.args;
                if (pick(random_, 3) == 0) std::shuffle(terms.begin(), terms.end(), random_);
                std::string text;
                for (const TreePtr& term : terms) {
                    const bool minus = term->kind == Kind::negate;
                    text += (text.empty() ? (minus ? "-" : "")
                             : minus      ? " - "
                                          : " + ") +
                            print(minus ? *term->args[0] : *term);
                }
                return "(" + text + ")";
            }
            case Kind::product: {
                // a(b + c) = ab + ac
                const auto sum = std::find_if(tree.args.begin(), tree.args.end(),
                                              [](const TreePtr& a) { return a->kind == Kind::sum; });
                if (change && sum != tree.args.end() && (*sum)->args.size() <= 4) {
                    std::string rest;
                    for (auto a = tree.args.begin(); a != tree.args.end(); ++a)
                        if (a != sum) rest += "*" + print(**a);
                    std::string text;
                    for (const TreePtr& term : (*sum)->args)
                        text += (text.empty() ? "" : "+") + print(*term) + rest;
                    return "(" + text + ")";
                }
                std::string text;
                for (const TreePtr& factor : tree.args) {
                    const bool over = factor->kind == Kind::reciprocal;
                    text += (text.empty() ? "" : over ? "/" : "*") + print(over ? *factor->args[0] : *factor);
                }
                return "(" + text + ")";
            }
        }
        return "";
    }

private:
    /// x′ less what the constraints say is zero.
    std::string name(const Tree& tree, bool change) {
        const std::string whole = tree.text + std::string(static_cast<std::size_t>(tree.primes), '\'');
        if (!change || tree.primes == 0 || zero_rates_.empty()) return whole;
        std::vector<std::string> with;
        for (const std::string& zero : zero_rates_)
            if (zero.find(tree.text + "'") != std::string::npos) with.push_back(zero);
        if (with.empty()) return whole;
        const std::string& zero = one_of(random_, with);
        return "(" + whole + " - (" + zero + ")" + std::string(static_cast<std::size_t>(tree.primes - 1), '\'') +
               ")";
    }

    std::string call(const Tree& tree, bool change) {
        std::string args;
        for (const TreePtr& arg : tree.args)
            args += (args.empty() ? "" : ",") + print(*arg);  // in parentheses where it is no atom
        const std::string plain = tree.text + "(" + args + ")";
        if (!change || (tree.text != "sin" && tree.text != "cos" && tree.text != "tan")) return plain;
        if (tree.text == "tan") return fmt::format("(sin({0})/cos({0}))", args);
        const bool sine = tree.text == "sin";
        const Tree& inside = *tree.args[0];
        if (inside.kind == Kind::sum && inside.args.size() == 2 && pick(random_, 2) == 0) {
            const bool minus = inside.args[1]->kind == Kind::negate;
            const std::string a = print(*inside.args[0]),
                              b = print(minus ? *inside.args[1]->args[0] : *inside.args[1]);
            return sine ? fmt::format("(sin({0})*cos({1}) {2} cos({0})*sin({1}))", a, b, minus ? "-" : "+")
                        : fmt::format("(cos({0})*cos({1}) {2} sin({0})*sin({1}))", a, b, minus ? "+" : "-");
        }
        switch (pick(random_, 4)) {
            case 0:
                return sine ? fmt::format("(2*sin({0}/2)*cos({0}/2))", args)
                            : fmt::format("(1 - 2*sin({0}/2)^2)", args);
            case 1:
                return sine ? fmt::format("cos(pi/2 - {0})", args) : fmt::format("sin({0} + pi/2)", args);
            case 2:
                return sine ? fmt::format("(tan({0})*cos({0}))", args) : fmt::format("(sin({0})/tan({0}))", args);
            default:
                return sine ? fmt::format("(-sin(-{0}))", args) : fmt::format("cos(-{0})", args);
        }
    }

    std::string power(const Tree& tree, bool change) {
        const Tree& base = *tree.args[0];
        const bool square = tree.args[1]->kind == Kind::number && tree.args[1]->text == "2";
        if (change && square && base.kind == Kind::call && (base.text == "sin" || base.text == "cos")) {
            const std::string a = print(*base.args[0]);
            const bool sine = base.text == "sin";
            if (pick(random_, 2) == 0) return fmt::format("(1 - {}({})^2)", sine ? "cos" : "sin", a);
            return fmt::format("((1 {} cos(2*{}))/2)", sine ? "-" : "+", a);
        }
        if (change && square) {
            const std::string b = print(base);
            return "(" + b + "*" + b + ")";
        }
        return "(" + print(base) + "^" + print(*tree.args[1]) + ")";
    }

    std::mt19937& random_;
    int changes_, nodes_;
    std::vector<std::string> zero_rates_;
};

int size_of(const Tree& tree) {
    int size = 1;
    for (const TreePtr& arg : tree.args) size += size_of(*arg);
    return size;
}

bool mentions_geometry(const std::string& text) {
    for (const char* word : {"dot(", "norm(", "cross(", "p_"})
        if (text.find(word) != std::string::npos) return true;
    return false;
}

/// z1, z2 ...: the oracle has no values for them.
bool mentions_intermediates(const std::string& text) {
    for (std::size_t k = 0; k + 1 < text.size(); ++k)
        if (text[k] == 'z' && std::isdigit(static_cast<unsigned char>(text[k + 1])) &&
            (k == 0 || !std::isalnum(static_cast<unsigned char>(text[k - 1]))))
            return true;
    return false;
}

}  // namespace

Rewritings::Rewritings(const Scene& scene, const Mechanism& m, const Equations& e) {
    const Derivation shown = derivation_of(m, e);
    const auto take = [&](const Phrase& lhs, const Phrase& rhs, bool in_any_case) {
        const std::string equation = text(lhs) + " = " + text(rhs);
        const bool readable = !mentions_intermediates(equation);
        if (readable || in_any_case) right_.push_back(equation);
        return readable;
    };
    for (const ReadableEquation& equation : shown.equations)
        readable_ = take(equation.lhs, equation.rhs, true) && readable_;
    if (!m.speeds.empty()) {
        const Derivation in_speeds = derivation_of(m, kane(m));
        for (const ReadableEquation& equation : in_speeds.equations) take(equation.lhs, equation.rhs, false);
        for (const auto& [rate, value] : in_speeds.kinematics) take(rate, value, false);
    }
    for (const Claim& claim : scene.claims) {
        const std::string written = text_of(claim.equation);
        if (claim.at == Claim::At::motion && claim.unknowns.empty() && claim.constants.empty() &&
            !mentions_geometry(written))
            right_.push_back(written);
    }
    for (std::size_t k = 0; k < shown.constraints.size(); ++k) {
        const std::string zero = text(shown.constraints[k].second);
        if (m.constraints[k].position) positions_.push_back(zero);
        rates_.push_back(m.constraints[k].position ? "(" + zero + ")'" : zero);
    }
    for (const Parameter& p : scene.parameters) parameters_.push_back(p.name.text);
    for (const Coordinate& q : scene.coordinates) coordinates_.push_back(q.name.text);
}

std::string Rewritings::function(std::mt19937& random, bool divisor) const {
    const std::string& q = one_of(random, coordinates_);
    const std::string a = parameters_.empty() ? "3" : one_of(random, parameters_);
    switch (pick(random, divisor ? 6 : 9)) {
        case 0:
            return a;
        case 1:
            return fmt::format("(2 + cos({}))", q);
        case 2:
            return fmt::format("(1 + {}^2)", q);
        case 3:
            return fmt::format("({} + {}'^2)", a, q);
        case 4:
            return fmt::format("sin({} + 1/3)", q);
        case 5:
            return fmt::format("{}", 2 + pick(random, 5));
        case 6:
            return fmt::format("{}'", q);
        case 7:
            return fmt::format("cos({})", q);
        default:
            return fmt::format("({}*{} - t)", a, q);
    }
}

std::string Rewritings::dressed(const std::string& text, std::mt19937& random, int changes) const {
    std::vector<Diagnostic> mistakes;
    const Expression e = parse_expression(text, {}, mistakes);
    if (!e.tree) return text;
    return Dresser(random, changes, size_of(*e.tree), rates_).print(*e.tree);
}

std::string Rewritings::claim(std::mt19937& random) const {
    std::string lhs, rhs;
    const auto put = [&](std::string& to, const std::string& text) { to += (to.empty() ? "" : " + ") + text; };
    const int rows = 1 + pick(random, std::min<std::size_t>(3, right_.size()));
    for (int k = 0; k < rows; ++k) {
        auto [left, right] = sides(one_of(random, right_));
        if (pick(random, 3) == 0) std::swap(left, right);
        std::string factor = function(random, false);
        if (pick(random, 4) == 0) factor += "/" + function(random, true);
        if (rows == 1 && pick(random, 3) == 0) factor = "1";
        if (pick(random, 2) == 0) {
            put(lhs, factor + "*(" + left + ")");
            put(rhs, factor + "*(" + right + ")");
        } else {
            put(lhs, factor + "*((" + left + ") - (" + right + "))");
        }
    }
    if (!rates_.empty() && pick(random, 3) == 0)
        put(pick(random, 2) == 0 || rhs.empty() ? lhs : rhs,
            function(random, false) + "*(" + one_of(random, rates_) + ")" + (pick(random, 2) == 0 ? "'" : ""));
    if (!positions_.empty() && pick(random, 3) == 0)
        put(lhs, function(random, false) + "*(" + one_of(random, positions_) + ")");
    if (rhs.empty()) rhs = "0";
    const int changes = pick(random, 5);
    return dressed(lhs, random, changes) + " = " + dressed(rhs, random, changes);
}

}  // namespace alembert::test
