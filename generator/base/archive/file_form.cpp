// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/archive/file_form.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

/// Endings of formats in which tables and other things come, but which are not written as tables.
constexpr const char* others[] = {".bmp",    ".doc",  ".docx", ".eps",  ".feather", ".fmu",  ".gif",     ".gz",
                                  ".htm",    ".html", ".ico",  ".jpeg", ".jpg",     ".json", ".mat",     ".md",
                                  ".npy",    ".ods",  ".odt",  ".pdf",  ".pkl",     ".png",  ".parquet", ".ps",
                                  ".sqlite", ".svg",  ".tex",  ".tif",  ".toml",    ".tsv",  ".tiff",    ".webp",
                                  ".xls",    ".xlsx", ".xml",  ".yaml", ".yml",     ".zip"};

bool is_other(const std::string& ending) {
    return std::any_of(std::begin(others), std::end(others), [&](const char* one) { return ending == one; });
}

bool is_one_of(const std::string& ending, const std::vector<std::string>& right) {
    return std::find(right.begin(), right.end(), ending) != right.end();
}

[[noreturn]] void refuse(const std::string& path, const std::string& what, const std::string& endings) {
    throw ModelError(say("'{}': {} is written; expected a name that ends in {}", path, what, endings));
}

}  // namespace

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

void need_form(const std::string& path, FileForm form) {
    const std::string ending = ending_of(path);
    if (path.empty() || (ending.empty() && form != FileForm::unit)) return;
    switch (form) {
        case FileForm::picture:
            if (ending != ".svg") refuse(path, say("a picture in SVG"), ".svg");
            break;
        case FileForm::page:
            if (!is_one_of(ending, {".html", ".htm", ".xhtml"})) refuse(path, say("a page in HTML"), ".html");
            break;
        case FileForm::scene:
            if (ending != ".toml") refuse(path, say("a scene in TOML"), ".toml");
            break;
        case FileForm::json:
            if (ending != ".json") refuse(path, say("a JSON object"), ".json");
            break;
        case FileForm::unit:
            if (ending != ".fmu")
                throw ModelError(say("'{}': other tools know a unit by its ending; call it NAME.fmu", path));
            break;
        case FileForm::csv:
            if (is_other(ending) || is_one_of(ending, {".npz", ".h5", ".hdf5"}))
                refuse(path, say("a table as CSV"), ".csv");
            break;
        case FileForm::table:
            if (is_other(ending)) refuse(path, say("a table"), ".csv, .npz, .h5");
            break;
    }
}

}  // namespace alembert
