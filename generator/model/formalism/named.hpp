// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// An expression as a scalar type. Every result gets an intermediate symbol, so that no expression grows beyond a
/// line.

#include "algebra/symbolic/intermediates.hpp"

namespace alembert {

struct Named {
    Named(int value = 0) : e(value) {}
    Named(const GiNaC::ex& value, Intermediates& table) : e(table.name(value)), z(&table) {}

    GiNaC::ex e;
    Intermediates* z = nullptr;  ///< null for a number

    friend Named operator+(const Named& a, const Named& b) { return of(a.e + b.e, a, b); }
    friend Named operator-(const Named& a, const Named& b) { return of(a.e - b.e, a, b); }
    friend Named operator*(const Named& a, const Named& b) { return of(a.e * b.e, a, b); }
    friend Named operator/(const Named& a, const Named& b) { return of(a.e / b.e, a, b); }
    Named operator-() const { return of(-e, *this, *this); }

private:
    static Named of(const GiNaC::ex& value, const Named& a, const Named& b) {
        Intermediates* table = a.z != nullptr ? a.z : b.z;
        Named result;
        result.e = table != nullptr ? table->name(value) : value;
        result.z = table;
        return result;
    }
};

}  // namespace alembert
