// SPDX-License-Identifier: GPL-2.0-or-later
// A first scene to change: the pendulum on a cart, with comments in the language of its reader.
#include <filesystem>
#include <memory>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

struct NewVerb {
    std::string file = "pendulum.toml";
    bool json = false;
};

std::string first_scene() {
    std::string text;
    const auto comment = [&](const std::string& words) { text += "# " + words + "\n"; };
    comment(say("A scene describes a mechanical system. Change what you like; lines after # are comments."));
    text += "title = \"" + say("A pendulum on a cart") + "\"\n";
    text += "gravity = [0, \"-g\"]\n\n";
    comment(say("Letters for numbers. They stay letters in the equations; units are optional."));
    text +=
        "[parameters]\nM = { value = 2.0, unit = \"kg\" }\nm = { value = 1.0, unit = \"kg\" }\n"
        "l = { value = 0.5, unit = \"m\" }\ng = { value = 9.81, unit = \"m/s^2\" }\n\n";
    comment(say("The coordinates, with their values at the start; the rates are 0 if not given (rate = 1.5)."));
    text += "[coordinates]\nx = { initial = 0.0, unit = \"m\" }\ntheta = { initial = 1.0, unit = \"rad\" }\n\n";
    comment(say("Masses: where they are, in the coordinates. x points to the right, y upwards."));
    text += "[[particle]]\nname = \"cart\"\nmass = \"M\"\nposition = [\"x\", 0]\n\n";
    comment(say("Its place counts from the cart; theta is the angle from the vertical below it."));
    text +=
        "[[particle]]\nname = \"bob\"\nmass = \"m\"\nfrom = \"cart\"\n"
        "position = [\"l*sin(theta)\", \"-l*cos(theta)\"]\n\n";
    comment(say("An equation of your own, which 'alembert check' proves or refutes (x'' is the acceleration)."));
    text += "[[claim]]\nequation = \"(M + m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = 0\"\n\n";
    text += "[simulation]\nduration = 10\n";
    return text;
}

int run(const NewVerb& verb) {
    std::error_code none;
    if (std::filesystem::symlink_status(verb.file, none).type() != std::filesystem::file_type::not_found)
        throw ModelError(say("there is such a file already, and it stays as it is; name another one"));
    check_output(verb.file, FileForm::scene, {});
    write_file(verb.file, first_scene(), {});
    if (verb.json)
        show(Json{{"file", verb.file}});
    else
        show(say(
            "wrote {0}\nIts equations: alembert derive {0}\nIts page, with a figure that moves: alembert {0}\n",
            verb.file));
    return 0;
}

}  // namespace

void add_new(CLI::App& app, Chosen& chosen) {
    const auto options = std::make_shared<NewVerb>();
    Verb verb = add_verb(app, {.name = "new",
                               .about = say("writes a first scene with comments, for you to change"),
                               .example = "alembert new cart.toml"});
    verb.add_option("file", options->file, say("the scene to be written; default: pendulum.toml"))
        .type_name(values::file);
    verb.take("--json", options->json);
    verb.callback([options, &chosen] {
        chosen = {options->file.empty() ? "new" : options->file, [options] { return run(*options); }};
    });
}

}  // namespace alembert
