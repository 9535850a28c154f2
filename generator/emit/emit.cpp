// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/emit.hpp"

#include <fmt/format.h>

#include <kainjow/mustache.hpp>
#include <set>

#include "alembert/abi.hpp"
#include "alembert/error.hpp"
#include "emit/parts.hpp"
#include "emit/templates.hpp"
#include "emit/writer.hpp"

namespace alembert {

namespace {

namespace mustache = kainjow::mustache;

constexpr std::size_t line_width = 110;
constexpr std::size_t part_length = 400;  // statements
constexpr int most_for_packs = 1000;  // operations of M and f; beyond, packs go lane by lane: nobody steps by these, and compiling takes a second

/// Long statements go on below, indented; a break only comes before an operator at its blanks.
std::string wrapped(const std::string& line) {
    std::string result;
    std::size_t start = 0;
    while (line.size() - start > line_width) {
        std::size_t cut = std::string::npos;
        for (std::size_t at = line.find(' ', start); at != std::string::npos && at - start < line_width;
             at = line.find(' ', at + 1))
            if (at + 1 < line.size() && (std::string("+-*/").find(line[at + 1]) != std::string::npos ||
                                         line[at - 1] == ','))
                cut = at;
        if (cut == std::string::npos) break;
        result += line.substr(start, cut - start) + "\n        ";
        start = cut + 1;
    }
    return result + line.substr(start);
}

class Emitter {
public:
    Emitter(const Program& program, const EmitOptions& options)
        : p_(program),
          options_(options),
          n_(static_cast<int>(program.coordinates.size())),
          s_(program.speeds.empty() ? n_ : static_cast<int>(program.speeds.size())) {
        for (const Quantity& q : p_.coordinates) {
            q_.push_back(names_.fresh(q.name));
            if (!p_.speeds.empty()) continue;
            u_.push_back(names_.fresh(q_.back() + "_dot"));
            a_.push_back(names_.fresh(q_.back() + "_ddot"));
        }
        for (const Quantity& u : p_.speeds) {
            const std::string q = u.rate_of < 0 ? "" : p_.coordinates[static_cast<std::size_t>(u.rate_of)].name;
            u_.push_back(names_.fresh(q.empty() ? u.name : q + "_dot"));
            a_.push_back(names_.fresh(q.empty() ? u_.back() + "_dot" : q + "_ddot"));
        }
        for (const Quantity& par : p_.parameters) par_.push_back(names_.fresh(par.name));
        find_constants();
    }

