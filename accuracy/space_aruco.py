#!/usr/bin/python3
"""Compares poses of a webcam over a coarse sheet with poses over a board of ArUco markers.

    accuracy/space_aruco.py build/release/bin/dotpose [FRAMES]

Both cameras have 640 x 480 px, a focal length of 1,000 px, a distance of 400 mm, a blur of 0.55 px, and
noise of 3 grey levels. The sheet has dots every 5 mm. The board has 6 x 4 markers of 40 mm, every
48 mm. Prints the table of docs/pose-in-space.md. Needs Debian's python3-opencv.
"""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import cv2
import numpy

WIDTH, HEIGHT, FOCAL_PX, DISTANCE_MM = 640, 480, 1000.0, 400.0
BLUR_PX, NOISE, PAPER, INK = 0.55, 3.0, 200.0, 30.0
MATRIX = numpy.array([[FOCAL_PX, 0, 319.5], [0, FOCAL_PX, 239.5], [0, 0, 1]])
CAMERA = f"""format: dotpose-camera
version: 1
width_px: {WIDTH}
height_px: {HEIGHT}
k_per_px2: 0
centre_px: [319.5, 239.5]
focal_px: {FOCAL_PX}
"""
TILTS_DEG = (0, 20, 40)


def turn_x(angle):
    c, s = math.cos(angle), math.sin(angle)
    return numpy.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def turn_z(angle):
    c, s = math.cos(angle), math.sin(angle)
    return numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def true_pose(x_mm, y_mm, theta_rad, tilt_rad):
    """Returns the rotation from camera to paper, and the position of a camera aimed at a point."""
    rotation = turn_z(theta_rad) @ turn_x(tilt_rad).T
    return rotation, numpy.array([x_mm, y_mm, 0]) - DISTANCE_MM * rotation[:, 2]


def errors(rotation, position, truth):
    """Returns the distance in mm and the angle in degrees between a pose and the truth."""
    turn, _ = cv2.Rodrigues(rotation.T @ truth[0])
    return numpy.linalg.norm(position - truth[1]), math.degrees(numpy.linalg.norm(turn))


def rotation_of(q):
    x, y, z, w = q
    vector = numpy.array([x, y, z])
    length = numpy.linalg.norm(vector)
    angle = 2 * math.atan2(length, w)
    rotation, _ = cv2.Rodrigues(vector / max(length, 1e-12) * angle)
    return rotation


