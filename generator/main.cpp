// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "alembert/error.hpp"
#include "alembert/integrate.hpp"
#include "commands/command.hpp"
#include "formalism/formalisms.hpp"

namespace {

using alembert::Request;

constexpr int input_is_wrong = 3, numbers_failed = 4, environment_failed = 5;

/// Runs a command and turns what it throws into one message and an exit code.
int guarded(int (*command)(const Request&), const Request& request) {
    const auto complain = [](const std::string& text, int code) {
        std::cout.flush();
        std::fflush(stdout);
        std::cerr << text << (text.ends_with('\n') ? "" : "\n");
        return code;
    };
    try {
        return command(request);
    } catch (const alembert::SceneError& e) {
        return complain(e.what(), input_is_wrong);
    } catch (const alembert::ModelError& e) {
        return complain(fmt::format("{}: {}", request.scene, e.what()), input_is_wrong);
    } catch (const std::invalid_argument& e) {
        return complain(fmt::format("{}: {}", request.scene, e.what()), input_is_wrong);
    } catch (const alembert::IntegrationError& e) {
        return complain(fmt::format("{}: {}", request.scene, e.what()), numbers_failed);
    } catch (const alembert::CompileError& e) {
        return complain(e.what(), environment_failed);
    } catch (const std::bad_alloc&) {
        return complain("out of memory", environment_failed);
    } catch (const std::exception& e) {
        return complain(fmt::format("{}: internal error: {}", request.scene, e.what()), environment_failed);
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"alembert derives the equations of motion of a mechanical system, and runs them."};
    app.set_version_flag("--version", std::string("alembert ") + ALEMBERT_VERSION);
    app.require_subcommand(1);
    Request request;
    int (*command)(const Request&) = nullptr;

    const auto verb = [&](const char* name, const char* about, int (*run)(const Request&)) {
        CLI::App* sub = app.add_subcommand(name, about);
        sub->add_option("scene", request.scene, "the scene, a TOML file")->required();
        sub->add_flag("--json", request.json, "print one JSON object");
        sub->add_option("--by", request.by, "formalism: " + alembert::formalism_names());
        sub->callback([&command, run] { command = run; });
        return sub;
    };
    CLI::App* derive = verb("derive", "print the equations of motion in textbook form", alembert::derive);
    derive->add_option("--format", request.format, "text, latex or mathml")->check(CLI::IsMember({"text", "latex", "mathml"}));
    derive->add_flag("--steps", request.steps, "show coordinates, T, V, generalized forces, then the equations");

    const auto with_reactions = [&](CLI::App* sub) {
        sub->add_flag("--reactions", request.reactions, "the reaction of each constraint along each coordinate, lambda*df/dq");
    };
    with_reactions(derive);

    verb("agree", "derive by every formalism that applies, and prove that they say the same", alembert::agree);
    verb("audit", "constraints: kinds, rank, which are redundant or integrable, whether the initial state obeys them", alembert::audit);

    CLI::App* check = verb("check", "hold a hand derivation against the derived equations", alembert::check);
    check->add_option("claims", request.claims, "a file of claims, one equation a line; without it the scene's [[claim]]s");

    const auto at_a_state = [&](CLI::App* sub) {
        sub->add_option("--at", request.at, "NAME=VALUE: a coordinate, a rate (\"theta1'=1\"), a parameter, t");
    };
    CLI::App* eval = verb("eval", "evaluate once, at the initial state or the one given", alembert::eval);
    at_a_state(eval);

    at_a_state(verb("linearize", "matrices and eigenvalues near an equilibrium or a steady motion", alembert::linearize));

    at_a_state(verb("inverse", "the loads along the coordinates that accelerations need: --at \"theta1''=2\"", alembert::inverse));

    verb("impact", "the rates after the scene's impulses, sudden constraints and closed contacts", alembert::impact);

    with_reactions(eval);

    CLI::App* emit = verb("emit", "write the specialized C++", alembert::emit_files);
    emit->add_option("-o,--output", request.output, "folder")->required();
    emit->add_flag("--fold", request.fold, "parameters as constants");
    emit->add_flag("--jacobian", request.jacobian, "with the derivatives of the right-hand side by state and parameters");
    emit->add_flag("--batch", request.batch, "the same functions for eight systems at once too");

    // CLI11's own take nan, and tell the range in 309 digits.
    const auto number = [](bool zero) {
        return CLI::Validator(
            [zero](const std::string& text) {
                const double x = std::strtod(text.c_str(), nullptr);
                return std::isfinite(x) && (x > 0 || (zero && x == 0)) ? std::string() : text + ": expected a number " + (zero ? "of zero or more" : "above zero");
            },
            zero ? "NONNEGATIVE" : "POSITIVE");
    };
    const CLI::Validator nonnegative = number(true), positive = number(false);
    const auto with_run = [&](CLI::App* sub) {
        sub->add_option("--duration", request.duration, "seconds from the start")->check(nonnegative);
        sub->add_option("--tolerance", request.tolerance, "local error of each component, relative to max(1, |y|)")
            ->check(positive);
        sub->add_option("--method", request.method, "auto, " + alembert::method_names() + "; cvode, ida with SUNDIALS");
        sub->add_option("--step", request.step, "fixed step, for methods without step control")->check(positive);
        sub->add_option("-o,--output", request.output, "CSV file");
        sub->add_option("--budget", request.budget, "right-hand sides at the most")->check(positive);
        sub->add_flag("--fast-math", request.fast_math, "let the compiler reorder sums");
    };
    CLI::App* import_robot = app.add_subcommand("import", "write the scene of a robot description (URDF)");
    import_robot->add_option("robot", request.scene, "the robot, an .urdf file")->required();
    import_robot->add_option("-o,--output", request.output, "the scene to be written")->required();
    import_robot->add_flag("--floating", request.floating, "the root link moves freely; otherwise it is the ground");
    import_robot->add_flag("--quaternion", request.quaternion, "what floats turns by a quaternion; otherwise by yaw, pitch and roll");
    import_robot->add_flag("--json", request.json, "print one JSON object");
    import_robot->callback([&command] { command = alembert::import_robot; });

    CLI::App* simulate = verb("simulate", "emit, compile and integrate", alembert::simulate);
    with_run(simulate);
    simulate->add_option("--sample", request.sample, "seconds between rows")->check(positive);
    simulate->add_flag("!--no-estimate", request.estimate, "no second run to estimate the error: half the time");
    with_reactions(simulate);

    CLI::App* sweep = verb("sweep", "integrate from many initial states or with many parameters, a row for each", alembert::sweep);
    with_run(sweep);
    sweep->add_option("--vary", request.vary, "NAME=FROM:TO:COUNT: a coordinate, a rate (\"theta1'=0:1:10\"), a parameter, t; several make a grid")
        ->required();
    sweep->add_option("--threads", request.threads, "as many as there are cores where it is missing")->check(CLI::Range(1, 1024));

    CLI::App* bench = verb("bench", "speed against error: every method over a range of tolerances, against a reference", alembert::bench);
    bench->add_flag("--peers", request.peers, "CVODE, IDA, odeint and GSL too, on the same right-hand side, where they are installed");
    bench->add_option("--csv", request.csv, "CSV file");
    bench->add_option("--svg", request.svg, "work-precision plot");
    bench->add_option("--duration", request.duration, "seconds from the start")->check(nonnegative);
    bench->add_option("--method", request.method, "this one alone");
    bench->add_option("--budget", request.budget, "right-hand sides of one run, at the most")->check(positive);
    bench->add_option("--reference-seconds", request.reference_seconds, "processor time for each of the reference's methods")
        ->check(positive);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        const int code = app.exit(e);
        return code == 0 ? 0 : input_is_wrong;
    }
    return guarded(command, request);
}
