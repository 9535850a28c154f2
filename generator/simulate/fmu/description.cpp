// SPDX-License-Identifier: GPL-2.0-or-later
// Functional Mock-up Interface for Model Exchange and Co-Simulation, version 2.0.4, §2.2; Functional Mock-up
// Interface Specification, version 3.0, §2.4.
#include "simulate/fmu/description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "codegen/emit/numbers.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

namespace {

/// For the value of an attribute in double quotes.
std::string xml_text(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return result;
}

/// ` name="value"`; nothing without a value.
std::string attribute(const char* name, const std::string& value) {
    return value.empty() ? std::string() : fmt::format(" {}=\"{}\"", name, xml_text(value));
}

/// The types of variables: quantities by their units.
const std::map<std::string, const char*>& type_names() {
    static const std::map<std::string, const char*> table{{"rad", "Angle"},
                                                          {"rad/s", "AngularVelocity"},
                                                          {"rad/s^2", "AngularAcceleration"},
                                                          {"m", "Length"},
                                                          {"m/s", "Velocity"},
                                                          {"m/s^2", "Acceleration"},
                                                          {"kg", "Mass"},
                                                          {"s", "Time"},
                                                          {"N", "Force"},
                                                          {"N*m", "Torque"},
                                                          {"J", "Energy"},
                                                          {"W", "Power"},
                                                          {"kg*m^2", "MomentOfInertia"},
                                                          {"N/m", "Stiffness"}};
    return table;
}

class DescriptionText {
public:
    DescriptionText(const UnitModel& model, const std::string& name, const std::vector<UnitVariable>& variables,
                    const DescriptionOptions& options)
        : m_(model), name_(name), variables_(variables), options_(options), is_2_(options.version == 2) {}

    std::string text() {
        add("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"{}\" modelName=\"{}\" "
            "{}=\"{}\"",
            is_2_ ? "2.0" : "3.0", xml_text(m_.mechanism.name), is_2_ ? "guid" : "instantiationToken",
            options_.token);
        add("{} generationTool=\"alembert {}\" variableNamingConvention=\"structured\"",
            attribute("description", m_.scene.title), ALEMBERT_VERSION);
        if (is_2_) add(" numberOfEventIndicators=\"{}\"", count(UnitVariable::Kind::event));
        add(">\n");
        add_interfaces();
        add_units();
        add_types();
        add("  <LogCategories>\n    <Category name=\"logStatusError\" description=\"why a call has failed\"/>\n"
            "    <Category name=\"logStatusWarning\" description=\"what is no longer seen\"/>\n"
            "  </LogCategories>\n");
        add("  <DefaultExperiment startTime=\"{}\" stopTime=\"{}\" tolerance=\"{}\" stepSize=\"{}\"/>\n",
            shortest(m_.start.t), shortest(m_.start.t + m_.duration), shortest(m_.tolerance),
            shortest(m_.sample > 0 ? m_.sample : m_.duration / 500));
        add("  <ModelVariables>\n");
        for (std::size_t k = 0; k < variables_.size(); ++k) add_variable(k);
        add("  </ModelVariables>\n  <ModelStructure>\n");
        is_2_ ? add_structure_2() : add_structure_3();
        add("  </ModelStructure>\n</fmiModelDescription>\n");
        return std::move(text_);
    }

private:
    template <typename... T>
    void add(fmt::format_string<T...> format, T&&... values) {
        text_ += fmt::format(format, std::forward<T>(values)...);
    }

    long count(UnitVariable::Kind kind) const {
        return std::count_if(variables_.begin(), variables_.end(), [&](const auto& v) { return v.kind == kind; });
    }

