// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/slip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "check/nearest.hpp"
#include "notation/readable.hpp"
#include "notation/text.hpp"
#include "scene/functions.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// pos(P), ex(B) …
bool is_of_geometry(const Tree& tree) {
    const Function* const function = tree.kind == Tree::Kind::call ? find_function(tree.text) : nullptr;
    return function && (function->takes == Function::Takes::points || function->takes == Function::Takes::frames);
}

/// A part of one side's text.
struct Stretch {
    bool left = true;
    int offset = 0, length = 0;
};

/// A term of some sum at any depth, its position in the sum, and the outermost term of which it is a part.
struct Summand {
    Stretch at;
    bool first = true, negated = false, compound = false;
    Stretch whole;
    bool in_angle = false;
};

struct Leaf {
    const Tree* tree;
    Stretch at, whole;
    Stretch term;  ///< the innermost term of a sum, a derivative or a side of which it is a part
    bool in_angle = false, exponent = false;
};

class Search {
public:
    Search(const Claim& claim, const ex& residual, const Mechanism& m, const Equations& e, const Judge& judge)
        : claim_(claim), m_(m), e_(e), judge_(judge), sides_{claim.equation.lhs.text, claim.equation.rhs.text} {
        nearest_ = nearest_equation(residual, m, e);
        for (const bool left : {true, false}) {
            const Expression& side = left ? claim.equation.lhs : claim.equation.rhs;
            const Tree& tree = *side.tree;
            if (tree.kind == Tree::Kind::sum)
                for (std::size_t k = 0; k < tree.args.size(); ++k)
                    collect_summand(*tree.args[k], left, k == 0, std::nullopt, false);
            else
                collect_summand(tree, left, true, std::nullopt, false);
        }
        find_lengths();
    }

    std::optional<Slip> find() {
        signs();
        if (!found_) trigonometry();
        if (!found_) arguments();
        // At rest a rate is zero, whatever it multiplies; the rates after an impact have no derivatives.
        if (!found_ && claim_.at == "motion") dots();
        if (!found_) parameters(true);
        if (!found_) numbers();
        if (!found_) parameters(false);
        if (!found_ && claim_.at == "impact") dots();
        if (!found_) powers();
        if (!found_) missing_own();
        if (!found_) wrong_row();
        if (!found_) extra();
        if (!found_) missing();
        if (!found_ && asked_ < most_asked) absent();
        return found_;
    }

private:
    using Kind = Tree::Kind;

    // The places of the parts of a claim

    static Stretch stretch(const Tree& tree, bool left) { return {left, tree.offset, tree.length}; }

    void collect_summand(const Tree& tree, bool left, bool first, const std::optional<Stretch>& whole,
                         bool in_angle) {
        const Tree& inner = tree.kind == Kind::negate ? *tree.args[0] : tree;
        if (tree.kind == Kind::number && trimmed(stretch(tree, left)) == "0") return;
        const Stretch at = stretch(tree, left);
        summands_.push_back(
            {at, first, tree.kind == Kind::negate, inner.kind == Kind::sum, whole.value_or(at), in_angle});
        collect(tree, left, whole.value_or(at), at, in_angle);
    }

    void collect(const Tree& tree, bool left, const Stretch& whole, const Stretch& term, bool in_angle,
                 bool exponent = false) {
        if (tree.kind == Kind::name || tree.kind == Kind::number || tree.kind == Kind::power ||
            tree.kind == Kind::call)
            leaves_.push_back({&tree, stretch(tree, left), whole, term, in_angle, exponent});
        if (is_of_geometry(tree)) return;  // its names are those of points and frames
        const bool turns =
            tree.kind == Kind::call && (tree.text == "sin" || tree.text == "cos" || tree.text == "tan");
        for (std::size_t k = 0; k < tree.args.size(); ++k)
            if (tree.kind == Kind::sum)
                collect_summand(*tree.args[k], left, k == 0, whole, in_angle);
            else
                collect(*tree.args[k], left, whole,
                        tree.kind == Kind::derivative ? stretch(*tree.args[k], left) : term, in_angle || turns,
                        tree.kind == Kind::power && k == 1);
    }

    const std::string& side(bool left) const { return sides_[left ? 0 : 1]; }
    std::string slice(const Stretch& s) const {
        return side(s.left).substr(static_cast<std::size_t>(s.offset), static_cast<std::size_t>(s.length));
    }
    std::string trimmed(const Stretch& s) const {
        std::string text = slice(s);
        while (!text.empty() && text.back() == ' ') text.pop_back();
        return text;
    }

