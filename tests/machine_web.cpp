// SPDX-License-Identifier: MIT
// Modules of WebAssembly against the interpreter of the same program. They are run here by a machine of this file,
// which reads the bytes as the specification has them (WebAssembly Core Specification 1.0, chapter 5), and refuses
// all that it does not know: stacks that do not fit, unknown instructions, sections whose size is wrong.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "alembert/base/error.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/machine/web_assembly.hpp"
#include "machine_values.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/differentiate.hpp"
#include "program/lower/choose.hpp"
#include "random_program.hpp"
#include "random_scene.hpp"
#include "scenes.hpp"

namespace machine_web {

using namespace alembert;
using namespace alembert::test;
using machine::ModuleOfLines;

namespace {

[[noreturn]] void refuse(const std::string& reason) {
    throw std::runtime_error("not a module: " + reason);
}

class Reader {
public:
    Reader(const std::uint8_t* begin, const std::uint8_t* end) : at_(begin), end_(end) {}
    bool is_at_end() const { return at_ == end_; }
    std::uint8_t byte() {
        if (at_ == end_) refuse("it ends early");
        return *at_++;
    }
    std::uint32_t number() {
        std::uint32_t value = 0;
        for (unsigned shift = 0;; shift += 7) {
            const std::uint8_t b = byte();
            value |= static_cast<std::uint32_t>(b & 0x7fU) << shift;
            if (b < 0x80) return value;
        }
    }
    std::uint32_t constant() {
        std::uint64_t value = 0;
        for (unsigned shift = 0;;) {
            const std::uint8_t b = byte();
            value |= static_cast<std::uint64_t>(b & 0x7fU) << shift;
            shift += 7;
            if (b >= 0x80) continue;
            if ((b & 0x40U) != 0) value |= ~std::uint64_t{0} << shift;
            return static_cast<std::uint32_t>(value);
        }
    }
    double real() {
        std::uint8_t bytes[8];
        for (std::uint8_t& b : bytes) b = byte();
        double value = 0;
        std::memcpy(&value, bytes, 8);
        return value;
    }
    std::string text() {
        std::string result(number(), ' ');
        for (char& letter : result) letter = static_cast<char>(byte());
        return result;
    }
    Reader part() {
        const std::uint32_t size = number();
        if (size > static_cast<std::size_t>(end_ - at_)) refuse("a part is longer than the whole");
        at_ += size;
        return {at_ - size, at_};
    }
    void expect(std::initializer_list<std::uint8_t> bytes) {
        for (const std::uint8_t b : bytes)
            if (byte() != b) refuse("another byte than expected");
    }

private:
    const std::uint8_t *at_, *end_;
};

/// A number of 64 or of 32 bits.
struct Value {
    bool is_real;
    double real = 0;
    std::uint32_t whole = 0;
};

std::vector<const void*>& table() {
    static std::vector<const void*> functions(1);
    return functions;
}

std::uint32_t place_of(const void* function) {
    table().push_back(function);
    return static_cast<std::uint32_t>(table().size() - 1);
}

void sines(double* angles, std::uint32_t distance, std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) {
        angles[distance + k] = std::sin(angles[k]);
        angles[2 * distance + k] = std::cos(angles[k]);
    }
}

/// A module and its memory, which is a list of numbers.
class Machine {
public:
    std::vector<double> memory;

