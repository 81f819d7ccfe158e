// Reads contiguous raw 8-bit grey frames from standard input.
#include <chrono>
#include <cmath>
#include <optional>
#include <system_error>

#include <fmt/core.h>

#include "capture/frame_source.hpp"
#include "system/process.hpp"

namespace dotpose::capture {
namespace {

class RawSource : public FrameSource {
  public:
    explicit RawSource(const SourceOptions& options) : options_(options) {
        if (options.width_px < 1 || options.height_px < 1) {
            throw BadArgument("raw frames need their size: --size WxH");
        }
    }

    bool next(Frame& frame) override {
        frame.image.width_px = options_.width_px;
        frame.image.height_px = options_.height_px;
        frame.image.pixels.resize(static_cast<std::size_t>(options_.width_px) *
                                  static_cast<std::size_t>(options_.height_px));
        if (!fill(frame.image.pixels)) return false;
        using namespace std::chrono;
        frame.time_us =
            options_.fps
                ? time_of(frames_, *options_.fps)
                : duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
        frame.is_live = !options_.fps;
        frame.index = frames_++;
        return true;
    }
    double rate() const override { return options_.fps.value_or(0); }

  private:
    /// Reads one frame. Returns false if the input ends before the first byte of the frame, or when
    /// `SourceOptions::stop` returns true.
    bool fill(std::vector<std::uint8_t>& pixels) {
        std::size_t filled = 0;
        while (filled < pixels.size()) {
            if (options_.stop()) return false;
            const auto size = read_input(pixels.data() + filled, pixels.size() - filled);
            if (!size) continue;
            if (*size == 0 && filled == 0) return false;
            if (*size == 0) {
                throw Error(fmt::format("standard input ended inside frame {}: {} of {} bytes",
                                        frames_, filled, pixels.size()));
            }
            filled += *size;
        }
        return true;
    }

    static std::optional<std::size_t> read_input(std::uint8_t* data, std::size_t max_bytes) {
        constexpr int kStandardInput = 0;
        try {
            return system::read_available(kStandardInput, data, max_bytes);
        } catch (const std::system_error& error) {
            throw Error("cannot read standard input: " + error.code().message());
        }
    }

    SourceOptions options_;
    std::int64_t frames_ = 0;
};

}  // namespace

std::int64_t time_of(std::int64_t index, double fps) {
    return std::llround(static_cast<double>(index) * 1e6 / fps);
}

std::unique_ptr<FrameSource> open_raw(const SourceOptions& options) {
    return std::make_unique<RawSource>(options);
}

}  // namespace dotpose::capture
