// SPDX-License-Identifier: MIT
#include "slips.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace alembert::test {

namespace {

using Kind = Tree::Kind;

struct Side {
    std::string text;
    TreePtr tree;
};

std::vector<Side> sides_of(const std::string& equation) {
    const std::size_t equals = equation.find('=');
    std::vector<Side> result;
    for (std::string text : {equation.substr(0, equals), equation.substr(equals + 1)}) {
        text.erase(0, text.find_first_not_of(' '));
        text.erase(text.find_last_not_of(' ') + 1);
        std::vector<Diagnostic> mistakes;
        const Expression e = parse_expression(text, {}, mistakes);
        result.push_back({text, e.tree});
    }
    return result;
}

class Student {
public:
    Student(const Scene& scene, const std::vector<std::string>& right, std::size_t rows, std::size_t k)
        : right_(right), rows_(rows), k_(k), sides_(sides_of(right[k])) {
        for (const Coordinate& q : scene.coordinates) coordinates_.insert(q.name.text);
        for (const Input& input : scene.inputs) moving_.insert(input.name.text);
        std::set<std::string> in_positions;
        const auto note = [&](const Position& position) {
            for (const Expression& e : position.offset.component)
                if (e.tree) collect_names(*e.tree, in_positions);
        };
        for (const Point& p : scene.points) note(p.position);
        for (const Particle& p : scene.particles) note(p.position);
        for (const Body& b : scene.bodies) note(b.position);
        for (const Definition& d : scene.definitions)
            if (in_positions.contains(d.name.text)) collect_names(*d.value.tree, in_positions);
        for (const Parameter& p : scene.parameters) {
            const bool is_length = p.unit == "m" || (p.unit.empty() && in_positions.contains(p.name.text));
            (is_length ? lengths_ : others_).insert(p.name.text);
        }
        for (int s = 0; s < 2; ++s) {
            side_ = s;
            terms(*sides_[static_cast<std::size_t>(s)].tree, true);
            visit(*sides_[static_cast<std::size_t>(s)].tree, false, false);
        }
        wrong_rows();
        extra_terms();
    }

    std::map<std::string, std::set<std::string>> made;

private:
    static void collect_names(const Tree& tree, std::set<std::string>& names) {
        if (tree.kind == Kind::name) names.insert(tree.text);
        for (const TreePtr& arg : tree.args) collect_names(*arg, names);
    }
    bool holds_any(const Tree& tree, const std::set<std::string>& names, int primes = 0) const {
        if (tree.kind == Kind::name && names.contains(tree.text) && tree.primes >= primes) return true;
        if (tree.kind == Kind::derivative && primes > 0) return true;
        return std::any_of(tree.args.begin(), tree.args.end(),
                           [&](const TreePtr& a) { return holds_any(*a, names, primes); });
    }

    std::string slice(const Tree& tree) const {
        std::string text = sides_[static_cast<std::size_t>(side_)].text.substr(
            static_cast<std::size_t>(tree.offset), static_cast<std::size_t>(tree.length));
        text.erase(text.find_last_not_of(' ') + 1);
        return text;
    }

    /// The equation with a stretch of this side replaced.
    void change(const std::string& kind, int offset, int length, const std::string& by) {
        std::string text = sides_[static_cast<std::size_t>(side_)].text;
        text.replace(static_cast<std::size_t>(offset), static_cast<std::size_t>(length), by);
        if (text.find_first_not_of(' ') == std::string::npos) text = "0";
        const std::string other = sides_[static_cast<std::size_t>(1 - side_)].text;
        add(kind, side_ == 0 ? text + " = " + other : other + " = " + text);
    }
    void add(const std::string& kind, const std::string& equation) {
        const auto sides = sides_of(equation);
        if (equation != right_[k_] && sides[0].tree && sides[1].tree) made[kind].insert(equation);
    }

    // Terms of a sum

