// Rules that determine which requests a server answers. They protect a server at a loopback address
// from pages of other sites that are open in the same browser. They protect a server on a network
// from clients without the token.
#pragma once

#include <string>
#include <string_view>

#include "serve/address.hpp"

namespace dotpose::serve {

/// Minimum length of a token.
inline constexpr std::size_t kMinTokenLength = 16;
/// Maximum length of a token.
inline constexpr std::size_t kMaxTokenLength = 256;

/// Returns a random token of 128 bits, as 32 hexadecimal digits. Throws Error if the system cannot
/// provide random numbers.
std::string make_token();

/// Reads a token from the first line of a file. Throws Error if the file cannot be read or the
/// token does not consist of 16 to 256 letters, digits and the characters '-', '_', '.', '~'.
std::string read_token(const std::string& path);

/// Compares two strings. The running time depends only on their lengths.
bool equals_in_constant_time(std::string_view a, std::string_view b);

/// The properties of a request that determine whether it is answered. Members for missing headers
/// are empty.
struct RequestHead {
    std::string host;           ///< Host header
    std::string origin;         ///< Origin header, which browsers add to requests from scripts
    std::string cookie;         ///< Cookie header
    std::string authorization;  ///< Authorization header
    std::string token;          ///< `token` parameter of the URL
    bool is_get = false;        ///< true if the method is GET
};

enum class Verdict {
    allowed,
    /// Allowed by the token in the URL. The response should store the token as a cookie.
    allowed_by_url,
    wrong_host,    ///< the host is not a name of this server (DNS rebinding)
    wrong_origin,  ///< the request is from a page on another site
    wrong_token,   ///< the token is missing or wrong
    wrong_method,
};

class Access {
  public:
    /// An empty `token` allows all clients, and requires a loopback address. `hostname` is the name
    /// of this computer.
    Access(const Address& address, std::string token, std::string hostname);

    Verdict judge(const RequestHead& head) const;

    /// Returns the value of a Set-Cookie header that stores the token. The name of the cookie
    /// contains the port, because browsers share cookies between all ports of a host.
    std::string set_cookie() const;

  private:
    bool is_own_host(std::string_view host) const;
    bool is_token(std::string_view token) const;

    Address address_;
    std::string token_;
    std::string hostname_;
    std::string cookie_name_;
};

}  // namespace dotpose::serve
