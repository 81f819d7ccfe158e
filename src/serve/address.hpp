// Addresses on which a server listens.
#pragma once

#include <cstdint>
#include <string>

#include "dotpose/files/error.hpp"

namespace dotpose::serve {

/// An IP address of this computer, and a port.
struct Address {
    std::string ip = "127.0.0.1";  ///< IPv4 or IPv6 address; 0.0.0.0 and :: mean all interfaces
    std::uint16_t port = 0;        ///< 0 to let the system choose a free port

    /// Returns true if only programs on this computer can reach the address.
    bool is_loopback() const;
    /// Returns true if the address represents all interfaces of this computer.
    bool is_any() const;
};

/// Parses "[ADDRESS:]PORT". ADDRESS is an IP address, with IPv6 addresses in brackets, or
/// "localhost". Throws BadArgument if the text is not an address.
Address parse_address(const std::string& text);

/// Returns "IP:PORT", with IPv6 addresses in brackets.
std::string text_of(const Address& address);

/// Throws Error with the reason why a server cannot listen on the address, for example because
/// another program is already listening there.
void require_free(const Address& address);

}  // namespace dotpose::serve
