// SPDX-License-Identifier: GPL-2.0-or-later
// Code in memory where the program itself is WebAssembly: the engine that runs it compiles a module beside it,
// which shares its memory and its table of functions.
//
// Where the engine refuses to compile (Chrome takes but small modules outside of workers) or a function is too
// large for it, the lines are interpreted. A function in a table has no data of its own, so that there is a fixed
// number of functions, each with a place for the lines that it runs.
#include <emscripten.h>

#include <array>
#include <utility>

#include "codegen/machine/interpreted_lines.hpp"
#include "codegen/machine/memory_code.hpp"
#include "codegen/machine/web_assembly.hpp"

// The place of the first of `count` functions in the table; 0 if the engine refuses them.
EM_JS(int, alembert_add_module, (const std::uint8_t* bytes, int size, int count), {
    try {
        const module = new WebAssembly.Module(HEAPU8.slice(bytes, bytes + size));
        const instance = new WebAssembly.Instance(module, {e : {m : wasmMemory, t : wasmTable}});
        const first = wasmTable.grow(count);
        for (let k = 0; k < count; ++k) wasmTable.set(first + k, instance.exports[k]);
        return first;
    } catch (refused) {
        return 0;
    }
});

EM_JS(void, alembert_remove_functions, (int first, int count), {
    for (let k = first; k < first + count; ++k) wasmTable.set(k, null);
});

namespace alembert::machine {

namespace {

std::uint32_t number_of(const void* pointer) {
    return reinterpret_cast<std::uintptr_t>(pointer);
}

/// Functions in the table, which is as long as it was at its longest, and the memory that they use.
struct InTable {
    InTable(int at, int size, std::shared_ptr<const void> memory)
        : first(at), count(size), used(std::move(memory)) {}
    InTable(const InTable&) = delete;
    InTable& operator=(const InTable&) = delete;
    ~InTable() { alembert_remove_functions(first, count); }
    int first, count;
    std::shared_ptr<const void> used;
};

constexpr std::size_t longest_block = 1 << 14;  // of sines, in numbers

/// What an interpreted function runs: lines, or a function with one more argument.
struct Interpreted {
    InterpretedLines lines;
    const void* function = nullptr;
    const void* last = nullptr;
};

constexpr std::size_t places = 64;  // for functions of the same arguments
constexpr int most_arrays = 6, called_arrays = 5;

/// The functions with or without t, and with so many arrays: each runs what is in its place.
template <bool takes_time, typename... Array>
struct Places {
    static inline std::array<std::shared_ptr<const Interpreted>, places> held;

    template <std::size_t place>
    static void run(double t, Array... array) {
        const Interpreted& own = *held[place];
        if constexpr (takes_time && sizeof...(Array) == called_arrays)
            if (own.function != nullptr) {
                using Function =
                    void (*)(double, Array..., const void*);  // pointers and int are the same kind here
                return reinterpret_cast<Function>(const_cast<void*>(own.function))(t, array..., own.last);
            }
        double* const arrays[] = {array...};
        own.lines.run(t, arrays);
    }
    template <std::size_t place>
    static void run_without_time(Array... array) {
        run<place>(0, array...);
    }
    template <std::size_t... place>
    static std::uint32_t function(std::size_t wanted, std::index_sequence<place...>) {
        if constexpr (takes_time) {
            constexpr void (*list[])(double, Array...) = {run<place>...};
            return number_of(reinterpret_cast<const void*>(list[wanted]));
        } else {
            constexpr void (*list[])(Array...) = {run_without_time<place>...};
            return number_of(reinterpret_cast<const void*>(list[wanted]));
        }
    }
};

/// Functions of a solver that are interpreted. Their places are free again afterwards.
class Interpreting {
public:
    Interpreting() = default;
    Interpreting(const Interpreting&) = delete;
    Interpreting& operator=(const Interpreting&) = delete;
    ~Interpreting() {
        for (std::shared_ptr<const Interpreted>* place : taken_) place->reset();
    }

