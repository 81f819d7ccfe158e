#include "known_frames.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/core.h>

#include "capture/source_kind.hpp"
#include "dotpose/tools/frame_file.hpp"
#include "live_sources.hpp"
#include "progress.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

namespace fs = std::filesystem;
using capture::SourceKind;

/// Returns true if the last components of `path` equal `end`.
bool ends_with(const fs::path& path, const fs::path& end) {
    const std::vector<fs::path> all(path.begin(), path.end());
    const std::vector<fs::path> last(end.begin(), end.end());
    return last.size() <= all.size() && std::equal(last.rbegin(), last.rend(), all.rbegin());
}

/// Reads the true poses of images from truth files. Each truth file is read only once.
class Poses {
  public:
    Poses(std::string given, std::optional<double> spacing_mm)
        : given_(std::move(given)), spacing_mm_(spacing_mm) {}

    fs::path file_for(const fs::path& folder) const {
        return given_.empty() ? folder / "truth.csv" : system::path_of(given_);
    }

    const std::vector<TruthRow>& rows_for(const fs::path& folder) {
        const fs::path file = file_for(folder);
        const auto known = rows_.find(file);
        if (known != rows_.end()) return known->second;
        if (!fs::exists(file)) {
            throw Error(fmt::format(
                "true poses are needed, and there is no {}: name their file with --poses",
                file.string()));
        }
        return rows_.emplace(file, read_truth(file, spacing_mm_)).first->second;
    }

    TruthRow row_of(const fs::path& image) {
        if (!fs::exists(image)) {
            throw Error("cannot read " + image.string() + ": no such file or folder");
        }
        const fs::path folder = image.parent_path();
        const fs::path path = image.lexically_normal();
        for (const TruthRow& row : rows_for(folder)) {
            if (!ends_with(path, system::path_of(row.file).lexically_normal())) continue;
            TruthRow found = row;
            found.file = image.string();
            return found;
        }
        throw Error(fmt::format("{} has no pose of {}", file_for(folder).string(), image.string()));
    }

  private:
    std::string given_;
    std::optional<double> spacing_mm_;
    std::map<fs::path, std::vector<TruthRow>> rows_;
};

KnownFrames known_images(const std::vector<std::string>& names,
                         const capture::SourceOptions& options, Poses& poses) {
    KnownFrames known;
    for (const std::string& name : names) {
        if (const fs::path folder = system::path_of(name); fs::is_directory(folder)) {
            for (TruthRow row : poses.rows_for(folder)) {
                row.file = (folder / system::path_of(row.file)).string();
                known.rows.push_back(std::move(row));
            }
            continue;
        }
        for (const std::string& image : capture::files_of(name))
            known.rows.push_back(poses.row_of(system::path_of(image)));
    }
    known.readable_frames = [count = known.rows.size()] { return count; };
    known.frame_at = [options, rows = known.rows,
                      read = frames_of_folder("", known.rows)](int index) {
        KnownFrame frame = read(index);
        if (!frame.problem.empty()) return frame;
        try {
            capture::prepare(options, rows[static_cast<std::size_t>(index)].file, frame.image);
        } catch (const BadArgument&) {
            throw;
        } catch (const Error& error) {
            frame.problem = error.what();
        }
        return frame;
    };
    return known;
}

/// Frames from sources that can only be read sequentially. Several threads may request frames at
/// the same time, but each frame can be requested only once. A request reads all frames up to the
/// requested index and buffers the earlier frames until they are requested. Requests should
/// therefore be roughly in order.
class FramesInOrder {
  public:
    /// Opens the first source. Throws Error or BadArgument if the source cannot be opened.
    FramesInOrder(std::vector<std::string> names, capture::SourceOptions options)
        : names_(std::move(names)), list_([this] { return next_name(); }, std::move(options)) {
        list_.open();
    }

    void set_poses(std::vector<TruthRow> rows) { rows_ = std::move(rows); }

    KnownFrame at(int index) {
        const TruthRow& row = rows_[static_cast<std::size_t>(index)];
        KnownFrame frame{{}, row.truth, row.code, {}};
        const std::lock_guard lock(mutex_);
        while (read_ <= index && !is_over_)
            read();
        const auto found = waiting_.find(index);
        if (found == waiting_.end()) {
            frame.problem =
                problem_.empty() ? fmt::format("there is no frame {}", index) : problem_;
            return frame;
        }
        frame.image = std::move(found->second);
        waiting_.erase(found);
        if (frame.image.pixels.empty()) frame.problem = fmt::format("frame {} is empty", index);
        return frame;
    }

    std::size_t readable_frames() {
        const std::lock_guard lock(mutex_);
        const bool is_cut = is_over_ && problem_.empty() && interrupted();
        return is_cut ? static_cast<std::size_t>(read_) : rows_.size();
    }

    void tell_if_more() {
        capture::Frame frame;
        if (is_over_ || interrupted() || !list_.next(frame)) return;
        notify(fmt::format("there are more frames than the {} poses; the others were left out",
                           rows_.size()));
    }

  private:
    std::optional<std::string> next_name() {
        if (next_name_ == names_.size()) return std::nullopt;
        return names_[next_name_++];
    }

    void read() {
        capture::Frame frame;
        try {
            is_over_ = !list_.next(frame);
        } catch (const Error& error) {
            problem_ = error.what();
            is_over_ = true;
        }
        if (is_over_) return;
        read_ = frame.index + 1;
        waiting_[frame.index] = std::move(frame.image);
    }

    std::vector<std::string> names_;
    std::vector<TruthRow> rows_;
    std::size_t next_name_ = 0;
    std::mutex mutex_;
    capture::SourceList list_;
    /// Frames that have been read but not yet requested, by index.
    std::map<std::int64_t, GreyImage> waiting_;
    std::int64_t read_ = 0;  ///< number of frames read so far
    bool is_over_ = false;
    std::string problem_;  ///< reason why reading ended early, or empty
};

}  // namespace

KnownFrames known_frames(const SourceArguments& arguments, const std::string& poses,
                         std::optional<double> spacing_mm) {
    const std::vector<std::string> names = Sources(arguments).all_names();
    Poses known(poses, spacing_mm);
    const bool are_images = std::ranges::all_of(names, [](const std::string& name) {
        const SourceKind kind = capture::kind_of(name);
        return kind == SourceKind::image || kind == SourceKind::images;
    });
    if (are_images) return known_images(names, arguments.options, known);
    capture::SourceOptions options = arguments.options;
    options.stop = interrupted;
    options.notify = notify;
    options.open_live = open_live;
    const auto frames = std::make_shared<FramesInOrder>(names, options);
    KnownFrames result;
    result.rows = known.rows_for(system::path_of(names.front()).parent_path());
    for (std::size_t i = 0; i < result.rows.size(); ++i)
        result.rows[i].file = fmt::format("frame {}", i);
    frames->set_poses(result.rows);
    result.frame_at = [frames](int index) { return frames->at(index); };
    result.readable_frames = [frames] { return frames->readable_frames(); };
    result.finish = [frames] { frames->tell_if_more(); };
    return result;
}

}  // namespace dotpose::cli
