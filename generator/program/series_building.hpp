// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Converts the nodes of a Program to the recurrences of recurrence.hpp.
///
///     SeriesBuilding(program, false).direct();        // accelerations as the nodes that the Program has for them
///     SeriesBuilding(program, false).implicit();      // accelerations from M u' = f, order by order
///
/// A sum stays a form, without a node, as long as its terms can be merged with those of another sum.
/// recurrence.cpp has the two ways, series_products.cpp forms and products, series_functions.cpp powers and
/// functions.

#include <map>
#include <optional>

#include "program/recurrence.hpp"

namespace alembert {

/// A value that has not been given a node: constants + Σ w x + Σ w a⊗b.
struct SeriesForm {
    std::vector<Weight> constants;
    std::vector<SeriesNode::Linear> linear;
    std::vector<SeriesNode::Bilinear> bilinear;
    bool is_constant() const { return linear.empty() && bilinear.empty(); }
    bool is_node() const { return constants.empty() && bilinear.empty() && linear.size() == 1; }
};

/// A factor times a node.
struct ScaledNode {
    Weight weight;
    int node;
};

class SeriesBuilding {
public:
    SeriesBuilding(const Program& program, bool with_work) {
        result_.program = program;
        if (with_work) power_ = program.nodes_of(Group::power).at(0);
    }

    Recurrences direct();
    Recurrences implicit();

private:
    Program& p() { return result_.program; }
    std::vector<SeriesNode>& nodes() { return result_.nodes; }

    int add(SeriesNode node);
    void remember(int id, int node, const Rational& factor);

    /// Counts uses and makes the nodes of the state.
    void begin(std::vector<int> roots);
    Recurrences finished();
    SeriesEntry entry(const SeriesForm& f);

    /// f − Σ_{j≥1} M_j u'_{k−j} of row i.
    SeriesNode residual(const SeriesForm& f, int i);
    int constant_product(int a, int b, int exponent_of_b);

    /// The weight number·constant, whose node may have become a number or a multiple of another node.
    Weight tidy(Rational number, int constant);
    Weight times(const Weight& a, const Weight& b);
    Weight over(const Weight& a, const Weight& b);
    void add_to(SeriesForm& sum, const Weight& weight, const SeriesForm& f);
    SeriesForm of(int node, const Weight& weight = {}) {
        return {.constants = {}, .linear = {{weight, node}}, .bilinear = {}};
    }

    /// The node of a form, with its factor taken out.
    ScaledNode scaled(const SeriesForm& f);
    int node_of(const SeriesForm& f);

    /// The form of a Program's node; it gets a node of its own if it is used more than once and is more than a
    /// multiple of another node.
    SeriesForm form(int id);
    SeriesForm made(int id);
    int variable(const Variable& v);
    SeriesForm product(const Node& node);
    SeriesForm assembled(Weight weight, const std::vector<int>& factors, const std::vector<ScaledNode>& divisors);

    /// Collects the factors of factors and the arguments of their roots, each with its exponent, in `exponents`.
    void flatten(int id, const Rational& exponent, std::map<int, Rational>& exponents) const;

    /// A product with a root whose exponent exceeds 1, as in r^(-3): it gets one recurrence instead of a quotient
    /// for each r. Nothing if there is no such root.
    std::optional<SeriesForm> product_with_roots(int id);
    int power_of(int base, const Rational& exponent);

    /// The divisor of a quotient. It is used as often as its reciprocal, which its own count of uses does not
    /// show.
    ScaledNode divisor(int id);
    int quotient(const SeriesForm& numerator, int divisor);
    int with(SeriesNode::Kind kind, int a, int w = -1, Op op = Op::number) {
        return add({.kind = kind, .a = a, .w = w, .op = op});
    }

    /// 1 + sign·x².
    int one_and_square(int x, int sign) {
        return add({.kind = SeriesNode::Kind::sum, .constants = {{}}, .bilinear = {{{sign, -1}, x, x}}});
    }

    /// A function with z' = a'·w, where w depends on z: makes the function's node, then that of its w.
    int area(int a, int sign, Op op);

    /// The nodes of sine and cosine; the recurrence of each needs both.
    int pair(int a, bool hyperbolic, bool second);
    SeriesForm function(const Node& node);
    int arc(int a) {
        return with(SeriesNode::Kind::ratio, a, with(SeriesNode::Kind::root, one_and_square(a, -1)), Op::asin);
    }

    SeriesForm power(const Node& node);

    struct Less {
        bool operator()(const Variable& a, const Variable& b) const {
            return std::pair(a.kind, a.index) < std::pair(b.kind, b.index);
        }
    };

    Recurrences result_;
    int power_ = -1, time_ = -1;
    std::map<int, int> uses_;
    std::map<int, SeriesForm> forms_;
    std::map<int, ScaledNode> divisors_;
    std::map<Variable, int, Less> given_;
    std::map<std::pair<int, int>, int> products_, quotients_;
    std::map<std::pair<int, bool>, int> pairs_;
    struct Smaller {
        bool operator()(const std::pair<int, Rational>& a, const std::pair<int, Rational>& b) const {
            return a.first != b.first ? a.first < b.first : a.second < b.second;
        }
    };
    std::map<std::pair<int, Rational>, int, Smaller> powers_;
};

}  // namespace alembert
