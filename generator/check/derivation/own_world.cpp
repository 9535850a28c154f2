// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/own_world.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_equations = 60;  // from which a line may follow: the last ones

}  // namespace

std::optional<std::size_t> later(std::optional<std::size_t> a, std::optional<std::size_t> b) {
    return a && b ? std::max(a, b) : a ? a : b;
}

OwnWorld::OwnWorld(DerivedSystem& system, const Letters& letters)
    : system_(system), letters_(letters), world_(system.scene(), system.mechanism(), system.sheets()) {
    refresh();
}

void OwnWorld::know(const std::string& name, const Stated& value) {
    known_[name] = value;
    world_.know(name, value.value);
}

ex OwnWorld::value_with(const std::string& text, const std::map<std::string, ex>& given) {
    for (const auto& [name, value] : given) world_.know(name, value);
    const auto restore = [&] {
        for (const auto& [name, value] : given) world_.know(name, known_.at(name).value);
    };
    try {
        const ex result = world_.value(text);
        restore();
        return result;
    } catch (...) {
        restore();
        throw;
    }
}

OwnWorld::Stated OwnWorld::stated_or(const std::string& name, const Stated& otherwise) const {
    const auto found = stated_.find(name);
    return found == stated_.end() ? otherwise : found->second;
}

void OwnWorld::count_as_part(const std::string& name, const std::string& whole, const ex& truth) {
    parts_[name] = {whole, truth};
}

void OwnWorld::count_as_velocity(const std::string& text, const ex& truth, const ex& mass) {
    const auto step = steps_.find(text);
    parts_[step == steps_.end() ? text : step->second] = {letters_.name_of(MechanicalQuantity::kinetic), truth,
                                                          mass};
    refresh();
}

OwnWorld::Stated OwnWorld::with_parts(const std::string& whole, const ex& truth) const {
    Stated result{truth, {}};
    for (const auto& [name, part] : parts_) {
        const auto stated = stated_.find(name);
        if (part.whole != whole || stated == stated_.end() || !stated->second.wrong) continue;
        const ex& own = stated->second.value;
        result.value += part.mass.is_zero() ? own - part.truth
                                            : part.mass * (GiNaC::pow(own, 2) - GiNaC::pow(part.truth, 2)) / 2;
        result.wrong = later(result.wrong, stated->second.wrong);
    }
    return result;
}

void OwnWorld::refresh() {
    const Mechanism& m = system_.mechanism();
    laws_[0].reset(), laws_[1].reset();
    const std::string names[] = {
        letters_.name_of(MechanicalQuantity::kinetic), letters_.name_of(MechanicalQuantity::potential),
        letters_.name_of(MechanicalQuantity::lagrangian), letters_.name_of(MechanicalQuantity::energy),
        letters_.name_of(MechanicalQuantity::hamiltonian)};
    const bool has_parts = !m.given_lagrangian;
    const Stated T = stated_or(names[0], with_parts(names[0], m.kinetic_energy())),
                 V = stated_or(names[1], with_parts(names[1], m.potential_energy()));
    const bool apart = has_parts || (stated_.contains(names[0]) && stated_.contains(names[1]));
    const Stated L = stated_or(names[2], apart ? Stated{m.z->name(T.value - V.value), later(T.wrong, V.wrong)}
                                               : Stated{m.lagrangian(), {}});
    if (apart || stated_.contains(names[0])) know(names[0], T);
    if (apart || stated_.contains(names[1])) know(names[1], V);
    know(names[2], L);
    const std::vector<ex> momenta = m.z->pull_back({{L.value, 1}}, m.qdot);
    GiNaC::exvector action;
    std::optional<std::size_t> wrong = L.wrong;
    for (int i = 0; i < m.size(); ++i) {
        const std::string name = "p_" + m.q[i].get_name();
        if (letters_.is_of_scene(name)) continue;
        const Stated p = stated_or(name, {momenta[i], L.wrong});
        know(name, p);
        action.push_back(momenta[i] * m.qdot[i]);
    }
    if (apart) know(names[3], stated_or(names[3], {m.z->name(T.value + V.value), later(T.wrong, V.wrong)}));
    know(names[4], stated_or(names[4], {m.z->name(GiNaC::add(action) - L.value), wrong}));
    const std::vector<ex> forces = system_.forces(false), slopes = apart && all_forces_
                                                                       ? m.z->pull_back({{V.value, 1}}, m.q)
                                                                       : std::vector<ex>(m.q.size(), 0);
    for (int i = 0; i < m.size(); ++i) {
        const std::string name = "Q_" + m.q[i].get_name();
        if (letters_.is_of_scene(name)) continue;
        Stated force = with_parts(name, m.z->name(forces[i] - slopes[i]));
        if (all_forces_) force.wrong = later(force.wrong, V.wrong);
        know(name, stated_or(name, force));
    }
    for (const auto& [name, value] : stated_)
        if (!known_.contains(name)) know(name, value);
}

