// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/fmu.hpp"

#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

struct FmuVerb : SceneOptions {
    std::string file;
    std::string version = "2";
};

int run(const FmuVerb& options) {
    check_output(options.file, FileForm::unit, {options.scene});
    const FunctionalUnit unit = functional_unit(
        scene_of(options), {.by = options.by, .version = options.version == "3" ? 3 : 2, .at = options.given.at});
    warn(unit.warnings);
    write_file(options.file, unit.archive, {options.scene});
    if (options.json)
        show(as_json(unit, options.file));
    else
        show(as_text(unit, options.file));
    return 0;
}

}  // namespace

void add_fmu(CLI::App& app, Chosen& chosen) {
    add_scene_verb<FmuVerb>(
        app, chosen,
        {.name = "fmu",
         .about = say("writes a functional mock-up unit (FMI), for other tools"),
         .example = "alembert emit scenes/textbook/cart_pole.toml --fmu cart_pole.fmu"},
        run, [](Verb& verb, FmuVerb& options) {
            verb.add_option("--fmu,-o,--output", options.file, say("the file to write, NAME.fmu"))
                .type_name(values::file)
                .required();
            verb.add_option("--fmi", options.version, say("the version of the interface: 2 (default) or 3"))
                .type_name(values::interface_version);
            add_given_state(verb, options.given);
            verb.take("--by", options.by);
        });
}

}  // namespace alembert
