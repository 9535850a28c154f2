// SPDX-License-Identifier: MIT
#pragma once

/// The binary interface between an emitted solver and whoever runs it.
///
/// An emitted file exports one C function, `alembert_solver()`, that returns the table below. The emitted file
/// includes nothing, so it carries its own copy of the struct (templates/solver.cpp.mustache): whoever changes
/// one changes the other and raises `abi_version`; a test compares the two word for word.
///
/// Arrays (all row-major, all doubles, SI or whatever units the scene uses throughout):
///   state  n + s    coordinates q, then speeds u: the rates q' (s = n) unless the equations are in others
///   par    p + k    parameters in the scene's order, then k constants that `prepare` computes from them
///   rate   n + s    q', then u'
///   energy 4        T, V, E, power: kinetic and potential energy; E = T + V, or q'·∂L/∂q' − L where a
///                   Lagrangian is given; the power dE/dt of everything that changes E (loads outside V,
///                   prescribed motions)
///   jacobi 1        T₂ − T₀ + V, the generalized energy
/// `par` must have been through `prepare` after its last change. No function keeps state: all are thread-safe.

extern "C" {

/// What `alembert_solver()` of an emitted file returns; it lives as long as the loaded file.
struct alembert_solver_table {
    int abi;                  ///< alembert::abi_version of the emitter
    int coordinates;          ///< n
    int speeds;               ///< s
    int parameters;           ///< p, the numbers a caller sets
    int constants;            ///< k, the numbers `prepare` adds
    int outputs;              ///< length of what `outputs` writes
    int events;               ///< length of what `events` writes
    int constraints;          ///< m
    const char* scene;        ///< title or file name of the scene
    const char* formulation;  ///< formalism and form, e.g. "lagrange, textbook form"
    const char* const* coordinate_names;
    const char* const* speed_names;  ///< s; null where they are the rates
    const char* const* parameter_names;
    const char* const* output_names;
    const char* const* event_names;
    const double* parameter_values;  ///< the scene's own values, p of them
    void (*prepare)(double* par);
    void (*rhs)(double t, const double* state, const double* par, double* rate);
    /// mass: s×s symmetric, forcing: s; M u' = f + Aᵀλ. Null for trees of so many joints that M would be most of
    /// the file.
    void (*mass_forcing)(double t, const double* state, const double* par, double* mass, double* forcing);
    /// `rate` as from `rhs` at the same t and state; energy: T, V, E, power; jacobi: one number.
    void (*energy)(double t, const double* state, const double* rate, const double* par, double* energy,
                   double* jacobi);
    void (*outputs_at)(double t, const double* state, const double* rate, const double* par, double* out);
    void (*events_at)(double t, const double* state, const double* rate, const double* par, double* out);
    /// position: m, f(q,t) of holonomic constraints, 0 for others; velocity: m, A q' + b; rows: A, m×n row-major;
    /// where the speeds are not the rates, then A in speeds, m×s, with zeros for constraints that u has
    /// eliminated.
    void (*constraints_at)(double t, const double* state, const double* par, double* position, double* velocity,
                           double* rows);
    /// λ, m of them.
    void (*multipliers_at)(double t, const double* state, const double* par, double* lambda);
};

/// What `alembert_derivatives()` returns, of an emitted file that has this function: partial derivatives of `rhs`,
/// those entries that are not zero at every state, row by row.
struct alembert_derivative_table {
    int abi;
    int entries;            ///< of d rate / d state
    int parameter_entries;  ///< of d rate / d parameter
    int operations;         ///< of one `jacobian`
    const int* rows;        ///< of each entry; n + s is a row more: of the power
    const int* columns;
    const int* parameter_rows;
    const int* parameter_columns;  ///< among the p parameters that a caller sets; what `prepare` makes of them is
                                   ///< followed through
    void (*jacobian)(double t, const double* state, const double* par, double* values);
    void (*parameter_jacobian)(double t, const double* state, const double* par,
                               double* values);  ///< null if not asked for
};

/// What `alembert_projection()` returns, of an emitted file of a system with constraints.
struct alembert_projection_table {
    int abi;
    /// moved: n + s, the state after one step of Newton's method to the constraints (project.hpp says in which
    /// metric); position: m, f at the state given; pivots: m, what the elimination of A M⁻¹Aᵀ has divided by, and
    /// for holonomic constraints that u has eliminated that of A Aᵀ; 0 for others of these. Null where u has
    /// eliminated all constraints and none is holonomic.
    void (*project)(double t, const double* state, const double* par, double* moved, double* position,
                    double* pivots);
    /// gamma: m, of A u' = γ; those of constraints that u has eliminated are left as they are. Null where it has
    /// eliminated all.
    void (*gamma_at)(double t, const double* state, const double* par, double* gamma);
};

/// What `alembert_pack()` of a file emitted with `--batch` returns: the functions of the same name above for
/// `lanes` systems at once. Each number of theirs becomes `lanes` of them side by side, one of each system (its
/// own time and parameters too): q₁ is at state[lanes] … state[2·lanes − 1]. Arrays begin at multiples of 64
/// bytes. What happens in one lane does not change another by a bit.
struct alembert_pack_table {
    int abi;
    int lanes;
    void (*prepare)(double* par);
    void (*rhs)(const double* t, const double* state, const double* par, double* rate);
    void (*mass_forcing)(const double* t, const double* state, const double* par, double* mass, double* forcing);
    void (*energy)(const double* t, const double* state, const double* rate, const double* par, double* energy,
                   double* jacobi);
    void (*outputs_at)(const double* t, const double* state, const double* rate, const double* par, double* out);
};

}  // extern "C"

namespace alembert {
inline constexpr int abi_version = 4;
}
