// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <tuple>

#include "alembert/native/temporary_file.hpp"
#include "base/language/say.hpp"
#include "commands/terminal.hpp"
#include "scene/text.hpp"

namespace alembert {

int write_bytes(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = write(descriptor, text.data(), text.size());
        if (count >= 0)
            text.remove_prefix(static_cast<std::size_t>(count));
        else if (errno != EINTR)
            return errno;
    }
    return 0;
}

namespace {

bool may_need_escape(unsigned char byte) {
    return (byte < 0x20 && byte != '\n' && byte != '\t') || byte >= 0x7F;
}

/// The number of bytes at the end that begin a UTF-8 character whose rest has not arrived yet.
std::size_t unfinished(std::string_view text) {
    for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back) {
        const auto byte = static_cast<unsigned char>(text[text.size() - back]);
        if (byte < 0x80) return 0;
        if (byte < 0xC0) continue;
        const std::size_t length = byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : 2;
        return length > back ? back : 0;
    }
    return 0;
}

/// The destination of a stream's bytes.
struct Way {
    int descriptor;
    int error = 0;          ///< errno of the first write that failed
    std::string held = {};  ///< the first bytes of an incomplete character
    bool colours = false;   ///< whether marks (ink.hpp) become colours

    bool put(std::string_view text) {
        if (error == 0) error = write_bytes(descriptor, text);
        return error == 0;
    }
};

// Never destroyed: the C library flushes its streams after everything else.
Way &out = *new Way{STDOUT_FILENO}, &err = *new Way{STDERR_FILENO};

/// The text made harmless, with our own escape sequences in place of marks.
std::string coloured(std::string_view text) {
    std::string result;
    std::size_t begin = 0;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        const std::string_view colour = text[i] == ink_mark ? colour_of(text[i + 1]) : std::string_view();
        if (colour.empty()) continue;
        result += harmless(text.substr(begin, i - begin));
        result += colour;
        begin = i + 2;
    }
    return result + harmless(text.substr(begin));
}

/// The write function for fopencookie: the number of bytes written, 0 for an error.
ssize_t pass_on(void* cookie, const char* bytes, std::size_t size) {
    Way& way = *static_cast<Way*>(cookie);
    std::string text = way.held + std::string(bytes, size);
    const std::size_t keep = unfinished(text);
    way.held = text.substr(text.size() - keep);
    text.erase(text.size() - keep);
    if (way.put(way.colours ? coloured(text) : harmless(text))) return static_cast<ssize_t>(size);
    errno = way.error;
    return 0;
}

std::FILE* guarded(Way& way, int buffering) {
    std::FILE* const stream =
        fopencookie(&way, "w", {.read = nullptr, .write = pass_on, .seek = nullptr, .close = nullptr});
    if (stream != nullptr) std::setvbuf(stream, nullptr, buffering, BUFSIZ);
    return stream;
}

/// std::cout and std::cerr on top of such a stream, without a buffer of their own.
class OnFile : public std::streambuf {
public:
    explicit OnFile(std::FILE* file) : file_(file) {}

protected:
    int_type overflow(int_type c) override { return c == traits_type::eof() ? 0 : std::fputc(c, file_); }
    std::streamsize xsputn(const char* text, std::streamsize size) override {
        return static_cast<std::streamsize>(std::fwrite(text, 1, static_cast<std::size_t>(size), file_));
    }
    int sync() override { return std::fflush(file_); }

private:
    std::FILE* file_;
};

/// The next file that is opened would get a closed descriptor, and messages would be written into it. Therefore
/// something to which writing fails is opened in its place.
void keep_descriptors() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(descriptor, F_GETFD) < 0 &&
            open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
}

constexpr std::size_t longest_note = 1000;
char notes[2][longest_note + 1];  // one is written while the other is shown
std::atomic<const char*> note_at_signal{nullptr};

extern "C" void end_by_signal(int signal) {
    remove_leftovers();
    if (const char* const note = note_at_signal.load(); note != nullptr)
        std::ignore = write(STDERR_FILENO, note, std::strlen(note));
    std::signal(signal, SIG_DFL);
    raise(signal);
}

void clean_up_after_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        struct sigaction action {};
        if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
        action.sa_handler = end_by_signal;
        sigaction(signal, &action, nullptr);
    }
}

}  // namespace

std::string harmless(std::string_view text) {
    if (std::none_of(text.begin(), text.end(),
                     [](char c) { return may_need_escape(static_cast<unsigned char>(c)); }))
        return std::string(text);
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t begin = i;
        const char32_t c = decode(text, i);
        if (c == U'\n' || c == U'\t' || !is_disturbing(c))
            result += text.substr(begin, i - begin);
        else if (c == invalid_character)
            result += fmt::format("\\x{:02X}", static_cast<unsigned char>(text[begin]));
        else if (c > 0xFFFF)
            result += fmt::format("\\u{:04X}\\u{:04X}", 0xD7C0 + (static_cast<unsigned>(c) >> 10),
                                  0xDC00 + (static_cast<unsigned>(c) & 0x3FF));
        else
            result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    }
    return result;
}

void guard_streams() {
    keep_descriptors();
    clean_up_after_signals();
    for (Way* const way : {&out, &err}) way->colours = !ink_for(way->descriptor).end.empty();
    std::FILE *const output = guarded(out, isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF), *const errors =
                                                                                              guarded(err, _IONBF);
    if (output == nullptr || errors == nullptr) return;
#ifdef __GLIBC__  // elsewhere these two are constants, and what is not written through std::cout passes as it is
    stdout = output;
    stderr = errors;
#endif
    static OnFile &on_output = *new OnFile(output), &on_errors = *new OnFile(errors);
    std::cout.rdbuf(&on_output);
    std::cerr.rdbuf(&on_errors);
    std::clog.rdbuf(&on_errors);
}

bool output_failed() {
    return out.error != 0;
}

int finished(int code) {
    std::cout.flush();
    std::fflush(stdout);
    if (!out.held.empty()) out.put(harmless(out.held));
    if (!output_failed()) return code;
    std::cerr << say("cannot write to the standard output: ") << std::strerror(out.error) << "\n";
    return 5;
}

void tell_at_signal(const std::string& text) {
    const std::string note = harmless(text).substr(0, longest_note);
    char* const free = note_at_signal.load() == notes[0] ? notes[1] : notes[0];
    std::memcpy(free, note.c_str(), note.size() + 1);
    note_at_signal = note.empty() ? nullptr : free;
}

void raw_to_terminal(std::string_view text) {
    err.put(text);
}

}  // namespace alembert
