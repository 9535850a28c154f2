// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

std::string without_blanks(const std::string& text) {
    const char* const blanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blanks);
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

}  // namespace

std::string shown(const XmlElement& e) {
    return "<" + escaped(e.Name()) + ">";
}

XmlFile::XmlFile(const std::string& text, std::string file) : file_(std::move(file)) {
    document_.Parse(text.c_str(), text.size());
    if (document_.Error() || document_.RootElement() == nullptr) {
        const Place place{document_.ErrorLineNum(), 1};
        const std::string why =
            say("this is no XML: {}", document_.Error() ? tinyxml2::XMLDocument::ErrorIDToName(document_.ErrorID())
                                                        : "XML_ERROR_EMPTY_DOCUMENT");
        throw SceneError(fmt::format("{}:{}:1: {}", file_, place.line, why), {{place, why}});
    }
    seen_.insert(document_.RootElement());
}

void XmlFile::include(const std::function<std::string(const XmlElement&, const std::string&)>& text_of) {
    constexpr int most = 100;  // a file that includes itself
    int count = 0;
    const auto expand = [&](const auto& self, XmlElement& e) -> void {
        for (XmlElement* child = e.FirstChildElement(); child != nullptr;) {
            XmlElement* const next = child->NextSiblingElement();
            if (std::string(child->Name()) != "include") {
                self(self, *child);
                child = next;
                continue;
            }
            if (++count > most) refuse(*child, say("more than {} files are included", most));
            tinyxml2::XMLDocument other;
            const std::string name = needed_text(*child, "file"), inside = text_of(*child, name);
            if (other.Parse(inside.c_str(), inside.size()) != tinyxml2::XML_SUCCESS ||
                other.RootElement() == nullptr)
                refuse(*child, say("{}, which is included here, is no XML", in_quotes(name)));
            tinyxml2::XMLNode* last = child;
            for (const tinyxml2::XMLNode* part = other.RootElement()->FirstChild(); part != nullptr;
                 part = part->NextSibling())
                last = e.InsertAfterChild(last, part->DeepClone(&document_));
            XmlElement* const first = child->NextSiblingElement();
            e.DeleteChild(child);
            child = first;
        }
    };
    expand(expand, *document_.RootElement());
}

Place XmlFile::place_of(const XmlElement& e) {
    const tinyxml2::XMLNode* at = &e;
    while (at->GetLineNum() == 0 && at->Parent() != nullptr) at = at->Parent();
    return {at->GetLineNum(), 1};
}

void XmlFile::refuse(const XmlElement& e, const std::string& why) const {
    throw SceneError(fmt::format("{}:{}:1: {}", file_, place_of(e).line, why), {{place_of(e), why}});
}

std::optional<std::string> XmlFile::text(const XmlElement& e, const char* attribute) {
    const tinyxml2::XMLAttribute* const found = e.FindAttribute(attribute);
    if (found == nullptr) return std::nullopt;
    seen_.insert(found);
    return without_blanks(found->Value());
}

std::string XmlFile::needed_text(const XmlElement& e, const char* attribute) {
    const std::optional<std::string> value = text(e, attribute);
    if (!value || value->empty()) refuse(e, say("{} has no {}=\"…\"; expected one", shown(e), attribute));
    return *value;
}

