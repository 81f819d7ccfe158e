// Tests the element in isolation, buffer by buffer: memory use, time stamps and state changes.
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gst/check/gstharness.h>
#include <gtest/gtest.h>

#include "drive.hpp"
#include "pipeline.hpp"

namespace dotpose::test {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr const char* kCaps =
    "video/x-raw,format=GRAY8,width=320,height=240,interlace-mode=progressive,framerate=";

class GstreamerElement : public testing::Test {
  protected:
    static void SetUpTestSuite() { start_gstreamer(); }

    /// Returns a new element, which the caller must unreference.
    static GstElement* element(const std::string& properties) {
        GstElement* made = gst_parse_launch(("dotposelocate " + properties).c_str(), nullptr);
        return GST_ELEMENT(gst_object_ref_sink(made));
    }
    void start(const std::string& properties, const std::string& rate = "200/1") {
        stop();
        GstElement* made = element(properties);
        harness_ = gst_harness_new_with_element(made, "sink", "src");
        gst_object_unref(made);
        gst_harness_set_src_caps_str(harness_, (kCaps + rate).c_str());
    }
    void stop() {
        if (harness_ != nullptr) gst_harness_teardown(harness_);
        harness_ = nullptr;
    }
    void TearDown() override { stop(); }

    /// Returns a buffer that contains one frame of the drive.
    GstBuffer* frame(int index, GstClockTime pts) const {
        const GreyImage image = camera_.frame(drive_, index);
        GstBuffer* buffer = gst_buffer_new_memdup(image.pixels.data(), image.pixels.size());
        GST_BUFFER_PTS(buffer) = pts;
        return buffer;
    }
    /// Passes the buffer through the element. Returns the meta of the output buffer.
    nlohmann::json locate(GstBuffer* buffer) {
        GstBuffer* out = gst_harness_push_and_pull(harness_, buffer);
        if (out == nullptr) return "no buffer";
        nlohmann::json meta = meta_of(out);
        gst_buffer_unref(out);
        return meta;
    }

