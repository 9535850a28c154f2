// SPDX-License-Identifier: MIT
#include "disassembled.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "alembert/native/simd_math.hpp"
#include "shell.hpp"

namespace alembert::test {

namespace {

constexpr std::uint64_t sign_of_number = std::uint64_t{1} << 63;

double real(std::uint64_t bits) {
    return std::bit_cast<double>(bits);
}
std::uint64_t bits(double value) {
    return std::bit_cast<std::uint64_t>(value);
}

/// How many numbers an operand has.
int width(const std::string& operand) {
    if (operand.starts_with("zmm") || operand.starts_with("ZMM")) return 8;
    if (operand.starts_with("ymm") || operand.starts_with("YMM")) return 4;
    throw std::runtime_error("no wide operand: " + operand);
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> result;
    std::istringstream stream(text);
    for (std::string one; std::getline(stream, one, ',');) result.push_back(one);
    return result;
}

/// What vpternlogq gives for three bits: the list of results is the number, the first argument the highest digit.
std::uint64_t by_list(std::uint64_t list, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    std::uint64_t result = 0;
    for (int k = 0; k < 64; ++k) result |= (list >> ((a >> k & 1) * 4 + (b >> k & 1) * 2 + (c >> k & 1)) & 1) << k;
    return result;
}

double larger(double a, double b) {  // the second where one is not a number
    return a > b ? a : b;
}
double larger_size(double a, double b) {  // the other one then
    a = std::abs(a), b = std::abs(b);
    if (std::isnan(a)) return b;
    return std::isnan(b) || a > b ? a : b;
}

using Binary = std::function<double(double, double)>;
const std::map<std::string, Binary>& binary() {
    static const std::map<std::string, Binary> table{
        {"vaddpd", std::plus<>()},    {"vsubpd", std::minus<>()}, {"vmulpd", std::multiplies<>()},
        {"vdivpd", std::divides<>()}, {"vmaxpd", larger},         {"vrangepd", larger_size}};
    return table;
}

/// The signs of product and rest, and which of the three operands are multiplied and which added.
bool fused(const std::string& name, const std::array<double, 3>& x, double& result) {
    struct Kind {
        const char* name;
        double product, rest;
    };
    for (const Kind& kind :
         {Kind{"vfmadd", 1, 1}, Kind{"vfmsub", 1, -1}, Kind{"vfnmadd", -1, 1}, Kind{"vfnmsub", -1, -1}}) {
        const std::string begin = kind.name;
        if (!name.starts_with(begin) || name.size() != begin.size() + 5) continue;
        const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(name[begin.size() + k] - '1')]; };
        result = std::fma(kind.product * at(0), at(1), kind.rest * at(2));
        return true;
    }
    return false;
}

}  // namespace

Disassembled::Disassembled(std::vector<std::uint8_t> code) : bytes_(std::move(code)), stack_(1 << 17) {
    const std::string file = temporary_folder("disassembled") + "/code";
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
    std::istringstream text(
        run_shell("objdump -D -b binary -m i386:x86-64 -M intel --no-show-raw-insn \"$1\"", {file}).out);
    std::size_t before = 0;
    bool is_first = true;
    for (std::string line; std::getline(text, line);) {
        const std::size_t colon = line.find(":\t");
        if (colon == std::string::npos) continue;
        const std::size_t at = std::stoul(line.substr(0, colon), nullptr, 16);
        if (!is_first) steps_[before].next = at;
        is_first = false;
        before = at;
        std::string rest = line.substr(colon + 2);
        rest = rest.substr(0, rest.find('#'));
        while (!rest.empty() && rest.back() == ' ') rest.pop_back();
        const std::size_t space = rest.find(' ');
        Step& step = steps_[at];
        step.name = rest.substr(0, space);
        const std::size_t first = rest.find_first_not_of(' ', space);
        if (space != std::string::npos && first != std::string::npos) step.operands = split(rest.substr(first));
    }
}

int Disassembled::count(const std::string& name) const {
    const auto found = counts_.find(name);
    return found == counts_.end() ? 0 : found->second;
}

void Disassembled::call(std::size_t begin, const std::vector<const double*>& arrays) {
    constexpr const char* names[] = {"rdi", "rsi", "rdx", "rcx", "r8", "r9"};
    for (std::size_t k = 0; k < arrays.size(); ++k)
        general_[names[k]] = reinterpret_cast<std::uint64_t>(arrays[k]);
    general_["rsp"] = reinterpret_cast<std::uint64_t>(stack_.data() + stack_.size() - 16) | 8;
    for (Lanes& any : vectors_) any.fill(bits(std::nan("")));
    run(begin);
}

