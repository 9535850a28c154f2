// SPDX-License-Identifier: GPL-2.0-or-later
/// The Python module `alembert._alembert`: one function for all verbs (verbs.hpp), and classes whose numbers
/// Python reads without a copy. The package's Python part gives them names, units and documentation (alembert/).
///
/// GiNaC is for one thread at a time: everything symbolic takes its turn (symbolic_turn.hpp), without the
/// interpreter's lock. The functions of many states release it too and use all cores.

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>

#include "alembert/base/error.hpp"
#include "alembert/native/compilation.hpp"
#include "algebra/symbolic/number_mistake.hpp"
#include "analysis/state/prepared.hpp"
#include "base/archive/file_form.hpp"
#include "base/language/libraries.hpp"
#include "commands/command_line.hpp"
#include "commands/streams.hpp"
#include "commands/verb.hpp"
#include "present/report/derivation.hpp"
#include "present/report/motion_plot.hpp"
#include "present/report/run.hpp"
#include "present/report/table_file.hpp"
#include "scene/advice.hpp"
#include "scene/typed_words.hpp"
#include "simulate/dense_output.hpp"
#include "simulate/emission.hpp"
#include "simulate/section.hpp"
#include "symbolic_turn.hpp"
#include "system.hpp"
#include "verbs.hpp"

namespace py = pybind11;

