// SPDX-License-Identifier: MIT
#pragma once

/// A context of SUNDIALS that prints nothing, in versions 6 (Debian 12) and 7 (Debian 13). Before 7 each
/// integrator is told so by itself.
///
///     SUNContext context = quiet_context();
///     void* memory = CVodeCreate(CV_BDF, context);
///     ALEMBERT_QUIET(CVode, memory);

#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>

namespace alembert {

inline SUNContext quiet_context() {
    SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR >= 7
    SUNContext_Create(SUN_COMM_NULL, &context);
    SUNContext_ClearErrHandlers(context);
#else
    SUNContext_Create(nullptr, &context);
#endif
    return context;
}

#if SUNDIALS_VERSION_MAJOR >= 7
#define ALEMBERT_QUIET(integrator, memory) static_cast<void>(memory)
#else
#define ALEMBERT_QUIET(integrator, memory) \
    integrator##SetErrHandlerFn(           \
        memory, [](int, const char*, const char*, char*, void*) {}, nullptr)
#endif

}  // namespace alembert
