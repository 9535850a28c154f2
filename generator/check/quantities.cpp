// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/quantities.hpp"

#include <algorithm>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "base/language/say.hpp"
#include "check/claim_tree.hpp"
#include "check/open_rows.hpp"
#include "check/total_derivative.hpp"
#include "check/vanishing.hpp"
#include "check/ways.hpp"
#include "scene/book_letters.hpp"
#include "scene/functions.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double largest_shown = 10000;
constexpr std::size_t most_shown = 150;

bool is_book_call_of(const Tree& tree, const Mechanism& m) {
    if (tree.text != "T" && tree.text != "V" && tree.text != book_inertia && !tree.text.starts_with("Q_"))
        return false;
    const std::vector<GiNaC::symbol>& functions = m.symbols->functions();
    return std::none_of(functions.begin(), functions.end(),
                        [&](const GiNaC::symbol& f) { return f.get_name() == tree.text; });
}

/// Whether it is made of numbers and parameters.
bool is_steady_tree(const Tree& tree, const Mechanism& m) {
    if (tree.kind == Tree::Kind::name) {
        const auto is_it = [&](const auto& parameter) { return parameter.symbol.get_name() == tree.text; };
        return tree.text == "pi" || std::any_of(m.parameters.begin(), m.parameters.end(), is_it);
    }
    return tree.kind != Tree::Kind::call && tree.kind != Tree::Kind::derivative &&
           std::all_of(tree.args.begin(), tree.args.end(),
                       [&](const TreePtr& arg) { return is_steady_tree(*arg, m); });
}

/// Whether a part of this tree that is a term of a sum makes the tree such a term, but for a steady factor.
bool keeps_terms(const Tree& tree, const Mechanism& m) {
    if (tree.kind == Tree::Kind::sum || tree.kind == Tree::Kind::negate) return true;
    const auto changes = [&](const TreePtr& arg) { return !is_steady_tree(*arg, m); };
    return tree.kind == Tree::Kind::product && std::count_if(tree.args.begin(), tree.args.end(), changes) == 1;
}

/// `sign`: with which it is a term of left − right; 0 if it has a factor; nothing if it is no term.
void listen(const Tree& tree, std::optional<int> sign, const Claims& read, SpokenLetters& spoken) {
    const std::string& text = tree.text;
    const bool is_letter = tree.kind == Tree::Kind::name && read.is_letter(text);
    if (is_letter || (tree.kind == Tree::Kind::call && is_book_call_of(tree, read.mechanism()))) {
        spoken.any = true;
        if (is_letter) {
            spoken.forces = spoken.forces || text.starts_with("Q_") || text == "deltaW";
            spoken.displacements =
                spoken.displacements || !after_prefix(text, "delta_").empty() || text == "deltaW";
        }
        if (!sign || tree.primes > 0) return;
        const bool is_free = text == "V" || text == "E" || text == "H" || text == "L";
        if (is_free && !spoken.constant && !spoken.derivative) spoken.sign = *sign;
        spoken.constant = spoken.constant || text == "V" || text == "E" || text == "H";
        spoken.derivative = spoken.derivative || text == "L";
        spoken.kinetic = spoken.kinetic || text == "T";
        spoken.terms.push_back(plain_text_of(tree));
        return;
    }
    if (sign && !keeps_terms(tree, read.mechanism())) sign.reset();
    if (sign && tree.kind == Tree::Kind::product) sign = 0;
    if (sign && tree.kind == Tree::Kind::negate) sign = -*sign;
    for (const TreePtr& arg : tree.args) listen(*arg, sign, read, spoken);
}

/// Are these values, one for each coordinate, a combination of the rows of the constraints at all states?
bool are_reactions(Comparison& now, const std::vector<ex>& values, ExactStates& states, double& failure) {
    Program p;
    std::vector<int> roots = now.claims.lower(p, values);
    const std::size_t columns = values.size();
    for (const std::vector<ex>& row : now.e.A) {
        const std::vector<int> more = now.claims.lower(p, row);
        roots.insert(roots.end(), more.begin(), more.end());
    }
    const std::size_t rows = roots.size() / columns;
    LeftToChance left;
    for (std::size_t s = 0; s < most_states && !left.is_small(); ++s) {
        const ExactState* const state = states.get(s);
        if (state == nullptr) return false;
        const auto at = evaluate_mod(p, state->point, roots);
        if (!at) continue;
        std::vector<std::vector<Prime>> matrix(rows, std::vector<Prime>(columns));
        double degree = std::max(1.0, state->degree);
        for (std::size_t k = 0; k < roots.size(); ++k) {
            matrix[k / columns][k % columns] = at->value[roots[k]];
            degree += at->degree[roots[k]];
        }
        const int all = rank_of(matrix, columns);
        matrix.erase(matrix.begin());
        if (rank_of(matrix, columns) != all) return false;
        left.add(chance_at(*state, degree, *at), *state);
        failure = left.failure;
    }
    return left.is_small();
}

