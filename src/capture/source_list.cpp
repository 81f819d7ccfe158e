#include "capture/source_list.hpp"

#include <utility>

#include <fmt/core.h>

#include "capture/source_kind.hpp"
#include "dotpose/tools/flip.hpp"

namespace dotpose::capture {

SourceList::SourceList(std::function<std::optional<std::string>()> next_name, SourceOptions options)
    : next_name_(std::move(next_name)), options_(std::move(options)) {}

std::optional<std::string> SourceList::take_name() {
    return pending_name_ ? std::exchange(pending_name_, std::nullopt) : next_name_();
}

bool SourceList::open() {
    const auto name = take_name();
    if (!name) return false;
    if (name->empty()) throw BadArgument("the name of the source is empty");
    name_ = *name;
    has_first_ = false;
    images_.clear();
    switch (kind_of(name_)) {
        case SourceKind::raw:
            source_ = open_raw(options_);
            break;
        case SourceKind::image:
        case SourceKind::images:
            images_ = files_of(name_);
            next_image_ = 0;
            source_ = open_images([this] { return next_image(); }, options_);
            break;
        case SourceKind::camera:
        case SourceKind::video:
            for (const std::string& file : files_of(name_))
                options_.before_reading(file);
            source_ = options_.open_live(name_, options_);
            break;
    }
    return true;
}

/// Returns the path of the next image from the image files, folders and globs in the list. Returns
/// an empty optional if the next source is of another kind, or if no sources are left.
std::optional<std::string> SourceList::next_image() {
    while (next_image_ == images_.size()) {
        auto name = take_name();
        if (!name) return std::nullopt;
        const SourceKind kind = kind_of(*name);
        if (kind != SourceKind::image && kind != SourceKind::images) {
            pending_name_ = std::move(name);
            return std::nullopt;
        }
        images_.clear();
        next_image_ = 0;
        images_ = files_of(*name);
    }
    return images_[next_image_++];
}

void SourceList::close() {
    dropped_before_ += source_->dropped();
    source_.reset();
    is_first_source_ = false;
}

bool SourceList::next(Frame& frame) {
    while (!options_.stop()) {
        if (!source_ && !open()) return false;
        frame.file.clear();
        frame.is_live = false;
        bool has_frame = false;
        try {
            has_frame = source_->next(frame);
        } catch (const Error&) {
            close();
            throw;
        }
        if (!has_frame) {
            close();
            continue;
        }
        newest_ = {{}, frame.time_us, frame.index, frame.file, frame.is_live};
        bits_per_px_ = source_->bits_per_px();
        put_in_order(frame);
        if (!frame.image.pixels.empty()) prepare(options_, name_of_frame(), frame.image);
        return true;
    }
    return false;
}

void SourceList::put_in_order(Frame& frame) {
    if (!has_first_) {
        has_first_ = true;
        first_index_ = next_index_;
        offset_us_ = is_first_source_ ? 0 : next_time_us_ - frame.time_us;
    }
    constexpr double kDefaultRate = 30;
    frame.index += first_index_;
    frame.time_us += offset_us_;
    // Times that are shifted to follow the previous source are no longer on the monotonic clock.
    if (offset_us_ != 0) frame.is_live = false;
    next_index_ = frame.index + 1;
    next_time_us_ = frame.time_us + time_of(1, rate() > 0 ? rate() : kDefaultRate);
}

std::int64_t SourceList::dropped() const {
    return dropped_before_ + (source_ ? source_->dropped() : 0);
}

std::string SourceList::name_of_frame() const {
    if (!newest_.file.empty()) return newest_.file;
    return fmt::format("{}#{}", name_, newest_.index);
}

GreyImage cropped(const GreyImage& image, const Region& region) {
    if (region.left < 0 || region.top < 0 || region.width < 1 || region.height < 1 ||
        region.left > image.width_px - region.width ||
        region.top > image.height_px - region.height) {
        throw BadArgument(fmt::format("the region {},{} {}x{} leaves the frame of {}x{} px",
                                      region.left, region.top, region.width, region.height,
                                      image.width_px, image.height_px));
    }
    GreyImage part;
    part.width_px = region.width;
    part.height_px = region.height;
    part.pixels.reserve(static_cast<std::size_t>(region.width) *
                        static_cast<std::size_t>(region.height));
    const ImageView view = image.view();
    for (int v = region.top; v < region.top + region.height; ++v) {
        const std::uint8_t* first = view.row(v) + region.left;
        part.pixels.insert(part.pixels.end(), first, first + region.width);
    }
    return part;
}

void prepare(const SourceOptions& options, const std::string& name, GreyImage& image) {
    if (options.flip) flip(image);
    if (!options.region) return;
    if (const auto& whole = options.whole_size_px;
        whole && *whole != std::pair(image.width_px, image.height_px)) {
        throw Error(fmt::format("{}: the camera file is for images of {} x {} px, not {} x {} px",
                                name, whole->first, whole->second, image.width_px,
                                image.height_px));
    }
    image = cropped(image, *options.region);
}

}  // namespace dotpose::capture
