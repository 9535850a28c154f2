// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes one function's statements from a Program: what is used twice gets a name, the rest stays in place.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emit/names.hpp"
#include "program/program.hpp"
#include "program/readiness.hpp"

namespace alembert {

/// Statements in the order in which a lecturer would write them.
struct Passage {
    std::string title;
    std::vector<std::string> lines;
};

/// One thing that a function computes: a node, and what its variable is to be called if it gets one.
struct Goal {
    std::string section, name;
    int node;
    bool own_name = false;  ///< `name` is taken by the caller, for this
};

class Writer {
public:
    /// `leaves`: nodes that have names already (variables, constants that `prepare` made).
    /// `adds_angles`: sin(a + b) from the sines and cosines of a and b where these are there: two operations instead of 30, as good to
    /// an ulp of 1, and further from the book.
    Writer(const Program& program, Names names, std::map<int, std::string> leaves, bool adds_angles = false)
        : program_(program), names_(std::move(names)), named_(std::move(leaves)), adds_angles_(adds_angles) {}

    /// The statements that lead to the goals, by section: trigonometry, what several sections share, then the
    /// goals' own sections in their order.
    std::vector<Passage> write(const std::vector<Goal>& goals);

    /// After `write`: an expression for a goal's value, and the leaves that were used.
    std::string value(int node) { return text(node, 0); }
    const std::map<int, int>& uses() const { return uses_; }

private:
    enum Precedence { additive = 0, multiplicative = 1, primary = 2 };
    bool is_leaf(int node) const { return leaves_.contains(node); }
    void count_uses(const std::vector<Goal>& goals);
    void choose_statements(const std::vector<Goal>& goals);
    std::string statement(int node);
    struct AngleSum {
        int argument, a, b;
        bool is_difference;
    };
    std::vector<AngleSum> taken_out_sums(std::vector<int>& arguments, std::vector<int>& first) const;
    std::vector<int> in_registers(const std::vector<int>& nodes) const;
    std::vector<std::string> trigonometry(const std::vector<int>& nodes);
    std::string trigonometric_name(int argument);
    std::string text(int node, int precedence);
    std::string sum_text(int node, bool negated);
    std::string product_text(int node);

    const Program& program_;
    std::optional<Readiness> ready_;  // in `write`
    Names names_;
    std::map<int, std::string> named_;
    std::map<int, std::string> leaves_;
    std::map<int, int> uses_;             // how often a needed node is used
    std::map<int, std::string> wanted_;   // nodes that get a statement, and the name they ask for ("" for any)
    std::map<int, std::string> promised_; // names that are theirs already
    std::map<int, std::string> argument_names_, sine_names_, cosine_names_;  // of an argument
    bool adds_angles_;
    std::map<int, std::pair<int, int>> sines_;  // argument → its sine and cosine, −1 where not needed
};

/// A rational as C++: exactly, in as few characters as that takes.
std::string number_text(const Rational& value);

/// The shortest decimal that reads back as the same double.
std::string shortest(double value);

}  // namespace alembert
