// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/taylor.hpp"

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <set>
#include <sstream>

#include "alembert/error.hpp"
#include "alembert/series.hpp"
#include "emit/templates.hpp"
#include "emit/writer.hpp"
#include "lower/recurrence.hpp"
#include "lower/solve.hpp"

namespace alembert {

namespace {

namespace mustache = kainjow::mustache;
using Kind = SeriesNode::Kind;
using Lines = std::vector<std::string>;

/// Exact in every Real of up to 34 digits: a double, a quotient of two, or a sum of three.
std::string exact_text(const Rational& value) {
    const auto is_double = [](const Rational& r) { return cln::zerop(r) || cln::equal(cln::rational(cln::cl_DF(cln::double_approx(r))), r); };
    const auto text = [](const Rational& r) { return fmt::format("Real({})", shortest(cln::double_approx(r))); };
    if (is_double(value)) return text(value);
    const Rational above = cln::numerator(value), below = cln::denominator(value);
    if (is_double(above) && is_double(below)) return fmt::format("({} / {})", text(above), text(below));
    std::string sum;
    Rational rest = value;
    for (int part = 0; part < 3 && !cln::zerop(rest); ++part) {
        const Rational piece = cln::rational(cln::cl_DF(cln::double_approx(rest)));
        sum += (part > 0 ? " + " : "") + text(piece);
        rest = rest - piece;
    }
    return "(" + sum + ")";
}

bool is_pair(Kind kind) { return kind == Kind::sine || kind == Kind::cosine; }

class TaylorEmitter {
public:
    TaylorEmitter(const Program& program, bool with_work)
        : r_(recurrences(program, with_work)),
          p_(r_.program),
          n_(static_cast<int>(p_.coordinates.size())),
          s_(p_.speeds.empty() ? n_ : static_cast<int>(p_.speeds.size())),
          with_work_(with_work) {
        for (const char* own : {"k", "number", "per_k", "order", "top", "out", "work", "last", "spread", "wide", "stride", "pad", "room",
                                "series", "quad", "clear", "solve", "terms"})
            names_.fresh(own);
        name_everything();
        find_products();
    }

    Source emit() {
        mustache::data file;
        const auto set = [&](const char* key, const Lines& lines) {
            mustache::data list{mustache::data::type::list};
            for (const std::string& line : lines) list << line;
            file.set(key, list);
        };
        const auto number = [&](const char* key, std::size_t value) { file.set(key, std::to_string(value)); };
        set("first", order_zero());
        set("given", given());
        set("chain", chain());
        set("spreading", spreading());
        set("storing", storing());
        set("last", last());
        set("arrays", arrays());
        std::string rates;
        for (int i = 0; i < width(); ++i) rates += first(rate_of(i)) + ", ";
        file.set("rates_at_zero", rates);
        set("prepare", prepare());
        file.set("has_constants", !constants_.empty());
        file.set("scene", ascii_identifier(p_.name));
        file.set("formulation", p_.formulation);
        file.set("version", ALEMBERT_VERSION);
        file.set("products", fmt::format("{}", r_.products()));
        file.set("trigonometric", has_trigonometry());
        number("abi", series_abi_version);
        number("n", static_cast<std::size_t>(n_));
        number("s", static_cast<std::size_t>(s_));
        number("extra", with_work_ ? 1 : 0);
        number("width", static_cast<std::size_t>(width()));
        number("p", p_.parameters.size());
        number("most_order", static_cast<std::size_t>(most_order));
        number("most_order_quad", static_cast<std::size_t>(most_order_quad));
        number("k", constants_.size());
        number("arrays_count", static_cast<std::size_t>(arrays_count_));
        number("sums_count", static_cast<std::size_t>(sums_count_));
        std::string values;
        for (const Quantity& par : p_.parameters) values += shortest(par.value) + ", ";
        file.set("parameter_values", values);
        mustache::mustache shape{std::string(template_taylor)};
        std::string elementary = mustache::mustache{std::string(template_elementary)}.render(file);
        elementary.pop_back();
        file.set("elementary", elementary);
        return {.file = ascii_identifier(p_.name) + "_taylor.cpp",
                .text = shape.render(file),
                .operations = p_.count(p_.right_hand_side()),
                .formulation = p_.formulation};
    }

private:
    struct Named {
        std::string now, first;            ///< the coefficient of this order; of order 0
        std::string series, rates, sums;   ///< arrays: coefficients, j times these, sums of products; empty: not needed
        std::string rate;                  ///< k times the coefficient of this order
        std::string inverse;               ///< of the first coefficient
    };
    struct Product {
        Weight weight;
        int a, b;
        bool a_rate = false, b_rate = false;
    };

