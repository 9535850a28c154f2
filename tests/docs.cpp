// SPDX-License-Identifier: MIT
// The reference of the scene language and the JSON schema, compared with the reader's own list of tables and keys.
// (tests/docs.sh compares the output shown in the guide and the options of the commands.)
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "alembert/base/error.hpp"
#include "alembert/ode/integrate.hpp"
#include "files.hpp"
#include "scene/joint_moves.hpp"
#include "scene/keys.hpp"
#include "scene/placing.hpp"
#include "scene/scene.hpp"
#include "scene/toml.hpp"
#include "scene/warning_kinds.hpp"

namespace docs {

namespace {

using namespace alembert;
using Json = nlohmann::json;
using Tables =
    std::map<std::string, std::set<std::string>>;  ///< "[[force]]", "[energy]", "body.inertia" or "" → keys

std::string text_of(const std::string& relative) {
    const std::string text = test::contents(test::source_path(relative));
    REQUIRE_MESSAGE(!text.empty(), relative);
    return text;
}

std::string title_of(const TableKeys& table) {
    const std::string name(table.table);
    if (name.empty() || table.shape == TableKeys::Shape::inner) return name;
    return table.shape == TableKeys::Shape::list ? "[[" + name + "]]" : "[" + name + "]";
}

Tables of_the_reader() {
    Tables result;
    for (const TableKeys& table : table_keys)
        for (std::set<std::string>& keys = result[title_of(table)]; const std::string_view key : table.keys())
            keys.emplace(key);
    return result;
}

/// The texts between backticks in a line.
std::vector<std::string> in_backticks(const std::string& line) {
    std::vector<std::string> words;
    for (std::size_t begin = line.find('`'); begin != std::string::npos;) {
        const std::size_t end = line.find('`', begin + 1);
        if (end == std::string::npos) break;
        words.push_back(line.substr(begin + 1, end - begin - 1));
        begin = line.find('`', end + 1);
    }
    return words;
}

/// Headings that name a table, and the first column of the rows below. Tables whose header is not `| key |` are
/// about something else.
Tables of_the_reference() {
    Tables result;
    std::set<std::string>* keys = nullptr;
    bool is_key_table = false;
    std::istringstream lines(text_of("docs/scene-language.md"));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("#")) {
            const std::vector<std::string> words = in_backticks(line);
            keys = line == "### Top level" ? &result[""] : words.empty() ? nullptr : &result[words[0]];
        } else if (line.starts_with("| key |")) {
            is_key_table = keys != nullptr;
        } else if (line.starts_with("| `") && is_key_table) {
            for (std::string& word : in_backticks(line.substr(0, line.find('|', 1))))
                keys->insert(std::move(word));
        } else if (!line.starts_with("|")) {
            is_key_table = false;
        }
    }
    return result;
}

const Json& schema() {
    static const Json all = Json::parse(text_of("docs/scene.schema.json"));
    return all;
}

const Json& resolved(const Json& node) {
    if (!node.contains("$ref")) return node;
    return schema().at(Json::json_pointer(node["$ref"].get<std::string>().substr(1)));
}

/// The object that a node allows, among its alternatives; null where it allows none.
const Json* object_in(const Json& node) {
    const Json& here = resolved(node);
    if (here.contains("properties")) return &here;
    for (const char* const list : {"anyOf", "allOf"})
        if (here.contains(list))
            for (const Json& one : here[list])
                if (const Json* const found = object_in(one)) return found;
    return nullptr;
}

void add_keys(Tables& tables, const std::string& title, const Json& node) {
    std::set<std::string>& keys = tables[title];
    if (const Json* const object = object_in(node)) {
        CHECK_MESSAGE((*object)["additionalProperties"] == false, title);
        for (const auto& [key, value] : (*object)["properties"].items()) keys.insert(key);
    }
}

