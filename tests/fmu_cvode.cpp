// SPDX-License-Identifier: MIT
// Units in model exchange under CVODE of SUNDIALS, whose search for roots is that of FMPy and other importers.
// What happens is compared with `simulate`, which has another integrator and another search, and with closed
// forms.
#include <cvode/cvode.h>
#include <doctest/doctest.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "fmu_exports.hpp"
#include "sundials_context.hpp"

namespace fmu_cvode {

using namespace alembert::test;

namespace {

/// CVODE with the functions of an instance.
class Integrator {
public:
    Integrator(Instance& one, int watched, double tolerance)
        : one_(one), watched_(watched), size_(static_cast<sunindextype>(one.states())) {
        context_ = alembert::quiet_context();
        y_ = N_VNew_Serial(size_, context_);
        matrix_ = SUNDenseMatrix(size_, size_, context_);
        solver_ = SUNLinSol_Dense(y_, matrix_, context_);
        memory_ = CVodeCreate(CV_BDF, context_);
        take();
        CVodeInit(memory_, rates, 0, y_);
        CVodeSStolerances(memory_, tolerance, tolerance);
        CVodeSetLinearSolver(memory_, solver_, matrix_);
        CVodeSetUserData(memory_, this);
        CVodeSetMaxNumSteps(memory_, 1000000);
        if (watched_ > 0) CVodeRootInit(memory_, watched_, indicators);
    }
    Integrator(const Integrator&) = delete;
    Integrator& operator=(const Integrator&) = delete;
    ~Integrator() {
        CVodeFree(&memory_);
        SUNLinSolFree(solver_);
        SUNMatDestroy(matrix_);
        N_VDestroy(y_);
        SUNContext_Free(&context_);
    }

    /// Goes on to `next` or to a root, as FMPy does: past the time in steps of its own, and back by interpolation.
    bool finds_root(double& t, double next) {
        const int flag = CVode(memory_, next, y_, &t, CV_NORMAL);
        REQUIRE(flag >= 0);
        one_.at(t, state());
        return flag == CV_ROOT_RETURN;
    }
    void begin_again(double t) {
        take();
        CVodeReInit(memory_, t, y_);
    }

private:
    Numbers state() const { return of(y_); }
    Numbers of(N_Vector v) const {
        const double* const x = N_VGetArrayPointer(v);
        return {x, x + size_};
    }
    void take() {
        const Numbers x = one_.state();
        std::copy(x.begin(), x.end(), N_VGetArrayPointer(y_));
    }
    static int rates(sunrealtype t, N_Vector y, N_Vector rate, void* me) {
        const auto& self = *static_cast<const Integrator*>(me);
        self.one_.at(t, self.of(y));
        const Numbers f = self.one_.rates();
        std::copy(f.begin(), f.end(), N_VGetArrayPointer(rate));
        return 0;
    }
    static int indicators(sunrealtype t, N_Vector y, sunrealtype* out, void* me) {
        const auto& self = *static_cast<const Integrator*>(me);
        self.one_.at(t, self.of(y));
        const Numbers z = self.one_.indicators();
        std::copy(z.begin(), z.end(), out);
        return 0;
    }

