// Server for a program that was built without libwebsockets.
#include "dotpose/files/error.hpp"
#include "serve/server.hpp"

namespace dotpose::serve {

class Server::Service {};

Server::Server(ServerOptions) {
    throw BadArgument(
        "--web: this dotpose was built without its page; install libwebsockets-dev and esbuild, "
        "and build it again");
}

Server::~Server() = default;

Topic& Server::add_topic(const std::string&, Format) {
    throw Error("there is no server");
}

void Server::start() {}

std::string Server::url() const {
    return {};
}

void Server::set_route(const std::string&, Route) {}

void Server::remove_route(const std::string&) {}

void Server::publish(Topic&, Topic::Encode) {}

void Server::publish_for_each(Topic&, Topic::EncodeFor) {}

std::optional<Command> Server::take_command() {
    return std::nullopt;
}

int Server::clients() const {
    return 0;
}

}  // namespace dotpose::serve
