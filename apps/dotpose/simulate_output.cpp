#include "simulate_output.hpp"

#include <fstream>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "capture/source_kind.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/image_file.hpp"
#include "live_sources.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

namespace fs = std::filesystem;

/// Removes the frames of an earlier run, because the new file of true poses will not list them.
void remove_old_frames(const fs::path& folder, const fs::path& truth) {
    std::vector<fs::path> frames;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("frame_") && name.ends_with(".pgm")) frames.push_back(entry.path());
    }
    if (frames.empty()) return;
    std::ifstream file(truth);
    std::string header;
    std::getline(file, header);
    if (header + '\n' != kTruthHeader) {
        throw Error(fmt::format(
            "{} has frames that dotpose simulate did not make, such as {}: name another folder",
            folder.string(), frames.front().filename().string()));
    }
    for (const fs::path& frame : frames)
        fs::remove(frame);
    notify(fmt::format("{}: removed {} frames of an earlier run", folder.string(), frames.size()));
}

class FrameFolder : public SimulateOutput {
  public:
    explicit FrameFolder(fs::path folder) : folder_(std::move(folder)) {
        std::error_code failed;
        fs::create_directories(folder_, failed);
        if (fs::exists(folder_) && !fs::is_directory(folder_)) {
            throw Error(folder_.string() + " is a file: name a folder for the frames");
        }
        if (!failed) remove_old_frames(folder_, truth_path());
    }

    fs::path truth_path() const override { return folder_ / "truth.csv"; }
    std::string name(int index) const override { return fmt::format("frame_{:06}.pgm", index); }
    void write(int index, const GreyImage& image) override {
        write_pgm(folder_ / name(index), image.view());
    }
    void finish() override {}

  private:
    fs::path folder_;
};

class FrameVideo : public SimulateOutput {
  public:
    FrameVideo(const std::string& path, double fps)
        : path_(system::path_of(path)), video_(create_video(path, fps)) {}

    fs::path truth_path() const override {
        return path_.parent_path() / path_.stem().concat("-truth.csv");
    }
    std::string name(int index) const override {
        return fmt::format("{}#{}", path_.filename().string(), index);
    }
    void write(int /*index*/, const GreyImage& image) override { video_->write(image.view()); }
    void finish() override { video_->finish(); }

  private:
    fs::path path_;
    std::unique_ptr<video::GreyVideo> video_;
};

}  // namespace

bool is_video_name(const std::string& out) {
    return !fs::is_directory(system::path_of(out)) &&
           capture::kind_of(out) == capture::SourceKind::video;
}

std::unique_ptr<SimulateOutput> open_simulate_output(const std::string& out, double fps) {
    if (is_video_name(out)) return std::make_unique<FrameVideo>(out, fps);
    return std::make_unique<FrameFolder>(system::path_of(out));
}

}  // namespace dotpose::cli
