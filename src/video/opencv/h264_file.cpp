#include "video/opencv/h264_file.hpp"

#include <cstdint>
#include <utility>

#include <fmt/core.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/error.h>
#include <libswscale/swscale.h>
}

#include "video/opencv/release.hpp"

namespace dotpose::video {
namespace {

/// Encoders to try, in this order. Hardware encoders are not used, because FFmpeg lists them even
/// if the hardware is not installed.
constexpr const char* kEncoders[] = {"libx264", "libopenh264"};

const AVCodec* h264_encoder() {
    for (const char* name : kEncoders) {
        if (const AVCodec* found = avcodec_find_encoder_by_name(name)) return found;
    }
    return nullptr;
}

}  // namespace

class H264File::Encoder {
  public:
    Encoder(std::string path, double fps, cv::Size size) : path_(std::move(path)) {
        av_log_set_level(AV_LOG_QUIET);  // failures are reported as Error
        AVFormatContext* file = nullptr;
        avformat_alloc_output_context2(&file, nullptr, nullptr, path_.c_str());
        if (file == nullptr) throw Error("cannot record to " + path_ + "; try a name with .mp4");
        file_.reset(file);
        open_encoder(fps, size);
        stream_ = avformat_new_stream(file, nullptr);
        require(stream_ != nullptr ? 0 : AVERROR(ENOMEM));
        stream_->time_base = encoder_->time_base;
        stream_->avg_frame_rate = encoder_->framerate;
        require(avcodec_parameters_from_context(stream_->codecpar, encoder_.get()));
        require(avio_open(&file->pb, path_.c_str(), AVIO_FLAG_WRITE));
        require(avformat_write_header(file, nullptr));
        packet_.reset(av_packet_alloc());
        picture_.reset(av_frame_alloc());
        picture_->format = encoder_->pix_fmt;
        picture_->width = size.width;
        picture_->height = size.height;
        require(av_frame_get_buffer(picture_.get(), 0));
        converter_.reset(sws_getContext(size.width, size.height, AV_PIX_FMT_BGR24, size.width,
                                        size.height, encoder_->pix_fmt, SWS_BILINEAR, nullptr,
                                        nullptr, nullptr));
        require(converter_ ? 0 : AVERROR(ENOMEM));
    }

    void write(const cv::Mat& picture) {
        require(av_frame_make_writable(picture_.get()));
        const std::uint8_t* const rows[] = {picture.data};
        const int strides[] = {static_cast<int>(picture.step)};
        sws_scale(converter_.get(), rows, strides, 0, picture.rows, picture_->data,
                  picture_->linesize);
        picture_->pts = frames_++;
        encode(picture_.get());
    }

    void finish() {
        if (file_->pb == nullptr) return;
        encode(nullptr);
        require(av_write_trailer(file_.get()));
        require(avio_closep(&file_->pb));
    }

  private:
    struct ReleaseWritten : Release {
        using Release::operator();
        void operator()(AVFormatContext* file) const {
            avio_closep(&file->pb);
            avformat_free_context(file);
        }
    };
    template <typename T>
    using Owned = std::unique_ptr<T, ReleaseWritten>;

    void open_encoder(double fps, cv::Size size) {
        const AVCodec* codec = h264_encoder();
        encoder_.reset(codec != nullptr ? avcodec_alloc_context3(codec) : nullptr);
        require(encoder_ ? 0 : AVERROR_ENCODER_NOT_FOUND);
        encoder_->width = size.width;
        encoder_->height = size.height;
        encoder_->pix_fmt = AV_PIX_FMT_YUV420P;
        constexpr int kMaxDenominator = 100'000;
        encoder_->framerate = av_d2q(fps, kMaxDenominator);
        encoder_->time_base = av_inv_q(encoder_->framerate);
        if ((file_->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
            encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        }
        // Uses a fast preset, because the encoder must not slow down the locator. Compared with the
        // default preset, encoding takes a third of the time, and the files are only slightly
        // larger.
        AVDictionary* options = nullptr;
        av_dict_set(&options, "preset", "veryfast", 0);
        av_dict_set(&options, "crf", "23", 0);
        const int code = avcodec_open2(encoder_.get(), codec, &options);
        av_dict_free(&options);
        require(code);
    }

    /// Encodes a picture and writes the packets that are ready. If `picture` is null, writes all
    /// remaining packets.
    void encode(const AVFrame* picture) {
        require(avcodec_send_frame(encoder_.get(), picture));
        while (true) {
            const int code = avcodec_receive_packet(encoder_.get(), packet_.get());
            if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
            require(code);
            av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
            packet_->stream_index = stream_->index;
            require(av_interleaved_write_frame(file_.get(), packet_.get()));
        }
    }

    /// Throws Error if `code` is an FFmpeg error code. The message contains the reason.
    void require(int code) const {
        if (code >= 0) return;
        char reason[AV_ERROR_MAX_STRING_SIZE] = {};
        av_strerror(code, reason, sizeof(reason));
        throw Error(fmt::format("cannot record to {}: {}", path_, reason));
    }

    std::string path_;
    Owned<AVFormatContext> file_;
    Owned<AVCodecContext> encoder_;
    Owned<AVPacket> packet_;
    Owned<AVFrame> picture_;
    Owned<SwsContext> converter_;
    AVStream* stream_ = nullptr;
    std::int64_t frames_ = 0;
};

bool H264File::is_available() {
    return h264_encoder() != nullptr;
}

H264File::H264File(const std::string& path, double fps, cv::Size size)
    : encoder_(std::make_unique<Encoder>(path, fps, size)) {}

H264File::~H264File() {
    try {
        encoder_->finish();
    } catch (const Error&) {
        // Only `finish` reports errors.
    }
}

void H264File::write(const cv::Mat& picture) {
    encoder_->write(picture);
}

void H264File::finish() {
    encoder_->finish();
}

}  // namespace dotpose::video
