// What CLN's configure finds out about floating-point numbers: those of wasm32.
#define rounds_to_nearest 0
#define rounds_to_zero 1
#define rounds_to_infinity 2
#define rounds_to_minus_infinity 3
#define float_mant_bits 24
#define float_rounds rounds_to_nearest
#define double_mant_bits 53
#define double_rounds rounds_to_nearest
#define long_double_mant_bits 113
#define long_double_rounds rounds_to_nearest
