// SPDX-License-Identifier: GPL-2.0-or-later
// The condition of rest: Σ F·δr = 0 with the inertia forces of the motion that is prescribed (Zhang & Qin, equation
// (20) of example 1-1), as a product; a factor a cos x + b or a sin x + b that is linear in it gives its root.
#include "formalism/own_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "formalism/dalembert.hpp"
#include "formalism/formalisms.hpp"
#include "formalism/hamilton.hpp"
#include "formalism/kane.hpp"
#include "formalism/rest.hpp"
#include "formalism/roberson_wittenburg.hpp"
#include "formalism/routhian.hpp"
#include "formalism/schiehlen.hpp"
#include "notation/text.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

class Showing {
public:
    Showing(Derivation& shown, const Mechanism& m, const Equations& e) : shown_(shown), m_(m), e_(e) {}

    void kane() {
        const PartialVelocities partial = partial_velocities(m_);
        for (const PartialVelocities::Of& body : partial.bodies) {
            Section section{.words = "Partial velocities of " + body.label + ":"};
            for (int r = 0; r < e_.size(); ++r)
                for (int k = 0; k < 3; ++k) {
                    add_partial(section, std::string("v_") + "xyz"[k], e_.u[r], body.velocity[r][k]);
                    if (!body.angular.empty())
                        add_partial(section, std::string("w_") + "xyz"[k], e_.u[r], body.angular[r][k]);
                }
            shown_.sections.push_back(std::move(section));
        }
        const KaneForces forces = kane_forces(m_);
        Section section{.words = "Generalized active forces F and inertia forces F*, F + F* = 0:"};
        if (!e_.A.empty()) section.words = "Generalized active forces F and inertia forces F*, F + F* + A^T lambda = 0:";
        for (int r = 0; r < e_.size(); ++r) {
            const std::string of = e_.h.empty() ? m_.q[r].get_name() : m_.symbols->info(e_.u[r]).text();
            GiNaC::exvector inertia{forces.inertia[r]};
            for (int s = 0; s < e_.size(); ++s) inertia.push_back(-forces.M(r, s) * e_.udot[s]);
            if (const auto f = normal(forces.conservative[r] + forces.dissipative[r] + forces.applied[r]))
                section.statements.push_back({Statement::Kind::energy, "F", of, {}, readable(*f)});
            if (const auto f = normal(GiNaC::add(std::move(inertia))))
                section.statements.push_back({Statement::Kind::energy, "F*", of, {}, readable(*f)});
        }
        shown_.sections.push_back(std::move(section));
    }

    /// The system graph, at any size.
    void graph() {
        const SystemGraph g = system_graph(m_);
        std::string arcs, bodies, chords;
        for (const SystemGraph::Arc& arc : g.arcs) {
            const auto name = [&](int body) { return body < 0 ? std::string("N") : g.bodies[body]; };
            arcs += fmt::format("{}{}: {} -> {}", arcs.empty() ? "" : ", ", arc.name, name(arc.from), name(arc.to));
        }
        for (const std::string& body : g.bodies) bodies += (bodies.empty() ? "" : ", ") + body;
        for (const std::string& chord : g.chords) chords += (chords.empty() ? " Chords, which close loops: " : ", ") + chord;
        if (!chords.empty()) chords += ".";
        const auto row = [](const std::vector<int>& entries) {
            std::vector<Phrase> phrases;
            for (const int entry : entries) phrases.push_back(phrases::number(entry));
            return phrases::tuple(std::move(phrases));
        };
        Section S{.words = fmt::format("The system graph, each arc from parent to child: {}.{} Incidence matrix S, a row for each body, a column "
                                       "for each arc (1 where it begins, -1 where it ends):",
                                       arcs, chords)};
        S.statements.push_back({Statement::Kind::energy, "S", "N", {}, row(g.S_0)});
        for (std::size_t i = 0; i < g.bodies.size(); ++i) S.statements.push_back({Statement::Kind::energy, "S", g.bodies[i], {}, row(g.S[i])});
        Section T{.words = fmt::format("Path matrix T, a row for each arc, a column for each body: {} (1 where the arc is on the body's path "
                                       "and points to the ground, -1 where it points away):",
                                       bodies)};
        for (std::size_t a = 0; a < g.arcs.size(); ++a) T.statements.push_back({Statement::Kind::energy, "T", g.arcs[a].name, {}, row(g.T[a])});
        shown_.sections.push_back(std::move(S));
        shown_.sections.push_back(std::move(T));
    }