void OwnWorld::count_potential_forces(bool all) {
    all_forces_ = all;
    refresh();
}

void OwnWorld::state(const std::string& name, const ex& value, std::optional<std::size_t> wrong) {
    stated_[name] = {system_.mechanism().z->name(value), wrong};
    known_[name] = stated_[name];
    world_.know(name, stated_[name].value);
    refresh();
}

bool OwnWorld::state_if(const std::string& name, const ex& value, std::size_t wrong,
                        const std::function<bool()>& is_so) {
    const auto found = stated_.find(name);
    const std::optional<Stated> before = found == stated_.end() ? std::nullopt : std::optional(found->second);
    state(name, value, wrong);
    if (is_so()) return true;
    if (before)
        stated_[name] = *before;
    else
        stated_.erase(name);
    refresh();
    return false;
}

void OwnWorld::state_step(const std::string& text, const ex& value, std::optional<std::size_t> wrong) {
    const auto [place, is_new] = steps_.emplace(text, "");
    if (is_new) place->second = letters_.free_name(fmt::format("step_{}", steps_.size()));
    know(place->second, {system_.mechanism().z->name(value), wrong});
    stated_[place->second] = known_[place->second];
    laws_[0].reset(), laws_[1].reset();
}

void OwnWorld::state_rate(const ex& of, const ex& value, std::optional<std::size_t> wrong) {
    rates_.push_back({of, {system_.mechanism().z->name(value), wrong}});
    laws_[0].reset(), laws_[1].reset();
}

std::optional<OwnWorld::Stated> OwnWorld::rate_of(const ex& value) const {
    MotionRows& rows = system_.rows();
    for (auto rate = rates_.rbegin(); rate != rates_.rend(); ++rate)
        if (rows.is_identity(rows.row(rate->of - value)) == true) return rate->value;
    return std::nullopt;
}

std::optional<std::size_t> OwnWorld::wrong_in(const std::set<std::string>& names) const {
    std::optional<std::size_t> result;
    for (const std::string& name : names)
        if (const auto found = known_.find(name); found != known_.end())
            result = later(result, found->second.wrong);
    return result;
}

std::map<std::string, ex> OwnWorld::values() const {
    std::map<std::string, ex> result;
    for (const auto& [name, value] : known_) result[name] = value.value;
    return result;
}

void OwnWorld::add_equation(MotionRow row, std::size_t line, bool is_wrong, bool is_near) {
    if (!row.linear || !row.is_known()) return;
    if (equations_.size() == most_equations) equations_.erase(equations_.begin());
    equations_.push_back({std::move(row), line, is_wrong, is_near});
}

std::optional<OwnWorld::Stated> OwnWorld::step(const std::string& text) const {
    const auto name = steps_.find(text);
    return name == steps_.end() ? std::nullopt : std::optional(known_.at(name->second));
}

