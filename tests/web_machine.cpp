// SPDX-License-Identifier: MIT
#include "web_machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "alembert/native/simd_math.hpp"

namespace alembert::test {

namespace {

using Value = WebMachine::Value;

[[noreturn]] void refuse(const std::string& reason) {
    throw std::runtime_error("not a module: " + reason);
}

std::vector<const void*>& table() {
    static std::vector<const void*> functions(1);
    return functions;
}

void sines(double* angles, std::uint32_t distance, std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) {
        angles[distance + k] = std::sin(angles[k]);
        angles[2 * distance + k] = std::cos(angles[k]);
    }
}

Value pop(std::vector<Value>& stack, char kind) {
    if (stack.empty() || stack.back().kind != kind) refuse("the stack has another value");
    const Value top = stack.back();
    stack.pop_back();
    return top;
}

/// The arithmetic of one number, by its instruction: 0x99 … for one operand, 0xa0 … for two.
double computed(std::uint8_t code, double a, double b) {
    switch (code) {
        case 0x99:
            return std::abs(a);
        case 0x9a:
            return -a;
        case 0x9f:
            return std::sqrt(a);
        case 0xa0:
            return a + b;
        case 0xa1:
            return a - b;
        case 0xa2:
            return a * b;
        case 0xa3:
            return a / b;
        default:
            refuse("the unknown instruction " + std::to_string(code));
    }
}

}  // namespace

