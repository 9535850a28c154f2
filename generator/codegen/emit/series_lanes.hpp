// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Decides which products of Taylor coefficients are computed side by side.
///
///     const SeriesLanes lanes(recurrences);
///     lanes.packs();       // nodes of the same shape: one vector operation for all of them at each order
///     lanes.lanes();       // products of all other nodes: only the sums over lower orders side by side
///
/// This file makes no text; names and C++ are made in series_writer.hpp.

#include <map>
#include <vector>

#include "program/processor.hpp"
#include "program/recurrence.hpp"

namespace alembert {

/// A Cauchy product in the sum of a node; with a rate, the coefficient of order j is multiplied by j.
struct SeriesProduct {
    Weight weight;
    int a, b;
    bool a_rate = false, b_rate = false;
    bool weighed = false;  ///< the sum of a power, Σ (α(k−j) − j) a_{k−j} z_j
    bool is_square() const { return a == b && a_rate == b_rate; }
};

/// The two factors in one lane.
struct SeriesLane {
    int a, b;
    bool a_rate, b_rate;
    auto operator<=>(const SeriesLane&) const = default;
};

/// Nodes of the same shape whose arguments are in lanes of the same order.
struct SeriesPack {
    std::vector<int> nodes;
    int number = -1;        ///< the position in the order in which packs were arranged
    bool by_lanes = false;  ///< whether each lane is computed separately, or copied from elsewhere
    bool is_copy = false;
    bool needs_rates = false;
    std::map<int, int> sources = {};  ///< argument of the first lane → pack that has all lanes' arguments
    std::vector<std::vector<Weight>> weights = {};  ///< the weights of linear and bilinear terms, then of
                                                    ///< products; empty if they are the same in all lanes
    std::size_t padded() const {
        return (nodes.size() + processor::lanes - 1) / processor::lanes * processor::lanes;
    }
};

/// The properties that must be equal for two nodes to be lanes of one pack.
struct SeriesShape {
    std::vector<int> numbers;
    Weight exponent;
};

/// The nodes whose coefficients of the same order a coefficient needs.
std::vector<int> arguments_of(const SeriesNode& node);

/// The node by whose first coefficient a node is divided; −1 if there is none.
int divisor_of(const Recurrences& recurrences, int id);

class SeriesLanes {
public:
    /// The recurrences must outlive this object. Without packs, all products are lanes.
    explicit SeriesLanes(const Recurrences& recurrences, bool with_packs = true);

    const std::vector<SeriesProduct>& products(int id) const { return products_[id]; }
    const std::vector<SeriesPack>& packs() const { return packs_; }
    bool is_packed(int id) const { return place_[id].pack >= 0; }
    int pack(int id) const { return place_[id].pack; }
    int lane(int id) const { return place_[id].lane; }  ///< the lane in its pack
    /// The pack that has the lanes of an argument; `arg` is the argument of the first lane.
    int source_of(const SeriesPack& pack, int arg) const;

    const std::vector<SeriesLane>& lanes() const { return lanes_; }
    int number_of(const SeriesProduct& product) const { return numbers_.at(lane_of(product)); }
    static SeriesLane lane_of(const SeriesProduct& product);
    std::size_t padded() const {
        return (lanes_.size() + processor::lanes - 1) / processor::lanes * processor::lanes;
    }
    /// Whether the first and the last term of each sum are added one by one. The coefficients of the order before
    /// then need not be read back from memory.
    bool has_edges() const { return lanes_.size() <= processor::most_edges; }
    /// Whether the product of order and coefficient is a factor somewhere.
    bool needs_rate(int id) const { return rate_needed_[id] != 0; }

    /// The number of multiplications of eight lanes in all sums of products, divided by the square of the order.
    double products_eight_wide() const;

private:
    struct Place {
        int pack = -1, lane = 0;
    };

    int size() const { return static_cast<int>(r_.nodes.size()); }
    const SeriesNode& node(int id) const { return r_.nodes[id]; }
    std::vector<SeriesProduct> products_of(int id) const;
    void find_lanes();
    SeriesShape shape(int id) const;
    std::vector<int> positions(int id) const;
    bool can_be_packed(int id) const;
    void find_levels();
    std::vector<std::vector<int>> parts_of(const std::vector<int>& group) const;
    void find_packs();
    bool follow(const std::vector<int>& leader, std::vector<int>& part) const;
    int add_pack(const std::vector<int>& nodes);
    void arrange(int number);
    int pack_of(const std::vector<int>& list, bool is_linear);
    void find_weights(SeriesPack& pack);

    const Recurrences& r_;
    std::vector<std::vector<SeriesProduct>> products_;  // the products in the sum of each node
    std::vector<SeriesPack> packs_;
    std::vector<Place> place_;  // of each node
    std::vector<int> levels_;
    int numbered_ = 0;
    std::map<SeriesLane, int> numbers_;
    std::vector<SeriesLane> lanes_;
    std::vector<char> rate_needed_;
};

}  // namespace alembert
