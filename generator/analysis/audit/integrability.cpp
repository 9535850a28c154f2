// SPDX-License-Identifier: GPL-2.0-or-later
// The null fields X_f = ∂_f − Σ C_pf ∂_p of the rows in echelon form: their brackets, and those of the X_f with
// brackets, have only pivot components. Left-normed brackets span all others, and brackets of one that is a
// combination of earlier ones are combinations too.
#include "analysis/audit/integrability.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "alembert/base/tolerances.hpp"
#include "analysis/exact/null_fields.hpp"
#include "analysis/exact/variety.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/lower.hpp"
#include "program/reduce_rows.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int few = 3, many = 16;  // numbers of points; the larger one is used if the smaller one gives no bound
constexpr double surely = -60;
constexpr int largest_program = 500000;

/// d³F/dt³ of every input, for which the mechanism has no symbol. Inputs may depend on each other.
std::vector<ex> third_derivatives(const Mechanism& m) {
    GiNaC::exmap known;
    for (const Mechanism::Input& input : m.inputs) known[input.derivative[0]] = m.z->expand(input.value);
    std::vector<ex> result;
    for (const Mechanism::Input& input : m.inputs) {
        ex value = input.derivative[0];
        for (std::size_t round = 0; round < m.inputs.size(); ++round)
            value = value.subs(known, GiNaC::subs_options::no_pattern);
        value = m.z->name(value);
        for (int order = 0; order < 3; ++order) value = m.z->push_forward({value}, {{m.t, 1}})[0];
        result.push_back(value);
    }
    return result;
}

using Rows = std::vector<std::vector<Prime>>;

int rank_of(Rows rows) {
    const std::size_t columns = rows.empty() ? 0 : rows[0].size();
    return reduce_rows(rows, columns);
}

class Closure {
public:
    Closure(const std::vector<OneForm>& forms, const Mechanism& m, const std::vector<ex>& positions,
            const std::vector<State<double>>& states, const IntegrabilityOptions& options, int points)
        : forms_(forms),
          m_(m),
          states_(states),
          options_(options),
          points_(points),
          size_(m.q.size() + 1),
          third_(third_derivatives(m)) {
        std::vector<ex> flat;
        for (const OneForm& form : forms) flat.insert(flat.end(), form.begin(), form.end());
        if (options.fixed) flat = with_constants(flat);
        entries_ = lower_expressions(program_, m, flat);
        const std::vector<int> zeros =
            lower_expressions(program_, m, options.fixed ? with_constants(positions) : positions);
        std::map<std::pair<Variable::Kind, int>, Prime> given;
        if (options.fixed)
            for (int k = 0; const Mechanism::Parameter& p : m.parameters)
                if (p.independent)
                    given[{Variable::Kind::parameter, k++}] =
                        Prime::from(cln::the<cln::cl_RA>(p.number().to_cl_N())).value_or(0);
        variety_ = variety_points(program_, zeros, entries_, points_, given);
        result_.on_variety = variety_.on_variety;
        result_.integrable.resize(forms.size());
    }

    /// With what is no fraction in place of the parameters that have it: the cosine of π/2 is zero then.
    std::vector<ex> with_constants(const std::vector<ex>& list) const {
        GiNaC::exmap constants;
        for (const Mechanism::Parameter& p : m_.parameters)
            if (p.independent && !GiNaC::is_a<GiNaC::numeric>(p.value)) constants[p.symbol] = p.value;
        return constants.empty() ? list : substitute(*m_.z, list, constants);
    }

    Integrability go() {
        if (static_cast<int>(variety_.points.size()) < points_)
            return undecided(say("no points were found where all roots exist"));
        values_ = evaluate(entries_);
        if (values_.empty()) return undecided(say("no points were found where all roots exist"));
        find_independent();
        if (!result_.contradictory.empty())
            return undecided(
                say("no rates obey all constraints, but where a relation between coordinates and time holds"));
        if (!find_fields()) return undecided(say("the points are unusable"));
        if (!close()) return undecided(say("the brackets grow beyond what is evaluated"));
        decide();
        return std::move(result_);
    }

private:
    Integrability undecided(std::string reason) {
        result_.reason = std::move(reason);
        return std::move(result_);
    }

