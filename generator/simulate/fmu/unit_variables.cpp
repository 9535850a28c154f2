// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/fmu/unit_variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "codegen/emit/names.hpp"
#include "scene/dimensions.hpp"
#include "scene/unit_text.hpp"
#include "scene/units.hpp"
#include "simulate/fmu/dependence.hpp"

namespace alembert {

namespace {

using Kind = UnitVariable::Kind;

class Listing {
public:
    explicit Listing(const UnitModel& model)
        : m_(model), p_(model.program), dependence_(model), values_(interpret(p_, model.start)) {}

    std::vector<UnitVariable> list() {
        add({.kind = Kind::time, .name = "time", .about = "t", .unit = is_si() ? "s" : ""});
        add_states();
        add_rates();
        add_inputs();
        add_parameters();
        add_values();
        find_dependencies();
        return std::move(list_);
    }

private:
    int add(UnitVariable variable) {
        while (!names_.insert(variable.name).second) variable.name += "_";
        list_.push_back(std::move(variable));
        return static_cast<int>(list_.size()) - 1;
    }

    /// Whether every unit of the scene is one of the SI, and there are some.
    bool is_si() const {
        const auto is_mechanical = [](const Quantity& q) {
            const auto meaning = meaning_of_unit(q.unit);
            return meaning && (meaning->exponents.contains("kg") || meaning->exponents.contains("m"));
        };
        return is_in_si(m_.scene) && (std::any_of(p_.parameters.begin(), p_.parameters.end(), is_mechanical) ||
                                      std::any_of(p_.coordinates.begin(), p_.coordinates.end(), is_mechanical));
    }

    std::string about_coordinate(const std::string& name) const {
        for (const Coordinate& c : m_.scene.coordinates)
            if (c.name.text == name) return c.about;
        return {};
    }

    /// The coordinate whose rate a speed is; −1 if there is none.
    int coordinate_of(std::size_t speed) const {
        return p_.speeds.empty() ? static_cast<int>(speed) : p_.speeds[speed].rate_of;
    }

    void add_states() {
        const bool are_moved = !p_.nodes_of(Group::projected).empty() || m_.contacts > 0,
                   are_struck = !p_.nodes_of(Group::event_impulse).empty();
        for (std::size_t i = 0; i < m_.coordinates(); ++i) {
            const Quantity& q = p_.coordinates[i];
            const std::string name = ascii_identifier(q.name);
            add({.kind = Kind::state,
                 .place = static_cast<int>(i),
                 .name = name,
                 .about = about_coordinate(q.name),
                 .unit = q.unit,
                 .shown = unit_of_name(m_.scene, q.name),
                 .start = m_.start.q[i],
                 .is_output = true,
                 .jumps = are_moved});
        }
        for (std::size_t k = 0; k < m_.speeds(); ++k) {
            const int of = coordinate_of(k);
            UnitVariable variable{.kind = Kind::state,
                                  .place = static_cast<int>(m_.coordinates() + k),
                                  .start = m_.start.qdot[k],
                                  .is_output = true,
                                  .jumps = are_moved || are_struck};
            if (of >= 0) {
                const Quantity& q = p_.coordinates[static_cast<std::size_t>(of)];
                variable.name = fmt::format("der({})", ascii_identifier(q.name));
                variable.unit = per_second(q.unit);
                variable.shown = unit_of_name(m_.scene, q.name + "'");
                variable.derivative_of = 1 + of;
            } else {
                variable.name = ascii_identifier(p_.speeds[k].name);
                variable.unit = p_.speeds[k].unit;
                variable.shown = unit_of_name(m_.scene, p_.speeds[k].name);
            }
            add(std::move(variable));
        }
    }