    void schiehlen() {
        const std::vector<BodyMotion> motions = global_motions(m_);
        for (std::size_t b = 0; b < motions.size(); ++b) {
            Section section{.words = "Global Jacobians of " + m_.masses[b].label + ", J_T = dr/dq along N and J_R = dw/dq' along its axes, and the accelerations at q'' = 0:"};
            const auto add_rows = [&](const std::string& letter, const std::vector<Vector3>& J) {
                for (int j = 0; j < m_.size(); ++j)
                    for (int k = 0; k < 3; ++k) add_partial(section, letter + "_" + "xyz"[k], m_.q[j], J[j][k]);
            };
            add_rows("r", motions[b].J_T);
            if (m_.masses[b].rotation) add_rows("s", motions[b].J_R);
            for (int k = 0; k < 3; ++k)
                if (const auto f = normal(motions[b].a_bar[k]); f && f->size() > 0)
                    section.statements.push_back({Statement::Kind::energy, std::string("a_") + "xyz"[k], "", {}, readable(*f)});
            shown_.sections.push_back(std::move(section));
        }
    }

    void lagrange1() {
        Section section{.words = "Newton's law for each Cartesian coordinate, m x'' = F + A^T lambda, with the forces:"};
        for (int i = 0; i < m_.size(); ++i)
            if (const auto f = normal(e_.forcing(i)))
                section.statements.push_back({Statement::Kind::force, "F", "", symbol_of(m_.q[i]), readable(*f)});
        shown_.sections.push_back(std::move(section));
    }

    void dalembert() {
        works("Virtual work of the applied forces, dW = sum of Q dq, and of the inertia forces, dW* = sum of Q* dq; "
              "Q + Q* = 0:",
              "Q", "Q*");
        const std::vector<ex> conditions = rest_conditions(m_, e_);
        Section section{.words = "With all rates and accelerations zero:"};
        for (const ex& condition : conditions)
            if (const auto f = normal(condition)) add_rest(section, readable(*f));
        shown_.sections.push_back(std::move(section));
        if (!roots_.equalities.empty()) shown_.sections.push_back(std::move(roots_));
    }

    void hamilton() {
        const Canonical c = canonical(m_);
        Section section{.words = "Hamilton's function, with p = dL/dq':"};
        for (int i = 0; i < m_.size(); ++i) add(section, symbol_of(c.p[i]), c.momenta[i]);
        add(section, letter("H"), c.H);
        std::vector<ReadableEquation> equations;
        for (int i = 0; i < 2 * m_.size(); ++i) {
            const int k = i % m_.size();
            const auto f = normal(i < m_.size() ? c.qdot[k] : c.pdot[k]);
            if (!f) return;
            equations.push_back({i < m_.size() ? symbol_of(m_.qdot[k]) : rate(c.p[k]), readable(*f), {}});
        }
        shown_.sections.push_back(std::move(section));
        shown_.title = "Hamilton's canonical equations";
        shown_.equations = std::move(equations);
    }

    void routhian() {
        const Reduction r = reduction(m_);
        std::string names;
        for (const int i : r.cyclic) names += (names.empty() ? "" : ", ") + m_.q[i].get_name();
        Section section{.words = "Cyclic coordinates: " + names + ". Their momenta are constants; the Routhian R = L - sum of p q':"};
        for (std::size_t k = 0; k < r.cyclic.size(); ++k) add(section, symbol_of(r.p[k]), r.momenta[k]);
        for (std::size_t k = 0; k < r.cyclic.size(); ++k) add(section, symbol_of(m_.qdot[r.cyclic[k]]), r.rates[k]);
        add(section, letter("R"), r.R);
        std::vector<ReadableEquation> equations;
        const int e = static_cast<int>(r.remaining.size());
        for (int i = 0; i < e; ++i) {
            GiNaC::exvector left{-r.own[i], -e_.dissipative[r.remaining[i]]};
            for (int j = 0; j < e; ++j) left.push_back(r.M(i, j) * m_.qddot[r.remaining[j]]);
            const auto f = normal(GiNaC::add(std::move(left))), right = normal(e_.applied[r.remaining[i]]);
            if (!f || !right) return;
            equations.push_back(readable_equation(*f, *right));
            equations.back().divided_by.reset();
        }
        for (std::size_t k = 0; k < r.cyclic.size(); ++k)
            equations.push_back({rate(r.p[k]), phrases::number(0), {}});
        shown_.sections.push_back(std::move(section));
        shown_.title = "Routh's equations of the coordinates that are not cyclic";
        shown_.equations = std::move(equations);
    }

private:
    Phrase symbol_of(const GiNaC::symbol& s) const { return phrases::symbol(s, m_.symbols->info(s)); }
    static Phrase letter(const std::string& name) {
        const GiNaC::symbol s(name);
        return phrases::symbol(s, {.name = name});
    }
    Phrase rate(const GiNaC::symbol& p) const {
        SymbolInfo info = m_.symbols->info(p);
        info.order = 1;
        return phrases::symbol(p, info);
    }

    std::optional<Fourier> normal(const ex& e) const {
        if (m_.z->tree_size(e) > 30000) return std::nullopt;
        std::optional<Fourier> f = fourier(m_.z->expand(e), *m_.symbols, 3000);
        if (f && f->size() > 150) return std::nullopt;
        return f;
    }

    void add(Section& section, const Phrase& left, const ex& value) const {
        if (const auto f = normal(value)) section.equalities.emplace_back(left, readable(*f));
    }

