// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "alembert/ode/method.hpp"
#include "base/language/say.hpp"
#include "scene/advice.hpp"
#include "scene/claim_mode.hpp"
#include "scene/tables.hpp"
#include "scene/text.hpp"
#include "scene/typed_words.hpp"

namespace alembert {
namespace {

std::string methods_with_fixed_steps() {
    std::vector<std::string_view> names;
    for (const Method method : all_methods())
        if (has_fixed_step(method)) names.push_back(name(method));
    return fmt::format("{}", fmt::join(names, ", "));
}

/// True for a literal number that is zero or negative, in any notation.
bool is_not_positive(const Tree& tree) {
    if (tree.kind == Tree::Kind::negate) return tree.args[0]->kind == Tree::Kind::number;
    return tree.kind == Tree::Kind::number &&
           tree.text.substr(0, tree.text.find_first_of("eE")).find_first_of("123456789") == std::string::npos;
}

std::optional<Name> read_method(const Table& table) {
    std::optional<Name> given = table.name("method");
    if (!given) return {};
    const std::vector<std::string> words = method_words();
    const auto word = std::find_if(words.begin(), words.end(),
                                   [&](const std::string& known) { return bare(known) == bare(given->text); });
    if (word != words.end()) {
        given->text = *word;
    } else {
        std::string meant(method_meant(given->text));
        if (meant.empty()) meant = nearest(given->text, words);
        table.reading().complain(given->place, say("unknown method {}; {}", in_quotes(given->text),
                                                   meant.empty() ? say("there are {}", fmt::join(words, ", "))
                                                                 : say("did you mean '{}'?", meant)));
        return {};
    }
    const std::optional<Method> own = method_named(given->text);
    const bool fixed = own && has_fixed_step(*own);
    if (table.has("step") && !fixed)
        table.complain("step",
                       say("only methods with fixed steps ({}) take 'step'; {} chooses its own: give 'tolerance'",
                           methods_with_fixed_steps(), given->text));
    if (table.has("max_step") && fixed)
        table.complain(
            "max_step",
            say("'max_step' bounds the steps of methods that choose their own; {} has a fixed step: give 'step'",
                given->text));
    return given;
}

void read_polynomial(Table table, Scene& scene) {
    table.allow("polynomial");
    scene.polynomial = PolynomialRule{table.place(), {}};
    const Entry* const entry = table.find("coefficients");
    const toml::array* const list = entry ? entry->node->as_array() : nullptr;
    if (!list || list->size() < 2) {
        const std::string expected = say("expected an array of at least two expressions, highest power first");
        if (entry)
            table.complain("coefficients", say("{} is {}; {}", table.what("coefficients"),
                                               list ? say("too short") : kind_of(*entry->node), expected));
        else
            table.reading().complain(table.place(), say("[polynomial] has no 'coefficients'; {}", expected));
        return;
    }
    for (const toml::node& node : *list)
        scene.polynomial->coefficients.push_back(
            read_expression(table.reading(), node, say("a coefficient of [polynomial]")));
}

void read_simulation(Table table, Scene& scene) {
    table.allow("simulation");
    Simulation& simulation = scene.simulation;
    simulation.start = table.has("start") ? table.expression("start") : zero(table.place());
    const std::pair<std::string_view, Expression*> positive[] = {
        {"duration", &simulation.duration}, {"tolerance", &simulation.tolerance}, {"step", &simulation.step},
        {"max_step", &simulation.max_step}, {"sample", &simulation.sample},       {"period", &simulation.period}};
    for (const auto& [key, value] : positive) {
        *value = table.expression(key);
        if (value->tree && is_not_positive(*value->tree))
            table.reading().complain(value->place(), say("{} is {}; expected a number greater than 0",
                                                         table.what(key), escaped(value->text, 40)));
    }
    simulation.method = read_method(table);
    simulation.regularize = table.flag("regularize");
}

/// +1, −1, or 0 for both.
int read_direction(const Table& table) {
    const std::optional<Name> word = table.name("direction");
    if (!word || word->text == "both") return 0;
    if (word->text == "up") return 1;
    if (word->text == "down") return -1;
    table.reading().complain(word->place, say("the direction of an event is \"up\" (the value of 'when' "
                                              "grows), \"down\" (it falls) or \"both\", not {}",
                                              in_quotes(word->text)));
    return 0;
}

/// A table of expressions by name, { theta = "expression" }.
std::vector<std::pair<Name, Expression>> values_by_name(const Table& table, std::string_view key,
                                                        std::string_view expected, std::string_view each) {
    const Entry* const entry = table.find(key);
    if (!entry) return {};
    const toml::table* const node = entry->node->as_table();
    if (!node || node->empty()) {
        table.complain(key, say("{} is {}; expected {}", table.what(key),
                                node ? say("empty") : kind_of(*entry->node), expected));
        return {};
    }
    const Table inner(table.reading(), *node, table.what(key), entry->place);
    std::vector<std::pair<Name, Expression>> result;
    for (const Entry& one : inner.entries())
        result.emplace_back(Name{written_name(one.key, table.reading().names), one.place},
                            read_expression(table.reading(), *one.node, labelled(each, one.key)));
    return result;
}

std::vector<GeneralizedForce> read_values(const Table& table, std::string_view key, std::string_view expected,
                                          std::string_view each) {
    std::vector<GeneralizedForce> values;
    for (auto& [name, value] : values_by_name(table, key, expected, each)) values.push_back({name, value});
    return values;
}

/// The columns of a run whose values are told, record = ["theta", "theta'"].
std::vector<Name> read_recorded(const Table& table) {
    std::vector<Name> recorded = table.names("record");
    for (Name& name : recorded) name.text = written_name(name.text, table.reading().names);
    if (recorded.empty() && table.has("record"))
        table.complain("record", say("{} is {}; expected the names of columns of a run: [\"theta\", \"theta'\"]",
                                     table.what("record"), say("empty")));
    return recorded;
}

std::optional<int> read_count(const Table& table) {
    constexpr std::int64_t most = 1000000000;
    const Entry* const entry = table.find("count");
    if (!entry) return {};
    const std::optional<std::int64_t> count = entry->node->value_exact<std::int64_t>();
    if (count && *count >= 1 && *count <= most) return static_cast<int>(*count);
    table.complain("count", say("{} is {}; expected how many zeros there are until the run stops, as in count = 3",
                                table.what("count"), kind_of(*entry->node)));
    return {};
}

void read_event(Table table, Scene& scene) {
    table.allow("event");
    EventRule event;
    event.name = table.needed_name("name");
    table.entitle(event.name);
    event.when = table.needed_expression("when");
    event.stop = table.flag("stop");
    event.direction = read_direction(table);
    event.impulses = read_values(table, "impulses", say("impulses by coordinate: {{ theta = \"expression\" }}"),
                                 say("the impulse along"));
    event.set = read_values(table, "set", say("values by state: {{ z = \"expression\" }}"), say("the value of"));
    event.rates =
        read_values(table, "rates", say("rates by coordinate: {{ theta = \"expression\" }}"), say("the rate of"));
    event.record = read_recorded(table);
    event.count = read_count(table);
    scene.events.push_back(std::move(event));
}

void read_claim(Table table, Scene& scene) {
    table.allow("claim");
    Claim claim;
    claim.place = table.place();
    claim.source = table.text("source");
    claim.unknowns = table.names("unknowns");
    claim.constants = table.names("constants");
    if (const auto at = table.name("at")) {
        if (!set_mode(claim, at->text))
            table.reading().complain(
                at->place,
                say("a claim is held at \"motion\", \"rest\", \"impact\", \"solution\", \"sticking\" or "
                    "\"closed\", not at {}",
                    in_quotes(at->text)));
    }
    if (const Entry* const where = table.find("where"))
        claim.where = read_inequalities(table.reading(), *where->node, table.what("where"));
    if (table.has("near")) {
        claim.near = values_by_name(table, "near", say("values of coordinates and rates: {{ theta = 0 }}"),
                                    say("the value of"));
        if (claim.at != Claim::At::motion)
            table.complain("near", say("a claim at {} cannot hold to first order 'near' a state; leave out one "
                                       "of the two",
                                       in_quotes(mode_text(claim))));
        claim.at = Claim::At::near;
    }
    if (const Entry* const equation = table.find("equation"); !equation)
        table.complain_of_missing({"equation"}, say("{} needs '{}'", table.title(), "equation"));
    else if (!equation->node->is_string())
        table.reading().complain(place_of(*equation->node), say("{} is {}; expected an equation in quotes",
                                                                table.what("equation"), kind_of(*equation->node)));
    else
        claim.equation = read_equality(table.reading(), *equation->node, claim.at == Claim::At::impact);
    scene.claims.push_back(std::move(claim));
}

}  // namespace

std::span<const TableReader> run_sections() {
    static constexpr TableReader all[] = {
        {"polynomial", read_polynomial},
        {"simulation", read_simulation},
        {"event", read_event},
        {"claim", read_claim},
    };
    return all;
}

}  // namespace alembert
