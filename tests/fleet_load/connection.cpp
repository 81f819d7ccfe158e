#include "connection.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace dotpose::test {
namespace {

// First byte of each packet type (MQTT 3.1.1, section 2.2).
constexpr std::uint8_t kConnect = 0x10;
constexpr std::uint8_t kConnectAnswer = 0x20;
constexpr std::uint8_t kPublishQos1 = 0x32;
constexpr std::uint8_t kPublishAnswer = 0x40;
constexpr std::uint8_t kSubscribe = 0x82;
constexpr std::uint8_t kSubscribeAnswer = 0x90;
constexpr std::uint8_t kPing = 0xC0;
constexpr std::uint8_t kPingAnswer = 0xD0;

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what + ": " + std::strerror(errno));
}

void add_16(std::string& packet, std::size_t value) {
    packet += static_cast<char>(value >> 8);
    packet += static_cast<char>(value & 0xFF);
}

void add_text(std::string& packet, std::string_view text) {
    add_16(packet, text.size());
    packet += text;
}

void add_packet(std::string& stream, std::uint8_t type, std::string_view body) {
    stream += static_cast<char>(type);
    std::size_t left = body.size();
    do {
        const std::size_t digit = left % 128;
        left /= 128;
        stream += static_cast<char>(left > 0 ? digit | 128 : digit);
    } while (left > 0);
    stream += body;
}

sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    return address;
}

void set_up(int descriptor) {
    const int yes = 1;
    setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    fcntl(descriptor, F_SETFL, O_NONBLOCK);
}

}  // namespace

std::int64_t monotonic_us() {
    using namespace std::chrono;
    return duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
}

Connection Connection::to_broker(int port, const std::string& client) {
    const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
    Connection connection(descriptor);
    const sockaddr_in address = loopback(port);
    if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        fail("cannot reach the broker");
    }
    set_up(descriptor);
    std::string body;
    add_text(body, "MQTT");
    body += '\x04';   // version 3.1.1
    body += '\x02';   // clean session
    add_16(body, 0);  // no keep-alive pings
    add_text(body, client);
    add_packet(connection.outgoing_, kConnect, body);
    while (!connection.is_ready_)
        connection.exchange(monotonic_us() + 1000);
    return connection;
}

Connection Connection::to_subscriber(int port) {
    const int listener = socket(AF_INET, SOCK_STREAM, 0);
    const int yes = 1;
    setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const sockaddr_in address = loopback(port);
    if (bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        listen(listener, 1) != 0) {
        fail("cannot listen");
    }
    const int descriptor = accept(listener, nullptr, nullptr);
    close(listener);
    if (descriptor < 0) fail("nobody connects");
    set_up(descriptor);
    Connection connection(descriptor);
    while (!connection.is_ready_)
        connection.exchange(monotonic_us() + 1000);
    return connection;
}

Connection::Connection(Connection&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      outgoing_(std::move(other.outgoing_)),
      sent_(other.sent_),
      incoming_(std::move(other.incoming_)),
      published_(other.published_),
      answered_(other.answered_),
      is_ready_(other.is_ready_) {}

Connection::~Connection() {
    if (descriptor_ >= 0) close(descriptor_);
}

void Connection::publish(const std::string& topic, const std::string& payload) {
    std::string body;
    add_text(body, topic);
    add_16(body, static_cast<std::size_t>(published_++ % 65535) + 1);
    body += payload;
    add_packet(outgoing_, kPublishQos1, body);
}

void Connection::exchange(std::int64_t until_us) {
    for (;;) {
        const bool has_more = sent_ < outgoing_.size();
        const std::int64_t left_us = until_us - monotonic_us();
        if (left_us <= 0 && !has_more) return;
        pollfd state{descriptor_, static_cast<short>(has_more ? POLLIN | POLLOUT : POLLIN), 0};
        const auto wait_ms = static_cast<int>(left_us <= 0 ? 1 : (left_us + 999) / 1000);
        poll(&state, 1, wait_ms);
        if ((state.revents & POLLIN) != 0) receive_some();
        if ((state.revents & POLLOUT) != 0) send_some();
        if ((state.revents & (POLLERR | POLLHUP)) != 0) throw std::runtime_error("disconnected");
    }
}

void Connection::send_some() {
    const ssize_t size =
        send(descriptor_, outgoing_.data() + sent_, outgoing_.size() - sent_, MSG_NOSIGNAL);
    if (size < 0 && errno != EAGAIN) fail("cannot send");
    if (size > 0) sent_ += static_cast<std::size_t>(size);
    if (sent_ < outgoing_.size()) return;
    outgoing_.clear();
    sent_ = 0;
}

void Connection::receive_some() {
    std::array<char, 65536> block;
    const ssize_t size = recv(descriptor_, block.data(), block.size(), 0);
    if (size == 0) throw std::runtime_error("disconnected");
    if (size < 0 && errno != EAGAIN) fail("cannot receive");
    if (size > 0) incoming_.append(block.data(), static_cast<std::size_t>(size));
    // A broker sends only packets shorter than 128 bytes to a publisher. The length of such a
    // packet is encoded in a single byte, the second byte of the packet.
    std::size_t at = 0;
    while (incoming_.size() >= at + 2) {
        const std::size_t length = static_cast<std::uint8_t>(incoming_[at + 1]);
        if (incoming_.size() < at + 2 + length) break;
        take(static_cast<std::uint8_t>(incoming_[at]),
             std::string_view(incoming_).substr(at + 2, length));
        at += 2 + length;
    }
    incoming_.erase(0, at);
}

void Connection::take(std::uint8_t type, std::string_view body) {
    if (type == kPublishAnswer) ++answered_;
    if (type == kPing) add_packet(outgoing_, kPingAnswer, {});
    if (type == kConnectAnswer) {
        if (body.size() != 2 || body[1] != 0) throw std::runtime_error("the broker refuses");
        is_ready_ = true;
    }
    using namespace std::string_view_literals;
    if (type == kConnect) add_packet(outgoing_, kConnectAnswer, "\0\0"sv);
    if (type == kSubscribe) {
        add_packet(outgoing_, kSubscribeAnswer, std::string(body.substr(0, 2)) + '\x01');
        is_ready_ = true;
    }
}

}  // namespace dotpose::test
