#include "serve/access.hpp"

#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../temporary_directory.hpp"
#include "dotpose/files/error.hpp"

namespace dotpose::serve {
namespace {

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

RequestHead get(const std::string& host) {
    RequestHead head;
    head.host = host;
    head.is_get = true;
    return head;
}

TEST(Access, LoopbackAcceptsOnlyNamesOfTheLoopbackInterface) {
    const Access access({"127.0.0.1", 8080}, "", "robot");
    for (const char* host : {"localhost:8080", "LOCALHOST", "127.0.0.1:8080", "[::1]:8080",
                             "localhost:9000" /* through an ssh tunnel */}) {
        EXPECT_EQ(access.judge(get(host)), Verdict::allowed) << host;
    }
    for (const char* host :
         {"", "example.com", "example.com:8080", "localhost.example.com", "127.0.0.1.nip.io:8080",
          "192.168.1.5:8080", "robot:8080", "[::1", "localhost:8080:8080"}) {
        EXPECT_EQ(access.judge(get(host)), Verdict::wrong_host) << host;
    }
}

TEST(Access, NetworkAcceptsAddressesAndOwnNames) {
    const Access access({"0.0.0.0", 8080}, kToken, "Robot");
    for (const char* host : {"192.168.1.5:8080", "[fe80::1]:8080", "robot:8080", "robot.local"})
        EXPECT_EQ(access.judge(get(host)), Verdict::wrong_token) << host;
    for (const char* host :
         {"example.com", "robot.example.com", "1.2.3.4.example.com", "robot.localx"})
        EXPECT_EQ(access.judge(get(host)), Verdict::wrong_host) << host;
}

TEST(Access, RefusesPagesOfOtherSites) {
    const Access access({"127.0.0.1", 8080}, "", "robot");
    RequestHead head = get("localhost:8080");
    for (const char* origin : {"http://localhost:8080", "https://localhost:8080"}) {
        head.origin = origin;
        EXPECT_EQ(access.judge(head), Verdict::allowed) << origin;
    }
    for (const char* origin :
         {"null", "http://example.com", "http://localhost", "http://localhost:8081",
          "http://localhost:8080.example.com", "file://"}) {
        head.origin = origin;
        EXPECT_EQ(access.judge(head), Verdict::wrong_origin) << origin;
    }
}

TEST(Access, RefusesOtherMethods) {
    const Access access({"127.0.0.1", 8080}, "", "robot");
    RequestHead head = get("localhost");
    head.is_get = false;
    EXPECT_EQ(access.judge(head), Verdict::wrong_method);
}

TEST(Access, TokenIsInCookieHeaderOrUrl) {
    const Access access({"0.0.0.0", 8080}, kToken, "robot");
    const RequestHead none = get("192.168.1.5:8080");
    RequestHead head = none;
    head.cookie = std::string("theme=dark; dotpose-8080=") + kToken + "; other=1";
    EXPECT_EQ(access.judge(head), Verdict::allowed);
    head = none;
    head.authorization = std::string("Bearer ") + kToken;
    EXPECT_EQ(access.judge(head), Verdict::allowed);
    head = none;
    head.token = kToken;
    EXPECT_EQ(access.judge(head), Verdict::allowed_by_url);
    EXPECT_THAT(access.set_cookie(), testing::StartsWith(std::string("dotpose-8080=") + kToken));
    EXPECT_THAT(access.set_cookie(), testing::HasSubstr("HttpOnly"));
}

TEST(Access, RefusesWrongTokens) {
    const Access access({"0.0.0.0", 8080}, kToken, "robot");
    const std::string token = kToken;
    for (const std::string& wrong :
         {std::string(), token.substr(1), token + "0", "1" + token.substr(1),
          token.substr(0, 31) + "0", std::string(32, '\0')}) {
        for (const std::string& name : {std::string("dotpose-8080="), std::string("dotpose-8081="),
                                        std::string("xdotpose-8080="), std::string()}) {
            RequestHead head = get("192.168.1.5:8080");
            head.cookie = name + wrong;
            head.authorization = "Bearer " + wrong;
            head.token = wrong;
            EXPECT_EQ(access.judge(head), Verdict::wrong_token) << name << wrong;
        }
    }
    RequestHead other_port = get("192.168.1.5:8080");
    other_port.cookie = "dotpose-8081=" + token;
    EXPECT_EQ(access.judge(other_port), Verdict::wrong_token);
}

TEST(Token, ComparesWholeTexts) {
    EXPECT_TRUE(equals_in_constant_time("abc", "abc"));
    EXPECT_TRUE(equals_in_constant_time("", ""));
    EXPECT_FALSE(equals_in_constant_time("abc", "abd"));
    EXPECT_FALSE(equals_in_constant_time("abc", "xbc"));
    EXPECT_FALSE(equals_in_constant_time("abc", "abcd"));
}

TEST(Token, MadeTokensDiffer) {
    std::set<std::string> tokens;
    for (int i = 0; i < 100; ++i) {
        const std::string token = make_token();
        EXPECT_THAT(token, testing::MatchesRegex("[0-9a-f]+"));
        EXPECT_EQ(token.size(), 32U);
        tokens.insert(token);
    }
    EXPECT_EQ(tokens.size(), 100U);
}

TEST(Token, IsReadFromTheFirstLineOfAFile) {
    const test::TemporaryDirectory folder;
    const std::string path = (folder.path() / "token").string();
    std::ofstream(path) << kToken << "\r\nnext line\n";
    EXPECT_EQ(read_token(path), kToken);
    EXPECT_THROW(read_token(path + "-missing"), Error);
    EXPECT_THROW(read_token(folder.path().string()), Error);
    for (const std::string& bad :
         {std::string("short"), std::string(300, 'a'), std::string("with spaces in the token"),
          std::string("semicolon;semicolon;")}) {
        std::ofstream(path) << bad;
        EXPECT_THROW(read_token(path), Error) << bad;
    }
}

}  // namespace
}  // namespace dotpose::serve
