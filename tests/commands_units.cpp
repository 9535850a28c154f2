// SPDX-License-Identifier: MIT
// Contacts and friction do not depend on the units in which a scene is written: the same modes in the same order,
// at the same times.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "contacts.hpp"
#include "files.hpp"

namespace commands_units {

using namespace alembert::test;

namespace {

/// How many new units of length, time and mass make a metre, a second and a kilogram.
struct Units {
    double length, time, mass;

    /// How many new units make one of these: "kg*m^2/s".
    double of(const std::string& unit) const {
        const std::map<std::string, double> base{
            {"m", length}, {"s", time}, {"kg", mass}, {"N", mass * length / (time * time)}, {"rad", 1}, {"1", 1}};
        double result = 1;
        int sign = 1;
        const std::regex part(R"(([*/])|([a-zA-Z]+|1)(?:\^(\d+))?)");
        for (std::sregex_iterator at(unit.begin(), unit.end(), part), end; at != end; ++at) {
            if ((*at)[1].matched)
                sign = (*at)[1] == "/" ? -1 : 1;
            else
                result *= std::pow(base.at((*at)[2]), sign * ((*at)[3].matched ? std::stoi((*at)[3]) : 1));
        }
        return result;
    }
};

/// The line with the number after `key = ` multiplied.
std::string multiplied(const std::string& line, const std::string& key, double factor) {
    const std::regex number("(^| )" + key + R"( *= *(-?[0-9.]+(?:e-?[0-9]+)?)(?=[, }]|$))");
    std::smatch found;
    if (!std::regex_search(line, found, number)) return line;
    return found.prefix().str() + found[1].str() + key + fmt::format(" = {:.17g}", std::stod(found[2]) * factor) +
           found.suffix().str();
}

std::string in_units(const std::string& scene, const Units& units) {
    std::istringstream lines(scene);
    std::string result;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("shape")) continue;  // it has lengths in metres
        static const std::regex unit("unit = \"([^\"]*)\"");
        std::smatch found;
        if (std::regex_search(line, found, unit)) {
            const double factor = units.of(found[1]);
            line = multiplied(line, "value", factor);
            line = multiplied(line, "initial", factor);
            line = multiplied(line, "rate", factor / units.time);
        }
        for (const char* const key : {"duration", "sample", "max_step"}) line = multiplied(line, key, units.time);
        result += line + "\n";
    }
    return result;
}

}  // namespace

TEST_CASE("units: contacts and friction are the same in other units of length, time and mass") {
    // Millimetres; kiloseconds; both with grams; milliseconds; kilometres.
    const std::vector<Units> all{{1e3, 1, 1}, {1, 1e-3, 1}, {1e3, 1e-3, 1e3}, {1, 1e3, 1}, {1e-3, 1, 1}};
    for (const char* const name :
         {"sliding_coin", "spinning_ball", "billiard_ball", "braking_box", "puck_on_slope", "rocking_block",
          "ladder", "block_on_slope", "superball", "falling_tripod"}) {
        const std::string scene = contents(source_path(fmt::format("scenes/friction/{}.toml", name)));
        const auto run_of = [&](const Units& units) {
            return simulated(temporary(std::string(name) + "_units.toml", in_units(scene, units)),
                             {"--tolerance", "1e-12"});
        };
        const Json exact = run_of({1, 1, 1});
        for (const Units& units : all) {
            const Json motion = run_of(units);
            INFO(std::string(name) << " in " << 1 / units.length << " m, " << 1 / units.time << " s, "
                                   << 1 / units.mass << " kg: " << motion["contacts"].dump() << " and "
                                   << exact["contacts"].dump());
            REQUIRE(motion["contacts"].size() == exact["contacts"].size());
            // A step is off by 1e-12 of max(1, |y|), which is 1e-9 where the unit is a thousand times larger.
            const double duration = exact["final"]["time"].get<double>(), off = 1e-9 * duration;
            for (std::size_t k = 0; k < exact["contacts"].size(); ++k) {
                const Json &event = motion["contacts"][k], &other = exact["contacts"][k];
                for (const char* const key : {"event", "name", "side"})
                    CHECK(event.value(key, Json()) == other.value(key, Json()));
                CHECK(std::abs(value(event, "time") / units.time - value(other, "time")) < off);
            }
            // Where length and time are both smaller units, W begins at 0 with numbers 10¹⁵ times as large, which
            // a step may be off by 1e-12.
            if (units.mass == 1) CHECK(motion["steps"].get<long>() < 4 * exact["steps"].get<long>());
        }
    }
}

}  // namespace commands_units