    int width() const { return n_ + s_ + (with_work_ ? 1 : 0); }
    const SeriesNode& node(int id) const { return r_.nodes[id]; }
    int size() const { return static_cast<int>(r_.nodes.size()); }

    bool has_trigonometry() const {
        if (std::any_of(r_.nodes.begin(), r_.nodes.end(), [](const SeriesNode& x) { return is_pair(x.kind); })) return true;
        for (int id = 0; id < p_.size(); ++id)
            if (p_[id].op == Op::sin || p_[id].op == Op::cos) return true;
        return false;
    }

    void name_everything() {
        named_.resize(r_.nodes.size());
        std::vector<std::string> speeds;
        for (const Quantity& q : p_.coordinates) names_.fresh(q.name);
        for (const Quantity& par : p_.parameters) names_.fresh(par.name);
        for (int id = 0; id < size(); ++id) {
            const SeriesNode& x = node(id);
            const auto i = static_cast<std::size_t>(x.index);
            Named& name = named_[id];
            const auto speed = [&] {
                if (p_.speeds.empty()) return ascii_identifier(p_.coordinates[i].name) + "_dot";
                const std::string& u = p_.speeds[i].name;
                return ascii_identifier(u.ends_with('\'') ? u.substr(0, u.size() - 1) + "_dot" : u);
            };
            switch (x.kind) {
                case Kind::coordinate: name.now = names_.fresh(p_.coordinates[i].name + "_k"); break;
                case Kind::speed: name.now = names_.fresh(speed() + "_k"); break;
                case Kind::time: name.now = names_.fresh("t_k"); break;
                case Kind::work: name.now = names_.fresh("work_k"); break;
                case Kind::residual: name.now = names_.numbered("row"); break;
                case Kind::unknown: name.now = x.index < r_.preferred ? names_.numbered("a") : names_.numbered("lambda"); break;
                case Kind::sine: name.now = names_.numbered("sin"); break;
                case Kind::cosine: name.now = names_.numbered("cos"); break;
                default: name.now = names_.numbered("z");
            }
            name.first = names_.fresh(name.now + "_0");
        }
    }

    std::vector<Product> products_of(int id) const {
        const SeriesNode& x = node(id);
        std::vector<Product> list;
        for (const auto* terms : {&x.bilinear, &x.implied})
            for (const auto& [weight, a, b] : *terms) list.push_back({weight, a, b});
        const Weight plus{1, -1}, minus{-1, -1};
        switch (x.kind) {
            case Kind::quotient: list.push_back({minus, x.w, id}); break;
            case Kind::root: list.push_back({minus, id, id}); break;
            case Kind::power:
                list.push_back({x.exponent, x.a, id, true, false});
                list.push_back({minus, id, x.a, true, false});
                break;
            case Kind::sine: case Kind::hyperbolic_sine: case Kind::hyperbolic_cosine: case Kind::area:
                list.push_back({plus, x.a, x.w, true, false});
                break;
            case Kind::cosine: list.push_back({minus, x.a, x.w, true, false}); break;
            case Kind::exponential: list.push_back({plus, x.a, id, true, false}); break;
            case Kind::ratio: list.push_back({minus, id, x.w, true, false}); break;
            case Kind::turn:
                list.push_back({plus, x.b, x.a, false, true});
                list.push_back({minus, x.a, x.b, false, true});
                list.push_back({minus, id, x.w, true, false});
                break;
            default: break;
        }
        return list;
    }

