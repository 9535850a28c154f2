// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A compiled catalogue of messages: the file that msgfmt writes from a .po file. It is read here because
/// gettext's own functions translate only where the system has generated the locale, which bare Debian has not.

#include <string_view>
#include <utility>
#include <vector>

namespace alembert {

class MessageCatalogue {
public:
    /// `file` holds the bytes of a .mo file in the byte order of this machine, as "The Format of GNU MO Files" of
    /// gettext's manual describes it, and must outlive the catalogue. Throws std::invalid_argument if it is none.
    explicit MessageCatalogue(std::string_view file);

    /// The translation, empty if there is none.
    std::string_view translation(std::string_view english) const;

    /// Each English text with its translation, in the order of the texts; the first holds properties of the
    /// catalogue.
    const std::vector<std::pair<std::string_view, std::string_view>>& entries() const { return entries_; }

private:
    std::vector<std::pair<std::string_view, std::string_view>> entries_;
};

}  // namespace alembert
