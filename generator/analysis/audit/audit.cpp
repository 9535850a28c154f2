// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/audit/audit.hpp"

#include "analysis/audit/description_poses.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "analysis/audit/integral.hpp"
#include "analysis/audit/tied_rows.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/branch.hpp"
#include "analysis/state/contradiction.hpp"
#include "analysis/state/force_balance.hpp"
#include "analysis/state/redundancy.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/formalism/routh.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_states = 6;
constexpr std::size_t most_special = 12;  // for more constraints, the effect of special parameters is not examined

std::string quoted(const Mechanism& m, const std::vector<int>& which) {
    std::vector<std::string> names;
    for (const int k : which) names.push_back("'" + m.constraints[k].name + "'");
    if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
    const std::string last = names.back();
    names.pop_back();
    return say("{} and {}", fmt::join(names, ", "), last);
}

class Auditing {
public:
    explicit Auditing(const Mechanism& m) : m_(m), n_(m.size()), forms_(forms_of(m)) {}

    Audit go() {
        result_.degrees_of_freedom = n_;
        const Start start = start_of(m_);
        result_.start = start.state();
        result_.integrals = 0;
        if (m_.constraints.empty()) return std::move(result_);
        for (const Mechanism::Constraint& c : m_.constraints)
            result_.constraints.push_back({.name = c.name,
                                           .holonomic = c.holonomic,
                                           .rheonomic = is_rheonomic(c),
                                           .integrable = {},
                                           .alone = {},
                                           .integral = {},
                                           .notes = {}});
        settle(start);
        if (settled_)
            for (const Start& place : places_on_branch(m_, lower_constraints(m_), settled_start_, most_states, 1))
                states_.push_back(place.state());
        else
            states_ = states_that_obey(m_, start, most_states);
        if (states_.empty() && settled_) states_.push_back(settled_start_.state());
        if (states_.empty()) contradiction(start);
        rank(start);
        joint();
        sources_of_redundancy();
        alone();
        integrals();
        poses();
        remarks();
        return std::move(result_);
    }

private:
    std::vector<GiNaC::symbol> clock() const { return m_.clock(); }

    bool is_rheonomic(const Mechanism::Constraint& c) const {
        std::vector<ex> values = c.row;
        if (c.position)
            values = {*c.position};
        else
            values.push_back(c.offset);
        if (std::none_of(values.begin(), values.end(), [&](const ex& e) { return m_.z->depends(e, clock()); }))
            return false;
        const std::vector<ex> rates = m_.explicit_time_derivative(values);
        return std::any_of(rates.begin(), rates.end(), [&](const ex& e) { return vanishes(e, m_) != true; });
    }

    /// Computes the residuals at the start, after an adjustment of the guesses if that succeeds.
    void settle(const Start& start) {
        const Program program = lower_constraints(m_);
        Start moved = start;
        try {
            assemble(moved, m_, program, {});
            settled_ = true;
            settled_start_ = moved;
            result_.start = moved.state();
            for (int i = 0; i < n_; ++i) {
                const auto note = [&](const std::string& name, double from, double to) {
                    if (std::abs(to - from) > 1e-15 * std::max(1.0, std::abs(from)))
                        result_.adjusted.push_back({name, from, to});
                };
                note(m_.q[i].get_name(), start.q[i], moved.q[i]);
                note(m_.q[i].get_name() + "'", start.qdot[i], moved.qdot[i]);
            }
        } catch (const ModelError& e) {
            result_.problem = e.what();
            result_.wrong = true;
        } catch (const IntegrationError& e) {
            result_.problem = e.what();
        }
        const std::vector<double> value = interpret(program, result_.start);
        const std::vector<int> position = program.nodes_of(Group::position),
                               velocity = program.nodes_of(Group::velocity);
        for (std::size_t k = 0; k < position.size(); ++k)
            result_.constraints[k].residual = {value[position[k]], value[velocity[k]]};
    }

