// SPDX-License-Identifier: MIT
#pragma once

/// Machine code run by an interpreter of its disassembly (objdump), so that code for registers which this
/// processor does not have can be tested too.
///
///     Disassembled code(bytes);
///     code.call(begin, {reals(&t), reals(state), reals(par), reals(rate)});      // pointers as System V passes
///     them
///
/// Throws std::runtime_error for what it does not know.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace alembert::test {

class Disassembled {
public:
    explicit Disassembled(std::vector<std::uint8_t> bytes);

    /// Calls the function that begins `begin` bytes after the first one.
    void call(std::size_t begin, const std::vector<const double*>& arrays);

    /// How often an instruction of that name was run.
    int count(const std::string& name) const;

private:
    using Lanes = std::array<std::uint64_t, 8>;
    struct Step {
        std::string name;
        std::vector<std::string> operands;
        std::size_t next = 0;  ///< the address behind it
    };

    void run(std::size_t at);
    void do_vector(const Step& step);
    void do_bits(const Step& step);
    bool do_general(const Step& step);
    void call_outside();
    std::uint64_t address(const std::string& operand, std::size_t next) const;
    std::uint64_t number(const std::string& operand) const;
    /// The numbers of a register, a place in memory, or one number of memory for all.
    Lanes values(const std::string& operand, std::size_t next) const;
    void put(const Step& step, const Lanes& values);

    std::vector<std::uint8_t> bytes_;
    std::map<std::size_t, Step> steps_;
    std::map<std::string, std::uint64_t> general_;
    std::map<std::string, int> counts_;
    std::vector<std::uint64_t> stack_;
    std::array<Lanes, 32> vectors_{};
    bool is_zero_ = false;
    unsigned mask_ = 0;
};

}  // namespace alembert::test