    Source emit() {
        const std::vector<int> rhs = p_.right_hand_side();
        const Operations cost = p_.count(rhs);
        mustache::data functions{mustache::data::type::list};
        mustache::data file;
        functions << prepare();
        add(functions, right_hand_side());
        const bool has_matrix = !p_.nodes_of(Group::mass).empty();
        if (has_matrix) add(functions, mass_forcing());
        file.set("has_matrix", has_matrix);
        for (const std::vector<mustache::data>& one : {energy(), list(Group::output), list(Group::event), constraints(), multipliers()}) add(functions, one);
        add_projection(functions, file);
        add_derivatives(functions, file);
        file.set("scene", ascii_identifier(p_.name));
        file.set("formulation", p_.formulation);
        file.set("version", ALEMBERT_VERSION);
        const bool own_speeds = !p_.speeds.empty();
        file.set("state", described(q_, p_.coordinates) + (own_speeds ? ", then " + described(u_, p_.speeds) : ", then their rates"));
        file.set("equation", own_speeds ? "M(q) u' = f(q, u, t), q' = h(q, u, t)" : "M(q) q'' = f(q, q', t)");
        file.set("has_speeds", own_speeds);
        file.set("speed_names", quoted(u_));
        file.set("parameters", par_.empty() ? "none" : described(par_, p_.parameters));
        file.set("operations", fmt::format("{} operations a right-hand side: {} additions, {} multiplications, {} "
                                           "divisions, {} functions",
                                           cost.total(), cost.additions, cost.multiplications, cost.divisions,
                                           cost.functions));
        file.set("functions", functions);
        file.set("trigonometric", has_trigonometry());
        file.set("batch", options_.batch);
        const bool one_by_one = p_.count(joined(p_.nodes_of(Group::mass), p_.nodes_of(Group::forcing))).total() > most_for_packs;
        file.set("one_by_one", one_by_one);
        file.set("together", has_matrix && !one_by_one);
        file.set("coordinate_names", quoted(q_));
        file.set("parameter_names", quoted(par_));
        file.set("output_names", quoted(joined(labels(Group::output), labels(Group::speed))));
        file.set("event_names", quoted(labels(Group::event)));
        std::string values;
        for (const Quantity& par : p_.parameters) values += shortest(par.value) + ", ";
        file.set("parameter_values", values);
        const auto number = [&](const char* key, std::size_t value) { file.set(key, std::to_string(value)); };
        number("abi", abi_version);
        number("n", q_.size());
        number("s", static_cast<std::size_t>(s_));
        number("p", par_.size());
        number("k", constants_.size());
        number("outputs", p_.nodes_of(Group::output).size() + p_.nodes_of(Group::speed).size());
        number("events", p_.nodes_of(Group::event).size());
        number("constraints", p_.nodes_of(Group::velocity).size());
        file.set("reaction", p_.nodes_of(Group::gamma).empty() ? ""
                             : own_speeds                 ? " + A^T lambda with A u' = gamma"
                                                          : " + A^T lambda with A q'' = gamma");
        std::string elementary = mustache::mustache{std::string(template_elementary)}.render(file);
        elementary.pop_back();  // the line's end is the template's
        file.set("elementary", elementary);
        mustache::mustache shape{std::string(template_solver)};
        return {.file = ascii_identifier(p_.name) + ".cpp",
                .text = shape.render(file),
                .operations = cost,
                .formulation = p_.formulation};
    }

private:
    bool has_trigonometry() const {
        for (int id = 0; id < p_.size(); ++id)
            if (p_[id].op == Op::sin || p_[id].op == Op::cos) return true;
        return false;
    }

    /// Everything that depends on parameters alone and is wanted by something that does not.
    void find_constants() {
        std::vector<int> wanted;
        for (const Root& root : p_.roots) wanted.push_back(root.node);
        std::set<int> found;
        const auto consider = [&](int id) {
            const Node& node = p_[id];
            if (!node.is_constant() || node.args.empty()) return;
            const bool negation = node.is_scaled() && cln::equal(node.coefficients[0], -1);
            const int kept = negation ? node.args[0] : id;
            if (!p_[kept].args.empty()) found.insert(kept);  // −p is read from p, which stands in `par` already
        };
        for (const int id : p_.needed(wanted))
            if (!p_[id].is_constant())
                for (const int arg : p_[id].args) consider(arg);
        for (const Root& root : p_.roots) {
            consider(root.node);
            if (found.contains(root.node) && (root.group == Group::mass || root.group == Group::forcing))
                constant_names_.emplace(root.node, root.name);
        }
        constants_.assign(found.begin(), found.end());
        for (const int id : constants_) {
            std::string& name = constant_names_[id];
            name = name.empty() ? names_.numbered("k") : names_.fresh(name);
        }
    }

    std::map<int, std::string> variables() const {
        std::map<int, std::string> leaves;
        for (int id = 0; id < p_.size(); ++id) {
            const Node& node = p_[id];
            if (node.op != Op::variable) continue;
            const auto i = static_cast<std::size_t>(node.variable.index);
            switch (node.variable.kind) {
                case Variable::Kind::parameter: leaves[id] = par_[i]; break;
                case Variable::Kind::time: leaves[id] = "t"; break;
                case Variable::Kind::coordinate: leaves[id] = q_[i]; break;
                case Variable::Kind::rate: leaves[id] = u_[i]; break;
                case Variable::Kind::acceleration: leaves[id] = a_[i]; break;
                case Variable::Kind::unknown: break;
            }
        }
        return leaves;
    }

