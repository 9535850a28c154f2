// SPDX-License-Identifier: GPL-2.0-or-later
// A claim r(q, q', q'', λ, t) = 0 is right if r vanishes on every motion. An identity of degree d that is false
// holds at a random point of GF(p) with a chance of at most d/p (Schwartz, J. ACM 27 (1980) 701).
#include "check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>

#include "check/absent.hpp"
#include "check/claims.hpp"
#include "check/counterexample.hpp"
#include "check/dimensions.hpp"
#include "check/multiple.hpp"
#include "check/nearest.hpp"
#include "check/open_rows.hpp"
#include "check/root_form.hpp"
#include "check/slip.hpp"
#include "check/static_combination.hpp"
#include "exact/exact_states.hpp"
#include "formalism/rest.hpp"
#include "formalism/routh.hpp"
#include "model/energy.hpp"
#include "model/translate.hpp"
#include "notation/readable.hpp"
#include "notation/text.hpp"
#include "symbolic/fourier.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

constexpr double wanted_failure = -60;
constexpr int states_of_rest = 48;
constexpr std::size_t most_states = 1200;

class Checker {
public:
    Checker(const Scene& scene, const Mechanism& m, const Equations& e, const std::shared_ptr<RootSheets>& sheets,
            const std::string& by)
        : scene_(scene), m_(m), e_(e), claims_(scene, m, e, sheets, by), sheets_(sheets) {}

    Checked run() {
        read();
        result_.claims.resize(forms_.size());
        for (const char* const when : {"motion", "rest", "impact"}) {
            when_ = when;
            std::vector<std::size_t> here;
            for (std::size_t k = 0; k < forms_.size(); ++k)
                if (scene_.claims[k].at == when_) here.push_back(k);
            if (here.empty()) continue;
            if (when_ == "impact" && !claims_.after_impact())
                for (const std::size_t k : here) result_.claims[k].reason = claims_.impact_obstacle();
            else  // the rates after an impact are expressions by now, in what any state of motion gives
                while (!here.empty()) {
                    const std::vector<std::size_t> spoken = undetermined_in(here.front());
                    std::vector<std::size_t> part = here;
                    std::erase_if(part, [&](std::size_t k) { return undetermined_in(k) != spoken; });
                    std::erase_if(here, [&](std::size_t k) { return undetermined_in(k) == spoken; });
                    law_ = with_multipliers(spoken);
                    spoken_ = spoken;
                    settle(part, when_ == "rest" ? Motions::At::rest : Motions::At::motion);
                }
        }
        for (CheckedClaim& c : result_.claims)
            for (const ex& positive : positive_) c.where.insert(c.where.begin(), inequality(positive));
        result_.complete = complete();
        return std::move(result_);
    }

private:
    void read() {
        std::vector<Diagnostic> mistakes;
        for (const Claim& claim : scene_.claims) try {
                forms_.push_back(claims_.read(claim));
            } catch (const SceneMistake& mistake) {
                mistakes.push_back(mistake.diagnostic);
            }
        if (!mistakes.empty()) fail(scene_, mistakes);
        if (sheets_) positive_ = sheets_->positive();
    }

    /// Which of m_.undetermined() the claim speaks of. With a contact's multiplier it holds whatever that is,
    /// without it speaks of the motion while the gap is open. Constraints that follow from others bear their least
    /// share.
    std::vector<std::size_t> undetermined_in(std::size_t claim) const {
        std::vector<std::size_t> result;
        const auto all = m_.undetermined();
        for (std::size_t k = 0; k < all.size(); ++k)
            if (k >= m_.unilateral.size() || m_.z->depends(forms_[claim].residual, {all[k]->multiplier}))
                result.push_back(k);
        return result;
    }

    Equations with_multipliers(const std::vector<std::size_t>& undetermined) const {
        Equations law = e_;
        for (const std::size_t k : undetermined) {
            const Mechanism::Constraint& c = *m_.undetermined()[k];
            for (int i = 0; i < law.size(); ++i) law.own[i] += c.row[i] * c.multiplier;
        }
        return law;
    }