    Instance& one_;
    int watched_;
    sunindextype size_;
    SUNContext context_ = nullptr;
    N_Vector y_ = nullptr;
    SUNMatrix matrix_ = nullptr;
    SUNLinearSolver solver_ = nullptr;
    void* memory_ = nullptr;
};

struct Ended {
    double time = 0;
    int roots = 0, known = 0;  ///< events that the search found, and that the unit had told
};

/// To `end`, in pieces of `interval`, but none as short as rounding. After each event no indicator may be zero.
Ended follow(Instance& one, double end, double interval, double tolerance = 1e-9) {
    Ended ended;
    double& t = ended.time;
    if (one.update()) return ended;
    const auto watched = static_cast<int>(one.indicators().size());
    Integrator by(one, watched, tolerance);
    for (int n = 1; end - t > 1e-12;) {
        const double told = one.next_event(), next = std::min({n * interval, end, told});
        REQUIRE(next > t);
        const bool is_root = by.finds_root(t, next), is_told = t >= told;
        while (n * interval - t <= 1e-12) ++n;
        if (!one.wants_event() && !is_root && !is_told) continue;
        ended.roots += is_root ? 1 : 0;
        ended.known += is_told ? 1 : 0;
        if (one.update()) return ended;
        for (const double z : one.indicators()) CHECK(z != 0);
        by.begin_again(t);
    }
    return ended;
}

constexpr const char* particle = R"toml([coordinates]
x = {{ initial = {}, rate = {} }}
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
{}
)toml";

std::string scene_of(double x, double v, const std::string& rest) {
    return temporary("unit.toml", fmt::format(particle, x, v, rest));
}

std::string force(const std::string& f) {
    return "[forces]\nx = \"" + f + "\"\n";
}

std::string kick(const std::string& when, const std::string& impulse, const std::string& more = "") {
    static int count = 0;
    return fmt::format("[[event]]\nname = \"e{}\"\nwhen = \"{}\"\nimpulses = {{ x = \"{}\" }}\n{}\n", count++,
                       when, impulse, more);
}

struct Case {
    const char* about;
    double x, v;
    std::string rest;
};

/// Everyday switches, walls, kicks and stops; zeros that are reached exactly, and zeros at times that are known.
std::vector<Case> everyday() {
    const std::string up = "direction = \"up\"", down = "direction = \"down\"";
    return {{"a step in time", 0, 0, force("(1 + sign(t - 5))/2")},
            {"a ramp", 0, 0, force("max(0, t - 5)")},
            {"an angle in time", 0, 0, force("abs(t - 5)")},
            {"a square wave of period 2", 0, 0, force("sign(sin(pi*t))")},
            {"a square wave of period 2 pi/3", 0, 0, force("sign(sin(3*t))")},
            {"a square wave that begins in the middle", 0, 0, force("sign(cos(pi*t))*(3 - sign(2 - t))")},
            {"on and off", 1, 0, force("-sign(x)")},
            {"a spring on one side", 1, 0, force("-x - 20*max(0, -x)")},
            {"a soft wall at 5", 0, 1, force("-30*max(0, x - 5)")},
            {"a soft wall at 3.3", 0, 1, force("-30*max(0, x - 3.3)")},
            {"drag", 0, 1, force("-0.3*x'*abs(x') + cos(t)")},
            {"a wall at 5", 0, 1, kick("x - 5", "-2*x'")},
            {"a wall at 5 000 000", 4999995, 1, kick("x - 5e6", "-2*x'")},
            {"a wall at 5 millionths", 0, 1e-6, kick("x - 5e-6", "-2*x'")},
            {"a kick at t = 5", 0, 1, kick("t - 5", "-2*x'")},
            {"a kick at t = 3.3", 0, 1, kick("7*(3.3 - t)", "-2*x'")},
            {"kicks at two times", 0, 1, kick("(t - 2)*(t - 7)", "0.5")},
            {"a kick of an oscillator", 1, 0, force("-x") + kick("x", "0.2*x'")},
            {"a stop at t = 5", 0, 1, "[[event]]\nname = \"e\"\nwhen = \"t - 5\"\nstop = true\n"},
            {"a stop at x = 5", 0, 1, "[[event]]\nname = \"e\"\nwhen = \"x - 5\"\nstop = true\n"},
            {"two walls", 0.3, 1, kick("x - 1", "-2*x'", up) + kick("x", "-2*x'", down)},
            {"kicks at whole times", 0, 1, kick("sin(pi*t)", "0.3")},
            {"kicks at times where a sine rises", 0, 1, kick("-2*sin(3*t + 1)", "0.3", up)},
            {"a bound force", 0, 1, force("-min(x, 2)")},
            {"a dead zone", 3, 0, force("-max(0, x - 1) - min(0, x + 1)")},
            {"a ball", 1, 0, force("-9.81") + kick("x", "-2*x'", down)},
            {"a brake that begins at a speed", 0, 0, force("1 - 0.5*max(0, x' - 1)")},
            {"from rest at a zero", 0, 0, force("cos(t) - 0.4*sign(x' + 3)*x") + kick("x - 0.5", "-x'", up)},
            {"a kick that crosses the zero of another", 0, 1, kick("x - 1.1", "1") + kick("x' - 1.5", "3")},
            {"kicks beside a kink", -3, 1, kick("abs(x) - 1", "1")},
            {"kicks beside a kink elsewhere", 0, 1, kick("abs(x - 5) - 1", "1")},
            {"kicks beside nested kinks", -4, 1, kick("abs(abs(x) - 2) - 1", "0.25")},
            {"an event that jumps over its zero", 0, 1, kick("sign(x - 5)", "1")},
            {"a jump over a zero, and a zero", 0, 1, kick("sign(x - 5)*(x - 3)", "1")},
            {"a pulse", 0, 0, force("max(0, sign(t - 2))*max(0, sign(3 - t))")},
            {"a pulse in space", 0, 1, force("max(0, sign(x - 2))*max(0, sign(3 - x))")},
            {"a train of pulses", 0, 0, force("max(0, sign(sin(2*pi*t) - 0.5))")},
            {"trains of pulses", 0, 0,
             "[parameters]\nA = 3\nw = 2\n" + force("sign(A*cos(w*t) + 1)*max(0, sign(2 - 3*sin(t + w)))")},
            {"a product of square waves", 0, 0, force("sign(sin(2*pi*t))*sign(cos(pi*t))")},
            {"kicks at zeros of a sine that rounding moves", 0, 1,
             "[parameters]\nT = 0.7\n" + kick("sin(2*pi*t/T)", "0.1", up)},
            {"kicks at zeros of a cosine", 0, 1, "[parameters]\nw = 3\n" + kick("cos(w*t + 0.3)", "0.1", down)}};
}

}  // namespace

