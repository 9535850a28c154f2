// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/fmu/unit.hpp"

#include <stdexcept>

#include "alembert/native/compilation.hpp"
#include "alembert/native/fingerprint.hpp"
#include "base/archive/zip.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/emit.hpp"
#include "codegen/emit/names.hpp"
#include "simulate/emit_command.hpp"
#include "simulate/fmu/description.hpp"
#include "simulate/fmu/unit_source.hpp"

namespace alembert {

namespace {

#if defined __aarch64__
constexpr const char *folder_2 = "aarch64-linux", *folder_3 = "aarch64-linux";
#else
constexpr const char *folder_2 = "linux64", *folder_3 = "x86_64-linux";
#endif

/// Statements; a longer function is written in parts. Whoever makes a unit waits for the compiler, whose time
/// grows with the square of a function's length, so parts begin earlier than in solvers
/// (program/processor.hpp).
constexpr std::size_t longest_function = 1000;

/// 32 digits as {8-4-4-4-12}.
std::string in_groups(const std::string& digits) {
    std::string result = "{";
    for (std::size_t k = 0; k < digits.size(); ++k) {
        if (k == 8 || k == 12 || k == 16 || k == 20) result += '-';
        result += digits[k];
    }
    return result + "}";
}

/// Those that the C of the unit calls besides.
std::vector<NamedFunction> functions_of(const UnitModel& model) {
    std::vector<NamedFunction> result;
    if (model.contacts > 0) result.push_back(model.contact_function);
    if (!model.setters.empty()) result.push_back(model.set_function);
    if (model.inertia_function.rows > 0) result.push_back(model.inertia_function);
    return result;
}

std::string completed(EmitCommand command, const std::string& name, const FunctionalUnitOptions& options) {
    command.add("--fmu", ascii_identifier(name) + ".fmu");
    command.add("--fmi", options.version == 3 ? "3" : "");
    for (const std::string& value : options.at) command.add("--at", value);
    command.add("--by", options.by);
    return std::move(command.text);
}

}  // namespace

FunctionalUnit functional_unit(Scene scene, const FunctionalUnitOptions& options) {
    if (options.version != 2 && options.version != 3)
        throw std::invalid_argument(say("fmi={}: there are the versions 2 and 3", options.version));
    EmitCommand maker(scene.file);
    FunctionalUnit unit{unit_model(std::move(scene), options.by)};
    unit.version = options.version;
    unit.platform = options.version == 2 ? folder_2 : folder_3;
    const std::string command = completed(std::move(maker), unit.program.name, options);
    const Source equations = emit(unit.program, {.language = CodeLanguage::c,
                                                 .functions = functions_of(unit),
                                                 .longest_function = longest_function,
                                                 .shares_multipliers = true,
                                                 .command = command});
    unit.name = equations.file.substr(0, equations.file.size() - 2);
    unit.variables = unit_variables(unit);
    Fingerprint print;
    print.add(equations.text);
    print.add(unit_source(unit, unit.variables, {options.version, command, ""}).text);
    print.add(model_description(unit, unit.name, unit.variables, {.version = options.version, .token = ""}));
    unit.token = in_groups(print.hex());
    const SourceFile functions = unit_source(unit, unit.variables, {options.version, command, unit.token});
    const std::vector<CSource> files{{equations.file, equations.text},
                                     {equations.header->name, equations.header->text},
                                     {functions.name, functions.text}};
    std::vector<ArchivedFile> archive{
        {"modelDescription.xml",
         model_description(unit, unit.name, unit.variables, {.version = options.version, .token = unit.token})},
        {"binaries/" + unit.platform + "/" + unit.name + ".so", shared_object(files)}};
    if (options.version == 3) archive.push_back({"sources/buildDescription.xml", build_description(unit.name)});
    for (const CSource& file : files) archive.push_back({"sources/" + file.name, file.text});
    unit.archive = stored_zip(archive);
    return unit;
}

}  // namespace alembert
