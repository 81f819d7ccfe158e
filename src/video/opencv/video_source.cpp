// Reads video files with the FFmpeg libraries. Unlike OpenCV, they provide the timestamp of each
// frame and report damaged frames.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/core.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include "video/opencv/offers.hpp"
#include "video/opencv/release.hpp"

namespace dotpose::video {
namespace {

bool is_key_frame(const AVFrame& picture) {
#ifdef AV_FRAME_FLAG_KEY  // FFmpeg 6.1 or newer
    return (picture.flags & AV_FRAME_FLAG_KEY) != 0;
#else
    return picture.key_frame != 0;
#endif
}

using capture::Frame;
using capture::SourceOptions;

struct ReleaseRead : Release {
    using Release::operator();
    void operator()(AVFormatContext* file) const { avformat_close_input(&file); }
};
template <typename T>
using Owned = std::unique_ptr<T, ReleaseRead>;

template <typename T>
Owned<T> owned(T* pointer) {
    if (pointer == nullptr) throw Error("cannot read videos: out of memory");
    return Owned<T>(pointer);
}

class GreyConverter {
  public:
    void operator()(const AVFrame& picture, GreyImage& image) {
        const int width = picture.width;
        const int height = picture.height;
        converter_.reset(sws_getCachedContext(
            converter_.release(), width, height, static_cast<AVPixelFormat>(picture.format), width,
            height, AV_PIX_FMT_GRAY8, SWS_POINT, nullptr, nullptr, nullptr));
        if (!converter_) throw Error("the video has a pixel format that is not known");
        if (picture.color_range == AVCOL_RANGE_JPEG) {
            const int* colours = sws_getCoefficients(SWS_CS_DEFAULT);
            sws_setColorspaceDetails(converter_.get(), colours, 1, colours, 1, 0, 1 << 16, 1 << 16);
        }
        // The converter requires aligned rows, so the image is allocated by FFmpeg.
        const auto grey = owned(av_frame_alloc());
        grey->format = AV_PIX_FMT_GRAY8;
        grey->width = width;
        grey->height = height;
        if (av_frame_get_buffer(grey.get(), 0) < 0 ||
            sws_scale(converter_.get(), picture.data, picture.linesize, 0, height, grey->data,
                      grey->linesize) != height) {
            throw Error("cannot convert a frame of the video");
        }
        image.width_px = width;
        image.height_px = height;
        image.pixels.clear();
        for (int v = 0; v < height; ++v) {
            const std::uint8_t* row = grey->data[0] + std::ptrdiff_t{v} * grey->linesize[0];
            image.pixels.insert(image.pixels.end(), row, row + width);
        }
    }

  private:
    Owned<SwsContext> converter_;
};

class VideoFile : public capture::FrameSource {
  public:
    VideoFile(const std::string& name, const SourceOptions& options)
        : name_(name),
          options_(options),
          packet_(owned(av_packet_alloc())),
          picture_(owned(av_frame_alloc())) {
        if (!std::filesystem::exists(name)) {
            throw Error("cannot read " + name + ": no such file or camera");
        }
        if (!std::ifstream(name)) {
            throw Error("cannot read " + name + ": " + std::strerror(errno));
        }
        // Failures are reported as Error, so FFmpeg need not print messages.
        av_log_set_level(AV_LOG_QUIET);
        if (!open()) throw Error(name + " is not a video, or its format is not known");
    }

    bool next(Frame& frame) override {
        while (!options_.stop()) {
            const int code = avcodec_receive_frame(decoder_.get(), picture_.get());
            if (code == AVERROR(EAGAIN)) {
                send_packet();
            } else if (code == AVERROR_EOF) {
                check_end();
                return false;
            } else if (code < 0) {
                skip_to_key_frame();
            } else if (take_picture(frame)) {
                return true;
            }
        }
        return false;
    }
    double rate() const override { return options_.fps.value_or(rate_); }
    std::int64_t length() const override { return expected_frames(); }
    double bits_per_px() const override {
        if (!is_lossy_ || packet_px_ == 0) return 0;
        return 8.0 * static_cast<double>(packet_bytes_) / static_cast<double>(packet_px_);
    }

