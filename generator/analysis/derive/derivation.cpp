// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/derive/derivation.hpp"

#include <algorithm>
#include <tuple>

#include "algebra/notation/operations.hpp"
#include "algebra/notation/text.hpp"
#include "analysis/derive/abbreviations.hpp"
#include "analysis/derive/euler_form.hpp"
#include "analysis/derive/intermediate_form.hpp"
#include "analysis/derive/shares.hpp"
#include "analysis/derive/unit_quaternions.hpp"
#include "base/language/say.hpp"
#include "model/formalism/lagrange.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double largest_tree = 30000;   // the most nodes of all equations with intermediate symbols substituted
constexpr std::size_t most_terms = 150;  // of one equation in normal form; longer ones are not readable

constexpr std::size_t most_letters = 2500;  // likewise: each term may be as long as a page

constexpr double worth_a_name = 0.85;  // of the length without names

bool mentions(const Phrase& phrase, const std::string& name) {
    return (phrase.kind == Phrase::Kind::symbol && phrase.info.name == name) ||
           std::any_of(phrase.args.begin(), phrase.args.end(),
                       [&](const Phrase& part) { return mentions(part, name); });
}

class Making {
public:
    Making(const Mechanism& m, const Equations& e, Length length, const PartDone& done)
        : m_(m), unit_(m), given_(e), e_(unit_(e)), names_(m), length_(length), done_(done) {}

    Derivation make() {
        result_.formalism = e_.formalism;
        result_.has_unit_quaternions = unit_.any();
        result_.degrees_of_freedom = m_.size();
        for (const Mechanism::Constraint& c : m_.constraints) result_.degrees_of_freedom -= is_gap(c) ? 0 : 1;
        gaps();
        frictions();
        constraints();
        states();
        for (const GiNaC::symbol& q : m_.q) result_.coordinates.push_back(symbol_of(q));
        for (int i = 0; i < e_.size(); ++i)
            result_.rows.push_back(symbol_of(e_.speeds_are_rates() ? m_.q[i] : e_.u[i]));
        if (!e_.speeds_are_rates() && m_.speeds.empty()) choice();
        for (const ex& pole : e_.poles)
            if (const auto f = normal(pole))
                result_.poles.push_back(
                    readable(f->size() > 0 && f->terms()[0].coefficient < 0 ? Rational(-1) * *f : *f));
        if (!too_long_.empty() || !readable_equations()) return with_definitions();
        if (names_.any()) keep_names_where_shorter();
        if (!energies()) return with_definitions();
        tell(0.7);
        motion();
        angular_velocities();
        forces();
        tell(0.85);
        derivatives();
        shares();
        return std::move(result_);
    }

private:
    void tell(double part) const {
        if (done_) done_(part);
    }

    Phrase symbol_of(const GiNaC::symbol& s) const { return phrases::symbol(s, m_.symbols->info(s)); }

    std::optional<Fourier> normal(const ex& given) const {
        const ex e = unit_(given);
        if (m_.z->tree_size(e) > largest_tree) return std::nullopt;
        const ex written = m_.z->expand(e);
        std::optional<Fourier> f = fourier(keeps_names_ ? names_(written) : written, *m_.symbols, 20 * most_terms);
        if (f && f->size() > most_terms) return std::nullopt;
        if (f && length_ == Length::readable && letters_in(*f) > most_letters) return std::nullopt;
        return f;
    }

    /// Letters of the equations as they are printed.
    std::size_t length() const {
        std::size_t result = 0;
        for (const ReadableEquation& e : result_.equations) result += (text(e.lhs) + text(e.rhs)).size();
        for (const auto& [rate, value] : result_.kinematics) result += text(value).size();
        return result;
    }

