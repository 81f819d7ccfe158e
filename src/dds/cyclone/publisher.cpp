#include "dds/publisher.hpp"

#include <array>
#include <cstdlib>

#include <dds/dds.h>

#include "dds/cyclone/idl_messages.hpp"
#include "dotpose/files/error.hpp"

namespace dotpose::dds {
namespace {

dds_entity_t require(dds_entity_t entity, const std::string& what) {
    if (entity < 0) throw Error("cannot set up " + what + " over DDS: " + dds_strretcode(-entity));
    return entity;
}

/// Maximum number of messages that a reliable topic stores until all readers have received them.
constexpr int kDepth = 100;

/// Quality-of-service settings of a topic. Topics have the same settings as in ROS.
struct Quality {
    bool is_reliable = true;
    bool is_kept = false;  ///< true if messages are kept for readers that connect later
    int depth = kDepth;
};

/// Maximum time that a reliable message waits for space in the queue. The time is short, because
/// waiting delays the next frame.
constexpr dds_duration_t kMaxWait_ns = DDS_MSECS(10);

/// Maximum time to wait for slow readers. DDS uses the same time limit to drop readers that exited
/// without disconnecting.
constexpr dds_duration_t kPatience_ns = DDS_SECS(10);

/// Creates a domain that is limited to this computer, with the settings of rmw_cyclonedds. The
/// settings in CYCLONEDDS_URI are appended and can override them.
dds_entity_t local_domain(int number) {
    std::string settings =
        "<General><AllowMulticast>false</AllowMulticast></General>"
        "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
        "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
        "<Peers><Peer address=\"localhost\"/></Peers></Discovery>";
    const char* own = std::getenv("CYCLONEDDS_URI");
    if (own != nullptr && *own != '\0') settings += std::string(",") + own;
    return require(dds_create_domain(static_cast<dds_domainid_t>(number), settings.c_str()),
                   "domain " + std::to_string(number));
}

dds_entity_t writer_of(dds_entity_t participant, const dds_topic_descriptor_t& type,
                       const std::string& topic, const std::string& type_hash,
                       const Quality& quality) {
    const dds_entity_t entity = require(
        dds_create_topic(participant, &type, topic.c_str(), nullptr, nullptr), "topic " + topic);
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(
        qos, quality.is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
        kMaxWait_ns);
    dds_qset_durability(qos,
                        quality.is_kept ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, quality.depth);
    // ROS 2 nodes since Iron warn about topics without a type hash.
    const std::string user_data = "typehash=" + type_hash + ';';
    dds_qset_userdata(qos, user_data.data(), user_data.size());
    // ROS 2 readers up to Humble require plain CDR.
    const std::array<dds_data_representation_id_t, 1> plain = {DDS_DATA_REPRESENTATION_XCDR1};
    dds_qset_data_representation(qos, plain.size(), plain.data());
    const dds_entity_t writer = dds_create_writer(participant, entity, qos, nullptr);
    dds_delete_qos(qos);
    return require(writer, "topic " + topic);
}

}  // namespace

class Publisher::Writers {
  public:
    Writers(const std::string& robot, const PublisherOptions& options)
        : domain_(options.is_local ? local_domain(options.domain) : 0) {
        const Quality sensor = {options.is_reliable, false, options.is_reliable ? kDepth : 5};
        // ROS adds the prefix "rt" to its topics.
        const std::string prefix = "rt/" + robot;
        try {
            participant_ =
                require(dds_create_participant(static_cast<dds_domainid_t>(options.domain), nullptr,
                                               nullptr),
                        "domain " + std::to_string(options.domain));
            pose_ = writer_of(participant_, geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc,
                              prefix + "/pose", ros::type_of(ros::PoseWithCovarianceStamped{}).hash,
                              sensor);
            if (options.has_space_pose) {
                camera_ =
                    writer_of(participant_, geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc,
                              prefix + "/camera_pose",
                              ros::type_of(ros::PoseWithCovarianceStamped{}).hash, sensor);
                camera_odometry_ =
                    writer_of(participant_, nav_msgs_msg_dds__Odometry__desc,
                              prefix + "/camera_odom", ros::type_of(ros::Odometry{}).hash, sensor);
            }
            odometry_ = writer_of(participant_, nav_msgs_msg_dds__Odometry__desc, prefix + "/odom",
                                  ros::type_of(ros::Odometry{}).hash, sensor);
            status_ = writer_of(participant_, diagnostic_msgs_msg_dds__DiagnosticArray__desc,
                                prefix + "/status", ros::type_of(ros::DiagnosticArray{}).hash, {});
            const std::string& transforms = ros::type_of(ros::TFMessage{}).hash;
            tf_ =
                writer_of(participant_, tf2_msgs_msg_dds__TFMessage__desc, "rt/tf", transforms, {});
            tf_static_ = writer_of(participant_, tf2_msgs_msg_dds__TFMessage__desc, "rt/tf_static",
                                   transforms, {true, true, 1});
        } catch (...) {
            close();
            throw;
        }
    }
    Writers(const Writers&) = delete;
    Writers& operator=(const Writers&) = delete;
    ~Writers() {
        wait_for_readers(DDS_SECS(1));
        close();
    }

