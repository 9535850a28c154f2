// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/web_assembly.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

#include "alembert/native/simd_math.hpp"

namespace alembert::machine {

namespace {

using Bytes = ModuleOfLines::Bytes;

constexpr std::size_t most_locals = 40'000, most_bytes = 7'000'000;  // engines take 50 000 and 7 654 321
constexpr std::uint8_t number_64 = 0x7c, number_32 = 0x7f, two_numbers = 0x7b;
constexpr int in_vector = 2;  // lanes of a vector, which has 128 bits

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
    divide = 0xa3,
    vector = 0xfd  // the prefix of the instructions of vectors
};

/// Those of vectors that stand for instructions of one number, and others.
enum VectorCode : std::uint8_t { load_vector = 0x00, store_vector = 0x0b, in_both = 0x14 };
std::uint32_t of_vectors(Code code) {
    switch (code) {
        case load_64:
            return load_vector;
        case store_64:
            return store_vector;
        case absolute:
            return 0xec;
        case negative:
            return 0xed;
        case root:
            return 0xef;
        default:  // add, subtract, multiply, divide
            return 0xf0U + (code - add);
    }
}

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

/// One function. A value has a local variable, in packs four, which are given back after its last use.
class WebFunction {
public:
    WebFunction(ModuleOfLines& module, const Lines& lines)
        : module_(module),
          l_(lines),
          lanes_(static_cast<std::uint32_t>(lines.lanes)),
          parts_(lines.lanes == 1 ? 1 : lanes_ / in_vector),
          arguments_((lines.takes_time ? 1U : 0U) + static_cast<std::uint32_t>(lines.arrays)),
          local_(lines.homes.size(), none),
          uses_(lines.homes.size(), 0) {
        for (const Line& line : l_.list) each_used(line, [&](int v) { ++uses_[v]; });
    }

    /// Declarations and instructions; empty if there are too many.
    Bytes body() {
        for (const Line& line : l_.list) write(line);
        code_.push_back(end);
        const std::uint32_t count = parts_ * count_;
        if (count > most_locals || code_.size() > most_bytes) return {};
        Bytes result;
        put(result, count > 0 ? 1 : 0);
        if (count > 0) {
            put(result, count);
            result.push_back(is_packed() ? two_numbers : number_64);
        }
        append(result, code_);
        return result;
    }

private:
    static constexpr std::uint32_t none = ~0U;

    /// Where an operand is when its line begins.
    struct Operand {
        int value;
        std::uint32_t local;  ///< its first one; none if it is in memory
        std::uint32_t kept;   ///< the first one that it gets, if it is used again
    };

    bool is_packed() const { return lanes_ > 1; }

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
    void instruction(Code code) {
        if (!is_packed()) return code_.push_back(code);
        code_.push_back(vector);
        put(code_, of_vectors(code));
    }
    /// At a value that lies behind the address on the stack of operands; `place` counts values.
    void at_place(Code code, std::uint64_t place, std::uint32_t part) {
        instruction(code);
        code_.push_back(is_packed() ? 4 : 3);  // places are multiples of 2⁴ and 2³
        put(code_, 8 * (lanes_ * place + in_vector * part));
    }

    std::uint32_t free_local() {
        if (free_.empty()) return arguments_ + parts_ * count_++;
        const std::uint32_t found = free_.back();
        free_.pop_back();
        return found;
    }

    /// One use of a value. In the order in which the operands are pushed; a result may take the place of one.
    Operand used(int v) {
        const bool is_last = --uses_[v] == 0;
        Operand found{.value = v, .local = local_[v], .kept = none};
        const Home::Kind kind = l_.homes[static_cast<std::size_t>(v)].kind;
        if (found.local != none) {
            if (is_last) free_.push_back(found.local);
        } else if (!is_last && kind != Home::Kind::constant && (is_packed() || kind != Home::Kind::time)) {
            found.kept = local_[v] = free_local();
        }
        return found;
    }

    /// A part of the value on the stack of operands: two lanes, or the number.
    void push(const Operand& x, std::uint32_t part) {
        if (x.local != none) return local(get, x.local + part);
        const Home& home = l_.homes[static_cast<std::size_t>(x.value)];
        switch (home.kind) {
            case Home::Kind::time:
                local(get, 0);
                if (is_packed()) at_place(load_64, 0, part);
                break;
            case Home::Kind::constant:
                code_.push_back(constant_64);
                for (const auto byte : std::bit_cast<std::array<std::uint8_t, 8>>(home.number))
                    code_.push_back(byte);
                if (is_packed()) code_.insert(code_.end(), {vector, in_both});
                break;
            case Home::Kind::argument:
                array(home.argument);
                at_place(load_64, static_cast<std::uint64_t>(home.place), part);
                break;
            default:
                put_constant(code_, module_.host_.block);
                at_place(load_64, static_cast<std::uint64_t>(home.place), part);
        }
        if (x.kept != none) local(tee, x.kept + part);
    }

    /// The result's part on the stack of operands becomes that of its local variables.
    void keep(std::uint32_t to, std::uint32_t part) {
        if (to == none) return code_.push_back(drop);
        local(set, to + part);
    }

    void call(const std::string& type, std::uint32_t function) {
        put_constant(code_, function);
        code_.push_back(call_indirect);
        put(code_, module_.type(type));
        code_.push_back(0);
    }

