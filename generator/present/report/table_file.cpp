// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/table_file.hpp"

#include "base/archive/file_form.hpp"
#include "base/archive/hdf5.hpp"
#include "present/report/motion_plot.hpp"
#include "present/report/run.hpp"
#include "present/report/sweep.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

enum class Form { csv, npz, hdf5 };

Form form_of(const std::string& path) {
    const std::string ending = ending_of(path);
    return ending == ".npz" ? Form::npz : ending == ".h5" || ending == ".hdf5" ? Form::hdf5 : Form::csv;
}

std::string in_form(Form form, const StoredTable& table) {
    return form == Form::npz ? as_npz(table) : as_hdf5(table);
}

std::vector<std::pair<std::string, std::string>> texts_of(const Scene& scene) {
    return {{"scene", scene.text}, {"version", ALEMBERT_VERSION}};
}

/// The unit of what is varied: of a parameter, a coordinate, a rate or a speed; s of t.
std::string unit_of_varied(const Mechanism& m, const std::string& name) {
    if (name == "t") return "s";
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.symbol.get_name() == name) return p.unit;
    for (std::size_t i = 0; i < m.q.size(); ++i) {
        if (m.q[i].get_name() == name) return m.units[i];
        if (m.q[i].get_name() + "'" == name) return per_second(m.units[i]);
    }
    for (const Mechanism::Speed& speed : m.speeds)
        if (speed.u.get_name() == name) return speed.unit;
    for (const Mechanism::State& z : m.states)
        if (z.derivative[0].get_name() == name) return z.unit;
    return {};
}

}  // namespace

StoredTable stored(const Run& run) {
    StoredTable table{.columns = {}, .texts = texts_of(run.scene)};
    const MotionTable& rows = run.rows;
    const std::vector<std::string> units = column_units(run);
    for (std::size_t column = 0; column < rows.columns.size(); ++column) {
        std::vector<double> values(rows.rows());
        for (std::size_t row = 0; row < values.size(); ++row) values[row] = rows.at(row, column);
        table.columns.push_back({rows.columns[column], units[column], std::move(values)});
    }
    return table;
}

StoredTable stored(const Sweep& s, const MotionsOf& rows) {
    StoredTable table{.columns = {}, .texts = texts_of(s.scene)};
    const std::vector<std::string> varied = s.grid.names(), ends = end_columns(s);
    for (const std::string& name : varied)
        table.columns.push_back({name, unit_of_varied(s.mechanism, name), std::vector<double>()});
    for (const std::string& end : ends)
        table.columns.push_back(
            {(end == ends.back() ? "" : "final_") + end, unit_of_varied(s.mechanism, end), std::vector<double>()});
    for (const std::string& name : along_columns(s))  // min_theta' is named after its column
        table.columns.push_back(
            {name, unit_of_varied(s.mechanism, name.substr(name.find('_') + 1)), std::vector<double>()});
    for (const char* const name : {"steps", "rejected", "evaluations"})
        table.columns.push_back({name, "", std::vector<std::int64_t>()});
    table.columns.push_back({"status", "", std::vector<std::string>()});
    rows([&](const std::vector<SweptMotion>& motions) {
        for (const SweptMotion& m : motions) {
            auto column = table.columns.begin();
            for (const std::vector<double>& part : {m.varied, end_values(m), m.along})
                for (const double x : part) std::get<std::vector<double>>((column++)->values).push_back(x);
            for (const long count : {m.steps, m.rejected, m.evaluations})
                std::get<std::vector<std::int64_t>>((column++)->values).push_back(count);
            std::get<std::vector<std::string>>(column->values).push_back(m.status);
        }
    });
    return table;
}

void need_table_form(const std::string& path) {
    need_form(path, FileForm::table);
    if (form_of(path) == Form::hdf5) need_hdf5();
}

std::string table_file(const Run& run, const std::string& path) {
    const Form form = form_of(path);
    return form == Form::csv ? as_csv(run.rows) : in_form(form, stored(run));
}

std::string table_file(const Sweep& sweep, const MotionsOf& rows, const std::string& path) {
    return in_form(form_of(path), stored(sweep, rows));
}

std::string table_file(const Sweep& sweep, const SweepReduction& reduction, const std::string& path) {
    const Form form = form_of(path);
    if (form == Form::csv) return as_csv(reduction);
    StoredTable table{
        .columns = {{"quantity", "", std::vector<std::string>()}, {"motions", "", std::vector<std::int64_t>()}},
        .texts = texts_of(sweep.scene)};
    for (const Statistic& statistic : reduction.statistics())
        table.columns.push_back({statistic.name, "", std::vector<double>()});
    for (const ReducedQuantity& quantity : reduction.rows()) {
        std::get<std::vector<std::string>>(table.columns[0].values).push_back(quantity.name);
        std::get<std::vector<std::int64_t>>(table.columns[1].values).push_back(quantity.motions);
        for (std::size_t k = 0; k < quantity.values.size(); ++k)
            std::get<std::vector<double>>(table.columns[k + 2].values).push_back(quantity.values[k]);
    }
    return in_form(form, table);
}

void put_table(SweepJob& job, const std::string& path, const std::function<void(std::string_view)>& put) {
    const Sweep& s = job.sweep();
    if (job.is_reduced()) return put(table_file(s, job.reduction(), path));
    if (form_of(path) != Form::csv)
        return put(table_file(
            s, [&job](const SweptStore::Rows& take) { job.each(take); }, path));
    put(csv_header(s));
    job.each([&](const std::vector<SweptMotion>& motions) { put(csv_rows(motions)); });
}

}  // namespace alembert