// d/dt ∂L/∂q' − ∂L/∂q = Q + Σ λ ∂f/∂q, each part as far as the derivation has written it out.
OwnWorld::Law OwnWorld::law_of(int i, bool with_reactions) {
    const Mechanism& m = system_.mechanism();
    const std::string q = m.q[i].get_name(), p = "p_" + q;
    const std::string T = letters_.name_of(MechanicalQuantity::kinetic),
                      V = letters_.name_of(MechanicalQuantity::potential),
                      L = letters_.name_of(MechanicalQuantity::lagrangian);
    const auto partial = [&](const std::string& of, const std::string& by) {
        return fmt::format("diff({},{})", of, by);
    };
    const auto own = [&](const std::string& name) { return known_.at(name); };
    const auto slope = [&](const std::string& of, const GiNaC::symbol& by) -> Stated {
        if (!known_.contains(of)) return {0, {}};
        return {m.z->pull_back({{own(of).value, 1}}, {by})[0], own(of).wrong};
    };
    const auto first = [&](std::initializer_list<std::string> texts) -> std::optional<Stated> {
        for (const std::string& text : texts)
            if (const auto found = step(text)) return found;
        return std::nullopt;
    };
    std::optional<Stated> momentum = first({partial(L, q + "'"), partial(T, q + "'")});
    if (!momentum && stated_.contains(p)) momentum = stated_.at(p);
    if (!momentum) momentum = slope(L, m.qdot[i]);
    std::optional<Stated> rate =
        first({"(" + partial(L, q + "'") + ")'", "(" + partial(T, q + "'") + ")'", "(" + p + ")'", p + "'"});
    if (!rate) rate = rate_of(momentum->value);
    if (!rate) rate = Stated{m.time_derivative({momentum->value})[0], momentum->wrong};
    std::optional<Stated> along = step(partial(L, q));
    if (!along) {
        const auto T_along = step(partial(T, q)), V_along = step(partial(V, q));
        if (T_along || V_along) {
            const Stated t = T_along ? *T_along : slope(T, m.q[i]), v = V_along ? *V_along : slope(V, m.q[i]);
            along = Stated{t.value - v.value, later(t.wrong, v.wrong)};
        } else {
            along = slope(L, m.q[i]);
        }
    }
    Stated force{system_.forces(false)[i], {}};
    if (const auto known = known_.find("Q_" + q); known != known_.end() && known->second.wrong) {
        force = known->second;
        if (all_forces_) force.value += slope(V, m.q[i]).value;
    }
    const ex reaction = with_reactions ? system_.reaction(i) : ex(0);
    const ex residual = rate->value - along->value - force.value - reaction;
    return {system_.rows().row(residual), later(later(rate->wrong, along->wrong), force.wrong)};
}

const std::vector<OwnWorld::Law>& OwnWorld::laws(bool with_reactions) {
    std::optional<std::vector<Law>>& made = laws_[with_reactions ? 1 : 0];
    if (!made) {
        made.emplace();
        for (int i = 0; i < system_.mechanism().size(); ++i) made->push_back(law_of(i, with_reactions));
    }
    return *made;
}

void OwnWorld::add_relation(const ex& residual, std::size_t line) {
    const Mechanism& m = system_.mechanism();
    const std::vector<ex> slopes = m.z->pull_back({{residual, 1}}, m.qdot);
    for (std::size_t i = m.q.size(); i-- > 0;) {
        if (slopes[i].is_zero() || m.z->depends(slopes[i], m.qdot)) continue;
        const ex rest = m.z->name(residual - slopes[i] * m.qdot[i]);
        relations_.push_back({{{m.qdot[i], m.z->name(-rest / slopes[i])}}, line});
        return;
    }
}

std::optional<std::size_t> OwnWorld::explained_by_relations(const ex& residual) {
    ex value = residual;
    for (auto relation = relations_.rbegin(); relation != relations_.rend(); ++relation) {
        value = substitute(*system_.mechanism().z, {value}, relation->rate)[0];
        if (system_.rows().is_identity(system_.rows().row(value)) == true) return relation->line;
    }
    return std::nullopt;
}

std::vector<const OwnWorld::OwnEquation*> OwnWorld::consistent(bool near, bool bound) const {
    std::vector<const OwnEquation*> result;
    std::vector<const MotionRow*> rows;
    for (auto equation = equations_.rbegin(); equation != equations_.rend(); ++equation) {
        if (equation->is_near && !near) continue;
        rows.push_back(&equation->row);
        if (system_.rows().agree(rows, bound))
            result.push_back(&*equation);
        else
            rows.pop_back();
    }
    return result;
}