std::optional<std::string> shown(const ex& e, const Mechanism& m) {
    if (m.z->tree_size(e) > largest_shown) return std::nullopt;
    const auto f = fourier(m.z->expand(e), *m.symbols, 20 * most_shown);
    return f && f->size() <= most_shown ? std::optional(text(readable(*f))) : std::nullopt;
}

/// Whether this side is one quantity, and not one of those that move: T, diff(L, theta), (diff(L, theta'))'.
bool is_quantity(const Tree& tree, const Comparison& now) {
    if (tree.kind == Tree::Kind::derivative) return is_quantity(*tree.args[0], now);
    if (tree.kind == Tree::Kind::call) {
        const Function* const function = find_function(tree.text);
        return function != nullptr ? function->takes != Function::Takes::scalars : is_book_call_of(tree, now.m);
    }
    const auto is_momentum = [&](const GiNaC::symbol& q) { return tree.text == "p_" + q.get_name(); };
    return tree.kind == Tree::Kind::name &&
           (now.claims.is_letter(tree.text) || std::any_of(now.m.q.begin(), now.m.q.end(), is_momentum));
}

}  // namespace

AnyStates::AnyStates(const Mechanism& m, const Equations& e, int halvings) {
    const Equations any = any_motion(e, m);
    for (const int halves : {0, 1, 2}) {
        states_.emplace(m, any, Motions::Sampling{.halves = halves, .halvings = halvings});
        if (states_->get(0) != nullptr) return;
    }
    states_.reset();
}

SpokenLetters letters_in(const Claim& claim, const Claims& read) {
    SpokenLetters spoken;
    listen(*claim.equation.lhs.tree, 1, read, spoken);
    listen(*claim.equation.rhs.tree, -1, read, spoken);
    std::sort(spoken.terms.begin(), spoken.terms.end());
    if (std::adjacent_find(spoken.terms.begin(), spoken.terms.end()) != spoken.terms.end())
        spoken.constant = spoken.derivative = false;  // V = V + c leaves nothing open
    return spoken;
}

bool speaks_of_letters(const Comparison& now, std::size_t k) {
    return letters_in(now.scene.claims[k], now.claims).any;
}

namespace {

/// Whether the tree holds the derivative of a first-order state; `primes` of those around it count.
bool holds_state_rate(const Tree& tree, const Mechanism& m, int primes = 0) {
    primes += tree.kind == Tree::Kind::name || tree.kind == Tree::Kind::derivative ? tree.primes : 0;
    if (tree.kind == Tree::Kind::name)
        return primes > 0 && std::any_of(m.states.begin(), m.states.end(), [&](const Mechanism::State& z) {
                   return z.derivative[0].get_name() == tree.text;
               });
    return std::any_of(tree.args.begin(), tree.args.end(),
                       [&](const TreePtr& arg) { return holds_state_rate(*arg, m, primes); });
}

}  // namespace

std::string words_without_forces(const Comparison& now, std::size_t k, std::string otherwise) {
    const Equality& equation = now.scene.claims[k].equation;
    if (holds_state_rate(*equation.lhs.tree, now.m) || holds_state_rate(*equation.rhs.tree, now.m))
        return say("it follows from the rates of the states, which the scene gives");
    return speaks_of_letters(now, k) ? words_of_identity() : otherwise;
}

std::string words_of_identity() {
    return say("a relation between the quantities themselves: it holds whatever the motion");
}

namespace {

/// `settle`, then, if that is false, the comparison of the sides as they stand, then `tell`.
class LetterClaim {
public:
    explicit LetterClaim(Question& q)
        : now_(q.now),
          k_(q.claim),
          states_(*q.together.states),
          spoken_(letters_in(now_.scene.claims[k_], now_.claims)),
          c_(q.found) {}

    /// Decides a claim that is right though its sides are not equal as they were read; returns whether it did. A
    /// claim that is wrong is left in the reading that is nearer.
    bool settle();
    /// Adds to the verdict how the letters were read, and of a wrong claim what the quantity is.
    void tell();

private:
    bool vanishes(const GiNaC::ex& residual);
    bool prove();
    ExactStates* any(const GiNaC::ex& e);
    std::optional<std::vector<GiNaC::ex>> coefficients(const GiNaC::ex& residual) const;
    bool holds_for_allowed(const ClaimForm& form);
    GiNaC::ex excess() const;
    bool is_steady(const GiNaC::ex& e) const;
    bool is_constant();
    bool is_derivative();
    void choose(const std::vector<ClaimForm>& readings);
    void tell_right_side();
    void tell_reading();