    /// The rates of the states that are no states themselves.
    void add_rates() {
        for (int state = 1; state <= static_cast<int>(m_.coordinates() + m_.speeds()); ++state) {
            const UnitVariable x = list_[static_cast<std::size_t>(state)];
            const bool is_known = std::any_of(list_.begin(), list_.end(), [&](const UnitVariable& other) {
                return other.is_state() && other.derivative_of == state;
            });
            if (is_known) continue;
            const bool is_second = x.derivative_of >= 0;
            const std::string& of = is_second ? list_[static_cast<std::size_t>(x.derivative_of)].name : x.name;
            const std::string& unit = is_second ? list_[static_cast<std::size_t>(x.derivative_of)].unit : x.unit;
            add({.kind = Kind::rate,
                 .place = state - 1,
                 .name = is_second ? fmt::format("der({},2)", of) : fmt::format("der({})", of),
                 .unit = per_second(unit, is_second ? 2 : 1),
                 .derivative_of = state});
        }
    }

    void add_inputs() {
        for (std::size_t k = 0; k < m_.inputs.size(); ++k) {
            const FreeInput& f = m_.inputs[k];
            const std::string name = ascii_identifier(f.name);
            for (std::size_t order = 0; order < 3; ++order) {
                if (order > 0 && !dependence_.uses_rate(k, order)) continue;
                inputs_[3 * static_cast<int>(k) + static_cast<int>(order)] =
                    add({.kind = Kind::input,
                         .place = static_cast<int>(3 * k + order),
                         .name = order == 0   ? name
                                 : order == 1 ? fmt::format("der({})", name)
                                              : fmt::format("der({},2)", name),
                         .about = order == 0 ? f.about : std::string(),
                         .unit = order == 0 ? f.unit : per_second(f.unit, static_cast<int>(order)),
                         .start = value_of(f.shown[order])});
            }
        }
    }

    double value_of(const std::string& output) const {
        for (const Root& root : p_.roots)
            if (root.group == Group::output && root.name == output) return values_[root.node];
        return 0;
    }

    std::string unit_of_output(const std::string& name) const {
        if (is_si())
            for (const Output& output : m_.scene.outputs)
                if (output.name.text == name) return si_unit_of(output.value, m_.scene).value_or("");
        return {};
    }

    void add_parameters() {
        std::map<std::string, std::string> about;
        for (const Parameter& p : m_.scene.parameters) about[p.name.text] = p.about;
        for (std::size_t k = 0; k < m_.own_parameters(); ++k)
            parameters_[static_cast<int>(k)] = add({.kind = m_.tied[k] ? Kind::tied_parameter : Kind::parameter,
                                                    .place = static_cast<int>(k),
                                                    .name = ascii_identifier(p_.parameters[k].name),
                                                    .about = about[p_.parameters[k].name],
                                                    .unit = p_.parameters[k].unit,
                                                    .shown = unit_of_name(m_.scene, p_.parameters[k].name),
                                                    .start = m_.start.parameters[k]});
    }

    void add_roots(Kind kind, Group group, int& place, const std::set<std::string>& hidden = {}) {
        for (const Root& root : p_.roots) {
            if (root.group != group) continue;
            const int here = place++;
            if (hidden.contains(root.name)) continue;
            const int side = kind == Kind::event ? here - static_cast<int>(m_.mechanism.events.size()) + 1 : 0;
            const std::string name = side > 0              ? fmt::format("event.side_{}", side)
                                     : kind == Kind::event ? "event." + ascii_identifier(root.name)
                                                           : ascii_identifier(root.name);
            node_of_[add({.kind = kind,
                          .place = here,
                          .name = name,
                          .unit = group == Group::output ? unit_of_output(root.name) : std::string(),
                          .is_output = kind == Kind::output})] = root.node;
        }
    }