namespace alembert {

namespace {

/// NumPy 2 has its descriptions of types in another layout than the pybind11 of Debian 12 expects, which reads
/// there how many bytes a number has. So no array may be made without its strides (`py::array_t<double>(count)`),
/// and no `itemsize` or `nbytes` be asked for.
std::vector<py::ssize_t> strides_of(const std::vector<py::ssize_t>& shape) {
    std::vector<py::ssize_t> strides(shape.size());
    py::ssize_t bytes = sizeof(double);
    for (std::size_t axis = shape.size(); axis-- > 0; bytes *= shape[axis]) strides[axis] = bytes;
    return strides;
}

py::array_t<double> new_array(std::vector<py::ssize_t> shape) {
    std::vector<py::ssize_t> strides = strides_of(shape);
    return {std::move(shape), std::move(strides)};
}

/// A view of `values` that keeps `owner` alive.
py::array_t<double> view(const std::vector<double>& values, const std::vector<py::ssize_t>& shape,
                         const py::object& owner) {
    py::array_t<double> array(shape, strides_of(shape), values.data(), owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

using Warnings = std::vector<std::string>;

/// JSON and the program's page as texts, warnings, files, and the table with its columns.
py::tuple asked(const std::string& verb, const std::string& text, const std::string& file,
                const std::string& options) {
    Answer answer = in_turn([&] { return answer_of(verb, text, file, options, look_for_interrupt); });
    py::dict files;
    for (const auto& [name, content] : answer.files) files[py::str(name)] = py::bytes(content);
    const auto columns = static_cast<py::ssize_t>(answer.table.columns.size());
    const auto rows = static_cast<py::ssize_t>(answer.table.rows());
    auto* const values = new std::vector<double>(std::move(answer.table.values));
    const py::capsule owner(values, [](void* p) { delete static_cast<std::vector<double>*>(p); });
    return py::make_tuple(answer.json.dump(), answer.text, answer.warnings, files, answer.table.columns,
                          view(*values, {rows, columns}, owner));
}

/// A motion, what it was asked for, and what gives its states between the rows, which is made when it is needed.
struct Motion {
    RunOptions wishes;
    Run run;
    std::string section;
    SectionOfRun crossings;
    std::unique_ptr<DenseOutput> between;

    DenseOutput& states() {
        if (!between) between = std::make_unique<DenseOutput>(run, wishes);
        return *between;
    }
};

/// A value with expressions in it, as Python holds it.
template <typename Value>
using Held = std::unique_ptr<Value, DestroyedInTurn<Value>>;

Held<Motion> simulated(const std::string& text, const std::string& file, RunOptions wishes,
                       const std::string& section, const GivenValues& given) {
    const SymbolicTurn turn;
    wishes.progress = look_for_interrupt;
    Scene scene = with_given(parse_scene(text, file), given);
    if (!section.empty()) {
        Prepared begun = prepared(std::move(scene));
        scene = std::move(begun.scene);
        add_section(scene, begun.mechanism, section);
    }
    Held<Motion> motion(new Motion{wishes, simulate(std::move(scene), wishes), section, {}, {}});
    motion->crossings = {section, take_crossings(motion->run)};
    return motion;
}

std::pair<std::string, Warnings> json_of(const Motion& motion) {
    const SymbolicTurn turn;
    Json json = as_json(motion.run);
    if (!motion.section.empty()) json["poincare"] = as_json(motion.crossings, motion.run);
    return {json.dump(), motion.run.warnings};
}

CompiledSystem compiled_system(std::string source) {
    const py::gil_scoped_release release;
    const WorkCanEnd can_end;
    Module module = load(compile(source, "python", {}).object);
    return {std::move(module), std::move(source)};
}

/// The names of coordinates, speeds, parameters and of inputs among these as the scene writes them; those in the
/// tables of emitted code are identifiers of C++.
using SystemNames = std::array<std::vector<std::string>, 4>;

/// Functions, frames, and values in place of the scene's.
using SystemLists = std::array<std::vector<std::string>, 3>;

std::tuple<CompiledSystem, Warnings, SystemNames> system_of(const std::string& text, const std::string& file,
                                                            const std::string& by, bool jacobian,
                                                            const SystemLists& lists) {
    auto [source, warnings, names] = in_turn([&] {
        Emission emitted =
            emission(with_given(parse_scene(text, file), {.at = lists[2]}),
                     {.by = by, .jacobian = jacobian, .batch = true, .functions = lists[0], .frames = lists[1]});
        const Program& program = emitted.choice.program;
        SystemNames of_scene;
        for (std::size_t k = 0; const auto* list : {&program.coordinates, &program.speeds, &program.parameters}) {
            for (const Quantity& quantity : *list) of_scene[k].push_back(quantity.name);
            ++k;
        }
        for (const Quantity& parameter : program.parameters)
            if (parameter.from_outside) of_scene[3].push_back(parameter.name);
        return std::tuple(std::move(emitted.source.text), std::move(emitted.warnings), std::move(of_scene));
    });
    CompiledSystem system = compiled_system(std::move(source));
    const auto first = std::find(names[2].begin(), names[2].end(), names[3].empty() ? "" : names[3].front());
    system.take_inputs(static_cast<std::size_t>(first - names[2].begin()), names[3].size());
    return {std::move(system), std::move(warnings), std::move(names)};
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// States as rows, whatever number of axes they came in.
struct Rows {
    std::vector<py::ssize_t> leading;
    std::size_t count = 1;
};

Rows rows_of_states(const Numbers& states, int width) {
    if (states.ndim() < 1 || states.shape(states.ndim() - 1) != width)
        throw std::invalid_argument(
            fmt::format("a state has {} numbers; the last axis of the array must have them", width));
    Rows rows;
    for (py::ssize_t axis = 0; axis + 1 < states.ndim(); ++axis) {
        rows.leading.push_back(states.shape(axis));
        rows.count *= static_cast<std::size_t>(states.shape(axis));
    }
    return rows;
}

/// One time for all states, or one for each.
std::vector<double> times_of(const py::object& t, std::size_t count) {
    if (PyFloat_Check(t.ptr()) || PyLong_Check(t.ptr())) return {PyFloat_AsDouble(t.ptr())};
    if (t.is_none()) throw std::invalid_argument("the time is None; a number is wanted, or one for each state");
    const auto times = t.cast<Numbers>();
    const auto given = static_cast<std::size_t>(times.size());
    if (given != 1 && given != count)
        throw std::invalid_argument(
            fmt::format("{} times for {} states; one, or one for each, is wanted", given, count));
    return {times.data(), times.data() + given};
}

template <typename Function>
py::array_t<double> mapped(const py::object& t, const Numbers& states, int width, std::vector<py::ssize_t> shape,
                           Function function) {
    const Rows rows = rows_of_states(states, width);
    const std::vector<double> times = times_of(t, rows.count);
    std::vector<py::ssize_t> whole = rows.leading;
    whole.insert(whole.end(), shape.begin(), shape.end());
    py::array_t<double> result = new_array(whole);
    double* const out = result.mutable_data();
    const double* const in = states.data();
    if (rows.count == 1) {
        function(times, in, 1, out);
    } else {
        const py::gil_scoped_release release;
        function(times, in, rows.count, out);
    }
    return result;
}

/// The case that solvers of ordinary differential equations call: one state, in as few instructions as possible.
/// With other inputs from outside where they are given, one number for each.
CompiledSystem with_inputs(const CompiledSystem& s, const py::object& inputs) {
    if (inputs.is_none()) return s;
    const auto values = inputs.cast<Numbers>();
    return s.with_inputs({values.data(), values.data() + values.size()});
}

py::array_t<double> right_hand_side(const CompiledSystem& system, const py::object& t, const Numbers& states,
                                    const py::object& inputs) {
    if (!inputs.is_none()) return right_hand_side(with_inputs(system, inputs), t, states, py::none());
    const CompiledSystem& s = system;
    const int n = s.dimension();
    if (states.ndim() == 1 && states.shape(0) == n && PyFloat_Check(t.ptr())) {
        py::array_t<double> result = new_array({n});
        s.rhs(PyFloat_AS_DOUBLE(t.ptr()), states.data(), result.mutable_data());
        return result;
    }
    return mapped(t, states, n, {n},
                  [s](const std::vector<double>& times, const double* in, std::size_t count, double* out) {
                      s.rhs_of_many(times, in, count, out);
                  });
}

void add_errors(py::module_& module) {
    static py::exception<std::runtime_error> base(module, "Error", PyExc_RuntimeError);
    static py::exception<SceneError> scene(module, "SceneError", base.ptr());
    static py::exception<ModelError> model(module, "ModelError", base.ptr());
    static py::exception<CompileError> environment(module, "EnvironmentFailure", base.ptr());
    static py::exception<IntegrationError> numbers(module, "IntegrationError", base.ptr());
    static const auto raise_numbers = [](const std::string& why, double time, const std::vector<double>& state) {
        const py::object raised = static_cast<const py::object&>(numbers)(why);
        raised.attr("time") = time;
        raised.attr("state") = state;
        PyErr_SetObject(numbers.ptr(), raised.ptr());
    };
    py::register_exception_translator([](std::exception_ptr error) {
        try {
            if (error) std::rethrow_exception(error);
        } catch (const Interrupted& interrupted) {
            interrupted.raised->restore();
        } catch (const SceneError& e) {
            const py::object raised = static_cast<const py::object&>(scene)(e.what());
            py::list places;
            for (const Diagnostic& d : e.diagnostics)
                places.append(py::make_tuple(d.place.line, d.place.column, d.message));
            raised.attr("diagnostics") = places;
            PyErr_SetObject(scene.ptr(), raised.ptr());
        } catch (const ModelError& e) {
            PyErr_SetString(model.ptr(), translated_from_library(e.what()).c_str());
        } catch (const CompileError& e) {
            PyErr_SetString(environment.ptr(), translated_from_library(e.what()).c_str());
        } catch (const std::invalid_argument& e) {
            PyErr_SetString(PyExc_ValueError, translated_from_library(e.what()).c_str());
        } catch (const IntegrationError& e) {
            raise_numbers(translated_from_library(e.what()), e.time, e.state);
        } catch (const std::exception& e) {
            const auto why = number_mistake(e);
            if (!why) throw;
            raise_numbers(*why, std::nan(""), {});
        }
    });
}

/// A function of many states: coordinates, and where they are given rates and accelerations of the same shape.
py::array_t<double> robot_function(const CompiledSystem& s, int which, const py::object& t, const Numbers& q,
                                   const std::optional<Numbers>& v, const std::optional<Numbers>& a) {
    const alembert_named_function& f = s.function(which);
    for (const std::optional<Numbers>* other : {&v, &a})
        if (*other && (**other).size() != q.size())
            throw std::invalid_argument("coordinates, rates and accelerations must have the same shape");
    return mapped(
        t, q, s.coordinate_count(), {f.rows, f.columns},
        [s, &f, &v, &a](const std::vector<double>& times, const double* in, std::size_t count, double* out) {
            s.function_of_many(f, times, {in, v ? v->data() : nullptr, a ? a->data() : nullptr}, count, out);
        });
}

py::array_t<double> states_at(Motion& motion, const Numbers& t) {
    DenseOutput& states = in_turn([&]() -> DenseOutput& { return motion.states(); });
    const auto width = static_cast<std::size_t>(states.dimension());
    std::vector<py::ssize_t> shape(t.shape(), t.shape() + t.ndim());
    shape.push_back(states.dimension());
    py::array_t<double> result = new_array(shape);
    double* const values = result.mutable_data();
    const double* const times = t.data();
    const auto count = static_cast<std::size_t>(t.size());
    in_turn([&] {
        for (std::size_t k = 0; k < count; ++k) {
            if (k % 1000 == 999) look_for_interrupt({}, 0);
            states.state_at(times[k], {values + k * width, width});
        }
    });
    return result;
}

void add_answers(py::module_& module) {
    module.def("ask", asked);
    module.def("listen", listen);
    module.def("derive", [](const std::string& text, const std::string& file, const std::string& by,
                            bool reactions, const std::vector<std::string>& at) {
        const SymbolicTurn turn;
        return Held<DerivedScene>(new DerivedScene(
            derive(with_given(parse_scene(text, file), {.at = at}), {.by = by, .reactions = reactions})));
    });
    module.def("simulate",
               [](const std::string& text, const std::string& file, const std::string& by,
                  const std::string& method, const std::array<std::optional<double>, 5>& numbers, long budget,
                  bool estimate, bool reactions, bool fast_math, const std::string& section,
                  const std::string& code, const std::vector<std::string>& sensitivity,
                  const std::vector<std::string>& sensitivity_of, bool sensitivity_rows, bool regularize,
                  bool tuning, const std::vector<std::string>& at, const std::vector<std::string>& inputs) {
                   return simulated(text, file,
                                    {.by = by,
                                     .method = method,
                                     .code = code,
                                     .duration = numbers[0],
                                     .tolerance = numbers[1],
                                     .step = numbers[2],
                                     .sample = numbers[3],
                                     .max_step = numbers[4],
                                     .budget = budget,
                                     .fast_math = fast_math,
                                     .estimate = estimate,
                                     .tuning = tuning,
                                     .regularize = regularize,
                                     .reactions = reactions,
                                     .sensitivity = sensitivity,
                                     .sensitivity_of = sensitivity_of,
                                     .sensitivity_rows = sensitivity_rows},
                                    section, {.at = at, .inputs = inputs});
               });
    module.def("system", system_of);
    module.def("command_line", [](const std::vector<std::string>& args) {
        const py::gil_scoped_release release;
        guard_streams();
        return finished(command_line(args));
    });
    module.def("functions_of_robots", all_functions);
    module.def("in_words_of_scenes", [](std::string text) {
        std::vector<Place> places;
        write_in_words(text, places, KnownNames());
        return text;
    });
    module.def("advice_on_function", [](const std::string& name) { return advice_on_function(name); });
    module.def("need_form", [](const std::string& path, const std::string& form) {
        need_form(path, form == "picture" ? FileForm::picture : form == "unit" ? FileForm::unit : FileForm::page);
    });
}

void add_motion(py::module_& module) {
    py::class_<DerivedScene, Held<DerivedScene>>(module, "Derivation")
        .def("json",
             [](const DerivedScene& d) {
                 const SymbolicTurn turn;
                 return std::pair<std::string, Warnings>(as_json(d).dump(), d.warnings);
             })
        .def("page", [](const DerivedScene& d, const std::string& format, bool steps) {
            const SymbolicTurn turn;
            return as_page(d, {.format = format, .steps = steps});
        });
    py::class_<Motion, Held<Motion>>(module, "Run")
        .def("json", json_of)
        .def("text",
             [](const Motion& motion) {
                 const SymbolicTurn turn;
                 return as_text(motion.run);
             })
        .def("plot",
             [](const Motion& motion, const std::vector<std::string>& columns) {
                 const SymbolicTurn turn;
                 check_columns(motion.run.rows.columns, columns);
                 return motion_plot(motion.run, columns);
             })
        .def("file",
             [](const Motion& motion, const std::string& path) {
                 need_table_form(path);
                 return py::bytes(in_turn([&] { return table_file(motion.run, path); }));
             })
        .def("states_at", states_at)
        .def_property_readonly("failure", [](const Motion& motion) { return motion.run.failure; })
        .def_property_readonly("columns", [](const Motion& motion) { return motion.run.rows.columns; })
        .def_property_readonly("table", [](const py::object& self) {
            const MotionTable& rows = self.cast<const Motion&>().run.rows;
            return view(rows.values,
                        {static_cast<py::ssize_t>(rows.rows()), static_cast<py::ssize_t>(rows.columns.size())},
                        self);
        });
}

void add_system(py::module_& module) {
    py::class_<CompiledSystem>(module, "System")
        .def_property_readonly("dimension", &CompiledSystem::dimension)
        .def("copy", [](const CompiledSystem& s) { return CompiledSystem(s); })
        .def_property_readonly("parameter_values", &CompiledSystem::parameter_values)
        .def_property_readonly("source", &CompiledSystem::source)
        .def("set_parameters", &CompiledSystem::set_parameters)
        .def(py::pickle(
            [](const CompiledSystem& s) { return std::tuple(s.source(), s.parameter_values(), s.inputs()); },
            [](const std::tuple<std::string, std::vector<double>, std::pair<std::size_t, std::size_t>>& state) {
                CompiledSystem s = compiled_system(std::get<0>(state));
                s.set_parameters(std::get<1>(state));
                s.take_inputs(std::get<2>(state).first, std::get<2>(state).second);
                return s;
            }))
        .def("rhs", right_hand_side, py::arg("t"), py::arg("y"), py::arg("inputs") = py::none())
        .def(
            "jacobian",
            [](const CompiledSystem& system, const py::object& t, const Numbers& states,
               const py::object& inputs) {
                const CompiledSystem s = with_inputs(system, inputs);
                const int n = s.dimension();
                return mapped(t, states, n, {n, n},
                              [s](const std::vector<double>& times, const double* in, std::size_t count,
                                  double* out) { s.jacobian_of_many(times, in, count, out); });
            },
            py::arg("t"), py::arg("y"), py::arg("inputs") = py::none())
        .def(
            "mass_matrix",
            [](const CompiledSystem& system, const py::object& t, const Numbers& states,
               const py::object& inputs) {
                const CompiledSystem s = with_inputs(system, inputs);
                const int k = s.speed_count();
                return mapped(t, states, s.dimension(), {k, k},
                              [s](const std::vector<double>& times, const double* in, std::size_t count,
                                  double* out) { s.mass_of_many(times, in, count, out, nullptr); });
            },
            py::arg("t"), py::arg("y"), py::arg("inputs") = py::none())
        .def_property_readonly("functions", &CompiledSystem::function_names)
        .def("function_shape",
             [](const CompiledSystem& s, int which) {
                 const alembert_named_function& f = s.function(which);
                 return std::tuple(f.rows, f.columns, f.operations);
             })
        .def("call", robot_function)
        .def(
            "energy",
            [](const CompiledSystem& system, const py::object& t, const Numbers& states,
               const py::object& inputs) {
                const CompiledSystem s = with_inputs(system, inputs);
                return mapped(t, states, s.dimension(), {3},
                              [s](const std::vector<double>& times, const double* in, std::size_t count,
                                  double* out) { s.energy_of_many(times, in, count, out); });
            },
            py::arg("t"), py::arg("y"), py::arg("inputs") = py::none());
}

}  // namespace

}  // namespace alembert

PYBIND11_MODULE(_alembert, module) {
    module.attr("version") = ALEMBERT_VERSION;
    alembert::add_errors(module);
    alembert::add_answers(module);
    alembert::add_motion(module);
    alembert::add_system(module);
}
