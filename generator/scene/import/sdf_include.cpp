// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/sdf_include.hpp"

#include <cstring>

#include "base/language/say.hpp"
#include "scene/import/other_files.hpp"
#include "scene/text.hpp"
#include "scene/text_file.hpp"

namespace alembert {

namespace {

constexpr int most_models = 200, deepest_model = 20;  // a model may include itself

/// Before version 1.5 the axis of a joint was given along the axes of its model.
bool has_old_axes(const XmlElement& root) {
    const char* const version = root.Attribute("version");
    if (version == nullptr) return false;
    for (const char* old : {"1.0", "1.2", "1.3", "1.4"})
        if (std::strcmp(version, old) == 0) return true;
    return false;
}

std::string inside(const XmlElement& e, const char* tag) {
    const XmlElement* const child = e.FirstChildElement(tag);
    const char* const text = child == nullptr ? nullptr : child->GetText();
    if (text == nullptr) return "";
    const std::string all = text, blanks = " \t\r\n";
    const std::size_t first = all.find_first_not_of(blanks);
    return first == std::string::npos ? "" : all.substr(first, all.find_last_not_of(blanks) - first + 1);
}

class Includer {
public:
    Includer(XmlFile& file, const OtherFiles& others) : file_(file), others_(others) {}

    void expand(XmlElement& e, const std::string& path, int depth) {
        for (XmlElement* child = e.FirstChildElement(); child != nullptr;) {
            XmlElement* const next = child->NextSiblingElement();
            const std::string tag = child->Name();
            if (tag == "world" || tag == "model" || tag == "sdf") expand(*child, path, depth);
            if (tag == "include") {
                if (++count_ > most_models || depth > deepest_model)
                    file_.refuse(*child, say("more than {} files are included", most_models));
                replace(e, *child, path, depth);
            }
            child = next;
        }
    }

private:
    void replace(XmlElement& around, XmlElement& include, const std::string& path, int depth) {
        const auto refuse = [&](const std::string& why) { file_.refuse(include, why); };
        const std::string uri = inside(include, "uri");
        if (uri.empty()) refuse(say("{} has no <uri>; expected one", shown(include)));
        const char* const written = include.Attribute("merge");
        const bool merge =
            written != nullptr && std::strcmp(written, "false") != 0 && std::strcmp(written, "0") != 0;
        if (merge && std::strcmp(around.Name(), "model") != 0)
            refuse(say("<include merge> of {} stands in no <model>, into which it could put its parts",
                       in_quotes(uri)));
        const std::string found = NamedFiles(path, others_).model(uri, refuse);
        tinyxml2::XMLDocument other;
        const std::string text = text_of_file(found);
        if (other.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS || other.RootElement() == nullptr)
            refuse(say("{}, which is included here, is no XML", in_quotes(uri)));
        const XmlElement& root = *other.RootElement();
        if (const XmlElement* const model = root.FirstChildElement("model")) {
            XmlElement& copy =
                *around.InsertAfterChild(&include, model->DeepClone(include.GetDocument()))->ToElement();
            keep_axes(copy, has_old_axes(root));
            expand(copy, found, depth + 1);
            override(copy, include);
            if (merge) this->merge(around, copy);
        } else if (root.FirstChildElement("light") == nullptr && root.FirstChildElement("actor") == nullptr) {
            refuse(say("{} holds no <model>", in_quotes(uri)));
        }
        around.DeleteChild(&include);
    }

    /// Puts the parts of a model into the one around it, which stand relative to a frame in place of it (the
    /// proposal of SDF 1.9, "Merge include").
    void merge(XmlElement& around, XmlElement& model) {
        const std::string own = model.Attribute("name") == nullptr ? "" : model.Attribute("name");
        const auto is_static = [](const XmlElement& e) {
            const std::string word = inside(e, "static");
            return word == "true" || word == "1";
        };
        // Links of one model stand or move together.
        if (is_static(model) && !is_static(around))
            file_.drop(say("<static> of a model that is merged into one that moves"), own, Robot::Effect::motion);
        const std::string name = "_merged__" + own + "__model__";
        XmlElement* const frame = model.GetDocument()->NewElement("frame");
        frame->SetAttribute("name", name.c_str());
        around.InsertAfterChild(&model, frame);
        place_frame(model, *frame);
        tinyxml2::XMLNode* last = frame;
        for (XmlElement* part = model.FirstChildElement(); part != nullptr; part = part->NextSiblingElement()) {
            const std::string tag = part->Name();
            if (tag == "pose" || tag == "static" || tag == "self_collide" || tag == "allow_auto_disable" ||
                tag == "enable_wind")
                continue;
            XmlElement& moved = *part->DeepClone(model.GetDocument())->ToElement();
            last = around.InsertAfterChild(last, &moved);
            stand_in(moved, tag, name);
        }
        around.DeleteChild(&model);
    }