    void add_values() {
        const char* const names[] = {"energy.kinetic", "energy.potential", "energy.total", "energy.power"};
        const char* const meanings[] = {"T", "V", "T + V",
                                        "power of the loads that are not in V and of prescribed motions"};
        const Group groups[] = {Group::kinetic, Group::potential, Group::energy, Group::power};
        for (int k = 0; k < 4; ++k)
            for (const int node : p_.nodes_of(groups[k]))
                node_of_[add({.kind = Kind::energy,
                              .place = k,
                              .name = names[k],
                              .about = meanings[k],
                              .unit = !is_si() ? ""
                                      : k < 3  ? "J"
                                               : "W",
                              .is_output = true})] = node;
        std::set<std::string> hidden;
        for (const FreeInput& f : m_.inputs) hidden.insert(f.shown.begin(), f.shown.end());
        int outputs = 0, multipliers = 0, events = 0;
        add_roots(Kind::output, Group::output, outputs, hidden);
        if (p_.speeds.empty()) add_roots(Kind::output, Group::speed, outputs);  // otherwise they are states
        add_roots(Kind::multiplier, Group::multiplier, multipliers);
        for (const std::string& force : m_.contact_forces)
            add({.kind = Kind::multiplier, .place = multipliers++, .name = ascii_identifier(force)});
        add_roots(Kind::event, Group::event, events);
        // The rates of the functions whose signs are held come last, then clocks: they are no indicators.
        list_.resize(list_.size() - static_cast<std::size_t>(m_.signs) - m_.clocks.size());
    }

    /// Forces of contacts depend on all that is known, and with them accelerations and outputs.
    std::set<int> all_known() const {
        std::set<int> known;
        for (std::size_t k = 0; k < list_.size(); ++k)
            if (const Kind kind = list_[k].kind;
                kind == Kind::time || kind == Kind::state || kind == Kind::input || list_[k].is_parameter())
                known.insert(static_cast<int>(k));
        return known;
    }

    void depend(UnitVariable& variable, int node) {
        std::set<int> known;
        if (m_.contacts > 0) known = all_known();
        const int n = static_cast<int>(m_.coordinates());
        for (const auto& [kind, index] : dependence_.of(node)) {
            if (m_.contacts > 0) break;
            if (kind == Variable::Kind::time) known.insert(0);
            if (kind == Variable::Kind::coordinate) known.insert(1 + index);
            if (kind == Variable::Kind::rate) known.insert(1 + n + index);
            if (kind != Variable::Kind::parameter) continue;
            const int first = static_cast<int>(m_.own_parameters()), count = static_cast<int>(m_.inputs.size());
            if (index < first)
                known.insert(parameters_.at(index));
            else if (index < first + 4 * count && (index - first) % 4 > 0) {
                const auto input = inputs_.find(3 * ((index - first) / 4) + (index - first) % 4 - 1);
                if (input != inputs_.end()) known.insert(input->second);
            }
        }
        variable.dependencies.assign(known.begin(), known.end());
    }

    void find_dependencies() {
        const std::vector<int> rates = p_.nodes_of(Group::rate), accelerations = p_.nodes_of(Group::acceleration);
        for (std::size_t k = 0; k < list_.size(); ++k) {
            UnitVariable& variable = list_[k];
            if (variable.kind == Kind::rate) {
                const auto place = static_cast<std::size_t>(variable.place);
                depend(variable,
                       place < m_.coordinates() ? rates[place] : accelerations[place - m_.coordinates()]);
            } else if (variable.is_state()) {
                variable.dependencies = {static_cast<int>(k)};
            } else if (const auto node = node_of_.find(static_cast<int>(k)); node != node_of_.end()) {
                depend(variable, node->second);
            }
        }
    }

    const UnitModel& m_;
    const Program& p_;
    Dependence dependence_;
    std::vector<double> values_;
    std::vector<UnitVariable> list_;
    std::set<std::string> names_;
    std::map<int, int> inputs_, parameters_, node_of_;
};

}  // namespace

std::vector<UnitVariable> unit_variables(const UnitModel& model) {
    return Listing(model).list();
}

std::vector<int> state_rates(const std::vector<UnitVariable>& variables) {
    std::vector<int> result;
    for (std::size_t state = 0; state < variables.size(); ++state) {
        if (!variables[state].is_state()) continue;
        for (std::size_t k = 0; k < variables.size(); ++k)
            if (variables[k].derivative_of == static_cast<int>(state)) result.push_back(static_cast<int>(k));
    }
    return result;
}

}  // namespace alembert