Tables of_the_schema() {
    Tables result;
    for (const auto& [name, node] : schema()["properties"].items()) {
        const Json& table = resolved(node);
        const bool is_list = table.contains("items") && resolved(table["items"]).contains("properties");
        if (is_list) {
            add_keys(result, "[[" + name + "]]", table["items"]);
        } else if (table.value("type", "") == "object") {
            const Json& others = table["additionalProperties"];
            add_keys(result, "[" + name + "]", table);
            if (others.is_object() && object_in(others) != nullptr) add_keys(result, name + ".*", others);
        } else {
            result[""].insert(name);
        }
    }
    add_keys(result, "body.shape", schema()["definitions"]["shape"]);
    add_keys(result, "body.inertia", schema()["properties"]["body"]["items"]["properties"]["inertia"]);
    return result;
}

void compare(const Tables& found, const Tables& expected, const std::string& where) {
    for (const auto& [title, keys] : expected) {
        CHECK_MESSAGE(found.contains(title), where << " has no table '" << title << "'");
        if (!found.contains(title)) continue;
        for (const std::string& key : keys)
            CHECK_MESSAGE(found.at(title).contains(key), where << ": no key '" << key << "' in " << title);
    }
    for (const auto& [title, keys] : found) {
        CHECK_MESSAGE(expected.contains(title), where << " has '" << title << "', which the reader does not know");
        if (!expected.contains(title)) continue;
        for (const std::string& key : keys)
            CHECK_MESSAGE(expected.at(title).contains(key),
                          where << " has '" << key << "' in " << title << ", which the reader does not know");
    }
}

/// Checks a value by the part of JSON Schema that our schema uses.
bool obeys(const Json& value, const Json& node) {
    const Json& s = resolved(node);
    const auto has_type = [&](const std::string& type) {
        return type == "object"   ? value.is_object()
               : type == "array"  ? value.is_array()
               : type == "string" ? value.is_string()
               : type == "number" ? value.is_number()
                                  : type == "boolean" && value.is_boolean();
    };
    const auto count = [&](const Json& list) {
        return std::count_if(list.begin(), list.end(), [&](const Json& one) { return obeys(value, one); });
    };
    if (s.contains("type")) {
        const Json types = s["type"].is_array() ? s["type"] : Json::array({s["type"]});
        if (std::none_of(types.begin(), types.end(), [&](const Json& type) { return has_type(type); }))
            return false;
    }
    if (s.contains("enum") && std::find(s["enum"].begin(), s["enum"].end(), value) == s["enum"].end())
        return false;
    if (s.contains("pattern") && value.is_string() &&
        !std::regex_search(value.get<std::string>(), std::regex(s["pattern"].get<std::string>())))
        return false;
    if (s.contains("anyOf") && count(s["anyOf"]) == 0) return false;
    if (s.contains("oneOf") && count(s["oneOf"]) != 1) return false;
    if (s.contains("allOf") && count(s["allOf"]) != static_cast<long>(s["allOf"].size())) return false;
    if (s.contains("not") && obeys(value, s["not"])) return false;
    if (value.is_array()) {
        if (value.size() < s.value("minItems", 0U) || value.size() > s.value("maxItems", 1U << 20)) return false;
        for (std::size_t k = 0; s.contains("items") && k < value.size(); ++k)
            if (!obeys(value[k], s["items"].is_array() ? s["items"][k] : s["items"])) return false;
    }
    if (!value.is_object()) return true;
    for (const Json& key : s.value("required", Json::array()))
        if (!value.contains(key.get<std::string>())) return false;
    for (const auto& [key, element] : value.items()) {
        const bool is_own = s.contains("properties") && s["properties"].contains(key);
        const Json others = s.value("additionalProperties", Json(true));
        if (is_own                ? !obeys(element, s["properties"][key])
            : others.is_boolean() ? !others
                                  : !obeys(element, others))
            return false;
    }
    return true;
}