    struct Input {
        std::string name, place;  ///< "q1", "state[0]"
        int kind;                 ///< kinds are declared apart
    };

    /// Those variables and constants that the function uses.
    std::vector<Input> inputs(const std::map<int, int>& uses, bool rates_needed) const {
        std::vector<Input> items;
        std::vector<char> q(n_, 0), u(s_, rates_needed ? 1 : 0), a(s_, 0), par(par_.size(), 0);
        for (const auto& [id, count] : uses) {
            const Node& node = p_[id];
            if (node.op != Op::variable || constant_names_.contains(id)) continue;
            const auto i = static_cast<std::size_t>(node.variable.index);
            switch (node.variable.kind) {
                case Variable::Kind::parameter: par[i] = 1; break;
                case Variable::Kind::coordinate: q[i] = 1; break;
                case Variable::Kind::rate: u[i] = 1; break;
                case Variable::Kind::acceleration: a[i] = 1; break;
                case Variable::Kind::unknown: break;
                default: break;
            }
        }
        for (int i = 0; i < n_; ++i)
            if (q[i] != 0) items.push_back({q_[i], fmt::format("state[{}]", i), 0});
        for (int i = 0; i < s_; ++i)
            if (u[i] != 0) items.push_back({u_[i], fmt::format("state[{}]", n_ + i), 0});
        for (int i = 0; i < s_; ++i)
            if (a[i] != 0) items.push_back({a_[i], fmt::format("rate[{}]", n_ + i), 1});
        for (std::size_t i = 0; i < par.size(); ++i)
            if (par[i] != 0) items.push_back({par_[i], fmt::format("par[{}]", i), 2});
        for (std::size_t k = 0; k < constants_.size(); ++k)
            if (uses.contains(constants_[k])) items.push_back({constant_names_.at(constants_[k]), fmt::format("par[{}]", par_.size() + k), 2});
        return items;
    }

    /// Declared as `const Real`.
    static mustache::data unpacked(const std::vector<Input>& items) {
        mustache::data lines{mustache::data::type::list};
        std::string line;
        for (std::size_t k = 0; k < items.size(); ++k) {
            const std::string item = fmt::format("{} = {}", items[k].name, items[k].place);
            if (!line.empty() && (items[k].kind != items[k - 1].kind || line.size() + item.size() > line_width - 15)) {
                lines << line;
                line.clear();
            }
            line += (line.empty() ? "&" : ", &") + item;
        }
        if (!line.empty()) lines << line;
        return lines;
    }

    struct Result {
        std::string to;  // "rate[0]"
        int node;
    };

    static void add(mustache::data& list, const std::vector<mustache::data>& functions) {
        for (const mustache::data& function : functions) list << function;
    }

    /// Where it is long, its parts before it.
    std::vector<mustache::data> function(const char* name, const char* about, const char* arguments, const std::vector<Goal>& goals,
                                         const std::vector<Result>& results, const std::vector<std::string>& first = {}) {
        std::map<int, std::string> leaves = variables();
        for (const int id : constants_) leaves[id] = constant_names_.at(id);
        Writer writer(p_, names_, std::move(leaves), options_.batch);
        std::vector<Passage> sections = writer.write(goals);
        Passage last{"Result", first};
        for (const Result& result : results) last.lines.push_back(result.to + " = " + writer.value(result.node) + ";");
        sections.push_back(std::move(last));
        const std::vector<Input> items = inputs(writer.uses(), !first.empty());
        std::size_t count = 0;
        for (const Passage& section : sections) count += section.lines.size();
        if (count <= options_.longest_function) return {assembled(name, about, arguments, unpacked(items), sections)};
        return in_pieces(name, about, arguments, items, sections, options_.longest_function);
    }

