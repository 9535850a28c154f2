// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <algorithm>

namespace alembert {

/// Sets GiNaC's precision, which is one for the whole program, to at least so many digits during its lifetime.
class ManyDigits {
public:
    explicit ManyDigits(long digits) : former_(GiNaC::Digits) { GiNaC::Digits = std::max(former_, digits); }
    ~ManyDigits() { GiNaC::Digits = former_; }
    ManyDigits(const ManyDigits&) = delete;
    ManyDigits& operator=(const ManyDigits&) = delete;

private:
    long former_;
};

class FiftyDigits : public ManyDigits {
public:
    FiftyDigits() : ManyDigits(50) {}
};

}  // namespace alembert
