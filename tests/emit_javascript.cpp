// SPDX-License-Identifier: MIT
// An emitted module of JavaScript computes the same as the interpreter of the same program, in Chromium and, where
// it is there, in Node; names that JavaScript reserves and texts of a scene change nothing.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "alembert/base/error.hpp"
#include "alembert/native/process.hpp"
#include "emitted.hpp"
#include "named_spring.hpp"
#include "program/interpret.hpp"
#include "program/rounding.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"
#include "tools.hpp"

namespace emit_javascript {

using namespace alembert;
using Json = nlohmann::json;

namespace {

/// Values that a module is to give: numbers, and how far each may be off. That is 1e-14 of the largest of a call,
/// or what rounding of its own operations may do where terms cancel (rounding.hpp), whichever is more.
struct Expected {
    std::vector<double> values, bounds;
    void add(double value, double bound) {
        values.push_back(value);
        bounds.push_back(bound);
    }
    Json json() const {
        double size = 0;
        for (const double x : values) size = std::max(size, std::abs(x));
        std::vector<double> all = bounds;
        for (double& bound : all) bound = std::max(bound, 1e-14 * size);
        return {{"values", values}, {"bounds", all}};
    }
};

Expected values_of(const Program& p, const std::vector<double>& value, const std::vector<double>& error,
                   std::initializer_list<Group> groups) {
    Expected expected;
    for (const Group group : groups)
        for (const int node : p.nodes_of(group)) expected.add(value[node], error[node]);
    return expected;
}

/// One state of a scene, with what its module must give there.
Json call_at(const Program& p, State<double> at) {
    std::vector<double> state = at.q, value = interpret(p, at), error = rounding_errors(p, at);
    state.insert(state.end(), at.qdot.begin(), at.qdot.end());
    Expected rates;
    if (p.speeds.empty())
        for (const double rate : at.qdot) rates.add(rate, 0);
    for (const Group group : {Group::rate, Group::acceleration})
        for (const int node : p.nodes_of(group)) rates.add(value[node], error[node]);
    std::vector<double> rate = rates.values;
    at.qddot.assign(rate.end() - static_cast<std::ptrdiff_t>(at.qdot.size()), rate.end());
    value = interpret(p, at);
    error = rounding_errors(p, at);
    Json call{{"t", at.t}, {"state", state}, {"rate", rate}, {"rhs", rates.json()}};
    const auto add = [&](const char* name, std::initializer_list<Group> groups) {
        const Expected expected = values_of(p, value, error, groups);
        if (!expected.values.empty()) call[name] = expected.json();
    };
    add("energy", {Group::kinetic, Group::potential, Group::energy, Group::power});
    add("outputs_at", {Group::output, Group::speed});
    add("project", {Group::projected});
    add("multipliers_at", {Group::multiplier});
    return call;
}

/// Writes the module of a scene and gives its calls; none of a scene without equations or a start.
Json module_of(const test::Folder& folder, const Scene& scene, const std::string& name, std::size_t longest = 0) {
    Emission e = emission(scene, {.language = CodeLanguage::javascript});
    const Start start = start_of(e.mechanism);
    const State<double> first = state_of(start, e.mechanism, e.equations);
    std::vector<double> state = first.q;
    state.insert(state.end(), first.qdot.begin(), first.qdot.end());
    if (longest > 0)
        e.source = emit(e.choice.program,
                        {.language = CodeLanguage::javascript, .longest_function = longest, .state = state});
    folder.write(name + ".mjs", e.source.text);
    CHECK(e.source.file.ends_with(".mjs"));
    CHECK(e.source.text.find("</") == std::string::npos);
    CHECK((longest == 0 || e.source.text.find("carried[") != std::string::npos));
    std::mt19937_64 random(99);
    Json calls = Json::array();
    for (int k = 0; k < 4; ++k) {
        State<double> at = k == 0 ? first : test::random_state(start, random);
        if (k > 0) at.qdot.resize(e.choice.program.speeds.empty() ? at.q.size() : e.choice.program.speeds.size());
        if (std::all_of(at.q.begin(), at.q.end(), [](double x) { return std::isfinite(x); }))
            calls.push_back(call_at(e.choice.program, at));
    }
    return {{"module", name + ".mjs"}, {"calls", calls}};
}

/// Loads the modules of a folder by both, and compares.
void compare(const test::Folder& folder, const Json& modules) {
    folder.write("modules.json", modules.dump());
    const std::string script = test::source_path("tests/browser/modules"), of = " " + folder.path.string();
    if (!find_program("node").empty()) CHECK(std::system(("node " + script + ".mjs" + of).c_str()) == 0);
    if (test::has_program("chromium") && test::has_program("chromedriver"))
        CHECK(std::system(("python3 -B " + script + ".py" + of).c_str()) == 0);
}

}  // namespace

TEST_CASE("emit: modules of JavaScript compute what their programs compute, in a browser and in Node") {
    const test::Folder folder;
    Json modules = Json::array();
    for (const std::string& file : test::scenes_in("scenes/textbook")) {
        CAPTURE(file);
        const std::string name = std::filesystem::path(file).stem().string();
        modules.push_back(module_of(folder, read_scene(file), name));
    }
    CHECK(modules.size() > 100);
    const Scene arm = read_scene(test::source_path("scenes/benchmark/trees/arm7.toml"));
    modules.push_back(module_of(folder, arm, "arm7"));
    modules.push_back(module_of(folder, arm, "arm7_in_parts", 60));
    compare(folder, modules);
}

TEST_CASE(
    "emit: reserved words of JavaScript as names, and texts that would end a comment or a script, change "
    "nothing") {
    const test::Folder folder;
    Json modules = Json::array();
    int k = 0;
    for (const std::vector<std::string>& names : std::vector<std::vector<std::string>>{
             {"g", "m", "l", "c", "theta", "s"},
             {"let", "var", "await", "yield", "function", "in"},
             {"arguments", "eval", "undefined", "NaN", "null", "with"},
             {"Math", "PI_", "Float64Array", "defaults", "of", "super"},
             {"constructor", "prototype", "Infinity", "values", "this", "export"}})
        for (const char* const text :
             {"m", "</script><!-- */ `${alert(1)}` //\u2028alert(2)", "\\u000aalert(3)//"}) {
            CAPTURE(text);
            const Scene scene = parse_scene(test::spring_scene(names, text, false), "named.toml");
            modules.push_back(module_of(folder, scene, fmt::format("named{}", k++)));
        }
    for (const Json& other : modules) CHECK(other["calls"][0]["rhs"] == modules[0]["calls"][0]["rhs"]);
    compare(folder, modules);
}

TEST_CASE("emit: what is not written in JavaScript is refused") {
    const Scene scene = read_scene(test::source_path("scenes/textbook/double_pendulum.toml"));
    for (const EmissionOptions& wishes :
         {EmissionOptions{.batch = true}, EmissionOptions{.standalone = true}, EmissionOptions{.casadi = true}}) {
        EmissionOptions in_javascript = wishes;
        in_javascript.language = CodeLanguage::javascript;
        CHECK_THROWS_AS(emission(scene, in_javascript), ModelError);
    }
}

}  // namespace emit_javascript
