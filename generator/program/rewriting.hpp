// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Copies a program node by node; the function given to `finish` makes the new node for each old one.
///
///     Rewriting rewriting(old);
///     return rewriting.finish([&](int id) { return rewriting.plain(id); });      // the same again

#include <functional>
#include <utility>

#include "program/program.hpp"

namespace alembert {

class Rewriting {
public:
    explicit Rewriting(const Program& old) : Rewriting(old, old.shell()) {}
    /// The copies are added to `made`.
    Rewriting(const Program& old, Program made) : old_(old), made_(std::move(made)), image_(old.size(), -1) {
        std::vector<int> roots;
        for (const Root& root : old.roots) roots.push_back(root.node);
        needed = old.needed(roots);
    }

    int plain(int id) {
        const Node& node = old_[id];
        switch (node.op) {
            case Op::number:
                return made_.number(node.number);
            case Op::pi:
                return made_.pi();
            case Op::variable:
                return made_.variable(node.variable);
            case Op::sum: {
                terms_.clear();
                for (std::size_t k = 0; k < node.args.size(); ++k)
                    terms_.emplace_back(node.coefficients[k], image_[node.args[k]]);
                return made_.sum(node.number, terms_);
            }
            case Op::product: {
                factors_.clear();
                for (std::size_t k = 0; k < node.args.size(); ++k)
                    factors_.emplace_back(image_[node.args[k]], node.exponents[k]);
                return made_.product(1, factors_);
            }
            default: {
                args_.clear();
                for (const int arg : node.args) args_.push_back(image_[arg]);
                return made_.call(node.op, args_);
            }
        }
    }

    Program finish(const std::function<int(int)>& rebuilt) {
        for (const int id : needed) {
            made_.set_sources(old_[id].sources);
            image_[id] = rebuilt(id);
        }
        made_.set_sources({0});
        for (const Root& root : old_.roots) {
            made_.roots.push_back(root);
            made_.roots.back().node = image_[root.node];
        }
        return std::move(made_);
    }

    int image(int id) const { return image_[id]; }
    Program& made() { return made_; }

    std::vector<int> needed;

private:
    const Program& old_;
    Program made_;
    std::vector<int> image_;
    std::vector<Program::Term> terms_;  // the lists of one copy
    std::vector<Program::Factor> factors_;
    std::vector<int> args_;
};

}  // namespace alembert
