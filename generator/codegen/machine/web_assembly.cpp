// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/web_assembly.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

namespace alembert::machine {

namespace {

using Bytes = ModuleOfLines::Bytes;

constexpr std::size_t most_locals = 40'000, most_bytes = 7'000'000;  // engines take 50 000 and 7 654 321
constexpr std::uint8_t number_64 = 0x7c, number_32 = 0x7f;

enum Code : std::uint8_t {
    end = 0x0b,
    call_indirect = 0x11,
    drop = 0x1a,
    get = 0x20,
    set = 0x21,
    tee = 0x22,
    load_64 = 0x2b,
    store_64 = 0x39,
    constant_32 = 0x41,
    constant_64 = 0x44,
    absolute = 0x99,
    negative = 0x9a,
    root = 0x9f,
    add = 0xa0,
    subtract = 0xa1,
    multiply = 0xa2,
    divide = 0xa3
};

/// LEB128, of numbers without a sign.
void put(Bytes& to, std::uint64_t value) {
    do {
        const auto low = static_cast<std::uint8_t>(value & 0x7fU);
        value >>= 7U;
        to.push_back(value != 0 ? low | 0x80U : low);
    } while (value != 0);
}

/// LEB128, of numbers of 32 bits with a sign.
void put_constant(Bytes& to, std::uint32_t bits) {
    to.push_back(constant_32);
    auto value = static_cast<std::int32_t>(bits);
    for (;;) {
        const auto low = static_cast<std::uint8_t>(value & 0x7f);
        value >>= 7;
        const bool is_last = value == ((low & 0x40U) != 0 ? -1 : 0);
        to.push_back(is_last ? low : low | 0x80U);
        if (is_last) return;
    }
}

void put(Bytes& to, const std::string& text) {
    put(to, text.size());
    to.insert(to.end(), text.begin(), text.end());
}

void append(Bytes& to, const Bytes& more) {
    to.insert(to.end(), more.begin(), more.end());
}

void put_section(Bytes& to, std::uint8_t number, const Bytes& content) {
    to.push_back(number);
    put(to, content.size());
    append(to, content);
}

}  // namespace

/// One function. A local variable is given back after the last use of its value.
class WebFunction {
public:
    WebFunction(ModuleOfLines& module, const Lines& lines)
        : module_(module),
          l_(lines),
          arguments_((lines.takes_time ? 1U : 0U) + static_cast<std::uint32_t>(lines.arrays)),
          local_(lines.homes.size(), none),
          uses_(lines.homes.size(), 0) {
        for (const Line& line : l_.list) each_used(line, [&](int v) { ++uses_[v]; });
    }

    /// Declarations and instructions; empty if there are too many.
    Bytes body() {
        for (const Line& line : l_.list) write(line);
        code_.push_back(end);
        if (count_ > most_locals || code_.size() > most_bytes) return {};
        Bytes result;
        put(result, count_ > 0 ? 1 : 0);
        if (count_ > 0) {
            put(result, count_);
            result.push_back(number_64);
        }
        append(result, code_);
        return result;
    }

private:
    static constexpr std::uint32_t none = ~0U;

    template <typename Use>
    void each_used(const Line& line, const Use& use) const {
        if (line.kind == Line::Kind::sines)
            for (const int v : l_.groups[static_cast<std::size_t>(line.place)].angles) use(v);
        for (const int v : line.of)
            if (v >= 0) use(v);
    }

    void local(Code code, std::uint32_t number) {
        code_.push_back(code);
        put(code_, number);
    }
    void array(int number) { local(get, static_cast<std::uint32_t>(number) + (l_.takes_time ? 1U : 0U)); }
    void at_place(Code code, std::uint64_t place) {
        code_.push_back(code);
        code_.push_back(3);  // places are multiples of 8 = 2³
        put(code_, 8 * place);
    }

    std::uint32_t free_local() {
        if (free_.empty()) return arguments_ + count_++;
        const std::uint32_t found = free_.back();
        free_.pop_back();
        return found;
    }

    /// The value on the stack of operands.
    void push(int v) {
        const Home& home = l_.homes[static_cast<std::size_t>(v)];
        const bool is_last = --uses_[v] == 0;
        if (home.kind == Home::Kind::time) return local(get, 0);
        if (home.kind == Home::Kind::constant) {
            code_.push_back(constant_64);
            for (const auto byte : std::bit_cast<std::array<std::uint8_t, 8>>(home.number)) code_.push_back(byte);
            return;
        }
        if (local_[v] != none) {
            local(get, local_[v]);
            if (is_last) free_.push_back(local_[v]);
            return;
        }
        if (home.kind == Home::Kind::argument) {
            array(home.argument);
            at_place(load_64, static_cast<std::uint64_t>(home.place));
        } else {
            put_constant(code_, module_.host_.block);
            at_place(load_64, static_cast<std::uint64_t>(home.place));
        }
        if (!is_last) local(tee, local_[v] = free_local());
    }

    void keep(int v) {
        if (uses_[v] == 0) return code_.push_back(drop);
        local(set, local_[v] = free_local());
    }

    void call(const std::string& type, std::uint32_t function) {
        put_constant(code_, function);
        code_.push_back(call_indirect);
        put(code_, module_.type(type));
        code_.push_back(0);
    }

    void binary(const Line& line, Code code) {
        push(line.of[0]);
        push(line.of[1]);
        code_.push_back(code);
    }

