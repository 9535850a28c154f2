// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which columns of a torque regressor Y depend on which, exactly: the reduced row echelon form of Y at random
/// states, modulo 2⁶¹ − 1.
///
///     const RegressorColumns columns(regressor, order, mechanism);
///     const auto d = columns.dependence(parameters);
///     d->pivots.size();               // the rank
///
/// With constraints, Y π = τ + Aᵀλ with multipliers that are not measured. What motion and loads show is Nᵀ Y π =
/// Nᵀ τ, where the columns of N span the motions that A q' = 0 allows. The states are then random points of f(q,
/// t) = 0 (analysis/exact/motions.hpp) with A q' + b = 0 and A q'' = γ.

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "program/lower/regressor.hpp"
#include "program/modular.hpp"

namespace alembert {

class Motions;

struct ColumnDependence {
    std::vector<std::size_t> pivots;       ///< places in the order
    std::vector<std::vector<Prime>> rows;  ///< one for each pivot
};

/// A coefficient: the entry of the echelon form in the row of a pivot and the column of a dependent one.
struct DependentEntry {
    std::size_t row, column;
};
std::vector<DependentEntry> entries_of(const ColumnDependence& d);

class RegressorColumns {
public:
    /// The columns in `order`. The regressor must outlive this. Throws ModelError for constraints without exact
    /// states.
    RegressorColumns(const Regressor& y, std::vector<std::size_t> order, const Mechanism& mechanism);

    /// At random states, with these values of parameters; nothing if too many points are unusable.
    std::optional<ColumnDependence> dependence(const std::vector<Prime>& parameters) const;
    /// The parameters on which Y and the constraints depend.
    std::vector<int> used_parameters() const;

    /// The constraints of the mechanism, as nodes.
    struct Constraints {
        Program program;
        std::vector<int> positions;        ///< f(q, t) of those that are holonomic
        std::vector<Eigen::Index> row_of;  ///< the row of each of these
        std::vector<int> rows;             ///< A, by rows
        std::vector<int> offset, gamma;    ///< of A q' + offset = 0 and A q'' = gamma
    };
    const Constraints& constraints() const { return c_; }

private:
    using Rows = std::vector<std::vector<Prime>>;
    using Given = std::map<std::pair<Variable::Kind, int>, Prime>;
    ModularPoint free_point(const Given& parameters, std::uint64_t state) const;
    std::vector<ModularPoint> states(const Given& parameters, std::size_t count) const;
    bool move(ModularPoint& point, Rows& free_motions) const;

    const Program& p_;
    std::vector<int> nodes_;
    std::vector<std::size_t> order_;
    int halves_;
    Constraints c_;
    std::shared_ptr<const Motions> motions_;  // with constraints
};

}  // namespace alembert