    void find_products() {
        products_.resize(r_.nodes.size());
        for (int id = 0; id < size(); ++id) {
            products_[id] = products_of(id);
            if (!products_[id].empty()) named_[id].sums = names_.fresh(named_[id].now + "_sums");
            for (const Product& product : products_[id]) {
                need(product.a, product.a_rate);
                need(product.b, product.b_rate);
            }
        }
    }

    void need(int id, bool rate) {
        Named& name = named_[id];
        std::string& array = rate ? name.rates : name.series;
        if (array.empty()) array = names_.fresh(name.now + (rate ? "_rates" : "_series"));
        if (rate && name.rate.empty()) name.rate = names_.fresh(name.now + "_times");
    }

    // Text of weights and sums.

    std::string constant(int id) {
        const Node& x = p_[id];
        if (x.op == Op::variable) return fmt::format("par[{}]", x.variable.index);
        if (x.is_number()) return exact_text(x.number);
        auto place = std::find(constants_.begin(), constants_.end(), id);
        if (place == constants_.end()) place = constants_.insert(constants_.end(), id);
        return fmt::format("par[{}]", p_.parameters.size() + static_cast<std::size_t>(place - constants_.begin()));
    }

    struct Piece {
        bool negative;
        std::string text;
    };

    Piece piece(const Weight& weight, const std::string& factor) {
        const Rational size = cln::abs(weight.number);
        std::string text;
        if (!cln::equal(size, 1)) text = exact_text(size);
        if (weight.constant >= 0) text += (text.empty() ? "" : " * ") + constant(weight.constant);
        if (!factor.empty()) text += (text.empty() ? "" : " * ") + factor;
        return {cln::minusp(weight.number), text.empty() ? "Real(1)" : text};
    }

    static std::string joined(std::vector<Piece> pieces) {
        if (pieces.empty()) return "Real(0)";
        const auto positive = std::find_if(pieces.begin(), pieces.end(), [](const Piece& x) { return !x.negative; });
        if (positive != pieces.end()) std::rotate(pieces.begin(), positive, positive + 1);
        std::string result = (pieces[0].negative ? "-" : "") + pieces[0].text;
        for (std::size_t k = 1; k < pieces.size(); ++k) result += (pieces[k].negative ? " - " : " + ") + pieces[k].text;
        return result;
    }

    static std::string bracketed(const std::string& text) {
        return text.find(' ') == std::string::npos ? text : "(" + text + ")";
    }

    const std::string& now(int id) const { return named_[id].now; }
    const std::string& first(int id) const { return named_[id].first; }

    // Order 0.

    std::string value_at_zero(int id) {
        const SeriesNode& x = node(id);
        const auto call = [&](const char* function) { return fmt::format("{}({})", function, first(x.a)); };
        std::vector<Piece> pieces;
        for (const auto& [weight, a] : x.linear) pieces.push_back(piece(weight, first(a)));
        for (const auto& [weight, a, b] : x.bilinear) pieces.push_back(piece(weight, first(a) + " * " + first(b)));
        for (const Weight& weight : x.constants) pieces.push_back(piece(weight, ""));
        switch (x.kind) {
            case Kind::quotient: return bracketed(joined(pieces)) + " / " + first(x.w);
            case Kind::root: return call("sqrt");
            case Kind::power: return fmt::format("pow({}, {})", first(x.a), joined({piece(x.exponent, "")}));
            case Kind::sine: return call("sin");
            case Kind::cosine: return call("cos");
            case Kind::hyperbolic_sine: return call("sinh");
            case Kind::hyperbolic_cosine: return call("cosh");
            case Kind::exponential: return call("exp");
            case Kind::area: case Kind::ratio: return call(name_of(x.op));
            case Kind::turn: return fmt::format("atan2({}, {})", first(x.a), first(x.b));
            default: return joined(pieces);
        }
    }

    std::vector<int> arguments(int id) const {
        const SeriesNode& x = node(id);
        std::vector<int> list;
        for (const auto& [weight, a] : x.linear) list.push_back(a);
        for (const auto& [weight, a, b] : x.bilinear) list.insert(list.end(), {a, b});
        for (const int arg : {x.a, x.b}) if (arg >= 0) list.push_back(arg);
        if (x.kind == Kind::quotient || x.kind == Kind::ratio || x.kind == Kind::turn) list.push_back(x.w);
        return list;
    }

