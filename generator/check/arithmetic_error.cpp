// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/arithmetic_error.hpp"

#include <new>
#include <stdexcept>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"

namespace alembert {

std::string words_of_arithmetic_error() {
    const auto without_value = [] {
        return say("it divides by something that is always zero, or a function in it has no value there");
    };
    try {
        throw;
    } catch (const SceneError&) {
        throw;
    } catch (const ModelError&) {
        throw;
    } catch (const CompileError&) {
        throw;
    } catch (const IntegrationError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::domain_error&) {  // GiNaC's pole_error too
        return without_value();
    } catch (const std::overflow_error& e) {  // of GiNaC's numbers
        if (std::string(e.what()).find("division by zero") != std::string::npos) return without_value();
        return say("it could not be evaluated: {}", e.what());
    } catch (const std::exception& e) {
        return say("it could not be evaluated: {}", e.what());
    }
}

}  // namespace alembert
