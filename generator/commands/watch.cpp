// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <optional>
#include <thread>
#include <tuple>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/page_server.hpp"
#include "commands/run_verb.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "present/report/scene_page.hpp"

namespace alembert {

namespace {

constexpr auto look_again_after = std::chrono::milliseconds(150);

struct WatchVerb {
    std::string scene, output;
    int port = 0;
    OverviewOptions options = {};
};

/// Values that change when a file is saved, whether it is written in place or replaced; nothing if there is no
/// file now.
using Stamp = std::optional<std::tuple<dev_t, ino_t, off_t, time_t, long>>;

Stamp stamp_of(const std::string& file) {
    struct stat info {};
    if (stat(file.c_str(), &info) != 0) return {};
    return std::tuple(info.st_dev, info.st_ino, info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec);
}

/// Waits until the file differs from `seen` and has not changed for a moment, because editors write in several
/// steps.
Stamp changed_from(const Stamp& seen, const std::string& file) {
    for (Stamp before = seen;;) {
        std::this_thread::sleep_for(look_again_after);
        const Stamp now = stamp_of(file);
        if (now && now != seen && now == before) return now;
        before = now;
    }
}

/// The page of the scene as it is now; for a scene with mistakes, a page that shows them.
std::string page_of(const WatchVerb& verb) {
    try {
        return as_html(overview(read_scene(verb.scene), verb.options),
                       {.version = ALEMBERT_VERSION, .by = verb.options.by});
    } catch (const std::exception& mistake) {
        return error_page(verb.scene, mistake.what());
    }
}

int run(const WatchVerb& verb) {
    check_output(verb.output, FileForm::page, {verb.scene});
    Stamp seen = stamp_of(verb.scene);
    if (!seen) read_scene(verb.scene);  // throws the reason why it cannot be read
    PageServer server(verb.port);
    show(say("{}  shows {}; Ctrl-C ends\n", server.address(), verb.scene));
    std::cout.flush();
    for (;;) {
        server.announce();
        const auto begin = std::chrono::steady_clock::now();
        const std::string page = page_of(verb);
        if (!verb.output.empty()) write_file(verb.output, page, {verb.scene});
        server.publish(page);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        show(say("made in {:.2f} s\n", seconds.count()));
        std::cout.flush();
        seen = changed_from(seen, verb.scene);
    }
}

}  // namespace

void add_watch(CLI::App& app, Chosen& chosen) {
    const auto options = std::make_shared<WatchVerb>();
    Verb verb = add_verb(app, {.name = "watch",
                               .about = say("shows the scene's page in the browser, anew whenever it is saved"),
                               .example = "alembert report scenes/textbook/sled.toml --watch"});
    verb.take("scene", options->scene).required();
    verb.add_option("--port", options->port, say("of this machine's address 127.0.0.1; default: any free port"))
        .type_name(values::count)
        .between(1, 65535);
    verb.add_option("-o,--output", options->output, say("writes the page to this file too"))
        .type_name(values::file);
    verb.take("--duration", options->options.wishes.duration);
    verb.take("--by", options->options.by);
    verb.take("--no-motion", options->options.moves);
    verb.callback([options, &chosen] { chosen = {options->scene, [options] { return run(*options); }}; });
}

}  // namespace alembert
