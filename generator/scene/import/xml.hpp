// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// An XML file that is read strictly, for MJCF and SDF. It remembers what was asked for, so that everything else
/// can be listed as dropped, and it refuses numbers that cannot be read, with their line.
///
///     XmlFile file(text, "arm.xml");
///     for (const XmlElement* body : file.children(*world, "body"))
///         file.numbers(*body, "pos", 3);      // std::optional<std::vector<double>>
///     file.left_out();                        // <geom>, <joint solref=…> … with the names concerned
///
/// (TinyXML-2 is in Debian's libtinyxml2-dev and is all that these two formats need; libsdformat would bring
/// thirty libraries for the poses that sdf.cpp resolves by itself.)

#include <tinyxml2.h>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/import/robot.hpp"

namespace alembert {

using XmlElement = tinyxml2::XMLElement;

class XmlFile {
public:
    /// Throws SceneError if the text is no XML. `file` is for messages.
    XmlFile(const std::string& text, std::string file);

    /// Replaces each <include file="…"/> by what stands in the outermost element of that file. `text_of` gives the
    /// text of a file that an element includes.
    void include(const std::function<std::string(const XmlElement&, const std::string&)>& text_of);

    const XmlElement& root() const { return *document_.RootElement(); }
    /// For rules that change the elements before anything is read.
    XmlElement& editable_root() { return *document_.RootElement(); }
    /// Its line; of an element from another file, or made by a rule, that of the element around it.
    static Place place_of(const XmlElement& e);
    [[noreturn]] void refuse(const XmlElement& e, const std::string& why) const;
    void remark(const XmlElement& e, const std::string& what, const std::string& kind = "") {
        remarks_.push_back({place_of(e), what, Severity::warning, kind});
    }
    const std::vector<Diagnostic>& remarks() const { return remarks_; }

    /// An attribute without blanks around it; nothing if it is missing.
    std::optional<std::string> text(const XmlElement& e, const char* attribute);
    std::string needed_text(const XmlElement& e, const char* attribute);
    /// Finite numbers between blanks, at least one and as many as `count` unless that is 0.
    std::optional<std::vector<double>> numbers(const XmlElement& e, const char* attribute, std::size_t count = 0);
    std::optional<double> number(const XmlElement& e, const char* attribute);
    /// "true" or "false", "1" or "0".
    std::optional<bool> flag(const XmlElement& e, const char* attribute);

    /// All children of this name, in the order of the file.
    std::vector<const XmlElement*> children(const XmlElement& e, const char* tag);
    std::vector<const XmlElement*> children(const XmlElement& e);
    /// The only child of this name, or null. A second one is refused.
    const XmlElement* only(const XmlElement& e, const char* tag);
    /// The text between <tag> and </tag>, and numbers in it.
    std::string content(const XmlElement& e);
    std::vector<double> numbers_in(const XmlElement& e, std::size_t count);
    std::optional<double> number_in(const XmlElement& parent, const char* tag);
    std::optional<std::string> text_in(const XmlElement& parent, const char* tag);
    std::optional<bool> flag_in(const XmlElement& parent, const char* tag);

    /// Whether it is true or false.
    bool truth(const XmlElement& e, const std::string& word) const;
    std::vector<double> numbers_of(const XmlElement& e, const std::string& what, const std::string& text,
                                   std::size_t count) const;

    /// Leaves the element, or one of its attributes, out of `left_out`, because it does not concern the motion.
    void ignore(const XmlElement& e, const char* attribute = nullptr);
    /// Lists it although it was read.
    void drop(const std::string& what, const std::string& of, Robot::Effect effect = Robot::Effect::none);
    /// All that was dropped, and all that nobody asked for, with the effect of an element, or of its attribute, on
    /// the motion. The attribute is empty if the element is meant.
    using EffectOf = std::function<Robot::Effect(const XmlElement& element, const std::string& attribute)>;
    std::vector<Robot::Dropped> left_out(const EffectOf& effect);

private:
    void look(const XmlElement& e, const std::string& owner, const EffectOf& effect);

    std::string file_;
    tinyxml2::XMLDocument document_;
    std::set<const void*> seen_;  // elements and attributes
    std::vector<Diagnostic> remarks_;
    std::vector<Robot::Dropped> dropped_;
};

/// "<joint>", for messages.
std::string shown(const XmlElement& e);

}  // namespace alembert
