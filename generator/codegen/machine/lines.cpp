// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "alembert/native/simd_math.hpp"
#include "codegen/emit/schedule.hpp"
#include "codegen/machine/pack_sines.hpp"
#include "program/interpret.hpp"
#include "program/processor.hpp"

namespace alembert::machine {

namespace {

using Function1 = double (*)(double);
using Function2 = double (*)(double, double);

const void* function_of(Op op) {
    const auto one = [](Function1 f) { return reinterpret_cast<const void*>(f); };
    const auto two = [](Function2 f) { return reinterpret_cast<const void*>(f); };
    switch (op) {
        case Op::tan:
            return one(std::tan);
        case Op::asin:
            return one(std::asin);
        case Op::acos:
            return one(std::acos);
        case Op::atan:
            return one(std::atan);
        case Op::sinh:
            return one(std::sinh);
        case Op::cosh:
            return one(std::cosh);
        case Op::tanh:
            return one(std::tanh);
        case Op::exp:
            return one(std::exp);
        case Op::log:
            return one(std::log);
        case Op::sign:
            return one(sign_for_code);
        case Op::pow:
            return two(std::pow);
        case Op::atan2:
            return two(std::atan2);
        case Op::min:
            return two(lesser_for_code);
        case Op::max:
            return two(greater_for_code);
        default:
            throw std::logic_error("no function for this operation");
    }
}

bool is_sine(const Node& node) {
    return node.op == Op::sin || node.op == Op::cos;
}

/// A value, or its negative.
struct Signed {
    int value = -1;
    bool negative = false;
    Signed operator-() const { return {value, !negative}; }
};

/// How a function for several systems is made.
struct Packing {
    Sines sines;
    int lanes;
};

class Lining {
public:
    Lining(const Program& program, const Vocabulary& words, const Readiness& ready, const FunctionTask& task,
           bool constants_are_given, std::optional<Packing> packed)
        : p_(program),
          ready_(ready),
          elsewhere_(task.elsewhere),
          value_(static_cast<std::size_t>(program.size())),
          is_leaf_(value_.size(), 0),
          uses_(value_.size(), 0) {
        if (packed) {
            lines_.lanes = packed->lanes;
            sines_ = packed->sines;
        }
        for (const FunctionArgument& a : task.arguments)
            if (a.name == "t")
                lines_.takes_time = true;
            else
                arrays_.push_back(a.name);
        lines_.arrays = static_cast<int>(arrays_.size());
        for (std::size_t k = 0; constants_are_given && k < words.constants().size(); ++k) {
            const int id = words.constants()[k];
            is_leaf_[id] = 1;
            constant_place_.emplace(id, static_cast<int>(words.par().size() + k));
        }
    }

    struct Wanted {
        int array;
        std::vector<std::size_t> places;
        int node;
    };
    Lines lines(std::span<const Wanted> wanted, std::span<const RateCopy> copies) {
        std::vector<int> roots;
        for (const Wanted& one : wanted) roots.push_back(one.node);
        const std::vector<int> nodes = counted(roots);
        std::vector<std::vector<const Wanted*>> stored(value_.size());
        for (const Wanted& one : wanted) stored[one.node].push_back(&one);
        const auto store = [&](int id) {
            for (const Wanted* one : stored[id])
                for (const std::size_t place : one->places)
                    add({.kind = Line::Kind::store,
                         .of = {whole(of(id)), -1, -1},
                         .argument = one->array,
                         .place = static_cast<int>(place)});
            stored[id].clear();
        };
        std::vector<int> done = sines_ ? std::vector<int>() : with_sines(nodes);
        std::vector<char> is_done(value_.size(), 0);
        for (const int id : done) is_done[id] = 1;
        for (const int id : done) store(id);
        for (const int id : in_order(nodes, roots, is_done)) {
            lower(id);
            if (!stored[id].empty()) store(id);
        }
        for (const int root : roots) store(root);  // leaves
        for (const RateCopy& copy : copies)
            add({.kind = Line::Kind::store,
                 .of = {leaf({.kind = Home::Kind::argument, .argument = array("state"), .place = copy.from}), -1,
                        -1},
                 .argument = array("rate"),
                 .place = copy.to});
        return std::move(lines_);
    }

