// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Intermediate symbols (Autolev's Z): every value that is more than an atom gets a symbol of its own, so that no
/// expression grows beyond a line and every derivative is computed once.
///
///     Intermediates z(symbols);
///     const ex x = z.name(l1*sin(theta1) + l2*sin(theta2));       // a symbol; its definition is recorded
///     const std::vector<ex> p = z.pull_back({{T, 1}}, qdot);      // ∂T/∂q', reverse mode: one pass for all
///     const std::vector<ex> M0 = z.push_forward(p, {{qdot[0], 1}});   // column of ∂p/∂q', forward mode
///
/// A definition is either one function of atoms (sin, sqrt, …, a power that is not whole) or a polynomial,
/// possibly with negative whole powers, in atoms; an atom is a number, a symbol, or a number times a symbol. Equal
/// expressions get the same symbol. Definitions refer to earlier ones only.
///
/// Reverse and forward differentiation on the resulting graph: Griewank & Walther, Evaluating Derivatives (2008),
/// chapter 3. Without intermediate symbols the derivation of a chain of 32 rods has 4·10²⁰ tree nodes.

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "algebra/symbolic/symbols.hpp"

#include "base/language/say.hpp"

namespace alembert {

class Intermediates {
public:
    /// `symbols` must outlive this table.
    explicit Intermediates(Symbols& symbols) : symbols_(&symbols) {}

    /// What an intermediate symbol stands for.
    struct Entry {
        GiNaC::symbol symbol;
        GiNaC::ex definition;
        std::vector<GiNaC::symbol> uses;  ///< symbols in the definition, by rank
        std::vector<int>
            sources;  ///< sorted indices into `source_labels`: the parts of the mechanism from which it comes
        double tree_size = 1;  ///< number of nodes if all intermediates were substituted
    };

    /// The atom that stands for `e`: `e` itself if it is one. Functions inside `e` get symbols of their own.
    GiNaC::ex name(const GiNaC::ex& e);

    /// Adds the entries of another table of the same scene that this one does not have, so that expressions in the
    /// symbols of either can be used with this one.
    void adopt(const Intermediates& other);

    /// Replaces the definitions for which `by` gives something, a polynomial in the same atoms.
    void redefine(const std::function<std::optional<GiNaC::ex>(const GiNaC::ex& definition)>& by);

    /// Sets the source of all symbols that are named from now on ("body M2", "spring 1"); returns the index of the
    /// former label.
    int set_source(const std::string& label);
    void restore_source(int index) { current_source_ = index; }
    const std::vector<std::string>& source_labels() const { return labels_; }

    /// Σ_k adjoint_k · ∂target_k/∂wrt_i for every i (the adjoints are not differentiated).
    std::vector<GiNaC::ex> pull_back(const std::vector<std::pair<GiNaC::ex, GiNaC::ex>>& targets,
                                     const std::vector<GiNaC::symbol>& wrt);

    /// A direction of differentiation: the derivative of each base symbol that is not constant along it.
    using Direction = std::vector<std::pair<GiNaC::symbol, GiNaC::ex>>;

    /// The derivative of each of `values` along `direction`.
    std::vector<GiNaC::ex> push_forward(const std::vector<GiNaC::ex>& values, const Direction& direction);

    /// The entry of an intermediate symbol, or null for any other.
    const Entry* find(const GiNaC::symbol& symbol) const;
    const std::vector<Entry>& entries() const { return entries_; }

    /// `e` with all intermediate symbols replaced by what they stand for. Check `tree_size` first.
    GiNaC::ex expand(const GiNaC::ex& e) const;
    double tree_size(const GiNaC::ex& e) const;

    /// Does `e` depend on any of `on`, through its definitions?
    bool depends(const GiNaC::ex& e, const std::vector<GiNaC::symbol>& on) const;

    const Symbols& symbols() const { return *symbols_; }

private:
    /// The derivatives along a direction that are known already. Scenes of hundreds of points are differentiated
    /// point by point.
    struct Flow {
        Direction direction = {};
        std::map<unsigned, GiNaC::ex> dot = {};  // symbol hash → its derivative, if that is not 0
        std::set<std::size_t> done = {};         // entries that have been differentiated
    };
    int source_of(const std::string& label);
    Flow& flow_along(const Direction& direction);
    GiNaC::ex name_whole(const GiNaC::ex& e);
    GiNaC::ex flatten(const GiNaC::ex& e);
    GiNaC::ex partial(const Entry& entry, const GiNaC::symbol& by);
    GiNaC::ex weighted_partial(const GiNaC::ex& weight, const Entry& entry, const GiNaC::symbol& by);
    std::optional<GiNaC::ex> without_factor(const GiNaC::ex& e, const GiNaC::symbol& factor,
                                            const GiNaC::numeric& power);
    std::vector<std::size_t> reachable(const std::vector<GiNaC::ex>& roots) const;
    std::vector<GiNaC::symbol> symbols_in(const GiNaC::ex& e) const;

    Symbols* symbols_;
    std::vector<Entry> entries_;
    std::map<unsigned, std::size_t> position_;                   // symbol hash → entry
    std::map<GiNaC::ex, GiNaC::ex, GiNaC::ex_is_less> known_;    // definition → symbol
    std::map<std::pair<std::size_t, int>, GiNaC::ex> partials_;  // (entry, rank) → ∂definition/∂symbol
    std::vector<std::string> labels_{say("the scene")};
    Flow last_flow_;
    int current_source_ = 0;
};

/// Sets the source label for a scope.
class SourceScope {
public:
    SourceScope(Intermediates& z, const std::string& label) : z_(z), former_(z.set_source(label)) {}
    ~SourceScope() { z_.restore_source(former_); }
    SourceScope(const SourceScope&) = delete;
    SourceScope& operator=(const SourceScope&) = delete;

private:
    Intermediates& z_;
    int former_;
};

}  // namespace alembert
