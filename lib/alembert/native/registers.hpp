// SPDX-License-Identifier: MIT
#pragma once

/// The registers of this processor that our code uses, and what g++ and clang need to compile for them.
///
///     ALEMBERT_WIDE void sum_4(…);
///     ALEMBERT_WIDEST void sum_8(…);
///     const auto sum = registers() == Registers::widest ? sum_8 : sum_4;

namespace alembert {

#if defined(__x86_64__)
#define ALEMBERT_WIDE __attribute__((target("avx2,fma")))
#define ALEMBERT_WIDEST __attribute__((target("avx512f,avx512dq,avx512vl,fma")))
#define ALEMBERT_WIDE_SAME_DIGITS __attribute__((target("avx2")))  // no product is added in one rounding
#else
#define ALEMBERT_WIDE
#define ALEMBERT_WIDE_SAME_DIGITS
#define ALEMBERT_WIDEST
#endif

enum class Registers {
    usual,
    wide,   ///< 16 registers of four numbers, with products that are added at once (AVX2, FMA)
    widest  ///< 32 registers of eight numbers (AVX-512 with its parts F, DQ and VL)
};

inline Registers registers() {
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return Registers::usual;
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512vl")
               ? Registers::widest
               : Registers::wide;
#else
    return Registers::usual;
#endif
}

/// "SSE2", "AVX2" or "AVX-512", for people; "other" where the processor is not an x86-64.
inline const char* name_of(Registers kind) {
#if defined(__x86_64__)
    constexpr const char* names[] = {"SSE2", "AVX2", "AVX-512"};
    return names[static_cast<int>(kind)];
#else
    (void)kind;
    return "other";
#endif
}

/// A register of so many numbers. Each for itself, so that its type is known where a template is read.
template <int width>
struct RegisterOf;
template <>
struct RegisterOf<2> {
    using Lane [[gnu::vector_size(2 * sizeof(double)), gnu::may_alias]] = double;
};
template <>
struct RegisterOf<4> {
    using Lane [[gnu::vector_size(4 * sizeof(double)), gnu::may_alias]] = double;
};

}  // namespace alembert