    static std::vector<mustache::data> in_pieces(const std::string& name, const char* about, const std::string& arguments,
                                                 const std::vector<Input>& items, const std::vector<Passage>& sections, std::size_t longest) {
        std::vector<std::string> statements;
        for (const Passage& section : sections) statements.insert(statements.end(), section.lines.begin(), section.lines.end());
        const FunctionParts parts = in_parts(statements, std::min(part_length, longest));
        std::string given;  // the arguments' names
        for (std::size_t end = 0; end != std::string::npos; ) {
            end = arguments.find(',', end + 1);
            const std::size_t stop = end == std::string::npos ? arguments.size() : end;
            const std::size_t space = arguments.rfind(' ', stop - 1);
            given += arguments.substr(space + 1, stop - space - 1) + ", ";
        }
        std::vector<mustache::data> result;
        Passage calls{"Parts", {fmt::format("Real carried[{}];", std::max(parts.carried, 1))}};
        for (const FunctionPart& part : parts.list) {
            std::vector<Input> used;
            for (const Input& item : items)
                if (part.names.contains(item.name)) used.push_back(item);
            const std::string own = fmt::format("{}_{}", name, result.size());
            result.push_back(assembled(own, "A part.", arguments + ", [[maybe_unused]] Real* carried", unpacked(used), {{"Part", part.lines}}));
            result.back().set("is_part", true);
            calls.lines.push_back(fmt::format("{}({}carried);", own, given));
        }
        result.push_back(assembled(name, about, arguments, mustache::data{mustache::data::type::list}, {calls}));
        return result;
    }

    static mustache::data assembled(const std::string& name, const char* about, const std::string& arguments,
                                    const mustache::data& unpack, const std::vector<Passage>& sections) {
        mustache::data list{mustache::data::type::list};
        for (const Passage& section : sections) {
            if (section.lines.empty()) continue;
            mustache::data lines{mustache::data::type::list};
            for (const std::string& line : section.lines) lines << wrapped(line);
            mustache::data one;
            one.set("title", section.title);
            one.set("lines", lines);
            list << one;
        }
        mustache::data result;
        result.set("name", name);
        result.set("is_part", false);
        result.set("about", about);
        result.set("arguments", arguments);
        result.set("unpack", unpack);
        result.set("sections", list);
        return result;
    }

    mustache::data prepare() {
        Writer writer(p_, names_, variables());
        std::vector<Goal> goals;
        for (const int id : constants_) goals.push_back({"Constants", constant_names_.at(id), id, true});
        std::vector<Passage> sections = writer.write(goals);
        Passage last{"Result", {}};
        for (std::size_t k = 0; k < constants_.size(); ++k)
            last.lines.push_back(fmt::format("par[{}] = {};", par_.size() + k, writer.value(constants_[k])));
        sections.push_back(std::move(last));
        mustache::data lines{mustache::data::type::list};
        std::map<int, int> uses;
        for (const auto& [id, count] : writer.uses())
            if (p_[id].op == Op::variable) uses[id] = count;
        return assembled("prepare", "What depends on parameters alone, after the parameters.",
                         constants_.empty() ? "Real*" : "Real* par", unpacked(inputs(uses, false)), sections);
    }

    std::vector<Goal> goals(Group group, const std::string& section) const {
        std::vector<Goal> result;
        for (const Root& root : p_.roots)
            if (root.group == group) result.push_back({section, root.name, root.node});
        return result;
    }

    template <typename Item>
    static std::vector<Item> joined(std::vector<Item> a, const std::vector<Item>& b) {
        a.insert(a.end(), b.begin(), b.end());
        return a;
    }

