// SPDX-License-Identifier: MIT
#pragma once

/// A machine that runs modules of WebAssembly as ModuleOfLines (codegen/machine/web_assembly.hpp) writes them. It
/// reads the bytes as the specification has them (WebAssembly Core Specification 2.0, chapter 5), and refuses all
/// that it does not know: stacks that do not fit, unknown instructions, sections whose size is wrong.
///
///     WebMachine machine(module.bytes());
///     machine.memory.resize(100);
///     machine.run(0, {WebMachine::Value(0.5), WebMachine::Value(std::uint32_t{8})});

#include <cstdint>
#include <string>
#include <vector>

namespace alembert::test {

class WebMachine {
public:
    /// A number of 64 bits, one of 32 bits, or a vector of two of 64 bits.
    struct Value {
        explicit Value(double x) : kind('d'), real{x, 0} {}
        explicit Value(std::uint32_t x) : kind('i'), whole(x) {}
        Value(double x, double y) : kind('v'), real{x, y} {}
        char kind;
        double real[2] = {0, 0};
        std::uint32_t whole = 0;
    };

    /// Throws std::runtime_error if the bytes are no module, or have what this machine does not know.
    explicit WebMachine(std::vector<std::uint8_t> bytes);

    std::size_t size() const { return bodies_.size(); }
    /// Runs the function of this number; throws std::runtime_error as the constructor does, and for a place
    /// outside of memory.
    void run(std::size_t number, const std::vector<Value>& arguments);

    /// The place of a C++ function in the table.
    static std::uint32_t place_of(const void* function);

    std::vector<double> memory;

private:
    class Reader;
    struct Part {
        std::size_t begin, end;  ///< in bytes_
    };

    void read(int section, Reader& from);
    bool step(Reader& body, std::vector<Value>& locals, std::vector<Value>& stack);
    void step_vector(Reader& body, std::vector<Value>& stack);
    void call(Reader& body, std::vector<Value>& stack);
    double* place(Reader& body, std::vector<Value>& stack, unsigned power);

    std::vector<std::uint8_t> bytes_;
    std::vector<std::string> types_;
    std::vector<std::uint32_t> type_of_;
    std::vector<Part> bodies_;
};

}  // namespace alembert::test