    Mechanism only(int k) const { return with_constraints(m_, {k}); }

    void contradiction(const Start& start) {
        const std::vector<int> clash = contradictory_constraints(m_, start);
        const std::string names = quoted(m_, clash);
        std::vector<OneForm> forms;
        for (const int k : clash) forms.push_back(forms_[k]);
        const bool dependent =
            integrability(forms, m_, {}, {}, {.exact = std::vector<bool>(clash.size(), true)}).independent.size() <
            clash.size();
        result_.wrong = true;
        result_.problem =
            clash.size() == 1
                ? say("constraint {} cannot be obeyed: no state that does was found from {} places", names,
                      places_tried)
                : say("constraints {} contradict each other: {}no state that obeys {} was found from {} places; "
                      "remove or correct one of them",
                      names, dependent ? say("they constrain the same rates differently; ") : "",
                      clash.size() == 2 ? say("both") : say("all"), places_tried);
        if (std::all_of(clash.begin(), clash.end(), [&](int k) { return m_.constraints[k].joint.has_value(); })) {
            std::vector<std::string> joints;
            for (const int k : clash) {
                const std::string& joint = m_.joints[static_cast<std::size_t>(*m_.constraints[k].joint)].name;
                if (std::find(joints.begin(), joints.end(), joint) == joints.end()) joints.push_back(joint);
            }
            result_.problem =
                say("joint{} '{}' cannot close {}: {}", joints.size() == 1 ? "" : "s", fmt::join(joints, "', '"),
                    joints.size() == 1 ? say("its loop") : say("their loops"), result_.problem);
        }
        result_.contradictory = clash;
        contradictory_ = true;
    }

    Mechanism starting_at(const State<double>& from) const {
        Mechanism at = m_;
        for (int i = 0; i < n_ && !settled_; ++i) {
            at.q_start[i] = GiNaC::numeric(cln::rational(cln::cl_DF(from.q[i])));
            at.qdot_start[i] = GiNaC::numeric(cln::rational(cln::cl_DF(from.qdot[i])));
            at.q_is_guess[i] = at.qdot_is_guess[i] = true;
        }
        return at;
    }

    void rank(const Start& start) {
        redundant_ = redundant_constraints(starting_at(states_.empty() ? start.state() : states_[0]));
        count();
    }

    /// Whether rows are independent that are so by far, though not in exact arithmetic: its states lie on another
    /// branch of the constraints, as where the scene's own needs √3.
    bool is_exact_elsewhere() const {
        constexpr double by_far = 1e-5;
        if (states_.empty()) return false;
        const std::size_t surely =
            m_.constraints.size() - redundant_constraints(starting_at(states_[0]), by_far).size();
        return joint_.independent.size() < surely;
    }

    void count() {
        for (AuditedConstraint& c : result_.constraints) c.redundant = false;
        for (const int k : redundant_) result_.constraints[k].redundant = true;
        result_.rank = static_cast<int>(m_.constraints.size() - redundant_.size());
        result_.degrees_of_freedom = n_ - result_.rank;
    }

    /// Whether the constraint, which is redundant, is tied to those that are kept (tied_rows.hpp).
    bool is_tied(int k) {
        if (!kept_) kept_ = with_tied_rows(without_constraints(m_, redundant_));
        return kept_
            ->redundant[m_.redundant.size() +
                        static_cast<std::size_t>(std::find(redundant_.begin(), redundant_.end(), k) -
                                                 redundant_.begin())]
            .tie.has_value();
    }

    void sources_of_redundancy() {
        for (const int k : redundant_) {
            if (std::find(joint_.contradictory.begin(), joint_.contradictory.end(), k) !=
                joint_.contradictory.end())
                continue;
            const std::vector<int> from = follows_from(m_, k, redundant_, states_);
            if (!from.empty())
                result_.constraints[k].notes.push_back(
                    is_tied(k)
                        ? say("follows from {} at most poses; the solution for the motion takes all of them, as "
                              "each is needed at some pose",
                              quoted(m_, from))
                        : say("follows from {}; the equations of motion leave it out", quoted(m_, from)));
        }
    }