    // Asking

    /// The claim with these sides, if it is right.
    std::optional<std::string> ask(const std::string& lhs, const std::string& rhs) {
        asked_ += lhs.size() + rhs.size();
        if (asked_ > most_asked) return std::nullopt;
        std::vector<Diagnostic> mistakes;
        Claim repaired = claim_;
        repaired.equation = parse_equality(lhs + " = " + rhs, {}, mistakes, claim_.at == "impact");
        if (!mistakes.empty() || !repaired.equation.lhs || !repaired.equation.rhs || !judge_.is_right(repaired))
            return std::nullopt;
        return text_of(repaired.equation);
    }

    bool try_change(const Stretch& at, const std::string& by, const std::string& kind, const std::string& term) {
        if (found_) return true;
        std::array<std::string, 2> sides = sides_;
        sides[at.left ? 0 : 1].replace(static_cast<std::size_t>(at.offset), static_cast<std::size_t>(at.length),
                                       by);
        if (const auto right = ask(sides[0], sides[1])) found_ = Slip{kind, term, *right};
        return found_.has_value();
    }

    /// The same inside a term. A change that makes the term vanish on every motion is no correction.
    bool try_change(const Leaf& leaf, const Stretch& at, const std::string& by, const std::string& kind) {
        if (found_ || !try_change(at, by, kind, trimmed(leaf.whole))) return found_.has_value();
        std::string term = slice(leaf.term);
        term.replace(static_cast<std::size_t>(at.offset - leaf.term.offset), static_cast<std::size_t>(at.length),
                     by);
        std::vector<Diagnostic> mistakes;
        const bool alone =
            trimmed({leaf.term.left, 0, static_cast<int>(side(leaf.term.left).size())}) == trimmed(leaf.term);
        if (const Expression changed = parse_equality(term + " = 0", {}, mistakes, claim_.at == "impact").lhs;
            !alone && changed.tree && judge_.vanishes(changed))
            found_.reset();
        return found_.has_value();
    }
    bool try_change(const Leaf& leaf, const std::string& by, const std::string& kind) {
        return try_change(leaf, leaf.at, by, kind);
    }

    /// The sign before a summand that is not the first of its sum.
    std::optional<Stretch> operator_before(const Summand& s) const {
        if (s.negated) return Stretch{s.at.left, s.at.offset, 1};
        int at = s.at.offset - 1;
        while (at >= 0 && (side(s.at.left)[static_cast<std::size_t>(at)] == ' ' ||
                           side(s.at.left)[static_cast<std::size_t>(at)] == '('))
            --at;
        if (at < 0 || side(s.at.left)[static_cast<std::size_t>(at)] != '+') return std::nullopt;
        return Stretch{s.at.left, at, 1};
    }

    // The changes

    void signs() {
        for (const Summand& s : summands_) {
            const std::string kind = s.in_angle ? "wrong_argument" : "sign", term = trimmed(s.whole);
            if (s.first && s.negated)
                try_change({s.at.left, s.at.offset, 1}, "", kind, term);
            else if (s.first)
                try_change(s.at, s.compound ? "-(" + slice(s.at) + ")" : "-" + slice(s.at), kind, term);
            else if (const auto sign = operator_before(s))
                try_change(*sign, s.negated ? "+" : "-", kind, term);
            if (found_) return;
        }
    }

    void trigonometry() {
        for (const Leaf& leaf : leaves_) {
            if (leaf.tree->kind != Kind::call || (leaf.tree->text != "sin" && leaf.tree->text != "cos")) continue;
            const std::string other = leaf.tree->text == "sin" ? "cos" : "sin";
            if (try_change(leaf, {leaf.at.left, leaf.at.offset, 3}, other, "swapped_trig")) return;
        }
    }

    void arguments() {
        std::vector<std::string> candidates;
        std::set<std::string> known;
        const auto add = [&](const std::string& text) {
            if (known.insert(text).second) candidates.push_back(text);
        };
        for (const std::string& text : equation_texts()) {
            std::vector<Diagnostic> mistakes;
            const Expression e = parse_expression(text, {}, mistakes);
            if (e.tree) add_arguments(*e.tree, text, add);
        }
        for (const Leaf& leaf : leaves_)
            if (is_trig(leaf)) add(argument(leaf));
        for (const Leaf& leaf : leaves_) {
            if (!is_trig(leaf)) continue;
            for (const std::string& candidate : candidates)
                if (candidate != argument(leaf) &&
                    try_change(leaf, leaf.tree->text + "(" + candidate + ")", "wrong_argument"))
                    return;
        }
    }

