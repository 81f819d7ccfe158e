#!/usr/bin/python3
"""Prints the pose of the camera from the messages and from the frames of a pipeline.

    read_poses.py 'v4l2src ! videoconvert'
"""
import sys

import gi

gi.require_version("Gst", "1.0")
from gi.repository import Gst  # noqa: E402


def say(line):
    """Writes a line with a single call, because frames and messages arrive in different threads."""
    sys.stdout.write(line + "\n")


def print_frame(pad, info):
    """Prints the metadata of a frame that passes through the pad."""
    frame = info.get_buffer()
    meta = frame.get_custom_meta("dotpose")
    if meta:
        pose = meta.get_structure()
        say(f"frame {frame.pts} {pose.get_string('status')} {pose.get_value('frame')}")
    return Gst.PadProbeReturn.OK


def print_message(message):
    pose = message.get_structure()
    if pose.get_name() != "dotpose":
        return
    if pose.get_string("status") != "ok":
        say("message " + pose.get_string("message"))
        return
    names = ["x_mm", "y_mm", "theta_deg", "sigma_x_mm"]
    say(
        "message x %.3f mm, y %.3f mm, angle %.4f degrees, sigma of x %.6f mm"
        % tuple(pose.get_value(name) for name in names)
    )


def main():
    Gst.init(None)
    pipeline = Gst.parse_launch(sys.argv[1] + " ! dotposelocate name=locate ! fakesink")
    source = pipeline.get_by_name("locate").get_static_pad("src")
    source.add_probe(Gst.PadProbeType.BUFFER, print_frame)
    pipeline.set_state(Gst.State.PLAYING)
    wanted = Gst.MessageType.ELEMENT | Gst.MessageType.ERROR | Gst.MessageType.EOS
    while True:
        message = pipeline.get_bus().timed_pop_filtered(Gst.CLOCK_TIME_NONE, wanted)
        if message.type != Gst.MessageType.ELEMENT:
            break
        print_message(message)
    pipeline.set_state(Gst.State.NULL)
    if message.type == Gst.MessageType.ERROR:
        sys.exit(message.parse_error()[0].message)


if __name__ == "__main__":
    main()
