// SPDX-License-Identifier: GPL-2.0-or-later
// Events are server-sent events (WHATWG HTML, §9.2): "making" and "page". On the latter, the frame around the page
// reloads it. The page itself is the one that `report` writes, under its own policy, which allows it no
// connections.
#include "commands/page_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "present/report/sha256.hpp"

namespace alembert {

namespace {

constexpr const char* loopback = "127.0.0.1";
constexpr int most_streams = 12, threads = 16;
constexpr auto heartbeat = std::chrono::seconds(5);

constexpr const char* script = R"(
const frame = document.querySelector('iframe'), note = document.querySelector('output');
const news = new EventSource('/events');
let last = '';
news.addEventListener('making', () => { note.textContent = note.dataset.making; });
news.addEventListener('page', event => {
  note.textContent = '';
  if (event.data === last) return;
  const y = frame.contentWindow.scrollY;
  last = event.data;
  frame.onload = () => frame.contentWindow.scrollTo(0, y);
  frame.contentWindow.location.reload();
});
news.onerror = () => { note.textContent = note.dataset.ended; };
)";
constexpr const char* style = R"(
html, body { margin: 0; height: 100%; } iframe { border: 0; width: 100%; height: 100%; display: block; }
output { position: fixed; right: 1rem; bottom: 1rem; padding: .2rem .6rem; font: 14px sans-serif; background: #222;
  color: #fff; border-radius: 4px; } output:empty { display: none; }
)";

std::string frame_around() {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"{}\"><head><meta charset=\"utf-8\"><title>alembert report --watch</title>"
        "<meta name=\"viewport\" content=\"width=device-width\"><style>{}</style></head><body>"
        "<iframe src=\"/page\" title=\"{}\"></iframe><output role=\"status\" data-making=\"{}\" "
        "data-ended=\"{}\"></output>"
        "<script>{}</script></body></html>\n",
        say("en"), style, say("the scene"), say("making the page …"), say("alembert has ended"), script);
}

std::string policy_of_frame() {
    return fmt::format(
        "default-src 'none'; script-src 'sha256-{}'; style-src 'sha256-{}'; frame-src 'self'; "
        "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
        sha256_base64(script), sha256_base64(style));
}

}  // namespace

struct PageServer::State {
    httplib::Server server;
    int port = 0;
    std::thread thread;
    std::mutex mutex;
    std::condition_variable changed;
    std::string page;
    long version = 0;
    bool is_making = false, is_over = false;
    int streams = 0;

    bool is_for_us(const httplib::Request& request) const {
        if (request.get_header_value_count("Host") != 1) return false;
        const std::string host = request.get_header_value("Host");
        for (const char* const name : {loopback, "localhost"})
            if (host == fmt::format("{}:{}", name, port) || (port == 80 && host == name)) return true;
        return false;
    }

    void protect(httplib::Response& response) const {
        response.set_header("Cache-Control", "no-store");
        response.set_header("X-Content-Type-Options", "nosniff");
        response.set_header("Referrer-Policy", "no-referrer");
        response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    }

    /// Waits for events after `seen` and writes them; false if the stream is over.
    bool tell(httplib::DataSink& sink, std::pair<long, bool>& seen) {
        std::unique_lock lock(mutex);
        changed.wait_for(lock, heartbeat, [&] { return is_over || seen != std::pair(version, is_making); });
        if (is_over) return false;
        std::string news = ": still here\n\n";
        if (seen != std::pair(version, is_making))
            news = is_making ? "event: making\ndata:\n\n" : fmt::format("event: page\ndata: {}\n\n", version);
        seen = {version, is_making};
        lock.unlock();
        return sink.write(news.data(), news.size());
    }

    void serve_events(httplib::Response& response) {
        {
            const std::lock_guard lock(mutex);
            if (streams >= most_streams) {
                response.status = 503;
                return;
            }
            ++streams;
        }
        response.set_chunked_content_provider(
            "text/event-stream",
            [this, seen = std::pair(-1L, false)](std::size_t, httplib::DataSink& sink) mutable {
                return tell(sink, seen);
            },
            [this](bool) {
                const std::lock_guard lock(mutex);
                --streams;
            });
    }

    void set_up() {
        server.new_task_queue = [] { return new httplib::ThreadPool(threads); };
        server.set_keep_alive_max_count(20);
        server.set_payload_max_length(0);
        server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            protect(response);
            if (is_for_us(request) && (request.method == "GET" || request.method == "HEAD"))
                return httplib::Server::HandlerResponse::Unhandled;
            response.status = is_for_us(request) ? 405 : 403;
            return httplib::Server::HandlerResponse::Handled;
        });
        server.Get("/", [](const httplib::Request&, httplib::Response& response) {
            response.set_header("Content-Security-Policy", policy_of_frame());
            response.set_content(frame_around(), "text/html; charset=utf-8");
        });
        server.Get("/page", [this](const httplib::Request&, httplib::Response& response) {
            const std::lock_guard lock(mutex);
            response.set_header("Content-Security-Policy", "frame-ancestors 'self'");
            response.set_content(page, "text/html; charset=utf-8");
        });
        server.Get("/events",
                   [this](const httplib::Request&, httplib::Response& response) { serve_events(response); });
    }
};

PageServer::PageServer(int port) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.set_up();
    const bool bound = port == 0 ? (s.port = s.server.bind_to_any_port(loopback)) > 0
                                 : s.server.bind_to_port(loopback, s.port = port);
    if (!bound)
        throw CompileError(say("cannot listen on {}:{}: the port is taken; give another one", loopback, port));
    s.thread = std::thread([&s] { s.server.listen_after_bind(); });
}

PageServer::~PageServer() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->is_over = true;
    }
    state_->changed.notify_all();
    state_->server.stop();
    if (state_->thread.joinable()) state_->thread.join();
}

std::string PageServer::address() const {
    return fmt::format("http://{}:{}/", loopback, state_->port);
}

void PageServer::announce() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->is_making = true;
    }
    state_->changed.notify_all();
}

void PageServer::publish(std::string page) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->page = std::move(page);
        state_->is_making = false;
        ++state_->version;
    }
    state_->changed.notify_all();
}

}  // namespace alembert
