// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/plain_number.hpp"

#include <cmath>
#include <numbers>

namespace alembert {

namespace {

class PlainValue {
public:
    explicit PlainValue(const Scene& scene) : scene_(scene) {}

    std::optional<double> of(const Tree& tree) {
        if (++nodes_ > most_nodes) return std::nullopt;
        using Kind = Tree::Kind;
        if (tree.kind == Kind::number) return value_of_digits(tree.text);
        if (tree.kind == Kind::name && tree.text == "pi" && tree.primes == 0) return std::numbers::pi;
        if (tree.kind == Kind::name) return tree.primes == 0 ? of_parameter(tree.text) : std::nullopt;
        if (tree.kind == Kind::call || tree.kind == Kind::derivative) return std::nullopt;
        double result = tree.kind == Kind::product ? 1 : 0;
        std::vector<double> args;
        for (const TreePtr& arg : tree.args) {
            const std::optional<double> value = of(*arg);
            if (!value) return std::nullopt;
            args.push_back(*value);
            result = tree.kind == Kind::product ? result * *value : result + *value;
        }
        if (tree.kind == Kind::negate) return -args[0];
        if (tree.kind == Kind::reciprocal) return 1 / args[0];
        if (tree.kind == Kind::power) return std::pow(args[0], args[1]);
        return result;
    }

private:
    static constexpr int most_nodes = 1000;

    std::optional<double> of_parameter(const std::string& name) {
        for (const Parameter& parameter : scene_.parameters)
            if (parameter.name.text == name && parameter.value) return of(*parameter.value.tree);
        return std::nullopt;
    }

    const Scene& scene_;
    int nodes_ = 0;
};

}  // namespace

std::optional<double> plain_number(const Expression& expression, const Scene& scene) {
    return expression ? PlainValue(scene).of(*expression.tree) : std::nullopt;
}

}  // namespace alembert
