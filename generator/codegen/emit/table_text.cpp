// SPDX-License-Identifier: GPL-2.0-or-later
// A derivative of order k of the polynomial Σ c_j u^j is Σ j!/(j−k)! c_j u^(j−k), by Horner's rule. With y for x
// held back at the ends, the line beyond them is P(y) + P'(y)(x − y), which between them is P(x).
#include "codegen/emit/table_text.hpp"

#include <fmt/format.h>

#include <kainjow/mustache.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include "base/language/say.hpp"
#include "codegen/emit/chosen_tables.hpp"
#include "codegen/emit/names.hpp"
#include "codegen/emit/numbers.hpp"
#include "codegen/emit/templates.hpp"

namespace alembert {

namespace {

using Call = Program::TableCall;

bool is_side(const Call& call) {
    return call.orders[0] >= TabulatedFunction::side_function;
}

/// Σ of `terms` with u from the power `order` on, differentiated so often.
std::string horner(const std::vector<std::string>& terms, int order, const std::string& u,
                   const TableWords& words) {
    std::string text;
    for (int j = static_cast<int>(terms.size()) - 1; j >= order; --j) {
        int factor = 1;
        for (int k = 0; k < order; ++k) factor *= j - k;
        const std::string term =
            factor == 1 ? terms[static_cast<std::size_t>(j)]
                        : fmt::format("{} * {}", words.number(factor), terms[static_cast<std::size_t>(j)]);
        text = text.empty() ? term : fmt::format("{} + {} * ({})", term, u, text);
    }
    return text.empty() ? words.number(0) : text;
}

std::string polynomial(const TabulatedFunction& table, const TabulatedFunction::Orders& orders,
                       const TableWords& words) {
    const int count = table.degree() + 1;
    std::vector<std::string> rows;
    for (int j = 0; j < count; ++j) {
        if (table.arguments() == 1) {
            rows.push_back(words.coefficient(j));
            continue;
        }
        std::vector<std::string> terms;
        for (int l = 0; l < count; ++l) terms.push_back(words.coefficient(count * j + l));
        rows.push_back("(" + horner(terms, orders[1], "u2", words) + ")");
    }
    return horner(rows, orders[0], "u1", words);
}

class TableText {
public:
    TableText(const Program& program, CodeLanguage language) : p_(program), language_(language) {}

    std::string functions() {
        std::map<std::string, const Node*> calls;
        std::vector<int> roots;
        for (const Root& root : p_.roots) roots.push_back(root.node);
        bool any_held = false;
        for (const int id : p_.needed(roots)) {
            const Node& node = p_[id];
            if (node.op != Op::unspecified) continue;
            if (p_.table_of(node) == nullptr) p_.refuse_unspecified(node);
            const Call call = p_.table_call(node);
            any_held = any_held || call.is_held || is_side(call);
            calls.emplace(table_call(p_, node), &node);
        }
        if (calls.empty()) return {};
        if (is_javascript() && any_held) throw std::logic_error("no run holds sides in JavaScript");
        kainjow::mustache::data file;
        file.set("javascript", language_ == CodeLanguage::javascript);
        file.set("packs", language_ == CodeLanguage::cpp);
        file.set("local", language_ == CodeLanguage::c ? "static inline" : "[[maybe_unused]] inline");
        file.set("floor", language_ == CodeLanguage::c ? "floor" : "__builtin_floor");
        file.set("held", any_held && language_ != CodeLanguage::javascript);
        std::string text = "\n\n" + kainjow::mustache::mustache{std::string(template_tables)}.render(file);
        for (const auto& [name, node] : calls) {
            const std::string base = table_base(p_, *node);
            if (!written_.contains(base)) text += numbers(base, *p_.table_of(*node));
            written_.insert(base);
            text += function(name, *node);
        }
        while (text.ends_with('\n')) text.pop_back();
        return text;
    }

private:
    bool is_javascript() const { return language_ == CodeLanguage::javascript; }

