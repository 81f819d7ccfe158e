// An HTTP and WebSocket server on its own thread, for pages that display the state of a running
// program. Requires libwebsockets at build time.
//
//     serve::Server server({.address = address, .pages = pages});
//     serve::Topic& states = server.add_topic("state", serve::Format::text);
//     server.start();
//     while (next_frame()) {
//         if (states.is_wanted()) server.publish(states, [json] { return json; });
//         while (auto command = server.take_command()) obey(*command);
//     }
//
// Protocol of the WebSocket /live: a client sends these commands.
// - {"do": "subscribe", "topic": NAME} requests the values of a topic. The values of some topics
//   depend on further arguments, which the client can change by sending the command again.
// - {"do": "next", "topic": NAME} must be sent after each message that the client has displayed.
// - {"do": "unsubscribe", "topic": NAME} ends the subscription.
// All other commands are passed to the program. Each message from the server consists of the name
// of a topic, a line break, and the value.
//
// The server never opens a file whose name is part of a request. Its limits are in limits.hpp.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "serve/access.hpp"
#include "serve/address.hpp"
#include "serve/command.hpp"
#include "serve/topic.hpp"

namespace dotpose::serve {

/// A file of the web page, embedded in the program.
struct Page {
    std::string_view path;  ///< path in URLs, such as "/live.js"
    std::string_view type;  ///< MIME type
    std::string_view content;
};

/// Response to a GET request.
struct Answer {
    std::string type = {};  ///< MIME type
    std::string body = {};
    /// Path of a file that is sent instead of `body`, or empty to send `body`. The path must not be
    /// derived from a request.
    std::string file = {};
    /// File name under which browsers save the response, or empty if they should display it. The
    /// name must consist of letters, digits, '.', '-' and '_'.
    std::string download = {};
};

/// Returns the response to a GET request. Called on the server's thread. Must not throw.
using Route = std::function<Answer()>;

/// Format in which the values of a topic are sent.
enum class Format { text, binary };

struct ServerOptions {
    Address address;
    /// Token that clients must send. May be empty only if `address` is a loopback address.
    std::string token;
    /// Files of the web page. They must outlive the server. The file with the path "/" is the start
    /// page.
    std::span<const Page> pages;
    /// Called with messages for the user, such as reports of refused clients. Called on the
    /// server's thread.
    std::function<void(const std::string&)> notify = [](const std::string&) {};
};

class Server {
  public:
    /// Throws BadArgument if `token` is empty and the address is not a loopback address, or if this
    /// program was built without libwebsockets.
    explicit Server(ServerOptions options);
    /// Closes all connections.
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Adds a topic. Must be called before `start`.
    Topic& add_topic(const std::string& name, Format format);

    /// Starts the thread. Throws Error if the server cannot listen.
    void start();

    // The following functions may be called on any thread, after `start`.

    /// Returns the URL of the page, with the token if there is one.
    std::string url() const;

    /// Adds or replaces a route.
    void set_route(const std::string& path, Route route);

    /// Removes a route if it exists.
    void remove_route(const std::string& path);

    /// Replaces the value of a topic and wakes the server.
    void publish(Topic& topic, Topic::Encode encode);

    /// Replaces the value of a topic with one that depends on the request of each client
    /// (Topic::publish_for_each), and wakes the server.
    void publish_for_each(Topic& topic, Topic::EncodeFor encode);

    /// Returns the next command from a client, or nullopt if there is none. The queue contains at
    /// most 32 commands. If it is full, a client that sends another command is disconnected.
    std::optional<Command> take_command();

    /// Returns the number of connected clients.
    int clients() const;

  private:
    class Service;
    std::unique_ptr<Service> service_;
};

}  // namespace dotpose::serve