class WebMachine::Reader {
public:
    Reader(const std::vector<std::uint8_t>& bytes, Part part) : bytes_(bytes), at_(part.begin), end_(part.end) {}
    bool is_at_end() const { return at_ == end_; }
    std::uint8_t byte() {
        if (at_ == end_) refuse("it ends early");
        return bytes_[at_++];
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
    Part part() {
        const std::uint32_t size = number();
        if (size > end_ - at_) refuse("a part is longer than the whole");
        at_ += size;
        return {at_ - size, at_};
    }
    void expect(std::initializer_list<std::uint8_t> bytes) {
        for (const std::uint8_t b : bytes)
            if (byte() != b) refuse("another byte than expected");
    }

private:
    const std::vector<std::uint8_t>& bytes_;
    std::size_t at_, end_;
};

std::uint32_t WebMachine::place_of(const void* function) {
    table().push_back(function);
    return static_cast<std::uint32_t>(table().size() - 1);
}

WebMachine::WebMachine(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {
    Reader all(bytes_, {0, bytes_.size()});
    all.expect({0, 'a', 's', 'm', 1, 0, 0, 0});
    for (const std::uint8_t expected : {1, 2, 3, 7, 10}) {
        if (all.byte() != expected) refuse("another section than expected");
        Reader section(bytes_, all.part());
        read(expected, section);
        if (!section.is_at_end()) refuse("a section is longer than what it has");
    }
    if (!all.is_at_end()) refuse("something follows");
}

void WebMachine::read(int section, Reader& from) {
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

void WebMachine::run(std::size_t number, const std::vector<Value>& arguments) {
    std::string given;
    for (const Value& v : arguments) given += v.kind;
    if (types_.at(type_of_.at(number)) != given + ">") refuse("the function has other arguments");
    Reader body(bytes_, bodies_.at(number));
    std::vector<Value> locals = arguments, stack;
    for (std::uint32_t groups = body.number(); groups > 0; --groups) {
        const std::uint32_t count = body.number();
        const std::uint8_t type = body.byte();
        if (type != 0x7c && type != 0x7b) refuse("a local variable of another type");
        const double nothing = std::nan("");
        locals.insert(locals.end(), count, type == 0x7c ? Value(nothing) : Value(nothing, nothing));
    }
    while (step(body, locals, stack)) {
    }
    if (!stack.empty() || !body.is_at_end()) refuse("something is left at the end");
}

/// Of so many numbers, at an address whose alignment is 2^power.
double* WebMachine::place(Reader& body, std::vector<Value>& stack, unsigned power) {
    body.expect({static_cast<std::uint8_t>(power)});
    const std::uint32_t offset = body.number(), address = pop(stack, 'i').whole + offset;
    if (address % (1U << power) != 0) refuse("a place is not aligned");
    const std::size_t last = (address + (1U << power)) / 8 - 1;
    if (last >= memory.size()) refuse("a place outside of the memory");
    return &memory[address / 8];
}

/// False at the end of the function.
bool WebMachine::step(Reader& body, std::vector<Value>& locals, std::vector<Value>& stack) {
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
        case 0x22: {
            Value& local = locals.at(body.number());
            local = pop(stack, local.kind);
            if (code == 0x22) stack.push_back(local);
            break;
        }
        case 0x2b:
            stack.emplace_back(*place(body, stack, 3));
            break;
        case 0x39: {
            const double value = pop(stack, 'd').real[0];
            *place(body, stack, 3) = value;
            break;
        }
        case 0x41:
            stack.emplace_back(body.constant());
            break;
        case 0x44:
            stack.emplace_back(body.real());
            break;
        case 0xfd:
            step_vector(body, stack);
            break;
        default: {
            const double b = code >= 0xa0 ? pop(stack, 'd').real[0] : 0, a = pop(stack, 'd').real[0];
            stack.emplace_back(computed(code, a, b));
        }
    }
    return true;
}

void WebMachine::step_vector(Reader& body, std::vector<Value>& stack) {
    const std::uint32_t code = body.number();
    if (code == 0x00) {
        const double* const from = place(body, stack, 4);
        stack.emplace_back(from[0], from[1]);
    } else if (code == 0x0b) {
        const Value value = pop(stack, 'v');
        std::copy_n(value.real, 2, place(body, stack, 4));
    } else if (code == 0x14) {
        const double x = pop(stack, 'd').real[0];
        stack.emplace_back(x, x);
    } else {
        // |x|, −x, √x and the four operations have the order that they have for one number.
        const std::vector<std::pair<std::uint32_t, std::uint8_t>> single{
            {0xec, 0x99}, {0xed, 0x9a}, {0xef, 0x9f}, {0xf0, 0xa0}, {0xf1, 0xa1}, {0xf2, 0xa2}, {0xf3, 0xa3}};
        const auto found =
            std::find_if(single.begin(), single.end(), [&](const auto& s) { return s.first == code; });
        if (found == single.end()) refuse("the unknown instruction of vectors " + std::to_string(code));
        const Value b = found->second >= 0xa0 ? pop(stack, 'v') : Value(0, 0), a = pop(stack, 'v');
        stack.emplace_back(computed(found->second, a.real[0], b.real[0]),
                           computed(found->second, a.real[1], b.real[1]));
    }
}

void WebMachine::call(Reader& body, std::vector<Value>& stack) {
    const std::string& type = types_.at(body.number());
    body.expect({0});
    void* const function = const_cast<void*>(table().at(pop(stack, 'i').whole));
    const auto numbers = [&](std::size_t count) {
        const std::uint32_t address = pop(stack, 'i').whole;
        if (address % 8 != 0 || address / 8 + count > memory.size()) refuse("a place outside of the memory");
        return &memory[address / 8];
    };
    if (type == "d>d") {
        const double x = pop(stack, 'd').real[0];
        stack.emplace_back(reinterpret_cast<double (*)(double)>(function)(x));
    } else if (type == "dd>d") {
        const double y = pop(stack, 'd').real[0], x = pop(stack, 'd').real[0];
        stack.emplace_back(reinterpret_cast<double (*)(double, double)>(function)(x, y));
    } else if (type == "iii>") {
        const std::uint32_t count = pop(stack, 'i').whole, distance = pop(stack, 'i').whole;
        sines(numbers(2 * std::size_t{distance} + count), distance, count);
    } else if (type == "ii>") {
        double* const values = numbers(16);
        void* const of_one = const_cast<void*>(table().at(pop(stack, 'i').whole));
        if (function == reinterpret_cast<void*>(each_for_code))
            each_for_code(reinterpret_cast<double (*)(double)>(of_one), values);
        else
            each_pair_for_code(reinterpret_cast<double (*)(double, double)>(of_one), values);
    } else {
        refuse("an unknown type of a function");
    }
}

}  // namespace alembert::test
