#include "robot_name.hpp"

#include <cstddef>

#include "command_line.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {

void add_robot_option(Command& command, std::string& robot, const std::string& help) {
    command.add_option("--robot", robot, help)
        ->type_name("NAME")
        ->capture_default_str()
        ->check([](const std::string& name) {
            constexpr std::size_t kMaxBytes = 128;  // `fleet` ignores longer names
            const bool is_bad = name.empty() || name.find_first_of("/+#") != std::string::npos ||
                                name.size() > kMaxBytes || printable(name) != name;
            return is_bad ? "the name of a robot must have 1 to 128 bytes, must not contain / + #, "
                            "and must be printable"
                          : std::string();
        });
}

void add_frame_prefix_option(Command& command, std::string& prefix) {
    command
        .add_option("--frame-prefix", prefix,
                    "Prefix of the names of the robot's frames in ROS, such as anna/, if several "
                    "robots share one tree of transforms")
        ->type_name("PREFIX");
}

}  // namespace dotpose::cli
