"""Starts the node: ros2 launch dotpose_ros locator.launch.py sheets:=table.json camera:=camera.yaml"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    names = {"sheets": "", "camera": "", "image": "image_raw", "camera_info": "camera_info"}
    arguments = [DeclareLaunchArgument(name, default_value=value) for name, value in names.items()]
    node = Node(
        package="dotpose_ros",
        executable="locator",
        name="dotpose",
        parameters=[{name: LaunchConfiguration(name) for name in ("sheets", "camera")}],
        remappings=[(name, LaunchConfiguration(source)) for name, source in
                    (("image", "image"), ("camera_info", "camera_info"))],
    )
    return LaunchDescription([*arguments, node])