std::vector<double> XmlFile::numbers_of(const XmlElement& e, const std::string& what, const std::string& text,
                                        std::size_t count) const {
    std::vector<double> result;
    std::istringstream words(text);
    const auto wrong = [&](const std::string& why) {
        refuse(e, say("{} of {}: {}; expected {}", what, shown(e), why,
                      count == 0   ? std::string(say("numbers between blanks"))
                      : count == 1 ? std::string(say("one number, as in 1.5"))
                                   : say("{} numbers between blanks", count)));
    };
    for (std::string word; words >> word;) {
        const char* const begin = word.data() + (word.starts_with('+') ? 1 : 0);
        double value = 0;
        const auto [end, failure] = std::from_chars(begin, word.data() + word.size(), value);
        if (failure != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
            wrong(say("{} is no finite number", in_quotes(word)));
        result.push_back(value);
    }
    if (count == 0 ? result.empty() : result.size() != count)
        wrong(result.size() == 1 ? say("this is one number") : say("these are {} numbers", result.size()));
    return result;
}

std::optional<std::vector<double>> XmlFile::numbers(const XmlElement& e, const char* attribute,
                                                    std::size_t count) {
    const std::optional<std::string> value = text(e, attribute);
    if (!value) return std::nullopt;
    return numbers_of(e, fmt::format("{}=\"{}\"", attribute, escaped(*value, 60)), *value, count);
}

std::optional<double> XmlFile::number(const XmlElement& e, const char* attribute) {
    const std::optional<std::vector<double>> list = numbers(e, attribute, 1);
    return list ? std::optional(list->front()) : std::nullopt;
}

bool XmlFile::truth(const XmlElement& e, const std::string& word) const {
    if (word == "true" || word == "1") return true;
    if (word != "false" && word != "0")
        refuse(e, say("{} in {} is neither true nor false", in_quotes(word), shown(e)));
    return false;
}

std::optional<bool> XmlFile::flag(const XmlElement& e, const char* attribute) {
    const std::optional<std::string> value = text(e, attribute);
    return value ? std::optional(truth(e, *value)) : std::nullopt;
}

std::vector<const XmlElement*> XmlFile::children(const XmlElement& e) {
    std::vector<const XmlElement*> result;
    for (const XmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
        result.push_back(child);
    return result;
}

std::vector<const XmlElement*> XmlFile::children(const XmlElement& e, const char* tag) {
    std::vector<const XmlElement*> result;
    for (const XmlElement* child = e.FirstChildElement(tag); child != nullptr;
         child = child->NextSiblingElement(tag)) {
        seen_.insert(child);
        result.push_back(child);
    }
    return result;
}

const XmlElement* XmlFile::only(const XmlElement& e, const char* tag) {
    const std::vector<const XmlElement*> all = children(e, tag);
    if (all.size() > 1)
        refuse(*all[1], say("a second <{}> inside {}, the first is on line {}; expected one", tag, shown(e),
                            all[0]->GetLineNum()));
    return all.empty() ? nullptr : all[0];
}

std::string XmlFile::content(const XmlElement& e) {
    seen_.insert(&e);
    return e.GetText() == nullptr ? "" : without_blanks(e.GetText());
}

std::vector<double> XmlFile::numbers_in(const XmlElement& e, std::size_t count) {
    const std::string inside = content(e);
    return numbers_of(e, in_quotes(inside), inside, count);
}

std::optional<double> XmlFile::number_in(const XmlElement& parent, const char* tag) {
    const XmlElement* const child = only(parent, tag);
    return child == nullptr ? std::nullopt : std::optional(numbers_in(*child, 1)[0]);
}

std::optional<std::string> XmlFile::text_in(const XmlElement& parent, const char* tag) {
    const XmlElement* const child = only(parent, tag);
    return child == nullptr ? std::nullopt : std::optional(content(*child));
}

std::optional<bool> XmlFile::flag_in(const XmlElement& parent, const char* tag) {
    const XmlElement* const child = only(parent, tag);
    return child == nullptr ? std::nullopt : std::optional(truth(*child, content(*child)));
}

void XmlFile::ignore(const XmlElement& e, const char* attribute) {
    if (attribute != nullptr) {
        if (const tinyxml2::XMLAttribute* const found = e.FindAttribute(attribute)) seen_.insert(found);
        return;
    }
    seen_.insert(&e);
    for (const tinyxml2::XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next()) seen_.insert(a);
    for (const XmlElement* child : children(e)) ignore(*child);
}

void XmlFile::drop(const std::string& what, const std::string& of, Robot::Effect effect) {
    auto found = std::find_if(dropped_.begin(), dropped_.end(),
                              [&](const Robot::Dropped& d) { return d.what == what && d.effect == effect; });
    if (found == dropped_.end()) found = dropped_.insert(found, {what, {}, effect});
    if (!of.empty() && std::find(found->of.begin(), found->of.end(), of) == found->of.end())
        found->of.push_back(of);
}

void XmlFile::look(const XmlElement& e, const std::string& owner, const EffectOf& effect) {
    const char* const name = e.Attribute("name");
    const std::string here = name != nullptr ? name : owner;
    if (!seen_.contains(&e)) return drop(fmt::format("<{}>", e.Name()), here, effect(e, ""));
    for (const tinyxml2::XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next())
        if (!seen_.contains(a)) drop(fmt::format("<{} {}=…>", e.Name(), a->Name()), here, effect(e, a->Name()));
    for (const XmlElement* child : children(e)) look(*child, here, effect);
}

std::vector<Robot::Dropped> XmlFile::left_out(const EffectOf& effect) {
    look(root(), "", effect);
    return std::move(dropped_);
}

}  // namespace alembert