    /// The scene's definitions stay names where the equations, these definitions added, are shorter with them.
    void keep_names_where_shorter() {
        const auto plain = std::pair(result_.equations, result_.kinematics);
        const std::size_t before = length();
        keeps_names_ = true;
        result_.equations.clear();
        result_.kinematics.clear();
        bool good = readable_equations();
        const auto occurs = [&](const std::string& name) {
            return std::any_of(result_.equations.begin(), result_.equations.end(),
                               [&](const auto& e) { return mentions(e.lhs, name) || mentions(e.rhs, name); }) ||
                   std::any_of(result_.kinematics.begin(), result_.kinematics.end(),
                               [&](const auto& rate) { return mentions(rate.second, name); });
        };
        std::size_t after = length();
        for (const Abbreviations::Kept& kept : names_.list()) {
            const auto f = fourier(kept.value, *m_.symbols, most_terms);
            if (!good || !f || !occurs(kept.name.get_name())) continue;
            result_.abbreviations.emplace_back(symbol_of(kept.name), readable(*f));
            after += text(result_.abbreviations.back().second).size();
        }
        if (good && static_cast<double>(after) < worth_a_name * static_cast<double>(before)) return;
        keeps_names_ = false;
        result_.abbreviations.clear();
        std::tie(result_.equations, result_.kinematics) = plain;
    }

    bool readable_equations() {
        double size = 0;
        for (int i = 0; i < e_.size(); ++i) {
            for (int j = 0; j < e_.size(); ++j) size += m_.z->tree_size(e_.M(i, j));
            size += m_.z->tree_size(e_.forcing(i));
        }
        if (size > largest_tree) return false;
        for (int i = 0; i < e_.size(); ++i) {
            GiNaC::exvector terms{-e_.own[i], -e_.dissipative[i]};
            for (int j = 0; j < e_.size(); ++j) terms.push_back(e_.M(i, j) * e_.udot[j]);
            GiNaC::exvector forces{e_.applied[i]};
            for (std::size_t k = 0; k < e_.A.size(); ++k) forces.push_back(e_.A[k][i] * e_.lambda[k]);
            if (has_shares())
                for (const Mechanism::Constraint& c : m_.redundant) forces.push_back(c.row[i] * c.multiplier);
            const auto left = normal(GiNaC::add(std::move(terms))), right = normal(GiNaC::add(std::move(forces)));
            if (!left || !right) return false;
            result_.equations.push_back(readable_equation(*left, *right, m_.symbols->info(e_.udot[i])));
            tell(0.5 * (i + 1) / e_.size());
        }
        if (!e_.speeds_are_rates()) write_as_euler(result_.equations, result_.rows);
        for (std::size_t i = 0; i < e_.h.size(); ++i) {
            if (e_.h[i].is_equal(m_.qdot[i])) continue;
            const auto rate = normal(e_.h[i]);
            if (!rate) return false;
            result_.kinematics.emplace_back(symbol_of(m_.qdot[i]), readable(*rate));
        }
        return true;
    }

    /// Do the equations contain multipliers of constraints that follow from others?
    bool has_shares() const { return e_.speeds_are_rates() && !e_.A.empty() && !m_.redundant.empty(); }

    void shares() {
        if (!has_shares()) return;
        for (const LeastShare& share : least_shares_of(m_)) {
            const auto left = normal(share.left - share.right), none = normal(ex(0));
            if (left && none) result_.shares.push_back(readable_equation(*left, *none));
        }
    }

    /// Describes the speeds that the program chose.
    void choice() {
        std::string kept, solved;
        for (int i = 0; i < m_.size(); ++i) {
            const bool is_free = std::any_of(e_.u.begin(), e_.u.end(),
                                             [&](const GiNaC::symbol& u) { return u.is_equal(m_.qdot[i]); });
            if (!is_free) solved += (solved.empty() ? "" : ", ") + m_.q[i].get_name() + "'";
        }
        for (int k = 0; k < e_.size(); ++k) {
            kept += (kept.empty() ? "" : ", ") + m_.symbols->info(e_.u[k]).text();
            if (m_.symbols->info(e_.u[k]).kind != SymbolInfo::Kind::speed) continue;
            if (const auto f = normal(e_.form[k])) result_.speeds.emplace_back(symbol_of(e_.u[k]), readable(*f));
        }
        result_.choice = say("The nonholonomic constraints are solved for {}; the independent speeds are {}{}",
                             solved, kept, result_.speeds.empty() ? "." : say(", with"));
    }

    bool add(std::vector<Statement>& to, Statement statement, const ex& value) {
        const auto f = normal(value);
        if (!f) return false;
        statement.value = readable(*f);
        to.push_back(std::move(statement));
        return true;
    }