def dotpose_errors(tool, frames, tilt_deg):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "camera.yaml").write_text(CAMERA)
        subprocess.run(
            [tool, "simulate", "-o", folder / "frames", f"--frames={frames}", "--preset=clean",
             f"--size={WIDTH}x{HEIGHT}", "--spacing=5", f"--mm-per-px={DISTANCE_MM / FOCAL_PX}",
             f"--working-distance={DISTANCE_MM}", f"--tilt={tilt_deg},0", f"--blur={BLUR_PX}",
             f"--noise={NOISE}", f"--paper-level={PAPER}", f"--ink={INK / PAPER}"],
            check=True, stdout=subprocess.DEVNULL)
        lines = subprocess.run(
            [tool, "locate", "--camera", folder / "camera.yaml", "--pose=space", "--spacing=5",
             folder / "frames"],
            check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
        with open(folder / "frames" / "truth.csv", encoding="utf-8") as file:
            truths = list(csv.DictReader(file))
        found = []
        for line, row in zip(lines, truths):
            pose = json.loads(line)
            if "camera_x_mm" not in pose or pose["camera_is_ambiguous"]:
                continue
            truth = true_pose(float(row["x_mm"]), float(row["y_mm"]),
                              math.radians(float(row["theta_deg"])), math.radians(tilt_deg))
            position = numpy.array([pose[f"camera_{axis}_mm"] for axis in "xyz"])
            found.append(errors(rotation_of(pose["camera_quaternion_xyzw"]), position, truth))
        return found


class Board:
    """A picture of a board of ArUco markers, with a known scale."""

    PX_PER_MM = 8

    def __init__(self):
        names = cv2.aruco.Dictionary_get(cv2.aruco.DICT_5X5_50)
        self.names = names
        marker, pitch, margin = 40, 48, 60
        columns, rows = 6, 4
        width = (columns - 1) * pitch + marker + 2 * margin
        height = (rows - 1) * pitch + marker + 2 * margin
        s = self.PX_PER_MM
        self.picture = numpy.full((height * s, width * s), PAPER, numpy.float32)
        self.corners = {}
        for index in range(columns * rows):
            left = margin + index % columns * pitch
            top = margin + index // columns * pitch
            square = cv2.aruco.drawMarker(names, index, marker * s).astype(numpy.float32)
            self.picture[top * s:(top + marker) * s, left * s:(left + marker) * s] = (
                INK + (PAPER - INK) * square / 255)
            self.corners[index] = [(left, top, 0), (left + marker, top, 0),
                                   (left + marker, top + marker, 0), (left, top + marker, 0)]
        self.middle = (width / 2, height / 2)

    def frame(self, truth, random):
        """Renders a frame with 4 x 4 samples per pixel, and adds blur, noise and rounding."""
        fine = 4
        rotation, position = truth
        # Homography from points (x, y, 1) on the paper to pixels.
        columns = numpy.column_stack(
            [rotation.T[:, 0], rotation.T[:, 1], -rotation.T @ position])
        to_fine = numpy.array([[fine, 0, (fine - 1) / 2], [0, fine, (fine - 1) / 2], [0, 0, 1]])
        to_mm = numpy.array([[1 / self.PX_PER_MM, 0, 0.5 / self.PX_PER_MM],
                             [0, 1 / self.PX_PER_MM, 0.5 / self.PX_PER_MM], [0, 0, 1]])
        image = cv2.warpPerspective(
            self.picture, to_fine @ MATRIX @ columns @ to_mm, (WIDTH * fine, HEIGHT * fine),
            flags=cv2.INTER_LINEAR, borderValue=PAPER)
        image = cv2.GaussianBlur(image, (0, 0), BLUR_PX * fine)
        image = image.reshape(HEIGHT, fine, WIDTH, fine).mean(axis=(1, 3))
        image += random.normal(0, NOISE, image.shape)
        return numpy.clip(numpy.rint(image), 0, 255).astype(numpy.uint8)


def aruco_errors(frames, tilt_deg, random):
    board = Board()
    options = cv2.aruco.DetectorParameters_create()
    options.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    found = []
    for _ in range(frames):
        x_mm, y_mm = numpy.array(board.middle) + random.uniform(-20, 20, 2)
        truth = true_pose(x_mm, y_mm, random.uniform(-math.pi, math.pi), math.radians(tilt_deg))
        corners, ids, _ = cv2.aruco.detectMarkers(
            board.frame(truth, random), board.names, parameters=options)
        if ids is None:
            continue
        places = numpy.array([p for i in ids.ravel() for p in board.corners[i]], numpy.float64)
        pixels = numpy.array(corners, numpy.float64).reshape(-1, 2)
        _, turn, shift = cv2.solvePnP(places, pixels, MATRIX, None, flags=cv2.SOLVEPNP_IPPE)
        turn, shift = cv2.solvePnPRefineLM(places, pixels, MATRIX, None, turn, shift)
        rotation = cv2.Rodrigues(turn)[0].T
        found.append(errors(rotation, -(rotation @ shift).ravel(), truth))
    return found


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    frames = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    random = numpy.random.default_rng(1)
    print("| tilt, degrees | target | poses | position, mm rms | largest | rotation, degrees rms | "
          "largest |\n|--:|---|--:|--:|--:|--:|--:|")
    for tilt_deg in TILTS_DEG:
        for name, found in (("sheet, 5 mm", dotpose_errors(sys.argv[1], frames, tilt_deg)),
                            ("ArUco board", aruco_errors(frames, tilt_deg, random))):
            values = numpy.array(found)
            rms = numpy.sqrt((values**2).mean(axis=0))
            largest = values.max(axis=0)
            print(f"| {tilt_deg} | {name} | {len(found)} of {frames} | {rms[0]:.3f} | "
                  f"{largest[0]:.3f} | {rms[1]:.4f} | {largest[1]:.4f} |", flush=True)


if __name__ == "__main__":
    main()