    void add_interfaces() {
        if (!is_2_) {
            add("  <ModelExchange modelIdentifier=\"{}\" canGetAndSetFMUState=\"true\" "
                "canSerializeFMUState=\"true\" "
                "providesDirectionalDerivatives=\"{}\" needsCompletedIntegratorStep=\"true\"/>\n",
                name_, m_.contacts == 0);
            add("  <CoSimulation modelIdentifier=\"{}\" canGetAndSetFMUState=\"true\" "
                "canSerializeFMUState=\"true\" "
                "providesDirectionalDerivatives=\"{}\" canHandleVariableCommunicationStepSize=\"true\"/>\n",
                name_, m_.contacts == 0);
            return;
        }
        const std::string files = fmt::format(
            "    <SourceFiles>\n      <File name=\"{0}.c\"/>\n      <File name=\"{0}_fmu.c\"/>\n    "
            "</SourceFiles>\n",
            name_);
        const std::string abilities = fmt::format(
            " canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\" "
            "canSerializeFMUstate=\"true\" providesDirectionalDerivative=\"{}\"",
            m_.contacts == 0);
        add("  <ModelExchange modelIdentifier=\"{}\"{}>\n{}  </ModelExchange>\n", name_, abilities, files);
        add("  <CoSimulation modelIdentifier=\"{}\" canHandleVariableCommunicationStepSize=\"true\" "
            "canInterpolateInputs=\"true\"{}>\n{}  </CoSimulation>\n",
            name_, abilities, files);
    }

    void add_units() {
        std::vector<std::string> units;
        for (const UnitVariable& v : variables_)
            if (!v.unit.empty() && std::find(units.begin(), units.end(), v.unit) == units.end())
                units.push_back(v.unit);
        if (units.empty()) return;
        add("  <UnitDefinitions>\n");
        for (const std::string& unit : units) {
            const auto meaning = meaning_of_unit(unit);
            if (!meaning || !meaning->is_si()) {
                add("    <Unit name=\"{}\"/>\n", xml_text(unit));
                continue;
            }
            add("    <Unit name=\"{}\">\n      <BaseUnit", xml_text(unit));
            for (const char* base : {"kg", "m", "s", "A", "K", "mol", "cd", "rad"})
                if (const auto found = meaning->exponents.find(base); found != meaning->exponents.end())
                    add(" {}=\"{}\"", base, std::lround(found->second));
            if (meaning->factor != 1) add(" factor=\"{}\"", shortest(meaning->factor));
            add("/>\n");
            for (const auto& [shown, size] : shown_in(unit))
                add("      <DisplayUnit name=\"{}\" factor=\"{}\"/>\n", xml_text(shown), shortest(1 / size));
            add("    </Unit>\n");
        }
        add("  </UnitDefinitions>\n");
    }

    /// The units in which the scene gives variables of this unit, and their sizes.
    std::map<std::string, double> shown_in(const std::string& unit) const {
        std::map<std::string, double> result;
        for (const UnitVariable& v : variables_)
            if (v.unit == unit && v.shown.size != 1) result[v.shown.unit] = v.shown.size;
        return result;
    }

    std::string type_of(const std::string& unit) const {
        const auto found = type_names().find(unit);
        return found == type_names().end() ? std::string() : found->second;
    }

    void add_types() {
        std::map<std::string, std::string> used;  // type → unit
        for (const UnitVariable& v : variables_)
            if (const std::string type = type_of(v.unit); !type.empty()) used[type] = v.unit;
        if (used.empty()) return;
        add("  <TypeDefinitions>\n");
        for (const auto& [type, unit] : used)
            if (is_2_)
                add("    <SimpleType name=\"{0}\">\n      <Real quantity=\"{0}\" unit=\"{1}\"/>\n    "
                    "</SimpleType>\n",
                    type, xml_text(unit));
            else
                add("    <Float64Type name=\"{0}\" quantity=\"{0}\" unit=\"{1}\"/>\n", type, xml_text(unit));
        add("  </TypeDefinitions>\n");
    }

    static const char* causality(const UnitVariable& v) {
        using Kind = UnitVariable::Kind;
        return v.kind == Kind::time    ? "independent"
               : v.kind == Kind::input ? "input"
               : v.is_parameter()      ? "parameter"
               : v.is_output           ? "output"
                                       : "local";
    }

