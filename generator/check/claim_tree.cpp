// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/claim_tree.hpp"

#include <algorithm>

namespace alembert {

using Kind = Tree::Kind;

namespace {

const std::string loose_sum = "loose";

/// `source`: the text from which the tree was parsed; null if what is left as it was is written anew, too.
std::string written(const Tree& tree, const std::string* source);

bool is_made(const Tree& tree) {
    return tree.offset < 0;
}

std::string slice(const Tree& tree, const std::string& source) {
    std::string text = source.substr(static_cast<std::size_t>(tree.offset), static_cast<std::size_t>(tree.length));
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

std::string in_parentheses(const Tree& tree, const std::string* source, bool needed) {
    const std::string text = written(tree, source);
    return needed ? "(" + text + ")" : text;
}

bool is_atom(const Tree& tree) {
    return tree.kind == Kind::name || tree.kind == Kind::number || tree.kind == Kind::call ||
           tree.kind == Kind::derivative;
}

std::string written_product(const Tree& tree, const std::string* source) {
    std::string result;
    for (const TreePtr& factor : tree.args) {
        const bool below = factor->kind == Kind::reciprocal;
        const Tree& inner = below ? *factor->args[0] : *factor;
        if (result.empty() && below) result = "1";
        if (!result.empty()) result += below ? "/" : "*";
        result += in_parentheses(inner, source,
                                 inner.kind == Kind::sum || (inner.kind == Kind::negate && !result.empty()) ||
                                     (below && !is_atom(inner) && inner.kind != Kind::power));
    }
    return result;
}

std::string written_sum(const Tree& tree, const std::string* source) {
    const bool loose = source != nullptr && tree.text == loose_sum;
    std::string result;
    for (const TreePtr& term : tree.args) {
        const bool minus = term->kind == Kind::negate && !result.empty();
        if (!result.empty()) {
            const std::string sign = minus ? "-" : "+";
            result += loose ? " " + sign + " " : sign;
        }
        const Tree& inner = minus ? *term->args[0] : *term;
        result += in_parentheses(inner, source, minus && inner.kind == Kind::sum);
    }
    return result;
}

std::string written(const Tree& tree, const std::string* source) {
    if (source != nullptr && !is_made(tree)) return slice(tree, *source);
    switch (tree.kind) {
        case Kind::number:
            return tree.text;
        case Kind::name:
            return tree.text + std::string(static_cast<std::size_t>(tree.primes), '\'');
        case Kind::negate:
            return "-" + in_parentheses(*tree.args[0], source, tree.args[0]->kind == Kind::sum);
        case Kind::sum:
            return written_sum(tree, source);
        case Kind::product:
            return written_product(tree, source);
        case Kind::reciprocal:
            return "1/" + in_parentheses(*tree.args[0], source,
                                         !is_atom(*tree.args[0]) && tree.args[0]->kind != Kind::power);
        case Kind::power:
            return in_parentheses(*tree.args[0], source, !is_atom(*tree.args[0])) + "^" +
                   in_parentheses(*tree.args[1], source, !is_atom(*tree.args[1]));
        case Kind::derivative:
            return "(" + written(*tree.args[0], source) + ")" +
                   std::string(static_cast<std::size_t>(tree.primes), '\'');
        case Kind::call: {
            if (tree.text == "(-)") return written(*tree.args[0], source) + "(-)";
            std::string args;
            for (const TreePtr& arg : tree.args) args += (args.empty() ? "" : ", ") + written(*arg, source);
            return tree.text + "(" + args + ")";
        }
    }
    return {};
}

}  // namespace

bool is_loose(const Tree& sum, const std::string& source) {
    if (is_made(sum)) return sum.text == loose_sum;
    const std::string text = slice(sum, source);
    return text.find(" + ") != std::string::npos || text.find(" - ") != std::string::npos;
}

TreePtr made(Kind kind, std::vector<TreePtr> args, std::string text, int primes) {
    return std::make_shared<const Tree>(Tree{kind, std::move(text), primes, std::move(args), -1, 0});
}

TreePtr number_tree(long value) {
    if (value < 0) return made(Kind::negate, {number_tree(-value)});
    return made(Kind::number, {}, std::to_string(value));
}

TreePtr name_tree(const std::string& name, int primes) {
    return made(Kind::name, {}, name, primes);
}

TreePtr detached(const TreePtr& tree) {
    std::vector<TreePtr> args;
    for (const TreePtr& arg : tree->args) args.push_back(detached(arg));
    return made(tree->kind, std::move(args), tree->text, tree->primes);
}

TreePtr product_of(std::vector<TreePtr> factors) {
    return factors.size() == 1 ? factors[0] : made(Kind::product, std::move(factors));
}

std::vector<TreePtr> negated_first(std::vector<TreePtr> factors) {
    factors[0] = made(Kind::negate, {factors[0]});
    return factors;
}

Expression expression_of(const Tree& tree) {
    return {.text = {}, .places = {}, .tree = TreePtr(TreePtr(), &tree)};
}

std::pair<TreePtr, bool> without_sign(const TreePtr& tree) {
    if (tree->kind == Kind::negate) return {tree->args[0], true};
    if (tree->kind != Kind::product || tree->args[0]->kind != Kind::negate) return {tree, false};
    std::vector<TreePtr> factors = tree->args;
    factors[0] = factors[0]->args[0];
    return {made(Kind::product, std::move(factors)), true};
}

TreePtr negated(const TreePtr& tree) {
    if (tree->kind == Kind::negate) return tree->args[0];
    if (tree->kind == Kind::number && tree->text == "0") return tree;
    if (tree->kind == Kind::product)
        for (std::size_t k = 0; k < tree->args.size(); ++k) {
            const TreePtr& factor = tree->args[k];
            if (factor->kind != Kind::sum && factor->kind != Kind::negate) continue;
            if (factor->kind == Kind::sum && (factor->args.size() != 2 || factor->args[0]->kind == Kind::negate ||
                                              factor->args[1]->kind != Kind::negate))
                continue;
            std::vector<TreePtr> factors = tree->args;
            factors[k] = factor->kind == Kind::negate
                             ? factor->args[0]
                             : made(Kind::sum, {factor->args[1]->args[0], made(Kind::negate, {factor->args[0]})},
                                    loose_sum);
            return made(Kind::product, std::move(factors));
        }
    return made(Kind::negate, {tree});
}

TreePtr plus(const TreePtr& tree, const TreePtr& term, bool loose) {
    std::vector<TreePtr> terms = tree->kind == Kind::sum ? tree->args : std::vector<TreePtr>{tree};
    if (tree->kind == Kind::number && tree->text == "0") terms.clear();
    for (const TreePtr& more : term->kind == Kind::sum ? term->args : std::vector<TreePtr>{term}) {
        const auto [body, negative] = without_sign(more);
        terms.push_back(negative ? made(Kind::negate, {body}) : body);
    }
    return terms.size() == 1 ? terms[0] : made(Kind::sum, std::move(terms), loose ? loose_sum : "");
}

TreePtr with_part(const TreePtr& root, const Tree* part, const TreePtr& by, const std::string& source) {
    if (root.get() == part) return by;
    std::vector<TreePtr> args;  // copied when the first of them has changed: most parts of a tree have not
    for (std::size_t k = 0; k < root->args.size(); ++k) {
        TreePtr changed = with_part(root->args[k], part, by, source);
        if (changed == root->args[k]) continue;
        if (args.empty()) args = root->args;
        args[k] = std::move(changed);
    }
    if (args.empty()) return root;
    if (root->kind == Kind::negate && args[0]->kind == Kind::negate) return args[0]->args[0];
    if (root->kind != Kind::sum) return made(root->kind, std::move(args), root->text, root->primes);
    std::vector<TreePtr> terms;  // a sum in place of a term stands without parentheses
    for (const TreePtr& arg : args)
        if (arg->kind == Kind::sum)
            terms.insert(terms.end(), arg->args.begin(), arg->args.end());
        else
            terms.push_back(arg);
    return made(Kind::sum, std::move(terms), is_loose(*root, source) ? loose_sum : "");
}

TreePtr without_term(const TreePtr& root, const Tree* term, const std::string& source) {
    if (root.get() == term) return number_tree(0);
    if (root->kind == Kind::sum) {
        std::vector<TreePtr> terms;
        for (const TreePtr& arg : root->args)
            if (arg.get() != term) terms.push_back(arg);
        if (terms.size() == 1) return terms[0];
        if (terms.size() < root->args.size())
            return made(Kind::sum, std::move(terms), is_loose(*root, source) ? loose_sum : "");
    }
    std::vector<TreePtr> args;
    bool changed = false;
    for (const TreePtr& arg : root->args) {
        args.push_back(without_term(arg, term, source));
        changed = changed || args.back() != arg;
    }
    if (!changed) return root;
    return made(root->kind, std::move(args),
                root->kind == Kind::sum && is_loose(*root, source) ? loose_sum
                : root->kind == Kind::sum                          ? ""
                                                                   : root->text,
                root->primes);
}

std::string text_of(const Tree& tree, const std::string& source) {
    return written(tree, &source);
}

std::string plain_text_of(const Tree& tree) {
    return written(tree, nullptr);
}

bool same(const Tree& a, const Tree& b) {
    return a.kind == b.kind && a.primes == b.primes && a.args.size() == b.args.size() &&
           (a.kind == Kind::sum || a.text == b.text) &&
           std::equal(a.args.begin(), a.args.end(), b.args.begin(),
                      [](const TreePtr& x, const TreePtr& y) { return same(*x, *y); });
}

}  // namespace alembert
