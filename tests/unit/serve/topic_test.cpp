#include "serve/topic.hpp"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace dotpose::serve {
namespace {

TEST(Topic, KeepsTheNewestValueOnly) {
    Topic topic("state", false);
    EXPECT_EQ(topic.version(), 0U);
    int encoded = 0;
    for (const char* value : {"a", "b", "c"})
        topic.publish([&encoded, value] { return ++encoded, value; });
    EXPECT_EQ(topic.version(), 3U);
    EXPECT_EQ(encoded, 0);
    std::uint64_t version = 0;
    EXPECT_EQ(*topic.message(version), "state\nc");
    EXPECT_EQ(version, 3U);
    // A second client receives the same message.
    EXPECT_EQ(*topic.message(version), "state\nc");
    EXPECT_EQ(encoded, 1);
}

TEST(Topic, MessageStaysValidAfterThePublicationOfTheNext) {
    Topic topic("frame", true);
    topic.publish([] { return "old"; });
    std::uint64_t version = 0;
    const auto old = topic.message(version);
    topic.publish([] { return "new"; });
    EXPECT_EQ(*topic.message(version), "frame\nnew");
    EXPECT_EQ(version, 2U);
    EXPECT_EQ(*old, "frame\nold");
}

TEST(Topic, ValueIsEmptyIfItsEncoderFails) {
    Topic topic("frame", true);
    topic.publish([]() -> std::string { throw std::runtime_error("no memory"); });
    std::uint64_t version = 0;
    EXPECT_EQ(*topic.message(version), "frame\n");
    EXPECT_EQ(version, 1U);
}

TEST(Topic, ValueDependsOnTheRequest) {
    Topic topic("rows", false);
    const auto publish = [&topic](const std::string& value) {
        topic.publish_for_each([value](const Command& request) {
            return value + std::to_string(*request.argument<double>("first"));
        });
    };
    const auto request = [](double first) { return Command{"subscribe", {{"first", first}}}; };
    std::uint64_t version = 0;
    publish("a");
    EXPECT_EQ(*topic.message(version, request(1)), "rows\na" + std::to_string(1.0));
    EXPECT_EQ(*topic.message(version, request(2)), "rows\na" + std::to_string(2.0));
    EXPECT_EQ(version, 1U);
    publish("b");
    EXPECT_EQ(*topic.message(version, request(2)), "rows\nb" + std::to_string(2.0));
    EXPECT_EQ(version, 2U);
    topic.publish_for_each([](const Command&) -> std::string { throw std::runtime_error("no"); });
    EXPECT_EQ(*topic.message(version), "rows\n");
}

TEST(Topic, IsWantedUntilTheNextPublication) {
    Topic topic("state", false);
    EXPECT_FALSE(topic.is_wanted());
    topic.set_ready_clients(2);
    EXPECT_TRUE(topic.is_wanted());
    topic.publish([] { return ""; });
    EXPECT_FALSE(topic.is_wanted());
}

TEST(Subscription, SendsEachValueOnce) {
    Subscription client;
    EXPECT_FALSE(client.is_due(1));
    client.begin();
    EXPECT_FALSE(client.is_due(0));
    EXPECT_TRUE(client.is_ready(0));
    EXPECT_TRUE(client.is_due(1));
    EXPECT_FALSE(client.is_ready(1));
    client.sent(1);
    EXPECT_FALSE(client.is_due(1));
    EXPECT_TRUE(client.is_ready(1));
}

TEST(Subscription, StuckClientReceivesTwoValues) {
    Subscription client;
    client.begin();
    client.sent(1);
    EXPECT_TRUE(client.is_due(2));
    client.sent(2);
    EXPECT_FALSE(client.is_due(3));
    EXPECT_FALSE(client.is_ready(2));
    client.acknowledge();
    EXPECT_TRUE(client.is_due(3));
}

TEST(Subscription, AChangedRequestIsAnsweredWithTheSameValue) {
    Subscription client;
    client.begin();
    client.sent(1);
    client.acknowledge();
    EXPECT_FALSE(client.is_due(1));
    client.begin({"subscribe", {{"first", 2.0}}});
    EXPECT_TRUE(client.is_due(1));
    EXPECT_EQ(*client.request.argument<double>("first"), 2.0);
}

TEST(Subscription, ChangedRequestsDoNotKeepAClientFromNewValues) {
    Subscription client;
    client.begin();
    client.sent(1);
    client.sent(2);
    for (int i = 0; i < 10; ++i) {
        client.begin();
        EXPECT_FALSE(client.is_due(2));
        client.acknowledge();
        // The request has changed, but the client has not acknowledged all messages. It therefore
        // does not receive value 2 again. It receives only a newer value.
        EXPECT_FALSE(client.is_due(2));
        EXPECT_TRUE(client.is_ready(2));
        EXPECT_TRUE(client.is_due(3));
        ++client.unacknowledged;
    }
}

TEST(Subscription, AcknowledgementsDoNotAddUp) {
    Subscription client;
    client.begin();
    for (int i = 0; i < 10; ++i)
        client.acknowledge();
    client.sent(1);
    client.sent(2);
    EXPECT_FALSE(client.is_open());
    client.end();
    EXPECT_FALSE(client.is_due(3));
}

}  // namespace
}  // namespace dotpose::serve