    /// Everything that is ready, then all sines that are ready at once, until nothing is left.
    Lines order_zero() {
        Lines lines;
        std::vector<char> done(r_.nodes.size(), 0);
        const auto ready = [&](int id) {
            const auto list = arguments(id);
            return done[id] == 0 && std::all_of(list.begin(), list.end(), [&](int arg) { return done[arg] != 0; });
        };
        bool solved = r_.matrix.empty();
        for (bool moved = true; moved;) {
            moved = false;
            for (int id = 0; id < size(); ++id) {
                if (!ready(id) || is_pair(node(id).kind) || (node(id).kind == Kind::unknown && !solved)) continue;
                if (node(id).kind != Kind::unknown) lines.push_back(statement_at_zero(id));
                done[id] = 1;
                moved = true;
            }
            if (moved) continue;
            std::vector<int> pairs;
            for (int id = 0; id < size() && pairs.size() < 8; ++id)
                if (node(id).kind == Kind::sine && ready(id)) pairs.push_back(id);
            if (!pairs.empty()) {
                add_sines(lines, pairs);
                for (const int id : pairs) done[id] = done[node(id).w] = 1;
                moved = true;
            } else if (!solved) {
                const Lines solution = solution_at_zero();
                lines.insert(lines.end(), solution.begin(), solution.end());
                solved = moved = true;
            }
        }
        add_inverses(lines);
        return lines;
    }

    void add_sines(Lines& lines, const std::vector<int>& pairs) {
        if (pairs.size() == 1) {
            lines.push_back(fmt::format("const auto [{}, {}] = sincos({});", first(pairs[0]), first(node(pairs[0]).w), first(node(pairs[0]).a)));
            return;
        }
        const std::string both = names_.numbered("both");
        std::string angles;
        for (const int id : pairs) angles += (angles.empty() ? "" : ", ") + first(node(id).a);
        lines.push_back(fmt::format("const auto {} = sincos({});", both, angles));
        for (std::size_t i = 0; i < pairs.size(); ++i)
            lines.push_back(fmt::format("const Real {} = {}.sine[{}], {} = {}.cosine[{}];", first(pairs[i]), both, i,
                                        first(node(pairs[i]).w), both, i));
    }

    std::string statement_at_zero(int id) {
        const SeriesNode& x = node(id);
        switch (x.kind) {
            case Kind::time: return fmt::format("const Real {} = t;", first(id));
            case Kind::coordinate: return fmt::format("const Real {} = state[{}];", first(id), x.index);
            case Kind::speed: return fmt::format("const Real {} = state[{}];", first(id), n_ + x.index);
            case Kind::work: return fmt::format("const Real {} = state[{}];", first(id), n_ + s_);
            default: return fmt::format("const Real {} = {};", first(id), value_at_zero(id));
        }
    }

    void add_inverses(Lines& lines) {
        for (int id = 0; id < size(); ++id) {
            const SeriesNode& x = node(id);
            int of = -1;
            if (x.kind == Kind::quotient || x.kind == Kind::ratio || x.kind == Kind::turn) of = x.w;
            if (x.kind == Kind::root) of = id;
            if (x.kind == Kind::power) of = x.a;
            if (of < 0 || !named_[of].inverse.empty()) continue;
            named_[of].inverse = names_.fresh("per_" + named_[of].now);
            lines.push_back(fmt::format("const Real {} = Real(1) / {};", named_[of].inverse, first(of)));
        }
    }

    // The linear system: factors at order 0, then a function of the residuals.