    static bool is_trig(const Leaf& leaf) {
        return leaf.tree->kind == Kind::call &&
               (leaf.tree->text == "sin" || leaf.tree->text == "cos" || leaf.tree->text == "tan");
    }
    std::string argument(const Leaf& leaf) const { return trimmed(stretch(*leaf.tree->args[0], leaf.at.left)); }

    template <typename Add>
    static void add_arguments(const Tree& tree, const std::string& text, const Add& add) {
        if (tree.kind == Kind::call && (tree.text == "sin" || tree.text == "cos" || tree.text == "tan"))
            add(text.substr(static_cast<std::size_t>(tree.args[0]->offset),
                            static_cast<std::size_t>(tree.args[0]->length)));
        for (const TreePtr& arg : tree.args) add_arguments(*arg, text, add);
    }

    std::vector<std::string> equation_texts() const {
        std::vector<std::string> result;
        for (const auto& row : rows_of(m_, e_))
            if (row && row->size() > 0) result.push_back(text(readable(*row)));
        return result;
    }

    /// A coordinate, or an input: its derivatives occur too.
    bool has_rate(const std::string& name) const {
        return std::any_of(m_.q.begin(), m_.q.end(),
                           [&](const GiNaC::symbol& q) { return q.get_name() == name; }) ||
               std::any_of(m_.inputs.begin(), m_.inputs.end(),
                           [&](const Mechanism::Input& input) { return input.derivative[0].get_name() == name; });
    }

    void dots() {
        for (const int more : {1, 2, -1, -2})
            for (const Leaf& leaf : leaves_) {
                if (leaf.tree->kind != Kind::name || !has_rate(leaf.tree->text) || leaf.in_angle) continue;
                const int primes = leaf.tree->primes + more;
                if (primes < 0 || primes > 2) continue;
                if (try_change(leaf, leaf.tree->text + std::string(static_cast<std::size_t>(primes), '\''),
                               "lost_dot"))
                    return;
            }
        // θ'² written θ'
        for (const Leaf& leaf : leaves_)
            if (leaf.tree->kind == Kind::name && has_rate(leaf.tree->text) && leaf.tree->primes == 1 &&
                try_change(leaf, "(" + slice(leaf.at) + ")^2", "lost_dot"))
                return;
    }

    void find_lengths() {
        for (const Mechanism::Parameter& p : m_.parameters) {
            const std::string name = p.symbol.get_name();
            parameters_.push_back(name);
            bool is_length = p.unit == "m";
            for (const MassElement& body :
                 m_.masses)  // used if units are not given; an angular rate occurs in positions too
                for (const ex& x : body.position)
                    is_length = is_length || (p.unit.empty() && m_.z->depends(x, {p.symbol}));
            const bool without_units = m_.masses.empty() && p.unit.empty();
            if (is_length || (without_units && std::string("lLrRabdhs").find(name[0]) != std::string::npos))
                lengths_.insert(name);
        }
    }

    /// The factor with the star before it or, if it is the first, after it. Nothing if it has neither.
    std::optional<Stretch> with_its_star(const Stretch& factor) const {
        const std::string& text = side(factor.left);
        const auto begin = static_cast<std::size_t>(factor.offset),
                   end = begin + static_cast<std::size_t>(factor.length);
        const std::size_t before = text.find_last_not_of(' ', begin - 1), after = text.find_first_not_of(' ', end);
        if (begin > 0 && before != std::string::npos && text[before] == '*')
            return Stretch{factor.left, static_cast<int>(before), static_cast<int>(end - before)};
        const bool divides = begin > 0 && before != std::string::npos && text[before] == '/';
        if (!divides && after != std::string::npos && text[after] == '*')
            return Stretch{factor.left, factor.offset, static_cast<int>(after + 1 - begin)};
        return std::nullopt;
    }

    /// Replaces a parameter by another, adds one or removes one, among the lengths or among the others.
    void parameters(bool lengths) {
        const std::string kind = lengths ? "wrong_arm" : "factor";
        for (const Leaf& leaf : leaves_) {
            if (leaf.tree->kind != Kind::name || lengths_.contains(leaf.tree->text) != lengths) continue;
            if (std::find(parameters_.begin(), parameters_.end(), leaf.tree->text) == parameters_.end()) continue;
            for (const std::string& other : parameters_)
                if (other != leaf.tree->text && lengths_.contains(other) == lengths &&
                    try_change(leaf, other, kind))
                    return;
            const std::optional<Stretch> removable = with_its_star(leaf.at);
            if (removable ? try_change(leaf, *removable, "", kind) : try_change(leaf, "1", kind)) return;
            for (const char* exponent : {"2", "3", "-1"})
                if (try_change(leaf, leaf.tree->text + "^" + exponent, kind)) return;
        }
        for (const Summand& s : summands_)
            for (const std::string& name : parameters_)
                if (lengths_.contains(name) == lengths)
                    for (const char* operation : {"*", "/"})
                        if (try_change(s.at, scaled(s, operation, name), kind, trimmed(s.whole))) return;
    }