    /// The values of the nodes at every point; empty if a point became unusable.
    std::vector<std::vector<Prime>> evaluate(const std::vector<int>& nodes) {
        std::vector<std::vector<Prime>> result;
        double failure = 0, largest = 1;
        for (const ModularPoint& point : variety_.points) {
            const auto at = evaluate_mod(program_, point, nodes);
            if (!at) return {};
            result_.exact = result_.exact && at->exact;
            result.emplace_back();
            for (const int node : nodes) {
                result.back().push_back(at->value[node]);
                largest = std::max(largest, at->degree[node]);
            }
            failure += at->conditions + variety_.conditions - 61;
        }
        degree_ = std::max(degree_, largest * variety_.degree);
        conditions_ = std::max(conditions_, failure + 61.0 * points_);
        return result;
    }

    Prime entry(int point, std::size_t form, std::size_t variable) const {
        return values_[point][form * size_ + variable];
    }

    /// Finds the forms whose row raises the rank at some point.
    void find_independent() {
        std::vector<Rows> rates(points_), all(points_);
        std::vector<std::size_t> order;
        for (const bool exact : {true, false})
            for (std::size_t k = 0; k < forms_.size(); ++k)
                if ((!options_.exact.empty() && options_.exact[k]) == exact) order.push_back(k);
        for (const std::size_t k : order) {
            bool raises = false, raises_all = false;
            for (int p = 0; p < points_; ++p) {
                std::vector<Prime> row;
                for (std::size_t i = 0; i < size_; ++i) row.push_back(entry(p, k, i));
                all[p].push_back(row);
                row.pop_back();
                rates[p].push_back(row);
                raises = raises || rank_of(rates[p]) == static_cast<int>(rates[p].size());
                raises_all = raises_all || rank_of(all[p]) == static_cast<int>(all[p].size());
            }
            const auto& known = options_.redundant;
            if (!result_.on_variety && std::find(known.begin(), known.end(), static_cast<int>(k)) != known.end())
                raises = raises_all = false;
            if (raises) {
                result_.independent.push_back(static_cast<int>(k));
                continue;
            }
            if (raises_all) result_.contradictory.push_back(static_cast<int>(k));
            for (int p = 0; p < points_; ++p) {
                rates[p].pop_back();
                all[p].pop_back();
            }
        }
    }

    bool find_fields() {
        std::vector<OneForm> rows;
        std::vector<Rows> value(points_);
        for (const int k : result_.independent) {
            rows.push_back(forms_[k]);
            for (int p = 0; p < points_; ++p) {
                value[p].emplace_back();
                for (std::size_t i = 0; i < size_; ++i) value[p].back().push_back(entry(p, k, i));
            }
        }
        auto found = null_fields(std::move(rows), std::move(value), *m_.z);
        if (!found) return false;
        fields_ = std::move(found->fields);
        pivots_ = std::move(found->pivots);
        return true;
    }

    /// Σ rate_k ∂/∂variable_k; inputs move with t.
    std::vector<ex> along(const std::vector<ex>& values, const std::vector<ex>& rates) const {
        Intermediates::Direction direction;
        for (std::size_t k = 0; k < m_.q.size(); ++k)
            if (!rates[k].is_zero()) direction.emplace_back(m_.q[k], rates[k]);
        if (const ex& clock = rates.back(); !clock.is_zero()) {
            direction.emplace_back(m_.t, clock);
            for (std::size_t k = 0; k < m_.inputs.size(); ++k) {
                const auto& F = m_.inputs[k].derivative;
                direction.insert(direction.end(),
                                 {{F[0], F[1] * clock}, {F[1], F[2] * clock}, {F[2], third_[k] * clock}});
            }
        }
        return m_.z->push_forward(values, direction);
    }

    std::vector<ex> bracket(const std::vector<ex>& X, const std::vector<ex>& Y) const {
        const std::vector<ex> first = along(Y, X), second = along(X, Y);
        std::vector<ex> result(size_, 0);
        for (const std::size_t p : pivots_) result[p] = m_.z->name(first[p] - second[p]);
        return result;
    }

    /// Adds brackets until no further one raises the rank, which is at most the number of forms that are not
    /// exact; false if they grow too large. Brackets are made in small groups, so that few unnecessary ones are
    /// made.
    bool close() {
        std::size_t lot = 2;
        for (const int k : result_.independent) most_ += options_.exact.empty() || !options_.exact[k] ? 1 : 0;
        std::vector<std::vector<ex>> last = fields_, lots;
        kept_.assign(points_, {});
        for (bool first = true; !last.empty(); first = false) {
            std::vector<std::vector<ex>> raising;
            const auto flush = [&] {
                if (!keep(lots)) return false;
                raising.insert(raising.end(), lots.begin(), lots.end());
                lots.clear();
                lot = std::min<std::size_t>(2 * lot, 64);
                return true;
            };
            for (std::size_t b = 0; b < last.size(); ++b)
                for (std::size_t a = 0; a < (first ? b : fields_.size()) && kept_nodes_.size() < most_; ++a) {
                    std::vector<ex> Z = bracket(fields_[a], last[b]);
                    if (std::any_of(Z.begin(), Z.end(), [](const ex& e) { return !e.is_zero(); }))
                        lots.push_back(std::move(Z));
                    if (lots.size() == lot && !flush()) return false;
                }
            if (!flush()) return false;
            last = std::move(raising);
        }
        return true;
    }

