// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/table_file.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "archive/hdf5.hpp"
#include "report/motion_plot.hpp"
#include "report/run.hpp"
#include "report/sweep.hpp"

namespace alembert {

namespace {

enum class Form { csv, npz, hdf5 };

Form form_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending == ".npz" ? Form::npz : ending == ".h5" || ending == ".hdf5" ? Form::hdf5 : Form::csv;
}

std::string in_form(Form form, const StoredTable& table) {
    return form == Form::npz ? as_npz(table) : as_hdf5(table);
}

std::string unit_of_rate(const std::string& unit) {
    return unit.empty() ? "" : unit + "/s";
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
        if (m.q[i].get_name() + "'" == name) return unit_of_rate(m.units[i]);
    }
    for (const Mechanism::Speed& speed : m.speeds)
        if (speed.u.get_name() == name) return speed.unit;
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

StoredTable stored(const Sweep& s) {
    StoredTable table{.columns = {}, .texts = texts_of(s.scene)};
    const auto add = [&](const std::string& name, const std::string& unit, const auto& value) {
        std::vector<std::decay_t<decltype(value(s.members[0]))>> values;
        for (const SweptMotion& m : s.members) values.push_back(value(m));
        table.columns.push_back({name, unit, std::move(values)});
    };
    const std::vector<std::string> varied = s.grid.names(), ends = end_columns(s);
    for (std::size_t k = 0; k < varied.size(); ++k)
        add(varied[k], unit_of_varied(s.mechanism, varied[k]), [k](const SweptMotion& m) { return m.varied[k]; });
    for (std::size_t k = 0; k < ends.size(); ++k)
        add(k + 1 < ends.size() ? "final_" + ends[k] : ends[k], unit_of_varied(s.mechanism, ends[k]),
            [k](const SweptMotion& m) { return end_values(m)[k]; });
    add("steps", "", [](const SweptMotion& m) { return m.steps; });
    add("rejected", "", [](const SweptMotion& m) { return m.rejected; });
    add("evaluations", "", [](const SweptMotion& m) { return m.evaluations; });
    add("status", "", [](const SweptMotion& m) { return m.status; });
    return table;
}

void need_table_form(const std::string& path) {
    if (form_of(path) == Form::hdf5) need_hdf5();
}

std::string table_file(const Run& run, const std::string& path) {
    const Form form = form_of(path);
    return form == Form::csv ? as_csv(run.rows) : in_form(form, stored(run));
}

std::string table_file(const Sweep& sweep, const std::string& path) {
    const Form form = form_of(path);
    return form == Form::csv ? as_csv(sweep) : in_form(form, stored(sweep));
}

}  // namespace alembert
