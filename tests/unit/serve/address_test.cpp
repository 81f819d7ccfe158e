#include "serve/address.hpp"

#include <gtest/gtest.h>

namespace dotpose::serve {
namespace {

TEST(ParseAddress, PortAloneIsOnTheLoopbackInterface) {
    const Address address = parse_address("8080");
    EXPECT_EQ(address.ip, "127.0.0.1");
    EXPECT_EQ(address.port, 8080);
    EXPECT_TRUE(address.is_loopback());
    EXPECT_FALSE(address.is_any());
}

TEST(ParseAddress, AcceptsAddresses) {
    EXPECT_EQ(text_of(parse_address("0.0.0.0:80")), "0.0.0.0:80");
    EXPECT_TRUE(parse_address("0.0.0.0:80").is_any());
    EXPECT_EQ(text_of(parse_address("[::1]:8080")), "[::1]:8080");
    EXPECT_TRUE(parse_address("[::1]:8080").is_loopback());
    EXPECT_TRUE(parse_address("localhost:0").is_loopback());
    EXPECT_FALSE(parse_address("192.168.1.5:8080").is_loopback());
}

TEST(ParseAddress, RefusesOtherTexts) {
    for (const char* text :
         {"", ":", "x", "80x", "-1", "65536", "8080:", ":8080", "::1:8080", "[::1]",
          "[127.0.0.1]:80", "example.com:80", "1.2.3:80", "1.2.3.4:", " 8080"}) {
        EXPECT_THROW(parse_address(text), BadArgument) << text;
    }
}

TEST(RequireFree, RefusesAddressesOfOtherComputers) {
    // 192.0.2.0/24 is reserved for documentation (RFC 5737), so no computer has such an address.
    EXPECT_THROW(require_free(parse_address("192.0.2.1:8080")), Error);
    EXPECT_NO_THROW(require_free(parse_address("0")));
}

}  // namespace
}  // namespace dotpose::serve