    std::vector<ex> positions() const {
        std::vector<ex> result;
        for (std::size_t k = 0; k < m_.constraints.size(); ++k)
            if (m_.constraints[k].position && !result_.constraints[k].redundant)
                result.push_back(*m_.constraints[k].position);
        return result;
    }

    void joint() {
        std::vector<bool> exact;
        for (const Mechanism::Constraint& c : m_.constraints) exact.push_back(c.holonomic);
        joint_ = integrability(forms_, m_, positions(), states_, {.exact = exact, .redundant = redundant_});
        result_.failure = joint_.failure;
        result_.integrals = joint_.integrals;
        const bool has_fewer =
            joint_.on_variety && !contradictory_ && static_cast<int>(joint_.independent.size()) < result_.rank;
        if (has_fewer && is_exact_elsewhere()) {
            result_.notes.push_back(
                say("the rank is {} on another branch of the constraints, and {} on the scene's",
                    joint_.independent.size(), result_.rank));
            joint_.on_variety = false;
            joint_.contradictory.clear();
            joint_.integrable.clear();
            result_.integrals.reset();
            if (std::all_of(m_.constraints.begin(), m_.constraints.end(),
                            [](const auto& c) { return c.holonomic; }))
                result_.integrals = result_.rank;
        } else if (has_fewer) {
            // Rounding may leave a small rest of a row that is exactly zero.
            redundant_.clear();
            for (int k = 0; k < static_cast<int>(m_.constraints.size()); ++k)
                if (std::find(joint_.independent.begin(), joint_.independent.end(), k) == joint_.independent.end())
                    redundant_.push_back(k);
            count();
        }
        result_.exact_rank = joint_.on_variety && static_cast<int>(joint_.independent.size()) == result_.rank;
        if (joint_.on_variety) result_.generic_rank = static_cast<int>(joint_.independent.size());
        if (contradictory_) {
            // Rank and redundancy are those of exact arithmetic, because there is no state.
            result_.rank = static_cast<int>(joint_.independent.size());
            result_.degrees_of_freedom = n_ - result_.rank;
            for (AuditedConstraint& c : result_.constraints) c.redundant = false;
            redundant_.clear();
        } else if (joint_.on_variety && static_cast<int>(joint_.independent.size()) > result_.rank) {
            result_.notes.push_back(
                say("the rank is {} for general parameters or on another branch of the constraints, and {} at the "
                    "scene's",
                    joint_.independent.size(), result_.rank));
            // Each of independent holonomic constraints keeps one function.
            if (std::all_of(m_.constraints.begin(), m_.constraints.end(),
                            [](const auto& c) { return c.holonomic; }))
                result_.integrals = result_.rank;
        }
        for (const int k : joint_.contradictory)
            if (!contradictory_)
                result_.constraints[k].notes.push_back(say(
                    "its rates are a combination of those of the others, the rest is not: together they force a "
                    "relation between coordinates and time that no constraint states"));
        for (std::size_t k = 0; k < m_.constraints.size(); ++k) {
            AuditedConstraint& c = result_.constraints[k];
            c.integrable = c.holonomic                 ? std::optional(true)
                           : joint_.integrable.empty() ? std::nullopt
                                                       : joint_.integrable[k];
        }
        const bool any = std::any_of(result_.constraints.begin(), result_.constraints.end(),
                                     [](const auto& c) { return c.integrable == false; });
        if (!any || m_.constraints.size() > most_special) return;
        const Integrability fixed = integrability(forms_, m_, positions(), states_,
                                                  {.fixed = true, .exact = exact, .redundant = redundant_});
        for (std::size_t k = 0; k < m_.constraints.size() && fixed.on_variety; ++k)
            if (result_.constraints[k].integrable == false && fixed.integrable[k] == true)
                result_.constraints[k].notes.push_back(
                    say("it is integrable for the scene's parameters, but not for general ones"));
    }

