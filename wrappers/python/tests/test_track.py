"""Tests Tracker and Follower on simulated drives."""

import copy
import math

import numpy as np
import pytest

import dotpose

PERIOD_US = 10_000


def drive(frames, step_mm=0.15, turn_rad=0.002):
    """Yields the times and shots of a robot that drives along x and turns at the same time."""
    shot = dotpose.draw_shots(1, seed=21, section=(0, 0))[0]
    for index in range(frames):
        yield index * PERIOD_US, copy.copy(shot)
        shot.x_mm += step_mm
        shot.theta_rad += turn_rad
        shot.seed += 1


def test_frames_that_are_too_small_are_read_together():
    shot = dotpose.draw_shots(1, seed=5, section=(0, 0), width_px=80, height_px=80)[0]
    motion = dotpose.MeasuredMotion(
        right_mm=1.5, down_mm=1.5, sigma_mm=0.02, sigma_rad=0.005
    )
    locator, fixes = dotpose.Locator(), []
    for _ in range(6):
        fixes.append(locator.locate(shot.render(), motion=motion))
        c, s = math.cos(shot.theta_rad), math.sin(shot.theta_rad)
        shot.x_mm += 1.5 * (c - s)
        shot.y_mm += 1.5 * (s + c)
        shot.seed += 1
    assert not fixes[0].ok and fixes[-1].ok
    assert max(fix.frames for fix in fixes) > 1
    with pytest.raises(ValueError, match="sigmas not negative"):
        locator.locate(shot.render(), motion=dotpose.MeasuredMotion(sigma_mm=-1, sigma_rad=0))


def test_odometry_carries_the_pose_on():
    locator, tracker = dotpose.Locator(), dotpose.Tracker()
    shot = dotpose.draw_shots(1, seed=21, section=(0, 0))[0]
    tracker.update(0, locator.locate(shot.render()))
    motion = dotpose.MeasuredMotion(right_mm=0.5, sigma_mm=0.01, sigma_rad=0.001)
    for index in range(1, 101):
        track = tracker.update(index * PERIOD_US, motion=motion)
    assert not track.is_lost
    distance = math.hypot(track.x_mm - shot.x_mm, track.y_mm - shot.y_mm)
    assert distance == pytest.approx(50, abs=0.1)
    assert 0.1 < math.sqrt(track.covariance[0, 0] + track.covariance[1, 1]) < 1.0


def test_a_tracker_knows_pose_and_speed():
    locator, tracker = dotpose.Locator(), dotpose.Tracker()
    assert tracker.track.is_lost and tracker.predict(0) is None
    assert math.isnan(tracker.track.x_mm) and np.isnan(tracker.track.covariance).all()
    attempts = []
    for time_us, shot in drive(60):
        fix = locator.locate(shot.render(), tracker.predict(time_us))
        attempts.append(fix.attempt)
        track = tracker.update(time_us, fix)
        if time_us == 0:
            assert track.events == {"fix"}
    assert attempts.count("tracked") > 50
    assert not track.is_lost and track.verdict == "accepted" and track.p_wrong < 1e-9
    assert track.x_mm == pytest.approx(shot.x_mm, abs=0.01)
    assert track.vx_mm_s == pytest.approx(15.0, abs=0.5)
    assert track.vy_mm_s == pytest.approx(0.0, abs=0.5)
    assert track.turn_rad_s == pytest.approx(0.2, abs=0.05)
    assert track.covariance.shape == (6, 6) and track.covariance[0, 0] > 0
    assert track.time_us == time_us
    lost = tracker.update(time_us + 100_000)
    assert lost.is_lost and lost.events == {"lost"} and lost.verdict == "none"


def test_options_of_a_tracker_are_checked():
    dotpose.Tracker(max_speed_mm_s=50, confirmations=2, lost_after_us=30_000)
    with pytest.raises(TypeError, match="max_speed"):
        dotpose.Tracker(max_speed=50)
    with pytest.raises(TypeError, match="confirmations must be a number"):
        dotpose.Tracker(confirmations="two")


def test_a_follower_without_sheets_tracks_in_the_pattern():
    follower = dotpose.Follower()
    for time_us, shot in drive(30):
        now = follower.follow(shot.render(), time_us)
    assert now and now.fix.ok and now.place is None and not follower.is_in_world
    assert now.fix.attempt == "tracked" and now.track.vx_mm_s == pytest.approx(15.0, abs=0.5)


def sheet_entry(world=None):
    entry = dotpose.SheetEntry("table", dotpose.make_sheet("A4", origin=(5000, 7000)))
    entry.world = world
    return entry


def shot_on(entry, x_mm, y_mm, theta_rad=0.3):
    """Returns a shot at the given position on the page."""
    sheet = entry.sheet
    shot = dotpose.draw_shots(1, seed=2, section=(0, 0))[0]
    shot.x_mm = sheet.origin[0] * sheet.spacing_mm + x_mm - sheet.origin_x_mm
    shot.y_mm = sheet.origin[1] * sheet.spacing_mm + y_mm - sheet.origin_y_mm
    shot.theta_rad = theta_rad
    return shot


def test_a_follower_finds_the_place_on_a_sheet_and_in_the_world():
    entry = sheet_entry(dotpose.WorldPose(1.0, 2.0, math.pi / 2))
    follower = dotpose.Follower([entry])
    assert follower.is_in_world and [e.name for e in follower.sheets] == ["table"]
    found = follower.locate(shot_on(entry, 100, 50).render())
    place = found.place
    assert place.name == place.entry.name == "table" and found.track is None
    assert (place.x_mm, place.y_mm) == (pytest.approx(100, abs=0.01), pytest.approx(50, abs=0.01))
    assert place.theta_rad == pytest.approx(0.3, abs=0.003)
    assert place.covariance.shape == (3, 3) and place.covariance[0, 0] > 0
    # The page's x axis is the world's y axis, so the page's y axis (down) is the world's x axis.
    world = place.world
    assert (world.x_m, world.y_m) == (pytest.approx(1.05, abs=1e-5), pytest.approx(2.1, abs=1e-5))
    assert world.yaw_rad == pytest.approx(math.pi / 2 - 0.3, abs=0.003)
    track = follower.follow(shot_on(entry, 100, 50).render(), 0).track
    assert track.x_mm == pytest.approx(1050, abs=0.02)


def test_a_place_outlives_its_follower():
    entry = sheet_entry()
    place = dotpose.Follower([entry]).locate(shot_on(entry, 100, 50).render()).place
    assert place.name == "table" and place.world is None


def test_a_follower_keeps_stages_if_asked(frames):
    image = frames[0].image
    assert len(dotpose.Follower(keep_stages=True).locate(image).fix.dots) > 100
    with pytest.raises(dotpose.Error):
        dotpose.Follower().locate(image).fix.dots


def test_large_images_are_reduced():
    frame = dotpose.simulate(1, seed=3, width_px=4500, height_px=200)[0]
    found = dotpose.Follower().locate(frame.image)
    assert found.reduced_by == 2 and found.fix.status != "image_too_large"
