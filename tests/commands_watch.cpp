// SPDX-License-Identifier: MIT
// `watch` over a socket, as a browser talks to it and as others might.
#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "files.hpp"
#include "shell.hpp"
#include "tools.hpp"

namespace commands_watch {

using alembert::test::contents;
using alembert::test::run;
using alembert::test::run_shell;
using alembert::test::temporary;

namespace {

constexpr const char* scene_text =
    "title = \"</title><script>alert(1)</script>\"\n[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\n"
    "potential = \"x^2/2\"\n[simulation]\nduration = 0.1\n";

/// A `watch` in the background; ended with the test.
struct Watching {
    std::string scene, log;
    int process = 0, port = 0;

    explicit Watching(const std::string& text)
        : scene(temporary("watched.toml", text)), log(temporary("watch.log", "")) {
        const auto started =
            run_shell("\"$ALEMBERT\" watch \"$1\" --no-motion >\"$2\" 2>&1 & echo $!", {scene, log});
        process = std::stoi(started.out);
        const std::string before = "http://127.0.0.1:";
        while (port == 0 && kill(process, 0) == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            const std::string said = contents(log);
            if (const std::size_t at = said.find(before);
                at != std::string::npos && said.find("made in") != said.npos)
                port = std::stoi(said.substr(at + before.size()));
        }
        INFO(contents(log));
        REQUIRE(port > 0);
    }
    ~Watching() { kill(process, SIGTERM); }
};

/// A connection that has sent a request.
struct Connection {
    int descriptor;
    Connection(int port, const std::string& request) : descriptor(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
        REQUIRE(connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
        REQUIRE(send(descriptor, request.data(), request.size(), 0) == static_cast<ssize_t>(request.size()));
    }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    ~Connection() { close(descriptor); }

    /// Reads until `end` has arrived or nothing more comes.
    std::string read_until(const std::string& end) const {
        std::string text;
        char bytes[4096];
        for (ssize_t count = 0; end.empty() || text.find(end) == std::string::npos;) {
            count = recv(descriptor, bytes, sizeof bytes, 0);
            if (count <= 0) break;
            text.append(bytes, static_cast<std::size_t>(count));
        }
        return text;
    }
};

std::string answer(int port, const std::string& what, const std::string& host) {
    const std::string line = host.empty() ? "" : "Host: " + host + "\r\n";
    return Connection(port, what + " HTTP/1.1\r\n" + line + "Connection: close\r\n\r\n").read_until("");
}

int status(const std::string& answer) {
    return answer.size() > 12 ? std::stoi(answer.substr(9, 3)) : 0;
}

/// Was the program built with a server? It gives up its start at once where the port that it is told is taken.
bool is_built() {
    const int taken = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    socklen_t size = sizeof address;
    REQUIRE(bind(taken, reinterpret_cast<const sockaddr*>(&address), size) == 0);
    REQUIRE(listen(taken, 1) == 0);
    REQUIRE(getsockname(taken, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    const std::string port = std::to_string(ntohs(address.sin_port));
    const auto result = run({"watch", temporary("watched.toml", scene_text), "--port", port});
    close(taken);
    CHECK(result.exit == 5);
    return alembert::test::is_provided(result.err.find("without cpp-httplib") == std::string::npos, "cpp-httplib");
}

}  // namespace

TEST_CASE("watch: it answers only to this machine's names, and serves nothing but the page and its events") {
    if (!is_built()) return;
    const Watching watching(scene_text);
    const int port = watching.port;
    const std::string ours = "127.0.0.1:" + std::to_string(port);
    const std::string frame = answer(port, "GET /", ours);
    CHECK(status(frame) == 200);
    CHECK(frame.find("frame-ancestors 'none'") != std::string::npos);
    const std::string page = answer(port, "GET /page", "localhost:" + std::to_string(port));
    CHECK(status(page) == 200);
    CHECK(page.find("<script>alert(1)") == std::string::npos);
    CHECK(page.find("&lt;script&gt;alert(1)") != std::string::npos);
    for (const std::string& host :
         {std::string("evil.example"), "evil.example:" + std::to_string(port), std::string("127.0.0.1"),
          std::string("127.0.0.1:1"), "127.0.0.1.evil.example:" + std::to_string(port),
          ours + "\r\nHost: evil.example", std::string()}) {
        CAPTURE(host);
        const std::string refused = answer(port, "GET /page", host);
        CHECK(status(refused) >= 400);
        CHECK(refused.find("alert(1)") == std::string::npos);
    }
    for (const char* const what : {"GET /watched.toml", "GET /../watched.toml", "GET /%2e%2e/watched.toml",
                                   "GET /etc/passwd", "GET /page/x"})
        CHECK(status(answer(port, what, ours)) == 404);
    for (const char* const what : {"POST /page", "PUT /page", "DELETE /page", "OPTIONS /page"})
        CHECK(status(answer(port, what, ours)) == 405);
    CHECK(page.find("Access-Control-Allow-Origin") == std::string::npos);
}

TEST_CASE("watch: the browser is informed of a saved scene, and the page shows a mistake at its place") {
    if (!is_built()) return;
    const Watching watching(scene_text);
    const std::string ours = "127.0.0.1:" + std::to_string(watching.port);
    const Connection events(watching.port, "GET /events HTTP/1.1\r\nHost: " + ours + "\r\n\r\n");
    CHECK(events.read_until("data: 1").find("event: page") != std::string::npos);
    std::ofstream(watching.scene) << "[coordinates]\nx = \"1 +* <b>\"\n";  // in place
    CHECK(events.read_until("data: 2").find("event: page") != std::string::npos);
    const std::string broken = answer(watching.port, "GET /page", ours);
    CHECK(broken.find("watched.toml:2") != std::string::npos);
    CHECK(broken.find("<b>") == std::string::npos);
    std::ofstream(watching.scene + ".new") << scene_text;  // as editors replace a file
    std::filesystem::rename(watching.scene + ".new", watching.scene);
    CHECK(events.read_until("data: 3").find("event: page") != std::string::npos);
    CHECK(answer(watching.port, "GET /page", ours).find("watched.toml:2") == std::string::npos);
}

}  // namespace commands_watch