    /// What is a combination of the equations and constraints needs no state that obeys the constraints, which may
    /// be hard to find; gives those that are none.
    std::vector<std::size_t> without_combinations(const std::vector<std::size_t>& here, Motions::At at) {
        if (!m_.redundant.empty()) return here;  // which share each bears is decided on the constraints only
        std::vector<std::size_t> left = here;
        if (at == Motions::At::rest) {
            std::erase_if(left, [&](std::size_t k) {
                if (!forms_[k].open.empty()) return false;
                const std::optional<double> failure = static_combination(claims_, law_, forms_[k].residual);
                if (failure) prove(k, *failure);
                return failure.has_value();
            });
            return left;
        }
        std::optional<ExactStates> states;
        Program p;
        std::vector<int> roots;
        std::vector<std::pair<std::size_t, double>> found;
        for (const std::size_t k : here) {
            if (!forms_[k].open.empty()) continue;
            const int root = claims_.lower(p, {forms_[k].residual})[0];
            if (p.is_zero(root)) continue;
            if (!states) states.emplace(m_, law_, at, 0, halvings_in(here), Motions::Positions::free);
            double failure = 0;
            bool exact = true;
            if (vanishes_at(*states, p, root, failure, exact) != std::optional(true)) continue;
            found.emplace_back(k, failure);
            roots.push_back(root);
        }
        if (found.empty()) return left;
        const std::vector<bool> holds = hold_in_numbers(states->motions, p, roots);
        for (std::size_t i = 0; i < found.size(); ++i)
            if (holds[i]) {
                prove(found[i].first, found[i].second);
                std::erase(left, found[i].first);
            }
        return left;
    }

    void prove(std::size_t k, double failure) {
        CheckedClaim& c = result_.claims[k];
        c.verdict = Verdict::proved;
        c.failure = failure;
        c.normal_form = when_ == "motion" && is_multiple(forms_[k].residual, m_, law_);
    }

    int halvings_in(const std::vector<std::size_t>& here) const {
        int result = 0;
        for (const std::size_t k : here) {
            Program p;
            result = std::max(result, halvings(p, claims_.lower(p, {forms_[k].residual})));
        }
        return result;
    }

    /// With holonomic constraints as they are at the pose where the scene starts: what of it is known in numbers
    /// only obeys them.
    Mechanism struck() {
        Mechanism result = m_;
        const GiNaC::exmap& pose = claims_.after_impact()->pose;
        for (auto* constraints : {&result.constraints, &result.redundant})
            for (Mechanism::Constraint& c : *constraints) {
                if (!c.position) continue;
                const ex here = m_.z->expand(*c.position).subs(pose, GiNaC::subs_options::no_pattern).expand();
                c.position = GiNaC::is_a<numeric>(here) ? std::nullopt : std::optional(m_.z->name(here));
            }
        return result;
    }

    void settle(const std::vector<std::size_t>& asked, Motions::At at) {
        const bool is_bound = std::any_of(m_.constraints.begin(), m_.constraints.end(),
                                          [](const Mechanism::Constraint& c) { return c.position.has_value(); });
        const bool may_combine = at == Motions::At::rest || (when_ == "motion" && is_bound);
        const std::vector<std::size_t> here = may_combine ? without_combinations(asked, at) : asked;
        if (here.empty()) return;
        // Angles in halves only where they occur: every halving doubles the degrees.
        const Mechanism mechanism = when_ == "impact" ? struck() : m_;
        std::optional<ExactStates> states;
        for (const int halves : {0, 1, 2}) {
            states.emplace(mechanism, law_, at, halves, halvings_in(here));
            const ExactState* const state = states->get(0);
            if (state == nullptr) continue;
            bool all = true;
            for (const std::size_t k : here) {
                Program p;
                const std::vector<int> root = claims_.lower(p, {forms_[k].residual});
                bool usable = false;
                for (std::size_t s = 0; s < 24 && !usable && states->get(s) != nullptr; ++s)
                    usable = evaluate_mod(p, states->get(s)->point, root).has_value();
                all = all && usable;
            }
            if (all) break;
        }
        if (states->get(0) == nullptr) {
            for (const std::size_t k : here) {
                CheckedClaim& c = result_.claims[k];
                c.reason = !states->motions.obstacle().empty() ? states->motions.obstacle()
                           : at == Motions::At::rest
                               ? "no state was found in which the equations allow rest"
                               : "no state was found that obeys the constraints and has one acceleration";
            }
            return;
        }
        std::vector<std::size_t> open;
        for (const std::size_t k : here)
            if (forms_[k].open.empty())
                settle_alone(k, *states);
            else if (states->motions.loose().empty())
                open.push_back(k);
            else
                result_.claims[k].reason =
                    "the constraints cannot be solved one after the other, and it leaves names open";
        settle_open(open, *states);
    }

