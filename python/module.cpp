// SPDX-License-Identifier: GPL-2.0-or-later
/// The Python module `alembert._alembert`: a function for each verb, from the text of a scene to the same JSON
/// that the program prints, and two classes whose numbers Python reads without a copy. The package's Python part
/// gives them names, units and documentation (alembert/__init__.py).
///
/// GiNaC is for one thread alone: everything symbolic keeps the interpreter's lock. The functions of many
/// states release it and use all cores.

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "alembert/compile.hpp"
#include "alembert/error.hpp"
#include "linear/about.hpp"
#include "report/agree.hpp"
#include "report/audit.hpp"
#include "report/check.hpp"
#include "report/derivation.hpp"
#include "report/emission.hpp"
#include "report/equilibria.hpp"
#include "report/evaluation.hpp"
#include "report/fmu.hpp"
#include "report/impact.hpp"
#include "report/inertia.hpp"
#include "report/inverse.hpp"
#include "report/kinematics.hpp"
#include "report/linearization.hpp"
#include "report/run.hpp"
#include "report/stability.hpp"
#include "run/emission.hpp"
#include "scene/claims_file.hpp"
#include "system.hpp"

namespace py = pybind11;

namespace alembert {

namespace {

/// JSON as text, and the warnings that go with it.
using Answer = std::pair<std::string, std::vector<std::string>>;
using Values = std::map<std::string, double>;

Overrides overrides_of(const Values& at) {
    return Overrides(at.begin(), at.end());
}

template <typename Value>
Answer answer(const Value& value) {
    return {as_json(value).dump(), value.warnings};
}

Answer check_claims(const std::string& text, const std::string& file, const std::optional<std::string>& claims,
                    const std::string& by) {
    Scene scene = parse_scene(text, file);
    if (claims) scene = with_claims(std::move(scene), *claims, "claims");
    return answer(check(std::move(scene), by));
}

/// The values as typed: the shortest decimals that give them, which are then exact.
ExactOverrides exact_overrides_of(const Values& at) {
    ExactOverrides result;
    for (const auto& [name, value] : at) result.emplace_back(name, fmt::format("{}", value));
    return result;
}

Answer linearized(const std::string& text, const std::string& file, const Values& at, const std::string& by) {
    return answer(linearize(parse_scene(text, file),
                            {.by = by, .at = overrides_of(at), .exact_at = exact_overrides_of(at)}));
}

Answer judged_stability(const std::string& text, const std::string& file, const Values& at, const std::string& by,
                        double period, const std::string& lyapunov) {
    return answer(stability(parse_scene(text, file), {.by = by,
                                                      .at = overrides_of(at),
                                                      .exact_at = exact_overrides_of(at),
                                                      .period = period,
                                                      .lyapunov = lyapunov}));
}

Answer kinematics_of(const std::string& text, const std::string& file, const std::vector<std::string>& of,
                     const Values& at, bool steps) {
    const SceneKinematics found =
        kinematics(parse_scene(text, file), {.of = of, .at = overrides_of(at), .steps = steps});
    return {as_json(found, steps).dump(), found.warnings};
}

Answer evaluated(const std::string& text, const std::string& file, const Values& at, const std::string& by,
                 bool reactions) {
    const Evaluation value =
        evaluate(parse_scene(text, file), {.by = by, .at = overrides_of(at), .reactions = reactions});
    return {as_json(value, reactions).dump(), value.warnings};
}

/// A view of `values` that keeps `owner` alive.
py::array_t<double> view(const std::vector<double>& values, std::vector<py::ssize_t> shape,
                         const py::object& owner) {
    py::array_t<double> array(std::move(shape), values.data(), owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

CompiledSystem system_of(const std::string& text, const std::string& file, const std::string& by, bool jacobian) {
    const Emission emitted = emission(parse_scene(text, file), {.by = by, .jacobian = jacobian, .batch = true});
    return CompiledSystem(load(compile(emitted.source.text, "python", {}).object), emitted.source.text);
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
std::vector<double> times_of(const Numbers& t, std::size_t count) {
    const auto given = static_cast<std::size_t>(t.size());
    if (given != 1 && given != count)
        throw std::invalid_argument(
            fmt::format("{} times for {} states; one, or one for each, is wanted", given, count));
    return {t.data(), t.data() + given};
}

template <typename Function>
py::array_t<double> mapped(const Numbers& t, const Numbers& states, int width, std::vector<py::ssize_t> shape,
                           Function function) {
    const Rows rows = rows_of_states(states, width);
    const std::vector<double> times = times_of(t, rows.count);
    std::vector<py::ssize_t> whole = rows.leading;
    whole.insert(whole.end(), shape.begin(), shape.end());
    py::array_t<double> result(whole);
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
py::array_t<double> right_hand_side(const CompiledSystem& s, const py::object& t, const Numbers& states) {
    const int n = s.dimension();
    if (states.ndim() == 1 && states.shape(0) == n && PyFloat_Check(t.ptr())) {
        py::array_t<double> result(n);
        s.rhs(PyFloat_AS_DOUBLE(t.ptr()), states.data(), result.mutable_data());
        return result;
    }
    return mapped(t.cast<Numbers>(), states, n, {n},
                  [&](const std::vector<double>& times, const double* in, std::size_t count, double* out) {
                      s.rhs_of_many(times, in, count, out);
                  });
}

void add_errors(py::module_& module) {
    static py::exception<std::runtime_error> base(module, "Error");
    static py::exception<SceneError> scene(module, "SceneError", base.ptr());
    static py::exception<ModelError> model(module, "ModelError", base.ptr());
    static py::exception<CompileError> environment(module, "EnvironmentFailure", base.ptr());
    static py::exception<IntegrationError> numbers(module, "IntegrationError", base.ptr());
    py::register_exception_translator([](std::exception_ptr error) {
        try {
            if (error) std::rethrow_exception(error);
        } catch (const SceneError& e) {
            const py::object raised = static_cast<const py::object&>(scene)(e.what());
            py::list places;
            for (const Diagnostic& d : e.diagnostics)
                places.append(py::make_tuple(d.place.line, d.place.column, d.message));
            raised.attr("diagnostics") = places;
            PyErr_SetObject(scene.ptr(), raised.ptr());
        } catch (const ModelError& e) {
            PyErr_SetString(model.ptr(), e.what());
        } catch (const CompileError& e) {
            PyErr_SetString(environment.ptr(), e.what());
        } catch (const IntegrationError& e) {
            const py::object raised = static_cast<const py::object&>(numbers)(e.what());
            raised.attr("time") = e.time;
            raised.attr("state") = e.state;
            PyErr_SetObject(numbers.ptr(), raised.ptr());
        }
    });
}

void add_verbs(py::module_& module) {
    module.def("derive",
               [](const std::string& text, const std::string& file, const std::string& by, bool reactions) {
                   return derive(parse_scene(text, file), {.by = by, .reactions = reactions});
               });
    module.def("check", check_claims);
    module.def("audit", [](const std::string& text, const std::string& file) {
        return answer(audit(parse_scene(text, file)));
    });
    module.def("agree", [](const std::string& text, const std::string& file) {
        return answer(agree(parse_scene(text, file)));
    });
    module.def("impact", [](const std::string& text, const std::string& file) {
        return answer(impact(parse_scene(text, file)));
    });
    module.def("evaluate", evaluated);
    module.def("linearize", linearized);
    module.def("stability", judged_stability);
    module.def("equilibrium", [](const std::string& text, const std::string& file, const Values& at,
                                 const std::string& by, int starts) {
        return answer(equilibria(parse_scene(text, file), {.by = by, .at = overrides_of(at), .starts = starts}));
    });
    module.def("kinematics", kinematics_of);
    module.def("fmu", [](const std::string& text, const std::string& file, const std::string& by, int version,
                         const std::string& path) {
        const FunctionalUnit unit = functional_unit(parse_scene(text, file), {.by = by, .version = version});
        return std::tuple(py::bytes(unit.archive), as_json(unit, path).dump(), unit.warnings);
    });
    module.def("inertia", [](const std::string& text, const std::string& file, const std::vector<std::string>& of,
                             const std::string& about, const Values& at) {
        return answer(inertia(parse_scene(text, file), {.of = of, .about = about, .at = overrides_of(at)}));
    });
    module.def("inverse",
               [](const std::string& text, const std::string& file, const Values& at, const std::string& by) {
                   return answer(inverse(parse_scene(text, file), {.by = by, .at = overrides_of(at)}));
               });
    module.def(
        "simulate",
        [](const std::string& text, const std::string& file, const std::string& by, const std::string& method,
           double duration, double tolerance, double step, double sample, double max_step, long budget,
           bool estimate, bool reactions) {
            return std::make_unique<Run>(simulate(parse_scene(text, file), {.by = by,
                                                                            .method = method,
                                                                            .duration = duration,
                                                                            .tolerance = tolerance,
                                                                            .step = step,
                                                                            .sample = sample,
                                                                            .max_step = max_step,
                                                                            .budget = budget,
                                                                            .estimate = estimate,
                                                                            .reactions = reactions}));
        },
        py::arg("text"), py::arg("file"), py::arg("by"), py::arg("method"), py::arg("duration"),
        py::arg("tolerance"), py::arg("step"), py::arg("sample"), py::arg("max_step"), py::arg("budget"),
        py::arg("estimate"), py::arg("reactions"));
    module.def("system", system_of);
}

void add_classes(py::module_& module) {
    py::class_<DerivedScene>(module, "Derivation")
        .def("json", [](const DerivedScene& d) { return answer(d); })
        .def("page", [](const DerivedScene& d, const std::string& format, bool steps) {
            return as_page(d, {.format = format, .steps = steps});
        });
    py::class_<Run>(module, "Run")
        .def("json", [](const Run& run) { return answer(run); })
        .def("text", [](const Run& run) { return as_text(run); })
        .def_property_readonly("failure", [](const Run& run) { return run.failure; })
        .def_property_readonly("columns", [](const Run& run) { return run.rows.columns; })
        .def_property_readonly("table", [](const py::object& self) {
            const MotionTable& rows = self.cast<const Run&>().rows;
            return view(rows.values,
                        {static_cast<py::ssize_t>(rows.rows()), static_cast<py::ssize_t>(rows.columns.size())},
                        self);
        });
    py::class_<CompiledSystem>(module, "System")
        .def_property_readonly("dimension", &CompiledSystem::dimension)
        .def_property_readonly("coordinates", &CompiledSystem::coordinates)
        .def_property_readonly("speeds", &CompiledSystem::speeds)
        .def_property_readonly("parameter_names", &CompiledSystem::parameter_names)
        .def_property_readonly("parameter_values", &CompiledSystem::parameter_values)
        .def_property_readonly("source", &CompiledSystem::source)
        .def("set_parameters", &CompiledSystem::set_parameters)
        .def("rhs", right_hand_side)
        .def("jacobian",
             [](const CompiledSystem& s, const Numbers& t, const Numbers& states) {
                 const int n = s.dimension();
                 return mapped(t, states, n, {n, n},
                               [&](const std::vector<double>& times, const double* in, std::size_t count,
                                   double* out) { s.jacobian_of_many(times, in, count, out); });
             })
        .def("mass_matrix",
             [](const CompiledSystem& s, const Numbers& t, const Numbers& states) {
                 const int k = s.speed_count();
                 return mapped(t, states, s.dimension(), {k, k},
                               [&](const std::vector<double>& times, const double* in, std::size_t count,
                                   double* out) { s.mass_of_many(times, in, count, out, nullptr); });
             })
        .def("energy", [](const CompiledSystem& s, const Numbers& t, const Numbers& states) {
            return mapped(t, states, s.dimension(), {3},
                          [&](const std::vector<double>& times, const double* in, std::size_t count, double* out) {
                              s.energy_of_many(times, in, count, out);
                          });
        });
}

}  // namespace

}  // namespace alembert

PYBIND11_MODULE(_alembert, module) {
    module.attr("version") = ALEMBERT_VERSION;
    alembert::add_errors(module);
    alembert::add_verbs(module);
    alembert::add_classes(module);
}
