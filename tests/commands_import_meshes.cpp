// SPDX-License-Identifier: MIT
// Bodies whose masses are those of meshes, against the same bodies of boxes.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"

namespace commands_import_meshes {

using namespace alembert::test;

namespace {

using Corner = std::array<double, 3>;
using Face = std::array<Corner, 3>;

/// The triangles of a box between two corners, turned outwards.
std::vector<Face> box(const Corner& low, const Corner& high) {
    std::vector<Face> result;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool far : {false, true}) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            const auto corner = [&](bool a, bool b) {
                Corner c{};
                c[axis] = far ? high[axis] : low[axis];
                c[u] = a ? high[u] : low[u];
                c[v] = b ? high[v] : low[v];
                return c;
            };
            const std::array<Corner, 4> round{corner(false, false), corner(true, false), corner(true, true),
                                              corner(false, true)};
            for (const auto& [a, b, c] : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
                Face face{round[static_cast<std::size_t>(a)], round[static_cast<std::size_t>(b)],
                          round[static_cast<std::size_t>(c)]};
                if (!far) std::swap(face[1], face[2]);
                result.push_back(face);
            }
        }
    return result;
}

std::filesystem::path folder() {
    return std::filesystem::path(temporary("x", "")).parent_path();
}

void write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder() / name, std::ios::binary) << bytes;
}

std::string binary_stl(const std::vector<Face>& faces) {
    std::string bytes(80, ' ');
    const auto put = [&](const auto& value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        bytes.append(raw, sizeof value);
    };
    put(static_cast<std::uint32_t>(faces.size()));
    for (const Face& face : faces) {
        for (int k = 0; k < 3; ++k) put(0.f);
        for (const Corner& corner : face)
            for (const double x : corner) put(static_cast<float>(x));
        put(std::uint16_t{0});
    }
    return bytes;
}

std::string text_stl(const std::vector<Face>& faces) {
    std::string text = "solid box\n";
    for (const Face& face : faces) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const Corner& c : face) text += fmt::format("vertex {} {} {}\n", c[0], c[1], c[2]);
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid box\n";
}

/// With the corners before the faces, and these counted from the end.
std::string obj(const std::vector<Face>& faces) {
    std::string text = "# a box\n", of_faces;
    long number = -3 * static_cast<long>(faces.size());
    for (const Face& face : faces) {
        for (const Corner& c : face) text += fmt::format("v {} {} {}\n", c[0], c[1], c[2]);
        of_faces += fmt::format("f {0}/1/1 {1}//2 {2}\n", number, number + 1, number + 2);
        number += 3;
    }
    return text + of_faces;
}

std::string corners_and_faces(const std::vector<Face>& faces) {
    std::string corners, numbers;
    int count = 0;
    for (const Face& face : faces)
        for (const Corner& c : face) {
            corners += fmt::format("{} {} {} ", c[0], c[1], c[2]);
            numbers += fmt::format("{} ", count++);
        }
    return fmt::format("vertex=\"{}\" face=\"{}\"", corners, numbers);
}

struct Body {
    double mass;
    Json centre, tensor;
    std::string told;
};

Body body(const std::string& assets, const std::string& geom, std::vector<std::string> more = {}, int exit = 0) {
    const std::string file =
        temporary("robot.xml", "<mujoco><compiler meshdir=\".\"/><asset>" + assets +
                                   "</asset><worldbody><body name=\"b\"><freejoint name=\"b\"/>" + geom +
                                   "</body></worldbody></mujoco>");
    const std::string scene = temporary("robot.toml", "");
    std::vector<std::string> args{"import", file, "-o", scene};
    args.insert(args.end(), more.begin(), more.end());
    const auto told = run(args);
    CHECK(told.exit == exit);
    if (told.exit != 0) return {0, {}, {}, told.err};
    const Json inertia = json_of({"eval", scene, "--inertia"});
    return {inertia["mass"].get<double>(), inertia["centre"], inertia["tensor"], told.err};
}

void check_same(const Body& one, const Body& other, double tolerance) {
    CHECK(std::abs(one.mass - other.mass) < tolerance * other.mass);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(std::abs(one.centre[i].get<double>() - other.centre[i].get<double>()) < tolerance);
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(std::abs(one.tensor[i][k].get<double>() - other.tensor[i][k].get<double>()) <
                  tolerance * other.mass);
    }
}

}  // namespace

