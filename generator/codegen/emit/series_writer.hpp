// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes the C++ of Taylor coefficients: names for the packs and lanes of series_lanes.hpp, and the statements of
/// order 0 and of order k.
///
///     SeriesWriter writer(recurrences, lanes);
///     writer.order_zero();      // first coefficients, factors of the linear system
///     writer.schedule();        // when each coefficient of order k is ready
///     writer.chain();           // the coefficients of order k
///     writer.prepare();         // last: the constants that all of these have asked for
///
/// series_names.cpp gives names and places; series_start.cpp writes order 0, series_order.cpp the statements of
/// order k, series_values.cpp the values in them, series_text.cpp the terms of these values.

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "codegen/emit/names.hpp"
#include "codegen/emit/series_times.hpp"
#include "codegen/emit/statement.hpp"

namespace alembert {

class SeriesWriter {
public:
    /// Both must outlive this object.
    SeriesWriter(const Recurrences& recurrences, const SeriesLanes& lanes);

    std::vector<CodeStatement> order_zero();
    void schedule();
    std::vector<CodeStatement> given() const;
    std::vector<std::string> gathering();
    std::vector<CodeStatement> chain();
    /// With `is_straight` all orders are straight-line code, and rows are stored as vectors.
    std::vector<CodeStatement> storing(bool is_straight) const;
    std::vector<std::string> ones() const;
    std::vector<std::string> edges() const;
    std::vector<std::string> last() const;
    std::string rates_at_zero() const;

    /// The work space: a row for each order of some arrays, and single rows.
    struct Arrays {
        std::vector<std::string> lines;
        std::size_t columns = 0, single = 0;
    };
    Arrays arrays() const;

    std::vector<std::string> prepare();
    const std::vector<int>& constants() const {
        return constants_;
    }  ///< the constants of the Program, in the order of `par`
    int width() const { return n_ + s_ + (r_.work >= 0 ? 1 : 0); }

private:
    struct NodeNames {
        std::string now, first;  ///< the coefficient of this order, and that of order 0
        std::string rate;        ///< k times the coefficient of this order; empty if not needed
        std::string inverse;     ///< the inverse of the first coefficient
    };
    struct PackNames {
        std::string column = {}, rates = {},
                    inverse = {};               ///< arrays [order][padded]; rates and inverse only if needed
        std::vector<std::string> sums = {};     ///< the sum of each product
        std::vector<std::string> weights = {};  ///< the weights of each term, if the lanes have different ones
    };
    struct EdgeNames {
        std::string one,
            before;  ///< the coefficient of order 1, with the factor of its rate, and that of the order before
    };
    /// How the text of a value names its arguments: for one node, or for all lanes from l on.
    struct View {
        std::function<CodeExpression(int)> now, first, inverse;
        std::function<Piece(std::size_t term, const Weight&, const CodeExpression&)> piece;
        CodeExpression sums;
    };

    int size() const { return static_cast<int>(r_.nodes.size()); }
    const SeriesNode& node(int id) const { return r_.nodes[id]; }
    const SeriesPack& pack_of(int id) const { return lanes_.packs()[lanes_.pack(id)]; }

    void name_nodes();
    void name_packs();
    void name_lanes();
    std::string speed_name(int i) const;

    std::string constant(int node);
    Piece term(const Weight& weight, const CodeExpression& factor);
    Piece piece(const Weight& weight, const CodeExpression& factor);
    CodeExpression number(const Weight& weight);
    CodeExpression now(int id) const;
    CodeExpression first(int id) const;
    CodeExpression inner_sum(const SeriesProduct& product) const;
    CodeExpression sums_of(int id);
    View view(int id);
    View view_of_pack(int number);

    CodeExpression power_at_zero(const Weight& exponent, const CodeExpression& base);
    CodeExpression value_at_zero(int id, const View& view);
    bool is_vector_at_zero(const SeriesPack& pack) const;
    void add_pack_at_zero(std::vector<CodeStatement>& lines, int number);
    bool add_ready_at_zero(std::vector<CodeStatement>& lines, std::vector<char>& done, bool solved);
    void add_sines(std::vector<CodeStatement>& lines, const std::vector<int>& pairs);
    std::string statement_at_zero(int id);
    void add_inverses(std::vector<CodeStatement>& lines);
    std::vector<CodeStatement> solution_at_zero();
    std::string solve_call(const std::function<std::string(int)>& name) const;

    CodeExpression value(int id, const View& view);
    SumParts sum_parts(int id);
    CodeExpression value_alone(int id);
    std::vector<int> needed_now(int id) const;
    bool is_ready(int id, const std::vector<char>& done, bool solved) const;
    void add_coefficients(std::vector<CodeStatement>& lines, int id);
    void add_what_products_need(std::vector<CodeStatement>& lines) const;
    static CodeStatement over_lanes(const SeriesPack& pack, const CodeExpression& to, const CodeExpression& value);
    void add_copy(std::vector<CodeStatement>& lines, int number, bool at_zero) const;
    std::set<int> copies_needed_now(const SeriesPack& pack) const;

    const Recurrences& r_;
    const Program& p_;
    const SeriesLanes& lanes_;
    int n_, s_;
    Names names_;
    std::vector<NodeNames> names_of_;  // of each node
    std::vector<PackNames> packs_;     // the names of each pack
    std::map<int, EdgeNames> edges_;   // names for the factors of lanes, if sums have edges
    std::vector<int> constants_;
    std::map<int, ScheduledSum> sums_;  // the sums of nodes outside packs, if sums have edges
    Times times_;
};

}  // namespace alembert
