// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Serves a page to a browser on this machine, which reloads it whenever a new one is published.
///
///     PageServer server(0);                                   // 0: any free port
///     server.publish(as_html(overview(scene)));
///     std::cout << server.address();                          // http://127.0.0.1:40211/
///
/// It listens on 127.0.0.1 only and serves from a thread of its own until it goes out of scope. It serves only `/`
/// (a frame around the page that waits for events), `/page` and `/events`. A request whose Host is not 127.0.0.1
/// or localhost with this port is refused, so that a foreign site whose name resolves to this address (DNS
/// rebinding) cannot read the page. The server is that of cpp-httplib.

#include <memory>
#include <string>

namespace alembert {

class PageServer {
public:
    /// Throws CompileError (the environment failed) if the port is not available, or if the program was built
    /// without cpp-httplib.
    explicit PageServer(int port);
    ~PageServer();

    std::string address() const;

    /// Tells browsers that the next page is being made.
    void announce();
    void publish(std::string page);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace alembert