    std::vector<mustache::data> right_hand_side() {
        const bool is_free = p_.nodes_of(Group::gamma).empty(), own_speeds = !p_.speeds.empty();
        const std::string unknown = own_speeds ? "u'" : "q''", rows = fmt::format("Constraints A {} = gamma", unknown);
        std::vector<Goal> all = goals(Group::rate, "Kinematics q' = h(q, u, t)");
        std::vector<Result> results;
        for (int i = 0; const Goal& goal : all) results.push_back({fmt::format("rate[{}]", i++), goal.node});
        for (Goal& goal : all) goal.name = ascii_identifier(goal.name) + "_dot";
        all = joined(all, joined(goals(Group::mass, "Mass matrix M(q), lower triangle"), goals(Group::forcing, "Forcing f")));
        if (!is_free) {
            std::vector<Goal> entries = goals(own_speeds ? Group::speed_row : Group::row, rows);
            if (own_speeds) std::erase_if(entries, [&](const Goal& goal) { return p_.is_zero(goal.node); });
            all = joined(all, joined(entries, goals(Group::gamma, rows)));
        }
        const std::string solve = is_free ? fmt::format("Solve M {} = f with M = L D L^T", unknown)
                                          : fmt::format("Solve M {0} = f + A^T lambda, A {0} = gamma", unknown);
        all = joined(all, goals(Group::acceleration, solve));
        // Recursions make accelerations without M and f.
        const std::vector<int> rhs = p_.right_hand_side(), list = p_.needed(rhs);
        const std::set<int> needed(list.begin(), list.end());
        std::erase_if(all, [&](const Goal& goal) { return !needed.contains(goal.node); });
        std::vector<std::string> first;
        for (int i = 0; i < n_ && !own_speeds; ++i) first.push_back(fmt::format("rate[{}] = {};", i, u_[i]));
        int i = 0;
        for (Goal& goal : all)
            if (goal.section == solve) {
                goal.name = a_[i];
                goal.own_name = true;
                results.push_back({fmt::format("rate[{}]", n_ + i++), goal.node});
            }
        return function("rhs", own_speeds ? "rate = (q', u') at t and state = (q, u)." : "rate = (q', q'') at t and state = (q, q').",
                        "[[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate",
                        all, results, first);
    }

    std::vector<mustache::data> mass_forcing() {
        const std::vector<Goal> mass = goals(Group::mass, "Mass matrix M(q), lower triangle"), f = goals(Group::forcing, "Forcing f");
        std::vector<Result> results;
        std::size_t k = 0;
        for (int i = 0; i < s_; ++i)
            for (int j = 0; j <= i; ++j, ++k) {
                const std::string mirror = i == j ? "" : fmt::format("mass[{}] = ", j * s_ + i);
                results.push_back({fmt::format("{}mass[{}]", mirror, i * s_ + j), mass[k].node});
            }
        for (int i = 0; i < s_; ++i) results.push_back({fmt::format("forcing[{}]", i), f[i].node});
        return function("mass_forcing", p_.speeds.empty() ? "M (n by n, row-major) and f of M q'' = f." : "M (s by s, row-major) and f of M u' = f.",
                        "[[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const "
                        "Real* par, Real* mass, Real* forcing",
                        joined(mass, f), results);
    }

    std::vector<mustache::data> energy() {
        std::vector<Goal> all;
        std::vector<Result> results;
        for (const Group group : {Group::kinetic, Group::potential, Group::energy, Group::power, Group::jacobi})
            all = joined(all, goals(group, "Energy"));
        for (std::size_t i = 0; i < all.size(); ++i)
            results.push_back({i < 4 ? fmt::format("energy[{}]", i) : "jacobi[0]", all[i].node});
        return function("energy", "T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.",
                        "[[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const "
                        "Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi",
                        all, results);
    }

