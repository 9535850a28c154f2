// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/language/say.hpp"
#include "program/quotient_signs.hpp"

namespace alembert {

HeldParameters::HeldParameters(const Module& module, std::vector<double> values, int count)
    : module_(module), values_(std::move(values)), sigma_(static_cast<std::size_t>(count), 1.0) {
    par_ = prepared(module_, this->values(sigma_));
}

std::vector<double> HeldParameters::values(const std::vector<double>& sigma) const {
    std::vector<double> all = values_;
    all.insert(all.end(), sigma.begin(), sigma.end());
    return all;
}

const double* HeldParameters::with(const double* sigma) {
    if (!std::equal(sigma_.begin(), sigma_.end(), sigma)) {
        std::copy_n(sigma, sigma_.size(), sigma_.begin());
        std::copy_n(sigma, sigma_.size(), par_.begin() + static_cast<std::ptrdiff_t>(values_.size()));
        module_.table().prepare(par_.data());
    }
    return par_.data();
}

namespace {

/// A node as a person would type it, if it is short.
std::string text_of(const Program& p, int id, int depth = 0) {
    const Node& node = p[id];
    if (depth > 4) return "…";
    const auto inner = [&](int arg) { return text_of(p, arg, depth + 1); };
    const auto rational = [](const Rational& r) { return fmt::format("{:g}", cln::double_approx(r)); };
    switch (node.op) {
        case Op::number:
            return rational(node.number);
        case Op::pi:
            return "pi";
        case Op::variable: {
            const auto k = static_cast<std::size_t>(node.variable.index);
            switch (node.variable.kind) {
                case Variable::Kind::parameter:
                    return p.parameters[k].name;
                case Variable::Kind::coordinate:
                    return p.coordinates[k].name;
                case Variable::Kind::rate:
                    return p.speeds.empty() ? p.coordinates[k].name + "'" : p.speeds[k].name;
                default:
                    return "t";
            }
        }
        case Op::sum: {
            std::string text = cln::zerop(node.number) ? "" : rational(node.number);
            for (std::size_t k = 0; k < node.args.size(); ++k) {
                const Rational c = node.coefficients[k];
                text += c < 0 ? "-" : text.empty() ? "" : "+";
                if (cln::abs(c) != 1) text += rational(cln::abs(c)) + "*";
                text += inner(node.args[k]);
            }
            return depth == 0 ? text : "(" + text + ")";
        }
        case Op::product: {
            std::string text;
            for (std::size_t k = 0; k < node.args.size(); ++k) {
                text += node.exponents[k] < 0 ? (text.empty() ? "1/" : "/") : text.empty() ? "" : "*";
                text += inner(node.args[k]);
                if (std::abs(node.exponents[k]) != 1) text += fmt::format("^{}", std::abs(node.exponents[k]));
            }
            return text;
        }
        case Op::unspecified: {
            const Program::TableCall call = p.table_call(node);
            std::string text;
            for (std::size_t k = 0; k < call.arguments; ++k)
                text += (text.empty() ? "" : ", ") + text_of(p, call.argument[k], 0);
            return fmt::format("{}({})", p.functions.at(p.function_of(node)), text);
        }
        default: {
            std::string text;
            for (const int arg : node.args) text += (text.empty() ? "" : ", ") + text_of(p, arg, 0);
            return fmt::format("{}({})", name_of(node.op), text);
        }
    }
}

}  // namespace

namespace {

using Labels = std::set<std::string>;

/// The labels of springs and dampers between two points, whose lengths nobody wrote.
Labels labels_of_lengths(const Scene& scene) {
    Labels labels;
    const auto add = [&](const std::vector<Link>& links, Origin::Kind kind) {
        for (std::size_t i = 0; i < links.size(); ++i)
            if (links[i].between) labels.insert(label({kind, static_cast<int>(i)}));
    };
    add(scene.springs, Origin::Kind::spring);
    add(scene.dampers, Origin::Kind::damper);
    return labels;
}

/// The labels of parts that hold a quotient with a size, √… or |…|, above or below what moves, beside those of
/// `lengths`.
Labels labels_of_quotients(const Mechanism& m, const Labels& lengths) {
    std::vector<GiNaC::symbol> moving = m.moving();
    moving.insert(moving.end(), m.qdot.begin(), m.qdot.end());
    const auto is_size = [](const GiNaC::ex& e) {
        if (GiNaC::is_a<GiNaC::power>(e)) return !e.op(1).info(GiNaC::info_flags::integer);
        if (!GiNaC::is_a<GiNaC::function>(e)) return false;
        const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
        return name == "abs" || name == "absolute";
    };
    const auto any_part = [](const GiNaC::ex& e, const auto& has) {
        for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
            if (has(*part)) return true;
        return false;
    };
    std::vector<GiNaC::symbol> sizes, quotients;
    Labels labels;
    for (const Intermediates::Entry& entry : m.z->entries()) {
        const auto holds = [&](const std::vector<GiNaC::symbol>& of) {
            return std::any_of(entry.uses.begin(), entry.uses.end(), [&](const GiNaC::symbol& s) {
                return std::find(of.begin(), of.end(), s) != of.end();
            });
        };
        const bool has_size = holds(sizes) || any_part(entry.definition, is_size);
        if (has_size) sizes.push_back(entry.symbol);
        const bool is_written = std::none_of(entry.sources.begin(), entry.sources.end(), [&](int source) {
            return lengths.contains(m.z->source_labels()[static_cast<std::size_t>(source)]);
        });
        const bool divides = has_size && any_part(entry.definition, [&](const GiNaC::ex& part) {
                                 return GiNaC::is_a<GiNaC::power>(part) &&
                                        part.op(1).info(GiNaC::info_flags::negative) &&
                                        m.z->depends(part.op(0), moving);
                             });
        if (!is_written || !(divides || holds(quotients))) continue;
        quotients.push_back(entry.symbol);
        for (const int source : entry.sources)
            labels.insert(m.z->source_labels()[static_cast<std::size_t>(source)]);
    }
    for (const Load& load : m.loads)
        for (const Load::Pair& pair : load.pairs)
            if (m.z->depends(pair.force, quotients)) labels.insert(label(load.origin));
    return labels;
}

}  // namespace

Program with_signs_told(Prepared& prepared, const Program& program) {
    std::vector<QuotientSign> signs;
    Program made = with_quotient_signs(program, signs);
    if (signs.empty()) return made;
    const Labels lengths = labels_of_lengths(prepared.scene),
                 written = labels_of_quotients(prepared.mechanism, lengths);
    std::set<std::string> arguments;
    for (const QuotientSign& sign : signs) {
        const auto is_among = [&](const Labels& labels) {
            return std::any_of(sign.sources.begin(), sign.sources.end(), [&](int source) {
                return labels.contains(made.source_labels[static_cast<std::size_t>(source)]);
            });
        };
        if (!is_among(lengths) || is_among(written)) arguments.insert(text_of(made, sign.argument));
    }
    for (const std::string& x : arguments)
        prepared.warn(
            "quotient_of_size",
            say("warning: a quotient such as {0}/abs({0}) or {0}/sqrt(({0})^2) is followed as sign({0}), "
                "which is 0 where {0} is 0; write sign({0})\n",
                x));
    return made;
}

namespace {

/// The name of the sign of a reaction on which a friction acts; nothing for signs that the scene has.
std::optional<std::string> name_of_reaction(const Program& program, int id) {
    const std::span<const int> sources = program[id].sources;
    for (const Program::ReactionSign& one : program.reaction_signs)
        if (sources.size() == 1 && sources[0] == one.source)
            return one.is_trial ? say("a trial value of the reaction of friction '{}'", one.friction)
                                : say("the reaction of friction '{}'", one.friction);
    return std::nullopt;
}

}  // namespace

std::vector<std::string> names_of_sides(const Program& program, const Switched& s) {
    constexpr std::size_t longest = 60;
    std::vector<const Root*> frictions;
    for (const Root& root : program.roots)
        if (root.group == Group::sliding_velocity) frictions.push_back(&root);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < s.functions.size(); ++k) {
        if (!s.frictions[k].empty()) {
            names.push_back(
                say("friction '{}'", frictions[static_cast<std::size_t>(s.frictions[k][0].friction)]->name));
            continue;
        }
        const int id = s.functions[k];
        if (const auto reaction = name_of_reaction(program, id)) {
            names.push_back(*reaction);
            continue;
        }
        const std::string text = text_of(program, id);
        names.push_back(text.size() <= longest ? text : fmt::format("{}(…)", name_of(program[id].op)));
    }
    return names;
}

