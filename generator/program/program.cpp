// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/program.hpp"

#include <cln/integer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "alembert/base/error.hpp"
#include "alembert/base/interrupt.hpp"
#include "base/language/say.hpp"
#include "program/short_lists.hpp"

namespace alembert {

namespace {

constexpr std::array op_names{"number", "pi",   "variable", "sum",  "product", "sin",  "cos", "tan",
                              "asin",   "acos", "atan",     "sinh", "cosh",    "tanh", "exp", "log",
                              "sqrt",   "abs",  "sign",     "pow",  "atan2",   "min",  "max", "unspecified"};

bool is_odd_function(Op op) {
    switch (op) {
        case Op::sin:
        case Op::tan:
        case Op::asin:
        case Op::atan:
        case Op::sinh:
        case Op::tanh:
        case Op::sign:
            return true;
        default:
            return false;
    }
}

bool is_even_function(Op op) {
    return op == Op::cos || op == Op::cosh || op == Op::abs;
}

std::uint64_t mix(std::uint64_t h, std::uint64_t value) {  // the finalizer of splitmix64 applied to a running sum
    h += value + 0x9e3779b97f4a7c15ULL;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
    return h ^ (h >> 31);
}

/// One item for each node, in the order of their numbers, with the sum of its weights.
template <typename Item, typename Weight>
void gather(ShortList<Item>& items, int Item::*node, Weight Item::*weight) {
    std::sort(items.begin(), items.end(), [&](const Item& a, const Item& b) { return a.*node < b.*node; });
    std::size_t count = 0;
    for (std::size_t k = 0; k < items.size(); ++k) {
        if (count > 0 && items[count - 1].*node == items[k].*node)
            items[count - 1].*weight = items[count - 1].*weight + items[k].*weight;
        else if (count++ != k)
            items[count - 1] = items[k];
    }
    items.resize(count);
}

std::uint64_t hash_of(const Rational& r) {
    return cln::equal_hashcode(r);
}

template <typename T, typename Equal = std::equal_to<>>
bool same(std::span<const T> a, std::span<const T> b, Equal equal = {}) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

bool same(const Node& a, const Node& b) {
    return a.op == b.op && a.variable == b.variable && same(a.args, b.args) && same(a.exponents, b.exponents) &&
           cln::equal(a.number, b.number) &&
           same(a.coefficients, b.coefficients,
                [](const Rational& x, const Rational& y) { return cln::equal(x, y); });
}

constexpr int whole_scene[] = {0};

}  // namespace

Program::Program() : sources_(whole_scene) {}
Program::Program(const Program&) = default;
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(const Program&) = default;
Program& Program::operator=(Program&&) noexcept = default;
Program::~Program() = default;

const char* name_of(Op op) {
    return op_names[static_cast<std::size_t>(op)];
}

int Program::intern(const Node& contents) {
    std::uint64_t h =
        mix(static_cast<std::uint64_t>(contents.op), static_cast<std::uint64_t>(contents.variable.kind));
    h = mix(mix(h, static_cast<std::uint64_t>(contents.variable.index)), hash_of(contents.number));
    for (std::size_t i = 0; i < contents.args.size(); ++i) {
        h = mix(h, nodes_[contents.args[i]].hash);
        if (!contents.coefficients.empty()) h = mix(h, hash_of(contents.coefficients[i]));
        if (!contents.exponents.empty()) h = mix(h, static_cast<std::uint64_t>(contents.exponents[i] + 1000));
    }
    if (const int id = known_.find(h, [&](int known) { return same(nodes_[known], contents); }); id >= 0)
        return id;
    ask_whether_wanted();
    Node node{.op = contents.op,
              .variable = contents.variable,
              .number = contents.number,
              .args = integers_.keep(contents.args),
              .coefficients = rationals_.keep(contents.coefficients),
              .exponents = integers_.keep(contents.exponents),
              .lead = 1 << 30,
              .hash = h,
              .sources = sources_};
    for (const int id : node.args) {
        const Node& arg = nodes_[id];
        node.depends |= arg.depends;
        node.lead = std::min(node.lead, arg.lead);
        node.size += arg.size;
    }
    if (node.op == Op::variable) {
        node.depends = 1U << static_cast<unsigned>(node.variable.kind);
        node.lead = static_cast<int>(node.variable.kind) * 100000 + node.variable.index;
    }
    known_.insert(h, size());
    nodes_.push_back(std::move(node));
    return size() - 1;
}

std::span<const int> Program::set_sources(std::span<const int> sources) {
    const std::span<const int> former = sources_;
    if (same(sources, former)) return former;
    std::uint64_t h = 0;
    for (const int source : sources) h = mix(h, static_cast<std::uint64_t>(source));
    const int known =
        known_sources_.find(h, [&](int k) { return same(source_lists_[static_cast<std::size_t>(k)], sources); });
    if (known < 0) {
        known_sources_.insert(h, static_cast<int>(source_lists_.size()));
        source_lists_.push_back(integers_.keep(sources));
    }
    sources_ = known < 0 ? source_lists_.back() : source_lists_[static_cast<std::size_t>(known)];
    return former;
}

bool Program::before(int a, int b) const {
    if (a == b) return false;
    const Node &x = nodes_[a], &y = nodes_[b];
    if ((x.op == Op::variable) != (y.op == Op::variable)) {
        if (x.is_constant() != y.is_constant()) return x.is_constant();
        return x.op == Op::variable;
    }
    if (x.is_constant() != y.is_constant()) return x.is_constant();
    if (x.lead != y.lead) return x.lead < y.lead;
    if (x.size != y.size) return x.size < y.size;
    if (x.op != y.op) return x.op < y.op;
    return x.hash < y.hash;
}

int Program::number(const Rational& value) {
    return intern(Node{.number = value});
}

int Program::pi() {
    return intern(Node{.op = Op::pi});
}

int Program::variable(Variable variable) {
    return intern(Node{.op = Op::variable, .variable = variable});
}

int Program::scaled(const Rational& coefficient, int id) {
    if (cln::equal(coefficient, 1)) return id;
    if (nodes_[id].is_number()) return number(coefficient * nodes_[id].number);
    if (nodes_[id].is_scaled()) return scaled(coefficient * nodes_[id].coefficients[0], nodes_[id].args[0]);
    return intern(Node{.op = Op::sum, .args = {&id, 1}, .coefficients = {&coefficient, 1}});
}

int Program::sum(const Rational& constant, std::span<const Term> terms) {
    Rational rest = constant;
    ShortLists lists;
    ShortList<Term> by_node(lists);
    by_node.reserve(terms.size());
    for (auto [coefficient, id] : terms) {
        if (nodes_[id].is_scaled()) {
            coefficient = coefficient * nodes_[id].coefficients[0];
            id = nodes_[id].args[0];
        }
        if (nodes_[id].is_number())
            rest = rest + coefficient * nodes_[id].number;
        else
            by_node.emplace_back(coefficient, id);
    }
    gather(by_node, &Term::second, &Term::first);
    ShortList<Term> kept(lists), constants(lists);
    kept.reserve(by_node.size());
    for (const auto& [coefficient, id] : by_node)
        if (!cln::zerop(coefficient)) (nodes_[id].is_constant() ? constants : kept).emplace_back(coefficient, id);
    if (!kept.empty() && constants.size() + (cln::zerop(rest) ? 0 : 1) > 1) {
        const int gathered = sum(rest, constants);
        if (nodes_[gathered].is_number()) return sum(nodes_[gathered].number, kept);
        rest = 0;
        // A numeric factor of the collected constant stays inside it, except for the sign, which costs nothing.
        const bool flip = nodes_[gathered].is_scaled() && cln::minusp(nodes_[gathered].coefficients[0]);
        constants = {{flip ? -1 : 1, flip ? scaled(-1, gathered) : gathered}};
    } else if (!kept.empty() && constants.size() == 1) {
        constants = {{cln::signum(constants[0].first), scaled(cln::abs(constants[0].first), constants[0].second)}};
    }
    kept.insert(kept.end(), constants.begin(), constants.end());
    if (kept.empty()) return number(rest);
    if (kept.size() == 1 && cln::zerop(rest)) return scaled(kept[0].first, kept[0].second);

    std::sort(kept.begin(), kept.end(), [&](const Term& a, const Term& b) { return before(a.second, b.second); });
    Rational content = cln::minusp(kept[0].first) ? -1 : 1;
    const bool all_equal = std::all_of(kept.begin(), kept.end(), [&](const Term& term) {
        return cln::equal(cln::abs(term.first), cln::abs(kept[0].first));
    });
    if (all_equal && cln::zerop(rest)) content = kept[0].first;
    const bool is_one = cln::equal(content, 1);
    ShortList<int> args(lists);
    ShortList<Rational> coefficients(lists);
    args.reserve(kept.size());
    coefficients.reserve(kept.size());
    for (const auto& [coefficient, id] : kept) {
        args.push_back(id);
        coefficients.push_back(is_one ? coefficient : coefficient / content);
    }
    return scaled(
        content,
        intern(Node{
            .op = Op::sum, .number = is_one ? rest : rest / content, .args = args, .coefficients = coefficients}));
}

namespace {

/// x⁻ⁿ with n > 1.
bool is_power_of_reciprocal(const Program& program, int id) {
    const Node& node = program[id];
    return node.op == Op::product && node.args.size() == 1 && program[node.args[0]].is_reciprocal();
}

/// cosh x, or a + b exp(x).
bool overflows(const Program& program, int id) {
    const Node& node = program[id];
    return node.op == Op::cosh || (node.op == Op::sum && node.args.size() == 1 && !cln::zerop(node.number) &&
                                   program[node.args[0]].op == Op::exp);
}

/// sinh x / cosh x is tanh x, and exp(x)/(a + b exp(x)) is 1/(b + a exp(−x)): so neither is ∞/∞ or 0·∞ where x is
/// large. Nothing if there is no such quotient.
std::optional<int> bounded_quotient(Program& program, const Rational& content,
                                    std::span<const Program::Factor> factors) {
    for (const auto& [below, power] : factors) {
        if (power >= 0 || !overflows(program, below)) continue;
        const Node divisor = program[below];
        const bool is_cosh = divisor.op == Op::cosh;
        for (const auto& [above, times] : factors) {
            const Node& node = program[above];
            const bool fits =
                is_cosh ? node.op == Op::sinh && node.args[0] == divisor.args[0] : above == divisor.args[0];
            if (times <= 0 || !fits) continue;
            const int both = std::min(times, -power), x = node.args[0];
            std::vector<Program::Factor> again(factors.begin(), factors.end());
            again.emplace_back(above, -both);
            again.emplace_back(below, both);
            if (is_cosh)
                again.emplace_back(program.call(Op::tanh, {x}), both);
            else
                again.emplace_back(
                    program.sum(divisor.coefficients[0],
                                {{divisor.number, program.call(Op::exp, {program.sum(0, {{-1, x}})})}}),
                    -both);
            return program.product(content, again);
        }
    }
    return std::nullopt;
}

/// The factors of a product whose factors may be products; c·x stays whole.
void collect_factors(const Program& program, int id, int exponent, std::map<int, int>& factors) {
    const Node& node = program[id];
    if (node.op != Op::product) {
        factors[id] += exponent;
        return;
    }
    for (std::size_t k = 0; k < node.args.size(); ++k)
        collect_factors(program, node.args[k], exponent * node.exponents[k], factors);
}

/// Whether one of several factors, some of them products, is exp or sinh, and may thus exceed all numbers before
/// another one divides it.
bool grows(const Program& program, std::span<const Program::Factor> factors) {
    const auto is_growing = [&](int id) { return program[id].op == Op::exp || program[id].op == Op::sinh; };
    bool has_product = false, has_growing = false;
    for (const auto& [id, exponent] : factors) {
        const Node& node = program[id];
        has_product = has_product || node.op == Op::product;
        has_growing = has_growing || is_growing(id) ||
                      (node.op == Op::product && std::any_of(node.args.begin(), node.args.end(), is_growing));
    }
    return has_product && has_growing;
}

std::optional<int> bounded_in_products(Program& program, const Rational& content,
                                       std::span<const Program::Factor> factors) {
    if (!grows(program, factors)) return std::nullopt;
    std::map<int, int> all;
    for (const auto& [id, exponent] : factors) collect_factors(program, id, exponent, all);
    const std::vector<Program::Factor> each(all.begin(), all.end());
    return bounded_quotient(program, content, each);
}

struct SquareInRoots {
    int root, moved;  ///< √x, and the exponent of x that is better taken out of its powers, or into them; or 0
};

/// √x · √x = x, and x/√x = √x.
SquareInRoots square_in_roots(const Program& program, std::span<const Program::Factor> factors) {
    for (const Program::Factor& root : factors) {
        const int id = root.first, exponent = root.second;
        if (program[id].op != Op::sqrt || exponent == 0) continue;
        const int below = program[id].args[0];
        const bool is_divided = std::any_of(factors.begin(), factors.end(), [&](const Program::Factor& factor) {
            return factor.first == below && factor.second > 0 && exponent < 0;
        });
        if (is_divided) return {id, -std::max(1, -exponent / 2)};
        if (std::abs(exponent) > 1) return {id, exponent / 2};
    }
    return {0, 0};
}

}  // namespace

int Program::product(const Rational& coefficient, std::span<const Factor> factors) {
    Rational content = coefficient;
    ShortLists lists;
    ShortList<Factor> by_node(lists);
    by_node.reserve(factors.size());
    for (auto [id, exponent] : factors) {
        if (exponent == 0) continue;
        if (nodes_[id].is_scaled()) {
            content = content * cln::expt(nodes_[id].coefficients[0], exponent);
            id = nodes_[id].args[0];
        }
        if (is_power_of_reciprocal(*this, id) && overflows(*this, nodes_[nodes_[id].args[0]].args[0])) {
            exponent *= nodes_[id].exponents[0];
            id = nodes_[id].args[0];
        }
        if (nodes_[id].is_reciprocal()) {
            id = nodes_[id].args[0];
            exponent = -exponent;
        }
        if (nodes_[id].is_number()) {
            if (cln::zerop(nodes_[id].number) && exponent < 0) throw std::domain_error("division by zero");
            content = content * cln::expt(nodes_[id].number, exponent);
        } else {
            by_node.emplace_back(id, exponent);
        }
    }
    gather(by_node, &Factor::first, &Factor::second);
    if (cln::zerop(content)) return number(0);
    if (const auto [root, moved] = square_in_roots(*this, by_node); moved != 0) {
        ShortList<Factor> again(by_node, lists);
        again.emplace_back(nodes_[root].args[0], moved);
        again.emplace_back(root, -2 * moved);
        return product(content, again);
    }
    if (const std::optional<int> found = bounded_quotient(*this, content, by_node)) return *found;
    if (const std::optional<int> found = bounded_in_products(*this, content, by_node)) return *found;
    ShortList<Factor> kept(lists), constants(lists);
    kept.reserve(by_node.size());
    for (const auto& [id, exponent] : by_node)
        if (exponent != 0) (nodes_[id].is_constant() ? constants : kept).emplace_back(id, exponent);
    if (!kept.empty() && !constants.empty()) {
        const Rational size = cln::abs(content);
        if (constants.size() > 1 || !cln::equal(size, 1) || constants[0].second != 1) {
            constants = {{product(size, constants), 1}};
            content = cln::signum(content);
        }
    }
    kept.insert(kept.end(), constants.begin(), constants.end());
    if (kept.empty()) return number(content);

    if (kept.size() == 1 && kept[0].second == -1)
        return scaled(
            content,
            intern(Node{.op = Op::product, .args = {&kept[0].first, 1}, .exponents = {&kept[0].second, 1}}));
    for (auto& [id, exponent] : kept)
        if (exponent < 0) {  // one division, shared by all quotients with this divisor
            id = product(1, {{id, -1}});
            exponent = -exponent;
        }
    std::sort(kept.begin(), kept.end(),
              [&](const Factor& a, const Factor& b) { return before(a.first, b.first); });
    ShortList<int> args(lists), exponents(lists);
    args.reserve(kept.size());
    exponents.reserve(kept.size());
    for (auto [id, exponent] : kept) {
        if (exponent > 3) {  // by repeated squaring, the squares shared
            args.push_back(product(1, {{id, exponent / 2}}));
            exponents.push_back(2);
            exponent %= 2;
            if (exponent == 0) continue;
        }
        args.push_back(id);
        exponents.push_back(exponent);
    }
    if (args.size() == 1 && exponents[0] == 1) return scaled(content, args[0]);
    return scaled(content, intern(Node{.op = Op::product, .args = args, .exponents = exponents}));
}

int Program::power(int base, const Rational& exponent) {
    const cln::cl_I denominator = cln::denominator(exponent);
    if (denominator == 1) return product(1, {{base, cln::cl_I_to_int(cln::numerator(exponent))}});
    if (denominator == 2) {
        const int numerator = cln::cl_I_to_int(cln::numerator(exponent));
        return product(1, {{call(Op::sqrt, {base}), numerator}});
    }
    return call(Op::pow, {base, number(exponent)});
}

int Program::call(Op op, std::span<const int> args) {
    const Node& arg = nodes_[args[0]];
    if (args.size() == 1 && arg.is_number()) {
        if (cln::zerop(arg.number)) {
            if (op == Op::cos || op == Op::cosh || op == Op::exp) return number(1);
            if (is_odd_function(op) || op == Op::sqrt || op == Op::abs) return number(0);
        }
        Rational root;
        if (op == Op::sqrt && !cln::minusp(arg.number) && cln::sqrtp(arg.number, &root)) return number(root);
        if (op == Op::abs) return number(cln::abs(arg.number));
        if (op == Op::sign) return number(cln::signum(arg.number));
        if (op == Op::log && cln::equal(arg.number, 1)) return number(0);
    }
    if ((op == Op::min || op == Op::max) && arg.is_number() && nodes_[args[1]].is_number()) {
        const Rational other = nodes_[args[1]].number;
        return number(op == Op::min ? std::min(arg.number, other) : std::max(arg.number, other));
    }
    const bool negative =
        (arg.is_scaled() && cln::minusp(arg.coefficients[0])) || (arg.is_number() && cln::minusp(arg.number));
    if (negative && (is_odd_function(op) || is_even_function(op))) {
        const int turned = scaled(-1, args[0]);
        return is_even_function(op) ? call(op, {turned}) : scaled(-1, call(op, {turned}));
    }
    if (const int simpler = simpler_call(op, args); simpler >= 0) return simpler;
    return intern(Node{.op = op, .args = args});
}

/// By identities that hold wherever both sides have values; −1 if there is none.
int Program::simpler_call(Op op, std::span<const int> args) {
    const Node& arg = nodes_[args[0]];
    const Op inner = arg.op;
    const int inside = arg.args.empty() ? args[0] : arg.args[0];
    const bool keeps_sign = inner == Op::tanh || inner == Op::sinh || inner == Op::atan || inner == Op::asin;
    if (op == Op::abs && keeps_sign) return call(inner, {call(Op::abs, {inside})});
    if (op == Op::sign && keeps_sign) return call(Op::sign, {inside});
    if (op == Op::log && inner == Op::product && arg.args.size() == 1 && arg.exponents[0] % 2 == 0) {
        const int exponent = arg.exponents[0];
        return scaled(exponent, call(Op::log, {call(Op::abs, {inside})}));
    }
    if (op == Op::atan2 && nodes_[args[1]].is_number() && cln::plusp(nodes_[args[1]].number))
        return call(Op::atan, {scaled(cln::recip(nodes_[args[1]].number), args[0])});
    return -1;
}

std::vector<int> Program::needed(std::span<const int> roots) const {
    std::vector<char> wanted(nodes_.size(), 0);
    for (const int root : roots) wanted[root] = 1;
    std::vector<int> result;
    for (int id = size() - 1; id >= 0; --id) {
        if (!wanted[id]) continue;
        for (const int arg : nodes_[id].args) wanted[arg] = 1;
        result.push_back(id);
    }
    std::reverse(result.begin(), result.end());
    return result;
}

std::vector<int> Program::right_hand_side() const {
    std::vector<int> nodes = nodes_of(Group::acceleration);
    const std::vector<int> rates = nodes_of(Group::rate);
    nodes.insert(nodes.end(), rates.begin(), rates.end());
    return nodes;
}

std::vector<int> Program::needed_state() const {
    std::set<int> components;
    if (nodes_of(Group::acceleration).empty()) components.insert(-1);
    for (const int id : needed(right_hand_side())) {
        if (nodes_[id].op != Op::variable) continue;
        const Variable& v = nodes_[id].variable;
        if (v.kind == Variable::Kind::coordinate)
            components.insert(v.index);
        else if (v.kind == Variable::Kind::rate)
            components.insert(static_cast<int>(coordinates.size()) + v.index);
        else if (v.kind != Variable::Kind::parameter)
            components.insert(-1);
    }
    return {components.begin(), components.end()};
}

std::size_t Program::function_of(const Node& node) const {
    return static_cast<std::size_t>(cln::cl_I_to_int(cln::numerator(nodes_[node.args[0]].number)));
}

void Program::refuse_unspecified(const Node& node) const {
    const std::size_t index = function_of(node);
    const std::string name = index < functions.size() ? "'" + functions[index] + "'" : say("a function");
    throw ModelError(
        say("[functions] leaves {} open, so that what depends on it has no values; `derive`, `check` and "
            "`audit` need none. For numbers write its formula in place of it, for example as a name in "
            "[definitions]",
            name));
}

std::shared_ptr<const TabulatedFunction> Program::shared_table_of(const Node& node) const {
    const std::size_t index = function_of(node);
    return index < tables.size() ? tables[index] : nullptr;
}

const TabulatedFunction* Program::table_of(const Node& node) const {
    return shared_table_of(node).get();
}

Program::TableCall Program::table_call(const Node& node) const {
    const TabulatedFunction* const table = table_of(node);
    if (table == nullptr) refuse_unspecified(node);
    const auto order = [&](std::size_t k) {
        return cln::cl_I_to_int(cln::numerator(nodes_[node.args[k]].number));
    };
    TableCall call;
    call.orders[0] = order(1);
    call.arguments = call.orders[0] >= TabulatedFunction::side_function ? 1 : table->arguments();
    for (std::size_t k = 0; k < call.arguments; ++k) {
        call.orders[k] = order(2 * k + 1);
        call.argument[k] = node.args[2 * k + 2];
    }
    const std::size_t plain = 1 + 2 * call.arguments;
    call.is_held = node.args.size() > plain;
    for (std::size_t k = 0; call.is_held && k < call.arguments; ++k) call.number[k] = node.args[plain + k];
    return call;
}

Program Program::shell() const {
    Program result;
    result.source_labels = source_labels;
    result.reaction_signs = reaction_signs;
    result.name = name;
    result.parameters = parameters;
    result.coordinates = coordinates;
    result.functions = functions;
    result.tables = tables;
    result.speeds = speeds;
    result.states = states;
    result.formulation = formulation;
    result.is_textbook = is_textbook;
    result.singular = singular;
    result.friction_on_multipliers = friction_on_multipliers;
    result.has_norm_terms = has_norm_terms;
    // A copy has about as many nodes; growing in steps would copy each of them with all its lists several times.
    result.nodes_.reserve(nodes_.size());
    result.known_.reserve(nodes_.size());
    return result;
}

Program Program::canonical() const {
    Program result = shell();
    std::vector<int> image(nodes_.size(), -1), args;
    std::vector<std::pair<int, std::size_t>> stack;  // a node, and how many of its arguments are done
    for (const Root& root : roots) {
        stack.emplace_back(root.node, 0);
        while (!stack.empty()) {
            auto& [id, done] = stack.back();
            const Node& node = nodes_[id];
            if (image[id] < 0 && done < node.args.size()) {
                const int next = node.args[done++];
                if (image[next] < 0) stack.emplace_back(next, 0);
                continue;
            }
            if (image[id] < 0) {
                args.clear();
                for (const int arg : node.args) args.push_back(image[arg]);
                result.set_sources(node.sources);
                image[id] = result.intern(Node{.op = node.op,
                                               .variable = node.variable,
                                               .number = node.number,
                                               .args = args,
                                               .coefficients = node.coefficients,
                                               .exponents = node.exponents});
            }
            stack.pop_back();
        }
        Root& copy = result.roots.emplace_back(root);
        copy.node = image[root.node];
    }
    result.set_sources({0});
    return result;
}

std::vector<int> Program::nodes_of(Group group) const {
    std::vector<int> result;
    for (const Root& root : roots)
        if (root.group == group) result.push_back(root.node);
    return result;
}

std::vector<int> Program::kept_constraints() const {
    std::vector<int> result;
    for (const Root& root : roots)
        if (root.group == Group::gamma) result.push_back(root.constraint);
    return result;
}

Operations Program::count(std::span<const int> wanted) const {
    Operations operations;
    for (const int id : needed(wanted)) {
        const Node& node = nodes_[id];
        if (node.is_constant()) continue;
        if (node.op == Op::sum) {
            operations.additions += static_cast<int>(node.args.size()) - (cln::zerop(node.number) ? 1 : 0);
            for (const Rational& c : node.coefficients)
                if (!cln::equal(cln::abs(c), 1)) ++operations.multiplications;
        } else if (node.op == Op::product) {
            int factors = 0;
            for (const int e : node.exponents) factors += e;
            if (node.is_reciprocal())
                ++operations.divisions;
            else
                operations.multiplications += factors - 1;
        } else if (node.op != Op::variable && node.op != Op::number && node.op != Op::pi) {
            ++operations.functions;
        }
    }
    return operations;
}

}  // namespace alembert