    std::vector<mustache::data> constraints() {
        const std::vector<int> position = p_.nodes_of(Group::position), velocity = p_.nodes_of(Group::velocity);
        std::vector<Result> results;
        for (std::size_t k = 0; k < position.size(); ++k) results.push_back({fmt::format("position[{}]", k), position[k]});
        for (std::size_t k = 0; k < velocity.size(); ++k) results.push_back({fmt::format("velocity[{}]", k), velocity[k]});
        for (std::size_t k = 0; const int node : p_.nodes_of(Group::row))
            results.push_back({fmt::format("rows[{}]", k++), node});
        for (std::size_t k = p_.nodes_of(Group::row).size(); const int node : p_.nodes_of(Group::speed_row))
            results.push_back({fmt::format("rows[{}]", k++), node});
        std::vector<Goal> all;
        for (const Result& result : results) all.push_back({"Constraints", "", result.node});
        return function("constraints_at", "f(q,t) of holonomic constraints, A q' + b of all, and A.",
                        "[[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, "
                        "[[maybe_unused]] Real* position, [[maybe_unused]] Real* velocity, [[maybe_unused]] Real* rows",
                        all, results);
    }

    std::vector<mustache::data> multipliers() {
        const std::vector<Goal> all = goals(Group::multiplier, "Multipliers");
        std::vector<Result> results;
        for (std::size_t i = 0; i < all.size(); ++i) results.push_back({fmt::format("lambda[{}]", i), all[i].node});
        return function("multipliers_at", "The multipliers lambda of M q'' = f + A^T lambda.",
                        "[[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, "
                        "[[maybe_unused]] Real* lambda",
                        all, results);
    }

    void add_projection(mustache::data& functions, mustache::data& file) {
        const std::vector<int> position = p_.nodes_of(Group::position), pivots = p_.nodes_of(Group::pivot), moved = p_.nodes_of(Group::projected);
        const std::vector<Goal> gamma = goals(Group::gamma, "Constraints");
        const bool is_needed = !gamma.empty() || std::any_of(position.begin(), position.end(), [&](int node) { return !p_.is_zero(node); });
        file.set("has_projection", !position.empty() && is_needed == !moved.empty());
        file.set("moves", !moved.empty());
        file.set("has_gamma", !gamma.empty());
        if (moved.empty()) return;
        std::vector<Goal> all;
        std::vector<Result> results, right;
        for (std::size_t i = 0; i < moved.size(); ++i) results.push_back({fmt::format("out[{}]", i), moved[i]});
        for (std::size_t k = 0; k < position.size(); ++k) results.push_back({fmt::format("position[{}]", k), position[k]});
        for (std::size_t k = 0; k < pivots.size(); ++k) results.push_back({fmt::format("pivots[{}]", k), pivots[k]});
        for (const Result& result : results) all.push_back({"Projection", "", result.node});
        add(functions, function("project", "One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.",
                                "[[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* out, "
                                "Real* position, [[maybe_unused]] Real* pivots",
                                all, results));
        if (gamma.empty()) return;
        const std::vector<int> kept = p_.kept_constraints();
        for (std::size_t k = 0; k < gamma.size(); ++k) right.push_back({fmt::format("out[{}]", kept[k]), gamma[k].node});
        add(functions, function("gamma_at", p_.speeds.empty() ? "gamma of A q'' = gamma." : "gamma of A u' = gamma.",
                                "[[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, "
                                "Real* out",
                                gamma, right));
    }

    /// Of the entries that are not zero: rows and columns as text, and where each goes.
    struct Pattern {
        std::string rows, columns;
        std::vector<Result> results;
    };

    void add_entries(Pattern& pattern, Group group, int row, std::size_t columns) const {
        const std::vector<int> nodes = p_.nodes_of(group);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            if (p_.is_zero(nodes[k])) continue;
            pattern.rows += fmt::format("{}, ", row + static_cast<int>(k / columns));
            pattern.columns += fmt::format("{}, ", k % columns);
            pattern.results.push_back({fmt::format("values[{}]", pattern.results.size()), nodes[k]});
        }
    }

    std::vector<mustache::data> derivative(const char* name, const char* about, const Pattern& pattern) {
        std::vector<Goal> all;
        for (const Result& result : pattern.results) all.push_back({"Derivatives", "", result.node});
        return function(name, about,
                        "[[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, "
                        "[[maybe_unused]] Real* values",
                        all, pattern.results);
    }