// Lengths that are exact in single precision, which a binary STL has.
TEST_CASE("import: a body of a mesh has the mass of the same box, from each kind of file") {
    const std::vector<Face> faces = box({-0.25, 0.5, 1}, {0.5, 0.75, 1.125});
    const std::string place = " pos=\"1 2 3\" euler=\"10 20 30\" density=\"300\"";
    const Body expected =
        body("", "<geom type=\"box\" size=\"0.375 0.125 0.0625\" pos=\"0 0 0\"/>");  // centre below
    CHECK(std::abs(expected.mass - 1000 * 0.75 * 0.25 * 0.125) < 1e-12);
    write("a.stl", binary_stl(faces));
    write("b.STL", text_stl(faces));
    write("c.obj", obj(faces));
    const Body binary =
        body("<mesh name=\"m\" file=\"a.stl\"/>", "<geom type=\"mesh\" mesh=\"m\"" + place + "/>", {"--strict"});
    CHECK(std::abs(binary.mass - 0.3 * expected.mass) < 1e-13);
    for (const std::string& asset :
         {std::string("<mesh file=\"b.STL\" name=\"m\"/>"), std::string("<mesh name=\"m\" file=\"c.obj\"/>"),
          "<mesh name=\"m\" " + corners_and_faces(faces) + "/>"})
        check_same(body(asset, "<geom type=\"mesh\" mesh=\"m\"" + place + "/>"), binary, 1e-14);
    // Its place in the file, in the geom and in the body.
    const Body plain = body("<mesh file=\"a.stl\"/>", "<geom type=\"mesh\" mesh=\"a\"/>"),
               by_box = body("", "<geom type=\"box\" size=\"0.375 0.125 0.0625\" pos=\"0.125 0.625 1.0625\"/>");
    check_same(plain, by_box, 1e-14);
    const Body given = body("<mesh file=\"a.stl\"/>", "<geom type=\"mesh\" mesh=\"a\" mass=\"7\"/>"),
               by_box_given = body(
                   "", "<geom type=\"box\" size=\"0.375 0.125 0.0625\" pos=\"0.125 0.625 1.0625\" mass=\"7\"/>");
    check_same(given, by_box_given, 1e-14);
    // Twice as long along x and mirrored along z, from another origin and turned by a quarter about z: x of the
    // file is −y of the geom, y is x.
    const Body scaled = body(
                   "<mesh file=\"a.stl\" scale=\"2 1 -1\" refpos=\"0.125 0.625 0\" "
                   "refquat=\"0.70710678118654757 0 0 0.70710678118654757\"/>",
                   "<geom type=\"mesh\" mesh=\"a\"/>"),
               by_scaled = body("", "<geom type=\"box\" size=\"0.25 0.375 0.0625\" pos=\"0 0 -1.0625\"/>");
    check_same(scaled, by_scaled, 1e-14);
}

TEST_CASE(
    "import: a mesh that no point sees whole has the mass of its volume, and that MuJoCo takes more is told") {
    // An L of two boxes that share a face; its corner is far from the middle.
    std::vector<Face> faces;
    const auto quad = [&](const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
    };
    const std::array<std::array<double, 2>, 6> round{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}};
    for (std::size_t k = 0; k < 6; ++k) {
        const auto &p = round[k], &q = round[(k + 1) % 6];
        quad({p[0], p[1], 0}, {q[0], q[1], 0}, {q[0], q[1], 1}, {p[0], p[1], 1});
    }
    for (const auto& [a, b, c] :
         {std::array{0, 1, 2}, std::array{0, 2, 3}, std::array{0, 3, 4}, std::array{0, 4, 5}}) {
        const auto at = [&](int k, double z) {
            return Corner{round[static_cast<std::size_t>(k)][0], round[static_cast<std::size_t>(k)][1], z};
        };
        faces.push_back({at(a, 1), at(b, 1), at(c, 1)});
        faces.push_back({at(a, 0), at(c, 0), at(b, 0)});
    }
    write("l.obj", obj(faces));
    const std::string boxes =
        "<geom type=\"box\" size=\"2 0.5 0.5\" pos=\"2 0.5 0.5\"/>"
        "<geom type=\"box\" size=\"0.5 1.5 0.5\" pos=\"0.5 2.5 0.5\"/>";
    const Body exact = body("<mesh file=\"l.obj\" inertia=\"exact\"/>", "<geom type=\"mesh\" mesh=\"l\"/>"),
               usual = body("<mesh file=\"l.obj\"/>", "<geom type=\"mesh\" mesh=\"l\"/>");
    check_same(exact, body("", boxes), 1e-13);
    CHECK(exact.told.find("MuJoCo takes") == std::string::npos);
    check_same(usual, exact, 1e-14);
    CHECK(usual.told.find("the mass of mesh 'l' of body 'b' is that of its volume, 7 m^3; MuJoCo takes ") !=
          std::string::npos);
}

TEST_CASE("import: meshes without an inside, and files that are not read, are told with the reason") {
    std::vector<Face> faces = box({0, 0, 0}, {1, 1, 1});
    write("whole.stl", binary_stl(faces));
    faces.pop_back();
    write("open.stl", binary_stl(faces));
    write("broken.stl", "solid\nvertex 1 2\n");
    write("other.dae", "<COLLADA/>");
    write("face.obj", "v 0 0 0\nf 1 2 3\n");
    std::filesystem::create_directories(folder() / "beside");
    const std::string ball = "<geom size=\"0.1\" pos=\"1 0 0\"/>";
    for (const auto& [asset, why] :
         {std::pair("file=\"open.stl\"", "its surface is not closed"),
          std::pair("file=\"broken.stl\"", "a corner has no three numbers"),
          std::pair("file=\"other.dae\"", "files of this kind are not read"),
          std::pair("file=\"face.obj\"", "a face has a corner 2, and there are 1"),
          std::pair("file=\"none.stl\"", "there is no file"),
          std::pair("file=\"../../../../../../etc/passwd.stl\"", "is outside the folder of this file"),
          std::pair("file=\"whole.stl\" inertia=\"convex\"", "its inertia is that of its convex hull"),
          std::pair("file=\"whole.stl\" inertia=\"shell\"", "its inertia is that of its shell"),
          std::pair("vertex=\"0 0 0 1 0 0 0 1 0 0 0 1\"", "it has neither a file nor corners and faces")}) {
        CAPTURE(std::string(asset));
        const std::string assets = fmt::format("<mesh name=\"m\" {}/>", asset);
        const Body told = body(assets, ball + "<geom type=\"mesh\" mesh=\"m\"/>");
        CHECK(told.told.find("the mass of body 'b' leaves out the mesh 'm': ") != std::string::npos);
        CHECK(told.told.find(why) != std::string::npos);
        body(assets, ball + "<geom type=\"mesh\" mesh=\"m\"/>", {"--strict"}, 3);
        body(assets, ball + "<geom type=\"mesh\" mesh=\"m\" mass=\"0\"/>", {"--strict"});
    }
}

}  // namespace commands_import_meshes
