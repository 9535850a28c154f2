// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <filesystem>

#include "alembert/error.hpp"
#include "commands/output.hpp"
#include "commands/show.hpp"
#include "commands/verb.hpp"
#include "report/emission.hpp"

namespace alembert {

namespace {

struct EmitVerb : SceneOptions {
    std::string folder;
    EmissionOptions emission;
};

int run(const EmitVerb& options) {
    EmissionOptions wishes = options.emission;
    wishes.by = options.by;
    const Emission e = emission(read_scene(options.scene), wishes);
    warn(e.warnings);
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (failed)
        throw CompileError(fmt::format("cannot make the folder '{}': {}", options.folder, failed.message()));
    const std::string path = (std::filesystem::path(options.folder) / e.source.file).string();
    write_file(path, e.source.text, {options.scene});
    if (options.json)
        show(as_json(e, path));
    else
        show(as_text(e, path));
    return 0;
}

}  // namespace

void add_emit(CLI::App& app, Chosen& chosen) {
    add_scene_verb<EmitVerb>(
        app, chosen, "emit", "write the specialized C++", run, [](CLI::App& verb, EmitVerb& options) {
            verb.add_option("-o,--output", options.folder, "folder")->required();
            verb.add_flag("--fold", options.emission.fold, "parameters as constants");
            verb.add_flag("--jacobian", options.emission.jacobian,
                          "with the derivatives of the right-hand side by state and parameters");
            verb.add_flag("--batch", options.emission.batch, "the same functions for eight systems at once too");
        });
}

}  // namespace alembert