    /// Is `residual` zero at all states? Nothing where that cannot be told. `failure`: log₂ of the chance of an
    /// error.
    std::optional<bool> vanishes_at(ExactStates& states, const Program& p, int root, double& failure,
                                    bool& exact) const {
        const std::array<int, 1> roots{root};
        failure = 0;
        double missed = 0;  // log₂ of the chance that no state was on some branch
        int usable = 0;
        const bool rest = states.motions.where() == Motions::At::rest;
        for (std::size_t s = 0;; ++s) {
            const ExactState* const state = states.get(s);
            if (state == nullptr || s > most_states)
                return usable > 0 && ((failure <= wanted_failure && missed <= wanted_failure) || rest)
                           ? std::optional(true)
                           : std::nullopt;
            const auto at = evaluate_mod(p, state->point, roots);
            if (!at) continue;
            ++usable;
            exact = exact && at->exact && state->exact;
            if (!at->value[root].is_zero()) return false;
            const double degree = std::max(1.0, at->degree[root]) * std::max(1.0, state->degree);
            const double chance = std::log2(degree) + at->conditions + state->conditions - 61;
            if (chance > -1) return std::nullopt;
            failure += chance;
            missed += miss(*state);
            if (failure <= wanted_failure && missed <= wanted_failure && (!rest || usable >= states_of_rest))
                return true;
        }
    }

    /// log₂ of the chance that a branch of the constraints is not the one of this state.
    static double miss(const ExactState& state) {
        return state.branches > 1 ? std::log2(1 - 1 / state.branches) : 2 * wanted_failure;
    }

    void settle_alone(std::size_t k, ExactStates& states) {
        CheckedClaim& c = result_.claims[k];
        Program p;
        const int root = claims_.lower(p, {forms_[k].residual})[0];
        if (p.is_zero(root)) {
            c.verdict = Verdict::proved;
            c.normal_form = true;
            if (when_ != "impact") c.reason = "it holds identically and says nothing of the motion";
            return;
        }
        bool exact = true;
        const std::optional<bool> zero = vanishes_at(states, p, root, c.failure, exact);
        if (!zero) {
            c.reason =
                "it could not be evaluated: it divides by something that is zero on every motion, or its degree "
                "is too high";
            return;
        }
        if (*zero) {
            if (!states.motions.loose().empty() && !hold_in_numbers(states.motions, p, {root})[0]) {
                c.reason =
                    "it holds wherever the constraints are constant, and no state was found at which they are "
                    "zero and the equations have one solution";
                return;
            }
            c.verdict = Verdict::proved;
            c.reason = told_of_shares(p, root, states);
            c.normal_form = (when_ == "motion" && is_multiple(forms_[k].residual, m_, law_)) ||
                            (when_ == "impact" && is_identically_zero(forms_[k].residual, m_));
            return;
        }
        if (const auto branch = branch_of(k, states)) {
            c.verdict = Verdict::proved;
            c.where = *branch;
            c.reason = "on the branch of the initial state";
            return;
        }
        const auto shown = counterexample(told(), states.motions, p, root);
        if (!shown) {  // exact arithmetic does not know every identity; nothing is called wrong without a state at
                       // which it fails
            c.reason = "it differs in exact arithmetic, and no state in numbers was found at which it fails";
            return;
        }
        show(c, *shown);
        refine(k, states);
    }

    /// A claim on constraints that depend on each other may hold for their least reactions alone.
    std::string told_of_shares(const Program& p, int root, ExactStates& states) const {
        for (std::size_t s = 0; s < 24 && states.get(s) != nullptr; ++s) {
            const std::optional<ModularPoint>& other = states.get(s)->other_shares;
            if (!other) return "";
            const auto at = evaluate_mod(p, *other, std::array<int, 1>{root});
            if (!at || at->value[root].is_zero()) continue;
            return "it holds for the least reactions of constraints that depend on each other; other reactions "
                   "with "
                   "the same effect would not obey it";
        }
        return "";
    }

