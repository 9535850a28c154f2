// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/slip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "check/claim_parts.hpp"
#include "check/nearest.hpp"
#include "notation/readable.hpp"
#include "notation/text.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

class Search {
public:
    Search(const Claim& claim, const ex& residual, const Mechanism& m, const Equations& e, const Judge& judge)
        : claim_(claim), m_(m), e_(e), judge_(judge), parts_(claim), nearest_(nearest_equation(residual, m, e)) {
        find_lengths();
    }

    std::optional<Slip> find() {
        signs();
        if (!found_) trigonometry();
        if (!found_) arguments();
        // At rest a rate is zero, whatever it multiplies; the rates after an impact have no derivatives.
        if (!found_ && claim_.at == Claim::At::motion) dots();
        if (!found_) parameters(true);
        if (!found_) numbers();
        if (!found_) parameters(false);
        if (!found_ && claim_.at == Claim::At::impact) dots();
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

    // Asking

    /// The claim with these sides, if it is right.
    std::optional<std::string> ask(const std::string& lhs, const std::string& rhs) {
        asked_ += lhs.size() + rhs.size();
        if (asked_ > most_asked) return std::nullopt;
        std::vector<Diagnostic> mistakes;
        Claim repaired = claim_;
        repaired.equation = parse_equality(lhs + " = " + rhs, {}, mistakes, claim_.at == Claim::At::impact);
        if (!mistakes.empty() || !repaired.equation.lhs || !repaired.equation.rhs || !judge_.is_right(repaired))
            return std::nullopt;
        return text_of(repaired.equation);
    }

    bool try_change(const TextStretch& at, const std::string& by, const std::string& kind,
                    const std::string& term) {
        if (found_) return true;
        std::array<std::string, 2> sides = parts_.sides();
        sides[at.left ? 0 : 1].replace(static_cast<std::size_t>(at.offset), static_cast<std::size_t>(at.length),
                                       by);
        if (const auto right = ask(sides[0], sides[1])) found_ = Slip{kind, term, *right};
        return found_.has_value();
    }

    /// The same inside a term. A change that makes the term vanish on every motion is no correction.
    bool try_change(const ClaimLeaf& leaf, const TextStretch& at, const std::string& by, const std::string& kind) {
        if (found_ || !try_change(at, by, kind, parts_.trimmed(leaf.whole))) return found_.has_value();
        std::string term = parts_.slice(leaf.term);
        term.replace(static_cast<std::size_t>(at.offset - leaf.term.offset), static_cast<std::size_t>(at.length),
                     by);
        std::vector<Diagnostic> mistakes;
        const bool alone =
            parts_.trimmed({leaf.term.left, 0, static_cast<int>(parts_.side(leaf.term.left).size())}) ==
            parts_.trimmed(leaf.term);
        if (const Expression changed =
                parse_equality(term + " = 0", {}, mistakes, claim_.at == Claim::At::impact).lhs;
            !alone && changed.tree && judge_.vanishes(changed))
            found_.reset();
        return found_.has_value();
    }
    bool try_change(const ClaimLeaf& leaf, const std::string& by, const std::string& kind) {
        return try_change(leaf, leaf.at, by, kind);
    }

    // The changes

    void signs() {
        for (const ClaimSummand& s : parts_.summands()) {
            const std::string kind = s.in_angle ? "wrong_argument" : "sign", term = parts_.trimmed(s.whole);
            if (s.first && s.negated)
                try_change({s.at.left, s.at.offset, 1}, "", kind, term);
            else if (s.first)
                try_change(s.at, s.compound ? "-(" + parts_.slice(s.at) + ")" : "-" + parts_.slice(s.at), kind,
                           term);
            else if (const auto sign = parts_.operator_before(s))
                try_change(*sign, s.negated ? "+" : "-", kind, term);
            if (found_) return;
        }
    }

    void trigonometry() {
        for (const ClaimLeaf& leaf : parts_.leaves()) {
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
        for (const ClaimLeaf& leaf : parts_.leaves())
            if (is_trig(leaf)) add(argument(leaf));
        for (const ClaimLeaf& leaf : parts_.leaves()) {
            if (!is_trig(leaf)) continue;
            for (const std::string& candidate : candidates)
                if (candidate != argument(leaf) &&
                    try_change(leaf, leaf.tree->text + "(" + candidate + ")", "wrong_argument"))
                    return;
        }
    }

    static bool is_trig(const ClaimLeaf& leaf) {
        return leaf.tree->kind == Kind::call &&
               (leaf.tree->text == "sin" || leaf.tree->text == "cos" || leaf.tree->text == "tan");
    }
    std::string argument(const ClaimLeaf& leaf) const {
        return parts_.trimmed(ClaimParts::stretch(*leaf.tree->args[0], leaf.at.left));
    }

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
            for (const ClaimLeaf& leaf : parts_.leaves()) {
                if (leaf.tree->kind != Kind::name || !has_rate(leaf.tree->text) || leaf.in_angle) continue;
                const int primes = leaf.tree->primes + more;
                if (primes < 0 || primes > 2) continue;
                if (try_change(leaf, leaf.tree->text + std::string(static_cast<std::size_t>(primes), '\''),
                               "lost_dot"))
                    return;
            }
        // θ'² written θ'
        for (const ClaimLeaf& leaf : parts_.leaves())
            if (leaf.tree->kind == Kind::name && has_rate(leaf.tree->text) && leaf.tree->primes == 1 &&
                try_change(leaf, "(" + parts_.slice(leaf.at) + ")^2", "lost_dot"))
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

    /// Replaces a parameter by another, adds one or removes one, among the lengths or among the others.
    void parameters(bool lengths) {
        const std::string kind = lengths ? "wrong_arm" : "factor";
        for (const ClaimLeaf& leaf : parts_.leaves()) {
            if (leaf.tree->kind != Kind::name || lengths_.contains(leaf.tree->text) != lengths) continue;
            if (std::find(parameters_.begin(), parameters_.end(), leaf.tree->text) == parameters_.end()) continue;
            for (const std::string& other : parameters_)
                if (other != leaf.tree->text && lengths_.contains(other) == lengths &&
                    try_change(leaf, other, kind))
                    return;
            const std::optional<TextStretch> removable = parts_.with_its_star(leaf.at);
            if (removable ? try_change(leaf, *removable, "", kind) : try_change(leaf, "1", kind)) return;
            for (const char* exponent : {"2", "3", "-1"})
                if (try_change(leaf, leaf.tree->text + "^" + exponent, kind)) return;
        }
        for (const ClaimSummand& s : parts_.summands())
            for (const std::string& name : parameters_)
                if (lengths_.contains(name) == lengths)
                    for (const char* operation : {"*", "/"})
                        if (try_change(s.at, parts_.scaled(s, operation, name), kind, parts_.trimmed(s.whole)))
                            return;
    }

    void numbers() {
        for (const char* other : {"1", "2", "3", "4", "1/2", "6", "8", "12"})
            for (const ClaimLeaf& leaf : parts_.leaves())
                if (leaf.tree->kind == Kind::number && !leaf.exponent && leaf.tree->text != other &&
                    try_change(leaf, other, leaf.in_angle ? "wrong_argument" : "factor"))
                    return;
        for (const char* factor : {"2", "1/2", "3", "1/3", "4", "1/4", "3/2", "2/3", "4/3", "3/4", "6", "1/6", "5",
                                   "1/5", "8", "1/8", "12", "1/12"}) {
            for (const ClaimSummand& s : parts_.summands()) {
                const bool lone = s.first && s.whole.offset == s.at.offset && s.whole.length == s.at.length &&
                                  parts_.is_alone_on_its_side(s);
                if (lone) continue;
                if (try_change(s.at, parts_.scaled(s, "*", std::string("(") + factor + ")"),
                               s.in_angle ? "wrong_argument" : "factor", parts_.trimmed(s.whole)))
                    return;
            }
        }
        // For a summand that is alone on its side of the equation.
        for (const char* factor : {"2", "1/2", "3", "1/3", "4", "1/4"})
            for (const ClaimSummand& s : parts_.summands())
                if (try_change(s.at, parts_.scaled(s, "*", std::string("(") + factor + ")"),
                               s.in_angle ? "wrong_argument" : "factor", parts_.trimmed(s.whole)))
                    return;
    }

    void powers() {
        for (const ClaimLeaf& leaf : parts_.leaves()) {
            if (leaf.tree->kind != Kind::power || leaf.tree->args[1]->kind != Kind::number) continue;
            const TextStretch exponent = ClaimParts::stretch(*leaf.tree->args[1], leaf.at.left);
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
            parts_.sides()[0] + (addition.starts_with('-') ? " - " + addition.substr(1) : " + " + addition);
        if (const auto right = ask(lhs, parts_.sides()[1])) found_ = Slip{kind, term, *right};
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
        for (const ClaimSummand& s : parts_.summands()) {
            if (s.in_angle || parts_.is_only_one(s)) continue;
            TextStretch gone = s.at;
            if (!s.first && !s.negated) {
                const auto sign = parts_.operator_before(s);
                if (!sign) continue;
                gone = {s.at.left, sign->offset, s.at.offset + s.at.length - sign->offset};
            }
            if (try_change(gone, s.first ? "0" : "", "extra_term", parts_.trimmed(s.at))) return;
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
        for (const ClaimSummand& s : parts_.summands())
            if (s.whole.offset == s.at.offset && s.whole.left == s.at.left && !s.in_angle)
                own.push_back(
                    "(" +
                    parts_.trimmed(s.negated ? TextStretch{s.at.left, s.at.offset + 1, s.at.length - 1} : s.at) +
                    ")");
        for (const bool there : {true, false}) {
            const auto terms = judge_.absent(claim_, there ? own : std::vector<std::string>());
            for (std::size_t k = 0; k < std::min(most_tried, terms.size()) && !found_; ++k) {
                const auto& [by, term] = terms[k];
                const std::string more = term == "1"  ? by
                                         : by == "1"  ? term
                                         : by == "-1" ? "-" + term
                                                      : by + "*" + term;
                if (const auto right =
                        ask(parts_.sides()[0] + (more[0] == '-' ? " - " + more.substr(1) : " + " + more),
                            parts_.sides()[1]))
                    found_ = there ? Slip{"factor", term, *right} : Slip{"missing_term", more, *right};
            }
        }
    }

    const Claim& claim_;
    const Mechanism& m_;
    const Equations& e_;
    const Judge& judge_;
    ClaimParts parts_;
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
