// SPDX-License-Identifier: MIT
#pragma once

/// The description of a functional mock-up unit, read from its XML and held against the rules of FMI 2.0.4 (§2.2)
/// and 3.0 (§2.4).
///
///     const UnitDescription d = described(xml, 2);
///     d.at("theta", "unit");           // "rad"
///     check_rules(xml, 2);

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace alembert::test {

struct UnitElement {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::string operator[](const std::string& key) const {
        const auto found = attributes.find(key);
        return found == attributes.end() ? std::string() : found->second;
    }
    bool has(const std::string& key) const { return attributes.contains(key); }
};

/// The elements in the order in which they begin.
inline std::vector<UnitElement> elements_of(const std::string& xml) {
    std::vector<UnitElement> list;
    for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
        if (xml[at + 1] == '/' || xml[at + 1] == '?') continue;
        std::size_t here = xml.find_first_of(" />\n", at);
        UnitElement e{.name = xml.substr(at + 1, here - at - 1), .attributes = {}};
        while (xml[here] != '>' && xml[here] != '/') {
            const std::size_t from = xml.find_first_not_of(" \n", here), equals = xml.find_first_of("=>/", from);
            if (xml[equals] != '=') break;
            const std::size_t close = xml.find('"', equals + 2);
            e.attributes[xml.substr(from, equals - from)] = xml.substr(equals + 2, close - equals - 2);
            here = close + 1;
        }
        list.push_back(std::move(e));
    }
    return list;
}

inline std::vector<int> whole_numbers_of(const std::string& list) {
    std::istringstream in(list);
    std::vector<int> result;
    for (int k = 0; in >> k;) result.push_back(k);
    return result;
}

/// A variable with the attributes of both of its elements, and the lists of ModelStructure by value references.
struct UnitDescription {
    std::map<std::string, std::string> model;
    std::vector<UnitElement> variables;
    std::vector<int> outputs, rates, initial, events;
    std::map<std::string, unsigned> reference;
    std::string at(const std::string& name, const char* key) const {
        return variables.at(reference.at(name))[key];
    }
};

inline UnitDescription described(const std::string& xml, int version) {
    UnitDescription d;
    std::vector<int>* list = nullptr;
    for (const UnitElement& e : elements_of(xml)) {
        if (e.name == "fmiModelDescription") d.model = e.attributes;
        if (e.name == "ScalarVariable" || e.name == "Float64") d.variables.push_back(e);
        if (e.name == "Real" && !d.variables.empty())
            d.variables.back().attributes.insert(e.attributes.begin(), e.attributes.end());
        const std::map<std::string, std::vector<int>*> lists{
            {"Outputs", &d.outputs},         {"Output", &d.outputs},
            {"Derivatives", &d.rates},       {"ContinuousStateDerivative", &d.rates},
            {"InitialUnknowns", &d.initial}, {"InitialUnknown", &d.initial},
            {"EventIndicator", &d.events}};
        if (const auto found = lists.find(e.name); found != lists.end()) list = found->second;
        if (e.name == "Unknown") list->push_back(std::stoi(e["index"]) - 1);
        if (version == 3 && lists.contains(e.name)) list->push_back(std::stoi(e["valueReference"]));
    }
    for (std::size_t k = 0; k < d.variables.size(); ++k)
        d.reference[d.variables[k]["name"]] = static_cast<unsigned>(std::stoul(d.variables[k]["valueReference"]));
    return d;
}

/// The rules of the description, as far as they can be listed.
inline void check_rules(const std::string& xml, int version) {
    const UnitDescription d = described(xml, version);
    const int first = version == 2 ? 1 : 0;
    CHECK(d.reference.size() == d.variables.size());  // names are unique
    std::set<std::string> units, types;
    for (const UnitElement& e : elements_of(xml)) {
        if (e.name == "Unit") units.insert(e["name"]);
        if (e.name == "SimpleType" || e.name == "Float64Type") types.insert(e["name"]);
        if (!e.has("dependencies")) continue;
        const std::vector<int> known = whole_numbers_of(e["dependencies"]);
        CHECK(std::is_sorted(known.begin(), known.end()));
        for (const int k : known) {
            const std::string causality = d.variables.at(static_cast<std::size_t>(k - first))["causality"];
            const bool is_state = d.variables[static_cast<std::size_t>(k - first)]["initial"] == "exact";
            CHECK((causality == "independent" || causality == "input" || is_state));
        }
    }
    std::set<int> outputs, unknowns;
    for (std::size_t k = 0; k < d.variables.size(); ++k) {
        const UnitElement& v = d.variables[k];
        CAPTURE(v["name"]);
        CHECK(v["valueReference"] == std::to_string(k));
        CHECK((v["unit"].empty() || units.contains(v["unit"])));
        CHECK((v["declaredType"].empty() || types.contains(v["declaredType"])));
        CHECK(v["name"].find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.(),") ==
              std::string::npos);
        const std::string kind = v["causality"] + " " + v["variability"] + " " + v["initial"];
        CHECK(std::set<std::string>{"independent continuous ", "input continuous ", "parameter tunable exact",
                                    "parameter fixed exact", "output continuous exact",
                                    "output continuous calculated", "local continuous exact",
                                    "local continuous calculated"}
                  .contains(kind));
        CHECK(v.has("start") == (v["initial"] == "exact" || v["causality"] == "input"));
        if (v["causality"] == "output") outputs.insert(static_cast<int>(k));
        if (v["causality"] == "output" && v["initial"] == "calculated") unknowns.insert(static_cast<int>(k));
    }
    for (const int rate : d.rates) {
        const UnitElement& v = d.variables.at(static_cast<std::size_t>(rate));
        REQUIRE(v.has("derivative"));
        CHECK(d.variables.at(static_cast<std::size_t>(std::stoi(v["derivative"]) - first))["initial"] == "exact");
        if (v["initial"] == "calculated") unknowns.insert(rate);
    }
    CHECK(std::set<int>(d.outputs.begin(), d.outputs.end()) == outputs);
    CHECK(d.initial == std::vector<int>(unknowns.begin(), unknowns.end()));
    if (version == 2) CHECK(std::stoul(d.model.at("numberOfEventIndicators")) + 1 > d.events.size());
}

}  // namespace alembert::test
