// SPDX-License-Identifier: MIT
// The same scene through the command line, the C++ library, Python and a functional mock-up unit: the same end,
// and the same message for a wrong scene.
//
// The first three run the same code, and their ends are equal bit for bit. The unit is C of its own; in model
// exchange its rates are integrated here with the method and tolerance of the others, so that only rounding
// differs.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <fstream>
#include <optional>

#include "alembert/ode/integrate.hpp"
#include "analysis/state/prepared.hpp"
#include "by_python.hpp"
#include "files.hpp"
#include "fmu_master.hpp"
#include "shell.hpp"
#include "simulate/fmu/unit.hpp"
#include "simulate/simulate.hpp"

namespace generator_four_ways {

using namespace alembert;
using namespace alembert::test;

namespace {

constexpr double duration = 2, tolerance = 1e-13;

/// Coordinates, then rates, at the end.
using End = std::vector<double>;

struct Scenario {
    std::string scene;
    std::vector<std::string> coordinates = {};
    End library = {};
};

End by_library(Scenario& one) {
    const alembert::Run run =
        simulate(read_scene(one.scene),
                 {.method = "dop853", .duration = duration, .tolerance = tolerance, .estimate = false});
    REQUIRE(!run.failure);
    one.coordinates = run.coordinates;
    End end = run.final_coordinates;
    end.insert(end.end(), run.final_rates.begin(), run.final_rates.end());
    return end;
}

/// The numbers of a text, separated by white space.
End numbers_in(const std::string& text) {
    std::istringstream in(text);
    End result;
    for (double x = 0; in >> x;) result.push_back(x);
    return result;
}

/// The last row of the table, which has as many columns as asked for after the time.
End by_command_line(const Scenario& one) {
    const std::string table = temporary("end.csv", "");
    const auto told =
        test::run({"simulate", one.scene, "--method", "dop853", "--duration", fmt::format("{}", duration),
                   "--tolerance", fmt::format("{}", tolerance), "--no-estimate", "-o", table});
    REQUIRE_MESSAGE(told.exit == 0, told.err);
    std::string text = contents(table);
    text.erase(text.find_last_not_of('\n') + 1);
    std::string row = text.substr(text.rfind('\n') + 1);
    std::replace(row.begin(), row.end(), ',', ' ');
    End end = numbers_in(row);
    end.erase(end.begin());
    end.resize(2 * one.coordinates.size());
    return end;
}

/// Model exchange, by the integrator of the others.
End by_unit(const Scenario& one) {
    const FunctionalUnit exported = functional_unit(read_scene(one.scene), {});
    const Unit unit(exported.archive, exported.token, 2);
    Instance instance(unit, false);
    instance.begin();
    instance.update();
    const Numbers start = instance.state();
    const int size = static_cast<int>(start.size());
    const auto rates = [&](double t, const double* y, double* rate) {
        instance.at(t, Numbers(y, y + size));
        const Numbers f = instance.rates();
        std::copy(f.begin(), f.end(), rate);
    };
    System system{.rhs = make_rhs(size, rates)};
    if (!prepared(read_scene(one.scene)).mechanism.constraints.empty())
        system.project = [&](double t, double* y) {
            instance.at(t, Numbers(y, y + size));
            if (instance.wants_event()) instance.update();
            const Numbers kept = instance.state();
            std::copy(kept.begin(), kept.end(), y);
        };
    const Trajectory motion = integrate(
        system, start, {.method = Method::dop853, .duration = duration, .tolerance = tolerance, .sample = 0.01});
    REQUIRE(!motion.failure);
    const auto last = motion.final_state();
    instance.at(duration, Numbers(last.begin(), last.end()));
    End end;
    for (const char* name : {"{}", "der({})"})
        for (const std::string& q : one.coordinates)
            end.push_back(instance.get(fmt::format(fmt::runtime(name), q)));
    return end;
}

double largest_difference(const End& a, const End& b) {
    REQUIRE(a.size() == b.size());
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, std::abs(a[i] - b[i]) / std::max(1.0, std::abs(b[i])));
    return worst;
}

}  // namespace

