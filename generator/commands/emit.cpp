// SPDX-License-Identifier: GPL-2.0-or-later
#include <filesystem>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "present/report/emission.hpp"
#include "scene/lists.hpp"

namespace alembert {

namespace {

struct EmitVerb : SceneOptions {
    std::string folder;
    std::string language = "cpp";
    std::string functions;
    std::vector<std::string> frames, wrenches;
    EmissionOptions emission;
};

int run(const EmitVerb& options) {
    EmissionOptions wishes = options.emission;
    wishes.by = options.by;
    wishes.functions = alembert::names_of(options.functions);
    wishes.frames = options.frames;
    wishes.wrenches = options.wrenches;
    wishes.language = language_of(options.language);
    wishes.at = options.given.at;
    const Emission e = emission(scene_of(options), wishes);
    warn(e.warnings);
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (failed) throw CompileError(say("cannot make the folder '{}': {}", options.folder, failed.message()));
    std::vector<std::string> paths;
    const auto write = [&](const std::string& name, const std::string& text) {
        paths.push_back((std::filesystem::path(options.folder) / name).string());
        write_file(paths.back(), text, {options.scene});
    };
    for (const SourceFile& file : files_of(e)) write(file.name, file.text);
    if (options.json)
        show(as_json(e, paths));
    else
        show(as_text(e, paths));
    return 0;
}

}  // namespace

void add_emit(CLI::App& app, Chosen& chosen) {
    add_scene_verb<EmitVerb>(
        app, chosen,
        {.name = "emit",
         .about = say("writes the C++ of the system, or its code in another language"),
         .example = "alembert emit scenes/textbook/double_pendulum.toml -o solver"},
        run, [](Verb& verb, EmitVerb& options) {
            verb.add_option("-o,--output", options.folder, say("the folder; the file is named after the scene"))
                .type_name(values::folder)
                .required();
            verb.add_option("--language", options.language,
                            say("c, js, python, julia, matlab, rust, modelica; else C++"))
                .type_name(values::language);
            verb.add_option("--name", options.emission.name,
                            say("of files and namespace; default: that of the scene"))
                .type_name(values::name);
            verb.add_flag("--standalone", options.emission.standalone,
                          say("also a main program that integrates and prints"));
            verb.add_flag("--casadi", options.emission.casadi,
                          say("with --language c: also functions for CasADi"));
            verb.add_flag("--fold", options.emission.fold, say("parameters as constants"));
            verb.add_flag("--jacobian", options.emission.jacobian,
                          say("also the derivatives of the right-hand side"));
            verb.add_option(
                    "--functions", options.functions,
                    say("functions of their own: inverse, mass, bias, gravity, loads, inverse_jacobian, "
                        "mass_inverse, coriolis, com, com_jacobian, momentum, centroidal, centroidal_drift, "
                        "regressor; of each "
                        "--frame: mobility, operational_inertia"))
                .type_name(values::names);
            verb.add_option(
                    "--frame", options.frames,
                    say("a point or body, or P@F: pose, Jacobian, velocity, acceleration; may be repeated"))
                .type_name(values::point);
            verb.add_option("--wrench", options.wrenches,
                            say("a point or body, or P@F: force and torque as parameters"))
                .type_name(values::point);
            verb.add_flag("--batch", options.emission.batch,
                          say("also the same functions for eight systems at once"));
            add_given_state(verb, options.given);
            verb.take("--by", options.by);
        });
}

}  // namespace alembert
