// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/head.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "codegen/emit/comment.hpp"
#include "codegen/emit/dialect.hpp"
#include "codegen/emit/interface.hpp"
#include "codegen/emit/layout.hpp"
#include "codegen/emit/numbers.hpp"
#include "codegen/emit/solver_functions.hpp"

namespace alembert {

namespace {

using Items = std::vector<std::string>;

constexpr std::size_t name_width = 16;

std::string with_unit(const std::string& text, const std::string& unit) {
    const std::string shown = comment_text(unit);
    return shown.empty() ? text : fmt::format("{} [{}]", text, shown);
}

class Head {
public:
    Head(const Program& p, const Vocabulary& words, const EmitOptions& options, bool is_header)
        : p_(p),
          words_(words),
          options_(options),
          is_header_(is_header),
          scene_(ascii_identifier(p.name)),
          n_(words.q().size()),
          s_(words.u().size()),
          inputs_(static_cast<std::size_t>(words.inputs_from_outside())),
          parameters_(words.par().size()),
          length_(parameters_ + words.constants().size()) {}

    Items lines() {
        lines_ = {
            "SPDX-License-Identifier: MIT",
            fmt::format("Equations of motion of '{}': {}.", scene_, comment_text(p_.formulation)),
            fmt::format("Written by alembert {} from a scene; may be used, changed and passed on freely (MIT).",
                        ALEMBERT_VERSION)};
        if (!options_.command.empty()) lines_.push_back("  " + comment_text(options_.command));
        lines_.emplace_back();
        equation();
        lines_.emplace_back();
        arguments();
        results();
        const Operations cost = p_.count(p_.right_hand_side());
        entry("cost",
              {fmt::format("{} a right-hand side: {}, {}, {}, {}", counted(cost.total(), "operation"),
                           counted(cost.additions, "addition"), counted(cost.multiplications, "multiplication"),
                           counted(cost.divisions, "division"), counted(cost.functions, "function"))});
        if (dialect_of(options_.language).is_shaped()) return lines_;  // the template has the example
        lines_.insert(lines_.end(), {"", example_title(), ""});
        switch (options_.language) {
            case CodeLanguage::cpp:
                if (is_header_)
                    example_of_header();
                else
                    example_in_cpp();
                break;
            case CodeLanguage::c:
                example_in_c();
                break;
            default:
                example_in_javascript();
        }
        return lines_;
    }

private:
    std::size_t count(Group group) const { return p_.nodes_of(group).size(); }

    /// "  name    a, b," and further lines below the first item.
    void entry(const std::string& name, const Items& items) {
        std::string line = fmt::format("  {:<{}}", name, name_width);
        bool is_fresh = true;
        if (line.size() > name_width + 2) line += "  ";
        for (std::size_t k = 0; k < items.size(); ++k) {
            const std::string item = items[k] + (k + 1 < items.size() ? "," : "");
            if (!is_fresh && line.size() + item.size() + 1 > line_width) {
                lines_.push_back(line);
                line = std::string(name_width + 2, ' ');
                is_fresh = true;
            }
            line += (is_fresh ? "" : " ") + item;
            is_fresh = false;
        }
        lines_.push_back(line);
    }

    Items with_units(const Items& names, const std::vector<Quantity>& quantities) const {
        Items items;
        for (std::size_t k = 0; k < names.size(); ++k)
            items.push_back(with_unit(label_of(names[k]), quantities[k].unit));
        return items;
    }

    void equation() {
        const bool own_speeds = !p_.speeds.empty();
        std::string text = own_speeds ? "M(q) u' = f(q, u, t), q' = h(q, u, t)" : "M(q) q'' = f(q, q', t)";
        if (count(Group::gamma) > 0)
            text += own_speeds ? " + A^T lambda with A u' = gamma" : " + A^T lambda with A q'' = gamma";
        lines_.push_back(text + ".");
        const std::vector<std::string>& notes = dialect_of(options_.language).notes;
        if (!notes.empty()) {
            lines_.insert(lines_.end(), notes.begin(), notes.end());
        } else if (options_.language == CodeLanguage::javascript) {
            lines_.insert(lines_.end(),
                          {"A module of JavaScript (ECMAScript 2015) that imports nothing and keeps no state.",
                           "All arguments but t are arrays, at best of type Float64Array."});
        } else if (options_.language == CodeLanguage::c) {
            lines_.insert(lines_.end(), {"C99; nothing is allocated, no function keeps state, and the library of "
                                         "mathematics is all that is needed.",
                                         "With -DALEMBERT_REAL=float all numbers are floats."});
        } else if (is_header_) {
            lines_.insert(lines_.end(),
                          {fmt::format("Declares what {}.cpp has, for C++17 and later.", scene_),
                           "Any number of systems can be in one program, and no function keeps state."});
        } else {
            lines_.insert(lines_.end(), {"This file includes nothing and allocates nothing. Real is "
                                         "double, or another type of numbers with the functions used."});
        }
    }