void Disassembled::run(std::size_t at) {
    for (;;) {
        const auto found = steps_.find(at);
        if (found == steps_.end()) throw std::runtime_error("no instruction begins there");
        const Step& step = found->second;
        ++counts_[step.name];
        at = step.next;
        if (step.name == "ret") return;
        if (step.name == "call" && step.operands[0] != "rax") {
            run(number(step.operands[0]));
            continue;
        }
        if (step.name == "jmp" || (step.name == "jne" && !is_zero_)) {
            at = number(step.operands[0]);
            continue;
        }
        if (step.name != "jne" && !do_general(step)) do_vector(step);
    }
}

std::uint64_t Disassembled::number(const std::string& operand) const {
    const auto known = general_.find(operand);
    return known != general_.end() ? known->second : std::stoull(operand, nullptr, 16);
}

/// Of "ZMMWORD PTR [rsi+0x40]".
std::uint64_t Disassembled::address(const std::string& operand, std::size_t next) const {
    const std::size_t open = operand.find('[');
    const std::string inside = operand.substr(open + 1, operand.find(']') - open - 1);
    const std::size_t sign = inside.find_first_of("+-");
    const std::string base = inside.substr(0, sign);
    std::uint64_t result =
        base == "rip" ? reinterpret_cast<std::uint64_t>(bytes_.data()) + next : general_.at(base);
    if (sign == std::string::npos) return result;
    const std::uint64_t offset = std::stoull(inside.substr(sign + 1), nullptr, 16);
    return inside[sign] == '+' ? result + offset : result - offset;
}

bool Disassembled::do_general(const Step& step) {
    const std::string& name = step.name;
    const std::vector<std::string>& of = step.operands;
    const auto push = [&](std::uint64_t value) {
        general_["rsp"] -= 8;
        *reinterpret_cast<std::uint64_t*>(general_["rsp"]) = value;
    };
    if (name == "vzeroupper" || name.starts_with("nop") || name == "xchg") return true;
    if (name == "push") {
        push(general_[of[0]]);
    } else if (name == "leave") {
        general_["rsp"] = general_["rbp"] + 8;
        general_["rbp"] = *reinterpret_cast<std::uint64_t*>(general_["rbp"]);
    } else if (name == "sub") {
        general_[of[0]] -= number(of[1]);
    } else if (name == "add") {
        general_[of[0]] += number(of[1]);
    } else if (name == "and") {
        general_[of[0]] &= number(of[1]);
    } else if (name == "lea") {
        general_[of[0]] = address(of[1], step.next);
    } else if (name == "mov" && of[0].find('[') != std::string::npos) {
        *reinterpret_cast<std::uint64_t*>(address(of[0], step.next)) = number(of[1]);
    } else if (name == "mov" && of[1].find('[') != std::string::npos) {
        general_[of[0]] = *reinterpret_cast<std::uint64_t*>(address(of[1], step.next));
    } else if (name == "mov" || name == "movabs") {
        general_[of[0][0] == 'e' ? "r" + of[0].substr(1) : of[0]] = number(of[1]);
    } else if (name == "call") {
        call_outside();
    } else if (name == "kortestb") {
        is_zero_ = mask_ == 0;
    } else if (name == "vtestpd") {
        is_zero_ = true;
        for (int k = 0; k < width(of[0]); ++k)
            if ((values(of[0], 0)[static_cast<std::size_t>(k)] & sign_of_number) != 0) is_zero_ = false;
    } else {
        return false;
    }
    return true;
}

/// What the code calls; what it keeps in registers is lost.
void Disassembled::call_outside() {
    const auto is = [&](auto function) { return general_["rax"] == reinterpret_cast<std::uint64_t>(function); };
    if (general_["rsp"] % 16 != 0) throw std::runtime_error("a call with a stack at an odd place");
    double* const list =
        reinterpret_cast<double*>(general_[is(sines_for_code) || is(sines_of_packs_for_code) ? "rdi" : "rsi"]);
    const auto count = static_cast<int>(general_["rsi"]);
    const auto one = reinterpret_cast<double (*)(double)>(general_["rdi"]);
    const auto two = reinterpret_cast<double (*)(double, double)>(general_["rdi"]);
    if (is(sines_for_code) || is(sines_of_packs_for_code))
        for (int k = 0; k < count; ++k)
            list[count + k] = std::sin(list[k]), list[2 * count + k] = std::cos(list[k]);
    else if (is(each_for_code))
        each_for_code(one, list);
    else if (is(each_pair_for_code))
        each_pair_for_code(two, list);
    else if (is(each_of_four_for_code))
        each_of_four_for_code(one, list);
    else if (is(each_pair_of_four_for_code))
        each_pair_of_four_for_code(two, list);
    else
        throw std::runtime_error("a call of an unknown function");
    for (Lanes& any : vectors_) any.fill(bits(std::nan("")));
    for (const char* name : {"rdi", "rsi", "rdx", "rcx", "r8", "r9", "rax"}) general_[name] = 0;
}

