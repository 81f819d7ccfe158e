"""Tests poses of cameras in space on simulated frames."""

import math

import pytest

import dotpose

DISTANCE_MM = 16.0
TILT = 0.35


def tilted_view():
    """Returns a shot from a camera tilted towards +x on the paper, and the camera itself."""
    shot = dotpose.draw_shots(1, seed=5, width_px=320, height_px=240, section=(0, 0))[0]
    shot.theta_rad = 0.0
    shot.tilt_x_rad = 0.0
    shot.tilt_y_rad = TILT
    camera = dotpose.Camera(320, 240)
    camera.focal_px = DISTANCE_MM / 0.046
    return shot, camera


def test_a_follower_finds_the_pose_in_space():
    shot, camera = tilted_view()
    pose = dotpose.Follower(camera=camera, space=True).locate(shot.render()).space
    x_mm, y_mm, z_mm = pose.position_mm
    assert x_mm == pytest.approx(shot.x_mm + DISTANCE_MM * math.sin(TILT), abs=0.05)
    assert y_mm == pytest.approx(shot.y_mm, abs=0.05)
    assert z_mm == pytest.approx(-DISTANCE_MM * math.cos(TILT), abs=0.05)
    assert pose.tilt_rad == pytest.approx(TILT, abs=0.003)
    assert pose.azimuth_rad == pytest.approx(0, abs=0.01)
    assert pose.turn_rad == pytest.approx(0, abs=0.01)
    # A rotation by -TILT about the y axis of the paper.
    assert pose.quaternion == pytest.approx(
        (0, -math.sin(TILT / 2), 0, math.cos(TILT / 2)), abs=0.005
    )
    assert pose.covariance.shape == (6, 6) and pose.covariance[2, 2] > 0
    assert pose.dots > 300 and not pose.is_ambiguous
    assert pose.second is None or pose.second[2] < -30


def test_the_pose_on_a_page_and_in_the_world():
    shot, camera = tilted_view()
    entry = dotpose.SheetEntry("table", dotpose.make_sheet("A4", origin=(5000, 7000)))
    entry.world = dotpose.WorldPose(1.0, 2.0, 0.0)
    sheet = entry.sheet
    shot.x_mm = sheet.origin[0] * sheet.spacing_mm + 100 - sheet.origin_x_mm
    shot.y_mm = sheet.origin[1] * sheet.spacing_mm + 50 - sheet.origin_y_mm
    pose = dotpose.Follower([entry], camera=camera, space=True).locate(shot.render()).space
    x_mm = 100 + DISTANCE_MM * math.sin(TILT)
    z_mm = DISTANCE_MM * math.cos(TILT)
    assert pose.on_sheet(entry) == pytest.approx((x_mm, 50, -z_mm), abs=0.05)
    world = pose.in_world(entry)
    assert world.position_m == pytest.approx((1 + x_mm / 1000, 1.95, z_mm / 1000), abs=5e-5)
    assert world.covariance.shape == (6, 6)
    entry.world = None
    assert pose.in_world(entry) is None


def test_the_tip_of_a_pen():
    shot, camera = tilted_view()
    follower = dotpose.Follower(camera=camera, space=True)
    assert follower.locate(shot.render()).tip is None
    # The tip is at the point where the optical axis meets the paper, so the pen touches the paper.
    camera.tip = dotpose.PenTip(0, 0, DISTANCE_MM)
    located = dotpose.Follower(camera=camera, space=True).locate(shot.render())
    assert (located.tip.x_mm, located.tip.y_mm) == pytest.approx((shot.x_mm, shot.y_mm), abs=0.02)
    assert located.tip.height_mm == pytest.approx(0, abs=0.02)
    assert located.tip.covariance.shape == (3, 3)
    assert located.is_pen_down
    camera.tip = dotpose.PenTip(0, 0, DISTANCE_MM - 1, rest_mm=0.5)
    located = dotpose.Follower(camera=camera, space=True).locate(shot.render())
    assert located.tip.height_mm == pytest.approx(math.cos(TILT) - 0.5, abs=0.02)
    assert not located.is_pen_down


def test_no_pose_in_space_without_being_asked():
    shot, camera = tilted_view()
    assert dotpose.Follower(camera=camera).locate(shot.render()).space is None


def test_a_pose_in_space_needs_a_focal_length():
    _, camera = tilted_view()
    camera.focal_px = None
    with pytest.raises(dotpose.Error, match="focal_px"):
        dotpose.Follower(camera=camera, space=True)
    with pytest.raises(dotpose.Error, match="camera"):
        dotpose.Follower(space=True)


def test_a_tracker_follows_the_camera_in_space():
    shot, camera = tilted_view()
    follower = dotpose.Follower(camera=camera, space=True)
    tracker = dotpose.SpaceTracker(acceleration_mm_s2=3000)
    assert tracker.track.is_lost and tracker.predict(0) is None
    start_mm = shot.x_mm
    for i in range(10):  # 30 mm/s along x, at 50 frames per second
        shot.x_mm = start_mm + 0.6 * i
        now = follower.follow(shot.render(), 20_000 * i)
        track = tracker.update(20_000 * i, now.space)
        assert track.verdict == "accepted" and track.is_new == (i == 0)
        # The follower also tracks the camera, with the default options, so the two tracks agree
        # closely.
        assert now.space_track.position_mm == pytest.approx(track.position_mm, abs=0.05)
    assert track.position_mm == pytest.approx(now.space.position_mm, abs=0.05)
    assert track.velocity_mm_s == pytest.approx((30, 0, 0), abs=3)
    assert track.turn_rad_s == pytest.approx((0, 0, 0), abs=0.3)
    assert track.covariance.shape == track.velocity_covariance.shape == (6, 6)
    ahead = tracker.predict(200_000)
    assert ahead.position_mm[0] == pytest.approx(track.position_mm[0] + 0.6, abs=0.1)
    assert ahead.covariance[0, 0] > track.covariance[0, 0]
    assert tracker.update(1_000_000).is_lost
    assert follower.locate(shot.render()).space_track is None
    with pytest.raises(TypeError, match="no option"):
        dotpose.SpaceTracker(speed=1)