    /// ± a·b ± c; with −a·b + c as c − a·b.
    void fused(const Line& line, const std::array<Operand, 3>& x, std::uint32_t part) {
        const bool is_from = line.minus_product && !line.minus_rest;
        if (is_from) push(x[2], part);
        push(x[0], part);
        push(x[1], part);
        instruction(multiply);
        if (is_from) return instruction(subtract);
        if (line.minus_product) instruction(negative);
        push(x[2], part);
        instruction(line.minus_rest ? subtract : add);
    }

    void sines(const SineGroup& group) {
        const std::uint32_t block = module_.host_.block;
        for (std::size_t k = 0; k < group.angles.size(); ++k) {
            const Operand x = used(group.angles[k]);
            for (std::uint32_t part = 0; part < parts_; ++part) {
                put_constant(code_, block);
                push(x, part);
                at_place(store_64, static_cast<std::uint64_t>(group.place) + k, part);
            }
        }
        put_constant(code_, block + 8 * lanes_ * static_cast<std::uint32_t>(group.place));
        put_constant(code_, lanes_ * static_cast<std::uint32_t>(group.size));
        put_constant(code_, lanes_ * static_cast<std::uint32_t>(group.angles.size()));
        call("iii>", module_.host_.sines);
    }

    static const void* each_of(std::uint64_t arguments) {
        return arguments == 1   ? reinterpret_cast<const void*>(each_for_code)
               : arguments == 2 ? reinterpret_cast<const void*>(each_pair_for_code)
                                : reinterpret_cast<const void*>(each_triple_for_code);
    }

    /// A function of eight values, which stand behind the block of sines.
    void call_packed(const Line& line, const std::array<Operand, 3>& x, std::uint32_t to) {
        const std::uint64_t arguments = line.of[1] < 0 ? 1 : line.of[2] < 0 ? 2 : 3;
        const auto place = static_cast<std::uint64_t>(l_.block);
        for (std::uint64_t k = 0; k < arguments; ++k)
            for (std::uint32_t part = 0; part < parts_; ++part) {
                put_constant(code_, module_.host_.block);
                push(x[k], part);
                at_place(store_64, place + k, part);
            }
        put_constant(code_, module_.host_.place_of(line.function));
        put_constant(code_, module_.host_.block + 8 * lanes_ * static_cast<std::uint32_t>(l_.block));
        call("ii>", module_.host_.place_of(each_of(arguments)));
        for (std::uint32_t part = 0; part < parts_; ++part) {
            put_constant(code_, module_.host_.block);
            at_place(load_64, place, part);
            keep(to, part);
        }
    }

    void write(const Line& line) {
        if (line.kind == Line::Kind::sines) return sines(l_.groups[static_cast<std::size_t>(line.place)]);
        const bool last_is_first = line.kind == Line::Kind::fused && line.minus_product && !line.minus_rest;
        std::array<Operand, 3> x{};
        if (last_is_first) x[2] = used(line.of[2]);
        for (std::size_t k = 0; k < 3; ++k)
            if (line.of[k] >= 0 && !(last_is_first && k == 2)) x[k] = used(line.of[k]);
        const std::uint32_t to = line.to >= 0 && uses_[line.to] > 0 ? local_[line.to] = free_local() : none;
        if (line.kind == Line::Kind::call && is_packed()) return call_packed(line, x, to);
        for (std::uint32_t part = 0; part < parts_; ++part) {
            write(line, x, part);
            if (line.kind != Line::Kind::store) keep(to, part);
        }
    }

    void write(const Line& line, const std::array<Operand, 3>& x, std::uint32_t part) {
        if (line.kind == Line::Kind::fused) return fused(line, x, part);
        if (line.kind == Line::Kind::store) array(line.argument);
        push(x[0], part);
        if (line.of[1] >= 0) push(x[1], part);
        if (line.kind == Line::Kind::call && line.of[2] >= 0) push(x[2], part);
        switch (line.kind) {
            case Line::Kind::add:
                return instruction(add);
            case Line::Kind::subtract:
                return instruction(subtract);
            case Line::Kind::multiply:
                return instruction(multiply);
            case Line::Kind::divide:
                return instruction(divide);
            case Line::Kind::root:
                return instruction(root);
            case Line::Kind::absolute:
                return instruction(absolute);
            case Line::Kind::negative:
                return instruction(negative);
            case Line::Kind::call:
                return call(line.of[1] < 0   ? "d>d"
                            : line.of[2] < 0 ? "dd>d"
                                             : "ddd>d",
                            module_.host_.place_of(line.function));
            case Line::Kind::store:
                return at_place(store_64, static_cast<std::uint64_t>(line.place), part);
            default:
                throw std::logic_error("a line that needs fused multiply-add in a module of WebAssembly");
        }
    }

    ModuleOfLines& module_;
    const Lines& l_;
    std::uint32_t lanes_, parts_, arguments_;
    std::vector<std::uint32_t> local_;  ///< of each value
    std::vector<int> uses_;             ///< that are still to come
    std::vector<std::uint32_t> free_;
    std::uint32_t count_ = 0;  ///< of values with local variables at the same time
    Bytes code_;
};

bool ModuleOfLines::add(const Lines& lines) {
    std::string arguments = lines.takes_time ? lines.lanes == 1 ? "d" : "i" : "";
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