    Lines solution_at_zero() {
        Program solver;
        std::map<int, std::string> leaves;
        Lines lines;
        std::vector<int> lower, right;
        for (const SeriesEntry& e : r_.matrix) {
            if (e.node < 0 && e.constant.constant < 0) {
                lower.push_back(solver.number(e.constant.number));
                continue;
            }
            const int variable = solver.variable({Variable::Kind::parameter, static_cast<int>(lower.size())});
            lower.push_back(variable);
            leaves[variable] = e.node >= 0 ? first(e.node) : names_.numbered("m");
            if (e.node < 0) lines.push_back(fmt::format("const Real {} = {};", leaves[variable], joined({piece(e.constant, "")})));
        }
        std::string residuals, results, firsts;
        for (std::size_t i = 0; i < r_.residuals.size(); ++i) {
            right.push_back(solver.variable({Variable::Kind::unknown, static_cast<int>(i)}));
            const std::string row = names_.numbered("r");
            leaves[right.back()] = row;
            residuals += fmt::format("{}const Real& {}", i > 0 ? ", " : "", row);
            results += fmt::format(", Real& {}", now(r_.unknowns[i]));
            firsts += fmt::format("{}{}", i > 0 ? ", " : "", first(r_.unknowns[i]));
        }
        const auto solution = solve_symmetric(solver, lower, right, r_.preferred);
        if (!solution) throw ModelError("the mass matrix is singular at every state: there are no accelerations to emit");
        // What does not depend on the residuals is done once.
        std::set<int> fixed;
        for (const int id : solver.needed(*solution))
            if (!solver[id].is_constant())
                for (const int arg : solver[id].args)
                    if (solver[arg].is_constant() && !solver[arg].args.empty()) fixed.insert(arg);
        std::vector<Goal> goals;
        for (const int id : fixed) goals.push_back({"Factors", names_.numbered("factor"), id, true});
        Writer factors(solver, names_, leaves);
        for (const Section& section : factors.write(goals)) lines.insert(lines.end(), section.lines.begin(), section.lines.end());
        for (const Goal& goal : goals) {
            if (const std::string value = factors.value(goal.node); value != goal.name)
                lines.push_back(fmt::format("const Real {} = {};", goal.name, value));
            leaves[goal.node] = goal.name;
        }
        lines.push_back(fmt::format("const auto solve = [&]({}{}) __attribute__((always_inline)) {{", residuals, results));
        Writer writer(solver, names_, leaves);
        goals.clear();
        for (const int id : *solution) goals.push_back({"Solution", "", id});
        for (const Section& section : writer.write(goals))
            for (const std::string& line : section.lines) lines.push_back("    " + line);
        for (std::size_t i = 0; i < solution->size(); ++i)
            lines.push_back(fmt::format("    {} = {};", now(r_.unknowns[i]), writer.value((*solution)[i])));
        lines.emplace_back("};");
        lines.push_back(fmt::format("Real {};", firsts));
        lines.push_back(solve_call([&](int id) { return first(id); }));
        return lines;
    }

    template <class Name>
    std::string solve_call(Name name) const {
        std::string args;
        for (const auto* list : {&r_.residuals, &r_.unknowns})
            for (const int id : *list) args += (args.empty() ? "" : ", ") + name(id);
        return fmt::format("solve({});", args);
    }

    // Order k.

    Lines given() const {
        Lines lines;
        for (int id = 0; id < size(); ++id) {
            const SeriesNode& x = node(id);
            const int place = x.kind == Kind::coordinate ? x.index : x.kind == Kind::speed ? n_ + x.index : x.kind == Kind::work ? n_ + s_ : -1;
            if (place < 0) continue;
            lines.push_back(fmt::format("const Real {} = per_k * last[{}];", now(id), place));
            lines.push_back(fmt::format("out[k * {} + {}] = {};", width(), place, now(id)));
        }
        return lines;
    }

    std::string boundary(int a, int b) const {
        if (a == b) return fmt::format("Real(2) * {} * {}", first(a), now(a));
        return fmt::format("({} * {} + {} * {})", first(a), now(b), now(a), first(b));
    }

