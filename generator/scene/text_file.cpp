// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/language/say.hpp"
#include "scene/scene.hpp"

namespace alembert {

namespace {

[[noreturn]] void refuse_file(const std::string& file, std::string message) {
    Scene scene;
    scene.file = file;
    fail(scene, {{{}, std::move(message)}});
}

}  // namespace

std::string text_of_file(const std::string& file, std::size_t largest) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        refuse_file(file, say("is a directory; expected a scene file"));
    if (file.empty()) refuse_file("\"\"", say("the name of the file is empty; expected the path of a scene"));
    if (!std::filesystem::exists(file, error)) refuse_file(file, say("no such file"));
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse_file(file, say("cannot be opened: {}", std::strerror(errno)));
    std::string text(largest + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad()) refuse_file(file, say("cannot be read"));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest)
        refuse_file(file, largest == most_scene_bytes
                              ? say("has more than 1048576 bytes (1 MiB), the limit for a scene")
                              : say("has more than {} bytes, the limit for a table", largest));
    return text;
}

}  // namespace alembert