TEST_CASE("four ways: a scene ends the same by command line, library, Python and functional mock-up unit") {
    std::vector<Scenario> list;
    for (const char* name : {"double_pendulum", "cart_pole", "slider_crank", "watt_governor", "heavy_top"})
        list.push_back({source_path(fmt::format("scenes/textbook/{}.toml", name))});
    std::string code;
    for (Scenario& one : list) {
        one.library = by_library(one);
        code += fmt::format(
            "f = alembert.Scene('{}').simulate(2, 1e-13, method='dop853', estimate=False).final\n"
            "print(*f['coordinates'].values(), *f['rates'].values())\n",
            one.scene);
    }
    for (const Scenario& one : list) {
        CAPTURE(one.scene);
        CHECK(by_command_line(one) == one.library);
        CHECK(largest_difference(by_unit(one), one.library) < 1e-12);
    }
    const std::optional<std::string> printed = by_python(code);
    if (!printed) {
        MESSAGE("the Python package is not there: three ways were compared");
        return;
    }
    std::istringstream lines(*printed);
    for (const Scenario& one : list) {
        std::string line;
        std::getline(lines, line);
        CAPTURE(one.scene);
        CHECK(numbers_in(line) == one.library);
    }
}

TEST_CASE("four ways: a wrong scene gives the same message by each") {
    const std::string good =
        "[coordinates]\nx = { initial = 1, rate = 0 }\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
        "position = [\"x\", 0]\n[parameters]\nm = 1\n";
    const std::pair<const char*, std::string> wrong[] = {
        {"syntax.toml", "[coordinates\n"},
        {"unknown.toml", good + "[forces]\nx = \"-k*x\"\n"},
        {"two.toml", "[coordinates]\nx = \"a\"\ny = 1\ny = 2\n"},
        {"mass.toml", "[coordinates]\nx = 0\ny = 0\n[energy]\nkinetic = \"x'^2\"\npotential = \"0\"\n"},
        {"apart.toml", good + "[[constraint]]\nname = \"far\"\nposition = \"x^2 + 1\"\n"}};
    std::string code, expected;
    for (const auto& [name, text] : wrong) {
        CAPTURE(name);
        const std::string file = temporary(name, text);
        std::string message;
        const auto caught = [&](const auto& function) {
            std::string what = "nothing was wrong";
            try {
                function();
            } catch (const SceneError& e) {
                what = e.what();
            } catch (const ModelError& e) {
                what = fmt::format("{}: {}", file, e.what());
            } catch (const IntegrationError& e) {
                what = fmt::format("{}: {}", file, e.what());
            }
            return what;
        };
        message = caught([&] { simulate(read_scene(file), {}); });
        CHECK(message != "nothing was wrong");
        const std::string with_end = message + (message.ends_with('\n') ? "" : "\n");
        CHECK(caught([&] { functional_unit(read_scene(file), {}); }) == message);
        for (const std::vector<std::string>& command :
             {std::vector<std::string>{"simulate", file}, {"fmu", file, "-o", temporary("none.fmu", "")}}) {
            const auto told = test::run(command);
            CHECK((told.exit == 3 || told.exit == 4));
            CHECK(told.err == with_end);
        }
        code += fmt::format(
            "try:\n    alembert.Scene('{0}').simulate()\nexcept alembert.Error as e:\n"
            "    said = str(e) if isinstance(e, alembert.SceneError) else '{0}: ' + str(e)\n"
            "    print(said, end='' if said.endswith('\\n') else '\\n')\n",
            file);
        expected += with_end;
    }
    if (const std::optional<std::string> printed = by_python(code)) CHECK(*printed == expected);
}

}  // namespace generator_four_ways
