# SPDX-License-Identifier: MIT
# Formula for Homebrew: packaging/recipes.sh fills it in.
#
# Its syntax is tried (ruby -c). Not tried: brew audit, and any build on macOS or with Homebrew's libraries, whose versions of
# GiNaC, fmt and toml++ are newer than those of Debian 12.
class Alembert < Formula
  desc "Equations of motion of mechanical systems, derived, proved and integrated"
  homepage "@home@"
  url "@url@"
  sha256 "@sha256@"
  license all_of: ["GPL-2.0-or-later", "MIT"]

  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "cpp-httplib" => :build
  depends_on "eigen" => :build
  depends_on "gettext" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "tomlplusplus" => :build
  depends_on "cln"
  depends_on "fmt"
  depends_on "ginac"
  depends_on "gmp"
  depends_on "tinyxml2"

  resource "mustache" do
    url "https://github.com/kainjow/Mustache.git",
        tag:      "v4.1",
        revision: "c66fdd87f01f0b2d1ba704192f27355b77746a5b"
  end

  def install
    resource("mustache").stage { (buildpath/"headers/kainjow").install "mustache.hpp" }
    ENV.prepend_path "CPLUS_INCLUDE_PATH", buildpath/"headers"
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_UNITY_BUILD=ON", "-DALEMBERT_TESTS=OFF",
           "-DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    system bin/"alembert", "new", "pendulum.toml"
    assert_match "theta''", shell_output("#{bin}/alembert derive pendulum.toml")
    system bin/"alembert", "check", "pendulum.toml"
    system bin/"alembert", "eval", "pendulum.toml"
  end
end
