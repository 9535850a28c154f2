// SPDX-License-Identifier: GPL-2.0-or-later
#include "verbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "alembert/base/argument.hpp"
#include "analysis/state/given_values.hpp"
#include "commands/import.hpp"
#include "commands/sweep_table.hpp"
#include "commands/verb.hpp"
#include "present/report/agree.hpp"
#include "present/report/audit.hpp"
#include "present/report/bench.hpp"
#include "present/report/branches.hpp"
#include "present/report/check.hpp"
#include "present/report/emission.hpp"
#include "present/report/equilibria.hpp"
#include "present/report/evaluation.hpp"
#include "present/report/figure.hpp"
#include "present/report/fmu.hpp"
#include "present/report/identification.hpp"
#include "present/report/impact.hpp"
#include "present/report/inertia.hpp"
#include "present/report/inverse.hpp"
#include "present/report/kinematics.hpp"
#include "present/report/linearization.hpp"
#include "present/report/marked.hpp"
#include "present/report/marked_page.hpp"
#include "present/report/proof.hpp"
#include "present/report/scene_page.hpp"
#include "present/report/stability.hpp"
#include "present/report/stability_charts.hpp"
#include "present/report/sweep.hpp"
#include "scene/claims_file.hpp"
#include "scene/units.hpp"
#include "simulate/samples.hpp"
#include "stability/judged_equilibria.hpp"
#include "stability/linear/about.hpp"

namespace alembert {

namespace {

using Texts = std::vector<std::string>;

/// The options of a call.
class Asked {
public:
    Asked(Json options, const ToldProgress& progress) : progress(progress), options_(std::move(options)) {}

    /// From here on numbers that were given for names are in SI units, and not in those of the scene.
    void take_units(const Scene& scene) {
        if (has("at")) {
            Json values = Json::array();
            typed_at_ = texts("at");
            for (const auto& [name, value] : exact_overrides_of(texts("at"), scene))
                values.push_back(fmt::format("{}={}", name, value));
            options_["at"] = std::move(values);
        }
        if (has("over")) {
            Json& over = options_["over"];
            if (over.at(0).is_array())
                for (Json& range : over) scale(range, scene);
            else
                scale(over, scene);
        }
        if (!has("names") || !has("points")) return;
        const Texts names = texts("names");
        Json& points = options_["points"];  // one after the other
        for (std::size_t k = 0; k < points.size() && !names.empty(); ++k)
            if (points[k].is_number())  // what is not finite is a text, and refused later
                points[k] = points[k].get<double>() * unit_of_name(scene, names[k % names.size()]).size;
    }

    bool has(const char* name) const { return options_.contains(name); }
    bool flag(const char* name) const { return options_.value(name, false); }
    double number(const char* name, double missing) const { return real(name).value_or(missing); }
    std::optional<double> real(const char* name) const {
        return has(name) ? std::optional(real_of(options_.at(name))) : std::nullopt;
    }
    int whole(const char* name, int missing) const {
        const double value = number(name, missing);
        if (value != std::floor(value) || std::abs(value) > 1e9)
            throw std::invalid_argument(argument::mistake(name, value, argument::whole_nonnegative));
        return static_cast<int>(value);
    }
    std::string text(const char* name) const { return options_.value(name, std::string()); }
    Texts texts(const char* name) const { return options_.value(name, Texts()); }
    std::string by() const { return text("by"); }
    Overrides at() const { return overrides_of(texts("at"), Scene()); }
    /// The values as they were written.
    ExactOverrides exact_at() const { return exact_overrides_of(texts("at"), Scene()); }
    /// The same in the units of the scene.
    const Texts& typed_at() const { return typed_at_; }
    /// [name, from, to] or [name, from, to, count]
    Axis axis(const char* name, std::size_t count) const { return axis_of(options_.at(name), count); }
    std::vector<Axis> axes(const char* name, std::size_t count) const {
        std::vector<Axis> result;
        for (const Json& one : options_.at(name)) result.push_back(axis_of(one, count));
        return result;
    }
    /// The scene with the values and the functions of inputs that are given for a run.
    Scene given(Scene scene) const {
        return with_values(with_given(std::move(scene), {.inputs = texts("input")}), exact_at());
    }
    RunOptions run_options() const {
        return {.by = by(),
                .method = text("method"),
                .code = text("code"),
                .duration = real("duration"),
                .tolerance = real("tolerance"),
                .step = real("step"),
                .max_step = real("max_step"),
                .budget = static_cast<long>(number("budget", 10'000'000)),
                .fast_math = flag("fast_math"),
                .tuning = options_.value("tuning", true),
                .progress = progress};
    }