std::optional<std::size_t> OwnWorld::explained_by(const MotionRow& row, bool near) {
    MotionRows& rows = system_.rows();
    for (auto equation = equations_.rbegin(); equation != equations_.rend(); ++equation)
        if (equation->is_wrong && (near || !equation->is_near) && rows.follows(row, {&equation->row}))
            return equation->line;
    std::vector<const MotionRow*> given;
    std::optional<std::size_t> wrong;
    for (const bool with_reactions : {true, false}) {
        given.clear();
        wrong.reset();
        for (const Law& law : laws(with_reactions)) given.push_back(&law.row), wrong = later(wrong, law.wrong);
        if (wrong && rows.follows(row, given)) return wrong;
    }
    for (const bool bound :
         {true, false}) {  // also where the derivation's own constraints take the place of the scene's
        given.clear();
        wrong.reset();
        for (const OwnEquation* equation : consistent(near, bound)) {
            given.push_back(&equation->row);
            if (equation->is_wrong) wrong = later(wrong, equation->line);
        }
        if (wrong && rows.follows(row, given, bound)) return wrong;
    }
    return std::nullopt;
}

// With q'' = −ω² a and q = a the last equations, one for each coordinate, have a determinant that vanishes.
std::optional<std::size_t> OwnWorld::explains_frequency(const ex& square) {
    const Mechanism& m = system_.mechanism();
    const std::size_t n = m.q.size();
    std::optional<std::size_t> wrong;
    GiNaC::matrix rows(static_cast<unsigned>(n), static_cast<unsigned>(n));
    std::size_t found = 0;
    for (auto equation = equations_.rbegin(); equation != equations_.rend() && found < n; ++equation) {
        if (!equation->is_near) continue;
        const std::vector<ex> inertia = m.z->pull_back({{equation->row.residual, 1}}, m.qddot),
                              stiffness = m.z->pull_back({{equation->row.residual, 1}}, m.q);
        for (std::size_t i = 0; i < n; ++i)
            rows(static_cast<unsigned>(found), static_cast<unsigned>(i)) =
                m.z->expand(stiffness[i] - square * inertia[i]);
        if (equation->is_wrong) wrong = later(wrong, equation->line);
        ++found;
    }
    if (found < n || !wrong) return std::nullopt;
    return is_identically_zero(m.z->name(rows.determinant()), m) ? wrong : std::nullopt;
}

std::optional<std::size_t> OwnWorld::explained_by_linearizing(
    const ex& residual, const std::function<std::optional<ex>(const ex&)>& linear) {
    MotionRows& rows = system_.rows();
    const std::optional<ex> small = linear(residual);
    if (!small) return std::nullopt;
    const MotionRow row = rows.row(*small);
    for (auto equation = equations_.rbegin(); equation != equations_.rend(); ++equation) {
        if (!equation->is_wrong || equation->is_near) continue;
        const std::optional<ex> own = linear(equation->row.residual);
        if (!own) continue;
        const MotionRow given = rows.row(*own);
        if (rows.follows(row, {&given}, false)) return equation->line;
    }
    return std::nullopt;
}

std::optional<std::size_t> OwnWorld::explained_at_rest(const std::function<bool(const ex&)>& is_same) {
    for (auto equation = equations_.rbegin(); equation != equations_.rend(); ++equation)
        if (equation->is_wrong && !equation->is_near && is_same(equation->row.residual)) return equation->line;
    for (const Law& law : laws(true))
        if (law.wrong && is_same(law.row.residual)) return law.wrong;
    return std::nullopt;
}

bool OwnWorld::founds(const MotionRow& row) {
    MotionRows& rows = system_.rows();
    std::vector<const MotionRow*> given;
    bool right = true;
    for (const Law& law : laws(true)) given.push_back(&law.row), right = right && !law.wrong;
    if (right || rows.follows(row, given)) return true;
    given.clear();
    for (const OwnEquation& equation : equations_)
        if (!equation.is_wrong) given.push_back(&equation.row);
    return rows.follows(row, given);
}

}  // namespace alembert
