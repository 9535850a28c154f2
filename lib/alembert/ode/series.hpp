// SPDX-License-Identifier: MIT
#pragma once

/// The Taylor coefficients of a motion at a state, computed by a separate emitted file
/// (generator/codegen/emit/taylor.hpp) or by machine code in memory (generator/codegen/machine/memory_series.hpp).
///
///     const Series series = make_series(load_series(object));     // the scene's own parameters
///     std::vector<double> out((order + 1) * series.width), work(series.workspace);
///     // out[k·width + i]: of (time − t)^k in component i
///     series(t, state, order, out.data(), work.data());
///
/// Throws CompileError as `load` does (module.hpp), std::invalid_argument if the number of parameters is wrong.

#include <filesystem>
#include <memory>
#include <vector>

namespace alembert {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = long double;
#endif

inline constexpr int series_abi_version = 2;
inline constexpr int most_order = 32;  ///< the highest order of coefficients in double
inline constexpr int most_order_quad = 40;

}  // namespace alembert

extern "C" {

/// What `alembert_series()` of an emitted file returns; it lives as long as the loaded file. `par` holds p
/// parameters, then k constants that `prepare` makes; `state` is (q, u), followed by the work of loads if `extra`
/// is 1; `work` is an array of `workspace` numbers.
struct alembert_series_table {
    int abi;  ///< alembert::series_abi_version of the emitter
    int coordinates, speeds, extra, parameters, constants;
    int workspace, workspace_quad;
    double order_cost, product_cost;  ///< a series of order p takes the time order_cost p + product_cost p², in
                                      ///< units of about the other work of a step
    const char* scene;
    const double* parameter_values;
    void (*prepare)(double* par);
    void (*series)(double t, const double* state, const double* par, int order, double* out, double* work);
    /// Null unless the file is compiled with ALEMBERT_QUAD.
    void (*prepare_quad)(alembert::Quad* par);
    void (*series_quad)(alembert::Quad t, const alembert::Quad* state, const alembert::Quad* par, int order,
                        alembert::Quad* out, alembert::Quad* work);
};

}  // extern "C"

namespace alembert {

using SeriesModule = std::shared_ptr<const alembert_series_table>;  ///< owns the loaded file
SeriesModule load_series(const std::filesystem::path& object);

/// The coefficients at given parameters. A copy is cheap; calls are thread-safe if `work` is the caller's own.
struct Series {
    SeriesModule module = {};
    std::shared_ptr<const std::vector<double>> par = {};
    int width = 0;      ///< components of the state
    int workspace = 0;  ///< number of doubles in `work`, which must be 0 at first

    explicit operator bool() const { return module != nullptr; }
    void operator()(double t, const double* state, int order, double* out, double* work) const {
        module->series(t, state, par->data(), order, out, work);
    }
};

/// `values` are the parameters; if empty, the scene's own.
Series make_series(const SeriesModule& module, const std::vector<double>& values = {});

}  // namespace alembert