    explicit Machine(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {
        Reader all(bytes_.data(), bytes_.data() + bytes_.size());
        all.expect({0, 'a', 's', 'm', 1, 0, 0, 0});
        for (const std::uint8_t expected : {1, 2, 3, 7, 10}) {
            if (all.byte() != expected) refuse("another section than expected");
            Reader section = all.part();
            read(expected, section);
            if (!section.is_at_end()) refuse("a section is longer than what it has");
        }
        if (!all.is_at_end()) refuse("something follows");
    }

    std::size_t size() const { return bodies_.size(); }

    void run(std::size_t number, const std::vector<Value>& arguments) {
        const std::string& type = types_.at(type_of_.at(number));
        std::string given;
        for (const Value& v : arguments) given += v.is_real ? 'd' : 'i';
        REQUIRE(type == given + ">");
        Reader body = bodies_.at(number);
        std::vector<Value> locals = arguments, stack;
        for (std::uint32_t groups = body.number(); groups > 0; --groups) {
            const std::uint32_t count = body.number();
            body.expect({0x7c});
            locals.insert(locals.end(), count, Value{true, std::nan("")});
        }
        while (step(body, locals, stack)) {
        }
        if (!stack.empty() || !body.is_at_end()) refuse("something is left at the end");
    }

private:
    void read(int section, Reader& from) {
        if (section == 2) {
            from.expect({2, 1, 'e', 1, 'm', 2, 0, 0, 1, 'e', 1, 't', 1, 0x70, 0, 0});
            return;
        }
        const std::uint32_t count = from.number();
        for (std::uint32_t k = 0; k < count; ++k) {
            if (section == 1) {
                from.expect({0x60});
                std::string type;
                for (const char* const after : {">", ""}) {
                    for (std::uint32_t n = from.number(); n > 0; --n) type += from.byte() == 0x7c ? 'd' : 'i';
                    type += after;
                }
                types_.push_back(type);
            } else if (section == 3) {
                type_of_.push_back(from.number());
            } else if (section == 7) {
                if (from.text() != std::to_string(k)) refuse("another name than expected");
                from.expect({0});
                if (from.number() != k) refuse("another function than expected");
            } else {
                bodies_.push_back(from.part());
            }
        }
    }

    static Value pop(std::vector<Value>& stack, bool is_real) {
        if (stack.empty() || stack.back().is_real != is_real) refuse("the stack has another value");
        const Value top = stack.back();
        stack.pop_back();
        return top;
    }

    double& place(Reader& body, std::vector<Value>& stack) {
        body.expect({3});
        const std::uint32_t offset = body.number(), address = pop(stack, false).whole + offset;
        if (address % 8 != 0) refuse("a place is not a multiple of eight");
        return memory.at(address / 8);
    }

    /// False at the end of the function.
    bool step(Reader& body, std::vector<Value>& locals, std::vector<Value>& stack) {
        const auto real = [&] { return pop(stack, true).real; };
        const auto give = [&](double x) { stack.push_back({true, x}); };
        const std::uint8_t code = body.byte();
        switch (code) {
            case 0x0b:
                return false;
            case 0x11:
                call(body, stack);
                break;
            case 0x1a:
                if (stack.empty()) refuse("the stack is empty");
                stack.pop_back();
                break;
            case 0x20:
                stack.push_back(locals.at(body.number()));
                break;
            case 0x21:
                locals.at(body.number()) = pop(stack, true);
                break;
            case 0x22:
                locals.at(body.number()) = stack.back();
                break;
            case 0x2b:
                give(place(body, stack));
                break;
            case 0x39: {
                const double value = real();
                place(body, stack) = value;
                break;
            }
            case 0x41:
                stack.push_back({false, 0, body.constant()});
                break;
            case 0x44:
                give(body.real());
                break;
            case 0x99:
                give(std::abs(real()));
                break;
            case 0x9a:
                give(-real());
                break;
            case 0x9f:
                give(std::sqrt(real()));
                break;
            default: {
                if (code < 0xa0 || code > 0xa3) refuse("the unknown instruction " + std::to_string(code));
                const double b = real(), a = real();
                give(code == 0xa0 ? a + b : code == 0xa1 ? a - b : code == 0xa2 ? a * b : a / b);
            }
        }
        return true;
    }

    void call(Reader& body, std::vector<Value>& stack) {
        const std::string& type = types_.at(body.number());
        body.expect({0});
        const void* const function = table().at(pop(stack, false).whole);
        if (type == "d>d") {
            const double x = pop(stack, true).real;
            stack.push_back({true, reinterpret_cast<double (*)(double)>(const_cast<void*>(function))(x)});
        } else if (type == "dd>d") {
            const double y = pop(stack, true).real, x = pop(stack, true).real;
            stack.push_back(
                {true, reinterpret_cast<double (*)(double, double)>(const_cast<void*>(function))(x, y)});
        } else if (type == "iii>") {
            const std::uint32_t count = pop(stack, false).whole, distance = pop(stack, false).whole;
            sines(&memory.at(pop(stack, false).whole / 8), distance, count);
        } else {
            refuse("an unknown type of a function");
        }
    }

    std::vector<std::uint8_t> bytes_;
    std::vector<std::string> types_;
    std::vector<std::uint32_t> type_of_;
    std::vector<Reader> bodies_;  ///< in bytes_
};

/// Where arrays lie, in numbers: each has as much room.
constexpr std::size_t room_of_arrays = 20'000;

int differences_in_module(const Program& p, const State<double>& state) {
    const Vocabulary words(p);
    std::vector<int> roots;
    for (const Root& root : p.roots) roots.push_back(root.node);
    const Readiness ready(p, roots);
    const Expected expected(p, state);
    std::vector<FunctionTask> tasks{
        right_hand_side(p, words), mass_forcing(p),   energy(p),       outputs_at(p), events_at(p),
        constraints_at(p),         multipliers_at(p), jacobian(p).task};
    if (has_projection(p)) tasks.insert(tasks.end(), {project(p), gamma_at(p)});
    std::erase_if(tasks, [](const FunctionTask& task) { return task.results.empty(); });
    ModuleOfLines module({.block = 0, .sines = 0, .place_of = place_of});
    const bool has_constants = !words.constants().empty();
    if (has_constants) REQUIRE(module.add(machine::lines_of_constants(p, words, ready)));
    for (const FunctionTask& task : tasks) REQUIRE(module.add(machine::lines_of(p, words, ready, task)));
    REQUIRE(module.size() == static_cast<int>(tasks.size()) + (has_constants ? 1 : 0));
    Machine engine(module.bytes());
    REQUIRE(engine.size() == static_cast<std::size_t>(module.size()));

    std::map<std::string, std::size_t> places;  // of arrays
    const auto array = [&](const std::string& name) {
        const std::size_t next = (places.size() + 1) * room_of_arrays;
        const std::size_t place = places.try_emplace(name, next).first->second;
        engine.memory.resize(std::max(engine.memory.size(), place + room_of_arrays));
        return place;
    };
    const auto fill = [&](const std::string& name, std::vector<std::vector<double>> parts) {
        std::size_t place = array(name);
        for (const std::vector<double>& part : parts)
            for (const double x : part) engine.memory.at(place++) = x;
    };
    const auto address = [&](const std::string& name) {
        return Value{false, 0, static_cast<std::uint32_t>(8 * array(name))};
    };
    fill("state", {state.q, state.qdot});
    fill("par", {state.parameters});
    if (has_constants) engine.run(0, {address("par")});
    int count = 0;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
        std::vector<double> rates = state.qdot;
        rates.resize(state.q.size());
        fill("rate", {rates, state.qddot});
        std::vector<Value> arguments;
        for (const FunctionArgument& argument : tasks[k].arguments)
            arguments.push_back(argument.name == "t" ? Value{true, state.t} : address(argument.name));
        engine.run(k + (has_constants ? 1 : 0), arguments);
        Arrays out;
        for (const FunctionResult& result : tasks[k].results) {
            std::vector<double>& values = out[result.array];
            const auto begin = engine.memory.begin() + static_cast<std::ptrdiff_t>(array(result.array));
            values.assign(begin, begin + static_cast<std::ptrdiff_t>(room(tasks[k], result.array)));
        }
        count += differences(tasks[k], out, expected);
    }
    return count;
}

}  // namespace