    /// The frame of the model: at its pose, or where that puts the frame that the model is placed by.
    void place_frame(const XmlElement& model, XmlElement& frame) {
        if (model.Attribute("placement_frame") != nullptr)
            file_.refuse(model,
                         say("a model that is merged is placed by a frame of its own; expected its own pose"));
        if (const XmlElement* const pose = model.FirstChildElement("pose"))
            frame.InsertEndChild(pose->DeepClone(frame.GetDocument()));
    }

    /// What was relative to the model is relative to its frame.
    static void stand_in(XmlElement& part, const std::string& tag, const std::string& frame) {
        const auto replaced = [&](XmlElement& e, const char* key) {
            const char* const given = e.Attribute(key);
            if (given != nullptr && std::strcmp(given, "__model__") == 0) e.SetAttribute(key, frame.c_str());
        };
        if (tag == "link" || tag == "model" || (tag == "frame" && part.Attribute("attached_to") == nullptr)) {
            XmlElement* pose = part.FirstChildElement("pose");
            if (pose == nullptr) {
                pose = part.GetDocument()->NewElement("pose");
                pose->SetText("0 0 0 0 0 0");
                part.InsertFirstChild(pose);
            }
            if (pose->Attribute("relative_to") == nullptr) pose->SetAttribute("relative_to", frame.c_str());
        }
        replaced(part, "attached_to");
        if (tag != "model") return replace_below(part, frame);
        // Inside a model that is nested, __model__ is that one; only where it stands is said in terms of this one.
        replaced(*part.FirstChildElement("pose"), "relative_to");
    }

    static void replace_below(XmlElement& e, const std::string& frame) {
        for (const char* key : {"relative_to", "expressed_in"})
            if (const char* const given = e.Attribute(key);
                given != nullptr && std::strcmp(given, "__model__") == 0)
                e.SetAttribute(key, frame.c_str());
        // Axes along the model of an older version.
        if (std::strcmp(e.Name(), "use_parent_model_frame") == 0 && e.BoolText(false))
            if (XmlElement* const xyz = e.Parent()->FirstChildElement("xyz")) {
                xyz->SetAttribute("expressed_in", frame.c_str());
                e.SetText(false);
            }
        for (const char* tag : {"parent", "child"})
            if (std::strcmp(e.Name(), tag) == 0 && e.GetText() != nullptr &&
                std::strcmp(e.GetText(), "__model__") == 0)
                e.SetText(frame.c_str());
        for (XmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
            replace_below(*child, frame);
    }

    /// Writes into the joints along which axes theirs are given, because the outer file may be of another version.
    static void keep_axes(XmlElement& e, bool old) {
        const char* const key = "use_parent_model_frame";
        for (XmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
            keep_axes(*child, old);
            const bool is_axis =
                std::strcmp(child->Name(), "axis") == 0 || std::strcmp(child->Name(), "axis2") == 0;
            if (is_axis && child->FirstChildElement("xyz") != nullptr && child->FirstChildElement(key) == nullptr)
                child->InsertNewChildElement(key)->SetText(old);
        }
    }

    /// What an <include> says takes the place of what the model says.
    static void override(XmlElement& model, const XmlElement& include) {
        if (const std::string name = inside(include, "name"); !name.empty())
            model.SetAttribute("name", name.c_str());
        if (const std::string frame = inside(include, "placement_frame"); !frame.empty())
            model.SetAttribute("placement_frame", frame.c_str());
        for (const char* tag : {"pose", "static"})
            if (const XmlElement* const given = include.FirstChildElement(tag)) {
                if (XmlElement* const own = model.FirstChildElement(tag)) model.DeleteChild(own);
                model.InsertFirstChild(given->DeepClone(model.GetDocument()));
            }
        for (const XmlElement* plugin = include.FirstChildElement("plugin"); plugin != nullptr;
             plugin = plugin->NextSiblingElement("plugin"))
            model.InsertEndChild(plugin->DeepClone(model.GetDocument()));
    }

    XmlFile& file_;
    const OtherFiles& others_;
    int count_ = 0;
};

}  // namespace

void include_models(XmlFile& file, const std::string& name, const OtherFiles& others) {
    Includer(file, others).expand(file.editable_root(), name, 0);
}

}  // namespace alembert
