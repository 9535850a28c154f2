// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/reserved_words.hpp"

#include <algorithm>
#include <iterator>

namespace alembert {

namespace {

// clang-format off
constexpr std::string_view keywords[] = {
    "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "bool", "break", "case", "catch",
    "char", "char8_t", "char16_t", "char32_t", "class", "compl", "concept", "const", "consteval", "constexpr",
    "constinit", "const_cast", "continue", "co_await", "co_return", "co_yield", "decltype", "default", "delete",
    "do", "double", "dynamic_cast", "else", "enum", "explicit", "export", "extern", "false", "float", "for",
    "friend", "goto", "if", "inline", "int", "long", "mutable", "namespace", "new", "noexcept", "not", "not_eq",
    "nullptr", "operator", "or", "or_eq", "private", "protected", "public", "register", "reinterpret_cast",
    "requires", "return", "short", "signed", "sizeof", "static", "static_assert", "static_cast", "struct",
    "switch", "template", "this", "thread_local", "throw", "true", "try", "typedef", "typeid", "typename",
    "typeof", "typeof_unqual", "union", "unsigned", "using", "virtual", "void", "volatile", "wchar_t", "while",
    "xor", "xor_eq", "final", "override", "import", "module", "restrict"};

// What JavaScript reserves in a module (ECMAScript 2024, 12.7.2) and C++ does not, what cannot be assigned there, and the
// objects that templates/solver.js.mustache uses.
constexpr std::string_view javascript[] = {
    "arguments", "async", "await", "debugger", "eval", "extends", "finally", "function", "implements", "in",
    "instanceof", "let", "null", "of", "package", "super", "undefined", "var", "with", "yield", "NaN", "Infinity",
    "Math", "Float64Array", "PI", "defaults", "parameter_values", "initial_state", "initial_time", "values"};

// The macros of the headers of C, C++ and POSIX that do not have the shape of a macro (those of Debian 12 and 13),
// further functions of C23, and some that compilers for other systems define.
constexpr std::string_view macros[] = {
    "B0", "B1000000", "B110", "B115200", "B1152000", "B1200", "B134", "B150", "B1500000", "B1800", "B19200",
    "B200", "B2000000", "B230400", "B2400", "B2500000", "B300", "B3000000", "B3500000", "B38400", "B4000000",
    "B460800", "B4800", "B50", "B500000", "B57600", "B576000", "B600", "B75", "B921600", "B9600", "I",
    "L_ctermid", "L_cuserid", "L_tmpnam", "P_tmpdir", "acosh", "acospi", "alloca", "arm", "asinh", "asinpi",
    "assert", "assert_perror", "atan2pi", "atanh", "atanpi", "atomic_compare_exchange_strong",
    "atomic_compare_exchange_strong_explicit", "atomic_compare_exchange_weak",
    "atomic_compare_exchange_weak_explicit", "atomic_exchange", "atomic_exchange_explicit", "atomic_fetch_add",
    "atomic_fetch_add_explicit", "atomic_fetch_and", "atomic_fetch_and_explicit", "atomic_fetch_or",
    "atomic_fetch_or_explicit", "atomic_fetch_sub", "atomic_fetch_sub_explicit", "atomic_fetch_xor",
    "atomic_fetch_xor_explicit", "atomic_flag_clear", "atomic_flag_clear_explicit", "atomic_flag_test_and_set",
    "atomic_flag_test_and_set_explicit", "atomic_init", "atomic_is_lock_free", "atomic_load",
    "atomic_load_explicit", "atomic_signal_fence", "atomic_store", "atomic_store_explicit",
    "atomic_thread_fence", "be16toh", "be32toh", "be64toh", "carg", "cbrt", "cdecl", "ceil", "cimag", "complex",
    "compoundn", "conj", "copysign", "cospi", "cproj", "creal", "dadd", "ddiv", "dfma", "dmul", "dsqrt", "dsub",
    "erf", "erfc", "errno", "exp10", "exp10m1", "exp2", "exp2m1", "expm1", "f32add", "f32div", "f32fma",
    "f32mul", "f32sqrt", "f32sub", "f32xadd", "f32xdiv", "f32xfma", "f32xmul", "f32xsqrt", "f32xsub", "f64add",
    "f64div", "f64fma", "f64mul", "f64sqrt", "f64sub", "f64xadd", "f64xdiv", "f64xfma", "f64xmul", "f64xsqrt",
    "f64xsub", "fadd", "far", "fdim", "fdiv", "ffma", "floor", "fma", "fmax", "fmaximum", "fmaximum_mag",
    "fmaximum_mag_num", "fmaximum_num", "fmaxmag", "fmin", "fminimum", "fminimum_mag", "fminimum_mag_num",
    "fminimum_num", "fminmag", "fmod", "fmul", "fpclassify", "frexp", "fromfp", "fromfpx", "fsqrt", "fsub",
    "htobe16", "htobe32", "htobe64", "htole16", "htole32", "htole64", "huge", "hyper", "hypot", "i386", "ilogb",
    "interface", "isalnum", "isalnum_l", "isalpha", "isalpha_l", "isascii", "isascii_l", "isblank", "isblank_l",
    "iscanonical", "iscntrl", "iscntrl_l", "isdigit", "isdigit_l", "iseqsig", "isfinite", "isgraph",
    "isgraph_l", "isgreater", "isgreaterequal", "isinf", "isless", "islessequal", "islessgreater", "islower",
    "islower_l", "isnan", "isnormal", "isprint", "isprint_l", "ispunct", "ispunct_l", "issignaling", "isspace",
    "isspace_l", "issubnormal", "isunordered", "isupper", "isupper_l", "isxdigit", "isxdigit_l", "iszero",
    "kill_dependency", "ldexp", "le16toh", "le32toh", "le64toh", "lgamma", "linux", "llogb", "llrint",
    "llround", "log10", "log10p1", "log1p", "log2", "log2p1", "logb", "logp1", "lrint", "lround",
    "math_errhandling", "mips", "near", "nearbyint", "nextafter", "nextdown", "nexttoward", "nextup",
    "noreturn", "offsetof", "pascal", "pown", "powr", "pthread_cleanup_pop", "pthread_cleanup_pop_restore_np",
    "pthread_cleanup_push", "pthread_cleanup_push_defer_np", "remainder", "remquo", "rint", "rootn", "round",
    "roundeven", "rsqrt", "s6_addr", "s6_addr16", "s6_addr32", "sa_handler", "sa_sigaction", "scalb", "scalbln",
    "scalbn", "sched_priority", "setjmp", "si_addr", "si_addr_lsb", "si_arch", "si_band", "si_call_addr",
    "si_fd", "si_int", "si_lower", "si_overrun", "si_pid", "si_pkey", "si_ptr", "si_status", "si_stime",
    "si_syscall", "si_timerid", "si_uid", "si_upper", "si_utime", "si_value", "sigev_notify_attributes",
    "sigev_notify_function", "sigmask", "signbit", "sigsetjmp", "sinpi", "small", "sparc", "st_atime",
    "st_ctime", "st_mtime", "stderr", "stdin", "stdout", "strdupa", "strndupa", "sun", "tanpi", "tgamma",
    "toascii", "toascii_l", "trunc", "ufromfp", "ufromfpx", "unix", "va_arg", "va_copy", "va_end", "va_start"};
// clang-format on

bool is_capital(char c) {
    return c >= 'A' && c <= 'Z';
}

}  // namespace

bool may_be_macro(std::string_view name) {
    const bool has_shape = name.size() > 1 && is_capital(name[0]) && !(name[1] >= 'a' && name[1] <= 'z') &&
                           std::count_if(name.begin(), name.end(), is_capital) > 1;
    return has_shape || std::find(std::begin(macros), std::end(macros), name) != std::end(macros);
}

bool is_reserved(std::string_view name) {
    return may_be_macro(name) || std::find(std::begin(keywords), std::end(keywords), name) != std::end(keywords);
}

std::span<const std::string_view> javascript_words() {
    return javascript;
}

}  // namespace alembert
