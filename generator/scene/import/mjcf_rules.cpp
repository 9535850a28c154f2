// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/mjcf_rules.hpp"

#include <fmt/format.h>

#include <cstring>
#include <map>

#include "base/language/say.hpp"
#include "scene/import/mjcf_values.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr int most_copies = 10'000, most_made = 100'000, deepest_attachment = 10;
constexpr const char* sections[] = {"tendon", "equality", "actuator"};

using Names = std::map<std::string, std::set<std::string>>;  // by kind: "body", "joint" …
using Rename = std::function<std::string(const std::string&)>;

/// The kind of the name that an element bears; empty for those whose names nothing here refers to.
std::string kind_of_name(const XmlElement& e) {
    const std::string tag = e.Name();
    if (tag == "freejoint") return "joint";
    for (const char* kind : {"body", "joint", "site", "geom", "frame"})
        if (tag == kind) return kind;
    if (e.Parent() != nullptr && std::strcmp(e.Parent()->Value(), "tendon") == 0) return "tendon";
    return "";
}

/// The kind of what an attribute refers to, as in joint="…", body2="…", refsite="…".
std::string kind_of_reference(std::string attribute) {
    if (!attribute.empty() && (attribute.back() == '1' || attribute.back() == '2')) attribute.pop_back();
    if (attribute == "jointinparent") return "joint";
    for (const char* kind : {"body", "joint", "site", "geom", "tendon"})
        if (attribute == kind) return kind;
    return attribute.ends_with("site") ? "site" : "";
}

bool is_of(const Names& names, const std::string& kind, const std::string& name) {
    const auto found = names.find(kind);
    return found != names.end() && found->second.contains(name);
}

