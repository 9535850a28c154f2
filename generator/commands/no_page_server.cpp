// SPDX-License-Identifier: GPL-2.0-or-later
// In the place of page_server.cpp, where the program is built without cpp-httplib.
#include "alembert/error.hpp"
#include "commands/page_server.hpp"

namespace alembert {

struct PageServer::State {};

PageServer::PageServer(int) {
    throw CompileError(
        "watch is missing: this program was built without cpp-httplib; install libcpp-httplib-dev, configure and "
        "build again, or use 'alembert report'");
}
PageServer::~PageServer() = default;
std::string PageServer::address() const {
    return {};
}
void PageServer::announce() {}
void PageServer::publish(std::string) {}

}  // namespace alembert
