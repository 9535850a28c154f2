// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/fmu/free_inputs.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "scene/known_names.hpp"

namespace alembert {

namespace {

Expression parsed(const std::string& text, const KnownNames* names = nullptr) {
    std::vector<Diagnostic> mistakes;
    Expression result = parse_expression(text, {}, mistakes, names);
    if (!result) throw ModelError(mistakes.empty() ? say("this is no expression") : mistakes.front().message);
    return result;
}

class Freeing {
public:
    explicit Freeing(Scene scene) : result_{.scene = std::move(scene), .inputs = {}, .time = {}} {
        const Scene& s = result_.scene;
        const auto take = [this](const auto& list) {
            for (const auto& item : list) taken_.insert(item.name.text);
        };
        take(s.parameters), take(s.inputs), take(s.coordinates), take(s.speeds), take(s.definitions);
        take(s.functions), take(s.outputs), take(s.events), take(s.constraints), take(s.frames), take(s.points);
    }

    FreeInputs freed() {
        if (result_.scene.inputs.empty()) return std::move(result_);
        result_.time = fresh("time_of_inputs");
        for (const Input& input : result_.scene.inputs) {
            FreeInput made{
                .name = input.name.text, .unit = input.unit, .about = input.about, .given = {}, .shown = {}};
            made.is_set = parameter(input.name.text + "_is_set");
            made.given = {parameter(input.name.text + "_set_value"), parameter(input.name.text + "_set_rate"),
                          parameter(input.name.text + "_set_second_rate")};
            for (std::size_t order = 0; order < 3; ++order) {
                made.shown[order] = fresh(fmt::format("{}_shown_{}", input.name.text, order));
                result_.scene.outputs.push_back({.name = {made.shown[order], {}},
                                                 .value = parsed(input.name.text + std::string(order, '\''))});
            }
            result_.inputs.push_back(std::move(made));
        }
        declare(result_.time);
        const KnownNames names(result_.scene);
        for (std::size_t k = 0; k < result_.inputs.size(); ++k) {
            const FreeInput& f = result_.inputs[k];
            Expression& value = result_.scene.inputs[k].value;
            result_.scene.inputs[k].from_outside = false;  // it is now, in the way of a unit
            value = parsed(fmt::format("{0}*({1} + {2}*(t - {4}) + {3}*(t - {4})^2/2) + (1 - {0})*({5})", f.is_set,
                                       f.given[0], f.given[1], f.given[2], result_.time, value.text),
                           &names);
        }
        return std::move(result_);
    }

private:
    std::string fresh(std::string name) {
        while (!taken_.insert(name).second) name += "_";
        return name;
    }
    void declare(const std::string& name) {
        result_.scene.parameters.push_back({.name = {name, {}}, .value = parsed("0"), .unit = {}, .about = {}});
    }
    std::string parameter(const std::string& wish) {
        const std::string name = fresh(wish);
        declare(name);
        return name;
    }

    FreeInputs result_;
    std::set<std::string> taken_;
};

}  // namespace

FreeInputs with_free_inputs(Scene scene) {
    return Freeing(std::move(scene)).freed();
}

}  // namespace alembert
