// Tests a server with a real socket. tests/web/hostile_clients tests the limits of the server.
#include "serve/server.hpp"

#include <chrono>
#include <cstring>
#include <functional>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace dotpose::serve {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr Page kPages[] = {{"/", "text/html", "<p>start"}};

/// Waits until a condition holds. Fails after a minute, which is long enough even on a busy
/// computer.
void wait_until(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!holds()) {
        ASSERT_LT(std::chrono::steady_clock::now(), end);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

class Socket {
  public:
    explicit Socket(const std::string& url) : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port =
            htons(static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1))));
        const timeval patience{60, 0};
        setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        if (connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
            ADD_FAILURE() << "cannot connect to " << url;
    }
    ~Socket() { close(descriptor_); }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;

    void send(const std::string& bytes) const {
        EXPECT_EQ(::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
                  static_cast<ssize_t>(bytes.size()));
    }
    /// Returns the received text once it contains `end`.
    std::string receive(const std::string& end) const {
        std::string text;
        char byte = 0;
        while (text.find(end) == std::string::npos && recv(descriptor_, &byte, 1, 0) == 1)
            text += byte;
        return text;
    }

  private:
    int descriptor_;
};

std::string get(const Server& server, const std::string& path, const std::string& end) {
    const Socket socket(server.url());
    socket.send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return socket.receive(end);
}

/// A WebSocket client. It sends only payloads shorter than 126 bytes, whose length is encoded in a
/// single byte.
class WebSocket : public Socket {
  public:
    explicit WebSocket(const Server& server) : Socket(server.url()) {
        send(
            "GET /live HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
            "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
        // RFC 6455 gives this key and its answer as an example.
        EXPECT_THAT(receive("\r\n\r\n"), HasSubstr("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="));
    }
    void command(const std::string& text) const {
        const std::string mask(4, '\0');
        send(std::string("\x81") + static_cast<char>(0x80 | text.size()) + mask + text);
    }
};

TEST(Server, AnswersPagesAndRoutes) {
    Server server({.address = {}, .token = {}, .pages = kPages});
    server.start();
    EXPECT_THAT(get(server, "/", "start"), StartsWith("HTTP/1.1 200"));
    server.set_route("/metrics", [] { return Answer{.type = "text/plain", .body = "robots 2"}; });
    const std::string answer = get(server, "/metrics", "robots 2");
    EXPECT_THAT(answer, HasSubstr("robots 2"));
    EXPECT_THAT(answer, HasSubstr("content-security-policy: default-src 'none'"));
    EXPECT_THAT(get(server, "/other", "page."), StartsWith("HTTP/1.1 404"));
    server.remove_route("/metrics");
    EXPECT_THAT(get(server, "/metrics", "page."), StartsWith("HTTP/1.1 404"));
}

TEST(Server, DeliversValuesToClientsThatAcknowledge) {
    Server server({.address = {}, .token = {}, .pages = {}});
    Topic& topic = server.add_topic("state", Format::text);
    server.start();
    const WebSocket client(server);
    wait_until([&] { return server.clients() == 1; });
    EXPECT_FALSE(topic.is_wanted());
    client.command(R"({"do": "subscribe", "topic": "state"})");
    wait_until([&] { return topic.is_wanted(); });
    server.publish(topic, [] { return "value-1."; });
    EXPECT_THAT(client.receive("."), HasSubstr("state\nvalue-1"));
    wait_until([&] { return topic.is_wanted(); });
    server.publish(topic, [] { return "value-2."; });
    EXPECT_THAT(client.receive("."), HasSubstr("value-2"));
    // The client has not acknowledged any value, so it receives no third value. The server does not
    // even produce a third value.
    server.publish(topic, [] { return "value-3."; });
    server.publish(topic, [] { return "value-4."; });
    EXPECT_FALSE(topic.is_wanted());
    client.command(R"({"do": "next", "topic": "state"})");
    EXPECT_THAT(client.receive("."), HasSubstr("value-4"));
}

TEST(Server, PassesCommandsToTheProgram) {
    Server server({.address = {}, .token = {}, .pages = {}});
    server.start();
    const WebSocket client(server);
    client.command(R"({"do": "record", "on": true})");
    std::optional<Command> command;
    wait_until([&] { return (command = server.take_command()).has_value(); });
    EXPECT_EQ(command->name, "record");
    EXPECT_TRUE(*command->argument<bool>("on"));
    EXPECT_FALSE(server.take_command());
}

TEST(Server, NetworkAddressNeedsAToken) {
    EXPECT_THROW(Server({.address = {"0.0.0.0", 0}, .token = {}, .pages = {}}), BadArgument);
}

TEST(Server, PortInUseIsAnError) {
    Server first({.address = {}, .token = {}, .pages = {}});
    first.start();
    const std::string url = first.url();
    const auto port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
    Server second({.address = {"127.0.0.1", port}, .token = {}, .pages = {}});
    EXPECT_THROW(second.start(), Error);
}

}  // namespace
}  // namespace dotpose::serve