    /// Keeps in the list the brackets that are no combinations of those kept before; false if they are too large
    /// to decide.
    bool keep(std::vector<std::vector<ex>>& brackets) {
        std::vector<ex> flat;
        for (const std::vector<ex>& Z : brackets) flat.insert(flat.end(), Z.begin(), Z.end());
        const std::vector<int> nodes = lower_expressions(program_, m_, flat);
        if (program_.size() > largest_program) return false;
        const auto at = evaluate(nodes);
        if (at.empty()) return false;
        std::vector<std::vector<ex>> raising;
        for (std::size_t b = 0; b < brackets.size() && kept_nodes_.size() < most_; ++b) {
            const auto begin = static_cast<std::ptrdiff_t>(b * size_),
                       end = begin + static_cast<std::ptrdiff_t>(size_);
            bool raises = false;
            for (int p = 0; p < points_; ++p) {
                kept_[p].emplace_back(at[p].begin() + begin, at[p].begin() + end);
                raises = raises || rank_of(kept_[p]) == static_cast<int>(kept_nodes_.size()) + 1;
            }
            if (raises) {
                kept_nodes_.emplace_back(nodes.begin() + begin, nodes.begin() + end);
                raising.push_back(brackets[b]);
            } else {
                for (Rows& rows : kept_) rows.pop_back();
            }
        }
        brackets = std::move(raising);
        return true;
    }

    void decide() {
        // A determinant with at most as many rows as there are forms, plus one for a bracket.
        const double failure =
            points_ * (std::log2(2 * degree_ * static_cast<double>(pivots_.size() + 1)) - 61) + conditions_;
        const bool certain = result_.exact && result_.on_variety;
        if (certain || independent_in_numbers())
            result_.integrals = static_cast<int>(pivots_.size() - kept_nodes_.size());
        for (std::size_t k = 0; k < forms_.size(); ++k) {
            bool zero = true;
            for (int p = 0; p < points_; ++p)
                for (const std::vector<Prime>& Y : kept_[p]) zero = zero && pairing(p, k, Y).is_zero();
            const bool known = !options_.exact.empty() && options_.exact[k];
            if (zero && !known) result_.failure = failure;
            if (zero && (known || failure <= surely))
                result_.integrable[k] = true;
            else if (!zero && (certain || seen_in_numbers(k)))
                result_.integrable[k] = false;
            else if (!zero)
                result_.reason =
                    say("it is not integrable outside the surface of the holonomic constraints; on the surface "
                        "nothing is proved");
            else
                result_.reason = say("the forms are of too high a degree for a bound on the failure of sampling");
        }
        if (kept_nodes_.size() < most_ && result_.failure == 0.0)
            result_.failure = failure;  // the bound for the number of integrals
        find_combinations();
    }

    Prime pairing(int p, std::size_t k, const std::vector<Prime>& Y) const {
        Prime sum = 0;
        for (std::size_t i = 0; i < size_; ++i) sum += entry(p, k, i) * Y[i];
        return sum;
    }

    /// Are the brackets independent at some state, beyond rounding?
    bool independent_in_numbers() const {
        if (kept_nodes_.empty()) return true;
        return std::any_of(states_.begin(), states_.end(), [&](const State<double>& state) {
            const std::vector<double> value = interpret(program_, state);
            Eigen::MatrixXd Y(static_cast<Eigen::Index>(kept_nodes_.size()), static_cast<Eigen::Index>(size_));
            for (Eigen::Index b = 0; b < Y.rows(); ++b)
                for (Eigen::Index i = 0; i < Y.cols(); ++i) Y(b, i) = value[kept_nodes_[b][i]];
            if (!Y.allFinite()) return false;
            Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposed(Y);
            decomposed.setThreshold(tolerance::surely_not_zero);
            return decomposed.rank() == Y.rows() && decomposed.maxPivot() > tolerance::surely_not_zero;
        });
    }

