// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes the statements of one function from a Program. Values that are used twice get a name, the others are
/// written in place.
///
///     Writer writer(program, words.names(), words.leaves());
///     writer.write({{"Forcing f", "f0", node}});      // passages of statements
///     writer.assigned("forcing", "forcing[0]", node); // forcing[0] = f0;
///
/// writer.cpp decides which nodes get statements, and where; writer_trigonometry.cpp writes sines and cosines,
/// writer_text.cpp all other values.

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/emit/names.hpp"
#include "codegen/emit/statement.hpp"
#include "program/node_map.hpp"
#include "program/program.hpp"
#include "program/readiness.hpp"

namespace alembert {

inline bool is_trigonometric(const Node& node) {
    return node.op == Op::sin || node.op == Op::cos;
}

class Writer {
public:
    /// `leaves` are the nodes that have names already (variables, and constants from `prepare`). With
    /// `adds_angles`, sin(a + b) is computed from the sines and cosines of a and b if these exist. That takes two
    /// operations instead of 30 and is accurate to an ulp of 1, but is less like a book. More than `longest_whole`
    /// statements will be divided into parts, and are ordered so that few values pass from one part to another.
    Writer(const Program& program, Names names, const std::map<int, std::string>& leaves, bool adds_angles = false,
           CodeLanguage language = CodeLanguage::cpp,
           std::size_t longest_whole = std::numeric_limits<std::size_t>::max())
        : program_(program),
          names_(std::move(names)),
          named_(leaves),
          adds_angles_(adds_angles),
          language_(language),
          longest_whole_(longest_whole) {}

    /// The statements that lead to the goals, by section: trigonometry, values that several sections share, then
    /// the goals' own sections in their order.
    std::vector<Passage> write(const std::vector<Goal>& goals);

    /// After `write`: the statement "to = value;" for a goal, where `to` is a place in `array`.
    CodeStatement assigned(const std::string& array, const std::string& to, int node);
    /// After `write`: the text of a goal's value, with what it uses.
    CodeStatement evaluated(int node);
    /// After `write`: an expression for a goal's value, and the leaves that were used.
    std::string value(int node) { return text(node, additive); }
    const NodeMap<int>& uses() const { return uses_; }

private:
    enum Precedence { additive = 0, multiplicative = 1, primary = 2 };
    struct AngleSum {
        int argument, a, b;
        bool is_difference;
    };
    struct Sections {
        std::vector<std::string> titles;
        NodeMap<std::size_t> place;  ///< the section of each node that the goals use
        /// Arguments of leaves belong to the first section, like sines.
        std::size_t of(int node) const {
            const auto found = place.find(node);
            return found == place.end() ? 0 : found->second;
        }
    };

    bool is_leaf(int node) const { return leaves_.contains(node); }
    bool is_simple(int node) const;
    void count_uses(const std::vector<Goal>& goals);
    void choose_statements(const std::vector<Goal>& goals);
    void shorten(int node, NodeMap<int>& length);
    Sections sections_of(const std::vector<Goal>& goals) const;
    std::vector<Passage> in_sections(const Sections& sections);
    std::vector<Passage> in_order_of_time(const Sections& sections, const std::vector<int>& nodes);
    void add_notes(std::vector<Passage>& passages, const std::vector<Goal>& goals);
    std::vector<int> in_registers(const std::vector<int>& nodes) const;
    std::vector<int> depth_first(const std::vector<int>& roots, const std::function<bool(int)>& is_done) const;

    std::vector<CodeStatement> trigonometry(const std::vector<int>& nodes);
    CodeStatement sines_together(const std::vector<int>& arguments, const std::vector<AngleSum>& sums);
    void add_angle_sum(std::vector<CodeStatement>& statements, const AngleSum& sum);
    std::vector<AngleSum> taken_out_sums(std::vector<int>& arguments, std::vector<int>& first) const;
    std::string trigonometric_name(int argument);
    CodeStatement trigonometric_statement(int node);

    CodeStatement statement(int node);
    std::string declared(const std::string& name, const std::string& value) const;  ///< the statement
    CodeStatement finished(std::vector<std::string> names, std::string text);
    std::string text(int node, int precedence);
    bool is_negative(int node) const;
    std::string unsigned_text(int node, int precedence);
    std::string sum_text(int node, bool negated);
    std::string product_text(int node);

    const Program& program_;
    std::optional<Readiness> ready_;  // set in `write`
    Names names_;
    NodeMap<std::string> named_;
    NodeMap<std::string> negatives_;  // for nodes whose negative has a name, that name
    NodeMap<std::string> leaves_;
    NodeMap<int> uses_;                    // how often a needed node is used
    NodeMap<std::string> wanted_;          // nodes that get a statement, and the name they ask for ("" for any)
    std::map<int, std::string> promised_;  // names that are reserved for these nodes
    std::map<int, std::string> wanted_negatives_;  // nodes of which the negative is written, and the name of that
    // Names for an argument and its sine and cosine.
    std::map<int, std::string> argument_names_, sine_names_, cosine_names_;
    bool adds_angles_;
    CodeLanguage language_;
    std::size_t longest_whole_;
    std::map<int, std::pair<int, int>> sines_;  // argument → its sine and cosine, −1 where not needed

    std::set<std::string> reading_;  // the names in the current statement
    int operations_ = 0;             // the operations in it
};

}  // namespace alembert
