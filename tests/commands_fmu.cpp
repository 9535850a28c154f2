// SPDX-License-Identifier: MIT
// Functional mock-up units, held by a master of our own: the archive is read, its description is held against the
// rules of FMI 2.0.4 (§2.2) and 3.0 (§2.4), the binary is loaded, and its motions, by model exchange and by
// co-simulation, are compared with those of `simulate`.
#include <dlfcn.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "archives.hpp"
#include "files.hpp"
#include "shell.hpp"

namespace commands_fmu {

using alembert::test::contents;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using alembert::test::unzipped;
using Json = nlohmann::json;
using Numbers = std::vector<double>;

namespace {

/// A new path each time: an object of the same path as one that is loaded would not be loaded.
std::string file_name(const std::string& name) {
    static int count = 0;
    return fmt::format("{}/{}", alembert::test::temporary_folder(fmt::format("units-{}", count++)), name);
}

struct Element {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::string operator[](const std::string& key) const {
        const auto found = attributes.find(key);
        return found == attributes.end() ? std::string() : found->second;
    }
    bool has(const std::string& key) const { return attributes.contains(key); }
};

/// The elements in the order in which they begin.
std::vector<Element> elements_of(const std::string& xml) {
    std::vector<Element> list;
    for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
        if (xml[at + 1] == '/' || xml[at + 1] == '?') continue;
        std::size_t here = xml.find_first_of(" />\n", at);
        Element e{.name = xml.substr(at + 1, here - at - 1), .attributes = {}};
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

std::vector<int> numbers_of(const std::string& list) {
    std::istringstream in(list);
    std::vector<int> result;
    for (int k = 0; in >> k;) result.push_back(k);
    return result;
}

/// A variable with the attributes of both of its elements, and the lists of ModelStructure by value references.
struct Description {
    std::map<std::string, std::string> model;
    std::vector<Element> variables;
    std::vector<int> outputs, rates, initial, events;
    std::map<std::string, unsigned> reference;
    std::string at(const std::string& name, const char* key) const {
        return variables.at(reference.at(name))[key];
    }
};

Description described(const std::string& xml, int version) {
    Description d;
    std::vector<int>* list = nullptr;
    for (const Element& e : elements_of(xml)) {
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
void check_rules(const std::string& xml, int version) {
    const Description d = described(xml, version);
    const int first = version == 2 ? 1 : 0;
    CHECK(d.reference.size() == d.variables.size());  // names are unique
    std::set<std::string> units, types;
    for (const Element& e : elements_of(xml)) {
        if (e.name == "Unit") units.insert(e["name"]);
        if (e.name == "SimpleType" || e.name == "Float64Type") types.insert(e["name"]);
        if (!e.has("dependencies")) continue;
        const std::vector<int> known = numbers_of(e["dependencies"]);
        CHECK(std::is_sorted(known.begin(), known.end()));
        for (const int k : known) {
            const std::string causality = d.variables.at(static_cast<std::size_t>(k - first))["causality"];
            const bool is_state = d.variables[static_cast<std::size_t>(k - first)]["initial"] == "exact";
            CHECK((causality == "independent" || causality == "input" || is_state));
        }
    }
    std::set<int> outputs, unknowns;
    for (std::size_t k = 0; k < d.variables.size(); ++k) {
        const Element& v = d.variables[k];
        CAPTURE(v["name"]);
        CHECK(v["valueReference"] == std::to_string(k));
        CHECK((v["unit"].empty() || units.contains(v["unit"])));
        CHECK((v["declaredType"].empty() || types.contains(v["declaredType"])));
        CHECK(v["name"].find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.(),") ==
              std::string::npos);
        const std::string kind = v["causality"] + " " + v["variability"] + " " + v["initial"];
        CHECK(std::set<std::string>{"independent continuous ", "input continuous ", "parameter tunable exact",
                                    "output continuous exact", "output continuous calculated",
                                    "local continuous exact", "local continuous calculated"}
                  .contains(kind));
        CHECK(v.has("start") == (v["initial"] == "exact" || v["causality"] == "input"));
        if (v["causality"] == "output") outputs.insert(static_cast<int>(k));
        if (v["causality"] == "output" && v["initial"] == "calculated") unknowns.insert(static_cast<int>(k));
    }
    for (const int rate : d.rates) {
        const Element& v = d.variables.at(static_cast<std::size_t>(rate));
        REQUIRE(v.has("derivative"));
        CHECK(d.variables.at(static_cast<std::size_t>(std::stoi(v["derivative"]) - first))["initial"] == "exact");
        if (v["initial"] == "calculated") unknowns.insert(rate);
    }
    CHECK(std::set<int>(d.outputs.begin(), d.outputs.end()) == outputs);
    CHECK(d.initial == std::vector<int>(unknowns.begin(), unknowns.end()));
    if (version == 2) CHECK(std::stoul(d.model.at("numberOfEventIndicators")) + 1 > d.events.size());
}

/// An exported scene: archive, description, library.
struct Unit {
    std::string archive;
    std::map<std::string, std::string> files;
    Description description;
    int version = 2;
    void* library = nullptr;
    std::string token;

    Unit(const std::string& scene, int fmi) : version(fmi) {
        const std::string file = file_name("unit.fmu");
        const auto made = run({"fmu", scene, "-o", file, "--fmi", std::to_string(fmi), "--json"});
        REQUIRE_MESSAGE(made.exit == 0, made.err);
        token = Json::parse(made.out)["token"];
        archive = contents(file);
        files = unzipped(archive);
        description = described(files.at("modelDescription.xml"), fmi);
        for (const auto& [name, bytes] : files)
            if (name.starts_with("binaries/")) {
                const std::string object = file_name("unit.so");
                std::ofstream(object, std::ios::binary) << bytes;
                library = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
            }
        REQUIRE((library != nullptr));
    }
    Unit(const Unit&) = delete;
    Unit& operator=(const Unit&) = delete;
    ~Unit() { dlclose(library); }

    template <typename Result = int, typename... T>
    Result call(const std::string& name, T... values) const {
        auto* const function = reinterpret_cast<Result (*)(T...)>(dlsym(library, name.c_str()));
        if (function == nullptr) FAIL("the unit has no function ", name);
        return function(values...);
    }
};

const Unit& cart(int version) {
    static const Unit two(source_path("scenes/textbook/cart_pole.toml"), 2),
        three(source_path("scenes/textbook/cart_pole.toml"), 3);
    return version == 2 ? two : three;
}

/// One instance of a unit, by either version of the interface.
class Instance {
public:
    Instance(const Unit& unit, bool co_simulation, double tolerance = 0) : unit_(unit) {
        const char *name = "one", *token = unit.token.c_str(), *nowhere = nullptr;
        if (unit.version == 2) {
            me_ = unit.call<void*>("fmi2Instantiate", name, co_simulation ? 1 : 0, token, nowhere,
                                   static_cast<const void*>(callbacks_), 0, 0);
            REQUIRE((me_ != nullptr));
            ok("fmi2SetupExperiment", tolerance > 0 ? 1 : 0, tolerance, 0.0, 0, 0.0);
        } else if (co_simulation) {
            me_ = unit.call<void*>("fmi3InstantiateCoSimulation", name, token, nowhere, false, false, false, false,
                                   static_cast<const unsigned*>(nullptr), std::size_t{0},
                                   static_cast<void*>(nullptr), static_cast<void*>(nullptr),
                                   static_cast<void*>(nullptr));
        } else {
            me_ = unit.call<void*>("fmi3InstantiateModelExchange", name, token, nowhere, false, false,
                                   static_cast<void*>(nullptr), static_cast<void*>(nullptr));
        }
        REQUIRE((me_ != nullptr));
        tolerance_ = tolerance;
    }
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    ~Instance() { unit_.call<void>(prefix() + "FreeInstance", me_); }

    void begin() {
        if (unit_.version == 2)
            ok("fmi2EnterInitializationMode");
        else
            ok("fmi3EnterInitializationMode", tolerance_ > 0, tolerance_, 0.0, false, 0.0);
        ok(prefix() + "ExitInitializationMode");
    }
    double get(const std::string& name) const {
        const unsigned reference = unit_.description.reference.at(name);
        double value = NAN;
        if (unit_.version == 2)
            ok("fmi2GetReal", &reference, std::size_t{1}, &value);
        else
            ok("fmi3GetFloat64", &reference, std::size_t{1}, &value, std::size_t{1});
        return value;
    }
    void set(const std::string& name, double value) {
        const unsigned reference = unit_.description.reference.at(name);
        const double* const at = &value;
        if (unit_.version == 2)
            ok("fmi2SetReal", &reference, std::size_t{1}, at);
        else
            ok("fmi3SetFloat64", &reference, std::size_t{1}, at, std::size_t{1});
    }
    std::size_t states() const { return unit_.description.rates.size(); }
    Numbers state() const {
        Numbers x(states());
        ok(prefix() + "GetContinuousStates", x.data(), x.size());
        return x;
    }
    void at(double t, const Numbers& x) {
        ok(prefix() + "SetTime", t);
        ok(prefix() + "SetContinuousStates", x.data(), x.size());
    }
    Numbers rates() const {
        Numbers f(states());
        ok(unit_.version == 2 ? "fmi2GetDerivatives" : "fmi3GetContinuousStateDerivatives", f.data(), f.size());
        return f;
    }
    Numbers indicators() const {
        const auto& names = unit_.description.reference;
        Numbers z(static_cast<std::size_t>(std::count_if(
            names.begin(), names.end(), [](const auto& one) { return one.first.starts_with("event."); })));
        ok(prefix() + "GetEventIndicators", z.data(), z.size());
        return z;
    }
    /// Advances in co-simulation; true unless the unit has ended the simulation.
    bool step(double t, double h) {
        if (unit_.version == 2) {
            const int status = unit_.call("fmi2DoStep", me_, t, h, 1);
            CHECK(status != 3);
            return status == 0;
        }
        bool event = false, over = false, early = false;
        double last = 0;
        ok("fmi3DoStep", t, h, true, &event, &over, &early, &last);
        return !over;
    }
    double derivative(const std::string& of, const std::string& by) const {
        const unsigned unknown = unit_.description.reference.at(of), known = unit_.description.reference.at(by);
        const double seed = 1, *const s = &seed;
        double result = NAN;
        const std::size_t one = 1;
        if (unit_.version == 2)
            ok("fmi2GetDirectionalDerivative", &unknown, one, &known, one, s, &result);
        else
            ok("fmi3GetDirectionalDerivative", &unknown, one, &known, one, s, one, &result, one);
        return result;
    }
    /// Event mode; true if the simulation ends.
    bool update() {
        if (unit_.version == 3) {
            bool need = false, over = false, nominals = false, values = false, next = false;
            double when = 0;
            ok("fmi3UpdateDiscreteStates", &need, &over, &nominals, &values, &next, &when);
            return over;
        }
        struct {
            int need, over, nominals, values, next;
            double when;
        } info{};
        ok("fmi2NewDiscreteStates", static_cast<void*>(&info));
        return info.over != 0;
    }
    bool wants_event() {
        if (unit_.version == 3) {
            bool event = false, over = false;
            ok("fmi3CompletedIntegratorStep", true, &event, &over);
            return event;
        }
        int event = 0, over = 0;
        ok("fmi2CompletedIntegratorStep", 1, &event, &over);
        return event != 0;
    }
    template <typename... T>
    void ok(const std::string& name, T... values) const {
        if (unit_.call(name, me_, values...) != 0) FAIL("the call failed: ", name);
    }
    std::string prefix() const { return unit_.version == 2 ? "fmi2" : "fmi3"; }

private:
    const Unit& unit_;
    void* me_ = nullptr;
    double tolerance_ = 0;
    const void* callbacks_[5] = {};
};

/// Model exchange by the classical method of Runge and Kutta with `steps` steps; inputs are set at every time. A
/// step in which an indicator changes its sign ends behind the first change, found by bisection, with the event
/// mode. True if the unit ends the simulation.
bool exchange(Instance& one, double end, int steps, const std::function<void(double)>& drive = {}) {
    one.update();
    Numbers x = one.state(), before = one.indicators();
    const auto f = [&](double t, const Numbers& y) {
        one.at(t, y);
        if (drive) drive(t);
        return one.rates();
    };
    const auto moved = [&](const Numbers& y, double by, const Numbers& k) {
        Numbers result = y;
        for (std::size_t i = 0; i < y.size(); ++i) result[i] += by * k[i];
        return result;
    };
    const auto stepped = [&](double t, double h) {
        const Numbers a = f(t, x), b = f(t + h / 2, moved(x, h / 2, a)), c = f(t + h / 2, moved(x, h / 2, b)),
                      d = f(t + h, moved(x, h, c));
        Numbers y = x;
        for (std::size_t i = 0; i < x.size(); ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        one.at(t + h, y);
        if (drive) drive(t + h);
        return y;
    };
    const auto changes = [&] {
        const Numbers now = one.indicators();
        for (std::size_t k = 0; k < now.size(); ++k)
            if ((now[k] > 0) != (before[k] > 0)) return true;
        return false;
    };
    double t = 0;
    for (int n = 0; n < steps; ++n)
        for (const double next = end * (n + 1) / steps; t < next;) {
            double h = next - t, low = 0;
            Numbers y = stepped(t, h);
            const bool is_event = changes();
            if (is_event) {
                while (h - low > 1e-14) {
                    const double middle = (low + h) / 2;
                    stepped(t, middle);
                    (changes() ? h : low) = middle;
                }
                y = stepped(t, h);
            }
            x = y;
            t = is_event ? t + h : next;
            if (one.wants_event() || is_event) {
                if (one.update()) return true;
                x = one.state();
            }
            before = one.indicators();
        }
    return false;
}

Json simulated(const std::string& scene, double end) {
    const auto result =
        run({"simulate", scene, "--duration", fmt::format("{}", end), "--tolerance", "1e-12", "--json"});
    REQUIRE_MESSAGE(result.exit == 0, result.err);
    return Json::parse(result.out)["final"];
}

/// The largest difference of coordinates and rates, relative to max(1, |x|).
double difference(const Instance& one, const Json& final) {
    double worst = 0;
    for (const auto& [name, value] : final["coordinates"].items()) {
        const double x = value, v = final["rates"][name];
        worst = std::max({worst, std::abs(one.get(name) - x) / std::max(1.0, std::abs(x)),
                          std::abs(one.get("der(" + name + ")") - v) / std::max(1.0, std::abs(v))});
    }
    return worst;
}

}  // namespace

TEST_CASE("fmu: a unit of either version obeys the rules of its description and moves as simulate does") {
    const std::string scene = source_path("scenes/textbook/cart_pole.toml");
    const Json final = simulated(scene, 2);
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit& unit = cart(version);
        check_rules(unit.files.at("modelDescription.xml"), version);
        CHECK(unit.files.contains("sources/cart_pole.c"));
        CHECK(unit.files.contains("sources/buildDescription.xml") == (version == 3));
        CHECK(unit.description.at("F", "causality") == "input");
        CHECK(unit.description.at("der(theta)", "unit") == "rad/s");
        CHECK(unit.description.model.at("fmiVersion") == (version == 2 ? "2.0" : "3.0"));
        for (const auto& [name, bytes] : unit.files)
            CHECK_MESSAGE(bytes.find(std::filesystem::temp_directory_path().string() + "/") == std::string::npos,
                          name);

        Instance exchanged(unit, false);
        exchanged.begin();
        exchange(exchanged, 2, 4000);
        CHECK(difference(exchanged, final) < 1e-9);

        // Two instances at once; the second is saved in the middle and goes on from there after a detour.
        Instance one(unit, true, 1e-12), other(unit, true, 1e-12);
        one.begin();
        other.set("F", 0);
        other.begin();
        for (int k = 0; k < 20; ++k) {
            CHECK(one.step(0.1 * k, 0.1));
            CHECK(other.step(0.1 * k, 0.1));
        }
        CHECK(difference(one, final) < 1e-9);
        CHECK(difference(other, final) > 1e-3);
        CHECK(one.get("energy.total") ==
              doctest::Approx(one.get("energy.kinetic") + one.get("energy.potential")).epsilon(1e-14));
        CHECK(one.get("height") == doctest::Approx(0.5 * std::cos(one.get("theta"))).epsilon(1e-14));
        CHECK(one.get("F") == doctest::Approx(2 * std::cos(8.0)).epsilon(1e-14));
        CHECK(one.get("event.pole_level") == doctest::Approx(std::cos(one.get("theta"))).epsilon(1e-14));
    }
}

TEST_CASE("fmu: a state is saved, written as bytes and restored, and the motion repeats bit for bit") {
    const Unit& unit = cart(2);
    Instance one(unit, true), other(unit, true);
    one.begin();
    other.begin();
    one.step(0, 0.7);
    void* saved = nullptr;
    one.ok("fmi2GetFMUstate", &saved);
    std::size_t size = 0;
    one.ok("fmi2SerializedFMUstateSize", saved, &size);
    std::string bytes(size, '\0');
    one.ok("fmi2SerializeFMUstate", saved, bytes.data(), size);
    one.step(0.7, 0.4);
    const double there = one.get("theta");
    one.ok("fmi2SetFMUstate", saved);
    one.set("F", 3);
    one.step(0.7, 0.4);
    CHECK(one.get("theta") != there);
    one.ok("fmi2SetFMUstate", saved);
    one.step(0.7, 0.4);
    CHECK(one.get("theta") == there);
    one.ok("fmi2FreeFMUstate", &saved);
    CHECK(saved == nullptr);

    void* read = nullptr;
    other.ok("fmi2DeSerializeFMUstate", static_cast<const char*>(bytes.data()), size, &read);
    other.ok("fmi2SetFMUstate", read);
    other.ok("fmi2FreeFMUstate", &read);
    other.step(0.7, 0.4);
    CHECK(other.get("theta") == there);
    other.ok("fmi2Reset");
    CHECK(other.get("theta") == 0.15);

    // Another token is refused.
    const void* callbacks[5] = {};
    CHECK(unit.call<void*>("fmi2Instantiate", "one", 0, "{other}", static_cast<const char*>(nullptr),
                           static_cast<const void*>(callbacks), 0, 0) == nullptr);
}

TEST_CASE("fmu: directional derivatives agree with differences, by states, inputs and parameters") {
    const Unit& unit = cart(3);
    Instance one(unit, false);
    one.begin();
    one.set("theta", 0.4);
    one.set("der(theta)", -0.3);
    one.set("F", 1.7);
    for (const std::string of :
         {"der(x,2)", "der(theta,2)", "energy.total", "energy.power", "height", "power", "x"})
        for (const std::string by : {"x", "theta", "der(x)", "der(theta)", "F", "m", "l"}) {
            CAPTURE(of);
            CAPTURE(by);
            const double exact = one.derivative(of, by), here = one.get(by), h = 1e-5;
            one.set(by, here + h);
            const double above = one.get(of);
            one.set(by, here - h);
            const double below = one.get(of);
            one.set(by, here);
            // The difference is off by h² times a third derivative, and by rounding over h.
            CHECK(exact == doctest::Approx((above - below) / (2 * h)).epsilon(1e-6));
        }
}

TEST_CASE("fmu: inputs and the rates that the equations need can be set, and given functions come back") {
    const std::string scene = temporary("support.toml", R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
a = 0.1
[inputs]
s = { value = "a*sin(5*t)", unit = "m" }
[coordinates]
phi = { initial = 0.5, unit = "rad" }
[[particle]]
name = "bob"
mass = 2
position = ["s + sin(phi)", "-cos(phi)"]
[outputs]
speed = "dot(vel(bob), vel(bob))"
)toml");
    const Json final = simulated(scene, 1);
    const Unit unit(scene, 2);
    // The equation has s'', the energy s'; each input is set to what the scene has.
    Instance given(unit, false);
    given.begin();
    exchange(given, 1, 1000, [&](double t) {
        given.set("s", 0.1 * std::sin(5 * t));
        given.set("der(s)", 0.5 * std::cos(5 * t));
        given.set("der(s,2)", -2.5 * std::sin(5 * t));
    });
    CHECK(difference(given, final) < 1e-9);
    CHECK(given.get("der(s)") == doctest::Approx(0.5 * std::cos(5.0)).epsilon(1e-14));

    // The scene's own function, with its amplitude tuned.
    Instance tuned(unit, true, 1e-12);
    tuned.set("a", 0);
    tuned.begin();
    tuned.step(0, 1);
    CHECK(tuned.get("s") == 0);
    CHECK(difference(tuned, final) > 1e-3);

    // In co-simulation an input follows the derivatives that it is given: s = t²/2 needs one step only.
    Instance followed(unit, true, 1e-12), wanted(unit, false);
    const unsigned s = unit.description.reference.at("s");
    followed.set("s", 0);
    const int order = 2, *const orders = &order;
    const double second = 1, *const values = &second;
    followed.ok("fmi2SetRealInputDerivatives", &s, std::size_t{1}, orders, values);
    followed.begin();
    followed.step(0, 1);
    wanted.begin();
    exchange(wanted, 1, 1000, [&](double t) {
        wanted.set("s", t * t / 2);
        wanted.set("der(s)", t);
        wanted.set("der(s,2)", 1);
    });
    CHECK(followed.get("phi") == doctest::Approx(wanted.get("phi")).epsilon(1e-9));
    CHECK(followed.get("s") == doctest::Approx(0.5).epsilon(1e-14));
}

TEST_CASE("fmu: constraints stay satisfied, and the same scene gives the same bytes") {
    const std::string scene = source_path("scenes/textbook/slider_crank.toml"), again = file_name("again.fmu");
    const Json final = simulated(scene, 1);
    const Unit unit(scene, 2);
    check_rules(unit.files.at("modelDescription.xml"), 2);
    Instance one(unit, true, 1e-12), exchanged(unit, false, 1e-12);
    one.begin();
    one.step(0, 1);
    CHECK(difference(one, final) < 1e-9);
    exchanged.begin();
    exchange(exchanged, 1, 4000);
    CHECK(difference(exchanged, final) < 1e-9);
    CHECK(one.get("x") ==
          doctest::Approx(0.15 * std::cos(one.get("alpha")) + 0.4 * std::cos(one.get("beta"))).epsilon(1e-12));
    // A longer rod: the start values do not fit, and are brought to the constraints.
    Instance longer(unit, true, 1e-12);
    longer.set("l", 0.45);
    longer.begin();
    CHECK(longer.get("x") ==
          doctest::Approx(0.15 * std::cos(longer.get("alpha")) + 0.45 * std::cos(longer.get("beta")))
              .epsilon(1e-14));
    REQUIRE(run({"fmu", scene, "-o", again}).exit == 0);
    CHECK(contents(again) == unit.archive);
}

TEST_CASE("fmu: events with impulses, events that end the run, and kinks are followed") {
    const std::string scene = temporary("court.toml", R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
m = 0.5
k = 40
[coordinates]
x = 0.2
y = { initial = 1, rate = 0.3 }
[[particle]]
name = "ball"
mass = "m"
position = ["x", "y"]
[forces]
x = "-k*x - 0.7*sign(x)"
[[event]]
name = "floor"
when = "y"
direction = "down"
impulses = { y = "-1.8*m*y'" }
[[event]]
name = "out"
when = "t - 1.75"
stop = true
)toml");
    const Json final = simulated(scene, 3);
    CHECK(final["time"] == doctest::Approx(1.75).epsilon(1e-12));
    const Unit unit(scene, 2);
    Instance one(unit, true, 1e-12);
    one.begin();
    bool goes_on = true;
    for (int k = 0; k < 30 && goes_on; ++k) goes_on = one.step(0.1 * k, 0.1);
    CHECK(!goes_on);
    CHECK(one.get("time") == doctest::Approx(1.75).epsilon(1e-12));
    CHECK(difference(one, final) < 1e-9);
    Instance exchanged(unit, false);
    exchanged.begin();
    CHECK(exchange(exchanged, 3, 6000));
    CHECK(exchanged.get("time") == doctest::Approx(1.75).epsilon(1e-12));
    CHECK(difference(exchanged, final) < 1e-9);
}

TEST_CASE("fmu: what a unit cannot follow is refused, with what to do") {
    const auto refused = [](const char* scene, const char* words) {
        const auto result = run({"fmu", source_path(scene), "-o", file_name("none.fmu")});
        CHECK(result.exit == 3);
        CHECK_MESSAGE(result.err.find(words) != std::string::npos, result.err);
    };
    refused("scenes/textbook/bouncing_ball.toml", "[[unilateral]]");
    refused("scenes/friction/block_on_slope.toml", "[[friction]]");
    const auto named = run({"fmu", source_path("scenes/textbook/slider_crank.toml"), "-o", file_name("unit.zip")});
    CHECK(named.exit == 3);
    CHECK(named.err.find("call it NAME.fmu") != std::string::npos);
}

}  // namespace commands_fmu