FilippovSystem switching_of(const Module& module, const std::vector<double>& values, const Switched& jumps,
                            std::vector<std::string> names, MotionOnSides motion) {
    const auto held = std::make_shared<HeldParameters>(module, values, jumps.held());
    FilippovSystem system;
    system.names = std::move(names);
    system.pairs = jumps.pairs;
    system.rates = [module, held, work = motion.work, correct = std::move(motion.correct)](
                       double t, const double* y, const double* sigma, double* rate) {
        const alembert_solver_table& table = module.table();
        const double* const par = held->with(sigma);
        table.rhs(t, y, par, rate);
        if (correct) correct(t, y, sigma, par, rate);
        if (work == Work::left_out) return;
        double energy[4], jacobi = 0;
        table.energy(t, y, rate, par, energy, &jacobi);
        rate[table.coordinates + table.speeds] = energy[3];
    };
    const auto events_from = [module, held](std::size_t before_end, std::size_t count) {
        return [=, all = std::vector<double>(static_cast<std::size_t>(module.table().events))](
                   double t, const double* y, const double* sigma, const double* rate, double* out) mutable {
            module.table().events_at(t, y, rate, held->with(sigma), all.data());
            std::copy_n(all.end() - static_cast<std::ptrdiff_t>(before_end), count, out);
        };
    };
    system.positional = jumps.positional;
    system.values = events_from(jumps.events(), system.numbers());
    if (jumps.bounds() > 0) system.bounds = events_from(jumps.bounds(), jumps.bounds());
    system.smooth = [held, smooth = std::move(motion.smooth)](const std::vector<double>& sigma) {
        return smooth(held->values(sigma));
    };
    return system;
}

Events first_events(const Events& all, std::size_t count, const Module& module, const std::vector<double>* par) {
    if (count == 0) return {};
    std::vector<Event> list(all.list.begin(), all.list.begin() + static_cast<std::ptrdiff_t>(count));
    return make_events(std::move(list),
                       [module, par, count](double t, const double* y, const double* rate, double* out) {
                           std::vector<double> values(static_cast<std::size_t>(module.table().events));
                           module.table().events_at(t, y, rate, par->data(), values.data());
                           std::copy_n(values.begin(), count, out);
                       });
}

std::vector<double> sides_at(const FilippovSystem& system, double t, const double* y, int dimension,
                             const std::vector<double>& sizes) {
    constexpr double on_it = 1e-9;
    return consistent_signs(
        system, [&](int k) { return on_it * sizes[static_cast<std::size_t>(k)]; }, t, y, dimension);
}

}  // namespace alembert