    Comparison& now_;
    std::size_t k_;
    ExactStates& states_;
    const SpokenLetters spoken_;
    CheckedClaim& c_;
    std::unique_ptr<AnyStates> any_;
    bool loads_ = false;            ///< whether the forces are those of the loads alone
    std::optional<int> displaced_;  ///< the coordinate whose virtual displacement alone is not zero
};

bool LetterClaim::settle() {
    if (!spoken_.any || now_.at != Claim::At::motion || vanishes(now_.forms[k_].residual)) return false;
    std::vector<ClaimForm> readings{now_.forms[k_]};
    if (spoken_.forces) {
        now_.claims.read_forces_as_whole(false);
        readings.push_back(now_.claims.read(now_.scene.claims[k_]));
        if (vanishes(readings[1].residual)) {
            loads_ = true;
            now_.forms[k_] = readings[1];
            return false;  // it is right as it now stands
        }
    }
    for (std::size_t r = 0; spoken_.displacements && r < readings.size(); ++r)
        if (holds_for_allowed(readings[r])) {
            loads_ = r == 1;
            now_.forms[k_] = readings[r];
            return prove();
        }
    if (spoken_.constant && is_constant()) return prove();
    if (spoken_.derivative && is_derivative()) return prove();
    choose(readings);
    return false;
}

bool LetterClaim::vanishes(const ex& residual) {
    Program p;
    const int root = now_.claims.lower(p, {residual})[0];
    return p.is_zero(root) || vanishes_at_two(states_, p, root);
}

bool LetterClaim::prove() {
    c_.verdict = Verdict::proved;
    return true;
}

ExactStates* LetterClaim::any(const ex& e) {
    if (!any_) {
        Program p;
        any_ = std::make_unique<AnyStates>(now_.m, now_.e, halvings(p, now_.claims.lower(p, {e})));
    }
    return any_->get();
}

/// The coefficients of the virtual displacements; nothing if the claim is not linear in them.
std::optional<std::vector<ex>> LetterClaim::coefficients(const ex& residual) const {
    const Mechanism& m = now_.m;
    std::vector<GiNaC::symbol> symbols;
    for (const auto& [coordinate, symbol] : now_.claims.displacements()) symbols.push_back(symbol);
    const std::vector<ex> slopes = m.z->pull_back({{residual, 1}}, symbols);
    std::vector<ex> result(static_cast<std::size_t>(m.size()), 0);
    ex rest = residual;
    for (std::size_t j = 0; j < slopes.size(); ++j) {
        if (m.z->depends(slopes[j], symbols)) return std::nullopt;
        result[static_cast<std::size_t>(now_.claims.displacements()[j].first)] += slopes[j];
        rest -= slopes[j] * symbols[j];
    }
    Program p;
    const int node = now_.claims.lower(p, {m.z->name(rest)})[0];
    return p.is_zero(node) || is_identity(p, node) ? std::optional(result) : std::nullopt;
}

bool LetterClaim::holds_for_allowed(const ClaimForm& form) {
    if (now_.e.A.empty()) return false;
    const auto values = coefficients(form.residual);
    ExactStates* const states = values ? any(form.residual) : nullptr;
    return states != nullptr && are_reactions(now_, *values, *states, c_.failure);
}

/// What is claimed minus the quantity, if its letter has no factor; otherwise a multiple of it.
ex LetterClaim::excess() const {
    const ex& residual = now_.forms[k_].residual;
    return spoken_.sign > 0 ? now_.m.z->name(-residual) : residual;
}

bool LetterClaim::is_constant() {
    const ex delta = excess();
    if (order_of(delta, now_.m) > 1) return false;
    const ex rate = now_.m.time_derivative({delta})[0];
    ExactStates* const states = any(rate);
    Program p;
    const int root = now_.claims.lower(p, {rate})[0];
    if (!p.is_zero(root) && (states == nullptr || vanishes_at(*states, p, root, c_.failure) != true)) return false;
    std::string constant = spoken_.sign != 0 && is_steady(delta) ? shown(delta, now_.m).value_or("") : "";
    c_.reason = constant.empty() ? say("right up to a constant")
                                 : say("right up to a constant; what is claimed is larger by {}", constant);
    c_.up_to = UpTo{.kind = UpTo::Kind::constant, .text = std::move(constant)};
    return true;
}

/// Whether no coordinate, rate or time is left in the normal form.
bool LetterClaim::is_steady(const ex& e) const {
    if (now_.m.z->tree_size(e) > largest_shown) return false;
    const auto f = fourier(now_.m.z->expand(e), *now_.m.symbols, 20 * most_shown);
    if (!f) return false;
    const ex written = expression(*f);
    std::vector<GiNaC::symbol> moving = now_.m.moving();
    moving.insert(moving.end(), now_.m.qdot.begin(), now_.m.qdot.end());
    return std::none_of(moving.begin(), moving.end(), [&](const GiNaC::symbol& s) { return written.has(s); });
}

bool LetterClaim::is_derivative() {
    const ex delta = excess();
    if (order_of(delta, now_.m) > 1) return false;
    const std::vector<ex> equations = euler_operator(delta, now_.m);
    ExactStates* const states = any(delta);
    if (states == nullptr || !are_reactions(now_, equations, *states, c_.failure)) return false;
    const auto source = spoken_.sign != 0 ? source_of_derivative(delta, now_.m) : std::nullopt;
    std::string F = source ? shown(*source, now_.m).value_or("") : "";
    c_.reason = F.empty() ? say("right up to the time derivative of a function of coordinates and time, which "
                                "changes no equation of motion")
                          : say("right up to a time derivative, which changes no equation of motion: what is "
                                "claimed is L + F' with F = {}",
                                F);
    c_.up_to = UpTo{.kind = UpTo::Kind::derivative, .text = std::move(F)};
    return true;
}

/// Of a wrong claim, the reading from which it differs in fewer terms.
void LetterClaim::choose(const std::vector<ClaimForm>& readings) {
    const auto terms = [&](const ClaimForm& form) {
        const ex& e = form.residual;
        const auto f = now_.m.z->tree_size(e) > largest_shown
                           ? std::nullopt
                           : fourier(now_.m.z->expand(e), *now_.m.symbols, 20 * most_shown);
        return f ? f->size() : most_shown;
    };
    loads_ = readings.size() > 1 && terms(readings[1]) < terms(readings[0]);
    now_.claims.read_forces_as_whole(!loads_);
    now_.forms[k_] = readings[loads_ ? 1 : 0];
    if (!spoken_.displacements) return;
    // A state has no virtual displacements: one of them is 1 there, the others are 0.
    const auto values = coefficients(now_.forms[k_].residual);
    for (int i = 0; values && i < now_.m.size(); ++i)
        if (const ex& value = (*values)[static_cast<std::size_t>(i)]; !vanishes(value)) {
            now_.forms[k_].residual = value;
            displaced_ = i;
            return;
        }
}

void LetterClaim::tell_right_side() {
    const Equality& equation = now_.scene.claims[k_].equation;
    const bool left = is_quantity(*equation.lhs.tree, now_);
    if (!left && !is_quantity(*equation.rhs.tree, now_)) return;
    const Expression& side = left ? equation.lhs : equation.rhs;
    const auto value = shown(now_.claims.read(side), now_.m);
    const ex& residual = now_.forms[k_].residual;
    const auto beyond = shown(left ? -residual : residual, now_.m);
    if (!value || !beyond) return;
    const std::size_t first = side.text.find_first_not_of(' '), last = side.text.find_last_not_of(' ');
    c_.nearest = side.text.substr(first, last + 1 - first) + " = " + *value;
    c_.difference = *beyond;
}

/// Which of the two meanings of a generalized force was right, where they differ.
void LetterClaim::tell_reading() {
    const ex here = now_.forms[k_].residual;
    now_.claims.read_forces_as_whole(loads_);
    const ex other = now_.claims.read(now_.scene.claims[k_]).residual;
    Program p;
    const int difference = now_.claims.lower(p, {now_.m.z->name(here - other)})[0];
    if (p.is_zero(difference) || is_identity(p, difference)) return;
    const std::string reading = loads_ ? say("Q is here the generalized force of the loads that are not in V")
                                       : say("Q is here the whole generalized force, with that of V");
    c_.reason = c_.reason.empty() ? reading : c_.reason + "; " + reading;
}

void LetterClaim::tell() {
    if (!spoken_.any) {
        const bool is_told = c_.likely || !c_.nearest.empty() || order_of(now_.forms[k_].residual, now_.m) > 1;
        if (c_.verdict == Verdict::refuted && !is_told && now_.at == Claim::At::motion) tell_right_side();
        return;
    }
    if (c_.verdict == Verdict::refuted && !c_.likely) tell_right_side();
    if (displaced_ && c_.verdict == Verdict::refuted) {
        c_.difference.clear();
        for (int i = 0; i < now_.m.size(); ++i)
            c_.counterexample.emplace_back("delta_" + now_.m.q[i].get_name(), i == *displaced_ ? "1" : "0");
    }
    if (spoken_.forces && c_.verdict == Verdict::proved) tell_reading();
    now_.claims.read_forces_as_whole(true);
}

}  // namespace

std::optional<CheckedClaim> by_its_letters(Question& q) {
    const auto letters = std::make_shared<LetterClaim>(q);
    q.tell_last = [letters] { letters->tell(); };
    const bool is_right = letters->settle();
    q.lower();  // in the reading that was chosen
    return is_right ? std::optional(q.found) : std::nullopt;
}

}  // namespace alembert