    void alone() {
        for (std::size_t k = 0; k < m_.constraints.size(); ++k) {
            AuditedConstraint& c = result_.constraints[k];
            c.alone = c.holonomic || m_.constraints.size() == 1
                          ? c.integrable
                          : integrability({forms_[k]}, m_, {},
                                          states_that_obey(only(static_cast<int>(k)), start_of(m_), 3))
                                .integrable[0];
        }
    }

    std::optional<Phrase> phrase(const ex& e) const {
        const auto f = fourier(e, *m_.symbols, 400);
        if (!f || f->size() == 0) return std::nullopt;
        const Rational sign = f->terms()[0].coefficient < 0 ? -1 : 1;
        return readable((sign / content(f->polynomial())) * *f);
    }

    void integrals() {
        std::vector<int> frozen;
        for (const OneForm& form : forms_) {
            std::vector<int> moving;
            for (int i = 0; i <= n_; ++i)
                if (!form[i].is_zero() && vanishes(form[i], m_) != true) moving.push_back(i);
            if (moving.size() == 1 && moving[0] < n_) frozen.push_back(moving[0]);
        }
        for (std::size_t k = 0; k < m_.constraints.size(); ++k) {
            AuditedConstraint& c = result_.constraints[k];
            if (c.holonomic || c.integrable == false) continue;
            std::optional<ex> F = integral_of(forms_[k], m_);
            if (F && !c.alone) c.alone = true;
            if (!F && c.alone == false) F = integral_of(forms_[k], m_, frozen);
            if (!F) continue;
            c.integrable = true;
            c.integral = phrase(*F);
        }
        for (std::vector<GiNaC::numeric> combination : joint_.combinations) {
            const auto leading =
                std::find_if(combination.begin(), combination.end(), [](const auto& c) { return !c.is_zero(); });
            if (*leading < 0)
                for (GiNaC::numeric& c : combination) c = -c;
            OneForm form(static_cast<std::size_t>(n_) + 1, 0);
            std::string name;
            for (std::size_t k = 0; k < combination.size(); ++k) {
                const GiNaC::numeric& c = combination[k];
                if (c.is_zero()) continue;
                for (int i = 0; i <= n_; ++i) form[i] += c * m_.z->expand(forms_[k][i]);
                const GiNaC::numeric size = abs(c);
                name += fmt::format(
                    "{}{}'{}'",
                    c < 0          ? (name.empty() ? "-" : " - ")
                    : name.empty() ? ""
                                   : " + ",
                    size == 1 ? ""
                              : fmt::format("{}{}*", size.numer().to_int(),
                                            size.denom() == 1 ? "" : fmt::format("/{}", size.denom().to_int())),
                    m_.constraints[k].name);
            }
            const auto F = integral_of(form, m_, frozen);
            result_.combinations.emplace_back(name, F ? phrase(*F) : std::nullopt);
        }
    }

    void poses() {
        if (!settled_) return;
        std::vector<int> kept;
        for (int k = 0; k < static_cast<int>(m_.constraints.size()); ++k)
            if (!result_.constraints[k].redundant) kept.push_back(k);
        const Mechanism independent = kept_ ? *kept_ : with_tied_rows(without_constraints(m_, redundant_));
        result_.singular_poses = singular_poses(independent, result_.start, states_);
        for (SingularPose& pose : result_.singular_poses)
            for (int& k : pose.among) k = kept[k];
    }