    /// ± a·b ± c; with −a·b + c as c − a·b.
    void fused(const Line& line) {
        const bool is_from = line.minus_product && !line.minus_rest;
        if (is_from) push(line.of[2]);
        binary(line, multiply);
        if (is_from) return code_.push_back(subtract);
        if (line.minus_product) code_.push_back(negative);
        push(line.of[2]);
        code_.push_back(line.minus_rest ? subtract : add);
    }

    void sines(const SineGroup& group) {
        const std::uint32_t block = module_.host_.block;
        for (std::size_t k = 0; k < group.angles.size(); ++k) {
            put_constant(code_, block);
            push(group.angles[k]);
            at_place(store_64, static_cast<std::uint64_t>(group.place) + k);
        }
        put_constant(code_, block + 8 * static_cast<std::uint32_t>(group.place));
        put_constant(code_, static_cast<std::uint32_t>(group.size));
        put_constant(code_, static_cast<std::uint32_t>(group.angles.size()));
        call("iii>", module_.host_.sines);
    }

    void write(const Line& line) {
        switch (line.kind) {
            case Line::Kind::add:
                binary(line, add);
                break;
            case Line::Kind::subtract:
                binary(line, subtract);
                break;
            case Line::Kind::multiply:
                binary(line, multiply);
                break;
            case Line::Kind::divide:
                binary(line, divide);
                break;
            case Line::Kind::root:
            case Line::Kind::absolute:
            case Line::Kind::negative:
                push(line.of[0]);
                code_.push_back(line.kind == Line::Kind::root       ? root
                                : line.kind == Line::Kind::absolute ? absolute
                                                                    : negative);
                break;
            case Line::Kind::fused:
                fused(line);
                break;
            case Line::Kind::call:
                push(line.of[0]);
                if (line.of[1] >= 0) push(line.of[1]);
                call(line.of[1] >= 0 ? "dd>d" : "d>d", module_.host_.place_of(line.function));
                break;
            case Line::Kind::sines:
                return sines(l_.groups[static_cast<std::size_t>(line.place)]);
            case Line::Kind::store:
                array(line.argument);
                push(line.of[0]);
                return at_place(store_64, static_cast<std::uint64_t>(line.place));
            default:
                throw std::logic_error("a line of packs in a function for one system");
        }
        keep(line.to);
    }

    ModuleOfLines& module_;
    const Lines& l_;
    std::uint32_t arguments_;
    std::vector<std::uint32_t> local_;  ///< of each value
    std::vector<int> uses_;             ///< that are still to come
    std::vector<std::uint32_t> free_;
    std::uint32_t count_ = 0;
    Bytes code_;
};

bool ModuleOfLines::add(const Lines& lines) {
    std::string arguments = lines.takes_time ? "d" : "";
    arguments.append(static_cast<std::size_t>(lines.arrays), 'i');
    Bytes body = WebFunction(*this, lines).body();
    if (body.empty()) return false;
    type_of_.push_back(type(arguments + ">"));
    bodies_.push_back(std::move(body));
    return true;
}

void ModuleOfLines::add_call(std::uint32_t function, std::uint32_t last) {
    constexpr std::uint8_t given = 6;
    Bytes body{0};
    for (std::uint8_t k = 0; k < given; ++k) body.insert(body.end(), {get, k});
    put_constant(body, last);
    put_constant(body, function);
    body.push_back(call_indirect);
    put(body, type("diiiiii>"));
    body.insert(body.end(), {0, end});
    type_of_.push_back(type("diiiii>"));
    bodies_.push_back(std::move(body));
}

std::uint32_t ModuleOfLines::type(const std::string& of) {
    const auto known = std::find(types_.begin(), types_.end(), of);
    if (known != types_.end()) return static_cast<std::uint32_t>(known - types_.begin());
    types_.push_back(of);
    return static_cast<std::uint32_t>(types_.size() - 1);
}

std::vector<std::uint8_t> ModuleOfLines::bytes() const {
    Bytes types, imports{2}, functions, exports, codes;
    put(types, types_.size());
    for (const std::string& type : types_) {
        types.push_back(0x60);
        for (std::size_t begin = 0, i = 0; i <= type.size(); ++i) {
            if (i < type.size() && type[i] != '>') continue;
            put(types, i - begin);
            for (; begin < i; ++begin) types.push_back(type[begin] == 'd' ? number_64 : number_32);
            ++begin;
        }
    }
    for (const char* const name : {"m", "t"}) {
        put(imports, std::string("e"));
        put(imports, std::string(name));
        if (*name == 'm')
            imports.insert(imports.end(), {2, 0, 0});  // memory, of any size
        else
            imports.insert(imports.end(), {1, 0x70, 0, 0});  // a table of functions, of any size
    }
    for (Bytes* const list : {&functions, &exports, &codes}) put(*list, bodies_.size());
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        put(functions, type_of_[k]);
        put(exports, std::to_string(k));
        exports.push_back(0);
        put(exports, k);
        put(codes, bodies_[k].size());
        append(codes, bodies_[k]);
    }
    Bytes result{0, 'a', 's', 'm', 1, 0, 0, 0};
    put_section(result, 1, types);
    put_section(result, 2, imports);
    put_section(result, 3, functions);
    put_section(result, 7, exports);
    put_section(result, 10, codes);
    return result;
}

}  // namespace alembert::machine
