#include "serve/address.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace dotpose::serve {
namespace {

bool is_ipv6(const std::string& ip) {
    return ip.find(':') != std::string::npos;
}

/// An IP address as the operating system represents it.
struct SocketAddress {
    sockaddr_storage storage{};
    socklen_t size = 0;  ///< 0 if the text is not an IP address
};

SocketAddress socket_address(const Address& address) {
    SocketAddress result;
    if (is_ipv6(address.ip)) {
        sockaddr_in6 ipv6{};
        ipv6.sin6_family = AF_INET6;
        ipv6.sin6_port = htons(address.port);
        if (inet_pton(AF_INET6, address.ip.c_str(), &ipv6.sin6_addr) == 1)
            result.size = sizeof ipv6;
        std::memcpy(&result.storage, &ipv6, sizeof ipv6);
    } else {
        sockaddr_in ipv4{};
        ipv4.sin_family = AF_INET;
        ipv4.sin_port = htons(address.port);
        if (inet_pton(AF_INET, address.ip.c_str(), &ipv4.sin_addr) == 1) result.size = sizeof ipv4;
        std::memcpy(&result.storage, &ipv4, sizeof ipv4);
    }
    return result;
}

}  // namespace

bool Address::is_loopback() const {
    return ip == "::1" || ip.starts_with("127.");
}

bool Address::is_any() const {
    return ip == "0.0.0.0" || ip == "::";
}

Address parse_address(const std::string& text) {
    Address address;
    std::string port = text;
    if (const std::size_t colon = text.rfind(':'); colon != std::string::npos) {
        address.ip = text.substr(0, colon);
        port = text.substr(colon + 1);
        const bool is_bracketed = address.ip.starts_with('[') && address.ip.ends_with(']');
        if (is_bracketed) address.ip = address.ip.substr(1, address.ip.size() - 2);
        if (is_bracketed != is_ipv6(address.ip)) address.ip.clear();
        if (address.ip == "localhost") address.ip = "127.0.0.1";
    }
    const char* end = port.data() + port.size();
    const auto [rest, error] = std::from_chars(port.data(), end, address.port);
    if (port.empty() || error != std::errc() || rest != end || socket_address(address).size == 0) {
        throw BadArgument(fmt::format(
            "'{}' is not [ADDRESS:]PORT: give a port from 0 to 65535, such as 8080, or an IP "
            "address and a port, such as 0.0.0.0:8080 or [::1]:8080",
            text));
    }
    return address;
}

std::string text_of(const Address& address) {
    return fmt::format(fmt::runtime(is_ipv6(address.ip) ? "[{}]:{}" : "{}:{}"), address.ip,
                       address.port);
}

void require_free(const Address& address) {
    const SocketAddress at = socket_address(address);
    const int descriptor = socket(at.storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const bool is_free =
        bind(descriptor, reinterpret_cast<const sockaddr*>(&at.storage), at.size) == 0 &&
        listen(descriptor, 1) == 0;
    const int reason = errno;
    if (descriptor >= 0) close(descriptor);
    if (is_free) return;
    const char* remedy = reason == EADDRINUSE      ? ": give another port"
                         : reason == EACCES        ? ": give a port above 1023"
                         : reason == EADDRNOTAVAIL ? ": give an address of this computer"
                                                   : "";
    throw Error(
        fmt::format("cannot listen at {}: {}{}", text_of(address), std::strerror(reason), remedy));
}

}  // namespace dotpose::serve