    void add_variable(std::size_t k) {
        using Kind = UnitVariable::Kind;
        const UnitVariable& v = variables_[k];
        const bool has_initial = v.kind != Kind::time && v.kind != Kind::input;
        const std::string common =
            fmt::format(" name=\"{}\" valueReference=\"{}\"{} causality=\"{}\" variability=\"{}\"{}",
                        xml_text(v.name), k, attribute("description", v.about), causality(v),
                        v.kind == Kind::parameter        ? "tunable"
                        : v.kind == Kind::tied_parameter ? "fixed"
                                                         : "continuous",
                        !has_initial        ? ""
                        : v.is_calculated() ? " initial=\"calculated\""
                                            : " initial=\"exact\"");
        const std::string type = type_of(v.unit);
        std::string own = type.empty() ? attribute("unit", v.unit)
                                       : fmt::format(" declaredType=\"{}\"", type) + attribute("unit", v.unit);
        if (v.shown.size != 1) own += attribute("displayUnit", v.shown.unit);
        if (v.start) own += fmt::format(" start=\"{}\"", shortest(*v.start));
        if (v.derivative_of >= 0) own += fmt::format(" derivative=\"{}\"", v.derivative_of + (is_2_ ? 1 : 0));
        if (v.jumps) own += " reinit=\"true\"";
        if (is_2_)
            add("    <ScalarVariable{}>\n      <Real{}/>\n    </ScalarVariable>\n", common, own);
        else
            add("    <Float64{}{}/>\n", common, own);
    }

    /// Of an unknown while the unit runs: without parameters, which are known then; at the start with them.
    std::string dependencies(const UnitVariable& v, bool at_start) const {
        std::string result;
        for (const int k : v.dependencies)
            if (at_start || !variables_[static_cast<std::size_t>(k)].is_parameter())
                result += fmt::format("{}{}", result.empty() ? "" : " ", k + (is_2_ ? 1 : 0));
        return result;
    }

    std::vector<int> outputs() const {
        std::vector<int> result;
        for (std::size_t k = 0; k < variables_.size(); ++k)
            if (variables_[k].is_output) result.push_back(static_cast<int>(k));
        return result;
    }

    /// The outputs and rates of states that are computed at the start.
    std::vector<int> initial_unknowns() const {
        std::vector<int> result = outputs();
        for (const int rate : state_rates(variables_)) result.push_back(rate);
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        std::erase_if(result, [&](int k) { return !variables_[static_cast<std::size_t>(k)].is_calculated(); });
        return result;
    }

    void add_list_2(const char* name, const std::vector<int>& unknowns, bool at_start) {
        if (unknowns.empty()) return;
        add("    <{}>\n", name);
        for (const int k : unknowns)
            add("      <Unknown index=\"{}\" dependencies=\"{}\"/>\n", k + 1,
                dependencies(variables_[static_cast<std::size_t>(k)], at_start));
        add("    </{}>\n", name);
    }

    void add_structure_2() {
        add_list_2("Outputs", outputs(), false);
        add_list_2("Derivatives", state_rates(variables_), false);
        add_list_2("InitialUnknowns", initial_unknowns(), true);
    }

    void add_list_3(const char* name, const std::vector<int>& unknowns, bool at_start) {
        for (const int k : unknowns)
            add("    <{} valueReference=\"{}\" dependencies=\"{}\"/>\n", name, k,
                dependencies(variables_[static_cast<std::size_t>(k)], at_start));
    }

    void add_structure_3() {
        std::vector<int> events;
        for (std::size_t k = 0; k < variables_.size(); ++k)
            if (variables_[k].kind == UnitVariable::Kind::event) events.push_back(static_cast<int>(k));
        add_list_3("Output", outputs(), false);
        add_list_3("ContinuousStateDerivative", state_rates(variables_), false);
        add_list_3("InitialUnknown", initial_unknowns(), true);
        add_list_3("EventIndicator", events, false);
    }

    const UnitModel& m_;
    const std::string& name_;
    const std::vector<UnitVariable>& variables_;
    const DescriptionOptions& options_;
    bool is_2_;
    std::string text_;
};

}  // namespace

std::string model_description(const UnitModel& model, const std::string& name,
                              const std::vector<UnitVariable>& variables, const DescriptionOptions& options) {
    return DescriptionText(model, name, variables, options).text();
}

std::string build_description(const std::string& name) {
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiBuildDescription fmiVersion=\"3.0\">\n"
        "  <BuildConfiguration modelIdentifier=\"{0}\">\n    <SourceFileSet language=\"C99\">\n"
        "      <SourceFile name=\"{0}.c\"/>\n      <SourceFile name=\"{0}_fmu.c\"/>\n    </SourceFileSet>\n"
        "  </BuildConfiguration>\n</fmiBuildDescription>\n",
        name);
}

}  // namespace alembert
