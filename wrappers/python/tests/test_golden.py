"""Tests that results for the golden frames are bit-identical to those of C++ (wrappers/golden)."""

import pytest

import dotpose
from conftest import bits_of, images_in


@pytest.mark.parametrize("name, count", [("nominal", 200), ("hard", 150), ("vga", 40)])
def test_golden_frames_give_the_bits_of_cpp(golden, name, count):
    lines = []
    images = images_in(golden / f"{name}.frames")
    for index, (image, following) in enumerate(zip(images, images)):
        locator = dotpose.Locator("anoto")
        fix = locator.locate(image)
        lines.append((index, "locate", bits_of(fix)))
        if fix:
            tracked = locator.locate(following, dotpose.Prediction.like(fix))
            lines.append((index, "tracked", bits_of(tracked)))
        lines.append((index, "any_code", bits_of(dotpose.Locator().locate(image))))
        if image.shape[1] <= 188:
            device = dotpose.Locator("anoto", options=dotpose.Options(effort="device"))
            assert device.locate(image).attempt == "device" or not device.locate(image)
    expected = [
        (int(index), way, rest)
        for index, way, rest in (
            line.split(",", 2) for line in (golden / f"{name}.csv").read_text().splitlines()
        )
        if way != "device"
    ]
    assert sum(way == "locate" for _, way, _ in lines) == count
    assert lines == expected


def test_simulated_frames_are_those_of_cpp(golden):
    images = images_in(golden / "nominal.frames")
    for shot in dotpose.draw_shots(20, "nominal", seed=2424):
        assert (shot.render() == next(images)).all()
        shot.move(0.25, -0.25)
        shot.theta_rad += 0.035
        shot.seed += 1
        assert (shot.render() == next(images)).all()