    void arguments() {
        if (!options_.left_out.empty()) {
            Items items = options_.left_out;
            items.back() += "; between them this is the motion";
            entry("left out", items);
        }
        entry("t", {"the time [s]"});
        Items state = with_units(words_.q(), p_.coordinates);
        if (p_.speeds.empty()) {
            state.back() += ", then their rates";
        } else {
            Items speeds = with_units(words_.u(), p_.speeds);
            speeds.front() = "then " + speeds.front();
            state.insert(state.end(), speeds.begin(), speeds.end());
        }
        entry(fmt::format("state[{}]", n_ + s_), state);
        entry(fmt::format("rate[{}]", n_ + s_), {"d state / dt"});
        Items par, inputs;
        for (std::size_t k = 0; k < parameters_; ++k)
            (words_.is_from_outside(k) ? inputs : par)
                .push_back(
                    with_unit(fmt::format("{} = {}", label_of(words_.par()[k]), shortest(p_.parameters[k].value)),
                              p_.parameters[k].unit));
        if (inputs_ > 0) par.push_back("then " + counted(static_cast<long>(inputs_), "unread number"));
        if (length_ > parameters_) {
            const std::string made = fmt::format("{}{} that prepare computes from them; call it after each change",
                                                 par.empty() ? "" : "then ",
                                                 counted(static_cast<long>(length_ - parameters_), "number"));
            par.push_back(made);
        }
        if (par.empty()) par.emplace_back("nothing is read");
        entry(fmt::format("par[{}]", length_), par);
        if (inputs_ == 0) return;
        inputs.back() += "; given from outside, and held during a call";
        entry(fmt::format("inputs[{}]", inputs_), inputs);
    }

    /// The arrays of the other functions.
    void results() {
        const std::size_t constraints = constraints_of(p_);
        const auto of = [&](const char* function, const std::string& arrays) { entry(function, {arrays}); };
        if (count(Group::mass) > 0)
            of("mass_forcing",
               fmt::format(
                   fmt::runtime(p_.has_norm_terms
                                    ? "mass[{}], M + c A^T A row by row; forcing[{}], f + c A^T gamma, with a "
                                      "c for the norm of each quaternion"
                                    : "mass[{}], M row by row; forcing[{}], f"),
                   s_ * s_, s_));
        if (count(Group::kinetic) > 0)
            of("energy",
               "energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]");
        const auto named = [&](const char* function, std::initializer_list<Group> groups) {
            Items names = root_names(p_, groups);
            if (names.empty()) return;
            names.front() = fmt::format("out[{}]: {}", names.size(), names.front());
            entry(function, names);
        };
        named("outputs_at", {Group::output, Group::speed});
        named("events_at", {Group::event});
        if (constraints > 0)
            of("constraints_at", fmt::format("position[{0}], velocity[{0}]; rows[{1}], A row by row", constraints,
                                             constraints * (n_ + (p_.speeds.empty() ? 0 : s_))));
        if (constraints > 0) constraint_rows();
        if (count(Group::multiplier) > 0) {
            Items names = root_names(p_, {Group::multiplier});
            names.front() = fmt::format("lambda[{}]: {}", names.size(), names.front());
            entry("multipliers_at", names);
        }
        if (count(Group::projected) > 0)
            of("project", fmt::format("{}[{}], position[{}], pivots[{}]",
                                      options_.language == CodeLanguage::c ? "moved" : "out",
                                      count(Group::projected), count(Group::position), count(Group::pivot)));
        if (!p_.nodes_of(Group::jacobian).empty())
            of("jacobian", fmt::format("values[{}]", jacobian(p_).rows.size()));
        if (!p_.nodes_of(Group::event_impulse).empty())
            of("impulses_at", fmt::format("out[{}]", count(Group::event_impulse)));
    }

    /// The rows of A by their names.
    void constraint_rows() {
        Items rows;
        for (const Group group : {Group::velocity, Group::redundant_velocity})
            for (const Root& root : p_.roots)
                if (root.group == group)
                    rows.push_back(comment_text(root.name) +
                                   (group == Group::velocity ? "" : " (follows from the others)"));
        entry("rows of A", rows);
    }

    std::string example_title() const {
        const std::string title =
            options_.state.empty() ? "Example: the rates at a state; put your own numbers in place of the zeros."
                                   : "Example: the rates at the scene's initial state.";
        switch (options_.language) {
            case CodeLanguage::c:
                return title + fmt::format(" Compile it with cc -std=c99 -O2 example.c {}.c -lm", scene_);
            case CodeLanguage::javascript:
                return title + " Run it with node example.mjs";
            default:
                break;
        }
        return title + (is_header_ ? fmt::format(" Compile it with c++ -O2 example.cpp {}.cpp", scene_)
                                   : " Compile it with c++ -std=c++20 -O2 example.cpp");
    }

    /// "{0.5, 0}": the inputs from outside as the scene has them.
    std::string input_values() const {
        Items values;
        for (std::size_t k = 0; k < parameters_; ++k)
            if (words_.is_from_outside(k)) values.push_back(shortest(p_.parameters[k].value));
        return fmt::format("{}", fmt::join(values, ", "));
    }

