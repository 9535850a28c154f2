// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/kink_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "analysis/exact/expression_of.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

std::string number(long double x) {
    return fmt::format("{:.6g}", static_cast<double>(x) + 0.0);
}

class Message {
public:
    explicit Message(const KinkPlace& place)
        : r_(place.residuals), at_(place.at), point_(place.value), m_(place.mechanism), e_(place.equations) {}

    std::string about(const std::vector<int>& nodes, const std::string& fault) const {
        std::vector<std::string> functions, labels;
        for (const int id : nodes) add(functions, text_of(r_.program, id));
        in_the_scene(functions, labels);
        if (functions.size() > 3) functions.resize(3);
        return say(
            "the equations of motion have no first derivative at {}, so they cannot be linearized there: because "
            "of {}{}, {}. A force must have a first derivative at the state, and a potential a second one. Give "
            "a state off this point, or a function that is smooth there, such as sqrt(x^2 + e^2) for abs(x)",
            place(nodes), fmt::join(functions, ", "), labels.empty() ? "" : say(" in {}", fmt::join(labels, ", ")),
            fault);
    }

private:
    static void add(std::vector<std::string>& list, const std::string& item) {
        if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
    }

    std::string text_of(const Program& program, int id) const {
        std::vector<GiNaC::symbol> unknown;
        for (const Mechanism::Input& input : m_.inputs)
            unknown.insert(unknown.end(), input.derivative.begin(), input.derivative.end());
        const bool in_rates = e_.speeds_are_rates() || &program != &r_.program;
        const auto value = in_rates || r_.s <= r_.n ? expression_of(program, id, m_, unknown) : std::nullopt;
        if (!value) return fmt::format("{}(…)", name_of(program[id].op));
        GiNaC::exmap speeds;
        for (int i = 0; i < r_.s && !in_rates; ++i) speeds[m_.qdot[i]] = e_.u[i];
        const auto f = fourier(value->subs(speeds), *m_.symbols, 400);
        return f ? text(readable(*f)) : fmt::format("{}(…)", name_of(program[id].op));
    }

    /// The critical functions of the scene's energies and loads, with the labels of these. Keeps those that are in
    /// `functions`, or all if those in `functions` come only from differentiation, as sign(x) does from abs(x).
    /// Changes nothing if there are none.
    void in_the_scene(std::vector<std::string>& functions, std::vector<std::string>& labels) const {
        std::vector<std::pair<std::string, GiNaC::ex>> parts;  // label, value
        for (const auto* list : {&m_.kinetic, &m_.potential})
            for (const Part& part : *list) parts.emplace_back(shown_label(part.origin), part.value);
        if (m_.given_lagrangian) parts.emplace_back(say("the Lagrangian"), *m_.given_lagrangian);
        for (const Load& load : m_.loads)
            for (const Load::Pair& pair : load.pairs)
                for (const GiNaC::ex& value : {pair.force, pair.velocity})
                    parts.emplace_back(shown_label(load.origin), value);
        std::vector<GiNaC::ex> values;
        for (const auto& part : parts) values.push_back(part.second);
        Program program = begun(m_);
        const std::vector<int> nodes = lower_expressions(program, m_, values);
        State<PuiseuxSeries> state;
        const auto about = [](long double x) { return PuiseuxSeries(x, 1e-13L * std::max(1.0L, std::abs(x))); };
        for (const long double x : at_.parameters) state.parameters.push_back(PuiseuxSeries(x));
        for (const long double x : at_.q) state.q.push_back(about(x));
        for (const int node : r_.rate) state.qdot.push_back(about(point_[node].at(0).value));
        for (int k = r_.s - r_.states; k < r_.s; ++k)
            state.qdot.push_back(about(at_.u[static_cast<std::size_t>(k)]));
        state.t = PuiseuxSeries(at_.t);
        const std::vector<PuiseuxSeries> value = interpret(program, state);
        std::vector<std::pair<std::string, std::string>> found;  // function, label
        for (std::size_t k = 0; k < nodes.size(); ++k)
            for (const int id : critical_nodes(program, std::vector<int>{nodes[k]}, value))
                found.emplace_back(text_of(program, id), parts[k].first);
        const auto is_known = [&](const auto& item) {
            return std::find(functions.begin(), functions.end(), item.first) != functions.end();
        };
        if (std::any_of(found.begin(), found.end(), is_known))
            std::erase_if(found, [&](const auto& item) { return !is_known(item); });
        if (!found.empty()) functions.clear();
        for (const auto& [function, of] : found) add(functions, function), add(labels, of);
    }

    /// "x = 0, y' = 1": of the variables in these functions.
    std::string place(const std::vector<int>& nodes) const {
        std::vector<std::string> result;
        for (const int id : r_.program.needed(nodes)) {
            const Variable& v = r_.program[id].variable;
            if (r_.program[id].op != Op::variable) continue;
            const auto i = static_cast<std::size_t>(v.index);
            if (v.kind == Variable::Kind::coordinate)
                result.push_back(fmt::format("{} = {}", m_.q[i].get_name(), number(at_.q[i])));
            if (v.kind == Variable::Kind::rate)
                result.push_back(fmt::format("{} = {}", speed(v.index), number(at_.u[i])));
            if (v.kind == Variable::Kind::unknown)
                result.push_back(fmt::format("{} = {}", input(v.index), number(point_[id].at(0).value)));
        }
        return result.empty() ? say("this state") : fmt::format("{}", fmt::join(result, ", "));
    }

    std::string speed(int i) const { return e_.u[i].get_name(); }
    std::string input(int k) const {
        return m_.inputs[k / 3].derivative[0].get_name() + std::string(static_cast<std::size_t>(k % 3), '\'');
    }

    const Residuals& r_;
    const Instant<long double>& at_;
    const std::vector<PuiseuxSeries>& point_;
    const Mechanism& m_;
    const Equations& e_;
};

}  // namespace

std::string no_derivative(const KinkPlace& place, const std::vector<int>& nodes, const std::string& fault) {
    return Message(place).about(nodes, fault);
}

}  // namespace alembert