Json json_of(const toml::node& node) {
    Json result;
    if (const toml::table* const table = node.as_table()) {
        result = Json::object();
        for (const auto& [key, value] : *table) result[std::string(key.str())] = json_of(value);
    } else if (const toml::array* const list = node.as_array()) {
        result = Json::array();
        for (const toml::node& value : *list) result.push_back(json_of(value));
    } else if (const auto text = node.value_exact<std::string>()) {
        result = *text;
    } else if (const auto flag = node.value_exact<bool>()) {
        result = *flag;
    } else if (const auto number = node.value<double>()) {
        result = *number;
    }
    return result;
}

Json json_of(const std::filesystem::path& file) {
    const std::string text = text_of(file.lexically_relative(ALEMBERT_SOURCE_DIR).string());
    return json_of(static_cast<const toml::node&>(toml::parse(text)));
}

/// The reader's complaints about an example, without those about names that are declared elsewhere.
std::string complaints(const std::string& example) {
    std::string told;
    try {
        parse_scene(example, "example");
    } catch (const SceneError& error) {
        std::istringstream lines(error.what());
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with("example:")) continue;
            const auto says = [&](const char* words) { return line.find(words) != std::string::npos; };
            if (says("unknown name") || says("unknown point") || says("unknown frame") || says("unknown body") ||
                says("unknown coordinate") || says("at least one is needed"))
                continue;
            told += line + "\n";
        }
    }
    return told;
}

}  // namespace

TEST_CASE("docs: the reference of the scene language has every table and key of the reader, and no other") {
    compare(of_the_reference(), of_the_reader(), "docs/scene-language.md");
}

TEST_CASE("docs: the schema has every table and key of the reader, and no other") {
    compare(of_the_schema(), of_the_reader(), "docs/scene.schema.json");
}

TEST_CASE("docs: the reader's list has the tables that it reads, in the shape that the list gives") {
    for (const TableKeys& table : table_keys) {
        if (table.table.empty() || table.shape == TableKeys::Shape::inner || table.keys().empty()) continue;
        const std::string told = complaints(title_of(table) + "\nno_such_key_ = 1\n");
        CHECK_MESSAGE(told.find("unknown key 'no_such_key_' in " + title_of(table)) != std::string::npos, told);
    }
}

TEST_CASE("docs: the schema's methods and joints are those of the program") {
    const std::vector<std::string> words = method_words();
    CHECK(schema()["properties"]["simulation"]["properties"]["method"]["anyOf"][0]["enum"]
              .get<std::set<std::string>>() == std::set<std::string>(words.begin(), words.end()));
    CHECK(schema()["properties"]["allow"]["items"]["enum"].get<std::vector<std::string>>() ==
          std::vector<std::string>(warning_kinds.begin(), warning_kinds.end()));
    const std::string language = text_of("docs/scene-language.md");
    for (const std::string_view kind : warning_kinds)
        CHECK_MESSAGE(language.find("`" + std::string(kind) + "`") != std::string::npos, kind);
    CHECK(schema()["properties"]["joint"]["items"]["properties"]["type"]["anyOf"][0]["enum"]
              .get<std::vector<std::string>>() == joint_types());
}

TEST_CASE("docs: every scene of the repository obeys the schema, and scenes with wrong keys or values do not") {
    int scenes = 0;
    for (const char* const folder : {"scenes", "tests/odd"})
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::filesystem::path(ALEMBERT_SOURCE_DIR) / folder)) {
            if (entry.path().extension() != ".toml") continue;
            CHECK_MESSAGE(obeys(json_of(entry.path()), schema()), entry.path().string());
            ++scenes;
        }
    CHECK(scenes > 90);
    for (const char* const name :
         {"21_unknown_table", "22_unknown_keys", "23_unknown_top_key", "24_body_without_mass", "45_vector_of_one",
          "46_vector_of_four", "47_wrong_types", "48_table_shapes", "55_spring_of_both_kinds", "56_rotations",
          "59_unknown_method", "62_bad_claims"})
        CHECK_MESSAGE(!obeys(json_of(std::filesystem::path(ALEMBERT_SOURCE_DIR) / "tests/broken" /
                                     (std::string(name) + ".toml")),
                             schema()),
                      name);
}