    /// The summand times or over something, its sign before it.
    std::string scaled(const Summand& s, const std::string& operation, const std::string& by) const {
        const std::string inside = s.negated ? slice({s.at.left, s.at.offset + 1, s.at.length - 1}) : slice(s.at);
        return (s.negated ? "-" : "") + std::string("(") + inside + ")" + operation + by;
    }

    void numbers() {
        for (const char* other : {"1", "2", "3", "4", "1/2", "6", "8", "12"})
            for (const Leaf& leaf : leaves_)
                if (leaf.tree->kind == Kind::number && !leaf.exponent && leaf.tree->text != other &&
                    try_change(leaf, other, leaf.in_angle ? "wrong_argument" : "factor"))
                    return;
        for (const char* factor : {"2", "1/2", "3", "1/3", "4", "1/4", "3/2", "2/3", "4/3", "3/4", "6", "1/6", "5",
                                   "1/5", "8", "1/8", "12", "1/12"}) {
            for (const Summand& s : summands_) {
                const bool lone = s.first && s.whole.offset == s.at.offset && s.whole.length == s.at.length &&
                                  sides_are_single(s);
                if (lone) continue;
                if (try_change(s.at, scaled(s, "*", std::string("(") + factor + ")"),
                               s.in_angle ? "wrong_argument" : "factor", trimmed(s.whole)))
                    return;
            }
        }
        // For a summand that is alone on its side of the equation.
        for (const char* factor : {"2", "1/2", "3", "1/3", "4", "1/4"})
            for (const Summand& s : summands_)
                if (try_change(s.at, scaled(s, "*", std::string("(") + factor + ")"),
                               s.in_angle ? "wrong_argument" : "factor", trimmed(s.whole)))
                    return;
    }

    /// Is it the only summand of the claim? "0 = 0" is no correction.
    bool is_only_one(const Summand& s) const {
        return s.whole.offset == s.at.offset && s.whole.length == s.at.length &&
               std::none_of(summands_.begin(), summands_.end(), [&](const Summand& other) {
                   return other.at.left != s.at.left || other.at.offset < s.at.offset ||
                          other.at.offset >= s.at.offset + s.at.length;
               });
    }

    bool sides_are_single(const Summand& s) const {
        return std::count_if(summands_.begin(), summands_.end(), [&](const Summand& other) {
                   return other.whole.left == s.whole.left && other.whole.offset == other.at.offset;
               }) == 1;
    }

    void powers() {
        for (const Leaf& leaf : leaves_) {
            if (leaf.tree->kind != Kind::power || leaf.tree->args[1]->kind != Kind::number) continue;
            const Stretch exponent = stretch(*leaf.tree->args[1], leaf.at.left);
            const Tree& base = *leaf.tree->args[0];
            const std::string kind =
                base.kind == Kind::name && lengths_.contains(base.text) ? "wrong_arm" : "factor";
            for (const char* other : {"1", "2", "3", "4"})
                if (try_change(leaf, exponent, other, kind)) return;
        }
    }

    // With the nearest right equation

    /// Tries the claim minus `wrong`, as text.
    bool try_without(const Fourier& wrong, const std::string& kind, const std::string& term) {
        const std::string addition = text(readable(Rational(-1) * wrong));
        const std::string lhs =
            sides_[0] + (addition.starts_with('-') ? " - " + addition.substr(1) : " + " + addition);
        if (const auto right = ask(lhs, sides_[1])) found_ = Slip{kind, term, *right};
        return found_.has_value();
    }

    /// Tries a missing term of the nearest equation as a whole.
    void missing_own() {
        if (!nearest_) return;
        const auto rows = rows_of(m_, e_);
        const auto& row = rows[static_cast<std::size_t>(nearest_->row)];
        const Fourier term = Rational(-1) * nearest_->wrong;
        for (const Fourier& part : parts_of(nearest_->scale * *row))
            if (is_zero(part - term)) try_without(nearest_->wrong, "missing_term", text(readable(term)));
    }

