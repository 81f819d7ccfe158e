"""Tests print maps on simulated frames."""

import copy
import random

import numpy as np
import pytest

import dotpose

PAGE_MM = 25.0


@pytest.fixture(scope="module")
def entry():
    sheet = dotpose.make_sheet("25x25", margin_mm=0, origin=(5000, 7000))
    return dotpose.SheetEntry("page", sheet)


def shots_of(entry, count, seed, print_seed=5):
    """Yields shots of one print of the page. The printed dots have position errors with
    a standard deviation of 10 um."""
    rng = random.Random(seed)
    first = dotpose.draw_shots(1, seed=print_seed, width_px=320, height_px=240, section=(0, 0))[0]
    first.tilt_x_rad = first.tilt_y_rad = 0.0
    first.jitter_mm = 0.010
    for i in range(count):
        shot = copy.copy(first)
        shot.seed = 1000 * seed + i
        shot.theta_rad = rng.uniform(-3.1, 3.1)
        sheet = entry.sheet
        shot.x_mm = sheet.origin[0] * sheet.spacing_mm + rng.uniform(6, PAGE_MM - 6)
        shot.y_mm = sheet.origin[1] * sheet.spacing_mm + rng.uniform(6, PAGE_MM - 6)
        yield shot


@pytest.fixture(scope="module")
def result(entry):
    return dotpose.make_print_map((shot.render() for shot in shots_of(entry, 50, 1)), [entry])


def error_um(follower, shots):
    """Returns the rms error of the fixes, per axis, after removing the mean offset, rotation and
    scale.

    These three errors are removed because they are zero in a map by definition. In the print, they
    amount to about 0.2 um on a page of this size.
    """
    rows, errors = [], []
    for shot in shots:
        fix = follower.locate(shot.render()).fix
        x, y = shot.x_mm - 5000 * 0.508, shot.y_mm - 7000 * 0.508
        rows += [(1, 0, x, -y), (0, 1, y, x)]
        errors += [fix.x_mm - shot.x_mm, fix.y_mm - shot.y_mm]
    design = np.array(rows)
    left = errors - design @ np.linalg.lstsq(design, np.array(errors), rcond=None)[0]
    return 1000 * float(np.sqrt((left**2).sum() / (len(left) - 4)))


def test_the_map_has_the_statistics_of_the_print(result):
    assert result.frames == 50 and result.map.pages == ["page"]
    page = result.pages[0]
    assert page.name == "page" and page.frames == 50 and 0 < page.seen <= page.dots
    assert page.jitter_mm == pytest.approx(0.010, rel=0.1)
    assert 0 < page.error_mm < 0.001
    assert page.is_rigid


def test_a_follower_uses_the_map(entry, result):
    without = error_um(dotpose.Follower([entry]), shots_of(entry, 20, 2))
    mapped = dotpose.Follower([entry], print_map=result.map)
    assert error_um(mapped, shots_of(entry, 20, 2)) < without / 2
    shot = next(shots_of(entry, 1, 3))
    assert mapped.locate(shot.render()).map_use == "used"
    assert dotpose.Follower([entry]).locate(shot.render()).map_use == "no_map"
    other = next(shots_of(entry, 1, 3, print_seed=6))
    assert mapped.locate(other.render()).map_use == "contradicted"


def test_map_files(entry, result, tmp_path):
    path = tmp_path / "desk.map"
    result.map.write(path)
    assert dotpose.PrintMap.read(path).pages == ["page"]
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(dotpose.Error, match="make the map again"):
        dotpose.PrintMap.read(path)
    moved = dotpose.SheetEntry("page", dotpose.make_sheet("25x25", margin_mm=0, origin=(1, 1)))
    with pytest.raises(dotpose.Error, match="make a map of the pages of this file"):
        dotpose.Follower([moved], print_map=result.map)


def test_a_map_is_updated(entry, result):
    images = [shot.render() for shot in shots_of(entry, 12, 4)]
    again = dotpose.make_print_map(images, [entry], earlier=result.map)
    assert again.frames == 12 and again.pages[0].frames == 12
    others = [shot.render() for shot in shots_of(entry, 12, 4, print_seed=6)]
    with pytest.raises(dotpose.Error, match="make a new map"):
        dotpose.make_print_map(others, [entry], earlier=result.map)