    /// The coefficient of order k, sums of products being complete but for their ends.
    std::string value(int id) {
        const SeriesNode& x = node(id);
        const std::string sums = named_[id].sums.empty() ? "" : named_[id].sums + "[k]";
        std::vector<Piece> pieces;
        for (const auto& [weight, a] : x.linear) pieces.push_back(piece(weight, now(a)));
        for (const auto& [weight, a, b] : x.bilinear) pieces.push_back(piece(weight, boundary(a, b)));
        for (const auto& [weight, m, a] : x.implied) pieces.push_back(piece(weight, fmt::format("{} * {}", now(m), first(a))));
        const std::string shared = sums.empty() ? "" : "per_k * " + sums;
        switch (x.kind) {
            case Kind::time: return "Real(k == 1)";
            case Kind::quotient:
                pieces.push_back({true, fmt::format("{} * {}", now(x.w), first(id))});
                pieces.push_back({false, sums});
                return fmt::format("({}) * {}", joined(pieces), named_[x.w].inverse);
            case Kind::root: return fmt::format("Real(0.5) * ({} + {}) * {}", now(x.a), sums, named_[id].inverse);
            case Kind::power: return fmt::format("({} + {}) * {}", joined({piece(x.exponent, now(x.a) + " * " + first(id))}), shared, named_[x.a].inverse);
            case Kind::sine: case Kind::hyperbolic_sine: case Kind::hyperbolic_cosine: case Kind::area:
                return fmt::format("{} * {} + {}", now(x.a), first(x.w), shared);
            case Kind::cosine: return fmt::format("{} - {} * {}", shared, now(x.a), first(x.w));
            case Kind::exponential: return fmt::format("{} * {} + {}", now(x.a), first(id), shared);
            case Kind::ratio: return fmt::format("({} + {}) * {}", now(x.a), shared, named_[x.w].inverse);
            case Kind::turn:
                return fmt::format("({} * {} - {} * {} + {}) * {}", first(x.b), now(x.a), first(x.a), now(x.b), shared, named_[x.w].inverse);
            default:
                if (!sums.empty()) pieces.push_back({false, sums});
                return joined(pieces);
        }
    }

    Lines chain() {
        Lines lines;
        const auto rate = [&](int id) {
            if (!named_[id].rate.empty()) lines.push_back(fmt::format("const Real {} = number * {};", named_[id].rate, now(id)));
        };
        for (int id = 0; id < size(); ++id) {
            const Kind kind = node(id).kind;
            if (id == r_.solved_at && !r_.matrix.empty()) {
                std::string unknowns;
                for (const int a : r_.unknowns) unknowns += (unknowns.empty() ? "" : ", ") + now(a);
                lines.push_back(fmt::format("Real {};", unknowns));
                lines.push_back(solve_call([&](int a) { return now(a); }));
            }
            if (kind != Kind::coordinate && kind != Kind::speed && kind != Kind::work && kind != Kind::unknown)
                lines.push_back(fmt::format("const Real {} = {};", now(id), value(id)));
            rate(id);
        }
        return lines;
    }

    /// The node of component i's rate.
    int rate_of(int i) const {
        if (i < n_) return r_.coordinate_rates.empty() ? n_ + i : r_.coordinate_rates[i];
        return i < n_ + s_ ? r_.accelerations[i - n_] : r_.work;
    }

    Lines last() const {
        Lines lines;
        for (int i = 0; i < width(); ++i) lines.push_back(fmt::format("last[{}] = {};", i, now(rate_of(i))));
        return lines;
    }

    Lines spreading() {
        Lines lines;
        for (int id = 0; id < size(); ++id) {
            if (products_[id].empty()) continue;
            std::vector<Piece> middle;
            std::string pairs;
            for (const Product& x : products_[id]) {
                const auto scalar = [&](int arg, bool rate) { return rate ? named_[arg].rate : now(arg); };
                const auto array = [&](int arg, bool rate) { return rate ? named_[arg].rates : named_[arg].series; };
                const auto scaled = [&](const Weight& weight, const std::string& factor) { return joined({piece(weight, factor)}); };
                middle.push_back(piece(x.weight, scalar(x.a, x.a_rate) + " * " + scalar(x.b, x.b_rate)));
                if (x.a == x.b && x.a_rate == x.b_rate) {
                    pairs += fmt::format(", {}, {}", scaled({2 * x.weight.number, x.weight.constant}, scalar(x.a, x.a_rate)), array(x.a, x.a_rate));
                } else {
                    pairs += fmt::format(", {}, {}", scaled(x.weight, scalar(x.a, x.a_rate)), array(x.b, x.b_rate));
                    pairs += fmt::format(", {}, {}", scaled(x.weight, scalar(x.b, x.b_rate)), array(x.a, x.a_rate));
                }
            }
            lines.push_back(fmt::format("spread({}, k, top, {}{});", named_[id].sums, joined(middle), pairs));
        }
        return lines;
    }

