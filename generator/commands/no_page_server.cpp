// SPDX-License-Identifier: GPL-2.0-or-later
// Replaces page_server.cpp if the program is built without cpp-httplib.
#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/page_server.hpp"

namespace alembert {

struct PageServer::State {};

PageServer::PageServer(int) {
    throw CompileError(say(
        "watch is missing: this program was built without cpp-httplib; install libcpp-httplib-dev, configure and "
        "build again, or use 'alembert report'"));
}
PageServer::~PageServer() = default;
std::string PageServer::address() const {
    return {};
}
void PageServer::announce() {}
void PageServer::publish(std::string) {}

}  // namespace alembert