void collect(const XmlElement& e, Names& names) {
    if (const char* const name = e.Attribute("name"); name != nullptr && !kind_of_name(e).empty())
        names[kind_of_name(e)].insert(name);
    for (const XmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
        collect(*child, names);
}

int elements_of(const XmlElement& e) {
    int count = 1;
    for (const XmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
        count += elements_of(*child);
    return count;
}

bool refers(const XmlElement& e, const Names& names) {
    for (const tinyxml2::XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next())
        if (is_of(names, kind_of_reference(a->Name()), a->Value())) return true;
    for (const XmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
        if (refers(*child, names)) return true;
    return false;
}

/// Renames the element, what is inside it, and its references to `names`.
void rename(XmlElement& e, const Names& names, const Rename& renamed) {
    std::vector<std::pair<std::string, std::string>> changes;
    for (const tinyxml2::XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next())
        if (std::strcmp(a->Name(), "name") == 0 || is_of(names, kind_of_reference(a->Name()), a->Value()))
            changes.emplace_back(a->Name(), renamed(a->Value()));
    for (const auto& [attribute, value] : changes) e.SetAttribute(attribute.c_str(), value.c_str());
    for (XmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
        rename(*child, names, renamed);
}

XmlElement& inserted(XmlElement& parent, tinyxml2::XMLNode& after, const XmlElement& original) {
    return *parent.InsertAfterChild(&after, original.DeepClone(parent.GetDocument()))->ToElement();
}

/// The classes of an attached model, which get its prefix.
void prefix_classes(XmlElement& e, const std::string& prefix) {
    for (const char* key : {"class", "childclass", "dclass"})
        if (const char* const own = e.Attribute(key)) e.SetAttribute(key, (prefix + own).c_str());
    if (std::strcmp(e.Name(), "default") == 0 && e.Attribute("class") == nullptr)
        e.SetAttribute("class", (prefix + "main").c_str());
    for (XmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
        prefix_classes(*child, prefix);
}

const XmlElement* named_inside(const XmlElement& e, const char* tag, const std::string& name) {
    for (const XmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
        if (std::strcmp(child->Name(), tag) == 0 && child->Attribute("name", name.c_str()) != nullptr)
            return child;
        if (const XmlElement* const found = named_inside(*child, tag, name)) return found;
    }
    return nullptr;
}

std::string model_name(const XmlFile& file) {
    const char* const name = file.root().Attribute("model");
    return name == nullptr ? "" : name;
}

class Rules {
public:
    Rules(XmlFile& file, const NamedFiles& named, int depth)
        : file_(file), root_(file.editable_root()), values_(file), named_(named), depth_(depth) {}

    void write_out(XmlElement& e) {
        for (XmlElement* child = e.FirstChildElement(); child != nullptr;) {
            const std::string tag = child->Name();
            if (tag == "attach") {
                child = attach(e, *child);
            } else {
                if (tag == "worldbody" || tag == "body" || tag == "frame" || tag == "replicate") write_out(*child);
                if (tag == "replicate") child = replicate(e, *child);
            }
            child = child->NextSiblingElement();
        }
    }

private:
    void count_made(const XmlElement& rule, double elements) {
        made_ += elements;
        if (made_ > most_made) file_.refuse(rule, say("more than {} elements are made by rules", most_made));
    }

    /// Replaces the rule by frames and returns the last of them.
    XmlElement* replicate(XmlElement& around, XmlElement& rule) {
        const double wanted = file_.number(rule, "count").value_or(0);
        const int count = static_cast<int>(wanted);
        if (count != wanted || count < 1 || count > most_copies)
            file_.refuse(rule, say("the count of {} is {}; expected a whole number from 1 to {}", shown(rule),
                                   wanted, most_copies));
        Names names;
        collect(rule, names);
        count_made(rule, static_cast<double>(elements_of(rule)) * count);
        const std::string separator = file_.text(rule, "sep").value_or("");
        const auto suffix = [&](int k) {
            const std::size_t digits = fmt::format("{}", count - 1).size();
            return fmt::format("{}{:0{}}", separator, k, digits);
        };
        const RobotPlace step{values_.three(rule, "offset", Real3::Zero()), values_.rotation(rule)};
        RobotPlace place;
        XmlElement* last = &rule;
        for (int k = 0; k < count; ++k) {
            last = &inserted(around, *last, rule);
            last->SetName("frame");
            for (const char* own : {"count", "sep", "offset", "euler", "prefix"}) last->DeleteAttribute(own);
            const Eigen::Quaterniond turn(place.R);
            last->SetAttribute("pos",
                               fmt::format("{} {} {}", place.shift[0], place.shift[1], place.shift[2]).c_str());
            last->SetAttribute("quat", fmt::format("{} {} {} {}", turn.w(), turn.x(), turn.y(), turn.z()).c_str());
            for (XmlElement* part = last->FirstChildElement(); part != nullptr; part = part->NextSiblingElement())
                rename(*part, names, [&](const std::string& name) { return name + suffix(k); });
            place = composed(place, step);
        }
        around.DeleteChild(&rule);
        repeat_what_refers(names, count, suffix);
        return last;
    }

    void repeat_what_refers(Names& names, int count, const std::function<std::string(int)>& suffix) {
        for (const char* const section : sections)
            for (XmlElement* all = root_.FirstChildElement(section); all != nullptr;
                 all = all->NextSiblingElement(section))
                for (XmlElement* one = all->FirstChildElement(); one != nullptr;) {
                    XmlElement* const next = one->NextSiblingElement();
                    if (refers(*one, names)) {
                        if (const char* const name = one->Attribute("name");
                            name != nullptr && section == sections[0])
                            names["tendon"].insert(name);
                        XmlElement* last = one;
                        for (int k = 0; k < count; ++k) {
                            last = &inserted(*all, *last, *one);
                            rename(*last, names, [&](const std::string& name) { return name + suffix(k); });
                        }
                        all->DeleteChild(one);
                    }
                    one = next;
                }
    }

    /// Replaces the rule by a frame that holds a part of another model, and returns it.
    XmlElement* attach(XmlElement& around, XmlElement& rule) {
        const std::string prefix = file_.text(rule, "prefix").value_or("");
        const auto model = file_.text(rule, "model");
        if (!model) return attach_part(around, rule, root_, prefix, "");
        const std::string name = file_of_model(rule, *model);
        const auto refuse = [&](const std::string& why) { file_.refuse(rule, why); };
        XmlFile other(named_.text(name, refuse), named_.path(name, refuse));
        include_parts(other, named_);
        write_out_rules(other, named_, depth_ + 1);
        XmlElement& theirs = other.editable_root();
        prefix_classes(theirs, prefix);
        const std::string usual = prefix + "main";
        const auto first = [&] {
            return root_.InsertFirstChild(root_.GetDocument()->NewElement("default"))->ToElement();
        };
        if (!has_class(root_, usual)) {
            for (const XmlElement* one = theirs.FirstChildElement("default"); one != nullptr;
                 one = one->NextSiblingElement("default"))
                inserted(root_, *root_.InsertFirstChild(root_.GetDocument()->NewComment("")), *one);
            if (!has_class(root_, usual)) first()->SetAttribute("class", usual.c_str());
        }
        return attach_part(around, rule, theirs, prefix, usual);
    }

    /// The file of a model of <asset>, which is named there or by its own <mujoco model="…">.
    std::string file_of_model(const XmlElement& rule, const std::string& model) {
        const auto refuse = [&](const std::string& why) { file_.refuse(rule, why); };
        for (const XmlElement* all = root_.FirstChildElement("asset"); all != nullptr;
             all = all->NextSiblingElement("asset"))
            for (const XmlElement* one = all->FirstChildElement("model"); one != nullptr;
                 one = one->NextSiblingElement("model")) {
                const char *const name = one->Attribute("name"), *const file = one->Attribute("file");
                if (file == nullptr || (name != nullptr && name != model)) continue;
                if (name != nullptr || model_name(XmlFile(named_.text(file, refuse), file)) == model) return file;
            }
        file_.refuse(rule, say("{} names the model {}, which is none of <asset>", shown(rule), in_quotes(model)));
    }

    static bool has_class(const XmlElement& root, const std::string& name) {
        for (const XmlElement* one = root.FirstChildElement("default"); one != nullptr;
             one = one->NextSiblingElement("default"))
            if (one->Attribute("class", name.c_str()) != nullptr) return true;
        return false;
    }

    /// `usual` is the class of what has none; empty if the part is from this file.
    XmlElement* attach_part(XmlElement& around, XmlElement& rule, XmlElement& theirs, const std::string& prefix,
                            const std::string& usual) {
        XmlElement& frame = *around.InsertAfterChild(&rule, root_.GetDocument()->NewElement("frame"))->ToElement();
        if (!usual.empty()) frame.SetAttribute("childclass", usual.c_str());
        for (const XmlElement* c = theirs.FirstChildElement("compiler"); c != nullptr && !usual.empty();
             c = c->NextSiblingElement("compiler"))
            for (const char* key : {"angle", "eulerseq"})
                if (const char* const value = c->Attribute(key))
                    frame.SetAttribute(fmt::format("attached-{}", key).c_str(), value);
        const auto take = [&](const XmlElement& part) {
            return frame.InsertEndChild(part.DeepClone(root_.GetDocument()))->ToElement();
        };
        bool found = false;
        for (const char* kind : {"body", "frame"})
            if (const auto name = file_.text(rule, kind)) {
                const XmlElement* const part = named_inside(theirs, kind, *name);
                if (part == nullptr || part == &frame)
                    file_.refuse(rule, say("{} names the {} {}, which is none of that model", shown(rule), kind,
                                           in_quotes(*name)));
                take(*part);
                found = true;
            }
        if (!found)
            for (const XmlElement* world = theirs.FirstChildElement("worldbody"); world != nullptr;
                 world = world->NextSiblingElement("worldbody"))
                for (const XmlElement* part = world->FirstChildElement(); part != nullptr;
                     part = part->NextSiblingElement())
                    take(*part);
        Names names;
        collect(frame, names);
        count_made(rule, elements_of(frame));
        const Rename renamed = [&](const std::string& name) { return prefix + name; };
        for (XmlElement* part = frame.FirstChildElement(); part != nullptr; part = part->NextSiblingElement())
            rename(*part, names, renamed);
        take_what_refers(theirs, names, renamed, usual);
        if (++nested_ > deepest_attachment)
            file_.refuse(rule, say("models are attached in each other more than {} deep", deepest_attachment));
        write_out(frame);  // rules of this file in a part of it
        --nested_;
        around.DeleteChild(&rule);
        return &frame;
    }

    void take_what_refers(const XmlElement& theirs, Names& names, const Rename& renamed,
                          const std::string& usual) {
        for (const char* const section : sections) {
            std::vector<const XmlElement*> taken;
            for (const XmlElement* all = theirs.FirstChildElement(section); all != nullptr;
                 all = all->NextSiblingElement(section))
                for (const XmlElement* one = all->FirstChildElement(); one != nullptr;
                     one = one->NextSiblingElement())
                    if (refers(*one, names)) taken.push_back(one);
            if (taken.empty()) continue;
            XmlElement& into = *root_.InsertEndChild(root_.GetDocument()->NewElement(section))->ToElement();
            for (const XmlElement* one : taken) {
                const char* const name = one->Attribute("name");
                if (name != nullptr && section == sections[0]) names["tendon"].insert(name);
                XmlElement& copy = *into.InsertEndChild(one->DeepClone(root_.GetDocument()))->ToElement();
                if (copy.Attribute("class") == nullptr && !usual.empty())
                    copy.SetAttribute("class", usual.c_str());
                rename(copy, names, renamed);
            }
        }
    }

    XmlFile& file_;
    XmlElement& root_;
    MjcfValues values_;
    const NamedFiles& named_;
    const int depth_;
    double made_ = 0;
    int nested_ = 0;  // attachments in each other
};

}  // namespace

void include_parts(XmlFile& file, const NamedFiles& named) {
    file.include([&](const XmlElement& e, const std::string& name) {
        return named.text(name, [&](const std::string& why) { file.refuse(e, why); });
    });
}

void write_out_rules(XmlFile& file, const NamedFiles& named, int depth) {
    if (depth > deepest_attachment)
        file.refuse(file.root(), say("models are attached in each other more than {} deep", deepest_attachment));
    Rules(file, named, depth).write_out(file.editable_root());
}

const char* of_attached_model(const XmlElement& e, const char* attribute) {
    const std::string key = fmt::format("attached-{}", attribute);
    for (const tinyxml2::XMLNode* at = &e; at != nullptr; at = at->Parent())
        if (const XmlElement* const element = at->ToElement())
            if (const char* const value = element->Attribute(key.c_str())) return value;
    return nullptr;
}

}  // namespace alembert