    void add_partial(Section& section, const std::string& of, const GiNaC::symbol& by, const ex& value) const {
        if (value.is_zero()) return;
        if (const auto f = normal(value))
            section.statements.push_back({Statement::Kind::partial, of, "", symbol_of(by), readable(*f)});
    }

    void works(const std::string& words, const std::string& active, const std::string& inertia) {
        const VirtualWork work = virtual_work(m_);
        Section section{.words = words};
        for (int i = 0; i < m_.size(); ++i) {
            const std::string of = m_.q[i].get_name();
            if (const auto f = normal(work.conservative[i] + work.dissipative[i] + work.applied[i]))
                section.statements.push_back({Statement::Kind::energy, active, of, {}, readable(*f)});
            if (const auto f = normal(work.inertia[i]))
                section.statements.push_back({Statement::Kind::energy, inertia, of, {}, readable(*f)});
        }
        shown_.sections.push_back(std::move(section));
    }

    // The condition of rest as a product

    void add_rest(Section& section, const Phrase& sum) {
        const TrigonometricProduct found = product_of(expression(sum), m_);
        std::vector<Phrase> atoms, sums;
        for (const ex& base : found.bases) {
            const auto f = fourier(base.subs(found.functions), *m_.symbols);
            if (!f || f->size() == 0) continue;
            (GiNaC::is_a<GiNaC::add>(base) ? sums : atoms).push_back(leading_positive(*f));
            if (m_.size() == 1) add_root(base, found.functions);
        }
        // GiNaC's order changes from run to run.
        const auto by_text = [](const Phrase& a, const Phrase& b) { return text(a) < text(b); };
        std::sort(atoms.begin(), atoms.end(), by_text);
        std::sort(sums.begin(), sums.end(), by_text);
        atoms.insert(atoms.end(), sums.begin(), sums.end());
        std::sort(roots_.equalities.begin(), roots_.equalities.end(), [](const auto& a, const auto& b) {
            const int simple_a = a.first.kind == Phrase::Kind::call, simple_b = b.first.kind == Phrase::Kind::call;
            return std::tuple(simple_a, text(a.first), text(a.second)) < std::tuple(simple_b, text(b.first), text(b.second));
        });
        section.equalities.emplace_back(found.vanishes ? phrases::number(0) : phrases::product(std::move(atoms)), phrases::number(0));
    }

    void add_root(const ex& base, const GiNaC::exmap& functions) {
        const ex q = m_.q[0];
        for (const auto& [s, call] : functions) {
            if (!base.has(s) || base.degree(s) != 1) continue;
            const ex slope = base.coeff(s, 1), rest = base.coeff(s, 0);
            if (slope.subs(functions).has(q) || rest.subs(functions).has(q)) continue;
            const std::string name = GiNaC::ex_to<GiNaC::function>(call).get_name();
            const auto arg = fourier(call.op(0), *m_.symbols);
            if (!arg || (name != "sin" && name != "cos")) continue;
            if (rest.is_zero()) {
                const Phrase zero = name == "sin" ? phrases::number(0) : phrases::quotient(phrases::pi(), phrases::number(2));
                roots_.equalities.emplace_back(readable(*arg), zero);
                if (name == "sin") roots_.equalities.emplace_back(readable(*arg), phrases::pi());
            } else if (const auto value = fourier((-rest / slope).subs(functions), *m_.symbols)) {
                // numerator and denominator apart: a quotient of two readable sums
                const ex sign = fourier(slope.subs(functions), *m_.symbols)->terms()[0].coefficient < 0 ? -1 : 1;
                const auto above = fourier((-rest * sign).subs(functions), *m_.symbols),
                           below = fourier((slope * sign).subs(functions), *m_.symbols);
                roots_.equalities.emplace_back(phrases::call(name, {readable(*arg)}),
                                               phrases::quotient(readable(*above), readable(*below)));
            }
        }
        if (base.is_equal(q)) roots_.equalities.emplace_back(symbol_of(m_.q[0]), phrases::number(0));
    }

    Derivation& shown_;
    const Mechanism& m_;
    const Equations& e_;
    Section roots_{.words = "with the roots (modulo the period):"};
};

}  // namespace

void show_own_steps(Derivation& shown, const Mechanism& mechanism, const Equations& equations) {
    shown.title = formalism(equations.formalism).title;
    Showing showing(shown, mechanism, equations);
    if (equations.formalism == "roberson-wittenburg") showing.graph();
    if (!shown.definitions.empty()) return;
    if (equations.formalism == "schiehlen") showing.schiehlen();
    if (equations.formalism == "kane") showing.kane();
    if (equations.formalism == "lagrange1") showing.lagrange1();
    if (equations.formalism == "dalembert") showing.dalembert();
    if (equations.formalism == "hamilton") showing.hamilton();
    if (equations.formalism == "routhian") showing.routhian();
}

}  // namespace alembert