    /// Adds the position of each mass as far as it is no coordinate, its velocity and v², and ω in the plane.
    void motion() {
        for (const MassElement& mass : m_.masses) {
            const std::string& name = mass.origin.name;
            if (name.empty() || is_name_of_scene(name)) continue;
            const auto state = [&](const char* letter, const ex& value) {
                return add(result_.motion, {Statement::Kind::motion, letter, name, {}, {}}, value);
            };
            if (mass.rotation && mass.rotation->w_NB_B[0].is_zero() && mass.rotation->w_NB_B[1].is_zero() &&
                !is_rate(mass.rotation->w_NB_B[2]) && !mass.rotation->w_NB_B[2].is_zero())
                state("omega", mass.rotation->w_NB_B[2]);
            std::vector<int> moving;
            for (int k = 0; k < 3; ++k)
                if (!mass.velocity[k].is_zero()) moving.push_back(k);
            if (std::all_of(moving.begin(), moving.end(), [&](int k) { return is_rate(mass.velocity[k]); }))
                continue;
            static constexpr std::array<const char*, 3> along{"x", "y", "z"}, rates{"x'", "y'", "z'"};
            for (const int k : moving) state(along[k], mass.position[k]);
            for (const int k : moving) state(rates[k], mass.velocity[k]);
            GiNaC::exvector squares;
            for (const int k : moving) squares.push_back(mass.velocity[k] * mass.velocity[k]);
            state("v^2", m_.z->name(GiNaC::add(std::move(squares))));
        }
    }

    bool is_rate(const ex& value) const {
        return std::any_of(m_.qdot.begin(), m_.qdot.end(),
                           [&](const GiNaC::symbol& rate) { return value.is_equal(rate); });
    }

    /// Whether one of the letters that a body's motion would have, x_A … omega_A, is a name of the scene.
    bool is_name_of_scene(const std::string& body) const {
        static constexpr std::array<const char*, 5> letters{"x_", "y_", "z_", "v_", "omega_"};
        const std::vector<GiNaC::symbol>& all = m_.symbols->all();
        return std::any_of(all.begin(), all.end(), [&](const GiNaC::symbol& s) {
            return std::any_of(letters.begin(), letters.end(),
                               [&](const char* letter) { return s.get_name() == letter + body; });
        });
    }

    /// Adds ω along the axes of each body that turns in space.
    void angular_velocities() {
        for (const MassElement& body : m_.masses) {
            if (!body.rotation || (body.rotation->w_NB_B[0].is_zero() && body.rotation->w_NB_B[1].is_zero()))
                continue;
            for (int k = 0; k < 3; ++k)
                add(result_.angular,
                    {Statement::Kind::energy, std::string("omega_") + "xyz" [k], shown_label(body.origin), {}, {}},
                    body.rotation->w_NB_B[k]);
        }
    }

    bool energies() {
        using Kind = Statement::Kind;
        for (const Part& part : m_.kinetic)
            if (!add(result_.energies, {Kind::energy, "T", shown_label(part.origin), {}, {}}, part.value))
                return false;
        for (const Part& part : m_.potential)
            if (!add(result_.energies, {Kind::energy, "V", shown_label(part.origin), {}, {}}, part.value))
                return false;
        const Energy energy = energy_of(m_);
        m_.z->adopt(*energy.z);
        const auto T = normal(energy.kinetic), V = normal(energy.potential), L = normal(m_.lagrangian());
        if (!T || !V || !L) return false;
        result_.kinetic = readable(*T);
        result_.potential = readable(*V);
        if (m_.given_lagrangian) result_.lagrangian = readable(*L);
        return true;
    }

    /// Adds Q of everything that does work: of V as −∂V/∂q, of loads by their virtual work; then the sums.
    void forces() {
        using Kind = Statement::Kind;
        GiNaC::exvector total(m_.size(), 0);
        const auto add_all = [&](const std::string& of, const std::vector<ex>& Q) {
            for (int i = 0; i < m_.size(); ++i) {
                if (Q[i].is_zero()) continue;
                add(result_.forces, {Kind::work, "Q", of, symbol_of(m_.q[i]), {}}, Q[i]);
                total[i] += Q[i];
            }
        };
        for (const Part& part : m_.potential)
            add_all(shown_label(part.origin), m_.z->pull_back({{part.value, -1}}, m_.q));
        for (const Load& load : m_.loads) {
            std::vector<std::pair<ex, ex>> targets;
            for (const Load::Pair& pair : load.pairs) targets.emplace_back(pair.velocity, pair.force);
            add_all(shown_label(load.origin), m_.z->pull_back(targets, m_.qdot));
        }
        if (result_.forces.empty()) return;
        for (int i = 0; i < m_.size(); ++i)
            add(result_.forces, {Kind::force, "Q", "", symbol_of(m_.q[i]), {}}, total[i]);
    }