    void remarks() {
        for (const Mechanism::Constraint& c : m_.redundant)
            if (c.nearly)
                result_.notes.push_back(
                    say("{}: follows from the others but for {:.2g} of its size, as rounded numbers leave it; the "
                        "equations of motion leave it out",
                        c.name, *c.nearly));
        for (std::size_t k = 0; k < m_.constraints.size(); ++k) {
            AuditedConstraint& c = result_.constraints[k];
            const Mechanism::Constraint& given = m_.constraints[k];
            const bool flat = std::all_of(given.row.begin(), given.row.end(),
                                          [&](const ex& e) { return vanishes(e, m_) == true; });
            if (!given.squared_in.empty())
                c.notes.push_back(
                    say("added: its square stands in a combination of {}, which only touch", given.squared_in));
            if (flat) {
                c.notes.push_back(c.holonomic
                                      ? say("it does not depend on any coordinate: it holds always or never")
                                      : say("its coefficients of the rates are all zero"));
                continue;
            }
            if (c.holonomic && gradient_vanishes(k)) {
                c.redundant = false;
                c.notes.push_back(
                    say("its gradient is zero wherever it holds, as that of a square is: write it without the "
                        "square"));
            }
            if (!c.integrable && !joint_.reason.empty())
                c.notes.push_back(say("undecided whether it is integrable: {}", joint_.reason));
            if (c.holonomic || c.integrable != true) continue;
            c.notes.push_back(say("declared nonholonomic, but it is integrable{}: {}",
                                  c.alone == true ? "" : say(" together with the others"),
                                  c.integral ? say("{} is constant", text(*c.integral))
                                             : say("some function of the coordinates is constant")));
        }
    }

    /// Compares rows at states that obey the constraint with rows at states close to these.
    bool gradient_vanishes(std::size_t k) const {
        const Mechanism one = only(static_cast<int>(k));
        const Program program = lower_constraints(one);
        const auto size = [&](const State<double>& state) {
            const std::vector<double> value = interpret(program, state);
            double sum = 0;
            for (const int id : program.nodes_of(Group::row)) sum += std::abs(value[id]);
            return sum;
        };
        for (State<double> state : states_) {
            const double on = size(state);
            for (double& q : state.q) q += 0.1;
            if (!(on < 1e-4 * size(state))) return false;
        }
        return !states_.empty();
    }

    const Mechanism& m_;
    int n_;
    std::vector<OneForm> forms_;
    bool settled_ = false, contradictory_ = false;
    Start settled_start_;
    std::vector<State<double>> states_;
    std::vector<int> redundant_;
    std::optional<Mechanism> kept_;  ///< without those that are redundant
    Integrability joint_;
    Audit result_;
};

}  // namespace

Audit audit_of(const Mechanism& mechanism) {
    if (!constraints_are_open(mechanism)) {
        const Mechanism own = with_own_intermediates(mechanism);
        return Auditing(own).go();
    }
    const Mechanism sampled = with_sample_functions(mechanism);
    Audit result = Auditing(sampled).go();
    result.start = start_of(mechanism).state();
    result.adjusted.clear();
    result.singular_poses.clear();
    for (AuditedConstraint& c : result.constraints) {
        c.residual = {std::nan(""), std::nan("")};
        c.integral.reset();
    }
    result.notes.push_back(say(
        "[functions] leaves functions in the constraints open: ranks and integrability are those with functions "
        "chosen at random in their place, and whether the initial state obeys the constraints is unknown"));
    return result;
}

Audited audit(Scene scene) {
    Audited result{prepared(std::move(scene))};
    result.audit = audit_of(result.mechanism);
    result.audit.description_poses = description_poses(result.mechanism, result.audit.start);
    for (const Mechanism::Rolling& rolling : result.mechanism.rollings)
        if (rolling.is_along)
            result.audit.notes.push_back(
                say("{0}: its rows and multipliers are along the axes of {1}, where none is lost at a regular "
                    "pose; along N they depend on each other with factors that change with the pose",
                    rolling.name, rolling.axes));
    constexpr int most_coordinates = 40;
    if (result.mechanism.size() > 0 && result.mechanism.size() <= most_coordinates)
        result.warn(warnings_of_unresisted(result.scene, result.mechanism, routh(result.mechanism)));
    return result;
}

}  // namespace alembert
