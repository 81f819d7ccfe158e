#include "dds/publisher.hpp"

#include <array>

#include <dds/dds.h>

#include "dds/cyclone/idl_messages.hpp"
#include "dotpose/files/error.hpp"

namespace dotpose::dds {
namespace {

dds_entity_t require(dds_entity_t entity, const std::string& what) {
    if (entity < 0) throw Error("cannot set up " + what + " over DDS: " + dds_strretcode(-entity));
    return entity;
}

/// How a topic is sent; the values that ROS uses.
struct Quality {
    bool is_reliable = true;
    bool is_kept = false;  ///< for readers that come later
    int depth = 100;       ///< messages that are kept until all readers have them
};

/// How long a reliable message may wait for room, which delays the frame.
constexpr dds_duration_t kMostWait_ns = DDS_MSECS(10);

dds_entity_t writer_of(dds_entity_t participant, const dds_topic_descriptor_t& type,
                       const std::string& topic, const Quality& quality) {
    const dds_entity_t entity = require(
        dds_create_topic(participant, &type, topic.c_str(), nullptr, nullptr), "topic " + topic);
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(
        qos, quality.is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
        kMostWait_ns);
    dds_qset_durability(qos,
                        quality.is_kept ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, quality.depth);
    // ROS 2 up to Humble looks at the representation that old readers have: plain CDR.
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
        : participant_(require(
              dds_create_participant(static_cast<dds_domainid_t>(options.domain), nullptr, nullptr),
              "domain " + std::to_string(options.domain))) {
        const Quality sensor = {options.is_reliable, false, options.is_reliable ? 100 : 5};
        // ROS puts "rt" before the names of its topics.
        const std::string prefix = "rt/" + robot;
        try {
            pose_ = writer_of(participant_, geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc,
                              prefix + "/pose", sensor);
            odometry_ =
                writer_of(participant_, nav_msgs_msg_dds__Odometry__desc, prefix + "/odom", sensor);
            status_ = writer_of(participant_, diagnostic_msgs_msg_dds__DiagnosticArray__desc,
                                prefix + "/status", Quality{});
            tf_ = writer_of(participant_, tf2_msgs_msg_dds__TFMessage__desc, "rt/tf", Quality{});
            tf_static_ = writer_of(participant_, tf2_msgs_msg_dds__TFMessage__desc, "rt/tf_static",
                                   {true, true, 1});
        } catch (...) {
            dds_delete(participant_);
            throw;
        }
    }
    Writers(const Writers&) = delete;
    Writers& operator=(const Writers&) = delete;
    ~Writers() {
        for (const dds_entity_t writer : {pose_, odometry_, status_, tf_})
            dds_wait_for_acks(writer, DDS_SECS(1));
        dds_delete(participant_);
    }

    void write(const ros::PoseWithCovarianceStamped& message) {
        const geometry_msgs_msg_dds__PoseWithCovarianceStamped_ sample = {idl(message.header),
                                                                          idl(message.pose)};
        write(pose_, &sample);
    }
    void write(const ros::Odometry& message) {
        const nav_msgs_msg_dds__Odometry_ sample = {idl(message.header),
                                                    idl(message.child_frame_id), idl(message.pose),
                                                    idl(message.twist)};
        write(odometry_, &sample);
    }
    void write(const ros::TFMessage& message) { write_transforms(tf_, message); }
    void write_static(const ros::TFMessage& message) { write_transforms(tf_static_, message); }
    void write(const ros::DiagnosticArray& message) {
        using Values = dds_sequence_diagnostic_msgs_msg_dds__KeyValue_;
        using States = dds_sequence_diagnostic_msgs_msg_dds__DiagnosticStatus_;
        std::vector<std::vector<diagnostic_msgs_msg_dds__KeyValue_>> values;
        values.reserve(message.status.size());  // the states point into them
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

    dds_entity_t participant_;
    dds_entity_t pose_ = 0;
    dds_entity_t odometry_ = 0;
    dds_entity_t status_ = 0;
    dds_entity_t tf_ = 0;
    dds_entity_t tf_static_ = 0;
    std::int64_t sent_ = 0;
    std::int64_t dropped_ = 0;
};

Publisher::Publisher(const std::string& robot, const PublisherOptions& options)
    : writers_(std::make_unique<Writers>(robot, options)) {}

Publisher::~Publisher() = default;

void Publisher::publish(const ros::RobotMessages& messages) {
    if (messages.pose) writers_->write(*messages.pose);
    if (messages.odometry) writers_->write(*messages.odometry);
    if (messages.tf) writers_->write(*messages.tf);
    writers_->write(messages.status);
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
