#include "capture/source_kind.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "../../temporary_directory.hpp"

namespace dotpose::capture {
namespace {

TEST(SourceKind, IsToldByTheName) {
    EXPECT_EQ(kind_of("-"), SourceKind::raw);
    for (const char* camera : {"0", "12", "/dev/video3", "http://10.0.0.1/stream", "rtsp://a/b"})
        EXPECT_EQ(kind_of(camera), SourceKind::camera) << camera;
    for (const char* video : {"a.mp4", "b/A.MKV", "c.d.Mov"})
        EXPECT_EQ(kind_of(video), SourceKind::video) << video;
    for (const char* image : {"a.png", "B.JPG", "frame", "mp4", "", "./0"})
        EXPECT_EQ(kind_of(image), SourceKind::image) << image;
    EXPECT_EQ(kind_of("a*.png"), SourceKind::images);
}

TEST(SourceKind, IsToldByWhatThereIs) {
    const test::TemporaryDirectory root;
    const auto path = [&](const char* name) { return (root.path() / name).string(); };
    const auto put = [&](const char* name, const std::string& text) {
        std::ofstream(path(name), std::ios::binary) << text;
        return path(name);
    };
    std::filesystem::create_directory(path("folder.mp4"));
    EXPECT_EQ(kind_of(path("folder.mp4")), SourceKind::images);
    EXPECT_EQ(kind_of(path("a[1].png")), SourceKind::images);
    EXPECT_EQ(kind_of(put("a[1].png", "x")), SourceKind::image);
    const std::string brand = std::string(3, '\0') + " ftyp";
    EXPECT_EQ(kind_of(put("one", brand + "isom....")), SourceKind::video);
    EXPECT_EQ(kind_of(put("two", brand + "heic....")), SourceKind::image);
    EXPECT_EQ(kind_of(put("three", "\x1a\x45\xdf\xa3........")), SourceKind::video);
    EXPECT_EQ(kind_of(put("four", "RIFF....AVI ")), SourceKind::video);
    EXPECT_EQ(kind_of(put("five", "RIFF....WAVE")), SourceKind::image);
    EXPECT_EQ(kind_of(put("six", "ftyp")), SourceKind::image);
}

}  // namespace
}  // namespace dotpose::capture