TEST_CASE("fmu: under CVODE's search for roots no event is lost, in either version and with any interval") {
    for (const Case& one : everyday()) {
        CAPTURE(std::string(one.about));
        const std::string scene = scene_of(one.x, one.v, one.rest);
        const Json wanted = simulated(scene, 9.9);
        for (const int version : {2, 3}) {
            CAPTURE(version);
            const Unit unit = exported(scene, version, Compiled::as_shipped);
            for (const double interval : {10.0, 0.5, 0.0371}) {
                CAPTURE(interval);
                Instance instance(unit, false, 1e-9);
                instance.begin();
                const Ended ended = follow(instance, 9.9, interval);
                CHECK(ended.time == doctest::Approx(double(wanted["time"])).epsilon(1e-8));
                // Some hundred steps, each with an error of 1e-9.
                CHECK(difference(instance, wanted) < 2e-6);
            }
            Instance together(unit, true, 1e-10);
            together.begin();
            for (int n = 0; n < 11 && together.step(n * 0.9, 0.9); ++n) {
            }
            CHECK(difference(together, wanted) < 2e-6);
        }
    }
}

TEST_CASE("fmu: an event that only touches zero happens, and so does one whose function is flat there") {
    const std::string up = "direction = \"up\"", down = "direction = \"down\"";
    for (const Case& one : std::vector<Case>{
             {"a square", 0, 1, kick("(x - 5)^2", "1")},
             {"squares above zero", 0, 1, kick("3*(x - 5)^2", "1", down) + kick("(x - 7)^2", "1", up)},
             {"squares below zero", 0, 1, kick("-(x - 5)^2", "1", up) + kick("-(x - 7)^2", "1", down)},
             {"an absolute value", 0, 1, kick("abs(x - 5)", "1")},
             {"a product of squares", 0, 1, kick("(x - 5)^2*(x + 1)^4", "1")},
             {"a square of a negative rate", 0, -1, kick("(x + 5)^2", "-1", down)},
             {"a square of time", 0, 1, kick("(t - 5)^2", "1")},
             {"a square beside a pole", 0, 1, kick("(x - 5)^2/(x - 7)^2", "1")},
             {"a cube", 0, 1, kick("(x - 5)^3", "1", up)},
             {"a cube, the other way", 0, 1, kick("(x - 5)^3", "1", down) + kick("5 - x", "1", down)},
             {"a negative power", 0, 1, kick("-2*(x - 5)^5", "1", down)}}) {
        CAPTURE(std::string(one.about));
        const std::string scene = scene_of(one.x, one.v, one.rest);
        for (const int version : {2, 3}) {
            CAPTURE(version);
            const Unit unit = exported(scene, version);
            Instance apart(unit, false, 1e-9), together(unit, true, 1e-9);
            apart.begin();
            follow(apart, 9.9, 0.5);
            together.begin();
            for (int n = 0; n < 11; ++n) together.step(n * 0.9, 0.9);
            for (const Instance* it : {&apart, &together}) {
                CHECK(it->get("x") == doctest::Approx(one.v * (5 + 2 * 4.9)).epsilon(1e-8));
                CHECK(it->get("der(x)") == doctest::Approx(2 * one.v).epsilon(1e-12));
            }
        }
    }
}