    std::string inequality(const ex& positive) const {
        const auto f = fourier(positive, *m_.symbols);
        return (f ? text(readable(*f)) : "a root of the claim") + " > 0";
    }

    /// A claim with a root that holds for one of the root's signs at every state: that of the initial state's
    /// branch.
    std::optional<std::vector<std::string>> branch_of(std::size_t k, ExactStates& states) const {
        if (when_ != "motion") return std::nullopt;
        const std::optional<RootForm> form = root_form(forms_[k].residual, m_);
        if (!form) return std::nullopt;
        Program p;
        const int norm = claims_.lower(p, {form->norm})[0];
        double failure = 0;
        bool exact = true;
        if (!p.is_zero(norm) && vanishes_at(states, p, norm, failure, exact) != std::optional(true))
            return std::nullopt;
        if (!is_positive_at_start(form->root, claims_, e_)) return std::nullopt;
        return std::vector<std::string>{inequality(form->root)};
    }

    Told told() {
        return {.mechanism = m_,
                .equations = e_,
                .claims = claims_,
                .spoken = spoken_,
                .positive = positive_,
                .is_impact = when_ == "impact"};
    }

    static void show(CheckedClaim& c, const Counterexample& shown) {
        c.verdict = Verdict::refuted;
        c.counterexample = shown.values;
        c.residual = shown.residual;
        c.residual_value = shown.residual_value;
    }

    // What is wrong

    void refine(std::size_t k, ExactStates& states) {
        CheckedClaim& c = result_.claims[k];
        if (states.motions.where() == Motions::At::rest) {
            c.reason = name_branch(k, states);
        } else if (holds_at_scene_values(k, states)) {
            c.reason = "it holds at the scene's values of the parameters only";
        }
        if (forms_[k].open.empty() && when_ == "motion")
            if (const auto nearest = nearest_equation(forms_[k].residual, m_, law_)) {
                c.nearest = nearest->equation;
                c.difference = nearest->difference;
            }
        const auto right = [&](const Claim& repaired) {
            try {
                Formed former{k, forms_[k], *this};
                forms_[k] = claims_.read(repaired);
                return holds_quickly(k, states);
            } catch (const SceneMistake&) {
                return false;
            }
        };
        const auto vanishes = [&](const Expression& value) {
            Program p;
            const std::optional<int> root = node_of(p, value);
            return root && (p.is_zero(*root) || is_zero_at_two(p, *root, states));
        };
        c.likely = likely_slip(scene_.claims[k], forms_[k].residual, m_, law_,
                               {.is_right = right,
                                .vanishes = vanishes,
                                .absent = [&](const Claim& claim, std::vector<std::string> terms) {
                                    return absent(claim, std::move(terms), states);
                                }});
        if (!c.likely)
            if (const auto term = term_of_wrong_unit(scene_.claims[k], m_))
                c.likely = Slip{.kind = "wrong_unit", .term = *term, .repair = {}};
    }

    /// Nothing where it cannot be read, or holds open names.
    std::optional<int> node_of(Program& p, const Expression& value) {
        try {
            const ex e = claims_.read(value);
            if (m_.z->depends(e, claims_.open_symbols())) return std::nullopt;
            return claims_.lower(p, {e})[0];
        } catch (const std::exception&) {
            return std::nullopt;
        } catch (const SceneMistake&) {
            return std::nullopt;
        }
    }

