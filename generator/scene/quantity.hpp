// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a quantity may depend on, and the check that an expression obeys this.

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "scene/names.hpp"

namespace alembert {

/// What an expression may contain. Orders are the highest allowed derivatives of coordinates (-1: no coordinates
/// at all) and of inputs.
struct Legal {
    std::string subject;  ///< "a mass", for messages
    int order = -1;
    int input_order = -1;
    bool time = false;
    bool definitions = true;
    std::string advice = {};       ///< what to do instead if a rate is refused
    std::string if_changing = {};  ///< what to do instead if the time or a coordinate is refused
    const std::unordered_set<std::string>* more = nullptr;  ///< further names, those of claims
    bool multipliers = false;  ///< whether the multipliers of the scene's constraints are legal
    /// Whether momenta p_…, multipliers lambda… and derive's z1, z2 … are legal, whether known or not, and the
    /// letters of the textbook (scene/book_letters.hpp).
    bool claim = false;
};

class Quantities {
public:
    Quantities(const NameSpaces& names, std::vector<Diagnostic>& diagnostics)
        : names_(names),
          diagnostics_(diagnostics),
          values_(spellings(names.values)),
          frames_(spellings(names.frames)),
          points_(spellings(names.points)) {
        values_.insert(values_.end(), {"t", "pi"});
    }

    /// Definitions, numbers or vectors, must be described in an order in which each comes after those to which it
    /// refers.
    void describe(const Definition& definition);
    /// The same for a speed, whose form is also checked here.
    void describe(const Speed& speed);

    /// Reports unknown names, illegal contents, and vectors where a number is expected.
    void check(const Expression& expression, const Legal& legal);

    /// Warns of a plain number beyond a turn: radians that are hardly meant.
    void doubt_rotation(const Expression& angle);

    void check_point(const Name& name) { check_place(name.text, name.place, "point"); }
    void check_frame(const Name& name) { check_place(name.text, name.place, "frame"); }

    std::string suggestion(const std::string& word, const std::vector<std::string>& known);

    /// Whether an expression or a reference that was checked has this name.
    bool is_used(Declared::Kind kind, const std::string& name) const;

    /// What was met that is not wrong, but hardly meant.
    const std::vector<Diagnostic>& warnings() const { return warnings_; }

private:
    /// What an expression contains: the highest orders of derivatives, -1 for none.
    struct Contents {
        int order = -1;
        int input_order = -1;
        bool time = false;
    };
    struct Context {
        const Expression& expression;
        const Legal& legal;
        Contents contents = {};
    };

    const NameSpaces& names_;
    std::vector<Diagnostic>& diagnostics_;
    std::vector<std::string> values_, frames_, points_;      // spellings, for "did you mean"
    std::unordered_map<std::string, Contents> definitions_;  // of definitions and speeds
    std::unordered_set<std::string> vectors_;                // definitions that are vectors
    std::unordered_set<std::string> unknown_;                // each is reported once for each expression
    std::unordered_set<std::string> used_values_, used_frames_, used_points_;
    std::vector<Diagnostic> warnings_;
    int suggestions_ = 0;

    enum class Rank {
        number,
        vector,
        wrong
    };  ///< wrong: a mistake was reported, and no further mistakes are derived from it

    void complain(const Context& context, const Tree& tree, std::string message);
    Rank rank(Context& context, const Tree& tree, int raised);
    void need_scalar(Context& context, const Tree& tree, int raised);
    Rank rank_of_sum(Context& context, const Tree& tree, int raised);
    Rank rank_of_product(Context& context, const Tree& tree, int raised);
    void doubt_angle(const Context& context, const Tree& call);
    void refuse_ambiguous_unit(Context& context, const Tree& tree);
    void refuse_rate_by_diff(Context& context, const Tree& call);
    Rank rank_of_call(Context& context, const Tree& tree, int raised);
    void meet_function(Context& context, const Tree& tree);
    void meet_name(Context& context, const Tree& tree, int raised);
    void meet_unknown(Context& context, const Tree& tree, int raised);
    void meet_book_letter(Context& context, const Tree& tree, int raised);
    void meet_book_call(Context& context, const Tree& tree);
    void meet(Context& context, const Tree& tree, Contents found, int raised);
    std::string advice_on(const std::string& word) const;
    void check_place(const std::string& name, Place place, const std::string& kind);
};

}  // namespace alembert
