// SPDX-License-Identifier: GPL-2.0-or-later
// A solid is the sum of the pyramids from a point to its triangles, with the sign of d = a·(b × c), where a, b, c
// are the corners from that point: V = Σ d/6, ∫ x dV = Σ d s/24 and ∫ x xᵀ dV = Σ d (s sᵀ + a aᵀ + b bᵀ + c
// cᵀ)/120 with s = a + b + c (Tonon, J. Math. Stat. 1 (2005) 8).
#include "scene/import/mesh_solid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <tuple>

#include "base/archive/file_form.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

constexpr std::size_t header = 80, of_triangle = 50;  // bytes of a binary STL

std::uint32_t count_in(const std::string& bytes) {
    std::uint32_t count = 0;
    for (int k = 3; k >= 0; --k)
        count = count << 8 | static_cast<unsigned char>(bytes[header + static_cast<std::size_t>(k)]);
    return count;
}

bool is_binary_stl(const std::string& bytes) {
    return bytes.size() >= header + 4 && bytes.size() == header + 4 + of_triangle * std::size_t{count_in(bytes)};
}

Triangles binary_stl(const std::string& bytes) {
    Triangles result(count_in(bytes));
    for (std::size_t k = 0; k < result.size(); ++k)
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t at = header + 4 + k * of_triangle + 12 * (corner + 1) + 4 * i;
                std::uint32_t bits = 0;
                for (std::size_t byte = 4; byte-- > 0;)
                    bits = bits << 8 | static_cast<unsigned char>(bytes[at + byte]);
                float x = 0;
                std::memcpy(&x, &bits, sizeof x);
                result[k][corner][static_cast<Eigen::Index>(i)] = static_cast<double>(x);
            }
    return result;
}

Real3 three_numbers(std::istream& words) {
    Real3 v;
    if (!(words >> v[0] >> v[1] >> v[2])) throw MeshMistake(say("a corner has no three numbers"));
    return v;
}

Triangles ascii_stl(const std::string& text) {
    std::istringstream words(text);
    std::vector<Real3> corners;
    for (std::string word; words >> word;)
        if (word == "vertex") corners.push_back(three_numbers(words));
    if (corners.empty() || corners.size() % 3 != 0)
        throw MeshMistake(say("it is neither a binary STL nor one of text"));
    Triangles result;
    for (std::size_t k = 0; k < corners.size(); k += 3)
        result.push_back({corners[k], corners[k + 1], corners[k + 2]});
    return result;
}

Triangles obj(const std::string& text) {
    std::vector<Real3> corners;
    Triangles result;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind, word;
        words >> kind;
        if (kind == "v") corners.push_back(three_numbers(words));
        if (kind != "f") continue;
        std::vector<Real3> face;
        while (words >> word) {  // "7", "7/1", "7//2", "-1": counted from the last
            long number = 0;
            std::istringstream(word) >> number;
            const long at = number < 0 ? static_cast<long>(corners.size()) + number : number - 1;
            if (at < 0 || at >= static_cast<long>(corners.size()))
                throw MeshMistake(say("a face has a corner {}, and there are {}", number, corners.size()));
            face.push_back(corners[static_cast<std::size_t>(at)]);
        }
        for (std::size_t k = 2; k < face.size(); ++k) result.push_back({face[0], face[k - 1], face[k]});
    }
    return result;
}

bool is_closed(const Triangles& surface) {
    using Corner = std::tuple<double, double, double>;
    std::map<std::pair<Corner, Corner>, int> edges;  // how many more triangles pass an edge forth than back
    const auto corner = [](const Real3& v) { return Corner{v[0], v[1], v[2]}; };
    for (const auto& triangle : surface)
        for (std::size_t k = 0; k < 3; ++k) {
            const Corner a = corner(triangle[k]), b = corner(triangle[(k + 1) % 3]);
            if (a < b) ++edges[{a, b}];
            if (b < a) --edges[{b, a}];
        }
    return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

}  // namespace

Triangles triangles_of_file(const std::string& bytes, const std::string& name) {
    const std::string ending = ending_of(name);
    Triangles result;
    if (ending == ".stl")
        result = is_binary_stl(bytes) ? binary_stl(bytes) : ascii_stl(bytes);
    else if (ending == ".obj")
        result = obj(bytes);
    else
        throw MeshMistake(say("files of this kind are not read; expected .stl or .obj"));
    for (const auto& triangle : result)
        for (const Real3& corner : triangle)
            if (!corner.allFinite()) throw MeshMistake(say("a corner is no number"));
    return result;
}

MeshSolid mesh_solid(const Triangles& surface) {
    if (surface.empty()) throw MeshMistake(say("it has no triangles"));
    MeshSolid result{.is_closed = is_closed(surface)};
    Real3 apex = Real3::Zero();
    double area = 0;
    for (const auto& triangle : surface) {
        const double own = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm();
        apex += own / 3 * (triangle[0] + triangle[1] + triangle[2]);
        area += own;
    }
    if (!(area > 0)) return result;
    apex /= area;
    Real3 first = Real3::Zero();
    Real33 second = Real33::Zero();
    for (const auto& triangle : surface) {
        const Real3 a = triangle[0] - apex, b = triangle[1] - apex, c = triangle[2] - apex, s = a + b + c;
        const double d = a.dot(b.cross(c));
        result.volume += d / 6;
        result.volume_of_pyramids += std::abs(d) / 6;
        first += d / 24 * s;
        second += d / 120 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
    if (result.volume < 0) {  // all triangles are turned inwards
        result.volume = -result.volume;
        first = -first;
        second = -second;
    }
    if (!(result.volume > 0)) return result;
    const Real3 to_centre = first / result.volume;
    second -= result.volume * to_centre * to_centre.transpose();
    result.centre = apex + to_centre;
    result.inertia = second.trace() * Real33::Identity() - second;
    return result;
}

}  // namespace alembert
