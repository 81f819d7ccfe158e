"""Tests the calibration of simulated cameras, camera files, and the paper's experiment."""

import math
import os
import signal
import threading

import numpy as np
import pytest

import dotpose

K_PER_PX2 = -4e-6


@pytest.fixture(scope="module")
def lens():
    """Returns a calibration computed from the frames of a camera with a known lens."""
    frames = dotpose.simulate(8, seed=5, section=(0, 0), k_per_px2=K_PER_PX2)
    return dotpose.calibrate(frame.image for frame in frames)


def test_the_lens_is_found(lens, tmp_path):
    assert lens.located == lens.frames == 8 and lens.verdict == "good" and lens.code == "anoto"
    assert lens.camera.k_per_px2 == pytest.approx(K_PER_PX2, rel=0.1)
    assert lens.residual_px < lens.residual_before_px and lens.advice
    assert lens.px_per_spacing == pytest.approx(0.508 / 0.046, rel=0.02)
    lens.draw(tmp_path / "lens.svg")
    assert "<svg" in (tmp_path / "lens.svg").read_text()


def test_camera_files(lens, tmp_path):
    lens.camera.reference_px = (10.5, 20.0)
    lens.camera.write(tmp_path / "camera.yaml")
    again = dotpose.Camera.read(tmp_path / "camera.yaml")
    assert again.k_per_px2 == pytest.approx(lens.camera.k_per_px2)
    assert again.reference_px == (10.5, 20.0) and again.width_px == 188
    with pytest.raises(dotpose.Error, match="none.yaml"):
        dotpose.Camera.read(tmp_path / "none.yaml")
    with pytest.raises(dotpose.BadArgument):
        dotpose.Camera(188, 120, k_per_px2=1.0)


def test_points_go_through_the_lens_and_back():
    camera = dotpose.Camera(188, 120, K_PER_PX2, centre_px=(94.0, 60.0))
    points = np.array([[94.0, 60.0], [0.0, 0.0], [187.0, 119.0]])
    straight = camera.undistorted(points)
    np.testing.assert_allclose(straight[0], points[0])
    radius2 = (94.0**2 + 60.0**2)
    np.testing.assert_allclose(straight[1] - points[0], -points[0] / (1 + K_PER_PX2 * radius2))
    np.testing.assert_allclose(camera.distorted(straight), points, atol=1e-6)
    with pytest.raises(TypeError, match=r"\(n, 2\)"):
        camera.undistorted(np.zeros(3))


def test_a_locator_uses_the_camera(lens):
    frame = dotpose.simulate(1, seed=77, section=(0, 0), k_per_px2=K_PER_PX2)[0]
    camera = dotpose.Camera(188, 120, K_PER_PX2)
    fix = dotpose.Locator(camera=camera).locate(frame.image)
    assert fix.x_mm == pytest.approx(frame.shot.x_mm, abs=0.005)
    with pytest.raises(dotpose.BadArgument, match="188 x 120"):
        dotpose.Locator(camera=camera).locate(frame.image[:100])
    with pytest.raises(TypeError):
        dotpose.Locator(camera="camera.yaml")


def turned_and_driven():
    """Yields images from a robot that turns about a point 2 mm to the right of the image centre."""
    shot = dotpose.draw_shots(1, seed=31, section=(0, 0))[0]
    x_mm, y_mm = shot.x_mm, shot.y_mm
    for step in range(12):
        angle = step * math.pi / 6
        shot.theta_rad = math.remainder(angle, 2 * math.pi)
        shot.x_mm = x_mm - 2 * math.cos(angle)
        shot.y_mm = y_mm - 2 * math.sin(angle)
        yield shot.render()


def test_the_mount_is_found(tmp_path):
    spin = dotpose.calibrate_spin(turned_and_driven())
    assert spin.located == 12 and spin.verdict == "good"
    assert spin.offset_mm == (pytest.approx(2, abs=0.05), pytest.approx(0, abs=0.05))
    spin.draw(tmp_path / "spin.svg")
    shot = dotpose.draw_shots(1, seed=31, section=(0, 0))[0]
    shot.theta_rad = 0.4
    images = []
    for _ in range(5):
        images.append(shot.render())
        shot.x_mm += 4
    drive = dotpose.calibrate_drive(images)
    assert drive.length_mm == pytest.approx(16, abs=0.1)
    assert drive.camera.theta_offset_rad == pytest.approx(-0.4, abs=0.01)


def test_frames_that_do_not_pivot_are_an_error():
    camera = dotpose.Camera(188, 120)
    camera.focal_px = 16 / 0.046
    shot = dotpose.draw_shots(1, seed=31, section=(0, 0))[0]
    with pytest.raises(dotpose.Error, match="does not pivot enough"):
        dotpose.calibrate_pivot([shot.render()] * 6, camera)


def test_series_that_show_nothing_are_an_error(tmp_path):
    blank = np.full((120, 188), 200, np.uint8)
    with pytest.raises(dotpose.Error):
        dotpose.calibrate([blank, blank])
    with pytest.raises(dotpose.Error, match="none.png"):
        dotpose.calibrate([tmp_path / "none.png", tmp_path / "none.png"])
    with pytest.raises(TypeError, match="uint8"):
        dotpose.calibrate([blank, 3])
    with pytest.raises(dotpose.Error):
        dotpose.stitch_sheets([blank], [])


def test_the_experiment_of_the_paper():
    protocol = dotpose.run_protocol(2, seed=3)
    assert len(protocol.printed.positions) == 121 and len(protocol.printed.angles) == 36
    places = np.array([station.place_mm for station in protocol.printed.positions])
    assert places.min() == -100 and places.max() == 100
    assert all(s.located == s.samples == 2 and s.wrong == 0 for s in protocol.perfect.positions)
    # Paper, Table III: the printing errors are far larger than the localization errors.
    worst = max(abs(s.y_mm[0]) for s in protocol.printed.positions)
    assert 0.1 < worst < 0.5 and max(abs(s.y_mm[0]) for s in protocol.perfect.positions) < 0.01


def test_ctrl_c_ends_long_work():
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        dotpose.run_protocol(300)