// A hop that ends within a step of the importer begins and ends on the same side of the floor.
TEST_CASE("fmu: a ball that loses height bounces under any step of the importer") {
    const std::string scene =
        scene_of(1, 0, force("-9.81") + kick("x", "-1.8*x'", "direction = \"down\"") + kick("x - 9", "0"));
    const Json wanted = simulated(scene, 3);
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit unit = exported(scene, version, Compiled::as_shipped);
        for (const double interval : {3.0, 0.5, 0.0371}) {
            CAPTURE(interval);
            Instance one(unit, false, 1e-9);
            one.begin();
            follow(one, 3, interval, 1e-10);
            CHECK(difference(one, wanted) < 1e-6);
        }
        for (const int steps : {3, 6, 20, 300}) {
            CAPTURE(steps);
            Instance one(unit, false, 1e-9);
            one.begin();
            exchange(one, 3, steps);
            CHECK(difference(one, wanted) < 1e-8);
        }
    }
}

TEST_CASE("fmu: a ball on a contact bounces, comes to rest and lies under any step of the importer") {
    const std::string scene = source_path("scenes/textbook/bouncing_ball.toml");
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit unit = exported(scene, version);
        for (const double end : {2.0, 4.0}) {
            const Json wanted = simulated(scene, end);
            for (const double interval : {4.0, 0.5, 0.0371}) {
                CAPTURE(interval);
                Instance one(unit, false, 1e-9);
                one.begin();
                follow(one, end, interval, 1e-10);
                CHECK(difference(one, wanted) < 1e-6);
                CHECK(std::abs(one.get("lambda_floor") - (end > 3 ? 0.5 * 9.81 : 0)) < 1e-9);
            }
        }
    }
}

// An importer does not tell the unit how large its errors are.
TEST_CASE("fmu: a contact comes to rest where its hops are as small as the errors of the importer") {
    for (const std::string gap : {"y", "y + 0.3*x", "y - 0.1*sin(5*t)"}) {
        CAPTURE(gap);
        const std::string scene =
            temporary("rest.toml",
                      "gravity = [0, -9.81]\n[coordinates]\nx = { initial = 0, rate = 0.3 }\ny = 1\n[[particle]]\n"
                      "name = \"p\"\nmass = 1\nposition = [\"x\", \"y\"]\n[[unilateral]]\nname = \"floor\"\n"
                      "restitution = 0.5\ngap = \"" +
                          gap + "\"\n");
        const Json wanted = simulated(scene, 4);
        for (const int version : {2, 3}) {
            const Unit unit = exported(scene, version);
            for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
                CAPTURE(tolerance);
                Instance one(unit, false);
                one.begin();
                CHECK(follow(one, 4, 0.05, tolerance).roots < 30);
                CHECK(difference(one, wanted) < 300 * tolerance);
            }
        }
    }
}

// A hop as small as the errors of the importer: behind the floor, although it moves up from it.
TEST_CASE("fmu: impulses that follow each other without end are an error, and no way through a floor") {
    for (const int version : {2, 3}) {
        const Unit unit =
            exported(scene_of(1, 0, force("-10") + kick("x", "-1.8*x'", "direction = \"down\"")), version);
        Instance one(unit, false, 1e-9);
        one.begin();
        one.update();
        one.at(0.4, {-1e-11, -1});
        CHECK(one.wants_event());
        one.update();
        CHECK(one.state()[1] == doctest::Approx(0.8));
        one.at(0.5, {-1e-11 - 1e-13, 0.1});
        CHECK_FALSE(one.wants_event());
        CHECK(one.indicators()[0] > 0);
        one.at(0.6, {-1e-9, 0.1});
        CHECK(one.wants_event());
        one.ok(one.prefix() + "EnterEventMode");
        bool over = false;
        CHECK(one.status_in_event_mode(over) == failed);
    }
}

