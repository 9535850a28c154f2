// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Reads values of a TOML file as the types that the scene language expects. Every mistake is recorded, and
/// reading goes on with an empty value. Keys come in the order of the file.
///
///     const Table table(reading, node, "[[particle]]", place);
///     table.allow("particle");
///     particle.mass = table.needed_expression("mass");

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/known_names.hpp"
#include "scene/scene.hpp"
#include "scene/source.hpp"
#include "scene/toml.hpp"

namespace alembert {

/// What all functions share that read one file.
struct Reading {
    const SourceText& source;
    std::vector<Diagnostic>& diagnostics;
    bool has_joints;          ///< if true, bodies may be placed by joints
    const KnownNames& names;  ///< what the file declares

    void complain(Place place, std::string message) const { diagnostics.push_back({place, std::move(message)}); }
    /// How many mistakes there are so far; warnings are none.
    std::size_t mistakes() const;
};

struct Entry {
    std::string key;
    Place place;  ///< of the key
    const toml::node* node;
};

Place place_of(const toml::node& node);

/// "a string", "the integer 3", "an array", …, for messages.
std::string kind_of(const toml::node& node);

/// A string or a plain number. `what` names the value in messages: `'mass'`, `parameter 'm'`.
Expression read_expression(const Reading& reading, const toml::node& node, const std::string& what);

/// Reads an equation, which must be a string.
Equality read_equality(const Reading& reading, const toml::node& node, bool rates_before);

/// Reads an inequality in quotes, or an array of such.
std::vector<Inequality> read_inequalities(const Reading& reading, const toml::node& node, const std::string& what);

/// The number 0, for a value that may be missing.
Expression zero(Place place);

/// Reads a string, with the place of its first character.
std::optional<Name> read_name(const Reading& reading, const toml::node& node, const std::string& what);

std::vector<Name> read_names(const Reading& reading, const toml::node& node, const std::string& what);

/// Reads two or three expressions.
Vector read_vector(const Reading& reading, const toml::node& node, const std::string& what);

class Table {
public:
    Table(const Reading& reading, const toml::table& table, std::string title, Place place);

    const Reading& reading() const { return *reading_; }
    const std::string& title() const { return title_; }
    Place place() const { return place_; }
    const std::vector<Entry>& entries() const { return entries_; }

    /// Reports each key that the table of this name in scene/keys.hpp does not have.
    void allow(std::string_view name) const;

    const Entry* find(std::string_view key) const;
    bool has(std::string_view key) const { return find(key) != nullptr; }
    void complain(std::string_view key, const std::string& message) const;
    /// Complains of keys that are missing, at the table, unless a key that was refused already stands in place of
    /// one.
    void complain_of_missing(std::initializer_list<std::string_view> keys, const std::string& message) const;

    std::string text(std::string_view key) const;
    /// A string in plain signs (scene/typed.hpp), with its places.
    std::optional<Literal> plain_text(std::string_view key) const;
    /// The text of a unit, and where it stands; complains of one that is none.
    std::string unit(std::string_view key, Place& place) const;
    bool flag(std::string_view key) const;
    std::optional<Name> name(std::string_view key) const;
    std::vector<Name> names(std::string_view key) const;
    Expression expression(std::string_view key) const;  ///< null if missing
    std::optional<Vector> vector(std::string_view key) const;

    Name needed_name(std::string_view key) const;
    Expression needed_expression(std::string_view key) const;
    Vector needed_vector(std::string_view key) const;

    /// `'key' of [[table]]`, for messages.
    std::string what(std::string_view key) const;

    /// The same table; mistakes are reported to `other`.
    Table with(const Reading& other) const {
        Table table = *this;
        table.reading_ = &other;
        return table;
    }

    /// Adds the table's own name to its title, for the messages that follow.
    void entitle(const Name& name);

private:
    const Reading* reading_;
    std::string title_;
    Place place_;
    std::vector<Entry> entries_;

    void need(std::string_view key) const;
};

}  // namespace alembert