    /// Tries whether a force of the claim's own row was exchanged with one of another row, or a force was added
    /// from another row.
    void wrong_row() {
        if (!nearest_ || nearest_->row >= e_.size()) return;
        const auto forces = [&](int i) {
            std::vector<Fourier> result;
            GiNaC::exmap still;
            for (const GiNaC::symbol& rate : m_.qdot) still[rate] = 0;
            for (const ex& force :
                 {e_.applied[i], ex(m_.z->expand(e_.own[i]).subs(still, GiNaC::subs_options::no_pattern))})
                if (m_.z->tree_size(force) < 3000)
                    if (const auto f = fourier(m_.z->expand(force), *m_.symbols, 2000); f && f->size() > 0) {
                        result.push_back(*f);
                        const std::vector<Fourier> parts = parts_of(*f);
                        if (parts.size() > 1) result.insert(result.end(), parts.begin(), parts.end());
                    }
            return result;
        };
        // The difference that remains after the own force has been restored.
        std::vector<Fourier> left{nearest_->wrong};
        for (const Fourier& own : forces(nearest_->row)) left.push_back(nearest_->wrong - nearest_->scale * own);
        for (const Fourier& rest : left)
            for (int j = 0; j < e_.size(); ++j) {
                if (j == nearest_->row || rest.size() == 0) continue;
                for (const Fourier& other : forces(j)) {
                    const auto ratio = steady_ratio(other.terms()[0], rest.terms()[0]);
                    if (!ratio || !is_zero(rest - *ratio * other)) continue;
                    if (try_without(nearest_->wrong, "wrong_row", text(readable(rest)))) return;
                }
            }
    }

    void extra() {
        for (const Summand& s : summands_) {
            if (s.in_angle || is_only_one(s)) continue;
            Stretch gone = s.at;
            if (!s.first && !s.negated) {
                const auto sign = operator_before(s);
                if (!sign) continue;
                gone = {s.at.left, sign->offset, s.at.offset + s.at.length - sign->offset};
            }
            if (try_change(gone, s.first ? "0" : "", "extra_term", trimmed(s.at))) return;
        }
    }

    void missing() {
        if (!nearest_) return;
        const Fourier term = Rational(-1) * nearest_->wrong;
        const Phrase shown = readable(term);
        constexpr std::size_t most_missing = 3;
        if (shown.kind == Phrase::Kind::sum && shown.args.size() > most_missing) return;
        try_without(nearest_->wrong, "missing_term", text(shown));
    }

    void absent() {
        constexpr std::size_t most_tried = 12;
        // If the term is there already with another factor, the factor is wrong.
        std::vector<std::string> own;
        for (const Summand& s : summands_)
            if (s.whole.offset == s.at.offset && s.whole.left == s.at.left && !s.in_angle)
                own.push_back(
                    "(" + trimmed(s.negated ? Stretch{s.at.left, s.at.offset + 1, s.at.length - 1} : s.at) + ")");
        for (const bool there : {true, false}) {
            const auto terms = judge_.absent(claim_, there ? own : std::vector<std::string>());
            for (std::size_t k = 0; k < std::min(most_tried, terms.size()) && !found_; ++k) {
                const auto& [by, term] = terms[k];
                const std::string more = term == "1"  ? by
                                         : by == "1"  ? term
                                         : by == "-1" ? "-" + term
                                                      : by + "*" + term;
                if (const auto right =
                        ask(sides_[0] + (more[0] == '-' ? " - " + more.substr(1) : " + " + more), sides_[1]))
                    found_ = there ? Slip{"factor", term, *right} : Slip{"missing_term", more, *right};
            }
        }
    }

    const Claim& claim_;
    const Mechanism& m_;
    const Equations& e_;
    const Judge& judge_;
    std::array<std::string, 2> sides_;
    std::vector<Summand> summands_;
    std::vector<Leaf> leaves_;
    std::vector<std::string> parameters_;
    std::set<std::string> lengths_;
    std::optional<Nearest> nearest_;
    std::optional<Slip> found_;
    static constexpr std::size_t most_asked = 300000;  // in bytes of claims, which takes some tenths of a second
    std::size_t asked_ = 0;
};

}  // namespace

std::optional<Slip> likely_slip(const Claim& claim, const ex& residual, const Mechanism& mechanism,
                                const Equations& equations, const Judge& judge) {
    return Search(claim, residual, mechanism, equations, judge).find();
}

}  // namespace alembert