TEST_CASE(
    "docs: the schema takes the words of joints and methods that are read, and refuses what the reader refuses") {
    const std::string body = "[[body]]\nname = \"B\"\nmass = 3\ninertia = [1, 1, 1]\n";
    const auto agree = [](const std::string& scene, bool right) {
        CAPTURE(scene);
        CHECK(obeys(json_of(static_cast<const toml::node&>(toml::parse(scene))), schema()) == right);
        CHECK(complaints(scene).empty() == right);
    };
    const auto joint = [&](const std::string& type, const std::string& coordinates) {
        return body + "[[joint]]\nname = \"j\"\nparent = \"N\"\nchild = \"B\"\ntype = \"" + type +
               "\"\ncoordinates = {" + coordinates + "}\n";
    };
    for (const char* type : {"hinge", "Revolute", "pin joint", "slider"}) agree(joint(type, "q = 0"), true);
    for (const char* type : {"U-joint", "cardan", "CYLINDRICAL"}) agree(joint(type, "q = 0, p = 0"), true);
    for (const char* type : {"hinges", "elastic", ""}) agree(joint(type, "q = 0"), false);
    const auto method = [&](const std::string& word) {
        return body + "position = [0, 0]\n[simulation]\nmethod = \"" + word + "\"\n";
    };
    for (const char* word : {"Radau", "DOP853", "verner-98"}) agree(method(word), true);
    for (const char* word : {"rk45", "Simpson"}) agree(method(word), false);
    const std::string particle = "[[particle]]\nname = \"q\"\nmass = 1\nposition = [0, 0]\n";
    agree(particle, true);
    for (const char* wrong :
         {"[[particle]]\nname = \"r\"\nmass = 1\nat = \"q\"\nposition = [0, 0]\n",
          "[[body]]\nname = \"r\"\nmass = 1\nat = \"q\"\nfrom = \"O\"\n",
          "[[body]]\nname = \"r\"\nmass = 1\nposition = [0, 0]\nshape = { disc = 1, ball = 2 }\n",
          "[coordinates]\nx = 0\n[[friction]]\nname = \"f\"\ncoefficient = 1\nslip = \"x'\"\n",
          "[[scenery]]\ncircle = 1\n", "[[scenery]]\nbox = [1, 1, 1]\n",
          "[[scenery]]\ndot = \"q\"\nline = [\"q\", \"O\"]\n"})
        agree(particle + wrong, false);
    for (const char* right :
         {"[[body]]\nname = \"r\"\nmass = 1\nat = \"q\"\n", "[[scenery]]\ncircle = 1\nat = \"q\"\n",
          "[[scenery]]\ndot = \"q\"\n", "[[scenery]]\nbox = [1, 1, 1]\nat = \"q\"\n"})
        agree(particle + right, true);
}

TEST_CASE("docs: a claim about sticking obeys the schema, whatever letters and blanks its names have") {
    const auto obeyed = [](const std::string& at) {
        return obeys({{"claim", {{{"equation", "x = 0"}, {"at", at}}}}}, schema());
    };
    for (const char* const at : {"sticking", "sticking slope", "sticking  σ\tslope ", "rest"})
        CHECK_MESSAGE(obeyed(at), at);
    for (const char* const at : {"stickingslope", "sticks", " sticking"}) CHECK_MESSAGE(!obeyed(at), at);
}

TEST_CASE("docs: the reader takes the examples of the reference") {
    std::istringstream lines(text_of("docs/scene-language.md"));
    int examples = 0;
    bool inside = false;
    std::string example;
    for (std::string line; std::getline(lines, line);) {
        if (line == "```toml") {
            inside = true;
            example.clear();
        } else if (inside && line == "```") {
            inside = false;
            CHECK_MESSAGE(complaints(example) == "", example);
            ++examples;
        } else if (inside) {
            example += line + "\n";
        }
    }
    CHECK(examples > 20);
}

}  // namespace docs