    Lines storing() const {
        Lines lines;
        for (int id = 0; id < size(); ++id) {
            if (!named_[id].series.empty()) lines.push_back(fmt::format("{}[k] = {};", named_[id].series, now(id)));
            if (!named_[id].rates.empty()) lines.push_back(fmt::format("{}[k] = {};", named_[id].rates, named_[id].rate));
        }
        return lines;
    }

    Lines arrays() {
        Lines lines;
        for (const Named& name : named_)
            for (const std::string* array : {&name.series, &name.rates})
                if (!array->empty()) lines.push_back(fmt::format("Real* const {} = work + {} * stride + pad;", *array, arrays_count_++));
        for (const Named& name : named_)
            if (!name.sums.empty()) lines.push_back(fmt::format("Real* const {} = work + {} * stride + {} * room;", name.sums, arrays_count_, sums_count_++));
        return lines;
    }

    // What depends on parameters alone; called last, when all constants are known.

    Lines prepare() {
        Lines lines;
        std::map<int, std::string> known;
        const auto text = [&](int id) -> std::string {
            const Node& x = p_[id];
            if (x.op == Op::variable) return fmt::format("par[{}]", x.variable.index);
            if (x.is_number()) return exact_text(x.number);
            if (x.op == Op::pi) return "(Real(3.141592653589793) + Real(1.2246467991473532e-16) + Real(-2.9947698097183397e-33))";
            return known.at(id);
        };
        for (const int id : p_.needed(constants_)) {
            const Node& x = p_[id];
            if (x.args.empty()) continue;
            std::string value;
            if (x.op == Op::sum) {
                std::vector<Piece> pieces;
                for (std::size_t k = 0; k < x.args.size(); ++k) {
                    const Rational size = cln::abs(x.coefficients[k]);
                    pieces.push_back({cln::minusp(x.coefficients[k]), (cln::equal(size, 1) ? "" : exact_text(size) + " * ") + text(x.args[k])});
                }
                if (!cln::zerop(x.number)) pieces.push_back({cln::minusp(x.number), exact_text(cln::abs(x.number))});
                value = joined(pieces);
            } else if (x.op == Op::product) {
                std::string above, below;
                for (std::size_t k = 0; k < x.args.size(); ++k)
                    for (int e = 0; e < std::abs(x.exponents[k]); ++e)
                        (x.exponents[k] > 0 ? above : below) += (x.exponents[k] < 0 ? " / " : above.empty() ? "" : " * ") + text(x.args[k]);
                value = (above.empty() ? "Real(1)" : above) + below;
            } else {
                value = std::string(name_of(x.op)) + "(" + text(x.args[0]) + (x.args.size() > 1 ? ", " + text(x.args[1]) : "") + ")";
            }
            known[id] = names_.numbered("c");
            lines.push_back(fmt::format("const Real {} = {};", known[id], value));
        }
        for (std::size_t k = 0; k < constants_.size(); ++k)
            lines.push_back(fmt::format("par[{}] = {};", p_.parameters.size() + k, text(constants_[k])));
        return lines;
    }

    const Recurrences r_;
    const Program& p_;
    int n_, s_;
    bool with_work_;
    Names names_;
    std::vector<Named> named_;                    // of each node
    std::vector<std::vector<Product>> products_;  // that each node sums up
    std::vector<int> constants_;                  // of the Program, in the order of `par`
    int arrays_count_ = 0, sums_count_ = 0;
};

}  // namespace

Source emit_taylor(const Program& program, bool with_work) {
    if (program.singular)
        throw ModelError("the mass matrix is singular at every state: there are no accelerations to emit");
    return TaylorEmitter(program, with_work).emit();
}

}  // namespace alembert