    int array(const std::string& name) const {
        const auto found = std::find(arrays_.begin(), arrays_.end(), name);
        if (found == arrays_.end()) throw std::logic_error("a function without its argument " + name);
        return static_cast<int>(found - arrays_.begin());
    }

private:
    /// The nodes to compute, arguments first, and how often each is used.
    std::vector<int> counted(std::span<const int> roots) {
        std::vector<char> is_needed(value_.size(), 0);
        std::vector<int> stack, nodes;
        const auto need = [&](int id) {
            ++uses_[id];
            if (is_needed[id] != 0) return;
            is_needed[id] = 1;
            if (is_leaf_[id] == 0 && !p_[id].args.empty()) stack.push_back(id), nodes.push_back(id);
        };
        for (const int root : roots) need(root);
        while (!stack.empty()) {
            const Node& node = p_[stack.back()];
            stack.pop_back();
            for (std::size_t k = 0; k < node.args.size(); ++k)
                for (int e = node.exponents.empty() ? 1 : std::abs(node.exponents[k]); e > 0; --e)
                    need(node.args[k]);
        }
        std::sort(nodes.begin(), nodes.end());
        return nodes;
    }

    /// The nodes that are left, in the order of the program, which keeps few values in use; or, if they wait for
    /// each other longer than the units are busy, in that in which nothing waits longer than it must.
    std::vector<int> in_order(const std::vector<int>& nodes, std::span<const int> roots,
                              const std::vector<char>& is_done) const {
        constexpr double much = 1.5;
        int operations = 0, chain = 0;
        for (const int id : nodes) operations += std::max(1, static_cast<int>(p_[id].args.size()) - 1);
        for (const int root : roots) chain = std::max(chain, ready_[root]);
        std::vector<int> order;
        if (processor::fused * operations / processor::units > much * chain) {
            for (const int id : nodes)
                if (is_done[id] == 0) order.push_back(id);
            return order;
        }
        const auto is_known = [&](int id) { return is_done[id] != 0 || is_leaf_[id] != 0; };
        for (const int id : scheduled(p_, ready_, roots, is_known))
            if (std::binary_search(nodes.begin(), nodes.end(), id)) order.push_back(id);
        return order;
    }

    /// Computes all sines and cosines with what they need; gives the nodes computed.
    std::vector<int> with_sines(const std::vector<int>& nodes) {
        std::vector<int> depth(value_.size(), 0);  // how many sines are nested in a node
        std::vector<char> is_inside(value_.size(), 0);
        int deepest = 0;
        for (const int id : nodes) {
            for (const int arg : p_[id].args) depth[id] = std::max(depth[id], depth[arg]);
            if (is_sine(p_[id])) deepest = std::max(deepest, ++depth[id]);
        }
        for (auto id = nodes.rbegin(); id != nodes.rend(); ++id)
            if (is_sine(p_[*id]) || is_inside[*id] != 0)
                for (const int arg : p_[*id].args) is_inside[arg] = 1;
        std::vector<int> done;
        for (int d = 0; d < deepest; ++d) {
            std::vector<int> sines;
            for (const int id : nodes)
                if (is_sine(p_[id]) && depth[id] == d + 1)
                    sines.push_back(id), done.push_back(id);
                else if (!is_sine(p_[id]) && is_inside[id] != 0 && depth[id] == d)
                    lower(id), done.push_back(id);
            add_sines(sines);
        }
        return done;
    }

    void add_sines(const std::vector<int>& sines) {
        std::map<int, int> position;  // argument → its position in the group
        SineGroup group{.angles = {}, .place = lines_.block, .size = 0};
        for (const int id : sines) {
            const int argument = p_[id].args[0];
            if (!position.try_emplace(argument, static_cast<int>(group.angles.size())).second) continue;
            group.angles.push_back(whole(of(argument)));
        }
        const int size = group.size = (static_cast<int>(group.angles.size()) + 3) / 4 * 4;
        lines_.block += 3 * size;
        add({.kind = Line::Kind::sines, .place = static_cast<int>(lines_.groups.size())});
        for (const int id : sines) {
            const int first = group.place + (p_[id].op == Op::sin ? size : 2 * size);
            value_[id] = {leaf({.kind = Home::Kind::block, .place = first + position.at(p_[id].args[0])})};
        }
        lines_.groups.push_back(std::move(group));
    }

