// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The symbols of one scene: GiNaC symbols and their meaning, in the order of their declaration.
///
/// GiNaC's own order of terms changes from run to run; everything that is printed or emitted is ordered by
/// `info(s).rank` instead.

#include <ginac/ginac.h>

#include <string>
#include <unordered_map>
#include <vector>

namespace alembert {

struct SymbolInfo {
    enum class Kind {
        time,
        parameter,
        input,       ///< a given function of time; order counts its derivatives
        coordinate,  ///< order 0: q, 1: q', 2: q''
        speed,       ///< a generalized speed; order 0: u, 1: u'
        state,       ///< a first-order state; order 0: z, 1: z', 2: z''
        definition,  ///< a name of the scene's [definitions], kept as a symbol
        function,    ///< a function of the scene's [functions]; stands only in its calls (unspecified.hpp)
        other,       ///< multipliers, claim unknowns, intermediate symbols
    };
    std::string name;  ///< as the user wrote it, without primes
    Kind kind = Kind::other;
    int index = 0;              ///< position among its kind
    int order = 0;              ///< number of primes
    int rank = 0;               ///< position among all symbols of the scene
    bool before = false;        ///< x'(-), a rate before an impact; of kind `other`
    bool intermediate = false;  ///< stands for an expression (Intermediates); of kind `other`

    /// The name and its primes, as a user would type them.
    std::string text() const {
        return name + std::string(static_cast<std::size_t>(order), '\'') + (before ? "(-)" : "");
    }
};

class Symbols {
public:
    /// Declares a new symbol. Its rank is the number of symbols declared before.
    GiNaC::symbol declare(std::string name, SymbolInfo::Kind kind, int index = 0, int order = 0);
    /// Declares z0, z1 …, the symbol of the expression at this position in a table of intermediate symbols.
    GiNaC::symbol declare_intermediate(int index);
    /// Declares x'(-) for the coordinate x.
    GiNaC::symbol declare_rate_before(const GiNaC::symbol& coordinate);

    /// Throws std::out_of_range for a symbol that was not declared here.
    const SymbolInfo& info(const GiNaC::symbol& symbol) const;

    /// The functions of [functions], by their index.
    const std::vector<GiNaC::symbol>& functions() const { return functions_; }

    /// All symbols by rank.
    const std::vector<GiNaC::symbol>& all() const { return by_rank_; }

    /// Expressions in these symbols with the short forms that were found for them, which takes long for some, as
    /// formalisms meet the same ones several times.
    GiNaC::exmap short_forms;

private:
    std::vector<GiNaC::symbol> by_rank_, functions_;
    std::vector<SymbolInfo> infos_;
    std::unordered_map<unsigned, std::size_t>
        position_;  // the key is gethash(), which corresponds one to one to a symbol's serial number
};

}  // namespace alembert