    void terms(const Tree& tree, bool outermost) {
        if (tree.kind == Kind::number) return;
        if (tree.kind != Kind::sum) {
            if (outermost) term(tree, true, true, side_ == 0);
            return;
        }
        for (std::size_t k = 0; k < tree.args.size(); ++k) term(*tree.args[k], k == 0, outermost);
    }

    /// The + before a term that is not the first.
    int plus_before(const Tree& tree) const {
        int at = tree.offset;
        while (sides_[static_cast<std::size_t>(side_)].text[static_cast<std::size_t>(at)] != '+') --at;
        return at;
    }

    /// From the first to one past the last character of a term, parentheses around it included.
    std::pair<int, int> with_parentheses(const Tree& tree) const {
        const std::string& text = sides_[static_cast<std::size_t>(side_)].text;
        int open = tree.offset, close = tree.offset + tree.length;
        while (open > 0 && text[static_cast<std::size_t>(open) - 1] == '(' &&
               close < static_cast<int>(text.size()) && text[static_cast<std::size_t>(close)] == ')')
            --open, ++close;
        return {open, close};
    }

    void term(const Tree& tree, bool first, bool outermost, bool alone = false) {
        const bool negated = tree.kind == Kind::negate;
        const Tree& inner = negated ? *tree.args[0] : tree;
        const std::string body = slice(inner);
        const bool moves =
            holds_any(tree, coordinates_) || holds_any(tree, moving_) || body.find("lambda") != std::string::npos;
        const std::string bracketed = inner.kind == Kind::sum ? "(" + body + ")" : body;
        // The sign
        if (negated)
            change("sign", tree.offset, 1, first ? "" : "+");
        else if (first)
            change("sign", inner.offset, static_cast<int>(body.size()), "-" + bracketed);
        else
            change("sign", plus_before(tree), 1, "-");
        if (inner.kind == Kind::number) return;
        // A factor
        if (outermost || moves)
            for (const char* times : {"2*", "3*"})
                change("factor", inner.offset, static_cast<int>(body.size()), times + bracketed);
        // Forgotten
        if (inner.kind == Kind::sum) {
            change("missing_term", inner.offset, static_cast<int>(body.size()), "0");
        } else if (!alone && (moves || outermost)) {
            const auto [open, close] = with_parentheses(tree);
            const int begin = first ? open : negated ? tree.offset : plus_before(tree);
            change("missing_term", begin, close - begin, first ? "0" : "");
        }
    }

    // Leaves

    void visit(const Tree& tree, bool in_angle, bool exponent) {
        const bool turns = tree.kind == Kind::call && (tree.text == "sin" || tree.text == "cos");
        if (tree.kind == Kind::sum && tree.offset != 0 && !in_angle) terms(tree, false);
        if (tree.kind == Kind::name && !in_angle) name(tree, false);
        if (tree.kind == Kind::power && tree.args[0]->kind == Kind::name && !in_angle) {
            squared(tree);
            name(*tree.args[0], true);
            return;
        }
        if (tree.kind == Kind::number && !in_angle && !exponent) number(tree);
        if (turns && !in_angle) trig(tree);
        for (std::size_t k = 0; k < tree.args.size(); ++k)
            visit(*tree.args[k], in_angle || turns, tree.kind == Kind::power && k == 1);
    }

    void name(const Tree& tree, bool is_base) {
        const int length = static_cast<int>(slice(tree).size());
        if (coordinates_.contains(tree.text) && tree.primes > 0)
            change("lost_dot", tree.offset, length,
                   tree.text + std::string(static_cast<std::size_t>(tree.primes - 1), '\''));
        for (const auto* names : {&lengths_, &others_}) {
            if (!names->contains(tree.text)) continue;
            const std::string kind = names == &lengths_ ? "wrong_arm" : "factor";
            for (const std::string& other : *names)
                if (other != tree.text) change(kind, tree.offset, length, other);
            if (is_base) continue;
            change(kind, tree.offset, length, tree.text + "^2");
            change(kind, tree.offset, length, "1");
        }
    }

    void number(const Tree& tree) {
        for (const char* other : {"1", "2", "3", "4"})
            if (slice(tree) != other && slice(tree) != "0")
                change("factor", tree.offset, static_cast<int>(slice(tree).size()), other);
    }

