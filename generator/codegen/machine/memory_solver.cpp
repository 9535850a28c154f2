// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/memory_solver.hpp"

#include "alembert/base/error.hpp"
#include "alembert/batch/packs.hpp"
#include "codegen/emit/solver_functions.hpp"
#include "codegen/machine/memory_code.hpp"

namespace alembert {

namespace {

using namespace machine;

/// Names as a table lists them.
class NameList {
public:
    explicit NameList(std::vector<std::string> names) : names_(std::move(names)) {
        for (const std::string& name : names_) list_.push_back(name.c_str());
        list_.push_back(nullptr);
    }
    NameList(const NameList&) = delete;
    NameList& operator=(const NameList&) = delete;
    const char* const* list() const { return list_.data(); }

private:
    std::vector<std::string> names_;
    std::vector<const char*> list_;
};

/// All that the tables point to.
struct Tables {
    explicit Tables(const Program& p, const Vocabulary& words)
        : scene(ascii_identifier(p.name)),
          formulation(p.formulation),
          coordinates(labels_of(words.q())),
          speeds(labels_of(words.u())),
          parameters(labels_of(words.par())),
          outputs(root_names(p, {Group::output, Group::speed})),
          events(root_names(p, {Group::event})),
          tables(p.tables) {
        for (const Quantity& parameter : p.parameters) values.push_back(parameter.value);
    }

    std::string scene, formulation;
    NameList coordinates, speeds, parameters, outputs, events;
    std::vector<double> values;
    std::vector<std::shared_ptr<const TabulatedFunction>> tables;  ///< to which the code has pointers
    std::shared_ptr<const void> code;
    std::vector<int> rows, columns, parameter_rows, parameter_columns;
    alembert_solver_table solver{};
    alembert_derivative_table derivatives{};
    alembert_projection_table projection{};
    std::shared_ptr<const alembert_pack_table> packs;
    std::optional<Module> compiled;
};

class Building {
public:
    Building(const Program& program, int lanes, int registers)
        : p_(program),
          words_(program),
          ready_(program, roots_of(program)),
          lanes_(lanes),
          code_(lanes, registers) {}

    std::optional<MemorySolver> solver(std::shared_ptr<const alembert_pack_table> packs) {
        const auto tables = std::make_shared<Tables>(p_, words_);
        alembert_solver_table& s = tables->solver;
        describe(*tables);
        tables->packs = std::move(packs);
        s.prepare = [](double*) {};
        s.energy = [](double, const double*, const double*, const double*, double*, double*) {};
        s.outputs_at = s.events_at = [](double, const double*, const double*, const double*, double*) {};
        s.constraints_at = [](double, const double*, const double*, double*, double*, double*) {};
        s.multipliers_at = [](double, const double*, const double*, double*) {};
        if (!words_.constants().empty()) code_.write(lines_of_constants(p_, words_, ready_), s.prepare);
        write(right_hand_side(p_, words_), s.rhs);
        write(mass_forcing(p_), s.mass_forcing);
        write(energy(p_), s.energy);
        write(outputs_at(p_), s.outputs_at);
        write(events_at(p_), s.events_at);
        write(constraints_at(p_), s.constraints_at);
        write(multipliers_at(p_), s.multipliers_at);
        const bool projects = has_projection(p_);
        if (projects) {
            tables->projection.abi = abi_version;
            write(project(p_), tables->projection.project);
            write(gamma_at(p_), tables->projection.gamma_at);
        }
        const bool derives = !p_.nodes_of(Group::jacobian).empty();
        if (derives) write_derivatives(*tables);
        tables->code = code_.placed();
        if (!tables->code) return std::nullopt;
        return MemorySolver{.module = Module(tables, {.solver = &s,
                                                      .derivatives = derives ? &tables->derivatives : nullptr,
                                                      .projection = projects ? &tables->projection : nullptr,
                                                      .pack = tables->packs.get(),
                                                      .functions = nullptr,
                                                      .independent_constraints =
                                                          static_cast<int>(p_.nodes_of(Group::velocity).size())}),
                            .go_over = [tables](const Module& compiled) { take_over(*tables, compiled); }};
    }

    std::shared_ptr<const alembert_pack_table> packs() {
        struct Packs {
            alembert_pack_table table{};
            std::vector<std::shared_ptr<const TabulatedFunction>> tables;
            std::shared_ptr<const void> code;
        };
        const auto packs = std::make_shared<Packs>();
        packs->tables = p_.tables;
        alembert_pack_table& t = packs->table;
        t.abi = abi_version;
        t.lanes = alembert::lanes;
        t.prepare = [](double*) {};
        t.energy = [](const double*, const double*, const double*, const double*, double*, double*) {};
        t.outputs_at = [](const double*, const double*, const double*, const double*, double*) {};
        if (!words_.constants().empty())
            code_.write(lines_of_constants_in_packs(p_, words_, ready_, lanes_), t.prepare);
        write_packed(right_hand_side(p_, words_), t.rhs);
        write_packed(mass_forcing(p_), t.mass_forcing);
        write_packed(energy(p_), t.energy);
        write_packed(outputs_at(p_), t.outputs_at);
        if (!(packs->code = code_.placed())) return nullptr;
        return {packs, &packs->table};
    }

private:
    static std::vector<int> roots_of(const Program& p) {
        std::vector<int> nodes;
        for (const Root& root : p.roots) nodes.push_back(root.node);
        return nodes;
    }

