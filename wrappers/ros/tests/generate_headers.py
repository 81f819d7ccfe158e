"""Makes the C++ headers of messages, as a build of ROS 2 does, by its generator (Debian's rosidl).

    generate_headers.py DEFINITIONS HEADERS     of DEFINITIONS/PACKAGE/msg/NAME.msg; absolute paths
"""
import json
import sys
from pathlib import Path

from rosidl_adapter.msg import convert_msg_to_idl
from rosidl_generator_cpp import generate_cpp

TEMPLATES = "/usr/share/rosidl_generator_cpp/resource"


def generate(package, headers):
    interfaces = headers / "idl" / package.name
    tuples = []
    for definition in sorted(package.glob("msg/*.msg")):
        convert_msg_to_idl(
            package, package.name, definition.relative_to(package), interfaces / "msg"
        )
        tuples.append(f"{interfaces}:msg/{definition.stem}.idl")
    arguments = headers / f"{package.name}.json"
    arguments.write_text(
        json.dumps(
            {
                "package_name": package.name,
                "idl_tuples": tuples,
                "ros_interface_dependencies": [],
                "output_dir": str(headers / package.name),
                "template_dir": TEMPLATES,
                "target_dependencies": [],
            }
        )
    )
    generate_cpp(str(arguments))


for folder in sorted(Path(sys.argv[1]).iterdir()):
    generate(folder, Path(sys.argv[2]))