    /// The sine and the cosine of an angle, for packs.
    std::array<int, 2> sine_and_cosine(int argument) {
        const auto [known, is_new] = turned_.try_emplace(argument);
        if (!is_new) return known->second;
        const int x = whole(of(argument));
        if (*sines_ == Sines::called) {
            lines_.groups.push_back({.angles = {x}, .place = lines_.block, .size = 1});
            add({.kind = Line::Kind::sines, .place = static_cast<int>(lines_.groups.size()) - 1});
            const int first = lines_.block + 1;
            lines_.block += 3;
            return known->second = {leaf({.kind = Home::Kind::block, .place = first}),
                                    leaf({.kind = Home::Kind::block, .place = first + 1})};
        }
        // By AVX2 the larger one of two is the second where one is not a number, which must not be the first
        // angle.
        if (lines_.largest < 0 && lines_.lanes == 4) lines_.largest = number(0);
        lines_.largest = lines_.largest < 0
                             ? add({.kind = Line::Kind::absolute, .of = {x, -1, -1}})
                             : add({.kind = Line::Kind::larger_size, .of = {lines_.largest, x, -1}});
        return known->second = sine_and_cosine_inside({.add = [this](const Line& line) { return add(line); },
                                                       .number = [this](double v) { return number(v); },
                                                       .lanes = lines_.lanes},
                                                      x);
    }

    int leaf(const Home& home) {
        lines_.homes.push_back(home);
        return static_cast<int>(lines_.homes.size()) - 1;
    }
    int number(double value) {
        const auto [known, is_new] = numbers_.try_emplace(value, 0);
        if (is_new) known->second = leaf({.kind = Home::Kind::constant, .number = value});
        return known->second;
    }
    int add(Line line) {
        if (line.kind != Line::Kind::store && line.kind != Line::Kind::sines) line.to = leaf({});
        lines_.list.push_back(line);
        return line.to;
    }

    /// The value with its own sign.
    int whole(Signed x) {
        if (!x.negative) return x.value;
        const auto [known, is_new] = negatives_.try_emplace(x.value, -1);
        if (is_new) known->second = add({.kind = Line::Kind::negative, .of = {x.value, -1, -1}});
        return known->second;
    }

    /// A number or a variable.
    int given(int id) {
        const Node& node = p_[id];
        if (const auto constant = constant_place_.find(id); constant != constant_place_.end())
            return leaf({.kind = Home::Kind::argument, .argument = array("par"), .place = constant->second});
        if (node.is_number()) return number(real_of<double>(node.number));
        if (node.op == Op::pi) return number(std::numbers::pi);
        const int i = node.variable.index, n = static_cast<int>(p_.coordinates.size());
        switch (node.variable.kind) {
            case Variable::Kind::parameter:
                return leaf({.kind = Home::Kind::argument, .argument = array("par"), .place = i});
            case Variable::Kind::time:
                return leaf({.kind = Home::Kind::time});
            case Variable::Kind::coordinate:
                return leaf({.kind = Home::Kind::argument, .argument = array("state"), .place = i});
            case Variable::Kind::rate:
                return leaf({.kind = Home::Kind::argument, .argument = array("state"), .place = n + i});
            case Variable::Kind::acceleration:
                return leaf({.kind = Home::Kind::argument, .argument = array("rate"), .place = n + i});
            case Variable::Kind::unknown: {
                const auto found = elsewhere_.find(i);
                const bool is_given = found == elsewhere_.end();
                return leaf({.kind = Home::Kind::argument,
                             .argument = array(is_given ? "given" : found->second.first),
                             .place = is_given ? i : found->second.second});
            }
        }
        throw std::logic_error("a variable without a value");
    }

    Signed of(int id) {
        Signed& known = value_[id];
        if (known.value >= 0) return known;
        const Node& node = p_[id];
        if (is_leaf_[id] != 0 || node.args.empty())
            known = {given(id)};
        else if (node.op == Op::sum)
            known = sum(id);
        else if (node.op == Op::product)
            known = product(id);
        else
            throw std::logic_error("a value is used before it is computed");
        return known;
    }