    /// The line `before` + numbers + `after`, broken.
    void numbers(const std::string& before, const std::string& after = "};") {
        Items items;
        for (std::size_t k = 0; k < n_ + s_; ++k)
            items.push_back(options_.state.empty() ? "0" : shortest(options_.state[k]));
        std::string line = before;
        for (std::size_t k = 0; k < items.size(); ++k) {
            const std::string item = items[k] + (k + 1 < items.size() ? "," : after);
            if (line.size() + item.size() > line_width) {
                lines_.push_back(line);
                line = "          ";
            }
            line += (k == 0 || line.back() == ' ' ? "" : " ") + item;
        }
        lines_.push_back(line);
    }

    const char* given() const { return inputs_ > 0 ? "inputs, " : ""; }

    void example_of_header() {
        const std::string space = namespace_of(p_);
        lines_.insert(
            lines_.end(),
            {"  #include <cstdio>", fmt::format("  #include \"{}.hpp\"", scene_), "", "  int main() {",
             options_.state.empty() ? fmt::format("      const {}::State state = {{}};", space)
                                    : fmt::format("      const {0}::State state = {0}::initial_state;", space),
             fmt::format("      const {0}::Parameters par = {0}::defaults();", space),
             fmt::format("      const {0}::State rate = {0}::rhs({1}, state, par{2});", space,
                         options_.state.empty() ? "0" : space + "::initial_time",
                         inputs_ > 0 ? ", " + space + "::Inputs()" : ""),
             fmt::format("      for (int k = 0; k < {0}::state_size; ++k) std::printf(\"%.17g\\n\", "
                         "{0}::numbers(rate)[k]);",
                         space),
             "  }"});
    }

    void example_in_cpp() {
        const std::string space = namespace_of(p_);
        lines_.insert(lines_.end(),
                      {"  #include <cstdio>", fmt::format("  #include \"{}.cpp\"", scene_), "", "  int main() {"});
        numbers(fmt::format("      const double state[{}] = {{", n_ + s_));
        lines_.push_back(fmt::format("      double par[{}]{}, rate[{}];", std::max<std::size_t>(length_, 1),
                                     length_ > 0 ? "" : " = {}", n_ + s_));
        if (parameters_ > 0)
            lines_.push_back(fmt::format("      for (int k = 0; k < {}; ++k) par[k] = {}::parameter_values[k];",
                                         parameters_, space));
        if (length_ > parameters_) lines_.push_back(fmt::format("      {}::prepare(par);", space));
        if (inputs_ > 0)
            lines_.push_back(fmt::format("      const double inputs[{}] = {{{}}};", inputs_, input_values()));
        lines_.insert(
            lines_.end(),
            {fmt::format("      {}::rhs({}, state, par, {}rate);", space, real_literal(options_.t), given()),
             "      for (const double value : rate) std::printf(\"%.17g\\n\", value);", "  }"});
    }

    void example_in_c() {
        lines_.insert(lines_.end(), {"  #include <stdio.h>", fmt::format("  #include \"{}.h\"", scene_), "",
                                     "  int main(void) {"});
        numbers(fmt::format("      const ALEMBERT_REAL state[{}_state] = {{", scene_));
        if (inputs_ > 0)
            lines_.push_back(
                fmt::format("      const ALEMBERT_REAL inputs[{}_inputs] = {{{}}};", scene_, input_values()));
        lines_.insert(
            lines_.end(),
            {fmt::format("      ALEMBERT_REAL par[{0}_par + 1], rate[{0}_state];", scene_),
             fmt::format("      {}_defaults(par);", scene_),
             fmt::format("      {}_rhs({}, state, par, {}rate);", scene_, shortest(options_.t), given()),
             fmt::format("      for (int k = 0; k < {}_state; ++k) printf(\"%.17g\\n\", (double)rate[k]);",
                         scene_),
             "      return 0;", "  }"});
    }

    void example_in_javascript() {
        lines_.push_back(fmt::format("  import * as scene from \"./{}.mjs\";", scene_));
        numbers("  const state = [", "];");
        lines_.insert(lines_.end(),
                      {fmt::format("  const par = scene.defaults(), rate = new Float64Array({});", n_ + s_),
                       fmt::format("  scene.rhs({}, state, par, {}rate);", shortest(options_.t),
                                   inputs_ > 0 ? "scene.input_values, " : ""),
                       "  for (const value of rate) console.log(value);"});
    }

    /// rhs deduces the type of numbers from its arguments.
    static std::string real_literal(double x) {
        const std::string text = shortest(x);
        return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
    }

    const Program& p_;
    const Vocabulary& words_;
    const EmitOptions& options_;
    bool is_header_;
    std::string scene_;
    std::size_t n_, s_, inputs_, parameters_, length_;
    Items lines_;
};

}  // namespace

std::vector<std::string> head_of(const Program& program, const Vocabulary& words, const EmitOptions& options) {
    return Head(program, words, options, false).lines();
}

std::vector<std::string> header_head_of(const Program& program, const Vocabulary& words,
                                        const EmitOptions& options) {
    return Head(program, words, options, true).lines();
}

}  // namespace alembert