    void squared(const Tree& tree) {
        const Tree& base = *tree.args[0];
        if (slice(*tree.args[1]) != "2" || base.kind != Kind::name) return;
        const int length = static_cast<int>(slice(tree).size());
        if (coordinates_.contains(base.text) && base.primes == 1)
            change("lost_dot", tree.offset, length, slice(base));
        if (lengths_.contains(base.text)) change("wrong_arm", tree.offset, length, slice(base));
    }

    void trig(const Tree& tree) {
        change("swapped_trig", tree.offset, 3, tree.text == "sin" ? "cos" : "sin");
        const Tree& inside = *tree.args[0];
        const std::string angle = slice(inside);
        std::set<std::string> angles;
        for (std::size_t s = 0; s < 2; ++s) find_angles(*sides_[s].tree, static_cast<int>(s), angles);
        for (std::size_t other = 0; other < right_.size(); ++other) {
            const auto sides = sides_of(right_[other]);
            const auto own = sides_;
            sides_ = sides;
            for (std::size_t s = 0; s < 2; ++s) find_angles(*sides_[s].tree, static_cast<int>(s), angles);
            sides_ = own;
        }
        for (const std::string& other : angles)
            if (other != angle) change("wrong_argument", inside.offset, inside.length, other);
        if (inside.kind == Kind::name) {
            change("wrong_argument", inside.offset, inside.length, "2*" + angle);
            for (const std::string& q : angles)
                if (q != angle && q.find_first_of("+-*/") == std::string::npos)
                    change("wrong_argument", inside.offset, inside.length, angle + "+" + q);
        }
        if (inside.kind == Kind::sum && inside.args.size() == 2) {
            const bool minus = inside.args[1]->kind == Kind::negate;
            const std::string a = slice(*inside.args[0]),
                              b = slice(minus ? *inside.args[1]->args[0] : *inside.args[1]);
            change("wrong_argument", inside.offset, inside.length, a + (minus ? "+" : "-") + b);
            change("wrong_argument", inside.offset, inside.length, a);
            change("wrong_argument", inside.offset, inside.length, b);
        }
    }

    void find_angles(const Tree& tree, int side, std::set<std::string>& angles) {
        if (tree.kind == Kind::call && (tree.text == "sin" || tree.text == "cos")) {
            const int former = std::exchange(side_, side);
            angles.insert(slice(*tree.args[0]));
            side_ = former;
        }
        for (const TreePtr& arg : tree.args) find_angles(*arg, side, angles);
    }

    // Between equations

    /// Terms of an equation without rates, in positions: gravity, springs, inputs. With their sign and side.
    struct Load {
        std::string text;  ///< without sign
        bool negated;
        int side, offset, length;
        bool first;
    };
    std::vector<Load> loads(const std::vector<Side>& sides) const {
        std::vector<Load> result;
        for (int s = 0; s < 2; ++s) {
            const Tree& tree = *sides[static_cast<std::size_t>(s)].tree;
            std::vector<const Tree*> list{&tree};
            if (tree.kind == Kind::sum) {
                list.clear();
                for (const TreePtr& arg : tree.args) list.push_back(arg.get());
            }
            for (std::size_t k = 0; k < list.size(); ++k) {
                const Tree& whole = *list[k];
                const Tree& inner = whole.kind == Kind::negate ? *whole.args[0] : whole;
                std::set<std::string> names;
                collect_names(inner, names);
                const bool has_force = std::any_of(names.begin(), names.end(), [&](const std::string& n) {
                    return moving_.contains(n) || n == "g";
                });
                if (!has_force || holds_any(inner, coordinates_, 1)) continue;
                std::string text = sides[static_cast<std::size_t>(s)].text.substr(
                    static_cast<std::size_t>(inner.offset), static_cast<std::size_t>(inner.length));
                text.erase(text.find_last_not_of(' ') + 1);
                result.push_back({text, whole.kind == Kind::negate, s, whole.offset, whole.length, k == 0});
            }
        }
        return result;
    }

