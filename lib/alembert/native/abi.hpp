// SPDX-License-Identifier: MIT
#pragma once

/// The binary interface between an emitted solver and whoever runs it.
///
/// A module, which is loaded while a program runs, exports one C function, `alembert_solver()`, that returns the
/// table below, and others for further tables (`module_entries`). An emitted file that is linked with a program
/// exports `NAME_tables_PRINT()`, NAME being that of its scene and PRINT a fingerprint of the file and its header,
/// with all tables in one. The emitted file includes nothing, so it carries its own copy of the structs
/// (templates/solver.cpp.mustache). If you change one of the two, change the other and raise `abi_version`; a test
/// compares them word for word.
///
/// Arrays (all row-major, all doubles, SI or whatever units the scene uses throughout):
///   state  n + s    coordinates q, then speeds u: the rates q' (s = n) unless the equations are in others
///   par    p + k    parameters in the scene's order, then k constants that `prepare` computes from them
///   rate   n + s    q', then u'
///   energy 4        T, V, E, power: kinetic and potential energy; E = T + V, or q'·∂L/∂q' − L where a
///                   Lagrangian is given; the power dE/dt of everything that changes E (loads outside V,
///                   prescribed motions)
///   jacobi 1        T₂ − T₀ + V, the generalized energy
/// `par` must have been through `prepare` after its last change. No function keeps a state of its own, so all are
/// thread-safe.

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
    int constraints;          ///< m, those that follow from the others last
    const char* scene;        ///< title or file name of the scene
    const char* formulation;  ///< formalism and form, e.g. "lagrange, textbook form"
    const char* const* coordinate_names;
    const char* const* speed_names;  ///< s names; null if the speeds are the rates q'
    const char* const* parameter_names;
    const char* const* output_names;
    const char* const* event_names;
    const double* parameter_values;  ///< the scene's own values, p of them
    void (*prepare)(double* par);
    void (*rhs)(double t, const double* state, const double* par, double* rate);
    /// mass: s×s symmetric, forcing: s; M u' = f + Aᵀλ. The pointer is null for trees with so many joints that M
    /// would take most of the file.
    void (*mass_forcing)(double t, const double* state, const double* par, double* mass, double* forcing);
    /// `rate` as from `rhs` at the same t and state; energy: T, V, E, power; jacobi: one number.
    void (*energy)(double t, const double* state, const double* rate, const double* par, double* energy,
                   double* jacobi);
    void (*outputs_at)(double t, const double* state, const double* rate, const double* par, double* out);
    void (*events_at)(double t, const double* state, const double* rate, const double* par, double* out);
    /// position: m, f(q,t) of holonomic constraints, 0 for others; velocity: m, A q' + b; rows: A, m×n row-major,
    /// followed, if the speeds are not the rates, by A in terms of the speeds, m×s, in which the rows of
    /// constraints that u has eliminated are zero.
    void (*constraints_at)(double t, const double* state, const double* par, double* position, double* velocity,
                           double* rows);
    /// λ, m of them.
    void (*multipliers_at)(double t, const double* state, const double* par, double* lambda);
};

/// What `alembert_derivatives()` returns, if the emitted file has this function: the partial derivatives of `rhs`.
/// Entries that are zero at every state are left out; the others are listed row by row.
struct alembert_derivative_table {
    int abi;
    int entries;            ///< number of entries of d rate / d state
    int parameter_entries;  ///< number of entries of d rate / d parameter
    int operations;         ///< number of operations of one call of `jacobian`
    const int* rows;  ///< the row of each entry; row n + s, one more than the rates, is that of the power; so also
                      ///< of `parameter_rows`
    const int* columns;
    const int* parameter_rows;
    const int* parameter_columns;  ///< among the p parameters that a caller sets; the derivatives include those of
                                   ///< the constants that `prepare` computes from them
    void (*jacobian)(double t, const double* state, const double* par, double* values);
    void (*parameter_jacobian)(double t, const double* state, const double* par,
                               double* values);  ///< null if they are not wanted
};

/// A module of a system in which some constraints follow from others also exports
/// `alembert_independent_constraints()`: the number r of the first constraints, from which the rest follow;
/// elsewhere r = m.

/// What `alembert_projection()` returns, which the emitted file of a system with constraints has.
struct alembert_projection_table {
    int abi;
    /// moved: n + s, the state after one step of Newton's method to the constraints (projection.hpp says in which
    /// metric); position: r, f at the state given; pivots: r, the pivots of the elimination of A M⁻¹Aᵀ. For
    /// constraints that u has eliminated they are those of A Aᵀ if the constraint is holonomic, else 0. The
    /// pointer is null if u has eliminated all constraints and none is holonomic.
    void (*project)(double t, const double* state, const double* par, double* moved, double* position,
                    double* pivots);
    /// gamma: r, the right-hand side of A u' = γ. The entries of constraints that u has eliminated are not
    /// written. The pointer is null if u has eliminated all constraints.
    void (*gamma_at)(double t, const double* state, const double* par, double* gamma);
};

/// What `alembert_pack()` of a file emitted with `--batch` returns: the functions of the same name above for
/// `lanes` systems at once. Each number in their arrays becomes `lanes` numbers side by side, one for each system,
/// which has its own time and parameters too: q₁ is at state[lanes] … state[2·lanes − 1]. Arrays begin at
/// multiples of 64 bytes. The values in one lane do not change a bit of the results in another.
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

/// One of the functions that `alembert_functions()` lists, such as inverse dynamics or a frame's Jacobian.
struct alembert_named_function {
    const char* name;
    int rows, columns;  ///< of the matrix that it writes to `out`, row by row; a vector has one column
    int operations;     ///< of one call
    /// `state` is (q, q') and `rate` is (q', q''), of which only q'' is read, and only by functions that need it.
    void (*call)(double t, const double* state, const double* rate, const double* par, double* out);
    /// The same for `lanes` systems at once as in alembert_pack_table; null without `--batch`.
    void (*pack)(const double* t, const double* state, const double* rate, const double* par, double* out);
};

/// What `alembert_functions()` of a file emitted with `--functions` or `--frame` returns.
struct alembert_function_table {
    int abi;
    int count;
    const alembert_named_function* list;
};

/// What `tables()` of an emitted header returns: the tables above, null where the file has none. `linked`
/// (module.hpp) takes it.
struct alembert_tables {
    const void* solver;
    const void* derivatives;
    const void* projection;
    const void* pack;
    const void* functions;
    int independent_constraints;
};

}  // extern "C"

namespace alembert {

inline constexpr int abi_version = 4;

/// The `extern "C"` functions that a module may have; each returns the table of this name, the last a number.
struct ModuleEntries {
    const char* solver = "alembert_solver";
    const char* derivatives = "alembert_derivatives";
    const char* projection = "alembert_projection";
    const char* pack = "alembert_pack";
    const char* functions = "alembert_functions";
    const char* independent_constraints = "alembert_independent_constraints";
};
inline constexpr ModuleEntries module_entries;

}  // namespace alembert
