// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A page for the browser of this machine, which is loaded again whenever another one is published.
///
///     PageServer server(0);                                   // 0: any free port
///     server.publish(as_html(overview(scene)));
///     std::cout << server.address();                          // http://127.0.0.1:40211/
///
/// It listens on 127.0.0.1 alone and serves from a thread of its own until it goes out of scope. There is nothing
/// but
/// `/` (a frame around the page that listens for news), `/page` and `/events`. A request whose Host is not
/// 127.0.0.1 or localhost with this port is refused, so that no name of somebody else's that leads here (DNS
/// rebinding) can read the page. The server is that of cpp-httplib.

#include <memory>
#include <string>

namespace alembert {

class PageServer {
public:
    /// Throws CompileError (the environment failed) where the port cannot be had, or the program was built without
    /// cpp-httplib.
    explicit PageServer(int port);
    ~PageServer();

    std::string address() const;

    /// The next page is being made: browsers say so.
    void announce();
    void publish(std::string page);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace alembert
