// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/interpreted_lines.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace alembert::machine {

namespace {

double called(const Line& line, const double* value) {
    void* const code = const_cast<void*>(line.function);
    const auto of = [&](std::size_t k) { return value[line.of[k]]; };
    if (line.of[1] < 0) return reinterpret_cast<double (*)(double)>(code)(of(0));
    if (line.of[2] < 0) return reinterpret_cast<double (*)(double, double)>(code)(of(0), of(1));
    return reinterpret_cast<double (*)(double, double, double)>(code)(of(0), of(1), of(2));
}

double computed(const Line& line, const double* value) {
    const auto of = [&](std::size_t k) { return value[line.of[k]]; };
    switch (line.kind) {
        case Line::Kind::add:
            return of(0) + of(1);
        case Line::Kind::subtract:
            return of(0) - of(1);
        case Line::Kind::multiply:
            return of(0) * of(1);
        case Line::Kind::divide:
            return of(0) / of(1);
        case Line::Kind::root:
            return std::sqrt(of(0));
        case Line::Kind::absolute:
            return std::abs(of(0));
        case Line::Kind::negative:
            return -of(0);
        case Line::Kind::fused: {
            const double product = line.minus_product ? -(of(0) * of(1)) : of(0) * of(1);
            return line.minus_rest ? product - of(2) : product + of(2);
        }
        case Line::Kind::call:
            return called(line, value);
        default:
            throw std::logic_error("a line of packs in a function for one system");
    }
}

}  // namespace

void sines_in_place(double* angles, int distance, int count) {
    for (int k = 0; k < count; ++k) {
        angles[distance + k] = std::sin(angles[k]);
        angles[2 * distance + k] = std::cos(angles[k]);
    }
}

InterpretedLines::InterpretedLines(Lines lines) : l_(std::move(lines)) {
    if (l_.lanes != 1) throw std::logic_error("packs are not interpreted");
    for (const Home& home : l_.homes) first_.push_back(home.number);
}

void InterpretedLines::run(double t, double* const* arrays) const {
    std::vector<double> value = first_, block(static_cast<std::size_t>(l_.block));
    for (std::size_t v = 0; v < value.size(); ++v)
        if (const Home& home = l_.homes[v]; home.kind == Home::Kind::argument)
            value[v] = arrays[home.argument][home.place];
        else if (home.kind == Home::Kind::time)
            value[v] = t;
    for (const Line& line : l_.list) {
        if (line.kind == Line::Kind::store) {
            arrays[line.argument][line.place] = value[static_cast<std::size_t>(line.of[0])];
        } else if (line.kind == Line::Kind::sines) {
            const SineGroup& group = l_.groups[static_cast<std::size_t>(line.place)];
            double* const angles = block.data() + group.place;
            for (std::size_t k = 0; k < group.angles.size(); ++k)
                angles[k] = value[static_cast<std::size_t>(group.angles[k])];
            sines_in_place(angles, group.size, static_cast<int>(group.angles.size()));
            for (std::size_t v = 0; v < value.size(); ++v)
                if (l_.homes[v].kind == Home::Kind::block && l_.homes[v].place >= group.place &&
                    l_.homes[v].place < group.place + 3 * group.size)
                    value[v] = block[static_cast<std::size_t>(l_.homes[v].place)];
        } else {
            value[static_cast<std::size_t>(line.to)] = computed(line, value.data());
        }
    }
}

}  // namespace alembert::machine
