// SPDX-License-Identifier: GPL-2.0-or-later
// Weights, coefficients and constants as C++.
#include <fmt/format.h>

#include <algorithm>

#include "codegen/emit/numbers.hpp"
#include "codegen/emit/series_writer.hpp"

namespace alembert {

using Kind = SeriesNode::Kind;

std::string SeriesWriter::constant(int id) {
    const Node& x = p_[id];
    if (x.op == Op::variable) return fmt::format("par[{}]", x.variable.index);
    if (x.is_number()) return exact_text(x.number);
    auto place = std::find(constants_.begin(), constants_.end(), id);
    if (place == constants_.end()) place = constants_.insert(constants_.end(), id);
    return fmt::format("par[{}]", p_.parameters.size() + static_cast<std::size_t>(place - constants_.begin()));
}

/// A term of a sum: a weight times a factor, or the factor alone if the weight is 1.
Piece SeriesWriter::term(const Weight& weight, const CodeExpression& factor) {
    const Rational size = cln::abs(weight.number);
    CodeExpression value;
    if (!cln::equal(size, 1)) value = exact_text(size);
    if (weight.constant >= 0) value = value * constant(weight.constant);
    return {cln::minusp(weight.number), value * factor};
}

Piece SeriesWriter::piece(const Weight& weight, const CodeExpression& factor) {
    Piece result = term(weight, factor);
    if (result.value.is_one()) result.value = "Real(1)";
    return result;
}

CodeExpression SeriesWriter::number(const Weight& weight) {
    return joined({piece(weight, {})});
}

CodeExpression SeriesWriter::now(int id) const {
    if (!lanes_.is_packed(id)) return names_of_[id].now;
    return {fmt::format("{}[{} * k + {}]", packs_[lanes_.pack(id)].column, pack_of(id).padded(), lanes_.lane(id)),
            2};
}

CodeExpression SeriesWriter::first(int id) const {
    if (!lanes_.is_packed(id)) return names_of_[id].first;
    return {fmt::format("{}[{}]", packs_[lanes_.pack(id)].column, lanes_.lane(id))};
}

/// The sum of a product over orders below k, without its ends if these are added one by one.
CodeExpression SeriesWriter::inner_sum(const SeriesProduct& product) const {
    return fmt::format("gathered[{}]", lanes_.number_of(product));
}

CodeExpression SeriesWriter::sums_of(int id) {
    if (lanes_.products(id).empty() || lanes_.is_packed(id)) return {};
    std::vector<Piece> pieces;
    for (const SeriesProduct& product : lanes_.products(id))
        pieces.push_back(piece(product.weight, inner_sum(product)));
    return bracketed(joined(pieces));
}

SeriesWriter::View SeriesWriter::view(int id) {
    return {.now = [this](int arg) { return now(arg); },
            .first = [this](int arg) { return first(arg); },
            .inverse = [this](int arg) { return names_of_[arg].inverse; },
            .piece = [this](std::size_t, const Weight& weight,
                            const CodeExpression& factor) { return piece(weight, factor); },
            .sums = sums_of(id)};
}

SeriesWriter::View SeriesWriter::view_of_pack(int number) {
    const SeriesPack& pack = lanes_.packs()[number];
    const PackNames& own = packs_[number];
    const auto source = [this, &pack](int arg) { return lanes_.source_of(pack, arg); };
    const auto weighed = [this, &own](std::size_t term, const Weight& weight,
                                      const CodeExpression& factor) -> Piece {
        if (own.weights[term].empty()) return piece(weight, factor);
        return {false, CodeExpression(fmt::format("loaded({} + l)", own.weights[term]), 1) * factor};
    };
    const SeriesNode& x = node(pack.nodes[0]);
    std::vector<Piece> sums;
    for (std::size_t t = 0; t < own.sums.size(); ++t)
        sums.push_back(weighed(x.linear.size() + x.bilinear.size() + t, lanes_.products(pack.nodes[0])[t].weight,
                               {fmt::format("loaded({} + l)", own.sums[t]), 1}));
    return {.now = [this, source](int arg) -> CodeExpression {
                return {fmt::format("loaded({} + {} * k + l)", packs_[source(arg)].column,
                                    lanes_.packs()[source(arg)].padded()),
                        3};
            },
            .first = [this, source](int arg) -> CodeExpression {
                return {fmt::format("loaded({} + l)", packs_[source(arg)].column), 1};
            },
            .inverse = [this, source](int arg) -> CodeExpression {
                return {fmt::format("loaded({} + l)", packs_[source(arg)].inverse), 1};
            },
            .piece = weighed,
            .sums = sums.empty() ? CodeExpression() : bracketed(joined(sums))};
}

std::vector<std::string> SeriesWriter::prepare() {
    std::vector<std::string> lines;
    std::map<int, std::string> known;
    const auto text = [&](int id) -> std::string {
        const Node& x = p_[id];
        if (x.op == Op::variable) return fmt::format("par[{}]", x.variable.index);
        if (x.is_number()) return exact_text(x.number);
        if (x.op == Op::pi)
            return "(Real(3.141592653589793) + Real(1.2246467991473532e-16) + Real(-2.9947698097183397e-33))";
        return known.at(id);
    };
    for (const int id : p_.needed(constants_)) {
        const Node& x = p_[id];
        if (x.args.empty()) continue;
        std::string value;
        if (x.op == Op::sum) {
            std::vector<Piece> pieces;
            for (std::size_t k = 0; k < x.args.size(); ++k) {
                const Rational size = cln::abs(x.coefficients[k]);
                pieces.push_back({cln::minusp(x.coefficients[k]),
                                  (cln::equal(size, 1) ? "" : exact_text(size) + " * ") + text(x.args[k])});
            }
            if (!cln::zerop(x.number)) pieces.push_back({cln::minusp(x.number), exact_text(cln::abs(x.number))});
            value = joined(pieces).text;
        } else if (x.op == Op::product) {
            std::string above, below;
            for (std::size_t k = 0; k < x.args.size(); ++k)
                for (int e = 0; e < std::abs(x.exponents[k]); ++e)
                    (x.exponents[k] > 0 ? above : below) += (x.exponents[k] < 0 ? " / "
                                                             : above.empty()    ? ""
                                                                                : " * ") +
                                                            text(x.args[k]);
            value = (above.empty() ? "Real(1)" : above) + below;
        } else {
            value = std::string(name_of(x.op)) + "(" + text(x.args[0]) +
                    (x.args.size() > 1 ? ", " + text(x.args[1]) : "") + ")";
        }
        known[id] = names_.numbered("c");
        lines.push_back(fmt::format("const Real {} = {};", known[id], value));
    }
    for (std::size_t k = 0; k < constants_.size(); ++k)
        lines.push_back(fmt::format("par[{}] = {};", p_.parameters.size() + k, text(constants_[k])));
    return lines;
}

}  // namespace alembert
