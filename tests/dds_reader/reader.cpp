// Reads topics with eProsima Fast DDS, as a ROS 2 node with this middleware does. dotpose publishes
// with Cyclone DDS, so this program tests that the two implementations work together. Prints each
// sample as a line: topic, ROS type, and the received bytes in hexadecimal.
//
//   dotpose_dds_reader best-effort|reliable NAME TOPIC TYPE [TOPIC TYPE]...
//
// TOPIC is a ROS topic, and TYPE is its type, such as nav_msgs/Odometry. The program creates the
// file NAME when all topics have writers. It ends when all writers are gone, or after five minutes.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastrtps/utils/IPLocator.h>

namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

/// Type support that stores the received bytes of each sample without decoding them.
class RawType : public TopicDataType {
  public:
    explicit RawType(const std::string& name) {
        setName(name.c_str());
        m_typeSize = 1 << 16;
        m_isGetKeyDefined = false;
    }
    bool serialize(void*, SerializedPayload_t*) override { return false; }
    bool deserialize(SerializedPayload_t* payload, void* data) override {
        static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
        return true;
    }
    std::function<uint32_t()> getSerializedSizeProvider(void*) override {
        return [] { return 0U; };
    }
    void* createData() override { return new Bytes; }
    void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
    bool getKey(void*, InstanceHandle_t*, bool) override { return false; }

    using Bytes = std::vector<unsigned char>;
};

std::string dds_name(const std::string& type) {
    const std::size_t slash = type.find('/');
    return type.substr(0, slash) + "::msg::dds_::" + type.substr(slash + 1) + '_';
}

std::mutex output;

class Printer : public DataReaderListener {
  public:
    Printer(std::string topic, std::string type)
        : topic_(std::move(topic)), type_(std::move(type)) {}

    void on_data_available(DataReader* reader) override {
        RawType::Bytes bytes;
        SampleInfo info;
        while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
            if (!info.valid_data) continue;
            const std::lock_guard lock(output);
            std::printf("%s %s ", topic_.c_str(), type_.c_str());
            for (const unsigned char byte : bytes)
                std::printf("%02x", byte);
            std::printf("\n");
        }
    }
    void on_subscription_matched(DataReader*, const SubscriptionMatchedStatus& status) override {
        if (status.current_count > 0) came_ = true;
        if (status.current_count == 0 && came_) has_gone_ = true;
    }
    void on_requested_incompatible_qos(DataReader*,
                                       const RequestedIncompatibleQosStatus& status) override {
        std::fprintf(stderr, "%s: incompatible quality of service %u\n", topic_.c_str(),
                     status.last_policy_id);
    }
    bool has_come() const { return came_; }
    bool has_gone() const { return has_gone_; }

  private:
    std::string topic_;
    std::string type_;
    std::atomic<bool> came_ = false;
    std::atomic<bool> has_gone_ = false;
};

/// If ROS_AUTOMATIC_DISCOVERY_RANGE is set to any value, searches for participants as ROS nodes do
/// if the value is LOCALHOST: without multicast, and only at the ports of this computer.
DomainParticipantQos participant_quality() {
    DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
    if (std::getenv("ROS_AUTOMATIC_DISCOVERY_RANGE") == nullptr) return qos;
    constexpr uint32_t kFirstPort = 7410;  // first port of domain 0
    constexpr uint32_t kParticipants = 8;
    auto& discovery = qos.wire_protocol().builtin;
    for (uint32_t i = 0; i < kParticipants; ++i) {
        eprosima::fastrtps::rtps::Locator_t locator;
        eprosima::fastrtps::rtps::IPLocator::setIPv4(locator, 127, 0, 0, 1);
        locator.port = kFirstPort + 2 * i;
        if (i == 0) discovery.metatrafficUnicastLocatorList.push_back(locator);
        discovery.initialPeersList.push_back(locator);
    }
    return qos;
}

/// Listener that prints the name of each ROS topic with a writer whose user data contain no type
/// hash.
class HashCheck : public DomainParticipantListener {
  public:
    void on_publisher_discovery(DomainParticipant*,
                                eprosima::fastrtps::rtps::WriterDiscoveryInfo&& writer) override {
        const auto& data = writer.info.m_qos.m_userData.data_vec();
        const std::string text(data.begin(), data.end());
        const std::string topic = writer.info.topicName().to_string();
        if (topic.rfind("rt/", 0) == 0 && text.rfind("typehash=RIHS01_", 0) != 0)
            std::fprintf(stderr, "%s: no type hash\n", topic.c_str());
    }
};

DataReaderQos quality(const std::string& topic, bool is_reliable) {
    DataReaderQos qos;
    const bool is_transform = topic == "/tf" || topic == "/tf_static";
    qos.reliability().kind =
        is_reliable || is_transform ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind =
        topic == "/tf_static" ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
    qos.history().kind = KEEP_ALL_HISTORY_QOS;
    return qos;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 5) return 2;
    const bool is_reliable = std::string(argv[1]) == "reliable";
    HashCheck hash_check;
    DomainParticipant* participant = DomainParticipantFactory::get_instance()->create_participant(
        0, participant_quality(), &hash_check, StatusMask::none());
    if (participant == nullptr) return 1;
    Subscriber* subscriber = participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
    std::vector<std::unique_ptr<Printer>> printers;
    for (int i = 3; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        TypeSupport type(new RawType(dds_name(argv[i + 1])));
        type.register_type(participant);
        Topic* topic =
            participant->create_topic("rt" + name, type.get_type_name(), TOPIC_QOS_DEFAULT);
        printers.push_back(std::make_unique<Printer>(name, argv[i + 1]));
        if (topic == nullptr || subscriber->create_datareader(topic, quality(name, is_reliable),
                                                              printers.back().get()) == nullptr) {
            return 1;
        }
    }
    const auto wait_until_all = [&printers](bool (Printer::*have)() const) {
        for (int tenths = 0; tenths < 1500; ++tenths) {
            bool have_all = true;
            for (const auto& printer : printers)
                have_all = have_all && (printer.get()->*have)();
            if (have_all) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
    };
    wait_until_all(&Printer::has_come);
    std::ofstream(argv[2]) << "ready\n";
    wait_until_all(&Printer::has_gone);
    participant->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant);
}