    void write(const ros::RobotMessages& messages) {
        if (messages.pose) write(pose_, *messages.pose);
        if (messages.camera && camera_ > 0) write(camera_, *messages.camera);
        if (messages.odometry) write(odometry_, *messages.odometry);
        if (messages.camera_odometry && camera_odometry_ > 0)
            write(camera_odometry_, *messages.camera_odometry);
        if (messages.tf) write(*messages.tf);
        write(messages.status);
        ++unconfirmed_frames_;
    }

    /// Every kDepth / 2 frames, waits until all reliable readers have received all messages.
    /// Without this wait, newer messages would replace older messages that a slow reader has not
    /// received yet. Counts messages that are not received in time as dropped.
    void keep_pace() {
        if (unconfirmed_frames_ < kDepth / 2) return;
        if (!wait_for_readers(kPatience_ns)) dropped_ += sent_ - confirmed_;
        confirmed_ = sent_;
        unconfirmed_frames_ = 0;
    }

    void write(dds_entity_t writer, const ros::PoseWithCovarianceStamped& message) {
        const geometry_msgs_msg_dds__PoseWithCovarianceStamped_ sample = {idl(message.header),
                                                                          idl(message.pose)};
        write(writer, &sample);
    }
    void write(dds_entity_t writer, const ros::Odometry& message) {
        const nav_msgs_msg_dds__Odometry_ sample = {idl(message.header),
                                                    idl(message.child_frame_id), idl(message.pose),
                                                    idl(message.twist)};
        write(writer, &sample);
    }
    void write(const ros::TFMessage& message) { write_transforms(tf_, message); }
    void write_static(const ros::TFMessage& message) { write_transforms(tf_static_, message); }
    void write(const ros::DiagnosticArray& message) {
        using Values = dds_sequence_diagnostic_msgs_msg_dds__KeyValue_;
        using States = dds_sequence_diagnostic_msgs_msg_dds__DiagnosticStatus_;
        std::vector<std::vector<diagnostic_msgs_msg_dds__KeyValue_>> values;
        // `values` must not be reallocated, because the states point into it.
        values.reserve(message.status.size());
        std::vector<diagnostic_msgs_msg_dds__DiagnosticStatus_> states;
        for (const ros::DiagnosticStatus& status : message.status) {
            auto& pairs = values.emplace_back();
            for (const ros::KeyValue& pair : status.values)
                pairs.push_back(idl(pair));
            states.push_back({status.level, idl(status.name), idl(status.message),
                              idl(status.hardware_id), sequence_in<Values>(pairs)});
        }
        const diagnostic_msgs_msg_dds__DiagnosticArray_ sample = {idl(message.header),
                                                                  sequence_in<States>(states)};
        write(status_, &sample);
    }

    std::int64_t sent() const { return sent_; }
    std::int64_t dropped() const { return dropped_; }

  private:
    void close() {
        if (participant_ > 0) dds_delete(participant_);
        if (domain_ > 0) dds_delete(domain_);
    }
    /// Waits until all reliable readers have received all messages. Returns false on timeout. After
    /// the first timeout, checks the remaining writers without waiting, because all writers have
    /// the same readers.
    bool wait_for_readers(dds_duration_t max_wait_ns) {
        bool have_all = true;
        for (const dds_entity_t writer :
             {pose_, camera_, odometry_, camera_odometry_, status_, tf_}) {
            if (writer == 0) continue;
            const dds_duration_t patience_ns = have_all ? max_wait_ns : 0;
            have_all = dds_wait_for_acks(writer, patience_ns) == DDS_RETCODE_OK && have_all;
        }
        return have_all;
    }
    void write_transforms(dds_entity_t writer, const ros::TFMessage& message) {
        using Transforms = dds_sequence_geometry_msgs_msg_dds__TransformStamped_;
        std::vector<geometry_msgs_msg_dds__TransformStamped_> transforms;
        for (const ros::TransformStamped& transform : message.transforms)
            transforms.push_back(idl(transform));
        const tf2_msgs_msg_dds__TFMessage_ sample = {sequence_in<Transforms>(transforms)};
        write(writer, &sample);
    }
    void write(dds_entity_t writer, const void* sample) {
        dds_write(writer, sample) == DDS_RETCODE_OK ? ++sent_ : ++dropped_;
    }

    dds_entity_t domain_;  ///< 0 if DDS creates the domain from the environment settings
    dds_entity_t participant_ = 0;
    dds_entity_t pose_ = 0;
    dds_entity_t camera_ = 0;  ///< 0 if poses in space are not published
    dds_entity_t odometry_ = 0;
    dds_entity_t camera_odometry_ = 0;  ///< 0 if poses in space are not published
    dds_entity_t status_ = 0;
    dds_entity_t tf_ = 0;
    dds_entity_t tf_static_ = 0;
    std::int64_t sent_ = 0;
    std::int64_t dropped_ = 0;
    std::int64_t confirmed_ = 0;  ///< number of messages that were received or counted as dropped
    int unconfirmed_frames_ = 0;
};

Publisher::Publisher(const std::string& robot, const PublisherOptions& options)
    : writers_(std::make_unique<Writers>(robot, options)) {}

Publisher::~Publisher() = default;

void Publisher::publish(const ros::RobotMessages& messages, bool waits) {
    writers_->write(messages);
    if (waits) writers_->keep_pace();
}

void Publisher::publish(const ros::TransformStamped& mount) {
    writers_->write_static({{mount}});
}

std::int64_t Publisher::sent() const {
    return writers_->sent();
}

std::int64_t Publisher::dropped() const {
    return writers_->dropped();
}

}  // namespace dotpose::dds