    template <typename Number>
    std::string list(const std::string& name, const std::vector<Number>& values, const char* type) const {
        std::string text =
            is_javascript() ? fmt::format("const {} = [", name)
                            : fmt::format("{} {} {}[] = {{",
                                          language_ == CodeLanguage::c ? "static const" : "constexpr", type, name);
        std::size_t length = text.size();
        for (std::size_t k = 0; k < values.size(); ++k) {
            const std::string value = shortest(static_cast<double>(values[k]));
            if (length + value.size() + 2 > 110) {
                if (text.ends_with(" ")) text.pop_back();
                text += "\n    ", length = 4;
            }
            text += value + (k + 1 < values.size() ? ", " : "");
            length += value.size() + 2;
        }
        return text + (is_javascript() ? "];\n" : "};\n");
    }

    std::string numbers(const std::string& base, const TabulatedFunction& table) const {
        std::string text = "\n";
        for (std::size_t k = 0; k < table.arguments(); ++k) {
            const TableAxis& axis = table.axes()[k];
            text += list(fmt::format("{}_at{}", base, suffix(table, k)), axis.at, "double");
            if (!is_javascript() && !axis.kinks.empty() && is_used(base, k))
                text += list(kinks_name(base, k), axis.kinks, "int");
        }
        return text + list(base + "_c", table.coefficients(), "double");
    }

    /// Whether a call is held by these kinks, or has them as zeros.
    bool is_used(const std::string& base, std::size_t axis) const {
        std::vector<int> roots;
        for (const Root& root : p_.roots) roots.push_back(root.node);
        for (const int id : p_.needed(roots)) {
            const Node& node = p_[id];
            if (node.op != Op::unspecified || table_base(p_, node) != base) continue;
            const Call call = p_.table_call(node);
            if (is_side(call) ? TabulatedFunction::side_axis(call.orders[0]) == axis : call.is_held) return true;
        }
        return false;
    }

    static std::string suffix(const TabulatedFunction& table, std::size_t axis) {
        return table.arguments() > 1 ? std::to_string(axis + 1) : "";
    }
    static std::string kinks_name(const std::string& base, std::size_t axis) {
        return fmt::format("{}_kinks{}", base, axis + 1);
    }
    /// The positions of the knots at which a derivative jumps, and their number.
    static std::string kinks_of(const std::string& base, const TabulatedFunction& table, std::size_t axis) {
        const std::size_t count = table.axes()[axis].kinks.size();
        return fmt::format("{}, {}", count > 0 ? kinks_name(base, axis) : "0", count);
    }

    /// "const Real u = …;"
    std::string local(const std::string& name, const std::string& value, const char* type = "Real") const {
        return is_javascript() ? fmt::format("    const {} = {};\n", name, value)
                               : fmt::format("    const {} {} = {};\n", type, name, value);
    }
    std::string real(const std::string& x) const { return is_javascript() ? x : fmt::format("Real({})", x); }
    TableWords words() const {
        return {.coefficient =
                    [this](int k) { return (is_javascript() ? "c[cell + " : "c[") + std::to_string(k) + "]"; },
                .number = [](int k) { return std::to_string(k); }};
    }
    std::string no_number() const {
        return is_javascript() ? "NaN" : language_ == CodeLanguage::c ? "(Real)NAN" : "Real(__builtin_nan(\"\"))";
    }
    std::string floor_of(const std::string& x) const {
        return is_javascript()                ? fmt::format("Math.floor({})", x)
               : language_ == CodeLanguage::c ? fmt::format("floor({})", x)
                                              : fmt::format("__builtin_floor(double({}))", x);
    }
    std::string as_double(const std::string& x) const {
        return language_ == CodeLanguage::cpp ? fmt::format("double({})", x) : x;
    }