    /// Is w_k(Y) beyond rounding at some state?
    bool seen_in_numbers(std::size_t k) const {
        for (const State<double>& state : states_) {
            const std::vector<double> value = interpret(program_, state);
            for (const std::vector<int>& Y : kept_nodes_) {
                double sum = 0, size = 0, largest = 0;
                for (std::size_t i = 0; i < size_; ++i) {
                    const double term = value[entries_[k * size_ + i]] * value[Y[i]];
                    sum += term;
                    size += std::abs(term);
                    largest = std::max(largest, std::abs(value[Y[i]]));
                }
                if (std::isfinite(sum) && std::abs(sum) > tolerance::surely_not_zero * size &&
                    largest > tolerance::surely_not_zero)
                    return true;
            }
        }
        return false;
    }

    /// Finds constant coefficients c with Σ c_k w_k(Y) = 0 for all brackets Y. The echelon form is then the same
    /// at all points, and its numbers are small.
    void find_combinations() {
        std::vector<std::size_t> unfit;
        for (const int k : result_.independent)
            if (result_.integrable[k] == false) unfit.push_back(k);
        if (unfit.size() < 2 || !result_.on_variety || kept_[0].empty()) return;
        std::vector<Rows> forms(points_);
        for (int p = 0; p < points_; ++p) {
            for (const std::vector<Prime>& Y : kept_[p]) {
                forms[p].emplace_back();
                for (const std::size_t k : unfit) forms[p].back().push_back(pairing(p, k, Y));
            }
            reduce_rows(forms[p], unfit.size());
        }
        // The combination of each form that is no pivot is w_j − Σ (entries) w_pivot. It exists if its column is
        // constant.
        std::vector<std::size_t> pivot;
        for (const std::vector<Prime>& row : forms[0])
            for (std::size_t j = 0; j < unfit.size(); ++j)
                if (!row[j].is_zero()) {
                    pivot.push_back(j);
                    break;
                }
        for (std::size_t j = 0; j < unfit.size(); ++j) {
            if (std::find(pivot.begin(), pivot.end(), j) != pivot.end()) continue;
            std::vector<GiNaC::numeric> combination(forms_.size(), 0);
            combination[unfit[j]] = 1;
            bool constant = true;
            for (std::size_t r = 0; r < pivot.size() && constant; ++r) {
                for (int p = 1; p < points_; ++p) constant = constant && forms[p][r][j] == forms[0][r][j];
                const auto c = small_rational(forms[0][r][j]);
                constant = constant && c;
                if (constant) combination[unfit[pivot[r]]] = -*c;
            }
            if (constant) result_.combinations.push_back(combination);
        }
    }

    static std::optional<GiNaC::numeric> small_rational(Prime value) {
        for (int below = 1; below <= 12; ++below)
            for (const int sign : {1, -1})
                if (const Prime above = value * below * sign; above.bits() <= 144)
                    return GiNaC::numeric(sign * static_cast<long>(above.bits()), below);
        return std::nullopt;
    }

    const std::vector<OneForm>& forms_;
    const Mechanism& m_;
    const std::vector<State<double>>& states_;
    const IntegrabilityOptions& options_;
    int points_;
    std::size_t size_;       ///< n + 1
    std::vector<ex> third_;  ///< derivatives of the inputs
    Program program_;
    std::vector<int> entries_;
    Variety variety_;
    std::vector<std::vector<Prime>> values_;  ///< values of the entries at every point
    std::vector<std::size_t> pivots_;
    std::vector<std::vector<ex>> fields_;
    std::vector<Rows> kept_;  ///< the brackets that raised the rank, at every point
    std::vector<std::vector<int>> kept_nodes_;
    std::size_t most_ = 0;  ///< the most brackets that can be independent
    double degree_ = 1, conditions_ = 0;
    Integrability result_;
};

}  // namespace

std::vector<OneForm> forms_of(const Mechanism& m) {
    std::vector<OneForm> result;
    for (const Mechanism::Constraint& c : m.constraints) {
        OneForm form = c.row;
        form.push_back(c.offset);
        result.push_back(form);
    }
    return result;
}

Integrability integrability(const std::vector<OneForm>& forms, const Mechanism& mechanism,
                            const std::vector<ex>& positions, const std::vector<State<double>>& states,
                            const IntegrabilityOptions& options) {
    if (forms.empty()) return {};
    Integrability result = Closure(forms, mechanism, positions, states, options, few).go();
    return result.failure <= surely ? result : Closure(forms, mechanism, positions, states, options, many).go();
}

}  // namespace alembert