    const ToldProgress& progress;
    const Json& options() const { return options_; }

    /// What is not finite comes as a text, because JSON has no number for it.
    static double real_of(const Json& value) {
        return value.is_string() ? std::strtod(value.get<std::string>().c_str(), nullptr) : value.get<double>();
    }

private:
    static void scale(Json& range, const Scene& scene) {
        for (const std::size_t k : {1, 2})
            if (range[k].is_number())
                range[k] = range[k].get<double>() * unit_of_name(scene, range[0].get<std::string>()).size;
    }
    static Axis axis_of(const Json& range, std::size_t count) {
        return {.name = range.at(0).get<std::string>(),
                .from = real_of(range.at(1)),
                .to = real_of(range.at(2)),
                .count = range.size() > 3 ? range.at(3).get<std::size_t>() : count};
    }

    Json options_;
    Texts typed_at_;
};

template <typename Value>
Answer shown(const Value& value) {
    return {.json = as_json(value), .text = as_text(value), .warnings = value.warnings};
}

/// The same for what has a picture and a table.
template <typename Value>
Answer drawn(const Value& value) {
    Answer answer{.json = as_json(value), .text = as_text(value), .files = {{"csv", as_csv(value)}}};
    if constexpr (requires { value.warnings; }) answer.warnings = value.warnings;
    if constexpr (requires { as_svg(value); }) answer.files["svg"] = as_svg(value);
    return answer;
}

Answer do_derivation(Scene scene, const Asked& asked) {
    MarkOptions options{.by = asked.by()};
    for (const std::string& given : asked.texts("letters")) {
        const std::size_t equals = given.rfind('=');
        options.letters[given.substr(0, equals)] = given.substr(equals + 1);
    }
    const std::string title = scene.title;
    const Marked marked =
        mark(std::move(scene), read_derivation(asked.text("derivation"), asked.text("name")), options);
    return {.json = as_json(marked),
            .text = as_text(marked),
            .files = {{"html", as_html(marked, {.title = title, .version = ALEMBERT_VERSION})}}};
}

Answer do_check(Scene scene, const Asked& asked) {
    scene = asked.given(std::move(scene));
    if (asked.has("derivation")) return do_derivation(std::move(scene), asked);
    if (asked.has("claims")) scene = with_claims(std::move(scene), asked.text("claims"), "claims");
    return shown(check(std::move(scene), asked.by()));
}

Answer do_audit(Scene scene, const Asked& asked) {
    return shown(audit(asked.given(std::move(scene))));
}

Answer do_agree(Scene scene, const Asked& asked) {
    return shown(agree(asked.given(std::move(scene))));
}

Answer do_impact(Scene scene, const Asked& asked) {
    return shown(impact(asked.given(std::move(scene))));
}

Answer do_eval(Scene scene, const Asked& asked) {
    const bool reactions = asked.flag("reactions");
    const Evaluation value =
        evaluate(std::move(scene),
                 {.by = asked.by(), .at = asked.at(), .reactions = reactions, .matrices = asked.flag("matrices")});
    return {.json = as_json(value, reactions), .text = as_text(value), .warnings = value.warnings};
}

Answer do_inverse(Scene scene, const Asked& asked) {
    return shown(inverse(std::move(scene), {.by = asked.by(), .at = asked.at()}));
}

Answer do_prove(Scene scene, const Asked& asked) {
    RunOptions wishes{.by = asked.by(), .duration = asked.real("duration"), .sample = asked.real("sample")};
    wishes.progress = asked.progress;
    return shown(prove(asked.given(std::move(scene)), wishes));
}

Answer do_linearize(Scene scene, const Asked& asked) {
    LinearizeOptions options{.by = asked.by(), .at = asked.at(), .exact_at = asked.exact_at()};
    if (asked.flag("affine")) options.about = About::any;
    if (asked.flag("along"))
        options.along = AlongOptions{.duration = asked.real("duration"),
                                     .tolerance = asked.real("tolerance"),
                                     .sample = asked.real("sample"),
                                     .progress = asked.progress};
    return shown(linearize(std::move(scene), options));
}

StabilityOptions stability_options(const Asked& asked) {
    return {.by = asked.by(),
            .at = asked.at(),
            .exact_at = asked.exact_at(),
            .period = asked.number("period", 0),
            .lyapunov = asked.text("lyapunov")};
}

Answer do_stability(Scene scene, const Asked& asked) {
    return shown(stability(std::move(scene), stability_options(asked)));
}

Answer do_chart(Scene scene, const Asked& asked) {
    const std::vector<Axis> over = asked.axes("over", 60);
    if (over.size() != 2) throw std::invalid_argument("a chart of stability is drawn over two parameters");
    return drawn(stability_chart(std::move(scene), over[0], over[1],
                                 {.stability = stability_options(asked), .progress = asked.progress}));
}

Answer do_locus(Scene scene, const Asked& asked) {
    return drawn(root_locus(std::move(scene), asked.axis("over", 200),
                            {.stability = stability_options(asked), .progress = asked.progress}));
}

Answer do_exponents(Scene scene, const Asked& asked) {
    return drawn(lyapunov_exponents(std::move(scene), {.by = asked.by(),
                                                       .at = asked.at(),
                                                       .count = asked.whole("count", 1),
                                                       .duration = asked.number("duration", 1000),
                                                       .progress = asked.progress}));
}

Answer do_equilibrium(Scene scene, const Asked& asked) {
    return shown(judged_equilibria(
        scene,
        {.by = asked.by(), .at = asked.at(), .starts = asked.whole("starts", 0), .progress = asked.progress}));
}

Answer do_branches(Scene scene, const Asked& asked) {
    const Axis over = asked.axis("over", 0);
    return drawn(branches(std::move(scene), {.by = asked.by(),
                                             .at = asked.at(),
                                             .name = over.name,
                                             .from = over.from,
                                             .to = over.to,
                                             .progress = asked.progress}));
}

Answer do_kinematics(Scene scene, const Asked& asked) {
    const bool steps = asked.flag("steps");
    const SceneKinematics found = kinematics(
        std::move(scene),
        {.of = asked.texts("of"), .at = asked.at(), .steps = steps, .jacobian = asked.flag("jacobian")});
    return {.json = as_json(found, steps),
            .text = as_page(found, "text", steps) + jacobian_page(found),
            .warnings = found.warnings};
}

Answer do_inertia(Scene scene, const Asked& asked) {
    return shown(
        inertia(std::move(scene), {.of = asked.texts("of"), .about = asked.text("about"), .at = asked.at()}));
}

Answer do_identify(Scene scene, const Asked& asked) {
    return shown(identify(asked.given(std::move(scene))));
}

Answer do_fmu(Scene scene, const Asked& asked) {
    const std::string path = asked.text("path");
    const FunctionalUnit unit =
        functional_unit(asked.given(std::move(scene)),
                        {.by = asked.by(), .version = asked.whole("fmi", 2), .at = asked.typed_at()});
    return {.json = as_json(unit, path),
            .text = as_text(unit, path),
            .warnings = unit.warnings,
            .files = {{"fmu", unit.archive}}};
}

Answer do_emit(Scene scene, const Asked& asked) {
    const Emission e = emission(asked.given(std::move(scene)), {.name = asked.text("name"),
                                                                .by = asked.by(),
                                                                .fold = asked.flag("fold"),
                                                                .jacobian = asked.flag("jacobian"),
                                                                .batch = asked.flag("batch"),
                                                                .language = language_of(asked.text("language")),
                                                                .functions = asked.texts("functions"),
                                                                .frames = asked.texts("frames"),
                                                                .wrenches = asked.texts("wrenches"),
                                                                .standalone = asked.flag("standalone"),
                                                                .at = asked.typed_at(),
                                                                .casadi = asked.flag("casadi")});
    Answer answer{.json = {}, .warnings = e.warnings};
    std::vector<std::string> paths;
    for (const SourceFile& file : files_of(e)) {
        paths.push_back(asked.text("folder") + file.name);
        answer.files[file.name] = file.text;
    }
    answer.json = as_json(e, paths);
    answer.text = as_text(e, paths);
    return answer;
}

/// Points that are listed one after the other.
Grid listed_points(const Asked& asked) {
    Grid grid;
    for (const std::string& name : asked.texts("names")) grid.axes.push_back({.name = name});
    for (const Json& value : asked.options().at("points")) grid.listed.push_back(Asked::real_of(value));
    for (Axis& axis : grid.axes) axis.count = grid.listed.size() / grid.axes.size();
    return grid;
}

Grid samples_asked(const Asked& asked, int samples) {
    const int seed = asked.whole("seed", 0);
    argument::need_whole_nonnegative("seed", seed);
    return sampled(asked.axes("over", 1), static_cast<std::size_t>(samples), sampling_of(asked.text("sampling")),
                   static_cast<std::uint64_t>(seed));
}

void add_rows(const std::vector<SweptMotion>& motions, MotionTable& table, Json& status) {
    for (const SweptMotion& motion : motions) {
        for (const std::vector<double>& part : {motion.varied, end_values(motion), motion.along})
            table.values.insert(table.values.end(), part.begin(), part.end());
        status.push_back(motion.status);
    }
}

Answer do_sweep(Scene scene, const Asked& asked) {
    const std::string path = asked.text("path");
    const std::vector<std::string> inputs{scene.file};
    const bool resume = asked.flag("resume");
    check_sweep_table(path, resume, inputs);
    const int samples = asked.whole("samples", 0);
    if (asked.has("samples")) argument::need_whole_positive("samples", samples);
    Json points = Json::object();
    if (samples > 0)
        points = {{"samples", samples}, {"sampling", asked.text("sampling")}, {"seed", asked.whole("seed", 0)}};
    SweepJob job({.scene = asked.given(std::move(scene)),
                  .grid = samples > 0 ? samples_asked(asked, samples) : listed_points(asked),
                  .wishes = asked.run_options(),
                  .along = asked.text("along"),
                  .reduce = asked.text("reduce"),
                  .journal = journal_beside(path),
                  .resume = resume,
                  .threads = asked.whole("threads", 0)});
    job.prepare();
    job.run();
    MotionTable table;
    Json status = Json::array();
    if (!path.empty())
        write_sweep_table(job, path, inputs);
    else if (!job.is_reduced())
        job.each([&](const std::vector<SweptMotion>& motions) { add_rows(motions, table, status); });
    job.drop_journal();
    const Sweep& swept = job.sweep();
    Answer answer{.json = as_json(job, points, path), .text = as_text(job, path), .warnings = swept.warnings};
    if (!path.empty() || job.is_reduced()) return answer;
    table.columns = swept.grid.names();
    for (const auto& names : {end_columns(swept), along_columns(swept)})
        table.columns.insert(table.columns.end(), names.begin(), names.end());
    answer.table = std::move(table);
    answer.json["status"] = std::move(status);
    return answer;
}

Answer do_bench(Scene scene, const Asked& asked) {
    BenchOptions options{.wishes = asked.run_options(), .peers = asked.flag("peers")};
    options.most_seconds = asked.number("run_seconds", options.most_seconds);
    options.reference_seconds = asked.number("reference_seconds", options.reference_seconds);
    return drawn(bench(asked.given(std::move(scene)), options));
}

Answer do_report(Scene scene, const Asked& asked) {
    OverviewOptions options{.by = asked.by(),
                            .wishes = asked.run_options(),
                            .moves = asked.flag("motion"),
                            .section = asked.text("poincare"),
                            .measures = asked.flag("bench")};
    options.wishes.budget = static_cast<long>(asked.number("budget", 3'000'000));
    Overview all = overview(asked.given(std::move(scene)), options);
    if (all.motion.value && all.motion.value->run.failure)
        all.warnings.push_back(say("the motion broke off: {}\n", *all.motion.value->run.failure));
    return {.json = Json::object(),
            .warnings = all.warnings,
            .files = {{"html", as_html(all, {.version = ALEMBERT_VERSION, .by = asked.by()})}}};
}

Answer do_draw(Scene scene, const Asked& asked) {
    return {.json = Json::object(), .files = {{"svg", figure_of(asked.given(std::move(scene)))}}};
}

using VerbFunction = Answer (*)(Scene scene, const Asked& asked);
const std::map<std::string, VerbFunction> verb_functions = {{"agree", do_agree},
                                                            {"audit", do_audit},
                                                            {"bench", do_bench},
                                                            {"branches", do_branches},
                                                            {"chart", do_chart},
                                                            {"check", do_check},
                                                            {"draw", do_draw},
                                                            {"emit", do_emit},
                                                            {"equilibrium", do_equilibrium},
                                                            {"eval", do_eval},
                                                            {"exponents", do_exponents},
                                                            {"fmu", do_fmu},
                                                            {"identify", do_identify},
                                                            {"impact", do_impact},
                                                            {"inertia", do_inertia},
                                                            {"inverse", do_inverse},
                                                            {"kinematics", do_kinematics},
                                                            {"linearize", do_linearize},
                                                            {"locus", do_locus},
                                                            {"prove", do_prove},
                                                            {"report", do_report},
                                                            {"stability", do_stability},
                                                            {"sweep", do_sweep}};

/// A robot description is no scene yet: `file` is its path.
Answer import_robot(const std::string& file, const Asked& asked) {
    const ImportedRobot imported = imported_robot(
        file, {.scene = {.source = {},
                         .floating = asked.flag("floating"),
                         .quaternion = asked.flag("quaternion"),
                         .drives = asked.flag("drives"),
                         .friction = asked.flag("friction"),
                         .stops = asked.flag("stops")},
               .others = {.outside = asked.flag("allow_outside"), .packages = asked.texts("package")},
               .right_angles = asked.flag("right_angles"),
               .strict = asked.flag("strict"),
               .loops = asked.text("loops")});
    return {.json = as_json(imported, file), .files = {{"scene", imported.scene.text}}};
}

}  // namespace

Answer answer_of(const std::string& verb, const std::string& text, const std::string& file,
                 const std::string& options, const ToldProgress& progress) {
    try {
        Asked asked(Json::parse(options), progress);
        if (verb == "import") return import_robot(file, asked);
        const auto known = verb_functions.find(verb);
        if (known == verb_functions.end()) throw std::invalid_argument(fmt::format("there is no verb '{}'", verb));
        Scene scene = parse_scene(text, file);
        asked.take_units(scene);
        return known->second(std::move(scene), asked);
    } catch (const nlohmann::json::exception& wrong) {
        throw std::invalid_argument(fmt::format("{}: an option is not what is expected: {}", verb, wrong.what()));
    }
}

}  // namespace alembert
