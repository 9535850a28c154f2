// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "program/motion_system.hpp"

namespace alembert {

const char* ArrayInput::name_of_array() const {
    constexpr const char* arrays[] = {"state", "rate", "par", "direction", "inputs"};
    return arrays[static_cast<int>(array)];
}

std::string ArrayInput::source() const {
    return fmt::format("{}[{}]", name_of_array(), place);
}

Vocabulary::Vocabulary(const Program& program, CodeLanguage language)
    : p_(program),
      n_(static_cast<int>(program.coordinates.size())),
      s_(static_cast<int>(speeds_of(program))),
      names_(language) {
    if (std::any_of(p_.parameters.begin(), p_.parameters.end(), [](const Quantity& p) { return p.from_outside; }))
        names_.fresh("inputs");
    for (const Quantity& q : p_.coordinates) {
        q_.push_back(names_.fresh(q.name));
        if (!p_.speeds.empty()) continue;
        u_.push_back(names_.fresh(q_.back() + "_dot"));
        a_.push_back(names_.fresh(q_.back() + "_ddot"));
    }
    for (const Quantity& u : p_.speeds) {
        const std::string q = u.rate_of < 0 ? "" : p_.coordinates[static_cast<std::size_t>(u.rate_of)].name;
        u_.push_back(names_.fresh(q.empty() ? u.name : q + "_dot"));
        a_.push_back(names_.fresh(q.empty() ? u_.back() + "_dot" : q + "_ddot"));
    }
    for (const Quantity& par : p_.parameters) {
        if (par.from_outside && inputs_++ == 0) first_input_ = static_cast<int>(par_.size());
        par_.push_back(names_.fresh(par.name));
    }
    for (int id = 0; id < p_.size(); ++id)
        if (const Variable& x = p_[id].variable; p_[id].op == Op::variable && x.kind == Variable::Kind::unknown)
            unknown_[x.index] = names_.fresh(fmt::format("direction_{}", x.index));
    find_constants();
}

std::vector<char> Vocabulary::by_inputs() const {
    std::vector<char> result(static_cast<std::size_t>(p_.size()), 0);
    for (int id = 0; id < p_.size() && inputs_ > 0; ++id) {
        const Node& node = p_[id];
        bool found = node.op == Op::variable && node.variable.kind == Variable::Kind::parameter &&
                     is_from_outside(static_cast<std::size_t>(node.variable.index));
        for (const int arg : node.args) found = found || result[static_cast<std::size_t>(arg)] != 0;
        result[static_cast<std::size_t>(id)] = found ? 1 : 0;
    }
    return result;
}

/// Finds the nodes that depend on parameters only and are used by nodes that depend on more.
void Vocabulary::find_constants() {
    std::vector<int> wanted;
    for (const Root& root : p_.roots) wanted.push_back(root.node);
    std::set<int> found;
    const std::vector<char> changing = by_inputs();
    const auto is_constant = [&](int id) {
        return p_[id].is_constant() && changing[static_cast<std::size_t>(id)] == 0;
    };
    const auto consider = [&](int id) {
        const Node& node = p_[id];
        if (!is_constant(id) || node.args.empty()) return;
        const bool negation = node.is_scaled() && cln::equal(node.coefficients[0], -1);
        const int kept = negation ? node.args[0] : id;
        if (!p_[kept].args.empty()) found.insert(kept);  // −p is computed from p, which is in `par` already
    };
    for (const int id : p_.needed(wanted))
        if (!is_constant(id))
            for (const int arg : p_[id].args) consider(arg);
    for (const Root& root : p_.roots) {
        consider(root.node);
        if (found.contains(root.node) && (root.group == Group::mass || root.group == Group::forcing))
            constant_names_.emplace(root.node, root.name);
    }
    constants_.assign(found.begin(), found.end());
    for (const int id : constants_) {
        std::string& name = constant_names_[id];
        name = name.empty() ? names_.numbered("k") : names_.fresh(name);
    }
}

std::map<int, std::string> Vocabulary::variables() const {
    std::map<int, std::string> leaves;
    for (int id = 0; id < p_.size(); ++id) {
        const Node& node = p_[id];
        if (node.op != Op::variable) continue;
        const auto i = static_cast<std::size_t>(node.variable.index);
        switch (node.variable.kind) {
            case Variable::Kind::parameter:
                leaves[id] = par_[i];
                break;
            case Variable::Kind::time:
                leaves[id] = "t";
                break;
            case Variable::Kind::coordinate:
                leaves[id] = q_[i];
                break;
            case Variable::Kind::rate:
                leaves[id] = u_[i];
                break;
            case Variable::Kind::acceleration:
                leaves[id] = a_[i];
                break;
            case Variable::Kind::unknown:
                leaves[id] = unknown_.at(node.variable.index);
                break;
        }
    }
    return leaves;
}

std::map<int, std::string> Vocabulary::leaves() const {
    std::map<int, std::string> leaves = variables();
    for (const int id : constants_) leaves[id] = constant_names_.at(id);
    return leaves;
}

std::vector<ArrayInput> Vocabulary::inputs(const NodeMap<int>& uses, bool rates_needed) const {
    std::vector<char> q(q_.size(), 0), u(u_.size(), rates_needed ? 1 : 0), a(a_.size(), 0), par(par_.size(), 0);
    std::set<int> direction;
    for (const auto& [id, count] : uses) {
        const Node& node = p_[id];
        if (node.op != Op::variable || constant_names_.contains(id)) continue;
        const auto i = static_cast<std::size_t>(node.variable.index);
        switch (node.variable.kind) {
            case Variable::Kind::parameter:
                par[i] = 1;
                break;
            case Variable::Kind::coordinate:
                q[i] = 1;
                break;
            case Variable::Kind::rate:
                u[i] = 1;
                break;
            case Variable::Kind::acceleration:
                a[i] = 1;
                break;
            case Variable::Kind::unknown:
                direction.insert(node.variable.index);
                break;
            case Variable::Kind::time:
                break;
        }
    }
    std::vector<ArrayInput> items;
    const auto add = [&](const std::vector<std::string>& names, const std::vector<char>& wanted,
                         ArrayInput::Array array, int first) {
        for (std::size_t i = 0; i < names.size(); ++i)
            if (wanted[i] != 0) items.push_back({names[i], array, first + static_cast<int>(i)});
    };
    add(q_, q, ArrayInput::Array::state, 0);
    add(u_, u, ArrayInput::Array::state, n_);
    add(a_, a, ArrayInput::Array::rate, n_);
    for (const int place : direction) items.push_back({unknown_.at(place), ArrayInput::Array::direction, place});
    std::vector<char> given(par_.size(), 0);
    for (std::size_t i = 0; i < par.size(); ++i)
        if (is_from_outside(i)) std::swap(par[i], given[i]);
    add(par_, par, ArrayInput::Array::par, 0);
    add(par_, given, ArrayInput::Array::inputs, -first_input_);
    for (std::size_t k = 0; k < constants_.size(); ++k)
        if (uses.contains(constants_[k]))
            items.push_back(
                {constant_names_.at(constants_[k]), ArrayInput::Array::par, static_cast<int>(par_.size() + k)});
    return items;
}

std::vector<std::string> root_names(const Program& program, std::initializer_list<Group> groups) {
    std::vector<std::string> result;
    for (const Group group : groups)
        for (const Root& root : program.roots)
            if (root.group == group) result.push_back(ascii_identifier(root.name));
    return result;
}

}  // namespace alembert