    /// y, the piece k and u along an axis, or a return where there is no value.
    std::string place(const std::string& base, const TabulatedFunction& table, const Call& call,
                      std::size_t a) const {
        const TableAxis& axis = table.axes()[a];
        const std::string n = std::to_string(a + 1), x = "x" + n, at = base + "_at" + suffix(table, a);
        const std::string low = shortest(axis.at.front()), high = shortest(axis.at.back());
        const std::string pieces = std::to_string(axis.at.size() - 1),
                          outside = fmt::format("!({0} >= {1} && {0} <= {2})", x, low, high);
        const bool has_ends = axis.period == 0;
        std::string text;
        const bool is_error = has_ends && table.outside() == TabulatedFunction::Outside::error;
        const int most = table.outside() == TabulatedFunction::Outside::hold ? 0 : 1;
        if (is_error) text += fmt::format("    if ({}) return {};\n", outside, no_number());
        if (call.is_held) return text + held_place(base, table, call, a);
        if (has_ends && !is_error && call.orders[a] > most)
            text += fmt::format("    if ({}) return 0 * {};\n", outside, x);
        text += is_error ? local("y" + n, x)
                : has_ends
                    ? local("y" + n, fmt::format("{0} < {1} ? {3} : {0} > {2} ? {4} : {0}", x, low, high,
                                                 real(low), real(high)))
                    : local("y" + n,
                            fmt::format("{0} - {1} * {2}", x, shortest(axis.period),
                                        floor_of(fmt::format("({} - {}) / {}", x, low, shortest(axis.period)))));
        const std::string k = is_javascript()
                                  ? fmt::format("table_place({}, y{})", at, n)
                                  : fmt::format("table_place({}, {}, {})", at, pieces, as_double("y" + n));
        return text + local("k" + n, k, "int") + local("u" + n, fmt::format("y{0} - {1}[k{0}]", n, at));
    }

    std::string held_place(const std::string& base, const TabulatedFunction& table, const Call& call,
                           std::size_t a) const {
        const TableAxis& axis = table.axes()[a];
        const std::string n = std::to_string(a + 1), at = base + "_at" + suffix(table, a),
                          pieces = std::to_string(axis.at.size() - 1), period = shortest(axis.period);
        std::string text = local(
            "piece" + n,
            fmt::format("table_held({}, {}, {}, {}, {}, {}, {})", at, pieces, period, kinks_of(base, table, a),
                        table.cycle(a, call.orders), as_double("x" + n), as_double("number" + n)),
            "long");
        if (axis.period > 0)
            return text +
                   local("k" + n, fmt::format("(int)(piece{0} - table_below(piece{0}, {1}) * {1})", n, pieces),
                         "int") +
                   local("y" + n, "x" + n) +
                   local("u" + n,
                         fmt::format("x{0} - table_knot({1}, {2}, {3}, piece{0})", n, at, pieces, period));
        const int most = table.outside() == TabulatedFunction::Outside::hold ? 0 : 1;
        if (call.orders[a] > most)
            text += fmt::format("    if (piece{0} < 0 || piece{0} >= {1}) return 0 * x{0};\n", n, pieces);
        return text +
               local("k" + n,
                     fmt::format("piece{0} < 0 ? 0 : piece{0} >= {1} ? {1} - 1 : (int)piece{0}", n, pieces),
                     "int") +
               local("y" + n, fmt::format("piece{0} < 0 ? Real({1}[0]) : piece{0} >= {2} ? Real({1}[{2}]) : x{0}",
                                          n, at, pieces)) +
               local("u" + n, fmt::format("y{0} - {1}[k{0}]", n, at));
    }

    std::string function(const std::string& name, const Node& node) const {
        const TabulatedFunction& table = *p_.table_of(node);
        const Call call = p_.table_call(node);
        const std::string base = table_base(p_, node);
        std::vector<std::string> names;
        for (std::size_t k = 0; k < call.arguments; ++k) names.push_back(fmt::format("x{}", k + 1));
        for (std::size_t k = 0; call.is_held && k < call.arguments; ++k)
            names.push_back(fmt::format("number{}", k + 1));
        std::string arguments;
        for (const std::string& one : names)
            arguments += (arguments.empty() ? "" : ", ") + (is_javascript()                ? one
                                                            : language_ == CodeLanguage::c ? "Real " + one
                                                                                           : "const Real& " + one);
        std::string text = "\n";
        text += is_javascript() ? fmt::format("function {}({}) {{\n", name, arguments)
                : language_ == CodeLanguage::c
                    ? fmt::format("static Real {}({}) {{\n", name, arguments)
                    : fmt::format("template <typename Real>\nReal {}({}) {{\n", name, arguments);
        const std::string end = language_ == CodeLanguage::cpp ? "    }\n}\n" : "}\n";
        if (language_ == CodeLanguage::cpp) text += lanes(name, names);
        if (is_side(call)) return text + side(base, table, call) + end;
        if (call.is_held && call.arguments == 1) text += mixture(name);
        if (call.orders[0] > table.degree() || call.orders[1] > table.degree())
            return text + (call.arguments == 1 ? "    return 0 * x1;\n" : "    return 0 * (x1 + x2);\n") + end;
        for (std::size_t k = 0; k < call.arguments; ++k) text += place(base, table, call, k);
        const int count = table.degree() + 1;
        const std::string cell =
            call.arguments == 1 ? fmt::format("{} * k1", count)
                                : fmt::format("{} * ({} * k1 + k2)", count * count, table.axes()[1].at.size() - 1);
        text += is_javascript() ? fmt::format("    const c = {}_c, cell = {};\n", base, cell)
                                : fmt::format("    const double* const c = {}_c + {};\n", base, cell);
        return text + "    return " + real(table_value(table, call, words())) + ";\n" + end;
    }

