// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The SHA-256 of a text in base 64, as a Content-Security-Policy names a script that may run:
/// 'sha256-' + sha256_base64(script) (FIPS 180-4, RFC 4648).

#include <string>
#include <string_view>

namespace alembert {

std::string sha256_base64(std::string_view text);

}  // namespace alembert