    /// Whether a sum adds this product in the instruction that multiplies.
    bool is_fused(int id) const {
        const Node& node = p_[id];
        if (node.op != Op::product || uses_[id] != 1 || is_leaf_[id] != 0 || value_[id].value >= 0) return false;
        return std::none_of(node.args.begin(), node.args.end(), [&](int arg) { return is_below(arg); }) &&
               node.exponents[0] > 0;
    }
    /// Whether a product divides by what this node is the reciprocal of.
    bool is_below(int id) const {
        return p_[id].is_reciprocal() && uses_[id] == 1 && is_leaf_[id] == 0 && value_[id].value < 0;
    }

    /// Computes a node, unless it becomes part of those that use it.
    void lower(int id) {
        const Node& node = p_[id];
        if (node.op == Op::product && uses_[id] == 1 && (node.is_reciprocal() || is_fused(id))) return;
        if (node.op == Op::sum || node.op == Op::product) {
            of(id);
            return;
        }
        if (node.op == Op::unspecified) {
            value_[id] = {table(node)};
            return;
        }
        if (is_sine(node)) {
            value_[id] = {sine_and_cosine(node.args[0])[node.op == Op::sin ? 0 : 1]};
            return;
        }
        const int x = whole(of(node.args[0]));
        if (node.op == Op::sqrt)
            value_[id] = {add({.kind = Line::Kind::root, .of = {x, -1, -1}})};
        else if (node.op == Op::abs)
            value_[id] = {add({.kind = Line::Kind::absolute, .of = {x, -1, -1}})};
        else
            value_[id] = {add({.kind = Line::Kind::call,
                               .of = {x, node.args.size() > 1 ? whole(of(node.args[1])) : -1, -1},
                               .function = function_of(node.op)})};
    }

    /// A call with the address of the table's call in the bits of its first argument; intervals that are held
    /// choose another one.
    int table(const Node& node) {
        const Program::TableCall call = p_.table_call(node);
        int of = number(bits_for_code(p_.table_of(node)->call(call.orders, call.is_held)));
        for (std::size_t k = 0; call.is_held && call.arguments > 1 && k < call.arguments; ++k)
            of = add({.kind = Line::Kind::call,
                      .of = {of, whole(this->of(call.number[k])), -1},
                      .function = reinterpret_cast<const void*>(held_for_code)});
        const int x = whole(this->of(call.argument[0]));
        if (call.arguments == 1)
            return add({.kind = Line::Kind::call,
                        .of = {of, x, call.is_held ? whole(this->of(call.number[0])) : -1},
                        .function = call.is_held ? reinterpret_cast<const void*>(held_value_for_code)
                                                 : reinterpret_cast<const void*>(value_for_code)});
        return add({.kind = Line::Kind::call,
                    .of = {of, x, whole(this->of(call.argument[1]))},
                    .function = reinterpret_cast<const void*>(value_of_two_for_code)});
    }

    Signed times(Signed a, Signed b) {
        return {add({.kind = Line::Kind::multiply, .of = {a.value, b.value, -1}}), a.negative != b.negative};
    }
    Signed times(const std::vector<Signed>& factors) {
        Signed result = factors[0];
        for (std::size_t k = 1; k < factors.size(); ++k) result = times(result, factors[k]);
        return result;
    }

    /// The factors of a product above and below, a power as often as its exponent.
    void split(int id, std::vector<Signed>& above, std::vector<Signed>& below) {
        const Node& node = p_[id];
        for (const std::size_t k : ready_.order(id)) {
            const int arg = node.args[k];
            const bool is_divisor = node.exponents[k] < 0 || is_below(arg);
            add_power(of(is_divisor && node.exponents[k] > 0 ? p_[arg].args[0] : arg), std::abs(node.exponents[k]),
                      is_divisor ? below : above);
        }
    }
    void add_power(Signed factor, int exponent, std::vector<Signed>& factors) {
        for (; exponent > 0; exponent /= 2) {
            if (exponent % 2 != 0) factors.push_back(factor);
            if (exponent > 1) factor = times(factor, factor);
        }
    }

    Signed product(int id) {
        std::vector<Signed> above, below;
        split(id, above, below);
        if (below.empty()) return times(above);
        const Signed top = above.empty() ? Signed{number(1)} : times(above), bottom = times(below);
        return {add({.kind = Line::Kind::divide, .of = {top.value, bottom.value, -1}}),
                top.negative != bottom.negative};
    }