TEST_CASE("fmu: an event at the very end of a run happens, in model exchange and in co-simulation") {
    struct Late {
        const char* when;
        double end, rate;
    };
    for (const Late& late : {Late{"t - 5", 5, 1.5}, Late{"x - 5", 5, 1.5}, Late{"10 - 2*x", 5, 1.5},
                             Late{"sin(pi*t)", 5, 3.5}, Late{"sin(pi*t)", 10, 6}, Late{"cos(pi*t)", 2.5, 2.5}}) {
        CAPTURE(std::string(late.when));
        const std::string scene = scene_of(0, 1, kick(late.when, "0.5"));
        for (const int version : {2, 3}) {
            const Unit unit = exported(scene, version);
            for (const double interval : {late.end, 0.5}) {
                CAPTURE(interval);
                Instance apart(unit, false, 1e-9), together(unit, true, 1e-9);
                apart.begin();
                follow(apart, late.end, interval);
                CHECK(apart.get("der(x)") == doctest::Approx(late.rate).epsilon(1e-12));
                together.begin();
                for (double t = 0; t < late.end; t += interval) together.step(t, interval);
                CHECK(together.get("der(x)") == doctest::Approx(late.rate).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("fmu: jumps at known times are told in advance, and are no roots") {
    struct Known {
        const char* when;
        std::vector<double> times;
    };
    const double pi = 3.14159265358979323846;
    for (const Known& known :
         {Known{"t - 5", {5}}, Known{"2*(T - t)", {4.5}}, Known{"sin(pi*t)", {1, 2, 3, 4, 5, 6, 7, 8, 9}},
          Known{"(t - 2)*(t - 7)", {2, 7}},
          Known{"1 - 2*cos(pi*t)", {1. / 3, 5. / 3, 7. / 3, 11. / 3, 13. / 3, 17. / 3, 19. / 3, 23. / 3, 25. / 3}},
          Known{"T*sin(pi*t) - T/2",
                {1. / 6, 5. / 6, 13. / 6, 17. / 6, 25. / 6, 29. / 6, 37. / 6, 41. / 6, 49. / 6, 53. / 6}},
          Known{"cos(2*t)*T", {pi / 4, 3 * pi / 4, 5 * pi / 4, 7 * pi / 4, 9 * pi / 4, 11 * pi / 4}}}) {
        CAPTURE(known.when);
        const std::string scene = scene_of(0, 1, "[parameters]\nT = 4.5\n" + kick(known.when, "-0.1*x'"));
        for (const int version : {2, 3}) {
            const Unit unit = exported(scene, version);
            Instance one(unit, false, 1e-9);
            one.begin();
            double x = 0, v = 1, last = 0;
            for (const double t : known.times) x += v * (t - last), v *= 0.9, last = t;
            x += v * (9.5 - last);
            const Ended ended = follow(one, 9.5, 1);
            CHECK(ended.known == static_cast<int>(known.times.size()));
            CHECK(ended.roots == 0);
            CHECK(one.get("x") == doctest::Approx(x).epsilon(1e-9));
            CHECK(one.get("der(x)") == doctest::Approx(v).epsilon(1e-12));
        }
    }
}

TEST_CASE("fmu: an importer whose step ends at the zero itself sees no zero, and the event follows") {
    for (const int version : {2, 3}) {
        const Unit unit = exported(scene_of(0, 1, kick("x - 5", "-2*x'")), version);
        Instance one(unit, false, 1e-9);
        one.begin();
        one.update();
        CHECK(one.indicators()[0] < 0);
        one.at(5, {5, 1});
        one.wants_event();
        CHECK(one.indicators()[0] < 0);  // it has not passed
        one.at(5 + 1e-9, {5 + 1e-9, 1});
        CHECK(one.indicators()[0] > 0);
        one.update();
        CHECK(one.state() == Numbers{5 + 1e-9, -1});
        CHECK(one.indicators()[0] < 0);
        one.at(5.5, {4.5, -1});
        CHECK_FALSE(one.wants_event());
        CHECK(one.indicators()[0] < 0);
        // It comes again, and is sent back again.
        one.at(7, {5.25, 1});
        CHECK(one.indicators()[0] > 0);
        CHECK(one.wants_event());
        one.update();
        CHECK(one.state() == Numbers{5.25, -1});
    }
}

// The times are told again after a parameter or the time was set.
TEST_CASE("fmu: the time that is told follows parameters, and an input that may be set is no clock") {
    for (const int version : {2, 3}) {
        const Unit unit = exported(scene_of(0, 1, "[parameters]\nT = 4.5\n" + kick("t - T", "1")), version);
        Instance one(unit, false);
        one.begin();
        one.update();
        CHECK(one.next_event() == 4.5);
        one.set("T", 3);
        one.update();
        CHECK(one.next_event() == 3);
        const Unit driven =
            exported(scene_of(0, 1, "[inputs]\nF = \"t - 5\"\n" + force("F") + kick("F", "1")), version);
        Instance other(driven, false);
        other.begin();
        other.update();
        CHECK(other.next_event() == HUGE_VAL);
    }
}

}  // namespace fmu_cvode