TEST_CASE("machine: a module of WebAssembly with random programs has the interpreter's values") {
    for (unsigned seed = 0; seed < 300; ++seed) {
        const Program p = random_program({.seed = seed,
                                          .count = 20 + static_cast<int>(seed) * 3,
                                          .calls = seed % 2 == 1,
                                          .inputs = 1 + static_cast<int>(seed % 40)});
        CAPTURE(seed);
        CHECK(differences_in_module(p, some_state(p, seed)) == 0);
    }
}

TEST_CASE("machine: a module of WebAssembly with the functions of scenes has the interpreter's values") {
    for (const std::string& file : every_third(scenes_in("scenes/textbook"), 2)) {
        CAPTURE(file);
        const Prepared made = prepared(read_scene(file));
        const Mechanism& m = made.mechanism;
        std::mt19937_64 random(12);
        for (const char* name : {"lagrange", "routh", "recursive"}) {
            std::optional<Program> program;
            try {
                program = choose(m, formalism(name).derive(m)).program;
            } catch (const ModelError&) {  // the formalism does not apply
                continue;
            }
            CAPTURE(name);
            if (program->singular) continue;
            if (const auto d = differentiated(*program, {.power = true, .budget = 20000})) program = d->program;
            State<double> state = random_state(start_of(m), random);
            state.qdot.resize(program->speeds.empty() ? state.q.size() : program->speeds.size(), 0.7);
            state.qddot.assign(state.qdot.size(), 0.3);
            CHECK(differences_in_module(*program, state) == 0);
        }
    }
}

TEST_CASE("machine: a module of WebAssembly calls a function with one more argument") {
    ModuleOfLines module({.block = 0, .sines = 0, .place_of = place_of});
    module.add_call(70, 0xfffffff0U);
    const std::vector<std::uint8_t> bytes = module.bytes();
    // i32.const −16, i32.const 70, call_indirect: constants have a sign, so that 70 takes two bytes.
    const std::vector<std::uint8_t> last{0x41, 0x70, 0x41, 0xc6, 0x00, 0x11, 0x00, 0x00, 0x0b};
    CHECK(std::equal(last.rbegin(), last.rend(), bytes.rbegin()));
    CHECK(Machine(bytes).size() == 1);
}

}  // namespace machine_web