Disassembled::Lanes Disassembled::values(const std::string& operand, std::size_t next) const {
    if (operand[0] == 'z' || operand[0] == 'y') return vectors_.at(std::stoul(operand.substr(3)));
    Lanes result{};
    const auto* const from = reinterpret_cast<const std::uint8_t*>(address(operand, next));
    if (operand.starts_with("QWORD")) {
        std::memcpy(result.data(), from, 8);
        result.fill(result[0]);
    } else {
        std::memcpy(result.data(), from, 8 * static_cast<std::size_t>(width(operand)));
    }
    return result;
}

void Disassembled::put(const Step& step, const Lanes& found) {
    const std::string& to = step.operands[0];
    if (to[0] != 'z' && to[0] != 'y') {
        std::memcpy(reinterpret_cast<void*>(address(to, step.next)), found.data(),
                    8 * static_cast<std::size_t>(width(to)));
        return;
    }
    Lanes& kept = vectors_.at(std::stoul(to.substr(3)));
    kept = {};
    std::copy_n(found.begin(), width(to), kept.begin());
}

void Disassembled::do_vector(const Step& step) {
    const std::vector<std::string>& of = step.operands;
    if (step.name == "vcmpgt_oqpd" && of[0] == "k1") {
        const Lanes a = values(of[1], step.next), b = values(of[2], step.next);
        mask_ = 0;
        for (std::size_t k = 0; k < 8; ++k) mask_ |= real(a[k]) > real(b[k]) ? 1U << k : 0U;
        return;
    }
    const auto arithmetic = binary().find(step.name);
    const bool is_fused = step.name.starts_with("vf");
    if (arithmetic == binary().end() && !is_fused && step.name != "vsqrtpd") return do_bits(step);
    const Lanes a = values(of[is_fused ? 0 : 1], step.next),
                b = values(of[is_fused        ? 1
                              : of.size() > 2 ? 2
                                              : 1],
                           step.next),
                c = is_fused ? values(of[2], step.next) : b;
    if (step.name == "vrangepd" && of[3] != "0xb") throw std::runtime_error("another range");
    Lanes result{};
    for (std::size_t k = 0; k < 8; ++k) {
        double value = 0;
        if (step.name == "vsqrtpd")
            value = std::sqrt(real(a[k]));
        else if (!is_fused)
            value = arithmetic->second(real(a[k]), real(b[k]));
        else if (!fused(step.name, {real(a[k]), real(b[k]), real(c[k])}, value))
            throw std::runtime_error("unknown: " + step.name);
        result[k] = bits(value);
    }
    put(step, result);
}

void Disassembled::do_bits(const Step& step) {
    const std::string& name = step.name;
    const std::vector<std::string>& of = step.operands;
    const auto value = [&](std::size_t k) {
        return k < of.size() && !of[k].starts_with("0x") ? values(of[k], step.next) : Lanes{};
    };
    const Lanes own = name == "vpternlogq" ? value(0) : Lanes{}, a = value(1), b = value(2), c = value(3);
    Lanes result{};
    for (std::size_t k = 0; k < 8; ++k) {
        if (name.starts_with("vmov") || name == "vbroadcastsd")
            result[k] = a[k];
        else if (name == "vandpd")
            result[k] = a[k] & b[k];
        else if (name == "vxorpd")
            result[k] = a[k] ^ b[k];
        else if (name == "vpsllq")
            result[k] = a[k] << number(of[2]);
        else if (name == "vpsraq")
            result[k] = static_cast<std::uint64_t>(static_cast<std::int64_t>(a[k]) >> number(of[2]));
        else if (name == "vcmpgt_oqpd")
            result[k] = real(a[k]) > real(b[k]) ? ~std::uint64_t{0} : 0;
        else if (name == "vblendvpd")
            result[k] = (c[k] & sign_of_number) != 0 ? b[k] : a[k];
        else if (name == "vpternlogq")
            result[k] = by_list(number(of[3]), own[k], a[k], b[k]);
        else
            throw std::runtime_error("unknown: " + name);
    }
    put(step, result);
}

}  // namespace alembert::test
