// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/other_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/language/say.hpp"
#include "scene/text.hpp"
#include "scene/text_file.hpp"

namespace alembert {

namespace {

namespace fs = std::filesystem;

constexpr int folders_above = 3;  // in which models are looked up

bool is_inside(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const fs::path inner = fs::weakly_canonical(file, error), outer = fs::weakly_canonical(folder, error);
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

}  // namespace

NamedFiles::NamedFiles(const std::string& file, const OtherFiles& others)
    : folder_(fs::path(file).parent_path().empty() ? "." : fs::path(file).parent_path().string()),
      others_(others) {}

std::string NamedFiles::path(const std::string& name, const Refuse& refuse) const {
    const fs::path path = fs::path(folder_) / name;
    std::vector<std::string> folders = others_.packages;
    folders.push_back(folder_);
    if (!others_.outside &&
        std::none_of(folders.begin(), folders.end(), [&](const std::string& f) { return is_inside(path, f); }))
        refuse(say("{} is outside the folder of this file, and is not read; --allow-outside reads it",
                   in_quotes(name)));
    std::error_code error;
    if (!fs::exists(path, error)) refuse(say("there is no file {}", in_quotes(name)));
    if (!fs::is_directory(path, error) && !is_file(path))
        refuse(say("{} is no regular file, but a pipe or a device, and is not read", in_quotes(name)));
    return path.string();
}

std::string NamedFiles::text(const std::string& name, const Refuse& refuse) const {
    const std::string found = path(name, refuse);
    if (!is_file(found)) refuse(say("{} is a folder; expected a file", in_quotes(name)));
    return text_of_file(found);
}

std::string NamedFiles::bytes(const std::string& name, const Refuse& refuse) const {
    constexpr std::uintmax_t largest = 64 << 20;
    const std::string found = path(name, refuse);
    std::error_code error;
    if (!is_file(found)) refuse(say("{} is a folder; expected a file", in_quotes(name)));
    if (fs::file_size(found, error) > largest) refuse(say("{} has more than 64 MiB, the limit", in_quotes(name)));
    std::ifstream stream(found, std::ios::binary);
    std::string result((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (!stream) refuse(say("{} cannot be read", in_quotes(name)));
    return result;
}

/// The file of the model in a folder: model.sdf, or its only one.
std::string NamedFiles::in_folder(const std::string& folder, const Refuse& refuse) const {
    const fs::path usual = fs::path(folder) / "model.sdf";
    if (is_file(usual)) return usual.string();
    std::vector<std::string> all;
    std::error_code error;
    for (const fs::directory_entry& one : fs::directory_iterator(folder, error))
        if (one.path().extension() == ".sdf" && is_file(one.path())) all.push_back(one.path().string());
    if (all.size() != 1) refuse(say("the folder {} has no model.sdf", in_quotes(folder)));
    return all.front();
}

std::string NamedFiles::model(const std::string& uri, const Refuse& refuse) const {
    std::error_code error;
    const std::size_t scheme = uri.find("://");
    const std::string kind = scheme == std::string::npos ? "" : uri.substr(0, scheme);
    const fs::path name = scheme == std::string::npos ? uri : uri.substr(scheme + 3);
    if (!kind.empty() && kind != "file" && kind != "model" && kind != "package")
        refuse(
            say("{} is not on this machine; expected model://NAME or a file, or the model written out, as by "
                "gz sdf -p",
                in_quotes(uri)));
    const bool is_plain = std::find(name.begin(), name.end(), "..") == name.end() && !name.is_absolute();
    if (kind == "file" || !is_plain || fs::exists(fs::path(folder_) / name, error)) {
        const std::string found = path(name.string(), refuse);
        return fs::is_directory(found, error) ? in_folder(found, refuse) : found;
    }
    if (name.empty()) refuse(say("{} names no model; expected model://NAME", in_quotes(uri)));
    std::vector<fs::path> folders(others_.packages.begin(), others_.packages.end());
    fs::path up = fs::absolute(folder_, error);
    for (int k = 0; k <= folders_above; ++k) {
        folders.push_back(up);
        folders.push_back(up / "models");
        up = up.parent_path();
    }
    for (const fs::path& folder : folders) {
        const fs::path found = folder / name;
        if (is_file(found)) return found.string();
        if (fs::is_directory(found, error)) return in_folder(found.string(), refuse);
    }
    refuse(
        say("the model {} is found neither beside this file nor in the folders above it; --package FOLDER names "
            "the folder in which it is",
            in_quotes(uri)));
    return "";
}

}  // namespace alembert
