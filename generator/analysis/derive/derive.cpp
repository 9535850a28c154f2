// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/derive/derive.hpp"

#include "alembert/base/error.hpp"
#include "algebra/notation/operations.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/exact/expression_of.hpp"
#include "analysis/reaction/joint_reactions.hpp"
#include "model/formalism/needs.hpp"
#include "scene/sticking.hpp"

namespace alembert {

namespace {

/// Adds the reactions F_x … M_z of each joint, and the normal reactions of what rolls, if they are short.
void add_reactions(DerivedScene& d) {
    constexpr std::size_t most_terms = 20;
    constexpr const char* letters[] = {"F_x", "F_y", "F_z", "M_x", "M_y", "M_z"};
    if (!has_reactions(d.mechanism)) return;
    const JointReactions reactions = joint_reactions(d.scene, d.mechanism);
    std::vector<GiNaC::symbol> multipliers;
    const auto find = [&](const std::string& name, const Mechanism::Constraint& c) {
        if (c.multiplier.get_name() == name) multipliers.push_back(c.multiplier);
    };
    for (const std::string& name : reactions.multipliers) {
        for (const auto* list : {&d.mechanism.constraints, &d.mechanism.redundant})
            for (const Mechanism::Constraint& c : *list) find(name, c);
        for (const Mechanism::Unilateral& contact : d.mechanism.unilateral) find(name, contact.gap);
    }
    const std::vector<int> force = reactions.program.nodes_of(Group::force),
                           moment = reactions.program.nodes_of(Group::moment);
    const auto state = [&](std::vector<Statement>& list, int node, const std::string& letter,
                           const std::string& of) {
        const auto e = expression_of(reactions.program, node, d.mechanism, multipliers);
        if (!e) return;
        const auto f = fourier(*e, *d.mechanism.symbols, 20 * most_terms);
        if (!f || f->size() > most_terms) return;
        list.push_back(
            {.kind = Statement::Kind::energy, .letter = letter, .of = of, .by = {}, .value = readable(*f)});
    };
    for (std::size_t k = 0; k < reactions.joints.size(); ++k)
        for (std::size_t i = 0; i < 6; ++i)
            state(d.joint_loads, i < 3 ? force[3 * k + i] : moment[3 * k + i - 3], letters[i],
                  reactions.joints[k]);
    for (std::size_t k = 0; k < reactions.normals.size(); ++k)
        state(d.normal_reactions, force[3 * reactions.joints.size() + k], "N", reactions.rollings[k]);
}

/// Adds the equations while this friction sticks; or how long they are; nothing if its force has no name.
void add_sticking(Derivation::Rubs& friction, const Scene& scene, const FrictionRule& rule, bool full) {
    std::vector<Diagnostic> told;
    friction.forces = sticking_forces(rule);
    if (!taken_forces(rule, declare(scene, told)).empty()) return;
    Scene stuck = with_sticking(scene, {rule.name.text});
    stuck.on_warning = [](const Warning&) {};  // they were told for the scene itself
    try {
        const std::string& by = formalism_for(Need::multipliers).name;
        Derived d = derived(std::move(stuck), {.by = by, .on_sheets = true});
        if (!d.mechanism.unilateral.empty()) d = derived_again(d, with_all_closed(d.mechanism), by);
        Derivation shown = derivation_of(d.mechanism, d.equations, full ? Length::any : Length::readable);
        if (shown.definitions.empty()) {
            friction.held = std::move(shown.equations);
            return;
        }
        for (const auto& [name, value] : shown.definitions) friction.operations += operations_in(value);
        for (const ReadableEquation& e : shown.equations)
            friction.operations += operations_in(e.lhs) + operations_in(e.rhs);
    } catch (const ModelError&) {
        return;  // what sticks contradicts a constraint, for instance
    } catch (const SceneError&) {
        return;  // the scene itself is right
    }
}

/// Coordinates, and the operations of a program for the equations of a large tree.
DerivedScene told_by_size(Derived derived) {
    DerivedScene d{std::move(derived)};
    const Mechanism& m = d.mechanism;
    const Formalism& by = formalism_in_rates(m);
    d.shown.formalism = by.name;
    d.shown.title = translated(by.title);
    d.shown.degrees_of_freedom = m.size() - static_cast<int>(m.constraints.size());
    for (const GiNaC::symbol& q : m.q) d.shown.coordinates.push_back(phrases::symbol(q, m.symbols->info(q)));
    d.shown.program_operations = lowered(d).cost.operations;
    return d;
}

}  // namespace

DerivedScene explained(Derived derived, const PartDone& done) {
    DerivedScene d{std::move(derived)};
    const bool independent = !d.by.empty() && formalism(d.by).independent;
    d.has_unilateral_reactions = !d.mechanism.unilateral.empty() && !independent;
    if (d.has_unilateral_reactions) {
        const std::string by = d.by;
        static_cast<Derived&>(d) = derived_again(d, with_all_closed(d.mechanism), by);
    }
    d.shown = derivation_of(d.mechanism, d.equations, formalism(d.equations.formalism), done);
    return d;
}

DerivedScene derive(Scene scene, const ShowOptions& options) {
    const auto tell = [&](double part) {
        if (options.done) options.done(part);
    };
    tell(0);
    DeriveOptions wishes{.by = options.by, .on_sheets = true, .coordinates = Coordinates::optional};
    if (!options.full && !options.reactions) wishes.use = Use::shown_or_counted;
    Derived equations = derived(std::move(scene), wishes);
    tell(0.3);
    if (wishes.use == Use::shown_or_counted && wishes.by.empty() && equations.equations.tree)
        return told_by_size(std::move(equations));
    DerivedScene d = explained(std::move(equations), [&](double part) { tell(0.3 + 0.4 * part); });
    if (d.sheets)
        for (const GiNaC::ex& positive : d.sheets->positive())
            if (auto sign = readable_sign(positive, *d.mechanism.symbols))
                d.shown.signs.push_back(std::move(*sign));
    for (Derivation::Rubs& friction : d.shown.frictions)
        for (const FrictionRule& rule : d.scene.frictions) {
            if (rule.name.text != friction.name) continue;
            const double before = static_cast<double>(&friction - d.shown.frictions.data());
            tell(0.7 + 0.3 * before / static_cast<double>(d.shown.frictions.size()));
            add_sticking(friction, d.scene, rule, options.full);
        }
    if (!options.reactions) return d;
    show_reactions(d.shown, d.mechanism);
    add_reactions(d);
    return d;
}

}  // namespace alembert