    /// Adds ∂T/∂q', its rate and ∂T/∂q, or those of L if the scene gives it.
    void derivatives() {
        using Kind = Statement::Kind;
        const std::string letter = m_.given_lagrangian ? "L" : "T";
        std::vector<GiNaC::symbol> state = m_.q;
        state.insert(state.end(), m_.qdot.begin(), m_.qdot.end());
        const ex energy = m_.given_lagrangian ? m_.lagrangian() : m_.kinetic_energy();
        const std::vector<ex> gradient = m_.z->pull_back({{energy, 1}}, state);
        const std::vector<ex> rates = m_.time_derivative({gradient.begin() + m_.size(), gradient.end()});
        for (int i = 0; i < m_.size(); ++i) {
            const Phrase rate = symbol_of(m_.qdot[i]);
            add(result_.derivatives, {Kind::partial, letter, "", rate, {}}, gradient[m_.size() + i]);
            if (!rates[i].is_zero())
                add(result_.derivatives, {Kind::partial_rate, letter, "", rate, {}}, rates[i]);
            add(result_.derivatives, {Kind::partial, letter, "", symbol_of(m_.q[i]), {}}, gradient[i]);
        }
    }

    /// Sets a part of the result to this value as it is read, or puts that off until there are intermediate
    /// symbols for it.
    void write(const ex& value, std::function<Phrase&(Derivation&)> place) {
        if (const auto f = normal(value))
            place(result_) = readable(*f);
        else
            too_long_.emplace_back(value, std::move(place));
    }

    void constraints() {
        for (const Mechanism::Constraint& c : m_.constraints) {
            if (is_gap(c)) continue;
            GiNaC::exvector terms{c.offset};
            for (int i = 0; i < m_.size(); ++i) terms.push_back(c.row[i] * m_.qdot[i]);
            const std::size_t k = result_.constraints.size();
            result_.constraints.emplace_back(c.name, Phrase());
            write(c.position ? *c.position : ex(GiNaC::add(std::move(terms))),
                  [k](Derivation& d) -> Phrase& { return d.constraints[k].second; });
        }
    }

    void states() {
        for (const Mechanism::State& z : m_.states) {
            const std::size_t k = result_.states.size();
            result_.states.emplace_back(symbol_of(z.derivative[1]), Phrase());
            write(z.rate, [k](Derivation& d) -> Phrase& { return d.states[k].second; });
        }
    }

    /// Whether this is a unilateral constraint, which is among the constraints because of its reaction.
    bool is_gap(const Mechanism::Constraint& c) const {
        return std::any_of(m_.unilateral.begin(), m_.unilateral.end(), [&](const Mechanism::Unilateral& contact) {
            return contact.gap.multiplier.is_equal(c.multiplier);
        });
    }

    void frictions() {
        for (const Mechanism::Friction& f : m_.frictions) {
            const std::size_t k = result_.frictions.size();
            result_.frictions.push_back({.name = f.name, .sliding_velocity = {}, .sliding = {}, .sticking = {}});
            write(f.sliding_velocity, [k](Derivation& d) -> Phrase& { return d.frictions[k].sliding_velocity; });
            write(f.coefficient * f.normal, [k](Derivation& d) -> Phrase& { return d.frictions[k].sliding; });
            write(f.resting * f.normal, [k](Derivation& d) -> Phrase& { return d.frictions[k].sticking; });
            if (!f.across) continue;
            write(*f.across, [k](Derivation& d) -> Phrase& { return d.frictions[k].across.emplace(); });
        }
    }

    void gaps() {
        for (const Mechanism::Unilateral& contact : m_.unilateral) {
            const std::size_t k = result_.gaps.size();
            result_.gaps.emplace_back(contact.gap.name, Phrase());
            write(*contact.gap.position, [k](Derivation& d) -> Phrase& { return d.gaps[k].second; });
        }
    }

