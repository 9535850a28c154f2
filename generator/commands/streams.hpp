// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The one place through which all text on standard output and standard error passes.
///
///     guard_streams();               // first thing in main
///     ... fmt::print, std::cout, std::cerr as anywhere ...
///     return finished(code);         // last thing in main
///
/// Titles, names, file names and the compiler's messages come from outside. Control characters, marks of writing
/// direction and bytes that are not UTF-8 are shown as escapes, so that they cannot control a terminal; line ends
/// and tabs are kept.

#include <string>
#include <string_view>

namespace alembert {

/// Makes stdout, stderr, std::cout and std::cerr pass their text through `harmless`; keeps the first three
/// descriptors from being taken by files if they are closed; and makes SIGINT, SIGTERM, SIGHUP and SIGPIPE remove
/// temporary files (alembert/native/temporary_file.hpp) before they end the process. Signals that were ignored at
/// the start remain ignored.
void guard_streams();

/// `code`, or 5 with a message on standard error if not everything could be written to standard output.
int finished(int code);

/// Has a write to standard output failed?
bool output_failed();

/// `text` with escapes: \u001B, \uD83D\uDE00 (as in JSON, so that it stays JSON), \xFF for a byte that is not
/// UTF-8.
std::string harmless(std::string_view text);

/// What a signal that ends the process writes to standard error; empty for nothing. May be called again and again.
void tell_at_signal(const std::string& text);

/// Writes all bytes. The errno of the write that failed; 0 if everything was written.
int write_bytes(int descriptor, std::string_view text);

/// Writes to standard error without escaping, for our own escape sequences (progress bars).
void raw_to_terminal(std::string_view text);

}  // namespace alembert