    const Drive drive_;
    const DriveCamera camera_{kWidth, kHeight};
    GstHarness* harness_ = nullptr;
};

TEST_F(GstreamerElement, DoesNotCopyMemory) {
    start("");
    // The memory is shared with another buffer, as after a tee.
    GstBuffer* buffer = frame(0, 0);
    GstMemory* memory = gst_buffer_get_memory(buffer, 0);
    GstBuffer* other = gst_buffer_copy(buffer);
    GstBuffer* out = gst_harness_push_and_pull(harness_, buffer);
    ASSERT_NE(out, nullptr);
    EXPECT_EQ(gst_buffer_peek_memory(out, 0), memory);
    EXPECT_EQ(meta_of(out)["status"], "ok");
    EXPECT_TRUE(meta_of(other).is_null());
    gst_buffer_unref(out);
    gst_buffer_unref(other);
    gst_memory_unref(memory);
}

TEST_F(GstreamerElement, DrawsOnNobodyElsesFrame) {
    start("overlay=true");
    GstBuffer* buffer = frame(0, 0);
    GstBuffer* other = gst_buffer_copy(buffer);
    const std::string before = bytes_of(other);
    GstBuffer* out = gst_harness_push_and_pull(harness_, buffer);
    ASSERT_NE(out, nullptr);
    EXPECT_TRUE(bytes_of(other) == before);
    EXPECT_FALSE(bytes_of(out) == before);
    gst_buffer_unref(out);
    gst_buffer_unref(other);
}

TEST_F(GstreamerElement, FollowsAnewAfterAJumpBack) {
    start("");
    EXPECT_EQ(locate(frame(170, 10 * GST_SECOND))["events"], "fix");
    EXPECT_EQ(locate(frame(171, 10 * GST_SECOND + 5 * GST_MSECOND))["attempt"], "tracked");
    // The time goes backwards, as after a seek. If tracking were not restarted, the tracker would
    // ignore all frames for ten seconds.
    EXPECT_EQ(locate(frame(170, 0))["events"], "fix");
    EXPECT_EQ(locate(frame(171, 5 * GST_MSECOND))["verdict"], "accepted");
    EXPECT_EQ(locate(frame(172, 10 * GST_MSECOND))["frame"], 4);
}

TEST_F(GstreamerElement, WithoutTimesTheRateTellsThem) {
    constexpr int kFrames = 30;
    constexpr int kFirst = 300;  // the robot drives at full speed in this frame
    std::vector<nlohmann::json> stamped;
    start("");
    for (int i = 0; i < kFrames; ++i)
        stamped.push_back(
            locate(frame(kFirst + i, static_cast<GstClockTime>(i) * 5 * GST_MSECOND)));
    EXPECT_GT(std::hypot(stamped.back()["vx_mm_s"].get<double>(),
                         stamped.back()["vy_mm_s"].get<double>()),
              200);
    start("");
    for (int i = 0; i < kFrames; ++i) {
        const nlohmann::json meta = locate(frame(kFirst + i, GST_CLOCK_TIME_NONE));
        EXPECT_EQ(meta["timestamp"], GST_CLOCK_TIME_NONE);
        EXPECT_EQ(meta["vx_mm_s"], stamped[static_cast<std::size_t>(i)]["vx_mm_s"]);
        EXPECT_EQ(meta["turn_deg_s"], stamped[static_cast<std::size_t>(i)]["turn_deg_s"]);
    }
    // Without a frame rate, the time of a frame is its time of arrival.
    start("", "0/1");
    EXPECT_EQ(locate(frame(0, GST_CLOCK_TIME_NONE))["events"], "fix");
    EXPECT_EQ(locate(frame(1, GST_CLOCK_TIME_NONE))["verdict"], "accepted");
}

TEST_F(GstreamerElement, StartsAnewAfterAStop) {
    start("");
    EXPECT_EQ(locate(frame(0, 0))["frame"], 0);
    EXPECT_EQ(locate(frame(1, 5 * GST_MSECOND))["frame"], 1);
    GstElement* stopped = harness_->element;
    ASSERT_EQ(gst_element_set_state(stopped, GST_STATE_NULL), GST_STATE_CHANGE_SUCCESS);
    g_object_set(stopped, "code", 1, nullptr);
    ASSERT_NE(gst_element_set_state(stopped, GST_STATE_PLAYING), GST_STATE_CHANGE_FAILURE);
    gst_harness_set_src_caps_str(harness_, (std::string(kCaps) + "200/1").c_str());
    const nlohmann::json meta = locate(frame(2, 10 * GST_MSECOND));
    EXPECT_EQ(meta["frame"], 0);
    EXPECT_EQ(meta["status"], "ok");
    EXPECT_FALSE(meta.contains("code_p_wrong"));  // absent because the code is given
}

TEST_F(GstreamerElement, TakesFramesOfOtherSizesOnTheWay) {
    start("");
    EXPECT_EQ(locate(frame(0, 0))["status"], "ok");
    gst_harness_set_src_caps_str(harness_,
                                 "video/x-raw,format=GRAY8,width=8,height=8,framerate=200/1");
    GstBuffer* tiny = gst_buffer_new_allocate(nullptr, 64, nullptr);
    gst_buffer_memset(tiny, 0, 200, 64);
    GST_BUFFER_PTS(tiny) = 5 * GST_MSECOND;
    EXPECT_EQ(locate(tiny)["status"], "image_too_small");
    gst_harness_set_src_caps_str(harness_, (std::string(kCaps) + "200/1").c_str());
    EXPECT_EQ(locate(frame(1, 10 * GST_MSECOND))["status"], "ok");
}

TEST_F(GstreamerElement, PropertiesAreAsTheyWereSet) {
    GstElement* made = element(
        "code=libdots sheets=a.json camera=b.yaml spacing-mm=0.4 inverted=true track=false "
        "max-speed-mm-s=7 acceleration-mm-s2=8 lost-after-ms=9 max-p-wrong=1e-6 "
        "post-messages=false attach-meta=false overlay=true");
    const auto text = [made](const char* name) {
        GParamSpec* spec = g_object_class_find_property(G_OBJECT_GET_CLASS(made), name);
        GValue value = G_VALUE_INIT;
        g_value_init(&value, spec->value_type);
        g_object_get_property(G_OBJECT(made), name, &value);
        char* serialized = gst_value_serialize(&value);
        std::string result = serialized;
        g_free(serialized);
        g_value_unset(&value);
        return result;
    };
    EXPECT_EQ(text("code"), "libdots");
    EXPECT_EQ(text("sheets"), "a.json");
    EXPECT_EQ(text("camera"), "b.yaml");
    EXPECT_EQ(text("spacing-mm"), "0.40000000000000002");
    EXPECT_EQ(text("inverted"), "true");
    EXPECT_EQ(text("track"), "false");
    EXPECT_EQ(text("max-speed-mm-s"), "7");
    EXPECT_EQ(text("acceleration-mm-s2"), "8");
    EXPECT_EQ(text("lost-after-ms"), "9");
    // 2^-20
    EXPECT_EQ(text("max-p-wrong"), "9.5367431640625e-07");
    EXPECT_EQ(text("post-messages"), "false");
    EXPECT_EQ(text("attach-meta"), "false");
    EXPECT_EQ(text("overlay"), "true");
    gst_object_unref(made);
}

}  // namespace
}  // namespace dotpose::test
