// SPDX-License-Identifier: GPL-2.0-or-later
// Sines and cosines: up to eight angles are computed at once; on request, sines and cosines of sums are computed
// from those of the terms.
#include <fmt/format.h>

#include <algorithm>

#include "codegen/emit/dialect.hpp"
#include "codegen/emit/writer.hpp"
#include "program/processor.hpp"

namespace alembert {

std::vector<CodeStatement> Writer::trigonometry(const std::vector<int>& nodes) {
    NodeMap<int> depth;  // the nesting depth of sines in a node
    int deepest = 0;
    for (const auto& [id, count] : uses_) {
        if (is_leaf(id)) continue;
        int& own = depth[id];
        for (const int arg : program_[id].args) own = std::max(own, depth[arg]);
        deepest = std::max(deepest, own += is_trigonometric(program_[id]) ? 1 : 0);
    }
    std::vector<CodeStatement> statements;
    for (int d = 0; d <= deepest; ++d) {
        for (const int id : nodes)
            if (!is_trigonometric(program_[id]) && depth[id] == d) statements.push_back(statement(id));
        std::vector<int> arguments, first;  // the arguments, and the first node of each
        for (const int id : nodes)
            if (const int argument = program_[id].args.empty() ? -1 : program_[id].args[0];
                is_trigonometric(program_[id]) && depth[id] == d + 1 &&
                std::find(arguments.begin(), arguments.end(), argument) == arguments.end()) {
                arguments.push_back(argument);
                first.push_back(id);
            }
        const std::vector<AngleSum> sums =
            adds_angles_ ? taken_out_sums(arguments, first) : std::vector<AngleSum>();
        for (std::size_t begin = 0; begin < arguments.size(); begin += processor::widest_sincos) {
            const std::size_t end = std::min(begin + processor::widest_sincos, arguments.size());
            const auto at = [&](std::size_t k) { return arguments.begin() + static_cast<std::ptrdiff_t>(k); };
            if (end - begin > 1 && language_ == CodeLanguage::cpp)
                statements.push_back(sines_together({at(begin), at(end)}, sums));
            else
                for (std::size_t k = begin; k < end; ++k) statements.push_back(statement(first[k]));
        }
        for (const AngleSum& sum : sums) add_angle_sum(statements, sum);
    }
    return statements;
}

/// Two to eight angles in one call; the values that are needed get names.
CodeStatement Writer::sines_together(const std::vector<int>& arguments, const std::vector<AngleSum>& sums) {
    const std::string group = names_.numbered("trig");
    std::string of, values;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        const int argument = arguments[k];
        const std::string base = trigonometric_name(argument);
        of += (of.empty() ? "" : ", ") + text(argument, additive);
        const bool is_added = std::any_of(
            sums.begin(), sums.end(), [&](const AngleSum& sum) { return sum.a == argument || sum.b == argument; });
        const auto name_it = [&](int node, std::map<int, std::string>& known, const char* prefix,
                                 const char* part) {
            if (node < 0 && !is_added) return;
            names.push_back(known[argument] = names_.fresh(prefix + base));
            if (node >= 0) named_[node] = names.back();
            values += fmt::format("{}{} = {}.{}[{}]", values.empty() ? "" : ", ", names.back(), group, part, k);
        };
        const auto [sine, cosine] = sines_[argument];
        name_it(sine, sine_names_, "sin_", "sine");
        name_it(cosine, cosine_names_, "cos_", "cosine");
    }
    return finished(std::move(names),
                    fmt::format("const auto {} = sincos({});\nconst Real {};", group, of, values));
}

void Writer::add_angle_sum(std::vector<CodeStatement>& statements, const AngleSum& sum) {
    const auto [sine, cosine] = sines_[sum.argument];
    const std::string base = trigonometric_name(sum.argument);
    const std::string &sa = sine_names_[sum.a], &ca = cosine_names_[sum.a], &sb = sine_names_[sum.b],
                      &cb = cosine_names_[sum.b];
    const auto add = [&](int node, const char* prefix, const std::string& value) {
        if (node < 0) return;
        const std::string name = named_[node] = names_.fresh(prefix + base);
        reading_.insert({sa, ca, sb, cb});
        operations_ += 3;
        statements.push_back(finished({name}, declared(name, value)));
    };
    add(sine, "sin_", fmt::format("{} * {} {} {} * {}", sa, cb, sum.is_difference ? '-' : '+', ca, sb));
    add(cosine, "cos_", fmt::format("{} * {} {} {} * {}", ca, cb, sum.is_difference ? '+' : '-', sa, sb));
}

/// The statement for the sine or cosine of a single angle.
CodeStatement Writer::trigonometric_statement(int id) {
    const Node& node = program_[id];
    const int argument = node.args[0];
    const auto [sine, cosine] = sines_[argument];
    const std::string base = trigonometric_name(argument), of = text(argument, additive);
    if (sine >= 0) named_[sine] = names_.fresh("sin_" + base);
    if (cosine >= 0) named_[cosine] = names_.fresh("cos_" + base);
    ++operations_;
    const Dialect& dialect = dialect_of(language_);
    const auto function = [&](Op op) { return dialect.call(op, of) + ")"; };
    if (sine >= 0 && cosine >= 0 && dialect.is_shaped())
        return finished({named_[sine], named_[cosine]}, declared(named_[sine], function(Op::sin)) + "\n" +
                                                            declared(named_[cosine], function(Op::cos)));
    if (sine >= 0 && cosine >= 0 && language_ != CodeLanguage::cpp)
        return finished({named_[sine], named_[cosine]},
                        declared(named_[sine], fmt::format("{}, {} = {}", function(Op::sin), named_[cosine],
                                                           function(Op::cos))));
    if (sine >= 0 && cosine >= 0)
        return finished({named_[sine], named_[cosine]},
                        fmt::format("const auto [{}, {}] = sincos({});", named_[sine], named_[cosine], of));
    return finished({named_[id]}, declared(named_[id], function(node.op)));
}

/// Removes from the lists the angles that are sums or differences of two others, if those others fit in one group.
std::vector<Writer::AngleSum> Writer::taken_out_sums(std::vector<int>& arguments, std::vector<int>& first) const {
    std::vector<AngleSum> sums;
    if (arguments.size() > processor::widest_sincos) return sums;
    const std::vector<int> all = arguments;
    const auto is_alone = [&](int id) {
        return std::find(all.begin(), all.end(), id) != all.end() &&
               (program_[id].op != Op::sum || program_[id].is_scaled());
    };
    for (const int id : all) {
        const Node& node = program_[id];
        if (node.op != Op::sum || node.args.size() != 2 || !cln::zerop(node.number) ||
            !cln::equal(node.coefficients[0], 1) || !cln::equal(cln::abs(node.coefficients[1]), 1) ||
            !is_alone(node.args[0]) || !is_alone(node.args[1]))
            continue;
        sums.push_back({.argument = id,
                        .a = node.args[0],
                        .b = node.args[1],
                        .is_difference = cln::minusp(node.coefficients[1])});
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

}  // namespace alembert