    Derivation with_definitions() {
        Energy energy = energy_of(m_);
        m_.z->adopt(*energy.z);
        energy.kinetic = unit_(energy.kinetic);
        energy.potential = unit_(energy.potential);
        std::vector<ex> others;
        for (const auto& [value, place] : too_long_) others.push_back(unit_(value));
        const LowerOptions for_reader{.reactions_are_letters = true, .states_are_given = true};
        IntermediateForm form = intermediate_form(lower(m_, e_, energy, for_reader), m_, e_, others);
        if (unit_.any()) {
            for (std::size_t k = 0; k < others.size(); ++k) others[k] = too_long_[k].first;
            IntermediateForm other =
                intermediate_form(lower(m_, given_, energy_of(m_), for_reader), m_, given_, others);
            if (other.definitions.size() < form.definitions.size()) {
                form = std::move(other);
                result_.has_unit_quaternions = false;
            }
        }
        result_.definitions = std::move(form.definitions);
        result_.equations = std::move(form.equations);
        result_.kinematics = std::move(form.kinematics);
        result_.kinetic = std::move(form.kinetic);
        result_.potential = std::move(form.potential);
        for (std::size_t k = 0; k < too_long_.size(); ++k)
            too_long_[k].second(result_) = std::move(form.others[k]);
        result_.energies.clear();
        return std::move(result_);
    }

    const Mechanism& m_;
    const UnitQuaternions unit_;
    const Equations& given_;
    const Equations e_;  ///< with unit quaternions
    const Abbreviations names_;
    const Length length_;
    const PartDone& done_;
    bool keeps_names_ = false;
    /// What is beyond the readable size apart from the equations, and where it belongs.
    std::vector<std::pair<ex, std::function<Phrase&(Derivation&)>>> too_long_;
    Derivation result_;
};

}  // namespace

void show_reactions(Derivation& shown, const Mechanism& m) {
    std::vector<Mechanism::Constraint> all = m.constraints;
    all.insert(all.end(), m.redundant.begin(), m.redundant.end());
    for (const Mechanism::Constraint& c : all)
        for (int i = 0; i < m.size(); ++i) {
            const ex force = c.row[i] * c.multiplier;
            if (force.is_zero() || m.z->tree_size(force) > largest_tree) continue;
            const auto f = fourier(m.z->expand(force), *m.symbols, 20 * most_terms);
            if (!f || f->size() > most_terms) continue;
            shown.reactions.push_back({.kind = Statement::Kind::work,
                                       .letter = "Q",
                                       .of = c.name,
                                       .by = phrases::symbol(m.q[i], m.symbols->info(m.q[i])),
                                       .value = readable(*f)});
        }
}

Derivation derivation_of(const Mechanism& mechanism, const Equations& equations, Length length,
                         const PartDone& done) {
    const Mechanism m = in_terms_of(equations, mechanism);
    return Making(m, equations, length, done).make();
}

Derivation derivation_of(const Mechanism& mechanism, const Equations& equations, const Formalism& by,
                         const PartDone& done) {
    const Mechanism m = in_terms_of(equations, mechanism);
    // First-order equations in momenta are shown with the energies, not after the elimination of the momenta.
    Derivation shown = derivation_of(m, by.in_momenta ? lagrange(m) : equations, Length::readable, done);
    shown.formalism = by.name;
    shown.title = translated(by.title);
    if (by.outline != nullptr) shown.sections = by.outline(m);
    if (by.in_momenta && !shown.definitions.empty())
        shown.title =
            say("Lagrange's equations, to which those in momenta are equal; these are too long to be shown");
    if (by.steps == nullptr || !shown.definitions.empty()) return shown;
    OwnSteps own = by.steps(m, equations);
    for (Section& section : own.sections) shown.sections.push_back(std::move(section));
    if (!own.equations.empty()) {
        shown.title = std::move(own.title);
        shown.equations = std::move(own.equations);
    } else if (by.in_momenta) {
        shown.title =
            say("Lagrange's equations, to which those in momenta are equal; these are too long to be shown");
    }
    return shown;
}

}  // namespace alembert