    std::vector<std::pair<std::string, std::string>> absent(const Claim& claim, std::vector<std::string> terms,
                                                            ExactStates& states) {
        const ClaimForm form = claims_.read(claim);
        if (!form.open.empty()) return {};
        Program p;
        const int residual = claims_.lower(p, {form.residual})[0];
        std::vector<std::string> texts;
        std::vector<int> nodes;
        std::vector<Diagnostic> mistakes;
        if (terms.empty()) terms = terms_of_mechanics(claim, m_, law_);
        for (std::string& text : terms) {
            const Expression value = parse_expression(text, {}, mistakes);
            const std::optional<int> node = value.tree ? node_of(p, value) : std::nullopt;
            if (!node || p.is_zero(*node)) continue;
            nodes.push_back(*node);
            texts.push_back(std::move(text));
        }
        std::vector<Steady> steady;
        for (const std::string& text : steady_sums(claim, m_)) {
            const Expression value = parse_expression(text, {}, mistakes);
            if (const std::optional<int> node = value.tree ? node_of(p, value) : std::nullopt)
                steady.push_back({text, *node});
        }
        std::vector<ModularPoint> points;
        const std::size_t most = states.motions.where() == Motions::At::rest ? states_of_rest : 12;
        for (std::size_t s = 0; s < most && states.get(s) != nullptr; ++s) points.push_back(states.get(s)->point);
        std::vector<std::pair<std::string, std::string>> result;
        for (const Absent& term : absent_terms(p, residual, nodes, steady, points))
            result.emplace_back(term.coefficient, texts[term.term]);
        return result;
    }

    /// Puts a form back.
    struct Formed {
        std::size_t k;
        ClaimForm form;
        Checker& checker;
        ~Formed() { checker.forms_[k] = form; }
    };

    bool holds_quickly(std::size_t k, ExactStates& states) {
        if (!forms_[k].open.empty()) {
            // With the claims of its group that are right; if they leave it open, with all.
            std::vector<std::size_t> group = group_of(k), right = group;
            std::erase_if(right, [&](std::size_t other) { return other != k && wrong_.contains(other); });
            return agrees(k, right, states) || (right.size() < group.size() && agrees(k, group, states));
        }
        Program p;
        const std::array<int, 1> root{claims_.lower(p, {forms_[k].residual})[0]};
        if (p.is_zero(root[0])) return when_ == "impact";  // elsewhere an identity is no repair
        return is_zero_at_two(p, root[0], states);
    }

    /// At rest, and where constraints have branches, two states may lie on one of them.
    static bool is_zero_at_two(const Program& p, int root, ExactStates& states) {
        std::size_t wanted = states.motions.where() == Motions::At::rest ? 8 : 2;
        for (std::size_t s = 0, usable = 0; usable < wanted; ++s) {
            const ExactState* const state = states.get(s);
            if (state == nullptr || s > 30) return false;
            if (state->branches > 1) wanted = 8;
            const auto at = evaluate_mod(p, state->point, std::array<int, 1>{root});
            if (!at) continue;
            if (!at->value[root].is_zero()) return false;
            ++usable;
        }
        return true;
    }

    bool agrees(std::size_t k, const std::vector<std::size_t>& group, ExactStates& states) {
        const OpenRows rows = open_rows(claims_, forms_, group);
        for (std::size_t s = 0; s < 2; ++s) {
            const auto at = matrix_at(rows, states, s);
            if (!at || !consistent(at->rows) || pins(rows, *at, {}, k)) return false;
        }
        return true;
    }

    bool holds_at_scene_values(std::size_t k, ExactStates& states) {
        if (!forms_[k].open.empty() || !states.motions.steps().empty()) return false;
        ModularPoint point;
        int independent = 0;
        std::map<std::pair<Variable::Kind, int>, Prime> values;
        for (const Mechanism::Parameter& p : m_.parameters) {
            if (!p.independent) continue;
            const auto value = Prime::from(cln::the<cln::cl_RA>(GiNaC::ex_to<numeric>(p.value).to_cl_N()));
            if (!value) return false;
            values[{Variable::Kind::parameter, independent++}] = *value;
        }
        if (independent == 0) return false;
        Program p;
        const std::array<int, 1> root{claims_.lower(p, {forms_[k].residual})[0]};
        int usable = 0;
        for (std::uint64_t seed = 1; seed < 40 && usable < 2; ++seed) {
            const auto state = states.motions.at(seed, values);
            if (!state) continue;
            const auto at = evaluate_mod(p, state->point, root);
            if (!at) continue;
            if (!at->value[root[0]].is_zero()) return false;
            ++usable;
        }
        return usable == 2;
    }