    void describe(Tables& tables) const {
        const auto count = [](std::size_t size) { return static_cast<int>(size); };
        alembert_solver_table& s = tables.solver;
        s.abi = abi_version;
        s.coordinates = count(words_.q().size());
        s.speeds = count(words_.u().size());
        s.parameters = count(words_.par().size());
        s.constants = count(words_.constants().size());
        s.outputs = count(p_.nodes_of(Group::output).size() + p_.nodes_of(Group::speed).size());
        s.events = count(p_.nodes_of(Group::event).size());
        s.constraints = count(constraints_of(p_));
        s.scene = tables.scene.c_str();
        s.formulation = tables.formulation.c_str();
        s.coordinate_names = tables.coordinates.list();
        s.speed_names = p_.speeds.empty() ? nullptr : tables.speeds.list();
        s.parameter_names = tables.parameters.list();
        s.output_names = tables.outputs.list();
        s.event_names = tables.events.list();
        s.parameter_values = tables.values.data();
    }

    void write_derivatives(Tables& tables) {
        const auto entries = [](SparseTask& task, std::vector<int>& rows, std::vector<int>& columns) {
            rows = std::move(task.rows), columns = std::move(task.columns);
            rows.push_back(-1), columns.push_back(-1);
            return static_cast<int>(rows.size()) - 1;
        };
        SparseTask by_state = jacobian(p_), by_parameters = parameter_jacobian(p_);
        alembert_derivative_table& d = tables.derivatives;
        const auto nothing = [](double, const double*, const double*, double*) {};
        d.abi = abi_version;
        d.jacobian = nothing;
        if (!p_.nodes_of(Group::parameter_jacobian).empty()) d.parameter_jacobian = nothing;
        write(by_state.task, d.jacobian);
        write(by_parameters.task, d.parameter_jacobian);
        d.entries = entries(by_state, tables.rows, tables.columns);
        d.parameter_entries = entries(by_parameters, tables.parameter_rows, tables.parameter_columns);
        d.operations = p_.count(p_.nodes_of(Group::jacobian)).total();
        d.rows = tables.rows.data(), d.columns = tables.columns.data();
        d.parameter_rows = tables.parameter_rows.data(), d.parameter_columns = tables.parameter_columns.data();
    }

    template <typename Function>
    void write(const FunctionTask& task, Function& place) {
        if (!task.results.empty() || !task.copies.empty()) code_.write(lines_of(p_, words_, ready_, task), place);
    }
    /// The function, and before it, if it has sines, the one that takes its place for large angles.
    template <typename Function>
    void write_packed(const FunctionTask& task, Function& place) {
        if (task.results.empty() && task.copies.empty()) return;
        const Lines inside = lines_of_packs(p_, words_, ready_, task, Sines::inside, lanes_);
        std::size_t other = 0;
        if (inside.largest >= 0)
            other = code_.write_aside(lines_of_packs(p_, words_, ready_, task, Sines::called, lanes_));
        code_.write(inside, place, other);
    }

    static void take_over(Tables& tables, const Module& compiled) {
        const auto functions = [](auto& own, const auto& other, auto... function) {
            ((own.*function = other.*function), ...);
        };
        using S = alembert_solver_table;
        functions(tables.solver, compiled.table(), &S::prepare, &S::rhs, &S::mass_forcing, &S::energy,
                  &S::outputs_at, &S::events_at, &S::constraints_at, &S::multipliers_at);
        if (compiled.projection() != nullptr)
            functions(tables.projection, *compiled.projection(), &alembert_projection_table::project,
                      &alembert_projection_table::gamma_at);
        if (compiled.derivatives() != nullptr)
            functions(tables.derivatives, *compiled.derivatives(), &alembert_derivative_table::jacobian,
                      &alembert_derivative_table::parameter_jacobian);
        tables.compiled = compiled;
    }

    const Program& p_;
    Vocabulary words_;
    Readiness ready_;
    int lanes_;
    MemoryCode code_;
};

}  // namespace

std::optional<MemorySolver> memory_solver(const Program& program, bool with_packs, std::optional<int> registers,
                                          std::optional<int> lanes) {
    const int side_by_side = lanes.value_or(lanes_of_processor());
    if (!can_run() || (with_packs && !can_run(side_by_side))) return std::nullopt;
    if (program.singular)
        throw ModelError("the mass matrix is singular at every state: there are no accelerations to emit");
    std::shared_ptr<const alembert_pack_table> packs;
    const int own = registers_of_processor(), allowed = std::min(own, registers.value_or(own));
    if (with_packs && !(packs = Building(program, side_by_side, allowed).packs())) return std::nullopt;
    return Building(program, 1, allowed).solver(std::move(packs));
}

}  // namespace alembert
