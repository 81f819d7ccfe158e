// Deleters for objects of the FFmpeg libraries.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libswscale/swscale.h>
}

namespace dotpose::video {

/// Deleter for FFmpeg objects that are used both for reading and for writing. Derived classes add
/// an overload that closes files.
struct Release {
    void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(SwsContext* converter) const { sws_freeContext(converter); }
};

}  // namespace dotpose::video
