#include "serve/command.hpp"

#include <string>

#include <gtest/gtest.h>

namespace dotpose::serve {
namespace {

TEST(ParseCommand, ReadsNameAndArguments) {
    const auto command =
        parse_command(R"({"do": "move", "robot": "anna <b>", "x_mm": -2.5, "n": 3, "on": true})");
    ASSERT_TRUE(command);
    EXPECT_EQ(command->name, "move");
    ASSERT_NE(command->argument<std::string>("robot"), nullptr);
    EXPECT_EQ(*command->argument<std::string>("robot"), "anna <b>");
    EXPECT_EQ(*command->argument<double>("x_mm"), -2.5);
    EXPECT_EQ(*command->argument<double>("n"), 3);
    EXPECT_TRUE(*command->argument<bool>("on"));
    EXPECT_EQ(command->argument<bool>("robot"), nullptr);
    EXPECT_EQ(command->argument<double>("missing"), nullptr);
}

TEST(ParseCommand, RefusesOtherTexts) {
    for (const char* text :
         {"", "{", "[]", "\"do\"", "{}", R"({"do": 1})", R"({"do": ""})", R"({"topic": "state"})",
          R"({"do": "x", "list": []})", R"({"do": "x", "nested": {"do": "y"}})",
          R"({"do": "x", "nothing": null})", R"({"do": "x"} {"do": "y"})", "{\"do\": \"\xff\"}",
          R"({"do": "x", "n": 1e999})"}) {
        EXPECT_FALSE(parse_command(text)) << text;
    }
}

TEST(ParseCommand, RefusesLongTexts) {
    const std::string head = R"({"do": "x", "text": ")";
    const std::string tail = R"("})";
    const std::string fill(kMaxCommandBytes - head.size() - tail.size(), 'a');
    EXPECT_TRUE(parse_command(head + fill + tail));
    EXPECT_FALSE(parse_command(head + fill + "a" + tail));
}

}  // namespace
}  // namespace dotpose::serve