    void wrong_rows() {
        const std::vector<Load> own = loads(sides_);
        const auto without_parameters = [&](const std::string& load) {
            std::string bare, word;
            for (const char c : load + " ") {
                if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
                    word += c;
                    continue;
                }
                bare += (lengths_.contains(word) || others_.contains(word) ? "" : word) +
                        (std::string("*/ ()").find(c) == std::string::npos ? std::string(1, c) : "");
                word.clear();
            }
            return bare;
        };
        for (std::size_t other = 0; k_ < rows_ && other < rows_; ++other) {
            if (other == k_) continue;
            for (const Load& load : loads(sides_of(right_[other]))) {
                if (std::any_of(own.begin(), own.end(), [&](const Load& o) {
                        return without_parameters(o.text) == without_parameters(load.text);
                    }))
                    continue;
                const auto [left, right] = std::pair(sides_[0].text, sides_[1].text);
                const std::string sign = load.negated ? " - " : " + ";
                // one too many
                add("wrong_row", load.side == 0 ? left + sign + load.text + " = " + right
                                                : left + " = " + right + sign + load.text);
                // instead of the own
                for (const Load& mine : own) {
                    side_ = mine.side;
                    const bool negative =
                        (load.negated != mine.negated) != (load.side != mine.side) ? !mine.negated : mine.negated;
                    const int sign_at = mine.negated ? mine.offset : mine.first ? mine.offset : plus_at(mine);
                    std::string by = negative ? "-" : mine.first ? "" : "+";
                    if (!mine.first) by += " ";
                    change("wrong_row", sign_at, mine.offset + mine.length - sign_at, by + load.text + " ");
                }
            }
        }
    }
    int plus_at(const Load& load) const {
        int at = load.offset;
        while (sides_[static_cast<std::size_t>(load.side)].text[static_cast<std::size_t>(at)] != '+') --at;
        return at;
    }

    /// A term of inertia that is not there.
    void extra_terms() {
        std::string mass = "1", arm;
        std::set<std::string> names;
        for (const Side& side : sides_) collect_names(*side.tree, names);
        for (const std::string& n : names) {
            if (others_.contains(n) && mass == "1" && n != "g") mass = n;
            if (lengths_.contains(n) && arm.empty()) arm = "*" + n;
        }
        std::set<std::string> angles;
        for (int s = 0; s < 2; ++s) find_angles(*sides_[static_cast<std::size_t>(s)].tree, s, angles);
        const std::string angle = angles.empty() ? "" : "*sin(" + *angles.begin() + ")";
        for (const std::string& a : coordinates_)
            for (const std::string& b : coordinates_) {
                if (b < a || right_[k_].find(a + "'*" + b + "'") != std::string::npos ||
                    right_[k_].find(b + "'*" + a + "'") != std::string::npos ||
                    (a == b && right_[k_].find(a + "'^2") != std::string::npos))
                    continue;
                for (const char* sign : {" + ", " - "})
                    add("extra_term", sides_[0].text + sign + mass + arm + "*" + a + "'*" + b + "'" + angle +
                                          " = " + sides_[1].text);
            }
    }

    const std::vector<std::string>& right_;
    std::size_t rows_, k_;
    std::vector<Side> sides_;
    std::set<std::string> coordinates_, moving_, lengths_, others_;
    int side_ = 0;
};

}  // namespace

std::vector<StudentSlip> slips_of(const Scene& scene, const std::vector<std::string>& right, std::size_t rows,
                                  std::size_t k, std::mt19937& random, std::size_t each) {
    std::vector<StudentSlip> result;
    for (const auto& [kind, equations] : Student(scene, right, rows, k).made) {
        std::vector<std::string> all(equations.begin(), equations.end());
        std::shuffle(all.begin(), all.end(), random);
        for (std::size_t i = 0; i < std::min(each, all.size()); ++i) result.push_back({kind, all[i]});
    }
    return result;
}

}  // namespace alembert::test
