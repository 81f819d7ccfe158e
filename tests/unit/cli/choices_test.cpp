#include "choices.hpp"

#include <string>

#include <gmock/gmock.h>

namespace dotpose::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Options {
    Options() {
        app.add_option("--code", code)->check(one_of({"anoto", "libdots"}));
        app.add_option("--name", name)->check([](const std::string&) { return ""; });
        app.add_flag("--json", is_json);
    }

    std::string parse_code(const std::string& value) {
        try {
            app.parse({value, "--code"});
        } catch (const UsageError& error) {
            return error.what();
        }
        return {};
    }

    Command app;
    std::string code, name;
    bool is_json = false;
};

TEST(Choices, AcceptsTheNames) {
    Options options;
    for (const std::string accepted : {"anoto", "libdots"}) {
        EXPECT_EQ(options.parse_code(accepted), "");
        EXPECT_EQ(options.code, accepted);
    }
}

TEST(Choices, RefusesOthersAndTellsTheNearest) {
    Options options;
    EXPECT_EQ(options.parse_code("libdot"),
              "--code: 'libdot' is not anoto or libdots; did you mean 'libdots'?");
    EXPECT_EQ(options.parse_code("banana"), "--code: 'banana' is not anoto or libdots");
}

TEST(Choices, AreKnownOfTheOption) {
    Options options;
    EXPECT_THAT(options.app.get_option("--code")->choices(), ElementsAre("anoto", "libdots"));
    EXPECT_THAT(options.app.get_option("--name")->choices(), IsEmpty());
    EXPECT_THAT(options.app.get_option("--json")->choices(), IsEmpty());
}

TEST(Choices, AsAList) {
    EXPECT_EQ(alternatives({}), "");
    EXPECT_EQ(alternatives({"a"}), "a");
    EXPECT_EQ(alternatives({"a", "b"}), "a or b");
    EXPECT_EQ(alternatives({"a", "b", "c"}), "a, b or c");
}

}  // namespace
}  // namespace dotpose::cli