    /// Of several systems side by side one after the other.
    static std::string lanes(const std::string& name, const std::vector<std::string>& names) {
        std::string each;
        for (const std::string& one : names) each += (each.empty() ? "" : ", ") + one + ".v[k]";
        return fmt::format(
            "    if constexpr (table_is_pack(static_cast<const Real*>(nullptr))) {{\n"
            "        Real result{{}};\n"
            "        for (int k = 0; k < Real::lanes; ++k) result.v[k] = {}({});\n"
            "        return result;\n    }} else {{\n",
            name, each);
    }

    /// Between two numbers the value is that of both intervals together.
    std::string mixture(const std::string& name) const {
        const bool is_c = language_ == CodeLanguage::c;
        const std::string share = is_c ? "share" : "Real(share)";
        return local("whole", floor_of("number1"), "double") +
               local("share", as_double("number1") + " - whole", "double") +
               fmt::format("    if (share > 0)\n        return (1 - {0}) * {1}(x1, {2}) + {0} * {1}(x1, {3});\n",
                           share, name, is_c ? "(Real)whole" : "Real(whole)",
                           is_c ? "(Real)(whole + 1)" : "Real(whole + 1)");
    }

    std::string side(const std::string& base, const TabulatedFunction& table, const Call& call) const {
        const int times = call.orders[0] % 10;
        const std::size_t a = TabulatedFunction::side_axis(call.orders[0]);
        const TableAxis& axis = table.axes()[a];
        return fmt::format("    return Real(table_side({}_at{}, {}, {}, {}, {}, {}));\n", base, suffix(table, a),
                           axis.at.size() - 1, shortest(axis.period), kinks_of(base, table, a), times,
                           as_double("x1"));
    }

    const Program& p_;
    CodeLanguage language_;
    std::set<std::string> written_;
};

}  // namespace

std::string table_value(const TabulatedFunction& table, const Call& call, const TableWords& words) {
    std::string text = polynomial(table, call.orders, words);
    if (table.outside() != TabulatedFunction::Outside::line) return text;
    const auto goes_on = [&](std::size_t k) {
        return k < call.arguments && call.orders[k] == 0 && table.axes()[k].period == 0;
    };
    auto orders = call.orders;
    for (std::size_t k = 0; k < 2; ++k)
        if (goes_on(k)) {
            orders = call.orders;
            ++orders[k];
            text += fmt::format(" + (x{0} - y{0}) * ({1})", k + 1, polynomial(table, orders, words));
        }
    if (goes_on(0) && goes_on(1))
        text += fmt::format(" + (x1 - y1) * (x2 - y2) * ({})", polynomial(table, {1, 1}, words));
    return text;
}

std::string table_base(const Program& p, const Node& node) {
    const std::size_t index = p.function_of(node);
    return fmt::format("table{}_{}", index, ascii_identifier(p.functions.at(index)));
}

std::string table_functions(const Program& program, CodeLanguage language) {
    if (dialect_of(language).is_shaped()) return chosen_tables(program, dialect_of(language));
    return TableText(program, language).functions();
}

std::string table_call(const Program& program, const Node& node) {
    const Call call = program.table_call(node);
    std::string name = table_base(program, node);
    if (is_side(call)) return name + fmt::format("_side{}", call.orders[0] - TabulatedFunction::side_function);
    if (call.orders[0] + call.orders[1] > 0)
        name += call.arguments == 1 ? fmt::format("_{}", call.orders[0])
                                    : fmt::format("_{}{}", call.orders[0], call.orders[1]);
    return call.is_held ? name + "_held" : name;
}

}  // namespace alembert