    /// Which factor of an equation of rest vanishes where the claim does not.
    std::string name_branch(std::size_t k, ExactStates& states) const {
        Program p;
        const std::array<int, 1> root{claims_.lower(p, {forms_[k].residual})[0]};
        for (std::size_t s = 0; states.get(s) != nullptr && s < 64; ++s) {
            const auto at = evaluate_mod(p, states.get(s)->point, root);
            if (!at || at->value[root[0]].is_zero()) continue;
            for (const RestFactor& factor : rest_factors(m_, e_)) {
                Program q;
                const std::array<int, 1> node{claims_.lower(q, {factor.value})[0]};
                const auto value = evaluate_mod(q, states.get(s)->point, node);
                if (value && value->value[node[0]].is_zero())
                    return fmt::format("rest is possible with {} = 0 too, and there it fails", factor.text);
            }
        }
        return "it fails at some of the states of rest";
    }

    // Claims with open names

    static std::optional<OpenMatrix> matrix_at(const OpenRows& rows, ExactStates& states, std::size_t s) {
        const ExactState* const state = states.get(s);
        return state == nullptr ? std::nullopt : open_matrix(rows, *state);
    }

    /// All claims that share open names with claim k, through others too.
    std::vector<std::size_t> group_of(std::size_t k) const {
        std::set<int> names(forms_[k].open.begin(), forms_[k].open.end());
        std::vector<std::size_t> group;
        for (std::size_t before = 0; before != names.size() || group.empty();) {
            before = names.size();
            group.clear();
            for (std::size_t other = 0; other < forms_.size(); ++other) {
                if (scene_.claims[other].at != scene_.claims[k].at || !forms_[other].linear) continue;
                if (std::none_of(forms_[other].open.begin(), forms_[other].open.end(),
                                 [&](int o) { return names.contains(o); }))
                    continue;
                group.push_back(other);
                names.insert(forms_[other].open.begin(), forms_[other].open.end());
            }
            if (group.empty()) break;
        }
        return group;
    }

    void settle_open(const std::vector<std::size_t>& open, ExactStates& states) {
        std::set<std::size_t> done;
        for (const std::size_t k : open) {
            CheckedClaim& c = result_.claims[k];
            if (!forms_[k].linear) {
                c.reason = "it is not linear in what it leaves open";
                continue;
            }
            if (mixes(k)) {
                c.reason =
                    "it holds an unknown function beside a constant of the motion, and the function's derivative "
                    "is not known";
                continue;
            }
            if (done.contains(k)) continue;
            std::vector<std::size_t> group = group_of(k);
            std::erase_if(group, [&](std::size_t other) { return mixes(other); });
            done.insert(group.begin(), group.end());
            settle_group(group, states);
        }
    }

    bool mixes(std::size_t k) const {
        bool constant = false, function = false;
        for (const int o : forms_[k].open) (claims_.open()[o].constant ? constant : function) = true;
        return constant && function;
    }

    void settle_group(const std::vector<std::size_t>& group, ExactStates& states) {
        const OpenRows rows = open_rows(claims_, forms_, group);
        double failure = 0, missed = 0;
        bool exact = true;
        std::optional<OpenMatrix> bad;
        std::vector<OpenMatrix> seen;
        for (std::size_t s = 0; s < most_states && (failure > wanted_failure || missed > wanted_failure) && !bad;
             ++s) {
            auto at = matrix_at(rows, states, s);
            if (!at) {
                if (states.get(s) == nullptr) break;
                continue;
            }
            exact = exact && at->exact;
            if (!consistent(at->rows)) bad = *at;
            failure += at->chance;
            missed += miss(*states.get(s));
            seen.push_back(std::move(*at));
        }
        if (seen.empty() || (!bad && (failure > wanted_failure || missed > wanted_failure))) {
            for (const std::size_t k : group) result_.claims[k].reason = "it could not be evaluated at any state";
            return;
        }
        wrong_ = bad ? culprits(rows, *bad, group) : std::set<std::size_t>();
        const std::set<std::size_t> wrong = wrong_;
        for (const std::size_t k : group) {
            CheckedClaim& c = result_.claims[k];
            c.failure = failure;
            if (wrong.contains(k)) {
                c.reason = wrong.size() > 1 && wrong.size() == group.size()
                               ? "no choice of what is left open satisfies these claims together"
                               : "the other claims leave no choice with which it holds";
                const auto shown = counterexample(told(), states.motions, rows,
                                                  {.claim = k, .open = forms_[k].open, .wrong = wrong});
                if (!shown) continue;
                show(c, *shown);
                if (shown->of_derivative)
                    c.reason = "it is not constant: the residual is that of its time derivative";
                refine(k, states);
            } else if (pins(rows, seen[0], wrong, k)) {
                const bool constant = claims_.open()[forms_[k].open[0]].constant;
                c.verdict = constant ? Verdict::undecided : Verdict::vacuous;
                c.reason = constant ? "a further time derivative would be needed to tell whether what it leaves "
                                      "open is constant"
                                    : "what it leaves open can take up whatever it says: no other claim fixes it";
            } else {
                c.verdict = Verdict::proved;
            }
        }
    }

