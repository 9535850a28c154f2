// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

namespace alembert {

/// Sets GiNaC's precision, which is one for the whole program, to fifty digits during its lifetime.
class FiftyDigits {
public:
    FiftyDigits() : former_(GiNaC::Digits) { GiNaC::Digits = 50; }
    ~FiftyDigits() { GiNaC::Digits = former_; }
    FiftyDigits(const FiftyDigits&) = delete;
    FiftyDigits& operator=(const FiftyDigits&) = delete;

private:
    long former_;
};

}  // namespace alembert
