// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene that a program makes, with the tables and keys of a scene file.
///
///     SceneDraft draft;
///     draft.set("gravity", {0, "-g"});
///     draft.table("parameters").set("m", 2.5).set("l", 0.5).set("g", 9.81);
///     draft.table("coordinates").set("theta", DraftTable().set("initial", 0.3).set("unit", "rad"));
///     draft.add("particle").set("name", "bob").set("mass", "m").set("position", {"l*sin(theta)",
///     "-l*cos(theta)"}); const Scene scene = draft.scene();
///
/// The draft is written as text and read like a file, so that the same rules and messages hold; places in messages
/// are those in `draft.text()`. docs/scene-language.md lists the tables.

#include <deque>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

class DraftTable;

/// A number, an expression or name, true or false, an array of these, or a table in braces.
class DraftValue {
public:
    DraftValue(double number);                           // NOLINT: a number is a value
    DraftValue(int number);                              // NOLINT
    DraftValue(bool flag);                               // NOLINT
    DraftValue(const char* text);                        // NOLINT: so is text
    DraftValue(const std::string& text);                 // NOLINT
    DraftValue(std::initializer_list<DraftValue> list);  // NOLINT: so is a list
    DraftValue(const std::vector<DraftValue>& list);     // NOLINT
    DraftValue(const DraftTable& table);                 // NOLINT: { initial = 0.3, unit = "rad" }
    /// An array of one array needs this name, as C++ takes {{"z", "psi"}} for a copy of the inner one.
    static DraftValue list(const std::vector<DraftValue>& values) { return DraftValue(values); }

    /// As it stands in a scene.
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

/// Keys with their values, in the order in which they are set.
class DraftTable {
public:
    DraftTable& set(const std::string& key, const DraftValue& value);
    /// "key = value" of each, between these.
    std::string text(const std::string& between) const;

private:
    std::vector<std::pair<std::string, std::string>> keys_;
};

class SceneDraft {
public:
    /// A key outside all tables: title, source, notes, gravity.
    SceneDraft& set(const std::string& key, const DraftValue& value);
    /// The table of that name, made when first asked for: "parameters", "coordinates", "simulation" …
    DraftTable& table(const std::string& name);
    /// One more entry of a list of tables: "particle", "body", "constraint", "claim" … The reference stays good
    /// while others are added.
    DraftTable& add(const std::string& name);

    std::string text() const;
    /// Throws SceneError as read_scene does; `name` stands in messages in place of a file's.
    Scene scene(const std::string& name = "draft") const;

private:
    struct Entry {
        std::string name;
        bool is_list;
        DraftTable table;
    };
    DraftTable top_;
    std::deque<Entry> entries_;
};

}  // namespace alembert
