// SPDX-License-Identifier: MIT
#pragma once

/// A master for functional mock-up units: it loads the binary of one and calls it by FMI 2.0 or 3.0.
///
///     const Unit unit(archive, token, 2);
///     Instance one(unit, true, 1e-12);          // co-simulation
///     one.begin();
///     one.step(0, 0.1);
///     one.get("theta");

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "archives.hpp"
#include "unit_description.hpp"

namespace alembert::test {

using Numbers = std::vector<double>;

constexpr int discarded = 2, failed = 3;  ///< of the status that both versions return

/// An exported scene: archive, description, library.
struct Unit {
    std::string archive;
    std::map<std::string, std::string> files;
    UnitDescription description = {};
    int version = 2;
    void* library = nullptr;
    std::string token;

    /// The library is written to a new path: an object of the path of one that is loaded would not be loaded.
    Unit(std::string bytes, std::string its_token, int fmi)
        : archive(std::move(bytes)), files(unzipped(archive)), version(fmi), token(std::move(its_token)) {
        static int count = 0;
        description = described(files.at("modelDescription.xml"), fmi);
        for (const auto& [name, content] : files)
            if (name.starts_with("binaries/")) {
                const std::string object = (std::filesystem::temp_directory_path() /
                                            fmt::format("alembert-unit-{}-{}.so", getpid(), count++))
                                               .string();
                std::ofstream(object, std::ios::binary) << content;
                library = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
                std::filesystem::remove(object);
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
    void set(const std::string& name, double value) { CHECK(status_of_set(name, value) == 0); }
    int status_of_set(const std::string& name, double value) const {
        const unsigned reference = unit_.description.reference.at(name);
        const double* const at = &value;
        if (unit_.version == 2) return status("fmi2SetReal", &reference, std::size_t{1}, at);
        return status("fmi3SetFloat64", &reference, std::size_t{1}, at, std::size_t{1});
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
        const int result = step_status(t, h);
        CHECK(result != failed);
        return result == 0 && !over_;
    }
    int step_status(double t, double h) {
        if (unit_.version == 2) return status("fmi2DoStep", t, h, 1);
        bool event = false, early = false;
        double last = 0;
        return status("fmi3DoStep", t, h, true, &event, &over_, &early, &last);
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
    /// Event mode, and back to continuous time; true if the simulation ends.
    bool update() {
        if (is_continuous_) ok(prefix() + "EnterEventMode");
        is_continuous_ = false;
        const bool over = in_event_mode();
        if (over) return true;
        ok(prefix() + "EnterContinuousTimeMode");
        is_continuous_ = true;
        return false;
    }
    bool in_event_mode() {
        bool over = false;
        if (status_in_event_mode(over) != 0) FAIL("the call failed: new discrete states");
        return over;
    }
    int status_in_event_mode(bool& over) {
        if (unit_.version == 3) {
            bool need = false, nominals = false, values = false, next = false;
            double when = 0;
            const int result = status("fmi3UpdateDiscreteStates", &need, &over, &nominals, &values, &next, &when);
            next_event_ = next ? when : HUGE_VAL;
            return result;
        }
        struct {
            int need, over, nominals, values, next;
            double when;
        } info{};
        const int result = status("fmi2NewDiscreteStates", static_cast<void*>(&info));
        next_event_ = info.next != 0 ? info.when : HUGE_VAL;
        over = info.over != 0;
        return result;
    }
    /// The time of the next event that the unit has told; HUGE_VAL if it has told none.
    double next_event() const { return next_event_; }
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
    int status(const std::string& name, T... values) const {
        return unit_.call(name, me_, values...);
    }
    template <typename... T>
    void ok(const std::string& name, T... values) const {
        if (status(name, values...) != 0) FAIL("the call failed: ", name);
    }
    std::string prefix() const { return unit_.version == 2 ? "fmi2" : "fmi3"; }

private:
    const Unit& unit_;
    void* me_ = nullptr;
    double tolerance_ = 0, next_event_ = HUGE_VAL;
    bool over_ = false, is_continuous_ = false;
    const void* callbacks_[5] = {};
};

/// Model exchange by the classical method of Runge and Kutta with `steps` steps; inputs are set at every time. A
/// step in which an indicator changes its sign ends behind the first change, found by bisection, with the event
/// mode. True if the unit ends the simulation.
inline bool exchange(Instance& one, double end, int steps, const std::function<void(double)>& drive = {}) {
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

}  // namespace alembert::test
