"""Starts the node: ros2 launch dotpose_ros locator.launch.py sheets:=table.json camera:=camera.yaml

If there are several robots, set namespace:=anna frame_prefix:=anna/ with a different name for each.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

# Arguments that must be strings even if they look like numbers.
TEXTS = {"sheets": "", "camera": "", "frame_prefix": ""}
FLAGS = ("reliable", "space")
TOPICS = {"image": "image_raw", "camera_info": "camera_info"}


def generate_launch_description():
    defaults = {"namespace": "", **dict.fromkeys(FLAGS, "false"), **TEXTS, **TOPICS}
    texts = {name: ParameterValue(LaunchConfiguration(name), value_type=str) for name in TEXTS}
    flags = {name: ParameterValue(LaunchConfiguration(name), value_type=bool) for name in FLAGS}
    node = Node(
        package="dotpose_ros",
        executable="locator",
        name="dotpose",
        namespace=LaunchConfiguration("namespace"),
        parameters=[{**texts, **flags}],
        remappings=[(name, LaunchConfiguration(name)) for name in TOPICS],
    )
    arguments = [DeclareLaunchArgument(name, default_value=value) for name, value in defaults.items()]
    return LaunchDescription([*arguments, node])
