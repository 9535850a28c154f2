// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The names of the state, the parameters and the constants of a Program in an emitted file.
///
///     const Vocabulary words(program);
///     words.leaves();                      // node → "theta", "l1", "k0"
///     words.inputs(writer.uses(), false);  // {"theta", "state[0]"}, {"l1", "par[2]"} …

#include <map>
#include <string>
#include <vector>

#include "codegen/emit/names.hpp"
#include "program/node_map.hpp"
#include "program/program.hpp"

namespace alembert {

/// A name that a function takes from one of its arrays.
struct ArrayInput {
    enum class Array { state, rate, par, direction, inputs };  ///< each array is declared separately
    std::string name;
    Array array;
    int place;
    const char* name_of_array() const;
    std::string source() const;  ///< "state[0]"
};

class Vocabulary {
public:
    explicit Vocabulary(const Program& program, CodeLanguage language = CodeLanguage::cpp);

    /// The names of variables and constants, by node.
    std::map<int, std::string> leaves() const;
    /// The names of variables only, for the function that computes the constants.
    std::map<int, std::string> variables() const;
    /// The variables and constants among the used nodes; with `rates_needed` also all speeds.
    std::vector<ArrayInput> inputs(const NodeMap<int>& uses, bool rates_needed) const;

    const Names& names() const { return names_; }  ///< in which all of the following are taken
    const std::vector<std::string>& q() const { return q_; }
    const std::vector<std::string>& u() const { return u_; }  ///< speeds
    const std::vector<std::string>& a() const { return a_; }  ///< their rates
    const std::vector<std::string>& par() const { return par_; }
    /// The parameters that callers give as the array `inputs`: where they begin in `par`, and how many they are.
    int first_input() const { return first_input_; }
    int inputs_from_outside() const { return inputs_; }
    bool is_from_outside(std::size_t parameter) const { return p_.parameters[parameter].from_outside; }
    const std::vector<int>& constants() const {
        return constants_;
    }  ///< nodes that depend on parameters only, in the order of `par`
    const std::string& constant(int node) const { return constant_names_.at(node); }

private:
    void find_constants();
    /// Of each node, whether it depends on an input from outside.
    std::vector<char> by_inputs() const;

    const Program& p_;
    int n_, s_, first_input_ = 0, inputs_ = 0;
    Names names_;
    std::vector<std::string> q_, u_, a_, par_;
    std::map<int, std::string> unknown_;  ///< the direction of program/tangent.hpp, by place
    std::vector<int> constants_;
    std::map<int, std::string> constant_names_;
};

/// The identifiers of the roots of these groups, as a solver's table lists outputs and events.
std::vector<std::string> root_names(const Program& program, std::initializer_list<Group> groups);

}  // namespace alembert