    /// The two factors of a product that a sum adds; of an even power, the same one twice.
    std::array<Signed, 2> two_factors(int id) {
        const Node& node = p_[id];
        std::vector<Signed> above, below;
        if (node.args.size() == 1 && node.exponents[0] % 2 == 0) {
            add_power(of(node.args[0]), node.exponents[0] / 2, above);
            const Signed half = times(above);
            return {half, half};
        }
        split(id, above, below);
        const Signed last = above.back();
        above.pop_back();
        return {above.empty() ? Signed{number(1)} : times(above), last};
    }

    /// total + x
    Signed plus(Signed total, Signed x) {
        if (total.value < 0) return x;
        if (total.negative && x.negative) return -plus(-total, -x);
        if (total.negative) std::swap(total, x);
        return {
            add({.kind = x.negative ? Line::Kind::subtract : Line::Kind::add, .of = {total.value, x.value, -1}})};
    }
    /// total + a b
    Signed plus(Signed total, Signed a, Signed b) {
        if (total.value < 0) return times(a, b);
        const bool minus = a.negative != b.negative;
        if (total.negative && minus) return -plus(-total, -a, b);
        return {add({.kind = Line::Kind::fused,
                     .of = {a.value, b.value, total.value},
                     .minus_product = minus,
                     .minus_rest = total.negative})};
    }

    Signed sum(int id) {
        const Node& node = p_[id];
        Signed total;
        if (!cln::zerop(node.number)) total = {number(real_of<double>(node.number))};
        for (const std::size_t k : ready_.order(id)) {
            const int arg = node.args[k];
            const double c = real_of<double>(node.coefficients[k]);
            if (std::abs(c) != 1) {
                const Signed x = of(arg);
                total = plus(total, {number(std::abs(c)), c < 0}, x);
            } else if (is_fused(arg)) {
                const auto [first, last] = two_factors(arg);
                total = plus(total, c < 0 ? -first : first, last);
            } else {
                const Signed x = of(arg);
                total = plus(total, c < 0 ? -x : x);
            }
        }
        return total;
    }

    const Program& p_;
    const Readiness& ready_;
    std::map<int, std::pair<std::string, int>> elsewhere_;  ///< FunctionTask
    std::vector<std::string> arrays_;
    std::vector<Signed> value_;  // of each node
    std::vector<char> is_leaf_;
    std::vector<int> uses_;
    std::map<int, int> constant_place_;
    std::map<double, int> numbers_;
    std::map<int, int> negatives_;  // of values
    Lines lines_;
    std::optional<Sines> sines_;                // of packs
    std::map<int, std::array<int, 2>> turned_;  // an angle, and the values of its sine and cosine
};

Lines lines_for(const Program& program, const Vocabulary& words, const Readiness& ready, const FunctionTask& task,
                std::optional<Packing> packed) {
    Lining lining(program, words, ready, task, true, packed);
    std::vector<Lining::Wanted> wanted;
    for (const FunctionResult& result : task.results)
        wanted.push_back({lining.array(result.array), result.places, result.node});
    return lining.lines(wanted, task.copies);
}

Lines constants_for(const Program& program, const Vocabulary& words, const Readiness& ready,
                    std::optional<Packing> packed) {
    const FunctionTask task{.name = {}, .about = {}, .arguments = {{"Real*", "par"}}, .goals = {}, .results = {}};
    Lining lining(program, words, ready, task, false, packed);
    std::vector<Lining::Wanted> wanted;
    for (std::size_t k = 0; k < words.constants().size(); ++k)
        wanted.push_back({0, {words.par().size() + k}, words.constants()[k]});
    return lining.lines(wanted, {});
}

}  // namespace

Lines lines_of(const Program& program, const Vocabulary& words, const Readiness& ready, const FunctionTask& task) {
    return lines_for(program, words, ready, task, {});
}

Lines lines_of_packs(const Program& program, const Vocabulary& words, const Readiness& ready,
                     const FunctionTask& task, Sines sines, int lanes) {
    return lines_for(program, words, ready, task, Packing{sines, lanes});
}

Lines lines_of_constants(const Program& program, const Vocabulary& words, const Readiness& ready) {
    return constants_for(program, words, ready, {});
}

Lines lines_of_constants_in_packs(const Program& program, const Vocabulary& words, const Readiness& ready,
                                  int lanes) {
    return constants_for(program, words, ready, Packing{Sines::called, lanes});
}

}  // namespace alembert::machine
