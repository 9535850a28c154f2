// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/writer.hpp"

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "emit/crowding.hpp"
#include "emit/schedule.hpp"

namespace alembert {

namespace {

constexpr std::size_t widest_group = 8;  // angles whose sines the emitted `sincos` takes at once
constexpr std::size_t readable_statements = 60;  // beyond, sections give way to speed
constexpr int widest_expression = 10;  // operations in one statement, so that it can be read
constexpr int step = 4, division = 14, most_steps = 4;  // cycles; operations that wait for each other in one statement

bool is_trigonometric(const Node& node) { return node.op == Op::sin || node.op == Op::cos; }

std::string digits(const cln::cl_I& value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

}  // namespace

std::string shortest(double value) { return fmt::format("{}", value); }

std::string number_text(const Rational& value) {
    const cln::cl_I numerator = cln::numerator(value), denominator = cln::denominator(value);
    const cln::cl_I largest = cln::expt_pos(cln::cl_I(2), 53);
    if (denominator == 1 && cln::abs(numerator) <= largest) return fmt::format("Real({})", digits(numerator));
    const double nearest = cln::double_approx(value);
    // A decimal such as 9.81 is itself when its digits are; 1/3 is left to Real's own division.
    cln::cl_I rest = denominator;
    while (cln::zerop(cln::mod(rest, 2))) rest = cln::exquo(rest, 2);
    while (cln::zerop(cln::mod(rest, 5))) rest = cln::exquo(rest, 5);
    if (rest != 1 && cln::abs(numerator) <= largest && denominator <= largest)
        return fmt::format("(Real({}) / Real({}))", digits(numerator), digits(denominator));
    return fmt::format("Real({})", shortest(nearest));
}

void Writer::count_uses(const std::vector<Goal>& goals) {
    std::vector<int> stack;
    const auto use = [&](int node, int times) {
        int& count = uses_[node];
        if (count == 0) stack.push_back(node);
        count += times;
    };
    for (const Goal& goal : goals) use(goal.node, 1);
    while (!stack.empty()) {
        const int id = stack.back();
        stack.pop_back();
        if (is_leaf(id)) continue;
        const Node& node = program_[id];
        for (std::size_t k = 0; k < node.args.size(); ++k)
            use(node.args[k], node.exponents.empty() ? 1 : std::abs(node.exponents[k]));
    }
}

void Writer::choose_statements(const std::vector<Goal>& goals) {
    const auto simple = [&](int id) {
        const Node& node = program_[id];
        return is_leaf(id) || node.is_number() || node.op == Op::pi ||
               (node.is_scaled() && is_leaf(node.args[0]) && cln::equal(node.coefficients[0], -1));
    };
    std::map<int, int> length;  // operations that stay in place, by node
    for (const auto& [id, count] : uses_) {
        const Node& node = program_[id];
        if (simple(id)) continue;
        int operations = 0;
        for (std::size_t k = 0; k < node.args.size(); ++k)
            operations += 1 + (wanted_.contains(node.args[k]) ? 0 : length[node.args[k]]);
        // The longest argument goes first until the rest fits on a line.
        while (operations > widest_expression) {
            int longest = -1;
            for (const int arg : node.args)
                if (!wanted_.contains(arg) && length[arg] > 0 && (longest < 0 || length[arg] > length[longest]))
                    longest = arg;
            if (longest < 0) break;
            wanted_.emplace(longest, "");
            operations -= length[longest];
        }
        const bool negation = node.is_scaled() && cln::equal(node.coefficients[0], -1);
        if ((count > 1 && !negation) || is_trigonometric(node)) {
            wanted_.emplace(id, "");
        }
        length[id] = operations;
    }
    // An argument of sin or cos that is more than a name gets one: phi0.
    for (const auto& [id, count] : uses_) {
        const Node& node = program_[id];
        if (!is_trigonometric(node) || is_leaf(id)) continue;
        if (!simple(node.args[0])) wanted_.emplace(node.args[0], "");
        auto& [sine, cosine] = sines_.try_emplace(node.args[0], -1, -1).first->second;
        (node.op == Op::sin ? sine : cosine) = id;
    }
    for (const Goal& goal : goals)
        if (!simple(goal.node) && !goal.name.empty()) {
            std::string& wish = wanted_[goal.node];
            if (wish.empty()) wish = goal.name;
            if (goal.own_name) promised_.emplace(goal.node, goal.name);
        }
}

std::vector<Passage> Writer::write(const std::vector<Goal>& goals) {
    leaves_ = named_;
    std::vector<int> nodes;
    for (const Goal& goal : goals) nodes.push_back(goal.node);
    ready_.emplace(program_, nodes);
    count_uses(goals);
    choose_statements(goals);

    // Which sections need a node: bits in the order of the goals' sections.
    std::vector<std::string> titles{"Trigonometry", "Shared terms"};
    std::map<int, unsigned> needed_by;
    std::map<std::string, std::vector<int>> roots_of;
    for (const Goal& goal : goals) {
        if (std::find(titles.begin(), titles.end(), goal.section) == titles.end()) titles.push_back(goal.section);
        roots_of[goal.section].push_back(goal.node);
    }
    for (std::size_t s = titles.size(); s-- > 2;)
        for (const int id : program_.needed(roots_of[titles[s]])) needed_by[id] |= 1U << s;
    std::vector<int> trigonometric;
    for (const auto& [id, count] : uses_)
        if (is_trigonometric(program_[id]) && !is_leaf(id)) trigonometric.push_back(id);
    for (const int id : program_.needed(trigonometric)) needed_by[id] |= 1U;

    // What the last section ("solve") needs besides one other belongs to that other; no node comes after its users.
    const unsigned last = titles.size() > 3 ? 1U << (titles.size() - 1) : 0U;
    std::map<int, std::size_t> place;
    for (const auto& [id, count] : uses_) {
        const unsigned bits = needed_by[id];
        const unsigned own = (bits & ~last) != 0 ? bits & ~last : bits;
        std::size_t s = 0;
        while (s < titles.size() && (own >> s) != 1U) ++s;
        place[id] = (bits & 1U) != 0 ? 0 : (own & (own - 1)) != 0 ? 1 : s;
    }
    for (std::size_t s = 2; s < titles.size(); ++s)
        for (const int id : roots_of[titles[s]])
            if (place[id] != 0) place[id] = s;
    for (auto user = place.rbegin(); user != place.rend(); ++user)
        for (const int arg : program_[user->first].args)
            if (const auto it = place.find(arg); it != place.end()) it->second = std::min(it->second, user->second);

    std::vector<Passage> sections(titles.size());
    for (std::size_t s = 0; s < titles.size(); ++s) sections[s].title = titles[s];
    std::vector<int> first;
    for (const auto& [id, wish] : wanted_)
        if (place[id] == 0 && !named_.contains(id)) first.push_back(id);
    sections[0].lines = trigonometry(first);
    if (ready_->is_ordered() && wanted_.size() > readable_statements) {
        sections.resize(1);
        sections.push_back({"All else, in the order in which it is ready", {}});
        std::vector<int> statements;
        for (const int id : scheduled(program_, *ready_, nodes, [&](int node) { return place[node] == 0 || is_leaf(node) || named_.contains(node); }))
            if (wanted_.contains(id) && !named_.contains(id)) statements.push_back(id);
        for (const int id : in_registers(statements)) sections[1].lines.push_back(statement(id));
    } else {
        for (std::size_t s = 1; s < titles.size(); ++s)
            for (const auto& [id, wish] : wanted_)
                if (place[id] == s && !named_.contains(id)) sections[s].lines.push_back(statement(id));
    }
    std::erase_if(sections, [](const Passage& section) { return section.lines.empty(); });
    return sections;
}

/// Each statement with what stands in place in it.
std::vector<int> Writer::in_registers(const std::vector<int>& nodes) const {
    std::map<int, int> position;
    for (std::size_t k = 0; k < nodes.size(); ++k) position.emplace(nodes[k], static_cast<int>(k));
    std::vector<Computation> statements;
    for (const int id : nodes) {
        Computation made{.needs = {}, .operations = 0, .latency = 0};
        std::vector<int> stack{id};
        while (!stack.empty()) {
            const Node& node = program_[stack.back()];
            stack.pop_back();
            made.operations += std::max(1, static_cast<int>(node.args.size()) - 1);
            if (node.is_reciprocal()) made.latency += division;
            for (const int arg : node.args)
                if (const auto known = position.find(arg); known != position.end())
                    made.needs.push_back(known->second);
                else if (!is_leaf(arg) && !named_.contains(arg) && !program_[arg].args.empty())
                    stack.push_back(arg);
        }
        std::sort(made.needs.begin(), made.needs.end());
        made.needs.erase(std::unique(made.needs.begin(), made.needs.end()), made.needs.end());
        made.latency += step * std::min(most_steps, made.operations);
        statements.push_back(std::move(made));
    }
    std::vector<int> result;
    for (const int k : uncrowded(statements)) result.push_back(nodes[k]);
    return result;
}

std::vector<std::string> Writer::trigonometry(const std::vector<int>& nodes) {
    std::map<int, int> depth;  // how many sines of sines there are in a node
    int deepest = 0;
    for (const auto& [id, count] : uses_) {
        if (is_leaf(id)) continue;
        int& own = depth[id];
        for (const int arg : program_[id].args) own = std::max(own, depth[arg]);
        deepest = std::max(deepest, own += is_trigonometric(program_[id]) ? 1 : 0);
    }
    std::vector<std::string> lines;
    for (int d = 0; d <= deepest; ++d) {
        for (const int id : nodes)
            if (!is_trigonometric(program_[id]) && depth[id] == d) lines.push_back(statement(id));
        std::vector<int> arguments, first;  // and the first node of each
        for (const int id : nodes)
            if (const int argument = program_[id].args.empty() ? -1 : program_[id].args[0];
                is_trigonometric(program_[id]) && depth[id] == d + 1 && std::find(arguments.begin(), arguments.end(), argument) == arguments.end()) {
                arguments.push_back(argument);
                first.push_back(id);
            }
        const std::vector<AngleSum> sums = adds_angles_ ? taken_out_sums(arguments, first) : std::vector<AngleSum>();
        for (std::size_t begin = 0; begin < arguments.size(); begin += widest_group) {
            const std::size_t end = std::min(begin + widest_group, arguments.size());
            if (end - begin == 1) {
                lines.push_back(statement(first[begin]));
                continue;
            }
            const std::string group = names_.numbered("trig");
            std::string of, values;
            for (std::size_t k = begin; k < end; ++k) {
                const auto [sine, cosine] = sines_[arguments[k]];
                const std::string base = trigonometric_name(arguments[k]);
                of += (of.empty() ? "" : ", ") + text(arguments[k], additive);
                const auto value = [&](int node, const char* part) {
                    const bool is_added = std::any_of(sums.begin(), sums.end(), [&](const AngleSum& sum) { return sum.a == arguments[k] || sum.b == arguments[k]; });
                    if (node < 0 && !is_added) return;
                    const std::string name = names_.fresh((part[0] == 's' ? "sin_" : "cos_") + base);
                    (part[0] == 's' ? sine_names_ : cosine_names_)[arguments[k]] = name;
                    if (node >= 0) named_[node] = name;
                    values += fmt::format("{}{} = {}.{}[{}]", values.empty() ? "" : ", ", name, group, part, k - begin);
                };
                value(sine, "sine");
                value(cosine, "cosine");
            }
            lines.push_back(fmt::format("const auto {} = sincos({});", group, of));
            lines.push_back("const Real " + values + ";");
        }
        for (const AngleSum& sum : sums) {
            const auto [sine, cosine] = sines_[sum.argument];
            const std::string base = trigonometric_name(sum.argument);
            const std::string &sa = sine_names_[sum.a], &ca = cosine_names_[sum.a], &sb = sine_names_[sum.b], &cb = cosine_names_[sum.b];
            if (sine >= 0) lines.push_back(fmt::format("const Real {} = {} * {} {} {} * {};", named_[sine] = names_.fresh("sin_" + base), sa, cb, sum.is_difference ? '-' : '+', ca, sb));
            if (cosine >= 0) lines.push_back(fmt::format("const Real {} = {} * {} {} {} * {};", named_[cosine] = names_.fresh("cos_" + base), ca, cb, sum.is_difference ? '+' : '-', sa, sb));
        }
    }
    return lines;
}

/// Those angles that are sums or differences of two others, when these fit in one group; they leave the lists.
std::vector<Writer::AngleSum> Writer::taken_out_sums(std::vector<int>& arguments, std::vector<int>& first) const {
    std::vector<AngleSum> sums;
    if (arguments.size() > widest_group) return sums;
    const std::vector<int> all = arguments;
    const auto is_alone = [&](int id) {
        return std::find(all.begin(), all.end(), id) != all.end() && (program_[id].op != Op::sum || program_[id].is_scaled());
    };
    for (const int id : all) {
        const Node& node = program_[id];
        if (node.op != Op::sum || node.args.size() != 2 || !cln::zerop(node.number) || !cln::equal(node.coefficients[0], 1) ||
            !cln::equal(cln::abs(node.coefficients[1]), 1) || !is_alone(node.args[0]) || !is_alone(node.args[1]))
            continue;
        sums.push_back({.argument = id, .a = node.args[0], .b = node.args[1], .is_difference = cln::minusp(node.coefficients[1])});
        const auto place = std::find(arguments.begin(), arguments.end(), id);
        first.erase(first.begin() + (place - arguments.begin()));
        arguments.erase(place);
    }
    return sums;
}

std::string Writer::trigonometric_name(int argument) {
    std::string& name = argument_names_[argument];
    if (name.empty()) {
        const auto known = named_.find(argument);
        name = known != named_.end() ? known->second : names_.numbered("angle");
    }
    return name;
}

std::string Writer::statement(int id) {
    const Node& node = program_[id];
    if (is_trigonometric(node)) {
        const int argument = node.args[0];
        const auto [sine, cosine] = sines_[argument];
        const std::string base = trigonometric_name(argument), of = text(argument, additive);
        if (sine >= 0) named_[sine] = names_.fresh("sin_" + base);
        if (cosine >= 0) named_[cosine] = names_.fresh("cos_" + base);
        if (sine >= 0 && cosine >= 0)
            return fmt::format("const auto [{}, {}] = sincos({});", named_[sine], named_[cosine], of);
        return fmt::format("const Real {} = {}({});", named_[id], name_of(node.op), of);
    }
    const std::string value = text(id, additive);
    const std::string& wish = wanted_[id];
    const auto promised = promised_.find(id);
    const std::string name = promised != promised_.end() ? promised->second
                             : !wish.empty()             ? names_.fresh(wish)
                                                         : names_.numbered(sines_.contains(id) ? "phi" : "z");
    named_[id] = name;
    return fmt::format("const Real {} = {};", name, value);
}

std::string Writer::text(int id, int precedence) {
    if (const auto known = named_.find(id); known != named_.end()) return known->second;
    const Node& node = program_[id];
    std::string result;
    int own = primary;
    switch (node.op) {
        case Op::number:
            result = number_text(node.number);
            break;
        case Op::pi: result = "Real(3.14159265358979323846264338327950288L)"; break;
        case Op::sum:
            own = node.is_scaled() && !cln::minusp(node.coefficients[0]) ? multiplicative : additive;
            result = sum_text(id, false);
            break;
        case Op::product:
            own = multiplicative;
            result = product_text(id);
            break;
        default: {
            result = fmt::format("{}({}", name_of(node.op), text(node.args[0], additive));
            for (std::size_t k = 1; k < node.args.size(); ++k) result += ", " + text(node.args[k], additive);
            result += ")";
        }
    }
    return own < precedence ? "(" + result + ")" : result;
}

std::string Writer::sum_text(int id, bool negated) {
    const Node& node = program_[id];
    struct Piece {
        bool negative;
        std::string text;
    };
    std::vector<Piece> pieces;
    for (const std::size_t k : ready_->order(id)) {
        const Rational& c = node.coefficients[k];
        const bool negative = cln::minusp(c) != negated;
        const Rational size = cln::abs(c);
        const Node& arg = program_[node.args[k]];
        if (cln::equal(size, 1)) {
            const bool is_sum = arg.op == Op::sum && !arg.is_scaled() && !named_.contains(node.args[k]);
            // −1·(a − b) reads better as b − a.
            if (negative && is_sum && node.args.size() == 1 && cln::zerop(node.number)) return sum_text(node.args[k], true);
            pieces.push_back({negative, text(node.args[k], is_sum || negative ? multiplicative : additive)});
        } else {
            pieces.push_back({negative, number_text(size) + " * " + text(node.args[k], multiplicative)});
        }
    }
    if (!cln::zerop(node.number))
        pieces.insert(ready_->is_ordered() ? pieces.begin() : pieces.end(), {cln::minusp(node.number) != negated, number_text(cln::abs(node.number))});
    // A positive term first, if there is one: b − a, not −a + b.
    const auto positive = std::find_if(pieces.begin(), pieces.end(), [](const Piece& p) { return !p.negative; });
    // But what is late stays last.
    const bool late = ready_->is_ordered() && pieces.size() > 2 && positive + 1 == pieces.end();
    if (positive != pieces.end() && !late) std::rotate(pieces.begin(), positive, positive + 1);
    std::string result = (pieces[0].negative ? "-" : "") + pieces[0].text;
    for (std::size_t k = 1; k < pieces.size(); ++k) result += (pieces[k].negative ? " - " : " + ") + pieces[k].text;
    return result;
}

std::string Writer::product_text(int sought) {
    const Node& node = program_[sought];
    std::string numerator, denominators;
    for (const std::size_t k : ready_->order(sought)) {
        const int id = node.args[k];
        const Node& arg = program_[id];
        if (node.exponents[k] < 0 || (arg.is_reciprocal() && !named_.contains(id))) {
            const int below = node.exponents[k] < 0 ? id : arg.args[0];
            for (int e = 0; e < std::abs(node.exponents[k]); ++e) denominators += " / " + text(below, primary);
            continue;
        }
        for (int e = 0; e < node.exponents[k]; ++e) {
            if (!numerator.empty()) numerator += " * ";
            numerator += text(id, multiplicative);
        }
    }
    return (numerator.empty() ? "Real(1)" : numerator) + denominators;
}

}  // namespace alembert