    /// With the constraints and what the claims leave open eliminated, is every acceleration determined?
    bool complete() {
        std::vector<GiNaC::symbol> unknowns = m_.qddot;
        unknowns.insert(unknowns.end(), e_.lambda.begin(), e_.lambda.end());
        for (const Mechanism::Constraint& c : m_.redundant) unknowns.push_back(c.multiplier);
        for (const Open& o : claims_.open()) unknowns.push_back(o.symbol);
        std::vector<ex> list;
        std::size_t count = 0;
        for (std::size_t k = 0; k < forms_.size(); ++k) {
            const Verdict verdict = result_.claims[k].verdict;
            if (scene_.claims[k].at != "motion" || (verdict != Verdict::proved && verdict != Verdict::vacuous))
                continue;
            const ex last = forms_[k].derivatives.empty() ? forms_[k].residual : forms_[k].derivatives.back();
            const std::vector<ex> slopes = m_.z->pull_back({{last, 1}}, unknowns);
            list.insert(list.end(), slopes.begin(), slopes.end());
            ++count;
        }
        if (count == 0) return false;
        for (const auto& row : e_.A) {
            list.insert(list.end(), row.begin(), row.end());
            list.insert(list.end(), unknowns.size() - row.size(), ex(0));
        }
        Program p;
        const std::vector<int> nodes = claims_.lower(p, list);
        for (const int halves : {0, 1, 2}) {
            ExactStates states(m_, e_, Motions::At::motion, halves, halvings(p, nodes));
            for (std::size_t s = 0; s < 40 && states.get(s) != nullptr; ++s) {
                const auto at = evaluate_mod(p, states.get(s)->point, nodes);
                if (!at) continue;
                std::vector<std::vector<Prime>> all, others;
                for (std::size_t r = 0; r * unknowns.size() < nodes.size(); ++r) {
                    all.emplace_back();
                    for (std::size_t j = 0; j < unknowns.size(); ++j)
                        all.back().push_back(at->value[nodes[r * unknowns.size() + j]]);
                    others.emplace_back(all.back().begin() + m_.size(), all.back().end());
                }
                return rank_of(all, unknowns.size()) == m_.size() + rank_of(others, unknowns.size() - m_.q.size());
            }
        }
        return false;
    }

    const Scene& scene_;
    const Mechanism& m_;
    const Equations& e_;
    Equations law_;                    // of the claims in hand
    std::vector<std::size_t> spoken_;  // the multipliers of m_.undetermined() in it
    Claims claims_;
    std::shared_ptr<RootSheets> sheets_;
    std::vector<ex> positive_;  // on the sheet of the scene and its claims, not of what is tried in their place
    std::vector<ClaimForm> forms_;
    std::string when_;
    std::set<std::size_t> wrong_;  // of the group in hand
    Checked result_;
};

}  // namespace

Checked check(const Scene& scene, const Mechanism& mechanism, const std::shared_ptr<RootSheets>& sheets,
              const std::string& by) {
    const Equations equations = routh(mechanism);
    const Mechanism m = in_terms_of(equations, mechanism);
    return Checker(scene, m, equations, sheets, by).run();
}

CheckedScene check(Scene scene, const std::string& by) {
    CheckedScene result{derived(std::move(scene), {.by = by, .on_sheets = true})};
    if (result.scene.claims.empty())
        throw ModelError(
            "there are no claims: write [[claim]] in the scene, or give a file of claims, one equation a line");
    result.checked = check(result.scene, result.mechanism, result.sheets, by);
    return result;
}

}  // namespace alembert
