// SPDX-License-Identifier: MIT
// Tables for NumPy are read by a reader of our own, after the description of the format (NumPy Enhancement
// Proposal 1), and hold what the CSV of the same run holds.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "archives.hpp"
#include "files.hpp"
#include "shell.hpp"
#include "tools.hpp"

namespace commands_tables {

using alembert::test::contents;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

struct Array {
    std::string type, shape;
    std::string data;

    explicit Array(const std::string& bytes) {
        REQUIRE(bytes.substr(0, 8) == std::string("\x93NUMPY\1\0", 8));
        const std::size_t length =
            static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
        CHECK((10 + length) % 64 == 0);
        const std::string header = bytes.substr(10, length);
        CHECK(header.back() == '\n');
        const auto between = [&](const std::string& before, char after) {
            const std::size_t at = header.find(before) + before.size();
            return header.substr(at, header.find(after, at) - at);
        };
        type = between("'descr': '", '\'');
        shape = between("'shape': (", ')');
        CHECK(between("'fortran_order': ", ',') == "False");
        data = bytes.substr(10 + length);
    }
    template <typename Number>
    std::vector<Number> numbers() const {
        std::vector<Number> values(data.size() / sizeof(Number));
        std::memcpy(values.data(), data.data(), data.size());
        CHECK(shape == fmt::format("{},", values.size()));
        return values;
    }
    /// ASCII only.
    std::vector<std::string> texts() const {
        REQUIRE(type.substr(0, 2) == "<U");
        const std::size_t length = std::stoul(type.substr(2));
        std::vector<std::string> result;
        for (std::size_t at = 0; at < data.size(); at += 4 * length) {
            result.emplace_back();
            for (std::size_t k = 0; k < length; ++k)
                if (const char c = data[at + 4 * k]; c != 0) result.back() += c;
        }
        return result;
    }
};

using Table = std::vector<std::vector<std::string>>;

/// Without commas in fields.
Table csv_of(const std::string& file) {
    std::istringstream lines(contents(file));
    Table table;
    for (std::string line; std::getline(lines, line);) {
        table.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) table.back().push_back(field);
    }
    return table;
}

/// Each column of the CSV is an array with the same numbers.
void compare(const Table& csv, const std::map<std::string, std::string>& files) {
    CHECK(Array(files.at("columns.npy")).texts() == csv[0]);
    CHECK(Array(files.at("units.npy")).texts().size() == csv[0].size());
    for (std::size_t column = 0; column < csv[0].size(); ++column) {
        CAPTURE(csv[0][column]);
        const Array array(files.at(csv[0][column] + ".npy"));
        std::vector<std::string> values;
        if (array.type == "<f8")
            for (const double x : array.numbers<double>()) values.push_back(fmt::format("{:.17g}", x));
        else if (array.type == "<i8")
            for (const long x : array.numbers<long>()) values.push_back(std::to_string(x));
        else
            values = array.texts();
        REQUIRE(values.size() + 1 == csv.size());
        for (std::size_t row = 0; row < values.size(); ++row) CHECK(values[row] == csv[row + 1][column]);
    }
}

}  // namespace

TEST_CASE("tables: simulate -o NAME.npz has the columns of the CSV, their units and the scene") {
    const std::string scene = source_path("scenes/textbook/slider_crank.toml"), csv = temporary("run.csv", ""),
                      npz = temporary("run.npz", ""), again = temporary("again.npz", "");
    for (const std::string& file : {csv, npz, again})
        REQUIRE(run({"simulate", scene, "--duration", "0.3", "--reactions", "-o", file}).exit == 0);
    const auto files = alembert::test::unzipped(contents(npz));
    compare(csv_of(csv), files);
    const std::vector<std::string> units = Array(files.at("units.npy")).texts();
    CHECK(std::vector<std::string>(units.begin(), units.begin() + 7) ==
          std::vector<std::string>{"s", "rad", "rad", "m", "rad/s", "rad/s", "m/s"});
    CHECK(Array(files.at("scene.npy")).texts() == std::vector<std::string>{contents(scene)});
    CHECK(Array(files.at("scene.npy")).shape.empty());
    CHECK(Array(files.at("version.npy")).texts()[0].find('.') != std::string::npos);
    CHECK(contents(npz) == contents(again));
}

TEST_CASE("tables: sweep -o NAME.npz has numbers, counts and texts; names that are taken get a _") {
    const std::string scene = temporary("taken.toml", R"toml(
[coordinates]
scene = { initial = 1, unit = "m" }
"θ" = 0.5
[energy]
kinetic = "scene'^2/2 + θ'^2/2"
potential = "scene^2/2 + θ^2"
)toml");
    const std::string csv = temporary("sweep.csv", ""), npz = temporary("sweep.npz", "");
    for (const std::string& file : {csv, npz})
        REQUIRE(run({"sweep", scene, "--vary", "scene=1:2:9", "--duration", "0.5", "-o", file}).exit == 0);
    const auto files = alembert::test::unzipped(contents(npz));
    CHECK(files.contains("scene_.npy"));
    CHECK(files.contains("final_θ.npy"));
    CHECK(Array(files.at("scene.npy")).numbers<double>().size() == 9);
    CHECK(Array(files.at("steps.npy")).type == "<i8");
    CHECK(Array(files.at("status.npy")).texts() == std::vector<std::string>(9, "done"));
    Table table = csv_of(csv);
    for (std::size_t column = 0; column < table[0].size(); ++column) {
        const Array array(files.at(table[0][column] + ".npy"));
        if (array.type != "<f8") continue;
        const std::vector<double> values = array.numbers<double>();
        for (std::size_t row = 0; row < values.size(); ++row)
            CHECK(fmt::format("{:.17g}", values[row]) == table[row + 1][column]);
    }
}

TEST_CASE("tables: simulate -o NAME.h5 has the numbers of NAME.npz, or says what to install") {
    const std::string scene = source_path("scenes/textbook/cart_pole.toml"), h5 = temporary("run.h5", ""),
                      npz = temporary("run.npz", "");
    const auto made = run({"simulate", scene, "--duration", "1", "-o", h5});
    if (!alembert::test::is_provided(made.exit == 0, "HDF5")) {
        CHECK(made.exit == 5);
        CHECK_MESSAGE(made.err.find("libhdf5-dev") != std::string::npos, made.err);
        return;
    }
    REQUIRE(run({"simulate", scene, "--duration", "1", "-o", npz}).exit == 0);
    const std::string bytes = contents(h5);
    CHECK(bytes.substr(0, 8) == "\x89HDF\r\n\x1a\n");
    for (const auto& [name, file] : alembert::test::unzipped(contents(npz))) {
        const Array array(file);
        CAPTURE(name);
        if (array.type == "<f8") CHECK(bytes.find(array.data) != std::string::npos);
        if (array.type == "<f8") CHECK(bytes.find(name.substr(0, name.size() - 4)) != std::string::npos);
    }
}

}  // namespace commands_tables