  private:
    bool open() {
        AVFormatContext* file = nullptr;
        // Without the prefix, FFmpeg would interpret the part of a name before a colon as a
        // protocol.
        const std::string url = "file:" + name_;
        if (avformat_open_input(&file, url.c_str(), nullptr, nullptr) < 0) return false;
        file_.reset(file);
        // The index is checked before the call of avformat_find_stream_info, because that function
        // reads packets, which adds entries to the index.
        for (unsigned i = 0; i < file->nb_streams; ++i) {
            const int entries = avformat_index_get_entries_count(file->streams[i]);
            has_index_ = has_index_ || (entries > 0 && entries >= file->streams[i]->nb_frames);
        }
        if (avformat_find_stream_info(file, nullptr) < 0) return false;
        const AVCodec* codec = nullptr;
        const int index = av_find_best_stream(file, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
        if (index < 0) return false;
        stream_ = file->streams[index];
        const AVRational rate = av_guess_frame_rate(file, stream_, nullptr);
        if (rate.num > 0 && rate.den > 0) rate_ = av_q2d(rate);
        decoder_ = owned(avcodec_alloc_context3(codec));
        decoder_->pkt_timebase = stream_->time_base;
        const AVCodecDescriptor* description = avcodec_descriptor_get(decoder_->codec_id);
        is_lossy_ = description != nullptr && (description->props & AV_CODEC_PROP_LOSSY) != 0;
        return avcodec_parameters_to_context(decoder_.get(), stream_->codecpar) >= 0 &&
               avcodec_open2(decoder_.get(), codec, nullptr) >= 0;
    }

    /// Returns the duration of the video stream in seconds, or 0 if it is unknown.
    double duration_s() const {
        if (stream_->duration > 0) {
            return static_cast<double>(stream_->duration) * av_q2d(stream_->time_base);
        }
        // The duration of a file is that of its longest stream, so it is used only if the video is
        // the only stream of the file.
        const bool is_of_video = file_->nb_streams == 1 && file_->duration > 0;
        return is_of_video ? static_cast<double>(file_->duration) / AV_TIME_BASE : 0;
    }
    /// Returns the number of frames according to the file. If the file does not contain this
    /// number, returns an estimate that is computed from the duration.
    std::int64_t expected_frames() const {
        return stream_->nb_frames > 0 ? stream_->nb_frames : std::llround(duration_s() * rate_);
    }
    /// Throws Error if the video is damaged or ends too early.
    void check_end() const {
        const bool is_short = stream_->nb_frames > 0 ? frames_ < stream_->nb_frames
                                                     : time_s_ + 2 / rate_ < duration_s();
        const std::string of =
            expected_frames() > frames_ ? fmt::format(" of {}", expected_frames()) : "";
        const std::string counts = fmt::format("{}{} frames were read", frames_, of);
        if (is_damaged_ || is_short) {
            throw Error(fmt::format(
                "{} is damaged or cut short: {}{}", name_, counts,
                is_counted_ ? "; times after the damage are counted from frame numbers" : ""));
        }
        const bool is_regular = av_cmp_q(stream_->avg_frame_rate, stream_->r_frame_rate) == 0;
        if (is_regular && frames_ < expected_frames()) {
            options_.notify(
                fmt::format("{} has gaps, from damage or from its recording: {}", name_, counts));
        }
    }

    /// Sends the next video packet to the decoder. After the last packet, signals the end of the
    /// stream.
    void send_packet() {
        constexpr int kMaxFailures = 100;
        for (int failures = 0; failures < kMaxFailures;) {
            const int code = av_read_frame(file_.get(), packet_.get());
            if (code == AVERROR_EOF) break;
            if (code < 0) {
                ++failures;
                skip_to_key_frame();
                continue;
            }
            const bool is_video = packet_->stream_index == stream_->index;
            if (is_video) {
                if ((packet_->flags & AV_PKT_FLAG_CORRUPT) != 0) skip_to_key_frame();
                packet_bytes_ += packet_->size;
                correct_time();
                if (avcodec_send_packet(decoder_.get(), packet_.get()) < 0) skip_to_key_frame();
            }
            av_packet_unref(packet_.get());
            if (is_video) return;
        }
        avcodec_send_packet(decoder_.get(), nullptr);
    }

    /// Corrects the timestamp of a packet in an AVI file. AVI files contain no timestamps. FFmpeg
    /// computes timestamps by counting packets, so all timestamps after damaged data are wrong. If
    /// the index of the file is complete, this function takes the timestamp from the index entry at
    /// the packet's position.
    void correct_time() {
        if (std::string_view(file_->iformat->name) != "avi") return;
        int first = 0;
        int last = avformat_index_get_entries_count(stream_);
        while (last - first > 1) {
            const int middle = (first + last) / 2;
            const AVIndexEntry* entry = avformat_index_get_entry(stream_, middle);
            (entry->pos <= packet_->pos ? first : last) = middle;
        }
        const AVIndexEntry* entry = avformat_index_get_entry(stream_, first);
        constexpr int kHeader = 8;
        is_counted_ = is_counted_ || !has_index_ || entry == nullptr || packet_->pos < entry->pos ||
                      packet_->pos > entry->pos + kHeader;
        if (is_counted_) return;
        packet_->dts = entry->timestamp;
        if (packet_->pts != AV_NOPTS_VALUE) packet_->pts = entry->timestamp;
    }

    /// Skips the frames before the next key frame, because they may contain parts of damaged
    /// frames.
    void skip_to_key_frame() {
        is_damaged_ = true;
        waits_for_key_frame_ = true;
    }

    /// Converts the decoded picture to a frame. Returns false if the picture may be partly damaged.
    bool take_picture(Frame& frame) {
        const std::int64_t time = picture_->best_effort_timestamp;
        if (time != AV_NOPTS_VALUE) {
            const double time_s = static_cast<double>(time) * av_q2d(stream_->time_base);
            if (!has_begun_) begin_s_ = time_s;
            time_s_ = time_s - begin_s_;
        } else if (has_begun_) {
            time_s_ += 1 / rate_;
        }
        has_begun_ = true;
        if (picture_->decode_error_flags != 0 || (picture_->flags & AV_FRAME_FLAG_CORRUPT) != 0) {
            skip_to_key_frame();
            return false;
        }
        if (is_key_frame(*picture_)) waits_for_key_frame_ = false;
        if (waits_for_key_frame_) return false;
        to_grey_(*picture_, frame.image);
        packet_px_ += std::int64_t{picture_->width} * picture_->height;
        frame.time_us =
            options_.fps ? capture::time_of(frames_, *options_.fps) : std::llround(time_s_ * 1e6);
        frame.index = frames_++;
        return true;
    }

    std::string name_;
    SourceOptions options_;
    Owned<AVFormatContext> file_;
    AVStream* stream_ = nullptr;  ///< the video stream, owned by `file_`
    Owned<AVCodecContext> decoder_;
    Owned<AVPacket> packet_;
    Owned<AVFrame> picture_;
    GreyConverter to_grey_;
    double rate_ = 30;
    double begin_s_ = 0;  ///< time of the first picture in the file
    double time_s_ = 0;   ///< time of the latest picture, relative to the first picture
    bool is_lossy_ = false;
    std::int64_t packet_bytes_ = 0;  ///< total size of the packets that were decoded
    std::int64_t packet_px_ = 0;     ///< total number of pixels in the returned frames
    bool has_begun_ = false;
    bool is_damaged_ = false;
    bool has_index_ = false;
    bool is_counted_ = false;  ///< true if times are computed from frame numbers
    bool waits_for_key_frame_ = false;
    std::int64_t frames_ = 0;
};

}  // namespace

std::unique_ptr<capture::FrameSource> open_video(const std::string& name,
                                                 const SourceOptions& options) {
    return std::make_unique<VideoFile>(name, options);
}

}  // namespace dotpose::video
