// Publisher for builds without DDS. The constructor throws BadArgument.
#include "dds/publisher.hpp"
#include "dotpose/files/error.hpp"

namespace dotpose::dds {

class Publisher::Writers {};

Publisher::Publisher(const std::string&, const PublisherOptions&) {
    throw BadArgument(
        "--dds: this dotpose was built without DDS; install cyclonedds-dev and cyclonedds-tools, "
        "and build it again");
}

Publisher::~Publisher() = default;

void Publisher::publish(const ros::RobotMessages&, bool) {}

void Publisher::publish(const ros::TransformStamped&) {}

std::int64_t Publisher::sent() const {
    return 0;
}

std::int64_t Publisher::dropped() const {
    return 0;
}

}  // namespace dotpose::dds