    /// The function that runs this; 0 if all places are taken.
    std::uint32_t add(const std::shared_ptr<const Interpreted>& what, bool takes_time, int arrays) {
        return takes_time ? find<true>(what, arrays) : find<false>(what, arrays);
    }

private:
    template <bool takes_time, typename... Array>
    std::uint32_t find(const std::shared_ptr<const Interpreted>& what, int arrays) {
        if constexpr (static_cast<int>(sizeof...(Array)) > most_arrays) {
            return 0;
        } else {
            if (arrays != static_cast<int>(sizeof...(Array)))
                return find<takes_time, Array..., double*>(what, arrays);
            using Own = Places<takes_time, Array...>;
            for (std::size_t place = 0; place < places; ++place) {
                if (Own::held[place]) continue;
                Own::held[place] = what;
                taken_.push_back(&Own::held[place]);
                return Own::function(place, std::make_index_sequence<places>());
            }
            return 0;
        }
    }
    std::vector<std::shared_ptr<const Interpreted>*> taken_;
};

}  // namespace

struct MemoryCode::Parts {
    struct Function {
        Put put = {};
        Lines lines = {};
        const void* function = nullptr;
        const void* last = nullptr;
    };
    int lanes = 1;
    std::shared_ptr<std::vector<double>> block = std::make_shared<std::vector<double>>(longest_block);
    ModuleOfLines module{{.block = number_of(block->data()),
                          .sines = number_of(reinterpret_cast<const void*>(sines_in_place)),
                          .place_of = number_of}};
    bool is_possible = true;  ///< as code
    std::vector<Function> functions = {};

    void add(const Lines& lines) {
        is_possible = is_possible && room_in_block(lines) <= longest_block && module.add(lines);
        functions.push_back({.lines = lines});
    }

    std::shared_ptr<const void> interpreted() const {
        const auto interpreting = std::make_shared<Interpreting>();
        for (const Function& one : functions) {
            if (one.lines.lanes != 1) return nullptr;
            const bool is_call = one.function != nullptr;
            const auto what = std::make_shared<const Interpreted>(
                Interpreted{.lines = InterpretedLines(one.lines), .function = one.function, .last = one.last});
            const std::uint32_t place = interpreting->add(what, is_call || one.lines.takes_time,
                                                          is_call ? called_arrays : one.lines.arrays);
            if (place == 0) return nullptr;
            one.put(place);
        }
        return interpreting;
    }
};

MemoryCode::MemoryCode(int lanes, int) : parts_(new Parts{.lanes = lanes}) {}
MemoryCode::~MemoryCode() = default;

int MemoryCode::lanes() const {
    return parts_->lanes;
}

/// Sines inside need fused multiply-add, without which the reduction of their angles is wrong: those that are
/// called take their place at all angles.
std::size_t MemoryCode::write_aside(const Lines& lines) {
    parts_->add(lines);
    return parts_->functions.size();
}

void MemoryCode::write(const Lines& lines, std::size_t other, Put put) {
    if (other == 0) {
        parts_->add(lines);
        other = parts_->functions.size();
    }
    parts_->functions[other - 1].put = std::move(put);
}

void MemoryCode::write_call(const void* function, const void* last, Put put) {
    parts_->module.add_call(number_of(function), number_of(last));
    parts_->functions.push_back({.put = std::move(put), .function = function, .last = last});
}

std::shared_ptr<const void> MemoryCode::placed() {
    if (!parts_->is_possible) return parts_->interpreted();
    const std::vector<std::uint8_t> bytes = parts_->module.bytes();
    const int count = parts_->module.size();
    const int first = alembert_add_module(bytes.data(), static_cast<int>(bytes.size()), count);
    if (first == 0) return parts_->interpreted();
    for (int k = 0; k < count; ++k)
        parts_->functions[static_cast<std::size_t>(k)].put(static_cast<std::uintptr_t>(first + k));
    return std::make_shared<const InTable>(first, count, parts_->block);
}

bool can_run(int) {
    return true;
}

int lanes_of_processor() {
    return 8;
}

int registers_of_processor() {
    return 16;
}

}  // namespace alembert::machine
