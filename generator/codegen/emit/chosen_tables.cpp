// SPDX-License-Identifier: GPL-2.0-or-later
// The mathematics is that of table_text.cpp.
#include "codegen/emit/chosen_tables.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include "codegen/emit/layout.hpp"
#include "codegen/emit/numbers.hpp"
#include "codegen/emit/table_text.hpp"

namespace alembert {

namespace {

using Call = Program::TableCall;

class ChosenTables {
public:
    ChosenTables(const Program& program, const Dialect& dialect)
        : p_(program), dialect_(dialect), shapes_(dialect.tables) {}

    std::string text() {
        std::map<std::string, const Node*> calls;
        std::vector<int> roots;
        for (const Root& root : p_.roots) roots.push_back(root.node);
        for (const int id : p_.needed(roots)) {
            const Node& node = p_[id];
            if (node.op != Op::unspecified) continue;
            if (p_.table_of(node) == nullptr) p_.refuse_unspecified(node);
            const Call call = p_.table_call(node);
            if (call.is_held || call.orders[0] >= TabulatedFunction::side_function)
                throw std::logic_error("no run holds sides in this language");
            calls.emplace(table_call(p_, node), &node);
        }
        std::string result;
        std::set<std::string> written;
        for (const auto& [name, node] : calls) {
            const std::string base = table_base(p_, *node);
            const TabulatedFunction& table = *p_.table_of(*node);
            if (written.insert(base).second) result += "\n" + numbers(base, table);
            result += "\n" + function(name, base, table, p_.table_call(*node));
        }
        while (result.ends_with('\n')) result.pop_back();
        return result;
    }

private:
    std::string real(double x) const { return dialect_.literal(shortest(x)); }

    std::string list(const std::string& name, const std::vector<double>& values) const {
        std::vector<std::string> items;
        for (const double value : values) items.push_back(dialect_.listed(shortest(value)));
        std::string text = wrapped_list(items);
        text.resize(text.find_last_not_of(", ") + 1);
        if (dialect_.continuation == Continuation::dots)
            for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 5))
                text.insert(at, " ...");
        return formed(shapes_.numbers, name, text, values.size());
    }

    static std::string suffix(const TabulatedFunction& table, std::size_t axis) {
        return table.arguments() > 1 ? std::to_string(axis + 1) : "";
    }

    std::string numbers(const std::string& base, const TabulatedFunction& table) const {
        std::string text;
        for (std::size_t k = 0; k < table.arguments(); ++k)
            text += list(base + "_at" + suffix(table, k), table.axes()[k].at);
        return text + list(base + "_c", table.coefficients());
    }

    /// "at1[k1 + 1]": the number at this place, which is counted from 0.
    std::string element(const std::string& array, const std::string& place, int further) const {
        further += dialect_.first;
        return formed(shapes_.element, array, further > 0 ? fmt::format("{} + {}", place, further) : place);
    }

    std::string line(const std::string& name, const std::string& value) const {
        return "    " + dialect_.wrapped(dialect_.declared(name, value)) + "\n";
    }

    /// The name of a list inside a function, where its statement stands.
    std::string local(std::string& lines, const std::string& name, const std::string& list) const {
        if (shapes_.array.empty()) return list;
        lines += line(name, formed(shapes_.array, list));
        return name;
    }

    /// y, the piece k and u along an axis.
    void place(std::string& lines, const std::string& base, const TabulatedFunction& table, std::size_t a) const {
        const TableAxis& axis = table.axes()[a];
        const std::string n = std::to_string(a + 1), x = "x" + n, y = "y" + n;
        const std::string at = local(lines, "at" + n, base + "_at" + suffix(table, a));
        const std::string low = real(axis.at.front()), high = real(axis.at.back());
        if (axis.period > 0)
            lines += line(
                y, fmt::format("{} - {} * {}", x, real(axis.period),
                               formed(shapes_.floor, fmt::format("({} - {}) / {}", x, low, real(axis.period)))));
        else
            lines += line(y, formed(shapes_.chosen, x + " < " + low, low,
                                    formed(shapes_.chosen, x + " > " + high, high, x)));
        lines += line("k" + n, formed(shapes_.place, at, y));
        lines += line("u" + n, y + " - " + element(at, "k" + n, 0));
    }

    /// The value, or what stands for it where the argument is outside.
    std::string value(std::string& lines, const std::string& value, const TabulatedFunction& table,
                      const Call& call) const {
        std::string result = value;
        for (std::size_t a = 0; a < call.arguments; ++a) {
            const TableAxis& axis = table.axes()[a];
            if (axis.period > 0) continue;
            const std::string x = "x" + std::to_string(a + 1), low = real(axis.at.front()),
                              high = real(axis.at.back());
            const std::string inside = formed(shapes_.both, x + " >= " + low, x + " <= " + high);
            const int most = table.outside() == TabulatedFunction::Outside::hold ? 0 : 1;
            if (table.outside() != TabulatedFunction::Outside::error) {
                if (call.orders[a] > most)
                    result = formed(shapes_.chosen, inside, result, dialect_.literal("0") + " * " + x);
            } else if (shapes_.no_number.empty()) {
                lines +=
                    fmt::format("    assert({}, \"a function by points is asked beyond its ends\");\n", inside);
            } else {
                result = formed(shapes_.chosen, inside, result, shapes_.no_number);
            }
        }
        return result;
    }

    std::string function(const std::string& name, const std::string& base, const TabulatedFunction& table,
                         const Call& call) const {
        std::string arguments;
        for (std::size_t k = 0; k < call.arguments; ++k)
            arguments += (k == 0 ? std::string() : std::string(shapes_.separator)) +
                         formed(shapes_.argument, "x" + std::to_string(k + 1));
        std::string lines;
        if (call.orders[0] > table.degree() || call.orders[1] > table.degree())
            return formed(shapes_.function, name, arguments, lines,
                          dialect_.literal("0") + " * " + (call.arguments == 1 ? "x1" : "(x1 + x2)"));
        for (std::size_t k = 0; k < call.arguments; ++k) place(lines, base, table, k);
        const std::string c = local(lines, "c", base + "_c");
        const int count = table.degree() + 1;
        lines += line("cell", call.arguments == 1 ? fmt::format("{} * k1", count)
                                                  : fmt::format("{} * ({} * k1 + k2)", count * count,
                                                                table.axes()[1].at.size() - 1));
        const std::string inner =
            table_value(table, call,
                        {.coefficient = [&](int k) { return element(c, "cell", k); },
                         .number = [&](int k) { return dialect_.literal(std::to_string(k)); }});
        lines += line("y", inner);
        const std::string result = value(lines, "y", table, call);
        return formed(shapes_.function, name, arguments, lines, result);
    }

    const Program& p_;
    const Dialect& dialect_;
    const DialectTables& shapes_;
};

}  // namespace

std::string chosen_tables(const Program& program, const Dialect& dialect) {
    return ChosenTables(program, dialect).text();
}

}  // namespace alembert