    void add_derivatives(mustache::data& functions, mustache::data& file) {
        const std::vector<int> nodes = p_.nodes_of(Group::jacobian);
        file.set("has_derivatives", !nodes.empty());
        if (nodes.empty()) return;
        Pattern state, parameters;
        add_entries(state, Group::jacobian, 0, static_cast<std::size_t>(n_ + s_));
        add_entries(state, Group::power_gradient, n_ + s_, static_cast<std::size_t>(n_ + s_));
        if (!par_.empty()) add_entries(parameters, Group::parameter_jacobian, 0, par_.size());
        const bool by_parameters = !p_.nodes_of(Group::parameter_jacobian).empty();
        add(functions, derivative("jacobian", "d rate / d state where it is not zero at every state; row n + s: of the power.", state));
        if (by_parameters)
            add(functions, derivative("parameter_jacobian", "d rate / d parameter where it is not zero at every state.", parameters));
        file.set("has_parameter_derivatives", by_parameters);
        file.set("rows", wrapped_list(state.rows));
        file.set("columns", wrapped_list(state.columns));
        file.set("parameter_rows", wrapped_list(parameters.rows));
        file.set("parameter_columns", wrapped_list(parameters.columns));
        file.set("entries", std::to_string(state.results.size()));
        file.set("parameter_entries", std::to_string(parameters.results.size()));
        file.set("derivative_operations", std::to_string(p_.count(nodes).total()));
    }

    static std::string wrapped_list(const std::string& list) {
        std::string result;
        for (std::size_t start = 0; start < list.size();) {
            std::size_t end = std::min(list.size(), start + line_width);
            if (end < list.size()) end = list.rfind(' ', end) + 1;
            result += (start == 0 ? "" : "\n    ") + list.substr(start, end - start);
            start = end;
        }
        return result;
    }

    std::vector<mustache::data> list(Group group) {
        std::vector<Goal> all = goals(group, group == Group::output ? "Outputs" : "Event functions");
        if (group == Group::output) all = joined(all, goals(Group::speed, "Generalized speeds"));
        std::vector<Result> results;
        for (std::size_t i = 0; i < all.size(); ++i) results.push_back({fmt::format("out[{}]", i), all[i].node});
        return function(group == Group::output ? "outputs_at" : "events_at",
                        group == Group::output ? "The scene's outputs." : "The scene's event functions.",
                        "[[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const "
                        "Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out",
                        all, results);
    }

    std::vector<std::string> labels(Group group) const {
        std::vector<std::string> result;
        for (const Root& root : p_.roots)
            if (root.group == group) result.push_back(ascii_identifier(root.name));
        return result;
    }

    static std::string quoted(const std::vector<std::string>& names) {
        std::string result;
        for (const std::string& name : names) result += fmt::format("\"{}\", ", name);
        return result;
    }

    static std::string described(const std::vector<std::string>& names, const std::vector<Quantity>& quantities) {
        std::string result, line;
        for (std::size_t i = 0; i < names.size(); ++i) {
            std::string unit;
            for (const char c : quantities[i].unit)
                if (std::string_view("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789*/^-. ").find(c) !=
                    std::string_view::npos)
                    unit += c;
            const std::string item = names[i] + (unit.empty() ? "" : " [" + unit + "]");
            if (line.size() + item.size() > line_width - 20) {
                result += line + ",\n//          ";
                line.clear();
            }
            line += (line.empty() ? "" : ", ") + item;
        }
        return result + line;
    }

    const Program& p_;
    EmitOptions options_;
    int n_, s_;
    Names names_;
    std::vector<std::string> q_, u_, a_, par_;
    std::vector<int> constants_;                  // nodes, in order
    std::map<int, std::string> constant_names_;   // of them
};

}  // namespace

Source emit(const Program& program, const EmitOptions& options) {
    if (program.singular)
        throw ModelError("the mass matrix is singular at every state: there are no accelerations to emit");
    return Emitter(program, options).emit();
}

}  // namespace alembert
