#include "dotpose/tools/mcap_file.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include "dotpose/files/error.hpp"
#include "mcap/summary.hpp"
#include "system/files.hpp"

namespace dotpose {

using namespace mcap;

namespace {

/// Returns the QoS profiles that rosbag2 stores with a channel, as a YAML list. The policies are
/// written as the numeric values defined by rmw, which all versions of rosbag2 can read. History 1
/// is keep last, reliability 1 is reliable, and liveliness 1 is automatic. Durability 1 is
/// transient local, and durability 2 is volatile.
std::string offered_profiles(const McapQuality& quality) {
    const std::string durability = quality.is_transient_local ? "1" : "2";
    const std::string forever = "\n    sec: 9223372036\n    nsec: 854775807\n";
    return "- history: 1\n  depth: " + std::to_string(quality.depth) +
           "\n  reliability: 1\n  durability: " + durability + "\n  deadline:" + forever +
           "  lifespan:" + forever + "  liveliness: 1\n  liveliness_lease_duration:" + forever +
           "  avoid_ros_namespace_conventions: false";
}

}  // namespace

class McapFile::Writer {
  public:
    Writer(const std::filesystem::path& path, const McapOptions& options)
        : path_(path.string()), options_(options), descriptor_(system::create_descriptor(path)) {
        if (descriptor_ < 0) throw Error("cannot create " + path_ + ": " + std::strerror(errno));
        Bytes start;
        append_magic(start);
        append_record(start, Op::header, [](Members& header) {
            header.put(std::string_view("ros2"));     // the profile
            header.put(std::string_view("dotpose"));  // the library
        });
        write_at_end(std::move(start));
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() {
        if (descriptor_ >= 0) system::close_descriptor(descriptor_);
    }

    McapChannel add_channel(const std::string& topic, const ros::MessageType& type,
                            const McapQuality& quality) {
        const std::uint16_t schema = schema_of(type);
        const auto id = static_cast<std::uint16_t>(contents_.messages.size() + 1);
        contents_.messages[id] = 0;
        Bytes record;
        append_record(record, Op::channel, [&](Members& channel) {
            channel.put(id);
            channel.put(schema);
            channel.put(std::string_view(topic));
            channel.put(std::string_view("cdr"));
            channel.put(std::map<std::string, std::string>{
                {"offered_qos_profiles", offered_profiles(quality)}});
        });
        Members(contents_.channels).put_raw(record);
        Members(chunk_.records()).put_raw(record);
        return McapChannel{id};
    }

    void write(McapChannel channel, std::uint64_t time_ns, std::span<const std::uint8_t> cdr) {
        const auto id = static_cast<std::uint16_t>(channel);
        const std::uint64_t number = contents_.messages.at(id)++;
        chunk_.add_message(id, static_cast<std::uint32_t>(number), time_ns, cdr);
        // Ends the chunk when it contains at least `chunk_bytes`. Also ends the chunk when it
        // covers at least `chunk_ns` and is at least as large as the end of the file. The end of
        // the file is rewritten after each chunk, so smaller chunks would more than double the
        // number of bytes written.
        const bool is_long =
            chunk_.duration_ns() >= static_cast<std::uint64_t>(options_.chunk_ns) &&
            chunk_.size() >= end_bytes_;
        if (is_long || chunk_.size() >= options_.chunk_bytes) write_chunk();
    }

    void finish() {
        if (descriptor_ < 0) return;
        if (!chunk_.is_empty()) write_chunk();
        const bool is_closed = system::close_descriptor(std::exchange(descriptor_, -1));
        if (!is_closed) throw_unwritable();
    }

  private:
    std::uint16_t schema_of(const ros::MessageType& type) {
        const auto known = schemas_.find(type.name);
        if (known != schemas_.end()) return known->second;
        const std::uint16_t id = ++contents_.schema_count;
        Bytes record;
        append_record(record, Op::schema, [&](Members& schema) {
            schema.put(id);
            schema.put(std::string_view(type.name));
            schema.put(std::string_view("ros2msg"));
            schema.put(std::string_view(type.definition));
        });
        Members(contents_.schemas).put_raw(record);
        Members(chunk_.records()).put_raw(record);
        schemas_[type.name] = id;
        return id;
    }

    void write_chunk() {
        Bytes bytes;
        contents_.chunks.push_back(chunk_.append_to(bytes, size_));
        write_at_end(std::move(bytes));
    }

    /// Overwrites the end of the file with `bytes`, followed by a new end, in a single write. The
    /// file never becomes shorter, because the new end contains everything that the old end
    /// contained.
    void write_at_end(Bytes bytes) {
        const std::size_t data_bytes = bytes.size();
        data_.add(bytes);
        append_end(bytes, size_ + data_bytes, contents_, data_);
        if (!system::write_at(descriptor_, bytes.data(), bytes.size(), size_)) throw_unwritable();
        size_ += data_bytes;
        end_bytes_ = bytes.size() - data_bytes;
    }

    [[noreturn]] void throw_unwritable() const {
        throw Error("cannot write " + path_ + ": " + std::strerror(errno));
    }

    std::string path_;
    McapOptions options_;
    int descriptor_;
    Crc32 data_;
    std::uint64_t size_ = 0;  ///< number of bytes before the data end record
    /// Size in bytes of the end of the file, which begins with the data end record.
    std::size_t end_bytes_ = 0;
    Contents contents_;
    std::map<std::string, std::uint16_t> schemas_;  ///< schema IDs by name
    Chunk chunk_;
};

McapFile::McapFile(const std::filesystem::path& path, const McapOptions& options)
    : writer_(std::make_unique<Writer>(path, options)) {}

McapFile::~McapFile() {
    try {
        finish();
    } catch (const Error&) {  // only `finish` reports errors
    }
}

McapChannel McapFile::add_channel(const std::string& topic, const ros::MessageType& type,
                                  const McapQuality& quality) {
    return writer_->add_channel(topic, type, quality);
}

void McapFile::write(McapChannel channel, std::int64_t time_ns, std::span<const std::uint8_t> cdr) {
    writer_->write(channel, static_cast<std::uint64_t>(std::max(time_ns, std::int64_t{0})), cdr);
}

void McapFile::finish() {
    writer_->finish();
}

}  // namespace dotpose
